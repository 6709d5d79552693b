"""`quartering booklet`: every loading case of a ship over the same map, a line a case."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from quartering.conventions import InputError
from quartering.options import OPTIONS
from quartering.view.command._map_axes import (
    ALL_HEADINGS,
    ALL_LENGTHS,
    Headings,
    OneHeight,
    Speeds,
    Steepness,
    WaveLengths,
    mapped,
    typed_axes,
)
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, FormName, Harmonics, ShipName, TableFile
from quartering.view.console.files import TABLES, reserve_path
from quartering.view.console.printed import Table, table
from quartering.view.console.progress import bar
from quartering.view.console.ship_options import option_words
from quartering.view.console.typed_ship import typed_ship
from quartering.view.map_summary import Summary, summary_of

if TYPE_CHECKING:
    import xarray as xr

    from quartering.hull.ship import Ship
    from quartering.loads.forces import Form

AS_IT_STANDS = "as it stands"
"""The line of the loading the file itself gives."""


class Case(NamedTuple):
    """One loading case: its name, the ship so loaded, and what stands out at each speed."""

    name: str
    ship: Ship
    summaries: list[Summary]

    @property
    def worst(self) -> Summary:
        """The speed of the largest roll."""
        return max(self.summaries, key=lambda one: one.worst_roll if math.isfinite(one.worst_roll) else -1.0)


def booklet(
    ship: ShipName,
    changes: Changes,
    speed: Speeds = None,
    headings: Headings = ALL_HEADINGS,
    wave_lengths: WaveLengths = ALL_LENGTHS,
    steepness: Steepness = None,
    wave_height: OneHeight = None,
    harmonics: Harmonics = 1,
    form: FormName = "stf",
    output: TableFile = None,
) -> Answer:
    """Every loading case of a ship file over the same map: largest roll and instability, a line a case."""
    from quartering.stability.precompile import announce_compilation
    from quartering.view.wording import ship_notes, wave_words

    one = typed_ship(ship, changes)
    names = tuple(one.value("loadings") or ())
    if not names:
        raise InputError(
            f"{one.name} has no loading cases; name some in its file, such as loadings: {OPTIONS['loadings'].example}"
        )
    path = reserve_path(output, TABLES)
    axes = typed_axes(one, speed, headings, wave_lengths, steepness, wave_height)
    chosen: Form = form  # type: ignore[assignment]  # polar refuses an unknown one
    ships = {AS_IT_STANDS: one} | {name: typed_ship(ship, {**changes, "loading_case": name}) for name in names}
    announce_compilation()
    cases: list[Case] = []
    ds: xr.Dataset | None = None
    with bar("loading cases", len(ships)) as progress:
        for name, loaded in ships.items():
            ds = mapped(loaded, axes, harmonics, chosen)
            cases.append(Case(name, loaded, [summary_of(loaded, ds.isel(speed=i)) for i in range(ds.sizes["speed"])]))
            progress(len(cases), len(ships))
    assert ds is not None  # there is at least the ship as it stands
    waves = wave_words(ds)

    def lines() -> Iterator[Table | str]:
        yield _table(
            cases, f"{one.name}: loading cases, {len(axes.speeds)} speeds, {len(axes.headings)} headings, {waves}"
        )
        yield from _alike(cases)
        yield ship_notes(one)

    worst = max(cases, key=lambda case: case.worst.worst_roll if math.isfinite(case.worst.worst_roll) else -1.0)
    case = "" if worst.name == AS_IT_STANDS else f" --loading-case {worst.name}"
    return Answer(
        lines(),
        lambda: {"ship": one.name, "cases": [_facts(case) for case in cases]},
        output=path,
        next_steps=[
            f"quartering polar {ship}{case}{option_words(changes)}",
            f"quartering polar {ship} {names[0]}{option_words(changes)}",
        ],
    )


def _table(cases: Sequence[Case], title: str) -> Table:
    """A line a case: its loading, its largest roll and where, shares of its map."""
    columns = [
        "case", "T [m]", "GM [m]", "KG [m]", "displacement [t]", "roll period [s]", "largest roll [deg]",
        "heading [deg]", "speed [m/s]", "wave length [m]", "unstable [%]",
    ]  # fmt: skip
    told = [key for key in _SHARES if any(_share(case, key) > 0 for case in cases)]
    rows = []
    for case in cases:
        facts = _facts(case)
        numbers = (
            f"{number:.0f}" if abs(number) >= 1e4 else f"{number:.4g}" if math.isfinite(number) else "no answer"
            for number in (float(facts[key]) for key in _COLUMNS)
        )
        rows.append((case.name, *numbers, *(f"{_share(case, key):.3g}" for key in told)))
    return table(title, [*columns, *(_SHARES[key] for key in told)], rows, range(1, len(columns) + len(told)))


_COLUMNS = (
    "draught", "gm", "kg", "displacement", "roll_period", "largest_roll_deg", "heading", "speed", "wave_length",
    "unstable_percent",
)  # fmt: skip
_SHARES = {"capsizing": "capsizes on the way [%]", "no_answer": "no answer [%]"}


def _share(case: Case, key: str) -> float:
    """Share of the cells of all speeds [%]."""
    cells = sum(one.cells for one in case.summaries)
    if key == "capsizing":
        return 100 * sum(one.capsize_on_the_way for one in case.summaries) / cells
    return 100 * sum(sum(one.no_answer.values()) for one in case.summaries) / cells


def _facts(case: Case) -> dict[str, float | str]:
    """The case in numbers."""
    from quartering.hull.hydrostatics import hydrostatics
    from quartering.hydro.coefficients import coefficients

    one, worst = case.ship, case.worst
    cells = sum(summary.cells for summary in case.summaries)
    unstable = sum(summary.unstable_share * summary.cells for summary in case.summaries)
    return {
        "case": case.name, "draught": one.hull.draught, "gm": one.loading.gm, "kg": one.loading.kg,
        "displacement": hydrostatics(one).displacement,
        "roll_period": 2 * math.pi / coefficients(one, 0.0, 0.0).roll_frequency,
        "largest_roll_deg": worst.worst_roll, "heading": worst.heading, "speed": worst.speed,
        "wave_length": worst.wave_length, "unstable_percent": 100 * unstable / cells,
        "capsizing_percent": _share(case, "capsizing"), "no_answer_percent": _share(case, "no_answer"),
    }  # fmt: skip


def _alike(cases: Sequence[Case]) -> Iterator[str]:
    """Which cases are one loading under several names."""
    from quartering._machine.digest import fingerprint

    names: dict[str, list[str]] = {}
    for case in cases:
        numbers = (case.ship.hull, case.ship.loading)
        names.setdefault(fingerprint(list(numbers)), []).append(case.name)
    for several in names.values():
        if len(several) > 1:
            yield f"{' and '.join(several)} are one loading: their lines are equal."
