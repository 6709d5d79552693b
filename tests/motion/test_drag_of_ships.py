"""Steep waves with drag strip by strip: built-in ships against an independent integration in time."""

import json
from dataclasses import replace

import numpy as np
import pytest

import quartering as qt
from quartering.hull.lines.immersed import strips
from quartering.hydro.strip import hull_table
from quartering.motion.drag_of_ship import drag_strips
from quartering.motion.of_ship import ship_system
from quartering.motion.steady.harmonic import harmonic_balance
from quartering.stability.assessment import assess
from tests.hydro.sections_of_two_kinds import lewis_like, table_of_two_kinds
from tests.reference import HERE

ROWS = json.loads((HERE / "moving_water.json").read_text())["steep"]["rows"]
ORDERS = (1, 3, 5, 7, 9)


def steep(name: str, hull_name: str | None = None):
    rows = [row for row in ROWS if row["ship"] == name]
    ship = qt.ship(name).with_(ends="strips", drag="strips", righting="polynomial")
    if hull_name is not None:
        ship = replace(ship, hull=replace(ship.hull, name=hull_name))
    length = np.array([row["lambda_over_L"] for row in rows]) * ship.hull.length
    slope = np.array([1 / float(row["steepness"].split("/")[1]) for row in rows])
    speed, heading = (np.array([row[key] for row in rows]) for key in ("speed", "heading_deg"))
    at = ship_system(ship, 2 * np.pi / length, speed, heading)
    return rows, at.at_amplitude((0.5 * slope * length)[:, None])


def hold(rows, system, share: float, of_yaw: float, of_rates: float, slack: float):
    """Amplitudes and exponents within shares of the reference's, and within `slack` of a degree."""
    np.testing.assert_allclose(system.frequency, [row["omega"] for row in rows], rtol=1e-4)
    u, status, _ = harmonic_balance(system, ORDERS, from_rest=True)
    assert (status <= 1).all()
    sway, roll, yaw = np.hypot(u[:, :, 0], u[:, :, 1]).T
    np.testing.assert_allclose(np.degrees(roll), [row["roll_deg"] for row in rows], rtol=share, atol=slack)
    np.testing.assert_allclose(sway, [row["sway"] for row in rows], rtol=min(share, 0.02), atol=np.radians(slack))
    np.testing.assert_allclose(np.degrees(yaw), [row["yaw_deg"] for row in rows], rtol=of_yaw, atol=0.2 * slack)
    found = assess(system, u, ORDERS)
    exponents = np.sort(found.floquet.exponents.real, axis=1)[:, -1]
    wanted = np.sort([row["exponents"] for row in rows], axis=1)[:, -1]
    np.testing.assert_allclose(exponents, wanted, rtol=of_rates, atol=5e-4 if of_rates > 0.01 else 3e-5)
    rates = [row["roll_rate_first_order"] for row in rows]
    np.testing.assert_allclose(
        found.first_order.roll_rate, rates, rtol=of_rates, atol=5e-4 if of_rates > 0.01 else 3e-5
    )


@pytest.mark.parametrize("name", [pytest.param("series60-cb60", marks=pytest.mark.soak), "s175"])
def test_steep_waves_agree_with_integration_elsewhere(name, monkeypatch):
    """Roll, sway and yaw to 0.1 %, exponents to 0.3 % of the reference, which integrates |q| q of every strip from rest.

    Demanded are 2 % and 3 %. The reference stands on tables in which sections within 1 % of a Lewis form were taken for it:
    two of the 24 of the S-175. No option gives such tables, so they are put together here, for a hull of another name: tables
    are kept by hull.
    """
    monkeypatch.setattr(hull_table, "radiation_table", table_of_two_kinds)
    hold(*steep(name, f"{name} of two kinds"), share=1e-3, of_yaw=1e-3, of_rates=3e-3, slack=0.01)


def test_sections_on_their_own_contours_move_the_series_60_by_less_than_is_demanded():
    """Roll and sway to 2 %, yaw to 3 %, exponents to 3 % of the reference with the tables of today."""
    hold(*steep("series60-cb60"), share=0.02, of_yaw=0.03, of_rates=0.03, slack=0.1)


def test_two_sections_are_what_moves_the_s175():
    """Two sections on their Lewis forms lower roll at resonance by 3.4 % of itself, beyond the 2 % of the reference.

    All else is within it but the exponent of two rows where the leading pair parts: there 3 % of roll are a quarter of it.
    """
    rows, system = steep("s175")
    assert lewis_like(strips(qt.ship("s175").hull)).sum() == 2
    u, _, _ = harmonic_balance(system, ORDERS, from_rest=True)
    roll = np.degrees(np.hypot(u[:, 1, 0], u[:, 1, 1]))
    apart = np.abs(roll / [row["roll_deg"] for row in rows] - 1)
    assert apart.max() < 0.04
    assert np.sort(apart)[-2] < 0.02


def test_drag_of_one_strip_is_that_of_its_lines():
    """Closed form: the sum of c over strips is (1/2) rho C_D times the lateral area, a rectangle for this hull."""
    ship = qt.ship("wigley")
    found = drag_strips(ship, np.array([0.05]), np.array([5.0]), np.array([180.0]))
    area = found.c.sum() / (0.5 * ship.loading.density * ship.drag_coefficient)
    assert area == pytest.approx(ship.hull.length * ship.hull.draught, rel=0.01)
    assert np.abs(found.water).max() < 1e-12  # a head sea does not cross the ship
