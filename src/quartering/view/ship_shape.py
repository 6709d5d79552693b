"""The shape of a ship for pictures: sections seen from aft, outlines seen from above, and its surface; about G, z up."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from quartering.hull.lines.contour import along, contour_curve
from quartering.hull.lines.immersed import strips
from quartering.hull.ship import Ship

Floats = NDArray[np.float64]
_AROUND, _MOST_STATIONS, _FEW = 40, 41, 9
"""Points round a section, stations of the surface, sections of the view from aft."""


@dataclass(frozen=True, eq=False)
class Shape:
    """A ship for pictures, about G: x forward from midship, y to starboard, z up [m].

    Parameters
    ----------
    surface : (s, n, 3) float    starboard side, station by station, keel to deck
    waterline, deck : (m, 2)     closed outlines seen from above
    sections : tuple of (k, 2)   both sides of some sections seen from aft (y, z), the widest first
    water : float                height of the calm water over G [m]
    """

    surface: Floats
    waterline: Floats
    deck: Floats
    sections: tuple[Floats, ...]
    water: float

    @property
    def length(self) -> float:
        """Length of the surface [m]."""
        return float(np.ptp(self.surface[..., 0]))


def shape_of(ship: Ship) -> Shape:
    """The shape of a ship as it floats."""
    hull, kg = ship.hull, ship.loading.kg
    step = -(-len(hull.x) // _MOST_STATIONS)
    taken = sorted({*range(0, len(hull.x), step), len(hull.x) - 1})
    rows = []
    for i in taken:
        half, over_keel = hull.contours[i]
        curve = contour_curve(half, over_keel, hull.outline)
        y, height, *_ = along(curve, np.linspace(curve.chord[0], curve.chord[-1], _AROUND))
        rows.append(np.stack([np.full(_AROUND, hull.x[i]), y, height - kg], axis=1))
    surface = np.array(rows)
    immersed = strips(hull)
    middle = int(np.argmax(surface[:, :, 1].max(axis=1)))
    some = [middle, *np.unique(np.linspace(0, len(rows) - 1, _FEW).round().astype(int)).tolist()]
    both = tuple(_both_sides(surface[i, :, 1:]) for i in some)
    return Shape(
        surface,
        _outline(immersed.x, immersed.half_breadth, (hull.x_aft, hull.x_fore)),
        _outline(surface[:, 0, 0], surface[:, -1, 1], (hull.x_aft, hull.x_fore)),
        both,
        hull.draught - kg,
    )


def _both_sides(section: Floats) -> Floats:
    """A starboard half section (n, 2) carried on to port."""
    return np.concatenate([section[::-1], section * [-1.0, 1.0]])


def _outline(x: Floats, half: Floats, ends: tuple[float, float]) -> Floats:
    """Closed outline of half breadths along the ship; it closes straight at the ends."""
    along_ship = np.concatenate([[min(ends[0], x[0])], x, [max(ends[1], x[-1])]])
    wide = np.concatenate([[half[0] if half[0] > 0.2 * half.max() else 0.0], half, [0.0]])
    starboard = np.stack([along_ship, wide], axis=1)
    return np.concatenate([starboard, (starboard * [1.0, -1.0])[::-1]])
