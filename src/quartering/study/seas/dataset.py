"""Responses to seas as one labelled dataset: units and meanings on everything, the sea and the ship in its attributes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import xarray as xr

from quartering.conventions import GRAVITY, HEADING_CONVENTION, MODES, REFERENCE_POINT, STATE
from quartering.hull.ship import Ship
from quartering.loads.forces import form_words
from quartering.loads.sea.cells import Cells
from quartering.loads.sea.sea import Sea
from quartering.motion.equations.model import Model
from quartering.study.dataset import made_by

if TYPE_CHECKING:
    from quartering.study.seas.response import Answer, SeaStatus

_LARGEST: Final = (
    ("most_probable", "most probable largest, swings in groups counted once (not passed with probability 1/e)"),
    ("mean_largest", "mean largest, swings in groups counted once"),
    ("most_probable_bound", "most probable largest if every swing were independent: at most"),
    ("mean_largest_bound", "mean largest if every swing were independent: at most"),
)
MEANINGS: Final[dict[str, tuple[str, str, tuple[str, ...]]]] = {
    "covariance": ("SI", "covariance of v [m/s], phi [rad], p, r [rad/s]", ("state", "state_2")),
    "roll_rms": ("deg", "root mean square roll about its mean", ()),
    "roll_mean": ("deg", "mean roll", ()),
    "roll_period": ("s", "mean zero-crossing period of roll", ()),
    **{f"roll_{name}": ("deg", f"largest |roll| about its mean, {words}", ()) for name, words in _LARGEST},
    "lateral_acceleration_rms": (
        "m s-2",
        "root mean square lateral acceleration at the place, gravity of the heeled deck in it",
        (),
    ),
    **{
        f"lateral_acceleration_{name}": ("m s-2", f"largest lateral acceleration, {words}", ())
        for name, words in _LARGEST
        if name.startswith("mean")
    },
    "gains": ("SI", "mean slopes of all forces by v, phi, p, r, at the frequency of free roll", ("mode", "state")),
    "n2": ("rad s-1", "roll frequency about the motion", ()),
    "k2": ("s-2", "first-order stability index with the covariance in place of wave averages; negative is stable", ()),
    "slow": ("s-1", "growth rates of the slow sway-yaw modes averaged over the sea", ("slow_mode",)),
    "exponent": ("s-1", "growth rates of the mean Jacobian, real parts, the largest first", ("exponent_of",)),
    "exponent_frequency": ("rad s-1", "its frequencies, imaginary parts", ("exponent_of",)),
    "overtaken": ("1", "share of the wave energy that the ship overtakes", ()),
    "near_zero": ("1", "share of the wave energy within a tenth of the roll frequency about encounter frequency 0", ()),
    "cut_off": (
        "1",
        "share of the wave energy beyond the cut, which does not act; nothing is scaled to make up for it",
        (),
    ),
    "roll_of_each": ("deg", "root mean square roll of each motion found, the one from rest first", ("solution",)),
    "passes": ("1", "passes over the cells", ()),
}
"""Variable -> unit, meaning, own dimensions."""


def sea_dataset(
    ship: Ship | Model,
    seas: Sequence[Sea],
    shape: Mapping[str, Any],
    answers: Sequence[Answer],
    status: Sequence[SeaStatus],
    cells: Cells,
    given: Mapping[str, Any],
) -> xr.Dataset:
    """Dataset of answers, sea by sea and in each heading by heading; see `sea_response`."""
    sizes = {name: one if isinstance(one, int) else len(one) for name, one in shape.items()}
    rows = [_row(one, given["hours"]) for one in answers]
    most = max(len(row["roll_of_each"]) for row in rows)
    for row in rows:
        row["roll_of_each"] = row["roll_of_each"] + [np.nan] * (most - len(row["roll_of_each"]))
    data = {}
    for name, (unit, meaning, own) in MEANINGS.items():
        values = np.array([row[name] for row in rows])
        values = values.reshape((*sizes.values(), *values.shape[1:]))
        data[name] = xr.Variable((*sizes, *own), values, {"units": unit, "long_name": meaning})
    flags = list(type(status[0]))
    data["status"] = xr.Variable(
        tuple(sizes),
        np.array([int(one) for one in status], dtype=np.int8).reshape(tuple(sizes.values())),
        {
            "long_name": "whether the condition has an answer",
            "flag_values": np.array([int(one) for one in flags], dtype=np.int8),
            "flag_meanings": " ".join(one.name.lower() for one in flags),
        },
    )
    data |= pile_up_lines(given["roll_frequency"], cells.speed)
    coordinates = sea_coordinates(seas, sizes, shape) | {"mode": list(MODES)}
    return xr.Dataset(data, coordinates, _attributes(ship, seas, cells, given, answers))


def _row(found: Answer, hours: float) -> dict[str, Any]:
    m, degrees = found.moments, float(np.degrees(1.0))
    roll, felt = np.sqrt(m.roll[0]) * degrees, np.sqrt(m.acceleration[0])
    largest, felt_largest = m.roll_largest(hours), m.acceleration_largest(hours)
    row = {
        "covariance": found.covariance,
        "roll_rms": roll,
        "roll_mean": found.mean[1] * degrees,
        "roll_period": m.roll_period,
        "lateral_acceleration_rms": felt,
        "lateral_acceleration_mean_largest": felt * felt_largest[1],
        "lateral_acceleration_mean_largest_bound": felt * felt_largest[3],
        "gains": found.gains,
        "n2": found.n2,
        "k2": found.k2,
        "slow": found.slow,
        "exponent": found.exponents.real,
        "exponent_frequency": found.exponents.imag,
        "roll_of_each": found.rolls,
        "passes": found.passes,
    }
    row |= {f"roll_{name}": roll * value for (name, _), value in zip(_LARGEST, largest, strict=True)}
    row |= dict(zip(("overtaken", "near_zero", "cut_off"), found.shares, strict=True))
    if not found.converged:
        row |= {
            name: np.full_like(np.asarray(row[name], dtype=float), np.nan) for name in row if name not in _STILL_KNOWN
        }
        row["roll_of_each"] = [np.nan]
    return row


_STILL_KNOWN: Final = ("overtaken", "near_zero", "cut_off", "passes", "roll_of_each")


def pile_up_lines(roll_frequency: float, speed: float) -> dict[str, xr.Variable]:
    """The two lines U cos mu = g/(4 w2) and g/(8 w2), and the heading each has at the speed."""
    line = GRAVITY / (np.array([4.0, 8.0]) * roll_frequency)
    with np.errstate(divide="ignore"):
        cosine = line / np.float64(speed)
    heading = np.degrees(np.arccos(np.where(cosine <= 1.0, cosine, np.nan)))
    words = "a broad band of waves arrives at one frequency: that of roll (synchronous), or twice it (parametric)"
    return {
        "pile_up": xr.Variable(("line",), line, {"units": "m s-1", "long_name": f"U cos mu at which {words}"}),
        "pile_up_heading": xr.Variable(
            ("line",),
            heading,
            {"units": "deg", "long_name": f"heading at this speed at which {words}; NaN where the ship is too slow"},
        ),
    }


def sea_coordinates(seas: Sequence[Sea], sizes: Mapping[str, int], shape: Mapping[str, Any]) -> dict[str, Any]:
    """Coordinates of every dataset of seas: states, danger lines, and what each sea is."""
    states = list(STATE)
    coords: dict[str, Any] = {"state": states, "state_2": states, "line": ["synchronous", "parametric"]}
    each = sizes.get("heading", 1)
    firsts = seas[::each]
    where = ("sea",) if "sea" in sizes else ()
    pick = (lambda values: np.array(values)) if where else (lambda values: values[0])
    for name, unit, meaning in (
        ("hs", "m", "significant wave height"),
        ("tp", "s", "period of the peak"),
        ("tz", "s", "mean zero-crossing period"),
    ):
        coords[name] = xr.Variable(
            where, pick([getattr(one, name) for one in firsts]), {"units": unit, "long_name": meaning}
        )
    about = {"units": "deg", "long_name": f"heading the sea goes to: {HEADING_CONVENTION}"}
    if "heading" in sizes:
        coords["heading"] = xr.Variable(("heading",), np.asarray(shape["heading"]), about)
    else:
        coords["heading"] = xr.Variable(where, pick([one.heading for one in firsts]), about)
    return coords


def _grid_error(cells: Cells, given: Mapping[str, Any]) -> float:
    """Largest error of roll variance by the width of the frequencies, 2 exp(-2 pi zeta w2/d omega)."""
    width = cells.step * np.sqrt(1.0 + 4.0 * cells.speed * given["roll_frequency"] / GRAVITY)
    return float(2.0 * np.exp(-2.0 * np.pi * max(given["damping"], 0.0) * given["roll_frequency"] / width))


def _attributes(
    ship: Ship | Model, seas: Sequence[Sea], cells: Cells, given: Mapping[str, Any], answers: Sequence[Answer]
) -> dict[str, Any]:
    x, z = given["place"]
    words = {
        "linear": "linear response in every wave cell, coefficients at its encounter frequency; no nonlinear term",
        "closure": "statistical linearisation of every nonlinear term, closed with the covariance",
    }
    known = {
        "title": "Response to irregular seas",
        "method": given["method"],
        "method_meaning": words[given["method"]],
        "seas": "; ".join(dict.fromkeys(one.words for one in seas)),
        "cut": "; ".join(
            dict.fromkeys(f"{one.band[0]:.3g} to {one.band[1]:.3g} rad/s" for sea in seas for one in sea.partitions)
        ),
        "speed": cells.speed,
        "hours": given["hours"],
        "place": f"{x:.4g} m forward of G, {z:.4g} m below it",
        "cells": f"{cells.sigma.size} frequencies x {cells.heading.size} headings on one side, the other folded onto it",
        "cells_used": max(one.cells for one in answers),
        "grid_error_bound": _grid_error(cells, given),
        "roll_frequency": given["roll_frequency"],
        "roll_damping_ratio": given["damping"],
        "largest": "Vanmarcke's, of a Gaussian motion; bound: Rice's with every swing independent",
        "heading_convention": HEADING_CONVENTION,
        "reference_point": REFERENCE_POINT,
        "references": "H71, STF70, Kazakov54, Vanmarcke75, Rice44",
        "source": made_by(),
    }
    known["ship"] = name_of(ship)
    if isinstance(ship, Model):
        return known
    return known | {
        "velocities": ship.velocities,
        "drag": ship.drag,
        "righting_curve": ship.righting,
        "diffraction": form_words(ship, given["form"]),
    }


def name_of(ship: Ship | Model) -> str:
    """What results call a ship, or a model."""
    return ship.name if isinstance(ship, Ship) else str(ship.source.get("ship", "a model given by numbers"))


def scalars(rows: Mapping[str, tuple[float, str, str]]) -> dict[str, xr.Variable]:
    """Variables without dimensions of values, each with its unit and meaning."""
    return {
        name: xr.Variable((), value, {"units": unit, "long_name": words}) for name, (value, unit, words) in rows.items()
    }
