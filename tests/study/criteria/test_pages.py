"""Pages of ships under the five failure modes are what the library gives: first levels here, whole ones before a release."""

import importlib.util
from pathlib import Path

import pytest

import quartering as qt
from quartering.hull.told import number
from quartering.study.criteria import dead_ship, excessive_acceleration, parametric_rolling, pure_loss, surf_riding
from quartering.study.criteria.particulars import particulars
from tests.tiers import mostly_soak

ROOT = Path(__file__).parents[3]
SHIPS = ("fishing-30m", "coaster-90m", "dtc", "s175", "dtmb5415")


def tool():
    spec = importlib.util.spec_from_file_location("write_criteria_pages", ROOT / "tools" / "write_criteria_pages.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def text_of(name):
    return (ROOT / "docs" / "criteria" / f"{name}.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", mostly_soak(SHIPS, "coaster-90m"))
def test_the_first_levels_of_a_page_are_those_of_the_library(name):
    """And the second levels that rest on sums alone."""
    made = tool()
    ship = qt.ship(name).with_(**made.options(made.CASES[name]))
    p = particulars(ship, number(ship, "speed", made.CASES[name].speed), None)
    quick = [one.level1(p) for one in (parametric_rolling, pure_loss, surf_riding, dead_ship, excessive_acceleration)]
    quick.append(surf_riding.level2(p, None))
    for judgement in quick:
        assert judgement.vulnerable is not None
        assert made._row(judgement) in text_of(name)


@pytest.mark.soak
@pytest.mark.parametrize("name", SHIPS)
def test_a_whole_page_is_that_of_the_library(name):
    assert tool().page(name) == text_of(name)


def test_every_page_has_all_five_modes_at_both_levels_and_says_what_it_is():
    for name in SHIPS:
        text = text_of(name)
        assert text.count("| 1 |") == text.count("| 2 |") == 5
        assert "not judged" not in text
        assert "it shows no compliance" in text
        assert "Assumed for this page" in text
        assert f"quartering criteria {name}" in text
