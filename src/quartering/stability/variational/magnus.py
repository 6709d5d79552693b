"""State transition matrices by the Magnus expansion, for weakly modulated equations."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import batch_kernel, kernel
from quartering._machine.threads import in_threads
from quartering.motion.equations.system import Floats
from quartering.stability.variational.exponential import ROW, commutator, exponential, product

STEPS = (
    4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 20, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 768, 1024, 2048, 4096,
    8192, 16384, 32768,
)  # fmt: skip
"""Numbers of steps there are tables for."""
FINEST = 1e-7
"""Smallest error of the multipliers the exponential is computed well enough for."""
_TIERS = (14, 18, 22, 24, 26, 28)
"""How many of `STEPS` a set of tables holds: nearly every motion is content with the first 14, up to 48 steps; the last sets
take tens of megabytes."""
_CONSTANT = 40.0
_NODE = math.sqrt(15.0) / 10.0
_POINTS = 40
_ROOT, _THIRDS = math.sqrt(15.0) / 3.0, 10.0 / 3.0


@batch_kernel
def _exponent(a, h, a1, a2, a3, c1, c2, scratch, out):
    """Magnus' exponent of one step to sixth order from the matrices (3, 4, 4, W) at Gauss' three nodes."""
    for i in range(4):
        for j in range(4):
            for l in range(ROW):
                low, middle, high = a[0, i, j, l], a[1, i, j, l], a[2, i, j, l]
                a1[i, j, l] = h[l] * middle
                a2[i, j, l] = h[l] * _ROOT * (high - low)
                a3[i, j, l] = _THIRDS * h[l] * (high - 2.0 * middle + low)
    commutator(a1, a2, scratch, c1)
    for i in range(4):
        for j in range(4):
            for l in range(ROW):
                out[i, j, l] = 2.0 * a3[i, j, l] + c1[i, j, l]
    commutator(a1, out, scratch, c2)
    for i in range(4):
        for j in range(4):
            for l in range(ROW):
                c1[i, j, l] += -20.0 * a1[i, j, l] - a3[i, j, l]
                c2[i, j, l] = a2[i, j, l] - c2[i, j, l] * (1.0 / 60.0)
    commutator(c1, c2, scratch, out)
    for i in range(4):
        for j in range(4):
            for l in range(ROW):
                out[i, j, l] = a1[i, j, l] + a3[i, j, l] * (1.0 / 12.0) + out[i, j, l] * (1.0 / 240.0)


@batch_kernel
def _at_nodes(values, weights, node, matrix):
    """Variational matrices (3, 4, 4, W) at the three nodes from ``node`` on, interpolated from equal intervals (s, 12, W)."""
    for m in range(3):
        for e in range(12):
            i = 0 if e < 4 else e // 4 + 1
            j = e % 4
            for l in range(ROW):
                matrix[m, i, j, l] = 0.0
            for s in range(0, values.shape[0], 4):
                a, b, c, d = weights[node + m, s : s + 4]
                for l in range(ROW):
                    two = a * values[s, e, l] + b * values[s + 1, e, l]
                    matrix[m, i, j, l] += two + c * values[s + 2, e, l] + d * values[s + 3, e, l]


@kernel
def _transition(first, last, along, weights, rows, starts, counts, scale, cycle, transition):
    """Transition matrices (n, 4, 4) of the conditions in rows first..last over `cycle` seconds.

    Row r holds the conditions rows[r], all of counts[r] steps; its last one fills up what is empty.
    """
    matrix, values = np.zeros((3, 4, 4, ROW)), np.zeros((weights.shape[1], 12, ROW))
    a1, a2, a3, c1 = np.empty((4, 4, ROW)), np.empty((4, 4, ROW)), np.empty((4, 4, ROW)), np.empty((4, 4, ROW))
    c2, scratch, exponent = np.empty((4, 4, ROW)), np.empty((4, 4, ROW)), np.empty((4, 4, ROW))
    phi, g, h = np.empty((4, 4, ROW)), np.empty(ROW), np.empty(ROW)
    norm, halvings = np.empty(ROW), np.empty(ROW, np.int64)
    for r in range(first, last):
        for l in range(ROW):
            i = rows[r, l]
            g[l], h[l] = scale[i], cycle[i] / counts[r]
            for e in range(12):  # sway velocity in units of g, so that all entries are of one size
                unit = (g[l] if e % 4 == 0 else 1.0) / (g[l] if e < 4 else 1.0)
                for s in range(along.shape[1]):
                    values[s, e, l] = along[i, s, e] * unit
            for a in range(4):
                for b in range(4):
                    phi[a, b, l] = 1.0 if a == b else 0.0
            for m in range(3):
                matrix[m, 1, 2, l] = 1.0
        # Magnus: Phi(t + h) = exp(Omega) Phi(t). From A at Gauss' three nodes, a1 = h A2, a2 = sqrt(15)/3 h (A3 - A1),
        # a3 = 10/3 h (A3 - 2 A2 + A1), Omega = a1 + a3/12 + [-20 a1 - a3 + [a1, a2], a2 - [a1, 2 a3 + [a1, a2]]/60]/240
        # errs by h^7; with the equations nearly constant few steps do.
        for n in range(counts[r]):
            _at_nodes(values, weights, starts[r] + 3 * n, matrix)
            _exponent(matrix, h, a1, a2, a3, c1, c2, scratch, exponent)
            exponential(exponent, c1, c2, scratch, norm, halvings, a1)
            product(a1, phi, a2)
            for a in range(4):
                for b in range(4):
                    for l in range(ROW):
                        phi[a, b, l] = a2[a, b, l]
        for l in range(ROW):
            for a in range(4):
                for b in range(4):
                    unit = (g[l] if a == 0 else 1.0) / (g[l] if b == 0 else 1.0)
                    transition[rows[r, l], a, b] = phi[a, b, l] * unit


@lru_cache(maxsize=16)
def _tables(samples: int, kinds: int, kinks: bool) -> tuple[Floats, NDArray[np.int64]]:
    """Weights (nodes, samples, filled up to a multiple of 4) of a periodic function's equally spaced values at the nodes of
    the first numbers of steps in turn, and where each begins: trigonometric interpolation, exact for the harmonics that
    the samples can hold.

    With kinks the values at the nodes are those of the parabola that comes nearest to the interpolated function over the step
    in the mean square: Gauss' rule then has its integral and first moments without error, wherever in the step the kink lies.
    """
    starts = (3 * np.concatenate([[0], np.cumsum(STEPS[:kinds])[:-1]])).astype(np.int64)
    if kinks:
        place, weight = np.polynomial.legendre.leggauss(_POINTS)
        powers = np.arange(3)
        parabola = np.polynomial.legendre.legvander(np.array([-2 * _NODE, 0.0, 2 * _NODE]), 2)
        project = parabola @ (
            (powers[:, None] + 0.5) * np.polynomial.legendre.legvander(place, 2).T * weight
        )  # (3, points)
        rows = [
            np.einsum("ap,nps->nas", project, _cardinals((np.arange(n)[:, None] + 0.5 + 0.5 * place) / n, samples))
            for n in STEPS[:kinds]
        ]
        weights = np.concatenate([row.reshape(-1, samples) for row in rows])
    else:
        nodes = [((np.arange(n)[:, None] + [0.5 - _NODE, 0.5, 0.5 + _NODE]) / n).ravel() for n in STEPS[:kinds]]
        weights = _cardinals(np.concatenate(nodes), samples)
    return np.pad(weights, ((0, 0), (0, -samples % 4))), starts  # four are taken at a time


def _cardinals(nodes: Floats, samples: int) -> Floats:
    """Trigonometric cardinal functions (..., samples) of equally spaced samples, at shares (...) of the period."""
    half = np.pi * (nodes[..., None] - np.arange(samples) / samples)
    small = np.abs(np.sin(half)) < 1e-12
    below = np.where(small, 1.0, np.sin(half) if samples % 2 else np.tan(half))
    return np.asarray(np.where(small, 1.0, np.sin(samples * half) / (samples * below)))


def magnus_steps(
    frequency: Floats, phasors: NDArray[np.complex128], rate: Floats, span: float, accuracy: float
) -> tuple[NDArray[np.int64], Floats]:
    """Steps that keep the error of the multipliers below a given accuracy, and the unit of sway velocity to take.

    frequency (n,): w > 0 [rad/s]
    phasors (n, m, 3, 4): harmonics of the variational matrix, the mean first
    rate (n,): from `fastest_rate` [1/s]
    span: fraction of the period integrated
    accuracy: relative to the larger of 1 and the multiplier; not below `FINEST`
    Returns steps (n,): one of `STEPS`; 0 where even the most are not enough: integrate those otherwise; scale (n,):
        sway velocity at which sway and the other equations weigh alike [m/s]

    The error is that of the modulation alone: C M r^4/n^6 over half a cycle, with M the modulation relative to w^2
    (stiffness) and w (damping), r = rate/w >= 1 and C = 40, the largest found on seven loadings of four hulls in 2,400
    conditions each.  Source: [Blanes09] order of the method; the constant is measured, see tests.
    """
    sizes, mean = np.abs(phasors[:, 1:]).sum(axis=1), np.abs(phasors[:, 0])
    out, back = mean[:, 0, 1:].sum(axis=1), mean[:, 1:, 0].sum(axis=1)
    usable = (out > 0) & (back > 0)
    scale = np.sqrt(np.where(usable, out, 1.0) / np.where(usable, back, 1.0))
    unit = np.stack([scale, np.ones_like(scale), np.ones_like(scale)], axis=1)
    sizes = sizes / unit[:, :, None]
    sizes[:, :, 0] *= scale[:, None]
    stiffness, damping = sizes[:, :, 1].max(axis=1), sizes[:, :, [0, 2, 3]].max(axis=(1, 2))
    w = np.where(frequency > 0, frequency, np.nan)
    strength = np.maximum(stiffness / w**2, damping / w) * np.maximum(rate / w, 1.0) ** 4
    wanted = 2 * span * (_CONSTANT * strength / max(accuracy, FINEST)) ** (1 / 6)
    index = np.searchsorted(STEPS, wanted)  # NaN sorts last
    return np.array([*STEPS, 0], dtype=np.int64)[index], scale


def magnus_transition(
    along: Floats, cycle: Floats, steps: NDArray[np.int64], scale: Floats, *, kinks: bool = False
) -> Floats:
    """State transition matrices of the variational equations over one period of their matrix.

    along (n, s, 3, 4): the matrix at equal intervals over its period, from `variation_along`
    cycle (n,): that period [s]
    steps, scale (n,): from `magnus_steps`
    kinks: the matrix is continuous only, as with drag |q| q
    Returns (n, 4, 4): state order (v, phi, p, r); NaN where steps are 0

    Sixth-order Magnus series on Gauss nodes: a constant matrix is integrated exactly, so only the modulation costs steps.
    Source: [Blanes09].  Valid: equations that are smooth along the motion, or
    continuous with many samples.
    """
    samples = along.shape[1]
    where = np.searchsorted(STEPS, np.maximum(steps, STEPS[0]))
    kinds = next(tier for tier in _TIERS if where.max(initial=0) < tier)
    weights, starts = _tables(samples, kinds, kinks)
    transition = np.full((along.shape[0], 4, 4), np.nan)
    rows = _rows(steps)
    of_row = (starts[where[rows[:, 0]]], steps[rows[:, 0]])
    in_threads(
        _transition, rows.shape[0], along.reshape(-1, samples, 12), weights, rows, *of_row, scale, cycle, transition
    )
    return transition


def _rows(steps: NDArray[np.int64]) -> NDArray[np.int64]:
    """Indices (rows, ROW) of conditions of equal numbers of steps, without those of none."""
    rows = [np.empty((0, ROW), np.int64)]
    for count in np.unique(steps[steps > 0]):
        own = np.flatnonzero(steps == count)
        rows.append(np.pad(own, (0, -own.size % ROW), mode="edge").reshape(-1, ROW))
    return np.concatenate(rows)
