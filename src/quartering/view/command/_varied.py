"""What both answers of `quartering vary` share: ranges, and names of options."""

from __future__ import annotations

from quartering.options import OPTIONS
from quartering.view.console.typed_ship import Typed


def is_range(text: str) -> bool:
    """Does a condition's option stand for several values?"""
    return ":" in text or "," in text


def option(name: str) -> str:
    """The option a parameter is given with."""
    return f"--{name.replace('_', '-')}" if name in OPTIONS else f"--coefficient {name}"


def unvaried_words(typed: Typed) -> str:
    """Options that give the same condition again, ranges left out."""
    return "".join(f" {option(key)} {text}" for key, text in typed.condition.items() if not is_range(text))
