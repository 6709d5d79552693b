"""Stability of roll where the restoring moment changes with the wave: Mathieu's equation, ships of an independent code, and
integration in time."""

import numpy as np
import pytest
from scipy.optimize import brentq

import quartering as qt
from quartering.motion.steady_course.balance import doubled_harmonics, oblique_doubled_harmonics
from quartering.motion.steady_course.course import course
from quartering.motion.steady_course.doubled import doubled_motions, largest_roll
from quartering.motion.steady_course.march import STATES, march
from quartering.motion.steady_course.orbits import symmetric_orbits
from quartering.stability.parametric import doubled_multipliers, growths, hill_multipliers, roll_growth
from tests.reference import table
from tests.simplified_course import rolling_alone, start_on, with_constant_coefficients
from tests.tiers import mostly_soak

SHIP = qt.ship("s175").with_(gm=1.0, gyradius_roll=8.89, gyradius_pitch=43.75, ends="strips", roll_damping=0.02)
LENGTH = 175.0


def at(speed, height, heading=180.0, ship=SHIP):
    one = (np.array([value]) for value in (height / 2, speed, heading))
    return course(ship, 2 * np.pi / LENGTH, *one)


@pytest.mark.parametrize("row", table("mathieu_thresholds.csv"), ids=lambda r: f"W{r['W']}-zeta{r['zeta']}")
def test_thresholds_of_mathieus_equation(row):
    """Smallest h with a multiplier -1, to 1e-6, against an independent integration."""
    W, zeta, h = (float(row[key]) for key in ("W", "zeta", "h"))
    phase = 2 * np.pi * np.arange(16) / 16

    def excess(variation):
        found = hill_multipliers(1 + variation * np.cos(phase)[None], np.array([2 * zeta]), np.array([2 * np.pi / W]))
        return float(np.abs(found).max()) - 1.0

    assert brentq(excess, 0.9 * h, 1.1 * h, xtol=1e-12) == pytest.approx(h, abs=1e-6)


def test_growth_beyond_any_number_is_infinite():
    """x'' = x grows by e^T over T: e^20 within 1e-6 by 4,000 steps of order 4, and more than a number holds over T = 2,000."""
    found = np.abs(hill_multipliers(np.full((2, 8), -1.0), np.zeros(2), np.array([20.0, 2000.0]), 4000)).max(axis=1)
    assert found[0] == pytest.approx(np.exp(20.0), rel=1e-6)
    assert np.isinf(found[1])


@pytest.mark.parametrize("row", table("hill_of_ships.csv"), ids=lambda r: f"{r['ship']}-{r['speed']}")
def test_growth_on_the_metacentric_height_of_an_independent_code(row):
    """Floquet exponent of roll alone with that code's GM(t), to 1e-5 1/s."""
    value = {key: float(text) for key, text in row.items() if key != "ship"}
    phase = 2 * np.pi * np.arange(64) / 64
    gm = value["mean"] + 2 * sum(
        value[f"c{k}"] * np.cos(k * phase) - value[f"d{k}"] * np.sin(k * phase) for k in range(1, 7)
    )
    w0, period = value["w0"], 2 * np.pi / value["omega"]
    found = hill_multipliers(w0**2 * gm[None] / value["gm"], np.array([2 * value["zeta"] * w0]), np.array([period]))
    assert float(np.log(np.abs(found).max())) / period == pytest.approx(value["growth"], abs=1e-5)


@pytest.mark.parametrize(("alone", "speed"), [(True, 3.3), (False, 3.3), (False, 2.4)])
def test_growth_and_steady_roll_are_those_of_an_integration_in_time(alone, speed):
    """Growth by Floquet within 2 % and roll of two periods within 1 % of a march of the same equations."""
    heading = 180.0 if speed == 3.3 else 0.0
    ship = SHIP if heading else SHIP.with_(gm=0.6)
    one = with_constant_coefficients(at(speed, 5.25, heading, ship))
    one = rolling_alone(one, 0.02) if alone else one
    orbits = symmetric_orbits(one)
    growth = roll_growth(orbits, 0.02)
    omega = one.numbers.omega[0]
    history = march(one, start_on(orbits.x[0], orbits.basis, omega, 1e-7), 50, 64)
    peaks = np.abs(history.state[:-1, 5]).reshape(50, 64).max(axis=1)
    measured = np.log(peaks[45] / peaks[25]) / (20 * 2 * np.pi / omega)
    wanted = growth.growth_roll_only if alone else growth.growth
    assert float(wanted[0]) == pytest.approx(measured, rel=0.02)
    x, _ = doubled_motions(one, 2.625, 4.0)
    basis = doubled_harmonics()
    sizes, stable = largest_roll(basis, x), np.abs(doubled_multipliers(one, basis, x)).max(axis=1) < 1.0
    assert stable.sum() == 1
    settled = march(one, start_on(orbits.x[0], orbits.basis, omega, 0.1), 150, 48)
    assert float(sizes[stable][0]) == pytest.approx(np.abs(settled.state[-480:, 5]).max(), rel=0.01)


def test_of_two_motions_of_two_periods_beyond_a_fold_one_is_stable():
    """Stability alternates along a branch: where it turns back a real multiplier passes 1."""
    ship = qt.ship("dtmb5415").with_(gm=1.0, gyradius_roll=7.0596, gyradius_pitch=35.5, ends="strips")
    length = ship.hull.length
    one = course(ship, 2 * np.pi / length, *(np.array([v]) for v in (0.015 * length, 2.68, 180.0)))
    one = rolling_alone(with_constant_coefficients(one), 0.03)
    _, branches = doubled_motions(one, 0.015 * length, 0.022 * length)
    branch = branches[0]
    back = np.flatnonzero(np.diff(branch.amplitude) < 0)
    basis, checked = branch.basis, 0
    for k in range(2, branch.amplitude.size - 1, 3):
        largest = doubled_multipliers(one.at_amplitude(branch.amplitude[[k]]), basis, branch.x[[k]])[0]
        real = largest[np.abs(largest.imag) < 1e-9].real
        if abs(branch.amplitude[k + 1] - branch.amplitude[k - 1]) > 0.02 * branch.amplitude.max() and not (
            {k - 1, k} & set(back.tolist()) and branch.amplitude[k] > branch.amplitude[k - 1]
        ):
            assert bool((real > 1.0).any()) == (branch.amplitude[k + 1] < branch.amplitude[k - 1])
            checked += 1
    assert checked > 3


@pytest.mark.parametrize("heading", mostly_soak([165.0, 150.0], 150.0))
def test_roll_of_two_periods_in_an_oblique_sea_is_that_of_a_march(heading):
    """Authority: integration in time of the same equations, from 3 deg of roll, 1 % allowed; the forced motion is unstable."""
    ship = qt.ship("dtc").with_(autopilot="1,10s")
    one = course(ship, 2 * np.pi / 355, *(np.array([v]) for v in (3.5, 5.0, heading)))
    one = with_constant_coefficients(one)
    basis = oblique_doubled_harmonics()
    x, branches = doubled_motions(one, 3.5, 5.0, basis=basis)
    assert len(x) == len(branches) == 1
    assert growths(one, basis, x, 2)[0][0] < 0.0
    assert branches[0].amplitude[0] < 3.5
    start = np.zeros(len(STATES))
    start[5] = 0.05
    late = march(one, start, 400.0).state[-48 * 20 :, 5]
    assert largest_roll(basis, x)[0] == pytest.approx(np.abs(late).max(), rel=0.01)
    assert np.abs(late[48:] + late[:-48]).max() < np.abs(late).max()  # not of one period ..
    np.testing.assert_allclose(late[96:], late[:-96], atol=1e-4 * np.abs(late).max())  # .. but of two


def test_an_oblique_sea_that_turns_into_a_head_sea_has_its_roll():
    """Limit: half a degree off the bow differs from a head sea in second order; a low wave leaves the forced motion alone."""
    ship, wave = qt.ship("dtc"), qt.Wave(355.0, 7.0)
    ahead, off = (qt.parametric_roll(ship, wave, 5.0, heading) for heading in (180.0, 179.5))
    assert off.kind == ahead.kind == "parametric"
    assert off.amplitude == pytest.approx(ahead.amplitude, rel=2e-3)
    mirrored = qt.parametric_roll(ship, wave, 5.0, 180.5)
    assert mirrored.amplitude == pytest.approx(off.amplitude, rel=1e-6)
    low = qt.parametric_roll(ship, qt.Wave(355.0, 1.0), 5.0, 165.0)
    assert (low.kind, len(low.amplitude)) == ("forced", 1)
    assert "that motion is stable" in low.sentence
