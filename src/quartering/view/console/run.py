"""A function made a command: with `--json` and the options of a ship, its answer given, its refusals said."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

from quartering.view.console.answer import Answer, give
from quartering.view.console.arguments import Json
from quartering.view.console.errors import report_errors
from quartering.view.console.ship_options import ShipOptions


def as_command(function: Callable[..., Answer | None]) -> Callable[..., None]:
    """A command of the options that a function has in its signature.

    function: returns an `Answer`, and the command has ``--json``; or nothing, such as a server. With a parameter
        ``changes`` the command has every option of a ship, and gets what was typed of them as one mapping of texts;
        with ``ranges`` the axes of a study may be ranges.
    Returns of the name and help of the given one
    """
    signature = inspect.signature(function, eval_str=True)
    own = dict(signature.parameters)
    told = next((name for name in ("changes", "ranges") if name in own), None)
    if told is not None:
        del own[told]
    if signature.return_annotation is Answer:
        own["json"] = inspect.Parameter("json", inspect.Parameter.KEYWORD_ONLY, default=False, annotation=Json)
    options = None if told is None else ShipOptions(own, ranges=told == "ranges")
    own = own if options is None else options.parameters

    def run(**given: Any) -> None:
        with report_errors():
            as_json = given.pop("json", False)
            if told is not None and options is not None:
                given[told] = options.taken_from(given)
            answer = function(**given)
            if answer is not None:
                give(answer, as_json)

    run.__name__, run.__doc__, run.__module__ = function.__name__, function.__doc__, function.__module__
    kinds = [one.replace(kind=inspect.Parameter.KEYWORD_ONLY) for one in own.values()]
    run.__signature__ = inspect.Signature(kinds)  # type: ignore[attr-defined]
    run.__annotations__ = {name: one.annotation for name, one in own.items()}
    return run
