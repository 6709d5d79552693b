"""`quartering figures`: the figures of the paper recomputed, or its claims measured."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from quartering.conventions import InputError
from quartering.view.command._scoreboard import measure_claims
from quartering.view.console.answer import Answer
from quartering.view.console.files import PICTURES, File, folder_named, reserve_path, write_files
from quartering.view.console.printed import table
from quartering.view.console.progress import bar

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.table import Table

    from quartering.study.paper.points import Point

_RANGE = re.compile(r"(\d+)(?:-(\d+))?")


def figures(
    numbers: Annotated[list[str] | None, typer.Argument(help="Which: 6, 14-16; by default all 23.")] = None,
    output: Annotated[
        str | None,
        typer.Option(
            "-o", "--output", help='Folder to write them to, "figures" by default; with --scoreboard a page (.md).'
        ),
    ] = None,
    kind: Annotated[list[str] | None, typer.Option(help="png, svg or pdf, repeatable; by default png.")] = None,
    points: Annotated[
        str | None, typer.Option(help="Folder of points read from the printed figures: fig06.csv, ..")
    ] = None,
    scoreboard: Annotated[bool, typer.Option("--scoreboard", help="Measure the paper's claims instead.")] = False,
) -> Answer:
    """Recompute the figures of Haddara (1971) from real hulls, or measure its claims."""
    from quartering.stability.precompile import announce_compilation
    from quartering.study.paper.points import read_points
    from quartering.view.plots.paper_figures import FIGURES

    if scoreboard:
        if numbers or kind or points:
            raise InputError("--scoreboard measures all claims; leave figure numbers, --kind and --points out")
        return measure_claims(output)
    wanted = chosen(numbers or [])
    endings = [_ending(one) for one in kind or ["png"]]
    read = read_points(points, list(FIGURES)) if points is not None else {}
    folder = folder_named("figures" if output is None else output)
    if folder.exists() and not folder.is_dir():
        raise InputError(f'output "{folder}" is a file; give a folder for the figures, such as figures')
    announce_compilation()
    files = _drawn(folder, wanted, endings, read)

    def lines() -> Iterator[Table | str]:
        rows = [
            (str(n), FIGURES[n].words, ", ".join(f.name for f in files[n]), str(len(read.get(n, [])) or ""))
            for n in wanted
        ]
        yield table(f"Haddara (1971) recomputed, in {folder}/", ("figure", "what", "file", "points"), rows, (0, 3))
        yield (
            "The conditions are ours and most coefficients are estimated: each figure says so. Floquet exponents stand beside "
            "K2."
        )

    def facts() -> dict[str, object]:
        entries = [{"number": n, "words": FIGURES[n].words, "files": [str(f) for f in files[n]]} for n in wanted]
        return {"figures": entries, "points": {n: len(p) for n, p in read.items()}}

    unstable = "--heading 15 --speed 0.25Fn --wave-length 1.5L --wave-height 9"
    return Answer(
        lines(),
        facts,
        next_steps=["quartering duffing -o duffing.png", f"quartering verdict series60-cb60 {unstable}"],
        written="",
    )


def _drawn(
    folder: Path, wanted: Sequence[int], endings: Sequence[str], points: Mapping[int, Sequence[Point]]
) -> dict[int, list[Path]]:
    """Draw the figures into a folder, which is made where there is none, and goes again where none could be drawn."""
    made = not folder.exists()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            f'output "{folder}" cannot be made ({error.strerror}); give a folder you may write to'
        ) from None
    try:
        return _write(folder, wanted, endings, points)
    finally:
        if made and not any(folder.iterdir()):
            folder.rmdir()


def chosen(numbers: Sequence[str]) -> list[int]:
    """Numbers of figures from words such as "6" and "14-16"; all when none is given.

    Examples
    --------
    >>> chosen(["14-16", "6"])
    [6, 14, 15, 16]
    """
    from quartering.view.plots.paper_figures import FIGURES

    found: set[int] = set()
    for text in numbers:
        match = _RANGE.fullmatch(text.strip())
        first, last = (int(match[1]), int(match[2] or match[1])) if match else (0, 0)
        if not (first in FIGURES and last in FIGURES and first <= last):
            raise InputError(f'figure "{text}": the paper has figures 1 to {max(FIGURES)}; try 6, or 14-16')
        found.update(range(first, last + 1))
    return sorted(found or FIGURES)


def _ending(kind: str) -> str:
    ending = f".{kind.lower().lstrip('.')}"
    if ending not in PICTURES:
        raise InputError(f'--kind "{kind}": a picture is {", ".join(p[1:] for p in PICTURES)}; try png')
    return ending


def _write(
    folder: Path, wanted: Sequence[int], endings: Sequence[str], points: Mapping[int, Sequence[Point]]
) -> dict[int, list[Path]]:
    """Draw each figure once and write it as every kind; nothing is in place before all are."""
    from quartering.view.plots import style
    from quartering.view.plots.paper_figures import draw_figure
    from quartering.view.plots.paper_points import draw_points

    files = {n: [reserve_path(folder / f"fig{n:02d}{ending}", PICTURES) for ending in endings] for n in wanted}
    with bar("figures", len(wanted)) as progress:

        def writer(number: int, done: int) -> Callable[[Path], None]:
            def draw(part: Path) -> None:
                if number not in drawn:
                    drawn.clear()
                    drawn[number] = draw_figure(number)
                    draw_points(drawn[number], points.get(number, ()), number)
                style.save(drawn[number], part)
                progress(done, len(wanted))

            return draw

        drawn: dict[int, Figure] = {}
        write_files(*[File(path, writer(n, i)) for i, n in enumerate(wanted, 1) for path in files[n]])
    return files
