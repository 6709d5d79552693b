"""The buttons of the explorer, pressed in a real browser: copy link, stop, light or dark, roll damping."""

import json
import re
import urllib.request

import pytest

import quartering as qt
from tests.view.pages import STABLE, filled, link, sentence, slider

HARD = (
    "ship=dtmb5415&speed=11.2&heading=50&wave_length=242&steepness=0.125&harmonics=9&gm=0.3"
    "&bilge_keel_length=36&bilge_keel_breadth=0.4"
)
"""A map of steep waves by nine harmonics, which takes seconds."""

STOP = """() => {
  const stop = document.querySelector('.progress button');
  const seen = stop && stop.offsetParent && getComputedStyle(stop).visibility === 'visible';
  if (seen) stop.click();
  return seen;
}"""
"""Presses the button in the first frame that shows it."""


def pressed(page, name):
    page.get_by_role("button", name=name).click()


def said_after(page, press):
    """The sentence once it has changed."""
    before = sentence(page)
    press()
    page.wait_for_function("before => document.querySelector('.says h1').innerText !== before", arg=before)
    return sentence(page)


def test_a_copied_link_opens_the_same_view(visit, context, explorer):
    context.grant_permissions(["clipboard-read", "clipboard-write"], origin=explorer.address)
    page = visit(f"{STABLE}&gm=0.7&bilge_keel_length=30&bilge_keel_breadth=0.25&harmonics=3&panel=stability")
    page.bring_to_front()
    page.locator(slider("heading")).first.focus()
    said = said_after(page, lambda: page.keyboard.press("ArrowRight"))
    pressed(page, "Copy link")
    page.get_by_text("is copied").wait_for()
    copied = page.evaluate("navigator.clipboard.readText()")
    assert copied.startswith(f"{explorer.address}/?")
    other = visit(copied.partition("?")[2])
    assert sentence(other) == said
    assert "Heading 31 deg" in said
    for dial in ("heading", "speed", "wave_height", "gm", "bilge_keel_length", "bilge_keel_breadth"):
        other.wait_for_function(f"document.querySelector('#number-{dial}').value !== ''")
        assert other.input_value(f"#number-{dial}") == page.input_value(f"#number-{dial}")
    other.wait_for_function("document.querySelector('.panel').innerText.includes('Floquet')")
    assert link(other) == link(page)
    assert page.wrong == other.wrong == []


@pytest.mark.soak
def test_where_the_browser_forbids_it_nothing_is_said_to_be_copied(visit):
    page = visit(STABLE)
    page.evaluate("Object.defineProperty(navigator, 'clipboard', { value: undefined })")
    pressed(page, "Copy link")
    page.get_by_text("take the link from its address line").wait_for()


@pytest.mark.soak
def test_stop_ends_a_long_map_and_the_server_answers_on(visit, explorer):
    page = visit(HARD)
    page.wait_for_function(STOP)
    page.wait_for_function("document.querySelector('.progress').innerText.includes('stopped at')")
    done = int(re.search(r"stopped at (\d+) of 37", page.inner_text(".progress"))[1])
    assert 0 < done < 37
    assert page.locator(".q-awaited").count() == (37 - done) * 20
    with urllib.request.urlopen(f"{explorer.address}/api/verdict?{STABLE}", timeout=600) as answer:
        assert ": stable: " in json.load(answer)["sentence"]
    assert page.locator(".q-awaited").count() == (37 - done) * 20  # it has not gone on meanwhile
    page.locator("#number-wave_height").fill("0.01")
    filled(page)
    assert page.wrong == []


@pytest.mark.soak
@pytest.mark.parametrize("system", [pytest.param("light", marks=pytest.mark.soak), "dark"])
def test_the_theme_follows_the_system_until_it_is_chosen(visit, system):
    page = visit(STABLE, scheme=system)

    def dark():
        paper = page.evaluate("getComputedStyle(document.body).backgroundColor")
        return sum(map(int, re.findall(r"\d+", paper)[:3])) < 120

    def shows(words):
        page.locator(f"button[aria-label='light or dark: {words}']").wait_for()

    shows("as the system")
    assert dark() == (system == "dark")
    for words in ("dark", "light", "as the system"):
        pressed(page, "light or dark")
        shows(words)
        page.wait_for_function(
            "dark => document.body.classList.contains('body--dark') === dark",
            arg=words == "dark" or (words == "as the system" and system == "dark"),
        )
        assert dark() == page.evaluate("document.body.classList.contains('body--dark')")
    assert page.wrong == []


@pytest.mark.soak
def test_bilge_keels_are_fitted_by_keyboard_and_taken_off_again(visit):
    """The numbers are those of the ship that `with_` gives the keels a page begins with, 0.25 L x 0.02 B."""
    page = visit(STABLE)
    bare = sentence(page) + page.inner_text(".says h1 + p")
    page.get_by_role("combobox", name="roll damping as").focus()
    page.keyboard.press("ArrowDown")
    chosen = page.locator(".q-manual-focusable--focused")
    chosen.wait_for()  # a key that comes before the list stands open is lost
    page.keyboard.press("ArrowDown")
    chosen.filter(has_text="Ikeda").wait_for()
    said_after(page, lambda: page.keyboard.press("Enter"))
    page.wait_for_function("location.search.includes('bilge_keel_breadth')")
    ship = qt.ship("series60-cb60")
    keels = 0.25 * ship.hull.length, 0.02 * ship.hull.beam
    assert (float(link(page)["bilge_keel_length"]), float(link(page)["bilge_keel_breadth"])) == pytest.approx(keels)
    fitted = ship.with_(roll_damping="ikeda", bilge_keels=keels)
    motion = qt.steady_motion(qt.equations(fitted, qt.Wave(150.0, 4.0), speed=7.5, heading=30.0), start="rest")
    assert f"Largest roll {motion.peak[1] * 57.29577951308232:.3g}°" in page.inner_text(".says")
    assert "% of critical at 10° of roll" in page.inner_text(".dials")
    pressed(page, "the ship's own loading")
    page.wait_for_function("!location.search.includes('bilge_keel')")
    assert sentence(page) + page.inner_text(".says h1 + p") == bare
    assert page.wrong == []
