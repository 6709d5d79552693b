"""Commands about the paper itself: its figures recomputed, its appendix on Duffing's equation."""

from __future__ import annotations

from typing import Annotated

import typer

from quartering.conventions import InputError
from quartering.view.arguments import Json, Picture
from quartering.view.outcome import answering


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
    json: Json = False,
) -> None:
    """Recompute the figures of Haddara (1971) from real hulls, or measure its claims."""
    with answering():
        if scoreboard:
            if numbers or kind or points:
                raise InputError("--scoreboard measures all claims; leave figure numbers, --kind and --points out")
            from quartering.view.commands.scoreboard import print_scoreboard

            print_scoreboard(output, json)
            return
        from quartering.view.commands.figures import draw_figures

        draw_figures(numbers or [], "figures" if output is None else output, kind or ["png"], points, json)


def duffing(
    beta: Annotated[str, typer.Option(help="Cubic stiffness: x'' + d x' + x + beta x^3 = X0 cos(w t).")] = "0.2",
    force: Annotated[str, typer.Option(help="Force X0.")] = "0.3",
    damping: Annotated[str, typer.Option(help="Damping d.")] = "0",
    frequency: Annotated[
        str, typer.Option(help="Frequencies w of the table: from:to:count or a list; their range is drawn.")
    ] = "0.6,0.8,1,1.2,1.4,1.6",
    output: Picture = None,
    json: Json = False,
) -> None:
    """Duffing's equation: the paper's formulas C-3, C-4, C-5 against the exact motions, their folds and stability."""
    with answering():
        from quartering.view.commands.duffing import compare_formulas

        compare_formulas((beta, force, damping), frequency, output, json)
