"""State transition matrices by the Magnus expansion, for weakly modulated equations."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import batch_kernel, inlined, kernel, maker, summing
from quartering._machine.simd import every, load, store
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
TIERS = (14, 18, 22, 24, 26, 28)
"""How many of `STEPS` a set of tables holds: nearly every motion is content with the first 14, up to 48 steps; the last sets
take tens of megabytes."""
_CONSTANT = 40.0
_NODE = math.sqrt(15.0) / 10.0
_POINTS = 8
_BESIDE = 3
"""Values that a polynomial takes on either side."""
BEFORE, AROUND = 2, 2 * _BESIDE
"""Values a step takes before the one it begins at, and how many beyond the ends of a period all steps take."""
_ROOT, _THIRDS = math.sqrt(15.0) / 3.0, 10.0 / 3.0


@batch_kernel
def _exponent(a, h, a1, a2, a3, c1, c2, out):
    """Magnus' exponent of one step to sixth order from the matrices (3, 4, 4, W) at Gauss' three nodes."""
    step = load(h, ())
    for i in range(4):
        for j in range(4):
            low, middle, high = load(a, (0, i, j)), load(a, (1, i, j)), load(a, (2, i, j))
            store(a1, (i, j), step * middle)
            store(a2, (i, j), step * (_ROOT * (high - low)))
            store(a3, (i, j), step * (_THIRDS * (high - 2.0 * middle + low)))
    commutator(a1, a2, c1)
    for i in range(4):
        for j in range(4):
            store(out, (i, j), 2.0 * load(a3, (i, j)) + load(c1, (i, j)))
    commutator(a1, out, c2)
    for i in range(4):
        for j in range(4):
            store(c1, (i, j), load(c1, (i, j)) - 20.0 * load(a1, (i, j)) - load(a3, (i, j)))
            store(c2, (i, j), load(a2, (i, j)) - load(c2, (i, j)) * (1.0 / 60.0))
    commutator(c1, c2, out)
    for i in range(4):
        for j in range(4):
            first = load(a1, (i, j)) + load(a3, (i, j)) * (1.0 / 12.0)
            store(out, (i, j), first + load(out, (i, j)) * (1.0 / 240.0))


@batch_kernel
def _at_nodes(values, begin, count, weights, node, matrix):
    """Variational matrices (3, 4, 4, W) at three nodes from ``node`` on, of ``count`` values (s, 12, W) from ``begin`` on."""
    for e in range(12):
        i = 0 if e < 4 else e // 4 + 1
        j = e % 4
        low, middle, high = every(0.0), every(0.0), every(0.0)
        for s in range(count):
            own = load(values, (begin + s, e))
            low += weights[node, s] * own
            middle += weights[node + 1, s] * own
            high += weights[node + 2, s] * own
        store(matrix, (0, i, j), low)
        store(matrix, (1, i, j), middle)
        store(matrix, (2, i, j), high)


@maker
def room_for_steps():
    """What `march` works in: matrices at the nodes, the exponent and its parts, norms."""
    return (np.zeros((3, 4, 4, ROW)), np.empty((4, 4, ROW)), np.empty((4, 4, ROW)), np.empty((4, 4, ROW)),
            np.empty((4, 4, ROW)), np.empty((4, 4, ROW)), np.empty((4, 4, ROW)), np.empty((2, ROW)))  # fmt: skip


@batch_kernel
def march(values, samples, weights, start, width, count, h, phi, room):
    """Transition matrices ``phi`` (4, 4, W) over ``count`` steps of h (W,).

    ``values`` (s, 12, W): the variational matrices at the samples of a period and `AROUND` further ones beyond its ends,
        `BEFORE` of them in front; sway velocity in a unit in which all entries are of one size

    ``weights, start, width``: of `tables`
    """
    matrix, a1, a2, a3, c1, c2, exponent, norms = room
    for a in range(4):
        for b in range(4):
            store(phi, (a, b), every(1.0 if a == b else 0.0))
    for m in range(3):
        store(matrix, (m, 1, 2), every(1.0))
    # Magnus: Phi(t + h) = exp(Omega) Phi(t). From A at Gauss' three nodes, a1 = h A2, a2 = sqrt(15)/3 h (A3 - A1),
    # a3 = 10/3 h (A3 - 2 A2 + A1), Omega = a1 + a3/12 + [-20 a1 - a3 + [a1, a2], a2 - [a1, 2 a3 + [a1, a2]]/60]/240
    # errs by h^7; with the equations nearly constant few steps do.
    for n in range(count):
        begin = samples * n // count if width != samples else BEFORE
        _at_nodes(values, begin, width, weights, start + 3 * n, matrix)
        _exponent(matrix, h, a1, a2, a3, c1, c2, exponent)
        exponential(exponent, c1, c2, a3, norms[0], norms[1], a1)
        product(a1, phi, a2)
        for a in range(4):
            for b in range(4):
                store(phi, (a, b), load(a2, (a, b)))


@kernel
def _transition(first, last, along, weights, rows, starts, widths, counts, scale, cycle, transition):
    """Transition matrices (n, 4, 4) of the conditions in rows first..last over `cycle` seconds.

    Row r holds the conditions rows[r], all of counts[r] steps; its last one fills up what is empty. A step takes widths[r]
    values about it, which go on beyond the ends of the period; all, where that is their number.
    """
    samples = along.shape[1]
    values, room = np.zeros((samples + AROUND + 2, 12, ROW)), room_for_steps()
    phi, g, h = np.empty((4, 4, ROW)), np.empty(ROW), np.empty(ROW)
    for r in range(first, last):
        for l in range(ROW):
            i = rows[r, l]
            g[l], h[l] = scale[i], cycle[i] / counts[r]
            for e in range(12):  # sway velocity in units of g, so that all entries are of one size
                unit = (g[l] if e % 4 == 0 else 1.0) / (g[l] if e < 4 else 1.0)
                for s in range(samples):
                    values[s + BEFORE, e, l] = along[i, s, e] * unit
                for s in range(BEFORE):
                    values[s, e, l] = along[i, samples - BEFORE + s, e] * unit
                for s in range(AROUND - BEFORE):
                    values[samples + BEFORE + s, e, l] = along[i, s, e] * unit
        march(values, samples, weights, starts[r], widths[r], counts[r], h, phi, room)
        for l in range(ROW):
            for a in range(4):
                for b in range(4):
                    unit = (g[l] if a == 0 else 1.0) / (g[l] if b == 0 else 1.0)
                    transition[rows[r, l], a, b] = phi[a, b, l] * unit


@lru_cache(maxsize=16)
def tables(samples: int, kinds: int, kinks: bool) -> tuple[Floats, NDArray[np.int64], NDArray[np.int64]]:
    """Weights (nodes, most) of a periodic function's equally spaced values at the nodes of the first numbers of steps in turn,
    where each number begins, and how many values a step of it takes: trigonometric interpolation, exact for the harmonics
    that the samples can hold.

    With kinks the values at the nodes are those of the parabola that comes nearest to the function over the step in the mean
    square: Gauss' rule then has its integral and first moments without error, wherever in the step the kink lies. There the
    function between its values is that of the polynomial through six of them, so that a step takes those near it alone.
    """
    starts = (3 * np.concatenate([[0], np.cumsum(STEPS[:kinds])[:-1]])).astype(np.int64)
    if not kinks:
        nodes = [((np.arange(n)[:, None] + [0.5 - _NODE, 0.5, 0.5 + _NODE]) / n).ravel() for n in STEPS[:kinds]]
        return _cardinals(np.concatenate(nodes), samples), starts, np.full(kinds, samples)
    local = [_local(samples, n) for n in STEPS[:kinds]]
    widths = np.array([part.shape[1] for part in local])
    return np.concatenate([np.pad(part, ((0, 0), (0, widths.max() - part.shape[1]))) for part in local]), starts, widths


def _local(samples: int, count: int) -> Floats:
    """Weights (3 count, values) of each of ``count`` steps, on the values from two before the one where it begins."""
    ends = samples * np.arange(count + 1) / count
    first = samples * np.arange(count) // count
    pieces = int(np.ceil(samples / count)) + 1
    cuts = np.clip(first[:, None] + np.arange(pieces + 1), ends[:-1, None], ends[1:, None])  # (n, pieces + 1)
    place, weight = np.polynomial.legendre.leggauss(_POINTS)
    half = 0.5 * np.diff(cuts)[..., None]
    x = cuts[:, :-1, None] + half * (1.0 + place)  # (n, pieces, points)
    length = samples / count
    # the parabola's values at the nodes: its Legendre coefficients are integrals over the step
    across = 2.0 * (x - ends[:-1, None, None]) / length - 1.0
    moments = (
        np.polynomial.legendre.legvander(across, 2) * (2.0 * np.arange(3) + 1.0) * (half * weight / length)[..., None]
    )
    at_nodes = moments @ np.polynomial.legendre.legvander(np.array([-2 * _NODE, 0.0, 2 * _NODE]), 2).T
    t = x - first[:, None, None] - np.arange(pieces)[:, None]  # from the value before: 0 to 1
    beside = np.arange(-BEFORE, _BESIDE * 2 - BEFORE)
    lagrange = np.ones((*t.shape, beside.size))
    for j, own in enumerate(beside):
        for other in beside[beside != own]:
            lagrange[..., j] *= (t - other) / (own - other)
    out = np.zeros((count, 3, pieces + 2 * _BESIDE - 1))
    for p in range(pieces):
        out[:, :, p : p + beside.size] += np.einsum("nga,ngj->naj", at_nodes[:, p], lagrange[:, p])
    return out.reshape(3 * count, -1)


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
    steps, scale = np.empty(frequency.size, np.int64), np.empty(frequency.size)
    given = (np.require(phasors, requirements=("C", "W")), frequency, rate, span, by_accuracy(accuracy))
    in_threads(_choose, frequency.size, *given, np.array([*STEPS, 0], dtype=np.int64), steps, scale)
    return steps, scale


def by_accuracy(accuracy: float) -> float:
    """The accuracy as `steps_of_one` takes it."""
    return _CONSTANT / max(accuracy, FINEST)


@summing
def _choose(first, last, phasors, frequency, rate, span, by_accuracy, kinds, steps, scale):
    """Numbers of steps and units of sway velocity of `magnus_steps`."""
    for i in range(first, last):
        place, scale[i] = steps_of_one(phasors[i], frequency[i], rate[i], span, by_accuracy, kinds)
        steps[i] = kinds[place]


@inlined
def modulus(z):
    """|z| of a number whose square is within the number range: `abs` guards against the ends of it, at ten times the cost."""
    return math.sqrt(z.real * z.real + z.imag * z.imag)


@summing
def steps_of_one(phasors, frequency, rate, span, by_accuracy, kinds):
    """Which of ``kinds`` of numbers of steps a condition takes, and its unit of sway velocity; see `magnus_steps`."""
    out, back = 0.0, 0.0
    for k in range(1, 4):
        out += modulus(phasors[0, 0, k])
    for k in range(1, 3):
        back += modulus(phasors[0, k, 0])
    g = math.sqrt(out / back) if out > 0.0 and back > 0.0 else 1.0
    stiffness, damping = 0.0, 0.0
    for k in range(3):
        for s in range(4):
            own = 0.0
            for m in range(1, phasors.shape[0]):
                own += modulus(phasors[m, k, s])
            own *= (g if s == 0 else 1.0) / (g if k == 0 else 1.0)
            if s == 1:
                stiffness = own if own > stiffness or np.isnan(own) else stiffness
            else:
                damping = own if own > damping or np.isnan(own) else damping
    w = frequency if frequency > 0.0 else np.nan
    strength = max(stiffness / (w * w), damping / w) * max(rate / w, 1.0) ** 4
    wanted, place = 2.0 * span * (by_accuracy * strength) ** (1.0 / 6.0), 0
    while place < kinds.size - 1 and not kinds[place] >= wanted:  # not a number goes to the end
        place += 1
    return place, g


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
    kinds = next(tier for tier in TIERS if where.max(initial=0) < tier)
    weights, starts, widths = tables(samples, kinds, kinks)
    transition = np.full((along.shape[0], 4, 4), np.nan)
    rows = _rows(steps)
    of_row = (starts[where[rows[:, 0]]], widths[where[rows[:, 0]]], steps[rows[:, 0]])
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
