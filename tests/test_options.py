"""The table of options reaches every door, and every door refuses in the same words."""

import importlib.util
import inspect
import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import quartering as qt
from quartering.hull.told import number
from quartering.hydro.damping.natural_roll import free_roll
from quartering.option_checks import Refused, checked
from quartering.options import OPTIONS, line_of, loading_axes, ship_options
from quartering.study.case.read import case_grid
from quartering.view.cli import app
from quartering.view.console.ship_options import command_options
from quartering.view.explorer.hulls.ship_registry import ShipRegistry
from quartering.view.explorer.service.calls import VerdictCall

ROOT = Path(__file__).parents[1]
S60 = qt.ship("series60-cb60")
NUMBERS = [one for one in ship_options() if one.numeric]
CONDITIONS = ["speed", "heading", "wave_length", "wave_height", "wave_period"]
WAYS = ["range", "unit", "word"]


def script():
    spec = importlib.util.spec_from_file_location("write_options", ROOT / "tools" / "write_options.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def wrong(one, way):
    """A value that cannot be, as text every door takes."""
    unit = "" if one.unit == "1" else f" {one.unit}"
    if way == "unit":
        return "3 furlong"
    if way == "word":
        return "abc"
    if one.low is not None and not one.above and one.kind != "length":
        return f"-90000{unit}" if one.low >= 0 else f"-9e9{unit}"
    return f"-1{unit}" if one.above else f"-1e9{unit}"


def words_of(one, given, sizes=S60.sizes):
    with pytest.raises(Refused) as refusal:
        checked(one, given, sizes=sizes)
    return refusal.value.words


def told(one, given):
    """An option as `with_` and the command line take it: a part by its group, with parts that can be."""
    if not one.group:
        return one.name, given
    whole = {part.path[-1]: part.usual for part in OPTIONS.values() if part.group == one.group}
    return one.group, {**whole, one.path[-1]: given}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("one", NUMBERS, ids=lambda one: one.name)
def test_python_and_files_refuse_an_option_in_the_same_words(one, way, tmp_path):
    """The words are those of the table; the file adds its name and the line."""
    given = wrong(one, way)
    words = words_of(one, given)
    name, value = told(one, given)
    with pytest.raises(qt.InputError) as of_python:
        S60.with_(**{name: value})
    assert str(of_python.value) == f"{S60.name}: {words}"
    text = json.dumps(value) if isinstance(value, dict) else value
    inner = f"loading:\n  {name}: {text}" if one.place == "loading" else f"\n{name}: {text}"
    file = tmp_path / "my.yaml"
    file.write_text(f"base: series60-cb60\n{inner}\n")
    with pytest.raises(qt.InputError) as of_file:
        qt.ship(file)
    begin = words.partition("units allowed")[0]  # of a dimension, L, B and T are not known yet
    assert f"{file}, line 3: " in str(of_file.value)
    assert begin in str(of_file.value)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("one", [one for one in command_options() if one.numeric], ids=lambda one: one.name)
def test_the_command_line_refuses_an_option_in_the_same_words(one, way):
    given = wrong(one, way)
    answer = CliRunner().invoke(app, ["hull", "series60-cb60", f"{one.command}={given}"])
    assert (answer.exit_code, answer.output.strip()) == (2, f"quartering: {one.command}: {words_of(one, given)}")


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", loading_axes())
def test_studies_cases_and_the_service_refuse_an_option_in_the_same_words(name, way, tmp_path):
    one = OPTIONS[name]
    given = wrong(one, way)
    words = words_of(one, given)
    beside = {"bilge_keel_length": 30.0, "bilge_keel_breadth": 0.3} if one.group else {}
    with pytest.raises(qt.InputError) as of_sweep:
        qt.sweep(S60, 5.0, 30.0, 100.0, 1.0, **{**beside, name: given})
    file = tmp_path / "case.yaml"
    at = "ship: series60-cb60\nspeed: 5\nheading: 30\nwave_length: 1 L\nwave_height: 1\nloading:\n"
    file.write_text(f"{at}  {name}: {given}\n")
    with pytest.raises(qt.InputError) as of_case:
        case_grid(file)
    call = {"ship": "series60-cb60", "speed": 5, "heading": 30, "wave_length": 100, "wave_height": 1}
    with pytest.raises(qt.InputError) as of_service:
        VerdictCall(**call, **{**beside, name: given}).loaded(ShipRegistry())
    assert words in str(of_sweep.value)
    assert words in str(of_service.value)
    assert str(of_case.value) == f"{file}, line 7: {words}"


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", CONDITIONS)
def test_a_condition_is_refused_in_the_same_words(name, way, tmp_path):
    one = OPTIONS[name]
    given = wrong(one, way)
    words = words_of(one, given)
    right = {"speed": "5", "heading": "30", "wave_length": "100", "wave_height": "1"}
    asked = {**right, name: given}
    if name == "wave_period":
        del asked["wave_length"]
    typed = [f"{OPTIONS[key].command}={text}" for key, text in asked.items()]
    answer = CliRunner().invoke(app, ["verdict", "series60-cb60", *typed])
    assert (answer.exit_code, answer.output.strip()) == (2, f"quartering: {one.command}: {words}")
    with pytest.raises(qt.InputError) as of_python:
        qt.sweep(S60, **asked)
    assert str(of_python.value) == words
    file = tmp_path / "case.yaml"
    file.write_text("\n".join(["ship: series60-cb60", *(f"{key}: {text}" for key, text in asked.items())]))
    with pytest.raises(qt.InputError, match=r"line \d") as of_case:
        case_grid(file)
    assert words in str(of_case.value)
    with pytest.raises(qt.InputError) as of_one:
        number(S60, name, given)
    assert str(of_one.value) == words


@pytest.mark.parametrize("value", [float("nan"), float("inf"), True, [1.0], {}])
def test_what_is_no_finite_number_is_refused(value):
    with pytest.raises(qt.InputError, match=r"openings = .*no finite number"):
        S60.with_(openings=value)


def test_an_unknown_option_is_answered_with_the_nearest_one(tmp_path):
    with pytest.raises(qt.InputError, match=r"gyradius_rol is unknown; did you mean gyradius_roll\?"):
        S60.with_(gyradius_rol=5.0)
    file = tmp_path / "my.yaml"
    file.write_text("base: box\nopnings: 40 deg\n")
    with pytest.raises(qt.InputError, match=r"line 2: opnings is unknown; did you mean openings\?"):
        qt.ship(file)
    answer = CliRunner().invoke(app, ["hull", "box", "--opnings", "40"])
    assert (answer.exit_code, answer.output.strip()) == (2, "quartering: opnings is unknown; did you mean openings?")


@pytest.mark.parametrize(
    ("both", "words"),
    [
        ({"gm": 1.0, "kg": 5.0}, "gm and kg are both given"),
        ({"gyradius_roll": 6.0, "roll_period": 12.0}, "gyradius_roll and roll_period are both given"),
        ({"bilge_keels": (30, 0.3), "bilge_keel_area": 20.0}, "bilge_keels and bilge_keel_area are both given"),
        ({"rudder": (20, 1.8), "rudder_area": 20.0}, "rudder_area is given beside rudder"),
    ],
)
def test_two_options_that_say_one_thing_are_refused(both, words):
    with pytest.raises(qt.InputError, match=words):
        S60.with_(**both)


def test_a_key_given_twice_in_a_file_is_refused_with_its_line(tmp_path):
    file = tmp_path / "my.yaml"
    file.write_text("base: box\nopenings: 40 deg\nopenings: 30 deg\n")
    with pytest.raises(qt.InputError, match=r"line 3: openings is given twice"):
        qt.ship(file)


def test_a_likely_slip_is_named():
    """1.025 is a density in t/m3, 5 a damping in per cent, 6500 a length in millimetres."""
    for option, value, slip in (
        ("water_density", 1.025, "did you mean 1.025 t/m3?"),
        ("roll_damping", 5, "did you mean 5 %?"),
        ("gyradius_roll", 6500.0, "did you mean 6500 mm?"),
        ("heading", 400, "did you mean 40 deg?"),
    ):
        assert slip in words_of(OPTIONS[option], value)


def test_factors_multiply_and_values_give():
    name = "N_r"
    own = {e.name: e.value for e in qt.coefficients(S60, 0.5, 5.0).table()}[name]

    def now(ship):
        return {e.name: e.value for e in qt.coefficients(ship, 0.5, 5.0).table()}[name]

    assert now(S60.with_(factors={name: 0.5})) == pytest.approx(0.5 * own, rel=1e-14)
    assert now(S60.with_(values={name: -2e8})) == -2e8
    assert now(S60.with_(factors={name: 0.5}).with_(values={name: -2e8})) == -2e8  # a value given starts anew
    assert now(S60.with_(values={name: -2e8}).with_(factors={name: 0.5})) == -1e8
    at = {"speed": 5.0, "heading": 60.0, "wave_length": 100.0, "wave_height": 1.0}
    swept = qt.sweep(S60, **at, values={name: [-2e8, -1e8]}, factors={"Y_v": 2.0})
    alone = qt.sweep(S60.with_(values={name: -1e8}, factors={"Y_v": 2.0}), **at)
    assert swept["N_r_value"].attrs["units"] == "kg m2/s"
    np.testing.assert_allclose(swept["roll"].values[1], alone["roll"].values, rtol=1e-12)


def test_the_word_that_meant_two_things_is_refused_with_the_two_that_mean_one():
    with pytest.raises(qt.InputError, match=r"coefficients is not taken.*factors.*values"):
        S60.with_(coefficients={"K_ppp": 0.5})
    with pytest.raises(qt.InputError, match=r"coefficients is not taken.*factors.*values"):
        qt.sweep(S60, 5.0, 30.0, 100.0, 1.0, coefficients={"K_ppp": 0.5})


@pytest.mark.parametrize("period", [9.0, "12 s", "0.25 min"])
def test_a_roll_period_gives_the_radius_of_gyration_with_which_the_ship_rolls_so(period):
    """Authority: the natural frequency found by a search for a root, for the radius found in closed form."""
    seconds = {9.0: 9.0, "12 s": 12.0, "0.25 min": 15.0}[period]
    made = S60.with_(roll_period=period)
    assert 2 * math.pi / free_roll(made).frequency == pytest.approx(seconds, rel=1e-9)
    assert "natural roll period" in made.provenance["gyradius_roll"]
    assert S60.with_(gm=1.2, roll_period=period).loading.gm == 1.2


def test_a_roll_period_no_loading_gives_is_refused():
    for period in (1.0, 100.0):
        with pytest.raises(qt.InputError, match=r"roll_period = .*; try \d"):
            S60.with_(roll_period=period)


def test_a_wave_may_be_given_by_its_period():
    """Deep water: lambda = g T^2 / (2 pi), [Lewis89] ch. VIII."""
    length = 9.81 * 9.0**2 / (2 * math.pi)
    for wave in (qt.Wave(period=9.0, height=2), qt.Wave("9 s", "2 m"), qt.Wave(period="0.15 min", height="200 cm")):
        assert (wave.length, wave.height) == (pytest.approx(length, rel=1e-14), 2.0)
    at = {"speed": 5.0, "heading": 60.0, "wave_height": 1.0}
    by_period, by_length = qt.sweep(S60, **at, wave_period="9 s"), qt.sweep(S60, **at, wave_length=length)
    np.testing.assert_allclose(by_period["roll"], by_length["roll"], rtol=1e-12)
    with pytest.raises(qt.InputError, match="both given"):
        qt.Wave(100.0, 2.0, period=9.0)


def test_numbers_may_be_text_with_a_unit_in_python():
    wave = qt.Wave("1.2L", "0.02 L", ship=S60)
    assert wave == qt.Wave(1.2 * S60.hull.length, 0.02 * S60.hull.length)
    with pytest.raises(qt.InputError, match=r'"L" is of a ship, and none is known here.*ship=ship'):
        qt.Wave("1.2L", 2.0)
    knots = 15 * 1852 / 3600
    text, si = qt.equations(S60, wave, "15kn", "1 rad"), qt.equations(S60, wave, knots, math.degrees(1.0))
    assert text.frequency == pytest.approx(si.frequency, rel=1e-14)
    forces = qt.wave_forces(S60, wave, ["10kn", "15kn"], "60 deg")
    np.testing.assert_allclose(forces["speed"], [10 * 1852 / 3600, knots])
    assert S60.with_(kg="5.1 m").loading.kg == S60.with_(kg=5.1).loading.kg
    calm = qt.hydrodynamics(S60, [0.6], speed="0.2Fn")
    np.testing.assert_allclose(
        calm.damping, qt.hydrodynamics(S60, [0.6], 0.2 * math.sqrt(9.81 * S60.hull.length)).damping
    )


def test_what_a_ship_is_told_is_recorded_with_where_it_comes_from(tmp_path):
    file = tmp_path / "my.yaml"
    file.write_text(
        "base: series60-cb60\ndepth: 1.6 T\ndatum: keel\nopenings: {value: 40 deg, status: published, source: plan 12}\n"
        "highest_position: {x: 40 m, height: 25 m}\nwindage: {area: 900 m2, lever: 9 m}\nbilge_keel_area: 20 m2\n"
        "propulsion: {diameter: 0.6 T, k0: 0.45, k1: -0.28, r2: 20e3}\nloading: {gyradius_pitch: 0.24 L}\n"
        "loadings: {ballast: {draught: 5.5 m, gm: 1.2 m}, departure: {kg: 5.5 m, roll_period: 11 s, roll_damping: 0.03}}\n"
    )
    one = qt.ship(file)
    assert one.value("depth") == pytest.approx(1.6 * 6.5024)
    assert one.value("openings") == 40.0
    assert one.value("windage") == {"area": 900.0, "lever": 9.0}
    assert one.value("windage_lever") == 9.0
    assert one.value("propeller_diameter") == pytest.approx(0.6 * 6.5024)
    assert (one.value("propellers"), one.value("resistance_2"), one.value("resistance_5")) == (1.0, 20e3, 0.0)
    assert one.provenance["openings"] == "published: 40 deg; plan 12"
    assert S60.value("gyradius_pitch") == 0.25 * S60.hull.length
    assert one.value("gyradius_pitch") == 0.24 * S60.hull.length
    ballast, departure = one.with_(loading_case="ballast"), one.with_(loading_case="departure", roll_damping=0.1)
    assert (ballast.hull.draught, ballast.loading.gm) == (5.5, 1.2)
    assert (departure.loading.kg, departure.loading.roll_damping) == (5.5, 0.1)
    assert 2 * math.pi / free_roll(departure).frequency == pytest.approx(11.0)
    assert ballast.provenance["gm"] == "given: loading case ballast"
    answer = CliRunner().invoke(app, ["hull", str(file)])
    assert "heel at which unprotected openings" in answer.output
    assert "plan 12" in " ".join(answer.output.split())
    with pytest.raises(qt.InputError, match="did you mean ballast"):
        one.with_(loading_case="balast")


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ("estimate", "did you mean estimated"),
        ({"diameter": 4.0, "k0": 0.45, "k1": -0.28}, "r0 to r5 are all 0"),
        (
            {"diameter": 4.0, "k0": 0.45, "k1": -0.28, "r2": 2e4, "propellers": 1.5},
            "propellers = 1.5; it is a whole number",
        ),
        ({"k0": 0.45}, "diameter is missing"),
    ],
)
def test_propulsion_that_drives_nothing_is_refused(given, words):
    with pytest.raises(qt.InputError, match=words):
        S60.with_(propulsion=given)


def test_propulsion_may_be_given_as_a_record_by_key_or_as_text():
    driven = qt.Propulsion((0, 0, 2e4), 4.0, 0.15, 0.25, (0.45, -0.28, -0.12))
    text = S60.with_(propulsion="4,0.45,-0.28,-0.12,0.15,0.25,1,0,0,20e3")
    assert S60.with_(propulsion=driven).value("propulsion") == text.value("propulsion") == driven.parts
    assert S60.with_(propulsion="estimated").value("propeller_diameter") is None


def test_bilge_keels_beside_a_method_that_does_not_allow_for_them_are_refused(tmp_path):
    file = tmp_path / "my.yaml"
    file.write_text("base: series60-cb60\nbilge_keels: {length: 0.25 L, breadth: 0.02 B}\n")
    with pytest.raises(
        qt.InputError, match=r"line 2: bilge_keels = 30.48 x 0.3251 m act in .*write roll_damping: ikeda"
    ):
        qt.ship(file)
    file.write_text(file.read_text() + "loading: {roll_damping: ikeda}\n")
    assert qt.ship(file).bilge_keels == pytest.approx((30.48, 0.32512))
    with pytest.raises(qt.InputError, match="write roll_damping: ikeda"):
        S60.with_(bilge_keels=(30.0, 0.3))


def test_with_reaches_every_option():
    """What `Ship.with_` takes is what the table has, for `help` and for type checkers alike."""
    names = {one.name for one in ship_options()}
    signature = inspect.signature(qt.Ship.with_)
    assert set(signature.parameters) - {"self"} == names
    assert all(f"{one.name} : " in qt.Ship.with_.__doc__ for one in ship_options())
    from quartering.hull.option_types import ShipOptions

    assert set(ShipOptions.__annotations__) == names


def test_a_ship_stretched_in_python_is_the_one_a_file_stretches(tmp_path):
    file = tmp_path / "my.yaml"
    file.write_text("base: series60-cb60\nlength: 100 m\nbeam: 15 m\ndesign_draught: 6 m\n")
    made, read = S60.with_(length=100, beam="15 m", design_draught=6), qt.ship(file)
    assert made.hull.length == read.hull.length
    assert made.hull.draught == read.hull.draught
    for key in ("gm", "kg", "gyradius_roll", "gyradius_yaw"):
        assert getattr(made.loading, key) == pytest.approx(
            getattr(read.loading, key), rel=1e-5
        )  # files keep six digits


def test_what_is_written_from_the_table_is_up_to_date():
    tool = script()
    kept = {path: path.read_text(encoding="utf-8") for path in tool.made()}
    assert kept == tool.made(), "run python tools/write_options.py"
    assert (tool.SOURCE / "hull" / "option_types.py").read_text(encoding="utf-8") == tool.types()


def test_the_table_is_light():
    """Neither numpy nor pydantic is imported with the table: the command line begins with it."""
    code = "import sys, quartering.options; print({'numpy', 'pydantic', 'yaml'} & set(sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "set()\n"


THROWAWAY = """
import sys
from quartering.option_checks import Option
from quartering.options import OPTIONS
OPTIONS["ice_class"] = Option("ice_class", "length", "thickness of ice it may meet", place="loading", low=0, high="0.1 L",
                              usual="1 m", default="0.5 m", axis=True)
import json
import quartering as qt
from quartering.hull.file.schema import ship_schema
from quartering.hull.file.new import write_ship
from quartering.study.case.read import case_grid, case_schema
from quartering.view.explorer.service.calls import VerdictCall
from quartering.view.explorer.dials.dials import scales_of
from quartering.view.explorer.hulls.ship_registry import ShipRegistry
from quartering.view.explorer.state import LOADING, State
from typer.testing import CliRunner
from quartering.view.cli import app
sys.path.insert(0, sys.argv[2])
import write_options
folder = sys.argv[1]
box = qt.ship("box")
write_ship("box", folder + "/new.yaml")
open(folder + "/my.yaml", "w").write("base: box\\nloading: {ice_class: 80 cm}\\n")
open(folder + "/case.yaml", "w").write(
    "ship: box\\nspeed: 5\\nheading: 30\\nwave_length: 1 L\\nwave_height: 1\\nloading: {ice_class: [0.2 m, 0.4 m]}\\n")
call = {"ship": "box", "speed": 5, "heading": 30, "wave_length": 100, "wave_height": 1, "ice_class": "0.3 m"}
print(json.dumps({
    "file": qt.ship(folder + "/my.yaml").value("ice_class"),
    "note": qt.ship(folder + "/my.yaml").provenance["ice_class"],
    "python": box.with_(ice_class="1 m").value("ice_class"),
    "default": box.value("ice_class"),
    "help": "ice_class : " in qt.Ship.with_.__doc__,
    "case": case_grid(folder + "/case.yaml").loadings["ice_class"].tolist(),
    "loaded": case_grid(folder + "/case.yaml").loaded(1).value("ice_class"),
    "command": "--ice-class" in CliRunner().invoke(app, ["verdict", "--help"]).output,
    "refused": CliRunner().invoke(app, ["hull", "box", "--ice-class", "99"]).output,
    "dial": "ice_class" in LOADING and list(scales_of(OPTIONS["ice_class"], box)[0][2:4]),
    "state": State(ice_class=0.7).query(),
    "service": VerdictCall(**call).loaded(ShipRegistry()).value("ice_class"),
    "new": "# ice_class: 1 m" in open(folder + "/new.yaml").read(),
    "ship schema": "ice_class" in json.loads(ship_schema())["properties"]["loading"]["properties"],
    "case schema": "ice_class" in case_schema(),
    "docs": "`ice_class`" in write_options.page(),
    "types": "ice_class: float | str" in write_options.types(),
}))
"""


def test_a_throw_away_option_declared_once_is_in_every_door(tmp_path):
    command = [sys.executable, "-c", THROWAWAY, str(tmp_path), str(ROOT / "tools")]
    answer = subprocess.run(command, capture_output=True, text=True, check=False)
    assert answer.returncode == 0, answer.stderr
    found = json.loads(answer.stdout.splitlines()[-1])
    refused = found.pop("refused")
    assert refused.startswith("quartering: --ice-class: ice_class = 99 m; it is from 0 m to 0.1 L = 10 m")
    assert found == {
        "file": 0.8, "note": "given: 80 cm; this file", "python": 1.0, "default": 0.5, "help": True, "case": [0.2, 0.4],
        "loaded": 0.4, "command": True, "dial": [0.0, 10.0], "state": "ship=series60-cb60&ice_class=0.7", "service": 0.3,
        "new": True, "ship schema": True, "case schema": True, "docs": True, "types": True,
    }  # fmt: skip


def test_every_option_says_what_it_is():
    for one in OPTIONS.values():
        assert line_of(one)
        assert one.text[-1] != "."
        assert not one.numeric or one.usual is not None or one.default is not None


@pytest.mark.parametrize(
    ("command", "most"),
    [
        (["polar", "wigley", "--speed", "5", "--headings", "60", "--wave-height", "1"], 3),
        (["forces", "wigley", "--speed", "5"], 3),
        (["polar", "wigley", "--speed", "5", "--headings", "60", "--wave-height", "1"], 1),
    ],
    ids=["polar", "forces", "one"],
)
def test_waves_are_asked_by_their_periods_too(command, most, tmp_path, monkeypatch):
    """Evenly spaced periods; deep water: lambda = g T^2 / (2 pi), [Lewis89] ch. VIII."""
    monkeypatch.chdir(tmp_path)
    text = "8:10s:3" if most == 3 else "9"
    periods = [8.0, 9.0, 10.0] if most == 3 else [9.0]
    answer = CliRunner().invoke(app, [*command, "--wave-period", text, "--json"])
    assert answer.exit_code == 0, answer.output
    asked = json.loads(answer.stdout)["wave_length"]
    assert asked == pytest.approx([9.81 * t**2 / (2 * math.pi) for t in periods], rel=1e-9)
    both = CliRunner().invoke(app, [*command, "--wave-periods", text, "--wave-lengths", "1L"])
    assert (
        both.output.strip()
        == "quartering: --wave-lengths and --wave-period are two ways to say one thing; leave one out"
    )
