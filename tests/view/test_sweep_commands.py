"""`new --case`, `sweep`, `worst`, `show`: what they write, say and refuse."""

import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure
from typer.testing import CliRunner

from quartering.study.maps.result import open_result
from quartering.view.cli import app

SMALL = """\
ship: series60-cb60
speed: [0, 6 m/s]
heading: 0..180 deg step 15
wave_length: 0.5..2 L count 8
wave_height: [1 m, 3 m]
loading:
  gm: [0.6 m, 1 m]
"""


def _run(*words):
    return CliRunner().invoke(app, [str(word) for word in words])


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    folder = tmp_path_factory.mktemp("case")
    (folder / "my.yaml").write_text(SMALL)
    found = _run("sweep", folder / "my.yaml", "--json")
    assert found.exit_code == 0, found.output
    return folder, json.loads(found.stdout)


def test_a_new_case_can_be_read_and_is_not_written_over(tmp_path):
    file = tmp_path / "c.yaml"
    assert _run("new", "wigley", file, "--case").exit_code == 0
    assert "wave_height:" in file.read_text()
    again = _run("new", "wigley", file, "--case")
    assert again.exit_code == 2
    assert "there already" in again.stderr


def test_sweep_stores_what_it_counts(case):
    folder, facts = case
    ds = open_result(folder / "my")
    assert facts["conditions"] == ds["verdict"].size == facts["stable"] + facts["unstable"] + facts["failed"]
    assert facts["stable"] == int((ds["verdict"] == 0).sum())
    assert "832 conditions in" in _run("sweep", folder / "my.yaml").stderr


def test_worst_agrees_with_the_dataset(case):
    folder, _ = case
    ds = open_result(folder / "my")
    found = json.loads(_run("worst", folder / "my", "--count", 2, "--json").stdout)
    assert found["worst"][0]["roll_peak"] == float(ds["roll_peak"].max())
    assert "Largest roll" in _run("worst", folder / "my").stdout
    assert "Least stable" in _run("worst", folder / "my", "--by", "margin").stdout


def test_show_writes_a_map_and_a_table_without_computing(case, tmp_path):
    folder, _ = case
    found = _run(
        "show", folder / "my", "--at", "wave_height=3", "-o", tmp_path / "m.png", "--csv", tmp_path / "t.csv", "--json"
    )
    assert found.exit_code == 0, found.output
    facts = json.loads(found.stdout)
    assert (tmp_path / "m.png").stat().st_size > 10_000
    assert len((tmp_path / "t.csv").read_text().splitlines()) == 1 + 2 * 2 * 13 * 8
    ds = open_result(folder / "my").sel(wave_height=3.0)
    np.testing.assert_allclose(np.max(facts["roll_peak"]), float(ds["roll_peak"].max()))


def test_show_takes_the_loading_asked_for(case, tmp_path, monkeypatch):
    drawn = []
    monkeypatch.setattr("quartering.view.plots.polar_map.polar_map", lambda ds: drawn.append(ds) or Figure())
    folder, _ = case
    ds = open_result(folder / "my")
    for asked, gm, index in (("0.95", 1.0, 1), ("0.5", 0.6, 0)):
        words = ("show", folder / "my", "--at", f"gm={asked}", "--at", "wave_height=3", "-o", tmp_path / "m.png")
        facts = json.loads(_run(*words, "--json").stdout)
        assert facts["at"] == {"gm": gm, "wave_height": 3.0}
        largest = ds["roll_peak"].isel(loading=index, wave_height=1).max(["wave_length"])
        np.testing.assert_array_equal(np.array(facts["roll_peak"], dtype=float), largest)
        np.testing.assert_array_equal(drawn[-1]["roll"], ds["roll"].isel(loading=index, wave_height=1))
        assert drawn[-1].attrs["loading"].startswith(f"GM {gm:.4g} m;")
    _run("show", folder / "my", "-o", tmp_path / "m.png")
    assert drawn[-1].attrs["loading"].startswith("GM 0.6 m (loading 1 of 2);")
    shown = _run("show", folder / "my", "--at", "gm=0.95").stdout
    assert "at GM [m] 1" in " ".join(shown.split())


def test_show_writes_a_zarr_store_of_the_cut(case, tmp_path):
    pytest.importorskip("zarr")
    folder, _ = case
    found = _run("show", folder / "my", "--at", "gm=1", "--zarr", tmp_path / "my.zarr")
    assert found.exit_code == 0, found.output
    with xr.open_zarr(tmp_path / "my.zarr", chunks=None, consolidated=False) as back:
        np.testing.assert_array_equal(back["roll"], open_result(folder / "my")["roll"].isel(loading=1))


def test_uncertainty_writes_probabilities(case, tmp_path):
    folder, _ = case
    found = _run(
        "sweep",
        folder / "my.yaml",
        "--uncertainty",
        "K_p=20%,gm=5%",
        "--draws",
        16,
        "-o",
        tmp_path / "p.nc",
        "--json",
    )
    assert found.exit_code == 0, found.output
    with xr.open_dataset(tmp_path / "p.nc") as ds:
        assert ds["probability_unstable"].attrs["units"] == "1"
        assert ds.attrs["draws"] == 16


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("sweep", "none.yaml"), "cannot be read"),
        (("worst", "none"), "there is no"),
        (("worst", "{case}.yaml"), "neither the folder"),
        (("show", "{case}", "--at", "foo=1"), "can be cut at"),
        (("show", "{case}", "--at", "speed"), "write it like"),
        (("show", "{case}", "-o", "x.gif"), ".png"),
        (("worst", "{case}", "--by", "sway"), "margin"),
        (("sweep", "{case}.yaml", "--uncertainty", "K_ppp"), "write it like"),
        (("sweep", "{case}.yaml", "--cluster", "moon"), "local:4"),
    ],
)
def test_bad_input_is_one_message_and_exit_2(case, words, message, tmp_path):
    if "--cluster" in words:
        pytest.importorskip("distributed")
        words = (*words, "-o", str(tmp_path / "s"))
    found = _run(*(word.replace("{case}", str(case[0] / "my")) for word in words))
    assert found.exit_code == 2
    assert message in found.stderr.splitlines()[-1]
    assert found.stderr.count("quartering: ") == 1


@pytest.mark.soak  # in the same process: tests/study/test_store.py, an interrupted sweep keeps its blocks
@pytest.mark.skipif(sys.platform == "win32", reason="POSIX signals")
def test_ctrl_c_keeps_what_is_finished(tmp_path):
    (tmp_path / "big.yaml").write_text(SMALL.replace("step 15", "step 0.5").replace("count 8", "count 60"))
    process = subprocess.Popen(
        [sys.executable, "-c", "from quartering.view.cli import main; main()", "sweep", "big.yaml"],
        cwd=tmp_path, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True, env=os.environ,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # a job in the background is started deaf to it
    )  # fmt: skip
    blocks, limit = tmp_path / "big" / "blocks", time.monotonic() + 600
    while process.poll() is None and time.monotonic() < limit and not list(blocks.glob("0*.nc")):
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=600)[1]
    assert process.returncode == 130, said
    assert "conditions are kept" in said
    assert list(blocks.glob("0*.nc"))
    assert not list(blocks.glob(".*"))
