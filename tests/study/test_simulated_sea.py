"""Simulation in a sea against an independent program, closed forms, and itself in other orders."""

import numpy as np
import pytest

import quartering as qt
from quartering._machine import threads
from quartering.motion.sea.march import march
from quartering.motion.sea.rational import rational_fit
from quartering.motion.sea.synthesis import RECORDS, Record, series_of
from quartering.motion.transient.rk4 import alike
from quartering.study.seas.simulated import blocks
from quartering.study.seas.simulated.failures import failure_rate, waiting_times_p
from tests.study.sea_cases import CASES, MODEL, force, matrix

SHIP = qt.ship("series60-cb60")
STEEP = pytest.mark.filterwarnings("ignore:sea of .* steepness:quartering.conventions.RangeWarning")
LINEAR = qt.Model(np.eye(3), dict(list(MODEL.terms.items())[:12]), 1.0, (0, 0, 0), (0, 0, 0))
# mean largest |roll| of half an hour of the nonlinear ship [deg] and its standard error; of 3 h of the linear ship over its
# root mean square: the same independent program's Monte Carlo, 256 hours and 1,920 records
LARGEST = {
    "long_quartering": (28.4808883273, 0.126673972791, 3.458, 0.0086),
    "short_quartering": (32.9149118975, 0.182075470902, 3.7933, 0.0076),
    "long_beam": (33.510610728, 0.178475246711, 3.9331, 0.0073),
}


def within(found, error, expected, own_error=0.0, times=3.0):
    assert abs(float(found) - expected) < times * np.hypot(float(error), own_error), (float(found), expected)


@STEEP
@pytest.mark.parametrize("hours", [(64, 320), pytest.param((512, 1920), marks=pytest.mark.soak)])
@pytest.mark.parametrize("name", CASES)
def test_three_seas_of_an_independent_program(name, hours):
    """Roll, largest roll within three combined standard errors of its Monte Carlo; linear covariances of its integral."""
    sea, speed, linear, _, (roll, error), *_ = CASES[name]
    found = qt.irregular(MODEL, qt.Sea(**sea), speed, force=force, hours=hours[0], seed=1, limit=1.5)
    within(found["roll_rms"], found["roll_rms_error"], roll, error)
    largest, largest_error, linear_largest, linear_error = LARGEST[name]
    own = found["roll_largest"].values
    within(own.mean(), own.std() / np.sqrt(own.size), largest, largest_error)
    found = qt.irregular(LINEAR, qt.Sea(**sea), speed, force=force, hours=hours[1], seed=2, limit=1.5)
    expected, error = matrix(linear), found["covariance_error"].values
    deviation = np.sqrt(np.diag(expected))
    # ten different covariances, most of them independent: 3.5 standard errors, and the program's own grid of 1e-3
    assert (np.abs(found["covariance"].values - expected) < 3.5 * error + 1e-3 * np.outer(deviation, deviation)).all()
    ratio = float(found["roll_mean_largest"] / found["roll_rms"])
    wrong = ratio * np.hypot(*(float(found[f"{one}_error"] / found[one]) for one in ("roll_mean_largest", "roll_rms")))
    within(ratio, wrong, linear_largest, linear_error)


def oscillator(limit, c, d, cubic, hours, seed=3):
    """Decay rate of x'' + c x' + x + k3 x^3 = w staying below a limit, through the records and the march of the product.

    White noise of <w w'> = 2 D delta up to 8 times the natural frequency: beyond it is 1e-4 of the motion.
    """
    terms = {"Y_v": -1.0, "K_phi": -1.0, "K_phiphiphi": -cubic, "K_p": -c, "N_r": -1.0}
    equations = alike(qt.Model(np.eye(3), terms, 1.0, (0, 0, 0), (0, 0, 0)).system)
    h, steps, first, times, causes = 0.1, 20_000, 1_000, [], []
    samples = 2 * (steps + 2)
    spacing = 2 * np.pi / (samples * h / 2)
    roots = np.zeros((int(8.0 / spacing), 3, 3), dtype=np.complex64)
    roots[:, 1, 1] = np.sqrt(2 * d / np.pi * spacing)  # one-sided density 2 D/pi
    record = Record(samples, h / 2, roots, 0.0)
    for row in range(hours):
        forcing = series_of(record, seed, 7, row * RECORDS)
        time, cause = np.full(RECORDS, (steps - first) * h), np.zeros(RECORDS, dtype=np.int64)
        sums, largest = np.zeros((16, RECORDS)), np.zeros((2, RECORDS))
        march(equations, forcing, steps, first, h, 0.0, 0.0, 0.0, limit, np.inf, sums, largest, time, cause)  # fmt: skip
        times.append(time)
        causes.append(cause)
    time, cause = np.concatenate(times), np.concatenate(causes)
    counted = cause != 3
    return time[counted], int((cause == 1).sum()), (steps - first) * h


# c, D, k3, limit: decay rate by the backward equation with its own error, as an independent program has it
@pytest.mark.parametrize(
    ("c", "d", "cubic", "limit", "rate", "tolerance", "rows"),
    [(0.1, 0.1, 0.0, 3.0, 1.81e-3, 0.02, 1), (0.1, 0.005, -1.0, 1.3, 1.155e-3, 0.06, 1)],
)
def test_first_passages_come_at_the_rate_of_the_backward_equation(c, d, cubic, limit, rate, tolerance, rows):
    """Crossings counted as independent would give twice as many; the runs begin from rest and a run-up."""
    time, failures, block = oscillator(limit, c, d, cubic, rows)
    found = failure_rate(failures, time.sum())
    error = found.rate / np.sqrt(failures)
    within(found.rate, error, rate, tolerance * rate)
    assert found.lower < found.rate < found.upper
    assert waiting_times_p(time[time < block], block, found.rate) > 0.01


def test_intervals_of_counts():
    """Quantiles of gamma distributions by an independent program, to 1e-6."""
    rows = [(0, 0.0, 3.68887945411, 2.99573227355), (1, 0.0253178079843, 5.57164339094, 4.74386451839),
            (2, 0.242209278544, 7.22468766772, 6.29579362187), (5, 1.62348639012, 11.6683320793, 10.5130349087),
            (10, 4.79538869613, 18.390356042, 16.9622192357), (30, 20.2408740214, 42.8268653948, 40.6905075944),
            (100, 81.3639912509, 121.626793792, 118.079272782)]  # fmt: skip
    for failures, lower, upper, one_sided in rows:
        np.testing.assert_allclose(failure_rate(failures, 1.0)[1:], (lower, upper), rtol=1e-6)
        np.testing.assert_allclose(failure_rate(failures, 1.0, 0.9).upper, one_sided, rtol=1e-6)  # 95 % to one side
    for confidence, hours in (
        (0.95, 1024.68873725),
        (0.9, 832.147853765),
    ):  # without a failure: the rate is below 1e-6 1/s
        np.testing.assert_allclose(failure_rate(0, 1.0, confidence).upper / 1e-6 / 3600.0, hours, rtol=1e-6)


@pytest.mark.filterwarnings("ignore::quartering.conventions.RangeWarning")
def test_blocks_do_not_depend_on_threads_length_or_interrupts(monkeypatch, tmp_path):
    """The same numbers to the last bit: on one core and on four, in one go and in two, after an interrupt, in a longer run."""
    given = {"force": force, "seed": 5, "limit": 0.5}
    sea, speed = qt.Sea(**CASES["long_quartering"][0]), 8.0
    monkeypatch.setattr(threads, "_WORKERS", 1)
    whole = qt.irregular(MODEL, sea, speed, hours=128, **given)
    assert 0 < int(whole["failures"]) < whole.sizes["block"]
    monkeypatch.setattr(threads, "_WORKERS", 4)
    assert whole.identical(qt.irregular(MODEL, sea, speed, hours=128, **given))
    part = qt.irregular(MODEL, sea, speed, hours=32, **given)
    np.testing.assert_array_equal(part["roll_largest"], whole["roll_largest"][:64])
    assert not np.array_equal(
        part["roll_largest"], qt.irregular(MODEL, sea, speed, hours=32, **given | {"seed": 6})["roll_largest"]
    )
    file, asked, rows = tmp_path / "blocks.npz", [], blocks.Plan.row

    def interrupted(plan, number):
        asked.append(number)
        if number == 2:
            raise KeyboardInterrupt
        return rows(plan, number)

    monkeypatch.setattr(threads, "_WORKERS", 1)
    monkeypatch.setattr(blocks.Plan, "row", interrupted)
    with pytest.raises(KeyboardInterrupt):
        qt.irregular(MODEL, sea, speed, hours=128, store=file, **given)
    monkeypatch.setattr(blocks.Plan, "row", lambda plan, number: asked.append(number) or rows(plan, number))
    assert whole.identical(qt.irregular(MODEL, sea, speed, hours=128, store=file, **given))
    assert asked == [0, 1, 2, 2, 3]
    with pytest.raises(qt.InputError, match="another ship, sea, seed"):
        qt.irregular(MODEL, sea, speed, hours=128, store=file, **given | {"seed": 6})


@STEEP
def test_a_run_stops_at_the_error_it_measures():
    """Half hours between blocks: a tenth of the blocks for three times the error, in whole rows."""
    given = {"force": force, "seed": 5, "limit": 1.5}
    found = qt.irregular(MODEL, qt.Sea(**CASES["long_beam"][0]), 0.0, hours=2000, until=0.005, **given)
    assert float(found["roll_rms_error"] / found["roll_rms"]) <= 0.005
    assert 32 < float(found["exposure"]) < 500
    before = found["roll_largest"].size - 64
    shorter = qt.irregular(MODEL, qt.Sea(**CASES["long_beam"][0]), 0.0, hours=before / 2, **given)
    assert float(shorter["roll_rms_error"] / shorter["roll_rms"]) > 0.005


@pytest.mark.filterwarnings("ignore:.* are not exponential:quartering.conventions.RangeWarning")
@STEEP
def test_failures_by_acceleration_and_in_the_run_up():
    sea, given = qt.Sea(**CASES["long_beam"][0]), {"force": force, "limit": 1.5}
    calm = qt.irregular(MODEL, sea, 0.0, **given)
    assert int(calm["failures"]) == 0
    assert float(calm["exposure"]) == 32.0
    assert np.isfinite(calm["rate_upper"])
    top = float(calm["lateral_acceleration_largest"].max())
    felt = qt.irregular(MODEL, sea, 0.0, acceleration_limit=0.9 * top, **given)
    assert 0 < int(felt["failures"]) == int(felt["failures_by_acceleration"])
    past = calm["lateral_acceleration_largest"].values > 0.9 * top
    np.testing.assert_array_equal(felt["failure_cause"].values == 2, past)
    growing = qt.Model(np.eye(3), {"Y_v": -1.0, "K_phi": -1.0, "K_p": 0.2, "N_r": -1.0}, 1.0, (0, 0, 0), (0, 0, 0))
    with pytest.warns(qt.RangeWarning, match="64 of 64 blocks failed in their run-up"):
        found = qt.irregular(growing, sea, 0.0, **given)
    assert float(found["exposure"]) == 0.0
    assert np.isnan(found["failure_rate"])
    assert np.isinf(found["rate_upper"])


SEAS = [
    (60, None, 6, 11), (45, None, 6, 11), (30, None, 6, 11), (90, None, 4, 9), (90, 10, 6, 11), (120, None, 5, 11),
    (60, 10, 6, 11), (45, 10, 4, 10), (75, "cos2", 5, 9), (60, None, 3, 9), (135, 5, 6, 12), (150, 25, 4, 8),
]  # fmt: skip


# the seas that the closure was first measured in: theory, 6.2
MORE_SEAS = [
    (heading, spreading, hs, 11) for heading in (45, 60, 90) for spreading in (None, 10) for hs in (1, 2, 4, 6)
]


@pytest.mark.filterwarnings("ignore::quartering.conventions.RangeWarning")
@pytest.mark.parametrize(
    ("change", "seas", "hours"),
    [({}, [(120, 10, 4, 9)], 64), ({"drag": "cubic"}, [(60, 10, 4, 9)], 64),
     pytest.param({}, SEAS, 256, marks=pytest.mark.soak), pytest.param({}, MORE_SEAS, 64, marks=pytest.mark.soak)],
)  # fmt: skip
def test_the_closure_and_simulation_with_memory_agree(change, seas, hours):
    """Two independent ways: deviations of v, phi, p, r and lateral acceleration within 5 %, beyond three standard errors."""
    ship = SHIP.with_(**change)
    for heading, spreading, hs, tp in seas:
        sea = qt.Sea(hs=hs, tp=tp, heading=heading, spreading=spreading)
        found = qt.irregular(ship, sea, 7.5, hours=hours, seed=4)
        closed = qt.sea_response(ship, sea, 7.5, method="closure")
        c, error = np.diag(found["covariance"]), np.diag(found["covariance_error"])
        assert (np.abs(np.sqrt(np.diag(closed["covariance"]) / c) - 1) < 0.05 + 1.5 * error / c).all(), (heading, hs)
        ratio = float(closed["lateral_acceleration_rms"] / found["lateral_acceleration_rms"])
        assert abs(ratio - 1) < 0.05 + 3 * float(
            found["lateral_acceleration_rms_error"] / found["lateral_acceleration_rms"]
        )


@STEEP
def test_without_memory_a_beam_sea_is_warned_of():
    """The closure with coefficients of free roll in every cell is the standard the simulation without memory has to meet."""
    with pytest.warns(qt.RangeWarning, match="changes by -18% in roll and"):
        found = qt.irregular(SHIP, qt.Sea(hs=4, tp=9, heading=90), 7.5, hours=64, seed=4, memory=False)
    closed = qt.sea_response(SHIP, qt.Sea(hs=4, tp=9, heading=90), 7.5, method="closure")
    np.testing.assert_allclose(found["roll_rms"] / closed["roll_rms"], 1 - 0.18, rtol=0.03)


@STEEP
def test_a_fit_does_not_run_away_beyond_its_samples():
    """A fit that is near in its band but has a hundredth of the yaw inertia beyond it ends every block in its run-up."""
    found = qt.irregular(qt.ship("wigley"), qt.Sea(hs=2, tp=8, heading=60, spreading=10), "10kn", seed=1)
    closed = qt.sea_response(qt.ship("wigley"), qt.Sea(hs=2, tp=8, heading=60, spreading=10), "10kn", method="closure")
    np.testing.assert_allclose(found["roll_rms"], closed["roll_rms"], rtol=0.05)
    assert int((found["failure_cause"] == 3).sum()) == 0


@STEEP
def test_a_step_is_short_enough_for_what_the_memory_makes_fast():
    """Where fit and motion together are faster than either (2.9 over a step of 0.3 rad of roll), Runge-Kutta, which ends at
    2.78, fails in every run-up. The closure is the standard, within 5 % as in other seas."""
    sea = qt.Sea(hs=2, tz=12.5, heading=90, spectrum="bretschneider", spreading="cos2")
    found = qt.irregular(SHIP, sea, 7.5, seed=1)
    assert int((found["failure_cause"] == 3).sum()) == 0
    closed = qt.sea_response(SHIP, sea, 7.5, method="closure")
    ratio = float(found["roll_rms"] / closed["roll_rms"])
    assert abs(ratio - 1) < 0.05 + 3 * float(found["roll_rms_error"] / found["roll_rms"])


def pair(passive, alpha=0.5, other=0.9):
    """Two transfer functions with closed form: s/(s^2 + 2 a s + w0^2), and one whose real part is below 0 at low frequency."""
    w = np.linspace(0.05, 3.0, 80)
    s = 1j * w
    if passive:
        return w, s / (s * s + 2 * alpha * s + other**2)
    return w, s * (s + alpha) / (((s + alpha) ** 2 + other**2) * (s + alpha + other))


@pytest.mark.parametrize(("passive", "order"), [(True, 2), (False, 3)])
def test_a_rational_fit_finds_poles_and_passivity(passive, order):
    """Poles in closed form: -a +- i sqrt(w0^2 - a^2); of the other -a +- i b and -(a + b), and it gives energy."""
    w, memory = pair(passive)
    fit = rational_fit(w, (2.0j * w + 0.3 + memory)[:, None, None], order)
    np.testing.assert_allclose(fit.memory(w)[:, 0, 0], memory, atol=1e-9)
    np.testing.assert_allclose((fit.slope[0, 0], fit.constant[0, 0]), (2.0, 0.3), rtol=1e-9)
    expected = [-0.5 + 1j * np.sqrt(0.56)] if passive else [-0.5 + 0.9j, -1.4]
    np.testing.assert_allclose(sorted(fit.poles[fit.poles.imag >= -1e-9], key=abs), expected, atol=1e-8)
    assert (fit.poles.real < 0).all()
    assert (fit.least_damping(np.linspace(0, 20, 400)) >= -1e-9) == passive


@STEEP
def test_an_autopilot_and_highest_position_take_part():
    ship = SHIP.with_(highest_position={"x": 0.0, "height": 25.0}, autopilot="1,10s")
    found = qt.irregular(ship, qt.Sea(hs=4, tp=10, heading=60), 7.5, seed=1)
    assert found.attrs["acceleration_limit"] == 9.81
    closed = qt.sea_response(ship, qt.Sea(hs=4, tp=10, heading=60), 7.5, method="closure")
    np.testing.assert_allclose(found["lateral_acceleration_rms"], closed["lateral_acceleration_rms"], rtol=0.03)


def test_a_ship_that_does_not_keep_its_course_is_said_to_turn():
    """Eigenvalues with the coefficients of slow motion, 0.01 rad/s, tell the growth; steered, closure and simulation agree."""
    ship, speed, sea = qt.ship("coaster-90m"), 5.9, qt.Sea(hs=1.8, tp=9.5, spreading=10, heading=60)
    slow = qt.coefficients(ship, [0.01], [speed])
    forces = np.zeros((3, 4))
    forces[:, [0, 2, 3]], forces[1, 1] = slow.linear[0], -9.81 * qt.hydrostatics(ship).mass * ship.loading.gm
    rates = np.insert(np.linalg.solve(slow.inertia[0], forces), 1, [0.0, 0.0, 1.0, 0.0], axis=0)
    growth = np.linalg.eigvals(rates).real.max()
    with pytest.warns(qt.RangeWarning, match=rf"nobody steers, .* grow by {growth:.1g}"):
        turning = qt.irregular(ship, sea, speed, hours=32, seed=1)
    steered = ship.with_(autopilot="1,10s")
    found, closed = (
        qt.irregular(steered, sea, speed, hours=32, seed=1),
        qt.sea_response(steered, sea, speed, method="closure"),
    )
    within(found["roll_rms"], found["roll_rms_error"], closed["roll_rms"], 0.01 * float(closed["roll_rms"]))
    yaw = [float(one["covariance"].sel(state="r", state_2="r")) for one in (turning, found)]
    assert yaw[0] > 2 * yaw[1]


def test_components_that_repeat_are_said():
    """50 components over 0.2 to 1.2 rad/s: 2 pi over their distance, 308 s."""
    w = np.linspace(0.2, 1.2, 50)
    given = (LINEAR, w, np.full((50, 3), 1e-4), np.zeros((1, 50)))
    with pytest.warns(qt.RangeWarning, match=r"repeat their groups of waves every 307\.9 s"):
        qt.irregular(*given, 400.0)
    assert qt.irregular(*given, duration=300.0).sizes["realisation"] == 1


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: qt.irregular(SHIP), "sea = None is no Sea"),
        (lambda: qt.irregular(SHIP, [qt.Sea(hs=2, tp=9)], 5.0), "is no Sea; give one"),
        (lambda: qt.irregular("x", qt.Sea(hs=2, tp=9), 5.0), "is no Ship or Model"),
        (lambda: qt.irregular(SHIP, qt.Sea(hs=2, tp=9), 5.0, hours=0), "hours = 0"),
        (lambda: qt.irregular(SHIP, qt.Sea(hs=2, tp=9), 5.0, seed=-1), "seed = -1; it is a whole number"),
        (lambda: qt.irregular(SHIP, qt.Sea(hs=2, tp=9), 5.0, seed=1.5), "seed = 1.5; it is a whole number"),
        (lambda: qt.irregular(SHIP, qt.Sea(hs=2, tp=9), 5.0, strips=0), "strips = 0; it is a whole number"),
        (lambda: qt.irregular(SHIP, qt.Sea(hs=2, tp=9), 5.0, until=2.0), "until = 2"),
        (lambda: qt.irregular(SHIP, qt.Sea(hs=2, tp=9), 5.0, step=60.0), "step = 60 s; it is at most 18 s"),
        (lambda: qt.irregular(SHIP, qt.Sea(hs=2, tp=9), 5.0, 400.0), "heading = 400 deg"),
        (lambda: qt.irregular(SHIP, qt.Sea(hs=2, tp=9), 5.0, force=force), "force is given beside a ship"),
        (lambda: qt.irregular(MODEL, qt.Sea(hs=2, tp=9), 5.0), "force is missing"),
        (lambda: qt.irregular(SHIP, qt.Sea(hs=2, tp=9), 5.0, store="no/such/folder/x.npz"), "in a folder that exists"),
        (lambda: qt.irregular(SHIP, qt.Sea(hs=2, tp=9), 5.0, acceleration_limit=0.0), "acceleration_limit = 0"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused(call, words):
    with pytest.raises(qt.InputError, match=words):
        call()


def test_a_file_of_something_else_is_refused(tmp_path):
    (tmp_path / "x.npz").write_text("something")
    with pytest.raises(qt.InputError, match="no file of a simulation"):
        qt.irregular(SHIP, qt.Sea(hs=2, tp=9), 5.0, store=tmp_path / "x.npz")
