"""`quartering sweep` and `quartering new --case`: a study from its case file."""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Mapping
from pathlib import Path

import typer

from quartering.conventions import InputError
from quartering.hull.file.read import ship
from quartering.stability.ahead import announce_compilation
from quartering.study.case.new import starting_case
from quartering.study.case.read import case_grid
from quartering.study.effects.uncertainty import uncertain
from quartering.study.grid import Grid
from quartering.study.maps.estimate import check_size, estimate
from quartering.study.maps.executor import check_cluster
from quartering.study.maps.progress import failures, progress_line, summary
from quartering.study.maps.sweep import fill, sized
from quartering.view.interrupts import stop_if_asked
from quartering.view.output import claim, folder_named, write
from quartering.view.progress import bar
from quartering.view.terminal import next_steps, show, show_json, table
from quartering.view.wording import WAY_WORDS, more_harmonics_words

INTERRUPTED = 130
_BETWEEN_LINES = 10.0
"""Seconds between two lines of progress where there is no terminal."""


def new_case(name: str, path: str, as_json: bool) -> None:
    """Write a case file to begin from and say what to do with it."""
    ship(name)
    target = Path(path)
    if target.exists():
        raise InputError(f'"{target}" is there already; give another name, or remove it first')
    written = claim(target, (".yaml", ".yml"))
    write((written, lambda part: part.write_text(starting_case(name), encoding="utf-8")))
    if as_json:
        show_json({"file": str(written), "ship": name})
        return
    show(f"Wrote {written}: a comment on each line says what it is.")
    show(next_steps(f"quartering sweep {written}"))


def run_sweep(case: str, output: str | None, cluster: str | None, yes: bool, as_json: bool) -> None:
    """Compute what is missing of a case into its folder, and say what was found."""
    check_cluster(cluster)
    wanted = case_grid(case)
    folder = Path(case).with_suffix("") if output is None else folder_named(output)
    announce_compilation()
    wanted = sized(wanted, folder)
    _before(wanted, folder, yes)
    begin, seen = time.monotonic(), _Progress(wanted.count)
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
    facts = summary(counts, time.monotonic() - begin)
    if as_json:
        show_json(facts | {"result": str(folder)})
        return
    _after(wanted, counts, facts["by_verdict"])
    if facts["capsize_on_the_way"]:
        show(f"{facts['capsize_on_the_way']:,} of the stable motions are not reached: {WAY_WORDS}.")
    if facts["more_harmonics"]:
        show(more_harmonics_words(facts["more_harmonics"], facts["conditions"], wanted.harmonics))
    show(f"Wrote {folder}")
    show(next_steps(f"quartering worst {folder}", f"quartering show {folder}", f"quartering report {folder}"))


def run_uncertain(
    case: str, typed: str, draws: int, output: str | None, cluster: str | None, yes: bool, as_json: bool
) -> None:
    """Probability that each condition of a case is unstable, as a dataset."""
    check_cluster(cluster)
    wanted, spread = case_grid(case), uncertainties(typed)
    target = claim(f"{Path(case).stem}-probability.nc" if output is None else output, (".nc",))
    announce_compilation()
    found = estimate(wanted)
    check_size(type(found)(wanted.count * draws, found.blocks, found.seconds * draws, 0.0, ()), yes=yes)
    with bar("conditions", wanted.count * draws) as report:
        ds = uncertain(wanted, spread, draws=draws, cluster=cluster, progress=report)
    write((target, lambda part: ds.to_netcdf(part)))
    p = ds["probability_unstable"]
    likely = {f"above {share:.0%}": int((p > share).sum()) for share in (0.0, 0.05, 0.5, 0.95)}
    if as_json:
        show_json(
            {"conditions": wanted.count, "draws": draws, "unstable_with_probability": likely, "dataset": str(target)}
        )
        return
    show(
        table(
            f"Unstable, by probability ({draws} draws)",
            ("probability", "conditions"),
            [(k, f"{n:,}") for k, n in likely.items()],
        )
    )
    show(f"Largest sampling error of a probability: {float(ds['probability_error'].max()):.2g}.", f"Wrote {target}")


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
    found = estimate(wanted)
    typer.echo(found.sentence, err=True)
    for missed in found.missed[:3]:
        typer.echo(f"note: {missed}", err=True)
    if len(found.missed) > 3:
        typer.echo(f"note: and {len(found.missed) - 3} more such ranges", err=True)
    check_size(found, folder, yes=yes)


def _after(wanted: Grid, counts: Counter[str], kinds: Mapping[str, int]) -> None:
    """Counts by verdict, and failed conditions grouped with advice."""
    rows = [(kind, f"{n:,}", f"{100 * n / wanted.count:.2f} %") for kind, n in kinds.items()]
    show(table(f"{wanted.ship.name}: {wanted.count:,} conditions", ("verdict", "conditions", "share"), rows, (1, 2)))
    for group in failures(counts):
        show(f"{group.conditions:,} conditions without an answer: {group.advice}.")
    if counts.get("beyond"):
        show(f"{counts['beyond']:,} conditions roll beyond the fit of the righting arm: extrapolated.")


class _Progress:
    """A line on stderr that is rewritten in a terminal, and repeated now and then elsewhere."""

    def __init__(self, total: int) -> None:
        self.total, self.begin, self.last = total, time.monotonic(), time.monotonic()
        self.begun: int | None = None
        self.done = 0

    def told(self, done: int, counts: Counter[str]) -> None:
        """Say how far the run has come, or stop where that was asked for."""
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
