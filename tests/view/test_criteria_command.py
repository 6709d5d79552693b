"""`quartering criteria`: what it prints is what `qt.criteria` holds, and what was not judged is said."""

import json

import pytest
from typer.testing import CliRunner

import quartering as qt
from quartering.view.cli import app


def run(*words):
    return CliRunner().invoke(app, list(words))


def test_the_command_prints_the_numbers_of_the_library():
    result = run("criteria", "s175", "--speed", "0.275Fn", "--json")
    told = json.loads(result.stdout)
    found = qt.criteria(qt.ship("s175"), speed="0.275 Fn")
    numbers = {(j["mode"], j["level"]): j["quantities"] for j in told["judgements"]}
    assert numbers["pure_loss", 1]["gm_min_waves"]["value"] == pytest.approx(
        found.value("pure_loss.level1.gm_min_waves"), rel=1e-12
    )
    assert (
        len(next(j["cases"] for j in told["judgements"] if j["mode"] == "parametric_rolling" and j["level"] == 2)) == 16
    )
    assert all(one["status"] for one in told["constants"])


def test_what_a_mode_lacks_is_named():
    shown = " ".join(run("criteria", "box").stdout.split())
    assert "needs windage" in shown
    assert "needs highest_position" in shown
    assert "It shows no compliance." in shown
