"""Maps say which of their stable motions the ship does not come to, and everything that shows a map says so too."""

import json
import warnings

import numpy as np
import pytest
from typer.testing import CliRunner

import quartering as qt
from quartering.motion.status import OnTheWay
from quartering.motion.steady.motion import steady_motions
from quartering.stability.assessment import assess
from quartering.stability.kind import Kind, near_fold
from quartering.study.condition.beside import capsizes_on_the_way
from quartering.study.condition.failure_events import failure_events
from quartering.study.conditions import RESULTS, evaluate_block
from quartering.study.grid import grid
from quartering.study.maps.query import capsizing
from quartering.study.maps.result import in_memory, open_result
from quartering.view.cli import app
from quartering.view.plots.polar_map import polar_map

pytestmark = pytest.mark.filterwarnings("ignore::quartering.conventions.RangeWarning")
OLD = qt.ship("dtmb5415").with_(velocities="absolute", righting="polynomial", drag="cubic")
LENGTH = OLD.hull.length
SPEEDS, HEADINGS = [6.0, 7.0], np.arange(75.0, 106.0, 5.0)
WAVES = [qt.Wave(ratio * LENGTH, ratio * LENGTH / 20) for ratio in (1.6, 1.8, 2.0, 2.2)]


@pytest.fixture(scope="module")
def ds():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return qt.polar(OLD, WAVES, SPEEDS, HEADINGS)


def cells(ds):
    """Every condition of a map with what stands there."""
    for i, j, k in np.ndindex(ds["verdict"].shape):
        yield ds.isel(speed=i, heading=j, wave_length=k)


ANGLE = np.pi / 180
END = (("sway_velocity", 1.0), ("roll", ANGLE), ("roll_rate", ANGLE), ("yaw_rate", ANGLE))
"""State at the end of a history, in SI units."""


def integrated(cell, share):
    """Code of a condition by `simulate`, its wave at a share of its height; each condition's equations made anew."""
    length, height = float(cell["wave_length"]), share * float(cell["wave_height"])
    waves = [qt.Wave(length, height * part) for part in (1 / 3, 2 / 3, 1.0)]
    models = [qt.equations(OLD, one, float(cell["speed"]), float(cell["heading"])) for one in waves]
    duration, start = 10 * 2 * np.pi / models[-1].frequency, (0.0, 0.0, 0.0, 0.0)
    upright = "capsize_time" in qt.simulate(models[-1], duration, start).attrs
    for model in models:
        trace = qt.simulate(model, duration, start)
        if "capsize_time" in trace.attrs:
            return 2 + upright
        start = tuple(float(trace[name][-1]) * unit for name, unit in END)
    return int(upright)


def test_a_cell_says_what_integration_of_that_condition_says(ds):
    """Authority: `simulate`, adaptive.  Near a saddle no step is small enough: there 0.1 % of the wave's height decides too."""
    asked = [one for one in cells(ds) if int(one["capsizes_on_the_way"]) != OnTheWay.NOT_ASKED]
    assert len(asked) > 40
    on_edge = 0
    for cell in asked:
        found = int(cell["capsizes_on_the_way"])
        if found != integrated(cell, 1.0):
            on_edge += 1
            assert found in (integrated(cell, 0.999), integrated(cell, 1.001)), cell
    assert on_edge <= 2


def test_it_is_asked_of_stable_motions_past_half_the_limit_and_of_no_unstable_one(ds):
    limit = qt.equations(OLD, WAVES[0], 7.0, 90.0).capsize_limit.angle
    asked = ds["capsizes_on_the_way"] != OnTheWay.NOT_ASKED
    stable = ds["verdict"] == int(Kind.STABLE)
    assert bool((asked | ~(stable & (ds["roll_peak"] > limit / 2))).all())
    assert not bool((asked & ~stable).any())
    assert {1, 2, 3} & set(np.unique(ds["capsizes_on_the_way"]).tolist())
    assert ds["capsizes_on_the_way"].dtype == np.int8
    assert ds["capsizes_on_the_way"].attrs["flag_meanings"] == "not_asked no from_upright wave_raised both"


def test_one_condition_and_its_cell_say_the_same(ds):
    codes = {"upright": 1, "raised": 2}
    for cell in list(cells(ds))[::7]:
        wave = qt.Wave(float(cell["wave_length"]), float(cell["wave_height"]))
        if int(cell["capsizes_on_the_way"]) != OnTheWay.NOT_ASKED:
            found = capsizes_on_the_way(qt.equations(OLD, wave, float(cell["speed"]), float(cell["heading"])))
            assert int(cell["capsizes_on_the_way"]) == sum(codes[way] for way in found)


def test_blocks_of_any_size_give_the_same_bytes():
    """By definition: a condition knows nothing of the others."""
    wanted = grid(OLD, SPEEDS, HEADINGS, [w.length for w in WAVES], steepness=[1 / 25, 1 / 20])

    def whole(size):
        sized = wanted.in_blocks_of(size)
        return in_memory(sized, {i: evaluate_block(sized, i) for i in range(len(sized.blocks))}, {})

    expected = whole(1000)
    assert capsizing(expected).any()
    for size in (7, 33):
        found = whole(size)
        for name in RESULTS:
            assert found[name].values.tobytes() == expected[name].values.tobytes(), (size, name)


def test_it_is_stored_and_taken_up_again(tmp_path):
    axes = {"speed": SPEEDS, "heading": HEADINGS, "wave_length": [w.length for w in WAVES], "steepness": [1 / 20]}
    made = qt.sweep(OLD, **axes, store=tmp_path / "s").load()
    blocks = sorted((tmp_path / "s" / "blocks").iterdir())
    blocks[-1].unlink()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        part = open_result(tmp_path / "s", partial=True)
    unknown = np.isnan(part["roll"].values) & (part["verdict"].values == int(Kind.NO_ANSWER))
    assert (part["capsizes_on_the_way"].values[unknown] == OnTheWay.NOT_ASKED).all()
    again = qt.sweep(OLD, **axes, store=tmp_path / "s").load()
    assert again["capsizes_on_the_way"].values.tobytes() == made["capsizes_on_the_way"].values.tobytes()
    assert capsizing(made).any()


def test_the_picture_crosses_these_cells_on_both_sides(ds):
    made = polar_map(ds)
    for i, panel in enumerate(made.axes[:2]):
        count = int(capsizing(ds.isel(speed=i)).sum())
        crosses = [line for line in panel.lines if line.get_gid() == "capsizes on the way"]
        assert [line.get_xdata().size for line in crosses] == ([count] * 2 if count else [])
        assert f"({count} capsize on the way)" in panel.get_title() or not count
    (legend,) = made.legends
    assert "stable motion, capsizes on the way" in [text.get_text() for text in legend.get_texts()]


def test_a_map_of_an_earlier_version_is_shown_without(ds):
    old = ds.drop_vars("capsizes_on_the_way")
    assert not capsizing(old).any()
    assert "stable motion, capsizes on the way" not in [t.get_text() for t in polar_map(old).legends[0].get_texts()]


def test_guidance_counts_it_as_a_failure_event(ds):
    failed = failure_events(ds, 1000.0)
    assert bool((failed | ~capsizing(ds)).all())
    assert bool((failed & capsizing(ds)).any())


def test_tables_of_a_result_name_it(ds, tmp_path):
    path = tmp_path / "map.nc"
    ds.to_netcdf(path)
    asked = CliRunner().invoke(app, ["worst", str(path), "--count", str(ds["verdict"].size), "--json"])
    rows = json.loads(asked.stdout)["worst"]
    named = [row for row in rows if row["verdict"] == "stable motion, capsizes on the way"]
    assert len(named) == int(capsizing(ds).sum())
    shares = json.loads(CliRunner().invoke(app, ["show", str(path), "--json"]).stdout)["capsizing"]
    np.testing.assert_allclose(shares, capsizing(ds).mean("wave_length"))


@pytest.mark.parametrize(("square", "near"), [(0.10, False), (0.15, False), (0.22, True), (0.235, True)])
def test_near_a_fold_a_half_period_multiplier_is_real_and_negative(square, near):
    """Closed form: averaged x'' + c x' + x - b x^3 = F cos wt, s = 1 - w^2, e = 3 b/4, amplitude squared A.

    F^2 = A ((s - e A)^2 + (c w)^2); the exponents are real from A = s/(3 e) = 0.2005 to the fold, at 0.247.
    """
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_p": -0.1, "K_phiphiphi": 0.5}
    force = (square * ((1 - 0.88**2 - 0.375 * square) ** 2 + 0.088**2)) ** 0.5
    model = qt.Model(np.eye(3), terms, 0.88, (0, force, 0), (0, 0, 0))
    u, orders, *_ = steady_motions(model.system, 3, start="rest")
    found = assess(model.system, u, orders)
    assert found.kind[0] == Kind.STABLE
    assert bool(near_fold(found.floquet)[0]) is near
