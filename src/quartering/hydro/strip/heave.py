"""Heave of a hull's sections, each solved as its sway and roll were: on its Lewis form or on its own contour."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.cache import cached
from quartering._machine.digest import fingerprint, source_digest
from quartering.hull.lines.hull import Hull
from quartering.hull.lines.immersed import strips
from quartering.hull.lines.section import Floats
from quartering.hull.lines.strips import Strips, wholly_under_water
from quartering.hull.option_types import Sections
from quartering.hydro.section.closefit.coefficients import close_fit, close_fit_limits
from quartering.hydro.section.lewis import added_mass_at_infinite_frequency, lewis_forms
from quartering.hydro.section.multipole import CONTOUR_POINTS, radiation
from quartering.hydro.section.wavemaker import Complexes
from quartering.hydro.strip.table import REFINEMENT, SectionTable, default_frequencies, user_outlines

PANELS = REFINEMENT * (CONTOUR_POINTS + 1)
"""Panels on the half contour, as for sway and roll."""


class Heave(NamedTuple):
    """Heave of all sections of a hull, per metre of length.

    Parameters
    ----------
    a : (f, s) float             a33; infinite at w = 0 [kg/m]
    b : (f, s) float             b33 [kg/(m s)]
    a_infinite : (s,) float      limit of a33 for w -> infinity [kg/m]
    """

    a: Floats
    b: Floats
    a_infinite: Floats


def heave_sections(strips: Strips, table: SectionTable) -> Heave:
    """Added mass and damping in heave at the frequencies of a table.

    strips: the table was made from

    Source: [Ursell49], [Tasai61] on [Lewis29] forms; [Frank67] on a section's own contour.  Valid: as `radiation_table`.

    >>> from quartering.hull.lines.immersed import strips
    >>> from quartering.hull.lines.hull import box_hull
    >>> from quartering.hydro.strip.table import radiation_table
    >>> box = strips(box_hull(100.0, 20.0, 5.0, 10.0))
    >>> heave = heave_sections(box, radiation_table(box, [0.5], 1000.0))
    >>> heave.a.shape == (1, len(box.x)), round(float(heave.a_infinite[0] / 1000.0 / 100.0), 2)  # 2.14 is known exactly
    (True, 2.14)
    """
    if table.forms is not None:
        solved = radiation(table.forms, table.frequency, "heave", density=table.density)
        infinite = added_mass_at_infinite_frequency(table.forms, table.density)[1]
        return Heave(solved.added_mass[..., 0, 0], solved.damping[..., 0, 0], infinite)
    outlines, which = user_outlines(strips)
    solved = close_fit(outlines, table.frequency, "heave", density=table.density, panels=PANELS)
    *_, infinite = close_fit_limits(outlines, table.density, panels=PANELS)
    return Heave(solved.added_mass[:, which, 0, 0], solved.damping[:, which, 0, 0], infinite[which])


@dataclass(frozen=True, eq=False)
class HeaveTable:
    """Heave of all sections of a hull over frequency, with the potentials on their contours.

    On the contour, a33 + b33/(i w) = -2 density sum(psi nz).

    Parameters
    ----------
    frequency : (f,) float     ascending [rad/s]
    a, b : (f, s) float        a33 [kg/m], b33 [kg/(m s)]
    y, z, ny, nz : (s, n)      starboard contour, and outward normal times arc length weight [m]
    psi : (f, s, n) complex    potential per unit velocity [m]
    """

    frequency: Floats
    a: Floats
    b: Floats
    y: Floats
    z: Floats
    ny: Floats
    nz: Floats
    psi: Complexes


@lru_cache(maxsize=16)
def heave_table(hull: Hull, density: float) -> HeaveTable:
    """Heave coefficients and potentials of a hull's sections at the standard frequencies, kept on disk.

    hull: at its draught
    density: of the water [kg/m3]

    Close-fit coefficients are those of twice as many panels as the contour has points.
    Source: [Frank67], or [Tasai61] on [Lewis29] forms, by the hull's choice.  Valid: as `radiation_table`.

    >>> from quartering.hull.lines.hull import box_hull
    >>> table = heave_table(box_hull(100.0, 20.0, 5.0, 10.0), 1025.0)
    >>> bool(table.b.min() > -1e-6 * table.b.max())
    True
    """
    s, w = strips(hull), default_frequencies(hull.beam, hull.draught)
    content = (s.y, s.z, s.dy, s.dz, s.half_breadth, s.draught, s.area, w, float(density), hull.section_method)
    name = f"heave-{fingerprint([source_digest('hull', 'hydro'), *content])}"
    arrays = cached(name, lambda: _solved(s, w, density, hull.section_method))
    return HeaveTable(**arrays)


def _solved(s: Strips, w: Floats, density: float, method: Sections) -> dict[str, NDArray[Any]]:
    """Arrays of a heave table by name; equal sections are solved once."""
    if method == "lewis":
        kept = fine = radiation(lewis_forms(s.half_breadth, s.draught, s.area), w, "heave", density=density)
        which = np.arange(s.x.size)
    else:
        outlines, which = user_outlines(s)
        kept = close_fit(outlines, w, "heave", density=density, panels=CONTOUR_POINTS + 1)
        fine = close_fit(outlines, w, "heave", density=density, panels=PANELS)
    point, normal = kept.point[which], kept.normal[which]
    found = {
        "a": fine.added_mass[:, which, 0, 0],
        "b": fine.damping[:, which, 0, 0],
        "psi": kept.potential[..., 0][:, which],
    }
    under = wholly_under_water(s)
    for values in found.values():
        values[:, under] = 0.0  # of a bulb: its own flow alone would be far too strong
    place = {"y": point.real, "z": point.imag, "ny": normal.real, "nz": normal.imag}
    return {"frequency": w, **found, **{key: np.ascontiguousarray(value) for key, value in place.items()}}
