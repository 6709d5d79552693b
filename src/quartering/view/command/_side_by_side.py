"""`quartering polar a.yaml b.yaml`: two ships, or two loadings of one, over the same conditions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from quartering.conventions import InputError
from quartering.view.command._map_axes import MapAxes, mapped
from quartering.view.console.answer import Answer
from quartering.view.console.files import File, picture_files, ship_stem
from quartering.view.console.printed import Table, table
from quartering.view.console.progress import bar
from quartering.view.console.ship_options import option_words
from quartering.view.console.tables import data_table
from quartering.view.console.typed_ship import typed_ship
from quartering.view.map_summary import Summary, summary_of
from quartering.view.side_by_side import ALIKE, alike, comparison_rows, told_apart, warned

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from quartering.hull.ship import Ship
    from quartering.loads.forces import Form


def side_by_side(
    one: Ship,
    ship: str,
    beside: str,
    changes: Mapping[str, str],
    axes: MapAxes,
    harmonics: int,
    form: Form,
    files: tuple[Path, Path | None],
) -> Answer:
    """Answer of `quartering polar` with two ships.

    ship, beside: as typed
    files: dataset or tables, and picture
    """
    from quartering.study.maps.compare import map_difference
    from quartering.view.wording import notes, wave_words

    other = _other(one, ship, beside, changes)
    of_one = beside in _cases(one)
    labels = (
        [one.name, f"{one.name}, {beside}"]
        if of_one
        else told_apart((one, other), [ship_stem(typed) for typed in (ship, beside)])
    )
    maps = []
    for which in (one, other):
        with bar(f"conditions, {which.name}", axes.conditions) as progress:
            maps.append(mapped(which, axes, harmonics, form, progress=progress))
    ds = map_difference(maps, labels)
    summaries = [
        [summary_of(who, m.isel(speed=i)) for i in range(m.sizes["speed"])]
        for who, m in zip((one, other), maps, strict=True)
    ]
    said = warned((one, other), labels, same_name=not of_one and one.name == other.name)
    path, picture = files

    def draw() -> Figure:
        from quartering.view.plots.difference_map import difference_map

        title = f"{labels[1]} less {labels[0]}: largest roll in regular waves, {wave_words(maps[0])}"
        return difference_map(ds, one.hull.length, title, " ".join([*said, *notes(maps[0])]))

    def lines() -> Iterator[Table | str]:
        yield table(
            "Side by side", ("", *labels, "difference"), comparison_rows((one, other), maps, summaries), (1, 2, 3)
        )
        yield from said
        for label, m in zip(labels, maps, strict=True):
            yield f"{label}: {' '.join(notes(m))}"

    return Answer(
        lines(),
        lambda: _facts(ds, labels, summaries) | {"files": [str(file) for file in files if file]},
        [] if picture is None else [File(path, lambda part: ds.to_netcdf(part)), *picture_files(picture, draw)],
        written=f"Wrote {path}" + ("" if picture is None else f" and {picture}"),
        next_steps=[f"quartering polar {ship if of_one else beside}{option_words(changes)}"],
        output=path,
        data=lambda: [data_table(ds, "conditions", along=("ship", "speed", "heading", "wave_length"))],
    )


def _other(one: Ship, ship: str, beside: str, changes: Mapping[str, str]) -> Ship:
    """The second ship: a loading case of the first where it has one of that name.

    Raises
    ------
    InputError    no such ship; the same ship, loaded alike
    """
    cases = _cases(one)
    if beside in cases:
        other = typed_ship(ship, {**changes, "loading_case": beside})
    else:
        try:
            other = typed_ship(beside, changes)
        except InputError as error:
            known = f"; loading cases of {one.name} are {', '.join(cases)}" if cases else ""
            raise InputError(f"{error}{known}") from None
    if alike(one, other):
        raise InputError(f'"{ship}" and "{beside}" {ALIKE}')
    return other


def _cases(one: Ship) -> tuple[str, ...]:
    """Names of the loading cases of a ship."""
    return tuple(one.value("loadings") or ())


def _facts(ds: xr.Dataset, labels: Sequence[str], summaries: Sequence[Sequence[Summary]]) -> dict[str, object]:
    """Everything for programs."""
    from quartering.study.maps.compare import Change

    change = ds["change"].values
    return {
        "ships": list(labels),
        "summaries": [[one._asdict() for one in several] for several in summaries],
        "becomes_unstable": int((change == Change.UNSTABLE).sum()),
        "becomes_stable": int((change == Change.STABLE).sum()),
        "conditions": int(change.size),
    }
