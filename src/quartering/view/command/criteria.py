"""`quartering criteria`: the five failure modes of second-generation intact stability."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated

import typer

from quartering.conventions import InputError
from quartering.options import OPTIONS
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, ShipName, TableFile
from quartering.view.console.files import TABLES, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.ship_options import option_words
from quartering.view.console.typed_ship import typed_ship
from quartering.view.console.typed_values import values
from quartering.view.criteria_words import criteria_facts, numbers_words, recalled_words

if TYPE_CHECKING:
    import xarray as xr

    from quartering.hull.ship import Ship
    from quartering.study.criteria.record import Criteria, Judgement
    from quartering.view.console.printed import Table


def criteria(
    ship: ShipName,
    changes: Changes,
    speed: Annotated[
        str | None, typer.Option(help="Service speed: 15kn, 0.25Fn; what needs it is not judged without.")
    ] = None,
    kgmax: Annotated[bool, typer.Option("--kgmax", help="Limiting heights of G of every level instead.")] = False,
    draughts: Annotated[
        str | None, typer.Option(help="Draughts of --kgmax: 5,6.5 [m], or from:to:count; by default the ship's own.")
    ] = None,
    output: TableFile = None,
) -> Answer:
    """The five failure modes of second-generation intact stability, levels 1 and 2."""
    from quartering.stability.precompile import announce_compilation
    from quartering.study.criteria.judged import criteria as judged

    path = reserve_path(output, TABLES)
    if kgmax:
        return replace(_limiting_heights(typed_ship(ship, changes), speed, draughts), output=path)
    if draughts is not None:
        raise InputError("--draughts are those of --kgmax; one draught of the ship is --draught")
    one = typed_ship(ship, changes)
    announce_compilation()
    found = judged(one, speed)
    again = option_words(changes)
    told = f" --speed {speed}" if speed is not None else " --speed 15kn"
    return Answer(
        _lines(found),
        lambda: criteria_facts(found),
        output=path,
        next_steps=[f"quartering criteria {ship}{told}{again} --json", f"quartering hull {ship}{again}"],
    )


def _lines(found: Criteria) -> Iterator[Table | str]:
    """Every level of every failure mode, with its numbers, limits and what was not judged."""
    from quartering.study.criteria.record import MODES

    rows = [_row(judgement) for mode in MODES for judgement in (found.of(mode, 1), found.of(mode, 2))]
    title = f"{found.ship}: {found.loading}"
    yield table(title, ("failure mode", "level", "verdict", "why", "numbers"), rows)
    for note in dict.fromkeys(note for judgement in found.judgements for note in judgement.notes):
        yield f"Assumed: {note}."
    yield f"{recalled_words(found)}; see `--json` for each with its place. It shows no compliance."


def _limiting_heights(one: Ship, speed: str | None, draughts: str | None) -> Answer:
    """Limiting heights of G over the draughts, and the ship's loadings beside them."""
    from quartering.stability.precompile import announce_compilation
    from quartering.study.criteria.limiting_kg import limiting_kg
    from quartering.study.criteria.record import FORM

    announce_compilation()
    wanted = None if draughts is None else values([draughts], OPTIONS["draught"], one.sizes, "--draughts", 5)
    found = limiting_kg(one, wanted, speed)
    loadings = [_loading(one, case) for case in one.value("loadings") or ()]

    def lines() -> Iterator[Table | str]:
        yield _limits(found, one.name)
        for loading in loadings:
            yield f"Loading {loading['name']}: draught {loading['draught']:.4g} m, KG {loading['kg']:.4g} m."
        yield f"{FORM}. It shows no compliance."

    return Answer(lines(), lambda: found.to_dict() | {"loadings": loadings})


def _limits(found: xr.Dataset, name: str) -> Table:
    """Limiting KG of each level over the draughts."""
    from quartering.study.criteria.record import LABELS

    rows = []
    for criterion in found["criterion"].values:
        own = found.sel(criterion=criterion)
        cells = [_limit(own.isel(draught=i)) for i in range(found.sizes["draught"])]
        odd = "" if bool(own["monotone"].all()) else "not monotone in KG: the widest range"
        mode, _, level = str(criterion).partition(".level")
        rows.append((f"{LABELS[mode]}, level {level}", *cells, odd))
    heads = [f"T {draught:.4g} m" for draught in found["draught"].values]
    return table(f"{name}: limiting KG [m over the keel]", ("failure mode", *heads, "remark"), rows)


def _loading(one: Ship, case: str) -> dict[str, object]:
    loaded = one.with_(loading_case=case)
    return {"name": case, "draught": loaded.hull.draught, "kg": loaded.loading.kg}


def _limit(cell: xr.Dataset) -> str:
    from quartering.study.criteria.limiting_kg import BELOW, FOUND

    if int(cell["found"]) != BELOW:
        return FOUND[int(cell["found"])]
    low, high = float(cell["kg_min"]), float(cell["kg_max"])
    if math.isnan(low):
        return f"up to {high:.3f}"
    return f"from {low:.3f}" if math.isnan(high) else f"{low:.3f} to {high:.3f}"


def _row(judgement: Judgement) -> tuple[str, ...]:
    from quartering.study.criteria.record import LABELS

    return LABELS[judgement.mode], str(judgement.level), judgement.verdict, judgement.reason, numbers_words(judgement)
