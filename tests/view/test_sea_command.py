"""`quartering sea`: its table, its JSON beside Python's numbers, and what it refuses."""

import json

import pytest
from typer.testing import CliRunner

import quartering as qt
from quartering.view.cli import app

SEA = ["sea", "wigley", "--hs", "2", "--tp", "8", "--heading", "60", "--speed", "10kn", "--spreading", "10"]


def test_one_sea_by_every_method():
    result = CliRunner().invoke(app, [*SEA, "--json"])
    assert result.exit_code == 0, result.output
    found = json.loads(result.output)
    sea = qt.Sea(hs=2, tp=8, heading=60, spreading=10)
    for method, answer in found["methods"].items():
        own = qt.sea_response(qt.ship("wigley"), sea, "10kn", method=method)
        assert answer["roll_rms"] == pytest.approx(float(own["roll_rms"]), rel=1e-12)
        assert answer["status"] == "answered"
    text = CliRunner().invoke(app, [*SEA, "--hours", "0"]).output
    for words in ("linear response", "statistical linearisation", "processor time", "Danger line whatever the period"):
        assert words in text


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"--hs": "0"}, "--hs: hs = 0 m; it is above 0 m"),
        ({"--tp": None}, "tp and tz are missing"),
        ({"--hs": "12"}, "above 0.1 it breaks"),
        ({"--spreading": "wide"}, "--spreading: spreading = 'wide'"),
        ({"--heading": "400"}, "heading = 400 deg"),
        ({"--tp": "3 m"}, 'unit "m"'),
    ],
)
def test_a_sea_that_cannot_be_is_refused(changed, words):
    given = dict(zip(SEA[2::2], SEA[3::2], strict=True)) | changed
    arguments = [part for name, text in given.items() if text is not None for part in (name, text)]
    result = CliRunner().invoke(app, ["sea", "wigley", *arguments])
    assert result.exit_code == 2
    assert words in result.output.replace("\n", " ")
