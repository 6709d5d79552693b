"""Commands about irregular seas."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from quartering.arguments import ARGUMENTS
from quartering.options import line_of
from quartering.view.arguments import Changes, Form, Heading, Json, Ship, Speed
from quartering.view.outcome import answering


def _told(name: str, more: str = "") -> Any:
    """Option for one argument of a sea, with the words of the table."""
    one = ARGUMENTS[name]
    text = line_of(one)
    return typer.Option(one.command, help=f"{text[0].upper()}{text[1:]}{more}.")


def sea(
    ship: Ship,
    hs: Annotated[str, _told("hs", ": 6")],
    heading: Heading,
    speed: Speed,
    tp: Annotated[str | None, _told("tp", ": 11; or give --tz")] = None,
    tz: Annotated[str | None, _told("tz", ", in place of --tp")] = None,
    spectrum: Annotated[
        str, typer.Option(help="Spectrum: jonswap, bretschneider, pierson-moskowitz or torsethaugen.")
    ] = "jonswap",
    gamma: Annotated[str, _told("gamma", ", of jonswap")] = "3.3",
    spreading: Annotated[
        str, typer.Option(help="Spreading: s of cos^2s of half the angle, cos2, or none for a long-crested sea.")
    ] = "none",
    hours: Annotated[str, typer.Option(help="Hours to simulate, 32 at a time: 1000; 0 for no simulation.")] = "32",
    form: Form = "stf",
    json: Json = False,
    changes: Changes = None,
) -> None:
    """Judge a ship in an irregular sea: roll, largest roll of three hours and stability, by every method there is."""
    with answering():
        from quartering.view.commands.sea import respond

        typed = {"hs": hs, "tp": tp, "tz": tz, "spectrum": spectrum, "gamma": gamma, "spreading": spreading}
        respond(ship, typed, (heading, speed), form, changes or {}, json, hours)
