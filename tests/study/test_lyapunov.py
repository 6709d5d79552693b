"""Growth of disturbances in a sea: against eigenvalues, Monte Carlo of an independent program, and itself."""

import numpy as np
import pytest

import quartering as qt
from quartering.motion.equations.layout import SHIP as LAYOUT
from quartering.motion.equations.system import System
from quartering.motion.sea.synthesis import RECORDS, Record, series_of
from quartering.motion.sea.windows import growth_of_disturbances
from quartering.motion.transient.rk4 import alike
from quartering.study.seas.simulated.asked import asked_of
from quartering.study.seas.simulated.planned import planned
from tests.study.sea_cases import CASES, MODEL, force


def one_mode(damping):
    """x'' + 2 z x' + (1 + f) x = 0 in roll, f a known input; sway and yaw damped faster."""
    linear = np.zeros((1, 3, 4))
    linear[0, 0, 0], linear[0, 1, 1], linear[0, 1, 2], linear[0, 2, 3] = -1.0, -1.0, -2.0 * damping, -1.0
    coefficients = np.zeros((1, 3, 1))
    coefficients[0, 1, 0] = -1.0
    return System(
        linear=linear, coefficients=coefficients, powers=np.array([[0, 1, 0, 0, 1]]), modulus=np.zeros(1, dtype=np.int64),
        mean=np.zeros((1, 3)), cos=np.zeros((1, 3)), sin=np.zeros((1, 3)), frequency=np.ones(1),
        inputs=np.zeros((1, 1, 3)), extra=np.array([-1]), strips=np.zeros((1, 0, 5)), push=-np.eye(3)[None],
        knots=np.zeros((1, 0)), cubics=np.zeros((1, 0, 4)), arm=np.zeros((1, 3)), layout=LAYOUT,
    )  # fmt: skip


def exponents(damping, variance, bandwidth, rows, h=0.1, steps=20_000):
    """Growth rates of each of some rows of records of noise with S_f = variance a/(pi (a^2 + w^2)), two-sided."""
    equations, samples = alike(one_mode(damping)), 2 * (steps + 2)
    spacing = 2 * np.pi / (samples * h / 2)
    w = spacing * np.arange(int(40.0 / spacing))
    roots = np.zeros((w.size, 4, 4), dtype=np.complex64)
    roots[:, 3, 3] = np.sqrt(2 * variance * bandwidth / np.pi / (bandwidth**2 + w**2) * spacing)
    record, found = Record(samples, h / 2, roots, 0.0), []
    for row in range(rows):
        growth, time = np.zeros(RECORDS), np.zeros(RECORDS)
        forcing = series_of(record, 11, 5, row * RECORDS)
        start = np.array([0.0, 1.0, 0.0, 0.0])
        growth_of_disturbances(equations, forcing, steps, 500, h, np.inf, start, growth, time)
        found.append(growth / time)
    return np.concatenate(found), (steps - 500) * h


# zeta, variance, bandwidth, S_f(2), exponent by an independent program's Monte Carlo and its standard error: theory,
# reference table stiffness_noise
NOISY = [
    (0.05, 0.02, 2.0, 0.00159154943092, -0.0487863883799, 6.91251792092e-05),
    (0.05, 0.04, 2.0, 0.00318309886184, -0.0473931934296, 9.17286214853e-05),
    (0.02, 0.06, 4.0, 0.00381971863421, -0.0170083501775, 0.000100167223197),
]


@pytest.mark.parametrize("case", [NOISY[1], *(pytest.param(one, marks=pytest.mark.soak) for one in NOISY[::2])])
def test_noise_in_the_stiffness_makes_disturbances_grow(case):
    """Within three combined standard errors of the Monte Carlo; the spread between records within 25 % of the closed form.

    The closed form is of weak noise: its own Monte Carlo differs from it by 4 % of the noise part at most (theory, 7.2).
    """
    damping, variance, bandwidth, spectrum, expected, error = case
    found, time = exponents(damping, variance, bandwidth, 2)
    own = found.std(ddof=1) / np.sqrt(found.size)
    assert abs(found.mean() - expected) < 3 * np.hypot(own, error)
    # weak noise by stochastic averaging: lambda = -z w + (pi/4) w^2 S(2 w), the mean square grows by twice that noise
    noise = np.pi / 4 * spectrum
    first, mean_square = noise - damping, 2 * noise - damping
    assert abs(found.mean() - first) < 3 * own + 0.04 * (first + damping)
    assert abs(found.mean() + damping) > 5 * own  # without noise it would be -damping
    # half of g(2) less lambda is the variance of ln|d| over time; 128 records tell it to 12.5 %
    np.testing.assert_allclose(found.var(ddof=1) * time, mean_square - first, rtol=0.25)


@pytest.mark.filterwarnings("ignore:sea of .* steepness:quartering.conventions.RangeWarning")
def test_in_a_low_sea_it_is_the_slowest_eigenvalue():
    """Hs to 0: the largest real part of the linear ship's own eigenvalues."""
    linear = qt.Model(np.eye(3), MODEL.terms, 1.0, (0, 0, 0), (0, 0, 0))
    sea, speed = qt.Sea(**CASES["long_beam"][0] | {"hs": 1e-4}), 0.0
    found = qt.lyapunov(linear, sea, speed, force=force, hours=32)
    matrix = np.zeros((4, 4))
    rows = {"Y": 0, "K": 2, "N": 3}
    for name, value in MODEL.terms.items():
        row, _, states = name.partition("_")
        if states in ("v", "phi", "p", "r"):
            matrix[rows[row], ("v", "phi", "p", "r").index(states)] = value
    matrix[1, 2] = 1.0
    np.testing.assert_allclose(found["lyapunov"], np.linalg.eigvals(matrix).real.max(), rtol=1e-3)
    assert float(found["mean_square"] - found["lyapunov"]) < 1e-5


@pytest.mark.filterwarnings("ignore:sea of .* steepness:quartering.conventions.RangeWarning")
def test_a_nonlinear_motion_is_stable_with_an_error_bar():
    """Dissipative cubics: more stable than at rest, near the slowest of the closure's mean Jacobian (first order)."""
    sea, speed, *_ = CASES["short_quartering"]
    found = qt.lyapunov(MODEL, qt.Sea(**sea), speed, force=force, hours=32, seed=1)
    closed = qt.sea_response(MODEL, qt.Sea(**sea), speed, method="closure", force=force)
    slowest = float(closed["exponent"].values.max())
    assert abs(float(found["lyapunov"]) - slowest) < 0.2 * abs(slowest)
    assert 0 < float(found["lyapunov_error"]) < 0.02 * abs(slowest)
    assert float(found["mean_square"]) > float(found["lyapunov"])
    again = qt.lyapunov(MODEL, qt.Sea(**sea), speed, force=force, hours=32, seed=2)
    apart = float(found["lyapunov"] - again["lyapunov"])
    assert 0 < abs(apart) < 4 * np.hypot(float(found["lyapunov_error"]), float(again["lyapunov_error"]))


def test_what_cannot_be_is_refused():
    with pytest.raises(qt.InputError, match="is no Sea"):
        qt.lyapunov(MODEL, 3.0, 5.0)
    with pytest.raises(qt.InputError, match="hours = 0"):
        qt.lyapunov(MODEL, qt.Sea(hs=1, tp=8, heading=60), 5.0, force=force, hours=0)


def test_outputs_without_room_for_every_record_are_refused():
    """They would be written past their end."""
    plan = planned(asked_of(qt.ship("wigley"), qt.Sea(hs=1, tp=8, heading=60), 5.0, None, 0, True, None, "stf")).plan
    forcing = series_of(plan.record, 0, 0, 0)
    start = np.array([0.0, 1.0, 0.0, 0.0])
    short = np.zeros(RECORDS // 2)
    with pytest.raises(ValueError, match="room for all of them"):
        growth_of_disturbances(plan.equations, forcing, 4, 2, plan.step, 1.0, start, short, short.copy())
