"""Pseudo-arclength continuation of a solution curve, through folds, until it closes."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Equations = Callable[[Floats], tuple[Floats, Floats]]
"""Residual (m,) and derivative (m, m + 1) at a point (m + 1,); the unknowns scaled to about 1."""

_FIRST_STEP, _LONGEST_STEP, _SHORTEST_STEP = 0.02, 0.05, 1e-6
_LARGEST_TURN = 0.98
_NEWTON_STEP, _ROUNDING = 1e-10, 1e-13
_POINTS_OF_A_LOOP = 8


class Path(NamedTuple):
    """Points and unit tangents (n, m + 1) of a curve in order; a closed one has its first point last again."""

    points: Floats
    tangents: Floats
    closed: bool


def corrected(equations: Equations, guess: Floats, tangent: Floats) -> Floats | None:
    """Point of the curve on the plane through `guess` across `tangent`.

    equations: see `Equations`
    guess (m + 1,)
    tangent (m + 1,)
    Returns (m + 1,)

    Source: [Krack19] (arclength continuation).
    """
    found = _newton(equations, guess, tangent)
    return None if found is None else found[0]


def tangent_at(equations: Equations, point: Floats, along: Floats) -> Floats:
    """Unit tangent of the curve at one of its points, on the side of `along`.

    equations: see `Equations`
    point, along (m + 1,)
    Returns (m + 1,)

    Source: closed form (the null space of the derivative).

    >>> def circle(x):
    ...     return np.array([x @ x - 1.0]), 2.0 * x[None]
    >>> tangent_at(circle, np.array([1.0, 0.0]), np.array([0.3, 1.0])).round(9).tolist()
    [0.0, 1.0]
    """
    return _null_vector(equations(point)[1], along)


def _newton(equations: Equations, guess: Floats, tangent: Floats) -> tuple[Floats, Floats] | None:
    """Point of `corrected`, and the derivative at the last iterate, a hair's breadth from it."""
    point, before = guess.copy(), 0.0
    for _ in range(12):
        value, derivative = equations(point)
        try:
            step = np.linalg.solve(np.vstack([derivative, tangent]), -np.append(value, tangent @ (point - guess)))
        except np.linalg.LinAlgError:
            return None
        point += step
        largest = np.abs(step).max()
        if not largest < 1e3:
            return None
        if largest < _NEWTON_STEP or largest**2 < _ROUNDING * before:  # at this rate the next step is below rounding
            return point, derivative
        before = largest
    return None


def _null_vector(derivative: Floats, along: Floats) -> Floats:
    """Unit vector that a derivative (m, m + 1) takes to zero, on the side of `along`."""
    last = np.zeros(along.size)
    last[-1] = 1.0
    try:
        direction = np.linalg.solve(np.vstack([derivative, along]), last)
    except np.linalg.LinAlgError:  # the curve runs exactly across `along` here, as at a fold
        direction = np.linalg.svd(derivative)[2][-1]
    return np.asarray(direction / np.linalg.norm(direction))


def follow(
    equations: Equations,
    start: Floats,
    along: Floats,
    go_on: Callable[[Floats], bool],
    *,
    points: int = 2000,
    longest: float = _LONGEST_STEP,
    may_close: bool = True,
) -> Path:
    """Points of a curve from one of them onwards.

    equations: see `Equations`
    start (m + 1,): a point of the curve
    along (m + 1,): side to set off to
    go_on: of a point: False ends the curve with that point
    points: at the most
    longest: step
    may_close: stop when the first point is met again

    Steps go along the tangent, bent as it last turned, and are halved where the curve bends by more than 11 degrees.
    Source: [Krack19].
    """
    tangent = tangent_at(equations, start, along)
    found, tangents, length, bend = [start], [tangent], min(_FIRST_STEP, longest), np.zeros(start.size)
    while len(found) < points and length > _SHORTEST_STEP:
        there = _newton(equations, found[-1] + length * (tangent + 0.5 * length * bend), tangent)
        if there is None:
            length *= 0.5
            continue
        point, turned = there[0], _null_vector(there[1], tangent)
        if not turned @ tangent >= _LARGEST_TURN:
            length *= 0.5
            continue
        enough = may_close and len(found) >= _POINTS_OF_A_LOOP
        if enough and turned @ tangents[0] > 0.5 and _passes(found[-1], point, start):
            return Path(np.array([*found, start]), np.array([*tangents, tangents[0]]), True)
        found.append(point)
        tangents.append(turned)
        bend = (turned - tangent) / np.linalg.norm(point - found[-2])
        tangent, length = turned, min(1.3 * length, longest)
        if not go_on(point):
            break
    return Path(np.array(found), np.array(tangents), False)


def _passes(a: Floats, b: Floats, target: Floats) -> bool:
    """Does the piece of the curve between two neighbours pass through a point? Its sagitta is small beside its chord."""
    chord = b - a
    length = float(np.linalg.norm(chord))
    share = float((target - a) @ chord) / length**2
    off = float(np.linalg.norm(a + share * chord - target))
    return 0.0 <= share <= 1.0 and off < 0.2 * length
