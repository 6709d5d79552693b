"""The command line as a user meets it: what it prints, writes, refuses, and how it exits."""

import contextlib
import json
import os
import re
import signal
import subprocess
import sys
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
import typer
import xarray as xr
from typer.testing import CliRunner

import quartering as qt
from quartering.conventions import RangeWarning
from quartering.hull.righting.arm import vanishing_angle
from quartering.hydro.calm_water import calm_water_exponents
from quartering.stability.kind import Kind
from quartering.view import command
from quartering.view.cli import _names, app
from quartering.view.console.files import File, write_files
from quartering.view.console.run import as_command

CONDITION = ["--heading", "30", "--speed", "15kn", "--wave-length", "1L", "--wave-height", "3"]
SMALL_MAP = ["--speed", "0.25Fn", "--headings", "0:180:7", "--wave-lengths", "0.6L,1L"]


def test_ships_lists_every_built_in_ship(run):
    result = run("ships", "--json")
    assert result.exit_code == 0
    assert {"series60-cb60", "s175", "wigley", "box", "dtmb5415", "dtc"} <= set(json.loads(result.stdout))


def test_new_writes_a_file_that_every_command_takes(run, tmp_path):
    assert run("new", "series60-cb60", "my.yaml").exit_code == 0
    assert (tmp_path / "my.yaml").read_text().count(" m") > 3
    mine = json.loads(run("hull", "my.yaml", "--json").stdout)
    assert mine["hydrostatics"]["cb"] == pytest.approx(qt.hydrostatics(qt.ship("series60-cb60")).cb)


def test_hull_prints_hydrostatics_and_draws_the_body_plan(run, tmp_path):
    result = run("hull", "series60-cb60", "-o", "hull.png")
    assert result.exit_code == 0
    assert "assumed" in result.stdout
    assert "calm water" in result.stdout
    assert "deck" in result.stdout
    assert "GZ = +0.8128 phi +" in result.stdout
    assert "phi^3" in result.stdout
    assert (tmp_path / "hull.png").stat().st_size > 10_000


def test_coefficients_names_the_source_of_every_number(run):
    entries = json.loads(run("coefficients", "series60-cb60", "--speed", "0.25Fn", "--json").stdout)["coefficients"]
    by_name = {entry["name"]: entry for entry in entries}
    assert "estimated" in by_name["C_D"]["source"]
    assert by_name["Y_v"]["kind"] == "regression"
    assert by_name["C_D"]["unit"] == "1"
    assert all(entry["source"] for entry in entries)


def test_forces_are_those_of_the_library(run, tmp_path):
    result = run(
        "forces", "series60-cb60", "--speed", "5", "--wave-lengths", "1L", "--form", "stf", "-o", "f.png", "--json"
    )
    assert result.exit_code == 0
    printed = json.loads(result.stdout)["forms"]["stf"]["roll"][0]
    ship = qt.ship("series60-cb60")
    total = qt.wave_forces(ship, qt.Wave(ship.hull.length, 2.0), 5.0, 60.0)["total"].sel(mode="roll")
    assert printed[12] == pytest.approx(float(np.hypot(*total.values)), rel=1e-9)  # 60 deg of 0, 5, ..; amplitude 1 m
    assert (tmp_path / "f.png").exists()


def test_forces_say_how_far_the_forms_are_apart_and_what_they_rest_on(run):
    shown = run("forces", "wigley", "--speed", "5", "--wave-lengths", "1L,2L")
    facts = json.loads(run("forces", "wigley", "--speed", "5", "--wave-lengths", "1L,2L", "--json").stdout)
    assert set(facts["forms"]) == {"froude-krylov", "paper", "paper-corrected", "relative-motion", "stf"}
    length = qt.ship("wigley").hull.length
    assert facts["wave_length"] == [length, 2 * length]
    first, second = (
        qt.wave_forces(qt.ship("wigley"), qt.Wave(length, 2.0), 5.0, facts["heading"], form=form)["total"]
        .sel(mode="roll")
        .to_numpy()
        @ [1, -1j]
        for form in ("paper", "stf")
    )
    by_hand = np.abs(first - second).max() / np.abs(second).max()
    assert facts["largest_difference_from_stf"]["paper"]["roll"][0] == pytest.approx(by_hand, rel=1e-9)
    assert f"{by_hand:.1%}" in shown.stdout
    words = " ".join(shown.stdout.split())
    for said in ("centre of gravity G", "5 m/s", "Haddara, M. R. (1971)", "Salvesen"):
        assert said in words, said


def test_forces_stand_beside_panels_with_their_mesh(run):
    pytest.importorskip("capytaine")
    facts = json.loads(
        run("forces", "wigley", "--speed", "0", "--wave-lengths", "2L", "--form", "bem", "--json").stdout
    )
    assert set(facts["forms"]) == {"stf", "bem"}
    assert "40 x 12 panels" in facts["panels"]
    sway = {form: np.max(modes["sway"]) for form, modes in facts["forms"].items()}
    assert sway["bem"] == pytest.approx(
        sway["stf"], rel=0.1
    )  # the aim of 10 % beyond 0.8 L, see tests/loads/test_bem.py
    assert 0 < facts["largest_difference_from_stf"]["bem"]["sway"][0] < 0.1


def test_verdict_is_that_of_the_library(run):
    facts = json.loads(run("verdict", "series60-cb60", *CONDITION, "--json").stdout)
    ship = qt.ship("series60-cb60")
    model = qt.equations(ship, qt.Wave(ship.hull.length, 3.0), 15 * 1852 / 3600, 30.0)
    motion = qt.steady_motion(model, start="rest")
    verdict = qt.stability(model, motion)
    assert facts["sentence"] == verdict.sentence
    assert facts["roll_deg"] == pytest.approx(np.degrees(motion.amplitude[1]))
    assert facts["k2"] == pytest.approx(verdict.k2)
    assert [z["re"] for z in facts["exponents"]] == pytest.approx(list(verdict.exponents.real))
    words = run("verdict", "series60-cb60", *CONDITION).stdout
    assert "Heading 30 deg" in words
    assert "Floquet" in words
    assert "Estimated" in words


def test_verdict_with_an_autopilot_is_that_of_the_library(run):
    facts = json.loads(run("verdict", "series60-cb60", *CONDITION, "--autopilot", "1,10s,2s", "--json").stdout)
    assert facts["autopilot"] == {"gain": 1.0, "rate_gain": 10.0, "lag": 2.0}
    assert len(facts["multipliers"]) == 6
    refused = run("verdict", "series60-cb60", *CONDITION, "--autopilot", "1,2,3,4")
    assert refused.exit_code == 2
    assert "it has 3 values" in refused.output


def test_unstable_verdict_offers_cures(run, tmp_path):
    file = tmp_path / "restless.yaml"
    file.write_text(
        "base: series60-cb60\nname: restless\nmultipliers: {K_prr: -60}\nvelocities: absolute\ndrag: cubic\n"
    )
    words = " ".join(
        run(
            "verdict", file, "--heading", "30", "--speed", "8.6", "--wave-length", "1L", "--wave-height", "4"
        ).stdout.split()
    )
    assert "unstable (roll)" in words
    assert "K_prr" in words
    assert "restores stability" in words


def test_polar_writes_the_dataset_and_the_picture(run, tmp_path):
    result = run("polar", "series60-cb60", *SMALL_MAP, "-o", "map.nc", "--json")
    assert result.exit_code == 0
    summary = json.loads(result.stdout)["speeds"][0]
    with xr.open_dataset(tmp_path / "map.nc") as ds:
        assert dict(ds.sizes) | {"speed": 1, "heading": 7, "wave_length": 2} == dict(ds.sizes)
        assert summary["worst_roll"] == pytest.approx(float(ds["roll_peak"].max()))
        assert summary["least_stable"] == pytest.approx(float(ds["exponent"].max()))
        assert sum(summary["verdicts"].values()) == ds["verdict"].size
    assert (tmp_path / "map.png").stat().st_size > 20_000
    assert sorted(path.name for path in tmp_path.iterdir()) == ["map.nc", "map.png"]


def test_polar_of_a_course_unstable_ship_says_the_wave_is_not_to_blame(run):
    words = " ".join(run("polar", "box", *SMALL_MAP).stdout.split())
    assert "course-in-calm-water" in words
    assert "The ship leaves its course without any wave unless it is steered; the waves are not to blame." in words


def test_simulate_settles_on_the_steady_motion(run, tmp_path):
    facts = json.loads(
        run("simulate", "series60-cb60", *CONDITION, "--duration", "400", "-o", "roll.png", "--json").stdout
    )
    assert facts["largest_late_roll_deg"] == pytest.approx(facts["steady_roll_peak_deg"], rel=0.01)
    assert facts["capsize_time"] is None
    assert (tmp_path / "roll.png").exists()


def test_a_start_beyond_the_vanishing_angle_is_a_capsize_though_the_polynomial_rights_the_ship(run):
    """The righting arm of the lines vanishes at 72 deg; the fitted polynomial is positive there."""
    ship = qt.ship("series60-cb60").with_(righting="polynomial")
    with pytest.warns(RangeWarning, match="deck"):
        assert qt.righting_arm(ship, [75.0])[0] < 0
    model = qt.equations(ship, qt.Wave(ship.hull.length, 4.0), speed=8.0, heading=60.0)
    assert qt.simulate(model, 60.0, (0.0, np.radians(80.0), 0.0, 0.0)).attrs["capsize_time"] == 0.0
    unlimited = replace(model, told_vanishing=np.inf)
    assert "capsize_time" not in qt.simulate(unlimited, 60.0, (0.0, np.radians(80.0), 0.0, 0.0)).attrs
    wave = ("--heading", "60", "--speed", "8", "--wave-length", "1L", "--wave-height", "4")
    wave = (*wave, "--righting", "polynomial")
    facts = json.loads(run("simulate", "series60-cb60", *wave, "--roll", "80", "--json").stdout)
    assert facts["capsize_time"] == 0.0
    assert facts["capsize_angle_deg"] == pytest.approx(vanishing_angle(ship))
    said = run("simulate", "series60-cb60", *wave, "--roll", "80").stdout
    assert f"Capsizes after 0 s (roll past {vanishing_angle(ship):.3g} deg, where the righting arm vanishes)" in said
    assert "the steady motion" not in said


def test_what_to_type_next_is_one_line_each_however_long(run):
    length = "1" + "0" * 120 + "e-118"
    words = ("--heading", "60", "--speed", "5", "--wave-length", length, "--wave-height", "1")
    lines = run("simulate", "wigley", *words, "--duration", "20").stdout.splitlines()
    assert f"  quartering verdict wigley {' '.join(words)}" in lines


BAD = [
    (["hull", "series60-cb6"], "series60-cb60"),
    (["verdict", "wigley", "--heading", "30", "--speed", "5", "--wave-length", "-5", "--wave-height", "1"], "length"),
    (["verdict", "wigley", "--heading", "30", "--speed", "5", "--wave-length", "50", "--wave-height", "10"], "1/7"),
    (["verdict", "wigley", "--heading", "nan", "--speed", "5", "--wave-length", "50", "--wave-height", "1"], "heading"),
    (
        ["verdict", "wigley", "--heading", "30", "--speed", "5 furlong", "--wave-length", "50", "--wave-height", "1"],
        "kn",
    ),
    (["verdict", "wigley", *CONDITION, "--harmonics", "2"], "odd"),
    (["verdict", "wigley", *CONDITION, "--form", "cfd"], "stf"),
    (["polar", "wigley", "--wave-lengths", "1L:2L:1"], "2 or more"),
    (["polar", "wigley", "-o", "nowhere/map.nc"], "folder"),
    (["polar", "wigley", "-o", "map.txt"], ".nc"),
    (["hull", "wigley", "-o", "hull.jpg"], ".png"),
    (["simulate", "wigley", *CONDITION, "--duration", "-3"], "duration"),
    (["simulate", "wigley", *CONDITION, "--roll", "nan"], "--roll"),
    (["simulate", "wigley", *CONDITION, "--duration", "1e9"], "samples"),
    (
        ["verdict", "wigley", "--heading", "400", "--speed", "5", "--wave-length", "50", "--wave-height", "1"],
        "did you mean 40 deg",
    ),
    (["vary", "wigley", "--heading", "0:400:4"], "--heading: heading = 400"),
    (["vary", "wigley", "--gm", "1:2", "--heading", "-190"], "--heading: heading = -190"),
    (["polar", "wigley", "--headings", "0:400:5"], "--headings: heading = 400"),
    (["polar", "wigley", "--steepness", "1/30", "--wave-height", "4"], "leave one out"),
    (["figures", "6", "--scoreboard"], "--scoreboard"),
    (["coefficients", "wigley", "--frequency", "inf"], "--frequency"),
    (["polar", "wigley", "--headings", "0:nan:5"], "finite"),
    (["polar", "wigley", "--steepness", "1/5"], "1/7"),
    (["polar", "wigley", "--steepness", "0"], "above 0"),
    (["polar", "wigley", "--speed", "0,-5"], "it is from 0 m/s"),
    (["polar", "wigley", "--speed", "5,10kn,0.2Fn"], "unit on each"),
    (["polar", "wigley", "--wave-lengths", "0,50"], "wave_length = 0 m; it is above 0 m"),
    (["polar", "wigley", "--headings", "0:180:2000", "--wave-lengths", "1L:2L:1000"], "1000000"),
    (["new", "series60-cb6", "my.yaml"], "series60-cb60"),
    (["new", "wigley", "nowhere/my.yaml"], "folder"),
    (["forces", "wigley", "--form", "cfd"], "stf"),
    (["forces", "wigley", "--form", "bem"], "--speed 0"),
    (["forces", "wigley", "--wave-lengths", "0"], "above 0"),
    (["hull", "wigley", "-o", "/proc/hull.png"], "cannot be written"),
]


@pytest.mark.parametrize(("words", "hint"), BAD, ids=lambda w: " ".join(w) if isinstance(w, list) else "")
def test_bad_input_is_one_message_and_exit_2(run, tmp_path, words, hint):
    result = run(*words)
    assert result.exit_code == 2
    assert hint in result.stderr
    assert result.stderr.count("quartering:") == 1
    assert "Traceback" not in result.output
    assert result.stdout == ""
    assert list(tmp_path.iterdir()) == []


def test_keeping_pace_with_the_wave_is_a_message(run):
    speed = np.sqrt(9.81 * 60 / (2 * np.pi))
    result = run(
        "verdict", "wigley", "--heading", "0", "--speed", f"{speed:.9f}", "--wave-length", "60", "--wave-height", "1"
    )
    assert result.exit_code == 2
    assert "keeps pace" in result.stderr


def test_help_imports_nothing_heavy():
    """What makes it quick; `benchmarks/start_up.py` holds the time against its goal."""
    code = "import sys; sys.argv = ['quartering', '--help']\nfrom quartering.view.cli import app\n"
    code += "try: app()\nexcept SystemExit: pass\n"
    code += "heavy = {'numpy', 'numba', 'xarray', 'matplotlib', 'scipy'} & set(sys.modules)\n"
    code += "print('HEAVY', sorted(heavy))"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "HEAVY []" in result.stdout
    assert "polar" in result.stdout


def test_version_is_printed(run):
    assert run("--version").stdout.startswith("quartering ")


def test_ctrl_c_says_so_exits_130_and_leaves_nothing(run, tmp_path, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("quartering.study.maps.polar.polar", interrupted)
    result = run("polar", "wigley", *SMALL_MAP)
    assert result.exit_code == 130
    assert "interrupted" in result.stderr
    assert list(tmp_path.iterdir()) == []


def test_an_interrupt_that_the_compiler_let_go_is_no_traceback(run, monkeypatch):
    """Numba's callback to keep machine code loses it, and what was to be kept is then missing: a RuntimeError of its own."""

    def compiling(*_, **__):
        with contextlib.suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        raise RuntimeError("no compiled object yet")

    monkeypatch.setattr("quartering.study.maps.polar.polar", compiling)
    before = signal.signal(
        signal.SIGINT, signal.default_int_handler
    )  # a shell starts what runs beside it deaf to interrupts
    try:
        result = run("polar", "wigley", *SMALL_MAP)
    finally:
        signal.signal(signal.SIGINT, before)
    assert result.exit_code == 130
    assert result.stderr == "quartering: interrupted; nothing was written\n"


def test_a_disk_that_fills_up_leaves_the_old_file_and_no_half_of_the_new(tmp_path):
    old, other = tmp_path / "map.nc", tmp_path / "map.png"
    old.write_text("old")

    def half(path):
        path.write_text("ha")
        raise OSError(28, "No space left on device")

    with pytest.raises(qt.InputError, match="No space left"):
        write_files(File(old, lambda path: path.write_text("new")), File(other, half))
    assert old.read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["map.nc"]


def test_new_never_overwrites(run, tmp_path):
    (tmp_path / "my.yaml").write_text("mine")
    result = run("new", "wigley", "my.yaml")
    assert result.exit_code == 2
    assert "exists" in result.stderr
    assert (tmp_path / "my.yaml").read_text() == "mine"


def test_a_range_warning_is_one_plain_line_and_json_stays_alone_on_stdout(run):
    result = run("hull", "series60-cb60", "--json")
    assert result.exit_code == 0
    assert json.loads(result.stdout)["righting"]["gm"] == pytest.approx(qt.ship("series60-cb60").loading.gm)
    lines = result.stderr.splitlines()
    assert len(lines) == 1
    assert lines[0].startswith("note: Series 60")


def test_a_map_names_its_waves_its_estimates_and_the_ship_without_waves(run):
    words = " ".join(run("polar", "series60-cb60", *SMALL_MAP).stdout.split())
    assert "1/50" in words
    assert "Estimated: velocity derivatives" in words
    summary = json.loads(run("polar", "series60-cb60", *SMALL_MAP, "--json").stdout)
    ship = qt.ship("series60-cb60")
    assert {"Y_v", "C_D"} <= set(summary["estimated"])
    expected = calm_water_exponents(ship, summary["speeds"][0]["speed"])
    assert [z["re"] for z in summary["speeds"][0]["calm_water"]] == pytest.approx(list(expected.real))


def test_cells_without_an_answer_are_grouped_with_advice(run, tmp_path):
    (tmp_path / "tender.yaml").write_text("base: series60-cb60\nname: tender\nloading: {gm: 0.02 B}\n")
    steep = ["--speed", "0.25Fn", "--headings", "10:50:9", "--wave-lengths", "1.9L:2.3L:5", "--steepness", "1/15"]
    result = run(
        "polar",
        "tender.yaml",
        *steep,
        "--velocities",
        "absolute",
        "--drag",
        "cubic",
        "--righting",
        "polynomial",
        "-o",
        "map.nc",
    )
    with xr.open_dataset(tmp_path / "map.nc") as ds:
        unanswered = int((ds["verdict"] == int(Kind.NO_ANSWER)).sum())
    assert unanswered > 0
    assert f"{unanswered} cells without an answer" in " ".join(result.stdout.split())


MAIN = "import sys; from quartering.view.cli import main; sys.argv = ['quartering', *sys.argv[1:]]; main()"


@pytest.mark.parametrize("words", [["--help"], ["hull", "--help"], ["hul", "wigley"]], ids=" ".join)
def test_options_of_other_commands_left_unread_change_nothing(words):
    """What the script says, which reads the options of the command named alone, is what the whole application says."""
    wide = {"COLUMNS": "80", "TERMINAL_WIDTH": "80"}
    command = [sys.executable, "-c", MAIN, *words]
    alone = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, **wide})
    whole = CliRunner().invoke(app, words, prog_name="quartering", env=wide, terminal_width=78)
    assert (alone.returncode, alone.stdout + alone.stderr) == (whole.exit_code, whole.output)


def test_the_command_of_the_contributing_page_is_one_file(tmp_path, monkeypatch):
    """Authority of the angle: the Series 60's own, by Python."""
    page = (Path(__file__).parents[2] / "CONTRIBUTING.md").read_text()
    (text,) = [block for block in re.findall(r"```python\n(.*?)```", page, re.DOTALL) if "def vanishing(" in block]
    (tmp_path / "vanishing.py").write_text(text)
    monkeypatch.setattr(command, "__path__", [*command.__path__, str(tmp_path)])
    assert _names()[-1] == "vanishing"
    name = f"{command.__name__}.vanishing"
    made = typer.Typer()
    made.command()(as_command(import_module(name).vanishing))
    monkeypatch.delitem(sys.modules, name)
    words = ["series60-cb60", "--gm", "0.9", "-o", str(tmp_path / "a.csv")]
    told = CliRunner().invoke(made, words)
    angle = vanishing_angle(qt.ship("series60-cb60").with_(gm=0.9))
    assert f"vanishes at {angle:.3g} deg." in told.stdout
    assert told.stdout.endswith("Next:\n  quartering hull series60-cb60\n")
    assert (tmp_path / "a.csv").read_text() == f"angle_deg\n{angle:.6g}\n"
    assert json.loads(CliRunner().invoke(made, [*words, "--json"]).stdout)["vanishing_angle_deg"] == angle
    assert CliRunner().invoke(made, [*words[:-1], "a.txt"]).exit_code == 2
