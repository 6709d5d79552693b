"""Equations of one ship in many loadings: wave forces computed once, transferred to each centre of gravity."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import GRAVITY
from quartering.hull.ship import Ship
from quartering.loads.forces import Form, keeps_speed_terms
from quartering.loads.validity import conditions_held
from quartering.loads.waves import encounter_frequency
from quartering.motion.equations.batch import joined, rows
from quartering.motion.equations.system import PER_CONDITION
from quartering.motion.of_ship import ShipSystem, excitation, ship_system

Floats = NDArray[np.float64]
Phasors = NDArray[np.complex128]
Bools = NDArray[np.bool_]


Found = dict[tuple[object, ...], tuple[Phasors, Floats, Bools]]
"""Wave forces of some conditions, by the hull in the water and what else they follow from."""


def systems(
    ships: Sequence[Ship],
    wavenumber: Floats,
    speed: Floats,
    heading: Floats,
    form: Form = "stf",
    *,
    known: Found | None = None,
) -> Iterator[ShipSystem]:
    """Equations per metre of wave amplitude, as `ship_system` gives them, for each loading in turn.

    ships: the same ship in its loadings
    wavenumber (m,): k > 0 [1/m]
    speed, heading (m,): [m/s, deg]
    form: of the diffraction force
    known: forces found by earlier calls for the same conditions, to which those of this one are added
    Yields of each ship, NaN where its own database does not hold the condition; forces are found again only where the
        hull in the water, its density, its speed terms or (for a form other than "stf") the height of G changes

    G moves up and down over one point of the waterplane, so sway and yaw stay and K_G' = K_G - (z0' - z0) Y, exactly.
    Source: [STF70] forces about the waterline, moved rigidly.
    """
    known = {} if known is None else known
    for ship in ships:
        moves = form == "stf"
        kg = None if moves else ship.loading.kg
        key = (id(ship.hull), ship.loading.density, keeps_speed_terms(ship), kg)
        if key not in known:
            known[key] = _held_excitation(_at_the_surface(ship) if moves else ship, wavenumber, speed, heading, form)
        force, omega, held = known[key]
        if moves:
            force = _moved(force, ship.loading.kg - ship.hull.draught)
        # Conditions outside the database are evaluated at zero frequency as a placeholder and flagged OUTSIDE_DATABASE.
        stand_in = (force, np.where(held, omega, 0.0))
        at = ship_system(ship, wavenumber, speed, heading, form, known=stand_in)
        yield at if held.all() else replace(at, encounter_frequency=omega, slow=at.slow & held, outside=~held)


@lru_cache(maxsize=64)
def _at_the_surface(ship: Ship) -> Ship:
    """The ship with G in the calm surface: forces are found there, whichever loadings a block holds, and moved from there."""
    return replace(ship, loading=replace(ship.loading, kg=ship.hull.draught))


def _held_excitation(
    ship: Ship, wavenumber: Floats, speed: Floats, heading: Floats, form: Form
) -> tuple[Phasors, Floats, Bools]:
    """Force per metre of amplitude, NaN where the ship's own database does not hold it; encounter frequency; is it held?"""
    held = conditions_held(ship, wavenumber, speed, heading, form)
    omega = encounter_frequency(np.sqrt(GRAVITY * wavenumber), speed, heading)
    force = np.full((omega.size, 3), np.nan + 0j)
    if held.any():
        force[held] = excitation(ship, wavenumber[held], speed[held], heading[held], form)[0]
    return force, omega, held


def _moved(force: Phasors, up: float) -> Phasors:
    """Force about a point `up` metres above the one it is given about."""
    moved = force.copy()
    moved[:, 1] -= up * force[:, 0]
    return moved


def in_batches(found: Iterable[ShipSystem], most: int) -> Iterator[tuple[slice, ShipSystem]]:
    """The equations of loadings, of as many together as stay within a number of conditions.

    found: of each loading in turn
    most: conditions of a batch of several loadings
    Yields (which loadings, their equations one after another): alone where the products are not the same, or where the cubic
        drag is matched, so that no condition's sums are taken in another order for its neighbours' sake

    >>> from quartering.hull.file.read import ship
    >>> three = [ship("wigley").with_(gm=gm) for gm in (0.8, 0.9, 1.0)]
    >>> one = (np.full(2, 0.05), np.array([5.0, 6.0]), np.full(2, 30.0))
    >>> [(some.start, some.stop, at.system.count) for some, at in in_batches(systems(three, *one), 4)]
    [(0, 2, 4), (2, 3, 2)]
    """
    first, waiting = 0, list[ShipSystem]()
    for at in found:
        count = sum(one.system.count for one in waiting)
        if waiting and (count + at.system.count > most or not _alike(waiting[0], at)):
            yield slice(first, first + len(waiting)), _one_batch(waiting)
            first, waiting = first + len(waiting), []
        waiting.append(at)
    if waiting:
        yield slice(first, first + len(waiting)), _one_batch(waiting)


def _alike(one: ShipSystem, other: ShipSystem) -> bool:
    """Have the equations of two loadings the same products, tables of as many pieces, as many strips, and no match?"""
    if one.matching is not None or other.matching is not None:
        return False
    a, b = one.system, other.system
    same = all(np.array_equal(getattr(a, name), getattr(b, name)) for name in ("powers", "modulus", "extra"))
    shapes = all(getattr(a, name).shape[1:] == getattr(b, name).shape[1:] for name in PER_CONDITION)
    return same and shapes and a.layout == b.layout


def _one_batch(found: Sequence[ShipSystem]) -> ShipSystem:
    """The equations of several loadings as one batch, with the first one's coefficients."""
    if len(found) == 1:
        return found[0]
    return replace(
        found[0],
        system=joined([one.system for one in found]),
        encounter_frequency=np.concatenate([one.encounter_frequency for one in found]),
        slow=np.concatenate([one.slow for one in found]),
        outside=np.concatenate([one.outside for one in found]),
    )


def part_of(equations: ShipSystem, part: slice) -> ShipSystem:
    """The equations of some of the conditions.

    equations: m conditions
    part: of them
    Returns with the whole batch's coefficients

    >>> from quartering.hull.file.read import ship
    >>> two = next(systems([ship("wigley")], np.full(2, 0.05), np.array([5.0, 6.0]), np.full(2, 30.0)))
    >>> part_of(two, slice(1, 2)).system.count
    1
    """
    return replace(
        equations,
        system=rows(equations.system, part),
        encounter_frequency=equations.encounter_frequency[part],
        slow=equations.slow[part],
        outside=equations.outside[part],
        matching=None if equations.matching is None else equations.matching.part(part),
    )
