"""Three-dimensional panels (Capytaine) at zero speed as a source of hydrodynamics.

A hull is solved once, about midship at the calm plane and in sea water: loading, G and water density then only move and scale
what is there, as they do with a database. The solution is kept on disk, since it takes half a minute.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache, partial
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.cache import cached
from quartering._machine.digest import fingerprint, source_digest
from quartering.conventions import GRAVITY, WATER_DENSITY
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.bulb import bulb
from quartering.hull.lines.hull import Hull
from quartering.hull.lines.mesh import Panels, hull_panels
from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.source.capytaine_run import PANELS, hull_solution, shortest_wave
from quartering.hydro.source.interpolated import Surfaces, force_surfaces, tabled_moments
from quartering.hydro.source.record import AtRest, Held, Hydrodynamics
from quartering.hydro.strip.moments import HullMoments, Moments

FREQUENCIES: Final = tuple(np.linspace(0.2, 1.6, 29).round(9).tolist())
"""w sqrt(B/2g) solved for, besides 0: waves of 78 B to 1.2 B; those the panels do not resolve are left out [1]."""
HEADINGS: Final = tuple(np.arange(0.0, 181.0, 10.0).tolist())
"""Headings solved for [deg]."""
WORDS: Final = "panels (Capytaine)"


class Mesh(NamedTuple):
    """What is solved for: hashable, so that it is solved once for a hull.

    Parameters
    ----------
    frequencies : tuple of float    w sqrt(B/2g), ascending, above 0 [1]
    headings : tuple of float       0 to 180, ascending [deg]
    panels : (int, int)             along the ship and from keel to waterline, on each side
    """

    frequencies: tuple[float, ...]
    headings: tuple[float, ...]
    panels: tuple[int, int]


def panel_source(
    ship: Ship,
    frequencies: tuple[float, ...] = FREQUENCIES,
    headings: tuple[float, ...] = HEADINGS,
    panels: tuple[int, int] = PANELS,
) -> Hydrodynamics:
    """Hydrodynamics of a ship by three-dimensional panels, solved when first asked for.

    frequencies: w sqrt(B/2g), ascending, at least four [1]
    headings: 0 to 180, ascending, at least four [deg]
    panels (int, int): along the ship and from keel to waterline, on each side
    Returns at zero speed, between those frequencies and headings, added mass and damping from 0; forces in sway, roll,
        yaw

    Heave, pitch and surge are not solved for yet: `force_modes` says what is held.
    Source: [Ancellin19], linear potential flow.  Valid: as `bem_forces`.
    """
    hull, ratio, mesh = ship.hull, ship.loading.density / WATER_DENSITY, Mesh(frequencies, headings, panels)
    centre = hydrostatics(ship).lcb, ship.loading.kg - hull.draught
    omega = _frequencies(hull, mesh)
    words = f"{WORDS} {bulb(hull).words}".rstrip()

    def solved(frequency: Floats) -> Moments:
        return _moments(hull, mesh, ratio).at(frequency).about(*centre)

    return Hydrodynamics(
        ship=ship,
        kind="database",
        words=words,
        method=f"Capytaine, {panels[0]} x {panels[1]} panels a side, zero speed; speed terms of strip theory without those of "
        "the aft end",
        references=("Ancellin19",),
        force_words=f"{words}, zero speed, with speed terms of strip theory",
        force_references=("STF70", "Ancellin19"),
        centre=centre,
        radiation=partial(_moments, hull, mesh, ratio),
        solved=solved,
        held=Held((float(omega[0]), float(omega[-1])), True, (headings[0], headings[-1])),
        at_rest=partial(_at_rest, hull, mesh, ratio),
    )


@lru_cache(maxsize=8)
def _half(hull: Hull, panels: tuple[int, int]) -> Panels:
    return hull_panels(hull, *panels)


def _frequencies(hull: Hull, mesh: Mesh) -> Floats:
    """Frequencies of the waves, as far as the panels resolve them [rad/s]."""
    omega = np.array(mesh.frequencies) * np.sqrt(2 * GRAVITY / hull.beam)
    highest = np.sqrt(2 * np.pi * GRAVITY / shortest_wave(_half(hull, mesh.panels)))
    return np.asarray(omega[omega <= highest])


@lru_cache(maxsize=8)
def _solution(hull: Hull, mesh: Mesh) -> Mapping[str, NDArray[Any]]:
    """Arrays of `hull_solution` in sea water, zero frequency first; from disk where the hull was solved before."""
    half, omega = _half(hull, mesh.panels), np.append(0.0, _frequencies(hull, mesh))
    content = (half.vertices, half.quads, omega, mesh.headings)
    name = f"panels-{fingerprint([source_digest('hull', 'hydro'), *content])}"
    return cached(name, lambda: hull_solution(hull, half, omega, np.array(mesh.headings), WATER_DENSITY))


@lru_cache(maxsize=8)
def _moments(hull: Hull, mesh: Mesh, ratio: float) -> HullMoments:
    found = _solution(hull, mesh)
    a, b = ratio * found["added_mass"], ratio * found["damping"]
    return tabled_moments(_frequencies(hull, mesh), a[1:], b[1:], a[0])


@lru_cache(maxsize=8)
def _forces(hull: Hull, mesh: Mesh) -> tuple[Surfaces, ...]:
    """Splines of forces in sea water."""
    found = _solution(hull, mesh)
    forces = {name: found[name] for name in ("froude_krylov", "diffraction")}
    return force_surfaces(_frequencies(hull, mesh), np.array(mesh.headings), forces)


def _at_rest(hull: Hull, mesh: Mesh, ratio: float, frequency: Floats, heading: Floats) -> AtRest:
    return {one.name: ratio * one.at(frequency, heading) for one in _forces(hull, mesh)}
