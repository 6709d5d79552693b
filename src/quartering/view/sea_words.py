"""An irregular sea in words and numbers: what a command, a page and the service say of a ship in it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    import xarray as xr

    from quartering.hull.ship import Ship
    from quartering.loads.sea.sea import Sea

METHODS: Final = {
    "linear": ("linear response", "-5 to +31 %"),
    "closure": ("statistical linearisation", "within 2 %"),
}
"""Method -> name, and the error of its roll found against simulation, in twelve seas of one ship (`docs/a_real_sea.md`)."""


def sea_sentence(one: Ship, sea: Sea, speed: float, best: xr.Dataset) -> str:
    """What the sea does to the ship, in one sentence.

    best: from `quartering.sea_response` by the closure
    """
    from quartering.hydro.capsize import capsize_limit
    from quartering.study.seas.response import MOST_NEAR, SeaStatus
    from quartering.view.wording import speed_words

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


ROWS: Final = (
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
"""What is told of a response: words, and the name of its variable."""


def number_words(of: xr.Dataset, name: str) -> str:
    """A number of a response; "-" where there is none."""
    return f"{float(of[name]):.3g}" if name in of and math.isfinite(float(of[name])) else "-"


def sea_remarks(best: xr.Dataset) -> list[str]:
    """Energy, danger lines, slow modes and several motions, a line each."""
    slow = ", ".join(f"{rate:.3g}" for rate in best["slow"].values)
    return [
        f"Wave energy: {float(best['overtaken']):.2%} overtaken by the ship, {float(best['near_zero']):.2%} near encounter"
        f" frequency 0, {float(best['cut_off']):.2%} beyond the cut ({best.attrs['cut']}).",
        *danger_lines(best),
        f"Slow sway-yaw modes averaged over the sea {slow} 1/s; below 0 is stable.",
        *several_motions(best),
    ]


def danger_lines(best: xr.Dataset) -> list[str]:
    """Where waves of many periods arrive at the frequency of roll, or twice it, a line each."""
    import numpy as np

    said = []
    line, at = best["pile_up"].values, best["pile_up_heading"].values
    for speed, heading, words in zip(line, at, ("roll in step with the waves", "parametric roll"), strict=True):
        where = f"heading {heading:.3g} deg here" if np.isfinite(heading) else "the ship is too slow for it"
        said.append(
            f"Danger line whatever the period, {words}: speed times cosine of the heading {speed:.3g} m/s; {where}."
        )
    return said


def several_motions(best: xr.Dataset) -> list[str]:
    """That the sea has more than one motion for the ship, where it has."""
    import numpy as np

    rolls = [roll for roll in np.atleast_1d(best["roll_of_each"].values) if np.isfinite(roll)]
    if len(rolls) < 2:
        return []
    return [f"Several motions: roll RMS {', '.join(f'{roll:.3g}' for roll in rolls)} deg; the ship may jump."]


def sea_facts(one: Ship, sea: Sea, speed: float, found: Mapping[str, xr.Dataset]) -> dict[str, Any]:
    """Everything about one sea, for programs.

    found: responses by method, "closure" among them
    """
    from quartering.study.seas.response import SeaStatus

    best = found["closure"]
    return {
        "ship": one.name,
        "condition": {
            "hs": sea.hs, "tp": sea.tp, "tz": sea.tz, "speed": speed, "heading": float(best["heading"]), "sea": sea.words
        },
        "methods": {
            method: {
                "status": SeaStatus(int(at["status"])).name.lower(),
                "roll_error": METHODS[method][1],
                **{
                    name: at[name].values.tolist()
                    for name in at.data_vars
                    if name not in ("status", "pile_up", "pile_up_heading", "overtaken", "near_zero", "cut_off")
                },
            }
            for method, at in found.items()
        },
        **{name: float(best[name]) for name in ("overtaken", "near_zero", "cut_off")},
        "pile_up": dict(zip(best["line"].values.tolist(), best["pile_up"].values.tolist(), strict=True)),
        "pile_up_heading": dict(zip(best["line"].values.tolist(), best["pile_up_heading"].values.tolist(), strict=True)),
    }  # fmt: skip


def guidance_facts(ds: xr.Dataset) -> dict[str, Any]:
    """Everything about a map over seas, for programs."""
    from quartering.study.seas.over_seas.advice import Advice

    about = ("ship", "loading", "sea", "judge", "threshold", "threshold_source", "roll_limit", "hours", "seed")
    names = (
        "speed",
        "heading",
        "hs",
        "tp",
        "tz",
        "roll_mean_3h_max",
        "failure_rate",
        "rate_upper",
        "recommended",
        "rung",
    )
    return {
        **{name: ds.attrs[name] for name in about},
        **{name: ds[name].values for name in names},
        "pile_up": dict(zip(ds["line"].values.tolist(), ds["pile_up"].values.tolist(), strict=True)),
        "conditions": {kind.name.lower(): int((ds["recommended"] == int(kind)).sum()) for kind in Advice},
    }
