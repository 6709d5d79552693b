"""Everything a ship, and the condition it is in, can be told: declared here once.

From this table are made the keys of ship and case files, `Ship.with_`, the axes of a study, command-line options, the dials of
the explorer and the fields of its service, the comments of new files, the JSON schemas, the table in the documentation, and
every refusal with its range.  To add an option, add it to `OPTIONS`, and run ``python tools/write_options.py`` for what
editors and type checkers read.  What acts on an option is written where its physics is; `Ship.value` reads it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from inspect import Parameter, Signature
from typing import Any, Final, Literal

from quartering.conventions import SYMBOLS, WATER_DENSITY, InputError, as_float
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
        self.option: str = option
        self.words: str = words
        self.group: str = group


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


_ENDS = {"strips": "none", "three-dimensional": "the water finds its way round them"}

OPTIONS: Final[dict[str, Option]] = {one.name: one for one in (
    # What floats
    Option("name", "text", "what the ship is called", home="name"),
    Option("length", "length", "between perpendiculars; stretches the lines, the loading in proportion", low=0, above=True,
           high=1000, usual="121.92 m", home="hull.length"),
    Option("beam", "length", "moulded; stretches the lines", low=0, above=True, high=300, usual="16.3 m", home="hull.beam"),
    Option("design_draught", "length", "draught the lines are drawn for; stretches their heights", low=0, above=True, high=100,
           usual="6.5 m", home="hull.design_draught"),
    Option("draught", "length", "draught the ship floats at; the lines stay", low=0, above=True, high=100, usual="6.5 m",
           axis=True, dial=(), home="hull.draught"),
    Option("depth", "length", "side of the hull from the keel to the deck; carries the lines up where they end below", low=0,
           above=True, high=100, usual="10 m", example="1.6 T"),
    Option("datum", "word", "where the heights of the lines are counted from; found from the lines where they tell it",
           words={"keel": "up from the keel at midship", "waterline": "up from the calm water"}, example="keel"),
    # How it is loaded
    Option("gm", "length", place="loading", low=0, above=True, usual="0.05 B", default="0.05 B", axis=True,
           hint="the metacentric height of a ship that floats upright",
           dial=(("m", "0.01 B", "0.15 B", 0.01),), home="loading.gm", label="GM"),
    Option("kg", "length", place="loading", low="-1 T", usual="1 T", axis=True, dial=(), home="loading.kg", label="KG"),
    Option("gyradius_roll", "length", place="loading", low=0, above=True, high="2 B", usual="0.35 B", default="0.35 B",
           axis=True, dial=(("m", "0.25 B", "0.5 B", 0.01), ("B", 0.25, 0.5, 0.005)), home="loading.gyradius_roll",
           label="roll gyradius"),
    Option("roll_period", "time", "natural roll period; gives the radius of gyration in roll, in its place", place="loading",
           low=0.1, high=120, usual="12 s", axis=True, dial=(), example="12 s"),
    Option("gyradius_pitch", "length", "radius of gyration in pitch, without added mass", place="loading", low=0, above=True,
           high="2 L", usual="0.25 L", default="0.25 L", example="0.25 L"),
    Option("gyradius_yaw", "length", place="loading", low=0, above=True, high="2 L", usual="0.25 L", default="0.25 L",
           axis=True, dial=(("m", "0.15 L", "0.35 L", 0.1), ("L", 0.15, 0.35, 0.005)), home="loading.gyradius_yaw",
           label="yaw gyradius"),
    Option("roll_damping", "ratio", place="loading", low=0, high=1, usual=0.05, default=0.05, axis=True,
           dial=(("%", 0, 20, 0.5),), home="loading.roll_damping", label="roll damping", title="Roll damping",
           words={"ikeda": "component method of Ikeda on the lines",
                  "ikeda-simplified": "regression of Kawahara, Maekawa and Ikeda"}),
    Option("water_density", "density", "of the water; fresh water 1000", place="loading", low=500, high=1500,
           usual=WATER_DENSITY, default=WATER_DENSITY, home="loading.density", axis=True, dial=()),
    Option("loadings", "table", "named loading cases, each with keys of a loading and a draught", acts=False,
           typed="Mapping[str, Mapping[str, Any]]",
           example="{ballast: {draught: 0.8 T, gm: 1.2 m}, departure: {kg: 6.9 m, roll_period: 11 s}}"),
    Option("loading_case", "text", "one of the named loading cases, which the ship then has", example="ballast"),
    # How it is computed
    Option("linear", "word", "sway-yaw derivatives", default="default", home="linear",
           words={"default": "lift from regression", "strip": "potential flow alone"}),
    Option("velocities", "word", "velocity that lift acts on", default="relative", home="velocities", axis=True, dial=(),
           words={"relative": "to the water, which the wave moves", "absolute": "over ground, as in the paper"}),
    Option("righting", "word", "righting curve in the equations", default="spline", home="righting",
           words={"spline": "the curve itself", "polynomial": "odd, to phi^7, as in the paper"}),
    Option("sections", "word", "section coefficients", default="auto", home="hull.section_method",
           words={"auto": "the section's own contour", "lewis": "its Lewis form", "close-fit": "its own contour"}),
    Option("hydrodynamics", "word", "added mass, damping and wave forces at zero speed, where no database gives them",
           default="strips", home="hydrodynamics", needs={"panels": ("capytaine", "bem")},
           words={"strips": "strip theory", "panels": "three-dimensional panels of Capytaine, solved once for a hull"}),
    Option("ends", "word", "water round stem and stern", default="three-dimensional", home="hull.ends", words=_ENDS),
    Option("drag_coefficient", "ratio", "cross-flow drag of the sections", low=0, high=10,
           usual=0.8, default=0.8, home="drag_coefficient"),
    Option("drag", "word", "form of the cross-flow drag", default="strips", home="drag", axis=True, dial=(),
           words={"strips": "|q| q strip by strip", "cubic": "ten cubic coefficients, one reference velocity"}),
    Option("velocity_scale", "speed", "velocity at which the cross-flow drag is made cubic", low=0, above=True, high=100,
           usual="0.03 Fn", home="velocity_scale", example="0.03 Fn"),
    Option("measured", "file", "measured manoeuvring set that replaces regression and cross-flow, or none", home="measured",
           example="son-nomoto-1982"),
    Option("database", "file", "your own coefficients and wave forces at zero speed, in place of strip theory: a file of"
           " Capytaine or WAMIT, or none", home="database", typed="Database | str | Path",
           example="{file: my.nc, midship: 0.0}"),
    # What it carries
    Option("autopilot", "group", "keeps the course: rudder angle = gain x heading off course + rate_gain x rate of turn",
           home="autopilot", typed="Autopilot | Mapping[str, float | str] | str",
           example="{gain: 1.0, rate_gain: 10 s, lag: 2 s}"),
    Option("autopilot_gain", "ratio", "rudder angle per angle off course", group="autopilot", key="gain", low=0, high=100,
           usual=1.0),
    Option("autopilot_rate_gain", "time", "rudder angle per rate of turn", group="autopilot", key="rate_gain", low=0, high=1000,
           usual="10 s", default=0.0),
    Option("autopilot_lag", "time", "time constant of the steering gear", group="autopilot", key="lag", low=0, high=1000,
           usual="2 s", default=0.0),
    Option("rudder", "group", "its lift is estimated from these; by rule when left out", home="rudder",
           typed="Rudder | Mapping[str, float | str] | str", example="{area: 20 m2, aspect: 1.8}"),
    Option("rudder_area", "area", "of the blade, side view", group="rudder", key="area", low=0, above=True, high=1000,
           usual="20 m2"),
    Option("rudder_aspect", "ratio", "height over chord", group="rudder", key="aspect", low=0, above=True, high=20, usual=1.8,
           default=1.8),
    Option("bilge_keels", "group", "one of the pair; ikeda and ikeda-simplified allow for them", home="bilge_keels",
           typed="tuple[float | str, float | str] | Mapping[str, float | str] | str",
           example="{length: 0.25 L, breadth: 0.02 B}"),
    Option("bilge_keel_length", "length", group="bilge_keels", key="length", low=0, high="1 L", usual="0.25 L", axis=True,
           dial=(("m", "0.05 L", "0.6 L", 0.1), ("L", 0.05, 0.6, 0.01)), title="Roll damping", label="keel length"),
    Option("bilge_keel_breadth", "length", group="bilge_keels", key="breadth", low=0, high="0.25 B", usual="0.02 B", axis=True,
           dial=(("m", 0, "0.06 B", 0.01), ("B", 0, 0.06, 0.001)), title="Roll damping", label="keel breadth"),
    Option("bilge_keel_area", "area", "total area of the bilge keels, where their length and breadth are not given", low=0,
           high=1000, usual="20 m2", example="20 m2"),
    Option("openings", "angle", "heel at which unprotected openings go under: a capsize", low=0, above=True, high=180,
           usual="40 deg", example="40 deg"),
    Option("highest_position", "group", "where people are highest, whose acceleration in a sea counts",
           typed="Mapping[str, float | str] | str", example="{x: 40 m, height: 25 m}"),
    Option("highest_position_x", "length", "from midship, + forward", group="highest_position", key="x", low="-1 L", high="1 L",
           usual="0.3 L"),
    Option("highest_position_height", "length", "over the keel", group="highest_position", key="height", low=0, above=True,
           high=150, usual="25 m"),
    Option("windage", "group", "what the wind meets: side above the water",
           typed="Mapping[str, float | str] | str", example="{area: 900 m2, lever: 9 m}"),
    Option("windage_area", "area", "projected on the side", group="windage", key="area", low=0, high=100_000, usual="900 m2"),
    Option("windage_lever", "length", "its centre over half the draught", group="windage", key="lever", low=0, high=100,
           usual="9 m"),
    Option("propulsion", "group", "resistance r0 + r1 u + .. + r5 u^5, propeller k0 + k1 J + k2 J^2",
           typed="Propulsion | Mapping[str, float | str] | str", words={"estimated": "from the lines"},
           example="{diameter: 4.5 m, k0: 0.45, k1: -0.28, k2: -0.12, wake: 0.25, thrust_deduction: 0.15, r2: 20e3}"),
    Option("propeller_diameter", "length", "of the propeller", group="propulsion", key="diameter", low=0, above=True,
           high="2 T", usual="0.7 T"),
    Option("thrust_at_rest", "ratio", "k0 of the thrust coefficient", group="propulsion", key="k0", low=0, above=True, high=2,
           usual=0.45),
    Option("thrust_slope", "ratio", "k1 of the thrust coefficient", group="propulsion", key="k1", low=-5, high=5, usual=-0.28),
    Option("thrust_curvature", "ratio", "k2 of the thrust coefficient", group="propulsion", key="k2", low=-5, high=5,
           usual=-0.12, default=0.0),
    Option("thrust_deduction", "ratio", "of the propeller behind the hull", group="propulsion", low=0, high=0.9, usual=0.15,
           default=0.0),
    Option("wake_fraction", "ratio", "of the propeller behind the hull", group="propulsion", key="wake", low=0, high=0.9,
           usual=0.25, default=0.0),
    Option("propellers", "ratio", "how many equal ones", group="propulsion", low=1, high=10, usual=1, default=1),
    *(Option(f"resistance_{i}", "ratio", f"r{i} of the resistance [N/(m/s)^{i}]", group="propulsion", key=f"r{i}", low=-1e8,
             high=1e8, usual=20e3 if i == 2 else 0.0, default=0.0) for i in range(6)),
    # What is known of the coefficients
    Option("values", "coefficients", "coefficients you know, in SI about G, by name; they replace the estimates",
           key="coefficients", home="overrides", typed="Mapping[str, float]", example="{N_r: -2.0e9}", also=("values",)),
    Option("factors", "coefficients", "factors on coefficients, however they were found", home="multipliers",
           typed="Mapping[str, float]", example="{K_p: 1.0}", also=("multipliers",)),
    # The condition
    Option("speed", "speed", place="condition", low=0, high=100, usual="15 kn", axis=True, hint="heading tells the direction"),
    Option("heading", "angle", place="condition", low=-180, high=360, usual=60, axis=True,
           hint="0 following, 180 head sea, beyond with the wave on the other side"),
    Option("wave_length", "wave length", place="condition", low=0, above=True, high=1e5, usual="1 L", axis=True),
    Option("wave_period", "time", "period of the wave seen from a fixed point, in place of its length", place="condition",
           low=0, above=True, high=250, usual="9 s"),
    Option("wave_height", "length", place="condition", low=0, high=1e4, usual="4 m", axis=True),
    Option("steepness", "steepness", place="condition", low=0, above=True, high="1/7", usual="1/50", axis=True),
    Option("extend", "word", "carry a polar map on past an edge that its largest roll stands on", place="condition",
           usual="yes", default="no", words={"no": "the map as it is asked for", "yes": "until the largest roll is inside"}),
)}  # fmt: skip
"""Every option by name, in the order in which files and tables show them."""


def options(
    *,
    place: Place | None = None,
    axis: bool | None = None,
    group: str | None = None,
    kinds: tuple[Kind, ...] | None = None,
) -> Iterator[Option]:
    """Options of a place, of a group (all that are no part of one by default), that are axes of a study."""
    for one in OPTIONS.values():
        wanted = (place in (None, one.place), axis in (None, one.axis), group in (None, one.group))
        if all(wanted) and (kinds is None or one.kind in kinds):
            yield one


def option(name: str, where: str = "") -> Option:
    """The option of a name.

    where: the message begins with it
    """
    if name not in OPTIONS:
        raise unknown(name, OPTIONS, where)
    return OPTIONS[name]


def unknown(name: str, known: Mapping[str, Any] | tuple[str, ...], where: str = "") -> Refused:
    """The refusal of a name that is none of those known."""
    near = get_close_matches(str(name), list(known), n=1, cutoff=0.5)
    hint = f"did you mean {near[0]}?" if near else f"known are {', '.join(known)}"
    return Refused(str(name), f"{name} is unknown; {hint}", where)


def parts(group: str) -> dict[str, Option]:
    """Parts of a group by their key in a file."""
    return {one.path[-1]: one for one in options(group=group)}


def no_coefficients(name: str, given: Any) -> Refused:
    """The refusal of what is no mapping of coefficients."""
    return Refused(
        name, f"{name} = {quoted(given)}; it is coefficients with a number each, such as {OPTIONS[name].example}"
    )


def part_values(of: Option, given: Any, where: str, sizes: Sizes) -> Any:
    """Values of a group by key, from a mapping, a sequence in the order of its parts, or text such as "1,10s,2s".

    of: a group
    given: "none" for none
    as for `checked`

    Returns None for none, or another word the group may be

    >>> part_values(option("autopilot"), "1,10s", "my ship", NO_SHIP)
    {'gain': 1.0, 'rate_gain': 10.0, 'lag': 0.0}
    """
    own = parts(of.name)
    if isinstance(given, str):
        if given.strip() == "none":
            return None
        if given.strip() in (of.words or {}):
            return given.strip()
        if of.words and "," not in given:
            likely = get_close_matches(given.strip(), of.words, n=1, cutoff=0.5)
            hint = f"; did you mean {likely[0]}?" if likely else ""
            words = f"{of.name} = {quoted(given)}; it is {' or '.join(of.words)}, or a group of {', '.join(own)}{hint}"
            raise Refused(of.name, words, where)
        given = [part.strip() for part in given.split(",")]
    if isinstance(given, (tuple, list)):
        if len(given) > len(own):
            raise Refused(of.name, f"{of.name} = {quoted(given)}; it has {len(own)} values: {', '.join(own)}", where)
        given = dict(zip(own, given, strict=False))
    if not isinstance(given, Mapping):
        words = f"{of.name} = {quoted(given)}; it is a group of {', '.join(own)}, such as {of.example}"
        raise Refused(of.name, words, where)
    for key in given:
        if key not in own:
            near = get_close_matches(str(key), list(own), n=1, cutoff=0.0)
            words = f"{of.name}: {key} is unknown; did you mean {near[0]}? It has {', '.join(own)}"
            raise Refused(of.name, words, where)
    found = {}
    for key, one in own.items():
        if given.get(key) is None and one.default is None:
            words = f"{of.name}: {key} is missing; give {', '.join(own)}, such as {of.example}"
            raise Refused(of.name, words, where)
        value = given.get(key)
        found[key] = float(one.default) if value is None else checked(one, value, where, sizes)  # type: ignore[arg-type]
    return found


def ship_options() -> list[Option]:
    """What `Ship.with_` takes: every option that is no condition."""
    return [one for one in OPTIONS.values() if one.place != "condition"]


def loading_axes() -> tuple[str, ...]:
    """Names of the numbers of a ship a study may vary."""
    return tuple(one.name for one in ship_options() if one.axis and one.numeric)


def choice_axes() -> dict[str, tuple[str, ...]]:
    """Axes of words, each with its words; a study numbers them in this order.

    >>> choice_axes()["velocities"]
    ('relative', 'absolute')
    """
    return {one.name: tuple(one.words or ()) for one in ship_options() if one.axis and one.kind == "word"}


def line_of(one: Option) -> str:
    """An option in a line: meaning, units, default."""
    units = f" {one.units}" if one.units not in ("", "[1]") else ""
    words = one.words or {}
    if one.numeric:
        beside = f", or {' or '.join(words)}" if words else ""
    else:
        beside = ": " + ", ".join(f"{word} ({meaning})" for word, meaning in words.items()) if words else ""
    return f"{one.text}{units}{beside}{'' if one.acts else '; recorded'}"


def signature() -> Signature:
    """Signature of `Ship.with_`, for `help` and completion."""
    keywords = [
        Parameter(one.name, Parameter.KEYWORD_ONLY, default=None, annotation=one.python) for one in ship_options()
    ]
    return Signature([Parameter("self", Parameter.POSITIONAL_OR_KEYWORD), *keywords], return_annotation="Ship")


def described(text: str | None) -> str | None:
    """A docstring with the options in the place of ``**given``."""
    if text is None:
        return None
    lines = text.splitlines()
    at = next((i for i, line in enumerate(lines) if line.strip().startswith("**given")), None)
    if at is None:
        return text
    margin = " " * (len(lines[at]) - len(lines[at].lstrip()))
    own = [f"{margin}{one.name} : {one.python}\n{margin}    {line_of(one)}" for one in ship_options()]
    return "\n".join([*lines[:at], *own, *lines[at + 1 :]])
