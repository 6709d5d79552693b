"""What a claim of the paper is here, and the conditions it is measured in."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, Literal, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from quartering.hull.file.read import ship
from quartering.hull.ship import Ship
from quartering.study.maps.sweep import sweep
from quartering.study.paper.conditions import speed_of, wave_of
from quartering.study.paper.model import PAPER_SHIP, paper_ship

Answer = Literal["holds", "holds in part", "does not hold"]
HEADINGS: Final = np.arange(5.0, 176.0, 5.0)
MODERATE, STEEP, VERY_STEEP = 50, 30, 20
"""Wave length over wave height."""


class Ships(NamedTuple):
    """Built-in ships with one set of equations.

    Parameters
    ----------
    words : str                what it is called on the page
    named : function          a ship by its name
    with_cubics : function    the same for claims that name or change coefficients of the cubic drag
    """

    words: str
    named: Callable[[str], Ship]
    with_cubics: Callable[[str], Ship]

    def one(self, name: str = PAPER_SHIP) -> Ship:
        """A built-in ship."""
        return self.named(name)

    def cubic(self, name: str = PAPER_SHIP) -> Ship:
        """A built-in ship whose drag is in powers of velocities."""
        return self.with_cubics(name)


OVER_GROUND: Final = Ships("over ground, as the paper", paper_ship, paper_ship)
THROUGH_WATER: Final = Ships("through the water", ship, lambda name: ship(name).with_(drag="cubic"))


class Finding(NamedTuple):
    """What was measured.

    Parameters
    ----------
    answer : str      "holds", "holds in part" or "does not hold"
    evidence : str    by how much, in words with numbers
    """

    answer: Answer
    evidence: str


class Claim(NamedTuple):
    """One statement of the paper.

    Parameters
    ----------
    text : str           the statement, in our words
    where : str          in the paper
    measure : function   computes the evidence for one set of equations
    moving : bool        whether what it says may be another thing through the water
    """

    text: str
    where: str
    measure: Callable[[Ships], Finding]
    moving: bool = True


def graded(holds: bool, in_part: bool, evidence: str) -> Finding:
    """A finding from what was found to be so.

    holds: the claim as a whole
    in_part: some of it

    >>> graded(False, True, "in 3 of 5").answer
    'holds in part'
    """
    return Finding("holds" if holds else "holds in part" if in_part else "does not hold", evidence)


def over_headings(
    one: Ship, steepness: int, ratio: float = 1.0, harmonics: int = 3, headings: ArrayLike = HEADINGS
) -> xr.Dataset:
    """Response and stability over all headings, at Froude number 0.25.

    steepness: wave length over wave height
    ratio: wave length over ship length
    harmonics: of the steady motion
    headings (h,): [deg]
    Returns over ``heading``

    >>> from quartering.study.paper.model import paper_ship
    >>> over_headings(paper_ship("wigley"), 50)["roll"].dims
    ('heading',)
    """
    wave = wave_of(one, ratio, 1 / steepness)
    ds = sweep(one, speed_of(one), headings, wave.length, wave.height, harmonics=harmonics)
    return ds.isel(speed=0, wave_length=0, wave_height=0)
