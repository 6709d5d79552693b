"""Plausibility checks of offsets: sizes, decks, block and waterplane coefficients."""

from __future__ import annotations

import warnings
from typing import Final

import numpy as np

from quartering.conventions import InputError, RangeWarning
from quartering.hull.lines.section import Floats
from quartering.options import OPTIONS

WIDEST: Final = 1.25
"""Largest half breadth under water, of half the beam."""
FLARE: Final = 3.0
"""Largest half breadth over water, of half the beam."""
HIGHEST: Final = 5.0
"""Highest top of a station, of the median over the ship."""
BLOCK: Final = (0.05, 1.02)
"""Block coefficient of what can be a ship; below `FINE` it is told."""
FINE: Final = 0.2
PLANE: Final = (0.15, 1.05)
"""The same for the waterplane coefficient."""

FLAT: Final = 25.0
"""Beam over draught from which on the draught is doubted: a light inland barge has some 20."""
SLENDER: Final = (1.0, 20.0)
"""Length over beam outside which they are doubted."""
EXTENT: Final = (0.93, 1.1)
"""What the stations reach over, of the length, outside which it is told: lines of ten spacings without an end have 0.9."""

Contours = tuple[tuple[Floats, Floats], ...]


def check_proportions(name: str, length: float, beam: float, draught: float) -> None:
    """Tell proportions that are hardly those of a ship, as a unit of one dimension makes them.

    >>> with warnings.catch_warnings(record=True) as said:
    ...     warnings.simplefilter("always")
    ...     check_proportions("my.yaml", 80.0, 12.0, 0.03)
    >>> str(said[0].message)
    'my.yaml: beam 12 m is 400 times the draught of 0.03 m; is the unit of both right?'
    """
    if beam > FLAT * draught:
        words = f"beam {beam:g} m is {beam / draught:.3g} times the draught of {draught:g} m"
    elif not SLENDER[0] <= length / beam <= SLENDER[1]:
        words = f"length {length:g} m is {length / beam:.3g} times the beam of {beam:g} m"
    else:
        return
    warnings.warn(f"{name}: {words}; is the unit of both right?", RangeWarning, stacklevel=2)


def check_extent(name: str, length: float, x: Floats) -> None:
    """Refuse stations of another length than the ship's; tell those that leave a part of it out, or reach past it.

    >>> check_extent("my.csv", 80.0, np.array([-40e3, 40e3]))
    Traceback (most recent call last):
    ...
    quartering.conventions.InputError: my.csv: the stations reach over 80000 m, the length is 80 m; the two agree within a ...
    """
    extent = float(x[-1] - x[0])
    if not 0.8 * length <= extent <= 1.25 * length:
        raise InputError(
            f"{name}: the stations reach over {extent:g} m, the length is {length:g} m; the two agree within a fifth; "
            "check the unit of x (a file that says none: `lines: {file: .., unit: mm}`), and that it is from midship, + forward"
        )
    if not EXTENT[0] * length <= extent <= EXTENT[1] * length:
        warnings.warn(
            f"{name}: the stations reach over {extent:g} m, from {x[0]:g} to {x[-1]:g} m, the length is {length:g} m; the hull "
            "is what they reach over; is a station missing, or the length another one?",
            RangeWarning,
            stacklevel=2,
        )


def check_breadths(name: str, beam: float, draught: float, contours: Contours, labels: list[str]) -> None:
    """Refuse a half breadth far beyond half the beam, named by station and waterline.

    >>> bad = np.array([0.0, 5000.0, 5.0, 5.0]), np.array([0.0, 0.0, 1.0, 6.0])
    >>> check_breadths("my.csv", 10.0, 4.0, (bad,), ["station 1"])
    Traceback (most recent call last):
    ...
    quartering.conventions.InputError: my.csv: station 1, waterline 2 (height 0 m): half breadth 5000 m; half the beam is 5 ...
    """
    for label, (y, height) in zip(labels, contours, strict=True):
        limit = np.where(np.asarray(height) <= draught, WIDEST, FLARE) * beam / 2
        if (np.asarray(y) > limit).any():
            at = int(np.argmax(np.asarray(y) / limit))
            raise InputError(
                f"{name}: {label}, waterline {at + 1} (height {height[at]:g} m): half breadth {y[at]:g} m; half the beam is "
                f"{beam / 2:g} m, and no half breadth is more than {limit[at] / beam * 2:g} times that here; correct it, or "
                "the beam"
            )


def check_decks(name: str, length: float, draught: float, contours: Contours, labels: list[str]) -> None:
    """Refuse a deck no ship has, named by station."""
    tops = np.array([float(height[-1]) for _, height in contours])
    usual = max(float(np.median(tops)), draught)
    high = min(float(OPTIONS["depth"].high or np.inf), length)
    for label, top in zip(labels, tops, strict=True):
        if top > min(high, HIGHEST * usual):
            raise InputError(
                f"{name}: {label} ends at height {top:g} m; the other stations end at {usual:.4g} m, and a deck lies at most "
                f"{min(high, HIGHEST * usual):.4g} m over the baseline; correct the height of its last point, or its unit"
            )


def check_coefficients(
    name: str, length: float, beam: float, draught: float, x: Floats, weight: Floats, contours: Contours
) -> None:
    """Refuse block and waterplane coefficients no ship has, and tell a very fine block.

    name: file named in messages
    length, beam, draught: [m]
    x, weight (s,): stations and their weights [m]
    contours: heights over the baseline [m]

    >>> side = np.array([0.0, 5.0, 5.0]), np.array([3.9, 3.9, 6.0])
    >>> check_coefficients("my.csv", 60.0, 10.0, 4.0, np.array([-30.0, 30]), np.array([30.0, 30]), (side, side))
    Traceback (most recent call last):
    ...
    quartering.conventions.InputError: my.csv: the volume is 60 m3, a block coefficient of 0.025 on length 60 m, beam 10 ...
    """
    volume = float(weight @ [_area(y, h, draught) for y, h in contours])
    plane = float(weight @ [2 * waterline_breadth(y, h, draught) for y, h in contours])
    block, fullness = volume / (length * beam * draught), plane / (length * beam)
    extent = f"; the stations reach over {x[-1] - x[0]:g} m" if abs(x[-1] - x[0] - length) > 0.01 * length else ""
    if not BLOCK[0] <= block <= BLOCK[1]:
        raise InputError(
            f"{name}: the volume is {volume:.4g} m3, a block coefficient of {block:.4g} on length {length:g} m, beam {beam:g} "
            f"m and draught {draught:g} m{extent}; a ship has from {BLOCK[0]:g} to 1; check these three, the unit of the "
            "lines, and where their heights count from (`datum:`)"
        )
    if not PLANE[0] <= fullness <= PLANE[1]:
        raise InputError(
            f"{name}: the waterplane is {plane:.4g} m2, a coefficient of {fullness:.4g} on length {length:g} m and beam "
            f"{beam:g} m{extent}; a ship has from {PLANE[0]:g} to 1; check these and the draught of {draught:g} m"
        )
    if block < FINE:
        warnings.warn(
            f"{name}: the block coefficient is {block:.3g}; are draught ({draught:g} m), beam ({beam:g} m) and datum those of "
            "the lines?",
            RangeWarning,
            stacklevel=2,
        )


def _area(y: Floats, height: Floats, draught: float) -> float:
    """Area under water of both sides, points joined straight."""
    y, height = np.asarray(y, dtype=float), np.asarray(height, dtype=float)
    if height[0] >= draught:
        return 0.0
    under = np.minimum(height, draught)
    share = np.divide(np.diff(under), np.diff(height), out=np.zeros(len(y) - 1), where=np.diff(height) > 0)
    end = y[:-1] + share * np.diff(y)
    return float(((y[:-1] + end) * np.diff(under)).sum())


def waterline_breadth(y: Floats, height: Floats, draught: float) -> float:
    """Half breadth at the calm plane, points joined straight; 0 where the contour ends below it.

    >>> waterline_breadth(np.array([0.0, 5.0, 5.0]), np.array([0.0, 0.0, 6.0]), 4.0)
    5.0
    """
    last = int(np.searchsorted(height, draught))
    if last == 0 or last == len(height):
        return 0.0
    share = (draught - height[last - 1]) / (height[last] - height[last - 1])
    return float(y[last - 1] + share * (y[last] - y[last - 1]))
