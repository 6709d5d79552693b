"""`quartering show`: what a stored result holds, nothing computed again."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from quartering.conventions import InputError
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Picture
from quartering.view.console.files import PICTURES, TABLES, File, picture_files, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.tables import map_table

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from quartering.view.console.printed import Table


def show(
    result: Annotated[str, typer.Argument(help="Folder of a sweep, or a .nc file.")],
    at: Annotated[
        list[str] | None,
        typer.Option(help="Cut at wave_height=4, steepness=1/30, gm=0.7, .., repeatable; the nearest value is taken."),
    ] = None,
    output: Picture = None,
    csv: Annotated[str | None, typer.Option(help="Table of the cut to write (.csv).")] = None,
    zarr: Annotated[str | None, typer.Option(help="Zarr store of the cut to write (a new folder).")] = None,
) -> Answer:
    """What a stored result holds: the worst of every speed and heading; its map, or a table, without computing again."""
    from quartering.study.maps.query import cut, worst_by, write_csv
    from quartering.study.maps.stored.zarr_store import write_zarr
    from quartering.view.stored import map_of, opened

    picture, target = reserve_path(output, (*PICTURES, *TABLES)), reserve_path(csv, (".csv",))
    ds, where = opened(result), dict(split_cut(typed) for typed in at or [])
    if "recommended" in ds:
        return _guidance(ds, result, where, picture, target, zarr)
    part = cut(ds, **where)
    taken = {name: float(part[name]) for name in where if not part[name].dims}
    if zarr is not None:
        write_zarr(part, zarr)

    def draw() -> Figure:
        from quartering.view.plots.polar_map import polar_map

        return polar_map(map_of(part))

    files = [] if target is None else [File(target, lambda half: write_csv(part, half))]
    by = worst_by(part, [dim for dim in ("speed", "heading") if dim in part["verdict"].dims])
    written = {
        "picture": str(picture) if picture else None, "table": str(target) if target else None, "zarr": zarr
    }  # fmt: skip
    return Answer(
        _lines(ds, part, by, taken),
        lambda: _facts(ds, by) | {"at": taken} | written,
        [*files, *picture_files(picture, draw)],
        output=picture,
        data=lambda: [map_table(part)],
        written="\n".join(f"Wrote {path}" for path in written.values() if path),
        next_steps=[f"quartering worst {result}", f"quartering show {result}{_example(ds)} -o map.png --csv slice.csv"],
    )


def _guidance(
    ds: xr.Dataset, result: str, where: Mapping[str, float], picture: Path | None, target: Path | None, zarr: str | None
) -> Answer:
    """What a stored result in irregular seas holds: advice in each sea, and its diagrams."""
    from quartering.study.maps.stored.zarr_store import write_zarr
    from quartering.view.command._sea_polar import guidance_lines
    from quartering.view.sea_words import guidance_facts
    from quartering.view.stored import sea_part

    part = sea_part(ds, where)
    if zarr is not None:
        write_zarr(part, zarr)

    def draw() -> Figure:
        from quartering.view.plots.sea_polar import sea_polar

        return sea_polar(part)

    def write(half: Path) -> None:
        part.drop_dims("line").to_dataframe().reset_index().to_csv(half, index=False)

    files = [] if target is None else [File(target, write)]
    written = {"picture": str(picture) if picture else None, "table": str(target) if target else None, "zarr": zarr}
    return Answer(
        guidance_lines(part),
        lambda: guidance_facts(part) | {"at": dict(where)} | written,
        [*files, *picture_files(picture, draw)],
        written="\n".join(f"Wrote {path}" for path in written.values() if path),
        next_steps=[f"quartering show {result} --at hs={float(ds['hs'][0]):g} -o map.png --csv slice.csv"],
    )


def _lines(ds: xr.Dataset, part: xr.Dataset, by: xr.Dataset, taken: dict[str, float]) -> Iterator[Table | str]:
    """The worst of every speed and heading of a part of a result."""
    from quartering.view.stored import head_of, short_words
    from quartering.view.wording import CALM_COURSE, value_words

    stacked = by.stack(line=[*by["roll_peak"].dims]) if by["roll_peak"].dims else by.expand_dims("line")
    rows = [_row(stacked.isel(line=i)) for i in range(stacked.sizes["line"])]
    title = f"{ds.attrs['title']}: {_sizes(ds)}"
    if taken:
        title += "; at " + ", ".join(
            f"{head_of(name, part)} {value_words(name, value, '1')}" for name, value in taken.items()
        )
    yield table(title, ("speed [m/s]", "heading [deg]", *_COLUMNS), rows, tuple(range(2 + len(_COLUMNS))))
    yield from short_words(part)
    if (share := float(by["course_unstable"].mean())) > 0:
        yield (
            f"Course-unstable in calm water: {100 * share:.1f} % of the conditions, where nothing else grows. {CALM_COURSE}"
        )


def _example(ds: xr.Dataset) -> str:
    """Options of a cut, with the first values of the result."""
    from quartering.view.stored import loading_names
    from quartering.view.wording import value_words

    names = [
        n
        for n in ("wave_height", "steepness", *loading_names(ds))
        if n in ds.coords and ds[n].dims in ((n,), ("loading",))
    ]
    return "".join(f" --at {name}={value_words(name, float(ds[name][0]), '1')}" for name in names)


def split_cut(typed: str) -> tuple[str, float]:
    """Dimension and value of "wave_height=4"; a steepness may be 1/30, as in a case file, and velocities a word.

    Examples
    --------
    >>> split_cut("wave_height=4")
    ('wave_height', 4.0)
    >>> split_cut("steepness=1/50")
    ('steepness', 0.02)
    """
    from quartering.study.loadings import CHOICE_AXES, coded

    name, sign, number = typed.partition("=")
    if name.strip() in CHOICE_AXES:
        return name.strip(), float(coded(name.strip(), number.strip()))
    above, bar, below = number.partition("/")
    try:
        return name.strip(), float(above) / (float(below) if bar else 1.0)
    except (ValueError, ZeroDivisionError):
        raise InputError(
            f'--at "{typed}"{"" if sign else " has no ="}: write it like --at wave_height=4 [m, m/s, deg]'
        ) from None


_COLUMNS = (
    "largest roll [deg]", "largest exponent [1/s]", "unstable", "no answer", "capsizes on the way", "several stable motions",
)  # fmt: skip


def _row(line: xr.Dataset) -> tuple[str, ...]:
    place = [f"{float(line[name]):.4g}" if name in line.coords else "" for name in ("speed", "heading")]
    shares = [f"{100 * float(line[name]):.1f} %" for name in ("unstable", "without_answer", "capsizing", "coexisting")]
    return (*place, f"{float(line['roll_peak']):.3g}", f"{float(line['exponent']):+.3g}", *shares)


def _facts(ds: xr.Dataset, by: xr.Dataset) -> dict[str, Any]:
    return {
        "title": ds.attrs["title"],
        "sizes": {str(name): size for name, size in ds["verdict"].sizes.items()},
        **{str(name): values.values for name, values in by.coords.items()},
        **{str(name): values.values for name, values in by.data_vars.items()},
    }


def _sizes(ds: xr.Dataset) -> str:
    def words(name: str) -> str:
        return name.replace("_", " ") + ("es" if name.endswith("s") else "s")

    sizes = ds["verdict"].sizes.items()
    return ", ".join(f"{size} {words(str(name)) if size != 1 else str(name).replace('_', ' ')}" for name, size in sizes)
