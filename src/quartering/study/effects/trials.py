"""The leading exponent of one condition while one value of the ship or of the condition is changed, many values at once."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import InputError, RangeWarning
from quartering.hull.ship import Ship
from quartering.hydro.capsize import capsize_limit
from quartering.loads.forces import Form
from quartering.loads.waves import Wave
from quartering.motion.equations.batch import joined, rows
from quartering.motion.equations.system import Floats, System
from quartering.motion.of_ship import ShipSystem
from quartering.motion.steady.motion import roll_peaks, steady_motions
from quartering.stability.assessment import assess
from quartering.stability.kind import Kind
from quartering.study.conditions import ACCURACY
from quartering.study.loadings import loaded, own_value
from quartering.study.shared import systems

EXACT = 1e-9
"""Error of the Floquet multipliers where a value is settled, as in a verdict; a map's, `ACCURACY`, while it is looked for."""

_NODES = 6
_LARGE_ROLL = 15.0
_UNMOVED = ("speed", "wave_height", "roll_damping", "gyradius_roll", "gyradius_yaw")

# The equations of a ship whose coefficient is multiplied by f, or whose roll damping is f times its own, are affine in f:
# those of two ships give all others. Those of other loadings (GM, gyradii) are smooth in log f: between six ships at
# Chebyshev's points they are interpolated. What is found so is asked of the ship itself before it is proposed.


class Trials:
    """One ship in one condition, of which one value at a time is tried at factors on its own.

    Parameters
    ----------
    ship, wave, speed, heading    the condition; speed and heading as numbers [m/s, deg]
    harmonics : int               of the steady motion, as in `steady_motion`
    form : str                    of the diffraction force
    """

    def __init__(self, ship: Ship, wave: Wave, speed: float, heading: float, harmonics: int, form: Form) -> None:
        self.ship, self.wave, self.speed, self.heading = ship, wave, speed, heading
        self.harmonics, self.form = harmonics, form
        self.ships_built = 0
        """Ships whose equations were made: the work, most of it."""
        self._made: dict[str, tuple[Floats, System]] = {}
        self._limits: dict[str, Floats] = {}
        self._own = self._system([ship])

    def as_it_is(self) -> tuple[float, Kind]:
        """Leading exponent [1/s] and verdict of the condition as it is; infinite without a motion."""
        u, orders, _, _ = steady_motions(self._own, self.harmonics, start="rest")
        judged = assess(self._own, u, orders, EXACT, detail="map")
        return float(np.nan_to_num(judged.floquet.growth[0], nan=np.inf)), Kind(int(judged.kind[0]))

    def ship_at(self, name: str, factor: float) -> Ship:
        """The ship with one of its values times a factor; itself where the value is one of the condition."""
        if name in ("speed", "wave_height"):
            return self.ship
        return loaded(self.ship, {name: own_value(self.ship, name) * factor})

    def reach(self, name: str, factors: Floats) -> int:
        """How many of some factors, from the first, lead to a ship and a wave that exist."""
        if name == "speed" or name[0] in "YKN":
            return len(factors)
        most, too_many = 0, len(factors) + 1
        while too_many - most > 1:  # what exists, exists nearer too
            middle = (most + too_many) // 2
            most, too_many = (middle, too_many) if self._exists(name, float(factors[middle - 1])) else (most, middle)
        return most

    def _exists(self, name: str, factor: float) -> bool:
        try:
            if name == "wave_height":
                Wave(self.wave.length, self.wave.height * factor)
            self.ship_at(name, factor)
        except InputError:  # no damping above 1, no wave that breaks
            return False
        return True

    def exponents(self, name: str, factors: Floats, accuracy: float = ACCURACY) -> Floats:
        """Leading exponents (n,) at factors (n,) between those of `span` [1/s]; infinite where there is no motion to judge."""
        with _no_range_warnings():
            if name == "wave_height":
                each = rows(self._own, np.zeros(factors.size, dtype=np.intp)).raised(factors)
            elif name == "speed":
                each = self._at_speeds(self.speed * factors)
            else:
                each = self._between(name, factors)
            return self._leading(each, lambda i: self._limit(name, float(factors[i])), accuracy)

    def settled(self, name: str, factors: Floats) -> Floats:
        """The same with nothing interpolated, as accurate as a verdict."""
        if name in ("speed", "wave_height"):
            return self.exponents(name, factors, EXACT)
        with _no_range_warnings():
            ships = [self.ship_at(name, float(f)) for f in factors]
            return self._leading(self._system(ships), lambda i: capsize_limit(ships[i]).angle, EXACT)

    def span(self, name: str, low: float, high: float) -> tuple[float, float]:
        """Make what `exponents` needs between two factors; the factors between which it could be made."""
        if name in ("speed", "wave_height"):
            return low, high
        affine = name[0] in "YKN" or name == "roll_damping"
        ends = np.log([low, high])
        for _ in range(4):
            middle, half = ends.mean(), np.ptp(ends) / 2
            nodes = np.array([1.0, np.exp(ends[1])]) if affine else np.exp(middle + half * _chebyshev())
            try:
                with _no_range_warnings():
                    self._made[name] = nodes, self._system([self.ship_at(name, float(f)) for f in nodes])
            except InputError:  # the equations of a ship this far cannot be made
                ends = 0.5 * ends
            else:
                return float(np.exp(ends[0])), float(np.exp(ends[1]))
        return 1.0, 1.0

    def _system(self, ships: Sequence[Ship]) -> System:
        """Equations of ships in the condition, one after another."""
        self.ships_built += len(ships)
        k, speed, heading = (np.array([value]) for value in (self.wave.wavenumber, self.speed, self.heading))
        return joined([self._high(at) for at in systems(ships, k, speed, heading, self.form)])

    def _at_speeds(self, speeds: Floats) -> System:
        self.ships_built += 1
        k, heading = (np.full(speeds.size, value) for value in (self.wave.wavenumber, self.heading))
        return self._high(next(systems([self.ship], k, speeds, heading, self.form)))

    def _high(self, at: ShipSystem) -> System:
        system = at.at_amplitude(np.full((at.system.count, 1), self.wave.amplitude))
        none = at.slow | at.outside
        return (
            system.each(lambda array: np.where(none.reshape(-1, *[1] * (array.ndim - 1)), np.nan, array))
            if none.any()
            else system
        )

    def _between(self, name: str, factors: Floats) -> System:
        """Equations between the ships of `span`."""
        nodes, made = self._made[name]
        if nodes.size == 2:
            share = (factors - nodes[0]) / (nodes[1] - nodes[0])
            weights = np.stack([1.0 - share, share], axis=1)
        else:
            x, at = np.log(nodes), np.log(factors)
            # Lagrange's polynomials by their product form: no division by a distance that may be 0
            apart = x[:, None] - x + np.eye(x.size)
            terms = (at[:, None, None] - x) / apart
            terms[:, np.arange(x.size), np.arange(x.size)] = 1.0
            weights = terms.prod(axis=2)
        return made.each(lambda array: np.ascontiguousarray(np.tensordot(weights, array, axes=1)))

    def _limit(self, name: str, factor: float) -> float:
        """Roll angle that counts as a capsize [deg]: of the ship itself, but where the righting arm changes."""
        if name in _UNMOVED or (name[0] in "YKN" and "phi" not in name):
            if "" not in self._limits:
                self._limits[""] = np.array([capsize_limit(self.ship).angle])
            return float(self._limits[""][0])
        nodes = self._made[name][0]
        if name not in self._limits:
            self._limits[name] = np.array([capsize_limit(self.ship_at(name, float(f))).angle for f in np.sort(nodes)])
        return float(np.interp(math.log(factor), np.log(np.sort(nodes)), self._limits[name]))

    def _leading(self, system: System, limit: Callable[[int], float], accuracy: float) -> Floats:
        u, orders, status, _ = steady_motions(system, self.harmonics, start="rest")
        with np.errstate(over="ignore"):  # multipliers of ships far from the one asked about may be beyond all numbers
            growth = assess(system, u, orders, accuracy, detail="map").floquet.growth
        none = (status > 1) | ~np.isfinite(growth)
        roll = np.degrees(roll_peaks(u, orders))
        for i in np.flatnonzero(~none & (growth < 0) & (roll > _LARGE_ROLL)):
            none[i] = roll[i] > limit(int(i))
        return np.where(none, np.inf, growth)


def _chebyshev() -> NDArray[np.float64]:
    return np.cos((np.arange(_NODES) + 0.5) * np.pi / _NODES)


def _no_range_warnings() -> warnings.catch_warnings[None]:
    """Range warnings left out: trials look at ships far from the one asked about."""
    return warnings.catch_warnings(action="ignore", category=RangeWarning)
