"""Raw results of a three-dimensional code in its own axes: one record for every format."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import InputError, RangeWarning
from quartering.hull.lines.section import Floats
from quartering.hydro.database.check import sway_phase
from quartering.option_checks import checked
from quartering.options import OPTIONS

GRAVITIES = (9.0, 10.5)
"""Range of the acceleration of gravity on this planet, as a file may round it [m/s2]."""


@dataclass(frozen=True, eq=False)
class RawDatabase:
    """Radiation and excitation in sway, roll, yaw as a file gives them, SI, phasors of e^{+i omega t}.

    File axes: x to the bow, y to port, z up from the calm plane; the wave runs towards ``direction``, counted from x to y,
    and its elevation at the file's origin is cos(omega t).

    Parameters
    ----------
    frequency : (f,) float              omega > 0, ascending [rad/s]
    direction : (h,) float              [deg]; empty without forces
    added_mass, damping : (f, 3, 3)     rows force, columns motion
    forces : mapping                    "froude_krylov" and "diffraction", or "total": (f, h, 3) per metre of amplitude
    density, gravity : float            [kg/m3], [m/s2]
    centre : (x, z) or None             point of the moments where the file says it [m]
    limits : mapping                    "zero", "infinite": (3, 3) added mass at those frequencies, where given
    """

    frequency: Floats
    direction: Floats
    added_mass: Floats
    damping: Floats
    forces: Mapping[str, NDArray[np.complex128]]
    density: float
    gravity: float
    centre: tuple[float, float] | None = None
    limits: Mapping[str, Floats] = field(default_factory=dict)


def needed_rows(path: str | Path, raw: RawDatabase) -> RawDatabase:
    """The database, refused when a frequency is missing, doubled or without finite values, or a number has no sense.

    path: file named in the message
    Returns as given, without limits that are not numbers
    """
    w = raw.frequency
    if w.size == 0:
        raise InputError(f"{path}: there are no frequencies in it; radiation results at 2 or more are needed")
    if not (np.isfinite(w).all() and (w > 0).all() and (np.diff(w) > 0).all()):
        raise InputError(f"{path}: frequencies {_few(w)} rad/s must be positive numbers, each once")
    _check_scalars(path, raw)
    fields = {"added mass": raw.added_mass, "damping": raw.damping, **raw.forces}
    for name, values in fields.items():
        bad = ~np.isfinite(values).reshape(w.size, -1).all(axis=1)
        if bad.any():
            missing = ", ".join(f"{one:.4g}" for one in w[bad][:3])
            raise InputError(
                f"{path}: {name} is missing or not a number at {int(bad.sum())} of {w.size} frequencies "
                f"(omega = {missing} rad/s); compute them, or leave those frequencies out of the file"
            )
    kept = {name: limit for name, limit in raw.limits.items() if np.isfinite(limit).all()}
    for name in raw.limits.keys() - kept.keys():
        warnings.warn(
            f"{path}: the added mass at {name} frequency is not a number; that limit is left out",
            RangeWarning,
            stacklevel=3,
        )
    for remark in sway_phase(w, raw.direction, raw.forces):
        warnings.warn(f"{path}: {remark}", RangeWarning, stacklevel=3)
    return replace(raw, limits=kept)


def _few(values: Floats, most: int = 6) -> str:
    """The first of many numbers, for a message."""
    return ", ".join(f"{one:.4g}" for one in values[:most]) + (", .." if values.size > most else "")


def _check_scalars(path: str | Path, raw: RawDatabase) -> None:
    """Refuse water, gravity, a point of the moments and directions that cannot be."""
    checked(OPTIONS["water_density"], raw.density, f"{path}: rho")
    if not GRAVITIES[0] <= raw.gravity <= GRAVITIES[1]:
        raise InputError(f"{path}: g = {raw.gravity:g} m/s2; it is from {GRAVITIES[0]:g} to {GRAVITIES[1]:g}; try 9.81")
    if raw.centre is not None and not np.isfinite(raw.centre).all():
        raise InputError(
            f"{path}: the point of the moments (rotation_center) is {raw.centre}; give numbers, or leave it out for the origin"
        )
    if not np.isfinite(raw.direction).all():
        raise InputError(f"{path}: a wave direction is not a number; give degrees or radians as its format asks")


def lateral_dofs(path: str | Path, found: Sequence[str], needed: Sequence[str]) -> None:
    """Refuse a file that lacks one of the lateral modes, naming it."""
    missing = [name for name in needed if name not in found]
    if missing:
        several = sorted({name.partition("__")[0] for name in found if "__" in name})
        if len(several) > 1:
            raise InputError(
                f"{path}: there are several bodies in it ({', '.join(several)}); results of one rigid body alone are needed"
            )
        raise InputError(
            f"{path}: mode {', '.join(missing)} is missing (there are {', '.join(found) or 'none'}); sway, roll and yaw of "
            "one rigid body are needed"
        )
