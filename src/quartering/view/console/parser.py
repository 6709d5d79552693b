"""A command whose options are refused, where unknown or given twice, in the words of every other door."""

from __future__ import annotations

from typing import Any, Final

import typer
from typer.core import TyperCommand, TyperGroup, TyperOption

from quartering.options import unknown
from quartering.view.console.errors import BAD_INPUT

_USAGE: Final[Any] = typer.BadParameter.__base__
"""Errors of usage; typer brings a click of its own, or takes the one installed."""


class _AsTyped:
    """What typer makes of a typed value, without pydantic where nothing is to be made of it: a text, a value left out.

    Typer builds a validator of pydantic for each option, given or not: of fifty options that is a sixth of a command.
    """

    def __init__(self, descriptor: Any) -> None:
        self._descriptor = descriptor

    def coerce(self, value: Any, param: Any, ctx: Any) -> Any:
        """Value of the option's type."""
        kind, several = self._descriptor.annotation, param.multiple or param.nargs == -1
        if self._descriptor.parameter_info.parser is None and not several:
            if value is None or (kind is str and type(value) is str):
                return value
            if value is param.default and type(value) is kind:
                return value
        if several and not value:
            return () if value is None else []
        from typer._coercion import build_runtime_param

        return build_runtime_param(self._descriptor).coerce(value, param=param, ctx=ctx)


def _leave_as_typed(params: list[Any]) -> None:
    """Spare options the validators of a typer that makes some."""
    for param in params:
        if getattr(param, "_runtime_param", params) is None and hasattr(param, "type_descriptor"):
            param._runtime_param = _AsTyped(param.type_descriptor)


class Group(TyperGroup):
    """The command whose commands the others are."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Parse as click does."""
        _leave_as_typed(self.get_params(ctx))
        return super().parse_args(ctx, args)


class Command(TyperCommand):
    """A command that takes each option once, unless it may be repeated."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Parse as click does, after the names alone have been looked at."""
        _leave_as_typed(self.get_params(ctx))
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
