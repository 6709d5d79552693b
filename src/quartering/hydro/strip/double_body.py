"""Double-body added mass of a hull in sway and roll, by panels and by strips.

At zero frequency the calm plane is as a rigid lid: the image moves as the hull does. At infinite frequency the potential
vanishes there: the image moves the other way. Either way no waves are made and the potentials are real.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from quartering.hull.lines.mesh import Grid, closed_panels
from quartering.hull.lines.section import Floats


class DoubleBody(NamedTuple):
    """Potentials per unit velocity in sway [m] and roll about the calm plane [m2] on the meshes of a grid.

    The first index is the limit: zero frequency, then infinite frequency. Normals point into the water.

    Parameters
    ----------
    hull : (2, n, m, 2) float        in three dimensions
    sections : (2, n, m, 2) float    of the section amidst each column of meshes, as an infinite cylinder
    velocity : (n, m, 2) float       normal velocity of a mesh in unit sway and roll, times its area [m2, m3]
    along : (n, m, 2) float          the same of the piece of that section, times the width of the column
    """

    hull: Floats
    sections: Floats
    velocity: Floats
    along: Floats


def double_body(grid: Grid) -> DoubleBody:
    """Potentials of a hull with its image at both limits of the frequency.

    grid: contours of the hull, n + 1 of m + 1 points

    Constant potential and normal velocity on each panel, equations at their middles. A flat end is a wall.
    Source: [Morino74], [Hess67].  Valid: deep water, no forward speed.
    """
    from quartering.hydro.strip.panel_influence import panel_equations  # kernels, which a table found on disk needs not

    panels = closed_panels(grid)
    corners = panels.vertices[panels.quads]
    normal, centre = panels.area_vectors, corners.mean(axis=1)
    area = np.linalg.norm(normal, axis=1)
    solid = area > 1e-10 * area.max()
    flux = _rigid(centre[:, 1:], normal[:, 1:])
    potential, velocity = panel_equations(corners[solid], normal[solid])
    known = velocity @ (flux[solid] / area[solid, None])
    found = np.zeros((2, len(corners), 2))
    found[:, solid] = np.linalg.solve(potential, known)
    shape = grid.y.shape[0] - 1, grid.y.shape[1] - 1
    meshes = shape[0] * shape[1]
    sections, along = _sections(grid)
    return DoubleBody(found[:, :meshes].reshape(2, *shape, 2), sections, flux[:meshes].reshape(*shape, 2), along)


def _rigid(point: Floats, normal: Floats) -> Floats:
    """Flux (..., 2) through surfaces at (y, z) with area normals (ny, nz) in unit sway and roll."""
    (y, z), (ny, nz) = np.moveaxis(point, -1, 0), np.moveaxis(normal, -1, 0)
    return np.stack([ny, y * nz - z * ny], axis=-1)


def _sections(grid: Grid) -> tuple[Floats, Floats]:
    """Potentials (2, n, m, 2) of the sections amidst the columns, and their flux times the width of the column."""
    from quartering.hydro.strip.panel_influence import contour_equations

    y, z = (0.5 * (points[1:] + points[:-1]) for points in (grid.y, grid.z))
    middle = np.stack([0.5 * (points[:, 1:] + points[:, :-1]) for points in (y, z)], axis=-1)
    normal = np.stack([-np.diff(z, axis=1), np.diff(y, axis=1)], axis=-1)
    flux, length = _rigid(middle, normal), np.linalg.norm(normal, axis=-1)[..., None]
    speed = np.divide(flux, length, out=np.zeros_like(flux), where=length > 0)
    found = np.empty((2, *flux.shape))
    for k in range(y.shape[0]):
        potential, velocity = contour_equations(y[k], z[k])
        found[:, k] = np.linalg.solve(potential, velocity @ speed[k])
    return found, flux * np.diff(grid.x)[:, None, None]
