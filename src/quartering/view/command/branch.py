"""`quartering branch`: every motion over one parameter."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from quartering.conventions import SYMBOLS, InputError, headed
from quartering.option_checks import Option
from quartering.options import OPTIONS
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import (
    Changes,
    Harmonics,
    Heading,
    Modes,
    PictureOrData,
    ShipName,
    Speed,
    WaveHeight,
    WaveLength,
)
from quartering.view.console.files import PICTURES, TABLES, dataset_or_picture, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.progress import working
from quartering.view.console.tables import data_table
from quartering.view.console.typed_ship import Typed
from quartering.view.console.typed_values import value

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from quartering.hull.ship import Ship
    from quartering.loads.waves import Wave
    from quartering.motion.modes import Modes as ModesOf
    from quartering.view.console.printed import Table

_UNBROKEN = 0.999
"""Share of the steepest wave that the usual limits keep below."""
_USUAL_HARMONICS = 9
ORIGINS = {
    "start": "from the lower limit",
    "symmetry-breaking": "leaning motions",
    "period-doubling": "motions of two wave periods",
    "search": "a curve of its own",
}
"""What the curves are, by where they began."""


def branch(
    ship: ShipName,
    heading: Heading,
    speed: Speed,
    wave_length: WaveLength,
    wave_height: WaveHeight,
    changes: Changes,
    over: Annotated[
        str,
        typer.Option(
            help="What changes: wave_height, heading, speed, wave_length, frequency, gm, .. or a term, K_ppp."
        ),
    ] = "wave_height",
    limits: Annotated[str | None, typer.Option(help="From and to: 1:6 [m], 20:160 [deg], 5kn:15kn.")] = None,
    harmonics: Harmonics = _USUAL_HARMONICS,
    output: PictureOrData = None,
    modes: Modes = "three",
) -> Answer:
    """Follow every motion over one parameter: folds, bifurcations, what is stable."""
    from quartering.motion.modes import in_six
    from quartering.stability.precompile import announce_compilation
    from quartering.study.branches.branch import branch as follow_branches
    from quartering.view.wording import ship_notes, speed_words

    six = in_six(modes)
    if six and harmonics != _USUAL_HARMONICS:
        raise InputError("--modes six has harmonics of its own; leave --harmonics out")
    asked: ModesOf = modes  # type: ignore[assignment]
    typed = Typed(ship, heading, speed, wave_length, wave_height, changes)
    one, wave, u, mu = typed.read()
    path = reserve_path(output, (*PICTURES, ".nc", *TABLES))
    ends = _limits(one, wave, over, limits)
    announce_compilation()
    with working("following the motions"):
        ds = follow_branches(one, over, limits=ends, harmonics=harmonics, wave=wave, speed=u, heading=mu, modes=asked)

    def draw() -> Figure:
        from quartering.view.plots.branch import branch_picture

        held = {"speed": speed_words(u, one.hull.length), "heading": f"heading {mu:g} deg"}
        held |= {"wave_length": f"wave length {wave.length:.4g} m", "wave_height": f"wave height {wave.height:.3g} m"}
        title = f"{one.name}: " + ", ".join(words for key, words in held.items() if key != over)
        return branch_picture(ds, over, title, ship_notes(one), asked=_asked(typed, over))

    def facts() -> dict[str, object]:
        found = {"ship": one.name, "over": over, "curves": _curves(ds, over), "events": _events(ds, over)}
        return found | {"written": None if path is None else str(path)}

    again = f" --harmonics {harmonics}" if harmonics != _USUAL_HARMONICS else ""
    again += f" --limits {limits}" if limits is not None else ""
    in_modes = " --modes six" if six else ""
    return Answer(
        _lines(ds, over, one),
        facts,
        dataset_or_picture(path, ds, draw),
        next_steps=_next(ds, typed, over, again + in_modes if path is None else None, in_modes),
        output=path,
        data=lambda: [data_table(ds, f"{one.name}: points of the curves", along=["point"])],
    )


def _asked(typed: Typed, over: str) -> float | None:
    """What was typed of the parameter that changes: where the condition stands on the curves."""
    one = typed.read()[0]
    text = (typed.condition | dict(typed.changes)).get(over)
    return None if text is None else value(text, OPTIONS[over], one.sizes, OPTIONS[over].command)


def _limits(one: Ship, wave: Wave, over: str, text: str | None) -> tuple[float, float] | None:
    """The two ends as typed, None for those of `quartering.branch`; no wave between them breaks.

    Raises
    ------
    InputError    not two values, a wave too steep at one of them
    """
    from quartering.loads.waves import STEEPEST, Wave
    from quartering.study.grid import CONDITION_AXES
    from quartering.study.loadings import LOADING_AXES

    if text is None and over == "wave_height":
        return 0.5 * wave.height, min(1.5 * wave.height, _UNBROKEN * STEEPEST * wave.length)
    if text is None and over == "wave_length":
        return max(0.5 * wave.length, wave.height / (_UNBROKEN * STEEPEST)), 1.5 * wave.length
    if text is None:
        return None
    ends = text.split(":")
    if len(ends) != 2:
        raise InputError(f'--limits "{text}": give two values, from:to, such as 1:6')
    kind: Option | Literal["ratio"] = OPTIONS[over] if over in (*CONDITION_AXES, *LOADING_AXES) else "ratio"
    low, high = (value(end, kind, one.sizes, "--limits") for end in ends)
    if over == "wave_height" and high > low:
        Wave(wave.length, high)  # refuses one that breaks
    if over == "wave_length" and high > low > 0.0:
        Wave(low, wave.height)
    return low, high


def _curves(ds: xr.Dataset, over: str) -> list[dict[str, object]]:
    """Each curve in numbers."""
    import numpy as np

    from quartering.stability.kind import Kind

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
    import numpy as np

    at = np.flatnonzero(ds["event"] != "")
    return [
        {
            "event": str(ds["event"].values[i]), over: float(ds[over][i]),
            "roll_peak_deg": float(ds["roll_peak"][i]), "curve": int(ds["curve"][i]),
        }
        for i in at
    ]  # fmt: skip


def _lines(ds: xr.Dataset, over: str, one: Ship) -> Iterator[Table | str]:
    """The curves, and where stability changes along them."""
    import numpy as np

    from quartering.stability.kind import Kind
    from quartering.view.wording import ship_notes

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
    yield table("Curves of motions", ("curve", "what", along, "largest roll [deg]", "points stable"), curves, (3, 4))
    rows = [
        (str(e["event"]), f"{e[over]:.6g}", f"{e['roll_peak_deg']:.3g}", str(e["curve"])) for e in _events(ds, over)
    ]
    if rows:
        yield table("Where stability changes", ("event", along, "largest roll [deg]", "curve"), rows, (1, 2))
    else:
        kinds = [Kind(int(k)).label for k in np.unique(ds["verdict"])]
        yield (
            f"Stability does not change between these limits: {kinds[0]} throughout."
            if len(kinds) == 1
            else "Stability does not change along any of these curves."
        )
    yield ship_notes(one)


def _next(ds: xr.Dataset, typed: Typed, over: str, again: str | None, more: str) -> list[str]:
    """What to type next: a verdict at the first event, the basin, and the picture where ``again`` tells its options.

    more: options of the verdict; there is no basin with them
    """
    given, ship, words = typed.condition, typed.ship_words, typed.words
    steps = [] if again is None else [f"quartering branch {ship} {words} --over {over}{again} -o branch.png"]
    events = _events(ds, over)
    if events and over in SYMBOLS and over in given:
        there = " ".join(
            f"{OPTIONS[key].command} {events[0][over] if key == over else text:.5}" for key, text in given.items()
        )
        steps.append(f"quartering verdict {ship} {there}{more}")
    return [*steps, *([] if more else [f"quartering basin {ship} {words} -o basin.png"])]
