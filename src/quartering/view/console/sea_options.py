"""Options of irregular seas that several commands share, with the words of the table."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import typer

from quartering.arguments import ARGUMENTS
from quartering.options import OPTIONS, Refused, line_of
from quartering.units import NO_SHIP
from quartering.view.console.typed_values import value

if TYPE_CHECKING:
    from quartering.loads.sea.sea import Sea


def told(name: str, more: str = "") -> Any:
    """Option for one argument of a sea, with the words of the table."""
    one = ARGUMENTS[name]
    text = line_of(one)
    return typer.Option(one.command, help=f"{text[0].upper()}{text[1:]}{more}.")


SPREADING: Final[Any] = typer.Option(
    help="Spreading: s of cos^2s of half the angle, cos2, or none for a long-crested sea."
)


SPECTRUM: Final[Any] = typer.Option(help="Spectrum: jonswap, bretschneider, pierson-moskowitz or torsethaugen.")
SWELL: Final[Any] = typer.Option(
    help="Swell beside the sea: height, period of its peak, angle off the sea: 2m,14s,40; its spreading is the sea's."
)


def typed_swell(text: str | None, spreading: Any) -> Sea | None:
    """A swell as typed; its heading is the angle off the sea."""
    from quartering.loads.sea.sea import Sea

    if text is None:
        return None
    parts = [part.strip() for part in text.split(",")]
    if len(parts) != 3:
        raise Refused(
            "swell", f"swell = {text!r}; it is height, period of its peak, angle off the sea; try 2m,14s,40", "--swell"
        )
    hs, tp = (value(part, ARGUMENTS[name], NO_SHIP, "--swell") for part, name in zip(parts, ("hs", "tp"), strict=False))
    heading = value(parts[2], OPTIONS["heading"], NO_SHIP, "--swell")
    return Sea(hs=hs, tp=tp, heading=heading, spreading=spreading)


def typed_spreading(text: str) -> Any:
    """A spreading as typed, for `Sea` to check."""
    if text in ("none", "cos2"):
        return None if text == "none" else text
    try:
        return float(text)
    except ValueError:
        raise Refused("spreading", f"spreading = {text!r}; it is s > 0, cos2 or none; try 10", "--spreading") from None
