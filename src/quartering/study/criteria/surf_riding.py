"""Surf-riding and broaching: length and Froude number, then the waves that catch the ship at its service speed."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.hull.lines.immersed import strips
from quartering.hull.propulsion import Propulsion
from quartering.hydro.propulsion import drive_of
from quartering.motion.surf_riding import melnikov_quadratic
from quartering.study.criteria.constants import limit
from quartering.study.criteria.particulars import Particulars
from quartering.study.criteria.record import Judgement, Quantity, not_judged
from quartering.study.criteria.sea_states import joint_density, scatter

Floats = NDArray[np.float64]

_RATIOS, _RATIO_STEP = np.arange(80) * 0.025 + 1.0125, 0.025
_STEEPNESSES, _STEEPNESS_STEP = np.arange(100) * 0.0012 + 0.0306, 0.0012


def level1(p: Particulars) -> Judgement:
    """Not vulnerable from 200 m on, or up to a Froude number of 0.3."""
    longest, above = limit("surf_riding.longest"), limit("surf_riding.applies_above")
    known = p.length >= longest or not math.isnan(p.froude)
    return Judgement(
        "surf_riding", 1,
        (Quantity("froude", p.froude, "1", f"up to {above:g}"), Quantity("length", p.length, "m", f"from {longest:g} on")),
        bool(p.length < longest and p.froude > above) if known else None,
        f"length {p.length:.4g} m, Froude number {p.froude:.3g}; {longest:g} m or more, or up to {above:g}"
        if known else "needs the service speed",
    )  # fmt: skip


_NEEDS = "needs propulsion: {diameter: .., k0: .., k1: .., r2: ..}, or propulsion: estimated"


def level2(p: Particulars, propulsion: Propulsion | None) -> Judgement:
    """C: share of waves, over all sea states, whose second threshold of surf-riding lies below the service speed."""
    drive = drive_of(p.ship, propulsion)
    if drive is None or math.isnan(p.speed):
        return not_judged("surf_riding", 2, ("c",), _NEEDS if drive is None else "needs the service speed")
    caught = caught_by(p, drive.propulsion)
    table, cell = scatter(), _RATIO_STEP * _STEEPNESS_STEP
    total = 0.0
    for i, j in np.argwhere(table.weight > 0):
        density = joint_density(p.length, table.hs[i], table.tz[j], _RATIOS[:, None], _STEEPNESSES)
        total += float(table.weight[i, j] * cell * density[caught].sum())
    most = limit("surf_riding.limit")
    return Judgement(
        "surf_riding", 2, (Quantity("c", total, "1", f"up to {most:g}"),), total > most, f"C {total:.3g}; up to {most:g}",
        notes=("added mass in surge 0.1 of the mass", f"resistance and thrust, {drive.source}"),
    )  # fmt: skip


def caught_by(p: Particulars, propulsion: Propulsion) -> NDArray[np.bool_]:
    """Is the ship at its service speed caught by each wave (80, 100), whatever its start.

    Melnikov's condition is a quadratic in the revolutions; the ship is caught where its own revolutions are above the root.
    """
    gravity, density = limit("general.gravity"), p.ship.loading.density
    mass = density * p.volume
    inertia = (1 + limit("surf_riding.added_mass")) * mass
    k = 2 * math.pi / (_RATIOS * p.length)
    force = surge_force(p, k)[:, None] * (_STEEPNESSES * _RATIOS[:, None] * p.length / 2)
    celerity = np.sqrt(gravity / k)[:, None]
    a, b, c = melnikov_quadratic(propulsion, inertia, k[:, None], celerity, force, density)
    root = (-b + np.sqrt(np.maximum(b**2 - 4 * a * c, 0.0))) / (2 * a)
    return np.asarray(propulsion.revolutions(p.speed, density) > root)


def surge_force(p: Particulars, wavenumber: ArrayLike) -> Floats:
    """Amplitude of the surging force of a following wave of 1 m amplitude [N/m], with the factor of diffraction.

    rho g k sqrt(Fc^2 + Fs^2), Fc, Fs = int A(x) (cos, sin)(k x) exp(-k d/2) dx over the sections.
    """
    wet = strips(p.ship.hull)
    k = np.asarray(wavenumber, dtype=float)[:, None]
    weight = wet.weight * wet.area * np.exp(-k * wet.draught / 2)
    both = np.hypot((weight * np.cos(k * wet.x)).sum(axis=1), (weight * np.sin(k * wet.x)).sum(axis=1))
    density = p.ship.loading.density
    return np.asarray(diffraction_factor(p) * density * limit("general.gravity") * k[:, 0] * both)


def diffraction_factor(p: Particulars) -> float:
    """Factor mu_x on the Froude-Krylov surge force, by block and midship coefficient."""
    fine, full = limit("surf_riding.diffraction_fine"), limit("surf_riding.diffraction_full")
    if p.cm < 0.86:
        slope = fine
    elif p.cm >= 0.94:
        slope = full
    else:
        slope = 5.76 - 5.0 * p.cm
    return slope * p.cb - limit("surf_riding.diffraction_less")
