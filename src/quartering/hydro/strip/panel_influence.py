"""Influence matrices of constant source and dipole panels, with two symmetry planes.

For water at rest far away Green's identity at a point p of the closed surface S, its normal n into the water, reads

    4 pi phi(p) - int_S (phi(q) - phi(p)) d(1/r)/dn dS = - int_S (1/r) dphi/dn dS

(phi(p) is taken out of the integral so that the panel p lies on needs no limit). The motions here are odd in y; across the
calm plane the image is even (a rigid lid, no waves at zero frequency) or odd (no potential there, infinite frequency).
In the plane, with ln(1/r) in place of 1/r, 2 pi stands in place of 4 pi.
"""

from __future__ import annotations

import math

import numpy as np

from quartering._machine.compiled import inner, kernel
from quartering.hull.lines.section import Floats

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


@inner
def _panel(px: float, py: float, pz: float, c: Floats, m: Floats, n: Floats) -> tuple[float, float]:
    """The same of a quadrilateral with corners c, their mean m and area normal n: four triangles, or a point far away."""
    dx, dy, dz = m[0] - px, m[1] - py, m[2] - pz
    square, size = dx * dx + dy * dy + dz * dz, 0.0
    for k in range(4):
        size = max(size, (c[k, 0] - m[0]) ** 2 + (c[k, 1] - m[1]) ** 2 + (c[k, 2] - m[2]) ** 2)
    angle, source = 0.0, 0.0
    if square > FAR**2 * size:
        source = math.sqrt((n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / square)
        return (n[0] * dx + n[1] * dy + n[2] * dz) / (square * math.sqrt(square)), source
    for k in range(4):
        one, other = _triangle(px, py, pz, c[k], c[(k + 1) % 4], m)
        angle += one
        source += other
    return angle, source


@inner
def _add(potential: Floats, velocity: Floats, i: int, j: int, image: int, angle: float, source: float) -> None:
    """Add what panel j does to image ``image`` of point i: bits 1 and 2 say that it is mirrored in y, in z."""
    in_y, in_z = image % 2, image // 2
    for mirror in range(2):
        sign = (1 - 2 * in_y) * (1 - 2 * in_z * mirror)
        potential[mirror, i, j] += sign * angle
        potential[mirror, i, i] -= angle
        velocity[mirror, i, j] -= sign * source


@kernel
def panel_equations(corners: Floats, normal: Floats) -> tuple[Floats, Floats]:
    """Green's identity at the centres of the panels of a quarter body.

    corners (n, 4, 3): quadrilaterals; each is four triangles that meet in the mean of its corners, so that the surface
        is closed whatever its twist [m]
    normal (n, 3): their normals into the water, times area; right-hand rule [m2]
    Returns potential (2, n, n): matrices of the unknown potentials; first the body mirrored evenly, then oddly in z =
        0; velocity (2, n, n): matrices of the normal velocities [m]: potential @ phi = velocity @ dphi/dn

    Source: [Morino74] Green's identity on constant panels; [VanOosterom83] solid angle; [Hess67] sources.
    Valid: motions odd in y; panels of any aspect, opposite sides of a thin body among them.
    """
    n = corners.shape[0]
    potential, velocity = np.zeros((2, n, n)), np.zeros((2, n, n))
    centre = corners.sum(axis=1) / 4
    for j in range(n):
        for i in range(n):
            for image in range(4):  # the body's image acts on p as the body on the image of p
                in_y, in_z = image % 2, image // 2
                y, z = centre[i, 1] * (1 - 2 * in_y), centre[i, 2] * (1 - 2 * in_z)
                angle, source = _panel(centre[i, 0], y, z, corners[j], centre[j], normal[j])
                if image == 0 and i == j:
                    angle = 0.0
                _add(potential, velocity, i, j, image, angle, source)
    for mirror in range(2):
        for i in range(n):
            potential[mirror, i, i] += 4.0 * math.pi
    return potential, velocity


@inner
def _piece(py: float, pz: float, y0: float, z0: float, y1: float, z1: float) -> tuple[float, float]:
    """Angle under which a straight piece is seen from p, as a solid angle, and the integral of ln(1/r) over it."""
    ty, tz = y1 - y0, z1 - z0
    length = math.sqrt(ty * ty + tz * tz)
    if length == 0.0:
        return 0.0, 0.0
    ty, tz = ty / length, tz / length
    height = (z0 - pz) * ty - (y0 - py) * tz
    first = (y0 - py) * ty + (z0 - pz) * tz
    last = first + length
    angle = 0.0
    if height != 0.0:
        angle = math.atan2(last, abs(height)) - math.atan2(first, abs(height))
    source = length - abs(height) * angle
    for end, sign in ((last, -0.5), (first, 0.5)):
        square = end * end + height * height
        if square > 0.0:
            source += sign * end * math.log(square)
    return math.copysign(angle, height), source


@kernel
def contour_equations(y: Floats, z: Floats) -> tuple[Floats, Floats]:
    """The same in the plane, at the middles of the straight pieces of a section's contour.

    y, z (m + 1,): points from the keel to the waterline [m]
    Returns potential (2, m, m): as `panel_equations`; velocity (2, m, m)

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
                angle, source = _piece(py, pz, y[j], z[j], y[j + 1], z[j + 1])
                if image == 0 and i == j:
                    angle = 0.0
                _add(potential, velocity, i, j, image, angle, source)
    for mirror in range(2):
        for i in range(n):
            potential[mirror, i, i] += 2.0 * math.pi
    return potential, velocity
