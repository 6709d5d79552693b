"""How a command ends: bad input is one message and exit 2, Ctrl-C exit 130, a warning one plain line."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import typer

from quartering.conventions import DamageWarning, InputError, RangeWarning
from quartering.view.console.interrupts import listening, was_asked

BAD_INPUT, INTERRUPTED = 2, 130
_TOLD = (RangeWarning, DamageWarning)


@contextmanager
def report_errors() -> Iterator[None]:
    """Run the body of a command: its refusals become one message on stderr, its warnings of range and of damage plain lines."""
    said: set[str] = set()

    def say(message: Warning | str, category: type[Warning], *place: Any, **more: Any) -> None:
        if not issubclass(category, _TOLD):
            usual(message, category, *place, **more)
        elif str(message) not in said:
            said.add(str(message))
            typer.echo(f"note: {message}", err=True)

    with warnings.catch_warnings(), listening():
        usual = warnings.showwarning
        for told in _TOLD:
            warnings.simplefilter("always", told)
        warnings.showwarning = say
        try:
            yield
        except InputError as error:
            typer.echo(f"quartering: {error}", err=True)
            raise typer.Exit(BAD_INPUT) from None
        except OSError as error:
            where = f'"{error.filename}": ' if error.filename else ""
            typer.echo(f"quartering: {where}{error.strerror or error}; try another file or folder", err=True)
            raise typer.Exit(BAD_INPUT) from None
        except KeyboardInterrupt:
            raise _interrupted() from None
        except Exception:
            if not was_asked():  # the compiler fails by an interrupt that its own code let go
                raise
            raise _interrupted() from None


def _interrupted() -> typer.Exit:
    """Say that a command was interrupted, and how it ends."""
    typer.echo("quartering: interrupted; nothing was written", err=True)
    return typer.Exit(INTERRUPTED)
