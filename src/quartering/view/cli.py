"""The command line. Each file of ``view/command`` is a command: the function of its name, with its options as parameters."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Sequence
from importlib import import_module
from pkgutil import iter_modules
from typing import Annotated, Any

from quartering.view.console.interrupts import quiet_start

with quiet_start():
    import typer

    from quartering.view import command
    from quartering.view.console.errors import BAD_INPUT, INTERRUPTED
    from quartering.view.console.parser import Command
    from quartering.view.console.run import as_command

# The kernels run as fast at LLVM's first level of optimisation as at its third, and compile in four fifths of the time.
os.environ.setdefault("NUMBA_OPT", "1")

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


_ORDER = (
    "ships", "new", "hull", "coefficients", "forces", "responses", "criteria", "decay", "verdict", "simulate", "branch",
    "basin", "parametric", "surf_riding", "broaching", "sea", "polar", "booklet", "vary", "sweep", "worst", "show",
    "figures", "duffing", "report", "operational", "app",
)  # fmt: skip
"""Order of the commands in `quartering --help`; one that is not named stands at the end."""


def _names() -> list[str]:
    """Names of the commands: the files of `quartering.view.command` that begin with a letter."""
    found = {one.name for one in iter_modules(command.__path__) if not one.name.startswith("_")}
    return sorted(found, key=lambda name: (_ORDER.index(name) if name in _ORDER else len(_ORDER), name))


for _name in _names():
    app.command(cls=Command)(as_command(getattr(import_module(f"{command.__name__}.{_name}"), _name)))


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
