"""Worker processes: the same numbers wherever a block is computed, also when a worker dies."""

import asyncio
import pickle

import numpy as np
import pytest
import xarray as xr

import quartering as qt
from quartering.study.conditions import evaluate_block
from quartering.study.grid import grid
from quartering.study.maps import executor
from quartering.study.maps.result import open_result
from quartering.study.maps.sweep import fill
from quartering.study.seas.over_seas.conditions import SIMULATION
from quartering.study.seas.over_seas.grid import sea_grid
from quartering.study.seas.over_seas.settings import SeaSettings

SHIP = qt.ship("series60-cb60")
CONDITIONS = {
    "speed": [0.0, 4.0, 8.0],
    "heading": np.arange(0.0, 181.0, 10.0),
    "wave_length": SHIP.hull.length * np.linspace(0.5, 2.0, 8),
    "wave_height": [0.5, 1.5, 3.0],
    "gm": [0.6, 0.9, 1.2],
}


@pytest.fixture(autouse=True)
def event_loop():
    """A loop for distributed's client, whatever tests that drove a browser have left behind in this process."""
    loop = asyncio.new_event_loop()
    asyncio.set_event_loop(loop)
    yield
    loop.close()
    asyncio.set_event_loop(None)


@pytest.mark.parametrize("name", ["cloud", "local:0", "local:many", "tcp:host"])
def test_an_unknown_cluster_is_refused_with_the_allowed_forms(name):
    pytest.importorskip("distributed")
    with pytest.raises(qt.InputError, match=r"local:4.*tcp://"):
        qt.sweep(SHIP, 5.0, 60.0, 100.0, 1.0, cluster=name)


def test_a_missing_extra_is_named(monkeypatch):
    def absent(_):
        raise ImportError

    monkeypatch.setattr(executor, "import_module", absent)
    with pytest.raises(qt.InputError, match=r"quartering\[cluster\]"):
        qt.sweep(SHIP, 5.0, 60.0, 100.0, 1.0, cluster="local:2")


def test_a_grid_travels_to_another_process():
    executor.prepare_pickling()
    wanted = grid(SHIP, **CONDITIONS)
    there = pickle.loads(pickle.dumps(wanted))
    assert there.described == wanted.described
    np.testing.assert_array_equal(evaluate_block(there, 2)["roll"], evaluate_block(wanted, 2)["roll"])


@pytest.mark.filterwarnings("ignore")
@pytest.mark.soak
def test_a_killed_worker_costs_nothing_but_time(tmp_path):
    """Agreement bit by bit with threads; a real cluster of two processes, one killed with SIGKILL while it works."""
    distributed = pytest.importorskip("distributed")
    expected = qt.sweep(SHIP, **CONDITIONS)
    killed = []
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50
    ) as workers:

        def progress(done, of):
            if done > 0.2 * of and not killed:
                process = next(iter(workers.workers.values())).process.process
                killed.append(process.pid)
                process.kill()

        result = qt.sweep(
            SHIP, **CONDITIONS, store=tmp_path / "s", cluster=workers.scheduler_address, progress=progress
        )
        assert killed
        assert killed[0] not in {worker.process.process.pid for worker in workers.workers.values() if worker.process}
    xr.testing.assert_identical(result.load(), expected)


@pytest.mark.filterwarnings("ignore")
def test_local_workers_begin_and_end_with_the_sweep():
    pytest.importorskip("distributed")
    small = CONDITIONS | {"gm": [0.9], "heading": [30.0, 60.0]}
    xr.testing.assert_identical(qt.sweep(SHIP, **small, cluster="local:2"), qt.sweep(SHIP, **small))


@pytest.mark.soak
@pytest.mark.filterwarnings("ignore")
def test_local_workers_write_the_bytes_of_seas_that_threads_write(tmp_path):
    """Guidance in seas with a loading, one cell of it simulated: every block's file equal byte for byte, and the datasets."""
    pytest.importorskip("distributed")
    told = SeaSettings(judge="rate", hours=32.0, swell=qt.Sea(hs=1, tp=14, heading=40))
    wanted = sea_grid(SHIP, [7.5], [60.0, 150.0], [3.0, 6.0], [11.0], settings=told, gm=[0.8, 0.9]).in_blocks_of(4)
    fill(wanted, tmp_path / "threads")
    fill(wanted, tmp_path / "workers", cluster="local:2")
    files = sorted(one.name for one in (tmp_path / "threads" / "blocks").glob("*.nc"))
    assert len(files) == len(wanted.blocks) > 1
    for name in files:
        single, many = (tmp_path / way / "blocks" / name for way in ("threads", "workers"))
        assert many.read_bytes() == single.read_bytes(), name
    own = open_result(tmp_path / "threads").load()
    assert (own["rung"] == SIMULATION).any()
    xr.testing.assert_identical(open_result(tmp_path / "workers").load(), own)


@pytest.mark.filterwarnings("ignore")
@pytest.mark.soak
def test_local_workers_assess_as_threads_do():
    pytest.importorskip("distributed")
    table = xr.DataArray([[4.0], [1.0]], {"hs": [3.5, 4.5], "tz": [8.5]}, ("hs", "tz"))
    given = {"speed": 7.5, "heading": [60.0, 120.0], "occurrence": table, "spreading": None, "hours": 32}
    ship = SHIP.with_(openings="12 deg")
    own = qt.direct_assessment(ship, **given)
    assert float(own["failures"].sum()) > 0
    xr.testing.assert_identical(qt.direct_assessment(ship, **given, cluster="local:2"), own)
