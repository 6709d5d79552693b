"""Continuation in wave height from zero, through folds: a compiled kernel."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import numpy as np

from quartering._machine.compiled import inner, maker
from quartering.motion.steady.balance import balance
from quartering.motion.steady.dense import lu_factor, lu_solve

_STEP = 1e-4


@inner
def _excitation(one, first, nb, out):
    """Excitation as it stands in the balance equations (3 b,)."""
    _, parts, i, _ = one
    for row in range(3 * nb):
        out[row] = 0.0
    for k in range(3):
        if first == 1:
            out[k * nb] = parts.mean[i, k]
        out[k * nb + first] = parts.cos[i, k]
        out[k * nb + first + 1] = parts.sin[i, k]


@inner
def _by_share(one, tables, u, share, force, residual, no_matrix, room, out):
    """Derivative (3 b,) of the residual by the share of the wave, from the forces and from the known inputs.

    The inputs enter as a cubic at most or as |q| q, smooth enough for a central difference: it steers Newton's steps and the
    tangent, not the solution.
    """
    program, parts, i, _ = one
    for row in range(out.size):
        out[row] = -force[row]
    if parts.inputs.shape[1] + parts.strips.shape[1] == 0:
        return
    for side in (-1.0, 1.0):
        balance((program, parts, i, share + side * _STEP), tables, u, residual, no_matrix, room)
        for row in range(out.size):
            out[row] += side * residual[row] / (2.0 * _STEP)


@maker
def _correct(one, tables, u, share, scale, tangent, force, bordered, pivots, step, work):
    """Newton's method across the tangent from a predicted point (u, share); returns iterations, or -1, and the share.

    On success ``bordered`` holds the factored bordered matrix of the last iterate.
    """
    residual, no_matrix, matrix, room = work[0], work[1], work[2], work[7]
    program, parts, i, _ = one
    nb = u.shape[1]
    size = 3 * nb
    by_share = np.empty(size)
    for iteration in range(8):
        if iteration == 0:  # the point hardly moves from here on
            _by_share(one, tables, u, share, force, residual, no_matrix, room, by_share)
        balance((program, parts, i, share), tables, u, residual, matrix, room)
        for row in range(size):
            step[row] = -(residual[row] + (1.0 - share) * force[row])
            for column in range(size):
                bordered[row, column] = matrix[row, column] * scale[column // nb]
            bordered[row, size] = by_share[row]
            bordered[size, row] = tangent[row]
        bordered[size, size] = tangent[size]
        step[size] = 0.0
        if lu_factor(bordered, pivots) == 0:
            return -1, share
        lu_solve(bordered, pivots, step)
        largest = abs(step[size])
        for row in range(size):
            u[row // nb, row % nb] += scale[row // nb] * step[row]
            largest = max(largest, abs(step[row]))
        share += step[size]
        if not largest < 1e3:
            return -1, share
        if largest < 1e-8:
            return iteration, share
    return -1, share


@inner
def _set_off(linear_motion, scale, tangent):
    """Size of each mode (3,), and the unit tangent (3 b + 1,) of the branch where the wave begins to rise."""
    nb = linear_motion.shape[1]
    size = 3 * nb
    whole = 1e-300
    for k in range(3):
        for b in range(nb):
            whole = max(whole, abs(linear_motion[k, b]))
    for k in range(3):
        scale[k] = 1e-3 * whole
        for b in range(nb):
            scale[k] = max(scale[k], abs(linear_motion[k, b]))
    norm = 1.0
    for row in range(size):
        tangent[row] = linear_motion[row // nb, row % nb] / scale[row // nb]
        norm += tangent[row] ** 2
    tangent[size] = 1.0
    for row in range(size + 1):
        tangent[row] /= np.sqrt(norm)


@inner
def _turn(bordered, pivots, tangent, new):
    """The branch's next tangent (3 b + 1,) in ``new``; returns its cosine with the last one."""
    size = tangent.size - 1
    for row in range(size):
        new[row] = 0.0
    new[size] = 1.0
    lu_solve(bordered, pivots, new)
    turn, norm = 0.0, 0.0
    for row in range(size + 1):
        norm += new[row] ** 2
        turn += new[row] * tangent[row]
    norm = np.sqrt(norm)
    for row in range(size + 1):
        new[row] /= norm
    return turn / norm


@maker
def follow(one, tables, linear_motion, u, work):
    """Follow the motion from rest while the excitation grows from 0 to 1; leaves ``u`` near the first motion at 1.

    Pseudo-arclength continuation: the share of the excitation is an unknown beside the harmonics, and each step goes along
    the tangent, so the branch is followed through folds where no motion exists for a slightly higher wave.

    Returns True when the full excitation was reached

    Source: [Krack19] (arclength continuation).
    """
    nb = u.shape[1]
    size = 3 * nb
    force, scale = np.empty(size), np.empty(3)
    tangent, new = np.zeros(size + 1), np.empty(size + 1)
    step, trial = np.empty(size + 1), np.empty((3, nb))
    bordered, pivots = np.empty((size + 1, size + 1)), np.empty(size + 1, np.int64)
    first = 1 if tables[2][0] == 0.0 else 0
    _excitation(one, first, nb, force)
    _set_off(linear_motion, scale, tangent)
    for row in range(size):
        u[row // nb, row % nb] = 0.0
    # Unknowns are the harmonics over their scale and the share s of the excitation; the point goes `length` along the unit
    # tangent, then Newton's method with the plane across the tangent as the further equation brings it back to the curve.
    # Where s turns back (a fold) only the balance's own matrix is singular, the bordered one is not.
    share, length = 0.0, 0.05
    for _ in range(600):
        for row in range(size):
            trial[row // nb, row % nb] = u[row // nb, row % nb] + length * tangent[row] * scale[row // nb]
        iterations, reached = _correct(
            one, tables, trial, share + length * tangent[size], scale, tangent, force, bordered, pivots, step, work
        )
        same = iterations >= 0 and _turn(bordered, pivots, tangent, new) > 0.9
        if not same:  # not converged, or the branch bent too sharply to be sure it is the same one
            length *= 0.5
            if length < 1e-7:
                return False
            continue
        crossed = share < 1.0 <= reached
        part = (1.0 - share) / (reached - share) if crossed else 1.0
        for row in range(size):
            k, b = row // nb, row % nb
            u[k, b] += part * (trial[k, b] - u[k, b])
        if crossed:
            return True
        for row in range(size + 1):
            tangent[row] = new[row]
        share = reached
        if abs(share) > 1e3:
            return False
        length = min(0.5, 1.4 * length)
    return False
