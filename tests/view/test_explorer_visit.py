"""What a visitor's browser remembers: that the first steps were seen, and named views."""

import pytest

from quartering.conventions import RangeWarning
from tests.view.pages import STABLE, faded_in, filled, link, sentence

STEPS = ".q-steps"


def test_a_page_opens_inside_the_range_of_the_theory():
    """First-order theory and Floquet agree there, and no number is out of the range of its formula."""
    import warnings

    pytest.importorskip("nicegui", reason="the explorer needs the extra `app`")
    from quartering.view.explorer.computing.computations import scene, verdict
    from quartering.view.explorer.headline import beyond
    from quartering.view.explorer.hulls.ship_registry import ShipRegistry
    from quartering.view.explorer.state import STARTING

    of = scene(STARTING, ShipRegistry().known(STARTING.ship))
    with warnings.catch_warnings():
        warnings.simplefilter("error", RangeWarning)
        found = verdict(of)
    assert beyond(found) == list(found.beside.sentences) == []
    assert found.verdict.stable == (found.verdict.k2 < 0)


def test_a_first_visit_is_told_what_it_looks_at_by_keyboard_once_and_again_when_asked(visit):
    page = visit(STABLE)
    page.evaluate("localStorage.clear()")
    page.reload()
    page.wait_for_selector(STEPS)
    for words, seen in (("1 of 3: The verdict", ".says"), ("2 of 3: The map", ".map"), ("3 of 3: Dials", ".panel")):
        assert words in page.inner_text(STEPS)
        assert page.locator(f"{seen}.looked-at").count() == 1
        page.locator(f"{STEPS} button", has_text="Next" if "3 of" not in words else "Done").focus()
        page.keyboard.press("Enter")
    page.wait_for_selector(STEPS, state="detached")
    assert page.locator(".looked-at").count() == 0
    page.reload()
    filled(page)
    assert page.locator(STEPS).count() == 0  # seen
    page.get_by_role("button", name="what am I looking at").focus()
    page.keyboard.press("Enter")
    page.wait_for_selector(STEPS)
    assert page.evaluate("document.activeElement.closest('.q-steps') !== null")
    page.keyboard.press("Escape")
    page.wait_for_selector(STEPS, state="detached")
    assert page.wrong == page.elsewhere == []


@pytest.mark.parametrize(("width", "scheme"), [(1440, "light"), pytest.param(390, "dark", marks=pytest.mark.soak)])
def test_views_are_saved_opened_and_deleted_by_keyboard_and_old_ones_are_told(visit, width, scheme):
    axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="axe-core comes with the extra `dev`")
    page = visit(f"{STABLE}&gm=0.7", width=width, scheme=scheme)
    old = "[{name: 'before', link: '?ship=wigley&heading=75&rings=2', version: '0.0.1'}, 3]"
    page.evaluate(f"localStorage.setItem('quartering-views', JSON.stringify({old}))")
    page.wait_for_function("location.search.includes('gm=0.7')")
    said = sentence(page)

    def dialog():
        page.get_by_role("button", name="Views").focus()
        page.keyboard.press("Enter")
        page.wait_for_selector(".q-views")
        page.wait_for_function("document.activeElement.id === 'view-name'")

    dialog()
    assert "1 saved views cannot be read" in page.inner_text(".q-views")
    assert "of version 0.0.1" in page.inner_text(".q-views")
    page.keyboard.type("light loading")
    page.keyboard.press("Enter")
    page.get_by_text("“light loading” is saved.").wait_for()
    faded_in(page)
    found = axe.Axe().run(page).response["violations"]
    serious = [one for one in found if one["impact"] in ("serious", "critical")]
    assert [(one["id"], one["nodes"][0]["html"], one["nodes"][0]["failureSummary"]) for one in serious] == []
    page.locator(".q-views-open", has_text="before").focus()
    page.keyboard.press("Enter")
    page.wait_for_function("document.querySelector('.says h1').innerText.includes('Heading 75 deg')")
    page.get_by_text("part of this link is of another version").wait_for()
    page.wait_for_selector(".q-views", state="detached")
    page.reload()
    page.wait_for_selector(".says h1 b")
    dialog()
    page.locator(".q-views-open", has_text="light loading").focus()
    page.keyboard.press("Enter")
    page.wait_for_function("said => document.querySelector('.says h1').innerText === said", arg=said)
    page.wait_for_function("location.search.includes('gm=0.7')")
    assert link(page)["ship"] == "series60-cb60"
    dialog()
    page.get_by_role("button", name="delete before").focus()
    page.keyboard.press("Enter")
    page.get_by_text("“before” is deleted.").wait_for()
    assert page.evaluate("JSON.parse(localStorage.getItem('quartering-views')).map(one => one.name)") == [
        "light loading"
    ]
    assert page.wrong == page.elsewhere == []


@pytest.mark.soak
def test_a_hull_is_chosen_by_keyboard_in_a_dialog_whose_parts_have_names(visit):
    axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="axe-core comes with the extra `dev`")
    page = visit(STABLE)
    # As at a first visit: without the three steps the button lies before the map, and axe takes the dimmed page for its
    # background, #949492, where the screen shows white on blue.
    page.evaluate("localStorage.clear()")
    page.reload()
    page.wait_for_selector(".says h1 b")
    filled(page)
    chosen = []
    page.on("filechooser", lambda one: chosen.append(one))
    page.get_by_role("button", name="Your hull").focus()
    page.keyboard.press("Enter")
    page.get_by_role("button", name="Draw it").click(trial=True)  # it stands still, and nothing lies over it
    faded_in(page)
    page.mouse.move(5, 500)  # away from the button, whose colour is another under the pointer
    found = axe.Axe().run(page).response["violations"]
    serious = [one for one in found if one["impact"] in ("serious", "critical")]
    assert [(one["id"], one["nodes"][0]["html"], one["nodes"][0]["failureSummary"]) for one in serious] == []
    page.get_by_role("button", name="Choose a file").focus()
    page.keyboard.press("Enter")
    page.wait_for_timeout(500)
    assert len(chosen) == 1
    assert page.wrong == []


RINGED = """() => {
  const one = document.activeElement, shown = (e) => e && getComputedStyle(e).outlineStyle !== 'none' &&
    parseFloat(getComputedStyle(e).outlineWidth) >= 2;
  let around = one;
  for (let i = 0; i < 6 && around && around !== document.body; i++, around = around.parentElement) if (shown(around)) return '';
  return [...one.querySelectorAll('*')].some(shown) ? '' : one.outerHTML.slice(0, 120);
}"""
"""What has the focus, where neither it nor what it stands in shows a ring of 2 px."""


@pytest.mark.soak
def test_every_stop_of_the_tab_key_shows_a_ring_of_two_pixels(visit):
    page = visit(f"{STABLE}&panel=compare&gm=0.7")
    filled(page)
    page.evaluate("document.body.focus()")
    first, bare, stops = "", set(), 0
    for _ in range(45):
        page.keyboard.press("Tab")
        here = page.evaluate("document.activeElement.outerHTML.slice(0, 300)")
        if here == first or here.startswith("<body"):
            break
        first = first or here
        stops += 1
        bare.add(page.evaluate(RINGED))
    assert stops > 25  # bar, dials with number and slider, map, tabs, what the tab holds
    assert bare == {""}
