"""Whatever a command is given: one message with what is allowed, exit 2, and a folder as it was before."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

import quartering as qt
from quartering.conventions import RangeWarning
from quartering.loads.validity import FASTEST, SHORTEST
from quartering.study.maps import executor
from quartering.study.maps.stored.store import LAYOUT
from quartering.units import Sizes
from quartering.view.cli import app
from quartering.view.console.typed_values import value

CASE = "ship: wigley\nspeed: 5 m/s\nheading: [60 deg]\nwave_length: 1 L\nwave_height: 1 m\n"
CONDITION = ["--heading", "60", "--speed", "5", "--wave-length", "100", "--wave-height", "1"]
LONG = "x" * 300
SHIPS = {
    "empty": ("", "list of keys"),
    "list": ("- 1\n- 2\n", "list of keys"),
    "tab": ("base: wigley\n\tname: x\n", "line 2: a tab stands where spaces indent"),
    "open": ("base: wigley\nloading: {gm: {value: 1 m\n", "line 3: `{` of line 2 is not closed"),
    "twice": ("base: wigley\nname: x\nbase: box\n", "line 3: base is given twice (first in line 1)"),
    "number": ("base: wigley\n1: 2\n", "line 2: the key 1 is no word"),
    "misspelt": ("base: wigley\ndraft: 5 m\n", "did you mean draught"),
    "metres": ("base: wigley\nloading:\n  gm: 800\n", "is the unit right? try 0.05 B"),
    "above": ("base: wigley\nloading:\n  kg: 50 m\n", "KM = 5.278 m"),
    "radius": (
        "base: wigley\nloading:\n  gyradius_roll: 3500\n",
        "at most 2 B = 20 m; did you mean 3500 mm? Try 0.35 B",
    ),
    "nothing": ("base: wigley\nlength: 0 m\n", "it is above 0"),
    "negative": ("base: wigley\nloading:\n  roll_damping: -0.1\n", "from 0 to 1"),
    "gain": ("base: wigley\nautopilot: {gain: 1.0e+30}\n", "from 0 to 100"),
    "deep": ("base: wigley\nloading: " + "[" * 90 + "]" * 90 + "\n", "[[[... is given"),
    "measured": ("base: wigley\nmeasured: empty.yaml\n", "a measured set is a list of keys"),
    "database": ("base: wigley\ndatabase: empty.nc\n", "cut short or not one"),
    "lines": ("length: 60 m\nbeam: 10 m\ndraught: 4 m\nlines: {file: nowhere.csv}\n", "seen from the ship file"),
}
CASES = {
    "empty": ("", "list of keys"),
    "tab": ("ship: wigley\n\tspeed: 3\n", "line 2: a tab stands where spaces indent"),
    "misspelt": (CASE + "speeed: 3\n", "line 6"),
    "deep": (CASE + "loading: " + "[" * 5000 + "]" * 5000 + "\n", "nested too deeply"),
    "number": (CASE + "1: 2\n", "line 6: the key 1 is no word"),
    "twice": (CASE + "speed: 3\n", "line 6: speed is given twice (first in line 2)"),
    "switch": (CASE.replace("5 m/s", "yes"), "line 2: speed: True is given"),
    "astern": (CASE.replace("5 m/s", "-5 m/s"), "it is from 0 m/s"),
    "unit": (CASE.replace("5 m/s", "5 furlong"), "m/s, kn, km/h, Fn"),
    "breaks": (CASE.replace("1 m\n", "90 m\n"), "1/7"),
    "heading": (CASE.replace("60 deg", "400 deg"), "line 3: heading = 400 deg"),
    "many": (CASE.replace("[60 deg]", "0..180 deg step 1e-9"), "take a larger step"),
    "huge": (
        CASE.replace("[60 deg]", "0..180 deg count 100000").replace("1 L", "1..2 L count 100000"),
        "100,000 of heading, 100,000 of wave_length make 10,000,000,000 conditions",
    ),
    "harmonics": (CASE + "harmonics: 1001\n", "line 6: harmonics=1001: give an odd number"),
    "metres": (CASE + "loading: {gm: [1 m, 800 m]}\n", "puts G 794.7 m below the keel"),
}
COMMANDS = [
    (["hull", LONG], "neither a file nor a built-in ship"),
    (["hull", ""], "neither a file nor a built-in ship"),
    (["hull", "wigley", "-o", ""], 'output "": its name must end in .png'),
    (["hull", "wigley", "-o", f"{LONG}.png"], "cannot be written (File name too long)"),
    (["verdict", "wigley", *CONDITION, "--harmonics", "1001"], "up to 199"),
    (["verdict", "wigley", *CONDITION, "--autopilot", "1e30,1s,1s"], "from 0 to 100"),
    (["polar", "wigley", "-o", ""], 'its name must end in .nc or .csv or .xlsx; try "my.nc"'),
    (["polar", "wigley", "--headings", "0:180:1000000"], "up to 100,000"),
    (["polar", "wigley", "--harmonics", "201"], "up to 199"),
    (["branch", "wigley", *CONDITION, "--over", "gm", "--limits", "1:1e6"], "below the keel"),
    (["basin", "wigley", *CONDITION, "--periods", "100000000"], "give 1 to 10,000"),
    (["basin", "wigley", *CONDITION, "--wave-heights", "0:2:5000"], "give up to 200"),
    (["forces", "wigley", "--wave-lengths", "1L:2L:99999"], "take fewer wave lengths"),
    (["duffing", "--force", "1e300"], "up to 1e+06"),
    (["figures", "1", "-o", ""], "names no folder"),
    (["new", "wigley", LONG], "File name too long"),
    (["sweep", LONG], "cannot be read"),
    (["sweep", "good.yaml", "-o", ""], "names no folder"),
    (["sweep", "good.yaml", "-o", "taken"], "holds other files"),
    (["sweep", "good.yaml", "-o", "bytes.nc"], "is a file"),
    (["sweep", "good.yaml", "--cluster", "foo"], "local:4"),
    (["sweep", "good.yaml", "--cluster", "local:²"], "local:4"),
    (["sweep", "good.yaml", "--cluster", "tcp://127.0.0.1:1"], "is it running?"),
    (["sweep", "good.yaml", "--uncertainty", "gm=10%", "--cluster", "foo"], "local:4"),
    (["sweep", "good.yaml", "--uncertainty", "gm=10%", "-o", ""], "must end in .nc"),
    (["worst", "bytes.nc"], "nor a netCDF file"),
    (["worst", "other.nc"], "not the result of a sweep"),
    (["show", "other.nc"], "not the result of a sweep"),
    (["show", "half"], "lacks a part"),
    (["show", LONG], "File name too long"),
    (["report", "half"], "lacks a part"),
    (["app", LONG, "--no-browser"], "neither a file nor a built-in ship"),
]


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A folder with things in it that are not what they seem."""
    (tmp_path / "good.yaml").write_text(CASE)
    (tmp_path / "bytes.nc").write_bytes(bytes(range(256)) * 8)
    xr.Dataset({"a": ("x", [1.0, 2.0])}).to_netcdf(tmp_path / "other.nc")
    for name, file, text in (("taken", "thesis.txt", "mine"), ("half", "case.json", json.dumps({"layout": LAYOUT}))):
        (tmp_path / name).mkdir()
        (tmp_path / name / file).write_text(text)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _content(folder):
    return {str(p.relative_to(folder)): p.read_bytes() if p.is_file() else None for p in folder.rglob("*")}


def _refused(folder, words, hint):
    before = _content(folder)
    found = CliRunner().invoke(app, words)
    assert found.exit_code == 2, found.output
    assert hint in found.stderr
    assert found.stderr.count("quartering:") == 1
    assert "Traceback" not in found.output
    assert found.stdout == ""
    assert _content(folder) == before


@pytest.mark.parametrize(("words", "hint"), COMMANDS, ids=lambda w: " ".join(w)[:60] if isinstance(w, list) else "")
def test_a_command_that_cannot_run_says_why_and_leaves_the_folder_as_it_was(place, words, hint, monkeypatch):
    if "--cluster" in words:
        pytest.importorskip("distributed")
        monkeypatch.setattr(executor, "LONGEST_WAIT", 1.0)
    if "app" in words:
        pytest.importorskip("nicegui")
    _refused(place, words, hint)


@pytest.mark.parametrize("name", SHIPS)
def test_a_ship_file_that_cannot_be_is_refused_with_what_to_try(place, name):
    text, hint = SHIPS[name]
    (place / "empty.yaml").write_text("")
    (place / "empty.nc").write_bytes(b"")
    (place / "my.yaml").write_text(text)
    _refused(place, ["coefficients", "my.yaml"], hint)


@pytest.mark.parametrize("name", CASES)
def test_a_case_file_that_cannot_be_is_refused_and_begins_no_store(place, name):
    text, hint = CASES[name]
    (place / "my.yaml").write_text(text)
    _refused(place, ["sweep", "my.yaml", "-o", "out"], hint)


def test_names_of_any_language_are_names(place):
    (place / "Schiff ü 船.yaml").write_text("base: wigley\nname: Größe 船\n")
    found = CliRunner().invoke(app, ["coefficients", "Schiff ü 船.yaml"])
    assert found.exit_code == 0
    assert "Größe 船" in found.stdout


def test_a_full_disk_behind_standard_output_is_one_message(place):
    if not Path("/dev/full").exists():
        pytest.skip("no /dev/full here")
    code = "from quartering.view.cli import main; main()"
    with open("/dev/full", "w") as full:
        found = subprocess.run(
            [sys.executable, "-c", code, "ships"],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            cwd=place,
            check=False,
        )
    assert found.returncode == 2
    assert found.stderr.startswith("quartering: No space left on device")
    assert "Traceback" not in found.stderr


AT_WORK = 6.0
"""Processor time after which a command is past its imports and in its computation [s]."""


def _worked(process):
    """Processor time of another process [s]; how long that takes depends on who else uses the machine."""
    if not Path("/proc/self/stat").exists():
        pytest.skip("the processor time of another program is read from /proc")
    fields = Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


@pytest.mark.skipif(sys.platform == "win32", reason="POSIX signals")
@pytest.mark.parametrize(
    "words",
    [
        ["polar", "wigley", "--headings", "0:180:721", "--wave-lengths", "0.4L:2.3L:400"],
        ["basin", "wigley", *CONDITION, "--periods", "10000", "-o", "b.png"],
        ["sweep", "good.yaml", "--uncertainty", "gm=2%", "--draws", "400000", "--yes"],
    ],
    ids=lambda words: words[0],
)
@pytest.mark.soak  # in the same process: tests/view/test_commands.py, Ctrl-C says so, exits 130 and leaves nothing
def test_ctrl_c_leaves_no_file_and_no_traceback(place, words):
    # compiled before: the compiler may lose an interrupt in its own clean-up, and a second one is needed
    qt.polar(qt.ship("wigley"), qt.Wave(100.0, 1.0), [5.0], [60.0, 90.0])
    before = _content(place)
    process = subprocess.Popen(
        [sys.executable, "-c", "from quartering.view.cli import main; main()", *words],
        cwd=place, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True, env=os.environ,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # a job in the background is started deaf to it
    )  # fmt: skip
    while process.poll() is None and _worked(process.pid) < AT_WORK:
        time.sleep(0.1)
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=600)[1]
    assert process.returncode == 130, said
    assert "interrupted; nothing was written" in said
    assert "Traceback" not in said
    assert _content(place) == before


def test_a_speed_or_wave_beyond_the_theory_is_doubted_once():
    """[STF70]: Froude number 0.5 of 100 m is 15.66 m/s; w sqrt(B/2g) = 3.5 at lambda = pi B/3.5^2."""
    ship, fast = qt.ship("wigley"), FASTEST * (9.81 * 100.0) ** 0.5
    assert SHORTEST * ship.hull.beam == pytest.approx(2.565, abs=1e-3)
    asked = (
        lambda speed, length: qt.equations(ship, qt.Wave(length, 0.01), speed, 60.0),
        lambda speed, length: qt.polar(ship, qt.Wave(length, 0.01), [0.0, speed], [60.0, 90.0]),
        lambda speed, length: qt.sweep(ship, [0.0, speed], [60.0, 90.0], length, 0.01, gm=[1.0, 1.1]),
        lambda speed, length: qt.wave_forces(ship, qt.Wave(length, 0.01), speed, 60.0),
    )
    for ask in asked:
        with pytest.warns(RangeWarning, match="Froude number 0.51.*is the unit right") as said:
            ask(1.02 * fast, 100.0)
        assert len(said) == 1
        with pytest.warns(RangeWarning, match=r"a wave of 2.4 m is shorter than 0.256 B") as said:
            ask(0.0, 2.4)
        assert len(said) == 1
        with pytest.warns(
            RangeWarning, match=r"a wave of 2.6 m is shorter than 0.15 L = 15 m.*try ends: strips"
        ) as said:
            ask(0.0, 2.6)
        assert len(said) == 1
        ask(0.99 * fast, 15.1)  # within all: silent, since warnings are errors here


def test_a_short_wave_on_strips_alone_is_not_doubted():
    """Their forces go over into those on a wall; three-dimensional ends have not faded out there."""
    ship = qt.ship("wigley").with_(ends="strips")
    assert np.isfinite(qt.wave_forces(ship, qt.Wave(2.6, 0.01), 0.0, 60.0)["total"]).all()


def test_a_froude_number_typed_as_a_speed_is_doubted():
    with pytest.warns(RangeWarning, match=r"0.25 m/s, Froude number 0.008; a Froude number is written 0.25Fn"):
        assert value("0.25", "speed", Sizes(100.0, 10.0, 6.0), "--speed") == 0.25
    assert value("0.25Fn", "speed", Sizes(100.0, 10.0, 6.0), "--speed") == pytest.approx(7.83, abs=0.01)
    assert value("0.25", "speed", Sizes(3.0, 0.3, 0.2), "--speed") == 0.25  # a model in a tank
