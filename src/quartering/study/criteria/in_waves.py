"""Metacentric height and righting arm on the crests and troughs of the criteria's waves, each wave balanced once.

Every wave is balanced for one height of G, that of the base ship. Another height moves the arm by

    GZ(KG) = GZ(KG_0) - (KG - KG_0) sin phi ,    GM(KG) = GM(KG_0) - (KG - KG_0) ,

as cross curves of stability do; what is left out is the change of trim by the height of G, of the order (KG - KG_0)/GM_L.
"""

from __future__ import annotations

import warnings
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import RangeWarning
from quartering.hull.ship import Ship
from quartering.loads.waves import Wave
from quartering.study.criteria.particulars import Particulars
from quartering.study.six_modes.gm_in_waves import gm_in_waves, righting_arm

Floats = NDArray[np.float64]

POSITIONS = 10
"""Crest positions along the ship, 0 to 0.9 of its length."""
HEELS = np.arange(0.0, 71.0, 1.0)
"""Heels of the righting arms in waves [deg]."""


def gm_mean(p: Particulars, wave_length: float, height: float) -> float:
    """Mean GM over the crest positions [m]."""
    return float(np.mean(_crests(p.base, wave_length, height))) - p.raised


def gm_variation(p: Particulars, wave_length: float, height: float) -> float:
    """Half the range of GM over the crest positions [m]."""
    return float(np.ptp(_crests(p.base, wave_length, height))) / 2


def gm_least(p: Particulars, wave_length: float, height: float) -> float:
    """Least GM over the crest positions [m]."""
    return float(np.min(_crests(p.base, wave_length, height))) - p.raised


def arms(p: Particulars, wave_length: float, height: float) -> Floats:
    """Righting arms (10, n) [m] over `HEELS`, a row a crest position; NaN where the ship does not balance."""
    return np.asarray(_arms(p.base, wave_length, height) - p.raised * np.sin(np.radians(HEELS)))


@lru_cache(maxsize=512)
def _crests(ship: Ship, wave_length: float, height: float) -> tuple[float, ...]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)  # a deck under water is part of these criteria
        found = gm_in_waves(ship, Wave(wave_length, height), positions=POSITIONS)
    return tuple(float(gm) for gm in found["gm"].values)


@lru_cache(maxsize=128)
def _arms(ship: Ship, wave_length: float, height: float) -> Floats:
    wave = Wave(wave_length, height)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)
        rows = [righting_arm(ship, HEELS, wave, position=k / POSITIONS) for k in range(POSITIONS)]
    return np.array(rows)
