"""The 23 figures of the paper by number: what each is, and how it is drawn."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Final, NamedTuple

import xarray as xr
from matplotlib.figure import Figure

from quartering.hull.file.read import ship
from quartering.hull.ship import Ship
from quartering.loads.waves import Wave
from quartering.study.paper.conditions import FROUDE, INSTABILITY_HEADING, MARINER_FROUDE, speed_of
from quartering.study.paper.duffing import duffing_curves
from quartering.study.paper.model import FEEDING
from quartering.study.paper.sets import (
    CB60,
    CB70,
    CHECK_HEADING,
    DUFFING,
    MARINER,
    coefficients_of,
    forces_of,
    growing_cases,
    gyradii_of,
    heights_of,
    instability_wave,
    integration_of,
    responses_of,
)
from quartering.view.plots.duffing import duffing_picture
from quartering.view.plots.forces import forces_picture
from quartering.view.plots.paper_axes import axes_picture
from quartering.view.plots.paper_caption import OURS, force_caption
from quartering.view.plots.paper_curves import (
    coefficient_picture,
    loading_picture,
    response_picture,
    stability_picture,
)
from quartering.view.plots.paper_motions import growth_picture, integration_picture
from quartering.view.wording import speed_words, steepness_words

_SUBSTITUTE = (
    "No offsets of the Mariner are public: the lines are those of Series 60 CB 0.60 stretched to its length, beam and draught. "
    "Its sway-yaw set is measured (Chislett and Strøm-Tejsen 1965), with the roll force taken at half draught."
)


class PaperFigure(NamedTuple):
    """A figure of the paper: what it shows, and a function that draws it under a title."""

    words: str
    draw: Callable[[str], Figure]


def _growth(linear: bool, title: str) -> Figure:
    one = ship(CB60)
    note = (
        f"{_where(one, instability_wave(one))}, heading {INSTABILITY_HEADING:g} deg. {OURS} Coefficients estimated "
        "(cross-flow drag, regression); the unit, inertia and linear coefficients of Table I are not printed, so its ratios "
        f"are applied to ours. K_prr × {FEEDING:g} is invented, to show the mechanism: yaw feeds roll."
        + (
            ""
            if linear
            else " Beyond 40 deg of roll the fitted righting arm is extrapolated; the trace ends at 90 deg."
        )
    )
    return growth_picture(growing_cases(linear), linear, title, note)


def _integration(title: str) -> Figure:
    ds, time, wave = integration_of(CB60)
    note = (
        f"{_where(ship(CB60), wave)}. {OURS} Integration runs 60 periods before roll is read. Coefficients estimated."
    )
    return integration_picture(ds, time, CHECK_HEADING, title, note)


def _where(one: Ship, wave: Wave) -> str:
    """Ship, speed, wave and loading in a line."""
    length, load = one.hull.length, one.loading
    return (
        f"{one.name}, {speed_words(speed_of(one), length)}, wave λ/L = {wave.length / length:.3g}, "
        f"H/λ = {steepness_words(wave.height / wave.length)}, GM {load.gm:.3g} m, k_xx {load.gyradius_roll:.3g} m, "
        f"k_zz {load.gyradius_yaw:.4g} m (assumed)"
    )


def _coefficients(title: str) -> Figure:
    return coefficient_picture(coefficients_of(CB60), title)


def _duffing(title: str) -> Figure:
    return duffing_picture(duffing_curves(**DUFFING), title)


Curves = Callable[[], Mapping[str, xr.Dataset]]


def _axes(title: str) -> Figure:
    return axes_picture(ship(CB60), 30.0, title)


def _force(mode: str, title: str) -> Figure:
    compared = forces_of(CB60)
    return forces_picture(compared, title, force_caption(ship(CB60), compared), [mode])


def _response(name: str, mode: str, title: str) -> Figure:
    return response_picture(responses_of(name), mode, title)


def _loading(curves: Curves, mode: str, note: str, title: str) -> Figure:
    return loading_picture(curves(), mode, title, note)


def _stability(curves: Curves, note: str, title: str) -> Figure:
    return stability_picture(curves(), title, note)


_GYRADII_60 = partial(gyradii_of, CB60, FROUDE)
_GYRADII_MARINER = partial(gyradii_of, MARINER, MARINER_FROUDE)
_HEIGHTS_60 = partial(heights_of, CB60)
_60, _70, _STAND_IN = "Series 60 CB 0.60", "Series 60 CB 0.70", "Mariner (substitute lines)"

FIGURES: Final = {
    1: PaperFigure("axes and heading", _axes),
    2: PaperFigure(f"wave sway force, {_60}", partial(_force, "sway")),
    3: PaperFigure(f"wave roll moment, {_60}", partial(_force, "roll")),
    4: PaperFigure(f"wave yaw moment, {_60}", partial(_force, "yaw")),
    5: PaperFigure(f"sway response, {_60}", partial(_response, CB60, "sway")),
    6: PaperFigure(f"roll response, {_60}", partial(_response, CB60, "roll")),
    7: PaperFigure(f"yaw response, {_60}", partial(_response, CB60, "yaw")),
    8: PaperFigure(f"sway response, {_70}", partial(_response, CB70, "sway")),
    9: PaperFigure(f"roll response, {_70}", partial(_response, CB70, "roll")),
    10: PaperFigure(f"yaw response, {_70}", partial(_response, CB70, "yaw")),
    11: PaperFigure("approximate solution and direct integration", _integration),
    12: PaperFigure("unstable motion by the variational equations, heading 15 deg", partial(_growth, True)),
    13: PaperFigure(
        "unstable motion by the full equations from 5 deg of roll, heading 15 deg", partial(_growth, False)
    ),
    14: PaperFigure(f"radii of gyration and roll, {_60}", partial(_loading, _GYRADII_60, "roll", "")),
    15: PaperFigure(f"radii of gyration and stability, {_60}", partial(_stability, _GYRADII_60, "")),
    16: PaperFigure(f"radii of gyration and yaw, {_60}", partial(_loading, _GYRADII_60, "yaw", "")),
    17: PaperFigure(
        f"radii of gyration and roll, {_STAND_IN}", partial(_loading, _GYRADII_MARINER, "roll", _SUBSTITUTE)
    ),
    18: PaperFigure(
        f"radii of gyration and stability, {_STAND_IN}", partial(_stability, _GYRADII_MARINER, _SUBSTITUTE)
    ),
    19: PaperFigure(f"radii of gyration and yaw, {_STAND_IN}", partial(_loading, _GYRADII_MARINER, "yaw", _SUBSTITUTE)),
    20: PaperFigure(f"GM and roll, {_60}", partial(_loading, _HEIGHTS_60, "roll", "")),
    21: PaperFigure(f"GM and stability, {_60}", partial(_stability, _HEIGHTS_60, "")),
    22: PaperFigure("K2 against the change of each coefficient", _coefficients),
    23: PaperFigure("Duffing's equation", _duffing),
}
"""Number -> figure."""


def draw_figure(number: int) -> Figure:
    """Draw one figure of the paper.

    number: 1 to 23
    """
    words, draw = FIGURES[number]
    return draw(f"Fig. {number} of Haddara (1971), recomputed: {words}")
