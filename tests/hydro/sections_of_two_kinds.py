"""Sections as an earlier state of the library chose them: the Lewis form where the contour lies within 1 % of it, else its own.

The reference of ships in steep waves was made on tables of that kind.
"""

from dataclasses import replace

import numpy as np

from quartering.hydro.section.lewis import lewis_contour, lewis_forms
from quartering.hydro.strip.table import radiation_table, user_outlines

LEWIS_LIKE = 0.01
"""Largest distance of a Lewis-like contour from its form, over the root of its area."""
_SAMPLES = 96


def lewis_like(strips):
    """Which sections (s,) lie within 1 % of their Lewis form."""
    outlines, which = user_outlines(strips)
    forms = lewis_forms(strips.half_breadth, strips.draught, strips.area)
    corners, _ = lewis_contour(forms, np.linspace(0.0, np.pi / 2.0, _SAMPLES))
    like = ~(forms.clipped | forms.stretched)
    for s in range(strips.x.size):
        outline = outlines[which[s]]
        chord = np.linspace(outline.corners[0], outline.corners[-1], _SAMPLES)
        y, z, *_ = outline.at(np.union1d(chord, outline.corners))
        start, side = corners[s][:-1], np.diff(corners[s])
        gap = (y + 1j * z)[:, None] - start
        share = np.clip((gap * side.conj()).real / np.abs(side) ** 2, 0.0, 1.0)
        like[s] &= np.abs(gap - share * side).min(axis=1).max() < LEWIS_LIKE * np.sqrt(forms.area[s])
    return like


def table_of_two_kinds(strips, frequency, density, **_):
    """`radiation_table` with each section's coefficients from its Lewis form or its own contour, as `lewis_like` says."""
    like = lewis_like(strips)
    own, form = (radiation_table(strips, frequency, density, method=method) for method in ("close-fit", "lewis"))

    def chosen(name: str, axis: int):
        a, b = getattr(form, name), getattr(own, name)
        return np.where(like.reshape((1,) * axis + (-1,) + (1,) * (a.ndim - axis - 1)), a, b)

    by_frequency = {name: chosen(name, 1) for name in ("a", "b", "psi")}
    by_section = {name: chosen(name, 0) for name in ("y", "z", "ny", "nz", "a_zero", "a_infinite")}
    return replace(own, **by_frequency, **by_section)
