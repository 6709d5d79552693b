"""`quartering criteria`: the five failure modes of second-generation intact stability."""

from __future__ import annotations

import math
from collections.abc import Mapping

import xarray as xr

from quartering.hull.ship import Ship
from quartering.options import OPTIONS
from quartering.stability.ahead import announce_compilation
from quartering.study.criteria.judged import criteria
from quartering.study.criteria.limiting_kg import BELOW, FOUND, limiting_kg
from quartering.study.criteria.record import FORM, LABELS, MODES, Criteria, Judgement
from quartering.view.commands.conditions import typed_ship
from quartering.view.options import values
from quartering.view.ship_options import option_words
from quartering.view.terminal import next_steps, show, show_json, table


def judge_criteria(name: str, speed: str | None, changes: Mapping[str, str], as_json: bool) -> None:
    """Print every level of every failure mode, with its numbers, limits and what was not judged."""
    one = typed_ship(name, changes)
    announce_compilation()
    found = criteria(one, speed)
    if as_json:
        show_json(_facts(found))
        return
    rows = [_row(judgement) for mode in MODES for judgement in (found.of(mode, 1), found.of(mode, 2))]
    title = f"{found.ship}: {found.loading}"
    show(table(title, ("failure mode", "level", "verdict", "why", "numbers"), rows))
    for note in dict.fromkeys(note for judgement in found.judgements for note in judgement.notes):
        show(f"Assumed: {note}.")
    recalled = [constant for constant in found.constants if constant.status.startswith("recalled")]
    show(
        f"{FORM}: {len(recalled)} of {len(found.constants)}; see `--json` for each with its place. It shows no compliance."
    )
    again = option_words(changes)
    told = f" --speed {speed}" if speed is not None else " --speed 15kn"
    show(next_steps(f"quartering criteria {name}{told}{again} --json", f"quartering hull {name}{again}"))


def limit_heights(
    name: str, speed: str | None, draughts: str | None, changes: Mapping[str, str], as_json: bool
) -> None:
    """Print the limiting heights of G over the draughts, and the ship's loadings beside them."""
    one = typed_ship(name, changes)
    announce_compilation()
    wanted = None if draughts is None else values([draughts], OPTIONS["draught"], one.sizes, "--draughts", 5)
    found = limiting_kg(one, wanted, speed)
    loadings = [_loading(one, case) for case in one.value("loadings") or ()]
    if as_json:
        show_json(found.to_dict() | {"loadings": loadings})
        return
    rows = []
    for criterion in found["criterion"].values:
        own = found.sel(criterion=criterion)
        cells = [_limit(own.isel(draught=i)) for i in range(found.sizes["draught"])]
        odd = "" if bool(own["monotone"].all()) else "not monotone in KG: the widest range"
        mode, _, level = str(criterion).partition(".level")
        rows.append((f"{LABELS[mode]}, level {level}", *cells, odd))
    heads = [f"T {draught:.4g} m" for draught in found["draught"].values]
    show(table(f"{one.name}: limiting KG [m over the keel]", ("failure mode", *heads, "remark"), rows))
    for loading in loadings:
        show(f"Loading {loading['name']}: draught {loading['draught']:.4g} m, KG {loading['kg']:.4g} m.")
    show(f"{FORM}. It shows no compliance.")


def _loading(one: Ship, case: str) -> dict[str, object]:
    loaded = one.with_(loading_case=case)
    return {"name": case, "draught": loaded.hull.draught, "kg": loaded.loading.kg}


def _limit(cell: xr.Dataset) -> str:
    if int(cell["found"]) != BELOW:
        return FOUND[int(cell["found"])]
    low, high = float(cell["kg_min"]), float(cell["kg_max"])
    if math.isnan(low):
        return f"up to {high:.3f}"
    return f"from {low:.3f}" if math.isnan(high) else f"{low:.3f} to {high:.3f}"


def _row(judgement: Judgement) -> tuple[str, ...]:
    numbers = ", ".join(
        f"{one.name} {one.value:.3g}{'' if one.unit in ('', '1') else f' {one.unit}'}"
        for one in judgement.quantities
        if math.isfinite(one.value)
    )
    return LABELS[judgement.mode], str(judgement.level), judgement.verdict, judgement.reason, numbers


def _facts(found: Criteria) -> dict[str, object]:
    """Everything for programs, the cases of sums and the constants with their status among it."""
    return {
        "ship": found.ship, "loading": found.loading, "sentence": found.sentence,
        "judgements": [
            {
                "mode": one.mode, "level": one.level, "verdict": one.verdict, "vulnerable": one.vulnerable,
                "applies": one.applies, "reason": one.reason, "notes": one.notes, "cases": one.cases,
                "quantities": {q.name: {"value": q.value, "unit": q.unit, "meaning": q.meaning} for q in one.quantities},
            }
            for one in found.judgements
        ],
        "constants": [constant._asdict() for constant in found.constants],
    }  # fmt: skip
