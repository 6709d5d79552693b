"""`quartering branch`: every motion over one parameter."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import numpy as np
import xarray as xr

from quartering.conventions import SYMBOLS, InputError, headed
from quartering.hull.ship import Ship
from quartering.loads.waves import STEEPEST, Wave
from quartering.options import OPTIONS, Option
from quartering.stability.ahead import announce_compilation
from quartering.stability.kind import Kind
from quartering.study.branches.branch import branch
from quartering.study.grid import CONDITION_AXES
from quartering.study.loadings import LOADING_AXES
from quartering.view.commands.conditions import condition, sizes
from quartering.view.options import value
from quartering.view.output import PICTURES, claim, write
from quartering.view.progress import working
from quartering.view.ship_options import option_words
from quartering.view.terminal import next_steps, show, show_json, table
from quartering.view.wording import ship_notes, speed_words

_OPTIONS = {"speed": "--speed", "heading": "--heading", "wave_length": "--wave-length", "wave_height": "--wave-height"}
_STEEPEST = 0.999 * STEEPEST
ORIGINS = {
    "start": "from the lower limit",
    "symmetry-breaking": "leaning motions",
    "period-doubling": "motions of two wave periods",
    "search": "a curve of its own",
}
"""What the curves are, by where they began."""


def follow_motions(
    name: str,
    typed: tuple[str, str, str, str],
    over: str,
    limits: str | None,
    harmonics: int,
    changes: Mapping[str, str],
    output: str | None,
    as_json: bool,
) -> None:
    """Follow the branches, print what happens along them, draw them where asked."""
    one, wave, speed, heading = condition(name, typed, changes)
    path = claim(output, PICTURES) if output is not None else None
    ends = _limits(one, wave, over, limits)
    announce_compilation()
    with working("following the motions"):
        ds = branch(one, over, limits=ends, harmonics=harmonics, wave=wave, speed=speed, heading=heading)
    if path is not None:
        from quartering.view.plots import style
        from quartering.view.plots.branch import branch_picture

        held = {"speed": speed_words(speed, one.hull.length), "heading": f"heading {heading:g} deg"}
        held |= {"wave_length": f"wave length {wave.length:.4g} m", "wave_height": f"wave height {wave.height:.3g} m"}
        title = f"{one.name}: " + ", ".join(words for key, words in held.items() if key != over)
        note = ship_notes(one)
        write((path, lambda part: style.save(branch_picture(ds, over, title, note), part)))
    if as_json:
        facts = {"ship": one.name, "over": over, "curves": _curves(ds, over), "events": _events(ds, over)}
        show_json(facts | {"picture": None if path is None else str(path)})
        return
    _print(ds, over)
    show(ship_notes(one))
    if path is not None:
        show(f"Wrote {path}")
    again = f" --harmonics {harmonics}" if harmonics != 9 else ""
    again += f" --limits {limits}" if limits is not None else ""
    name += option_words(changes)
    show(next_steps(*_next(ds, name, typed, over, again if path is None else None)))


def _limits(one: Ship, wave: Wave, over: str, text: str | None) -> tuple[float, float] | None:
    """The two ends as typed, None for those of `quartering.branch`; no wave between them breaks.

    Raises
    ------
    InputError    not two values, a wave too steep at one of them
    """
    if text is None and over == "wave_height":
        return 0.5 * wave.height, min(1.5 * wave.height, _STEEPEST * wave.length)
    if text is None and over == "wave_length":
        return max(0.5 * wave.length, wave.height / _STEEPEST), 1.5 * wave.length
    if text is None:
        return None
    ends = text.split(":")
    if len(ends) != 2:
        raise InputError(f'--limits "{text}": give two values, from:to, such as 1:6')
    kind: Option | Literal["ratio"] = OPTIONS[over] if over in (*CONDITION_AXES, *LOADING_AXES) else "ratio"
    low, high = (value(end, kind, sizes(one), "--limits") for end in ends)
    if over == "wave_height" and high > low:
        Wave(wave.length, high)  # refuses one that breaks
    if over == "wave_length" and high > low > 0.0:
        Wave(low, wave.height)
    return low, high


def _curves(ds: xr.Dataset, over: str) -> list[dict[str, object]]:
    """Each curve in numbers."""
    found = []
    for number in np.unique(ds["curve"]):
        own = ds.isel(point=np.flatnonzero(ds["curve"] == number))
        stable = np.asarray(own["verdict"]) == Kind.STABLE
        peak = np.asarray(own["roll_peak"])
        found.append(
            {
                "curve": int(number), "origin": str(own["origin"].values[0]), "periods": int(own["periods"].values[0]),
                "closed": bool(own["closed"].values[0]), "from": float(own[over].min()), "to": float(own[over].max()),
                "largest_roll_deg": float(peak.max()), "points": int(own.sizes["point"]),
                "stable_share": float(stable.mean()),
                "largest_stable_roll_deg": float(peak[stable].max()) if stable.any() else None,
            }
        )  # fmt: skip
    return found


def _events(ds: xr.Dataset, over: str) -> list[dict[str, object]]:
    """Each fold and bifurcation in numbers."""
    at = np.flatnonzero(ds["event"] != "")
    return [
        {
            "event": str(ds["event"].values[i]), over: float(ds[over][i]),
            "roll_peak_deg": float(ds["roll_peak"][i]), "curve": int(ds["curve"][i]),
        }
        for i in at
    ]  # fmt: skip


def _print(ds: xr.Dataset, over: str) -> None:
    along = headed(over, str(ds[over].attrs["units"]))
    curves = [
        (
            str(c["curve"]),
            ORIGINS[str(c["origin"])] + (", closed" if c["closed"] else ""),
            f"{c['from']:.4g} to {c['to']:.4g}",
            f"{c['largest_roll_deg']:.3g}",
            f"{c['stable_share']:.0%}",
        )
        for c in _curves(ds, over)
    ]
    show(table("Curves of motions", ("curve", "what", along, "largest roll [deg]", "points stable"), curves, (3, 4)))
    rows = [
        (str(e["event"]), f"{e[over]:.6g}", f"{e['roll_peak_deg']:.3g}", str(e["curve"])) for e in _events(ds, over)
    ]
    if rows:
        show(table("Where stability changes", ("event", along, "largest roll [deg]", "curve"), rows, (1, 2)))
    else:
        kinds = [Kind(int(k)).label for k in np.unique(ds["verdict"])]
        show(
            f"Stability does not change between these limits: {kinds[0]} throughout."
            if len(kinds) == 1
            else "Stability does not change along any of these curves."
        )


def _next(ds: xr.Dataset, name: str, typed: tuple[str, str, str, str], over: str, again: str | None) -> list[str]:
    """What to type next: a verdict at the first event, the basin, and the picture where ``again`` tells its options."""
    given = dict(zip(("heading", "speed", "wave_length", "wave_height"), typed, strict=True))
    words = " ".join(f"{_OPTIONS[key]} {text}" for key, text in given.items())
    steps = [] if again is None else [f"quartering branch {name} {words} --over {over}{again} -o branch.png"]
    events = _events(ds, over)
    if events and over in SYMBOLS and over in given:
        there = " ".join(
            f"{_OPTIONS[key]} {events[0][over] if key == over else text:.5}" for key, text in given.items()
        )
        steps.append(f"quartering verdict {name} {there}")
    return [*steps, f"quartering basin {name} {words} -o basin.png"]
