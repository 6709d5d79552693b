"""Cross-flow drag strip by strip: the sums over strips that forces and their derivatives take, compiled kernels.

The water passes a strip at q = v + x r - h p - w and pushes with f = -c |q| q, c = (1/2) rho C_D T dx, in (Y, K, N) =
f (1, -h, x): along the gradient of q by (v, p, r). With e = c^(1/3) (1, -h, x) and w times c^(1/3) likewise, the force is
-|q| q e and its derivative -2 |q| e e^T, with no coefficient left: six numbers of a symmetric matrix. The minus stands in
``push``.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from quartering._machine.compiled import batch_kernel


@batch_kernel
def one_hull(strips):
    """Have all lanes the same forms of their strips?"""
    for z in range(strips.shape[0]):
        for j in range(3):
            for l in range(1, strips.shape[2]):
                if strips[z, j, l] != strips[z, j, 0]:
                    return False
    return True


@batch_kernel
def drag(strips, velocities, c, s, columns, sums):
    """Sums over strips (z, 5, W) of |q| q e (3, W); ``c, s`` are cosine and sine of the wave's phase."""
    width = columns.shape[1]
    sway, roll, yaw = velocities[0], velocities[1], velocities[2]
    for l in range(width):
        sums[0, l], sums[1, l], sums[2, l] = 0.0, 0.0, 0.0
    for z in range(strips.shape[0]):
        for l in range(width):
            v, p, r = strips[z, 0, l], strips[z, 1, l], strips[z, 2, l]
            own = v * columns[sway, l] + p * columns[roll, l] + r * columns[yaw, l]
            q = own - (c * strips[z, 3, l] + s * strips[z, 4, l])
            f = q * abs(q)
            sums[0, l] += f * v
            sums[1, l] += f * p
            sums[2, l] += f * r


@batch_kernel
def drag_of_one_hull(strips, velocities, c, s, columns, sums):
    """`drag` where all lanes have the strips of one hull, so that their forms are numbers: a third of the memory is read."""
    width = columns.shape[1]
    sway, roll, yaw = velocities[0], velocities[1], velocities[2]
    for l in range(width):
        sums[0, l], sums[1, l], sums[2, l] = 0.0, 0.0, 0.0
    for z in range(strips.shape[0]):
        v, p, r = strips[z, 0, 0], strips[z, 1, 0], strips[z, 2, 0]
        for l in range(width):
            own = v * columns[sway, l] + p * columns[roll, l] + r * columns[yaw, l]
            q = own - (c * strips[z, 3, l] + s * strips[z, 4, l])
            f = q * abs(q)
            sums[0, l] += f * v
            sums[1, l] += f * p
            sums[2, l] += f * r


@batch_kernel
def drag_slopes(strips, velocities, c, s, columns, sums):
    """Sums over strips of 2 |q| e e^T: the six entries (vv, vp, vr, pp, pr, rr; W)."""
    width = columns.shape[1]
    sway, roll, yaw = velocities[0], velocities[1], velocities[2]
    for j in range(6):
        for l in range(width):
            sums[j, l] = 0.0
    for z in range(strips.shape[0]):
        for l in range(width):
            v, p, r = strips[z, 0, l], strips[z, 1, l], strips[z, 2, l]
            own = v * columns[sway, l] + p * columns[roll, l] + r * columns[yaw, l]
            g = 2.0 * abs(own - (c * strips[z, 3, l] + s * strips[z, 4, l]))
            sums[0, l] += g * (v * v)
            sums[1, l] += g * (v * p)
            sums[2, l] += g * (v * r)
            sums[3, l] += g * (p * p)
            sums[4, l] += g * (p * r)
            sums[5, l] += g * (r * r)


@batch_kernel
def drag_slopes_of_one_hull(strips, velocities, c, s, columns, sums):
    """`drag_slopes` where all lanes have the strips of one hull."""
    width = columns.shape[1]
    sway, roll, yaw = velocities[0], velocities[1], velocities[2]
    for j in range(6):
        for l in range(width):
            sums[j, l] = 0.0
    for z in range(strips.shape[0]):
        v, p, r = strips[z, 0, 0], strips[z, 1, 0], strips[z, 2, 0]
        vv, vp, vr, pp, pr, rr = v * v, v * p, v * r, p * p, p * r, r * r
        for l in range(width):
            own = v * columns[sway, l] + p * columns[roll, l] + r * columns[yaw, l]
            g = 2.0 * abs(own - (c * strips[z, 3, l] + s * strips[z, 4, l]))
            sums[0, l] += g * vv
            sums[1, l] += g * vp
            sums[2, l] += g * vr
            sums[3, l] += g * pp
            sums[4, l] += g * pr
            sums[5, l] += g * rr
