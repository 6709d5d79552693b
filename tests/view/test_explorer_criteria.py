"""The criteria in the explorer: tab and service give the judgements of the library, say what is not judged, claim nothing."""

import re

import pytest

import quartering as qt
from quartering.view.criteria_words import criteria_facts
from tests.view.pages import filled, link, serious
from tests.view.service import ask

pytest.importorskip("nicegui", reason="the explorer needs the extra `app`")

CALL = {"ship": "coaster-90m", "speed": "12kn"}
SPEED = 12 * 1852 / 3600
PAGE = f"ship=coaster-90m&speed={SPEED}&panel=criteria"
ROWS = "document.querySelectorAll('.panel table:not(.told).judges tr').length === {} + 1"


def judgements(told):
    return {(one["mode"], one["level"]): (one["verdict"], one["reason"]) for one in told["judgements"]}


def test_the_criteria_are_those_of_the_library(explorer):
    status, served = ask(explorer, "/api/criteria", CALL)
    own = criteria_facts(qt.criteria(qt.ship("coaster-90m"), "12 kn"))
    assert status == 200
    assert judgements(served) == judgements(own)
    assert served["sentence"] == own["sentence"]
    assert len(served["constants"]) == len(own["constants"])
    assert "Prepared in the form of MSC.1/Circ.1627" in served["form"]
    first = ask(explorer, "/api/criteria", CALL | {"levels": 1})[1]
    assert judgements(first) == {key: one for key, one in judgements(own).items() if key[1] == 1}
    assert first["sentence"] is None
    assert ask(explorer, "/api/criteria", query=CALL)[0] == 405


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (CALL | {"speed": -1}, "speed = -1 m/s"),
        (CALL | {"speed": "12 furlongs"}, "furlongs"),
        (CALL | {"gm": 0}, "above 0 m"),
        (CALL | {"levels": 3}, "levels"),
        (CALL | {"level": 1}, "did you mean levels"),
        (CALL | {"ship": "nowhere.yaml"}, "unknown"),
        ({"speed": 5}, "ship: is missing"),
        (b"\x00", "JSON"),
    ],
)
def test_criteria_that_cannot_be_asked_are_refused_with_the_reason(explorer, content, reason):
    status, answer = ask(explorer, "/api/criteria", content)
    assert status == 422
    assert re.search(re.escape(reason), answer["error"]), answer["error"]


def test_the_tab_has_level_one_at_once_and_level_two_by_a_button(visit):
    """By keyboard; another GM takes level 2 away; what is missing is said; nothing complies."""
    page = visit(PAGE)
    page.wait_for_function(ROWS.format(5))
    found = qt.criteria(qt.ship("coaster-90m"), SPEED)
    shown = " ".join(page.inner_text(".panel").split())
    assert found.of("parametric_rolling", 1).reason in shown
    assert "Prepared in the form of MSC.1/Circ.1627, whose constants are recalled" in shown
    assert "complies" not in shown
    page.get_by_role("button", name="Judge level 2").focus()
    page.keyboard.press("Enter")
    page.wait_for_function(ROWS.format(10))
    page.wait_for_function("!document.querySelector('.panel').innerText.includes('level 2:')")
    shown = " ".join(page.inner_text(".panel").split())
    for mode in ("pure_loss", "surf_riding", "dead_ship"):
        assert found.of(mode, 2).reason in shown
    page.get_by_text("Constants, with place and status").focus()
    page.keyboard.press("Enter")
    assert "recalled" in page.inner_text(".panel details[open]")
    filled(page)
    page.locator("#number-heading").fill("75")
    page.wait_for_function("location.search.includes('heading=75')")
    assert page.evaluate(ROWS.format(10))  # the heading is nothing to the criteria
    gm = float(page.input_value("#number-gm"))
    page.locator("#number-gm").fill(f"{0.9 * gm:.3g}")
    page.wait_for_function(ROWS.format(5))
    assert link(page)["panel"] == "criteria"
    assert serious(page) == []
    assert page.wrong == page.elsewhere == []


@pytest.mark.soak
def test_the_criteria_on_a_phone_in_the_dark_say_what_is_missing(visit):
    page = visit("ship=series60-cb60&panel=criteria&mode=sea", width=390, height=844, scheme="dark")
    page.wait_for_function(ROWS.format(5))
    assert "needs windage" in page.inner_text(".panel")
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    assert serious(page) == []
    assert page.wrong == []
