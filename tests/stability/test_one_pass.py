"""From a map's motions to transition matrices in one pass: as by small steps, and no condition the wiser of its neighbours."""

import numpy as np
import pytest

import quartering as qt
from quartering.motion.equations.batch import rows
from quartering.motion.equations.system import acceleration_form
from quartering.motion.equations.terms import term_table
from quartering.motion.of_ship import ship_system
from quartering.motion.steady.harmonic import harmonic_balance
from quartering.stability.variational.one_pass import goes_in_one_pass, in_one_pass
from quartering.stability.variational.transition import transition_matrices
from quartering.stability.variational.variation import variational_harmonics

ACCURACY = 5e-6
COUNT = 75  # nine rows and part of one


def of_cubics():
    """Damped rolls with a cubic moment, in waves of many frequencies: from four steps to more than the first tables hold."""
    random = np.random.default_rng(4)
    linear = np.zeros((COUNT, 3, 4))
    linear[:, [0, 1, 2], [0, 2, 3]] = -random.uniform(0.05, 0.5, (COUNT, 3))
    linear[:, 1, 0], linear[:, 1, 1] = random.uniform(-0.1, 0.1, COUNT), -1.0
    table = term_table({"K_phiphiphi": 0.3, "K_ppp": -0.1, "Y_vvp": 0.2, "N_rrp": -0.2})
    cos, sin = 0.05 * random.uniform(-1, 1, (2, COUNT, 3))
    return acceleration_form(np.eye(3), table, np.geomspace(0.02, 3.0, COUNT), (cos, sin, 0.0), linear=linear)


def of_a_ship():
    """Series 60 with drag by strips in moving water and its own righting curve."""
    ship = qt.ship("series60-cb60")
    wave = np.linspace(0.6, 2.2, COUNT) * ship.hull.length
    heading = 15.0 + 150.0 * np.modf(0.618 * np.arange(COUNT))[0]
    return ship_system(ship, 2 * np.pi / wave, np.full(COUNT, 5.0), heading).at_amplitude(wave[:, None] / 80)


@pytest.fixture(params=[of_cubics, of_a_ship], ids=["cubics", "ship"])
def moving(request):
    system = request.param()
    u, status, _ = harmonic_balance(system, (1, 3))
    assert goes_in_one_pass(system, ACCURACY)
    return rows(system, np.flatnonzero(status <= 1)), u[status <= 1]


def test_multipliers_are_those_of_small_steps(moving):
    """The classical Runge-Kutta method with 6,000 steps of half a cycle, another code of the same equations."""
    system, u = moving
    found = in_one_pass(system, u, (1, 3), ACCURACY).transition
    there = np.isfinite(found).all(axis=(1, 2))
    assert there.mean() > 0.9
    fine = transition_matrices(system, u, (1, 3), 0.5, np.full(system.count, 6000))[there]
    own, right = np.linalg.eigvals(found[there]), np.linalg.eigvals(fine)
    apart = np.abs(own[:, :, None] - right[:, None, :]).min(axis=1).max(axis=1)
    assert (apart / np.maximum(1.0, np.abs(right).max(axis=1))).max() < ACCURACY


def test_harmonics_are_those_found_by_themselves(moving):
    system, u = moving
    np.testing.assert_array_equal(
        in_one_pass(system, u, (1, 3), ACCURACY).phasors, variational_harmonics(system, u, (1, 3))
    )


def test_no_condition_feels_its_neighbours(moving):
    """In another order, and without most of the others, the bytes are the same."""
    system, u = moving
    whole = in_one_pass(system, u, (1, 3), ACCURACY)
    order = np.random.default_rng(1).permutation(system.count)[: system.count // 2]
    part = in_one_pass(rows(system, order), u[order], (1, 3), ACCURACY)
    for one, other in zip(whole, part, strict=True):
        np.testing.assert_array_equal(one[order], other)


def test_a_wave_without_force_moves_nothing():
    """Closed form: without excitation the motion of a damped ship is none, found in the batch beside others that move."""
    system = of_cubics()
    still = system.raised(np.where(np.arange(COUNT) % 3 == 0, 0.0, 1.0))
    u, status, residual = harmonic_balance(still, (1,), from_rest=True)
    assert (status[::3] == 0).all()
    assert (u[::3] == 0.0).all()
    assert (residual[::3] == 0.0).all()
    np.testing.assert_array_equal(u[1::3], harmonic_balance(system, (1,), from_rest=True)[0][1::3])
