"""Options of irregular seas that several commands share, with the words of the table."""

from __future__ import annotations

from typing import Any, Final

import typer

from quartering.arguments import ARGUMENTS
from quartering.option_checks import Refused
from quartering.options import line_of


def told(name: str, more: str = "") -> Any:
    """Option for one argument of a sea, with the words of the table."""
    one = ARGUMENTS[name]
    text = line_of(one)
    return typer.Option(one.command, help=f"{text[0].upper()}{text[1:]}{more}.")


SPREADING: Final[Any] = typer.Option(
    help="Spreading: s of cos^2s of half the angle, cos2, or none for a long-crested sea."
)


def typed_spreading(text: str) -> Any:
    """A spreading as typed, for `Sea` to check."""
    if text in ("none", "cos2"):
        return None if text == "none" else text
    try:
        return float(text)
    except ValueError:
        raise Refused("spreading", f"spreading = {text!r}; it is s > 0, cos2 or none; try 10", "--spreading") from None
