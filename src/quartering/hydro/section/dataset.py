"""Added mass and damping of one section over frequency, as a labelled dataset."""

from __future__ import annotations

import warnings
from typing import Final, get_args

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from quartering.conventions import WATER_DENSITY, InputError, RangeWarning
from quartering.doors import takes
from quartering.hull.lines.section import Floats, Section
from quartering.hull.option_types import Sections
from quartering.hull.told import count, number, numbers
from quartering.hydro.section.closefit.check import warn_of_mismatch, worst
from quartering.hydro.section.closefit.coefficients import close_fit
from quartering.hydro.section.lewis import LewisForms, area_coefficient_limits, lewis_forms
from quartering.hydro.section.multipole import Radiation, radiation
from quartering.hydro.section.outline import section_outline

PANELS: Final = 50
"""Panels on the half contour: within 0.3 % on flat forms with sharp bilges, on which 25 miss heave by 2 %."""
_VARIABLES: Final = {
    "a22": ("kg m-1", "sway added mass per metre of length"),
    "b22": ("kg m-1 s-1", "sway wave damping per metre of length"),
    "a24": ("kg", "sway-roll added mass per metre of length"),
    "b24": ("kg s-1", "sway-roll wave damping per metre of length"),
    "a44": ("kg m", "roll added moment of inertia per metre of length"),
    "b44": ("kg m s-1", "roll wave damping per metre of length"),
    "a33": ("kg m-1", "heave added mass per metre of length"),
    "b33": ("kg m-1 s-1", "heave wave damping per metre of length"),
}


@takes(section="Section")
def section_coefficients(
    section: Section,
    frequency: ArrayLike,
    method: Sections = "auto",
    *,
    density: float | str = WATER_DENSITY,
    panels: int = PANELS,
) -> xr.Dataset:
    """Added mass and wave damping of a section in sway, roll and heave, about its waterline point.

    Parameters
    ----------
    section : Section
    frequency : (f,) float   w >= 0 [rad/s]
    method : "auto", "lewis" or "close-fit"
        "auto" and "close-fit" solve the section on its own contour, "lewis" on the Lewis form of its breadth, draught
        and immersed area.
    density : float          of the water, > 0 [kg/m3]
    panels : int             on the half contour, for close-fit

    Returns
    -------
    xr.Dataset               a22 b22 a24 b24 a44 b44 a33 b33 over frequency, SI per metre of length, axes z down;
                             a33 is infinite at w = 0; attribute `method` names the one used: close-fit or lewis

    Raises
    ------
    InputError               unknown method; a frequency negative or not finite; density not positive; a contour that
                             is open, crosses itself, starts above the water or has no breadth (not for "lewis")

    Warns
    -----
    RangeWarning             the contour is not resolved: damping by pressure and by waves differ by more than 3 %;
                             a Lewis form was asked for and there is none of these sizes, so the nearest stands for it:
                             no breadth at the waterline (0.02 of the draught is taken as half breadth) or an area
                             outside the forms' range

    Notes
    -----
    Source: [Ursell49], [Tasai61] multipoles on [Lewis29] forms; [Frank67] on the section's own contour.
    Valid: deep water, nu B/2 < 20; Lewis forms for surface-piercing sections without marked shoulders.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.linspace(0.0, np.pi / 2, 200)
    >>> circle = Section(y=np.sin(t), z=np.cos(t))
    >>> ds = section_coefficients(circle, [np.sqrt(9.81)])
    >>> round(float(ds.a22[0]) / (1025.0 * np.pi / 2), 3), ds.a22.attrs["units"]
    (0.382, 'kg m-1')
    """
    if method not in get_args(Sections):
        raise InputError(f"method {method!r} is unknown; allowed: {', '.join(get_args(Sections))}")
    density, panels = number(None, "density", density), count("panels", panels, 2, PANELS, 1000)
    w = np.atleast_1d(numbers(None, "frequency", frequency))
    if method == "lewis":
        forms = lewis_forms(section.half_breadth, section.draught, immersed_area(section))
        remark = _remark(forms)
        if remark:
            warnings.warn(remark, RangeWarning, stacklevel=2)
        lateral = radiation(forms, w, "lateral", density=density)
        heave = radiation(forms, w, "heave", density=density)
        return _dataset(w, lateral, heave, density, _words_of_forms(forms) | {"remark": remark})
    outline = section_outline(section)
    lateral = close_fit([outline], w, "lateral", density=density, panels=panels)
    heave = close_fit([outline], w, "heave", density=density, panels=panels)
    residual = np.concatenate([lateral.residual, heave.residual], axis=-1)
    warn_of_mismatch(worst(residual, w), ["the section"], stacklevel=2)
    return _dataset(w, lateral, heave, density, {"method": "close-fit", "remark": "", "references": "Frank67, Kress90"})


def immersed_area(section: Section) -> float:
    """Area of a section below the calm plane, both sides.

    Returns [m2]

    2 |int y dz| over the polyline, cut at z = 0 and closed to the centre plane.
    Source: Green's theorem; used with [Lewis29] forms.  Valid: any contour that does not cross itself.
    """
    y, z = section.y, section.z
    inside = np.maximum(z, 0.0)
    # the part of each piece below z = 0: half breadth where it crosses, linear in between
    crossing = z[:-1] * z[1:] < 0.0
    step = np.where(crossing, z[:-1] - z[1:], 1.0)
    cut = y[:-1] + (y[1:] - y[:-1]) * np.where(crossing, z[:-1] / step, 0.0)
    y0 = np.where(crossing & (z[:-1] < 0.0), cut, y[:-1])
    y1 = np.where(crossing & (z[1:] < 0.0), cut, y[1:])
    return float(abs(np.sum((y0 + y1) * (inside[:-1] - inside[1:]))))


def _remark(forms: LewisForms) -> str:
    parts = []
    if forms.stretched[0]:
        parts.append(
            f"half breadth {forms.half_breadth[0]:.4g} m and draught {forms.draught[0]:.4g} m are taken for its own "
            "(half breadth is kept between 0.02 and 50 times the draught)"
        )
    if forms.clipped[0]:
        lower, upper = area_coefficient_limits(forms.half_breadth / forms.draught)
        parts.append(
            f"area coefficient {forms.asked_area_coefficient[0]:.3f} is outside the range of Lewis forms of its "
            f"breadth and draught ({lower[0]:.3f} to {upper[0]:.3f}); {forms.area_coefficient[0]:.3f} is taken, "
            f"off by {abs(forms.excess[0]):.3f}"
        )
    return "the section is not Lewis-like: " + "; ".join(parts) if parts else ""


def _words_of_forms(forms: LewisForms) -> dict[str, str | float]:
    """Attributes of a dataset of a Lewis form."""
    return {
        "method": "lewis",
        "references": "Ursell49, Tasai61, Lewis29",
        "lewis_half_breadth": float(forms.half_breadth[0]),
        "lewis_draught": float(forms.draught[0]),
        "lewis_area_coefficient": float(forms.area_coefficient[0]),
    }


def _dataset(
    w: Floats, lateral: Radiation, heave: Radiation, density: float, said: dict[str, str | float]
) -> xr.Dataset:
    values = {"a33": heave.added_mass[:, 0, 0, 0], "b33": heave.damping[:, 0, 0, 0]}
    for modes, i, j in (("22", 0, 0), ("24", 0, 1), ("44", 1, 1)):
        values["a" + modes] = lateral.added_mass[:, 0, i, j]
        values["b" + modes] = lateral.damping[:, 0, i, j]
    variables = {
        name: ("frequency", values[name], {"units": unit, "long_name": meaning, "symbol": f"{name[0]}_{name[1:]}"})
        for name, (unit, meaning) in _VARIABLES.items()
    }
    axis = ("frequency", w, {"units": "rad s-1", "long_name": "frequency", "symbol": "omega"})
    attributes = {
        "axes": "y to starboard, z down",
        "reference_point": "centre of the waterline of the section",
        "time_factor": "exp(+i omega t)",
        "water_density": density,
        "water_density_units": "kg m-3",
        **said,
    }
    return xr.Dataset(variables, coords={"frequency": axis}, attrs=attributes)
