"""A ship on a steady course with what an integration in time, or a closed form, can hold: for comparison with either."""

from dataclasses import replace

import numpy as np

from quartering.motion.steady_course.balance import columns
from quartering.motion.steady_course.course import ROLL, roll_inertia


def with_constant_coefficients(one, half=True):
    """The water's coefficients at one frequency a mode: omega in heave and pitch, omega/2 or omega in sway, roll and yaw.

    That is what an integration in time can hold; harmonic balance takes each harmonic's own otherwise.
    """
    mass, damping = one.numbers.mass.copy(), one.numbers.damping.copy()
    for part in (mass, damping):
        part[:, :, :2, :2] = part[:, 2:3, :2, :2]
        part[:, :, 2:, 2:] = part[:, 1:2, 2:, 2:] if half else part[:, 2:3, 2:, 2:]
    return replace(one, numbers=one.numbers._replace(mass=mass, damping=damping))


def rolling_alone(one, damping):
    """Sway and yaw locked, and of the damping in roll a fraction of critical at the ship's GM alone."""
    numbers, weight = one.numbers, one.numbers.scale[0] * one.numbers.scale[1]
    inertia = roll_inertia(one.ship, 0.5 * numbers.omega)
    frequency = np.sqrt(weight * one.ship.loading.gm / inertia)
    mass, own = numbers.mass.copy(), numbers.damping.copy()
    mass[:, :, 2:, 2:], own[:, :, 2:, 2:] = weight * np.eye(3), weight * np.eye(3)  # sway and yaw come to rest
    mass[:, :, ROLL, ROLL] = inertia[:, None]
    own[:, :, ROLL, ROLL] = (2.0 * damping * frequency * inertia)[:, None]
    locked = numbers._replace(
        mass=mass, damping=own, heel=np.zeros_like(numbers.heel), powers=np.zeros((0, 4), dtype=int),
        modulus=np.zeros(0, dtype=int), products=np.zeros((one.count, 3, 0)), strips=np.zeros((one.count, 0, 5)),
        rudder=np.zeros_like(numbers.rudder), gains=np.zeros(3), share=np.array([1.0, 1.0, 0.0, 1.0, 0.0]),
        force=numbers.force * np.array([1.0, 1.0, 0.0, 1.0, 0.0]),
    )  # fmt: skip
    return replace(one, numbers=locked)


def start_on(orbit, basis, omega, roll):
    """State at time 0 on a motion with the coefficients `orbit`, and a roll angle added [rad]."""
    zero = np.zeros(1)
    (up, up_rate), (side, side_rate) = columns(basis.vertical, zero), columns(basis.lateral, zero)
    h, theta, v, phi, r = basis.parts(orbit)
    rates = [float(omega * up_rate[0] @ part) for part in (h, theta)]
    p = float(omega * side_rate[0] @ phi)
    values = [float(up[0] @ h), float(up[0] @ theta), *rates, float(side[0] @ v), float(side[0] @ phi) + roll, p]
    return np.array([*values, float(side[0] @ r), 0.0, 0.0])
