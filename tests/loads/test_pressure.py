"""Pressure over the instantaneous wetted hull: energy, limits, and the linear Froude-Krylov force."""

import numpy as np
import pytest

import quartering as qt
from quartering.hull.lines.immersed import strips
from quartering.loads.strips.froude_krylov import froude_krylov
from quartering.loads.strips.stations import stations
from quartering.loads.wetted_hull.floating import floating_hull
from quartering.loads.wetted_hull.pressure import Waves, direct_loads, wetted_hull

SHIPS = ("s175", "dtc")
STATE = np.array([[0.4, np.radians(17.0), np.radians(0.9)]])


def waves(ship, height, heading, phase=0.7):
    k = 2 * np.pi / ship.hull.length
    along, across = k * np.cos(np.radians(heading)), k * np.sin(np.radians(heading)) if heading % 180 else 0.0
    return Waves(*(np.array([v]) for v in (height / 2, along, across, phase)))


def by_difference(ship, wave, pressure="hydrostatic", exact=False, step=1e-4):
    hull = floating_hull(ship, 24).hull
    change = [step * np.eye(3)[q] for q in range(3)]
    up, down = (direct_loads(hull, STATE + sign * np.array(change), wave, pressure, exact)[0] for sign in (1, -1))
    return ((up - down) / (2 * step)).T


def direct_of_three(ship, wave, pressure, exact=False):
    return direct_loads(floating_hull(ship, 24).hull, STATE, wave, pressure, exact)[1][0]


@pytest.mark.parametrize("name", SHIPS)
@pytest.mark.parametrize("height", [0.0, 0.03])
def test_hydrostatic_loads_have_a_potential(name, height):
    """Energy: dK/dh = dZ/dphi, dK/dtheta = dM/dphi, dZ/dtheta = dM/dh, in calm water and in a head sea.

    The wave is taken at the section's own place, so its slope enters neither side.
    """
    ship = qt.ship(name)
    found = by_difference(ship, waves(ship, height * ship.hull.length, 180.0))
    Z, K, M = 2, 3, 4
    assert found[K, 0] == pytest.approx(found[Z, 1], rel=2e-3)  # a polygon's K is smooth but for its corners
    assert found[M, 1] == pytest.approx(found[K, 2], rel=1e-4)
    assert found[Z, 2] == pytest.approx(found[M, 0], rel=1e-5)


def energy(hull, state, wave, points=4000):
    """int d dV over the immersed hull with the wave at the true place of every point: midpoint rule in depth, upright."""
    heave, pitch = state
    a, along, phase = (float(part[0]) for part in (wave.amplitude, wave.along, wave.phase))
    total = 0.0
    for x, weight, n, y, z in zip(hull.x, hull.weight, hull.points, hull.y, hull.z, strict=True):
        step = (z[0] - z[n - 1]) / points
        down = z[n - 1] + step * (np.arange(points) + 0.5)
        breadth = 2 * np.interp(-down, -z[: n - 1], y[: n - 1])  # heights ascend; the last point closes the deck
        place = x * np.cos(pitch) + down * np.sin(pitch)
        depth = heave - hull.z0 - x * np.sin(pitch) + down * np.cos(pitch) + a * np.cos(along * place - phase)
        total += weight * step * float(breadth @ np.maximum(depth, 0.0))
    return total


@pytest.mark.parametrize("pitch", [-0.02, 0.01, 0.04])
def test_in_a_steep_wave_the_exact_pitch_moment_is_the_derivative_of_the_energy(pitch):
    """M = -dE/dtheta of the true wave, within 6e-4 of the largest: the slope of the wave is taken at the surface."""
    ship = qt.ship("wigley")
    hull, wave = wetted_hull(ship.hull).about(0.0, 8.0 - ship.hull.draught), waves(ship, 0.04 * ship.hull.length, 180.0)
    step = 2e-4
    M = -(energy(hull, (0.1, pitch + step), wave) - energy(hull, (0.1, pitch - step), wave)) / (2 * step)
    found = direct_loads(hull, np.array([[0.1, 0.0, pitch]]), wave, "hydrostatic", exact=True)[0][0, 4]
    assert found == pytest.approx(M, abs=6e-4 * 25e3)


@pytest.mark.parametrize(("pressure", "heading"), [("hydrostatic", 180.0), ("smith", 180.0), ("smith", 150.0)])
def test_the_jacobian_is_the_derivative_of_the_loads(pressure, heading):
    """By central difference; in oblique waves up to where the surface passes a corner."""
    ship = qt.ship("dtc")
    wave = waves(ship, 0.03 * ship.hull.length, heading)
    found, expected = direct_of_three(ship, wave, pressure), by_difference(ship, wave, pressure)
    scale = np.abs(expected).max(axis=1, keepdims=True)
    assert (np.abs(found - expected) < 2e-3 * scale + 1e-6).all()


@pytest.mark.parametrize("heading", [30.0, 90.0, 180.0])
def test_a_small_wave_gives_the_linear_froude_krylov_force(heading):
    """Authority: the linear force in sway, roll and yaw from the contours; roll about G with the water that moves.

    The direct force of a wave at phase eps is Re F e^{-i eps}; the linear phasor belongs to a surface - A sin(omega t) up.
    """
    ship = qt.ship("wigley")
    k = 2 * np.pi / 80.0
    linear = froude_krylov(strips(ship.hull), stations(ship), [k], [heading], density=1.0)[0] / 9.81
    floats, a = floating_hull(ship), 1e-4
    along, across = k * np.cos(np.radians(heading)), k * np.sin(np.radians(heading)) if heading % 180 else 0.0
    two = Waves(*(np.full(2, v) for v in (a, along, across)), np.array([0.0, np.pi / 2]))
    calm = direct_loads(floats.hull, np.zeros((1, 3)), Waves(*np.zeros((4, 1))))[0][0]
    loads = (direct_loads(floats.hull, np.zeros((2, 3)), two)[0] - calm) / a
    # eta = a cos(k x - omega t) at t = eps/omega: the cos part at phase 0, the sin part at phase 90
    found = (loads[0] - 1j * loads[1])[[1, 3, 5]]
    expected = linear * np.exp(-1j * np.pi / 2)  # -sin(omega t) = cos(omega t + pi/2) up
    if heading == 180.0:
        assert np.abs(found).max() < 1e-6
        return
    assert found == pytest.approx(expected, rel=3e-3, abs=1e-9)
