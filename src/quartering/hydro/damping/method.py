"""Interface of a roll-damping method: the terms it gives and their provenance."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple

from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.damping.natural_roll import FreeRoll
from quartering.hydro.terms import Kind

LINEAR = "K_p"
MODULUS = "K_p|p|"
AMPLITUDE = 10.0
"""Roll amplitude about which nonlinear damping is fitted, and at which methods are compared [deg]."""


class AddedDamping(NamedTuple):
    """Roll damping to be added to the wave damping of the ship's source of hydrodynamics at rest.

    Parameters
    ----------
    terms : mapping of str to (n,)   coefficients by name: K_p [kg m2/s], K_p|p| [kg m2], ..; mostly <= 0
    equivalent : (n,) float          linear damping of equal dissipation at 10 deg, n2 [kg m2/s]
    """

    terms: Mapping[str, Floats]
    equivalent: Floats


class DampingMethod(NamedTuple):
    """A method of added roll damping.

    Parameters
    ----------
    added : callable             ship, (n,) speeds [m/s], its free roll -> AddedDamping
    kind : str                   of the coefficients, "estimated" for an estimate
    words : callable             ship -> source for the table, "estimated: .." for an estimate
    references : tuple of str    keys of the papers behind it
    lift : bool                  it has the lift of a rolling hull, which takes the place of the regression's in K_p
    """

    added: Callable[[Ship, Floats, FreeRoll], AddedDamping]
    kind: Kind
    words: Callable[[Ship], str]
    references: tuple[str, ...]
    lift: bool
