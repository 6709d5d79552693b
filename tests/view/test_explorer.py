"""The explorer as a visitor meets it, in a real browser: look, drag, click, upload, take a file home and run it again."""

import json
import math
import re
import shutil

import pytest
from typer.testing import CliRunner

import quartering as qt
from quartering.study.maps.result import open_result
from quartering.view.cli import app
from tests.view.pages import STABLE, filled, link, sentence


def test_the_first_sight_is_the_verdict_and_the_whole_map(visit):
    page = visit()
    filled(page)
    said = sentence(page)
    assert "stable" in said
    assert ("restores stability" in page.inner_text("body")) == ("unstable" in said)
    kinds = page.eval_on_selector_all(".q-cell", "cells => cells.map(cell => cell.dataset.kind)")
    hatched = page.eval_on_selector_all(
        ".q-map svg path", "all => all.filter(p => (p.getAttribute('fill') || '').includes('hatch'))"
    )
    assert len(hatched) == sum(int(kind) not in (-1, 0, 5) for kind in kinds)  # by pattern, not by colour alone
    assert len(kinds) > 0
    assert page.wrong == page.elsewhere == []


def test_the_sentence_is_that_of_the_command(page):
    words = ["--heading", "30", "--speed", "7.5", "--wave-length", "150", "--wave-height", "4", "--json"]
    said = json.loads(CliRunner().invoke(app, ["verdict", "series60-cb60", *words]).stdout)["sentence"]
    shown = f"{sentence(page)} {page.inner_text('.says h1 + p')}"
    for number in re.findall(r"\d+\.\d+", said):
        assert number in shown
    assert "stable" in sentence(page)


def test_a_turned_dial_moves_verdict_link_and_map(page):
    before = sentence(page)
    thumb = page.locator("#slider-heading [tabindex='0'], #slider-heading[tabindex='0']").first
    thumb.focus()
    page.keyboard.press("ArrowRight")
    page.wait_for_function("before => document.querySelector('.says h1').innerText !== before", arg=before)
    assert "Heading 31 deg" in sentence(page)
    page.wait_for_function("location.search.includes('heading=31')")
    assert page.wrong == []


@pytest.mark.soak
def test_dragging_a_slider_follows_with_the_mouse(visit):
    page = visit(STABLE)
    box = page.locator("#slider-gm").bounding_box()
    before = page.input_value("#number-gm")
    page.mouse.move(box["x"] + 0.3 * box["width"], box["y"] + box["height"] / 2)
    page.mouse.down()
    for share in (0.4, 0.5, 0.6, 0.7):
        page.mouse.move(box["x"] + share * box["width"], box["y"] + box["height"] / 2, steps=3)
    page.mouse.up()
    at_rest = (
        "Math.abs(new URLSearchParams(location.search).get('gm') - document.querySelector('#number-gm').value) < 1e-3"
    )
    page.wait_for_function(at_rest)
    assert float(link(page)["gm"]) > float(before)


def test_a_click_on_a_cell_opens_its_motion(page):
    ship = qt.ship("series60-cb60")
    page.locator(".q-cell[data-i='24'][data-j='8']").evaluate(
        "cell => cell.dispatchEvent(new MouseEvent('click', { bubbles: true }))"
    )
    page.wait_for_function("document.querySelector('.says h1').innerText.includes('Heading 120 deg')")
    length = 1.2 * ship.hull.length  # ring 8 of 0.4, 0.5, ..
    model = qt.equations(ship, qt.Wave(length, 4.0), speed=7.5, heading=120.0)
    motion = qt.steady_motion(model, start="rest")
    roll = f"Largest roll {motion.peak[1] * 57.29577951308232:.3g}°"
    page.wait_for_function("roll => document.querySelector('.panel').innerText.includes(roll)", arg=roll)
    page.locator(".q-map svg").focus()
    page.keyboard.press("ArrowLeft")
    page.wait_for_function("document.querySelector('.says h1').innerText.includes('Heading 115 deg')")
    assert page.wrong == []


@pytest.mark.parametrize(
    ("panel", "says"),
    [
        ("stability", "Floquet"),
        *(
            pytest.param(*one, marks=pytest.mark.soak)
            for one in (("curve", "harmonics"), ("causes", "leading exponent"), ("hull", "Body plan"))
        ),
    ],
)
def test_every_panel_draws(visit, panel, says):
    page = visit(f"{STABLE}&panel={panel}")
    page.wait_for_function("says => document.querySelector('.panel').innerText.includes(says)", arg=says)
    page.wait_for_selector(".panel .main-svg")
    assert page.locator(".panel .main-svg .trace, .panel .main-svg .points path").count() > 0
    assert page.wrong == []


BARGE = "x,0,4,6\n" + "\n".join(f"{x},5,5,5" for x in (-30, -10, 10, 30))


def upload(page, name, content, draught=None):
    page.get_by_role("button", name="Your hull").click()
    if draught is not None:
        page.get_by_label("draught [m]").fill(str(draught))
        page.get_by_label("draught [m]").blur()
    file = content if isinstance(content, str) else {"name": name, "mimeType": "text/csv", "buffer": content}
    page.locator("input[type=file]").set_input_files(file)


def test_an_uploaded_hull_is_drawn_and_its_case_runs_again(page, tmp_path, monkeypatch):
    upload(page, "barge.csv", BARGE.encode(), draught=3)
    page.wait_for_function(
        "document.querySelector('.panel').innerText.includes('displaced 1,800')"
    )  # L B T = 60 x 10 x 3 m
    assert link(page)["ship"].startswith("upload-")
    said = page.inner_text(".says")
    page.get_by_role("button", name="Download").click()
    with page.expect_download() as taken:
        page.get_by_text("Case file").click()
    taken.value.save_as(tmp_path / "case.zip")
    shutil.unpack_archive(tmp_path / "case.zip", tmp_path)
    monkeypatch.chdir(tmp_path)
    assert rerun(tmp_path / "case.yaml", page, said) == "upload"


@pytest.mark.soak
def test_the_case_file_runs_again_with_the_same_answer(visit, tmp_path, monkeypatch):
    page = visit(f"{STABLE}&gm=0.8&heading=33")
    said = page.inner_text(".says")
    page.get_by_role("button", name="Download").click()
    with page.expect_download() as taken:
        page.get_by_text("Case file").click()
    taken.value.save_as(tmp_path / "case.yaml")
    monkeypatch.chdir(tmp_path)
    assert rerun(tmp_path / "case.yaml", page, said) == "built-in"


def rerun(case, page, said):
    """Run a case by the command line and compare the chosen condition with what the page says."""
    runner = CliRunner()
    result = runner.invoke(app, ["sweep", str(case), "-o", "result"])
    assert result.exit_code == 0, result.output
    ds = open_result("result").load()
    at = link(page)
    heading = float(at.get("heading", 60))
    length = (
        float(at["wave_length"])
        if "wave_length" in at
        else float(re.search(r"wave length ([\d.]+) m", case.read_text())[1])
    )
    cell = ds.sel(heading=heading, wave_length=length, method="nearest").squeeze()
    assert float(cell["wave_length"]) == pytest.approx(length)
    roll = float(re.search(r"Largest roll ([\d.]+)° over a cycle", said)[1])
    assert float(cell["heading"]) == pytest.approx(heading)
    assert float(cell["roll_peak"]) == pytest.approx(roll, rel=5e-3)  # the page shows three digits
    assert bool(cell["verdict"] == 0) == ("unstable" not in said)
    told = re.search(r"out at ([\d.e-]+) 1/s", said) or re.search(r"\+([\d.e-]+) 1/s by Floquet", said)
    assert abs(float(cell["exponent"])) == pytest.approx(float(told[1]), rel=5e-3)
    return "upload" if "ship.yaml" in case.read_text() else "built-in"


@pytest.mark.soak
def test_bad_files_are_refused_in_the_dialog_and_another_visitor_notices_nothing(visit, tmp_path):
    other, page = visit(STABLE), visit(STABLE)
    before = sentence(other)
    huge = tmp_path / "huge.stl"
    with huge.open("wb") as file:
        file.truncate(200_000_000)
    upload(page, "", str(huge))
    page.wait_for_function("document.querySelector('.upload-box').innerText.includes('up to 8 MB')")
    for name, content, says in (
        ("hull.csv", bytes(range(256)) * 40, "cannot be read as text"),
        ("one.csv", b"x,0,4\n0,5,5\n", "at least 4 of them"),
        ("barge.csv", BARGE.encode(), "give the draught"),
    ):
        page.locator("input[type=file]").set_input_files({"name": name, "mimeType": "text/csv", "buffer": content})
        page.wait_for_function("says => document.querySelector('.upload-box').innerText.includes(says)", arg=says)
    page.get_by_role("button", name="Cancel").click()
    other.locator("#number-heading").fill("40")
    other.wait_for_function("document.querySelector('.says h1').innerText.includes('Heading 40 deg')")
    assert sentence(page) == before  # what one visitor does, the other does not see
    assert page.wrong == other.wrong == []


def test_a_link_that_cannot_be_says_why_and_opens_a_page(visit):
    page = visit("heading=nan&ship=wigley")
    assert "heading" in page.inner_text(".wrong")
    assert "nan" in page.inner_text(".wrong")


@pytest.mark.soak
def test_a_wave_that_breaks_is_told_and_the_page_goes_on(visit):
    page = visit(STABLE)
    page.locator("#number-wave_height").fill("40")
    page.wait_for_selector(".wrong")
    assert "breaks" in page.inner_text(".wrong")
    page.locator("#number-wave_height").fill("3")
    page.wait_for_function("document.querySelector('.says h1').innerText.includes('x 3 m')")
    assert page.locator(".wrong").count() == 0


@pytest.mark.soak
def test_a_ship_that_keeps_pace_with_the_wave_gets_no_answer_but_its_map(visit):
    speed = math.sqrt(9.81 * 150.0 / (2 * math.pi))  # the celerity of the wave
    page = visit(f"ship=series60-cb60&speed={speed!r}&heading=0&wave_length=150&wave_height=4")
    page.wait_for_selector(".wrong")
    assert "No periodic motion" in sentence(page)
    assert "keeps pace" in page.inner_text(".wrong")
    filled(page)


@pytest.mark.soak
def test_it_fits_a_phone_and_follows_the_dark(visit):
    page = visit(STABLE, width=375, height=800, scheme="dark")
    filled(page)
    assert page.evaluate("document.documentElement.scrollWidth") <= 375
    ink, paper = page.evaluate(
        "[getComputedStyle(document.body).color, getComputedStyle(document.body).backgroundColor]"
    )
    light, dark = (sum(map(int, re.findall(r"\d+", colour)[:3])) for colour in (ink, paper))
    assert light > 600 > 120 > dark
    assert page.wrong == []


def test_on_a_phone_verdict_and_refusal_stay_in_sight_of_the_dials(page):
    page.set_viewport_size({"width": 390, "height": 844})
    page.locator("#number-gm").scroll_into_view_if_needed()
    page.evaluate("document.querySelector('.dials').scrollIntoView()")

    def in_sight(selector):
        box = page.locator(selector).bounding_box()
        return box["y"] >= 0 and box["y"] + box["height"] <= 844

    assert in_sight(".says h1")
    page.locator("#number-wave_height").fill("40")
    page.wait_for_selector(".wrong")
    assert in_sight(".wrong")
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    page.locator("#number-wave_height").fill("4")
    page.wait_for_selector(".wrong", state="detached")
