"""The report: its numbers are those of the result, it needs nothing from outside, and it refuses what it cannot use."""

import re
import sys
import zlib
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

import quartering as qt
from quartering.hull.file.read import ship
from quartering.stability.kind import Kind
from quartering.study.condition.failure_events import failure_events
from quartering.study.condition.first_failure import STEEPNESSES, first_failure
from quartering.view.cli import app
from quartering.view.report import failure_modes, report_html
from quartering.view.report import guidance as report_of_guidance
from quartering.view.report import page as report_of_page
from quartering.view.report.conditions import sensitivities, worst_conditions
from quartering.view.report.failure_modes import criteria_section
from quartering.view.report.guidance import guidance
from quartering.view.report.page import guidance_page, report_page, write_pdf
from quartering.view.report.pictures import inline_svg, map_svgs, pictures_for
from quartering.view.report.source import Source, report_source

SHIP = ship("series60-cb60")
LENGTH = SHIP.hull.length


@pytest.fixture(scope="module")
def result() -> xr.Dataset:
    waves = [qt.Wave(ratio * LENGTH, ratio * LENGTH / 30) for ratio in (0.6, 1.0, 1.4)]
    return qt.polar(SHIP, waves, [5.0, 7.5], [0.0, 30.0, 60.0, 90.0, 180.0])


@pytest.fixture(scope="module")
def page(result) -> str:
    return report_html(SHIP, result)


@pytest.fixture(scope="module")
def heights() -> xr.Dataset:
    return qt.sweep(SHIP, [5.0, 8.0], [30.0, 60.0, 90.0], [0.8 * LENGTH, LENGTH], [2.0, 6.0, 12.0])


@pytest.fixture
def unpictured(monkeypatch) -> None:
    """A report as it is but for its pictures, which take half the time, where a test reads words alone."""
    monkeypatch.setattr(report_of_page, "hull_svg", lambda _: "")
    monkeypatch.setattr(report_of_page, "map_svgs", lambda _: [])
    monkeypatch.setattr(report_of_guidance, "guidance_picture", lambda *_: None)
    monkeypatch.setattr(report_of_guidance, "inline_svg", lambda *_: "")


class Sources(HTMLParser):
    """Every address a browser would fetch, and the text outside of styles and scripts."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.fetched: list[str] = []
        self.text: list[str] = []
        self._inside: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self._inside.append(tag)
        if tag in ("link", "iframe", "object", "embed", "base"):
            self.fetched.append(tag)
        self.fetched += [
            value or ""
            for name, value in attributes
            if name in ("src", "href", "xlink:href", "data", "srcset", "action")
            and not (value or "").startswith(("#", "data:image/"))
        ]

    def handle_endtag(self, _tag):
        if self._inside:
            self._inside.pop()

    def handle_data(self, data):
        if not self._inside or self._inside[-1] not in ("style", "script"):
            self.text.append(data)


def words(page: str) -> str:
    return " ".join(" ".join(Sources(page).text).split())


def test_worst_roll_and_least_margin_are_those_of_the_dataset(page, result):
    text = words(page)
    assert f"Largest roll of all: {float(result['roll_peak'].max()):.3g} deg" in text
    assert f"{float(result['exponent'].max()):+.4f}" in text


def test_sentences_are_those_of_the_verdict(page, result):
    worst = worst_conditions(Source(SHIP, result, "", ""), "margin")[0].place
    wave = qt.Wave(worst["wave_length"], worst["wave_height"])
    model = qt.equations(SHIP, wave, worst["speed"], worst["heading"])
    verdict = qt.stability(model, qt.steady_motion(model, start="rest"))
    assert verdict.sentence in words(page)


def test_hydrostatics_and_coefficients_are_those_of_the_ship(page):
    text = words(page)
    floats = qt.hydrostatics(SHIP)
    assert f"displaced volume {floats.volume:.5g} m3" in text
    for name, source in (("Y_v", "Clarke"), ("C_D", "strip by strip")):
        assert re.search(rf"{name} -?[\d.e+]+ .{{0,40}}estimated: [^.]*{source}", text), name


def test_estimated_values_are_marked_and_derived_ones_are_not(page):
    marked = re.findall(r'<tr class="marked"><td[^>]*>([^<]*)</td>', page)
    assert {"GM", "Y_v", "C_D"} <= set(marked)
    assert not {"KG", "Y_vdot", "m"} & set(marked)


def test_page_says_where_it_comes_from(page, result):
    text = words(page)
    for part in (result.attrs["heading_convention"], result.attrs["reference_point"], "Haddara", "fingerprint"):
        assert part in text
    assert SHIP.provenance["lines"].split(".")[0] in text


@pytest.mark.usefixtures("unpictured")
def test_the_failure_modes_are_a_section_where_a_service_speed_is_told(result, monkeypatch):
    """Each number is that of `qt.criteria`; nothing is claimed, and an estimate is marked."""
    one = ship("series60-cb60").with_(propulsion="estimated")
    found = qt.criteria(one, 8.0)
    monkeypatch.setattr(failure_modes, "criteria", lambda ship, speed: {(one, 8.0): found}[ship, speed])
    made = criteria_section(one, 8.0)
    assert made.sentence == found.sentence
    assert len(made.table.rows) == 10
    for row in made.table.rows:
        assert row.cells[3] in {judgement.reason for judgement in found.judgements}
    c1 = next(row.cells[4] for row in made.table.rows if row.cells[:2] == ("parametric rolling", "2"))
    assert f"c1 {found.value('parametric_rolling.level2.c1'):.3g}" in c1
    assert any("estimated" in note for note in made.notes)
    assert "no compliance" in made.form
    assert "Intact stability" not in report_page(Source(SHIP, result, "", ""))
    page = report_page(Source(one, result, "", ""), 8.0)
    assert "<h2>Intact stability</h2>" in page
    assert "parametric rolling" in page


def test_pages_fetch_nothing(page, result):
    for one in (page, guidance_page(Source(SHIP, result, "", ""), None)):
        assert Sources(one).fetched == []
        assert "@import" not in one
        assert [address for address in re.findall(r"url\(([^)]*)\)", one) if not address.startswith("#")] == []


def test_pictures_on_a_page_do_not_share_names(page):
    named = [set(re.findall(r'\bid="([^"]+)"', svg)) for svg in re.findall(r"<svg.*?</svg>", page, re.DOTALL)]
    assert len(named) == 2
    assert not named[0] & named[1]
    used = set(re.findall(r"url\(#([^)]*)\)", page)) | set(re.findall(r'href="#([^"]*)"', page))
    assert used <= named[0] | named[1]


def test_text_from_files_is_escaped(result):
    from dataclasses import replace

    nasty = replace(SHIP, name="<script>alert(1)</script>", provenance={"lines": "<img src=x onerror=alert(1)>"})
    page = report_html(nasty, result.assign_attrs(ship=nasty.name, loading='"><svg onload=alert(1)>'))
    assert "<script>alert" not in page
    assert "<img" not in page
    assert "<svg onload" not in page
    assert "&lt;script&gt;alert(1)" in page


@pytest.mark.soak
def test_fingerprint_changes_with_the_ship_and_not_from_run_to_run(page, result):
    def mark(text: str) -> str:
        return re.search(r"<dt>fingerprint</dt><dd>(\w+)</dd>", text)[1]

    assert mark(page) == mark(report_html(SHIP, result))
    assert mark(page) != mark(report_html(SHIP.with_(gm=0.9), result))


def test_sensitivities_name_the_strongest_first(result):
    source = Source(SHIP, result, "", "")
    found = sensitivities(source, worst_conditions(source, "roll")[0])
    rolls, rates = (np.abs([row[i] for row in found.rows]) for i in (2, 3))
    share = rolls / rolls.max() + rates / rates.max()
    assert (np.diff(share) <= 1e-12).all()


@pytest.mark.usefixtures("unpictured")
def test_failure_event_is_roll_beyond_the_least_angle(heights):
    """40 deg for a ship that rights itself beyond, the openings where they go under sooner."""
    source = Source(SHIP, heights, "", "")
    assert guidance(source, None).limit == 40.0
    assert guidance(source, 22.0).limit == 22.0
    assert guidance(source, 60.0).limit == 40.0
    failed = failure_events(heights, 22.0)
    roll = heights["roll_peak"]
    assert bool(failed.where(roll > 22.0, True).all())
    assert not bool(failed.where(roll <= 22.0, False).any())
    beyond = heights["status"] == 6  # BEYOND_CAPSIZE_LIMIT, where roll is NaN
    assert bool(failed.where(beyond, True).all())
    assert int(failed.sum()) == int((roll > 22.0).sum()) + int(beyond.sum())


@pytest.mark.usefixtures("unpictured")
def test_guidance_has_a_sheet_for_every_wave_height_and_claims_nothing(heights):
    page = guidance_page(Source(SHIP, heights, "", ""), 22.0)
    text = words(page)
    for height in (2, 6, 12):
        assert f"Wave height {height} m" in text
    assert "Prepared in the form of operational guidance (MSC.1/Circ.1627)" in text
    assert "complies" not in text
    assert "complian" not in text
    assert "Roll beyond 22 deg" in text
    share = float(failure_events(heights, 22.0).isel(wave_height=2, wave_length=1).mean())
    assert f"{float(heights['roll_peak'].isel(wave_height=2, wave_length=1).max()):.1f} {100 * share:.1f} %" in text


@pytest.mark.usefixtures("unpictured")
def test_a_stored_map_finds_its_ship_again(tmp_path, result, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result.to_netcdf("map.nc")
    source = report_source("map.nc", None, "report")
    assert source.ship.name == SHIP.name
    assert source.harmonics == 1
    assert source.form == "stf"
    made = CliRunner().invoke(app, ["report", "map.nc", "--json"])
    assert made.exit_code == 0, made.output
    assert f"{float(result['roll_peak'].max()):.3g} deg" in words((tmp_path / "map-report.html").read_text())


@pytest.mark.usefixtures("unpictured")
def test_report_of_a_ship_file_and_of_a_sweep(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run = CliRunner().invoke
    assert run(app, ["new", "series60-cb60", "my.yaml"]).exit_code == 0
    changed = re.sub(r"^gm: [^#\n]*", "gm: 1.1 m   ", (tmp_path / "my.yaml").read_text(), flags=re.MULTILINE)
    changed = re.sub(r"^(\s+)gm: [^#\n]*", r"\1gm: 1.1 m   ", changed, flags=re.MULTILINE)
    (tmp_path / "my.yaml").write_text(changed)
    mine = ship("my.yaml")
    assert mine.loading.gm == 1.1
    conditions = ["--speed", "7.5", "--headings", "60,90", "--wave-lengths", "1L,1.2L,1.4L"]
    assert run(app, ["polar", "my.yaml", *conditions, "-o", "mine.nc"]).exit_code == 0
    made = run(app, ["report", "mine.nc", "-o", "mine.html"])
    assert made.exit_code == 0, made.output
    assert "1.1 m" in words((tmp_path / "mine.html").read_text())
    qt.sweep(mine, 7.5, [60.0, 90.0], 100.0, [1.0, 2.0], store="kept")
    refused = run(app, ["report", "kept"])
    assert refused.exit_code == 2
    assert "--ship" in refused.output
    assert run(app, ["report", "kept", "--ship", "my.yaml", "-o", "kept.html"]).exit_code == 0
    other = run(app, ["report", "kept", "--ship", "wigley"])
    assert other.exit_code == 2
    assert "is not the one of" in other.output


@pytest.mark.usefixtures("unpictured")
@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ("autopilot: {gain: 1.0, rate_gain: 8 s}", "autopilot none, there gain 1, rate gain 8 s, lag 0 s"),
        ("righting: polynomial", "righting curve spline, there polynomial"),
    ],
)
def test_a_map_is_reported_with_its_own_autopilot_and_righting_curve_only(tmp_path, monkeypatch, keys, says):
    """The two change the motion and stand in no other line of the record."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "plain.yaml").write_text("base: wigley\nname: Mine\n")
    (tmp_path / "mine.yaml").write_text(f"base: wigley\nname: Mine\n{keys}\n")
    mine = ship("mine.yaml")
    qt.polar(mine, qt.Wave(100.0, 1.0), [5.0], [60.0, 90.0]).to_netcdf("map.nc")
    with pytest.raises(qt.InputError, match=f"plain.yaml.* is not the one of .*{says}"):
        report_source("map.nc", "plain.yaml", "report")
    source = report_source("map.nc", "mine.yaml", "report")
    assert (source.ship.autopilot, source.ship.righting) == (mine.autopilot, mine.righting)
    assert says.partition("there ")[2] in words(report_html(mine, source.result))


@pytest.mark.usefixtures("unpictured")
def test_a_sweep_that_replaces_the_roll_damping_is_reported_with_the_ship_it_began_from(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    qt.sweep(SHIP, 5.0, [60.0], 100.0, 1.0, bilge_keel_length=[30.0], bilge_keel_breadth=[0.3], store="keels")
    source = report_source("keels", None, "report")
    assert source.ship.name == SHIP.name
    assert "K_p|p|" in source.result.attrs["estimated_coefficients"]
    text = words(report_html(source.ship, source.result))
    assert "bilge keel breadth 0.3 m" in text


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["nothing.nc"], "there is no"),
        (["wigley", "--form", "novel"], "give report or guidance"),
        (["wigley", "--openings", "30"], "--form guidance"),
        (["wigley", "--form", "guidance", "--openings", "-5"], "above 0"),
        (["wigley", "-o", "page.docx"], ".html or .pdf"),
        (["no-such-ship"], "no-such-ship"),
    ],
)
def test_bad_input_is_refused_in_one_message(tmp_path, monkeypatch, arguments, says):
    monkeypatch.chdir(tmp_path)
    refused = CliRunner().invoke(app, ["report", *arguments])
    assert refused.exit_code == 2
    assert says in refused.output
    assert list(tmp_path.iterdir()) == []


def test_what_is_no_map_is_refused(tmp_path):
    xr.Dataset({"a": ("x", [1.0])}).to_netcdf(tmp_path / "other.nc")
    with pytest.raises(qt.InputError, match="not a result"):
        report_source(str(tmp_path / "other.nc"), None, "report")


def test_guidance_needs_several_speeds_and_one_loading(result, heights):
    with pytest.raises(qt.InputError, match="two speeds"):
        guidance(Source(SHIP, result.isel(speed=[0]), "", ""), None)
    with pytest.raises(qt.InputError, match="one loading"):
        guidance(Source(SHIP, heights.expand_dims("loading"), "", ""), None)


def unpacked(stream: bytes) -> bytes:
    try:
        return zlib.decompress(stream)
    except zlib.error:
        return b""


@pytest.mark.soak
def test_pdf_has_pages(tmp_path, page):
    try:
        write_pdf(page, tmp_path / "page.pdf")
    except qt.InputError as refusal:
        pytest.skip(str(refusal))
    written = (tmp_path / "page.pdf").read_bytes()
    assert written.startswith(b"%PDF-")
    assert len(written) < 1_000_000
    parts = [written, *(unpacked(part) for part in re.findall(rb"stream\r?\n(.*?)\r?\nendstream", written, re.DOTALL))]
    assert max(int(count) for part in parts for count in re.findall(rb"/Count (\d+)", part)) >= 4


def test_pdf_without_its_library_is_refused_with_what_to_do(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "weasyprint", None)
    with pytest.raises(qt.InputError, match=r"pip install 'quartering\[pdf\]'"):
        write_pdf("<p>page</p>", tmp_path / "page.pdf")
    assert list(tmp_path.iterdir()) == []


def test_svg_keeps_its_own_references():
    from matplotlib.figure import Figure

    figure = Figure()
    figure.subplots().plot([0, 1], [0, 1])
    svg = inline_svg(figure, "a line")
    names = set(re.findall(r'\bid="([^"]+)"', svg))
    assert set(re.findall(r"url\(#([^)]*)\)", svg)) <= names
    assert "http://purl.org" not in svg


def lettered():
    """A figure with a word on it."""
    from matplotlib.figure import Figure

    figure = Figure()
    figure.text(0.1, 0.5, "roll resonance")
    return figure


def test_letters_of_pictures_stay_letters_in_pdf_and_are_outlines_in_html(tmp_path):
    with pictures_for(Path("page.html")):
        assert "<text" not in inline_svg(lettered(), "a word")
    with pictures_for(Path("page.pdf")):
        svg = inline_svg(lettered(), "a word")
    assert re.search(r"<text[^>]*>roll resonance</text>", svg)
    assert "<use" not in svg
    write_pdf(f"<!DOCTYPE html>{svg}", tmp_path / "page.pdf")
    written = (tmp_path / "page.pdf").read_bytes()
    parts = [written, *(unpacked(part) for part in re.findall(rb"stream\r?\n(.*?)\r?\nendstream", written, re.DOTALL))]
    assert any(b"DejaVu" in part for part in parts)  # the font is in the file


def unstable_everywhere(result):
    """A result whose every cell is hatched, which a page has to carry."""
    changed = result.copy(deep=True)
    changed["verdict"][:] = int(Kind.ROLL)
    changed["verdict"][..., 1] = int(Kind.COURSE_IN_CALM_WATER)
    return changed


def test_a_page_full_of_hatched_cells_is_a_small_pdf(tmp_path):
    waves = [qt.Wave(ratio * LENGTH, ratio * LENGTH / 30) for ratio in np.linspace(0.4, 2.3, 10)]
    result = unstable_everywhere(qt.polar(SHIP, waves, [5.0, 7.5], np.arange(0.0, 181.0, 10.0)))
    svg = map_svgs(result)[0]
    # a hatch for the unstable cells and one for the course-unstable ones, and those of the key: however many cells
    assert svg.count("<pattern") == 4
    # one path on each side of each of two panels
    assert len(re.findall(r'id="[^"]*unstable"', svg)) == 4
    write_pdf(f"<!DOCTYPE html>{svg}", tmp_path / "map.pdf")
    assert (tmp_path / "map.pdf").stat().st_size < 400_000


def test_the_first_page_answers_with_the_steps_of_a_loading(page, result):
    text = words(page)
    first = text[text.index("In short") : text.index("Roll and stability over headings")]
    assert first.count("as it is") == 2  # at the largest roll, and at the first failure
    for change in ("GM +0.1 m", "GM -0.1 m", "bilge keels", "speed +2 kn", "speed -2 kn"):
        assert first.count(change) == 2 + (change == "bilge keels") * first.count("no bilge keels"), change
    worst = worst_conditions(Source(SHIP, result, "", ""), "roll")[0].place
    wave = qt.Wave(worst["wave_length"], worst["wave_height"])
    for change, one in (("GM +0.1 m", SHIP.with_(gm=SHIP.loading.gm + 0.1)), ("as it is", SHIP)):
        motion = qt.steady_motion(qt.equations(one, wave, worst["speed"], worst["heading"]), start="rest")
        assert f"{change} {np.degrees(motion.peak[1]):.1f} " in first
    assert text.count("Course in calm water, rudder amidships") == 1
    assert text.index("Appendix") > text.index("The worst conditions")
    assert text.index("Appendix") < text.index("Y_r is the hydrodynamic one")


def test_the_first_failure_is_found_in_the_lowest_waves():
    limit = 40.0
    lengths, headings = np.array([0.8, 1.4, 2.0]) * LENGTH, [30.0, 60.0, 90.0]
    found = first_failure(SHIP, [5.0], headings, lengths, limit)
    assert found is not None
    for steepness in STEEPNESSES:
        ds = qt.sweep(SHIP, [5.0], headings, lengths, steepness=steepness)
        kinds = ds["verdict"].values
        bad = (kinds > Kind.STABLE) & (kinds != Kind.COURSE_IN_CALM_WATER)
        bad |= failure_events(ds, limit).values
        assert bad.any() == (steepness == found.steepness)
        if bad.any():
            assert (found.failing, found.conditions) == (int(bad.sum()), bad.size)
            assert found.wave_height == pytest.approx(steepness * found.wave_length)
            return
    pytest.fail("no steepness failed")


@pytest.mark.soak
def test_no_wave_of_guidance_is_left_undrawn():
    lengths = np.linspace(0.5, 2.0, 8) * LENGTH
    ds = qt.sweep(SHIP, [5.0, 8.0], [30.0, 90.0], lengths, [2.0, 4.0])
    found = guidance(Source(SHIP, ds, "", ""), None)
    assert found.left_out == ""
    titles = [title for title, _ in found.sheets]
    assert len(titles) == 4
    assert titles[1].endswith("sheet 2 of 2")
    drawn = " ".join(str(svg) for _, svg in found.sheets)
    assert len(set(re.findall(r"<!-- wave length ([\d.]+) m", drawn))) == 8


def test_on_a_phone_a_row_names_its_columns(page):
    assert 'data-head="largest roll [deg]"' in page
    assert "content: attr(data-head)" in page
