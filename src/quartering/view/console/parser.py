"""A command whose options are refused, where unknown or given twice, in the words of every other door."""

from __future__ import annotations

from typing import Any, Final

import typer
from typer.core import TyperCommand, TyperOption

from quartering.options import unknown
from quartering.view.console.errors import BAD_INPUT

_USAGE: Final[Any] = typer.BadParameter.__base__
"""Errors of usage; typer brings a click of its own, or takes the one installed."""


class Command(TyperCommand):
    """A command that takes each option once, unless it may be repeated."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Parse as click does, after the names alone have been looked at."""
        known = tuple(name.lstrip("-").replace("-", "_") for one in self.params for name in one.opts)
        try:
            _, _, order = self.make_parser(ctx).parse_args(args=list(args))
        except _USAGE as error:
            if hasattr(error, "possibilities"):  # no such option
                self._refuse(unknown(error.option_name.lstrip("-").replace("-", "_"), known).words)
            order = []  # said as click says it, below
        for one in order:
            if isinstance(one, TyperOption) and order.count(one) > 1 and not (one.multiple or one.is_flag):
                self._refuse(f"{one.name} is given twice; leave one out")
        return super().parse_args(ctx, args)

    def _refuse(self, words: str) -> None:
        typer.echo(f"quartering: {words}", err=True)
        raise typer.Exit(BAD_INPUT)
