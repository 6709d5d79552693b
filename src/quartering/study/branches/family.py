"""Parametrised equations of a ship or model, for branches and stability boundaries."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.hull.told import number
from quartering.loads.waves import Wave
from quartering.motion.branches.branch import Family
from quartering.motion.equations.batch import joined
from quartering.motion.equations.batch import rows as rows_of
from quartering.motion.equations.model import Model
from quartering.motion.equations.system import PER_CONDITION, Floats, System
from quartering.motion.equations.terms import parse
from quartering.motion.of_ship import equations, ship_system
from quartering.option_checks import Refused, quoted
from quartering.options import OPTIONS
from quartering.study.dataset import attributes
from quartering.study.grid import CONDITION_AXES
from quartering.study.loadings import LOADING_AXES, loaded, user_value

Limits = tuple[float | str, float | str] | None
"""The two ends of a parameter, numbers or text with a unit; None for the usual ones."""
_NODES, _NODES_OF_LOADING = 65, 17
_LIKE = {"frequency": "wave_frequency"}
_UNITS = {"frequency": "rad/s", "excitation": "1"}


class Parameters(NamedTuple):
    """Parameters of a ship or a model: names, present values (n,), limits (n,), and the systems (k) at values (k, n)."""

    names: tuple[str, ...]
    own: Floats
    low: Floats
    high: Floats
    systems: Callable[[Floats], System]


def parameters(
    ship_or_model: Ship | Model,
    over: Sequence[str],
    limits: Sequence[Limits],
    wave: Wave | None,
    speed: float,
    heading: float,
) -> Parameters:
    """Parameters by name, their limits checked.

    over: as in `quartering.branch`
    limits: (low, high) of each, or None for 0.5 to 1.5 times the present value (0 to 2 for an excitation)
    of a ship [m/s, deg]
    """
    if isinstance(ship_or_model, Model):
        model, of_ship = ship_or_model, False
        own = {}
    else:
        if wave is None:
            raise InputError("a ship needs a wave here: wave=Wave(length=.., height=..), speed=.., heading=..")
        model, of_ship = equations(ship_or_model, wave, speed, heading), True
        own = {"speed": speed, "heading": heading, "wave_length": wave.length, "wave_height": wave.height}
        own |= {name: user_value(ship_or_model, name) for name in LOADING_AXES}
    own |= {"frequency": model.frequency, "excitation": 1.0}
    ends = []
    for name, pair in zip(over, limits, strict=True):
        if name not in own:
            _check_term(model, name, of_ship)
        centre = own.get(name, 1.0)
        pair = _in_unit(ship_or_model, name, pair)
        low, high = pair or ((0.0, 2.0) if name == "excitation" else _usual(name, centre))
        if not (np.isfinite(low) and np.isfinite(high) and 0 <= low < high) or (name == "frequency" and low == 0):
            raise InputError(
                f"limits ({low:g}, {high:g}) of {name} must be two rising numbers of zero or more, above zero for a frequency"
            )
        ends.append((low, high))
    low_ends, high_ends = np.array(ends, dtype=float).T
    if isinstance(ship_or_model, Model):
        systems = _of_model(ship_or_model, tuple(over))
    else:
        assert wave is not None
        systems = _of_ship(ship_or_model, tuple(over), own)
    return Parameters(tuple(over), np.array([own.get(name, 1.0) for name in over]), low_ends, high_ends, systems)


def _usual(name: str, centre: float) -> tuple[float, float]:
    """Half to one and a half times the present value, a heading no further than headings go."""
    return 0.5 * centre, min(1.5 * centre, 360.0) if name == "heading" else 1.5 * centre


def _in_unit(of: Ship | Model, name: str, pair: Limits) -> tuple[float, float] | None:
    """Limits in the unit of the parameter, each in the range of the option; those of a term are factors."""
    if pair is None:
        return None
    if isinstance(pair, str) or np.ndim(pair) != 1 or len(pair) != 2:
        raise InputError(f"limits = {quoted(pair)} of {name}; they are two, the lower and the upper, such as (1, 6)")
    ship, one = (of if isinstance(of, Ship) else None), _LIKE.get(name, name if name in OPTIONS else "excitation")
    try:
        low, high = (number(ship, one, end) for end in pair)
    except Refused as error:
        raise Refused(name, f"limits of {name}: {error.words}") from None
    return low, high


def family(
    ship_or_model: Ship | Model,
    over: str,
    limits: Limits,
    wave: Wave | None,
    speed: float,
    heading: float,
) -> tuple[float, float, Family]:
    """Limits of one parameter, and the system at each share of the way between them.

    as in `quartering.branch`
    Returns family: a ship's is a spline through its systems at 65 values (17 of a loading)
    """
    one = parameters(ship_or_model, [over], [limits], wave, speed, heading)
    return float(one.low[0]), float(one.high[0]), along(one, 0, one.own, splined=isinstance(ship_or_model, Ship))


def along(of: Parameters, which: int, others: Floats, *, splined: bool) -> Family:
    """Systems along one parameter, the others held.

    which: the one that changes
    others (n,): values of the others
    splined: through a spline, for systems that take long to compute
    """

    def values(share: Floats) -> Floats:
        rows = np.repeat(others[None], share.size, axis=0)
        rows[:, which] = of.low[which] + (of.high[which] - of.low[which]) * share
        return rows

    if not splined:
        return lambda t: of.systems(values(np.array([t])))
    share = np.linspace(0.0, 1.0, _NODES if of.names[which] in CONDITION_AXES else _NODES_OF_LOADING)
    systems = of.systems(values(share))
    if not systems.finite.all():
        raise InputError(
            f"between {of.names[which]} = {of.low[which]:g} and {of.high[which]:g} the ship keeps pace with the wave;"
            " take narrower limits"
        )
    arrays = [getattr(systems, name) for name in PER_CONDITION]
    spline = CubicSpline(share, np.column_stack([array.reshape(share.size, -1) for array in arrays]))
    ends = np.cumsum([array[0].size for array in arrays]).tolist()
    places = [(end - array[0].size, end, (1, *array.shape[1:])) for end, array in zip(ends, arrays, strict=True)]

    def at_share(t: float) -> System:
        row = spline(t)
        parts = [row[begin:end].reshape(shape) for begin, end, shape in places]
        return replace(systems, **dict[str, Any](zip(PER_CONDITION, parts, strict=True)))

    return at_share


def parameter_attributes(name: str) -> dict[str, object]:
    """Unit and meaning of a parameter or of a result along a branch or an edge, for a dataset.

    Returns units, long_name, symbol

    >>> parameter_attributes("excitation")["units"]
    '1'
    """
    if name in _UNITS:
        return {"units": _UNITS[name], "long_name": "parameter followed over", "symbol": name}
    return attributes(name)


def _scaled(s: System, values: Mapping[str, Floats]) -> System:
    """Systems at other frequencies, or with a share of their excitation, their coefficients held."""
    if "frequency" in values:
        s = replace(s, frequency=values["frequency"].copy())
    if "excitation" in values:
        s = s.raised(values["excitation"])
    return s


def _of_model(model: Model, names: tuple[str, ...]) -> Callable[[Floats], System]:
    terms = [name for name in names if name not in ("frequency", "excitation")]

    def systems(values: Floats) -> System:
        by_name = dict(zip(names, values.T, strict=True))
        if not terms:
            s = joined([model.system] * len(values))
        else:
            factors = [{name: float(by_name[name][i]) for name in terms} for i in range(len(values))]
            changed = [{name: f * model.terms[name] for name, f in row.items()} for row in factors]
            s = joined([replace(model, terms=dict(model.terms) | row).system for row in changed])
        return _scaled(s, by_name)

    return systems


def _of_ship(ship: Ship, names: tuple[str, ...], own: Mapping[str, float]) -> Callable[[Floats], System]:
    changes = [name for name in names if name not in (*CONDITION_AXES, "frequency", "excitation")]

    def systems(values: Floats) -> System:
        by_name = dict(zip(names, values.T, strict=True))
        u, mu, length, height = (
            np.array(np.broadcast_to(by_name.get(name, own[name]), len(values)), dtype=float) for name in CONDITION_AXES
        )

        def of(one: Ship, rows: slice | NDArray[np.intp]) -> System:
            at = ship_system(one, 2 * np.pi / length[rows], u[rows], mu[rows])
            s = at.at_amplitude(0.5 * height[rows, None])
            if at.encounter_frequency.min() < 0 < at.encounter_frequency.max():
                return replace(s, frequency=np.full(s.count, np.nan))  # between them the ship keeps pace with the wave
            return s

        if not changes:
            return _scaled(of(ship, slice(None)), by_name)
        loadings, which = np.unique(values[:, [names.index(name) for name in changes]], axis=0, return_inverse=True)
        groups = [np.flatnonzero(which.ravel() == i) for i in range(len(loadings))]
        parts = [
            of(loaded(ship, dict(zip(changes, row, strict=True))), group)
            for row, group in zip(loadings.tolist(), groups, strict=True)
        ]
        return _scaled(rows_of(joined(parts), np.argsort(np.concatenate(groups))), by_name)

    return systems


def _check_term(model: Model, over: str, of_ship: bool) -> None:
    """Refuse a parameter that is neither a condition nor a term the model has."""
    known = "'frequency', 'excitation'" + (
        ", " + ", ".join(map(repr, (*CONDITION_AXES, *LOADING_AXES))) if of_ship else ""
    )
    if "_" not in over:
        raise InputError(f"over={over!r}: a branch can be followed over {known}, or a term such as 'K_ppp'")
    parse(over)
    if model.terms.get(over, 0.0) == 0.0:
        raise InputError(f"over={over!r}: the model has no such term (or it is zero), so there is nothing to multiply")
