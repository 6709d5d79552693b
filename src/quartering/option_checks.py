"""What an option is, and how a value of one is checked: the same range and the same words at every door."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any, Final, Literal

from quartering.conventions import SYMBOLS, InputError, as_float
from quartering.units import BARE, NO_SHIP, Sizes, article, quantity, split_quantity, units_of
from quartering.units import Kind as UnitKind

Kind = Literal[
    "length", "wave length", "speed", "mass", "angle", "time", "density", "area", "ratio", "steepness", "frequency",
    "roll angle", "rate", "growth rate", "word", "text", "file", "group", "coefficients", "table",
]  # fmt: skip
Place = Literal["ship", "loading", "condition"]
Bound = float | str | None
"""A limit: a number in the option's own unit, or one in sizes of the ship, such as "2 B"; None where there is none."""
TINY: Final = 1e-6
"""Smallest value of what is above 0, in its own unit: less is a slip, and its square or cube is lost in rounding."""
_NO_NUMBERS: Final = ("word", "text", "file", "group", "coefficients", "table")


class Refused(InputError):
    """An option refused: the option, and the words that are the same whichever way it was given."""

    def __init__(self, option: str, words: str, where: str = "", group: str = "") -> None:
        super().__init__(f"{where}: {words}" if where else words)
        self.option, self.words, self.group = option, words, group


@dataclass(frozen=True)
class Option:
    """One thing a ship, or a condition, can be told.

    Parameters
    ----------
    name : str                    one word in every door, such as "gyradius_roll"
    kind : str                    of the quantity, which gives its units; or "word", "text", "file", "group", ..
    meaning : str                 in a few words; by default that of `quartering.conventions.SYMBOLS`
    place : str                   "loading" where it stands below `loading:` in a ship file, "ship" at its top, "condition"
    group, key : str              group of a ship file it is a part of, and its key there
    low, high : Bound             limits; `above`: the low one itself is refused
    usual : float or str          what to try
    default : float or str        taken where nothing is given; None: derived, or nothing
    words : mapping of str to str allowed words, or words beside a number, each with its meaning
    axis : bool                   may a study vary it? Words are numbered in their order
    dial : tuple or None          scales (unit, low, high, step) of the explorer's dial, limits as `Bound` or numbers in that
                                  unit; (): none; None: one from low to high
    home : str                    attribute of `Ship` (or, with a dot, of its hull or loading) that holds it; "": `particulars`
    acts : bool                   do results depend on it? What does not act yet is recorded, checked and shown
    typed : str                   its type in Python, where it is not "float | str"
    example : str                 of a new file, commented out; "": the option is left out there
    label : str                   of the explorer's dial, by default the name
    title : str                   group of dials it stands in
    also : tuple of str           other keys a ship file may have for it
    hint : str                    said after the range
    needs : mapping               word -> (module, extra) that must be installed for it
    """

    name: str
    kind: Kind
    meaning: str = ""
    place: Place = "ship"
    group: str = ""
    key: str = ""
    low: Bound = None
    high: Bound = None
    above: bool = False
    usual: Bound = None
    default: Bound = None
    words: Mapping[str, str] | None = None
    axis: bool = False
    dial: tuple[tuple[str, Bound, Bound, float], ...] | None = None
    home: str = ""
    acts: bool = True
    typed: str = ""
    example: str = ""
    label: str = ""
    title: str = "Loading"
    also: tuple[str, ...] = ()
    hint: str = ""
    needs: Mapping[str, tuple[str, str]] | None = None

    @property
    def numeric(self) -> bool:
        """Is its value a number with a unit?"""
        return self.kind not in _NO_NUMBERS

    @property
    def unit(self) -> str:
        """Unit of a bare number; "" for what is no number."""
        return BARE["ratio" if self.kind == "steepness" else self.kind] if self.numeric else ""  # type: ignore[index]

    @property
    def path(self) -> tuple[str, ...]:
        """Keys under which a ship file holds it, the outermost first."""
        outer = self.group or ("loading" if self.place == "loading" else "")
        return ((outer,) if outer else ()) + (self.key or self.name,)

    @property
    def text(self) -> str:
        """What it means."""
        return self.meaning or SYMBOLS[self.name].meaning

    @property
    def symbol(self) -> str:
        """Its letter, or its name."""
        return SYMBOLS[self.name].symbol if self.name in SYMBOLS else self.name

    @property
    def units(self) -> str:
        """Units it may be written in, for help texts: "[m, B]"."""
        if not self.numeric:
            return ""
        kind: UnitKind = "ratio" if self.kind == "steepness" else self.kind  # type: ignore[assignment]
        shown = [self.unit, *(unit for unit in units_of(kind, Sizes(1.0, 1.0, 1.0)) if unit != self.unit)]
        return "[" + ", ".join(unit for unit in shown if unit not in ("mm", "cm", "km", "ft", "h")) + "]"

    @property
    def command(self) -> str:
        """Option of the command line."""
        return "--" + self.name.replace("_", "-")

    @property
    def python(self) -> str:
        """Its type in a signature."""
        if self.typed:
            return self.typed
        if self.kind == "word":
            return f"Literal[{', '.join(repr(word) for word in self.words or ())}]"
        return "float | str" if self.numeric else "str | Path" if self.kind == "file" else "str"

    def range(self, sizes: Sizes = NO_SHIP) -> str:
        """The allowed values in words, limits in sizes of the ship also in the unit where the ship is known."""
        own = f" {self.unit}" if self.unit not in ("1", "") else ""
        beside = " or ".join(self.words or ())
        if not self.numeric:
            return f"it is {beside}" if beside else "it is text"
        low, high = (_limit(bound, own, sizes, self) for bound in (self.low, self.high))
        if low and high:
            words = f"above {low} and at most {high}" if self.above else f"from {low} to {high}"
        elif low:
            words = f"above {low}" if self.above else f"{low} or more"
        else:
            words = f"at most {high}" if high else "a number"
        return f"it is {words}" + (f", or {beside}" if beside else "") + (f" ({self.hint})" if self.hint else "")


def _limit(bound: Bound, unit: str, sizes: Sizes, of: Option) -> str:
    """One limit in words; "" for none."""
    if bound is None:
        return ""
    if not isinstance(bound, str):
        return f"{bound:g}{unit}"
    found = _resolved(bound, of, sizes)
    return bound if found is None else f"{bound} = {found:.4g}{unit}"


def _resolved(bound: Bound, of: Option, sizes: Sizes) -> float | None:
    """A limit in the option's own unit; None where there is none, or the ship it is measured by is not known."""
    if bound is None or not isinstance(bound, str):
        return bound
    unit = "" if of.kind == "steepness" else split_quantity(bound)[1]
    known = {"L": sizes.length, "B": sizes.beam, "T": sizes.draught, "Fn": sizes.length}
    if unit in known and not known[unit]:
        return None
    return _number(bound, of, sizes)


def _number(given: float | str, of: Option, sizes: Sizes) -> float:
    """Value in the option's own unit."""
    if of.kind == "steepness":
        parts = given.split("/") if isinstance(given, str) else [given]
        if len(parts) > 2:
            raise InputError(f'{of.name}: "{given}" is no ratio')
        numbers = [quantity(part, "ratio", what=of.name) for part in parts]
        if len(numbers) == 2 and numbers[1] == 0:
            raise InputError(f'{of.name}: "{given}" divides by 0')
        return numbers[0] / numbers[1] if len(numbers) == 2 else numbers[0]
    return quantity(given, of.kind, **sizes._asdict(), what=of.name)  # type: ignore[arg-type]


def checked(of: Option, given: Any, where: str = "", sizes: Sizes = NO_SHIP) -> Any:
    """A value in the option's own unit (SI, degrees), or one of its words.

    given: a number, a number with its unit, or a word
    where: ship, file and line, or option of the command line it was given by; the message begins with it
    sizes: of the ship [m]; limits and units that need it are left out where it is not known
    """
    given = as_float(given)
    if not of.numeric:
        return _word(of, given, where) if of.kind == "word" else _text(of, given, where)
    word = given.strip() if isinstance(given, str) else ""
    if of.words and word in of.words:
        return word
    try:
        split_quantity(given, of.name)
    except InputError:
        near = get_close_matches(word, of.words or (), n=1, cutoff=0.5)
        hint = f"; did you mean {near[0]}?" if near else ""
        raise _refused(of, given, where, sizes, f"that is no finite number with a unit{hint}") from None
    try:
        value = _number(given, of, sizes)
    except InputError:
        raise _refused(of, given, where, sizes, _unit_words(of, given, sizes)) from None
    low, high = _resolved(of.low, of, sizes), _resolved(of.high, of, sizes)
    least = TINY if of.above and low == 0 and of.kind != "steepness" else low
    if (low is not None and least is not None and (value < least or (of.above and value == low))) or (
        high is not None and value > high
    ):
        raise _refused(of, given, where, sizes)
    return value


def _refused(of: Option, given: Any, where: str, sizes: Sizes, what: str = "") -> Refused:
    words = [f"{of.name} = {_said(of, given)}", *([what] if what else []), of.range(sizes)]
    slip = "" if what else _slip(of, given, sizes)
    usual = of.usual if of.usual is not None else of.default
    in_unit = _resolved(usual, of, sizes) if of.numeric and isinstance(usual, str) else None
    own = f" {of.unit}" if of.unit not in ("1", "") else ""
    more = "" if in_unit is None or str(usual).endswith(own or "?") else f" = {in_unit:.4g}{own}"
    advice = (
        "" if usual is None else f"{'Try' if slip else 'try'} {usual if isinstance(usual, str) else f'{usual:g}'}{more}"
    )
    text = "; ".join([*words, *([f"{slip} {advice}".strip()] if slip or advice else [])])
    return Refused(of.name, text, where, of.group)


def _said(of: Option, given: Any) -> str:
    """What was given: a number with its unit, text as it was written, in quotes where it is no number."""
    if isinstance(given, (int, float)) and not isinstance(given, bool):
        return f"{given:g}" + (f" {of.unit}" if of.unit not in ("1", "") else "")
    if isinstance(given, str) and of.numeric and of.kind != "steepness":
        try:
            bare = not split_quantity(given)[1]
        except InputError:
            bare = False
        if bare:
            return f"{given.strip()} {of.unit}".removesuffix(" 1")
    if isinstance(given, str):
        return given if given[:1].isdigit() or (given[:1] in "+-." and len(given) < 40) else quoted(given)
    return quoted(given)


def _unit_words(of: Option, given: Any, sizes: Sizes) -> str:
    """What is wrong with a unit."""
    kind: UnitKind = "ratio" if of.kind == "steepness" else of.kind  # type: ignore[assignment]
    unit, allowed = (
        split_quantity(given)[1] if "/" not in str(given) or of.kind != "steepness" else "",
        units_of(kind, sizes),
    )
    if unit in ("L", "B", "T", "Fn") and unit not in allowed and unit in units_of(kind, Sizes(1.0, 1.0, 1.0)):
        return f'"{unit}" is of a ship, and none is known here'
    if not unit:
        return "that is no ratio"
    near = get_close_matches(unit, allowed, n=1, cutoff=0.5)
    hint = f'; did you mean "{near[0]}"?' if near else ""
    return f'unit "{unit}" is not known for {article(kind)} {kind}; units allowed: {", ".join(allowed) or "none, or %"}{hint}'


def _slip(of: Option, given: Any, sizes: Sizes) -> str:
    """The likely slip: another unit, or the other sign, that would put the same number in the range."""
    number, unit = (
        split_quantity(given) if not (isinstance(given, str) and "/" in given and not of.unit) else (math.nan, "x")
    )
    if of.kind == "angle" and of.high == 360 and unit in ("", "deg"):
        return f"did you mean {number % 360.0:g} deg?"
    if unit or of.kind == "steepness" or not math.isfinite(number):
        high = _resolved(of.high, of, sizes)
        over = high is not None and unit != "" and _number(given, of, sizes) > high
        if unit and of.kind == "density":
            other = {"kg/m3": "t/m3", "t/m3": "kg/m3"}[unit]
            low = _resolved(of.low, of, sizes)
            if low is not None and high is not None and low <= _number(f"{number!r} {other}", of, sizes) <= high:
                return f"did you mean {number:g} {other}?"
        return "is the unit right?" if over and of.kind != "steepness" else ""
    if number <= 0:
        return ""
    for other in (*units_of(of.kind, sizes), *(("%",) if of.kind == "ratio" else ())):  # type: ignore[arg-type]
        if other == of.unit:
            continue
        value = _number(f"{number!r} {other}", of, sizes)
        low, high = _resolved(of.low, of, sizes), _resolved(of.high, of, sizes)
        if low is not None and high is not None and low < value < high and low < value:
            return f"did you mean {number:g} {other}?"
    return ""


def _word(of: Option, given: Any, where: str) -> str:
    words = of.words or {}
    if isinstance(given, str) and given in words:
        _check_installed(of, given, where)
        return given
    near = get_close_matches(str(given), words, n=1, cutoff=0.4)
    allowed = ", ".join(f'"{word}" ({meaning})' for word, meaning in words.items())
    hint = f'; did you mean "{near[0]}"?' if near else f'; try "{of.default}"' if of.default else ""
    raise Refused(of.name, f"{of.name} = {quoted(given)}; allowed are {allowed}{hint}", where, of.group)


def _check_installed(of: Option, word: str, where: str) -> None:
    """Refuse a word that rests on a package which is not there, with what to install."""
    module, extra = (of.needs or {}).get(word, ("", ""))
    if not module:
        return
    from importlib.util import find_spec  # few options need anything

    if find_spec(module) is None:
        raise Refused(
            of.name,
            f"{of.name} = {word!r}; that needs {module.capitalize()}, which is not installed; install it with "
            f"`pip install 'quartering[{extra}]'`, or take \"{of.default}\"",
            where,
            of.group,
        )


def _text(of: Option, given: Any, where: str) -> Any:
    if isinstance(given, str) or of.kind != "text":
        return given
    raise Refused(of.name, f"{of.name} = {quoted(given)}; it is text, in quotes where it looks like a number", where)


def quoted(given: Any, longest: int = 60) -> str:
    """What was given as a message repeats it: whole, or its beginning."""
    text = repr(given)
    return text if len(text) <= longest else f"{text[: longest - 3]}..."
