"""The motion that a wave raised slowly from nothing leads to, in steep waves where others stand beside it."""

import numpy as np
import pytest

import quartering as qt
from quartering.motion.of_ship import ship_system
from quartering.motion.steady.harmonic import harmonic_balance

STEPS = 40
BESIDE = {  # wave length and height over the ship's length, heading [deg], Froude number
    "twice the roll": (1.5, 1.5 / 15, 60.0, 0.2),
    "the linear motion's roll": (2.4233, 2.4233 * 0.0516, 125.7598, 0.0719),
}
"""Where Newton's method comes from the linear motion to another one, with no fold between: of 50 deg in place of 25, and of 45
in place of 29, just as much as the linear motion's."""


def system_of(name: str, ratio, height, heading, froude):
    ship = qt.ship(name)
    length = ship.hull.length
    waves = (2 * np.pi / (ratio * length), froude * np.sqrt(9.81 * length), heading)
    return ship_system(ship, *waves).at_amplitude((0.5 * height * length)[:, None])


def roll(u):
    return np.hypot(u[:, 1, 0], u[:, 1, 1])


def raised_in_steps(system, orders):
    """Motions in the whole wave raised step by step, and which of them came there with no jump and so no fold."""
    last, before, smooth = 0.0, 0.0, np.ones(system.count, dtype=bool)
    for k in range(1, STEPS + 1):
        ahead = 2 * last - before if k > 1 else None
        u, status, _ = harmonic_balance(system.raised(np.array([k / STEPS])), orders, ahead)
        smooth &= status <= 1
        if k > 2:
            smooth &= (np.abs(u - ahead).max(axis=2) <= 0.15 * np.abs(u).max(axis=2)).all(axis=1)
        u = np.where(np.isfinite(u), u, 0.0)
        last, before = u, last
    return last, smooth


@pytest.mark.parametrize("orders", [(1,), (1, 3, 5)])
def test_a_motion_beside_the_one_from_rest_is_not_taken_for_it(orders):
    """Roll to 1e-6 of that of the wave raised in forty steps, another algorithm."""
    system = system_of("series60-cb60", *np.array(list(BESIDE.values())).T)
    expected, smooth = raised_in_steps(system, orders)
    assert smooth.all()
    from_linear, _, _ = harmonic_balance(system, orders)
    assert (roll(from_linear) > 1.5 * roll(expected)).all()
    found, _, _ = harmonic_balance(system, orders, from_rest=True)
    np.testing.assert_allclose(roll(found), roll(expected), rtol=1e-6)


@pytest.mark.filterwarnings("ignore::quartering.conventions.RangeWarning")
@pytest.mark.parametrize("name", ["series60-cb60", "s175", "dtmb5415", "coaster-90m"])
def test_motions_in_steep_waves_are_those_of_the_wave_raised_in_steps(name):
    """In 75 waves of 1/30 to 1/12 a ship, at any heading and speed, all that no fold stands before: roll to 1e-6."""
    random = np.random.default_rng(1971)
    low, high = np.array([(0.6, 3.0), (1 / 30, 1 / 12), (10.0, 170.0), (0.05, 0.3)]).T
    ratio, steepness, heading, froude = random.uniform(low, high, (75, 4)).T
    system = system_of(name, ratio, steepness * ratio, heading, froude)
    expected, smooth = raised_in_steps(system, (1,))
    assert smooth.mean() > 0.8
    found, status, _ = harmonic_balance(system, (1,), from_rest=True)
    assert (status[smooth] <= 1).all()
    np.testing.assert_allclose(roll(found)[smooth], roll(expected)[smooth], rtol=1e-6)
