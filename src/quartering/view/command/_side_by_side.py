"""`quartering polar a.yaml b.yaml`: two ships, or two loadings of one, over the same conditions."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from quartering.conventions import InputError
from quartering.view.command._map_axes import MapAxes, mapped
from quartering.view.command._map_summary import Summary, summary_of
from quartering.view.console.answer import Answer
from quartering.view.console.files import File, picture_files, ship_stem
from quartering.view.console.printed import Table, table
from quartering.view.console.progress import bar
from quartering.view.console.ship_options import option_words
from quartering.view.console.tables import data_table
from quartering.view.console.typed_ship import typed_ship

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from quartering.hull.ship import Ship
    from quartering.loads.forces import Form

_THOUSANDS = 1e4
_ALIKE = 1e-6
"""Lengths nearer than this are the same."""


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
    labels = [one.name, f"{one.name}, {beside}"] if of_one else told_apart((one, other), (ship, beside))
    maps = []
    for which in (one, other):
        with bar(f"conditions, {which.name}", axes.conditions) as progress:
            maps.append(mapped(which, axes, harmonics, form, progress=progress))
    ds = map_difference(maps, labels)
    summaries = [
        [summary_of(who, m.isel(speed=i)) for i in range(m.sizes["speed"])]
        for who, m in zip((one, other), maps, strict=True)
    ]
    said = _warned((one, other), labels, same_name=not of_one and one.name == other.name)
    path, picture = files

    def draw() -> Figure:
        from quartering.view.plots.difference_map import difference_map

        title = f"{labels[1]} less {labels[0]}: largest roll in regular waves, {wave_words(maps[0])}"
        return difference_map(ds, one.hull.length, title, " ".join([*said, *notes(maps[0])]))

    def lines() -> Iterator[Table | str]:
        yield _table((one, other), labels, maps, summaries)
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
    from quartering._machine.digest import fingerprint

    cases = _cases(one)
    if beside in cases:
        other = typed_ship(ship, {**changes, "loading_case": beside})
    else:
        try:
            other = typed_ship(beside, changes)
        except InputError as error:
            known = f"; loading cases of {one.name} are {', '.join(cases)}" if cases else ""
            raise InputError(f"{error}{known}") from None
    if fingerprint(other) == fingerprint(one):
        raise InputError(
            f'"{ship}" and "{beside}" are one ship, loaded alike; give another ship or loading to compare it with'
        )
    return other


def _cases(one: Ship) -> tuple[str, ...]:
    """Names of the loading cases of a ship."""
    return tuple(one.value("loadings") or ())


def told_apart(ships: Sequence[Ship], typed: Sequence[str]) -> list[str]:
    """What two ships are called: their names, and what was typed of them where that is the same."""
    names = [one.name for one in ships]
    if len(set(names)) == len(names):
        return names
    stems = [ship_stem(text) for text in typed]
    words = stems if len(set(stems)) == len(stems) else [str(i + 1) for i in range(len(names))]
    return [f"{name} ({word})" for name, word in zip(names, words, strict=True)]


def _warned(ships: Sequence[Ship], labels: Sequence[str], *, same_name: bool) -> list[str]:
    """What the reader of a comparison should know: ships of one name, and of other sizes."""
    said = []
    if same_name:
        said.append(
            f"Both are called {ships[0].name}; they are told apart by what was typed: {labels[0]}, {labels[1]}."
        )
    sizes = [(one.hull.length, one.hull.beam, one.hull.draught) for one in ships]
    if any(not math.isclose(a, b, rel_tol=_ALIKE) for a, b in zip(sizes[0][:2], sizes[1][:2], strict=True)):
        lengths = " and ".join(f"{length:.4g} x {beam:.4g} m" for length, beam, _ in sizes)
        said.append(
            f"The ships are of other sizes (L x B {lengths}): both meet the same waves and speeds in metres; Fn and λ/L are "
            f"those of {labels[0]}."
        )
    return said


def _table(
    ships: Sequence[Ship], labels: Sequence[str], maps: Sequence[xr.Dataset], summaries: Sequence[Sequence[Summary]]
) -> Table:
    """The one table: what the ships are, and what stands out at each speed."""
    from quartering.hull.hydrostatics import hydrostatics

    floats = [hydrostatics(one) for one in ships]
    rows = [
        _row("length [m]", [one.hull.length for one in ships]),
        _row("beam [m]", [one.hull.beam for one in ships]),
        _row("draught [m]", [one.hull.draught for one in ships]),
        _row("displacement [t]", [h.displacement for h in floats]),
        _row("GM [m]", [one.loading.gm for one in ships]),
        _row("KG [m]", [one.loading.kg for one in ships]),
        _row("roll gyradius k_xx [m]", [one.loading.gyradius_roll for one in ships]),
        _row("natural roll frequency [rad/s]", [float(m.attrs["natural_roll_frequency"]) for m in maps]),
    ]
    for pair in zip(*summaries, strict=True):
        at = f"at {pair[0].speed:.3g} m/s"
        rows.append(_row(f"largest roll [deg], {at}", [one.worst_roll for one in pair]))
        rows.append((f"  where, {at}", *(_where(one) for one in pair), ""))
        rows.append(_row(f"unstable cells [%], {at}", [100 * one.unstable_share for one in pair]))
        if any(one.capsize_on_the_way for one in pair):
            rows.append(
                _row(f"capsizes on the way [%], {at}", [100 * one.capsize_on_the_way / one.cells for one in pair])
            )
        if any(one.no_answer for one in pair):
            rows.append(_row(f"no answer [%], {at}", [100 * sum(one.no_answer.values()) / one.cells for one in pair]))
        course = [float(one.calm_water.real.max()) for one in pair]
        rows.append(_row(f"calm-water exponent [1/s], {at}", course))
    return table("Side by side", ("", *labels, "difference"), rows, (1, 2, 3))


def _row(words: str, values: Sequence[float]) -> tuple[str, ...]:
    first, second = values
    return words, _figures(first), _figures(second), f"{second - first:+.3g}" if abs(second - first) > 1e-9 else "0"


def _figures(value: float) -> str:
    """Four figures, and thousands in full."""
    return f"{value:.0f}" if abs(value) >= _THOUSANDS else f"{value:.4g}"


def _where(one: Summary) -> str:
    return f"{one.heading:g} deg, {one.wave_length:.4g} m" if math.isfinite(one.heading) else "no answer"


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
