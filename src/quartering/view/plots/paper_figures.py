"""The 23 figures of the paper by number: what each is, and how it is drawn."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache, partial
from typing import Final, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from quartering.hull.ship import Ship, ship
from quartering.loads.waves import Wave
from quartering.motion.of_ship import equations
from quartering.motion.simulate import simulate
from quartering.motion.steady import steady_motion
from quartering.stability.verdict import stability
from quartering.study.duffing import duffing_curves
from quartering.study.paper_conditions import (
    INSTABILITY_HEADING,
    INSTABILITY_RATIO,
    INSTABILITY_STEEPNESS,
    MARINER_FROUDE,
    speed_of,
    wave_of,
)
from quartering.study.paper_curves import coefficient_curves, force_curves, loading_curves, response_curves
from quartering.study.paper_model import FEEDING, PAPER_SHIP, feeding_model, modified_model
from quartering.study.paper_motions import disturbance, integration_check, time_check
from quartering.view.plots.duffing import duffing_picture
from quartering.view.plots.paper_axes import axes_picture
from quartering.view.plots.paper_caption import OURS
from quartering.view.plots.paper_curves import (
    coefficient_picture,
    force_picture,
    loading_picture,
    response_picture,
    stability_picture,
)
from quartering.view.plots.paper_motions import Growth, growth_picture, integration_picture
from quartering.view.wording import speed_words, steepness_words

CB60: Final = PAPER_SHIP
CB70: Final = "series60-cb70"
MARINER: Final = "mariner"
GYRADII_ROLL: Final = ("0.30 B", "0.35 B", "0.40 B", "0.45 B")
GYRADII_YAW: Final = ("0.22 L", "0.25 L", "0.28 L")
HEIGHTS: Final = ("0.03 B", "0.05 B", "0.075 B", "0.10 B")
COEFFICIENTS: Final = ("K_p", "K_ppp", "K_vpp", "K_pvv", "K_prr", "K_vrr")
CHANGES: Final = np.linspace(-100.0, 100.0, 41)
CHECK_HEADING, CHECK_STEEPNESS = 60.0, 1 / 30
DUFFING: Final = {"beta": 0.2, "force": 0.3}
DISTURBANCE, START_ROLL, DURATION = 1.0, 5.0, 400.0
"""Disturbance of roll in Fig. 12, roll at the start of Fig. 13 (the paper's) [deg], and how long both are followed [s]."""


class PaperFigure(NamedTuple):
    """A figure of the paper: its title, and a function without arguments that draws it."""

    title: str
    draw: Callable[[], Figure]


@lru_cache(maxsize=4)
def forces_of(name: str) -> xr.Dataset:
    """Wave forces of a built-in ship in the figures' conditions (Figs. 2-4)."""
    return force_curves(ship(name))


@lru_cache(maxsize=4)
def responses_of(name: str) -> xr.Dataset:
    """Response of a built-in ship in the figures' conditions (Figs. 5-10)."""
    return response_curves(ship(name))


@lru_cache(maxsize=4)
def gyradii_of(name: str, froude: float) -> Mapping[str, xr.Dataset]:
    """Response and stability of a built-in ship for several radii of gyration (Figs. 14-19)."""
    one = ship(name)
    return {
        quantity: loading_curves(one, quantity, _lengths(one, quantity, values), froude=froude)
        for quantity, values in (("gyradius_roll", GYRADII_ROLL), ("gyradius_yaw", GYRADII_YAW))
    }


@lru_cache(maxsize=4)
def heights_of(name: str) -> Mapping[str, xr.Dataset]:
    """Response and stability of a built-in ship for several metacentric heights (Figs. 20, 21)."""
    one = ship(name)
    return {"gm": loading_curves(one, "gm", _lengths(one, "gm", HEIGHTS))}


def _lengths(one: Ship, quantity: str, values: tuple[str, ...]) -> list[float]:
    return [float(getattr(one.with_(**{quantity: value}).loading, quantity)) for value in values]


def growing_cases(linear: bool) -> list[Growth]:
    """The modified model, and the one in which yaw feeds roll, followed in time (Figs. 12, 13).

    Parameters
    ----------
    linear : bool    a disturbance by the variational equations; or the full equations started with a roll angle
    """
    cases = []
    for words, one in (
        ("Table I ratios on the estimated coefficients", modified_model()),
        (f"the same with K_prr × {FEEDING:g} (invented)", feeding_model()),
    ):
        model = equations(one, _instability_wave(one), speed_of(one), INSTABILITY_HEADING)
        motion = steady_motion(model, 9, start="rest")
        if linear:
            trace = disturbance(model, motion, DURATION, DISTURBANCE)
        else:
            trace = simulate(model, DURATION, (0.0, float(np.radians(START_ROLL)), 0.0, 0.0))
        cases.append(Growth(words, trace, stability(model, motion), float(np.degrees(motion.peak[1]))))
    return cases


def _instability_wave(one: Ship) -> Wave:
    return wave_of(one, INSTABILITY_RATIO, INSTABILITY_STEEPNESS)


def _growth(title: str, linear: bool) -> Figure:
    one = ship(CB60)
    note = (
        f"{_where(one, _instability_wave(one))}, heading {INSTABILITY_HEADING:g} deg. {OURS} Coefficients estimated "
        "(cross-flow drag, regression); the unit, inertia and linear coefficients of Table I are not printed, so its ratios "
        f"are applied to ours. K_prr × {FEEDING:g} is invented, to show the mechanism: yaw feeds roll."
    )
    return growth_picture(growing_cases(linear), linear, title, note)


def _integration(title: str) -> Figure:
    one = ship(CB60)
    wave, speed = wave_of(one, 1.0, CHECK_STEEPNESS), speed_of(one)
    model = equations(one, wave, speed, CHECK_HEADING)
    time = time_check(model, steady_motion(model, 1, start="rest"))
    ds = integration_check(one, wave, speed, np.arange(15.0, 166.0, 5.0))
    note = f"{_where(one, wave)}. {OURS} Integration runs 60 periods before roll is read. Coefficients estimated."
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
    sets = {}
    for words, one, heading in (
        ("as estimated, heading 30 deg", ship(CB60), 30.0),
        (f"Table I ratios, K_prr × {FEEDING:g} (invented), heading 15 deg", feeding_model(), INSTABILITY_HEADING),
    ):
        sets[words] = coefficient_curves(one, COEFFICIENTS, CHANGES, _instability_wave(one), speed_of(one), heading)
    return coefficient_picture(sets, title)


def _title(number: int, words: str) -> str:
    return f"Fig. {number} of Haddara (1971), recomputed: {words}"


def _figures() -> dict[int, PaperFigure]:
    """Every figure by number."""
    made: dict[int, PaperFigure] = {}

    def add(number: int, words: str, draw: Callable[..., Figure], *arguments: object, **more: object) -> None:
        made[number] = PaperFigure(words, partial(draw, *arguments, title=_title(number, words), **more))

    add(1, "axes and heading", lambda title: axes_picture(ship(CB60), 30.0, title))
    for number, (mode, words) in enumerate((("sway", "sway force"), ("roll", "roll moment"), ("yaw", "yaw moment")), 2):
        add(
            number,
            f"wave {words}, Series 60 CB 0.60",
            lambda mode, title: force_picture(forces_of(CB60), mode, title),
            mode,
        )
    for first, name, words in ((5, CB60, "Series 60 CB 0.60"), (8, CB70, "Series 60 CB 0.70")):
        for number, mode in enumerate(("sway", "roll", "yaw"), first):
            add(
                number, f"{mode} response, {words}",
                lambda name, mode, title: response_picture(responses_of(name), mode, title), name, mode,
            )  # fmt: skip
    add(11, "approximate solution and direct integration", _integration)
    add(12, "unstable motion by the variational equations, heading 15 deg", _growth, linear=True)
    add(13, "unstable motion by the full equations from 5 deg of roll, heading 15 deg", _growth, linear=False)
    for first, name, froude, words in (
        (14, CB60, 0.25, "Series 60 CB 0.60"),
        (17, MARINER, MARINER_FROUDE, "Mariner (substitute lines)"),
    ):
        add(
            first, f"radii of gyration and roll, {words}",
            lambda name, froude, title: loading_picture(gyradii_of(name, froude), "roll", title), name, froude,
        )  # fmt: skip
        add(
            first + 1, f"radii of gyration and stability, {words}",
            lambda name, froude, title: stability_picture(gyradii_of(name, froude), title), name, froude,
        )  # fmt: skip
        add(
            first + 2, f"radii of gyration and yaw, {words}",
            lambda name, froude, title: loading_picture(gyradii_of(name, froude), "yaw", title), name, froude,
        )  # fmt: skip
    add(20, "GM and roll, Series 60 CB 0.60", lambda title: loading_picture(heights_of(CB60), "roll", title))
    add(21, "GM and stability, Series 60 CB 0.60", lambda title: stability_picture(heights_of(CB60), title))
    add(22, "K2 against the change of each coefficient", _coefficients)
    add(23, "Duffing's equation", lambda title: duffing_picture(duffing_curves(**DUFFING), title))
    return made


FIGURES: Final = _figures()
"""Number -> figure."""
