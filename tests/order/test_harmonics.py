"""How fast harmonic balance converges to the motion itself, and how near nine harmonics come."""

import numpy as np
import pytest

from quartering.motion.steady.harmonic import harmonic_balance
from quartering.motion.steady.motion import motion_record, steady_motion
from quartering.motion.transient.simulate import simulate
from tests.reference import CASES, DYNAMICS, coupled_model, model_of

# Harmonics with which the motion is within 1e-8 of the integrated orbit: nine where roll is moderate; more where the spring
# has softened (D, past her fold) or sway and yaw are driven hard (C).
ENOUGH = {
    ("A_roll_only", 0): 9, ("B_ship_moderate", 0): 9, ("F_damping_modulation_m2", 0): 9, ("D_fold_strong", 0): 9,
    ("C_ship_unstable_I3", 0): 11, ("D_fold_strong", 1): 11, ("D_fold_strong", 2): 13,
}  # fmt: skip


def motion_with(model, start, highest):
    orders = tuple(range(1, highest + 1, 2))
    given = np.zeros((1, 3, 2 * len(orders)))
    width = min(given.shape[2], start.shape[2])
    given[:, :, :width] = start[:, :, :width]
    u, status, residual = harmonic_balance(model.system, orders, start=given)
    assert status[0] == 0
    return motion_record(model, u[0], orders, int(status[0]), float(residual[0]), "harmonic balance")


def missed(model, motion, start):
    """Largest difference over a period from direct integration started on the orbit, relative to the largest state."""
    period = 2 * np.pi / model.frequency
    trace = simulate(model, period, start, step=period / 64, tolerance=1e-13)
    degrees = np.column_stack([trace[name] for name in ("roll", "roll_rate", "yaw_rate")])
    exact = np.column_stack([trace["sway_velocity"], np.radians(degrees)])
    found = motion.state(trace["time"].values)
    return (np.abs(found - exact).max(axis=0) / np.abs(exact).max(axis=0).clip(1e-12)).max()


@pytest.mark.parametrize(("name", "branch"), CASES)
def test_motion_agrees_with_the_integrated_orbit_to_1e_8_and_converges_geometrically(name, branch):
    """Authority: Dormand-Prince at tolerance 1e-13 from the orbit's state in 40-digit arithmetic, over one period."""
    case = DYNAMICS["cases"][name]
    model, solution = model_of(case), case["solutions"][branch]
    start, state = np.array(solution["harmonics_9"]).reshape(1, 3, 10), solution["orbit"]["state0"]
    errors = np.array([missed(model, motion_with(model, start, h), state) for h in (3, 5, 7, 9, 11, 13)])
    assert errors[(ENOUGH[name, branch] - 3) // 2] < 1e-8, errors
    measurable = errors[errors > 1e-12]
    assert (measurable[1:] < 0.07 * measurable[:-1]).all(), errors


@pytest.mark.parametrize(("frequency", "enough"), [(0.6, 11), (0.95, 11), (1.3, 9)])
def test_coupled_motion_agrees_with_the_integrated_orbit_to_1e_8(frequency, enough):
    """Authority: integration from the motion's own state; a stable orbit draws it onto itself over 30 periods."""
    model = coupled_model(frequency)
    motion = steady_motion(model, enough)
    duration = 30 * 2 * np.pi / model.frequency
    trace = simulate(model, duration, motion.state(0.0), step=duration, tolerance=1e-13)
    degrees = [float(trace[name][-1]) for name in ("roll", "roll_rate", "yaw_rate")]
    drawn = np.array([float(trace["sway_velocity"][-1]), *np.radians(degrees)])
    assert missed(model, motion, drawn) < 1e-8
