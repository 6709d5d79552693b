"""The case file: units, ranges and comments; every mistake is answered with its line, the limit and the nearest word."""

import json
from pathlib import Path

import numpy as np
import pytest
import yaml

import quartering as qt
from quartering.study.case.new import SCHEMA, starting_case
from quartering.study.case.read import case_grid, case_schema
from quartering.study.maps.sweep import fill

pytestmark = pytest.mark.quick

START = starting_case("series60-cb60")
LENGTH = qt.ship("series60-cb60").hull.length


def _case(tmp_path, *changes):
    text = START
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    file = tmp_path / "my.yaml"
    file.write_text(text)
    return file


def test_the_starting_case_is_a_case_with_a_comment_on_every_line(tmp_path):
    made = case_grid(_case(tmp_path))
    assert made.shape == (4, 3, 37, 20, 3)
    np.testing.assert_allclose(made.axes["speed"], np.array([0.15, 0.2, 0.25]) * np.sqrt(9.81 * LENGTH))
    np.testing.assert_allclose(made.axes["wave_length"][[0, -1]], [0.4 * LENGTH, 2.3 * LENGTH])
    assert made.loadings["gm"].tolist() == [0.6, 0.8, 1.0, 1.2]
    assert all("#" in line for line in START.splitlines())
    assert made.text == START


@pytest.mark.parametrize(
    ("typed", "values"),
    [
        ("0..18 kn step 6", np.array([0, 6, 12, 18]) * 1852 / 3600),
        ("0..18 kn step 7 kn", np.array([0, 7, 14]) * 1852 / 3600),
        ("2..4 m/s count 5", [2.0, 2.5, 3.0, 3.5, 4.0]),
        ("7.5", [7.5]),
        ("[0, 3 m/s, 4..5 step 0.5]", [0.0, 3.0, 4.0, 4.5, 5.0]),
        ("0.1..0.3 m/s step 0.1", [0.1, 0.2, 0.3]),  # rounding does not lose the last
        ("1e0..2e0 step 1", [1.0, 2.0]),
    ],
)
def test_values_lists_and_ranges_with_units(tmp_path, typed, values):
    made = case_grid(_case(tmp_path, ("speed: 0.15..0.25 Fn step 0.05", f"speed: {typed}")))
    np.testing.assert_allclose(made.axes["speed"], values, rtol=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("0.25 Fn step 0.05", "18 knt step 1", r'line 4: speed = .*unit "knt".*did you mean "kn"'),
        ("speed: 0.15", "sped: 0.15", r"line 4: sped is unknown; did you mean speed"),
        ("speed: 0.15..0.25 Fn step 0.05", "", r"key `speed` is missing"),
        ("0..180 deg step 5", "180..0 deg step 5", r"line 5: heading: the range .* is empty"),
        ("0..180 deg step 5", "0..180 deg step 0", r"line 5: heading: the step"),
        ("0..180 deg step 5", "0..180 deg step 1e-9", r"line 5: heading: .* more than 100,000 values"),
        ("0..180 deg step 5", "0..180 deg", r"line 5: heading: .* is not a range"),
        ("0..180 deg step 5", "east", r"line 5: heading = 'east'; that is no finite number"),
        ("0..180 deg step 5", "[0, .nan]", r"line 5: heading"),
        ("0..180 deg step 5", "{a: 1}", r"line 5: heading"),
        ("0..180 deg step 5", "[0, 5", r"line \d: .*write `key: value`"),
        ("speed:", "heading: 3\nspeed:", r"line 6: heading is given twice \(first in line 4\)"),
        ("[1 m, 2 m, 3 m]", "[1 m, 30 m]", r"line 7: .*1/7"),
        ("[1 m, 2 m, 3 m]", "[]", r"line 7: wave_height: the list is empty"),
        ("  gm: [0.6", "  kg: 6 m\n  gm: [0.6", r"line 9: gm and kg"),
        ("  gm: [0.6", "  gmm: [0.6", r"line 9: gmm is unknown; did you mean gm"),
        ("  gm: [0.6", "  gm: [-0.6", r"line 9: gm = -0.6 m; it is above 0 m"),
        ("form: stf", "form: sft", r"line 13: form: 'sft' is given; did you mean 'stf'"),
        ("ship: series60-cb60", "ship: series60-cb61", r"line 3: .*did you mean"),
        ("harmonics: 1", "harmonics: 2", r"line 12: harmonics"),
        ("harmonics: 1 ", "factors: {K_ppx: 2} ", r"line 12: .*K_ppx.*nearest"),
        ("harmonics: 1 ", "coefficients: {K_ppp: 2} ", r"line 12: coefficients is not taken.*factors.*values"),
        ("speed: 0.15..0.25 Fn step 0.05", "speed: -3", r"line 4: speed = -3 m/s; it is from 0"),
    ],
)
def test_a_mistake_is_answered_with_its_line(tmp_path, old, new, message):
    with pytest.raises(qt.InputError, match=message) as refusal:
        case_grid(_case(tmp_path, (old, new)))
    assert "my.yaml" in str(refusal.value)


def test_a_ship_file_beside_the_case_is_found(tmp_path):
    (tmp_path / "own.yaml").write_text("base: series60-cb60\nname: Own\n")
    made = case_grid(_case(tmp_path, ("ship: series60-cb60 ", "ship: own.yaml ")))
    assert made.ship.name == "Own"


def test_no_file_and_no_keys(tmp_path):
    with pytest.raises(qt.InputError, match="cannot be read"):
        case_grid(tmp_path / "none.yaml")
    (tmp_path / "text.yaml").write_text("just words")
    with pytest.raises(qt.InputError, match="a list of keys"):
        case_grid(tmp_path / "text.yaml")


def test_the_shipped_schema_is_that_of_the_code():
    assert SCHEMA.read_text() == case_schema(), "write case_schema() to case.schema.json"
    schema = json.loads(case_schema())
    assert "description" in schema["properties"]["speed"]
    assert set(yaml.safe_load(START)) <= set(schema["properties"])
    assert Path(START.splitlines()[0].split("=")[1]).exists()


def test_a_comment_does_not_make_another_case_but_a_value_does(tmp_path):
    small = (
        ("0.15..0.25 Fn step 0.05", "5"), ("0..180 deg step 5", "[30, 60]"), ("0.4..2.3 L count 20", "1 L"),
        ("[0.6 m, 0.8 m, 1.0 m, 1.2 m]", "0.9"),
    )  # fmt: skip
    fill(case_grid(_case(tmp_path, *small)), tmp_path / "s")
    assert json.loads((tmp_path / "s" / "case.json").read_text())["text"].startswith("# yaml-language-server")
    fill(case_grid(_case(tmp_path, *small, ("# A study", "# My study"))), tmp_path / "s")
    with pytest.raises(qt.InputError, match="another case: wave_height"):
        fill(case_grid(_case(tmp_path, *small, ("3 m]", "4 m]"))), tmp_path / "s")
