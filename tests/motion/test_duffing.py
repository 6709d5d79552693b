"""Single-degree benchmarks: Duffing's equation carried by the roll row."""

import numpy as np
import pytest

from quartering.motion.equations import Model
from quartering.motion.harmonic import harmonic_balance
from quartering.motion.steady import steady_motion
from tests.reference import DYNAMICS


def duffing(beta: float, force: float, frequency: float, damping: float = 0.0) -> Model:
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -beta, "K_p": -damping}
    return Model(np.eye(3), terms, frequency, force_cos=(0, force, 0), force_sin=(0, 0, 0))


ROWS = [(row, i) for row in DYNAMICS["duffing"]["rows"] for i in range(len(row["exact"]))]


@pytest.mark.parametrize(("row", "i"), ROWS, ids=[f"w={row['w']}-{i}" for row, i in ROWS])
def test_appendix_c_equation_c4_is_one_harmonic_balance(row, i):
    """[H71] (C-4): w^2 = 1 + 3/4 beta P^2 - X0/P, roots in 40-digit arithmetic."""
    exact, beta, force = row["exact"][i], DYNAMICS["duffing"]["beta"], DYNAMICS["duffing"]["X0"]
    start = np.zeros((1, 3, 2))
    start[0, 1, 0] = exact["start"]
    u, status, _ = harmonic_balance(duffing(beta, force, row["w"]).system, (1,), start=start * 1.0001)
    assert status[0] == 0
    assert u[0, 1, 0] == pytest.approx(row["C4"][i], rel=1e-12)


@pytest.mark.parametrize(("row", "i"), ROWS, ids=[f"w={row['w']}-{i}" for row, i in ROWS])
def test_many_harmonics_reach_the_exact_duffing_motion(row, i):
    """Exact symmetric solutions in 40-digit arithmetic; 21 harmonics leave less than 1e-9."""
    exact, beta, force = row["exact"][i], DYNAMICS["duffing"]["beta"], DYNAMICS["duffing"]["X0"]
    orders = tuple(range(1, 22, 2))
    start = np.zeros((1, 3, 2 * len(orders)))
    start[0, 1, 0] = exact["start"]
    u, status, _ = harmonic_balance(duffing(beta, force, row["w"]).system, orders, start=start)
    assert status[0] == 0
    np.testing.assert_allclose(u[0, 1, [0, 2, 4]], [exact["a1"], exact["a3"], exact["a5"]], atol=1e-9)
    assert u[0, 1, ::2].sum() == pytest.approx(exact["x0"], abs=1e-9)


# x'' + c x' + x + beta x^3 = F cos wt by shooting (relative tolerance 1e-12), accurate to 1e-8:
# c, beta, F, w, first and third amplitude.
FORCED = [
    (0.05, 0.1, 0.18, 0.5, 0.238509915, 0.000272731),
    (0.05, 0.1, 0.18, 0.8, 0.474872047, 0.000566268),
    (0.05, 0.1, 0.18, 1.0, 1.305345473, 0.007179364),
    (0.05, 0.1, 0.18, 1.1, 1.938630343, 0.019533673),
]


@pytest.mark.parametrize(("c", "beta", "force", "w", "first", "third"), FORCED)
def test_damped_duffing_agrees_with_shooting(c, beta, force, w, first, third):
    motion = steady_motion(duffing(beta, force, w, c), harmonics=11)
    amplitude = np.hypot(motion.cos[:2, 1], motion.sin[:2, 1])
    np.testing.assert_allclose(amplitude, [first, third], atol=1e-8)


def test_steady_heel_of_a_biased_duffing_is_the_static_root():
    """Closed form: without a wave the mean heel solves phi + beta phi^3 = F0."""
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.5, "K_p": -0.1}
    model = Model(np.eye(3), terms, 0.7, (0, 1e-9, 0), (0, 0, 0), force_mean=(0, 0.3, 0))
    motion = steady_motion(model, harmonics=3)
    heel = motion.mean[1]
    assert heel + 0.5 * heel**3 == pytest.approx(0.3, rel=1e-12)
    assert motion.orders == (1, 2, 3)


def test_quadratic_stiffness_shifts_the_mean_as_second_order_theory_says():
    """Closed form: x'' + c x' + x + e x^2 = F cos wt has mean -e a^2/2 to first order in e."""
    e, force = 1e-4, 0.2
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphi": -e, "K_p": -0.1}
    motion = steady_motion(Model(np.eye(3), terms, 0.6, (0, force, 0), (0, 0, 0)), harmonics=3)
    amplitude = force / np.hypot(1 - 0.36, 0.06)
    assert motion.mean[1] == pytest.approx(-e * amplitude**2 / 2, rel=1e-3)


def test_energy_balance_of_quadratic_damping():
    """Closed form: at resonance F = w a (c + 8/(3 pi) b w a), the energy |p|p takes out of a harmonic motion."""
    b, c, force = 0.3, 0.01, 0.05
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_p": -c, "K_p|p|": -b}
    u, status, _ = harmonic_balance(Model(np.eye(3), terms, 1.0, (0, force, 0), (0, 0, 0)).system, (1,))
    assert status[0] <= 1
    drag = 8 / (3 * np.pi) * b
    expected = (-c + np.sqrt(c**2 + 4 * drag * force)) / (2 * drag)
    # 64 samples of a function with a kink: the projection of |p|p is good to 1e-3.
    assert np.hypot(*u[0, 1]) == pytest.approx(expected, rel=1e-3)
