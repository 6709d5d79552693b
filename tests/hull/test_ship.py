"""Ships, ship files, and what is said when one cannot be right."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from quartering.conventions import InputError
from quartering.hull.file.new import write_ship
from quartering.hull.file.read import LIBRARY, available_ships, ship
from quartering.hull.hydrostatics import hydrostatics
from quartering.units import quantity, split_quantity

pytestmark = pytest.mark.quick

SHIPS = [entry.name for entry in available_ships()]
STATIONS = ("offsets", "stations")


def test_the_library_holds_the_thirteen_ships_each_with_one_line_about_it() -> None:
    assert {entry.name for entry in available_ships()} == {
        "series60-cb60", "series60-cb65", "series60-cb70", "series60-cb75", "series60-cb80", "s175", "wigley", "box",
        "dtmb5415", "dtc", "mariner", "coaster-90m", "fishing-30m",
    }  # fmt: skip
    assert all(10 < len(entry.description) < 90 for entry in available_ships())


@pytest.mark.parametrize("name", SHIPS)
def test_every_value_of_a_built_in_ship_says_where_it_comes_from(name: str) -> None:
    notes = ship(name).provenance
    for key in ("lines", "gyradius_roll", "gyradius_yaw", "roll_damping", "water_density", "drag_coefficient"):
        assert notes[key].split(":")[0] in ("published", "derived", "assumed", "estimated"), key
    assert {notes["gm"].split(":")[0], notes["kg"].split(":")[0]} in ({"assumed", "derived"}, {"published", "derived"})


@pytest.mark.parametrize(("name", "volume"), [("coaster-90m", 5647.0), ("fishing-30m", None)])
def test_invented_ships_say_so_and_have_the_particulars_they_were_invented_with(
    name: str, volume: float | None
) -> None:
    """Authority: the particulars that came with the lines (volume to 1 m3; none came with the fishing vessel)."""
    made = ship(name)
    entry = next(entry for entry in available_ships() if entry.name == name)
    assert "nvented" in entry.description
    assert "no real ship" in entry.description
    assert "invented" in made.name
    assert made.provenance["lines"].startswith("assumed: invented")
    assert LIBRARY.joinpath(f"{name}.yaml").read_text().splitlines()[0].count("INVENTED") == 1
    if volume is not None:
        assert hydrostatics(made).volume == pytest.approx(volume, abs=1.0)
        assert made.loading.gm == pytest.approx(0.64, abs=0.005)


@pytest.mark.parametrize("name", SHIPS)
def test_gm_and_kg_of_every_ship_are_tied_by_km(name: str) -> None:
    loading = ship(name).loading
    assert loading.gm + loading.kg == pytest.approx(hydrostatics(ship(name)).km)
    assert hydrostatics(ship(name)).gm == pytest.approx(loading.gm)


def test_s175_has_the_loading_of_the_veres_input() -> None:
    loading = ship("s175").loading
    assert (loading.kg, loading.gyradius_roll, loading.gyradius_yaw) == (9.55, 8.331, 42.0)


def test_series60_has_the_default_loading_in_beams_and_lengths() -> None:
    parent = ship("series60-cb60")
    assert parent.loading.gm == pytest.approx(0.05 * 16.256)
    assert parent.loading.gyradius_roll == pytest.approx(0.35 * 16.256)
    assert parent.loading.gyradius_yaw == pytest.approx(0.25 * 121.92)
    assert parent.loading.roll_damping == 0.05


@given(st.floats(0.01, 3.0))
def test_changing_gm_moves_g_and_leaves_the_first_ship_alone(gm: float) -> None:
    parent = ship("series60-cb60")
    changed = parent.with_(gm=gm)
    assert changed.loading.gm == gm
    assert changed.loading.kg == pytest.approx(hydrostatics(parent.hull).km - gm)
    assert parent.loading.gm == pytest.approx(0.8128)
    assert changed.with_(kg=changed.loading.kg).loading.gm == pytest.approx(gm)


def test_with_takes_units_multipliers_and_the_choice_of_derivatives() -> None:
    parent = ship("series60-cb60")
    changed = parent.with_(gyradius_roll="0.38 B", linear="strip", factors={"K_ppp": 0.5}).with_(factors={"Y_v": 2.0})
    assert changed.loading.gyradius_roll == pytest.approx(0.38 * 16.256)
    assert dict(changed.multipliers) == {"K_ppp": 0.5, "Y_v": 2.0}
    again = changed.with_(factors={"K_ppp": 0.5, "Y_v": 1.0})
    assert dict(again.multipliers) == {"K_ppp": 0.25, "Y_v": 2.0}
    assert (changed.linear, parent.linear) == ("strip", "default")
    assert changed.provenance["gyradius_roll"].startswith("given")


def test_another_draught_keeps_g_and_finds_the_new_gm() -> None:
    parent = ship("s175")
    lighter = parent.with_(draught=8.5)
    assert lighter.hull.draught == 8.5
    assert lighter.loading.kg == pytest.approx(9.55)
    assert lighter.loading.gm == pytest.approx(hydrostatics(lighter.hull).km - 9.55)
    assert lighter.hull.design_draught == 9.5


def test_values_left_alone_keep_their_provenance() -> None:
    parent = ship("series60-cb60")
    assert dict(parent.with_(factors={"K_ppp": 2}).provenance) == dict(parent.provenance)


def test_mappings_of_a_ship_cannot_be_written_to() -> None:
    with pytest.raises(TypeError):
        ship("box").multipliers["K_ppp"] = 2.0  # type: ignore[index]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"gm": 0.0}, ["gm = 0 m", "above 0", "0.05 B"]),
        ({"gm": -0.3}, ["gm = -0.3 m", "above 0"]),
        ({"gm": float("nan")}, ["gm", "nan"]),
        ({"kg": 9.0}, ["kg = 9 m", "KM = 6.55", "above 0"]),
        ({"gm": 1.0, "kg": 5.0}, ["gm", "kg", "both"]),
        ({"gyradius_roll": 0.0}, ["gyradius_roll = 0 m", "above 0", "0.35 B"]),
        ({"gyradius_yaw": "-1 L"}, ["gyradius_yaw", "above 0", "0.25 L"]),
        ({"gyradius_roll": "6 furlong"}, ["furlong", "m, mm", "B"]),
        ({"draught": -1.0}, ["draught = -1 m", "above 0"]),
        ({"draught": 30.0}, ["draught = 30 m", "at most 9.75"]),
        ({"roll_damping": 5.0}, ["roll_damping = 5", "0 to 1"]),
        ({"linear": "stripp"}, ["stripp", '"default"', '"strip"']),
        ({"factors": {"K_pppp_": 0.5}}, ["K_pppp_", "K_ppp"]),
        ({"factors": {"Kppp": 0.5}}, ["Kppp", '"K_ppp"']),
        ({"factors": {"K_ppp": float("inf")}}, ["K_ppp", "finite"]),
    ],
)
def test_a_change_that_cannot_be_right_is_refused_in_one_message(change: dict[str, Any], words: list[str]) -> None:
    with pytest.raises(InputError) as refusal:
        ship("series60-cb60").with_(**change)
    for word in ["Series 60, CB 0.60", *words]:
        assert word in str(refusal.value)
    assert "\n" not in str(refusal.value)


def _written(folder: Path, data: dict[str, Any] | str) -> Path:
    file = folder / "my.yaml"
    file.write_text(data if isinstance(data, str) else yaml.safe_dump(data))
    return file


def _series60(*path: Any, value: Any = None) -> dict[str, Any]:
    """The built-in file of Series 60, CB 0.60, with one entry changed."""
    data: dict[str, Any] = copy.deepcopy(yaml.safe_load((LIBRARY / "series60-cb60.yaml").read_text()))
    at: Any = data
    for key in path[:-1]:
        at = at[key]
    at[path[-1]] = value
    return data


BASE = "base: series60-cb60\n"


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (BASE + "lenght: 100 m", ["lenght is unknown", "did you mean length", "Keys allowed"]),
        (BASE + "loading: {gyradius_rol: 5 m}", ["gyradius_rol is unknown", "did you mean gyradius_roll"]),
        (BASE + "draught: -3 m", ["draught = -3 m", "above 0", "6.5 m"]),
        (BASE + "beam: 0", ["beam = 0", "above 0"]),
        (BASE + "draught: 20 m", ["draught = 20 m", "at most 9.7536 m"]),
        (BASE + "length: .nan", ["length", "nan", "finite"]),
        (BASE + "length: true", ["length", "True"]),
        (BASE + "length: twelve", ["length", "twelve"]),
        (BASE + "loading: {gm: .nan}", ["loading, gm", "nan", "finite"]),
        (BASE + "loading: {gm: -0.2 m}", ["gm = -0.2 m", "above 0", "0.05 B"]),
        (BASE + "loading: {gyradius_roll: 0}", ["gyradius_roll = 0 m", "above 0", "0.35 B"]),
        (BASE + "loading: {gm: 3 furlong}", ["furlong", "units allowed", "m, mm"]),
        (BASE + "loading: {kg: 9 m}", ["kg = 9 m", "KM = 6.55", "above 0"]),
        (BASE + "loading: {kg: 5 m, gm: 1 m}", ["gm and kg", "leave one out"]),
        (BASE + "loading: {gm: {value: 1 m, status: guessed}}", ["guessed", "'assumed'"]),
        (BASE + "loading: 3", ["loading", "gm, kg"]),
        (BASE + "loading: {water_density: -1}", ["water_density", "1025"]),
        (BASE + "loading: {roll_damping: 5}", ["roll_damping = 5", "0 to 1"]),
        (BASE + "linear: stripes", ["stripes", '"strip"']),
        (BASE + "factors: {Kppp: 1}", ["Kppp", '"K_ppp"']),
        (BASE + "factors: {K_ppp: .nan}", ["K_ppp", "nan", "finite"]),
        (BASE + "coefficients: {K_pp_: 1}", ["K_pp_"]),
        (BASE + "drag_coefficient: -1", ["drag_coefficient = -1", "0.8"]),
        (BASE + "velocity_scale: 0 m/s", ["velocity_scale = 0", "above 0"]),
        (BASE + "shape: box", ["`shape`", "`base`"]),
        (BASE + "depth: 2 m", ["depth = 2 m", "6.5"]),
        ("base: series60\n", ["series60", "series60-cb60", "wigley"]),
        ("length: 100 m\nbeam: 10 m", ["`draught`", "missing"]),
        ("length: 100 m\nbeam: 10 m\ndraught: 4 m", ["no lines", "offsets"]),
        ("[1, 2]", ["list of keys"]),
        ("", ["list of keys"]),
        ("a: [", ["line 2", "key: value"]),
        (_series60(*STATIONS, 4, "half_breadths", 3, value=-0.2), ["station 2 ", "waterline 4", "-0.2", "0 or more"]),
        (_series60(*STATIONS, 4, "half_breadths", 3, value=float("nan")), ["station 5", "waterline 4", "nan"]),
        (_series60(*STATIONS, 4, "half_breadths", 3, value="abc"), ["waterline 4", "abc", "a number"]),
        (_series60(*STATIONS, 4, "half_breadths", 3), ["station 2 ", "blank"]),
        (_series60(*STATIONS, 4, "x", value=0.1), ["x = 0.1", "one way"]),
        (_series60(*STATIONS, 4, "heights", value=[0, 1]), ["station 2 ", "8 half breadths for 2 heights"]),
        (_series60(*STATIONS, 4, "halfbreadths", value=[0, 1]), ["half_breadths"]),
        (
            _series60("offsets", "waterlines", value=[0, 0.25, 0.075, 0.5, 0.75, 1, 1.25, 1.5]),
            ["station 19.5", "waterline 3", "0.075 T", "0.25 T", "cross"],
        ),
        (_series60("offsets", "waterlines"), ["heights", "waterlines"]),
        (_series60("offsets", "unit", value="ft"), ["ft", "'LBT'"]),
        (_series60("offsets", "unit", value="m"), ["reach over 1 m", "121.92 m", "check the unit"]),
        (_series60("offsets", "stations", value=[]), ["stations", "4"]),
    ],
)
def test_a_ship_file_that_cannot_be_right_is_refused_in_one_message(
    tmp_path: Path, content: dict[str, Any] | str, words: list[str]
) -> None:
    file = _written(tmp_path, content)
    with pytest.raises(InputError) as refusal:
        ship(file)
    for word in ["my.yaml", *words]:
        assert word in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_a_name_that_is_no_ship_is_answered_with_the_nearest() -> None:
    with pytest.raises(InputError, match='did you mean "series60-cb60"'):
        ship("series60-cb6")
    with pytest.raises(InputError, match="neither a file nor a built-in ship"):
        ship("no/such/file.yaml")


def test_length_alone_scales_a_base_ship_with_its_loading(tmp_path: Path) -> None:
    half = ship(_written(tmp_path, "base: s175\nlength: 87.5 m"))
    whole = ship("s175")
    assert (half.hull.beam, half.hull.draught) == pytest.approx((12.7, 4.75))
    assert hydrostatics(half).volume == pytest.approx(hydrostatics(whole).volume / 8)
    assert half.loading.gm == pytest.approx(whole.loading.gm / 2, rel=1e-5)
    assert half.loading.gyradius_roll == pytest.approx(whole.loading.gyradius_roll / 2, rel=1e-5)
    assert half.provenance["gyradius_roll"].startswith("derived")
    assert "stretched" in half.provenance["dimensions"]


def test_a_base_ship_can_be_stretched_floated_and_loaded(tmp_path: Path) -> None:
    text = """
    base: series60-cb60
    name: my ship
    length: 150 m
    beam: 0.15 L
    design_draught: 0.35 B
    draught: 7 m
    loading: {gm: {value: 1.1 m, status: published, source: inclining test}, gyradius_roll: 0.4 B, roll_damping: 8 %}
    coefficients: {K_ppp: -2.0e8}
    multipliers: {Y_v: 1.2}
    linear: strip
    drag_coefficient: 0.9
    """
    mine = ship(_written(tmp_path, text))
    assert (mine.hull.length, mine.hull.beam, mine.hull.design_draught, mine.hull.draught) == pytest.approx(
        (150, 22.5, 7.875, 7)
    )
    assert (mine.loading.gm, mine.loading.gyradius_roll, mine.loading.roll_damping) == pytest.approx((1.1, 9.0, 0.08))
    assert mine.loading.gyradius_yaw == pytest.approx(0.25 * 150)
    assert (dict(mine.overrides), dict(mine.multipliers)) == ({"K_ppp": -2.0e8}, {"Y_v": 1.2})
    assert (mine.name, mine.linear, mine.drag_coefficient) == ("my ship", "strip", 0.9)
    assert mine.provenance["gm"] == "published: 1.1 m; inclining test"
    assert mine.provenance["K_ppp"].startswith("given")


@pytest.mark.parametrize("order", [1, -1])
def test_own_offsets_in_metres_may_run_either_way(tmp_path: Path, order: int) -> None:
    stations = [{"x": x, "heights": [0, 0, 6], "half_breadths": [0, 5, 5]} for x in (-30, -10, 10, 30)][::order]
    data = {
        "name": "barge",
        "length": "60 m",
        "beam": 10,
        "draught": "0.4 B",
        "offsets": {"unit": "m", "stations": stations},
    }
    barge = ship(_written(tmp_path, data))
    assert barge.name == "barge"
    assert hydrostatics(barge).volume == pytest.approx(60 * 10 * 4)
    assert barge.provenance["gm"].startswith("assumed")


@pytest.mark.parametrize("name", SHIPS)
def test_the_starting_file_of_a_ship_reads_back_as_that_ship(tmp_path: Path, name: str) -> None:
    file = write_ship(name, tmp_path / "my.yaml")
    mine, own = ship(file), ship(name)
    for key in ("gm", "kg", "gyradius_roll", "gyradius_yaw", "roll_damping", "density"):
        assert getattr(mine.loading, key) == pytest.approx(getattr(own.loading, key), rel=1e-9)
    assert hydrostatics(mine.hull).volume == pytest.approx(hydrostatics(own.hull).volume, rel=1e-9)
    values = [line for line in file.read_text().splitlines() if ":" in line and not line.lstrip().startswith("#")]
    assert all("#" in line for line in values if line.split(":")[0] not in ("name", "loading"))


def test_a_starting_file_never_overwrites_and_starts_from_a_built_in_ship(tmp_path: Path) -> None:
    write_ship("box", tmp_path / "my.yaml")
    with pytest.raises(InputError, match="exists"):
        write_ship("box", tmp_path / "my.yaml")
    with pytest.raises(InputError, match="cannot be written"):
        write_ship("box", tmp_path / "no" / "my.yaml")
    with pytest.raises(InputError, match='did you mean "box"'):
        write_ship("boxx", tmp_path / "other.yaml")


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [  # definitions: 1 kn = 1852 m/h, 1 ft = 0.3048 m
        ("18 kn", "speed", 18 * 1852 / 3600),
        ("0.38 B", "length", 7.6),
        ("1.2L", "length", 120.0),
        ("2*T", "length", 10.0),
        ("0.25 Fn", "speed", 0.25 * (9.81 * 100) ** 0.5),
        ("8500 t", "mass", 8.5e6),
        ("400 ft", "length", 121.92),
        ("15 deg", "angle", 15.0),
        ("5 %", "ratio", 0.05),
        ("-1.5e2 m", "length", -150.0),
        (3, "time", 3.0),
        ("1 min", "time", 60.0),
        ("1.025 t/m3", "density", 1025.0),
    ],
)
def test_values_with_units_read_as_si(text: str | float, kind: Any, value: float) -> None:
    assert quantity(text, kind, length=100.0, beam=20.0, draught=5.0) == pytest.approx(value)


@given(st.floats(allow_nan=False, allow_infinity=False, width=32))
def test_a_number_survives_being_written_with_a_unit(number: float) -> None:
    assert split_quantity(f"{number!r} m") == (number, "m")


@pytest.mark.parametrize("text", ["", "m", "4,5 m", "1 2 m", ".nan m", "nan", "inf m", True, None, [1.0]])
def test_what_is_not_a_value_is_refused(text: Any) -> None:
    with pytest.raises(InputError):
        quantity(text, "length")


def test_a_copied_ship_file_keeps_saying_what_is_assumed(tmp_path: Path) -> None:
    """A value repeated from the built-in ship keeps its status; one that is changed becomes the file's own."""
    from quartering.hull.file.new import write_ship

    file = write_ship("series60-cb60", tmp_path / "my.yaml")
    assert ship(file).provenance["gyradius_roll"].startswith("assumed")
    assert ship(file).provenance["gm"].startswith("assumed")
    file.write_text(file.read_text().replace("gyradius_roll: 5.6896 m", "gyradius_roll: 6.1 m"))
    assert ship(file).provenance["gyradius_roll"].startswith("given")
    assert ship(file).provenance["gm"].startswith("assumed")
