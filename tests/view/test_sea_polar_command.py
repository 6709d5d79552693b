"""`quartering polar --hs`: its JSON and dataset beside Python's numbers, its picture, what it refuses, stored results."""

import json

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

import quartering as qt
from quartering.view.cli import app
from quartering.view.plots.sea_polar import sea_polar

pytestmark = pytest.mark.filterwarnings("ignore:.* steep.*doubtful:quartering.conventions.RangeWarning")
SEAS = ["polar", "wigley", "--hs", "1:2:2", "--tp", "8", "--speed", "2,4,6", "--headings", "0:180:7"]


def test_a_map_over_seas_is_that_of_python(tmp_path):
    result = CliRunner().invoke(app, [*SEAS, "-o", str(tmp_path / "g.nc"), "--json"])
    assert result.exit_code == 0, result.output
    found = json.loads(result.stdout)
    own = qt.guidance(qt.ship("wigley"), [1, 2], 8, speed=[2, 4, 6], heading=np.linspace(0, 180, 7))
    np.testing.assert_allclose(found["roll_mean_3h_max"], own["roll_mean_3h_max"].values, rtol=1e-12)
    stored = xr.load_dataset(tmp_path / "g.nc")
    assert stored["recommended"].dims == ("loading", "hs", "tz", "speed", "heading")
    np.testing.assert_array_equal(stored["recommended"], own["recommended"])
    assert "unverified" in stored.attrs["threshold_source"]
    assert sum(found["conditions"].values()) == 42
    assert (tmp_path / "g.png").stat().st_size > 10_000


def test_the_picture_has_the_danger_lines_and_the_advice():
    """Lines at right angles to the way of the ship; a panel for each sea."""
    ds = qt.guidance(
        qt.ship("series60-cb60"), [3, 6], [9, 12], speed=np.linspace(0, 8, 5), heading=np.arange(0, 181, 30)
    )
    made = sea_polar(ds)
    panels = [ax for ax in made.axes if ax.name == "polar"]
    assert len(panels) == 4
    lines = {line.get_gid(): line for line in panels[0].lines}
    for name, speed in zip(ds["line"].values, ds["pile_up"].values, strict=True):
        theta, r = lines[name].get_data()
        np.testing.assert_allclose(r * np.cos(theta), speed, rtol=1e-9)
    marks = {one.get_gid() for ax in panels for one in ax.collections}
    assert {"not recommended", "undecided"} <= marks
    words = " ".join(" ".join(text.get_text() for text in made.texts).split())
    assert "recalled, unverified" in words


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (["--wave-height", "2"], "--wave-height is of regular waves and --hs of irregular seas"),
        (["--tz", "7"], "tp and tz are both given"),
        (["--judge", "foo"], "judge = 'foo'; allowed: largest"),
        (["--threshold", "0"], "--threshold: threshold = 0; it is from 1 to 10"),
        (["--spectrum", "tors"], "spectrum = 'tors'; allowed in maps: jonswap"),
        (["--swell", "2,14"], "--swell: swell = '2,14'; it is height, period of its peak, angle off the sea"),
        (["--swell", "2,90,30"], "--swell: tp = 90"),
        (["--hours", "-3"], "--hours: hours = -3"),
        (["--spreading", "wide"], "--spreading: spreading = 'wide'"),
    ],
)
def test_what_cannot_be_is_refused(more, words):
    result = CliRunner().invoke(app, [*SEAS, *more])
    assert result.exit_code == 2
    assert words in result.output.replace("\n", " ")


def test_a_period_without_a_height_is_refused():
    result = CliRunner().invoke(app, ["polar", "wigley", "--tp", "8"])
    assert result.exit_code == 2
    assert "give --hs too" in result.output


def test_a_case_with_seas_is_swept_and_shown(tmp_path):
    case, folder = tmp_path / "my.yaml", tmp_path / "result"
    case.write_text("ship: wigley\nspeed: 4\nheading: 0..180 deg step 60\nsea:\n  hs: [1, 2]\n  tp: 8\n")
    run = CliRunner().invoke(app, ["sweep", str(case), "-o", str(folder), "--json"])
    assert run.exit_code == 0, run.output
    swept = json.loads(run.stdout)
    shown = CliRunner().invoke(app, ["show", str(folder), "--at", "hs=1.9", "--csv", str(tmp_path / "s.csv"), "--json"])
    assert shown.exit_code == 0, shown.output
    assert json.loads(shown.stdout)["roll_mean_3h_max"][0][0] == swept["roll_mean_3h_max"][0][1]
    assert len((tmp_path / "s.csv").read_text().splitlines()) == 1 + 4
    refused = CliRunner().invoke(app, ["worst", str(folder)])
    assert refused.exit_code == 2
    assert "take `quartering show`" in refused.output.replace("\n", " ")


def test_a_map_over_seas_is_reported(tmp_path):
    """The page holds the numbers of the map, its threshold with its status, and the diagrams."""
    data = tmp_path / "g.nc"
    ds = qt.guidance(qt.ship("wigley"), [1, 2], 8, speed=[2, 4], heading=[0, 60, 120, 180], spreading=8)
    ds.to_netcdf(data)
    result = CliRunner().invoke(app, ["report", str(data), "-o", str(tmp_path / "g.html")])
    assert result.exit_code == 0, result.output
    page = (tmp_path / "g.html").read_text()
    for i in range(2):
        assert f"{float(ds['roll_mean_3h_max'][0, i].max()):.3g}</td>" in page
    assert "recalled, unverified" in page
    assert "<svg" in page
    assert "spreading s 8" in page
    assert "Regular waves" not in page
