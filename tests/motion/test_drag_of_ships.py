"""Steep waves with drag strip by strip: built-in ships against an independent integration in time."""

import json

import numpy as np
import pytest

import quartering as qt
from quartering.motion.harmonic import harmonic_balance
from quartering.motion.drag_of_ship import drag_strips
from quartering.motion.of_ship import ship_system
from quartering.stability.assessment import assess
from tests.reference import HERE

ROWS = json.loads((HERE / "moving_water.json").read_text())["steep"]["rows"]
ORDERS = (1, 3, 5, 7, 9)


def steep(name: str):
    rows = [row for row in ROWS if row["ship"] == name]
    ship = qt.ship(name).with_(ends="strips", drag="strips", righting="polynomial")
    length = np.array([row["lambda_over_L"] for row in rows]) * ship.hull.length
    slope = np.array([1 / float(row["steepness"].split("/")[1]) for row in rows])
    speed, heading = (np.array([row[key] for row in rows]) for key in ("speed", "heading_deg"))
    at = ship_system(ship, 2 * np.pi / length, speed, heading)
    return rows, at.at_amplitude((0.5 * slope * length)[:, None])


@pytest.mark.parametrize("name", ["series60-cb60", "s175"])
def test_steep_waves_agree_with_integration_elsewhere(name):
    """Roll and sway to 2 %, yaw to 3 %, exponents to 3 % of the reference, which integrates |q| q from rest.

    Its S-175 had most sections on Lewis forms; on their own contours roll at resonance comes out up to 3.4 % lower: 4 % there.
    """
    share = 0.04 if name == "s175" else 0.02
    rows, system = steep(name)
    np.testing.assert_allclose(system.frequency, [row["omega"] for row in rows], rtol=1e-4)
    u, status, _ = harmonic_balance(system, ORDERS, from_rest=True)
    assert (status <= 1).all()
    sway, roll, yaw = np.hypot(u[:, :, 0], u[:, :, 1]).T
    np.testing.assert_allclose(np.degrees(roll), [row["roll_deg"] for row in rows], rtol=share, atol=0.1)
    np.testing.assert_allclose(sway, [row["sway"] for row in rows], rtol=0.02, atol=np.radians(0.1))
    np.testing.assert_allclose(np.degrees(yaw), [row["yaw_deg"] for row in rows], rtol=0.03, atol=0.02)
    found = assess(system, u, ORDERS)
    exponents = np.sort(found.floquet.exponents.real, axis=1)
    wanted = np.sort([row["exponents"] for row in rows], axis=1)
    rate, wanted_rate = found.first_order.roll_rate, np.array([row["roll_rate_first_order"] for row in rows])
    for ours, theirs in ((exponents[:, -1], wanted[:, -1]), (rate, wanted_rate)):
        if (
            name == "s175"
        ):  # two of its rows lie where the leading pair parts: there 3 % of roll are a quarter of the exponent
            assert np.median(np.abs(ours / theirs - 1)) < 0.01
        else:
            np.testing.assert_allclose(ours, theirs, rtol=0.03, atol=5e-4)


def test_drag_of_one_strip_is_that_of_its_lines():
    """Closed form: the sum of c over strips is (1/2) rho C_D times the lateral area, a rectangle for this hull."""
    ship = qt.ship("wigley")
    strips = drag_strips(ship, np.array([0.05]), np.array([5.0]), np.array([180.0]))
    area = strips.c.sum() / (0.5 * ship.loading.density * ship.drag_coefficient)
    assert area == pytest.approx(ship.hull.length * ship.hull.draught, rel=0.01)
    assert np.abs(strips.water).max() < 1e-12  # a head sea does not cross the ship
