"""One fault, one message: from a ship file, Python, the command line and the service, for every kind of option."""

import asyncio
import json

import httpx
import pytest
from fastapi import FastAPI
from typer.testing import CliRunner

import quartering as qt
from quartering.view.cli import app
from quartering.view.explorer.computing.job_queue import JobQueue
from quartering.view.explorer.hulls.ship_registry import ShipRegistry
from quartering.view.explorer.service.api import serve_api

SHIP = qt.ship("series60-cb60")
CONDITION = {"speed": 5, "heading": 30, "wave_length": 100, "wave_height": 1}
LOADING = {"gm", "kg", "gyradius_roll", "roll_damping", "gmm", "water_density"}
SERVED = {"gm", "kg", "gyradius_roll", "roll_damping", "velocities", "drag", "water_density", "draught"}
NO_NUMBER = "that is no finite number with a unit"

# Kind and fault: the option, what is given, and the words that every door says; text between braces is a file's group of keys.
FAULTS = {
    "length, range": ("gyradius_roll", "6500", "gyradius_roll = 6500 m; it is above 0 m and at most 2 B = 32.51 m"),
    "length, unit": ("gm", "1 kg", 'gm = 1 kg; unit "kg" is not known for a length; units allowed: m, mm, cm, km'),
    "length, number": ("draught", "abc", f"draught = 'abc'; {NO_NUMBER}; it is above 0 m and at most 100 m; try 6.5 m"),
    "height of G": ("kg", "40 m", "kg = 40 m under KM = 6.556 m gives gm = -33.4435 m"),
    "angle, range": ("openings", "400", "openings = 400 deg; it is above 0 deg and at most 180 deg"),
    "angle, unit": ("openings", "3 m", 'openings = 3 m; unit "m" is not known for an angle; units allowed: deg, rad'),
    "angle, number": ("openings", "abc", f"openings = 'abc'; {NO_NUMBER}; it is above 0 deg and at most 180 deg"),
    "number, range": ("drag_coefficient", "50", "drag_coefficient = 50; it is from 0 to 10; did you mean 50 %? Try 0.8"),
    "number, unit": ("drag_coefficient", "3 m", 'drag_coefficient = 3 m; unit "m" is not known for a ratio'),
    "number, number": ("drag_coefficient", "nan", f"drag_coefficient = 'nan'; {NO_NUMBER}; it is from 0 to 10; try 0.8"),
    "density, slip": ("water_density", "1.025", "water_density = 1.025 kg/m3; it is from 500 kg/m3 to 1500 kg/m3; did you"),
    "share, range": ("roll_damping", "5", "roll_damping = 5; it is from 0 to 1, or ikeda or ikeda-simplified; did you mean"),
    "share, unit": ("roll_damping", "3 m", 'roll_damping = 3 m; unit "m" is not known for a ratio; units allowed: %'),
    "share, word": ("roll_damping", "ikdea", f"roll_damping = 'ikdea'; {NO_NUMBER}; did you mean ikeda?"),
    "choice, word": ("velocities", "relatve", "velocities = 'relatve'; allowed are \"relative\" (to the water"),
    "flag, word": ("drag", "strps", "drag = 'strps'; allowed are \"strips\" (|q| q strip by strip), \"cubic\""),
    "file, kind": ("database", "no.txt", "database = 'no.txt'; it is a path of a Capytaine netCDF (.nc) or of WAMIT's .1"),
    "file, gone": ("database", "no.nc", "database = 'no.nc'; there is no such file; it is a path of a Capytaine"),
    "set": ("measured", "sno", "measured = 'sno'; it is a file, or one of blanke-christensen-1993"),
    "pair, range": ("bilge_keels", "300 m,0.3 m", "bilge_keel_length = 300 m; it is from 0 m to 1 L = 121.9 m; is the unit"),
    "pair, unit": ("bilge_keels", "30 kg,0.3 m", 'bilge_keel_length = 30 kg; unit "kg" is not known for a length'),
    "pair, number": ("bilge_keels", "abc,0.3 m", f"bilge_keel_length = 'abc'; {NO_NUMBER}; it is from 0 m to 1 L = 121.9 m"),
    "pair, missing": ("bilge_keels", "30", "bilge_keels: breadth is missing; give length, breadth, such as {length: 0.25 L"),
    "coefficient, number": ("factors", "K_ppp=abc", "factors: K_ppp = 'abc'; it is a finite number, such as {K_p: 1.0}"),
    "coefficient, unit": ("values", "K_ppp=2 m", "values: K_ppp = '2 m'; it is a finite number, such as {N_r: -2.0e9}"),
    "coefficient, name": ("values", "K_ppq=2", 'coefficient "K_ppq" is unknown; the nearest known name is "K_vpp"'),
    "coefficients": ("factors", "K_ppp", "factors = 'K_ppp'; it is coefficients with a number each, such as {K_p: 1.0}"),
    "name": ("opnings", "40 deg", "opnings is unknown; did you mean openings?"),
    "name of loading": ("gmm", "1 m", "gmm is unknown; did you mean gm?"),
}  # fmt: skip


@pytest.fixture(scope="module")
def service():
    """Answer of the service to a call, without a socket."""
    server = FastAPI()
    serve_api(server, ShipRegistry(), JobQueue())

    async def asked(path, whole):
        transport = httpx.ASGITransport(app=server)
        async with httpx.AsyncClient(transport=transport, base_url="http://localhost") as client:
            if whole is None:
                return await client.get(path)
            return await client.post(path, content=whole, headers={"content-type": "application/json"})

    def call(path="/api/verdict", text=None, **content):
        whole = text or json.dumps({"ship": "series60-cb60", **content})
        return asyncio.run(asked(path, None if "?" in path else whole))

    return call


def in_file(name, given):
    """Lines of a ship file, and the line the option stands on."""
    if name == "bilge_keels":
        keys = zip(("length", "breadth"), given.split(","), strict=False)
        given = "{" + ", ".join(f"{key}: {part}" for key, part in keys) + "}"
    if name in ("values", "factors") and "=" in given:
        key, _, value = given.partition("=")
        given = f"{{{key}: {value}}}"
    beside = "loading: {roll_damping: ikeda}\n" if name == "bilge_keels" else "\n"
    return f"base: series60-cb60\nloading:\n  {name}: {given}\n" if name in LOADING else (
        f"base: series60-cb60\n{beside}{name}: {given}\n"
    )  # fmt: skip


@pytest.mark.parametrize("fault", FAULTS)
def test_every_door_says_the_same_of_a_fault(fault, tmp_path, service):
    name, given, words = FAULTS[fault]
    beside = {"roll_damping": "ikeda"} if name == "bilge_keels" else {}
    file = tmp_path / "my.yaml"
    file.write_text(in_file(name, given))
    with pytest.raises(qt.InputError) as of_file:
        qt.ship(file)
    assert f"{file}, line 3: " in str(of_file.value)
    assert words.partition("units allowed")[0] in str(of_file.value)  # of a dimension, L, B and T are not known yet
    with pytest.raises(qt.InputError) as of_python:
        SHIP.with_(**{**beside, name: given})
    said = str(of_python.value).removeprefix(f"{SHIP.name}: ")
    assert said.startswith(words)
    typed = [f"--{key.replace('_', '-')}={text}" for key, text in {**beside, name: given}.items()]
    answer = CliRunner().invoke(app, ["hull", "series60-cb60", *typed])
    assert answer.exit_code == 2
    prefix = "" if "is unknown; did you mean" in words else f"--{name.replace('_', '-')}: "
    assert answer.output.strip() == f"quartering: {prefix}{said}"
    if name in SERVED:
        refusal = service(**CONDITION, **{name: given})
        assert refusal.status_code == 422
        assert refusal.json()["error"].removeprefix(f"{SHIP.name}: ") == said
    if name not in SERVED and "is unknown" in words:
        near = service(**CONDITION, gmm=1).json()["error"]
        assert near == "gmm is unknown; did you mean gm?"


CONDITIONS = {
    "speed, range": ("speed", "-5", "speed = -5 m/s; it is from 0 m/s to 100 m/s (heading tells the direction)"),
    "speed, unit": ("speed", "3 kg", 'speed = 3 kg; unit "kg" is not known for a speed; units allowed: m/s, kn'),
    "heading, range": ("heading", "400", "heading = 400 deg; it is from -180 deg to 360 deg"),
    "length, number": ("wave_length", "abc", f"wave_length = 'abc'; {NO_NUMBER}; it is above 0 m"),
    "period, range": ("wave_period", "-1", "wave_period = -1 s; it is above 0 s and at most 250 s; try 9 s"),
    "period, unit": ("wave_period", "9 m", 'wave_period = 9 m; unit "m" is not known for a time'),
    "height, number": ("wave_height", "tall", f"wave_height = 'tall'; {NO_NUMBER}; it is from 0 m"),
}


def equations_of(speed, heading, wave_height, wave_length=None, wave_period=None):
    return qt.equations(SHIP, qt.Wave(wave_length, wave_height, period=wave_period, ship=SHIP), speed, heading)


@pytest.mark.parametrize(
    ("fault", "number"),
    [(fault, number) for fault in CONDITIONS for number in (False, True) if not number or fault.endswith("range")],
)
def test_every_door_says_the_same_of_a_condition(fault, number, service):
    """Given as text, and in Python and the service as a number too."""
    name, given, words = CONDITIONS[fault]
    asked = {**CONDITION, name: float(given) if number else given}
    if name == "wave_period":
        del asked["wave_length"]
    with pytest.raises(qt.InputError) as of_python:
        qt.sweep(SHIP, **asked)
    said = str(of_python.value)
    assert said.startswith(words)
    with pytest.raises(qt.InputError) as of_equations:
        equations_of(**asked)
    assert str(of_equations.value) == said
    typed = [f"--{key.replace('_', '-')}={text}" for key, text in {**asked, name: given}.items()]
    answer = CliRunner().invoke(app, ["verdict", "series60-cb60", *typed])
    assert answer.output.strip() == f"quartering: --{name.replace('_', '-')}: {said}"
    assert service(**asked).json()["error"] == said
    several = {key: value if key == "wave_height" else [value] for key, value in asked.items()}
    assert service("/api/polar", **several).json()["error"] == said


def test_an_option_given_twice_is_refused_at_every_door(tmp_path, service):
    words = "openings is given twice"
    file = tmp_path / "my.yaml"
    file.write_text("base: box\nopenings: 40 deg\nopenings: 30 deg\n")
    with pytest.raises(qt.InputError, match=f"line 3: {words}"):
        qt.ship(file)
    answer = CliRunner().invoke(app, ["hull", "box", "--openings=40", "--openings=30"])
    assert (answer.exit_code, answer.output.strip()) == (2, f"quartering: {words}; leave one out")
    twice = json.dumps({"ship": "box", **CONDITION})[:-1] + ', "speed": 6}'
    assert service(text=twice).json()["error"] == "speed is given twice; leave one out"
    query = "ship=box&speed=5&speed=6&heading=30&wave_length=100&wave_height=1"
    assert service(f"/api/verdict?{query}").json()["error"] == "speed is given twice; leave one out"
    both = {"gm": "1 m", "kg": "5 m"}
    words = "gm and kg are both given; one stands for the other, leave one out"
    with pytest.raises(qt.InputError, match=words):
        SHIP.with_(**both)
    file.write_text("base: box\nloading: {gm: 1 m, kg: 5 m}\n")
    with pytest.raises(qt.InputError, match=f"line 2: loading, {words}"):
        qt.ship(file)
    answer = CliRunner().invoke(app, ["hull", "series60-cb60", "--gm=1 m", "--kg=5 m"])
    assert answer.output.strip() == f"quartering: --kg: {words}"
    assert service(**CONDITION, **both).json()["error"] == words
