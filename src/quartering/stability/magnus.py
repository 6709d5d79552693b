"""State transition matrices of gently modulated equations by Magnus' series: few long steps, each an exact exponential."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from quartering.compiled import kernel
from quartering.motion.equations import Floats
from quartering.threads import in_threads

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


@kernel
def _product(a, b, out):
    for i in range(4):
        for j in range(4):
            out[i, j] = a[i, 0] * b[0, j] + a[i, 1] * b[1, j] + a[i, 2] * b[2, j] + a[i, 3] * b[3, j]


@kernel
def _commutator(a, b, scratch, out):
    _product(a, b, out)
    _product(b, a, scratch)
    for i in range(4):
        for j in range(4):
            out[i, j] -= scratch[i, j]


@kernel
def _exponential(x, square, cube, part, out):
    """out = exp(x) by its series to x^8 after halving x until its norm is below 1/2; x is lost."""
    norm = 0.0
    for i in range(4):
        row = abs(x[i, 0]) + abs(x[i, 1]) + abs(x[i, 2]) + abs(x[i, 3])
        norm = max(norm, row)
    halvings, scale = 0, 1.0
    while norm > 0.5 and halvings < 60:
        norm *= 0.5
        scale *= 0.5
        halvings += 1
    for i in range(4):
        for j in range(4):
            x[i, j] *= scale
    _product(x, x, square)
    _product(square, x, cube)
    for i in range(4):
        for j in range(4):
            part[i, j] = (1.0 / 720.0 if i == j else 0.0) + x[i, j] / 5040.0 + square[i, j] / 40320.0
    _product(cube, part, out)
    for i in range(4):
        for j in range(4):
            part[i, j] = out[i, j] + (1.0 / 6.0 if i == j else 0.0) + x[i, j] / 24.0 + square[i, j] / 120.0
    _product(cube, part, out)
    for i in range(4):
        for j in range(4):
            out[i, j] += (1.0 if i == j else 0.0) + x[i, j] + 0.5 * square[i, j]
    for _ in range(halvings):
        _product(out, out, part)
        for i in range(4):
            for j in range(4):
                out[i, j] = part[i, j]


@kernel
def _exponent(a, h, a1, a2, a3, c1, c2, scratch, out):
    """Magnus' exponent of one step to sixth order from the matrices (3, 4, 4) at Gauss' three nodes."""
    for i in range(4):
        for j in range(4):
            low, middle, high = a[0, i, j], a[1, i, j], a[2, i, j]
            a1[i, j] = h * middle
            a2[i, j] = h * np.sqrt(15.0) / 3.0 * (high - low)
            a3[i, j] = h * 10.0 / 3.0 * (high - 2.0 * middle + low)
    _commutator(a1, a2, scratch, c1)
    for i in range(4):
        for j in range(4):
            out[i, j] = 2.0 * a3[i, j] + c1[i, j]
    _commutator(a1, out, scratch, c2)
    for i in range(4):
        for j in range(4):
            c1[i, j] += -20.0 * a1[i, j] - a3[i, j]
            c2[i, j] = a2[i, j] - c2[i, j] / 60.0
    _commutator(c1, c2, scratch, out)
    for i in range(4):
        for j in range(4):
            out[i, j] = a1[i, j] + a3[i, j] / 12.0 + out[i, j] / 240.0


@kernel
def _transition(first, last, along, weights, starts, counts, scale, cycle, transition):
    """Transition matrices (n, 4, 4) of conditions first..last over `cycle` seconds; `counts` of 0 are left alone."""
    matrix, flat = np.zeros((3, 4, 4)), np.empty(12)
    a1, a2, a3, c1 = np.empty((4, 4)), np.empty((4, 4)), np.empty((4, 4)), np.empty((4, 4))
    c2, scratch, exponent, phi = np.empty((4, 4)), np.empty((4, 4)), np.empty((4, 4)), np.empty((4, 4))
    for i in range(first, last):
        if counts[i] == 0:
            continue
        g = scale[i]
        for a in range(4):
            for b in range(4):
                phi[a, b] = 1.0 if a == b else 0.0
        for n in range(counts[i]):
            for m in range(3):
                node = starts[i] + 3 * n + m
                for e in range(12):
                    flat[e] = 0.0
                for s in range(along.shape[1]):
                    weight = weights[node, s]
                    for e in range(12):
                        flat[e] += weight * along[i, s, e]
                for s in range(4):  # sway velocity in units of g, so that all entries are of one size
                    unit = g if s == 0 else 1.0
                    matrix[m, 0, s] = flat[s] * unit / g
                    matrix[m, 2, s] = flat[4 + s] * unit
                    matrix[m, 3, s] = flat[8 + s] * unit
                matrix[m, 1, 2] = 1.0
            _exponent(matrix, cycle[i] / counts[i], a1, a2, a3, c1, c2, scratch, exponent)
            _exponential(exponent, c1, c2, scratch, a1)
            _product(a1, phi, a2)
            for a in range(4):
                for b in range(4):
                    phi[a, b] = a2[a, b]
        for a in range(4):
            for b in range(4):
                unit = (g if a == 0 else 1.0) / (g if b == 0 else 1.0)
                transition[i, a, b] = phi[a, b] * unit


@lru_cache(maxsize=16)
def _tables(samples: int, kinds: int) -> tuple[Floats, NDArray[np.int64]]:
    """Weights (nodes, samples) of a periodic function's equally spaced values at the nodes of the first numbers of steps in
    turn, and where each begins: trigonometric interpolation, exact for the harmonics the samples can hold.
    """
    nodes = np.concatenate(
        [((np.arange(n)[:, None] + [0.5 - _NODE, 0.5, 0.5 + _NODE]) / n).ravel() for n in STEPS[:kinds]]
    )
    half = np.pi * (nodes[:, None] - np.arange(samples) / samples)
    small = np.abs(np.sin(half)) < 1e-12
    below = np.where(small, 1.0, np.sin(half) if samples % 2 else np.tan(half))
    weights = np.where(small, 1.0, np.sin(samples * half) / (samples * below))
    return weights, (3 * np.concatenate([[0], np.cumsum(STEPS[:kinds])[:-1]])).astype(np.int64)


def magnus_steps(
    frequency: Floats, phasors: NDArray[np.complex128], rate: Floats, span: float, accuracy: float
) -> tuple[NDArray[np.int64], Floats]:
    """Steps that keep the error of the multipliers below a given accuracy, and the unit of sway velocity to take.

    Parameters
    ----------
    frequency : (n,) float         w > 0 [rad/s]
    phasors : (n, m, 3, 4)         harmonics of the variational matrix, the mean first
    rate : (n,) float              from `fastest_rate` [1/s]
    span : float                   fraction of the period integrated
    accuracy : float               relative to the larger of 1 and the multiplier; not below `FINEST`

    Returns
    -------
    steps : (n,) int               one of `STEPS`; 0 where even the most are not enough: integrate those otherwise
    scale : (n,) float             sway velocity at which sway and the other equations weigh alike [m/s]

    Notes
    -----
    The error is that of the modulation alone: C M r^4/n^6 over half a cycle, with M the modulation relative to w^2
    (stiffness) and w (damping), r = rate/w >= 1 and C = 40, the largest found on seven loadings of four hulls in 2,400
    conditions each.  Source: [Blanes09] order of the method; the constant is measured, see tests.

    Examples
    --------
    >>> gentle = np.zeros((1, 2, 3, 4), complex)
    >>> gentle[0, :, 1, 1] = [-1.0, 0.05]
    >>> magnus_steps(np.ones(1), gentle, np.ones(1), 0.5, 5e-6)[0].tolist()
    [9]
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


def magnus_transition(along: Floats, cycle: Floats, steps: NDArray[np.int64], scale: Floats) -> Floats:
    """State transition matrices of the variational equations over one period of their matrix.

    Parameters
    ----------
    along : (n, s, 3, 4) float    the matrix at equal intervals over its period, from `variation_along`
    cycle : (n,) float            that period [s]
    steps, scale : (n,)           from `magnus_steps`

    Returns
    -------
    (n, 4, 4) float               state order (v, phi, p, r); NaN where steps are 0

    Notes
    -----
    Sixth-order Magnus series on Gauss nodes: a constant matrix is integrated exactly, so only the modulation costs steps.
    Source: [Blanes09].  Valid: equations that are smooth along the motion.

    Examples
    --------
    >>> calm = np.zeros((1, 3, 3, 4))
    >>> calm[:, :, 0, 0] = -1.0
    >>> phi = magnus_transition(calm, np.full(1, 2 * np.pi), np.array([4]), np.ones(1))[0]
    >>> bool(np.isclose(phi[0, 0], np.exp(-2 * np.pi), rtol=1e-6))
    True
    """
    samples = along.shape[1]
    where = np.searchsorted(STEPS, np.maximum(steps, STEPS[0]))
    kinds = next(tier for tier in _TIERS if where.max(initial=0) < tier)
    weights, starts = _tables(samples, kinds)
    transition = np.full((along.shape[0], 4, 4), np.nan)
    in_threads(
        _transition,
        along.shape[0],
        along.reshape(-1, samples, 12),
        weights,
        starts[where],
        steps,
        scale,
        cycle,
        transition,
    )
    return transition
