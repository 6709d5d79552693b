"""The section coefficients and contour potentials of a whole hull over frequency, and how to read between."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline

from quartering.conventions import GRAVITY, InputError
from quartering.hull.section import Floats
from quartering.hull.strips import Strips
from quartering.hydro.lewis import (
    LewisForms,
    added_mass_at_infinite_frequency,
    added_mass_at_zero_frequency,
    lewis_forms,
)
from quartering.hydro.multipole import CONTOUR_POINTS, radiation
from quartering.hydro.wavemaker import Complexes

FREQUENCY_RANGE: Final = (0.02, 3.5)
"""Lowest and highest w sqrt(B/2g) of the standard frequencies [1]."""
STANDARD_FREQUENCIES: Final = 96
_KNEE: Final = 0.8


@dataclass(frozen=True, eq=False)
class SectionTable:
    """Sway and roll coefficients and contour potentials of all sections of a hull, about their waterline points.

    Axes y to starboard, z down from the calm plane; phasors e^{+i w t}; per metre of length, both sides. The contour is
    that of the Lewis form that stands for the section. On it, from the waterline to the keel,
    a_ij + b_ij/(i w) = -2 density sum(psi_i n_j) with n_2 = ny and n_4 = y nz - z ny.

    Parameters
    ----------
    frequency : (f,) float       ascending [rad/s]
    a : (f, s, 3) float          a22 [kg/m], a24 [kg], a44 [kg m]
    b : (f, s, 3) float          b22 [kg/(m s)], b24 [kg/s], b44 [kg m/s]
    y, z : (s, n) float          points of the starboard contour [m]
    ny, nz : (s, n) float        outward normal times arc length weight, starboard half [m]
    psi : (f, s, n, 2) complex   potential per unit velocity in sway [m] and roll [m2]
    a_zero : (s, 3) float        limit of a for w -> 0
    a_infinite : (s, 3) float    limit of a for w -> infinity
    forms : LewisForms           the forms, with those that had to be replaced by the nearest admissible one
    density : float              of the water [kg/m3]
    """

    frequency: Floats
    a: Floats
    b: Floats
    y: Floats
    z: Floats
    ny: Floats
    nz: Floats
    psi: Complexes
    a_zero: Floats
    a_infinite: Floats
    forms: LewisForms
    density: float


def radiation_table(
    strips: Strips, frequency: ArrayLike, density: float, *, points: int = CONTOUR_POINTS
) -> SectionTable:
    """Section coefficients in sway and roll of a hull's strips, each replaced by its Lewis form.

    Parameters
    ----------
    strips : Strips          half breadth, draught and area of (s,) sections are used
    frequency : (f,) float   w >= 0, ascending [rad/s]
    density : float          of the water, > 0 [kg/m3]
    points : int             points on the half contour, at least 18

    Returns
    -------
    SectionTable

    Raises
    ------
    InputError               frequencies not ascending, negative or not finite; density not positive

    Notes
    -----
    At w = 0 the damping is zero and the potentials are those under a rigid lid.
    Source: [Tasai61] sections in sway and roll by [Lewis29] forms.  Valid: deep water; ship-like sections, nu B/2 < 20.

    Examples
    --------
    >>> import numpy as np
    >>> one = np.ones((1, 1))
    >>> half_circle = Strips(np.zeros(1), np.ones(1), one, one, one, one, np.ones(1), np.ones(1), np.full(1, np.pi / 2))
    >>> table = radiation_table(half_circle, [0.0, np.sqrt(9.81)], density=1.0)
    >>> np.round(table.a[:, 0, 0] / (np.pi / 2), 4).tolist()
    [1.0, 0.3818]
    """
    w = np.atleast_1d(np.asarray(frequency, dtype=float))
    if w.ndim != 1 or not (np.diff(w) > 0.0).all():
        raise InputError(f"frequencies must be one list in ascending order [rad/s]; given {frequency!r}")
    if not (np.isfinite(density) and density > 0.0):
        raise InputError(f"water density {density} kg/m3 is not possible; give a positive number, 1025 for sea water")
    forms = lewis_forms(strips.half_breadth, strips.draught, strips.area)
    lateral = radiation(forms, w, "lateral", density=density, points=points)
    return SectionTable(
        frequency=w,
        a=_triplet(lateral.added_mass),
        b=_triplet(lateral.damping),
        y=lateral.point.real,
        z=lateral.point.imag,
        ny=lateral.normal.real,
        nz=lateral.normal.imag,
        psi=lateral.potential,
        a_zero=added_mass_at_zero_frequency(forms, density),
        a_infinite=added_mass_at_infinite_frequency(forms, density)[0],
        forms=forms,
        density=float(density),
    )


def _triplet(matrix: Floats) -> Floats:
    return np.stack([matrix[..., 0, 0], matrix[..., 0, 1], matrix[..., 1, 1]], axis=-1)


def default_frequencies(beam: float, draught: float, count: int = STANDARD_FREQUENCIES) -> Floats:
    """Frequencies between which the coefficients of all sections of a ship may be read by cubic interpolation.

    Parameters
    ----------
    beam, draught : float   of the ship, > 0 [m]
    count : int             how many, at least 8

    Returns
    -------
    (count,) float          ascending, w sqrt(B/2g) from 0.02 to 3.5 [rad/s]

    Raises
    ------
    InputError              beam or draught not positive, or too few frequencies

    Notes
    -----
    w = w_k sinh(u), u evenly spaced, w_k = 0.8 sqrt(g/max(B/2, T)): even at low and ever wider at high frequency.
    Four-point Lagrange interpolation then errs by less than 1e-4 of each curve's maximum and a cubic spline by less
    than 3e-5 (96 frequencies; a spline needs 60 for 1e-4).
    Source: measured on Lewis forms of [Lewis29], half breadths from 0.02 of the draught.  Valid: sections within the
    ship's breadth and draught.

    Examples
    --------
    >>> w = default_frequencies(20.0, 8.0)
    >>> len(w), round(float(w[0]), 4), round(float(w[-1]), 3)
    (96, 0.0198, 3.467)
    """
    for name, value in (("beam", beam), ("draught", draught)):
        if not (np.isfinite(value) and value > 0.0):
            raise InputError(f"{name} {value} m is not possible; give a positive number of metres")
    if count < 8:
        raise InputError(f"{count} frequencies are too few to interpolate between; give at least 8")
    knee = _KNEE * np.sqrt(GRAVITY / max(beam / 2.0, draught))
    ends: Floats = np.array(FREQUENCY_RANGE) * np.sqrt(2.0 * GRAVITY / beam)
    first, last = np.arcsinh(ends / knee)
    w = knee * np.sinh(np.linspace(first, last, count))
    w[0], w[-1] = ends
    return np.asarray(w)


def interpolate(table: SectionTable, frequency: ArrayLike) -> tuple[Floats, Floats]:
    """Coefficients of a table's sections between its frequencies, by cubic splines.

    Parameters
    ----------
    table : SectionTable
    frequency : (n,) float   w >= 0; below the lowest and above the highest the end values are held [rad/s]

    Returns
    -------
    (n, s, 3) float          a22, a24, a44
    (n, s, 3) float          b22, b24, b44; going to zero like w^5 below the lowest frequency

    Raises
    ------
    InputError               a frequency negative or not finite, or a table of fewer than four frequencies

    Notes
    -----
    Source: [Tasai61] coefficients of the table; b ~ w^5 as w -> 0.  Valid: tables on `default_frequencies`.

    Examples
    --------
    >>> import numpy as np
    >>> one = np.ones((1, 1))
    >>> half_circle = Strips(np.zeros(1), np.ones(1), one, one, one, one, np.ones(1), np.ones(1), np.full(1, np.pi / 2))
    >>> table = radiation_table(half_circle, default_frequencies(2.0, 1.0), density=1.0)
    >>> a, b = interpolate(table, [np.sqrt(9.81)])
    >>> round(float(a[0, 0, 0] / (np.pi / 2)), 4)
    0.3818
    """
    w = np.atleast_1d(np.asarray(frequency, dtype=float))
    if w.ndim != 1 or not (np.isfinite(w) & (w >= 0.0)).all():
        raise InputError(f"frequency {frequency!r} [rad/s]: give a list of finite numbers >= 0")
    if table.frequency.size < 4:
        raise InputError(f"a table of {table.frequency.size} frequencies cannot be interpolated; it needs at least 4")
    lowest, highest = table.frequency[0], table.frequency[-1]
    inside = np.clip(w, lowest, highest)
    curves = CubicSpline(table.frequency, np.concatenate([table.a, table.b], axis=-1), axis=0)(inside)
    fade = (np.minimum(w, lowest) / lowest) ** 5 if lowest > 0.0 else np.ones_like(w)
    return curves[..., :3], curves[..., 3:] * fade[:, None, None]
