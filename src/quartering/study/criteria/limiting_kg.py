"""Limiting KG: up to which height of G a ship passes each level of each failure mode, over its draughts."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.propulsion import Propulsion
from quartering.hull.ship import Ship
from quartering.hull.told import number, numbers
from quartering.option_checks import quoted
from quartering.study.criteria import dead_ship, excessive_acceleration, parametric_rolling, pure_loss, surf_riding
from quartering.study.criteria.particulars import Particulars, particulars
from quartering.study.criteria.record import FORM, Judgement

_POINTS = 24
_LOWEST, _HIGHEST = 0.5, 0.998
"""Range of KG over KM that is looked through: GM down to 0.2 % of KM."""
_CLOSE = 1e-3
"""Limits are found to this height [m]."""


def _levels(propulsion: Propulsion | None) -> dict[str, Callable[[Particulars], Judgement]]:
    """Every level that depends on the height of G."""
    return {
        "parametric_rolling.level1": parametric_rolling.level1,
        "parametric_rolling.level2": lambda p: parametric_rolling.level2(p, second=False),
        "pure_loss.level1": pure_loss.level1, "pure_loss.level2": pure_loss.level2,
        "surf_riding.level1": surf_riding.level1, "surf_riding.level2": lambda p: surf_riding.level2(p, propulsion),
        "dead_ship.level1": dead_ship.level1, "dead_ship.level2": dead_ship.level2,
        "excessive_acceleration.level1": excessive_acceleration.level1,
        "excessive_acceleration.level2": excessive_acceleration.level2,
    }  # fmt: skip


BELOW: Final = 0
NOT_JUDGED: Final = 1
NEVER: Final = 2
ALWAYS: Final = 3
FOUND = {BELOW: "limit found", NOT_JUDGED: "not judged", NEVER: "vulnerable at every KG", ALWAYS: "passed at every KG"}


@takes(ship="Ship", propulsion="Propulsion, None")
def limiting_kg(
    ship: Ship,
    draughts: Sequence[float | str] | None = None,
    speed: float | str | None = None,
    propulsion: Propulsion | None = None,
    levels: Sequence[str] | None = None,
) -> xr.Dataset:
    """Heights of G between which a ship passes each level of each failure mode.

    Parameters
    ----------
    ship : Ship
    draughts : sequence of float    on even keel [m]; None: the ship's own
    speed : float                   service speed [m/s]; None: what needs it is not judged
    propulsion : Propulsion         for surf-riding at level 2; None: the ship's own, if it was told
    levels : sequence of str        such as "pure_loss.level1"; None: all ten

    Returns
    -------
    Dataset    over ``draught`` and ``criterion``: kg_min and kg_max [m] of the widest range of KG that passes, NaN at an end
               that lies beyond the range looked through; found (int8 flags); monotone (bool): is there one such range,
               from the lowest KG up

    Raises
    ------
    InputError    a draught out of its range or without freeboard, a level that is none

    Notes
    -----
    KG from half of KM to KM less 0.2 %, 24 values, then bisection to 1 mm. A mode that does not apply passes.
    Source: MSC.1/Circ.1627 (recalled) for the levels.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> limits = limiting_kg(ship("wigley"), levels=["pure_loss.level1"])
    >>> found = limits.isel(criterion=0, draught=0)
    >>> 0.9 < float(found.kg_max) / ship("wigley").loading.kg, bool(found.monotone)
    (True, True)
    """
    wanted = [ship.hull.draught] if draughts is None else np.atleast_1d(numbers(ship, "draught", draughts)).tolist()
    service = None if speed is None else number(ship, "speed", speed)
    judges = _levels(propulsion)
    if levels is not None and (not isinstance(levels, (list, tuple)) or not levels):
        raise InputError(f"levels = {quoted(levels)}; they are a list of names: {', '.join(judges)}")
    if wrong := [one for one in levels or () if not isinstance(one, str) or one not in judges]:
        raise InputError(f"levels: {quoted(wrong[0])} is none; allowed: {', '.join(judges)}")
    judges = judges if levels is None else {name: judges[name] for name in levels}
    shape = (len(wanted), len(judges))
    low, high, found, monotone = (
        np.full(shape, np.nan),
        np.full(shape, np.nan),
        np.zeros(shape, np.int8),
        np.ones(shape, bool),
    )
    for i, draught in enumerate(wanted):
        at = _Heights(ship.with_(draught=draught), service)
        for j, judge in enumerate(judges.values()):
            low[i, j], high[i, j], found[i, j], monotone[i, j] = _range_of(at, judge)
    dims = ("draught", "criterion")
    flags = {
        "flag_values": np.array(list(FOUND), np.int8),
        "flag_meanings": " ".join(w.replace(" ", "_") for w in FOUND.values()),
    }
    return xr.Dataset(
        {
            "kg_min": (dims, low, {"units": "m", "long_name": "least height of G over the keel that passes"}),
            "kg_max": (dims, high, {"units": "m", "long_name": "largest height of G over the keel that passes"}),
            "found": (dims, found, {"units": "1", "long_name": "what was found", **flags}),
            "monotone": (dims, monotone, {"units": "1", "long_name": "one range, from the lowest KG up"}),
        },
        coords={
            "draught": ("draught", np.array(wanted), {"units": "m", "long_name": "draught on even keel"}),
            "criterion": ("criterion", list(judges), {"units": "1", "long_name": "failure mode and level"}),
        },
        attrs={"ship": ship.name, "form": FORM, "speed": math.nan if service is None else service},
    )


class _Heights:
    """A ship at one draught with G at many heights; its waves are balanced once."""

    def __init__(self, ship: Ship, speed: float | None) -> None:
        km = hydrostatics(ship).km
        self.base, self.speed = ship.with_(kg=0.9 * km), speed
        self.kg = np.linspace(_LOWEST * km, _HIGHEST * km, _POINTS)
        self._made: dict[float, Particulars] = {}

    def at(self, kg: float) -> Particulars:
        """The ship with G at a height."""
        if kg not in self._made:
            self._made[kg] = particulars(self.base.with_(kg=kg), self.speed, None, self.base)
        return self._made[kg]


def _range_of(at: _Heights, judge: Callable[[Particulars], Judgement]) -> tuple[float, float, int, bool]:
    """Least and largest KG of the widest range that passes, what was found, and whether it is the only one from below."""
    verdicts = [_passes(judge(at.at(float(kg)))) for kg in at.kg]
    if None in verdicts:
        return math.nan, math.nan, NOT_JUDGED, True
    passed = np.array(verdicts, dtype=bool)
    if not passed.any():
        return math.nan, math.nan, NEVER, True
    if passed.all():
        return math.nan, math.nan, ALWAYS, True
    runs = list(_runs(passed))
    first, last = max(runs, key=lambda run: run[1] - run[0])
    low = math.nan if first == 0 else _edge(at, judge, float(at.kg[first - 1]), float(at.kg[first]))
    high = math.nan if last == passed.size - 1 else _edge(at, judge, float(at.kg[last + 1]), float(at.kg[last]))
    return low, high, BELOW, len(runs) == 1 and first == 0


def _passes(found: Judgement) -> bool | None:
    if not found.applies:
        return True
    return None if found.vulnerable is None else not found.vulnerable


def _runs(passed: NDArray[np.bool_]) -> Iterator[tuple[int, int]]:
    """First and last index of every run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], passed, [False]]).astype(int)))
    for start, end in edges.reshape(-1, 2):
        yield int(start), int(end) - 1


def _edge(at: _Heights, judge: Callable[[Particulars], Judgement], failing: float, passing: float) -> float:
    """KG nearest to the failing one that passes, to a millimetre [m]."""
    while abs(failing - passing) > _CLOSE:
        middle = 0.5 * (failing + passing)
        failing, passing = (failing, middle) if _passes(judge(at.at(middle))) else (middle, passing)
    return passing
