"""The section coefficients of a hull summed over its length, at any frequency.

The 2-D solution is found once per hull on a fixed set of frequencies and kept for the process; what the whole-ship
coefficients need of it are the integrals of x^0, x^1, x^2 times added mass and damping, splined in frequency.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from quartering._machine.piecewise import cubic_spline
from quartering.conventions import InputError
from quartering.hull.lines.hull import Hull
from quartering.hull.lines.immersed import strips
from quartering.hull.lines.section import Floats
from quartering.hull.lines.strips import has_transom
from quartering.hydro.strip.hull_table import hull_table
from quartering.hydro.strip.integrals import section_moments, shifted_moments
from quartering.hydro.strip.table import SectionTable, default_frequencies


@lru_cache(maxsize=8)
def section_table(hull: Hull, density: float) -> SectionTable:
    """Added mass, damping and potentials of all sections on the standard frequencies, kept for the process.

    hull: at its draught
    density: rho [kg/m3]
    Returns about the waterline point of each section, SI

    Source: [Tasai61] or [Frank67], by the hull's choice of section method; [Morino74] for three-dimensional ends.
    Valid: as `radiation_table`.
    """
    frequency = default_frequencies(hull.beam, hull.draught)
    return hull_table(hull, frequency, density)


class Moments(NamedTuple):
    """Integrals of added mass and damping about one point at some frequencies.

    Parameters
    ----------
    a, b : (n, 3, 3) float    power of x, then [22, 24, 44]; SI
    aft : two (n, 3, 3)       x_A^k a(x_A) and x_A^k b(x_A) of a transom, None for a pointed stern
    """

    a: Floats
    b: Floats
    aft: tuple[Floats, Floats] | None

    def about(self, x_g: float, z0: float) -> Moments:
        """The same about G.

        x_g: G forward of midship [m]
        z0: KG - T [m]

        Source: [STF70] section coefficients, moved rigidly.
        """
        aft = None if self.aft is None else tuple(shifted_moments(end, x_g, z0) for end in self.aft)
        ends = None if aft is None else (aft[0], aft[1])
        return Moments(shifted_moments(self.a, x_g, z0), shifted_moments(self.b, x_g, z0), ends)


@dataclass(frozen=True, eq=False)
class HullMoments:
    """Integrals of added mass and damping of a hull over frequency, about the waterline amidships.

    Parameters
    ----------
    spline : callable    of frequency, (4, 3, 3): a, b, then both of the aft end
    highest : float      frequency up to which the spline holds; it starts at 0 [rad/s]
    transom : bool       the aft end counts
    """

    spline: Callable[[Floats], Floats]
    highest: float
    transom: bool

    def at(self, frequency: ArrayLike) -> Moments:
        """Moments at given frequencies.

        frequency (n,): omega, >= 0; held at the upper end of the table [rad/s]
        Returns about the waterline amidships

        Source: [Frank67] sections, cubic spline in frequency.  Valid: as `default_frequencies`.
        """
        omega = np.asarray(frequency, dtype=float)
        if not (np.isfinite(omega).all() and (omega >= 0).all()):
            raise InputError(
                "frequencies must be finite and >= 0 rad/s; fold a negative encounter frequency to |omega|"
            )
        values = self.spline(np.minimum(omega, self.highest))
        a, b, aft_a, aft_b = (values[..., k, :, :] for k in range(4))
        return Moments(a, b, (aft_a, aft_b) if self.transom else None)


@lru_cache(maxsize=8)
def hull_moments(hull: Hull, density: float) -> HullMoments:
    """Integrals of the section coefficients of a hull, ready for any frequency; kept for the process.

    hull: at its draught
    density: rho [kg/m3]
    Returns about the waterline amidships

    Source: [STF70] integrals over the length; sections [Frank67].  Valid: as `radiation_table`.
    """
    immersed, table = strips(hull), section_table(hull, density)
    end = [hull.x_aft], [1.0]
    a = np.concatenate([table.a_zero[None], table.a])
    b = np.concatenate([np.zeros_like(table.b[:1]), table.b])
    parts = [section_moments(immersed.x, immersed.weight, c) for c in (a, b)]
    parts += [section_moments(*end, c[:, :1]) for c in (a, b)]
    return HullMoments(
        cubic_spline(np.concatenate([[0.0], table.frequency]), np.stack(parts, axis=1)),
        float(table.frequency[-1]),
        has_transom(immersed),
    )
