"""Inputs broken on purpose, from a seed, and what becomes of each: read by the doors people use, in this process.

Two kinds. Noise (bytes, words, numbers beyond all sense) must be read or refused. Changes of meaning, whose right answer is
known, must be refused, told in a warning, or answered rightly: `right` says so of an answer.
"""

import json
import os
import re
import resource
import signal
import sys
import tempfile
import traceback
import warnings
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import yaml
from pydantic import ValidationError
from typer.testing import CliRunner

import quartering as qt
from quartering.conventions import RangeWarning
from quartering.hull.formats.meshes import box_triangles
from quartering.hull.user_database import database_of
from quartering.hydro.database.capytaine import read_capytaine_file, write_capytaine_file
from quartering.hydro.database.dataset import write_capytaine, write_wamit
from quartering.view.cli import app
from quartering.view.explorer.hulls.ship_registry import ShipRegistry
from quartering.view.explorer.service.api import _examined
from quartering.view.explorer.service.calls import VerdictCall
from tests.loads.own_file import of_strips

SECONDS = 12
"""Processor time an input may take."""
X = np.linspace(-40.0, 40.0, 9)
LENGTH, BEAM, DRAUGHT, DEPTH = 80.0, 12.0, 3.0, 5.0
VOLUME = LENGTH * BEAM * DRAUGHT
SHIP = {
    "name": "barge", "length": "80 m", "beam": "12 m", "draught": "3 m", "lines": {"file": "a.csv", "midship": 0},
    "loading": {"gm": "0.8 m", "gyradius_roll": "4 m", "roll_damping": 0.05, "water_density": 1025},
}  # fmt: skip
WORDS = [
    "", "~", "nan", "-inf", "1e308", "-1e308", "1e-308", "-1", "0", str(10**400), "yes", "[]", "{}", "[1, [2, {}]]",
    "5 furlong", "1,5", "\u0661", "\U0001f6a2", "x" * 3000, "'", '"', "{", "*a", "&a 1", "!!python/object:os.system", "\\x00",
    "3 m 4 m", "1e", "--", "../../etc", "a: b: c", "=1+1", "%s%n", "0x10", "1_000", "1 L", "1 Fn", "-0.0", "1e-400", "\u200b3",
]  # fmt: skip


NUMBER = re.compile(rb"-?\d+(\.\d+)?")
WORD = re.compile(rb"[^\s,:;]+")


@dataclass
class Outcome:
    """What became of an input: "refused", "told", "answered", or a fault in words."""

    kind: str
    fault: str = ""


class Hang(Exception):
    """An input that takes too long."""


def _hang(*_):
    raise Hang


# Noise ---------------------------------------------------------------------------------------------------------------


def noisy(random, text):
    """Text with one or two changes: bytes, lines, words, numbers."""
    data = bytearray(text.encode())
    for _ in range(int(random.integers(1, 3))):
        way, at = int(random.integers(0, 12)), int(random.integers(0, max(len(data), 1)))
        lines = bytes(data).split(b"\n")
        line = int(random.integers(0, len(lines)))
        if way == 0 and data:
            data[at % len(data)] = int(random.integers(0, 256))
        elif way == 1:
            data = data[:at]
        elif way == 2:
            data = bytearray(b"\n".join(lines[:line] + lines[line + 1 :]))
        elif way == 3:
            again = lines[line : line + 1] * int(random.choice([2, 50]))
            data = bytearray(b"\n".join([*lines[:line], *again, *lines[line:]]))
        elif way == 4:
            data[at:at] = bytes(random.integers(0, 256, 8).astype(np.uint8))
        else:
            found = list((NUMBER if way > 6 else WORD).finditer(lines[line]))
            if found:
                one = found[int(random.integers(0, len(found)))]
                other = str(random.choice(WORDS)).encode()
                if way > 6:
                    other = f"{float(one[0]) * 10 ** random.uniform(-0.5, 0.5):.6g}".encode()
                lines[line] = lines[line][: one.start()] + other + lines[line][one.end() :]
            data = bytearray(b"\n".join(lines))
    return bytes(data)


def _is_number(part):
    try:
        return bool(np.isfinite(float(part)))
    except ValueError:
        return False


def _points(y=lambda y: y, z=lambda z: z, x=lambda x: x):
    """Stations x, y, z of the barge, each column changed."""
    rows = [(x(a), y(b), z(c)) for a in X for b, c in ((0.0, 0.0), (6.0, 0.0), (6.0, 5.0))]
    return "x,y,z\n" + "\n".join(",".join(f"{v:g}" for v in row) for row in rows) + "\n"


def _table():
    return "x,0,1,3,5\n" + "\n".join(f"{x:g},6,6,6,6" for x in X) + "\n"


def _pdstrip():
    return f"{X.size} t 3.0\n" + "\n".join(f"{x:g} 3 0\n0 6 6\n0 0 5" for x in X) + "\n"


def _triangles():
    return box_triangles(LENGTH, BEAM, DEPTH, keel=-DRAUGHT)


def _stl(triangles=None):
    corners = (_triangles() if triangles is None else triangles).reshape(-1, 3)
    return "solid a\n" + "\n".join(f"vertex {x:g} {y:g} {z:g}" for x, y, z in corners) + "\nendsolid\n"


def _gdf(triangles=None):
    all_of = _triangles() if triangles is None else triangles
    corners = np.concatenate([all_of, all_of[:, 2:]], axis=1).reshape(-1, 3)
    rows = "\n".join(f"{x:.6f} {y:.6f} {z:.6f}" for x, y, z in corners)
    return f"barge\n1.0 9.81\n0 0\n{len(all_of)}\n{rows}\n"


LINES = {"a.csv": _points, "b.csv": _table, "c.out": _pdstrip, "d.stl": _stl, "e.gdf": _gdf}
CASE = "ship: wigley\nspeed: 5 m/s\nheading: [60 deg]\nwave_length: 1 L\nwave_height: 1 m\nloading: {gm: [0.5 m]}\n"


def _decay(time=1.0, angle=1.0):
    t = np.arange(0.0, 60.0, 0.2)
    phi = 10.0 * np.exp(-0.03 * t) * np.cos(0.7 * t)
    return (
        "time [s],roll [deg]\n"
        + "\n".join(f"{a:.4f},{b:.5f}" for a, b in zip(time * t, angle * phi, strict=True))
        + "\n"
    )


def _read(folder, ship_text):
    (folder / "my.yaml").write_bytes(ship_text if isinstance(ship_text, bytes) else ship_text.encode())
    one = qt.ship(folder / "my.yaml")
    return one, qt.hydrostatics(one)


def _sound(one, floats):
    """An answer to noise still is a ship."""
    block = floats.volume / (one.hull.length * one.hull.beam * one.hull.draught)
    if not (np.isfinite(floats.volume) and 0.0 < block <= 1.05 and np.isfinite(one.loading.gm)):
        return f"block {block:g}, GM {one.loading.gm:g}"
    return ""


def noise_of_ship(random, folder):
    (folder / "a.csv").write_text(_points())
    return _sound(*_read(folder, noisy(random, yaml.safe_dump(SHIP, sort_keys=False))))


def noise_of_lines(random, folder):
    name = str(random.choice(list(LINES)))
    (folder / name).write_bytes(noisy(random, LINES[name]()))
    return _sound(*_read(folder, yaml.safe_dump(SHIP | {"lines": name})))


def noise_of_decay(random, folder):
    (folder / "d.csv").write_bytes(noisy(random, _decay()))
    fit = qt.roll_decay(SOUND["ship"], qt.read_decay(folder / "d.csv", unit="deg"))
    return "" if np.isfinite([fit.roll_damping, fit.quadratic]).all() else "a fit that is not finite"


def noise_of_wamit(random, folder):
    for ending in (".1", ".3"):
        text = Path(f"{SOUND['wamit']}{ending}").read_text()
        which = random.integers(0, 2)
        (folder / f"a{ending}").write_bytes(noisy(random, text) if which else text.encode())
    one = SOUND["ship"].with_(database=database_of(folder / "a.1", "test", length=1.0))
    force = qt.wave_forces(one, SOUND["wave"], 0.0, 60.0)
    return "" if np.isfinite(force.to_array().to_numpy().astype(float)).all() else "force is not finite"


def noise_of_netcdf(random, folder):
    data = bytearray(Path(SOUND["capytaine"]).read_bytes())
    for _ in range(int(random.integers(1, 4))):
        at = int(random.integers(0, len(data)))
        data[at] ^= 1 << int(random.integers(0, 8))
    (folder / "a.nc").write_bytes(bytes(data[: int(random.integers(0, len(data)))] if random.random() < 0.3 else data))
    one = SOUND["ship"].with_(database=database_of(folder / "a.nc", "test"))
    qt.wave_forces(one, SOUND["wave"], 0.0, 60.0)
    return ""


def noise_of_case(random, folder):
    (folder / "c.yaml").write_bytes(noisy(random, CASE))
    return _command(folder, ["sweep", "c.yaml", "-o", "out"])


def noise_of_command(random, folder):
    words = [
        "verdict",
        "wigley",
        "--heading",
        "60",
        "--speed",
        "5",
        "--wave-length",
        "100",
        "--wave-height",
        "1",
        "--json",
    ]
    for _ in range(int(random.integers(1, 3))):
        at = int(random.integers(1, len(words)))
        if random.random() < 0.5 and _is_number(words[at]):
            words[at] = f"{float(words[at]) * 10 ** random.uniform(-0.5, 0.3):.4g}"
        else:
            words[at] = str(random.choice([*WORDS, "--gm", "--draught", "-9e9", "1e3 t", "0.25Fn", "400"]))
    return _command(folder, words)


def noise_of_call(random, _):
    call = {"ship": "wigley", "speed": 5.0, "heading": 60, "wave_length": 100, "wave_height": 1.0, "gm": 0.8}
    key = str(random.choice([*call, "kg", "draught", "harmonics", "form", "autopilot", "x"]))
    values = [*WORDS, None, True, [], {}, [1] * 1000, float("nan"), 10**400, -1, {"a": {"b": []}}, 1e308, "9" * 5000]
    if random.random() < 0.3 and _is_number(call.get(key, "")):
        call[key] *= 10 ** random.uniform(-0.5, 0.3)
    else:
        call[key] = values[int(random.integers(0, len(values)))]
    try:
        found = VerdictCall.model_validate(json.loads(json.dumps(call)))
    except ValidationError:
        raise qt.InputError("refused by the description") from None
    _examined(found, SOUND["registry"])
    return ""


def _command(folder, words):
    before, here = set(folder.rglob("*")), os.getcwd()
    os.chdir(folder)
    try:
        found = CliRunner().invoke(app, words)
    finally:
        os.chdir(here)
    if found.exit_code == 0:
        return ""
    if found.exit_code != 2 or (found.exception and not isinstance(found.exception, SystemExit)):
        return (
            f"exit {found.exit_code}: {found.exception!r} {''.join(traceback.format_exception(found.exception))[-600:]}"
        )
    if set(folder.rglob("*")) != before or found.stdout:
        return "refused after files or output"
    raise qt.InputError(found.stderr)


# Changes of meaning --------------------------------------------------------------------------------------------------


def _volume_of(folder, text, name, tolerance=0.02, **more):
    (folder / name).write_text(text)
    _, floats = _read(folder, yaml.safe_dump(SHIP | {"lines": name} | more))
    wrong = abs(floats.volume - VOLUME) > tolerance * VOLUME
    return f"volume {floats.volume:g} for {VOLUME:g} m3" if wrong else ""


def scaled_lines(random, folder):
    """All of the lines in another unit."""
    unit = float(random.choice([1e3, 1e-3, 1e2, 1e-2, 0.3048, 1 / 0.3048, 25.4, 10.0]))
    name = str(random.choice(list(LINES)))
    if name in ("d.stl", "e.gdf"):
        text = (_stl if name == "d.stl" else _gdf)(unit * _triangles())
    elif name == "a.csv":
        text = _points(*3 * [lambda v: unit * v])
    else:
        lines = LINES[name]().split("\n")
        text = (
            "\n".join([lines[0], *(_times(line, unit) for line in lines[1:])])
            if name == "b.csv"
            else _scaled_pdstrip(unit)
        )
    return _volume_of(folder, text, name)


def _times(line, unit):
    return ",".join(f"{unit * float(v):g}" for v in line.split(",")) if line else line


def _scaled_pdstrip(unit):
    rows = "\n".join(f"{unit * x:g} 3 0\n0 {unit * 6:g} {unit * 6:g}\n0 0 {unit * 5:g}" for x in X)
    return f"{X.size} t 3.0\n{rows}\n"


def scaled_column(random, folder):
    """One of x, y, z in another unit, or of the other sign."""
    by = float(random.choice([1e3, 1e-3, 0.3048, 2.0, 0.5, -1.0]))
    which = str(random.choice(["x", "y", "z"]))
    return _volume_of(folder, _points(**{which: lambda v: by * v}), "a.csv")


def dropped_station(random, folder):
    """The rows of one station gone: inside, the hull is the same; at an end it is shorter, which is told."""
    at = int(random.integers(0, X.size))
    lines = _points().split("\n")
    return _volume_of(folder, "\n".join(lines[: 1 + 3 * at] + lines[4 + 3 * at :]), "a.csv")


def point_below(random, folder):
    """A keel point below the baseline at a few stations, a little or a lot."""
    down, first = float(random.choice([1e-3, 0.05, 0.3])), int(random.integers(0, X.size))
    lines = _points().split("\n")
    for k in range(first, min(first + int(random.integers(1, 4)), X.size)):
        lines[1 + 3 * k] = f"{X[k]:g},0,{-down:g}"
    return _volume_of(folder, "\n".join(lines), "a.csv", tolerance=0.02 + down * 0.5 / DRAUGHT)


def moved_lines(random, folder):
    """All heights, or all x, counted from elsewhere."""
    shift = float(random.choice([-3.0, -5.0, 3.0, 40.0, -40.0, 1.5]))
    which = str(random.choice(["x", "z"]))
    return _volume_of(folder, _points(**{which: lambda v: v + shift}), "a.csv")


def swapped_columns(random, folder):
    order = random.permutation(3)
    rows = [row.split(",") for row in _points().strip().split("\n")[1:]]
    text = "x,y,z\n" + "\n".join(",".join(row[k] for k in order) for row in rows) + "\n"
    return _volume_of(folder, text, "a.csv")


def leaking_mesh(random, folder):
    """Panels gone from under the water, or turned round."""
    below = _triangles()
    gone = int(random.integers(0, len(below)))
    triangles = np.delete(below, gone, axis=0) if random.random() < 0.5 else below.copy()
    if len(triangles) == len(below):
        triangles[gone] = triangles[gone][::-1]
    name = str(random.choice(["d.stl", "e.gdf"]))
    return _volume_of(folder, (_stl if name == "d.stl" else _gdf)(triangles), name)


def size_of_ship(random, folder):
    """A dimension of the ship file in another unit, of the other sign, or gone."""
    key, by = (
        str(random.choice(["length", "beam", "draught"])),
        float(random.choice([1e3, 1e-3, 0.3048, -1.0, 0.1, 10.0, 0.0])),
    )
    (folder / "a.csv").write_text(_points())
    own = {"length": LENGTH, "beam": BEAM, "draught": DRAUGHT}[key]
    keys = dict(SHIP)
    if by:
        keys[key] = f"{by * own:g} m"
    else:
        del keys[key]
    _, floats = _read(folder, yaml.safe_dump(keys))
    # heights from the baseline may float at any draught, whose volume is known
    right = VOLUME * (by if key == "draught" else 1.0)
    wrong = abs(floats.volume - right) > 0.02 * right
    return f"{key} times {by:g}: volume {floats.volume:g} for {right:g} m3" if wrong else ""


def decay_in_other_units(random, folder):
    """Milliseconds, minutes, time backwards; the period is 2 pi/0.7 s."""
    by = float(random.choice([1e3, 1e6, 1 / 60, 1 / 3600, -1.0, 1e-3]))
    (folder / "d.csv").write_text(_decay(time=by).replace("time [s]", str(random.choice(["time", "t", "time [s]"]))))
    record = qt.read_decay(folder / "d.csv", unit="deg")
    qt.roll_decay(SOUND["ship"], record)
    wrong = abs(record.time[-1] - 59.8) > 0.1
    return f"time times {by:g} taken" if wrong else ""


def changed_database(random, folder):
    """A database of another density, size, sign, frequency or direction: its own answer, or told."""
    raw = read_capytaine_file(SOUND["capytaine"])
    ways = {
        "matrices x 1000": lambda: replace(raw, added_mass=1e3 * raw.added_mass, damping=1e3 * raw.damping),
        "forces x 1000": lambda: replace(raw, forces={n: 1e3 * f for n, f in raw.forces.items()}),
        "forces x 0.5": lambda: replace(raw, forces={n: 0.5 * f for n, f in raw.forces.items()}),
        "density / 1000": lambda: replace(raw, density=raw.density / 1e3),
        "imaginary parts": lambda: replace(raw, forces={n: np.conj(f) for n, f in raw.forces.items()}),
        "diffraction": lambda: replace(raw, forces={**raw.forces, "diffraction": np.conj(raw.forces["diffraction"])}),
        "damping of the other sign": lambda: replace(raw, damping=-raw.damping),
        "one coupling": lambda: replace(raw, added_mass=raw.added_mass * np.array([[1, -1, 1], [1, 1, 1], [1, 1, 1]])),
        "Hz": lambda: replace(raw, frequency=raw.frequency / (2 * np.pi)),
        "rad/s for Hz": lambda: replace(raw, frequency=raw.frequency * 2 * np.pi),
        "half a hull": lambda: replace(raw, added_mass=raw.added_mass / 2, damping=raw.damping / 2),
        "roll of the other sign": lambda: replace(raw, forces={n: f * [1.0, -1.0, 1.0] for n, f in raw.forces.items()}),
        "yaw of the other sign": lambda: replace(raw, forces={n: f * [1.0, 1.0, -1.0] for n, f in raw.forces.items()}),
        "moments in t m": lambda: replace(raw, forces={n: f * [1e-3, 1e-3, 1e-3] for n, f in raw.forces.items()}),
        "directions from the other side": lambda: replace(raw, direction=raw.direction * -1.0),
        "x from the aft end": lambda: replace(raw, centre=(40.0, 0.0)),
    }  # fmt: skip
    way = str(random.choice(list(ways)))
    write_capytaine_file(folder / "a.nc", ways[way]())
    one = SOUND["ship"].with_(database=database_of(folder / "a.nc", "test"))
    model = qt.equations(one, SOUND["wave"], 0.0, 60.0)
    roll = float(np.abs(qt.steady_motion(model).amplitude[1]))
    wrong = abs(roll - SOUND["roll"]) > 0.02 * SOUND["roll"]
    return f"{way}: roll {roll:g} for {SOUND['roll']:g}" if wrong else ""


NOISE = (
    noise_of_ship, noise_of_lines, noise_of_lines, noise_of_decay, noise_of_wamit, noise_of_netcdf, noise_of_case,
    noise_of_command, noise_of_call,
)  # fmt: skip
MEANING = (
    scaled_lines, scaled_column, dropped_station, point_below, moved_lines, swapped_columns, leaking_mesh, size_of_ship,
    decay_in_other_units, changed_database,
)  # fmt: skip
KINDS = (*NOISE, *MEANING)
SOUND = {}
"""What the inputs are compared with, made once in a process."""


def prepare(folder):
    """A sound database of a box in both formats, and the roll it gives."""
    box = qt.ship("box").with_(ends="strips")
    omega, headings = np.linspace(0.2, 1.2, 11), np.arange(0.0, 181.0, 30.0)
    found = of_strips(box, omega, headings)
    write_capytaine(found, folder / "sound.nc", box)
    write_wamit(found, folder / "sound", box)
    wave = qt.Wave(120.0, 2.0)
    one = box.with_(database=database_of(folder / "sound.nc", "test"))
    SOUND.update(ship=box, wave=wave, capytaine=folder / "sound.nc", wamit=folder / "sound", registry=ShipRegistry())
    SOUND["roll"] = float(np.abs(qt.steady_motion(qt.equations(one, wave, 0.0, 60.0)).amplitude[1]))


def one_input(number):
    """What becomes of the input of a number."""
    random, kind = np.random.default_rng([16, number]), KINDS[number % len(KINDS)]
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        signal.setitimer(signal.ITIMER_PROF, SECONDS)
        try:
            wrong = kind(random, Path(folder))
        except qt.InputError as error:
            return Outcome("refused", "" if str(error).strip() else "refused without a word")
        except Hang:
            return Outcome("hang", f"took over {SECONDS} s")
        except BaseException:
            return Outcome("traceback", traceback.format_exc()[-900:])
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)
    told = [str(one.message) for one in said if issubclass(one.category, RangeWarning)]
    if told:
        return Outcome("told")
    other = [str(one.message) for one in said if not issubclass(one.category, (RangeWarning, DeprecationWarning))]
    if other and kind in NOISE:
        return Outcome("warning", other[0][:300])
    return Outcome("silent" if wrong else "answered", wrong)


def main(first, count):
    """Each input of a range as a line of JSON."""
    signal.signal(signal.SIGPROF, _hang)
    with tempfile.TemporaryDirectory() as folder:
        prepare(Path(folder))
        for number in range(first, first + count):
            found = one_input(number)
            most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024
            print(json.dumps([number, KINDS[number % len(KINDS)].__name__, found.kind, found.fault, most]), flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]))
