"""The values of a ship a study may vary: loading, draught, bilge keels and multipliers of coefficients."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import InputError
from quartering.hull.changes import changed
from quartering.hull.ship import Ship
from quartering.hydro.damping.natural_roll import free_roll
from quartering.hydro.source.of_ship import source_of
from quartering.option_checks import checked
from quartering.options import OPTIONS, choice_axes, loading_axes

KEEL_AXES = ("bilge_keel_length", "bilge_keel_breadth")
LOADING_AXES = loading_axes()
CHOICE_AXES: Final = choice_axes()
"""Axes of words; their values are the places of the words, as flags."""
VALUE: Final = "_value"
"""What the name of a coefficient ends with where values of it are given, not factors on it: K_p_value."""


def loaded(ship: Ship, values: Mapping[str, float]) -> Ship:
    """The ship with loading values set and coefficients multiplied.

    values: gm, kg, gyradius_roll, gyradius_yaw, draught [m], roll_damping; bilge_keel_length, bilge_keel_breadth [m],
        which a ship without keels needs both of, 0 for none, and the other axes of `quartering.options`, a word by its
        place; K_p multiplies that coefficient, K_p_value gives it
    Returns with bilge keels: its roll damping by components, "ikeda" where it said a fraction
    """
    if not values:
        return ship
    own: dict[str, Any] = {name: v for name, v in values.items() if name in LOADING_AXES and name not in KEEL_AXES}
    own |= {name: words[int(values[name])] for name, words in CHOICE_AXES.items() if name in values}
    own["values"] = {name.removesuffix(VALUE): v for name, v in values.items() if name.endswith(VALUE)}
    known = (*LOADING_AXES, *CHOICE_AXES)
    own["factors"] = {n: v for n, v in values.items() if n not in known and not n.endswith(VALUE)}
    keels = {name: values[name] for name in KEEL_AXES if name in values}
    if not keels:
        return _known_roll(changed(ship, own))
    if "roll_damping" in own:
        raise InputError(
            "roll_damping as a fraction of critical stands for the bilge keels too, and bilge_keel_length and "
            "bilge_keel_breadth are given beside it; leave out the one or the others"
        )
    method = ship.roll_method if ship.damped_by_components else "ikeda"
    return _known_roll(changed(ship, own | {"roll_damping": method, "bilge_keels": _keels(ship, keels)}))


def coded(name: str, value: Any) -> Any:
    """The place of a word among those of an axis of words; any other value as it is.

    name: of the axis
    a word, or a place already

    >>> coded("velocities", "absolute"), coded("gm", 0.8)
    (1, 0.8)
    """
    if name not in CHOICE_AXES:
        return value
    words = CHOICE_AXES[name]
    if not isinstance(value, str) and value in range(len(words)):
        return value
    return words.index(checked(OPTIONS[name], value))


def _known_roll(ship: Ship) -> Ship:
    """The ship, refused where its own database does not reach the frequency it now rolls at."""
    source = source_of(ship)
    if np.isfinite(source.held.frequency[1]):  # strips hold every frequency
        source.check(np.array([free_roll(ship).frequency]))
    return ship


def _keels(ship: Ship, given: Mapping[str, float]) -> tuple[float, float]:
    """Length and breadth of one keel; (0, 0) for none."""
    own = dict(zip(KEEL_AXES, ship.bilge_keels, strict=True)) if ship.bilge_keels else {}
    missing = [name for name in KEEL_AXES if name not in given and name not in own]
    if missing:
        usual = 0.25 * ship.hull.length if missing[0] == KEEL_AXES[0] else 0.02 * ship.hull.beam
        raise InputError(
            f"{', '.join(given)} is given, and {ship.name} has no bilge keels of its own: give {missing[0]} too;"
            f" try {usual:.2g} m"
        )
    length, breadth = ({**own, **given}[name] for name in KEEL_AXES)
    return (0.0, 0.0) if 0.0 in (length, breadth) else (length, breadth)


def base_of(ship: Ship, loadings: Mapping[str, NDArray[np.float64]]) -> Ship:
    """Ship stored in the manifest; its roll-damping method is the one the varied values imply.

    loadings: values of loading l by name, as for `loaded`
    Returns with the first damping, or its own keels or else the first; else as it is

    >>> from quartering.hull.file.read import ship
    >>> keels = {"bilge_keel_length": np.full(2, 40.0), "bilge_keel_breadth": np.array([0.0, 0.4])}
    >>> base_of(ship("s175"), keels).roll_damping_words
    'component method of Ikeda on the lines, no bilge keels'
    """
    names = [name for name in ("roll_damping", *KEEL_AXES) if name in loadings]
    if names == ["roll_damping"] and not ship.damped_by_components:  # the same way with another number
        return ship
    first = {name: float(loadings[name][0]) for name in names}
    if ship.bilge_keels:  # a first breadth of 0 would take their length away with them
        first |= {name: user_value(ship, name) for name in names if name in KEEL_AXES}
    return loaded(ship, first)


def user_value(ship: Ship, name: str) -> float:
    """Present value of what a study may vary.

    name: one of `LOADING_AXES`, or a coefficient
    Returns in the unit of the option; 0 for what a ship does not have; 1 for a factor on a coefficient, NaN for a value
        of one that was not given
    """
    if name == "roll_period":
        return 2.0 * math.pi / free_roll(ship).frequency
    if name.endswith(VALUE):
        return ship.overrides.get(name.removesuffix(VALUE), math.nan)
    if name in CHOICE_AXES:
        return float(CHOICE_AXES[name].index(ship.value(name)))
    if name not in LOADING_AXES:
        return 1.0
    value = ship.value(name)
    return 0.0 if value is None else float(value)
