"""Two ships or loadings over one map, and the loading cases of a file as a booklet."""

import json

import numpy as np
import pytest
import xarray as xr

import quartering as qt
from quartering.conventions import InputError
from quartering.stability.kind import Kind
from quartering.study.maps.compare import Change, OnlyOne, map_difference
from quartering.view.plots.difference_map import difference_map

AXES = ["--speed", "5", "--headings", "30:150:5", "--wave-lengths", "80,120,160", "--steepness", "1/25"]
WAVES = [qt.Wave(length, length / 25) for length in (80.0, 120.0, 160.0)]
HEADINGS = [30.0, 60.0, 90.0, 120.0, 150.0]
CASES = "loadings:\n  ballast: {draught: 0.8 T, gm: 1.2 m}\n  departure: {gm: 0.4 m}\n"


@pytest.fixture
def loaded(run, tmp_path):
    """A ship file with loading cases."""

    def written(cases):
        (tmp_path / "my.yaml").unlink(missing_ok=True)
        assert run("new", "wigley", "my.yaml").exit_code == 0
        text = (tmp_path / "my.yaml").read_text()
        (tmp_path / "my.yaml").write_text(f"{text}\n{cases}")
        return "my.yaml"

    return written


def test_the_difference_is_that_of_two_maps_of_the_library(run, tmp_path):
    result = run("polar", "wigley", "box", *AXES, "-o", "two.nc")
    assert result.exit_code == 0
    assert (tmp_path / "two.png").stat().st_size > 20_000
    first, second = (qt.polar(qt.ship(name), WAVES, [5.0], HEADINGS) for name in ("wigley", "box"))
    with xr.open_dataset(tmp_path / "two.nc") as ds:
        expected = second["roll_peak"].values - first["roll_peak"].values
        np.testing.assert_allclose(ds["roll_difference"].values, expected, rtol=1e-12, equal_nan=True)
        assert list(ds["ship"].values) == [qt.ship("wigley").name, qt.ship("box").name]
    assert "of other sizes" in result.stdout
    assert "Side by side" in result.stdout


def test_a_change_of_the_verdict_is_told_and_course_instability_of_calm_water_is_none():
    first = qt.polar(qt.ship("wigley"), WAVES, [5.0], HEADINGS)
    second = first.copy(deep=True)
    first["verdict"][:], second["verdict"][:] = int(Kind.STABLE), int(Kind.STABLE)
    second["verdict"][0, 0, 0] = first["verdict"][0, 1, 1] = int(Kind.ROLL)
    second["verdict"][0, 2, 2] = int(Kind.COURSE_IN_CALM_WATER)
    second["verdict"][0, 3, 0] = int(Kind.NO_ANSWER)
    ds = map_difference([first, second], ["a", "b"])
    change = ds["change"].values[0]
    assert (change[0, 0], change[1, 1], change[2, 2], change[3, 0]) == (
        Change.UNSTABLE, Change.STABLE, Change.NONE, Change.UNKNOWN,
    )  # fmt: skip
    assert np.count_nonzero(change) == 3
    figure = difference_map(ds, 100.0, "b less a", "")
    hatched = {c.get_gid(): c.get_hatch() for axes in figure.axes for c in axes.collections if c.get_gid()}
    assert set(hatched) == {"unstable", "course", "no answer"}
    assert hatched["unstable"] != hatched["course"]


def test_a_ship_that_alone_capsizes_on_the_way_is_marked_and_both_doing_it_is_no_difference():
    first = qt.polar(qt.ship("wigley"), WAVES, [5.0], HEADINGS)
    second = first.copy(deep=True)
    for one in (first, second):
        one["capsizes_on_the_way"][:] = 0
    first["capsizes_on_the_way"][0, 0, 0] = second["capsizes_on_the_way"][0, 0, 0] = 3
    first["capsizes_on_the_way"][0, 1, 1] = second["capsizes_on_the_way"][0, 2, 2] = 1
    ds = map_difference([first, second], ["a", "b"])
    expected = np.zeros((5, 3))
    expected[1, 1], expected[2, 2] = OnlyOne.FIRST, OnlyOne.SECOND
    np.testing.assert_array_equal(ds["only_one_capsizes"].values[0], expected)
    drawn = [line for axes in difference_map(ds, 100.0, "b less a", "").axes for line in axes.lines if line.get_gid()]
    marks = {str(line.get_gid()): line.get_marker() for line in drawn if "alone capsizes" in str(line.get_gid())}
    assert len(marks) == len(set(marks.values())) == 2  # told apart by their form


def test_maps_over_other_conditions_are_not_compared():
    first = qt.polar(qt.ship("wigley"), WAVES, [5.0], HEADINGS)
    with pytest.raises(InputError, match="heading"):
        map_difference([first, qt.polar(qt.ship("wigley"), WAVES, [5.0], [0.0, *HEADINGS[1:]])], ["a", "b"])


def test_a_loading_case_stands_beside_the_ship_and_both_are_named(run, loaded):
    facts = json.loads(run("polar", loaded(CASES), "ballast", *AXES, "--json").stdout)
    name = qt.ship("my.yaml").name
    assert facts["ships"] == [name, f"{name}, ballast"]
    ballast = qt.polar(qt.ship("my.yaml").with_(loading_case="ballast"), WAVES, [5.0], HEADINGS)
    assert facts["summaries"][1][0]["worst_roll"] == pytest.approx(float(ballast["roll_peak"].max()))


def test_a_booklet_has_a_line_a_case_with_its_loading_and_largest_roll(run, loaded):
    facts = json.loads(run("booklet", loaded(CASES), *AXES, "--json").stdout)
    assert [case["case"] for case in facts["cases"]] == ["as it stands", "ballast", "departure"]
    ship = qt.ship("my.yaml")
    ballast, departure = facts["cases"][1:]
    assert ballast["draught"] == pytest.approx(0.8 * ship.hull.draught)
    assert departure["gm"] == pytest.approx(0.4)
    alone = qt.polar(ship.with_(gm=0.4), WAVES, [5.0], HEADINGS)
    assert departure["largest_roll_deg"] == pytest.approx(float(alone["roll_peak"].max()))
    assert run("booklet", "my.yaml", *AXES, "-o", "book.csv").exit_code == 0


def test_cases_that_are_one_loading_and_names_given_twice_are_told(run, loaded):
    same = "loadings:\n  departure: {gm: 0.4 m}\n  arrival: {gm: 0.4 m}\n"
    assert "departure and arrival are one loading" in " ".join(run("booklet", loaded(same), *AXES).stdout.split())
    twice = run("booklet", loaded("loadings:\n  ballast: {gm: 0.4 m}\n  ballast: {gm: 0.9 m}\n"), *AXES)
    assert twice.exit_code == 2
    assert "ballast is given twice" in twice.stderr


@pytest.mark.parametrize(
    ("words", "hint"),
    [
        (["polar", "wigley", "wigley"], "one ship, loaded alike"),
        (["polar", "wigley", "nothing"], "neither a file nor a built-in ship"),
        (["polar", "wigley", "box", "--extend"], "are of one map"),
        (["booklet", "wigley"], "has no loading cases; name some"),
    ],
)
def test_what_cannot_be_compared_is_one_message(run, words, hint):
    result = run(*words)
    assert result.exit_code == 2
    assert hint in result.stderr
    assert result.stderr.count("\n") == 1


def test_ships_of_one_name_are_told_apart_by_their_files(run, loaded, tmp_path):
    loaded("")
    (tmp_path / "other.yaml").write_text((tmp_path / "my.yaml").read_text().replace("gm: 0.5", "gm: 0.6"))
    result = run("polar", "my.yaml", "other.yaml", *AXES)
    assert result.exit_code == 0, result.stderr
    assert "Both are called" in result.stdout
    assert "(other)" in result.stdout
