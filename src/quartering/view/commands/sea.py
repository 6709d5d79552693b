"""`quartering sea`: one ship in one irregular sea, every method beside the others."""

from __future__ import annotations

from collections.abc import Mapping
from time import process_time
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from quartering.arguments import ARGUMENTS
from quartering.hull.ship import Ship
from quartering.hydro.capsize import capsize_limit
from quartering.loads.forces import Form
from quartering.loads.sea.sea import Sea
from quartering.options import Refused
from quartering.study.seas.response import MOST_NEAR, Method, SeaStatus, sea_response
from quartering.study.seas.simulation import irregular
from quartering.units import NO_SHIP
from quartering.view.commands.conditions import typed_ship, typed_value
from quartering.view.options import value
from quartering.view.ship_options import option_words
from quartering.view.terminal import next_steps, show, show_json, table
from quartering.view.wording import ship_notes, speed_words

METHODS: Final[dict[Method, tuple[str, str]]] = {
    "linear": ("linear response", "-5 to +31 %"),
    "closure": ("statistical linearisation", "within 2 %"),
}
"""Method -> name, and the error of its roll found against simulation, in twelve seas of one ship (`docs/a_real_sea.md`)."""


class Found(NamedTuple):
    """The answer of one method, and the processor time it took [s]."""

    result: xr.Dataset
    cost: float


def respond(
    name: str,
    sea: Mapping[str, str | None],
    typed: tuple[str, str],
    form: Form | str,
    changes: Mapping[str, str],
    as_json: bool,
    hours: str = "32",
) -> None:
    """Print the response to one sea; ``hours`` are those of the simulation, 0 for none."""
    one = typed_ship(name, changes)
    heading, speed = (typed_value(key, text, one.sizes) for key, text in zip(("heading", "speed"), typed, strict=True))
    waves = typed_sea(sea, one, heading)
    found: dict[str, Found] = {}
    for method in METHODS:
        sea_response(one, waves, speed, method=method, form=form)  # type: ignore[arg-type]  # compiled and tabled: not its cost
        begun = process_time()
        found[method] = Found(sea_response(one, waves, speed, method=method, form=form), process_time() - begun)  # type: ignore[arg-type]
    simulated = _hours(hours)
    if simulated > 0:
        irregular(one, waves, speed, form=form)  # type: ignore[arg-type]  # compiled: not its cost
        begun = process_time()
        result = irregular(one, waves, speed, hours=simulated, form=form)  # type: ignore[arg-type]
        found["simulation"] = Found(result, process_time() - begun)
    if as_json:
        show_json(facts(one, waves, speed, found))
        return
    best = found["closure"].result
    show(_sentence(one, waves, speed, best))
    show(_table(found), *_remarks(best))
    if "simulation" in found:
        show(*_of_simulation(found["simulation"].result))
    show(ship_notes(one))
    words = f"--heading {typed[0]} --speed {typed[1]} --wave-period {waves.tp:.3g}s --wave-height {waves.hs:.3g}"
    show(next_steps(f"quartering verdict {name} {words}{option_words(changes)}"))


def _hours(text: str) -> float:
    """Hours to simulate; 0 for none."""
    return 0.0 if text.strip() in ("0", "none") else value(text, ARGUMENTS["simulated_hours"], NO_SHIP, "--hours")


def _of_simulation(result: xr.Dataset) -> list[str]:
    """What only a simulation tells: failures, their rate, and what it rests on."""
    k, exposure = int(result["failures"]), float(result["exposure"])
    limit = result.attrs["roll_limit"]
    felt = result.attrs["acceleration_limit"]
    other = f" or {felt:g} m/s2" if isinstance(felt, float) else ""
    return [
        f"Simulation of {exposure:.4g} h (seed {result.attrs['seed']}): {k} failures (roll of {limit:.3g} deg{other}), rate"
        f" {float(result['failure_rate']):.2g} 1/s, 95 % interval {float(result['rate_lower']):.2g} to"
        f" {float(result['rate_upper']):.2g} 1/s.",
        f"It has {result.attrs['strips']} strips of drag and {result.attrs['memory']}; by the closure that changes"
        f" {result.attrs['closure_change']}.",
    ]


def typed_sea(typed: Mapping[str, str | None], one: Ship, heading: float) -> Sea:
    """The sea of the words typed.

    Raises
    ------
    InputError    what `Sea` refuses, with the option as typed
    """
    given: dict[str, Any] = {
        "heading": heading,
        "spectrum": typed["spectrum"],
        "spreading": _spreading(typed["spreading"]),
    }
    for name in ("hs", "tp", "tz", "gamma"):
        text = typed[name]
        if text is not None:
            given[name] = value(text, ARGUMENTS[name], one.sizes, ARGUMENTS[name].command)
    return Sea(**given)


def _spreading(text: str | None) -> Any:
    if text in (None, "none", "cos2"):
        return None if text == "none" else text
    try:
        return float(str(text))
    except ValueError:
        raise Refused("spreading", f"spreading = {text!r}; it is s > 0, cos2 or none; try 10", "--spreading") from None


def _sentence(one: Ship, sea: Sea, speed: float, best: xr.Dataset) -> str:
    where = f"Heading {float(best['heading']):g} deg, {speed_words(speed, one.hull.length)}, {sea.words}"
    status = SeaStatus(int(best["status"]))
    if status == SeaStatus.NOT_CONVERGED:
        return f"{where}: no Gaussian motion was found; the sea is too much for this method."
    limit = capsize_limit(one)
    rms, largest, hours = float(best["roll_rms"]), float(best["roll_mean_largest"]), best.attrs["hours"]
    rolls = f"roll {rms:.3g} deg RMS, largest of {hours:g} h {largest:.3g} deg in the mean"
    ends = {
        SeaStatus.ANSWERED: "steady on average",
        SeaStatus.UNSTABLE: "but the motion about the mean grows: no steady motion",
        SeaStatus.SURF_RIDING: f"but over {MOST_NEAR:.0%} of the energy rides with the ship: surf-riding, not valid",
        SeaStatus.PAST_CAPSIZE_LIMIT: f"past {limit.words}: a capsize is likely, and no Gaussian method tells how soon",
    }
    return f"{where}: {rolls}, {ends[status]}."


_ROWS: Final = (
    ("roll RMS [deg]", "roll_rms"),
    ("mean period of roll [s]", "roll_period"),
    ("largest roll, most probable [deg]", "roll_most_probable"),
    ("largest roll, mean [deg]", "roll_mean_largest"),
    ("  at most, every swing counted [deg]", "roll_mean_largest_bound"),
    ("lateral acceleration RMS [m/s2]", "lateral_acceleration_rms"),
    ("largest lateral acceleration, mean [m/s2]", "lateral_acceleration_mean_largest"),
    ("roll frequency about the motion [rad/s]", "n2"),
    ("K2, below 0 is stable [1/s2]", "k2"),
)


def _table(found: Mapping[str, Found]) -> Any:
    rows = [(words, *(_number(one.result, name) for one in found.values())) for words, name in _ROWS]
    rows.append(("processor time [s]", *(f"{one.cost:.2g}" for one in found.values())))
    errors, names = [error for _, error in METHODS.values()], [words for words, _ in METHODS.values()]
    if "simulation" in found:
        at = found["simulation"].result
        errors.append(f"{float(at['roll_rms_error'] / at['roll_rms']):.1%} standard error")
        names.append(f"simulation, {float(at['exposure']):.4g} h")
    rows.append(("error of roll RMS; of the first two as found in twelve seas", *errors))
    hours = found["closure"].result.attrs["hours"]
    return table(f"Response; largest of {hours:g} h", ("quantity", *names), rows, right=tuple(range(1, len(names) + 1)))


def _number(of: xr.Dataset, name: str) -> str:
    return f"{float(of[name]):.3g}" if name in of and np.isfinite(float(of[name])) else "-"


def _remarks(best: xr.Dataset) -> list[str]:
    said = [
        f"Wave energy: {float(best['overtaken']):.2%} overtaken by the ship, {float(best['near_zero']):.2%} near encounter"
        f" frequency 0, {float(best['cut_off']):.2%} beyond the cut ({best.attrs['cut']})."
    ]
    line, at = best["pile_up"].values, best["pile_up_heading"].values
    for speed, heading, words in zip(line, at, ("roll in step with the waves", "parametric roll"), strict=True):
        where = f"heading {heading:.3g} deg here" if np.isfinite(heading) else "the ship is too slow for it"
        said.append(
            f"Danger line whatever the period, {words}: speed times cosine of the heading {speed:.3g} m/s; {where}."
        )
    slow = ", ".join(f"{rate:.3g}" for rate in best["slow"].values)
    said.append(f"Slow sway-yaw modes averaged over the sea {slow} 1/s; below 0 is stable.")
    rolls = [roll for roll in np.atleast_1d(best["roll_of_each"].values) if np.isfinite(roll)]
    if len(rolls) > 1:
        said.append(f"Several motions: roll RMS {', '.join(f'{roll:.3g}' for roll in rolls)} deg; the ship may jump.")
    return said


def facts(one: Ship, sea: Sea, speed: float, found: Mapping[str, Found]) -> dict[str, Any]:
    """Everything about the sea, for programs: what `quartering sea --json` prints."""
    best = found["closure"].result
    return {
        "ship": one.name,
        "condition": {
            "hs": sea.hs, "tp": sea.tp, "tz": sea.tz, "speed": speed, "heading": float(best["heading"]), "sea": sea.words
        },
        "methods": {
            method: {
                "status": SeaStatus(int(at["status"])).name.lower(),
                "processor_time": cost,
                "roll_error": METHODS[method][1],
                **{
                    name: at[name].values.tolist()
                    for name in at.data_vars
                    if name not in ("status", "pile_up", "pile_up_heading", "overtaken", "near_zero", "cut_off")
                },
            }
            for method, (at, cost) in found.items()
            if method in METHODS
        },
        **({"simulation": _simulated_facts(found["simulation"])} if "simulation" in found else {}),
        **{name: float(best[name]) for name in ("overtaken", "near_zero", "cut_off")},
        "pile_up": dict(zip(best["line"].values.tolist(), best["pile_up"].values.tolist(), strict=True)),
        "pile_up_heading": dict(zip(best["line"].values.tolist(), best["pile_up_heading"].values.tolist(), strict=True)),
    }  # fmt: skip


def _simulated_facts(found: Found) -> dict[str, Any]:
    """Numbers of a simulation, without those of each block, and what it rests on."""
    at = found.result
    numbers = {str(name): at[name].values.tolist() for name in at.data_vars if not at[name].dims}
    return {
        "processor_time": found.cost,
        **numbers,
        **{name: at.attrs[name] for name in ("seed", "hours", "step", "memory")},
    }
