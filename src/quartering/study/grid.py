"""The conditions of a study: axes, loadings, and their division into blocks that are computed one by one."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import product
from typing import Any, ClassVar, NamedTuple, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering._machine.digest import fingerprint
from quartering.arguments import ARGUMENTS
from quartering.conventions import InputError
from quartering.hull.changes import COEFFICIENTS, check_twice
from quartering.hull.ship import Ship
from quartering.hull.told import real
from quartering.loads.forces import FORMS, Form
from quartering.loads.waves import Wave
from quartering.motion.steady.harmonic import checked_harmonics
from quartering.option_checks import Refused, checked, quoted
from quartering.options import OPTIONS
from quartering.study.case.values import values_of
from quartering.study.loadings import CHOICE_AXES, VALUE, base_of, coded, loaded
from quartering.units import wave_length_of

Floats = NDArray[np.float64]
CONDITION_AXES = ("speed", "heading", "wave_length", "wave_height")
SEA_AXES = ("hs", "tp", "tz")
"""Axes of irregular seas."""
STEEPNESS = "steepness"
"""Axis that may stand in the place of wave_height: H/lambda, the same for all wave lengths."""
MOST_CONDITIONS = 1_000_000_000
"""Largest study: some 300 GB of results."""
LARGEST_BLOCK, SMALLEST_BLOCK = 16_384, 512
_BLOCKS_WANTED = 64
_POINTS_WANTED = 512
_DRAUGHTS_TOGETHER = 4
_SHIPS_KEPT = 4096


class Block(NamedTuple):
    """One part of a grid: all wave heights, or steepnesses, at some loadings and some points (speed, heading, wave length)."""

    loadings: slice
    points: slice


@dataclass(frozen=True, eq=False)
class Grid:
    """Every condition of a study: a ship, its loadings, and the axes of the conditions.

    Parameters
    ----------
    ship : Ship
    axes : mapping of str to (n,) float        speed [m/s], heading [deg], wave_length, wave_height [m]; or steepness, H/lambda,
                                               in the place of wave_height
    loadings : mapping of str to (l,) float    values of loading l, by name; empty for the ship as it is
    harmonics : int                            of the steady motion
    form : str                                 of the diffraction force
    text : str                                 case file the grid was read from, for the record
    block_size : int                           conditions of one block; 0: by their number alone
    """

    ship: Ship
    axes: Mapping[str, Floats]
    loadings: Mapping[str, Floats] = field(default_factory=dict)
    harmonics: int = 1
    form: Form = "stf"
    text: str = ""
    block_size: int = 0
    _ships: dict[int, Ship] = field(default_factory=dict, init=False, repr=False)
    sampled: ClassVar[int] = 1024
    """Conditions at most that tell how long one takes."""

    def __post_init__(self) -> None:
        for mapping in ("axes", "loadings"):
            object.__setattr__(self, mapping, dict(getattr(self, mapping)))

    @property
    def loading_count(self) -> int:
        """Number of loadings, 1 for the ship as it is."""
        return next(iter(self.loadings.values())).size if self.loadings else 1

    @property
    def shape(self) -> tuple[int, ...]:
        """Sizes of a result over the whole grid: loadings where there are some, speed, heading, wave length, sea."""
        return ((self.loading_count,) if self.loadings else ()) + tuple(values.size for values in self.axes.values())

    @property
    def sea(self) -> str:
        """The last axis: wave_height, or steepness."""
        return tuple(self.axes)[-1]

    @property
    def sea_count(self) -> int:
        """Number of wave heights, or of steepnesses."""
        return int(self.axes[self.sea].size)

    @property
    def point_count(self) -> int:
        """Number of points (speed, heading, wave length)."""
        return int(np.prod([values.size for values in self.point_axes.values()]))

    @property
    def point_axes(self) -> dict[str, Floats]:
        """The three axes of the points: all but the last."""
        return {name: self.axes[name] for name in tuple(self.axes)[:-1]}

    @property
    def count(self) -> int:
        """Number of conditions."""
        return self.loading_count * self.point_count * self.sea_count

    @property
    def usual_block_size(self) -> int:
        """Conditions of one block, by their number alone: they bound the memory, and what a killed run has to do again."""
        return min(max(self.count // _BLOCKS_WANTED, SMALLEST_BLOCK), LARGEST_BLOCK)

    @cached_property
    def blocks(self) -> tuple[Block, ...]:
        """The parts the grid is computed in; the numbers do not depend on them."""
        heights, loadings, points = self.sea_count, self.loading_count, self.point_count
        size = self.block_size or self.usual_block_size
        together = min(max(size // (heights * min(points, _POINTS_WANTED)), 1), loadings)
        if "draught" in self.loadings:  # hulls of few draughts are kept at a time
            together = min(together, _DRAUGHTS_TOGETHER)
        rows = min(max(size // (heights * together), 1), points)
        return tuple(
            Block(slice(first, min(first + together, loadings)), slice(start, min(start + rows, points)))
            for first in range(0, loadings, together)
            for start in range(0, points, rows)
        )

    @cached_property
    def described(self) -> dict[str, Any]:
        """What decides the results, in types JSON knows: two grids with equal descriptions give equal numbers."""
        return {
            "ship": {"name": self.ship.name, "digest": fingerprint(self.ship)},
            **{name: values.tolist() for name, values in self.axes.items()},
            "loadings": {name: values.tolist() for name, values in self.loadings.items()},
            "harmonics": self.harmonics,
            "form": self.form,
        }

    def in_blocks_of(self, size: int) -> Grid:
        """The same grid in blocks of another size."""
        made = replace(self, block_size=size)
        made._ships.update(self._ships)
        return made

    def points(self, part: slice) -> tuple[Floats, Floats, Floats]:
        """Speed [m/s], heading [deg] and wave length [m], or the third axis there is, of some points."""
        axes = self.point_axes.values()
        where = np.unravel_index(np.arange(part.start, part.stop), [values.size for values in axes])
        u, mu, third = (values[i] for values, i in zip(axes, where, strict=True))
        return u, mu, third

    def heights(self, part: slice) -> Floats:
        """Wave heights (points, heights) at some points [m]."""
        length = self.points(part)[2][:, None]
        return length * self.axes[STEEPNESS] if self.sea == STEEPNESS else length * 0 + self.axes["wave_height"]

    def check_loadings(self) -> None:
        """Refuse a loading the ship cannot have, before anything is computed."""
        for i in range(self.loading_count if self.loadings else 0):
            self.loaded(i)

    def loaded(self, index: int) -> Ship:
        """The ship in one of its loadings."""
        if index not in self._ships:
            if len(self._ships) >= _SHIPS_KEPT:
                self._ships.clear()
            values = {name: float(column[index]) for name, column in self.loadings.items()}
            self._ships[index] = loaded(self.ship, values)
        return self._ships[index]


def grid(
    ship: Ship,
    speed: ArrayLike,
    heading: ArrayLike,
    wave_length: ArrayLike | None = None,
    wave_height: ArrayLike | None = None,
    *,
    harmonics: int = 1,
    form: Form = "stf",
    factors: Mapping[str, ArrayLike] | None = None,
    values: Mapping[str, ArrayLike] | None = None,
    **axes: Any,
) -> Grid:
    """All combinations of conditions and loadings, checked.

    speed, heading, wave_length, wave_height (n,): [m/s, deg, m, m], or text with a unit
    factors, values: factors on coefficients, and values of them, by name
    **axes (l,): loading values, or factors on coefficients, by name; wave_period [s] in place of wave_length and steepness,
        H/lambda, in place of wave_height; as in `sweep`
    """
    period, steepness = axes.pop("wave_period", None), axes.pop("steepness", None)
    conditions: dict[str, ArrayLike] = {"speed": speed, "heading": heading}
    conditions |= {"wave_length": _lengths(wave_length, period, ship)} | _sea(wave_height, steepness)
    own = {name: axis(name, given, ship) for name, given in conditions.items()}
    _check_conditions(own)
    checked_harmonics(harmonics)
    if form not in get_args(Form):
        raise InputError(f"form {form!r} given; allowed: {', '.join(FORMS)}; try 'stf'")
    ship, extra = loading_columns(ship, axes, factors, values)
    check_count({**own, **extra})
    made = Grid(ship, own, combinations(extra), harmonics, form)
    made.check_loadings()
    return made


def combinations(extra: Mapping[str, Floats]) -> dict[str, Floats]:
    """Columns (l,) of all combinations of values, by name."""
    count = int(np.prod([values.size for values in extra.values()]))
    combined = np.array(list(product(*extra.values())), dtype=float).reshape(count, len(extra))
    return {name: combined[:, i] for i, name in enumerate(extra)}


def _lengths(wave_length: ArrayLike | None, wave_period: ArrayLike | None, ship: Ship) -> ArrayLike:
    """Wave lengths, from periods where those are given."""
    if (wave_length is None) == (wave_period is None):
        both = (
            "are two ways to say one thing; leave one out"
            if wave_length is not None
            else "are missing; give one of the two"
        )
        raise InputError(f"wave_length and wave_period {both}")
    if wave_period is None:
        return wave_length if wave_length is not None else ()
    return [wave_length_of(period) for period in axis("wave_period", wave_period, ship).tolist()]


def loading_columns(
    ship: Ship,
    axes: Mapping[str, ArrayLike],
    factors: Mapping[str, ArrayLike] | None,
    values: Mapping[str, ArrayLike] | None,
) -> tuple[Ship, dict[str, Floats]]:
    """The ship that loadings begin from, and the checked values of each axis of them by name."""
    extra = {name: axis(name, given, ship) for name, given in _extra(axes, factors, values).items()}
    check_twice(extra, "")
    return base_of(ship, extra), extra


def _extra(
    axes: Mapping[str, ArrayLike], factors: Mapping[str, ArrayLike] | None, values: Mapping[str, ArrayLike] | None
) -> dict[str, ArrayLike]:
    """Every axis beside the conditions by one name: of the loading, factors on coefficients, values of them."""
    if "coefficients" in axes:
        raise Refused("coefficients", COEFFICIENTS)
    for what, told in (("factors", factors), ("values", values)):
        if told is not None and not isinstance(told, Mapping):
            raise InputError(
                f'{what} = {quoted(told)}; it is a mapping of names to values, such as {{"K_ppp": [1, 2]}}'
            )
    found = dict(axes)
    for name, given in (factors or {}).items():
        if name in found:
            raise InputError(f"{name} is given twice, by its name and in factors; leave one out")
        found[name] = given
    return found | {f"{name}{VALUE}": given for name, given in (values or {}).items()}


def axis(name: str, values: ArrayLike, ship: Ship | None = None) -> Floats:
    """Values of one axis as a checked, flat array.

    name: of an option, or for the message
    values (n,): numbers; with a ship also text with a unit, or a range "0..18 kn step 1"
    ship: whose L, B and T are meant
    Returns (n,)
    """
    given: Any = values
    one = ARGUMENTS[name] if name in SEA_AXES else OPTIONS.get(name)
    if name in CHOICE_AXES:
        given = [coded(name, value) for value in np.atleast_1d(np.asarray(values)).tolist()]
        ship = None
    if ship is not None and one is not None and _has_text(given):
        return np.array(values_of(one, given, ship))
    found = real(given)
    if found is None:
        raise InputError(f"{name} = {quoted(values)} is not a number or a list of numbers; try [0, 5, 10]")
    array = np.atleast_1d(found)
    if array.ndim != 1 or array.size == 0:
        raise InputError(f"{name} needs at least one value in a flat list; given shape {array.shape}")
    if not np.isfinite(array).all():
        raise InputError(f"{name} has a value that is not a finite number: {array[~np.isfinite(array)][0]}")
    if one is not None and one.numeric and ship is not None:
        for end in (array.min(), array.max()):
            checked(one, float(end), "", ship.sizes)
    return array


def _has_text(values: Any) -> bool:
    return isinstance(values, str) or (isinstance(values, (list, tuple)) and any(isinstance(v, str) for v in values))


def _sea(wave_height: ArrayLike | None, steepness: ArrayLike | None) -> dict[str, ArrayLike]:
    """The one of the two that is given."""
    if wave_height is not None and steepness is not None:
        raise InputError("wave_height and steepness are two ways to say one thing; leave one out")
    if steepness is not None:
        return {STEEPNESS: steepness}
    if wave_height is not None:
        return {"wave_height": wave_height}
    raise InputError(
        "wave_height or steepness is missing; give one of the two (steepness: height over length, alike for all lengths)"
    )


def check_count(axes: Mapping[str, Floats]) -> None:
    """Refuse a study nobody can have meant, before memory goes on it."""
    count = math.prod(values.size for values in axes.values())
    if count > MOST_CONDITIONS:
        sizes = ", ".join(f"{values.size:,} of {name}" for name, values in axes.items() if values.size > 1)
        raise InputError(
            f"{sizes} make {count:,} conditions; a study takes up to {MOST_CONDITIONS:,}: take fewer values on an axis"
        )


def _check_conditions(axes: Mapping[str, Floats]) -> None:
    """Refuse waves that cannot be, by building the extreme ones."""
    shortest = float(axes["wave_length"].min())
    heights = axes.get("wave_height", np.zeros(1))
    for height in (heights.max(), heights.min()):
        Wave(length=shortest, height=float(height))
