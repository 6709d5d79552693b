"""Stability quantities against 40-digit reference numbers (tests/reference/dynamics.json)."""

import numpy as np
import pytest

from quartering.motion.steady.motion import motion_record, steady_motion
from quartering.stability.assessment import assess
from quartering.stability.first_order import first_order
from quartering.stability.variational.transition import transition_matrices
from quartering.stability.variational.variation import variational_harmonics
from quartering.stability.verdict import stability
from tests.reference import CASES, COUPLED, DYNAMICS, complexes, coupled_model, model_of

pytestmark = pytest.mark.quick

SETS = {"harmonics_1": (1,), "harmonics_1_3": (1, 3), "harmonics_H9": (1, 3, 5, 7, 9)}


def coefficients(solution: dict, which: str) -> np.ndarray:
    one, three = solution["one_harmonic"], solution["third_harmonic"]
    if which == "harmonics_1":
        return np.stack([one["A"], one["B"]], axis=1)[None]
    if which == "harmonics_1_3":
        return np.stack([one["A"], one["B"], three["C"], three["S"]], axis=1)[None]
    return np.array(solution["harmonics_9"]).reshape(1, 3, 10)


@pytest.mark.parametrize("which", SETS)
@pytest.mark.parametrize(("name", "branch"), CASES)
def test_first_order_quantities_to_1e_12(name, branch, which):
    case = DYNAMICS["cases"][name]
    expected = case["solutions"][branch]["first_order"][which]
    system, u = model_of(case).system, coefficients(case["solutions"][branch], which)
    phasors = variational_harmonics(system, u, SETS[which])
    f = first_order(system, phasors, u[:, :, 0] - 1j * u[:, :, 1])
    close = {"rtol": 1e-12, "atol": 1e-14}
    np.testing.assert_allclose(f.n2[0], expected["n2"], **close)
    np.testing.assert_allclose(f.rho[0], expected["rho"], **close)
    for ours in ("k2", "k2_rho", "k2_paper", "roll_rate"):
        np.testing.assert_allclose(getattr(f, ours)[0], expected[ours], **close, err_msg=ours)
    np.testing.assert_allclose(f.slow[0], np.sort(np.array(expected["slow"])[:, 0])[::-1], **close)
    for i, m in enumerate(("2", "4", "6")):
        np.testing.assert_allclose(f.q[0, i], max(np.array(expected["q"][m]["full"])[:, 0]), **close)
        np.testing.assert_allclose(f.q_paper[0, i], max(np.array(expected["q"][m]["paper"])[:, 0]), **close)
    assert f.index[0] == -f.roll_rate[0]


@pytest.mark.parametrize(("name", "branch"), CASES)
def test_averaged_system_mean_jacobian_and_combination_to_1e_9(name, branch):
    case = DYNAMICS["cases"][name]
    solution = case["solutions"][branch]
    system = model_of(case).system
    one, nine = coefficients(solution, "harmonics_1"), coefficients(solution, "harmonics_H9")
    at_one = first_order(system, variational_harmonics(system, one, (1,)), np.zeros((1, 3)))
    at_nine = first_order(system, variational_harmonics(system, nine, SETS["harmonics_H9"]), np.zeros((1, 3)))
    np.testing.assert_allclose(
        np.sort_complex(at_one.averaged[0]), complexes(solution["averaged_roll_pair"]), atol=1e-9
    )
    np.testing.assert_allclose(
        np.sort_complex(at_nine.mean_jacobian[0]), complexes(solution["mean_jacobian"]), atol=1e-9
    )
    assert at_nine.combination[0] == pytest.approx(max(np.array(solution["combination"])[:, 0]), abs=1e-9)


@pytest.mark.parametrize(("name", "branch"), CASES)
def test_floquet_multipliers_of_the_exact_orbit_to_1e_10(name, branch):
    case = DYNAMICS["cases"][name]
    solution = case["solutions"][branch]
    model = model_of(case)
    from quartering.motion.steady.harmonic import harmonic_balance

    orders = tuple(range(1, 24, 2))
    start = np.zeros((1, 3, 2 * len(orders)))
    start[:, :, :10] = coefficients(solution, "harmonics_H9")
    u, status, _ = harmonic_balance(model.system, orders, start=start)
    assert status[0] == 0
    verdict = stability(model, motion_record(model, u[0], orders, 0, 0.0, "harmonic balance"))
    exact = complexes(solution["orbit"]["multipliers"])
    np.testing.assert_allclose(
        np.sort_complex(verdict.multipliers), exact, rtol=0, atol=1e-10 * max(1, abs(exact).max())
    )
    assert verdict.stable == solution["orbit"]["stable"]
    assert verdict.liouville < 1e-9 or np.isnan(verdict.liouville)


@pytest.mark.parametrize("solution", COUPLED["solutions"], ids=lambda s: f"w={s['omega']}")
def test_coupled_system_multipliers_agree_with_shooting(solution):
    """Authority: variational equations along the shooting solution, printed to 8 decimals."""
    model = coupled_model(solution["omega"])
    verdict = stability(model, steady_motion(model, 13))
    printed = np.sort_complex([complex(z.replace("i", "j")) for z in solution["mu_re_im"].split()])
    np.testing.assert_allclose(np.sort_complex(verdict.multipliers), printed, atol=1e-8)


@pytest.mark.parametrize(("name", "branch"), CASES)
def test_transition_matrix_has_fourth_order(name, branch):
    """Measured order of the Runge-Kutta integration of the variational equations: 4 +- 0.3."""
    case = DYNAMICS["cases"][name]
    system, u = model_of(case).system, coefficients(case["solutions"][branch], "harmonics_H9")
    fine, *rest = (transition_matrices(system, u, SETS["harmonics_H9"], 0.5, np.array([n])) for n in (1600, 60, 120))
    errors = [np.abs(phi - fine).max() for phi in rest]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4.0, abs=0.3)


@pytest.mark.parametrize("accuracy", [1e-4, 1e-6, 1e-8])
def test_requested_accuracy_of_multipliers_is_kept(accuracy):
    """Against the same integration with far more steps, on every reference orbit."""
    for name, branch in CASES:
        case = DYNAMICS["cases"][name]
        system, u = model_of(case).system, coefficients(case["solutions"][branch], "harmonics_H9")
        rough = assess(system, u, SETS["harmonics_H9"], accuracy).floquet.multipliers
        fine = assess(system, u, SETS["harmonics_H9"], 1e-13).floquet.multipliers
        assert abs(np.sort_complex(rough[0]) - np.sort_complex(fine[0])).max() < accuracy * max(1, abs(fine).max()), (
            name
        )


def test_half_period_multiplier_is_minus_one_at_the_reference_fold():
    """A fold of the exact balance is where a half-period multiplier passes -1."""
    from quartering.motion.equations.model import Model
    from quartering.motion.steady.harmonic import harmonic_balance

    fold = DYNAMICS["folds"][0]
    base = model_of(DYNAMICS["cases"]["D_fold_strong"])
    model = Model(base.inertia, base.terms, fold["omega_HB9"] - 1e-9, base.force_cos, base.force_sin)
    start = np.zeros((1, 3, 10))
    start[0, :, 0], start[0, :, 1] = fold["A"], fold["B"]
    orders = SETS["harmonics_H9"]
    u, status, _ = harmonic_balance(model.system, orders, start=start)
    assert status[0] == 0
    half = assess(model.system, u, orders, 1e-10).floquet.half[0]
    assert half[np.argmin(abs(half + 1))] == pytest.approx(-1.0, abs=2e-3)  # square root of the 1e-9 distance, times 30
