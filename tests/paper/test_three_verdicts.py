"""The paper's three ways of judging a motion, on a real hull: index, variational equations, direct integration."""

import numpy as np
import pytest

import quartering as qt
from quartering.study.paper.model import paper_ship

SHIP = paper_ship()
LENGTH = SHIP.hull.length
SPEED = 0.25 * np.sqrt(9.81 * LENGTH)
WAVE = qt.Wave(length=LENGTH, height=LENGTH / 30)


def measured_growth(model: qt.Model, motion: qt.Motion, periods: int) -> float:
    """Growth rate of a small disturbance in the full equations, by two integrations [1/s]."""
    period = 2 * np.pi / model.frequency
    start = motion.state(0.0)
    disturbed = start + 1e-5 * np.array([0.0, 1.0, 0.0, 0.0])

    def states(state0):
        trace = qt.simulate(model, periods * period, state0, step=period / 50, tolerance=1e-12)
        return np.stack(
            [trace["sway_velocity"], *np.radians([trace["roll"], trace["roll_rate"], trace["yaw_rate"]])], axis=1
        )

    difference = states(disturbed) - states(start)
    # Roll energy of the disturbance: its envelope does not swing with the phase of roll.
    size = np.hypot(difference[:, 1], difference[:, 2] / qt.coefficients(SHIP, model.frequency, SPEED).roll_frequency)
    times = np.arange(len(size)) * period / 50
    late = times > times[-1] / 3
    return float(np.polyfit(times[late], np.log(size[late]), 1)[0])


def judged(ship: qt.Ship, heading: float) -> tuple[qt.Model, qt.Motion, qt.Verdict]:
    model = qt.equations(ship, WAVE, SPEED, heading)
    motion = qt.steady_motion(model, 9, start="rest")
    return model, motion, qt.stability(model, motion)


@pytest.mark.parametrize(("factor", "stable"), [(1.0, True), (-60.0, False)])
def test_index_floquet_and_integration_agree(factor, stable):
    """Stable: the ship as estimated. Unstable: K_prr turned to feed yaw into roll, the paper's mechanism."""
    model, motion, verdict = judged(SHIP.with_(factors={"K_prr": factor}), heading=30.0)
    assert verdict.stable is stable
    assert verdict.first_order_stable is stable
    assert (verdict.k2 < 0) is stable
    growth = measured_growth(model, motion, periods=12)
    assert (growth < 0) is stable
    # A disturbance of roll shows the rate of the oscillating (roll) pair, not that of the slow sway-yaw modes.
    roll_pair = verdict.exponents[np.abs(verdict.exponents.imag) > 1e-6]
    assert growth == pytest.approx(roll_pair[0].real, rel=0.05)
    assert verdict.liouville < 1e-8


def test_the_unstable_motion_names_its_mechanism():
    _, _, verdict = judged(SHIP.with_(factors={"K_prr": -60.0}), heading=30.0)
    assert verdict.kind == "roll"
    assert verdict.strongest[0] == "K_prr"
    assert "Heading 30 deg" in verdict.sentence
    assert "K_prr" in verdict.sentence


def test_uncoupled_roll_is_stable_where_coupled_motion_is_not():
    """[H71] conclusion: with the same roll coefficients, roll alone (no sway, no yaw) is stable."""
    model, _, verdict = judged(SHIP.with_(factors={"K_prr": -60.0}), heading=30.0)
    assert not verdict.stable
    own = {name: value for name, value in model.terms.items() if name in ("K_p", "K_ppp") or "phi" in name}
    alone = qt.Model(
        np.diag(np.diag(model.inertia)),
        own | {"Y_v": -1e6, "N_r": -1e9},
        model.frequency,
        model.force_cos * [0, 1, 0],
        model.force_sin * [0, 1, 0],
    )
    assert qt.stability(alone, qt.steady_motion(alone, 9)).stable
