"""Apply option values to a ship: the implementation of `Ship.with_` and of ship files."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from quartering.conventions import InputError
from quartering.hull.autopilot import Autopilot, Rudder
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.hull import Hull, at_draught, scaled, with_depth
from quartering.hull.lines.sense import check_proportions
from quartering.hull.loading import Loading, loaded_alike, reloaded
from quartering.hull.propulsion import Propulsion, propulsion_of_parts
from quartering.hull.roll_method import BilgeKeels, RollMethod, checked_bilge_keels, roll_damping_note, roll_method
from quartering.hull.roll_period import gyradius_of_period
from quartering.hull.user_database import DATABASE_IS, Database, database_of, database_of_keys
from quartering.hull.user_measured import MeasuredFile, measured_source
from quartering.names import term
from quartering.option_checks import Option, Refused, checked, quoted
from quartering.options import OPTIONS, no_coefficients, options, part_values, parts, unknown
from quartering.units import Sizes, quantity

if TYPE_CHECKING:
    from quartering.hull.ship import Ship

CHANGED = "changed from the ship's own"
_TWICE = (("gm", "kg"), ("gyradius_roll", "roll_period"), ("bilge_keels", "bilge_keel_area"))
"""Options of which one follows from the other."""
_LOADING = ("gm", "kg", "gyradius_roll", "gyradius_yaw", "roll_damping", "water_density")
_DIMENSIONS = ("length", "beam", "design_draught")


def sizes_of(hull: Hull) -> Sizes:
    """What L, B and T stand for."""
    return Sizes(hull.length, hull.beam, hull.draught)


def changed(ship: Ship, given: Mapping[str, Any], where: str | None = None) -> Ship:
    """A ship with some options changed.

    given: options of `quartering.options`; None keeps what the ship has
    where: ship or file named in messages
    """
    where = ship.name if where is None else where
    wanted = {name: value for name, value in given.items() if value is not None}
    _check_names(wanted, where)
    case, wanted = _of_case(ship, wanted, where)
    check_twice(wanted, where)
    check_datum(ship, wanted, where)
    floating, loading = _floating(ship, wanted, where)
    sizes = sizes_of(floating)
    wanted |= _grouped(ship, wanted, where, sizes)
    database = _database(ship, wanted, where)
    _check_draught_of_database(ship, floating, database, wanted)
    _check_panels(ship, database, wanted, where)
    hull = _solved_by(ship, floating, wanted, where, database)
    numbers = {name: _checked(name, wanted[name], where, sizes) for name in _LOADING if name in wanted}
    density = numbers.pop("water_density", loading.density)
    loading = replace(loading, density=density)
    moved = floating.draught != ship.hull.draught or any(name in wanted for name in _DIMENSIONS)
    if moved or {"gm", "kg"} & numbers.keys():
        loading = reloaded(where, hull, loading, **numbers)
    else:  # the centre of gravity stays where it is, to the last bit
        loading = loaded_alike(loading, numbers)
    method: RollMethod = ship.roll_method if "roll_damping" not in numbers else roll_method(numbers["roll_damping"])
    keels = _keels(ship, hull, method, wanted, where)
    rest = {
        one.home: _plain(one, wanted[name], where, sizes)
        for name in wanted
        if (one := OPTIONS[name]).home and "." not in one.home and name not in _ELSEWHERE
    }
    made = replace(
        ship, **rest, hull=hull, loading=loading, roll_method=method, bilge_keels=keels, database=database,
        overrides={**ship.overrides, **_coefficients(wanted.get("values", {}), where, "values")},
        multipliers=_multipliers(ship, wanted, where),
        particulars={**ship.particulars, **_particulars(wanted, where, sizes)},
    )  # fmt: skip
    notes = _notes(ship, made, {*wanted}, case)
    made = replace(made, provenance={**ship.provenance, **notes})
    return made if "roll_period" not in wanted else _rolling(made, wanted, where)


_ELSEWHERE = ("database", "bilge_keels", "values", "factors")
"""Options `changed` sets by name."""


def _check_names(given: Mapping[str, Any], where: str) -> None:
    known = {name: one for name, one in OPTIONS.items() if one.place != "condition"}
    if "coefficients" in given:
        raise Refused("coefficients", COEFFICIENTS, where)
    for name in given:
        if name not in known:
            raise unknown(name, known, where)


COEFFICIENTS = (
    "coefficients is not taken here any more: it multiplied, where a ship file's `coefficients:` gives values; write factors"
    ' to multiply, such as factors={"K_p": 0.5}, or values to give, such as values={"K_p": -2.0e8}'
)
"""Refusal of a word that meant two things."""


def check_twice(given: Mapping[str, Any], where: str) -> None:
    """Refuse two options of which one stands for the other, and a part given beside its group."""
    for one, other in _TWICE:
        if one in given and other in given:
            raise Refused(other, f"{one} and {other} are both given; one stands for the other, leave one out", where)
    for name in given:
        if name in OPTIONS and (group := OPTIONS[name].group) in given:
            raise Refused(name, f"{name} is given beside {group}, whose part it is; leave one out", where)


def check_datum(ship: Ship, given: Mapping[str, Any], where: str) -> None:
    """Refuse another datum for lines that are read: it acts while a file is read."""
    if "datum" not in given:
        return
    wanted, has = checked(OPTIONS["datum"], given["datum"], where), ship.hull.datum
    if wanted != has:
        raise Refused(
            "datum",
            f"datum = {wanted}; heights of these lines were counted from {has} as they were read; datum acts while lines of a "
            "file are read: write it in the ship file beside `lines:` or `offsets:`",
            where,
        )


def _of_case(ship: Ship, given: dict[str, Any], where: str) -> tuple[str, dict[str, Any]]:
    """The values of a named loading case, those given beside it in place of its own."""
    name = given.get("loading_case")
    if name is None:
        return "", given
    cases = ship.particulars.get("loadings", {})
    if "loadings" in given:
        cases = _loading_cases(given["loadings"], where, sizes_of(ship.hull))
    if not isinstance(name, str) or name not in cases:
        raise Refused("loading_case", _no_case(name, tuple(cases)), where)
    return str(name), _merged(cases[name], given)


def _no_case(name: Any, cases: tuple[str, ...]) -> str:
    if not cases:
        return f"loading_case = {quoted(name)}; the ship has no loading cases; name some below `loadings:` of its file"
    return str(unknown(str(name), cases).words).replace(str(name), f"loading_case = {quoted(name)}", 1)


def _merged(case: Mapping[str, Any], given: Mapping[str, Any]) -> dict[str, Any]:
    """Values of a loading case below those given, of which some stand in the place of another one."""
    gone = {other for pair in _TWICE for one, other in (pair, pair[::-1]) if one in given}
    return {name: value for name, value in case.items() if name not in gone} | dict(given)


def _checked(name: str, value: Any, where: str, sizes: Sizes) -> Any:
    return checked(OPTIONS[name], value, where, sizes)


def _floating(ship: Ship, given: Mapping[str, Any], where: str) -> tuple[Hull, Loading]:
    """Hull of other dimensions, depth and draught, and the loading in proportion to it."""
    hull, loading = ship.hull, ship.loading
    if any(name in given for name in _DIMENSIONS):
        own = sizes_of(hull)
        length, beam, design = (
            _checked(name, given[name], where, own) if name in given else None for name in _DIMENSIONS
        )
        along = 1.0 if length is None else length / hull.length
        across = along if beam is None else beam / hull.beam
        up = along if design is None else design / hull.design_draught
        hull = scaled(hull, along, across, up)
        loading = replace(
            loading, gm=loading.gm * up, kg=hydrostatics(hull).km - loading.gm * up,
            gyradius_roll=loading.gyradius_roll * across, gyradius_yaw=loading.gyradius_yaw * along,
        )  # fmt: skip
    if "depth" in given:
        hull = with_depth(hull, _checked("depth", given["depth"], where, sizes_of(hull)), called=where)
    if "draught" in given:
        draught = _checked("draught", given["draught"], where, sizes_of(hull))
        hull = hull if draught == hull.draught else at_draught(hull, draught, called=where)
    if any(name in given for name in (*_DIMENSIONS, "draught")):
        check_proportions(where, hull.length, hull.beam, hull.draught)
    return hull, loading


def _grouped(ship: Ship, given: Mapping[str, Any], where: str, sizes: Sizes) -> dict[str, Any]:
    """Groups of which single parts are given, completed by what the ship has."""
    made: dict[str, Any] = {}
    for name, value in given.items():
        one = OPTIONS[name]
        if one.group:
            own = made.get(one.group) or part_of_ship(ship, one.group)
            made[one.group] = {**own, one.path[-1]: checked(one, value, where, sizes)}
    return made


def part_of_ship(ship: Ship, group: str) -> dict[str, float]:
    """Values of a group by key, as far as the ship has them."""
    value = ship.value(group)
    if value is None or isinstance(value, str):
        return {}
    keys = list(parts(group))
    if isinstance(value, Mapping):
        return dict(value)
    return (
        dict(zip(keys, value, strict=True)) if isinstance(value, tuple) else {key: getattr(value, key) for key in keys}
    )


def _database(ship: Ship, given: Mapping[str, Any], where: str) -> Database | None:
    value = given.get("database", ship.database)
    if value is None or isinstance(value, Database):
        return value
    if isinstance(value, Mapping):
        return database_of_keys(value, where)
    if not isinstance(value, (str, Path)):
        raise Refused("database", f"database = {quoted(value)}; {DATABASE_IS}", where)
    return None if value == "none" else database_of(value, where)


def _check_draught_of_database(ship: Ship, hull: Hull, database: Database | None, given: Mapping[str, Any]) -> None:
    if database is not None and "database" not in given and not math.isclose(hull.draught, ship.hull.draught):
        raise InputError(
            f"{ship.name}: {database.name} is of draught {ship.hull.draught:g} m, and {hull.draught:g} m is asked "
            'for; give the database of that draught too, or database="none"'
        )


def _check_panels(ship: Ship, database: Database | None, given: Mapping[str, Any], where: str) -> None:
    """Refuse panels beside a database, and a correction of strips that panels take the place of."""
    if checked(OPTIONS["hydrodynamics"], given.get("hydrodynamics", ship.hydrodynamics), where) != "panels":
        return
    if database is not None:
        raise Refused(
            "hydrodynamics",
            f"hydrodynamics = panels, and {database.name} gives added mass, damping and wave forces too; leave one of the two "
            "out (hydrodynamics: strips, or database: none)",
            where,
        )
    if given.get("ends") == "three-dimensional":
        raise Refused(
            "ends",
            'ends = "three-dimensional" corrects the strips, and panels take their place; leave one of the two out (ends, or '
            "hydrodynamics: panels)",
            where,
        )


def _solved_by(ship: Ship, hull: Hull, given: Mapping[str, Any], where: str, database: Database | None) -> Hull:
    """The hull with its numerical choices; the same one where none differs, since a hull is solved once."""
    chosen = {
        one.home.partition(".")[2]: checked(
            one, given.get(one.name, getattr(ship.hull, one.home.partition(".")[2])), where
        )
        for one in options(kinds=("word",))
        if one.home.startswith("hull.")
    }
    if database is not None and "ends" not in given:
        chosen["ends"] = "strips"  # the database stands for the whole hull, its ends among it
    if chosen.get("ends") == "three-dimensional" and database is not None:
        raise Refused(
            "ends",
            f'ends = "three-dimensional" corrects the strips, and {database.name} takes their place; leave one of the two out '
            "(ends: strips, or database: none)",
            where,
        )
    return hull if all(getattr(hull, key) == value for key, value in chosen.items()) else replace(hull, **chosen)


def _keels(ship: Ship, hull: Hull, method: RollMethod, given: Mapping[str, Any], where: str) -> BilgeKeels | None:
    """Bilge keels [m]; refused beside a method that does not allow for them."""
    if "bilge_keels" not in given:
        return ship.bilge_keels
    value = part_values(OPTIONS["bilge_keels"], given["bilge_keels"], where, sizes_of(hull))
    keels = (
        None
        if value is None
        else checked_bilge_keels(where, hull.length, hull.beam, (value["length"], value["breadth"]))
    )
    if keels is not None and method == "fraction":
        raise Refused(
            "bilge_keels",
            f"bilge_keels = {keels[0]:.4g} x {keels[1]:.4g} m act in the methods of Ikeda, and roll_damping is a fraction of "
            "critical, which stands for keels too; write roll_damping: ikeda (or ikeda-simplified), or leave the keels out",
            where,
        )
    return keels


def _plain(one: Option, value: Any, where: str, sizes: Sizes) -> Any:
    """Value of an option as the ship keeps it."""
    if one.name == "measured":
        if isinstance(value, MeasuredFile):
            return value
        return None if isinstance(value, str) and value == "none" else measured_source(value)
    if one.kind == "group":
        record = {"autopilot": Autopilot, "rudder": Rudder}[one.name]
        if isinstance(value, record):
            return value
        found = part_values(one, value, where, sizes)
        return None if found is None else record(**found)
    return checked(one, value, where, sizes)


def _coefficients(given: Any, where: str, name: str) -> dict[str, float]:
    """Coefficients by name, from a mapping or from text such as "K_ppp=0.5,K_prr=2"."""
    pairs: Any = given
    if isinstance(given, str):
        pairs = {key.strip(): value for key, _, value in (part.partition("=") for part in given.split(","))}
        if "=" not in given:
            pairs = None
    if not isinstance(pairs, Mapping):
        raise Refused(name, no_coefficients(name, given).words, where)
    found = {}
    for key, one in pairs.items():
        try:
            term(str(key))
        except InputError as error:
            raise Refused(name, str(error), where) from None
        try:
            found[key] = quantity(one, "ratio", what=key)
        except InputError:
            words = f"{name}: {key} = {quoted(one)}; it is a finite number, such as {OPTIONS[name].example}"
            raise Refused(name, words, where) from None
    return found


def _multipliers(ship: Ship, given: Mapping[str, Any], where: str) -> dict[str, float]:
    """Factors after further ones: a factor of 1 changes nothing, and a value given starts anew."""
    own = {name: factor for name, factor in ship.multipliers.items() if name not in given.get("values", {})}
    further = _coefficients(given.get("factors", {}), where, "factors")
    return own | {name: factor * own.get(name, 1.0) for name, factor in further.items()}


def _particulars(given: Mapping[str, Any], where: str, sizes: Sizes) -> dict[str, Any]:
    """Values of the options that have no attribute of their own."""
    found: dict[str, Any] = {}
    for name, value in given.items():
        one = OPTIONS[name]
        if one.home or one.group or name == "roll_period":
            continue
        if name == "propulsion":
            found[name] = _propulsion(one, value, where, sizes)
        elif one.kind == "group":
            found[name] = part_values(one, value, where, sizes)
        elif one.kind == "table":
            found[name] = _loading_cases(value, where, sizes)
        else:
            found[name] = checked(one, value, where, sizes)
    return found


def _propulsion(one: Option, given: Any, where: str, sizes: Sizes) -> Any:
    """Resistance and propeller by key, or how they are estimated; what makes no propeller is refused."""
    if isinstance(given, Propulsion):
        return given.parts
    found = part_values(one, given, where, sizes)
    if isinstance(found, Mapping):
        try:
            propulsion_of_parts(found)
        except InputError as error:
            raise Refused(one.name, f"{one.name}: {error}", where) from None
    return found


def _loading_cases(given: Any, where: str, sizes: Sizes) -> dict[str, dict[str, Any]]:
    """Named loading cases with their keys and ranges checked, each value as it was written."""
    if not isinstance(given, Mapping) or not all(isinstance(case, Mapping) for case in given.values()):
        raise Refused(
            "loadings",
            f"loadings = {quoted(given)}; it is a table of named cases, such as {OPTIONS['loadings'].example}",
            where,
        )
    known = {one.name: one for one in options(place="loading") if one.numeric} | {"draught": OPTIONS["draught"]}
    for name, case in given.items():
        for key, value in case.items():
            if key not in known:
                raise Refused("loadings", f"loadings, {name}: {unknown(key, known).words}", where)
            try:
                checked(known[key], value, "", sizes)
            except Refused as error:
                raise Refused("loadings", f"loadings, {name}: {error.words}", where) from None
        try:
            check_twice(case, "")
        except Refused as error:
            raise Refused("loadings", f"loadings, {name}: {error.words}", where) from None
    return {str(name): dict(case) for name, case in given.items()}


def _notes(ship: Ship, made: Ship, given: set[str], case: str) -> dict[str, str]:
    """What to say of the values in which another ship differs, given ones and those that follow."""
    by = f"given: loading case {case}" if case else f"given: {CHANGED}"
    notes = {}
    for one in options(group="", kinds=None):
        name = one.name
        if one.place == "condition" or name in (
            "roll_damping",
            "bilge_keels",
            "values",
            "factors",
            "roll_period",
            "loadings",
        ):
            continue
        if (one.place == "loading" and one.home) or name == "drag_coefficient":
            if not math.isclose(ship.value(name), made.value(name)):
                notes[name] = by if name in given else f"derived: {CHANGED}"
        elif (not one.home and name in given) or (one.kind in ("group", "speed") and name in given):
            notes[name] = by
    notes |= {name: f"given: {CHANGED}" for name in made.overrides if ship.overrides.get(name) != made.overrides[name]}
    return notes | _note_of_damping(ship, made)


def _note_of_damping(ship: Ship, made: Ship) -> dict[str, str]:
    """Provenance note for a changed roll-damping method, bilge keels or amount."""
    if made.damped_by_components:
        if (made.roll_method, made.bilge_keels) != (ship.roll_method, ship.bilge_keels):
            return {"roll_damping": roll_damping_note(made.roll_method, made.bilge_keels)}
        return {}
    same = made.roll_method == ship.roll_method and math.isclose(ship.loading.roll_damping, made.loading.roll_damping)
    return {} if same else {"roll_damping": f"given: {CHANGED}"}


def _rolling(ship: Ship, given: Mapping[str, Any], where: str) -> Ship:
    """The ship with the radius of gyration that gives it a natural roll period."""
    period = _checked("roll_period", given["roll_period"], where, sizes_of(ship.hull))
    radius = gyradius_of_period(ship, period, where)
    note = {"gyradius_roll": f"derived: natural roll period {period:.4g} s, with the water that moves along"}
    loading = replace(ship.loading, gyradius_roll=radius)
    return replace(ship, loading=loading, provenance={**ship.provenance, **note})
