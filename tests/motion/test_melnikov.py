"""Erosion of the safe basin against Melnikov's force: where a fractal boundary becomes possible, and not before."""

import csv

import numpy as np
import pytest
from scipy.integrate import quad

from quartering.motion.equations.model import Model
from quartering.motion.transient.basin import safe_shares
from tests.reference import HERE

ROWS = list(csv.DictReader((HERE / "melnikov.csv").read_text().splitlines()[3:]))


def model(row, force):
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_p": -float(row["c"])}
    terms |= {"K_phiphi" if row["equation"] == "escape" else "K_phiphiphi": 1.0}
    return Model(np.eye(3), terms, float(row["w"]), (0, force, 0), (0, 0, 0))


def rate_on_the_separatrix(equation, t):
    """dx/dt on the undamped, unforced orbit that leaves a saddle and comes back, or goes to the other one."""
    if equation == "escape":  # x = 1 - 3/2 sech^2(t/2)
        return 1.5 * np.tanh(t / 2) / np.cosh(t / 2) ** 2
    return 1.0 / np.cosh(t / np.sqrt(2)) ** 2 / np.sqrt(2)  # x = tanh(t/sqrt 2)


@pytest.mark.parametrize("row", ROWS, ids=lambda r: f"{r['equation']}-{r['c']}-{r['w']}")
def test_melnikovs_integral_gives_the_published_force(row):
    """The distance of the two invariant curves, c int x'^2 - F int x' cos or sin(w t), first touches zero."""
    c, w = float(row["c"]), float(row["w"])
    wave = np.sin if row["equation"] == "escape" else np.cos  # the part of the integral that does not cancel
    damping = 2 * quad(lambda t: rate_on_the_separatrix(row["equation"], t) ** 2, 0, 60)[0]
    forcing = 2 * quad(lambda t: rate_on_the_separatrix(row["equation"], t) * wave(w * t), 0, 60, limit=200)[0]
    assert c * damping / forcing == pytest.approx(float(row["F"]), abs=2e-8)


@pytest.mark.parametrize("row", [ROWS[1], ROWS[2], ROWS[8]], ids=lambda r: f"{r['equation']}-{r['w']}")
def test_the_basin_is_whole_below_the_force_and_loses_half_between_it_and_twice_it(row):
    """Source: Thompson (1989): the boundary turns fractal at Melnikov's force, the area falls off a cliff a little above.

    Frequencies where escape is easiest, a little below the natural one; at w = 1 the cliff stands further off.
    """
    angles, rates = np.meshgrid(np.linspace(-1.0, 1.0, 45), np.linspace(-0.7, 0.7, 35))
    starts = np.zeros((angles.size, 4))
    starts[:, 1], starts[:, 2] = angles.ravel(), rates.ravel()
    forces = float(row["F"]) * np.array([0.0, 0.5, 0.9, 2.0])
    share = safe_shares([model(row, force) for force in forces], starts, periods=16, limit=1.5)
    integrity = share / share[0]
    assert (integrity[1:3] > 0.9).all(), integrity
    assert integrity[3] < 0.5, integrity
