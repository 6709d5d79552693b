"""Periodic motions against 40-digit reference numbers (tests/reference/dynamics.json)."""

import numpy as np
import pytest

from quartering.motion.steady.harmonic import harmonic_balance
from quartering.motion.steady.motion import steady_motion
from quartering.motion.transient.simulate import simulate
from tests.reference import CASES, COUPLED, DYNAMICS, coupled_model, model_of

pytestmark = pytest.mark.quick


def start_near(solution: dict) -> np.ndarray:
    one = solution["one_harmonic"]
    return np.stack([one["A"], one["B"]], axis=1)[None]


@pytest.mark.parametrize(("name", "branch"), CASES)
def test_one_harmonic_agrees_with_reference_to_1e_12(name, branch):
    case = DYNAMICS["cases"][name]
    start = start_near(case["solutions"][branch])
    u, status, _ = harmonic_balance(model_of(case).system, (1,), start=start * (1 + 1e-4))
    assert status[0] == 0
    np.testing.assert_allclose(u, start, rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize(("name", "branch"), CASES)
def test_nine_harmonics_agree_with_reference_to_1e_12(name, branch):
    case = DYNAMICS["cases"][name]
    exact = np.array(case["solutions"][branch]["harmonics_9"]).reshape(1, 3, 10)
    u, status, residual = harmonic_balance(model_of(case).system, (1, 3, 5, 7, 9), start=exact * (1 + 1e-5))
    assert status[0] == 0
    assert residual[0] < 1e-12
    np.testing.assert_allclose(u, exact, rtol=1e-12, atol=1e-12 * np.abs(exact).max())


@pytest.mark.parametrize(("name", "branch"), CASES)
def test_harmonics_up_to_nine_are_those_of_the_integrated_orbit_to_1e_8(name, branch):
    """Agreement: every harmonic kept, against Taylor-series shooting; the largest of each variable is 1.

    What stands at one instant is further off (1.4e-7 on the largest motion) by the harmonics left out, from the eleventh on.
    """
    case = DYNAMICS["cases"][name]
    start = start_near(case["solutions"][branch])
    start = np.pad(start, ((0, 0), (0, 0), (0, 8)))
    u, status, _ = harmonic_balance(model_of(case).system, (1, 3, 5, 7, 9), start=start)
    assert status[0] == 0
    exact = np.array(case["solutions"][branch]["orbit"]["fourier"])
    ours = u[0].reshape(3, 5, 2).copy()
    turning = case["input"]["w"] * np.array([1, 3, 5, 7, 9])[:, None]
    for k in (0, 2):  # the rates of A cos + B sin
        ours[k] = turning * np.stack([ours[k, :, 1], -ours[k, :, 0]], axis=-1)
    for k in range(3):
        np.testing.assert_allclose(ours[k], exact[k], rtol=0, atol=1e-8 * max(np.abs(exact[k]).max(), 1e-30))


@pytest.mark.parametrize("name", DYNAMICS["cases"])
def test_third_harmonic_of_the_modified_struble_method(name):
    case = DYNAMICS["cases"][name]
    motion = steady_motion(model_of(case))
    solution = case["solutions"][0]
    assert motion.orders == (1, 3)
    np.testing.assert_allclose(motion.cos[0], solution["one_harmonic"]["A"], rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(motion.sin[0], solution["one_harmonic"]["B"], rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(motion.cos[1], solution["third_harmonic"]["C"], rtol=1e-12, atol=1e-16)
    np.testing.assert_allclose(motion.sin[1], solution["third_harmonic"]["S"], rtol=1e-12, atol=1e-16)


@pytest.mark.parametrize(("name", "branch"), CASES)
def test_integration_over_one_period_returns_to_the_reference_state(name, branch):
    case = DYNAMICS["cases"][name]
    orbit = case["solutions"][branch]["orbit"]
    trace = simulate(model_of(case), orbit["period"], orbit["state0"], step=orbit["period"], tolerance=1e-13)
    end = [trace["sway_velocity"][-1], *np.radians([trace["roll"][-1], trace["roll_rate"][-1], trace["yaw_rate"][-1]])]
    # The unstable orbits of cases C and D multiply the integration error by their multiplier (below 3).
    np.testing.assert_allclose(end, orbit["state0"], rtol=0, atol=3e-11)


@pytest.mark.parametrize("solution", COUPLED["solutions"], ids=lambda s: f"w={s['omega']}")
def test_coupled_system_agrees_with_shooting_to_1e_8(solution):
    """Authority: shooting with relative tolerance 1e-12 (tests/reference/coupled_system.json, printed to 9 decimals)."""
    motion = steady_motion(coupled_model(solution["omega"]), harmonics=9)
    w = solution["omega"]
    amplitude = np.hypot(motion.cos, motion.sin)
    np.testing.assert_allclose(amplitude[:3, 1], [solution["PHI1"], solution["PHI3"], solution["PHI5"]], atol=1e-8)
    np.testing.assert_allclose(amplitude[:2, 0] * w * [1, 3], [solution["V1"], solution["V3"]], atol=1e-8)
    np.testing.assert_allclose(amplitude[:2, 2] * w * [1, 3], [solution["R1"], solution["R3"]], atol=1e-8)
    phase = np.degrees(np.angle(motion.cos[0, 1] - 1j * motion.sin[0, 1]))
    assert phase == pytest.approx(solution["PHI1_phase_deg"], abs=1e-5)
    state = [solution[k] for k in ("x0_v", "x0_phi", "x0_p", "x0_r")]
    finer = steady_motion(coupled_model(w), harmonics=13)  # an instant feels the harmonics left out
    np.testing.assert_allclose(finer.state(0.0), state, atol=1e-8)
