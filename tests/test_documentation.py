"""Documentation that cannot drift: links, the symbols table, Python and commands of the pages, and numbers in two tables."""

import doctest
import re
import shlex
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

import quartering as qt
from quartering.conventions import SYMBOLS
from quartering.study.paper.model import paper_ship

ROOT = Path(__file__).parents[1]
MADE = {"reference", "gallery"}
PAGES = [
    ROOT / "README.md",
    *(page for page in sorted((ROOT / "docs").rglob("*.md")) if page.relative_to(ROOT / "docs").parts[0] not in MADE),
]
sys.path.append(str(ROOT / "docs" / "_extensions"))
import page_examples  # noqa: E402


def blocks(page: Path, language: str) -> list[str]:
    return page_examples.blocks(page.read_text(), language)


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.name)
def test_every_relative_link_leads_somewhere(page):
    links = re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text())
    missing = [link for link in links if not (page.parent / link).exists()]
    assert missing == []


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.name)
def test_every_test_and_script_a_page_names_is_there(page):
    named = re.findall(r"`((?:tests|benchmarks|examples)/[\w/]+\.py)`", page.read_text())
    assert [name for name in named if not (ROOT / name).exists()] == []


def test_every_page_is_linked_from_the_readme_or_another_page():
    linked = {
        (page.parent / link).resolve()
        for page in PAGES
        for link in re.findall(r"\]\(([^)#:]+\.md)\)", page.read_text())
    }
    assert [page.name for page in PAGES[1:] if page.resolve() not in linked] == []


def test_pictures_of_the_pages_stay_small():
    sizes = {picture.name: picture.stat().st_size for picture in (ROOT / "docs" / "images").glob("*.png")}
    assert sizes
    assert max(sizes.values()) < 300_000


def test_symbols_table_is_that_of_the_code():
    """`python docs/_extensions/symbols.py` writes it."""
    text = (ROOT / "docs" / "conventions.md").read_text()
    assert text.endswith("meaning |\n|---|---|---|---|\n" + "".join(text.splitlines(keepends=True)[-len(SYMBOLS) :]))
    for name, symbol in SYMBOLS.items():
        letter = symbol.symbol.replace("|", "&#124;")
        unit = "-" if symbol.unit == "1" else symbol.unit
        assert f"| `{name}` | {letter} | {unit} | {symbol.meaning} |" in text


def test_python_of_the_readme_runs(capsys):
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
    assert blocks
    for block in blocks:
        exec(block, {})
    assert "stable" in capsys.readouterr().out


@pytest.mark.parametrize("page", [page for page in PAGES if blocks(page, "pycon")], ids=lambda p: p.name)
def test_python_of_the_pages_gives_what_they_show(page):
    count, wrong = page_examples.tried(page.read_text(), page.name)
    assert count
    assert not wrong, wrong


def test_every_guide_page_has_python_that_runs():
    guides = [page for page in PAGES if page.parent.name == "guide"]
    assert len(guides) == 7  # the rooms
    assert [page.name for page in guides if not blocks(page, "pycon")] == []


@pytest.mark.parametrize("page", [page for page in PAGES if blocks(page, "console")], ids=lambda p: p.name)
def test_commands_of_the_pages_print_what_they_show(page, tmp_path, monkeypatch):
    from typer.testing import CliRunner

    from quartering.view.cli import app

    for named in re.findall(r"`(tests/data/[\w.]+)`", page.read_text()):  # the files its sessions work on
        shutil.copy(ROOT / named, tmp_path)
    monkeypatch.chdir(tmp_path)
    for session in blocks(page, "console"):
        for command, shown in re.findall(r"^\$ quartering (.*)\n((?:(?!\$ ).*\n)*)", session, re.MULTILINE):
            ended = CliRunner().invoke(app, shlex.split(command))
            printed = ended.stdout or ended.stderr  # a note on stderr is not part of what is shown
            want = re.sub(r"\s+", " ", shown)
            assert doctest.OutputChecker().check_output(want, re.sub(r"\s+", " ", printed), page_examples.LENIENT), (
                printed
            )


def test_commands_of_the_readme_exist():
    from quartering.view.cli import app

    names = {(command.name or command.callback.__name__).replace("_", "-") for command in app.registered_commands}
    used = set(re.findall(r"^quartering ([\w-]+)", (ROOT / "README.md").read_text(), re.MULTILINE))
    assert used
    assert used <= names


def test_roll_peaks_page_quotes_the_numbers_the_library_gives():
    """The lambda = L row of docs/two_roll_peaks.md, recomputed for a very small wave (the page's numbers are linear)."""
    row = re.search(r"lambda = L, roll/kA \| (.*) \|", (ROOT / "docs" / "two_roll_peaks.md").read_text())
    quoted = [float(x) for x in row[1].split("|")]
    ship = paper_ship()
    length = ship.hull.length
    wave = qt.Wave(length, length / 20_000)
    ds = qt.polar(ship, wave, [0.25 * np.sqrt(9.81 * length)], np.arange(30.0, 131.0, 10.0))
    slope = np.degrees(wave.wavenumber * wave.amplitude)
    np.testing.assert_allclose(ds["roll"].squeeze() / slope, quoted, rtol=0.02)


def test_three_verdicts_page_quotes_the_numbers_the_library_gives():
    text = (ROOT / "docs" / "do_the_verdicts_agree.md").read_text()
    ship = paper_ship()
    length = ship.hull.length
    for factor, row in ((1.0, "K_prr as estimated"), (-60.0, "K_prr x -60")):
        quoted = re.search(rf"\| {re.escape(row)} \| ([-+.\d]+) \| ([-+.\d]+)", text)
        wave, speed = qt.Wave(length, length / 30), 0.25 * np.sqrt(9.81 * length)
        model = qt.equations(ship.with_(factors={"K_prr": factor}), wave, speed, 30.0)
        verdict = qt.stability(model, qt.steady_motion(model, 9, start="rest"))
        pair = verdict.exponents[np.abs(verdict.exponents.imag) > 1e-6][0].real
        assert float(quoted[1]) == pytest.approx(-verdict.index, abs=6e-5)
        assert float(quoted[2]) == pytest.approx(pair, abs=6e-5)
