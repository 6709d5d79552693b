"""Before a run, while it goes, and questions to its result."""

import csv
import re

import numpy as np
import pytest

import quartering as qt
from quartering.hydro.calm_water import calm_water_exponents
from quartering.study.condition.resonance import missed_resonance
from quartering.study.effects.uncertainty import uncertain
from quartering.study.grid import grid
from quartering.study.maps.estimate import Estimate, check_size, estimate
from quartering.study.maps.kinds import WAVES
from quartering.study.maps.progress import failures, outcome, progress_line, summary
from quartering.study.maps.query import cut, worst, worst_by, write_csv
from quartering.study.maps.result import open_result
from quartering.study.maps.sweep import fill

SHIP = qt.ship("series60-cb60")
LENGTH = SHIP.hull.length


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    folder = tmp_path_factory.mktemp("q") / "sweep"
    wanted = grid(SHIP, [0.0, 6.0], [0.0, 30.0, 60.0, 90.0], LENGTH * np.linspace(0.5, 2, 5), [1.0, 3.0], gm=[0.6, 1.2])
    return folder, wanted, fill(wanted, folder)


def test_estimated_conditions_and_disk_are_what_comes(stored):
    folder, wanted, _ = stored
    found = estimate(wanted)
    assert found.conditions == wanted.count == open_result(folder)["roll"].size
    disk = sum(f.stat().st_size for f in (folder / "blocks").iterdir())
    assert 0.8 * disk < found.disk < 1.5 * disk
    assert found.seconds > 0
    assert WAVES.size > 100


def test_a_run_too_large_is_refused_unless_it_is_meant(tmp_path):
    large = Estimate(10**9, 60_000, 30_000.0, 2e11, ())
    with pytest.raises(qt.InputError, match=r"8\.3 h.*--yes"):
        check_size(large)
    check_size(Estimate(10**9, 60_000, 30_000.0, 1e6, ()), tmp_path / "not" / "there", yes=True)
    with pytest.raises(qt.InputError, match="free"):
        check_size(Estimate(10**12, 10**8, 1e7, 1e18, ()), tmp_path, yes=True)


def test_a_grid_that_steps_over_the_roll_resonance_is_told_where():
    """Closed form: in beam seas at rest omega = sqrt(2 pi g / lambda), so the peak stands at lambda = 2 pi g / n2^2."""
    z = calm_water_exponents(SHIP, 0.0)
    n2 = abs(z[np.argmax(z.imag)])
    peak = 2 * np.pi * 9.81 / n2**2
    (said,) = missed_resonance(grid(SHIP, 0.0, 90.0, [0.5 * peak, 2.0 * peak], 1.0))
    assert said.startswith(f"wave lengths between {0.5 * peak:.4g} and {2.0 * peak:.4g} m step over")
    assert missed_resonance(grid(SHIP, 0.0, 90.0, [0.5 * peak, peak, 2.0 * peak], 1.0)) == ()
    assert missed_resonance(grid(SHIP, 0.0, 90.0, [0.3 * peak, 0.5 * peak], 1.0)) == ()
    assert missed_resonance(grid(SHIP, 0.0, [0.0, 180.0], [0.5 * peak, 2.0 * peak], 1.0)) == ()
    assert missed_resonance(grid(SHIP, 0.0, 90.0, np.linspace(0.5, 2.0, 60) * peak, 1.0)) == ()


def test_speeds_that_step_over_the_roll_resonance_are_told():
    """Closed form: in quartering seas omega = sigma - k U cos(mu) falls through n2 between rest and some speed."""
    length, heading = 60.0, 45.0
    k = 2 * np.pi / length
    fast = 8.0
    speeds = np.linspace(0.0, fast, 401)
    omega = np.sqrt(9.81 * k) - k * speeds * np.cos(np.radians(heading))
    roots = [calm_water_exponents(SHIP, float(u)) for u in speeds[::20]]
    n2 = np.interp(speeds, speeds[::20], [abs(z[np.argmax(z.imag)]) for z in roots])
    peak = float(speeds[np.argmin(np.abs(omega - n2))])
    assert 1.0 < peak < 7.5
    (said,) = missed_resonance(grid(SHIP, [0.0, fast], heading, length, 1.0))
    assert said.startswith("speeds between 0 and 8 m/s step over")
    assert missed_resonance(grid(SHIP, [0.0, peak, fast], heading, length, 1.0)) == ()
    assert missed_resonance(grid(SHIP, [0.0, 0.5 * peak], heading, length, 1.0)) == ()


@pytest.mark.parametrize("axis", ["speed", "wave_length"])
def test_what_a_warning_advises_makes_it_go(axis):
    """Both ways: a value where it says, or its steps over the whole range."""
    axes = {"speed": [0.0, 8.0], "heading": [45.0], "wave_length": [60.0]}
    if axis == "wave_length":
        axes = {"speed": [5.0], "heading": [90.0], "wave_length": [100.0, 900.0]}
    (said,) = missed_resonance(grid(SHIP, **axes, wave_height=1.0))
    near, step = (float(x) for x in re.search(r"values near (\S+), or take steps of (\S+) there", said).groups())
    low, high = axes[axis]
    for values in ([low, near, high], np.arange(low, high + step, step)):
        assert missed_resonance(grid(SHIP, **(axes | {axis: values}), wave_height=1.0)) == ()


def test_a_warning_counts_every_line():
    """Two of three headings: waves from ahead do not roll the ship."""
    (said,) = missed_resonance(grid(SHIP, 5.0, [45.0, 90.0, 180.0], [60.0, 1500.0], 1.0))
    assert " on 2 of 2 lines" in said
    first, last = (float(x) for x in re.search(r"values near (\S+) to (\S+),", said).groups())
    for heading, peak in ((45.0, first), (90.0, last)):
        assert missed_resonance(grid(SHIP, 5.0, heading, [60.0, peak, 1500.0], 1.0)) == ()


def test_a_grid_without_a_warning_sees_the_peak():
    """What the warning is for: on waves low enough to be linear a grid it passes sees 0.7 of the largest roll or more."""
    n2 = abs(max(calm_water_exponents(SHIP, 0.0), key=lambda z: z.imag))
    peak = 2 * np.pi * 9.81 / n2**2
    fine = qt.sweep(SHIP, 0.0, 90.0, np.linspace(0.8, 1.25, 91) * peak, 0.02)["roll"].max()
    seen = []
    for first in np.linspace(0.5, 0.8, 7):
        lengths = peak * np.arange(first, 2.0, 0.19)
        if missed_resonance(grid(SHIP, 0.0, 90.0, lengths, 0.02)) == ():
            seen.append(float(qt.sweep(SHIP, 0.0, 90.0, lengths, 0.02)["roll"].max() / fine))
    assert seen
    assert min(seen) > 0.7


def test_progress_tells_rate_time_left_and_outcome(stored):
    _, wanted, counts = stored
    stable, unstable, failed = outcome(counts)
    assert stable + unstable + failed == wanted.count
    line = progress_line(wanted.count // 2, wanted.count, 0, 2.0, counts)
    assert "left" in line
    assert f"{stable:,} stable" in line
    facts = summary(counts, 2.0)
    assert facts["conditions"] == wanted.count
    assert sum(facts["by_verdict"].values()) == wanted.count


def test_failed_conditions_are_grouped_with_advice():
    """Closed form: omega = 0 at U = sqrt(g lambda / 2 pi) in following seas."""
    found = grid(SHIP, [0.0, np.sqrt(9.81 * 60.0 / (2 * np.pi))], [0.0], [60.0], [0.5, 1.0])
    from quartering.study.conditions import evaluate_block
    from quartering.study.maps.stored.block_file import counted

    (group,) = failures(counted(evaluate_block(found, 0), WAVES))
    assert group.conditions == 2
    assert "broaching" in group.advice


def test_the_worst_conditions_are_those_of_the_dataset(stored):
    folder, _, _ = stored
    ds = open_result(folder)
    found = worst(ds, count=5)
    assert found["roll_peak"].values.tolist() == np.sort(ds["roll_peak"].values.ravel())[::-1][:5].tolist()
    first = found.isel(rank=0)
    cell = ds.sel({name: float(first[name]) for name in ("speed", "heading", "wave_length", "wave_height")})
    cell = cell.isel(loading=int(np.flatnonzero(ds["gm"].values == float(first["gm"]))[0]))
    assert float(cell["roll_peak"]) == float(first["roll_peak"])
    assert float(worst(ds, "margin")["exponent"][0]) == float(np.nanmax(ds["exponent"].values))
    table = worst_by(ds)
    assert table["roll_peak"].dims == ("speed", "heading")
    assert float(table["roll_peak"].max()) == float(ds["roll_peak"].max())
    for bad, message in (({"by": "sway"}, "roll"), ({"count": 0}, "1 condition")):
        with pytest.raises(qt.InputError, match=message):
            worst(ds, **bad)
    with pytest.raises(qt.InputError, match="not a dimension"):
        worst_by(ds, ("time",))


def test_a_slice_goes_to_a_table_with_units(stored, tmp_path):
    folder, _, _ = stored
    ds = open_result(folder)
    lines = write_csv(ds, tmp_path / "slice.csv", ["roll", "q", "verdict"], heading=32.0, wave_height=3.0)
    with open(tmp_path / "slice.csv") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == lines == 2 * 2 * 5
    assert {"heading [deg]", "roll [deg]", "gm [m]", "q [1/s] 1", "verdict"} <= set(rows[0])
    assert {row["heading [deg]"] for row in rows} == {"30.0"}
    one = ds.sel(heading=30.0, wave_height=3.0).isel(loading=0, speed=0, wave_length=0)
    assert float(rows[0]["roll [deg]"]) == float(one["roll"])
    with pytest.raises(qt.InputError, match="not in this result"):
        write_csv(ds, tmp_path / "x.csv", ["rol"])
    with pytest.raises(qt.InputError, match="cut at"):
        write_csv(ds, tmp_path / "x.csv", headin=3.0)
    with pytest.raises(qt.InputError, match="cannot be written"):
        write_csv(ds, tmp_path / "none" / "x.csv")


def test_a_cut_takes_the_nearest_value_of_a_dimension_or_a_loading():
    ds = qt.sweep(SHIP, 5.0, [60.0, 30.0], LENGTH, [1.0, 2.0], gm=[0.6, 0.9, 1.2], N_v=[1.0, 2.0])
    one = cut(ds, gm=1.0, N_v=1.9, heading=35.0)
    np.testing.assert_array_equal(one["roll"].values, ds["roll"].isel(loading=3, heading=1).values)
    assert (float(one["gm"]), float(one["N_v"]), float(one["heading"])) == (0.9, 2.0, 30.0)
    two = cut(ds, N_v=1.0)
    np.testing.assert_array_equal(two["gm"].values, [0.6, 0.9, 1.2])
    np.testing.assert_array_equal(two["roll"].values, ds["roll"].isel(loading=[0, 2, 4]).values)
    for wrong in ("gmm", "resonance", "verdict"):
        with pytest.raises(qt.InputError, match=r"can be cut at .*wave_height.*gm, N_v"):
            cut(ds, **{wrong: 1.0})


def _edge():
    """Conditions on both sides of the edge of stability: low damping, long steep quartering waves."""
    ship = SHIP.with_(roll_damping=0.005)
    return grid(ship, [6.0], [30.0, 45.0, 60.0], LENGTH * np.linspace(0.6, 2.0, 5), [2.0, 5.0])


@pytest.mark.filterwarnings("ignore::quartering.RangeWarning")
@pytest.mark.soak
def test_probabilities_are_repeatable_and_agree_with_plain_random_draws():
    """Agreement: share of unstable verdicts over 400 pseudo-random draws of the same distribution, within 4 errors."""
    from quartering.study.conditions import evaluate_block

    wanted, spread = _edge(), {"K_p": 0.4, "gm": 0.15}
    found = uncertain(wanted, spread, draws=128, seed=3)
    again = uncertain(wanted, {"K_p": "40%", "gm": "15 %"}, draws=128, seed=3)
    assert found.identical(again)
    other = uncertain(wanted, spread, draws=128, seed=4)
    random = np.random.default_rng(0)
    factor = {n: np.exp(random.standard_normal(400) * np.sqrt(np.log1p(s**2))) for n, s in spread.items()}
    plain = type(wanted)(wanted.ship, wanted.axes, {"K_p": factor["K_p"], "gm": wanted.ship.loading.gm * factor["gm"]})
    shares = np.zeros(plain.shape[1:])
    for i, block in enumerate(plain.blocks):
        verdict = evaluate_block(plain, i)["verdict"]
        shares.reshape(15, 2)[block.points] += (verdict > 0).sum(axis=0) / 400
    p, error = found["probability_unstable"].values, found["probability_error"].values
    binomial = np.sqrt(np.maximum(shares * (1 - shares), 0.01) / 400)
    assert (np.abs(p - shares) < 4 * np.hypot(error, binomial)).all()
    assert (np.abs(p - other["probability_unstable"].values) < 6 * error).all()
    assert (error >= 1 / 130).all()
    assert ((p >= 0) & (p <= 1)).all()


def test_what_is_certain_has_probability_zero_or_one():
    steady = grid(SHIP, [0.0], [90.0], [LENGTH], [0.2], gm=[0.6, 1.0])
    found = uncertain(steady, {"N_v": "10%"}, draws=16)
    assert found["probability_unstable"].dims[0] == "loading"
    assert found["probability_unstable"].values.max() == 0.0
    assert float(found["probability_error"].max()) == pytest.approx(1 / 18)


@pytest.mark.parametrize(
    ("spread", "draws", "message"),
    [
        ({}, 64, "nothing is uncertain"),
        ({"K_ppp": -0.1}, 64, "above 0"),
        ({"K_ppp": "200%"}, 64, "100 %"),
        ({"K_pppp": 0.1}, 64, "K_ppp"),
        ({"gm": 0.1, "kg": 0.1}, 64, "one follows"),
        ({"gm": 0.1}, 10, "multiple of 8"),
        ({"kg": "50%"}, 64, r"draw \d+ of 64 is no ship: .* above 0 .*smaller uncertainty"),
    ],
)
def test_bad_uncertainties_are_refused(spread, draws, message):
    with pytest.raises(qt.InputError, match=message):
        uncertain(grid(SHIP, 5.0, 60.0, LENGTH, 1.0), spread, draws=draws)
