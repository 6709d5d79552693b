"""The command line. Its commands stand in ``cli_*.py``; their work, and every heavy import, in ``view/commands``."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Sequence
from typing import Annotated, Any

from quartering.view.interrupts import quiet_start

with quiet_start():
    import typer

    from quartering.view import cli_decay, cli_motions, cli_pages, cli_paper, cli_seas, cli_ships, cli_studies
    from quartering.view.outcome import BAD_INPUT
    from quartering.view.ship_options import takes_ship_options
    from quartering.view.typed_options import Command

# The kernels run as fast at LLVM's first level of optimisation as at its third, and compile in four fifths of the time.
os.environ.setdefault("NUMBA_OPT", "1")

INTERRUPTED = 130
_MOST_THREADS = 10_000

app = typer.Typer(
    name="quartering",
    help="At which headings, speeds and waves does a ship roll badly or lose a stable motion, why, and what cures it?",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)


def _version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        typer.echo(f"quartering {version('quartering')}")
        raise typer.Exit


@app.callback()
def main_options(
    version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Print it.")] = False,
) -> None:
    """At which headings, speeds and waves does a ship roll badly or lose a stable motion, why, and what cures it?"""


_COMMANDS = (
    cli_ships.ships,
    cli_ships.new,
    cli_ships.hull,
    cli_ships.coefficients,
    cli_ships.forces,
    cli_ships.responses,
    cli_ships.criteria,
    cli_decay.decay,
    cli_motions.verdict,
    cli_motions.simulate,
    cli_motions.branch,
    cli_motions.basin,
    cli_seas.sea,
    cli_seas.parametric,
    cli_studies.polar,
    cli_studies.vary,
    cli_studies.sweep,
    cli_studies.worst,
    cli_studies.show,
    cli_paper.figures,
    cli_paper.duffing,
    cli_pages.report,
    cli_pages.app,
)
_OF_A_SHIP = (
    cli_ships.hull,
    cli_ships.coefficients,
    cli_ships.forces,
    cli_ships.responses,
    cli_ships.criteria,
    cli_motions.verdict,
    cli_motions.simulate,
    cli_motions.branch,
    cli_motions.basin,
    cli_seas.sea,
    cli_seas.parametric,
    cli_studies.polar,
    cli_studies.vary,
)
"""Commands that take the options of a ship."""
for _command in _COMMANDS:
    app.command(cls=Command)(
        _command if _command not in _OF_A_SHIP else takes_ship_options(_command, _command is cli_studies.vary)
    )


def _leave_unread(words: Sequence[str]) -> None:
    """Leave the options of every command but the one named unread: for a list of commands their names and lines suffice."""
    named = next((word for word in words if not word.startswith("-")), "")
    for info in app.registered_commands:
        if info.callback is not None and info.callback.__name__.replace("_", "-") != named:
            info.callback = _with_line_alone(info.callback)


def _with_line_alone(command: Callable[..., Any]) -> Callable[[], None]:
    """A command of the same name and line, without options, that is never run."""

    def shown() -> None:
        raise NotImplementedError

    shown.__name__, shown.__doc__ = command.__name__, command.__doc__
    return shown


def main() -> None:
    """Entry point of the ``quartering`` command."""
    if sys.stdout is None or sys.stderr is None:  # closed by the shell: nothing could be told
        if sys.stderr is not None:
            sys.stderr.write(
                "quartering: standard output is closed; leave it open, or send it to a file or /dev/null\n"
            )
        sys.exit(BAD_INPUT)
    threads = os.environ.get("NUMBA_NUM_THREADS", "1")
    if not (threads.strip().isdigit() and 0 < int(threads) < _MOST_THREADS):
        sys.stderr.write(
            f"quartering: NUMBA_NUM_THREADS={threads!r}; it is a whole number from 1 to {_MOST_THREADS - 1}; leave it out for "
            "all processors\n"
        )
        sys.exit(BAD_INPUT)
    _leave_unread(sys.argv[1:])
    try:
        app()
    except KeyboardInterrupt:  # between the imports and the command
        raise SystemExit(INTERRUPTED) from None
