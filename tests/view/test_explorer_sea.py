"""The explorer in an irregular sea: page, link, files and service give the numbers of the library and refuse what is none."""

import json
import re
from urllib.parse import parse_qsl

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner

import quartering as qt
from quartering.conventions import InputError
from quartering.study.case.read import case_grid
from quartering.view.cli import app
from tests.view.pages import STABLE, link, sentence, serious
from tests.view.service import ask

pytest.importorskip("nicegui", reason="the explorer needs the extra `app`")

from quartering.view.explorer.hulls.ship_registry import ShipRegistry
from quartering.view.explorer.sea.sea_downloads import case_file
from quartering.view.explorer.sea.sea_scene import map_grid, sea_scene
from quartering.view.explorer.state import State

SEA = {"ship": "series60-cb60", "hs": 3, "tp": 9, "spreading": "10", "speed": 7.5, "heading": 45}
MAP = {"ship": "series60-cb60", "gm": 0.9, "hs": [2, 3], "tp": [9], "speed": [3, 7.5], "heading": [45, 90]}
PAGE = "ship=series60-cb60&mode=sea&hs=3&tp=9&heading=45&speed=7.5"
FILLED = (
    "document.querySelectorAll('.q-sea-map .q-cell').length === 259 && !document.querySelector('.q-sea-map .q-awaited')"
)


@given(
    hs=st.none() | st.floats(0.01, 30.0),
    period=st.tuples(st.sampled_from(["tp", "tz"]), st.floats(1.0, 35.0)),
    spectrum=st.sampled_from(["jonswap", "bretschneider", "pierson-moskowitz", "torsethaugen"]),
    spreading=st.sampled_from(["none", "cos2", "2", "10", "7.5"]),
    panel=st.sampled_from(["response", "hull", "criteria"]),
)
def test_a_link_carries_the_sea(period, **values):
    state = State(mode="sea", **values, **dict([period]))
    back = State.of_query(dict(parse_qsl(state.query())))
    for name, value in state:
        other = getattr(back, name)
        assert other == (pytest.approx(value, rel=1e-9, abs=1e-12) if isinstance(value, float) else value), name


def test_a_panel_of_the_other_mode_gives_way():
    assert State(mode="sea", panel="curve").panel == "response"
    assert State(panel="response").panel == "motion"
    assert State(mode="sea").changed(mode="wave") == State()


@pytest.mark.parametrize(
    ("query", "reason"),
    [
        ({"hs": "0"}, "hs = 0 m; it is above 0 m"),
        ({"hs": "inf"}, "finite"),
        ({"tp": "8", "tz": "7"}, "leave one out"),
        ({"tz": "0.1"}, "tz = 0.1 s"),
        ({"spectrum": "wallops"}, "spectrum"),
        ({"spreading": "wide"}, "spreading = 'wide'"),
        ({"spreading": "-1"}, "s > 0"),
        ({"mode": "storm"}, "mode"),
    ],
)
def test_a_link_of_no_sea_is_refused_with_the_reason(query, reason):
    with pytest.raises(InputError, match=re.escape(reason)):
        State.of_query(query)


@pytest.mark.parametrize("spectrum", ["jonswap", "torsethaugen"])
def test_the_case_file_gives_the_map_again(tmp_path, spectrum):
    """The grid of the case is that of the page with the chosen speed and heading beside: same sea, same ship."""
    state = State(mode="sea", hs=3.0, tp=9.0, spectrum=spectrum, spreading="cos2", gm=0.9, heading=47.0, speed=7.7)
    of = sea_scene(state, ShipRegistry().known(state.ship))
    name, content = case_file(state, of)
    (tmp_path / name).write_bytes(content)
    read, own = case_grid(tmp_path / name), map_grid(state, of)
    assert read.described["spreading"] == "cos2"
    assert {*own.axes["speed"].tolist(), 7.7} == {*read.axes["speed"].tolist()}
    assert 47.0 in read.axes["heading"].tolist()
    np.testing.assert_allclose(read.axes[own.period], own.axes[own.period], rtol=1e-12)
    assert read.loaded(0).loading.gm == own.ship.loading.gm == 0.9


def test_a_sea_is_that_of_the_command(explorer):
    words = [
        "--hs",
        "3",
        "--tp",
        "9",
        "--spreading",
        "10",
        "--speed",
        "7.5",
        "--heading",
        "45",
        "--hours",
        "0",
        "--json",
    ]
    printed = json.loads(CliRunner().invoke(app, ["sea", "series60-cb60", *words]).stdout)
    for method in printed["methods"].values():
        del method["processor_time"]
    status, served = ask(explorer, "/api/sea", SEA)
    assert status == 200
    assert served["stable"]
    assert served["sentence"].startswith("Heading 45 deg")
    assert {name: served[name] for name in printed} == printed
    assert ask(explorer, "/api/sea", query=SEA)[1] == served


def test_guidance_is_that_of_the_library(explorer):
    status, served = ask(explorer, "/api/guidance", MAP)
    assert status == 200
    ds = qt.guidance(qt.ship("series60-cb60").with_(gm=0.9), [2, 3], [9], speed=[3, 7.5], heading=[45, 90])
    np.testing.assert_allclose(served["roll_mean_3h_max"], ds["roll_mean_3h_max"].values, rtol=1e-12)
    assert served["dims"] == ["loading", "hs", "tz", "speed", "heading"]
    words = np.array(ds["recommended"].attrs["flag_meanings"].split())
    assert served["recommended"] == words[ds["recommended"].values].tolist()
    assert "unverified" in served["threshold_source"]


@pytest.mark.parametrize(
    ("path", "content", "reason"),
    [
        ("sea", SEA | {"hs": 0}, "above 0 m"),
        ("sea", SEA | {"hs": float("nan")}, "finite"),
        ("sea", SEA | {"hs": 20}, "it breaks"),
        ("sea", SEA | {"tz": 7}, "leave one out"),
        ("sea", SEA | {"spreading": "wide"}, "spreading = 'wide'"),
        ("sea", SEA | {"spreading": [1]}, "spreading = "),
        ("sea", SEA | {"gamma": 99}, "gamma = 99; it is from 1 to 20"),
        ("sea", SEA | {"speed": "fast"}, "speed"),
        ("sea", SEA | {"hss": 3}, "did you mean hs"),
        ("sea", SEA | {"spectrum": "torsethaugen", "tp": None, "tz": 7}, "give tp"),
        ("sea", {"ship": "wigley"}, "hs: is missing"),
        ("guidance", MAP | {"tz": [7]}, "one of the two"),
        ("guidance", MAP | {"hs": []}, "hs"),
        ("guidance", MAP | {"speed": [float("inf")]}, "finite"),
        ("guidance", MAP | {"speed": [i / 100 for i in range(2000)]}, "8,000 conditions"),
        ("guidance", MAP | {"hs": [25]}, "breaks"),
        ("guidance", MAP | {"spectrum": "torsethaugen", "tp": None, "tz": [7]}, "tz of a spectrum of two peaks"),
        ("guidance", MAP | {"threshold": 0}, "it is from 1 to 10"),
        ("guidance", MAP | {"ship": "../etc/passwd"}, "unknown"),
        ("guidance", b"[1", "JSON"),
    ],
)
def test_a_call_about_no_sea_is_refused_with_the_reason(explorer, path, content, reason):
    status, answer = ask(explorer, f"/api/{path}", content)
    assert status == 422
    assert re.search(re.escape(reason), answer["error"]), answer["error"]


def test_the_switch_to_a_sea_and_back(visit):
    """By keyboard alone: wave to sea, the map of the sea, its numbers, a cell by the arrow keys; Back is the wave again."""
    page = visit(STABLE)
    page.get_by_role("button", name="sea", exact=True).focus()
    page.keyboard.press("Enter")
    page.wait_for_function("location.search.includes('mode=sea')")
    assert not page.locator("#number-wave_length").is_visible()
    page.locator("#number-hs").fill("3")
    page.wait_for_function("location.search.includes('hs=3')")
    page.locator("#number-period").fill("9")
    page.wait_for_function("location.search.includes('tp=9')")
    page.wait_for_function(FILLED)
    found = qt.sea_response(qt.ship("series60-cb60"), qt.Sea(hs=3, tp=9, heading=30), 7.5, method="closure")
    page.wait_for_function("document.querySelector('.says h1').innerText.includes('Hs 3 m, Tp 9 s')")
    shown = page.inner_text(".panel")
    for name in ("roll_rms", "roll_mean_largest", "roll_mean_largest_bound", "roll_period"):
        assert f"{float(found[name]):.3g}" in shown
    for words in ("Vanmarcke", "Rice", "K₂", "energy overtaken"):
        assert words in shown
    assert "recalled, unverified" in page.inner_text(".q-sea-map .legend")
    page.locator(".q-sea-map svg").focus()
    page.keyboard.press("ArrowLeft")
    page.wait_for_function("document.querySelector('.says h1').innerText.includes('Heading 25 deg')")
    assert link(page)["mode"] == "sea"
    while "mode" in link(page):
        page.go_back()
        page.wait_for_timeout(300)
    page.wait_for_function("document.querySelector('.says h1').innerText.includes('wave')")
    page.wait_for_selector("#number-wave_length:visible")
    page.go_forward()
    page.wait_for_function("document.querySelector('.says h1').innerText.includes('Hs')")
    assert serious(page) == []
    assert page.wrong == page.elsewhere == []


@pytest.mark.soak
def test_a_sea_on_a_phone_in_the_dark(visit):
    page = visit(PAGE, width=390, height=844, scheme="dark")
    page.wait_for_function(FILLED)
    assert "Heading 45 deg" in sentence(page)
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    page.locator("#number-hs").fill("20")
    page.wait_for_selector(".dial.refused #number-hs")
    assert "it breaks" in page.inner_text(".wrong")
    assert serious(page) == []
    assert page.wrong == []
