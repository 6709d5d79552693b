"""`quartering parametric`: the numbers are those of Python, the map is drawn, bad input is one message."""

import json

import pytest
from typer.testing import CliRunner

import quartering as qt
from quartering.view.cli import app

WORDS = ["parametric", "dtc", "--wave-length", "1L", "--wave-height", "5", "--speed", "5"]


@pytest.mark.soak
def test_a_map_is_drawn_beside_the_record(tmp_path):
    picture = tmp_path / "map.png"
    ended = CliRunner().invoke(app, [*WORDS, "-o", str(picture)])
    assert ended.exit_code == 0, ended.output
    assert picture.stat().st_size > 10_000


def test_the_record_is_that_of_python():
    ended = CliRunner().invoke(app, [*WORDS, "--json"])
    assert ended.exit_code == 0, ended.output
    told = json.loads(ended.stdout)
    found = qt.parametric_roll(qt.ship("dtc"), qt.Wave(355.0, 5.0), 5.0)
    assert told["sentence"] == found.sentence
    assert told["amplitude"] == pytest.approx(list(found.amplitude))
    assert (told["kind"], told["status"]) == ("parametric", "CONVERGED")
    shown = CliRunner().invoke(app, WORDS)
    assert "parametric roll, tenfold in" in " ".join(shown.stdout.split())


def test_what_cannot_be_asked_is_one_message(tmp_path):
    for words, said in (
        (["--heading", "x"], "--heading"),
        (["--heading", "30", "-o", str(tmp_path / "map.png")], "try 180"),
    ):
        ended = CliRunner().invoke(app, [*WORDS, *words])
        assert ended.exit_code == 2
        assert said in " ".join(ended.stderr.split())


def test_a_map_holds_what_the_record_of_one_wave_says():
    """Same amplitude, growth and margin in a cell and in the record; heights that do not rise are refused."""
    ship = qt.ship("dtc")
    ds = qt.parametric_map(ship, 355.0, [3.0, 5.0], [5.0])
    found = qt.parametric_roll(ship, qt.Wave(355.0, 5.0), 5.0)
    cell = ds.isel(speed=0, wave_height=1)
    assert float(cell.roll_settled) == pytest.approx(found.amplitude[0], rel=1e-6)
    assert float(cell.growth) == pytest.approx(found.growth, rel=1e-6)
    assert float(cell.margin) == pytest.approx(found.margin, rel=1e-6)
    with pytest.raises(qt.InputError, match="they are above 0 and rise"):
        qt.parametric_map(ship, 355.0, [5.0, 3.0], [5.0])
