"""Options of irregular seas that several commands share, with the words of the table."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Final, NamedTuple

import typer

from quartering.arguments import ARGUMENTS
from quartering.option_checks import Refused
from quartering.options import OPTIONS, line_of
from quartering.units import NO_SHIP, Sizes
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


Hs = Annotated[str, told("hs", ": 6")]
Tp = Annotated[str | None, told("tp", ": 11; or give --tz")]
Tz = Annotated[str | None, told("tz", ", in place of --tp")]
SpectrumName = Annotated[str, SPECTRUM]
Gamma = Annotated[str, told("gamma", ", of jonswap")]
SpreadingWords = Annotated[str, SPREADING]
SwellWords = Annotated[str | None, SWELL]
Hours = Annotated[str, typer.Option(help="Hours to simulate, 32 at a time: 1000.")]
SeaTable = Annotated[
    str | None,
    typer.Option(
        "--seas", help="Table of how often seas occur, .csv: Tz across, Hs down; the North Atlantic's without."
    ),
]
Seed = Annotated[int, typer.Option(help="Seed of the simulations.")]


class TypedSea(NamedTuple):
    """One sea as typed.

    Parameters
    ----------
    heading, hs, tp, tz, spectrum, gamma, spreading, swell : str, or None where not typed
    """

    heading: str
    hs: str
    tp: str | None
    tz: str | None
    spectrum: str
    gamma: str
    spreading: str
    swell: str | None

    def read(self, sizes: Sizes) -> Sea:
        """The sea, for a ship of some sizes; refusals name the option."""
        from quartering.loads.sea.sea import Sea

        spreading = typed_spreading(self.spreading)
        given: dict[str, Any] = {"spectrum": self.spectrum, "spreading": spreading}
        for name in ("hs", "tp", "tz", "gamma"):
            text = getattr(self, name)
            if text is not None:
                given[name] = value(text, ARGUMENTS[name], sizes, ARGUMENTS[name].command)
        beside = typed_swell(self.swell, spreading)
        heading = value(self.heading, OPTIONS["heading"], sizes, OPTIONS["heading"].command)
        return (Sea(**given) if beside is None else Sea(**given) + beside).turned_to(heading)

    @property
    def words(self) -> str:
        """The options, to be typed again."""
        return "".join(f" --{name} {text}" for name, text in self._asdict().items() if text is not None)


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
