"""`quartering figures`: the figures of the paper, recomputed."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from matplotlib.figure import Figure

from quartering.conventions import InputError
from quartering.stability.ahead import announce_compilation
from quartering.study.paper.points import Point, read_points
from quartering.view.output import PICTURES, claim, folder_named, write
from quartering.view.plots import style
from quartering.view.plots.paper_figures import FIGURES, draw_figure
from quartering.view.plots.paper_points import draw_points
from quartering.view.progress import bar
from quartering.view.terminal import next_steps, show, show_json, table

_RANGE = re.compile(r"(\d+)(?:-(\d+))?")


def draw_figures(numbers: Sequence[str], output: str, kinds: Sequence[str], points: str | None, as_json: bool) -> None:
    """Compute and draw the figures asked for into a folder, all of them or none."""
    wanted = chosen(numbers)
    endings = [_ending(kind) for kind in kinds]
    given = read_points(points, list(FIGURES)) if points is not None else {}
    folder = folder_named(output)
    if folder.exists() and not folder.is_dir():
        raise InputError(f'output "{folder}" is a file; give a folder for the figures, such as figures')
    announce_compilation()
    made = not folder.exists()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            f'output "{folder}" cannot be made ({error.strerror}); give a folder you may write to'
        ) from None
    try:
        files = _write(folder, wanted, endings, given)
    finally:
        if made and not any(folder.iterdir()):
            folder.rmdir()
    if as_json:
        entries = [{"number": n, "words": FIGURES[n].words, "files": [str(f) for f in files[n]]} for n in wanted]
        show_json({"figures": entries, "points": {n: len(p) for n, p in given.items()}})
        return
    rows = [
        (str(n), FIGURES[n].words, ", ".join(f.name for f in files[n]), str(len(given.get(n, [])) or ""))
        for n in wanted
    ]
    show(table(f"Haddara (1971) recomputed, in {folder}/", ("figure", "what", "file", "points"), rows, (0, 3)))
    show(
        "The conditions are ours and most coefficients are estimated: each figure says so. Floquet exponents stand beside K2.",
        next_steps("quartering duffing -o duffing.png", "quartering verdict series60-cb60 --heading 15 --speed 0.25Fn "
                   "--wave-length 1.5L --wave-height 9"),
    )  # fmt: skip


def chosen(numbers: Sequence[str]) -> list[int]:
    """Numbers of figures from words such as "6" and "14-16"; all when none is given.

    Examples
    --------
    >>> chosen(["14-16", "6"])
    [6, 14, 15, 16]
    """
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
    files = {n: [claim(folder / f"fig{n:02d}{ending}", PICTURES) for ending in endings] for n in wanted}
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
        write(*[(path, writer(n, i)) for i, n in enumerate(wanted, 1) for path in files[n]])
    return files
