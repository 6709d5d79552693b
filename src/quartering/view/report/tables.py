"""The tables of a report: hydrostatics, loading, coefficients with their sources."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.righting.arm import righting_polynomial, vanishing_angle
from quartering.hull.ship import Ship
from quartering.hydro.capsize import capsize_limit
from quartering.hydro.coefficients import coefficients
from quartering.view.particulars import HYDROSTATICS, LOADING, loading_rows, particular_rows
from quartering.view.wording import carries_curve


class Row(NamedTuple):
    """A line of a table; ``marked`` when its value is estimated or assumed."""

    cells: tuple[str, ...]
    marked: bool = False


class Table(NamedTuple):
    """A table of texts; ``numbers`` are the columns aligned to the right."""

    columns: tuple[str, ...]
    rows: list[Row]
    numbers: tuple[int, ...] = ()


def hydrostatics_table(ship: Ship) -> Table:
    """Hydrostatics at the draught, and the marks of the righting arm."""
    floats, fit = hydrostatics(ship), righting_polynomial(ship)
    rows = [
        Row((words, f"{round(getattr(floats, key), 9) + 0.0:.5g}", unit)) for key, (words, unit) in HYDROSTATICS.items()
    ]
    rows += [
        Row((words, f"{angle:.4g}" if np.isfinite(angle) else "above 80", "deg"))
        for words, angle in (
            ("angle of vanishing stability", vanishing_angle(ship)),
            ("top of the offsets goes under at", fit.deck_angle),
        )
    ]
    return Table(("quantity", "value", "unit"), rows, (1,))


def loading_table(ship: Ship) -> Table:
    """Loading with where each value comes from."""
    rows = [
        Row(row, row[-1].startswith(("assumed", "estimated"))) for row in (*loading_rows(ship), *particular_rows(ship))
    ]
    if ship.autopilot is not None:
        rows.append(Row(("autopilot", ship.autopilot.words, "", "given")))
    curve = "the curve itself, as a spline" if carries_curve(ship) else "polynomial fitted to the curve"
    rows.append(Row(("righting curve", curve, "", "an option")))
    rows.append(Row(("capsize: roll past", capsize_limit(ship).words, "", "the least of three")))
    return Table(("quantity", "value", "unit", "where it comes from"), rows, (1,))


def provenance_table(ship: Ship) -> Table:
    """Where the lines and everything else of the ship come from."""
    loading = {key for key, _, _ in LOADING}
    rows = [
        Row((key.replace("_", " "), text), text.startswith("assumed"))
        for key, text in ship.provenance.items()
        if key not in loading
    ]
    return Table(("value", "where it comes from"), rows or [Row(("lines", ship.hull.source))])


def coefficients_table(ship: Ship, speed: float) -> tuple[Table, float]:
    """Every coefficient that is not zero, at the frequency of roll [rad/s], which is returned too."""
    frequency = coefficients(ship, 0.0, speed).roll_frequency
    rows = [
        Row((e.name, f"{e.value:.4g}", e.unit, e.kind, e.source), e.estimated)
        for e in coefficients(ship, frequency, speed).table()
        if e.value != 0.0
    ]
    return Table(("name", "value", "unit", "kind", "source"), rows, (1,)), frequency
