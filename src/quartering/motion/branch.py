"""Branches of periodic motions followed through folds, and all motions that coexist in one condition."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.loads.waves import Wave
from quartering.motion.balance import balance
from quartering.motion.basis import basis
from quartering.motion.equations import Floats, Model, System
from quartering.motion.harmonic import harmonic_balance, orders_for
from quartering.motion.of_ship import equations
from quartering.motion.status import Status
from quartering.motion.steady import Motion, motion_record, peaks

if TYPE_CHECKING:
    import xarray as xr

Over = Literal["frequency", "excitation"]
_ANGLES, _SIZES = 12, 12


@dataclass(frozen=True, eq=False)
class _Curve:
    """The balance equations of one system with one parameter free; unknowns scaled to order one."""

    system: System
    orders: tuple[int, ...]
    over: Over
    scale: Floats

    def residual(self, point: Floats) -> tuple[Floats, Floats]:
        """Residual (m,) and derivative (m, m + 1) at a scaled point (unknowns, parameter)."""
        value, matrix = self._balance(point)
        step = 1e-6
        forward, backward = point.copy(), point.copy()
        forward[-1] += step
        backward[-1] -= step
        by_parameter = (self._balance(forward)[0] - self._balance(backward)[0]) / (2 * step)
        return value, np.column_stack([matrix * self.scale, by_parameter])

    def _balance(self, point: Floats) -> tuple[Floats, Floats]:
        s, table = self.system, basis(self.orders, self.system.degree, self.system.has_modulus)
        share, w = (1.0, point[-1]) if self.over == "frequency" else (point[-1], s.frequency[0])
        one = (
            s.linear[0],
            s.coefficients[0],
            s.powers,
            s.modulus,
            share * s.mean[0],
            share * s.cos[0],
            share * s.sin[0],
            w,
        )
        nb = table.factors.size
        residual, matrix = np.empty(3 * nb), np.empty((3 * nb, 3 * nb))
        scratch = (np.empty((4, 8)), np.empty(4), np.empty(3), np.empty((3, 4)), np.empty((3, 3, nb)))
        balance(one, table.arrays, self.unscaled(point), 1.0, True, residual, matrix, scratch)
        return residual, matrix

    def unscaled(self, point: Floats) -> Floats:
        """Coefficients (3, b) of a scaled point."""
        return np.ascontiguousarray((point[:-1] * self.scale).reshape(3, -1))

    def corrected(self, guess: Floats, tangent: Floats) -> Floats | None:
        """Point of the curve on the plane through `guess` across `tangent`, or None."""
        point = guess.copy()
        for _ in range(10):
            value, derivative = self.residual(point)
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
        _, derivative = self.residual(point)
        direction = np.linalg.svd(derivative)[2][-1]
        return np.asarray(direction * np.sign(direction @ along))


def _followed(
    curve: _Curve, start: Floats, along: Floats, stop: tuple[float, float], points: int
) -> tuple[list[Floats], list[int]]:
    """Points of a curve from `start` until the parameter leaves `stop`, and which of them are folds."""
    found, folds, length = [start], [], 0.02
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
        tangent, length = turned, min(1.3 * length, 0.1)
        if not stop[0] <= point[-1] <= stop[1]:
            break
    return found, folds


def _fold(curve: _Curve, before: Floats, tangent: Floats, reach: float) -> Floats:
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


def branch(
    ship_or_model: Ship | Model,
    over: Over = "frequency",
    *,
    limits: tuple[float, float] | None = None,
    harmonics: int = 3,
    wave: Wave | None = None,
    speed: float = 0.0,
    heading: float = 90.0,
    points: int = 2000,
) -> xr.Dataset:
    """Follow the periodic motions of a model through their folds while one parameter changes.

    Parameters
    ----------
    ship_or_model : Ship or Model    a ship needs `wave`, `speed`, `heading`; coefficients and force stay as there
    over : str                       "frequency" (encounter frequency [rad/s]) or "excitation" (share of the wave force)
    limits : (low, high)             of the parameter; by default 0.5 to 1.5 times the model's frequency, or 0 to 2
    harmonics : int                  highest harmonic, odd
    wave, speed, heading             of a ship [m/s, deg]
    points : int                     at the most

    Returns
    -------
    xarray.Dataset    along ``point``: parameter, sway [m], roll, yaw, roll_peak [deg]; ``fold`` is True where the parameter
                      turns back; several motions coexist where the curve passes one value more than once

    Raises
    ------
    InputError        unknown parameter, limits that do not rise, no motion to start from

    Notes
    -----
    Pseudo-arclength continuation from the motion at the lower limit.  Source: [Krack19]; [H71] eq. (A-11).

    Examples
    --------
    >>> terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.2, "K_p": -0.04}
    >>> model = Model(np.eye(3), terms, 1.0, (0, 0.1, 0), (0, 0, 0))
    >>> curve = branch(model, "frequency", limits=(0.8, 1.5), harmonics=1)
    >>> curve["frequency"][curve["fold"]].values.round(2).tolist()
    [1.26, 1.1]
    """
    import xarray as xr

    model = _model(ship_or_model, wave, speed, heading)
    if over not in ("frequency", "excitation"):
        raise InputError(f"over={over!r}: a branch can be followed over 'frequency' or 'excitation'")
    default = (0.5 * model.frequency, 1.5 * model.frequency) if over == "frequency" else (0.0, 2.0)
    low, high = limits or default
    if not (0 <= low < high < np.inf) or (over == "frequency" and low == 0):
        raise InputError(f"limits ({low:g}, {high:g}) must be two rising numbers, above zero for a frequency")
    curve, start, along = _start(model.system, orders_for(model.system, harmonics), over, low)
    path, folds = _followed(curve, start, along, (low - 1e-12, high), points)
    found = np.array(path)
    u = np.array([curve.unscaled(point) for point in found])
    first = 1 if curve.orders[0] == 0 else 0
    amplitude = np.hypot(u[:, :, first], u[:, :, first + 1])
    fold = np.zeros(len(found), dtype=bool)
    fold[folds] = True
    columns = {
        over: (found[:, -1], "rad/s" if over == "frequency" else "1", "parameter of the branch"),
        "sway": (amplitude[:, 0], "m", "amplitude of sway, fundamental"),
        "roll": (np.degrees(amplitude[:, 1]), "deg", "amplitude of roll, fundamental"),
        "yaw": (np.degrees(amplitude[:, 2]), "deg", "amplitude of yaw, fundamental"),
        "roll_peak": (np.degrees(peaks(u, curve.orders)[:, 1]), "deg", "largest roll angle over a cycle"),
    }
    data = {name: ("point", v, {"units": unit, "long_name": text}) for name, (v, unit, text) in columns.items()}
    ds = xr.Dataset(data, attrs={"references": ", ".join((*model.references, "Krack19"))})
    return ds.assign(fold=("point", fold, {"long_name": "the parameter turns back here"}))


def _model(ship_or_model: Ship | Model, wave: Wave | None, speed: float, heading: float) -> Model:
    if isinstance(ship_or_model, Model):
        return ship_or_model
    if wave is None:
        raise InputError(
            "a branch of a ship needs a wave: branch(ship, wave=Wave(length=.., height=..), speed=.., heading=..)"
        )
    return equations(ship_or_model, wave, speed, heading)


def _start(system: System, orders: tuple[int, ...], over: Over, low: float) -> tuple[_Curve, Floats, Floats]:
    """The curve, its first point at the lower limit, and the direction of a rising parameter."""
    share, w = (1.0, low) if over == "frequency" else (low, float(system.frequency[0]))
    at = replace(
        system, mean=share * system.mean, cos=share * system.cos, sin=share * system.sin, frequency=np.array([w])
    )
    u, status, _ = harmonic_balance(at, orders)
    if not Status(status[0]).ok:
        raise InputError(f"no motion to start the branch from at {over} = {low:g}: {Status(status[0]).advice}")
    full, _, _ = harmonic_balance(system, orders)
    size = np.nan_to_num(np.abs(np.concatenate([u, full])).max(axis=(0, 2)))
    size = np.maximum(size, 1e-3 * size.max() + 1e-12)
    scale = np.repeat(size, u.shape[2])
    point = np.append(u[0].ravel() / scale, low)
    along = np.zeros(point.size)
    along[-1] = 1.0
    return _Curve(system, orders, over, scale), point, along


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
    try:
        curve, start, along = _start(model.system, low, "excitation", 0.0)
    except InputError:
        return found
    path, _ = _followed(curve, start, along, (-2.0, 2.0), 1500)
    for a, b in zip(path, path[1:], strict=False):
        if (a[-1] - 1) * (b[-1] - 1) <= 0 and a[-1] != b[-1]:
            part = (1 - a[-1]) / (b[-1] - a[-1])
            found.append(curve.unscaled(a + part * (b - a)))
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
