"""`quartering sea`: one ship in one irregular sea, every method beside the others."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from time import process_time
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from quartering.arguments import ARGUMENTS
from quartering.units import NO_SHIP
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, FormName, Heading, ShipName, Speed, TableFile
from quartering.view.console.files import TABLES, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.sea_options import (
    Gamma,
    Hs,
    SpectrumName,
    SpreadingWords,
    SwellWords,
    Tp,
    TypedSea,
    Tz,
)
from quartering.view.console.ship_options import option_words
from quartering.view.console.typed_ship import typed_ship, typed_value
from quartering.view.console.typed_values import value
from quartering.view.sea_words import METHODS, ROWS, number_words, sea_facts, sea_remarks, sea_sentence

if TYPE_CHECKING:
    import xarray as xr

    from quartering.hull.ship import Ship
    from quartering.loads.forces import Form
    from quartering.loads.sea.sea import Sea
    from quartering.view.console.printed import Table


def sea(
    ship: ShipName,
    hs: Hs,
    heading: Heading,
    speed: Speed,
    changes: Changes,
    tp: Tp = None,
    tz: Tz = None,
    spectrum: SpectrumName = "jonswap",
    gamma: Gamma = "3.3",
    spreading: SpreadingWords = "none",
    swell: SwellWords = None,
    hours: Annotated[str, typer.Option(help="Hours to simulate, 32 at a time: 1000; 0 for no simulation.")] = "32",
    form: FormName = "stf",
    output: TableFile = None,
) -> Answer:
    """Judge a ship in an irregular sea: roll, largest roll of three hours and stability, by every method there is."""
    from quartering.view.wording import ship_notes

    one = typed_ship(ship, changes)
    u = typed_value("speed", speed, one.sizes)
    waves = TypedSea(heading, hs, tp, tz, spectrum, gamma, spreading, swell).read(one.sizes)
    path = reserve_path(output, TABLES)
    chosen: Form = form  # type: ignore[assignment]  # sea_response refuses an unknown one
    found = _answers(one, waves, u, chosen, _hours(hours))

    def lines() -> Iterator[Table | str]:
        best = found["closure"].result
        yield sea_sentence(one, waves, u, best)
        yield _table(found)
        yield from sea_remarks(best)
        if "simulation" in found:
            yield from _of_simulation(found["simulation"].result)
        yield ship_notes(one)

    words = f"--heading {heading} --speed {speed} --wave-period {waves.tp:.3g}s --wave-height {waves.hs:.3g}"
    return Answer(
        lines(),
        lambda: _facts(one, waves, u, found),
        output=path,
        next_steps=[f"quartering verdict {ship} {words}{option_words(changes)}"],
    )


class Found(NamedTuple):
    """The answer of one method, and the processor time it took [s]."""

    result: xr.Dataset
    cost: float


def _answers(one: Ship, waves: Sea, speed: float, form: Form, hours: float) -> dict[str, Found]:
    """The answer of each method; of the simulation where it has hours."""
    from quartering.study.seas.response import sea_response
    from quartering.study.seas.simulated.simulation import irregular

    found: dict[str, Found] = {}
    for method in METHODS:
        sea_response(one, waves, speed, method=method, form=form)  # type: ignore[arg-type]  # compiled and tabled: not its cost
        begun = process_time()
        result = sea_response(one, waves, speed, method=method, form=form)  # type: ignore[arg-type]
        found[method] = Found(result, process_time() - begun)
    if hours > 0:
        irregular(one, waves, speed, form=form)  # compiled: not its cost
        begun = process_time()
        result = irregular(one, waves, speed, hours=hours, form=form)
        found["simulation"] = Found(result, process_time() - begun)
    return found


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


def _table(found: Mapping[str, Found]) -> Table:
    rows = [(words, *(number_words(one.result, name) for one in found.values())) for words, name in ROWS]
    rows.append(("processor time [s]", *(f"{one.cost:.2g}" for one in found.values())))
    errors, names = [error for _, error in METHODS.values()], [words for words, _ in METHODS.values()]
    if "simulation" in found:
        at = found["simulation"].result
        errors.append(f"{float(at['roll_rms_error'] / at['roll_rms']):.1%} standard error")
        names.append(f"simulation, {float(at['exposure']):.4g} h")
    rows.append(("error of roll RMS; of the first two as found in twelve seas", *errors))
    hours = found["closure"].result.attrs["hours"]
    return table(f"Response; largest of {hours:g} h", ("quantity", *names), rows, right=tuple(range(1, len(names) + 1)))


def _facts(one: Ship, sea: Sea, speed: float, found: Mapping[str, Found]) -> dict[str, Any]:
    """Everything about the sea, for programs: what `quartering sea --json` prints."""
    told = sea_facts(one, sea, speed, {method: at.result for method, at in found.items() if method in METHODS})
    for method, of_method in told["methods"].items():
        of_method["processor_time"] = found[method].cost
    return told | ({"simulation": _simulated_facts(found["simulation"])} if "simulation" in found else {})


def _simulated_facts(found: Found) -> dict[str, Any]:
    """Numbers of a simulation, without those of each block, and what it rests on."""
    at = found.result
    numbers = {str(name): at[name].values.tolist() for name in at.data_vars if not at[name].dims}
    return {
        "processor_time": found.cost,
        **numbers,
        **{name: at.attrs[name] for name in ("seed", "hours", "step", "memory")},
    }
