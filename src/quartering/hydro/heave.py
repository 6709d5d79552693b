"""Heave of a hull's sections, each solved as its sway and roll were: on its Lewis form or on its own contour."""

from __future__ import annotations

from typing import NamedTuple

from quartering.hull.section import Floats
from quartering.hull.strips import Strips
from quartering.hydro.closefit import close_fit, close_fit_limits
from quartering.hydro.lewis import added_mass_at_infinite_frequency
from quartering.hydro.multipole import CONTOUR_POINTS, radiation
from quartering.hydro.table import REFINEMENT, SectionTable, own_outlines

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

    Parameters
    ----------
    strips : Strips         the table was made from
    table : SectionTable

    Returns
    -------
    Heave

    Notes
    -----
    Source: [Ursell49], [Tasai61] on [Lewis29] forms; [Frank67] on a section's own contour.  Valid: as `radiation_table`.

    Examples
    --------
    >>> from quartering.hull.immersed import strips
    >>> from quartering.hull.offsets import box_hull
    >>> from quartering.hydro.table import radiation_table
    >>> box = strips(box_hull(100.0, 20.0, 5.0, 10.0))
    >>> heave = heave_sections(box, radiation_table(box, [0.5], 1000.0))
    >>> heave.a.shape == (1, len(box.x)), round(float(heave.a_infinite[0] / 1000.0 / 100.0), 2)  # 2.14 is known exactly
    (True, 2.14)
    """
    if table.forms is not None:
        solved = radiation(table.forms, table.frequency, "heave", density=table.density)
        infinite = added_mass_at_infinite_frequency(table.forms, table.density)[1]
        return Heave(solved.added_mass[..., 0, 0], solved.damping[..., 0, 0], infinite)
    outlines, which = own_outlines(strips)
    solved = close_fit(outlines, table.frequency, "heave", density=table.density, panels=PANELS)
    *_, infinite = close_fit_limits(outlines, table.density, panels=PANELS)
    return Heave(solved.added_mass[:, which, 0, 0], solved.damping[:, which, 0, 0], infinite[which])
