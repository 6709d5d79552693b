"""Derivatives with drag by strips and a righting spline, to 1e-6; and why values of K2 and exponent are no judges of them.

Sampled at a few dozen phases, the mean of 2 |q| has an error that changes as the zeros of q pass the samples: the value of K2
is good to some 1e-5, the differences of its values to no better (8.6e-6 of a model, 1e-3 of a ship over steps of 1e-4). So the
reference takes the mean over 2^17 phases, written out here. The exponent comes from steps in time across the same corners;
differences over less than 5e-4 hold their noise.
"""

from dataclasses import replace

import numpy as np
import pytest

import quartering as qt
from quartering.hull.righting.spline import odd_spline
from quartering.motion.steady.derivative import OFFSETS, difference, states_along
from quartering.motion.steady.harmonic import harmonic_balance
from quartering.stability.assessment import assess
from quartering.stability.first_order import roll_mode
from quartering.study.effects.sensitivity import coefficient_rows, derivatives
from tests.motion.test_moving_water import dragged_model

MEASURES = ("sway", "roll", "yaw", "k2", "index", "exponent")
ANGLES = np.arange(4.0, 97.0, 4.0)
ORDERS, STEP, PHASES = (1, 3, 5), 5e-4, 2 * np.pi * np.arange(2**17) / 2**17
SPLINE = odd_spline(ANGLES, -0.3 * np.radians(ANGLES) ** 3 + 0.2 * np.maximum(np.radians(ANGLES) - 0.2, 0.0) ** 2)


def mean_slopes(model, u):
    """Mean over the cycle of the derivatives (3, 4) of the right-hand sides, term by term."""
    v, phi, p, r = states_along(u[None], model.system.frequency, ORDERS, PHASES)[0].T
    mean = np.zeros((3, 4))
    for name, value in model.terms.items():
        row, (_, _, factors) = "YKN".index(name[0]), name.partition("_")
        powers = {"phi": 1, "phiphiphi": 3}
        if factors in powers:
            mean[row, 1] += value * powers[factors] * (phi ** (powers[factors] - 1)).mean()
        else:
            mean[row, "v_pr".index(factors)] += value
    if model.restoring is not None:
        mean[1, 1] += model.restoring.derivative(phi).mean()
    at = model.strips
    form = np.stack([np.ones_like(at.x), -at.lever, at.x], axis=1)
    q = np.stack([v, p, r], axis=1) @ form.T - (at.water[0] * np.exp(1j * PHASES)[:, None]).real
    mean[:, [0, 2, 3]] -= form.T @ (2 * (at.c * np.abs(q)).mean(axis=0)[:, None] * form)
    return np.linalg.solve(model.inertia, mean)


def measures(model, start):
    """Amplitudes of sway, roll and yaw, K2, index and leading exponent."""
    system = model.system
    u, _, _ = harmonic_balance(system, ORDERS, start=start[None])
    n2, _, rate = roll_mode(mean_slopes(model, u[0])[None], system.linear)
    growth = assess(system, u, ORDERS, accuracy=1e-12).floquet.growth[0]
    amplitude = np.hypot(u[0, :, 0], u[0, :, 1]) * [1, 180 / np.pi, 180 / np.pi]
    return np.array([*amplitude, 2 * n2[0] * rate[0], -rate[0], growth])


def apart(found, models, start, step):
    """Differences (6,) of derivatives from those of motions solved again, over the larger of them and of the measure."""
    around = np.array([measures(model, start) for model in models])
    expected = difference(around, step)
    return np.abs(found - expected) / np.maximum(np.abs(expected), np.abs(around.mean(axis=0)))


@pytest.mark.soak
def test_every_coefficient_of_a_model_with_strips_and_a_spline():
    """Authority: motions solved again, four of each term; roll of 31 deg, past the knots of the spline."""
    model = dragged_model(2.0, restoring=SPLINE)
    u = harmonic_balance(model.system, ORDERS)[0][0]
    assert np.hypot(*u[1, :2]) > np.radians(30.0)
    parameters = coefficient_rows(model)
    _, slopes, why = derivatives(model.system, [row.change for row in parameters], u, ORDERS)
    assert why == ""
    step = 2 * STEP
    for row, found in zip(parameters, slopes, strict=True):
        around = [replace(model, terms=dict(model.terms) | {row.name: row.value * (1 + step * o)}) for o in OFFSETS]
        assert apart(found, around, u, step).max() < 1e-6, row.name


def test_wave_and_loading_of_a_ship_with_all_defaults():
    """Authority: motions of the ship solved again, its forces and coefficients with them."""
    ship = qt.ship("series60-cb60")
    assert (ship.drag, ship.righting, ship.velocities) == ("strips", "spline", "relative")
    length, speed, heading = ship.hull.length, 8.0, 60.0

    def model(height=1.0, gm=1.0, damping=1.0):
        other = ship.with_(gm=gm * ship.loading.gm, roll_damping=damping * ship.loading.roll_damping)
        return qt.equations(other, qt.Wave(length, height * length / 40), speed, heading)

    table = qt.sensitivity(ship, qt.Wave(length, length / 40), speed, heading, harmonics=max(ORDERS))
    u = harmonic_balance(model().system, ORDERS, from_rest=True)[0][0]
    for name, argument in (("wave_height", "height"), ("gm", "gm"), ("roll_damping", "damping")):
        found = np.array([float(table[m].sel(parameter=name)) for m in MEASURES])
        around = [model(**{argument: 1 + STEP * o}) for o in OFFSETS]
        assert apart(found, around, u, STEP).max() < 1e-6, name
