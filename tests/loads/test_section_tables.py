"""Loads from tables of sections against the direct integration of the pressure."""

import numpy as np
import pytest

import quartering as qt
from quartering.loads.wetted_hull.floating import floating_hull
from quartering.loads.wetted_hull.pressure import Waves, direct_loads
from quartering.loads.wetted_hull.section_tables import section_tables, table_loads

SHIP = qt.ship("series60-cb60")
FLOATS = floating_hull(SHIP, 24)
K = 2 * np.pi / SHIP.hull.length


def states_and_waves(heading, count=200):
    """Heave to 0.2 T, heel to 29 deg, trim to 2.3 deg, steepness to 0.04."""
    chance = np.random.default_rng(1971)
    heave, heel, trim = (chance.uniform(-1, 1, count) * limit for limit in (0.2 * SHIP.hull.draught, 0.506, 0.04))
    along, across = K * np.cos(np.radians(heading)), K * np.sin(np.radians(heading)) if heading % 180 else 0.0
    amplitude, phase = chance.uniform(0, 0.02 * SHIP.hull.length, count), chance.uniform(0, 6.3, count)
    return np.stack([heave, heel, trim], axis=1), Waves(amplitude, np.full(count, along), np.full(count, across), phase)


def tables(pressure):
    made = section_tables(SHIP.hull, K if pressure == "smith" else 0.0, 24)
    return made.about(FLOATS.x_g, FLOATS.hull.z0)


# K over V GM/2, in head seas, where the surface is straight across the ship, and at 150 deg, where it bends (k B sin mu = 0.4).
@pytest.mark.parametrize("pressure", ["hydrostatic", "smith"])
@pytest.mark.parametrize(("heading", "roll_miss"), [(180.0, 4e-4), (150.0, 5e-3)])
def test_the_tables_give_the_loads_of_the_pressure(pressure, heading, roll_miss):
    """Root mean square over 200 states: Z 4e-4 of the volume, M 4e-5 of V L/10 in head seas."""
    state, wave = states_and_waves(heading)
    direct, _ = direct_loads(FLOATS.hull, state, wave, pressure)
    found, _ = table_loads(tables(pressure), state, wave)
    V, L = FLOATS.volume, SHIP.hull.length
    scale = np.array([V, V, V, 0.5 * V * SHIP.loading.gm, 0.1 * V * L, 0.1 * V * L])
    miss = np.sqrt(np.mean((found - direct) ** 2, axis=0)) / scale
    assert miss[3] < roll_miss
    straight = heading == 180.0
    assert miss[[0, 1, 2]].max() < (4e-4 if straight else 1e-3)
    assert miss[[4, 5]].max() < (4e-5 if straight else 2e-3)


@pytest.mark.parametrize("pressure", ["hydrostatic", "smith"])
@pytest.mark.parametrize("heading", [180.0, 150.0, 60.0])
def test_the_gradients_are_those_of_the_tables_themselves(pressure, heading):
    """Splines are differentiated exactly, and the wave as roll moves sections in it: central differences of the loads."""
    state, wave = states_and_waves(heading, 20)
    made, step = tables(pressure), 1e-5
    jacobian = table_loads(made, state, wave)[1]
    for q in range(3):
        change = step * np.eye(3)[q]
        difference = (table_loads(made, state + change, wave)[0] - table_loads(made, state - change, wave)[0]) / (
            2 * step
        )
        assert np.abs(jacobian[:, :, q] - difference).max(axis=0) == pytest.approx(
            0, abs=2e-5 * np.abs(difference).max()
        )


def test_a_state_outside_the_tables_has_no_loads():
    calm = Waves(*np.zeros((4, 1)))
    for state in ([0.0, np.radians(80.0), 0.0], [5 * SHIP.hull.draught, np.radians(50.0), 0.0]):
        loads, jacobian = table_loads(tables("hydrostatic"), np.array([state]), calm)
        assert np.isnan(loads).all()
        assert np.isnan(jacobian).all()
    flying = table_loads(tables("hydrostatic"), np.array([[-5 * SHIP.hull.draught, 0.0, 0.0]]), calm)[0]
    assert flying == pytest.approx(0.0, abs=1e-9)


def test_a_hull_under_water_up_to_its_deck_keeps_its_volume():
    """Below the last depth of the tables the loads are those of the pressure itself: whole areas, and a wave that decays."""
    _, wave = states_and_waves(180.0, 3)
    deep = np.array([[2.0 * SHIP.hull.draught + d, 0.1, 0.02] for d in (6.0, 9.0, 12.0)])
    for pressure in ("hydrostatic", "smith"):
        loads, _ = table_loads(tables(pressure), deep, wave)
        wanted, _ = direct_loads(FLOATS.hull, deep, wave, pressure)
        assert loads[:, 2] == pytest.approx(wanted[:, 2], rel=2e-3)
        assert loads[:, 3] == pytest.approx(wanted[:, 3], abs=2e-3 * np.abs(wanted[:, 3]).max())
