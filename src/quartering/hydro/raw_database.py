"""What a 3-D code's result file holds, before it is moved into our axes: one record for every format."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import InputError
from quartering.hull.section import Floats


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
    """The database, refused when a frequency is missing, doubled or without finite values.

    Parameters
    ----------
    path : str or Path    file named in the message
    raw : RawDatabase

    Returns
    -------
    RawDatabase    as given

    Raises
    ------
    InputError    no frequencies, not ascending, not positive; a value that is not finite: named by frequency

    Notes
    -----
    Source: none; a check.
    """
    w = raw.frequency
    if w.size == 0:
        raise InputError(f"{path}: there are no frequencies in it; radiation results at 2 or more are needed")
    if not (np.isfinite(w).all() and (w > 0).all() and (np.diff(w) > 0).all()):
        raise InputError(f"{path}: frequencies {w.tolist()} rad/s must be positive numbers, each once")
    fields = {"added mass": raw.added_mass, "damping": raw.damping, **raw.forces}
    for name, values in fields.items():
        bad = ~np.isfinite(values).reshape(w.size, -1).all(axis=1)
        if bad.any():
            missing = ", ".join(f"{one:.4g}" for one in w[bad][:3])
            raise InputError(
                f"{path}: {name} is missing or not a number at {int(bad.sum())} of {w.size} frequencies "
                f"(omega = {missing} rad/s); compute them, or leave those frequencies out of the file"
            )
    return raw


def lateral_dofs(path: str | Path, found: Sequence[str], needed: Sequence[str]) -> None:
    """Refuse a file that lacks one of the lateral modes, naming it.

    Raises
    ------
    InputError    a mode is missing

    Notes
    -----
    Source: a check of names.
    """
    missing = [name for name in needed if name not in found]
    if missing:
        raise InputError(
            f"{path}: mode {', '.join(missing)} is missing (there are {', '.join(found) or 'none'}); sway, roll and yaw of "
            "one rigid body are needed"
        )
