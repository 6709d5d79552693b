"""Everything a ship, and the condition it is in, can be told: declared here once.

From this table are made the keys of ship and case files, `Ship.with_`, the axes of a study, command-line options, the dials of
the explorer and the fields of its service, the comments of new files, the JSON schemas, the table in the documentation, and
every refusal with its range.  To add an option, add it to `OPTIONS`, and run ``python tools/write_options.py`` for what
editors and type checkers read.  What acts on an option is written where its physics is; `Ship.value` reads it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from inspect import Parameter, Signature
from typing import Any, Final

from quartering.conventions import WATER_DENSITY
from quartering.option_checks import Kind, Option, Place, Refused, checked, quoted
from quartering.units import Sizes

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

    >>> part_values(option("autopilot"), "1,10s", "my ship", Sizes())
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
