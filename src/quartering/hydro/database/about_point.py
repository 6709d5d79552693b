"""Transfer of a database to another reference point: axes, phases, headings.

Files have x to the bow, y to port, z up from the calm plane, and count the direction the wave runs towards from x to y. Ours:
y to starboard, z down, heading mu = -direction, and the surface at the point passes its mean level on the way down at t = 0.
Half a turn about x changes the sign of sway and yaw; per unit elevation the phasor is multiplied by i.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.hull.lines.section import Floats
from quartering.hydro.database.raw import RawDatabase
from quartering.hydro.transfer import transfer, transfer_matrix

HALF_TURN: Final = np.array([-1.0, 1.0, -1.0])
"""Sway, roll, yaw of file axes in ours."""


class AboutPoint(NamedTuple):
    """A database about a point, in our axes.

    Parameters
    ----------
    added_mass, damping : (f, 3, 3)    sway, roll, yaw, SI
    limits : mapping                   "zero", "infinite": (3, 3) added mass at those frequencies, where given
    heading : (h,) float               0 to 180, ascending; empty without forces [deg]
    forces : mapping                   of the database: (f, h, 3) phasors of e^{+i omega t} per metre of wave amplitude
    """

    added_mass: Floats
    damping: Floats
    limits: Mapping[str, Floats]
    heading: Floats
    forces: Mapping[str, NDArray[np.complex128]]


def moved_to_point(raw: RawDatabase, point: tuple[float, float], moments_about: tuple[float, float]) -> AboutPoint:
    """A file's database about a point, the surface there as the reference of the phases.

    point (x, z): wanted, in the file's axes [m]
    moments_about (x, z): point of the file's moments, in its axes [m]

    Source: [Abkowitz64], rigid-body kinematics; [Ancellin19], [WAMIT] conventions.

    >>> one = np.eye(3)[None]
    >>> raw = RawDatabase(np.ones(1), np.zeros(0), one, one, {}, 1025.0, 9.81)
    >>> moved_to_point(raw, (0.0, 2.0), (0.0, 0.0)).added_mass[0, 1].tolist()  # the force acts 2 m below the point
    [-2.0, 5.0, 0.0]
    """
    lever = moments_about[0] - point[0], point[1] - moments_about[1]

    def moved(matrix: Floats) -> Floats:
        return transfer(matrix * HALF_TURN[:, None] * HALF_TURN, *lever)

    heading, forces = np.zeros(0), {}
    if raw.forces:
        heading, order, sign = _headings(raw.direction)
        phase = incident(raw.frequency**2 / raw.gravity, point[0], raw.direction)[..., None]
        forces = {
            name: np.asarray(((phase * force * HALF_TURN) @ transfer_matrix(*lever))[:, order] * sign[:, None])
            for name, force in raw.forces.items()
        }
    limits = {name: moved(limit) for name, limit in raw.limits.items()}
    return AboutPoint(moved(raw.added_mass), moved(raw.damping), limits, heading, forces)


def incident(wavenumber: Floats, x: float, direction: Floats) -> NDArray[np.complex128]:
    """Factor (f, h) on a phasor per unit elevation at the file's origin: the elevation at x becomes i.

    wavenumber (f,): k [1/m]
    x: in the file's axes [m]
    direction (h,): the wave runs towards, from x to y of the file [deg]
    Returns (f, h)

    Source: [Ancellin19], [WAMIT] conventions.

    >>> complex(incident(np.ones(1), 0.0, np.zeros(1))[0, 0])
    1j
    """
    phase = wavenumber[:, None] * x * np.cos(np.radians(direction))
    return np.asarray(1j * np.exp(1j * phase))


def _headings(direction: Floats) -> tuple[Floats, NDArray[np.intp], Floats]:
    """Headings 0 to 180 deg once each, which direction each is, and the sign of the lateral forces there."""
    mu = (-direction + 180.0) % 360.0 - 180.0
    heading, order = np.unique(np.round(np.abs(mu), 9).astype(np.float64), return_index=True)
    chosen = mu[order]
    return heading, order, np.where((chosen < 0) & (chosen > -180.0), -1.0, 1.0)
