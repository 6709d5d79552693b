"""`quartering broaching`: prints what the library holds, draws its branch, and refuses in the same words."""

import json

import pytest
from typer.testing import CliRunner

import quartering as qt
from quartering.view.cli import app

WORDS = ["broaching", "fishing-30m", "--wave-length", "1L", "--wave-height", "1.5", "--speed", "0.38Fn"]


def run(*words):
    return CliRunner().invoke(app, list(words))


def test_the_command_prints_the_record_and_draws_the_branch(tmp_path):
    file = tmp_path / "branch.svg"
    told = json.loads(run(*WORDS, "--autopilot", "1,10s", "-o", str(file), "--json").stdout)
    found = qt.broaching(qt.ship("fishing-30m").with_(autopilot="1,10s"), qt.Wave(30.0, 1.5), "0.38 Fn")
    assert told["critical_gain"] == found.critical_gain
    assert (told["kind"], told["sentence"]) == (found.kind, found.sentence)
    assert len(told["eigenvalues"]) == 7
    assert file.read_text().rstrip().endswith("</svg>")


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (["--heading", "20"], "without an autopilot no heading is held"),
        (["-o", "x.png"], "takes an autopilot; try --autopilot 1,10s"),
        (["--heading", "90", "--autopilot", "1"], "from 0 (following) to 60 deg"),
    ],
)
def test_nonsense_is_refused_with_exit_code_2(more, words):
    answer = run(*WORDS, *more)
    assert answer.exit_code == 2
    assert words in " ".join(answer.output.split())
