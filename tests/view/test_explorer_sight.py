"""What a visitor of the explorer sees, hears, undoes and prints: the ship in its wave, the hull, refusals, the way back."""

import pytest

from tests.view.pages import STABLE, filled, link, sentence, serious

PIXELS = """selector => {
  const canvas = document.querySelector(selector);
  const all = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
  let sum = 0, some = new Set();
  for (let i = 0; i < all.length; i += 4 * 37) {
    some.add(all[i] << 16 | all[i + 1] << 8 | all[i + 2]);
    sum = (sum * 31 + all[i] + all[i + 1]) % 1e9;
  }
  return [sum, some.size];
}"""


def drawn(page, selector):
    """A number that changes with a canvas, and how many colours it has."""
    return page.evaluate(PIXELS, selector)


def test_the_ship_moves_in_its_wave_and_stops_and_steps_by_keyboard(visit):
    page = visit(STABLE, motion="no-preference")
    page.wait_for_selector(".q-ship canvas")
    page.wait_for_function("document.querySelector('.q-ship canvas').width > 300")
    page.locator(".q-ship-play[aria-label='pause']").wait_for()  # it plays by itself
    page.locator(".q-ship canvas").focus()
    page.keyboard.press(" ")
    page.locator(".q-ship-play[aria-label='play']").wait_for()
    still, colours = drawn(page, ".q-ship canvas")
    assert colours > 10  # hull, water from trough to crest, lines
    page.wait_for_timeout(400)
    assert drawn(page, ".q-ship canvas")[0] == still
    before = page.input_value(".q-ship input[type=range]")
    page.keyboard.press("ArrowRight")
    page.wait_for_function("before => document.querySelector('.q-ship input').value !== before", arg=before)
    assert drawn(page, ".q-ship canvas")[0] != still
    page.keyboard.press(" ")
    at = page.input_value(".q-ship input[type=range]")
    page.wait_for_function("at => document.querySelector('.q-ship input').value !== at", arg=at)
    assert "roll" in page.get_attribute(".q-ship input[type=range]", "aria-valuetext")
    assert page.wrong == page.elsewhere == []


@pytest.mark.soak
def test_who_wants_less_motion_gets_a_picture_that_stands(visit):
    page = visit(STABLE, motion="reduce")
    page.wait_for_selector(".q-ship-play[aria-label='play']")


def test_the_hull_is_turned_by_keyboard_and_by_name(page):
    page.get_by_role("tab", name="Hull").click()
    page.wait_for_selector(".q-hull-form canvas")
    page.wait_for_function("document.querySelector('.q-hull-form canvas').width > 300")
    first, colours = drawn(page, ".q-hull-form canvas")
    assert colours > 20  # facets in the light, above and below the water
    page.locator(".q-hull-form canvas").focus()
    page.keyboard.press("ArrowLeft")
    turned, _ = drawn(page, ".q-hull-form canvas")
    assert turned != first
    page.get_by_role("button", name="bow").click()
    assert drawn(page, ".q-hull-form canvas")[0] not in (first, turned)
    assert page.wrong == []


def test_a_refused_value_stays_red_and_the_verdict_greys_until_it_is_mended(page):
    own = page.input_value("#number-gm")
    page.locator("#number-gm").fill("-3")
    page.wait_for_selector(".dial.refused #number-gm")
    page.wait_for_selector(".says.stale")
    assert page.locator(".dial.refused").count() == 1
    assert float(page.input_value("#number-gm")) == -3
    assert "above 0 m" in page.inner_text(".wrong")
    assert page.get_attribute("#number-gm", "aria-invalid") == "true"
    page.locator("#number-gm").fill(own)
    page.wait_for_function("!document.querySelector('.dial.refused, .says.stale, .wrong')")


def test_back_undoes_a_turn_and_forward_does_it_again(page):
    page.locator("#number-heading").fill("75")
    page.wait_for_function("location.search.includes('heading=75')")
    page.go_back()
    page.wait_for_function("document.querySelector('.says h1').innerText.includes('Heading 30 deg')")
    page.wait_for_function("document.querySelector('#number-heading').value === '30'")
    assert link(page)["heading"] == "30"
    page.go_forward()
    page.wait_for_function("document.querySelector('.says h1').innerText.includes('Heading 75 deg')")
    assert page.wrong == []


def test_an_unknown_part_of_a_link_is_told_and_the_rest_is_shown(visit):
    page = visit("ship=series60-cb60&heading=75&haeding=30&rings=2")
    page.wait_for_selector(".wrong")
    told = page.inner_text(".wrong")
    assert "haeding" in told
    assert "did you mean heading" in told
    assert "rings" in told
    assert "Heading 75 deg" in sentence(page)


def test_a_slider_says_its_name_and_its_value_with_the_unit(page):
    slider = page.locator("#slider-gm[role=slider], #slider-gm [role=slider]").first
    page.wait_for_function("document.querySelector('[aria-valuetext]#slider-gm, #slider-gm [aria-valuetext]')")
    assert slider.get_attribute("aria-valuetext") == f"{page.input_value('#number-gm')} m"
    assert slider.get_attribute("aria-label") == "GM"


@pytest.mark.soak
def test_the_theme_is_remembered(visit):
    page = visit(STABLE)
    page.get_by_role("button", name="light or dark").click()
    page.wait_for_function("document.cookie.includes('quartering-theme=dark')")
    page.reload()
    page.wait_for_function("document.body.classList.contains('body--dark')")
    for _ in range(2):  # back to the system's, for whoever comes next
        page.get_by_role("button", name="light or dark").click()
    page.wait_for_function("document.cookie.includes('quartering-theme=system')")


@pytest.mark.soak
def test_switching_tabs_leaves_the_console_silent(visit):
    page = visit(STABLE)
    page.wait_for_selector(".panel .main-svg")
    for name in ("Stability", "Hull", "Motion", "Stability"):
        page.get_by_role("tab", name=name).click()
        page.wait_for_timeout(600)
    page.set_viewport_size({"width": 1200, "height": 900})
    page.wait_for_timeout(600)
    assert page.wrong == []


def test_a_printed_page_has_the_map_with_its_scale_and_no_controls(page):
    page.emulate_media(media="print")
    assert page.locator(".scale-bar").is_visible()
    assert page.locator(".q-map svg").is_visible()
    assert not page.locator(".q-slider").first.is_visible()
    assert not page.locator(".tabs").is_visible()
    assert page.evaluate("getComputedStyle(document.querySelector('.scale-bar')).printColorAdjust") == "exact"
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    page.emulate_media(media="screen")


def test_axe_finds_nothing_serious(page):
    page.wait_for_selector(".panel canvas")
    assert serious(page) == []


@pytest.mark.soak
@pytest.mark.parametrize("width", [1440, 1024, 390])
@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("panel", ["stability", "hull"])
def test_axe_finds_nothing_serious_anywhere(visit, width, scheme, panel):
    page = visit(f"{STABLE}&panel={panel}", width=width, scheme=scheme)
    filled(page)
    page.wait_for_selector(".panel canvas, .panel table")
    assert serious(page) == []
