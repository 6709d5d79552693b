"""Derivatives against independent differences and closed forms."""

from dataclasses import replace

import numpy as np
import pytest

import quartering as qt
from quartering.motion.branches.branch import balance_of

SHIP = qt.paper_ship("series60-cb60")  # every term has a name and all derivatives
LENGTH = SHIP.hull.length
WAVE, SPEED, HEADING = qt.Wave(LENGTH, LENGTH / 60), 8.0, 45.0


@pytest.fixture(scope="module")
def table():
    return qt.sensitivity(SHIP, WAVE, SPEED, HEADING)


def test_roll_derivatives_by_every_coefficient_agree_with_implicit_differentiation_to_1e_6(table):
    """du/dtheta = -R_u^-1 R_theta, exact: the balance equations are linear in every coefficient, so R(2 theta) - R(theta)
    is theta R_theta."""
    model = qt.equations(SHIP, WAVE, SPEED, HEADING)
    motion = qt.steady_motion(model, 3, start="rest")
    u, orders = motion.coefficients, motion.orders_with_mean
    residual, matrix = balance_of(model.system, orders, u)
    amplitude = motion.amplitude[1]
    checked = 0
    for name, value in model.terms.items():
        if value == 0.0:
            continue
        doubled = replace(model, terms=dict(model.terms) | {name: 2 * value}).system
        change = balance_of(doubled, orders, u, with_matrix=False)[0] - residual
        slope = np.linalg.solve(matrix, -change).reshape(u.shape)[1]
        expected = np.degrees((u[1, 0] * slope[0] + u[1, 1] * slope[1]) / amplitude)
        found = float(table["roll"].sel(parameter=name))
        assert found == pytest.approx(expected, rel=1e-6, abs=1e-6 * np.degrees(amplitude)), name
        checked += 1
    assert checked > 20


def test_linear_limit_roll_is_proportional_to_wave_height():
    """Closed form: for a small wave d roll / d ln H = roll."""
    ds = qt.sensitivity(SHIP, qt.Wave(LENGTH, 1e-3), SPEED, HEADING)
    assert float(ds["roll"].sel(parameter="wave_height")) == pytest.approx(ds.attrs["base_roll"], rel=1e-6)


def test_even_harmonics_are_refused():
    with pytest.raises(qt.InputError, match="harmonics"):
        qt.sensitivity(SHIP, WAVE, SPEED, HEADING, harmonics=1)
