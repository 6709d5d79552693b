"""The paper's short index in moving water: amplitudes through the water, and drag by strips as cubics of equal energy."""

import json

import numpy as np
import pytest

import quartering as qt
from quartering.motion.of_ship import ship_system
from quartering.motion.steady.harmonic import harmonic_balance
from quartering.stability.assessment import assess
from quartering.stability.short_index import through_water
from tests.reference import HERE

ROWS = json.loads((HERE / "moving_water.json").read_text())["steep"]["rows"]
ORDERS = (1, 3, 5, 7, 9)
TERMS = {"Y_v": -1.0, "K_phi": -1.0, "K_p": -0.1, "N_r": -1.0, "K_ppp": -0.1, "K_vvv": -0.2, "K_prr": -0.3}


def judged(name: str, **options):
    rows = [row for row in ROWS if row["ship"] == name]
    ship = qt.ship(name).with_(ends="strips", righting="polynomial", **options)
    length = np.array([row["lambda_over_L"] for row in rows]) * ship.hull.length
    slope = np.array([1 / float(row["steepness"].split("/")[1]) for row in rows])
    speed, heading = (np.array([row[key] for row in rows]) for key in ("speed", "heading_deg"))
    system = ship_system(ship, 2 * np.pi / length, speed, heading).at_amplitude((0.5 * slope * length)[:, None])
    u, *_ = harmonic_balance(system, ORDERS, from_rest=True)
    return assess(system, u, ORDERS)


@pytest.mark.parametrize("name", ["series60-cb60", "s175"])
def test_the_full_index_is_the_growth_of_roll(name):
    """Theory of moving water, section 7: K2/(2 n2) against the roll pair of Floquet, 0.8 % in the median, 4.2 % at worst."""
    found = judged(name)
    exponents = found.floquet.exponents
    pair = np.abs(exponents.imag) > 1e-4
    there = pair.any(axis=1)  # near a resonance the pair parts, and q of m = 2 is its growth
    assert there.sum() >= 11
    roll = np.where(pair, exponents.real, 0.0).sum(axis=1)[there] / 2
    miss = np.abs(roll / found.first_order.roll_rate[there] - 1)
    assert np.median(miss) < 0.015
    assert miss.max() < 0.05


def test_a_ship_that_rides_with_the_water_has_no_drag_in_its_index():
    """Closed form: where (v, r) is (w0, w1) the amplitudes through the water are nil, and roll's own alone counts."""
    w0, w1, w = 0.4 - 0.2j, 0.01 + 0.03j, 0.8
    model = qt.Model(np.eye(3), TERMS, w, (0, 0, 0), (0, 0, 0), water=(w0, w1))
    displacement = np.array([[w0 / (1j * w), 0.1, w1 / (1j * w)]])
    relative = through_water(model.system, displacement)
    np.testing.assert_allclose(relative, [[0.0, 0.1, 0.0]], atol=1e-15)
    still = qt.Model(np.eye(3), TERMS, w, (0, 0, 0), (0, 0, 0))
    np.testing.assert_array_equal(through_water(still.system, displacement), displacement)


def test_amplitudes_over_ground_misjudge_a_ship_in_long_beam_waves():
    """The full index holds all averages of the motion through the water: the short one must use the same, or is far off."""
    ship = qt.ship("series60-cb60").with_(drag="cubic")
    model = qt.equations(ship, qt.Wave(6 * ship.hull.length, 18.0), speed=7.5, heading=90.0)
    verdict = qt.stability(model, qt.steady_motion(model, start="rest"))
    through, over = (abs(index / verdict.k2 - 1) for index in (verdict.k2_rho, verdict.k2_paper))
    assert through < 0.15
    assert over > 2 * through
    assert verdict.through_water[0] < 0.1 * qt.steady_motion(model, start="rest").amplitude[0]


def test_strips_have_the_index_of_their_matched_cubics():
    """By the same amplitudes and u0 two forms of one drag have one short index, but for the motions, 0.4 % apart in roll."""
    law, cubic = (judged("series60-cb60", drag=drag).first_order for drag in ("strips", "cubic"))
    np.testing.assert_allclose(law.k2_rho, cubic.k2_rho, rtol=0.02)
    np.testing.assert_allclose(law.k2_paper, cubic.k2_paper, rtol=0.02)
