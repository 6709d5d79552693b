"""`quartering new --offsets`, and that every file of the page *Your own ship* runs."""

import re
from pathlib import Path

import pytest
from typer.testing import CliRunner

import quartering as qt
from quartering.view.cli import app
from quartering.view.explorer.hulls.uploads import Sizes, hull_of_upload
from tests.tiers import mostly_soak

PAGE = (Path(__file__).parents[2] / "docs" / "your_own_ship.md").read_text(encoding="utf-8")
FILES = re.findall(r"```text\n(.*?)```", PAGE, re.DOTALL)
PAIRS = list(zip(FILES, ["barge.csv", "points.csv", "geomet.out"], strict=True))


def run(*words):
    return CliRunner().invoke(app, ["new", *words])


@pytest.mark.parametrize(("text", "name"), mostly_soak(PAIRS, PAIRS[0], several=True))
def test_every_file_of_the_page_runs(tmp_path, monkeypatch, text, name):
    """Authority: closed form of the prism, 80 12 3 m3; of the table the trapezium at most."""
    monkeypatch.chdir(tmp_path)
    Path(name).write_text(text)
    result = run("--offsets", name, "my.yaml", "--draught", "3")
    assert result.exit_code == 0, result.output
    assert "datum: keel" in result.output
    assert (tmp_path / "my.png").stat().st_size > 5_000
    volume = qt.hydrostatics(qt.ship("my.yaml")).volume
    assert 0.6 * 2880 < volume < 2880 if name == "barge.csv" else volume == pytest.approx(2880.0)


def test_a_draught_that_is_missing_is_asked_for_and_nothing_is_left(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("a.csv").write_text(FILES[0])
    result = run("--offsets", "a.csv")
    assert (result.exit_code, [path.name for path in tmp_path.iterdir()]) == (2, ["a.csv"])
    assert "--draught" in result.stderr


def test_lines_from_the_calm_water_have_their_own_draught(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("a.csv").write_text("x,-3,2\n-40,6,6\n40,6,6")
    result = run("--offsets", "a.csv", "--json")
    assert result.exit_code == 0, result.output
    assert qt.ship("a.yaml").value("datum") == "waterline"
    assert qt.hydrostatics(qt.ship("a.yaml")).volume == pytest.approx(2880.0)


def test_new_without_a_ship_says_what_to_give(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert "--offsets" in run().stderr


@pytest.mark.parametrize("words", [("mine.csv",), ("mine.csv", "mine.yaml"), ("--case", "mine.csv", "case.yaml")])
def test_lines_in_the_place_of_a_built_in_ship_are_refused_with_the_command_that_takes_them(
    tmp_path, monkeypatch, words
):
    monkeypatch.chdir(tmp_path)
    Path("mine.csv").write_text(FILES[0])
    refused = run(*words)
    assert (refused.exit_code, [path.name for path in tmp_path.iterdir()]) == (2, ["mine.csv"])
    hinted = re.search(r"`quartering new (.*?)`", " ".join(refused.stderr.split())).group(1).split()
    assert hinted == ["--offsets", "mine.csv"]
    assert run(*hinted, "--draught", "3").exit_code == 0


def test_a_name_that_is_neither_ship_nor_file_is_told_the_built_in_ships(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert "wigley" in run("mine.csv", "mine.yaml").stderr


FLARED = "x,0,3,6\n-40,2,4,6\n40,2,4,6"


def test_a_flared_hull_has_its_beam_at_the_waterline(tmp_path, monkeypatch):
    """Authority: closed form of the trapezium, 8 m broad at the draught and 12 m at the deck, 80 (4 + 8) / 2 3 m3."""
    monkeypatch.chdir(tmp_path)
    Path("a.csv").write_text(FLARED)
    result = run("--offsets", "a.csv", "--draught", "3", "--json")
    assert result.exit_code == 0, result.output
    uploaded = hull_of_upload("a.csv", FLARED.encode(), Sizes(draught=3.0)).ship
    for ship in (qt.ship("a.yaml"), uploaded):
        assert ship.hull.beam == pytest.approx(8.0)
        assert qt.hydrostatics(ship).volume == pytest.approx(1440.0)


def test_the_beam_of_a_flared_deck_is_refused_with_what_to_give(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("a.csv").write_text(FLARED)
    refused = run("--offsets", "a.csv", "--draught", "3", "--beam", "12 m")
    assert (refused.exit_code, [path.name for path in tmp_path.iterdir()]) == (2, ["a.csv"])
    assert "--beam" in refused.stderr


def test_lines_in_millimetres_keep_their_unit(tmp_path, monkeypatch):
    """Authority: closed form of the prism, 80 12 3 m3."""
    monkeypatch.chdir(tmp_path)
    Path("a.csv").write_text("x,0,5000\n-40000,6000,6000\n40000,6000,6000")
    assert "over 80000 m" in (refused := run("--offsets", "a.csv", "--draught", "3 m").stderr)
    assert "say the unit of its numbers" in refused
    result = run("--offsets", "a.csv", "--draught", "3 m", "--unit", "mm")
    assert result.exit_code == 0, result.output
    assert qt.hydrostatics(qt.ship("a.yaml")).volume == pytest.approx(2880.0)
