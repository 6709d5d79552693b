"""Measured order of what is summed along the ship; that of the section panels is measured in tests/hydro/test_closefit.py."""

import numpy as np
import pytest

from quartering.hull.lines.quadrature import station_weights


def test_wave_force_along_the_ship_has_the_fourth_order_of_the_station_weights():
    """Closed form: int (1 - u^2) cos(k x) dx of a Wigley-like load over a wave as long as the ship, stations even."""
    k = 2 * np.pi / 100.0
    half = 50.0
    exact = 4 * (np.sin(k * half) - k * half * np.cos(k * half)) / (k**3 * half**2)
    errors = []
    for count in (20, 40, 80, 160, 320):
        x = np.linspace(-half, half, count + 1)
        errors.append(abs(station_weights(x) @ ((1 - (x / half) ** 2) * np.cos(k * x)) - exact))
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert orders[-1] == pytest.approx(4.0, abs=0.2)
    assert errors[0] < 1e-2 * abs(exact)  # 21 stations, as lines are given
