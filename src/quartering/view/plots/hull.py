"""The hull at a glance: body plan and righting arm side by side."""

from __future__ import annotations

import re
from collections.abc import Mapping

from matplotlib.figure import Figure

from quartering.hull.lines.section import Floats
from quartering.hull.righting.arm import RightingFit
from quartering.hull.ship import Ship
from quartering.view.plots import style
from quartering.view.plots.body_plan import draw_body_plan
from quartering.view.plots.righting import draw_righting_arm


def hull_picture(
    ship: Ship,
    angles: Floats,
    arms: Floats,
    fit: RightingFit,
    width: float = 12.0,
    waves: Mapping[str, Floats] | None = None,
) -> Figure:
    """Body plan and righting arm of a ship.

    angles, arms (n,): heel [deg] and GZ [m]
    width: of the figure [inches]
    waves: further righting arms, on waves, by what they are called [m]
    """
    made = style.figure(width, 1.4 + width / 3)
    left, right = made.subplots(1, 2, width_ratios=(1.15, 1.0))
    draw_body_plan(left, ship)
    draw_righting_arm(right, angles, arms, fit, ship.righting == "polynomial", waves)
    hull = ship.hull
    style.title(made, f"{ship.name}: L {hull.length:.4g} m, B {hull.beam:.4g} m, T {hull.draught:.4g} m")
    gm = ship.provenance.get("gm", "given").split(";")[0]
    lines = re.split(r"(?<=[a-z0-9)])\. ", ship.provenance.get("lines", hull.source))[0]
    style.footnote(made, f"Lines: {lines}\nGM: {gm}")
    return made
