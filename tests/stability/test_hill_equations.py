"""Linear equations with periodic stiffness against closed forms: Mathieu's and Meissner's."""

from dataclasses import replace

import numpy as np
import pytest

from quartering.motion.equations.model import Model
from quartering.motion.status import Status
from quartering.motion.steady.motion import Motion
from quartering.stability.variational.hill import exponents_of_batch
from quartering.stability.variational.transition import transition_matrices
from tests.reference import table
from tests.tiers import mostly_soak

MATHIEU, MEISSNER = table("mathieu.csv"), table("meissner.csv")
UNIT = Motion(1.0, (1,), np.array([[0.0, 1.0, 0.0]]), np.zeros((1, 3)), np.zeros(3), Status.CONVERGED, 0.0, "given")


def mathieu(a, q):
    """x'' + (a - 2 q cos 2t) x = 0 as the variation about phi = cos t: 3 k3 phi^2 = 1.5 k3 (1 + cos 2t) with 1.5 k3 = 2 q."""
    terms = {"Y_v": -0.3, "N_r": -0.2, "K_phi": -(a + 2 * q), "K_phiphiphi": 4.0 / 3.0 * q}
    return Model(np.eye(3), terms, 1.0, (0, 1, 0), (0, 0, 0)).system


def trace_over_half_a_cycle(a, q):
    return np.trace(
        transition_matrices(mathieu(a, q), UNIT.coefficients[None], (1,), 0.5, np.array([6000]))[0][1:3, 1:3]
    )


@pytest.mark.parametrize("row", MATHIEU, ids=lambda r: f"q={r['q']}-{r['type']}{r['order']}")
def test_trace_of_the_monodromy_matrix_is_two_on_mathieus_characteristic_curves(row):
    """a to 1e-8, the accuracy of the table: the trace may miss by as much as that moves it (curves of b and a nearly touch)."""
    q, a, exact = float(row["q"]), float(row["a"]), float(row["trace"])
    step = 1e-4
    slope = (trace_over_half_a_cycle(a + step, q) - trace_over_half_a_cycle(a - step, q)) / (2 * step)
    assert abs(trace_over_half_a_cycle(a, q) - exact) < 1e-8 * max(1.0, abs(slope))


def test_a_stiffness_that_changes_with_the_wave_is_mathieus_equation():
    """Agreement: a known input alone beside phi, and the variation about a motion that modulates the stiffness as much."""
    a, q = 1.3, 0.4
    still = Model(np.eye(3), {"Y_v": -0.3, "N_r": -0.2, "K_phi": -a}, 1.0, (0, 0, 0), (0, 0, 0)).system
    system = replace(
        still,
        powers=np.array([[0, 1, 0, 0, 1]]),
        modulus=np.array([0]),
        coefficients=np.array([[[0.0], [1.0], [0.0]]]),
        extra=np.array([-1]),
        inputs=np.array([[[0.0, 0.0, 0.0, 2 * q, 0.0]]]),  # 2 q cos 2t
    )
    assert system.symmetric
    by_input = transition_matrices(system, np.zeros((1, 3, 2)), (1,), 0.5, np.array([2000]))[0]
    by_motion = transition_matrices(mathieu(a, q), UNIT.coefficients[None], (1,), 0.5, np.array([2000]))[0]
    np.testing.assert_allclose(by_input, by_motion, atol=1e-10)
    exponents, _ = exponents_of_batch(system, np.zeros((1, 3, 2)), (1,), reach=14)
    exact = np.sort(np.abs(np.linalg.eigvals(by_input)))
    np.testing.assert_allclose(np.sort(np.abs(np.exp(exponents[0] * np.pi))), exact, atol=1e-8)


@pytest.mark.parametrize("shift", mostly_soak([-0.3, 0.2, 0.45], 0.2))
@pytest.mark.parametrize(
    "row", [r for r in MATHIEU if float(r["q"]) <= 2 and r["type"] == "a"][::3], ids=lambda r: r["a"]
)
def test_hill_gives_the_same_multipliers_as_the_monodromy_matrix_to_1e_8(row, shift):
    """Between the curves: exp(lambda T/2) of Hill's determinant against eigenvalues of the integrated matrix."""
    q, a = float(row["q"]), float(row["a"]) + shift
    phi = transition_matrices(mathieu(a, q), UNIT.coefficients[None], (1,), 0.5, np.array([6000]))[0]
    exponents, _ = exponents_of_batch(mathieu(a, q), UNIT.coefficients[None], (1,), reach=14)
    by_hill = np.sort(np.abs(np.exp(exponents[0] * np.pi)))
    exact = np.sort(np.abs(np.linalg.eigvals(phi)))
    np.testing.assert_allclose(by_hill, exact, rtol=0, atol=1e-8 * max(1.0, exact[-1]))


@pytest.mark.parametrize("row", MEISSNER, ids=lambda r: f"delta={r['delta']}-T={r['T'][:5]}")
def test_meissners_equation_in_two_constant_halves_is_its_closed_form(row):
    """Stiffness delta + eps, then delta - eps: the product of two integrated transition matrices, to 1e-10."""
    given = {key: float(value) for key, value in row.items()}
    halves = []
    for side in (1.0, -1.0):
        terms = {"Y_v": -0.3, "N_r": -0.2, "K_phi": -(given["delta"] + side * given["eps"]), "K_p": -given["c"]}
        system = Model(np.eye(3), terms, 2 * np.pi / given["T"], (0, 0, 0), (0, 0, 0)).system
        halves.append(transition_matrices(system, np.zeros((1, 3, 2)), (1,), 0.5, np.array([1000]))[0][1:3, 1:3])
    monodromy = halves[1] @ halves[0]
    assert np.trace(monodromy) == pytest.approx(given["trace"], abs=1e-10)
    assert np.linalg.det(monodromy) == pytest.approx(given["det"], abs=1e-10)
    assert np.abs(np.linalg.eigvals(monodromy)).max() == pytest.approx(given["mu_max_abs"], abs=1e-10)
