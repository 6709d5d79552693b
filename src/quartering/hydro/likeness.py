"""How far a section's own contour lies from the Lewis form of its breadth, draught and area."""

from __future__ import annotations

from typing import Final

import numpy as np

from quartering.hull.section import Floats
from quartering.hydro.lewis import LewisForms, lewis_contour
from quartering.hydro.outline import Outline

LEWIS_LIKE: Final = 0.01
"""Largest distance of a Lewis-like contour from its Lewis form, over the square root of its area [1]."""
_SAMPLES: Final = 96


def contour_difference(outline: Outline, forms: LewisForms, index: int = 0) -> float:
    """Largest distance of a section's contour from the contour of a Lewis form, over the root of the form's area.

    Parameters
    ----------
    outline : Outline     of the section
    forms : LewisForms
    index : int           which of the forms

    Returns
    -------
    float                 0 when they coincide [1]

    Notes
    -----
    From 96 points of the section to the nearest side of a polygon on the form, to a few 1e-4.
    Source: geometry; forms of [Lewis29].  Valid: any contour.

    Examples
    --------
    >>> from quartering.hull.section import Section
    >>> from quartering.hydro.lewis import lewis_forms
    >>> from quartering.hydro.outline import section_outline
    >>> box = section_outline(Section(y=[0.0, 1.0, 1.0], z=[1.0, 1.0, 0.0]))
    >>> round(contour_difference(box, lewis_forms([1.0], [1.0], [2.0])), 3)
    0.062
    """
    chord = np.linspace(outline.corners[0], outline.corners[-1], _SAMPLES)
    y, z, *_ = outline.at(np.union1d(chord, outline.corners))
    points, _ = lewis_contour(forms, np.linspace(0.0, np.pi / 2.0, _SAMPLES))
    return float(_distance(y + 1j * z, points[index]).max() / np.sqrt(forms.area[index]))


def _distance(point: np.ndarray, corner: np.ndarray) -> Floats:
    """Distance of points from a polygon."""
    start, side = corner[:-1], np.diff(corner)
    gap = point[:, None] - start
    share = np.clip((gap * side.conj()).real / np.abs(side) ** 2, 0.0, 1.0)
    return np.asarray(np.abs(gap - share * side).min(axis=1))
