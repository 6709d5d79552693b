"""`quartering surf-riding`: prints what the library holds, draws its diagram, and refuses in the same words."""

import json

import pytest
from typer.testing import CliRunner

import quartering as qt
from quartering.view.cli import app

WORDS = ["surf-riding", "s175", "--wave-length", "1L", "--wave-height", "6"]


def run(*words):
    return CliRunner().invoke(app, list(words))


def test_the_command_prints_the_record_and_writes_the_diagram(tmp_path):
    file = tmp_path / "diagram.svg"
    told = json.loads(run(*WORDS, "--speed", "20kn", "-o", str(file), "--json").stdout)
    found = qt.surf_riding(qt.ship("s175"), qt.Wave(175.0, 6.0), speed="20 kn")
    assert told["froude_exact"] == found.froude_exact
    assert told["kind"] == found.kind == "surf-riding from some starts"
    assert told["estimated"] is True
    assert told["sentence"] == found.sentence
    assert file.read_text().rstrip().endswith("</svg>")


def test_propulsion_typed_is_that_of_python():
    typed = "6.5,0.45,-0.28,-0.12,0.15,0.25,1,0,0,20e3"
    told = json.loads(run(*WORDS, "--propulsion", typed, "--json").stdout)
    driven = qt.Propulsion((0, 0, 20e3), 6.5, 0.15, 0.25, (0.45, -0.28, -0.12))
    assert told["froude"] == qt.surf_riding(qt.ship("s175"), qt.Wave(175.0, 6.0), driven).froude
    assert told["estimated"] is False


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (["--speed", "-1"], "--speed: speed = -1"),
        (["--propulsion", "guess"], "--propulsion: propulsion = 'guess'; it is estimated"),
        (["--wave-height", "0"], "surf-riding needs a wave"),
        (["--wave-height", "60"], "breaks"),
    ],
)
def test_nonsense_is_refused_with_exit_code_2(more, words):
    words_before = WORDS if "--wave-height" not in more else WORDS[:-2]
    answer = run(*words_before, *more)
    assert answer.exit_code == 2
    assert words in " ".join(answer.output.split())
