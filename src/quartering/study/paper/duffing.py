"""Duffing's equation over frequency, exact to many harmonics, and what the formulas of the paper's Appendix C say of it."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
import xarray as xr

from quartering.conventions import InputError
from quartering.motion.branches.branch import Curve, follow_branch
from quartering.motion.equations.model import Model
from quartering.motion.equations.system import Floats, System, acceleration_form
from quartering.motion.equations.terms import term_table
from quartering.motion.status import Status
from quartering.motion.steady.harmonic import harmonic_balance, orders_for
from quartering.motion.steady.motion import roll_peaks
from quartering.stability.assessment import assess
from quartering.study.paper.duffing_formulas import FORMULAS, duffing_amplitudes, duffing_model

HARMONICS: Final = 11
"""Highest harmonic: with 21 the curves of the paper's case change by less than 1e-13."""

NEUTRAL: Final = 1e-5
"""A growth rate below this is none: without damping every multiplier of a stable motion lies on the unit circle."""

_POINTS = 3000
LARGEST: Final = 1e6
"""Largest coefficient or force: beyond, the cubic of one harmonic has no sound roots [1]."""


def duffing_curves(
    beta: float,
    force: float,
    damping: float = 0.0,
    limits: tuple[float, float] = (0.5, 2.0),
    harmonics: int = HARMONICS,
) -> xr.Dataset:
    """Every periodic motion of Duffing's equation that a curve from either end of a range of frequencies leads to.

    beta, force, damping: of x'' + damping x' + x + beta x^3 = force cos(omega t)
    limits (low, high): of omega, above 0
    harmonics: odd
    Returns along ``point``: ``curve`` (0 from the low end, 1 from the high end), ``frequency``, ``fundamental`` and
        ``peak``, negative where opposite in phase to the force, ``growth`` (largest Floquet exponent of x), ``stable``,
        ``fold``

    Pseudo-arclength continuation of the harmonic balance.  Source: [H71] Fig. 23; [Krack19].  Valid: motions joined to neither
    end (isolated ones) are not found.
    """
    _check(beta, force, damping, limits)
    paths: list[tuple[Floats, list[int], Floats]] = []
    for first, last in (limits, limits[::-1]):
        curve, start = _start(
            duffing_model(beta, force, first, damping), beta, force, damping, (first, last), harmonics
        )
        path, folds = follow_branch(curve, start, _POINTS)
        u = np.array([curve.coefficients(point) for point in path.points])
        frequency = first * (1 - path.points[:, -1]) + last * path.points[:, -1]
        if not paths or not _joined(paths[0], frequency, u):
            paths.append((frequency, folds, u))
    parts = [_described(duffing_model(beta, force, 1.0, damping), *path, i) for i, path in enumerate(paths)]
    attributes: dict[str, object] = {"beta": beta, "force": force, "damping": damping, "harmonics": harmonics}
    return xr.concat(parts, "point").assign_attrs(attributes | {"references": "H71, Krack19"})


def _check(beta: float, force: float, damping: float, limits: tuple[float, float]) -> None:
    if not (np.abs([beta, force, damping]).max() <= LARGEST and damping >= 0):
        raise InputError(
            f"beta {beta:g}, force {force:g}, damping {damping:g}: give numbers up to {LARGEST:g}, a damping of 0 or more"
        )
    if not (np.isfinite(limits).all() and 0 < limits[0] < limits[1]):
        raise InputError(f"frequencies {limits[0]:g} to {limits[1]:g}: give two rising numbers above 0, such as 0.5:2")


def _start(
    model: Model, beta: float, force: float, damping: float, ends: tuple[float, float], harmonics: int
) -> tuple[Curve, Floats]:
    """The curve over frequency from one end to the other, and its smallest motion at the first.

    The linear motion, from which branches start elsewhere, does not exist without damping at the natural frequency.
    """
    first, last = ends
    orders = orders_for(model.system, harmonics)
    u, _ = _motions(beta, force, np.array(ends), damping, orders, smallest=True)
    size = np.abs(u).max(axis=(0, 2))
    scale = np.repeat(np.maximum(size, 1e-3 * size.max()), u.shape[2])

    def family(share: float) -> System:
        return replace(model.system, frequency=np.array([first + (last - first) * share]))

    return Curve(family, orders, scale), np.append(u[0].ravel() / scale, 0.0)


def _motions(
    beta: float, force: float, frequency: Floats, damping: float, orders: tuple[int, ...], *, smallest: bool
) -> tuple[Floats, System]:
    """Motions (m, 3, b) that one harmonic knows, or the smallest at each frequency, carried to many harmonics; their system."""
    starts = [_one_harmonic(beta, force, float(w), damping) for w in frequency]
    chosen = [found[:1] if smallest else found for found in starts]
    empty = [w for w, found in zip(frequency, chosen, strict=True) if not len(found)]
    if empty:
        raise InputError(
            f"Duffing's equation with beta {beta:g}, force {force:g}, damping {damping:g} has no forced motion at frequency"
            f" {empty[0]:g}; give a force other than 0, and at the natural frequency 1 some cubic stiffness or damping"
        )
    model = duffing_model(beta, force, 1.0, damping)
    repeated = np.repeat(frequency, [len(found) for found in chosen])
    system = acceleration_form(np.eye(3), term_table(model.terms), repeated, (model.force_cos, model.force_sin, 0.0))
    guess = np.zeros((repeated.size, 3, 2 * len(orders)))
    guess[:, 1, :2] = np.concatenate(chosen)
    u, status, _ = harmonic_balance(system, orders, start=guess)
    if (status != Status.CONVERGED).any():
        raise InputError(
            f"Duffing's equation with beta {beta:g}, force {force:g} at frequency {repeated[status != Status.CONVERGED][0]:g}:"
            " its motion has no convergent harmonics there; take a smaller force or another frequency"
        )
    return u, system


def _joined(known: tuple[Floats, list[int], Floats], frequency: Floats, u: Floats) -> bool:
    """Does the first curve end where this one begins: is it the same curve?"""
    before, after = known[0][-2:]
    part = (frequency[0] - before) / (after - before)
    end = known[2][-2] + part * (known[2][-1] - known[2][-2])
    return bool(0.0 <= part <= 1.0 and np.abs(end - u[0]).max() < 0.02 * np.abs(u[0]).max())


def _described(model: Model, frequency: Floats, folds: list[int], u: Floats, index: int) -> xr.Dataset:
    """One curve as a dataset, judged."""
    orders = tuple(range(1, u.shape[2], 2))
    system = acceleration_form(np.eye(3), term_table(model.terms), frequency, (model.force_cos, model.force_sin, 0.0))
    growth = _growth(system, u, orders)
    side = np.where(u[:, 1, 0] < 0, -1.0, 1.0)
    columns = {
        "curve": (np.full(frequency.size, index), "which end it was followed from: 0 low, 1 high frequency"),
        "frequency": (frequency, "frequency of the force, natural one 1"),
        "fundamental": (side * np.hypot(u[:, 1, 0], u[:, 1, 1]), "amplitude of the fundamental"),
        "peak": (side * roll_peaks(u, orders), "largest value over a cycle"),
        "growth": (growth, "largest real Floquet exponent"),
        "stable": (growth < NEUTRAL, "does no small disturbance grow"),
        "fold": (np.isin(np.arange(frequency.size), folds), "the frequency turns back here"),
    }
    return xr.Dataset({name: ("point", v, {"units": "1", "long_name": words}) for name, (v, words) in columns.items()})


def _growth(system: System, u: Floats, orders: tuple[int, ...]) -> Floats:
    """Largest exponent of the oscillator itself; the idle sway and yaw die out at rate 1."""
    return np.asarray(assess(system, u, orders, accuracy=1e-10).floquet.exponents.real.max(axis=1))


def duffing_table(beta: float, force: float, frequency: float, damping: float = 0.0) -> list[dict[str, float | bool]]:
    """Motions of Duffing's equation at one frequency, and the nearest answer of each formula of Appendix C.

    beta, force, damping: of x'' + damping x' + x + beta x^3 = force cos(omega t)
    frequency: omega > 0
    Returns a motion each, smallest first: ``frequency``, ``fundamental``, ``peak`` (negative: opposite in phase),
        ``stable``, and under "C-3", "C-4", "C-5" the formula's amplitude on the same side of the force, NaN where it
        has none

    The motions are those that one harmonic knows, all of them in closed form, carried to many; motions born of a superharmonic
    resonance are not looked for. The formulas are of the undamped equation; C-3 and C-4 give the fundamental. What P of C-5 is
    depends on where: the peak to first order in beta away from resonance, the fundamental to second order on the backbone
    curve, omega^2 - 1 = 3/4 beta P^2.
    Source: [H71] Appendix C; closed form by putting the third harmonic beta A^3/(4 (9 omega^2 - 1)) into each.
    """
    _check(beta, force, damping, (frequency, frequency + 1.0))
    orders = tuple(range(1, HARMONICS + 1, 2))
    u, system = _motions(beta, force, np.array([frequency]), damping, orders, smallest=False)
    growth = _growth(system, u, orders)
    rows: list[dict[str, float | bool]] = []
    for i in range(len(u)):
        side = -1.0 if u[i, 1, 0] < 0 else 1.0
        fundamental = float(side * np.hypot(*u[i, 1, :2]))
        row: dict[str, float | bool] = {
            "frequency": frequency, "fundamental": fundamental, "peak": float(side * roll_peaks(u[i : i + 1], orders)[0]),
            "stable": bool(growth[i] < NEUTRAL),
        }  # fmt: skip
        roots = {name: duffing_amplitudes(name, beta, force, frequency) for name in FORMULAS}
        rows.append(row | {name: nearest_root(found, fundamental) for name, found in roots.items()})
    return rows


def _one_harmonic(beta: float, force: float, frequency: float, damping: float) -> Floats:
    """Cosine and sine parts (m, 2) of every motion of one harmonic, smallest first.

    [(1 - w^2 + 3/4 beta P^2)^2 + (d w)^2] P^2 = X0^2, a cubic in P^2.
    """
    c, d = 1.0 - frequency**2, damping * frequency
    squares = np.roots([9 / 16 * beta**2, 1.5 * beta * c, c**2 + d**2, -(force**2)])
    real = np.abs(squares.imag) < 1e-9 * (1 + np.abs(squares))
    stiffness = c + 0.75 * beta * np.sort(squares.real[real & (squares.real > 0)])
    return np.asarray(force * np.column_stack([stiffness, np.full_like(stiffness, d)]) / (stiffness**2 + d**2)[:, None])


def nearest_root(roots: Floats, amplitude: float) -> float:
    """Root on the same side of the force, nearest in amplitude.

    roots (m,): as from `duffing_amplitudes`
    amplitude: signed
    Returns NaN where no root is on that side

    >>> nearest_root(np.array([-3.1, -0.2, 3.3]), -0.5)
    -0.2
    """
    same = roots[roots * amplitude > 0]
    return float(same[np.argmin(np.abs(same - amplitude))]) if same.size else float("nan")
