"""Cross-flow drag strip by strip: the sums over strips that forces and their derivatives take, compiled kernels.

The water passes a strip at q = v + x r - h p - w and pushes with f = -c |q| q, c = (1/2) rho C_D T dx, in (Y, K, N) =
f (1, -h, x): along the gradient of q by (v, p, r). With e = c^(1/3) (1, -h, x) and w times c^(1/3) likewise, the force is
-|q| q e and its derivative -2 |q| e e^T, with no coefficient left: six numbers of a symmetric matrix. The minus stands in
``push``.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from quartering._machine.compiled import batch_kernel
from quartering._machine.simd import every, load, size, store


@batch_kernel
def one_hull(strips, of, one):
    """Have the conditions ``of`` (W,) of strips (n, z, 5) all the forms of condition ``one``?"""
    forms = strips[one]
    for l in range(of.size):
        own = strips[of[l]]
        for z in range(strips.shape[1] if of[l] != one else 0):
            if own[z, 0] != forms[z, 0] or own[z, 1] != forms[z, 1] or own[z, 2] != forms[z, 2]:
                return False
    return True


@batch_kernel
def drag(strips, velocities, c, s, columns, sums):
    """Sums over strips (z, 5, W) of |q| q e (3, W); ``c, s`` are cosine and sine of the wave's phase."""
    sway, roll, yaw = velocities[0], velocities[1], velocities[2]
    by_v, by_p, by_r = load(columns, sway), load(columns, roll), load(columns, yaw)
    y, m, n = every(0.0), every(0.0), every(0.0)
    for z in range(strips.shape[0]):
        v, p, r = load(strips, (z, 0)), load(strips, (z, 1)), load(strips, (z, 2))
        water = c * load(strips, (z, 3)) + s * load(strips, (z, 4))
        q = v * by_v + p * by_p + r * by_r - water
        f = q * size(q)
        y += f * v
        m += f * p
        n += f * r
    store(sums, 0, y)
    store(sums, 1, m)
    store(sums, 2, n)


@batch_kernel
def lay_out_forms(strips, forms):
    """The forms (v, p, r) of strips (z, 5), and twice their products (vv, vp, vr, pp, pr, rr), as numbers (z, 9)."""
    for z in range(strips.shape[0]):
        v, p, r = strips[z, 0], strips[z, 1], strips[z, 2]
        forms[z, 0], forms[z, 1], forms[z, 2] = v, p, r
        forms[z, 3], forms[z, 4], forms[z, 5] = 2.0 * (v * v), 2.0 * (v * p), 2.0 * (v * r)
        forms[z, 6], forms[z, 7], forms[z, 8] = 2.0 * (p * p), 2.0 * (p * r), 2.0 * (r * r)


@batch_kernel
def drag_of_one_hull(strips, forms, velocities, c, s, columns, sums):
    """`drag` where all lanes have the strips of one hull, so that their forms are numbers: a third of the memory is read."""
    sway, roll, yaw = velocities[0], velocities[1], velocities[2]
    by_v, by_p, by_r = load(columns, sway), load(columns, roll), load(columns, yaw)
    y, m, n = every(0.0), every(0.0), every(0.0)
    for z in range(strips.shape[0]):
        v, p, r = forms[z, 0], forms[z, 1], forms[z, 2]
        water = c * load(strips, (z, 3)) + s * load(strips, (z, 4))
        q = v * by_v + p * by_p + r * by_r - water
        f = q * size(q)
        y += f * v
        m += f * p
        n += f * r
    store(sums, 0, y)
    store(sums, 1, m)
    store(sums, 2, n)


@batch_kernel
def drag_slopes(strips, velocities, c, s, columns, sums):
    """Sums over strips of 2 |q| e e^T: the six entries (vv, vp, vr, pp, pr, rr; W)."""
    sway, roll, yaw = velocities[0], velocities[1], velocities[2]
    by_v, by_p, by_r = load(columns, sway), load(columns, roll), load(columns, yaw)
    vv, vp, vr, pp, pr, rr = every(0.0), every(0.0), every(0.0), every(0.0), every(0.0), every(0.0)
    for z in range(strips.shape[0]):
        v, p, r = load(strips, (z, 0)), load(strips, (z, 1)), load(strips, (z, 2))
        water = c * load(strips, (z, 3)) + s * load(strips, (z, 4))
        g = 2.0 * size(v * by_v + p * by_p + r * by_r - water)
        vv += g * (v * v)
        vp += g * (v * p)
        vr += g * (v * r)
        pp += g * (p * p)
        pr += g * (p * r)
        rr += g * (r * r)
    store(sums, 0, vv)
    store(sums, 1, vp)
    store(sums, 2, vr)
    store(sums, 3, pp)
    store(sums, 4, pr)
    store(sums, 5, rr)


@batch_kernel
def drag_slopes_of_one_hull(strips, forms, velocities, c, s, columns, sums):
    """`drag_slopes` where all lanes have the strips of one hull.

    Each |q| goes through ``sums``, behind the seventh: velocities and all six sums are more than a processor's registers hold.
    """
    sway, roll, yaw = velocities[0], velocities[1], velocities[2]
    by_v, by_p, by_r = load(columns, sway), load(columns, roll), load(columns, yaw)
    for z in range(strips.shape[0]):
        water = c * load(strips, (z, 3)) + s * load(strips, (z, 4))
        store(sums, 7 + z, size(forms[z, 0] * by_v + forms[z, 1] * by_p + forms[z, 2] * by_r - water))
    vv, vp, vr, pp, pr, rr = every(0.0), every(0.0), every(0.0), every(0.0), every(0.0), every(0.0)
    for z in range(strips.shape[0]):
        g = load(sums, 7 + z)
        vv += g * forms[z, 3]
        vp += g * forms[z, 4]
        vr += g * forms[z, 5]
        pp += g * forms[z, 6]
        pr += g * forms[z, 7]
        rr += g * forms[z, 8]
    store(sums, 0, vv)
    store(sums, 1, vp)
    store(sums, 2, vr)
    store(sums, 3, pp)
    store(sums, 4, pr)
    store(sums, 5, rr)
