"""Stored sweeps: interrupted any way and resumed they equal an uninterrupted one, and nothing foreign is mixed in."""

import ast
import errno
import json
import os
import re
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

import quartering as qt
from quartering._machine import publish
from quartering.hydro.database.dataset import write_capytaine
from quartering.hydro.manoeuvring.measured import LIBRARY
from quartering.study.grid import LARGEST_BLOCK, grid
from quartering.study.maps import estimate as estimates
from quartering.study.maps.estimate import timed_block_size
from quartering.study.maps.kinds import SEAS, WAVES
from quartering.study.maps.result import open_result
from quartering.study.maps.stored import store as store_file
from quartering.study.maps.stored import zarr_store
from quartering.study.maps.stored.store import open_store
from quartering.study.maps.stored.zarr_store import write_zarr
from quartering.study.maps.sweep import fill
from tests.loads.own_file import of_strips

SHIP = qt.ship("series60-cb60")
LENGTH = SHIP.hull.length
CONDITIONS = {
    "speed": [0.0, 4.0, 8.0],
    "heading": np.arange(0.0, 181.0, 20.0),
    "wave_length": LENGTH * np.linspace(0.5, 2.0, 6),
    "wave_height": [0.5, 1.5, 3.0],
    "gm": [0.6, 0.9, 1.2],
}


MEASURED = estimates._seconds_each


@pytest.fixture(scope="module", autouse=True)
def _equal_blocks():
    """Files can be compared where every run begins with the same blocks, however busy the machine is."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(estimates, "_seconds_each", lambda *_: 1e-5)
        yield


@pytest.fixture(scope="module")
def uninterrupted() -> xr.Dataset:
    return qt.sweep(SHIP, **CONDITIONS)


def _blocks(folder):
    return {f.name: f.read_bytes() for f in sorted((folder / "blocks").iterdir())}


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole") / "sweep"
    qt.sweep(SHIP, **CONDITIONS, store=folder)
    return folder


def test_a_stored_sweep_is_the_sweep_in_memory_bit_by_bit(stored, uninterrupted):
    xr.testing.assert_identical(open_result(stored).load(), uninterrupted)


@pytest.mark.parametrize(
    "part",
    [
        {"loading": 1, "speed": 2},
        {"heading": slice(2, 7, 2), "wave_length": [0, 3, 5], "wave_height": -1},
        {"loading": [2, 0], "speed": 0, "heading": 3, "wave_length": 1, "wave_height": 2},
        {"heading": slice(4, 4)},
    ],
)
def test_a_part_of_a_stored_sweep_is_that_part(stored, uninterrupted, part):
    for name in ("roll", "q", "verdict", "encounter_frequency"):
        own = {k: v for k, v in part.items() if k in uninterrupted[name].dims}
        xr.testing.assert_identical(open_result(stored)[name].isel(own).load(), uninterrupted[name].isel(own))


def test_a_stored_sweep_survives_plain_netcdf(stored, uninterrupted, tmp_path):
    open_result(stored).to_netcdf(tmp_path / "all.nc")
    with xr.open_dataset(tmp_path / "all.nc") as back:
        np.testing.assert_array_equal(back["roll"], uninterrupted["roll"])


def test_a_block_opens_by_itself_with_units_and_coordinates(stored):
    with xr.open_dataset(stored / "blocks" / "0000000.nc", engine="scipy") as block:
        assert block["roll"].attrs["units"] == "deg"
        assert block["speed"].dims == ("point",)
        assert block["verdict"].dtype == np.int8


class _Stop(Exception):
    """Stands for whatever ends a run."""


@pytest.mark.parametrize("kind", [KeyboardInterrupt, _Stop])
def test_an_interrupted_sweep_keeps_its_blocks_and_computes_only_the_rest(kind, stored, uninterrupted, tmp_path):
    folder, calls = tmp_path / "s", []

    def interrupt(done, of):
        calls.append(done)
        if 0.3 * of < done:
            raise kind

    with pytest.raises(kind):
        qt.sweep(SHIP, **CONDITIONS, store=folder, progress=interrupt)
    kept = _blocks(folder)
    assert 0 < len(kept) < len(_blocks(stored))
    assert not list((folder / "blocks").glob(".*"))
    stamps = {name: (folder / "blocks" / name).stat().st_mtime_ns for name in kept}
    with pytest.raises(qt.InputError, match="not complete"):
        open_result(folder)
    half = open_result(folder, partial=True)
    assert 0 < int(np.isfinite(half["roll"]).sum()) < half["roll"].size
    first = []
    result = qt.sweep(SHIP, **CONDITIONS, store=folder, progress=lambda done, _: first.append(done))
    assert first[0] >= 0.3 * result["roll"].size  # it goes on from what was there
    assert {name: (folder / "blocks" / name).stat().st_mtime_ns for name in kept} == stamps
    assert _blocks(folder) == _blocks(stored)
    xr.testing.assert_identical(result.load(), uninterrupted)


CHILD = textwrap.dedent(
    """
    import sys, time
    import numpy as np, quartering as qt
    from quartering.study.maps import estimate
    from tests.study.test_store import SHIP, CONDITIONS
    estimate._seconds_each = lambda *_: 1e-5  # the blocks of the run it is compared with
    qt.sweep(SHIP, **CONDITIONS, store=sys.argv[1], progress=lambda done, of: time.sleep(0.05))
    """
)


def test_a_sweep_killed_at_work_goes_on_from_its_blocks(stored, tmp_path):
    """Real SIGKILL on a real process, given by itself between two blocks; the soak kills at any moment."""
    folder = tmp_path / "s"
    killed = CHILD.replace("time.sleep(0.05)", "os.kill(os.getpid(), signal.SIGKILL) if done > 0.3 * of else None")
    command = [sys.executable, "-W", "ignore", "-c", "import os, signal\n" + killed, str(folder)]
    assert subprocess.run(command, cwd=os.getcwd(), check=False).returncode == -signal.SIGKILL
    kept = [name for name in _blocks(folder) if not name.startswith(".")]
    assert 0 < len(kept) < len(_blocks(stored))
    qt.sweep(SHIP, **CONDITIONS, store=folder)
    assert {name: data for name, data in _blocks(folder).items() if not name.startswith(".")} == _blocks(stored)


@pytest.mark.soak
def test_a_sweep_killed_five_times_at_random_equals_an_uninterrupted_one(stored, tmp_path):
    """Real SIGKILL on a real process; the block files are compared byte for byte."""
    folder, random = tmp_path / "s", np.random.default_rng(6)
    seen = []
    for _ in range(5):
        process = subprocess.Popen([sys.executable, "-W", "ignore", "-c", CHILD, str(folder)], cwd=os.getcwd())
        wanted = len(seen and _blocks(folder)) + int(random.integers(1, 3))
        limit = time.monotonic() + 600
        while process.poll() is None and time.monotonic() < limit:
            if (folder / "blocks").is_dir() and len(list((folder / "blocks").glob("[0-9]*.nc"))) >= wanted:
                time.sleep(float(random.uniform(0, 0.05)))
                process.send_signal(signal.SIGKILL)
                break
            time.sleep(0.002)
        process.wait(600)
        seen.append(len(list((folder / "blocks").glob("[0-9]*.nc"))))
    assert seen == sorted(seen)
    assert seen[0] < len(_blocks(stored))
    qt.sweep(SHIP, **CONDITIONS, store=folder)
    whole = {name: data for name, data in _blocks(folder).items() if not name.startswith(".")}
    assert whole == _blocks(stored)


def test_a_full_disk_loses_nothing_and_says_what_to_do(stored, tmp_path, monkeypatch):
    folder, written = tmp_path / "s", []
    replace = os.replace

    def filling(source, target):
        if len(written) >= 3:
            raise OSError(errno.ENOSPC, "No space left on device")
        written.append(target)
        replace(source, target)

    monkeypatch.setattr(publish.os, "replace", filling)
    with pytest.raises(qt.InputError, match=r"No space left on device.*finished blocks are kept.*free"):
        qt.sweep(SHIP, **CONDITIONS, store=folder)
    monkeypatch.undo()
    assert len(_blocks(folder)) == 2  # the third name went to the description of the case
    qt.sweep(SHIP, **CONDITIONS, store=folder)
    assert _blocks(folder) == _blocks(stored)


def test_a_damaged_block_is_computed_again(stored, tmp_path):
    folder = tmp_path / "s"
    qt.sweep(SHIP, **CONDITIONS, store=folder)
    block = folder / "blocks" / "0000003.nc"
    block.write_bytes(block.read_bytes()[:2000])
    (folder / "blocks" / "0000004.nc").write_bytes(b"")
    with pytest.raises(qt.InputError, match="2 of"):
        open_result(folder)
    with pytest.warns(qt.DamageWarning, match="2 of"):
        qt.sweep(SHIP, **CONDITIONS, store=folder)
    assert _blocks(folder) == _blocks(stored)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"heading": [0.0, 90.0]}, "another case: heading there 10 values from 0 to 180, here 2 values"),
        ({"gm": [0.6, 0.9, 1.3]}, "another case: loadings"),
        ({"harmonics": 3}, "another case: harmonics there 1, here 3"),
    ],
)
def test_a_changed_case_is_not_mixed_in(stored, changes, message):
    before = _blocks(stored)
    with pytest.raises(qt.InputError, match=message):
        qt.sweep(SHIP, **(CONDITIONS | changes), store=stored)
    with pytest.raises(qt.InputError, match="another case: ship"):
        qt.sweep(SHIP.with_(gyradius_roll=6.0), **CONDITIONS, store=stored)
    assert _blocks(stored) == before


@pytest.mark.parametrize("key", ["measured", "lines", "database"])
def test_a_file_the_ship_refers_to_counts_with_its_content(key, tmp_path):
    """The same ship file, the same path beside it, other numbers in it: another case."""
    (tmp_path / "ship.yaml").write_text(f"name: mine\n{OUTSIDE_FILES[key]}")
    conditions = {"speed": 5.0, "heading": 60.0, "wave_length": 100.0, "wave_height": 1.0}

    def begin(change):
        _write_outside_file(key, tmp_path, change)
        open_store(tmp_path / "s", grid(qt.ship(tmp_path / "ship.yaml"), **conditions))

    begin(1.0)
    begin(1.0)
    with pytest.raises(qt.InputError, match="another case: ship there mine"):
        begin(1.01)


STUDY = "quartering.study."


@pytest.mark.parametrize(("kind", "first"), [(WAVES, "conditions"), (SEAS, "seas/over_seas/conditions")])
def test_every_file_a_block_is_computed_by_counts(monkeypatch, kind, first):
    """The rooms to the left count whole; of this room, what `conditions` imports of it, and what that imports."""
    counted = []
    monkeypatch.setattr(store_file, "source_digest", lambda *parts: counted.extend(parts) or "")
    store_file.code_digest(kind)
    reached, waiting = set(), [first]
    while waiting:
        name = waiting.pop()
        reached.add(name)
        tree = ast.parse((Path(qt.__file__).parent / "study" / f"{name}.py").read_text())
        modules = [node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
        own = {module.removeprefix(STUDY).replace(".", "/") for module in modules if module.startswith(STUDY)}
        waiting += own - reached
    rooms = {one for one in counted if not one.endswith(".py")}
    assert rooms - {"study/seas"} == {"hull", "hydro", "loads", "motion", "stability"}
    inside = tuple(f"{room}/" for room in rooms)
    single = {file for file in (f"study/{name}.py" for name in reached) if not file.startswith(inside)}
    assert single == set(counted) - rooms


OUTSIDE_FILES = {
    "measured": "base: s175\nmeasured: beside.yaml\n",
    "database": "base: series60-cb60\ndatabase: beside.nc\n",
    "lines": "length: 60 m\nbeam: 10 m\ndraught: 4 m\nlines: {file: beside.csv, midship: 0}\n",
}


def _write_outside_file(key, folder, change):
    """The file a ship refers to, one of its numbers multiplied."""
    if key == "measured":
        text = (LIBRARY / "son-nomoto-1982.yaml").read_text()
        printed = re.search(r"Y_v: *(-[0-9.e-]+)", text)
        (folder / "beside.yaml").write_text(text.replace(printed[0], f"Y_v: {change * float(printed[1])!r}", 1))
    elif key == "database":
        strips = of_strips(SHIP, np.linspace(0.1, 2.0, 12), np.arange(0.0, 181.0, 30.0))
        write_capytaine(strips.assign(damping=change * strips["damping"]), folder / "beside.nc", SHIP)
    else:
        rows = [f"{x},{4.9 * change * (1 - (x / 31) ** 2)},{z}" for x in range(-30, 31, 6) for z in (0, 2, 4, 6)]
        (folder / "beside.csv").write_text("\n".join(["x,y,z", *rows]) + "\n")


def test_another_version_and_a_foreign_or_broken_folder_are_refused(tmp_path):
    conditions = {"speed": 5.0, "heading": 60.0, "wave_length": LENGTH, "wave_height": 1.0}
    folder = tmp_path / "s"
    qt.sweep(SHIP, **conditions, store=folder)
    manifest = folder / "case.json"
    content = json.loads(manifest.read_text())
    manifest.write_text(json.dumps(content | {"version": "0.0.1"}))
    with pytest.raises(qt.InputError, match=r"begun by quartering 0\.0\.1"):
        qt.sweep(SHIP, **conditions, store=folder)
    manifest.write_text(json.dumps(content | {"code": "changed"}))
    with pytest.raises(qt.InputError, match="other source files"):
        qt.sweep(SHIP, **conditions, store=folder)
    manifest.write_text(json.dumps(content | {"layout": 99}))
    with pytest.raises(qt.InputError, match="layout 99"):
        open_result(folder)
    manifest.write_text("{half")
    with pytest.raises(qt.InputError, match="cannot be read"):
        qt.sweep(SHIP, **conditions, store=folder)
    manifest.unlink()  # blocks without a case are of no known case
    with pytest.raises(qt.InputError, match=r"case\.json is missing"):
        qt.sweep(SHIP, **conditions, store=folder)
    assert len(_blocks(folder)) == 1
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "thesis.txt").write_text("mine")
    with pytest.raises(qt.InputError, match="holds other files"):
        qt.sweep(SHIP, **conditions, store=tmp_path / "other")
    with pytest.raises(qt.InputError, match="is a file"):
        qt.sweep(SHIP, **conditions, store=tmp_path / "other" / "thesis.txt")
    with pytest.raises(qt.InputError, match="not the result of a sweep"):
        open_result(tmp_path / "other")
    with pytest.raises(qt.InputError, match="cannot be written"):
        qt.sweep(SHIP, **conditions, store="/proc/none/s")


def test_conflicting_axes_are_refused():
    with pytest.raises(qt.InputError, match="gm and kg"):
        qt.sweep(SHIP, 5.0, 60.0, LENGTH, 1.0, gm=[0.8], kg=[6.0])


def test_heights_of_g_share_the_wave_forces(monkeypatch):
    """Closed form: moving G by dz moves the roll moment by -dz Y; so 3 GM values cost one computation of forces."""
    from quartering.study import loading_systems

    asked = []
    find = loading_systems.excitation
    monkeypatch.setattr(loading_systems, "excitation", lambda *a, **k: asked.append(1) or find(*a, **k))
    wanted = grid(SHIP, [5.0], [30.0, 60.0], [LENGTH], [1.0], gm=[0.6, 0.9, 1.2])
    ships = [wanted.loaded(i) for i in range(3)]
    one = (np.full(2, 2 * np.pi / LENGTH), np.full(2, 5.0), np.array([30.0, 60.0]))
    for ship, together in zip(ships, loading_systems.systems(ships, *one), strict=True):
        from quartering.motion.of_ship import ship_system

        alone = ship_system(ship, *one)
        np.testing.assert_allclose(together.system.cos, alone.system.cos, rtol=1e-11, atol=1e-14)
        np.testing.assert_allclose(together.system.sin, alone.system.sin, rtol=1e-11, atol=1e-14)
    assert len(asked) == 1
    asked.clear()
    list(
        loading_systems.systems(ships, *one, form="relative-motion")
    )  # its forces depend on the height of G in another way
    assert len(asked) == 3


@pytest.mark.parametrize(("each", "size"), [(1e-5, 512), (0.01, 100), (1.0, 32)])
def test_blocks_take_a_second_where_conditions_are_dear(monkeypatch, each, size):
    """Closed form: 1 s over the time of a condition, from 32 to the usual number."""
    monkeypatch.setattr(estimates, "_seconds_each", lambda *_: each)
    assert timed_block_size(grid(SHIP, **CONDITIONS)) == size


def test_the_time_of_a_condition_is_measured(monkeypatch):
    """Of the best try, on a clock that each condition moves on: by half a second, and three times as far in other tries."""
    axes = {name: values for name, values in CONDITIONS.items() if name != "gm"}
    wanted, clock, tries = grid(SHIP, **axes), [0.0], iter([9, 3, 1, 3])  # the first compiles

    def evaluate(sample, index):
        if index == 0:
            evaluate.slow = next(tries)
        clock[0] += 0.5 * evaluate.slow * sample.count / len(sample.blocks)

    monkeypatch.setattr(estimates, "kind_of", lambda _: SimpleNamespace(evaluate=evaluate))
    monkeypatch.setattr(estimates.time, "perf_counter", lambda: clock[0])
    assert MEASURED(wanted, 500) == pytest.approx(0.5)


def test_a_store_keeps_the_blocks_it_was_begun_with_and_the_numbers_do_not_depend_on_them(
    uninterrupted, tmp_path, monkeypatch
):
    """Begun where a condition takes 25 ms, finished where it takes 10 us."""
    folder = tmp_path / "s"

    def interrupt(done, of):
        if 0.3 * of < done:
            raise _Stop

    monkeypatch.setattr(estimates, "_seconds_each", lambda *_: 0.025)
    with pytest.raises(_Stop):
        qt.sweep(SHIP, **CONDITIONS, store=folder, progress=interrupt)
    assert json.loads((folder / "case.json").read_text())["block_size"] == 40
    kept = _blocks(folder)
    monkeypatch.setattr(estimates, "_seconds_each", lambda *_: 1e-5)
    result = qt.sweep(SHIP, **CONDITIONS, store=folder)
    assert kept.items() < _blocks(folder).items()
    assert len(_blocks(folder)) > len(grid(SHIP, **CONDITIONS).blocks)
    xr.testing.assert_identical(result.load(), uninterrupted)


def test_blocks_cover_the_grid_once():
    for heights, gms, points, size in (
        (1, 1, 5, 0),
        (10, 9, 300, 0),
        (3, 2000, 2, 0),
        (1, 1, 40_000, 0),
        (10, 9, 300, 77),
    ):
        wanted = grid(
            SHIP, 5.0, np.linspace(0, 180, points), LENGTH, np.linspace(0.5, 3, heights), N_v=np.linspace(0.5, 2, gms)
        ).in_blocks_of(size)
        seen = np.zeros((gms, points), int)
        for block in wanted.blocks:
            seen[block.loadings, block.points] += 1
            assert seen[block.loadings, block.points].size * heights <= max(size or LARGEST_BLOCK, heights)
        assert (seen == 1).all()


def test_fill_counts_old_and_new_blocks_alike(tmp_path):
    wanted = grid(SHIP, 5.0, [30.0, 60.0], LENGTH, [1.0, 2.0])
    first, again = fill(wanted, tmp_path / "s"), fill(wanted, tmp_path / "s")
    assert first == again
    assert sum(n for key, n in first.items() if key.startswith("verdict")) == 4


MEASURE = textwrap.dedent(
    """
    import sys, tempfile, warnings
    import numpy as np
    warnings.simplefilter("ignore")
    from tests.study.test_store import SHIP, LENGTH
    import quartering as qt
    lengths = int(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        ds = qt.sweep(
            SHIP, np.linspace(0.0, 8.0, 8), np.linspace(0.0, 180.0, 19), LENGTH * np.linspace(0.4, 2.3, lengths),
            np.linspace(0.3, 3.0, 10), gm=[0.6, 0.9, 1.2], store=folder + "/s",
        )
        # Of this program alone: ru_maxrss of a started program counts the one that started it.
        lines = open("/proc/self/status").read().splitlines()
        print(ds["roll"].size, next(line.split()[1] for line in lines if line.startswith("VmHWM")))
    """
)


@pytest.mark.soak
def test_memory_does_not_grow_with_the_number_of_conditions():
    """Measured in processes of their own: 71 MB of results and twice that. Both fill the largest blocks; 18,000 do not."""
    if not os.path.exists("/proc/self/status"):
        pytest.skip("the peak memory of one program is read from /proc")
    peak = {}
    for lengths in (80, 160):
        command = [sys.executable, "-c", MEASURE, str(lengths)]
        count, kilobytes = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
        peak[int(count)] = int(kilobytes) / 1024
    small, large = sorted(peak)
    assert large == 2 * small
    results = (large - small) * 194 / 1e6
    assert peak[large] - peak[small] < 0.5 * results
    assert peak[large] < 1000


def test_a_stored_sweep_goes_to_zarr_part_by_part(stored, uninterrupted, tmp_path, monkeypatch):
    pytest.importorskip("zarr")
    monkeypatch.setattr(zarr_store, "_AT_A_TIME", 400)  # of 1,620: several parts
    written = write_zarr(open_result(stored), tmp_path / "all.zarr")
    with xr.open_zarr(written, chunks=None, consolidated=False) as back:
        xr.testing.assert_equal(back.load(), uninterrupted)
        assert back["roll"].attrs["units"] == "deg"
        assert back["verdict"].attrs["flag_meanings"] == uninterrupted["verdict"].attrs["flag_meanings"]
    assert [f.name for f in tmp_path.iterdir()] == ["all.zarr"]
    with pytest.raises(qt.InputError, match="there already"):
        write_zarr(uninterrupted, tmp_path / "all.zarr")
    with pytest.raises(qt.InputError, match="no folder"):
        write_zarr(uninterrupted, tmp_path / "none" / "all.zarr")
    one = write_zarr(
        uninterrupted.isel(loading=0, speed=0, heading=3, wave_length=2, wave_height=1), tmp_path / "one.zarr"
    )
    with xr.open_zarr(one, chunks=None, consolidated=False) as back:
        assert float(back["roll"]) == float(uninterrupted["roll"][0, 0, 3, 2, 1])


def test_zarr_that_is_not_installed_is_named(uninterrupted, tmp_path, monkeypatch):
    monkeypatch.setattr(zarr_store, "find_spec", lambda _: None)
    with pytest.raises(qt.InputError, match=r"quartering\[zarr\]"):
        write_zarr(uninterrupted, tmp_path / "all.zarr")
