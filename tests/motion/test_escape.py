"""The escape equation: even terms, full harmonics, multipliers, and erosion of the safe basin."""

import csv

import numpy as np
import pytest

from quartering.conventions import InputError
from quartering.motion.equations.model import Model
from quartering.motion.steady.motion import steady_motion
from quartering.motion.transient.basin import basin, capsize_times, safe_shares
from quartering.motion.transient.simulate import simulate
from quartering.stability.verdict import stability
from tests.reference import HERE

ROWS = list(csv.DictReader((HERE / "escape_equation.csv").read_text().splitlines()[3:]))
DAMPING, FREQUENCY = 0.1, 0.85


def escape(force: float) -> Model:
    """Roll row x'' + 0.1 x' + x - x^2 = F sin wt; sway and yaw idle."""
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_p": -DAMPING, "K_phiphi": 1.0}
    return Model(np.eye(3), terms, FREQUENCY, (0, 0, 0), (0, force, 0))


@pytest.mark.parametrize("row", ROWS, ids=lambda r: f"F={r['F']}")
def test_motion_and_multipliers_agree_with_shooting(row):
    """Authority: shooting with relative tolerance 1e-12 (tests/reference/escape_equation.csv)."""
    model = escape(float(row["F"]))
    motion = steady_motion(model, harmonics=15)
    assert motion.orders[:4] == (1, 2, 3, 4)
    assert motion.state(0.0)[1] == pytest.approx(float(row["x0"]), abs=2e-9)
    assert motion.state(0.0)[2] == pytest.approx(float(row["v0"]), abs=2e-9)
    assert abs(motion.mean[1]) == pytest.approx(float(row["A0"]), abs=1e-8)
    amplitudes = np.hypot(motion.cos[:3, 1], motion.sin[:3, 1])
    np.testing.assert_allclose(amplitudes, [float(row[k]) for k in ("A1", "A2", "A3")], atol=1e-8)
    exact = complex(float(row["mu_re"]), float(row["mu_im"]))
    assert np.abs(stability(model, motion).multipliers - exact).min() < 2e-9


def melnikov_force() -> float:
    """Closed form: F_M = beta sinh(pi w)/(5 pi w^2) = 0.06333530 at w = 0.85 (Thompson 1989)."""
    return DAMPING * np.sinh(np.pi * FREQUENCY) / (5 * np.pi * FREQUENCY**2)


@pytest.mark.soak
def test_safe_basin_is_whole_below_the_melnikov_force_and_eroded_above():
    assert melnikov_force() == pytest.approx(0.06333530, abs=1e-8)
    angles, rates = np.meshgrid(np.linspace(-0.7, 1.0, 60), np.linspace(-0.7, 0.7, 50))
    starts = np.zeros((angles.size, 4))
    starts[:, 1], starts[:, 2] = angles.ravel(), rates.ravel()
    forces = np.array([0.0, 0.5, 0.9, 1.2, 1.6]) * melnikov_force()
    share = safe_shares([escape(f) for f in forces], starts, periods=16)
    integrity = share / share[0]
    assert (integrity[1:3] > 0.9).all(), integrity  # a smooth boundary moves, it is not eaten into
    assert integrity[4] < 0.5, integrity
    assert (np.diff(integrity) < 0.02).all(), integrity


def test_fixed_steps_agree_with_the_error_controlled_integration():
    """Order of the fixed-step method: halving the step divides the error by 16."""
    model, start = escape(0.05), [0.0, 0.1, 0.05, 0.0]
    duration = 8 * 2 * np.pi / FREQUENCY
    fine = simulate(model, duration, start, step=duration, tolerance=1e-12)
    exact = np.radians([fine["roll"].values[-1], fine["roll_rate"].values[-1]])
    errors = [np.abs(capsize_times(model, [start], 8, steps=n)[1][0, 1:3] - exact).max() for n in (20, 40, 80)]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4.0, abs=0.3)
    assert np.log2(errors[1] / errors[2]) == pytest.approx(4.0, abs=0.3)


def test_basin_is_labelled_and_bad_starts_are_refused():
    ds = basin(escape(0.0), np.linspace(-30, 60, 10), [0.0, 10.0], periods=4)
    assert ds["capsize_time"].attrs["units"] == "s"
    assert 0.0 < ds.attrs["safe_share"] < 1.0 + 1e-12
    with pytest.raises(InputError, match="four"):
        capsize_times(escape(0.0), [[0.0, 0.1]])
    with pytest.raises(InputError, match="period"):
        capsize_times(escape(0.0), [[0.0, 0.1, 0.0, 0.0]], periods=0)
