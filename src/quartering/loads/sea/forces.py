"""Wave forces on a ship in all cells of a sea."""

# The pressure of the undisturbed wave does not feel the ship's speed, and a wave from ahead, at 180 deg - mu, is that from
# astern, at mu, run backwards: same k, same k2, k1 of the other sign. Its Froude-Krylov phasors are the conjugates: half
# of the evenly spaced headings are computed. The diffraction feels the encounter frequency and has no such symmetry.

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from quartering.conventions import GRAVITY
from quartering.hull.lines.immersed import strips
from quartering.hydro.strip.moments import section_table
from quartering.loads.forces import keeps_speed_terms, ship_force_phasors
from quartering.loads.sea.cells import Cells
from quartering.loads.source import wave_source
from quartering.loads.strips.diffraction import contour_diffraction
from quartering.loads.strips.froude_krylov import froude_krylov
from quartering.loads.strips.stations import stations
from quartering.loads.strips.strip_forces import Form
from quartering.loads.waves import Phasors, folded

if TYPE_CHECKING:
    from quartering.hull.ship import Ship


def cell_forces(ship: Ship, cells: Cells, form: Form = "stf") -> Phasors:
    """Froude-Krylov and diffraction force in the cells of a sea, per metre of amplitude, lift apart.

    form: of the diffraction force
    Returns (c, 3): sway [N/m], roll and yaw about G [N m/m]: phasors of e^{i |omega| t}

    >>> import numpy as np
    >>> from quartering.hull.file.read import ship
    >>> cells = Cells(np.array([0.6, 0.8]), 0.2, np.array([30.0, 90.0, 150.0]), 0.0, 5.0)
    >>> cell_forces(ship("wigley").with_(ends="strips"), cells).shape
    (6, 3)
    """
    sigma, mu = cells.flat
    k, U = sigma**2 / GRAVITY, np.full(sigma.shape, cells.speed)
    if form != "stf" or wave_source(ship, form).source is not None:
        pressure, scattered, _ = ship_force_phasors(ship, k, U, mu, form)
        return pressure + scattered
    density, place = ship.loading.density, stations(ship)
    scattered = contour_diffraction(
        place, section_table(ship.hull, density), k, U, mu, density=density, speed_terms=keeps_speed_terms(ship)
    )
    return folded(cells.omega, _pressure(ship, cells) + scattered)[1]


def _pressure(ship: Ship, cells: Cells) -> Phasors:
    """Froude-Krylov phasors (c, 3) of e^{i omega t}, from those of headings astern where the same stand ahead."""
    half, last = (cells.even + 1) // 2, cells.even - 1
    own = np.append(np.arange(half), np.arange(cells.even, cells.heading.size))
    sigma, mu = np.meshgrid(cells.sigma, cells.heading[own], indexing="ij")
    found = froude_krylov(
        strips(ship.hull), stations(ship), sigma.ravel() ** 2 / GRAVITY, mu.ravel(), density=ship.loading.density
    ).reshape(*sigma.shape, 3)
    out = np.empty((cells.sigma.size, cells.heading.size, 3), dtype=complex)
    out[:, own] = found
    ahead = np.arange(half, cells.even)
    out[:, ahead] = found[:, last - ahead].conj()
    return out.reshape(-1, 3)
