"""Error messages for the keys of a file, independent of the wording of the validation library."""

from __future__ import annotations

import re
from collections.abc import Callable
from difflib import get_close_matches
from typing import Any

_NUMBER, _WHOLE, _TEXT, _LIST = "a number", "a whole number", "text (in quotes when it looks like a number)", "a list"

# The kinds of error are the library's interface, with the limits beside them; its sentences are not.
_ALLOWED: dict[str, Callable[[dict[str, Any]], str]] = {
    "finite_number": lambda _: "a finite number",
    "float_parsing": lambda _: _NUMBER,
    "float_type": lambda _: _NUMBER,
    "int_parsing": lambda _: _WHOLE,
    "int_parsing_size": lambda _: _WHOLE,
    "int_type": lambda _: _WHOLE,
    "int_from_float": lambda _: _WHOLE,
    "bool_parsing": lambda _: "true or false",
    "bool_type": lambda _: "true or false",
    "string_type": lambda _: _TEXT,
    "string_too_long": lambda limit: f"up to {limit['max_length']:,} letters",
    "string_too_short": lambda limit: f"{limit['min_length']:,} letters or more",
    "list_type": lambda _: f"{_LIST}, such as [0, 1.5, 2.0]",
    "tuple_type": lambda _: f"{_LIST}, such as [0, 1.5]",
    "too_short": lambda limit: f"{_LIST} of {limit['min_length']:,} or more",
    "too_long": lambda limit: f"{_LIST} of up to {limit['max_length']:,}",
    "greater_than": lambda limit: f"above {limit['gt']:.4g}",
    "greater_than_equal": lambda limit: f"from {limit['ge']:.4g}",
    "less_than": lambda limit: f"below {limit['lt']:.4g}",
    "less_than_equal": lambda limit: f"up to {limit['le']:.4g}",
    "literal_error": lambda limit: ", ".join(words_of(limit)),
    "dict_type": lambda _: "a group of keys",
    "model_type": lambda _: "a group of keys",
    "model_attributes_type": lambda _: "a group of keys",
    "json_invalid": lambda _: "JSON",
}


def allowed(problem: Any) -> str:
    """What could stand where a checked key is wrong.

    problem: one of the `errors()` of a pydantic ValidationError, of a kind with a limit or a type
    """
    say = _ALLOWED.get(problem["type"])
    return say(problem.get("ctx", {})) if say else "a value of another kind"


def user_words(problem: Any) -> str | None:
    """What this project's own check said, or None where the library's check failed."""
    return str(problem["ctx"]["error"]) if problem["type"] == "value_error" else None


def nearest_word(problem: Any) -> str:
    """The word of a choice that is nearest to the one given, and all of them.

    >>> nearest_word({"input": "relativ", "ctx": {"expected": "'relative' or 'absolute'"}})
    "did you mean 'relative'? Allowed: 'relative', 'absolute'"
    """
    words = words_of(problem["ctx"])
    near = get_close_matches(repr(problem["input"]), words, n=1, cutoff=0.0)[0]
    return f"did you mean {near}? Allowed: {', '.join(words)}"


def words_of(limit: dict[str, Any]) -> list[str]:
    """The words or numbers a choice is of, from the `ctx` of its error."""
    return re.findall(r"'[^']*'|-?\d[\d.]*", str(limit["expected"]))
