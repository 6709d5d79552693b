"""`quartering basin`: the safe basin of a wave, and how waves erode it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

import typer

from quartering.conventions import InputError
from quartering.options import OPTIONS
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import Changes, Heading, Picture, ShipName, Speed, WaveHeight, WaveLength
from quartering.view.console.files import PICTURES, TABLES, picture_files, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.progress import bar
from quartering.view.console.typed_ship import Typed
from quartering.view.console.typed_values import values

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from quartering.hull.ship import Ship
    from quartering.loads.waves import Wave
    from quartering.study.condition.basin_integrity import Integrity
    from quartering.view.console.printed import Table

_HEIGHTS, _MOST_HEIGHTS = 9, 200


def basin(
    ship: ShipName,
    heading: Heading,
    speed: Speed,
    wave_length: WaveLength,
    wave_height: WaveHeight,
    changes: Changes,
    wave_heights: Annotated[
        str | None, typer.Option(help="Heights of the integrity curve: 0:8:9 [m]; by default up to twice the height.")
    ] = None,
    periods: Annotated[int, typer.Option(help="Wave periods to go on for.")] = 16,
    output: Picture = None,
) -> Answer:
    """From which roll angles and rates the ship survives a wave, and how waves erode that safe basin."""
    from quartering.hydro.capsize import capsize_limit
    from quartering.stability.precompile import announce_compilation
    from quartering.study.condition.basin_integrity import basin_integrity
    from quartering.view.wording import ship_notes, speed_words

    typed = Typed(ship, heading, speed, wave_length, wave_height, changes)
    one, wave, u, mu = typed.read()
    path = reserve_path(output, (*PICTURES, *TABLES))
    heights = _heights(one, wave, wave_heights)
    announce_compilation()
    with bar("waves", len({*heights, wave.height})) as progress:
        found = basin_integrity(one, wave, u, mu, heights, periods=periods, progress=progress)
    limit, at = capsize_limit(one), found.at(wave.height)

    def draw() -> Figure:
        from quartering.view.plots.basin import basin_picture

        title = f"{one.name}: heading {mu:g} deg, {speed_words(u, one.hull.length)}, wave length {wave.length:.4g} m"
        curve = (found.wave_height, found.integrity)
        return basin_picture(found.basins[at], curve, wave.height, limit.words, title, ship_notes(one))

    def lines() -> Iterator[Table | str]:
        yield (
            f"In waves of {wave.height:g} m, {found.integrity[at]:.1%} of the starts that are safe in calm water stay below "
            f"{limit.words}, for {periods} wave periods."
        )
        yield _curve(found)
        yield ship_notes(one)

    def facts() -> dict[str, object]:
        return {
            "ship": one.name, "heading": mu, "speed": u, "wave_length": wave.length, "wave_height": wave.height,
            "capsize_angle_deg": limit.angle, "capsize_reason": limit.reason, "periods": periods,
            "integrity": float(found.integrity[at]), "curve": _curve_facts(found),
            "picture": None if path is None else str(path),
        }  # fmt: skip

    first = [f"quartering basin {typed.ship_words} {typed.words} -o basin.png"] if path is None else []
    return Answer(
        lines(),
        facts,
        picture_files(path, draw),
        output=path,
        next_steps=[*first, f"quartering branch {typed.ship_words} {typed.words} --over wave_height"],
    )


def _heights(one: Ship, wave: Wave, typed: str | None) -> list[float]:
    """Wave heights of the integrity curve: calm water, and those typed, or up to twice the height of the wave [m].

    Raises
    ------
    InputError    more than a person waits for
    """
    from quartering.loads.waves import STEEPEST

    top = min(2.0 * wave.height, 0.999 * STEEPEST * wave.length)
    chosen = [0.0, *values([typed or f"0:{top}"], OPTIONS["wave_height"], one.sizes, "--wave-heights", _HEIGHTS)]
    if len(chosen) > _MOST_HEIGHTS:
        raise InputError(
            f'--wave-heights "{typed}": {len(chosen):,} heights, each with a basin of its own; give up to {_MOST_HEIGHTS}'
        )
    return chosen


def _curve(found: Integrity) -> Table:
    """Safe share and integrity over wave height."""
    columns = (found.wave_height, found.safe_share, found.integrity)
    rows = [(f"{h:.3g}", f"{s:.1%}", f"{q:.1%}") for h, s, q in zip(*columns, strict=True)]
    return table(
        "Integrity of the safe basin", ("wave height [m]", "of all starts", "of the safe ones"), rows, (0, 1, 2)
    )


def _curve_facts(found: Integrity) -> list[dict[str, float]]:
    """The same, for programs."""
    columns = (found.wave_height, found.safe_share, found.integrity)
    return [{"wave_height": h, "safe_share": s, "integrity": q} for h, s, q in zip(*columns, strict=True)]
