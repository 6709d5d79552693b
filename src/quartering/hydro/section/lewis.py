"""Lewis forms: sections that a two-parameter map makes from a circle, and their limits of added mass."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import InputError
from quartering.hull.lines.section import Floats

BREADTH_RATIO_LIMITS: Final = (0.02, 50.0)
"""Smallest and largest half breadth over draught of a form; thinner or flatter sections take the nearest."""
AREA_MARGINS: Final = (0.02, 0.05)
"""How far area coefficients keep from the two limits, as a share of the range: at the limits the contour has a cusp."""
SMALLEST_DRAUGHT: Final = 1e-6
"""Draught of a form that stands for a section without any extent [m]."""


@dataclass(frozen=True, eq=False)
class LewisForms:
    """Sections mapped from the unit circle: y + i z = M (xi + a1/xi + a3/xi^3), xi = exp(i theta).

    theta runs from 0 at the waterline (starboard) to pi/2 at the keel; z is down from the calm plane.

    Parameters
    ----------
    half_breadth : (s,) float     of the form, at the waterline [m]
    draught : (s,) float          of the form on the centre line [m]
    scale : (s,) float            M [m]
    a1, a3 : (s,) float           map coefficients [1]
    area_coefficient : (s,) float   of the form, immersed area / (2 half_breadth draught) [1]
    asked_area_coefficient : (s,) float   of the section it stands for, with the form's breadth and draught [1]
    clipped : (s,) bool           is the area that of the nearest admissible form, not the section's own
    stretched : (s,) bool         is the breadth or the draught that of the nearest admissible form
    """

    half_breadth: Floats
    draught: Floats
    scale: Floats
    a1: Floats
    a3: Floats
    area_coefficient: Floats
    asked_area_coefficient: Floats
    clipped: NDArray[np.bool_]
    stretched: NDArray[np.bool_]

    @property
    def area(self) -> Floats:
        """Immersed area of the forms, both sides [m2]."""
        return 2.0 * self.half_breadth * self.draught * self.area_coefficient

    @property
    def excess(self) -> Floats:
        """By how much the asked area coefficient misses the admissible range; 0 when it does not [1]."""
        return np.asarray(self.asked_area_coefficient - self.area_coefficient)


def area_coefficient_limits(breadth_ratio: ArrayLike) -> tuple[Floats, Floats]:
    """Smallest and largest area coefficient a Lewis form of given half breadth over draught may have.

    breadth_ratio (...): H = B/(2T) > 0 [1]
    Returns lower and upper limit [1]

    lower = (3 pi/32) (2 - min(H, 1/H)): below it the contour is re-entrant at the waterline or the keel;
    upper = (pi/32) (10 + H + 1/H): there dZ/dxi vanishes on the contour.
    Source: [Lewis29], limits of the two-parameter family.  Valid: any breadth ratio.
    """
    H = np.asarray(breadth_ratio, dtype=float)
    return 3.0 * np.pi / 32.0 * (2.0 - np.minimum(H, 1.0 / H)), np.pi / 32.0 * (10.0 + H + 1.0 / H)


def lewis_forms(half_breadth: ArrayLike, draught: ArrayLike, area: ArrayLike) -> LewisForms:
    """Lewis forms of the sections' half breadth, draught and immersed area, or the nearest admissible ones.

    half_breadth (s,): at the calm plane, >= 0 [m]
    draught (s,): depth of the deepest point, >= 0 [m]
    area (s,): immersed area, both sides, >= 0 [m2]
    Returns clipped where the area coefficient is outside its range, stretched where the breadth ratio is

    A section with no breadth at the waterline (a bulb, a submerged section) takes 0.02 of its draught as half breadth,
    one flatter than 50 takes a draught of half_breadth/50; the area is kept as far as the range allows. A section
    without any extent becomes a form of 1e-6 m.
    Source: [Lewis29].  Valid: contours without shoulders that breadth, draught and area do not see.
    """
    b, T, S = (
        _sizes(value, name) for value, name in ((half_breadth, "half breadth"), (draught, "draught"), (area, "area"))
    )
    b, T, S = (np.array(value) for value in np.broadcast_arrays(b, T, S))
    low, high = BREADTH_RATIO_LIMITS
    T_used = np.maximum(np.maximum(T, b / high), SMALLEST_DRAUGHT)
    b_used = np.maximum(b, low * T_used)
    asked = S / (2.0 * b_used * T_used)
    lower, upper = area_coefficient_limits(b_used / T_used)
    span = upper - lower
    used = np.clip(asked, lower + AREA_MARGINS[0] * span, upper - AREA_MARGINS[1] * span)
    a1, a3 = _map_coefficients(b_used / T_used, used)
    return LewisForms(
        half_breadth=b_used,
        draught=T_used,
        scale=b_used / (1.0 + a1 + a3),
        a1=a1,
        a3=a3,
        area_coefficient=used,
        asked_area_coefficient=asked,
        clipped=used != asked,
        stretched=(b_used != b) | (T_used != T),
    )


def _sizes(value: ArrayLike, name: str) -> Floats:
    sizes = np.atleast_1d(np.asarray(value, dtype=float))
    wrong = ~(np.isfinite(sizes) & (sizes >= 0.0))
    if wrong.any():
        first = int(np.flatnonzero(wrong.ravel())[0])
        raise InputError(
            f"section {first}: {name} {sizes.ravel()[first]:g} is not a size; give a finite number >= 0 in metres"
        )
    return sizes


def _map_coefficients(H: Floats, sigma: Floats) -> tuple[Floats, Floats]:
    ratio = (H - 1.0) / (H + 1.0)
    c = 3.0 + 4.0 * sigma / np.pi + (1.0 - 4.0 * sigma / np.pi) * ratio**2
    a3 = (3.0 - c + np.sqrt(np.maximum(9.0 - 2.0 * c, 0.0))) / c
    return ratio * (1.0 + a3), a3


def lewis_contour(forms: LewisForms, angle: Floats) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Contour points of Lewis forms and their normals, as complex numbers (y part + i z part).

    angle (n,): theta: 0 at the starboard waterline, pi/2 at the keel [rad]
    Returns (s, n): y + i z [m]; (s, n): (n_y + i n_z) ds/dtheta, n outward from the hull into the water [m/rad]

    (n_y + i n_z) ds = xi (dZ/dxi) dtheta.  Source: [Lewis29].  Valid: any form.
    """
    xi = np.exp(1j * angle)
    M, a1, a3 = forms.scale[:, None], forms.a1[:, None], forms.a3[:, None]
    return M * (xi + a1 / xi + a3 / xi**3), M * (xi - a1 / xi - 3.0 * a3 / xi**3)


def added_mass_at_zero_frequency(forms: LewisForms, density: float) -> Floats:
    """Sway and roll added mass of Lewis forms for w -> 0 (the free surface a rigid lid), about the waterline point.

    density: of the water [kg/m3]
    Returns (s, 3): a22 [kg/m], a24 [kg], a44 [kg m]; heave has no finite limit

    On the contour n_2 ds = M [(1-a1) cos t - 3 a3 cos 3t] dt, n_4 ds = M^2 [2 a1 (1+a3) sin 2t + 4 a3 sin 4t] dt and
    psi_2 = -M [(1-a1) cos t - a3 cos 3t]; a24 and a44 follow with int cos nt sin kt = k/(k^2-n^2), n odd, k even.
    Source: [Lewis29] for sway; [Tasai61], roll.  Valid: any form.
    """
    M, a1, a3 = forms.scale, forms.a1, forms.a3
    p, q = a1 * (1.0 + a3), a3
    n = np.arange(1.0, 801.0, 2.0)[:, None]
    a22 = np.pi / 2.0 * M**2 * ((1.0 - a1) ** 2 + 3.0 * a3**2)
    a24 = 2.0 * M**3 * ((1.0 - a1) * (4.0 / 3.0 * p + 16.0 / 15.0 * q) + a3 * (4.0 / 5.0 * p - 16.0 / 7.0 * q))
    a44 = 128.0 / np.pi * M**4 * ((p / (4.0 - n**2) + 4.0 * q / (16.0 - n**2)) ** 2 / n).sum(axis=0)
    return density * np.stack([a22, a24, a44], axis=-1)


def added_mass_at_infinite_frequency(forms: LewisForms, density: float) -> tuple[Floats, Floats]:
    """Added mass of Lewis forms for w -> infinity (zero potential on the free surface), about the waterline point.

    density: of the water [kg/m3]
    Returns (s, 3): a22 [kg/m], a24 [kg], a44 [kg m]; (s,): a33 [kg/m]

    psi_4 = -M^2 [a1 (1+a3) sin 2t + a3 sin 4t] on the contour gives a44 and, with n_2 ds, a24.
    Source: [Lewis29] for heave; [Tasai61], sway and roll.  Valid: any form.
    """
    M, a1, a3 = forms.scale, forms.a1, forms.a3
    p, q = a1 * (1.0 + a3), a3
    a22 = 2.0 / np.pi * M**2 * ((1.0 - a1 + a3) ** 2 + 16.0 / 3.0 * a3**2)
    a24 = 2.0 * M**3 * ((1.0 - a1) * (2.0 / 3.0 * p + 4.0 / 15.0 * q) + 3.0 * a3 * (2.0 / 5.0 * p - 4.0 / 7.0 * q))
    a44 = np.pi * M**4 * (p**2 + 2.0 * q**2)
    a33 = np.pi / 2.0 * M**2 * ((1.0 + a1) ** 2 + 3.0 * a3**2)
    return density * np.stack([a22, a24, a44], axis=-1), density * a33
