"""Single-degree benchmarks: Duffing's equation carried by the roll row."""

import numpy as np
import pytest

from quartering.conventions import InputError
from quartering.motion.equations.model import Model
from quartering.motion.steady.harmonic import harmonic_balance
from quartering.motion.steady.motion import steady_motion
from quartering.motion.steady.struble import modified_struble
from quartering.study.branches.coexisting import all_motions
from quartering.study.paper.duffing_formulas import duffing_amplitudes, duffing_model
from tests.reference import DYNAMICS

ROWS = [(row, i) for row in DYNAMICS["duffing"]["rows"] for i in range(len(row["exact"]))]


@pytest.mark.parametrize(("row", "i"), ROWS, ids=[f"w={row['w']}-{i}" for row, i in ROWS])
def test_appendix_c_equation_c4_is_one_harmonic_balance(row, i):
    """[H71] (C-4): w^2 = 1 + 3/4 beta P^2 - X0/P, roots in 40-digit arithmetic."""
    exact, beta, force = row["exact"][i], DYNAMICS["duffing"]["beta"], DYNAMICS["duffing"]["X0"]
    start = np.zeros((1, 3, 2))
    start[0, 1, 0] = exact["start"]
    u, status, _ = harmonic_balance(duffing_model(beta, force, row["w"]).system, (1,), start=start * 1.0001)
    assert status[0] == 0
    assert u[0, 1, 0] == pytest.approx(row["C4"][i], rel=1e-12)


@pytest.mark.parametrize(("row", "i"), ROWS, ids=[f"w={row['w']}-{i}" for row, i in ROWS])
def test_many_harmonics_reach_the_exact_duffing_motion(row, i):
    """Exact symmetric solutions in 40-digit arithmetic; 21 harmonics leave less than 1e-9."""
    exact, beta, force = row["exact"][i], DYNAMICS["duffing"]["beta"], DYNAMICS["duffing"]["X0"]
    orders = tuple(range(1, 22, 2))
    start = np.zeros((1, 3, 2 * len(orders)))
    start[0, 1, 0] = exact["start"]
    u, status, _ = harmonic_balance(duffing_model(beta, force, row["w"]).system, orders, start=start)
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
    motion = steady_motion(duffing_model(beta, force, w, c), harmonics=11)
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


@pytest.mark.parametrize("row", DYNAMICS["duffing"]["rows"], ids=lambda r: f"w={r['w']}")
@pytest.mark.parametrize(("formula", "key"), [("C-3", "C3"), ("C-4", "C4"), ("C-5", "C5")])
def test_the_three_formulas_of_appendix_c(row, formula, key):
    """Roots of [H71] (C-3), (C-4), (C-5) in 40-digit arithmetic."""
    found = duffing_amplitudes(formula, DYNAMICS["duffing"]["beta"], DYNAMICS["duffing"]["X0"], row["w"])
    np.testing.assert_allclose(found, row[key], rtol=1e-12)


@pytest.mark.parametrize(("row", "i"), ROWS, ids=[f"w={row['w']}-{i}" for row, i in ROWS])
def test_third_harmonic_is_the_first_order_one(row, i):
    """C = beta A^3/(4 (9 w^2 - 1)) in 40-digit arithmetic."""
    start = np.zeros((1, 3, 2))
    start[0, 1, 0] = row["exact"][i]["start"]
    system = duffing_model(DYNAMICS["duffing"]["beta"], DYNAMICS["duffing"]["X0"], row["w"]).system
    u, orders, _, _ = modified_struble(system, start=start)
    assert orders == (1, 3)
    assert u[0, 1, 2] == pytest.approx(row["exact"][i]["a3_first_order"], rel=1e-12)


# beta, X0, exact omega, exact fundamental A1, third harmonic A3 and peak of undamped motions by shooting (1e-8), and what
# (C-3), (C-4), (C-5) say of omega at P = A1.
EXACT = [
    (0.1, 0.1, 1.1609056740, -1.981373344, -0.018454217, 1.17245403, 1.15970172, 1.16102372),
    (0.1, 0.1, 0.9047288252, 0.499507253, 0.000492272, 0.90925788, 0.90471861, 0.90462022),
    (0.1, 0.1, 1.1164517573, 1.979649103, 0.020146553, 1.12170590, 1.11508376, 1.11614056),
    (0.1, 0.3, 1.2036382480, -1.982825967, -0.017026529, 1.22308456, 1.20256772, 1.20409253),
]


@pytest.mark.parametrize(("beta", "force", "w", "a1", "a3", "c3", "c4", "c5"), EXACT)
def test_harmonic_balance_is_exact_where_the_formulas_are_not(beta, force, w, a1, a3, c3, c4, c5):
    """Authority: shooting of the undamped equation; each formula holds at its own frequency."""
    orders = tuple(range(1, 16, 2))
    start = np.zeros((1, 3, 2 * len(orders)))
    start[0, 1, 0] = a1
    u, _, _ = harmonic_balance(duffing_model(beta, force, w).system, orders, start=start)
    np.testing.assert_allclose(u[0, 1, [0, 2]], [a1, a3], atol=2e-8)
    for formula, omega in (("C-3", c3), ("C-4", c4), ("C-5", c5)):
        assert np.abs(duffing_amplitudes(formula, beta, force, omega) - a1).min() < 2e-7, formula


def test_linear_resonance_without_damping_is_a_status_and_no_error():
    """No periodic motion exists at w = 1 without a cubic term; with one, 3/4 beta P^3 = X0 of one harmonic does."""
    assert not steady_motion(duffing_model(0.0, 0.3, 1.0)).status.ok
    start = np.zeros((1, 3, 2))
    start[0, 1, 0] = 1.2
    u, status, _ = harmonic_balance(duffing_model(0.2, 0.3, 1.0).system, (1,), start=start)
    assert status[0] == 0
    assert u[0, 1, 0] == pytest.approx(np.cbrt(0.3 / (0.75 * 0.2)), rel=1e-12)


def test_unknown_formula_and_pole_are_refused():
    with pytest.raises(InputError, match="C-4"):
        duffing_amplitudes("C-9", 0.1, 0.1, 1.0)
    with pytest.raises(InputError, match="1/3"):
        duffing_amplitudes("C-5", 0.1, 0.1, 1.0 / 3.0)


@pytest.mark.parametrize("harmonics", [1, 15])
def test_undamped_resonance_has_no_linear_motion_and_yet_an_answer(harmonics):
    """[H71] (C-4) at omega = 1: 3/4 beta P^3 = X0, P = 1.2599; with all harmonics 1.2555 (reference)."""
    (motion,) = all_motions(duffing_model(0.2, 0.3, 1.0), harmonics)
    expected = (0.3 / (0.75 * 0.2)) ** (1 / 3) if harmonics == 1 else 1.25546
    assert motion.cos[0, 1] == pytest.approx(expected, abs=1e-5)
