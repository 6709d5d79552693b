"""Harmonics that do not suffice are noticed and followed up, against integration in time."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import quartering as qt

HARD = {"Y_v": -1.0, "N_r": -1.0, "K_p": -0.2, "K_phi": -1.0, "K_phiphiphi": -400.0}
"""A stiffening spring, driven slowly: the restoring moment has the third harmonic nearly as large as the first."""
WAVE = 0.3


def integrated(terms, w, force):
    """Largest roll of the settled motion, by an integrator of scipy's."""

    def rate(t, y):
        return [
            y[1],
            terms["K_p"] * y[1] + terms["K_phi"] * y[0] + terms["K_phiphiphi"] * y[0] ** 3 + force * np.cos(w * t),
        ]

    period = 2 * np.pi / w
    found = solve_ivp(rate, (0, 30 * period), [0, 0], rtol=1e-9, atol=1e-11, dense_output=True)
    return np.abs(found.sol(np.linspace(29 * period, 30 * period, 2000))[0]).max()


def test_a_motion_with_too_few_harmonics_gets_more_and_says_so():
    model = qt.Model(np.eye(3), HARD, WAVE, force_cos=(0, 0.4, 0), force_sin=(0, 0, 0))
    with pytest.warns(qt.RangeWarning, match=r"3 harmonics do not suffice.*it has \d+ now"):
        motion = qt.steady_motion(model, 3)
    assert max(motion.orders) > 3
    assert motion.missed < 0.01
    exact = integrated(HARD, WAVE, 0.4)
    kept = qt.steady_motion(model, 3, fixed=True)
    assert max(kept.orders) == 3
    assert np.isnan(kept.missed)
    assert abs(kept.peak[1] / exact - 1) > 0.02  # what was missed
    assert motion.peak[1] == pytest.approx(exact, rel=0.01)


def test_a_mild_motion_keeps_its_harmonics_and_tells_what_it_misses():
    terms = HARD | {"K_phiphiphi": -0.2}
    model = qt.Model(np.eye(3), terms, 0.8, force_cos=(0, 0.02, 0), force_sin=(0, 0, 0))
    motion = qt.steady_motion(model, 3)
    assert motion.orders == (1, 3)
    assert 0.0 < motion.missed < 1e-4
    assert motion.peak[1] == pytest.approx(integrated(terms, 0.8, 0.02), rel=1e-4)
