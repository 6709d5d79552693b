"""The tab that compares: a second ship or loading beside the one of the dials."""

import numpy as np
import pytest

import quartering as qt
from quartering.conventions import InputError
from tests.view.pages import STABLE, link

pytest.importorskip("nicegui", reason="the explorer needs the extra `app`")

from quartering.study.maps.compare import map_difference
from quartering.view.explorer.comparison.beside import compared, kept, link_of, offered, same
from quartering.view.explorer.computing.computations import joined, map_blocks, scene
from quartering.view.explorer.hulls.ship_registry import Known, ShipRegistry
from quartering.view.explorer.state import State

CASES = {"ballast": {"gm": "0.9 m"}}


def known_as(key, one):
    """A registry that holds a ship as if it had been brought."""
    registry = ShipRegistry()
    registry.keep(Known(key, key, one))
    return registry


def test_what_is_kept_comes_back_from_its_link_and_is_told_from_what_is_shown():
    registry = ShipRegistry()
    state = State(ship="wigley", gm=0.6, gyradius_roll=3.4)
    other = kept(link_of(state), registry)
    assert (other.ship.loading.gm, other.ship.loading.gyradius_roll) == (0.6, 3.4)
    shown = scene(State(ship="wigley", gm=0.7, gyradius_roll=3.4), registry.known("wigley"))
    assert not same(shown, other)
    assert same(scene(state, registry.known("wigley")), other)
    assert offered(state.changed(beside=link_of(state)), registry.known("wigley"), registry)[link_of(state)] == (
        "kept: wigley, GM 0.6, roll gyradius 3.4"
    )


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("gm=0.6", "the ship is missing"),
        ("ship=wigley&heading=30", "not heading"),
        ("ship=wigley&gm=-1", "gm"),
        ("ship=/etc/passwd", "unknown here"),
        ("ship=wigley&loading_case=ballast", "no loading cases"),
        ("ship=upload-0123", "does not hold the hull"),
    ],
)
def test_what_cannot_be_compared_with_is_refused_with_the_reason(text, reason):
    with pytest.raises(InputError, match=reason):
        kept(text, ShipRegistry())


def side_by_side(state, beside, registry):
    of, other = scene(state, registry.known(state.ship)), kept(beside, registry)
    maps = [joined([block() for block in map_blocks(one)]) for one in (of._replace(ship=other.ship), of)]
    return compared(of, other, maps), maps


def test_a_loading_case_and_ships_of_one_name_and_of_other_sizes_are_each_told():
    brought = qt.ship("wigley").with_(loadings=CASES)
    registry = known_as("own", brought)
    case, maps = side_by_side(State(ship="own"), "ship=own&loading_case=ballast", registry)
    assert case.labels == ["Wigley hull, ballast", "Wigley hull, as shown"]
    assert case.rows[4][:3] == ("GM [m]", "0.9", "0.5")
    np.testing.assert_array_equal(
        case.ds["roll_difference"], map_difference(maps, ["a", "b"])["roll_difference"]
    )  # what `quartering polar` writes
    longer = known_as("own", brought.with_(length=120.0))
    twins, _ = side_by_side(State(ship="wigley"), "ship=own", longer)
    assert twins.labels == ["Wigley hull (own)", "Wigley hull (wigley)"]
    assert "Both are called Wigley hull" in twins.said[0]
    assert "of other sizes" in twins.said[1]
    assert "those of Wigley hull (wigley)" in twins.said[1]  # the map's rings are of the page's own ship


def test_a_loading_is_kept_and_what_the_dials_do_to_it_is_drawn_and_told(page, tmp_path):
    page.get_by_role("tab", name="Compare").click()
    page.wait_for_function("document.querySelector('.panel').innerText.includes('Keep the loading')")
    page.get_by_role("button", name="Keep this loading").focus()
    page.keyboard.press("Enter")
    page.get_by_text("one ship, loaded alike").wait_for()
    page.locator("#number-gm").fill("0.6")
    page.wait_for_selector(".beside-table")
    page.wait_for_function("!document.querySelector('.later')")
    assert "GM 0.6 m less" in page.inner_text(".beside-says")
    own = qt.ship("series60-cb60")
    told = [cell.inner_text() for cell in page.locator(".beside-table tr", has_text="GM [m]").locator("td").all()]
    assert [float(cell) for cell in told] == pytest.approx([own.loading.gm, 0.6, 0.6 - own.loading.gm], abs=1e-3)
    waves = [qt.Wave(own.hull.length * ratio, 4.0) for ratio in (1.0, 1.2)]
    rolls = [qt.polar(one, waves, [7.5], [60.0])["roll_peak"].values for one in (own, own.with_(gm=0.6))]
    page.locator(".beside-map .q-cell[data-i='12'][data-j='8']").dispatch_event("mousemove")
    words = page.inner_text(".beside-map .q-map-told")
    assert f"roll difference {(rolls[1] - rolls[0])[0, 0, 1]:+.1f}°" in words
    page.locator(".beside-map svg").first.focus()
    page.keyboard.press("ArrowRight")
    page.wait_for_function("document.querySelector('.says h1').innerText.includes('Heading 35 deg')")
    with page.expect_download() as taken:
        page.get_by_role("button", name="Picture of the difference").click()
    taken.value.save_as(tmp_path / "difference.png")
    assert (tmp_path / "difference.png").stat().st_size > 20_000
    assert link(page)["beside"] == "ship=series60-cb60"
    assert page.wrong == page.elsewhere == []


@pytest.mark.soak
@pytest.mark.parametrize(("width", "scheme"), [(1440, "light"), pytest.param(390, "dark", marks=pytest.mark.soak)])
def test_axe_finds_nothing_serious_where_two_ships_are_compared(visit, width, scheme):
    axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="axe-core comes with the extra `dev`")
    page = visit(f"{STABLE}&panel=compare&beside=ship%3Dwigley", width=width, scheme=scheme)
    page.wait_for_selector(".beside-table")
    assert "of other sizes" in page.inner_text(".panel")
    found = axe.Axe().run(page).response["violations"]
    assert [one["id"] for one in found if one["impact"] in ("serious", "critical")] == []
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    assert page.wrong == []


@pytest.mark.parametrize("width", [1440, 1280])
def test_the_names_of_all_panels_stand_in_one_line(page, width):
    page.set_viewport_size({"width": width, "height": 1000})
    page.get_by_role("tab", name="Compare").wait_for()
    tops = page.evaluate(
        "[...document.querySelectorAll('.tabs .q-tab')].map(one => one.getBoundingClientRect())"
        ".filter(one => one.width > 0).map(one => Math.round(one.top))"
    )
    assert len(tops) >= 7
    assert len(set(tops)) == 1
