"""Public functions that refuse an argument of another kind in one message."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import wraps
from inspect import signature
from os import PathLike
from typing import Any, Final, ParamSpec, TypeVar

from quartering.conventions import InputError
from quartering.option_checks import quoted

P = ParamSpec("P")
R = TypeVar("R")

_ADVICE: Final = {
    "Ship": 'quartering.ship("wigley")',
    "Hull": 'quartering.ship("wigley").hull',
    "Wave": "quartering.Wave(100.0, 2.0)",
    "Sea": "quartering.Sea(hs=6, tp=11)",
    "Model": "quartering.equations(ship, wave, speed, heading)",
    "Motion": "quartering.steady_motion(model)",
    "DecayRecord": 'quartering.read_decay("decay.csv")',
    "Dataset": "quartering.bem_forces(ship, [100.0], [90.0])",
    "Propulsion": "quartering.Propulsion(resistance, diameter=2.6, thrust=(0.36, -0.28, -0.12))",
    "Section": "quartering.Section(y=[0, 5, 5], z=[4, 4, 0])",
    "words": '["gm", "K_p"]',
    "file": '"mine.csv"',
}
"""Kind -> how one is made."""
_SAID: Final = {"word": "word in quotes", "words": "list of names", "file": "name of a file"}


def takes(**kinds: str) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Refuse arguments that are not of the kinds named.

    **kinds: argument -> name of its class, or of several, "Ship, Hull, None"; so no room is imported for it; "word" is any
        text, "words" a list of texts, "file" the name of one
    Returns a decorator; the function raises `InputError` before anything else
    """

    def checked(function: Callable[P, R]) -> Callable[P, R]:
        places = {name: k for k, name in enumerate(signature(function).parameters) if name in kinds}

        @wraps(function)
        def call(*args: P.args, **given: P.kwargs) -> R:
            for name, place in places.items():
                if place < len(args):
                    _of_kind(name, args[place], kinds[name])
                elif name in given:
                    _of_kind(name, given[name], kinds[name])
            return function(*args, **given)

        return call

    return checked


def _of_kind(name: str, given: Any, kinds: str) -> None:
    allowed = kinds.split(", ")
    if given is None and "None" in allowed:
        return
    if any(_is_of(given, kind) for kind in allowed):
        return
    words = " or ".join(_SAID.get(one, one) for one in allowed if one != "None")
    advice = f"; give one, such as {_ADVICE[allowed[0]]}" if allowed[0] in _ADVICE else ""
    raise InputError(f"{name} = {quoted(given)} is no {words}{advice}")


def _is_of(given: Any, kind: str) -> bool:
    if kind == "words":
        several = isinstance(given, Sequence) and not isinstance(given, (str, bytes)) and len(given) > 0
        return several and all(isinstance(one, str) for one in given)
    if kind in ("word", "file"):
        return isinstance(given, str) or (kind == "file" and isinstance(given, PathLike))
    return any(one.__name__ == kind for one in type(given).__mro__)
