"""The options of a ship on the command line: every command that takes a ship takes them, as the table declares them."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from functools import cache
from typing import Annotated, Any

import typer

from quartering.conventions import InputError
from quartering.option_checks import Option, checked
from quartering.options import OPTIONS, line_of, ship_options
from quartering.units import NO_SHIP
from quartering.view.console.typed_values import values

_RANGES = "; or a range, from:to or from:to:count"


def command_options() -> list[Option]:
    """Options a command takes: those of a ship, of a group only what a study may vary."""
    return [one for one in ship_options() if one.kind != "table" and (not one.group or one.axis)]


class ShipOptions:
    """The options of a ship beside those a command has of its own.

    Parameters
    ----------
    own : mapping of str to Parameter    of the command, by name
    ranges : bool                        may the axes of a study be ranges?

    Notes
    -----
    Where a command takes a wave length, or several, a wave period may be typed in its place.
    """

    def __init__(self, own: Mapping[str, inspect.Parameter], *, ranges: bool) -> None:
        self.parameters = dict(own)
        self._asked = next((name for name in ("wave_length", "wave_lengths") if name in own), "")
        if self._asked:
            length = own[self._asked]
            self._usual = length.default
            self.parameters[self._asked] = length.replace(default=None, annotation=_optional(length.annotation))
            self.parameters["wave_period"] = inspect.Parameter(
                "wave_period", inspect.Parameter.KEYWORD_ONLY, default=None, annotation=_period(self._asked)
            )
        self._added = [one.name for one in command_options() if one.name not in self.parameters]
        for name in self._added:
            self.parameters[name] = _parameter(name, ranges and OPTIONS[name].axis)

    def taken_from(self, given: dict[str, Any]) -> dict[str, str]:
        """What was typed of the options of a ship, taken out of all that was typed; a wave period becomes a wave length."""
        changes = {name: text for name in self._added if (text := given.pop(name)) is not None}
        if self._asked:
            given[self._asked] = _wave_length(given.pop("wave_period"), given[self._asked], self._usual, self._asked)
        return changes


@cache  # the same for every command: most of the time `quartering --help` takes of its own
def _parameter(name: str, ranges: bool) -> inspect.Parameter:
    """An option of a ship as a parameter of a command."""
    one = OPTIONS[name]
    option = typer.Option(one.command, help=_help(one) + (_RANGES if ranges else ""))
    annotation = Annotated[str | None, option]
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=annotation)


def _optional(annotation: Any) -> Any:
    return Annotated[str | None, annotation.__metadata__[0]]


def _help(one: Option) -> str:
    line = line_of(one)
    return f"{line[0].upper()}{line[1:]}"


def _period(beside: str) -> Any:
    """The option of a wave period beside one wave length, or beside several."""
    names = [OPTIONS["wave_period"].command, *(["--wave-periods"] if beside.endswith("s") else [])]
    more = ": from:to:count or a list" if beside.endswith("s") else ""
    return Annotated[str | None, typer.Option(*names, help=_help(OPTIONS["wave_period"]) + more)]


def _wave_length(period: str | None, length: str | None, usual: Any, name: str = "wave_length") -> str:
    """The wave length typed, or the period typed in its place, with its unit; of several, the periods are evenly spaced."""
    typed = "--" + name.replace("_", "-")
    if period is not None and length is not None:
        raise InputError(f"{typed} and --wave-period are two ways to say one thing; leave one out")
    if period is None:
        if length is None and usual is inspect.Parameter.empty:
            raise InputError(
                "--wave-length is missing; give it, such as 150 or 1.0L, or give --wave-period, such as 9.8s"
            )
        return usual if length is None else length
    if name == "wave_lengths":
        return ",".join(
            f"{one:.12g}s" for one in values([period], OPTIONS["wave_period"], NO_SHIP, "--wave-period", 20)
        )
    return ",".join(":".join(_seconds(end) for end in item.split(":")[:2]) + _count(item) for item in period.split(","))


def _seconds(text: str) -> str:
    return f"{checked(OPTIONS['wave_period'], text, OPTIONS['wave_period'].command):.12g}s"


def _count(item: str) -> str:
    return "".join(f":{part}" for part in item.split(":")[2:])


def option_words(changes: Mapping[str, str]) -> str:
    """Options that give the same ship again, each with a blank before it.

    >>> option_words({"gm": "0.8", "name": "my ship"})
    " --gm 0.8 --name 'my ship'"
    """
    return "".join(f" {OPTIONS[name].command} {_shell(text)}" for name, text in changes.items())


def _shell(text: str) -> str:
    return f"'{text}'" if " " in text or "{" in text else text
