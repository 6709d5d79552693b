"""Measured orders of the methods that go in steps: with the number of Runge-Kutta steps, and with the tolerance."""

import numpy as np
import pytest

import quartering as qt
from quartering.motion.transient.simulate import simulate
from quartering.stability.variational.transition import transition_matrices
from tests.motion.test_autopilot import AUTOPILOTS, model_with
from tests.reference import DYNAMICS, model_of


@pytest.mark.parametrize("autopilot", AUTOPILOTS[:2], ids=str)
def test_transition_matrix_with_an_autopilot_has_fourth_order(autopilot):
    model = model_with(autopilot)
    motion = qt.steady_motion(model, 9)
    u, orders = motion.coefficients[None], motion.orders
    fine, *rest = (transition_matrices(model.system, u, orders, 0.5, np.array([n])) for n in (3200, 60, 120, 240))
    errors = [np.abs(phi - fine).max() for phi in rest]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4.0, abs=0.3)
    assert np.log2(errors[1] / errors[2]) == pytest.approx(4.0, abs=0.3)


def test_error_of_the_integration_in_time_follows_its_tolerance():
    """Steps held to a local error of tolerance: the global error falls in proportion, to within its scatter."""
    case = DYNAMICS["cases"]["B_ship_moderate"]
    model, orbit = model_of(case), case["solutions"][0]["orbit"]
    tolerances = np.array([1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10])
    errors = []
    for tolerance in tolerances:
        trace = simulate(model, orbit["period"], orbit["state0"], step=orbit["period"], tolerance=tolerance)
        errors.append(abs(np.radians(float(trace["roll"][-1])) - orbit["state0"][1]))
    assert np.polyfit(np.log(tolerances), np.log(errors), 1)[0] == pytest.approx(1.0, abs=0.25)
