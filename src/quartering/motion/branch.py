"""Branches of periodic motions followed through folds, and all motions that coexist in one condition."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from quartering.conventions import InputError
from quartering.motion.balance import balance
from quartering.motion.basis import basis
from quartering.motion.equations import Floats, Model, System
from quartering.motion.harmonic import harmonic_balance, orders_for
from quartering.motion.status import Status
from quartering.motion.steady import Motion, motion_record

Family = Callable[[float], System]
"""A system of one condition for every value of a parameter between 0 and 1."""

_ANGLES, _SIZES = 12, 12
_FIRST_STEP, _LONGEST_STEP = 0.02, 0.1


@dataclass(frozen=True, eq=False)
class Curve:
    """The balance equations of a family of systems; a point is the scaled unknowns and the parameter.

    Parameters
    ----------
    family : function of the parameter (0 to 1), gives a System of one condition
    orders : tuple of int    harmonics kept
    scale : (m,) float       size of each unknown
    """

    family: Family
    orders: tuple[int, ...]
    scale: Floats

    def coefficients(self, point: Floats) -> Floats:
        """Coefficients (3, b) of a point, as from `harmonic_balance`."""
        return np.ascontiguousarray((point[:-1] * self.scale).reshape(3, -1))

    def corrected(self, guess: Floats, tangent: Floats) -> Floats | None:
        """Point of the curve on the plane through `guess` across `tangent`, or None when Newton's method fails."""
        point = guess.copy()
        for _ in range(10):
            value, derivative = self._residual(point)
            matrix = np.vstack([derivative, tangent])
            try:
                step = np.linalg.solve(matrix, -np.append(value, tangent @ (point - guess)))
            except np.linalg.LinAlgError:
                return None
            point += step
            if not np.abs(step).max() < 1e3:
                return None
            if np.abs(step).max() < 1e-10:
                return point
        return None

    def tangent(self, point: Floats, along: Floats) -> Floats:
        """Unit tangent at a point, on the side of `along`."""
        _, derivative = self._residual(point)
        direction = np.linalg.svd(derivative)[2][-1]
        return np.asarray(direction * np.sign(direction @ along))

    def _residual(self, point: Floats) -> tuple[Floats, Floats]:
        """Residual (m,) and derivative (m, m + 1); by the parameter with central differences."""
        value, matrix = self._balance(point)
        step = 1e-6
        forward, backward = point.copy(), point.copy()
        forward[-1] += step
        backward[-1] -= step
        by_parameter = (self._balance(forward)[0] - self._balance(backward)[0]) / (2 * step)
        return value, np.column_stack([matrix * self.scale, by_parameter])

    def _balance(self, point: Floats) -> tuple[Floats, Floats]:
        s = self.family(float(point[-1]))
        table = basis(self.orders, s.degree, s.has_modulus)
        linear, coefficients, powers, modulus, mean, cos, sin, frequency = s.kernel_arrays()
        one = (linear[0], coefficients[0], powers, modulus, mean[0], cos[0], sin[0], frequency[0])
        nb = table.factors.size
        residual, matrix = np.empty(3 * nb), np.empty((3 * nb, 3 * nb))
        scratch = (np.empty((4, 8)), np.empty(4), np.empty(3), np.empty((3, 4)), np.empty((3, 3, nb)))
        balance(one, table.arrays, self.coefficients(point), 1.0, residual, matrix, scratch)
        return residual, matrix


def start_of_branch(family: Family, harmonics: int) -> tuple[Curve, Floats]:
    """The curve of a family and its first point, the motion at parameter 0 that grows out of the linear solution.

    Parameters
    ----------
    family : function of the parameter (0 to 1)
    harmonics : int    highest harmonic, odd

    Returns
    -------
    (Curve, (m + 1,) float)

    Raises
    ------
    InputError         no motion there, `harmonics` even

    Notes
    -----
    Source: [H71] eq. (A-11).

    Examples
    --------
    See `follow_branch`.
    """
    first, last = family(0.0), family(1.0)
    orders = orders_for(last, harmonics)
    u, status, _ = harmonic_balance(first, orders, from_rest=True)
    if not Status(status[0]).ok:
        raise InputError(f"no motion to start the branch from: {Status(status[0]).advice}")
    end, _, _ = harmonic_balance(last, orders, from_rest=True)
    size = np.nan_to_num(np.abs(np.concatenate([u, end])).max(axis=(0, 2)))
    size = np.maximum(size, 1e-3 * size.max() + 1e-12)
    scale = np.repeat(size, u.shape[2])
    return Curve(family, orders, scale), np.append(u[0].ravel() / scale, 0.0)


def follow_branch(
    curve: Curve, start: Floats, points: int = 2000, limits: tuple[float, float] = (0.0, 1.0)
) -> tuple[Floats, list[int]]:
    """Points of a branch from a start until the parameter leaves its limits, through folds.

    Parameters
    ----------
    curve : Curve
    start : (m + 1,) float         a point of it
    points : int                   at the most
    limits : (low, high)           of the parameter

    Returns
    -------
    points : (n, m + 1) float      scaled unknowns and parameter
    folds : list of int            which points are folds, located to rounding

    Notes
    -----
    Pseudo-arclength continuation: steps go along the tangent, shorter where the branch bends.  Source: [Krack19].

    Examples
    --------
    >>> terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.2, "K_p": -0.04}
    >>> system = Model(np.eye(3), terms, 1.0, (0, 0.1, 0), (0, 0, 0)).system
    >>> curve, start = start_of_branch(lambda t: replace(system, frequency=np.array([0.8 + 0.7 * t])), harmonics=1)
    >>> path, folds = follow_branch(curve, start)
    >>> (0.8 + 0.7 * path[folds, -1]).round(2).tolist()
    [1.26, 1.1]
    """
    found, folds, length = [start], [], _FIRST_STEP
    along = np.zeros(start.size)
    along[-1] = 1.0
    tangent = curve.tangent(start, along)
    while len(found) < points and length > 1e-6:
        point = curve.corrected(found[-1] + length * tangent, tangent)
        turned = curve.tangent(point, tangent) if point is not None else tangent
        if point is None or turned @ tangent < 0.95:
            length *= 0.5
            continue
        if turned[-1] * tangent[-1] < 0:
            folds.append(len(found))
            found.append(_fold(curve, found[-1], tangent, 2.0 * length))
        found.append(point)
        tangent, length = turned, min(1.3 * length, _LONGEST_STEP)
        if not limits[0] <= point[-1] <= limits[1]:
            break
    return np.array(found), folds


def _fold(curve: Curve, before: Floats, tangent: Floats, reach: float) -> Floats:
    """Point beyond `before` where the tangent has no part along the parameter."""
    from scipy.optimize import brentq

    def at(length: float) -> Floats:
        point = curve.corrected(before + length * tangent, tangent)
        return before if point is None else point

    def slope(length: float) -> float:
        return float(curve.tangent(at(length), tangent)[-1])

    while slope(reach) * slope(0.0) > 0:
        reach *= 1.5
    return at(brentq(slope, 0.0, reach, xtol=1e-13))


def all_motions(model: Model, harmonics: int = 9) -> list[Motion]:
    """Every periodic motion found in one condition, from the smallest roll to the largest.

    Parameters
    ----------
    model : Model
    harmonics : int    of the motions returned, odd

    Returns
    -------
    list of Motion     with the wave's period; judge each with `stability`

    Raises
    ------
    InputError         `harmonics` even or not positive

    Notes
    -----
    Three searches: from the linear solution, along the branch from rest to twice the excitation, and Newton's method from a
    grid of roll amplitudes and phases.  Nothing proves that no further motion exists.
    Source: [Krack19]; [H71] eq. (A-11) has up to as many roots as its cubics allow.

    Examples
    --------
    >>> terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.2, "K_p": -0.04}
    >>> model = Model(np.eye(3), terms, 1.2, (0, 0.1, 0), (0, 0, 0))
    >>> [round(float(m.amplitude[1]), 2) for m in all_motions(model, 5)]
    [0.23, 1.63, 1.76]
    """
    orders = orders_for(model.system, harmonics)
    columns = basis(orders, model.system.degree, model.system.has_modulus).factors.size
    starts = [u[None] for u in (*_from_branch(model), *_from_grid(model.system))]
    motions: list[tuple[Floats, int, float]] = []
    if starts:
        padded = np.zeros((len(starts), 3, columns))
        for i, u in enumerate(starts):
            padded[i, :, : u.shape[2]] = u[0]
        u, status, residual = harmonic_balance(_copies(model.system, len(starts)), orders, start=padded)
        for one, code, error in zip(u, status, residual, strict=True):
            if Status(code).ok and not any(_same(one, known) for known, _, _ in motions):
                motions.append((one, int(code), float(error)))
    records = [motion_record(model, u, orders, code, error, "harmonic balance") for u, code, error in motions]
    return sorted(records, key=lambda m: float(m.amplitude[1]))


def _same(a: Floats, b: Floats) -> bool:
    size = np.maximum(np.abs(a).max(axis=1), np.abs(b).max(axis=1)) + 1e-12
    return bool((np.abs(a - b).max(axis=1) < 1e-6 * size + 1e-12).all())


def _copies(system: System, count: int) -> System:
    arrays = {
        name: np.repeat(getattr(system, name), count, axis=0)
        for name in ("linear", "coefficients", "mean", "cos", "sin", "frequency")
    }
    return replace(system, **arrays)


def _from_branch(model: Model) -> list[Floats]:
    """One-harmonic motions where the branch over the excitation passes its full value, and the linear start's."""
    low = orders_for(model.system, 1)
    direct, status, _ = harmonic_balance(model.system, low)
    found = [direct[0]] if Status(status[0]).ok else []

    def raised(share: float) -> System:
        s, factor = model.system, 2.0 * share
        return replace(s, mean=factor * s.mean, cos=factor * s.cos, sin=factor * s.sin)

    try:
        curve, start = start_of_branch(raised, 1)
    except InputError:
        return found
    path, _ = follow_branch(curve, start, 1500, (-1.0, 1.0))
    for a, b in pairwise(path):
        if (a[-1] - 0.5) * (b[-1] - 0.5) <= 0 and a[-1] != b[-1]:
            part = (0.5 - a[-1]) / (b[-1] - a[-1])
            found.append(curve.coefficients(a + part * (b - a)))
    return found


def _from_grid(system: System) -> list[Floats]:
    """One-harmonic motions reached by Newton's method from a grid of roll amplitudes and phases."""
    low = orders_for(system, 1)
    first = 1 if low[0] == 0 else 0
    stiffness = np.abs(system.linear[0, 1, 1])
    hard = np.abs(system.coefficients[0, 1, (system.powers == [0, 3, 0, 0]).all(axis=1)]).sum()
    largest = min(2.0, 2.0 * np.sqrt(stiffness / hard)) if hard > 0 else 1.5
    sizes = largest * (np.arange(_SIZES) + 1) / _SIZES
    angles = 2 * np.pi * np.arange(_ANGLES) / _ANGLES
    start = np.zeros((_SIZES * _ANGLES, 3, 2 + first))
    start[:, 1, first] = np.outer(sizes, np.cos(angles)).ravel()
    start[:, 1, first + 1] = np.outer(sizes, np.sin(angles)).ravel()
    u, status, _ = harmonic_balance(_copies(system, len(start)), low, start=start)
    unique: list[Floats] = []
    for one in u[status == Status.CONVERGED]:
        if not any(_same(one, known) for known in unique):
            unique.append(one)
    return unique
