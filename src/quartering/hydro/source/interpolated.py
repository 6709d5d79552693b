"""Interpolation of tabulated coefficients and forces over frequency and heading."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.hull.lines.section import Floats
from quartering.hydro.strip.moments import HullMoments

if TYPE_CHECKING:
    from scipy.interpolate import RectBivariateSpline

Phasors = NDArray[np.complex128]
FEWEST_HEADINGS = 4


def tabled_moments(frequency: Floats, added_mass: Floats, damping: Floats, zero: Floats | None) -> HullMoments:
    """Added mass and damping of a ship over frequency, in the form strip theory has them: integrals over the length.

    frequency (f,): ascending, above 0 [rad/s]
    added_mass, damping (f, 3, 3): sway, roll, yaw about midship at the calm plane, SI
    zero (3, 3): added mass at zero frequency; None: as at the lowest
    Returns splines from zero frequency, where the damping vanishes; no aft end
    """
    from scipy.interpolate import CubicSpline

    slow = added_mass[0] if zero is None else zero
    a = _integrals(np.concatenate([slow[None], added_mass]))
    b = _integrals(np.concatenate([np.zeros((1, 3, 3)), damping]))
    none = np.zeros_like(a)
    spline = CubicSpline(np.concatenate([[0.0], frequency]), np.stack([a, b, none, none], axis=1))
    return HullMoments(spline, float(frequency[-1]), transom=False)


def _integrals(matrix: Floats) -> Floats:
    """Longitudinal moments (n, 3, 3) equivalent to given sway-roll-yaw matrices; entries they do not determine are 0."""
    m = (matrix + matrix.swapaxes(-1, -2)) / 2
    out = np.zeros_like(m)
    out[:, 0] = np.stack([m[:, 0, 0], m[:, 0, 1], m[:, 1, 1]], axis=-1)
    out[:, 1, :2] = np.stack([m[:, 0, 2], m[:, 1, 2]], axis=-1)
    out[:, 2, 0] = m[:, 2, 2]
    return out


class Surfaces(NamedTuple):
    """Splines over wave frequency and heading of one force: cos and sin parts of each mode."""

    name: str
    parts: tuple[tuple[RectBivariateSpline, RectBivariateSpline], ...]

    def at(self, frequency: Floats, heading: Floats) -> Phasors:
        """Phasors (n, modes)."""
        columns = [re.ev(frequency, heading) + 1j * im.ev(frequency, heading) for re, im in self.parts]
        return np.stack(columns, axis=-1)


def force_surfaces(frequency: Floats, heading: Floats, forces: Mapping[str, Phasors]) -> tuple[Surfaces, ...]:
    """Splines of lateral forces; at 0 and 180 deg these vanish and go on with reversed sign.

    frequency (f,): of the wave, ascending [rad/s]
    heading (h,): 0 to 180, ascending, at least `FEWEST_HEADINGS` [deg]
    forces: by name: (f, h, modes) phasors per metre of wave amplitude
    Returns one a force

    >>> waves, mu = np.arange(1.0, 6.0), np.arange(0.0, 181.0, 10.0)
    >>> beam = np.sin(np.radians(mu))[None, :, None] * np.ones((5, 1, 1)) + 0j
    >>> one, = force_surfaces(waves, mu, {"diffraction": beam})
    >>> bool(abs(one.at(np.array([2.5]), np.array([33.0]))[0, 0] - np.sin(np.radians(33.0))) < 1e-5)
    True
    """
    from scipy.interpolate import RectBivariateSpline

    found = []
    for name, force in forces.items():
        beyond, values = _mirrored(heading, force)
        parts = tuple(
            (
                RectBivariateSpline(frequency, beyond, values[..., k].real),
                RectBivariateSpline(frequency, beyond, values[..., k].imag),
            )
            for k in range(values.shape[-1])
        )
        found.append(Surfaces(name, parts))
    return tuple(found)


def _mirrored(heading: Floats, force: Phasors) -> tuple[Floats, Phasors]:
    """Headings and forces continued beyond 0 and 180 deg, where the table reaches so far."""
    beyond = min(3, heading.size - 1)
    if np.isclose(heading[-1], 180.0):
        near = slice(-2, -2 - beyond, -1)
        heading = np.concatenate([heading, 360.0 - heading[near]])
        force = np.concatenate([force, -force[:, near]], axis=1)
    if np.isclose(heading[0], 0.0):
        near = slice(beyond, 0, -1)
        heading = np.concatenate([-heading[near], heading])
        force = np.concatenate([-force[:, near], force], axis=1)
    return heading, force
