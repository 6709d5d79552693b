"""The long steps a map takes in place of Runge-Kutta's: their error measured, not believed."""

import numpy as np
import pytest

import quartering as qt
from quartering.motion.of_ship import ship_system
from quartering.motion.steady.motion import steady_motions
from quartering.stability.assessment import assess
from quartering.stability.variational.magnus import STEPS, magnus_steps, magnus_transition
from quartering.study.conditions import ACCURACY


def _motions(name, damping, harmonics=1, gm=None):
    smooth = {"roll_damping": damping, "drag": "cubic", "righting": "polynomial"}  # a table: `test_floquet_of_splines`
    ship = qt.ship(name).with_(**smooth) if gm is None else qt.ship(name).with_(**smooth, gm=gm)
    length = ship.hull.length
    u, mu, wave = (
        a.ravel()
        for a in np.meshgrid(
            [0.0, 4.0, 9.0], np.arange(5.0, 180.0, 25.0), length * np.linspace(0.4, 2.3, 8), indexing="ij"
        )
    )
    heights = np.broadcast_to(np.linspace(0.4, 4.0, 3), (u.size, 3))
    system = ship_system(ship, 2 * np.pi / wave, u, mu).at_amplitude(0.5 * heights)
    return system, *steady_motions(system, harmonics, start="rest")


@pytest.mark.parametrize(
    ("name", "damping", "gm"),
    [("series60-cb60", 0.01, 0.5), ("series60-cb60", 0.05, 1.6), ("s175", 0.02, None), ("box", 0.03, None)],
)
def test_multipliers_of_a_map_keep_its_accuracy(name, damping, gm):
    """Agreement with fourth-order Runge-Kutta at 1e-9 on the same motions; relative to the larger of 1 and the multiplier."""
    system, u, orders, status, _ = _motions(name, damping, gm=gm)
    sane = (status < 2) & (np.abs(np.nan_to_num(u[:, 1])).max(axis=1) < 1.2)
    u = np.where(sane[:, None, None], u, np.nan)
    quick, slow = assess(system, u, orders, ACCURACY, detail="map"), assess(system, u, orders, 1e-9)
    fast, exact = (np.sort(np.abs(r.floquet.multipliers), axis=1)[sane] for r in (quick, slow))
    error = (np.abs(fast - exact) / np.maximum(1.0, exact)).max(axis=1)
    assert error.max() < ACCURACY
    assert np.median(error) < 1e-7
    near = np.abs(exact[:, -1] - 1.0) < 2 * ACCURACY
    assert (quick.kind[sane] == slow.kind[sane])[~near].all()


def test_what_a_map_leaves_out_is_nan_and_the_rest_the_same():
    system, u, orders, *_ = _motions("series60-cb60", 0.05)
    brief, full = assess(system, u, orders, detail="map"), assess(system, u, orders)
    assert np.isnan(brief.first_order.mean_jacobian).all()
    found = np.isfinite(u).all(axis=(1, 2))
    np.testing.assert_allclose(
        np.sort_complex(brief.first_order.averaged[found]), np.sort_complex(full.first_order.averaged[found]), atol=1e-9
    )
    for name in ("n2", "k2", "k2_rho", "q", "slow", "combination"):
        np.testing.assert_array_equal(getattr(brief.first_order, name), getattr(full.first_order, name), err_msg=name)
    unstable = full.floquet.growth > 0
    np.testing.assert_allclose(brief.floquet.share[unstable], full.floquet.share[unstable], atol=1e-5)
    np.testing.assert_array_equal(brief.calm, full.calm)


def test_error_of_the_long_steps_falls_with_their_sixth_power():
    """Order of convergence: Mathieu's equation with damping against 64 steps."""
    phase = np.pi * np.arange(17) / 17
    along = np.zeros((1, 17, 3, 4))
    along[0, :, 0, 0], along[0, :, 2, 3] = -0.4, -0.3
    along[0, :, 1, 1], along[0, :, 1, 2] = -1.0 + 0.5 * np.cos(2 * phase), -0.1
    along[0, :, 1, 0], along[0, :, 0, 1] = 0.2 * np.sin(2 * phase), 0.1
    cycle, one = np.array([np.pi]), np.ones(1)
    fine = magnus_transition(along, cycle, np.array([64]), one)
    steps = np.array([6, 8, 12, 16])
    error = [np.abs(magnus_transition(along, cycle, np.array([n]), one) - fine).max() for n in steps]
    slope = np.polyfit(np.log(steps), np.log(error), 1)[0]
    assert -6.6 < slope < -5.4


def test_a_constant_matrix_needs_no_small_steps():
    """Closed form: exp of a diagonal decay and of free roll."""
    along = np.zeros((1, 5, 3, 4))
    along[0, :, 0, 0], along[0, :, 1, 1], along[0, :, 2, 3] = -1.0, -4.0, -0.5
    phi = magnus_transition(along, np.array([3.0]), np.array([4]), np.array([2.0]))[0]
    assert phi[0, 0] == pytest.approx(np.exp(-3.0), rel=1e-8)
    assert phi[1, 1] == pytest.approx(np.cos(6.0), abs=1e-7)
    assert phi[3, 3] == pytest.approx(np.exp(-1.5), rel=1e-8)


def test_violent_modulation_is_left_to_small_steps():
    wild = np.zeros((2, 2, 3, 4), complex)
    wild[:, 0, 1, 1], wild[:, 1, 1, 1] = -1.0, 1e14
    wild[1, 1, 1, 1] = np.nan
    assert magnus_steps(np.ones(2), wild, np.full(2, 100.0), 0.5, 5e-6)[0].tolist() == [0, 0]
    assert magnus_steps(np.ones(1), wild[:1] * 0, np.ones(1), 0.5, 5e-6)[0].tolist() == [STEPS[0]]
