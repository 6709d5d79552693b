"""Three-dimensional panels (Capytaine) at zero speed as a source of hydrodynamics."""

from __future__ import annotations

from functools import lru_cache, partial
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from quartering.conventions import GRAVITY
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.bem import PANELS, bem_forces
from quartering.hydro.moments import HullMoments, Moments
from quartering.hydro.source import AtRest, Held, Hydrodynamics
from quartering.hydro.tabled import Surfaces, force_surfaces, tabled_moments
from quartering.hydro.transfer import transfer, transfer_matrix

FREQUENCIES: Final = tuple(np.linspace(0.3, 1.6, 27).tolist())
"""w sqrt(B/2g) solved for: from near the limit at zero frequency to waves of 1.2 B [1]."""
HEADINGS: Final = tuple(np.arange(0.0, 181.0, 10.0).tolist())
"""Headings solved for [deg]."""


class _Panels(NamedTuple):
    """What is solved: hashable, so that it is solved once for a ship."""

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

    Parameters
    ----------
    ship : Ship
    frequencies : tuple of float    w sqrt(B/2g), ascending, at least four [1]
    headings : tuple of float       0 to 180, ascending, at least four [deg]
    panels : (int, int)             along the ship and from keel to waterline, on each side

    Returns
    -------
    Hydrodynamics                   at zero speed, between those frequencies and headings; forces in sway, roll, yaw

    Notes
    -----
    Heave, pitch and surge are not solved for yet: `force_modes` says what is held.
    Source: [Ancellin19], linear potential flow.  Valid: as `bem_forces`.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> panel_source(ship("wigley")).words
    'panels (Capytaine)'
    """
    solve = _Panels(frequencies, headings, panels)
    centre = hydrostatics(ship).lcb, ship.loading.kg - ship.hull.draught
    unit = float(np.sqrt(2 * GRAVITY / ship.hull.beam))

    def solved(frequency: Floats) -> Moments:
        return _moments(ship, solve).at(frequency).about(*centre)

    words = "panels (Capytaine)"
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
        radiation=partial(_moments, ship, solve),
        solved=solved,
        held=Held((frequencies[0] * unit, frequencies[-1] * unit), False, (headings[0], headings[-1])),
        at_rest=partial(_at_rest, ship, solve),
    )


@lru_cache(maxsize=8)
def _solution(ship: Ship, solve: _Panels) -> xr.Dataset:
    """Forces, added mass and damping about G, ascending in frequency."""
    omega = np.array(solve.frequencies) * np.sqrt(2 * GRAVITY / ship.hull.beam)
    return bem_forces(ship, 2 * np.pi * GRAVITY / omega**2, solve.headings, panels=solve.panels)


@lru_cache(maxsize=8)
def _moments(ship: Ship, solve: _Panels) -> HullMoments:
    ds, (x, z) = _solution(ship, solve), _centre(ship)
    a, b = (transfer(ds[name].to_numpy(), x, z) for name in ("added_mass", "damping"))
    return tabled_moments(ds["frequency"].to_numpy(), a, b, None)


@lru_cache(maxsize=8)
def _forces(ship: Ship, solve: _Panels) -> tuple[Surfaces, ...]:
    """Splines of forces about midship, whose phases stand for the surface there."""
    ds, (x, z) = _solution(ship, solve), _centre(ship)
    omega, mu = ds["frequency"].to_numpy(), ds["heading"].to_numpy()
    phase = np.exp(-1j * omega[:, None] ** 2 / GRAVITY * x * np.cos(np.radians(mu)))[..., None]
    forces = {}
    for name in ("froude_krylov", "diffraction"):
        parts = ds[name].transpose("wave_length", "heading", "part", "mode").to_numpy()
        forces[name] = phase * (parts[:, :, 0] - 1j * parts[:, :, 1]) @ transfer_matrix(x, z)
    return force_surfaces(omega, mu, forces)


def _at_rest(ship: Ship, solve: _Panels, frequency: Floats, heading: Floats) -> AtRest:
    return {one.name: one.at(frequency, heading) for one in _forces(ship, solve)}


def _centre(ship: Ship) -> tuple[float, float]:
    """G from midship at the calm plane, forward and down [m]."""
    return hydrostatics(ship).lcb, ship.hull.draught - ship.loading.kg
