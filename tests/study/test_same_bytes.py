"""A condition's numbers depend on nothing but the condition: not on its neighbours, the blocks, the threads or the workers.

Authority: by definition; every number of a grid is compared, byte for byte, with that of the same condition computed among
others.
"""

import numpy as np
import pytest

import quartering as qt
from quartering._machine import threads
from quartering._machine.rowwise import rowwise
from quartering.study import conditions
from quartering.study import grid as grids
from quartering.study.conditions import RESULTS, evaluate, evaluate_block
from quartering.study.grid import grid
from quartering.study.maps.result import in_memory
from quartering.study.maps.sweep import evaluated
from tests.loads.own_file import of_strips
from tests.tiers import mostly_soak

SPEEDS, HEADINGS = [0.0, 4.0, 8.0], np.arange(0.0, 181.0, 30.0)
RATIOS, HEIGHTS = np.array([0.55, 0.8, 1.1, 1.7]), [0.5, 2.0, 4.0]

CASES = {
    "the paper's method": ("series60-cb60", {}, {}),
    "several loadings": ("series60-cb60", {}, {"gm": [0.6, 0.9, 1.2], "N_v": [0.5, 2.0]}),
    "steepness": ("wigley", {}, {"steepness": [0.01, 0.03]}),
    "three harmonics": ("dtmb5415", {}, {"harmonics": 3}),
    "five harmonics": ("series60-cb60", {}, {"harmonics": 5, "gm": [0.5, 0.7]}),
    "relative motion": ("s175", {}, {"form": "relative-motion"}),
    "the paper's forces": ("wigley", {}, {"form": "paper"}),
    "measured": ("mariner", {}, {}),
    "bilge keels": ("series60-cb60", {"roll_damping": "ikeda", "bilge_keels": (30.0, 0.3)}, {}),
    "absolute velocities": ("s175", {"velocities": "absolute"}, {}),
    "matched drag": ("series60-cb60", {"drag": "cubic"}, {"gm": [0.6, 0.9]}),
    "other products": ("series60-cb60", {}, {"gm": [0.6, 0.9], "velocities": ["relative", "absolute"]}),
}


def _wanted(name, changes, more):
    ship = qt.ship(name).with_(**changes) if changes else qt.ship(name)
    heights = {} if "steepness" in more else {"wave_height": HEIGHTS}
    return grid(ship, SPEEDS, HEADINGS, ship.hull.length * RATIOS, **heights, **more)


def _whole(wanted):
    found = {i: evaluate_block(wanted, i) for i in range(len(wanted.blocks))}
    return in_memory(wanted, found, {})


def _same(one, other):
    for name in (*RESULTS, "encounter_frequency"):
        assert one[name].values.tobytes() == other[name].values.tobytes(), name


@pytest.mark.parametrize("case", mostly_soak(CASES, "several loadings"))
@pytest.mark.parametrize("sizes", mostly_soak([(None, 31), (7, 50, 111)], (None, 31)), ids=["few", "many"])
def test_blocks_of_any_size_give_the_same_bytes(case, sizes):
    """No size stands for one block a loading."""
    wanted = _wanted(*CASES[case])
    expected = _whole(wanted.in_blocks_of(grids.LARGEST_BLOCK))
    for size in sizes:
        _same(_whole(wanted.in_blocks_of(size or wanted.sea_count)), expected)


@pytest.mark.parametrize("case", ["several loadings", "matched drag", "other products"])
def test_batches_of_any_size_within_a_block_give_the_same_bytes(case, monkeypatch):
    """Loadings beside each other, one alone, and parts of one."""
    wanted = _wanted(*CASES[case]).in_blocks_of(grids.LARGEST_BLOCK)
    expected = _whole(wanted)
    for most in (30, 2 * wanted.point_count * wanted.sea_count):
        monkeypatch.setattr(conditions, "_OF_A_BLOCK", most)
        _same(_whole(wanted), expected)


@pytest.mark.soak
def test_blocks_of_a_ship_with_its_own_database_give_the_same_bytes(tmp_path):
    from quartering.hydro.database.dataset import write_capytaine

    ship = qt.ship("series60-cb60")
    write_capytaine(of_strips(ship, np.linspace(0.1, 2.0, 12), np.arange(0.0, 181.0, 30.0)), tmp_path / "own.nc", ship)
    (tmp_path / "own.yaml").write_text("base: series60-cb60\ndatabase: own.nc\n")
    wanted = _wanted(tmp_path / "own.yaml", {}, {"gm": [0.7, 0.9]})
    expected = _whole(wanted.in_blocks_of(grids.LARGEST_BLOCK))
    for size in (1, 20, 77):
        _same(_whole(wanted.in_blocks_of(size)), expected)


@pytest.mark.parametrize("count", mostly_soak([1, 2, 5], 1, 5))
def test_threads_of_any_number_give_the_same_bytes(count, monkeypatch):
    wanted = _wanted(*CASES["several loadings"])
    expected = _whole(wanted.in_blocks_of(grids.LARGEST_BLOCK))
    monkeypatch.setattr(threads, "_WORKERS", count)
    _same(evaluated(wanted.in_blocks_of(40)), expected)


def test_a_map_gives_the_bytes_of_each_condition_alone(monkeypatch):
    """The way of maps, which spreads one batch over threads in pieces of a size of their own."""
    ship = qt.ship("series60-cb60")
    mu, ratio = (a.ravel() for a in np.meshgrid(np.linspace(0, 180, 19), RATIOS, indexing="ij"))
    speed, length = np.full(mu.size, 7.5), ratio * ship.hull.length
    height = np.full((mu.size, 1), 3.0)
    monkeypatch.setattr(threads, "_WORKERS", 3)
    together = evaluate(ship, speed, mu, length, height, harmonics=3)
    for i in range(0, mu.size, 5):
        part = slice(i, i + 1)
        alone = evaluate(ship, speed[part], mu[part], length[part], height[part], harmonics=3)
        for name in RESULTS:
            assert alone[name].tobytes() == together[name][part].tobytes(), name


def test_a_product_row_by_row_does_not_depend_on_the_rows_beside():
    """As against ``rows @ matrix``, which on most processors does."""
    random = np.random.default_rng(2)
    rows, matrix = random.normal(size=(200, 6)), random.normal(size=(6, 128))
    whole = rowwise(rows, matrix)
    np.testing.assert_allclose(whole, rows @ matrix, rtol=0, atol=1e-13)
    for first, last in ((0, 1), (3, 5), (10, 17), (100, 199)):
        assert rowwise(rows[first:last], matrix).tobytes() == whole[first:last].tobytes()
