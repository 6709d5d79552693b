"""The section coefficients and contour potentials of a whole hull over frequency."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Final, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering._machine.cache import cached
from quartering._machine.digest import fingerprint, source_digest
from quartering.conventions import GRAVITY, InputError
from quartering.hull.lines.section import Floats
from quartering.hull.lines.strips import Strips, wholly_under_water
from quartering.hull.option_types import Sections
from quartering.hydro.section.closefit.check import warn_of_mismatch, worst
from quartering.hydro.section.closefit.coefficients import close_fit, close_fit_limits
from quartering.hydro.section.lewis import (
    LewisForms,
    added_mass_at_infinite_frequency,
    added_mass_at_zero_frequency,
    lewis_forms,
)
from quartering.hydro.section.multipole import CONTOUR_POINTS, Radiation, radiation
from quartering.hydro.section.outline import Outline, strip_outline
from quartering.hydro.section.wavemaker import Complexes

FREQUENCY_RANGE: Final = (0.02, 3.5)
"""Lowest and highest w sqrt(B/2g) of the standard frequencies [1]."""
STANDARD_FREQUENCIES: Final = 96
REFINEMENT: Final = 2
"""Panels of a close-fit solution for added mass and damping, over those on whose ends its potentials are kept."""
FEWEST_KEPT: Final = 8
"""Frequencies from which on a table is kept on disk: fewer are solved as fast as read."""
_KNEE: Final = 0.8


@dataclass(frozen=True, eq=False)
class SectionTable:
    """Sway and roll coefficients and contour potentials of all sections of a hull, about their waterline points.

    Axes y to starboard, z down from the calm plane; phasors e^{+i w t}; per metre of length, both sides. The contour is
    the section's own or, with Lewis forms, theirs. On it, from the waterline to the keel,
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
    forms : LewisForms or None   that the sections were solved on, with those that had to be replaced by the nearest
                                 admissible one; None when all were solved on their own contours
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
    forms: LewisForms | None
    density: float


def radiation_table(
    strips: Strips, frequency: ArrayLike, density: float, *, points: int = CONTOUR_POINTS, method: Sections = "auto"
) -> SectionTable:
    """Section coefficients in sway and roll of a hull's strips.

    strips: (s,) sections
    frequency (f,): w >= 0, ascending [rad/s]
    density: of the water, > 0 [kg/m3]
    points: points on the half contour, at least 18
    method: "auto" and "close-fit" solve each section on its own contour, "lewis" on the Lewis form of its breadth,
        draught and area.

    A table of 8 frequencies or more is kept on disk (`quartering._machine.cache`) by its content and that of the source.
    At w = 0 the damping is zero and the potentials are those under a rigid lid. Close-fit coefficients are those of twice
    as many panels as the contour has points; the potentials integrate to them within 1e-3 (5e-3 on offsets with kinks).
    Source: [Tasai61] sections in sway and roll by [Lewis29] forms; [Frank67] on their own contours.
    Sections wholly under water, of a bulb ahead of the stem, are left out: their coefficients are zero.
    Valid: deep water, nu B/2 < 20.
    """
    w = np.atleast_1d(np.asarray(frequency, dtype=float))
    if w.ndim != 1 or not (np.diff(w) > 0.0).all():
        raise InputError(f"frequencies must be one list in ascending order [rad/s]; given {frequency!r}")
    if not (np.isfinite(density) and density > 0.0):
        raise InputError(f"water density {density} kg/m3 is not possible; give a positive number, 1025 for sea water")
    if method not in get_args(Sections):
        raise InputError(f"method {method!r} is unknown; allowed: {', '.join(get_args(Sections))}")
    found = dict(_found(strips, w, density, points, "lewis" if method == "lewis" else "close-fit"))
    names = [f"section {i + 1} (x = {x:g} m)" for i, x in enumerate(strips.x)]
    under = wholly_under_water(strips)
    mismatch = found.pop("mismatch")
    warn_of_mismatch(np.where(under, 0.0, mismatch), names, stacklevel=2)
    if under.any():
        found = {name: np.array(values) for name, values in found.items()}
        for name in ("a", "b", "psi"):
            found[name][:, under] = 0.0
        for name in ("a_zero", "a_infinite"):
            found[name][under] = 0.0
    return _table(found, density)


def _found(strips: Strips, w: Floats, density: float, points: int, method: Sections) -> Mapping[str, NDArray[Any]]:
    """Arrays of a table by name, from disk where they are worth keeping."""
    solved = _of_lewis_forms if method == "lewis" else _of_own_contours
    if w.size < FEWEST_KEPT:
        return solved(strips, w, density, points)
    s = strips
    content = (s.y, s.z, s.dy, s.dz, s.half_breadth, s.draught, s.area, w, float(density), points, method)
    name = f"sections-{fingerprint([source_digest('hull', 'hydro'), *content])}"
    return cached(name, lambda: solved(strips, w, density, points))


def _of_lewis_forms(strips: Strips, w: Floats, density: float, points: int) -> dict[str, NDArray[Any]]:
    """Arrays of a table by name; those of its Lewis forms after "forms."."""
    forms = lewis_forms(strips.half_breadth, strips.draught, strips.area)
    solution = radiation(forms, w, "lateral", density=density, points=points)
    zero = added_mass_at_zero_frequency(forms, density)
    infinite = added_mass_at_infinite_frequency(forms, density)[0]
    shapes = {f"forms.{field.name}": getattr(forms, field.name) for field in fields(forms)}
    return _arrays(w, solution, zero, infinite, np.zeros((2, forms.scale.size))) | shapes


def _of_own_contours(strips: Strips, w: Floats, density: float, points: int) -> dict[str, NDArray[Any]]:
    """Arrays of a table by name; equal sections are solved once."""
    outlines, which = user_outlines(strips)
    kept = close_fit(outlines, w, "lateral", density=density, panels=points + 1)
    fine = close_fit(outlines, w, "lateral", density=density, panels=REFINEMENT * (points + 1))
    zero, infinite, _ = close_fit_limits(outlines, density, panels=REFINEMENT * (points + 1))
    values = {
        name: getattr(fine if name in ("added_mass", "damping") else kept, name)
        for name in Radiation.__dataclass_fields__
    }
    solution = Radiation(**{n: v[which] if n in ("point", "normal") else v[:, which] for n, v in values.items()})
    return _arrays(w, solution, zero[which], infinite[which], worst(fine.residual, w)[:, which])


def _arrays(
    w: Floats, solution: Radiation, zero: Floats, infinite: Floats, mismatch: Floats
) -> dict[str, NDArray[Any]]:
    return {
        "frequency": w,
        "a": _triplet(solution.added_mass),
        "b": _triplet(solution.damping),
        "y": solution.point.real,
        "z": solution.point.imag,
        "ny": solution.normal.real,
        "nz": solution.normal.imag,
        "psi": solution.potential,
        "a_zero": zero,
        "a_infinite": infinite,
        "mismatch": mismatch,
    }


def _table(arrays: Mapping[str, NDArray[Any]], density: float) -> SectionTable:
    """Table of named arrays, contiguous so that no kernel is compiled for another layout."""
    flat = {name: np.ascontiguousarray(value) for name, value in arrays.items()}
    shapes = {name.removeprefix("forms."): flat.pop(name) for name in arrays if name.startswith("forms.")}
    return SectionTable(**flat, forms=LewisForms(**shapes) if shapes else None, density=float(density))


def user_outlines(strips: Strips) -> tuple[list[Outline], NDArray[np.intp]]:
    """Outlines of a hull's sections, each once.

    strips: (s,) sections
    Returns the different ones, in the order of the sections; (s,): which of them each section has
    """
    s = strips
    number: dict[bytes, int] = {}
    contour = np.concatenate([s.y, s.z, s.dy, s.dz, s.half_breadth[:, None], s.draught[:, None]], axis=1)
    which = [number.setdefault(row.tobytes(), len(number)) for row in contour]
    return [_user_outline(strips, which.index(k)) for k in range(len(number))], np.array(which, dtype=np.intp)


def _user_outline(strips: Strips, section: int) -> Outline:
    """Outline of one section, counted from 0."""
    s, i = strips, section
    called = f"section {i + 1} (x = {s.x[i]:g} m)"
    return strip_outline(s.y[i], s.z[i], s.dy[i], s.dz[i], float(s.half_breadth[i]), float(s.draught[i]), called)


def _triplet(matrix: Floats) -> Floats:
    return np.stack([matrix[..., 0, 0], matrix[..., 0, 1], matrix[..., 1, 1]], axis=-1)


def default_frequencies(beam: float, draught: float, count: int = STANDARD_FREQUENCIES) -> Floats:
    """Frequencies between which the coefficients of all sections of a ship may be read by cubic interpolation.

    beam, draught: of the ship, > 0 [m]
    count: how many, at least 8
    Returns (count,): ascending, w sqrt(B/2g) from 0.02 to 3.5 [rad/s]

    w = w_k sinh(u), u evenly spaced, w_k = 0.8 sqrt(g/max(B/2, T)): even at low and ever wider at high frequency.
    Four-point Lagrange interpolation then errs by less than 1e-4 of each curve's maximum and a cubic spline by less
    than 3e-5 (96 frequencies; a spline needs 60 for 1e-4).
    Source: measured on Lewis forms of [Lewis29], half breadths from 0.02 of the draught.  Valid: sections within the
    ship's breadth and draught.
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
