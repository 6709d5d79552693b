"""`quartering assess`, `long-term`, `design-point`, `lyapunov`: their JSON beside Python's numbers, files, refusals."""

import csv
import json

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

import quartering as qt
from quartering.study.seas.failure_rates.occurrence import read_table
from quartering.view.cli import app
from quartering.view.plots.assessment import assessment_picture
from quartering.view.plots.design_point import design_point_picture

pytestmark = pytest.mark.filterwarnings("ignore::quartering.conventions.RangeWarning")
SHIP = qt.ship("wigley")
SEA = ["--hs", "1", "--tp", "8", "--heading", "60", "--speed", "5"]
TABLE = xr.DataArray([[70.0, 20.0], [8.0, 2.0]], {"hs": [1.5, 2.5], "tz": [6.5, 7.5]}, ("hs", "tz"))


def answered(*arguments):
    result = CliRunner().invoke(app, [*arguments])
    assert result.exit_code == 0, result.output
    return result.stdout


@pytest.fixture
def table(tmp_path):
    file = tmp_path / "seas.csv"
    file.write_text("# of a coast\nhs,6.5,7.5\n1.5,70,20\n2.5,8,2\n")
    return str(file)


def test_growth_of_disturbances_is_that_of_python(tmp_path):
    found = json.loads(answered("lyapunov", "wigley", *SEA, "--seed", "3", "-o", str(tmp_path / "l.nc"), "--json"))
    own = qt.lyapunov(SHIP, qt.Sea(hs=1, tp=8, heading=60), 5.0, seed=3)
    for name in ("lyapunov", "lyapunov_error", "mean_square", "mean_square_error", "blocks"):
        assert found[name] == pytest.approx(float(own[name]), rel=1e-12)
    assert float(xr.load_dataset(tmp_path / "l.nc")["lyapunov"]) == found["lyapunov"]
    assert found["processor_time"] > 0
    words = " ".join(answered("lyapunov", "wigley", *SEA, "-o", str(tmp_path / "l.csv")).split())
    assert "the motion is stable" in words
    assert "95 % interval" in words
    assert (tmp_path / "l.csv").read_text().startswith("# Wigley hull")


def test_a_rare_roll_is_that_of_python(tmp_path):
    asked = ["design-point", "wigley", *SEA, "--roll", "15", "--windows", "512"]
    found = json.loads(answered(*asked, "-o", str(tmp_path / "d.nc"), "--json"))
    own = qt.design_point(SHIP, qt.Sea(hs=1, tp=8, heading=60), 5.0, roll=15, windows=512)
    for name in ("beta", "probability", "probability_error", "crossing_rate", "effective"):
        assert found[name] == pytest.approx(float(own[name]), rel=1e-12)
    stored = xr.load_dataset(tmp_path / "d.nc")
    np.testing.assert_array_equal(stored["roll"], own["roll"])
    line = design_point_picture(stored).axes[0].lines[0]
    assert line.get_ydata()[-1] == pytest.approx(15.0, rel=0.01)  # the window ends at the roll
    answered(*asked, "-o", str(tmp_path / "d.csv"))
    rows = [row for row in csv.reader((tmp_path / "d.csv").read_text().splitlines()) if not row[0].startswith("#")]
    assert rows[0] == ["time [s]", "roll [deg]"]
    np.testing.assert_allclose([float(row[1]) for row in rows[1:]], own["roll"], rtol=1e-9)


def test_failures_over_all_seas_of_a_map_are_those_of_python(tmp_path, table):
    found = qt.guidance(SHIP, [1.5, 2.5], tz=[6.5, 7.5], speed=4.0, heading=[30, 90, 150], spreading="cos2")
    found.to_netcdf(tmp_path / "g.nc")
    told = json.loads(answered("long-term", str(tmp_path / "g.nc"), "--seas", table, "--json"))
    own = qt.long_term(found, TABLE)
    for name in ("failure_rate", "rate_upper", "failures_a_year", "not_covered"):
        np.testing.assert_allclose(told[name], own[name].values, rtol=1e-12)
    answered("long-term", str(tmp_path / "g.nc"), "--seas", table, "-o", str(tmp_path / "life.csv"))
    assert "contribution" in (tmp_path / "life.csv").read_text()


def test_a_direct_assessment_is_that_of_python(tmp_path, table):
    asked = [
        "assess",
        "wigley",
        "--gm",
        "1.0",
        "--openings",
        "10",
        "--speed",
        "4",
        "--headings",
        "60,120",
        "--hours",
        "32",
    ]
    asked += ["--seas", table, "--spreading", "none", "--seed", "1"]
    told = json.loads(answered(*asked, "-o", str(tmp_path / "a.csv"), "--json"))
    ship = SHIP.with_(gm=1.0, openings="10 deg")
    own = qt.direct_assessment(ship, 4.0, [60, 120], TABLE, hours=32, spreading=None, seed=1)
    for name in ("long_term_rate", "long_term_lower", "long_term_upper", "failure_rate", "contribution", "status"):
        np.testing.assert_allclose(np.array(told[name], dtype=float), own[name].values, rtol=1e-12)
    assert sum(told["cells"].values()) == 8
    text = (tmp_path / "a.csv").read_text()
    assert "counted" in text or "budget_spent" in text
    assert "seed: 1" in text
    made = assessment_picture(own)
    bars = made.axes[1].patches
    np.testing.assert_allclose([bar.get_height() for bar in bars], own["contribution"].sum(("hs", "tz", "speed"))[0])
    words = " ".join(" ".join(text.get_text() for text in made.texts).split())
    assert "seed 1" in words
    assert "No compliance with any rule is shown" in words


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        (["lyapunov", "wigley", *SEA, "--hours", "0"], "--hours: hours = 0"),
        (["lyapunov", "wigley", *SEA, "-o", "x.png"], "its name must end in .nc or .csv or .xlsx"),
        (["lyapunov", "wigley", *SEA, "--spectrum", "foo"], "spectrum = 'foo'; allowed: jonswap"),
        (
            ["design-point", "wigley", *SEA, "--roll", "95"],
            "--roll: roll = 95 deg; it is above 0 deg and at most 90 deg",
        ),
        (
            ["design-point", "wigley", *SEA, "--roll", "10", "--windows", "5"],
            "windows = 5; it is a whole number from 64 to",
        ),
        (["long-term", "nowhere.nc"], 'there is no "nowhere.nc"'),
        (["assess", "wigley", "--speed", "4", "--precision", "0"], "--precision: precision = 0; it is above 0"),
        (["assess", "wigley", "--speed", "4", "--share", "0.9"], "--share: share = 0.9; it is from 0 to 0.5"),
        (["assess", "wigley", "--speed", "4", "--seas", "nowhere.csv"], '"nowhere.csv" cannot be read'),
        (["assess", "wigley", "--speed", "4", "--spectrum", "torsethaugen"], "tz of a spectrum of two peaks"),
    ],
)
def test_what_cannot_be_is_refused(asked, words):
    result = CliRunner().invoke(app, asked)
    assert result.exit_code == 2
    assert words in result.output.replace("\n", " ")


@pytest.mark.parametrize("text", ["", "hs,6\n", "hs,6\n1,2,3\n", "hs,6\n1,a\n"])
def test_what_is_no_table_of_seas_is_refused(tmp_path, text):
    file = tmp_path / "seas.csv"
    file.write_text(text)
    with pytest.raises(qt.InputError, match="is no table of seas"):
        read_table(file)
