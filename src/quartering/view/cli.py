"""The command line. Each file of ``view/command`` is a command: the function of its name, with its options as parameters."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from importlib import import_module
from pkgutil import iter_modules
from typing import Annotated, Any

from quartering.view.console.interrupts import quiet_start

with quiet_start():
    import typer

    from quartering.view import command
    from quartering.view.console.errors import BAD_INPUT, INTERRUPTED
    from quartering.view.console.parser import Command, Group
    from quartering.view.console.run import as_command

# The kernels run as fast at LLVM's first level of optimisation as at its third, and compile in four fifths of the time.
os.environ.setdefault("NUMBA_OPT", "1")

_MOST_THREADS = 10_000
_HELP = "At which headings, speeds and waves does a ship roll badly or lose a stable motion, why, and what cures it?"


def _version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        typer.echo(f"quartering {version('quartering')}")
        raise typer.Exit


def main_options(
    version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Print it.")] = False,
) -> None:
    """At which headings, speeds and waves does a ship roll badly or lose a stable motion, why, and what cures it?"""


_ORDER = (
    "ships", "new", "hull", "coefficients", "forces", "responses", "criteria", "decay", "verdict", "simulate", "branch",
    "basin", "parametric", "surf_riding", "broaching", "sea", "lyapunov", "design_point", "polar", "booklet", "vary",
    "sweep", "worst", "show",
    "figures", "duffing", "report", "operational", "long_term", "assess", "app",
)  # fmt: skip
"""Order of the commands in `quartering --help`; one that is not named stands at the end."""


def _names() -> list[str]:
    """Names of the commands: the files of `quartering.view.command` that begin with a letter."""
    found = {one.name for one in iter_modules(command.__path__) if not one.name.startswith("_")}
    return sorted(found, key=lambda name: (_ORDER.index(name) if name in _ORDER else len(_ORDER), name))


def application(named: str | None = None) -> typer.Typer:
    """The commands: with their options, or, where one is named, that one alone with its options and the others by name.

    The file of a command that is not asked for is not read then.
    """
    made = typer.Typer(
        name="quartering", help=_HELP, no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False,
        rich_markup_mode=None, cls=Group,
    )  # fmt: skip
    made.callback()(main_options)
    names = _names()
    for name in names:
        known = named is None or named.replace("-", "_") not in names or named.replace("-", "_") == name
        function = as_command(_function(name)) if known else _by_name_alone(name)
        made.command(name.replace("_", "-"), cls=Command)(function)
    return made


def _function(name: str) -> Callable[..., Any]:
    """The function of a command."""
    found: Callable[..., Any] = getattr(import_module(f"{command.__name__}.{name}"), name)
    return found


def _listed() -> typer.Typer:
    """The commands by name and line, for `quartering --help` and for a command that does not exist."""
    made = application("")
    for info in made.registered_commands:
        if info.callback is not None:
            info.callback = _by_name_alone(info.callback.__name__, info.callback.__doc__)
    return made


def _by_name_alone(name: str, line: str | None = None) -> Callable[[], None]:
    """A command of a name and line, without options, that is never run."""

    def shown() -> None:
        raise NotImplementedError

    shown.__name__, shown.__doc__ = name, line
    return shown


def __getattr__(name: str) -> Any:
    """`app`, every command with its options, made when it is asked for."""
    if name != "app":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()["app"] = made = application()
    return made


def _leave_dask_alone() -> None:
    """Let no import find dask, unless `--cluster` asks for it: where it is installed xarray loads it with the first dataset."""
    if not any(word.partition("=")[0] == "--cluster" for word in sys.argv[1:]):
        modules: dict[str, Any] = sys.modules
        modules.setdefault("dask", None)  # as if it were not installed


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
    _leave_dask_alone()
    named = next((word for word in sys.argv[1:] if not word.startswith("-")), "")
    try:
        (application(named) if named.replace("-", "_") in _names() else _listed())()
    except KeyboardInterrupt:  # between the imports and the command
        raise SystemExit(INTERRUPTED) from None
