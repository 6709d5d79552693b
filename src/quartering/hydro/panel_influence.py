"""What panels of constant potential and constant normal velocity do to one another, for bodies mirrored in two planes.

For water at rest far away Green's identity at a point p of the closed surface S, its normal n into the water, reads

    4 pi phi(p) - int_S (phi(q) - phi(p)) d(1/r)/dn dS = - int_S (1/r) dphi/dn dS

(phi(p) is taken out of the integral so that the panel p lies on needs no limit). The motions here are odd in y; across the
calm plane the image is even (a rigid lid, no waves at zero frequency) or odd (no potential there, infinite frequency).
In the plane, with ln(1/r) in place of 1/r, 2 pi stands in place of 4 pi.
"""

from __future__ import annotations

import math

import numpy as np

from quartering.compiled import inner, kernel
from quartering.hull.section import Floats

FAR = 20.0
"""Distance from which a panel acts as a point, over the distance of its centre from its farthest corner: 2e-4 of its part."""


@inner
def _edge(x0: float, y0: float, z0: float, x1: float, y1: float, z1: float, nx: float, ny: float, nz: float) -> float:
    """Part of one edge in the integral of 1/r over a flat triangle with unit normal n, seen from the origin."""
    ex, ey, ez = x1 - x0, y1 - y0, z1 - z0
    length = math.sqrt(ex * ex + ey * ey + ez * ez)
    reach = math.sqrt(x0 * x0 + y0 * y0 + z0 * z0) + math.sqrt(x1 * x1 + y1 * y1 + z1 * z1)
    off = (ey * nz - ez * ny) * x0 + (ez * nx - ex * nz) * y0 + (ex * ny - ey * nx) * z0
    if off == 0.0 or reach - length <= 1e-12 * length:
        return 0.0
    return off / length * math.log((reach + length) / (reach - length))


@inner
def _triangle(px: float, py: float, pz: float, a: Floats, b: Floats, c: Floats) -> tuple[float, float]:
    """Solid angle of a triangle, above zero when its normal points away from p, and the integral of 1/r over it."""
    ax, ay, az = a[0] - px, a[1] - py, a[2] - pz
    bx, by, bz = b[0] - px, b[1] - py, b[2] - pz
    cx, cy, cz = c[0] - px, c[1] - py, c[2] - pz
    ux, uy, uz, vx, vy, vz = bx - ax, by - ay, bz - az, cx - ax, cy - ay, cz - az
    nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    double_area = math.sqrt(nx * nx + ny * ny + nz * nz)
    if double_area <= 1e-14 * (ux * ux + uy * uy + uz * uz + vx * vx + vy * vy + vz * vz):
        return 0.0, 0.0
    nx, ny, nz = nx / double_area, ny / double_area, nz / double_area
    height = ax * nx + ay * ny + az * nz
    ra, rb, rc = math.sqrt(ax**2 + ay**2 + az**2), math.sqrt(bx**2 + by**2 + bz**2), math.sqrt(cx**2 + cy**2 + cz**2)
    ab, bc, ca = ax * bx + ay * by + az * bz, bx * cx + by * cy + bz * cz, cx * ax + cy * ay + cz * az
    angle = 0.0
    if height != 0.0:
        angle = 2.0 * math.atan2(height * double_area, ra * rb * rc + ab * rc + bc * ra + ca * rb)
    source = _edge(ax, ay, az, bx, by, bz, nx, ny, nz)
    source += _edge(bx, by, bz, cx, cy, cz, nx, ny, nz)
    source += _edge(cx, cy, cz, ax, ay, az, nx, ny, nz)
    return angle, source - height * angle


@kernel
def panel_equations(corners: Floats) -> tuple[Floats, Floats]:
    """Green's identity at the centres of the panels of a quarter body.

    Parameters
    ----------
    corners : (n, 4, 3) float    quadrilaterals, the normal into the water by the right-hand rule; each is four triangles that
                                 meet in the mean of its corners, so that the surface is closed whatever its twist [m]

    Returns
    -------
    potential : (2, n, n) float    matrices of the unknown potentials; first the body mirrored evenly, then oddly in z = 0
    velocity : (2, n, n) float     matrices of the normal velocities [m]: potential @ phi = velocity @ dphi/dn

    Notes
    -----
    Source: [Morino74] Green's identity on constant panels; [VanOosterom83] solid angle; [Hess67] sources.
    Valid: motions odd in y; panels of any aspect, opposite sides of a thin body among them.
    """
    n = corners.shape[0]
    potential, velocity = np.zeros((2, n, n)), np.zeros((2, n, n))
    centre = np.empty((n, 3))
    for j in range(n):
        for k in range(3):
            centre[j, k] = 0.25 * (corners[j, 0, k] + corners[j, 1, k] + corners[j, 2, k] + corners[j, 3, k])
    for j in range(n):
        c, m, size = corners[j], centre[j], 0.0
        for k in range(4):
            size = max(size, (c[k, 0] - m[0]) ** 2 + (c[k, 1] - m[1]) ** 2 + (c[k, 2] - m[2]) ** 2)
        ux, uy, uz = c[2, 0] - c[0, 0], c[2, 1] - c[0, 1], c[2, 2] - c[0, 2]
        vx, vy, vz = c[3, 0] - c[1, 0], c[3, 1] - c[1, 1], c[3, 2] - c[1, 2]
        nx, ny, nz = 0.5 * (uy * vz - uz * vy), 0.5 * (uz * vx - ux * vz), 0.5 * (ux * vy - uy * vx)
        area = math.sqrt(nx * nx + ny * ny + nz * nz)
        for i in range(n):
            for image in range(4):  # the body's image acts on p as the body on the image of p
                in_y, in_z = image % 2, image // 2
                px, py, pz = centre[i, 0], centre[i, 1] * (1 - 2 * in_y), centre[i, 2] * (1 - 2 * in_z)
                dx, dy, dz = m[0] - px, m[1] - py, m[2] - pz
                square = dx * dx + dy * dy + dz * dz
                angle, source = 0.0, 0.0
                if square > FAR**2 * size:
                    source = area / math.sqrt(square)
                    angle = (nx * dx + ny * dy + nz * dz) / (square * math.sqrt(square))
                else:
                    for k in range(4):
                        one, other = _triangle(px, py, pz, c[k], c[(k + 1) % 4], m)
                        angle += one
                        source += other
                if image == 0 and i == j:
                    angle = 0.0
                for mirror in range(2):
                    sign = (1 - 2 * in_y) * (1 - 2 * in_z * mirror)
                    potential[mirror, i, j] += sign * angle
                    potential[mirror, i, i] -= angle
                    velocity[mirror, i, j] -= sign * source
    for mirror in range(2):
        for i in range(n):
            potential[mirror, i, i] += 4.0 * math.pi
    return potential, velocity


@kernel
def contour_equations(y: Floats, z: Floats) -> tuple[Floats, Floats]:
    """The same in the plane, at the middles of the straight pieces of a section's contour.

    Parameters
    ----------
    y, z : (m + 1,) float    points from the keel to the waterline [m]

    Returns
    -------
    potential : (2, m, m) float    as `panel_equations`
    velocity : (2, m, m) float

    Notes
    -----
    The subtended angle and the integral of ln(1/r) of a straight piece in closed form.
    Source: [Morino74], [Hess67] in two dimensions.  Valid: motions odd in y, so that no flow goes out on the whole.
    """
    n = y.size - 1
    potential, velocity = np.zeros((2, n, n)), np.zeros((2, n, n))
    for i in range(n):
        for image in range(4):
            in_y, in_z = image % 2, image // 2
            py, pz = 0.5 * (y[i] + y[i + 1]) * (1 - 2 * in_y), 0.5 * (z[i] + z[i + 1]) * (1 - 2 * in_z)
            for j in range(n):
                ty, tz = y[j + 1] - y[j], z[j + 1] - z[j]
                length = math.sqrt(ty * ty + tz * tz)
                if length == 0.0:
                    continue
                ty, tz = ty / length, tz / length
                ay, az = y[j] - py, z[j] - pz
                height = az * ty - ay * tz
                if image == 0 and i == j:
                    height = 0.0
                first = ay * ty + az * tz
                last = first + length
                angle = 0.0
                if height != 0.0:
                    angle = math.atan2(last, abs(height)) - math.atan2(first, abs(height))
                source = length - abs(height) * angle
                for end, sign in ((last, -0.5), (first, 0.5)):
                    square = end * end + height * height
                    if square > 0.0:
                        source += sign * end * math.log(square)
                angle = math.copysign(angle, height)
                for mirror in range(2):
                    factor = (1 - 2 * in_y) * (1 - 2 * in_z * mirror)
                    potential[mirror, i, j] += factor * angle
                    potential[mirror, i, i] -= angle
                    velocity[mirror, i, j] -= factor * source
    for mirror in range(2):
        for i in range(n):
            potential[mirror, i, i] += 2.0 * math.pi
    return potential, velocity
