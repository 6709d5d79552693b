"""What makes the documentation's pages: every equation of the theory is claimed by code, and code claims no other."""

import doctest
import importlib
import sys
from functools import cache
from pathlib import Path

import pytest

pytestmark = pytest.mark.quick

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "src" / "quartering"
STEPS = {"A-6", "A-7", "A-9"}
"""Steps of the derivation that the theory pages tell in words: they lie within ranges that docstrings name."""


@pytest.fixture(scope="module", autouse=True)
def extensions():
    sys.path.insert(0, str(ROOT / "docs" / "_extensions"))
    yield
    sys.path.remove(str(ROOT / "docs" / "_extensions"))


@cache
def claims_of_code():
    from paper_code import claims

    return list(claims(PACKAGE))


def claimed() -> set[str]:
    return {claim.place for claim in claims_of_code()}


def printed() -> dict[str, str]:
    from generated_pages import theory_sections

    return theory_sections(ROOT / "docs" / "theory")


def test_every_equation_of_the_theory_is_claimed_by_code():
    assert set(printed()) - claimed() == set()


def test_every_equation_that_code_claims_stands_in_the_theory():
    numbers = {place for place in claimed() if place[-1].isdigit() and not place.startswith("Fig")}
    assert numbers - set(printed()) - STEPS == set()


def test_the_main_results_are_found_where_they_are_implemented():
    where = {(claim.place, f"{claim.module}.{claim.name}") for claim in claims_of_code()}
    for place, name in (
        ("A-11", "motion.steady.struble.modified_struble"),
        ("13", "stability.first_order.first_order"),
        ("8", "stability.variational.floquet.floquet"),
        ("B-4", "loads.strips.froude_krylov.froude_krylov"),
        ("C-5", "study.paper.duffing_formulas.duffing_amplitudes"),
    ):
        assert (place, f"quartering.{name}") in where


def test_no_equation_is_printed_twice():
    from equations import tags

    found = [tag for page in sorted((ROOT / "docs" / "theory").glob("*.md")) for tag in tags(page.read_text())]
    assert len(found) == len(set(found))


def test_every_command_and_option_is_on_its_page():
    import typer.main
    from command_pages import page

    from quartering.view.cli import app

    text = page()
    for name, command in typer.main.get_command(app).commands.items():
        assert f"\n{name}\n{'-' * len(name)}\n" in text
        for parameter in command.params:
            assert parameter.param_type_name == "argument" or parameter.opts[-1] in text


def test_every_public_name_is_in_the_reference():
    from room_pages import pages

    import quartering

    made = pages(PACKAGE)
    for name in quartering.__all__:
        home = "stability.verdict" if name == "stability" else quartering._HOMES[name]
        assert f"`qt.{name} <" in made["python.rst"]
        page = f"{home.split('.')[0]}.rst" if "." in home else "beside.rst"
        assert f".. automodule:: quartering.{home}\n" in made[page]


def test_symbols_table_is_the_generated_one():
    from symbols import renewed

    text = (ROOT / "docs" / "conventions.md").read_text()
    assert renewed(text) == text


@pytest.mark.parametrize(
    "name",
    [
        "aligned_docstrings",
        "command_pages",
        "equations",
        "gallery_sources",
        "page_examples",
        "paper_code",
        "room_pages",
    ],
)
def test_examples_of_the_page_makers(name):
    failed, tried = doctest.testmod(importlib.import_module(name))
    assert failed == 0
    assert tried or name == "room_pages"


def test_every_example_gets_a_title_and_still_compiles():
    from gallery_sources import titled

    for script in sorted((ROOT / "examples").glob("plot_*.py")):
        made = titled(script.read_text())
        lines = made.removeprefix('"""').strip().splitlines()
        assert set(lines[1]) == {"="}
        assert len(lines[1]) == len(lines[0])
        compile(made, script.name, "exec")
