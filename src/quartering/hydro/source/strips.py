"""Strip theory as a source of hydrodynamics: sections on their own, or with three-dimensional ends."""

from __future__ import annotations

from functools import partial

import numpy as np

from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.bulb import bulb
from quartering.hull.lines.immersed import strips
from quartering.hull.lines.section import Floats
from quartering.hull.lines.strips import has_transom
from quartering.hull.ship import Ship
from quartering.hydro.source.record import Hydrodynamics
from quartering.hydro.strip.hull_table import end_method, hull_table, section_references, section_words
from quartering.hydro.strip.integrals import about_gravity_centre, section_moments
from quartering.hydro.strip.moments import Moments, hull_moments


def strip_source(ship: Ship) -> Hydrodynamics:
    """Hydrodynamics of a ship by strip theory, with the ends its hull asks for.

    Returns every frequency and heading held; wave forces from the potentials on the sections, in sway, roll, yaw

    Source: [STF70]; sections [Frank67], or [Tasai61] on Lewis forms; three-dimensional ends [Morino74].
    Valid: slender ships, deep water.

    >>> from quartering.hull.file.read import ship
    >>> strip_source(ship("wigley").with_(ends="strips")).words
    'the strips'
    """
    hull, ends = ship.hull, end_method(ship.hull)
    centre = hydrostatics(ship).lcb, ship.loading.kg - hull.draught
    sections = f"strip theory, {section_words(hull)}"
    corrections = ", ".join(words for words in (ends.words, bulb(hull).words) if words)
    return Hydrodynamics(
        ship=ship,
        kind="strip",
        words=f"the strips {corrections}".rstrip(),
        method=f"{sections}, {corrections}" if corrections else sections,
        references=("STF70", *section_references(hull), *ends.references),
        force_words=corrections,
        force_references=("H71", "STF70", *ends.references),
        centre=centre,
        radiation=partial(hull_moments, hull, ship.loading.density),
        solved=partial(_solved, ship, centre),
    )


def _solved(ship: Ship, centre: tuple[float, float], frequency: Floats) -> Moments:
    """Integrals about G, the sections solved at the very frequencies."""
    hull, immersed, (x_g, z0) = ship.hull, strips(ship.hull), centre
    ascending, back = np.unique(frequency, return_inverse=True)
    table = hull_table(hull, ascending, ship.loading.density)
    a, b = (about_gravity_centre(c[back], z0) for c in (table.a, table.b))
    x, end = immersed.x - x_g, ([hull.x_aft - x_g], [1.0])
    aft = (section_moments(*end, a[:, :1]), section_moments(*end, b[:, :1])) if has_transom(immersed) else None
    return Moments(section_moments(x, immersed.weight, a), section_moments(x, immersed.weight, b), aft)
