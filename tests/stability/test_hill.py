"""Hill's determinant against integrated multipliers and 40-digit references."""

import numpy as np
import pytest

from quartering.motion.steady.harmonic import harmonic_balance
from quartering.stability.variational.hill import exponents_of_batch
from tests.reference import CASES, COUPLED, DYNAMICS, complexes, coupled_model, model_of
from tests.tiers import mostly_soak


@pytest.mark.parametrize(("name", "branch"), CASES)
def test_exponents_of_batch_give_the_reference_multipliers_to_1e_9(name, branch):
    """Authority: multipliers in 40-digit arithmetic (tests/reference/dynamics.json)."""
    solution = DYNAMICS["cases"][name]["solutions"][branch]
    model = model_of(DYNAMICS["cases"][name])
    orders = tuple(range(1, 24, 2))
    start = np.zeros((1, 3, 2 * len(orders)))
    start[:, :, :10] = np.array(solution["harmonics_9"]).reshape(1, 3, 10)
    u, _, _ = harmonic_balance(model.system, orders, start=start)
    exponents, defect = exponents_of_batch(model.system, u, orders, reach=12)
    assert defect[0] < 1e-9
    multipliers = np.exp(exponents[0] * 2 * np.pi / model.frequency)
    exact = complexes(solution["orbit"]["multipliers"])
    assert max(np.abs(multipliers - z).min() for z in exact) < 1e-9 * max(1.0, np.abs(exact).max())


@pytest.mark.parametrize("solution", COUPLED["solutions"], ids=lambda s: f"w={s['omega']}")
def test_hill_agrees_with_shooting_on_the_coupled_system(solution):
    model = coupled_model(solution["omega"])
    orders = tuple(range(1, 14, 2))
    u, _, _ = harmonic_balance(model.system, orders)
    exponents, _ = exponents_of_batch(model.system, u, orders)
    found = np.exp(exponents[0] * 2 * np.pi / model.frequency)
    for printed in (complex(z.replace("i", "j")) for z in solution["mu_re_im"].split()):
        assert np.abs(found - printed).min() < 1e-8


# Trace of the monodromy matrix of x'' + (a - 2 q cos 2t) x = 0 is 2 cos(pi nu); +-2 on the characteristic curves.
# Authority: Mathieu characteristic values a_r(q), b_r(q) (scipy.special, checked by integration to 1e-8).
MATHIEU = [
    (0.1, -0.0049945438, 2),
    (0.1, 1.0987343130, -2),
    (0.5, 1.4667668425, -2),
    (0.5, 4.1009005956, 2),
    (1.0, 1.8591080725, -2),
]


@pytest.mark.parametrize(("q", "a", "trace"), mostly_soak(MATHIEU, MATHIEU[0], MATHIEU[-1], several=True))
def test_mathieu_characteristic_values(q, a, trace):
    """A variational equation with stiffness a - 2 q cos 2t: build it from a motion that modulates the restoring moment."""
    from quartering.motion.equations.model import Model
    from quartering.motion.status import Status
    from quartering.motion.steady.motion import Motion
    from quartering.stability.variational.transition import transition_matrices

    # phi = sqrt(x) (cos t): 3 k3 phi^2 = 1.5 k3 x (1 + cos 2t), so stiffness K1 + 1.5 k3 x + 1.5 k3 x cos 2t.
    cubic = 4.0 / 3.0 * q  # with unit amplitude: 1.5 cubic = 2 q
    terms = {"Y_v": -0.3, "N_r": -0.2, "K_phi": -(a + 2 * q), "K_phiphiphi": cubic}
    model = Model(np.eye(3), terms, 1.0, (0, 1, 0), (0, 0, 0))
    motion = Motion(
        1.0, (1,), np.array([[0.0, 1.0, 0.0]]), np.zeros((1, 3)), np.zeros(3), Status.CONVERGED, 0.0, "given"
    )
    u = motion.coefficients[None]
    phi = transition_matrices(model.system, u, (1,), 0.5, np.array([4000]))[0]
    roll = phi[1:3, 1:3]
    assert np.trace(roll) == pytest.approx(trace, abs=2e-7)
    exponents, _ = exponents_of_batch(model.system, u, (1,), reach=14)
    # On a characteristic curve the two exponents of roll coincide (their real part is zero up to the root of rounding).
    slow = np.sort(np.abs(exponents[0].real))
    assert slow[1] < 1e-4
