"""A database as a user may bring one, made from strips, so that what it must give is known."""

import numpy as np

import quartering as qt
from quartering.conventions import GRAVITY
from quartering.loads.forces import ship_force_phasors

S60 = qt.ship("series60-cb60").with_(ends="strips")
OMEGA = np.linspace(0.1, 2.2, 43)
HEADINGS = np.arange(0.0, 181.0, 5.0)


def of_strips(ship, omega=OMEGA, headings=HEADINGS, forces=True):
    """Coefficients and zero-speed wave forces of a ship by strip theory, as a database to write."""
    k = omega**2 / GRAVITY
    grid_k, grid_mu = (v.ravel() for v in np.meshgrid(k, headings, indexing="ij"))
    found = ship_force_phasors(ship, grid_k, np.zeros_like(grid_k), grid_mu)
    shape = (omega.size, headings.size, 3)
    parts = {
        name: (("frequency", "heading", "part", "mode"), np.stack([p.real, -p.imag], axis=1).reshape(*shape[:2], 2, 3))
        for name, p in zip(("froude_krylov", "diffraction"), found, strict=False)
    }
    dataset = qt.hydrodynamics(ship, omega)
    return dataset.assign(parts).assign_coords(heading=headings, part=["cos", "sin"]) if forces else dataset
