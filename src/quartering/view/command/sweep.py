"""`quartering sweep`: a study from its case file."""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from quartering.conventions import InputError
from quartering.view.console.answer import Answer
from quartering.view.console.errors import INTERRUPTED
from quartering.view.console.files import File, folder_named, reserve_path
from quartering.view.console.interrupts import stop_if_asked
from quartering.view.console.printed import table
from quartering.view.console.progress import bar

if TYPE_CHECKING:
    from quartering.study.grid import Grid
    from quartering.view.console.printed import Table

_BETWEEN_LINES = 10.0
"""Seconds between two lines of progress where there is no terminal."""


def sweep(
    case: Annotated[str, typer.Argument(help="Case file, see `quartering new --case`.")],
    output: Annotated[
        str | None,
        typer.Option(
            "-o", "--output", help="Folder of the results, by default the case's name; a .nc file with --uncertainty."
        ),
    ] = None,
    cluster: Annotated[str | None, typer.Option(help="local:4, or tcp://host:8786 of a dask scheduler.")] = None,
    yes: Annotated[bool, typer.Option("--yes", help="Run it however large it is.")] = False,
    uncertainty: Annotated[
        str | None, typer.Option(help="K_p=20%,gm=5%: probability of instability instead of one verdict.")
    ] = None,
    draws: Annotated[int, typer.Option(help="Random draws with --uncertainty, a multiple of 8.")] = 256,
) -> Answer:
    """Every condition of a case file; interrupted, it goes on where it was when it is called again."""
    from quartering.stability.precompile import announce_compilation
    from quartering.study.case.read import case_grid
    from quartering.study.maps.executor import check_cluster
    from quartering.study.maps.progress import summary
    from quartering.study.maps.sweep import sized
    from quartering.study.seas.over_seas.grid import SeaGrid
    from quartering.view.wording import WAY_WORDS, more_harmonics_words

    check_cluster(cluster)
    if uncertainty is not None:
        return _uncertain(case, uncertainty, draws, output, cluster, yes)
    wanted = case_grid(case)
    folder = Path(case).with_suffix("") if output is None else folder_named(output)
    announce_compilation()
    wanted = sized(wanted, folder)
    _before(wanted, folder, yes)
    begin = time.monotonic()
    counts = _filled(wanted, folder, cluster)
    if isinstance(wanted, SeaGrid):
        return _of_seas(folder, wanted.count, time.monotonic() - begin)
    found = summary(counts, time.monotonic() - begin)

    def lines() -> Iterator[Table | str]:
        yield from _after(wanted, counts, found["by_verdict"])
        if found["capsize_on_the_way"]:
            yield f"{found['capsize_on_the_way']:,} of the stable motions are not reached: {WAY_WORDS}."
        if found["more_harmonics"]:
            yield more_harmonics_words(found["more_harmonics"], found["conditions"], wanted.harmonics)

    return Answer(
        lines(),
        lambda: found | {"result": str(folder)},
        written=f"Wrote {folder}",
        next_steps=[f"quartering worst {folder}", f"quartering show {folder}", f"quartering report {folder}"],
    )


def _of_seas(folder: Path, count: int, seconds: float) -> Answer:
    """What a study in irregular seas found."""
    from quartering.study.maps.result import open_result
    from quartering.view.command._sea_polar import guidance_lines
    from quartering.view.sea_words import guidance_facts

    ds = open_result(folder)
    return Answer(
        guidance_lines(ds),
        lambda: guidance_facts(ds) | {"total": count, "seconds": seconds, "result": str(folder)},
        written=f"Wrote {folder}",
        next_steps=[f"quartering show {folder} -o guidance.png", f"quartering report {folder}"],
    )


def _filled(wanted: Grid, folder: Path, cluster: str | None) -> Counter[str]:
    """Compute what is missing; interrupted, say that what is done is kept, and end.

    Raises
    ------
    typer.Exit    after Ctrl-C
    """
    from quartering.study.maps.sweep import fill

    seen = _Progress(wanted.count)
    try:
        counts = fill(wanted, folder, cluster=cluster, told=seen.told)
        stop_if_asked()
    except KeyboardInterrupt:
        seen.end()
        typer.echo(
            f"quartering: interrupted; {seen.done:,} of {wanted.count:,} conditions are kept in {folder}: run the same command"
            " again, only the rest is computed",
            err=True,
        )
        raise typer.Exit(INTERRUPTED) from None
    seen.end()
    return counts


def _uncertain(case: str, typed: str, draws: int, output: str | None, cluster: str | None, yes: bool) -> Answer:
    """Probability that each condition of a case is unstable, as a dataset."""
    from quartering.stability.precompile import announce_compilation
    from quartering.study.case.read import case_grid
    from quartering.study.effects.uncertainty import uncertain
    from quartering.study.maps.estimate import check_size, estimate

    wanted, spread = case_grid(case), uncertainties(typed)
    target = reserve_path(f"{Path(case).stem}-probability.nc" if output is None else output, (".nc",))
    announce_compilation()
    found = estimate(wanted)
    check_size(type(found)(wanted.count * draws, found.blocks, found.seconds * draws, 0.0, ()), yes=yes)
    with bar("conditions", wanted.count * draws) as report:
        ds = uncertain(wanted, spread, draws=draws, cluster=cluster, progress=report)
    p = ds["probability_unstable"]
    likely = {f"above {share:.0%}": int((p > share).sum()) for share in (0.0, 0.05, 0.5, 0.95)}

    def lines() -> Iterator[Table | str]:
        rows = [(k, f"{n:,}") for k, n in likely.items()]
        yield table(f"Unstable, by probability ({draws} draws)", ("probability", "conditions"), rows)
        yield f"Largest sampling error of a probability: {float(ds['probability_error'].max()):.2g}."

    def facts() -> dict[str, Any]:
        counts = {"conditions": wanted.count, "draws": draws, "unstable_with_probability": likely}
        return counts | {"dataset": str(target)}

    return Answer(lines(), facts, [File(target, lambda part: ds.to_netcdf(part))])


def uncertainties(typed: str) -> dict[str, str]:
    """Spreads by name from "K_p=20%,gm=5%".

    Examples
    --------
    >>> uncertainties("K_p=20%, gm=5%")
    {'K_p': '20%', 'gm': '5%'}
    """
    pairs = [part.split("=") for part in typed.split(",") if part.strip()]
    if any(len(pair) != 2 for pair in pairs):
        raise InputError(f'--uncertainty "{typed}": write it like "K_p=20%,gm=5%"')
    return {name.strip(): value.strip() for name, value in pairs}


def _before(wanted: Grid, folder: Path, yes: bool) -> None:
    """What the run will take; refuses what nobody may have meant."""
    from quartering.study.maps.estimate import check_size, estimate

    found = estimate(wanted)
    typer.echo(found.sentence, err=True)
    for missed in found.missed[:3]:
        typer.echo(f"note: {missed}", err=True)
    if len(found.missed) > 3:
        typer.echo(f"note: and {len(found.missed) - 3} more such ranges", err=True)
    check_size(found, folder, yes=yes)


def _after(wanted: Grid, counts: Counter[str], kinds: Mapping[str, int]) -> Iterator[Table | str]:
    """Counts by verdict, and failed conditions grouped with advice."""
    from quartering.study.maps.progress import failures

    rows = [(kind, f"{n:,}", f"{100 * n / wanted.count:.2f} %") for kind, n in kinds.items()]
    yield table(f"{wanted.ship.name}: {wanted.count:,} conditions", ("verdict", "conditions", "share"), rows, (1, 2))
    for group in failures(counts):
        yield f"{group.conditions:,} conditions without an answer: {group.advice}."
    if counts.get("beyond"):
        yield f"{counts['beyond']:,} conditions roll beyond the fit of the righting arm: extrapolated."


class _Progress:
    """A line on stderr that is rewritten in a terminal, and repeated now and then elsewhere."""

    def __init__(self, total: int) -> None:
        self.total, self.begin, self.last = total, time.monotonic(), time.monotonic()
        self.begun: int | None = None
        self.done = 0

    def told(self, done: int, counts: Counter[str]) -> None:
        """Say how far the run has come, or stop where that was asked for."""
        from quartering.study.maps.progress import progress_line

        self.begun = done if self.begun is None else self.begun
        self.done = done
        stop_if_asked()
        now, terminal = time.monotonic(), sys.stderr.isatty()
        if now - self.last < (0.2 if terminal else _BETWEEN_LINES) or done == 0:
            return
        self.last = now
        line = progress_line(done, self.total, self.begun, now - self.begin, counts)
        typer.echo(f"\r{line}\033[K" if terminal else line, err=True, nl=not terminal)

    def end(self) -> None:
        """Leave the line."""
        if sys.stderr.isatty():
            typer.echo("\r\033[K", err=True, nl=False)
