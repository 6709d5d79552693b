"""Figs. 11-13: the approximate motion against integration, disturbances against the difference of two integrations."""

import numpy as np
import pytest

import quartering as qt
from quartering.conventions import InputError
from quartering.study.paper.conditions import (
    INSTABILITY_HEADING,
    INSTABILITY_RATIO,
    INSTABILITY_STEEPNESS,
    speed_of,
    wave_of,
)
from quartering.study.paper.model import TABLE_I, feeding_model, modified_model, paper_ship, table_ratios
from quartering.study.paper.motions import disturbance, integration_check, time_check
from quartering.study.paper.sets import roll_rate

SHIP = paper_ship()
SPEED = speed_of(SHIP)


def case(ship: qt.Ship) -> tuple[qt.Model, qt.Motion, qt.Verdict]:
    wave = wave_of(ship, INSTABILITY_RATIO, INSTABILITY_STEEPNESS)
    model = qt.equations(ship, wave, SPEED, INSTABILITY_HEADING)
    motion = qt.steady_motion(model, 9, start="rest")
    return model, motion, qt.stability(model, motion)


def test_approximate_solution_agrees_with_integration():
    """[H71] Fig. 11. Nine harmonics in balance to the accuracy a peak is read with (1e-4); the paper's solution to less than
    the thickness of a line, 0.5 %, at 25 deg of roll."""
    ds = integration_check(SHIP, wave_of(SHIP, 1.0, 1 / 30), SPEED, [30.0, 60.0, 90.0])
    for name in ("roll_peak", "yaw_rate_peak"):
        exact = ds[name].sel(solution="integration")
        np.testing.assert_allclose(ds[name].sel(solution="balance"), exact, rtol=2e-4)
        np.testing.assert_allclose(ds[name].sel(solution="struble"), exact, rtol=5e-3)


def test_error_of_the_approximate_solution_is_of_fourth_order_in_roll():
    """[H71] Appendix A leaves out second-order terms: a relative error of the square of the cubic terms' weight, roll^4."""
    errors, sizes = [], []
    for steepness in (1 / 60, 1 / 120):
        model = qt.equations(SHIP, wave_of(SHIP, 1.0, steepness), SPEED, 70.0)
        paper, exact = (qt.steady_motion(model, n, start="rest").amplitude[1] for n in (1, 9))
        errors.append(abs(paper / exact - 1))
        sizes.append(exact)
    order = np.log(errors[0] / errors[1]) / np.log(sizes[0] / sizes[1])
    assert order == pytest.approx(4.0, abs=0.2)


def test_integration_from_rest_settles_on_the_approximate_motion_in_phase():
    model = qt.equations(SHIP, wave_of(SHIP, 1.0, 1 / 30), SPEED, 60.0)
    both = time_check(model, qt.steady_motion(model, start="rest"))
    largest = float(np.abs(both["integrated"]).max())
    np.testing.assert_allclose(both["approximate"], both["integrated"], atol=0.02 * largest)


@pytest.mark.parametrize("ship", [modified_model(), feeding_model()], ids=["table-1", "feeding"])
def test_variational_equations_are_the_difference_of_two_integrations(ship):
    model, motion, _ = case(ship)
    small = 1e-3
    found = disturbance(model, motion, 60.0, small)
    step = float(found["time"][1])
    start = motion.state(0.0)
    one, other = (
        qt.simulate(model, 60.0, tuple(start + push * np.array([0.0, np.radians(1.0), 0.0, 0.0])), step, 1e-12)
        for push in (0.0, small)
    )
    for name in ("sway_velocity", "roll", "yaw_rate"):
        difference = (other[name] - one[name]).values
        np.testing.assert_allclose(found[name], difference, atol=2e-3 * np.abs(difference).max())


@pytest.mark.parametrize(
    ("ship", "stable"), [(modified_model(), True), (feeding_model(), False)], ids=["table-1", "feeding"]
)
def test_growth_of_the_disturbance_index_and_floquet_agree(ship, stable):
    """[H71] Fig. 12. Growth of roll energy between two times whole periods apart."""
    model, motion, verdict = case(ship)
    found = disturbance(model, motion, 20 * 2 * np.pi / model.frequency, 1.0)
    size = np.hypot(found["roll"], found["roll_rate"] / verdict.n2).values
    time = found["time"].values
    late = slice(time.size // 4, 3 * time.size // 4)
    growth = np.polyfit(time[late], np.log(size[late]), 1)[0]
    assert verdict.stable is stable
    assert (verdict.k2 < 0) is stable
    assert growth == pytest.approx(roll_rate(verdict), abs=2e-3)


def test_full_equations_from_5_deg_of_roll():
    """[H71] Fig. 13: with the ratios of Table I ours comes back to its steady motion; where yaw feeds roll it capsizes."""
    model, motion, _ = case(modified_model())
    late = qt.simulate(model, 600.0, (0.0, np.radians(5.0), 0.0, 0.0))["roll"].isel(time=slice(-60, None))
    assert float(np.abs(late).max()) == pytest.approx(np.degrees(motion.peak[1]), rel=2e-3)
    model, _, _ = case(feeding_model())
    assert "capsize_time" in qt.simulate(model, 600.0, (0.0, np.radians(5.0), 0.0, 0.0)).attrs


def test_table_1_turns_the_sign_of_i3_in_the_papers_own_numbers():
    """[H71] I3 = 0.1 K_vrr + K_prr."""
    before, after = (0.1 * TABLE_I["K_vrr"][i] + TABLE_I["K_prr"][i] for i in (0, 1))
    assert before == pytest.approx(-0.575, abs=1e-3)
    assert after == pytest.approx(3.9155, abs=1e-4)


def test_table_1_does_not_turn_the_sign_of_ours():
    """Cross-flow drag is dissipative: taking K_prr away leaves nothing to feed roll, so K2 stays negative at any heading."""
    headings, wave = np.arange(5.0, 90.0, 10.0), wave_of(SHIP, 1.0, 1 / 40)
    found = qt.polar(modified_model(), wave, [SPEED], headings)
    assert (found["k2"] < 0).all()
    assert (found["verdict"] == 0).all()


def test_multipliers_of_the_modified_model_are_the_ratios_of_the_table():
    assert dict(modified_model().multipliers) == pytest.approx(table_ratios())
    assert dict(modified_model(strength=0.5).multipliers)["K_prr"] == pytest.approx(0.5)
    with pytest.raises(InputError, match="strength"):
        modified_model(strength=2.0)


def test_a_disturbance_needs_a_duration():
    model, motion, _ = case(SHIP)
    with pytest.raises(InputError, match="duration"):
        disturbance(model, motion, 0.0, 1.0)
