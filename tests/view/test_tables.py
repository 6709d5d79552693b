"""Tables of commands as files: what stands in them, what they refuse."""

import csv
import json

import numpy as np
import pytest
import xarray as xr

import quartering as qt
from quartering.view.console import files, tables
from quartering.view.console.printed import table
from quartering.view.plots.branch import branch_picture
from quartering.view.plots.trace import trace_picture

SMALL_MAP = ["--speed", "0.2Fn", "--headings", "0:180:4", "--wave-lengths", "0.6L,1L,2L"]


def blocks_of(path):
    """The tables of a .csv: title -> rows, the head first."""
    found, title = {}, ""
    for row in csv.reader(path.read_text().splitlines()):
        if row and row[0].startswith("# ") and not found.get(title):
            title = ",".join(row)[2:] if title not in found else title
            found.setdefault(title, [])
        elif row and row[0].startswith("# "):
            title = ",".join(row)[2:]
            found[title] = []
        elif row:
            found[title].append(row)
    return found


def test_hydrostatics_of_a_csv_are_those_of_the_wigley_form(run, tmp_path):
    assert run("hull", "wigley", "-o", "h.csv").exit_code == 0
    blocks = blocks_of(tmp_path / "h.csv")
    (name,) = (title for title in blocks if "hydrostatics" in title)
    values = {row[0]: float(row[1]) for row in blocks[name][1:]}
    hull = qt.ship("wigley").hull
    # closed forms: volume 4/9 LBT, waterplane 2/3 LB; five figures are printed
    volume, area = 4 / 9 * hull.length * hull.beam * hull.draught, 2 / 3 * hull.length * hull.beam
    assert values["displacement"] == pytest.approx(1.025 * volume, rel=1e-4)
    assert values["tonnes per centimetre TPC"] == pytest.approx(1025 * area / 1e5, rel=1e-4)
    assert values["LCB from AP, + forward"] == pytest.approx(hull.length / 2, rel=1e-4)
    (arm,) = (title for title in blocks if "righting arm" in title)
    assert blocks[arm][0] == ["heel [deg]", "GZ [m]"]
    assert len(blocks[arm]) == 1 + 61


def test_a_map_in_csv_has_a_line_a_condition_with_the_values_of_the_library(run, tmp_path):
    assert run("polar", "wigley", *SMALL_MAP, "-o", "map.csv").exit_code == 0
    assert [path.name for path in tmp_path.iterdir()] == ["map.csv"]
    lines = [line for line in (tmp_path / "map.csv").read_text().splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    ship = qt.ship("wigley")
    waves = [qt.Wave(length, length / 50) for length in (60.0, 100.0, 200.0)]
    ds = qt.polar(ship, waves, ["0.2Fn"], [0.0, 60.0, 120.0, 180.0])
    assert len(rows) == ds["verdict"].size == 12
    for row in rows:
        there = {"heading": float(row["heading [deg]"]), "wave_length": float(row["wave_length [m]"])}
        cell = ds.isel(speed=0).sel(there)
        expected = float(cell["roll_peak"])
        assert (float(row["roll_peak [deg]"]) if row["roll_peak [deg]"] else np.nan) == pytest.approx(
            expected, nan_ok=True
        )


def test_a_workbook_has_the_same_data_and_the_printed_tables_beside_it(run, tmp_path):
    openpyxl = pytest.importorskip("openpyxl", reason="workbooks need the extra `excel`")
    assert run("polar", "wigley", *SMALL_MAP, "-o", "map.csv").exit_code == 0
    assert run("polar", "wigley", *SMALL_MAP, "-o", "map.xlsx").exit_code == 0
    book = openpyxl.load_workbook(tmp_path / "map.xlsx")
    printed, data = book.worksheets
    assert printed["A2"].value == "speed"
    lines = [line for line in (tmp_path / "map.csv").read_text().splitlines() if not line.startswith("#")]
    head, *rows = csv.reader(lines)
    assert [cell.value for cell in data[2]] == head
    assert len(rows) == 12
    for row, cells in zip(rows, data.iter_rows(min_row=3, values_only=True), strict=False):
        for text, cell in zip(row, cells, strict=True):
            expected = tables.cell_value(text)  # Excel keeps 15 figures
            assert (cell or "") == expected if isinstance(expected, str) else cell == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize(
    "words",
    [
        ["ships"],
        ["coefficients", "wigley"],
        ["duffing", "--frequency", "0.8,1.2"],
        ["vary", "wigley", "--gm", "0.4:1:3"],
        ["forces", "wigley", "--wave-lengths", "1L"],
        ["verdict", "wigley", "--heading", "60", "--speed", "5", "--wave-length", "1L", "--wave-height", "1"],
    ],
    ids=lambda words: words[0],
)
def test_every_table_goes_to_a_file_and_is_named(run, tmp_path, words):
    result = run(*words, "-o", "t.csv")
    assert result.exit_code == 0
    assert "Wrote t.csv" in result.stdout
    (first, *_) = (rows for rows in blocks_of(tmp_path / "t.csv").values() if rows)
    assert len(first) > 2
    assert len({len(row) for row in first}) == 1


def test_points_of_branches_are_kept_as_a_dataset(run, tmp_path):
    words = ["--heading", "60", "--speed", "5", "--wave-length", "1L", "--wave-height", "1", "--harmonics", "1"]
    facts = json.loads(run("branch", "wigley", *words, "-o", "b.nc", "--json").stdout)
    with xr.open_dataset(tmp_path / "b.nc") as ds:
        assert ds.sizes["point"] == sum(curve["points"] for curve in facts["curves"])
        assert float(ds["roll_peak"].max()) == pytest.approx(max(c["largest_roll_deg"] for c in facts["curves"]))


def test_more_rows_than_excel_has_are_refused_and_nothing_is_written(run, tmp_path, monkeypatch):
    pytest.importorskip("openpyxl", reason="workbooks need the extra `excel`")
    monkeypatch.setattr(tables, "MOST_ROWS", 5)
    result = run("polar", "wigley", *SMALL_MAP, "-o", "map.xlsx")
    assert result.exit_code == 2
    assert "has 12 rows; a sheet of Excel ends at 5; write a .csv" in result.stderr
    assert list(tmp_path.iterdir()) == []


def test_without_openpyxl_a_workbook_is_refused_before_the_work(run, monkeypatch):
    monkeypatch.setattr(files, "find_spec", lambda _name: None)
    result = run("hull", "wigley", "-o", "h.xlsx")
    assert result.exit_code == 2
    assert 'pip install "quartering[excel]"' in result.stderr
    assert '"h.csv"' in result.stderr


def test_a_text_that_looks_like_a_formula_stays_a_text(tmp_path):
    openpyxl = pytest.importorskip("openpyxl", reason="workbooks need the extra `excel`")
    hostile = table("=1+1: [a]/*?", ("=2+2", "n"), [("=3+3\x07", "4")])
    tables.write_tables(tmp_path / "t.xlsx", [hostile, hostile], [])
    book = openpyxl.load_workbook(tmp_path / "t.xlsx")
    first, second = book.worksheets
    assert [cell.data_type for cell in (first["A1"], first["A2"], first["A3"], first["B3"])] == ["s", "s", "s", "n"]
    assert first.title != second.title


def test_a_picture_of_branches_marks_the_value_that_was_asked():
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.2, "K_p": -0.04}
    ds = qt.branch(qt.Model(np.eye(3), terms, 1.0, (0, 0.1, 0), (0, 0, 0)), limits=(0.8, 1.5), harmonics=1)

    def lines(asked):
        curve = branch_picture(ds, "frequency", "Duffing", asked=asked).axes[0]
        return [line.get_xdata()[0] for line in curve.lines if str(line.get_label()).startswith("asked")]

    assert lines(1.1) == [1.1]
    assert lines(3.0) == lines(None) == []


def test_the_axis_of_a_capsize_ends_at_the_capsize():
    ship = qt.ship("series60-cb60")
    model = qt.equations(ship, qt.Wave(ship.hull.length, 4.0), speed=8.0, heading=60.0)
    trace = qt.simulate(model, 300.0, (0.0, np.radians(30.0), np.radians(60.0), 0.0))
    lost = trace.attrs["capsize_time"]
    assert 0.0 < lost < 100.0
    assert trace_picture(trace, None, "", "").axes[-1].get_xlim()[1] == pytest.approx(lost, rel=0.02)
