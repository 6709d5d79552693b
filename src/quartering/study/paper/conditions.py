"""The conditions the paper's figures are recomputed in: speed, waves, headings, loadings.

They are ours: the speed, the waves and the loading of the paper's models are not known here, so the curves can be compared in
shape and in kind, not number by number.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from quartering.hull.ship import Ship
from quartering.loads.waves import Wave
from quartering.units import quantity

FROUDE: Final = 0.25
MARINER_FROUDE: Final = 0.20
"""Near the 15 knots at which the Mariner's set was measured."""

HEADINGS: Final = np.arange(0.0, 181.0, 1.0)
FINE_HEADINGS: Final = np.arange(1801) / 10
"""For exponents: next to resonance the largest one rises and falls within 2 deg."""

RATIOS: Final = (0.75, 1.0, 1.5)
"""Wave lengths over the ship's."""

STEEPNESS: Final = 1 / 50
"""Wave height over wave length of the response curves."""

INSTABILITY_HEADING: Final = 15.0
"""Heading of the paper's unstable case [deg]."""

INSTABILITY_RATIO: Final = 1.5
INSTABILITY_STEEPNESS: Final = 1 / 20


def speed_of(ship: Ship, froude: float = FROUDE) -> float:
    """Speed of a ship at a Froude number.

    Returns [m/s]
    """
    return quantity(f"{froude!r} Fn", "speed", length=ship.hull.length)


def wave_of(ship: Ship, ratio: float, steepness: float = STEEPNESS) -> Wave:
    """Wave of a length given in ship lengths.

    ratio: wave length over ship length
    steepness: wave height over wave length
    """
    length = ratio * ship.hull.length
    return Wave(length, steepness * length)
