"""The leading exponent of one condition while one value of the ship or of the condition is changed, many values at once."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from quartering.conventions import InputError, RangeWarning
from quartering.hull.ship import Ship
from quartering.hydro.capsize import capsize_limit
from quartering.loads.forces import Form
from quartering.loads.waves import Wave
from quartering.motion.equations.batch import joined, rows
from quartering.motion.equations.system import Floats, System
from quartering.motion.of_ship import ShipSystem
from quartering.motion.status import Status
from quartering.motion.steady.motion import roll_peaks, steady_motions
from quartering.stability.assessment import assess, leading_growth
from quartering.stability.kind import Kind
from quartering.study.conditions import ACCURACY
from quartering.study.effects.nearest import REACH, Reached
from quartering.study.loading_systems import Found, systems
from quartering.study.loadings import loaded, user_value

EXACT = 1e-8
"""Error of the Floquet multipliers where a value is settled, a hundredth of `INSIDE`; a map's while it is looked for."""

_LARGE_ROLL = 15.0
_WIDE = 0.7
"""Of log factor: ships farther apart have another between them."""
_UNMOVED = ("speed", "wave_height", "roll_damping", "gyradius_roll", "gyradius_yaw")

# The equations of a ship whose coefficient is multiplied by f, or whose roll damping is f times its own, are affine in f:
# those of two ships give all others. Those of other loadings (GM, gyradii) are smooth in log f: between a few ships they are
# interpolated. What is found so is asked of the ship itself before it is proposed.


class Trials:
    """One ship in one condition, of which one value at a time is tried at factors on its own.

    Parameters
    ----------
    ship, wave, speed, heading    the condition; speed and heading as numbers [m/s, deg]
    harmonics : int               of the steady motion, as in `steady_motion`
    form : str                    of the diffraction force
    """

    def __init__(self, ship: Ship, wave: Wave, speed: float, heading: float, harmonics: int, form: Form) -> None:
        self.ship: Ship = ship
        self.wave: Wave = wave
        self.speed: float = speed
        self.heading: float = heading
        self.harmonics: int = harmonics
        self.form: Form = form
        # the work: ships whose equations were made, batches of conditions, and conditions
        self.ships_built: int = 0
        self.batches: int = 0
        self.judged: int = 0
        self._forces: Found = {}
        self._made: dict[str, dict[float, System]] = {}
        self._joined: dict[str, System] = {}
        self._limits: dict[str, Floats] = {}
        self._at = next(self._systems([ship]))
        self._own = self._high(self._at, 1.0)

    def as_it_is(self) -> tuple[float, Kind]:
        """Leading exponent [1/s] and verdict of the condition as it is; infinite without a motion."""
        u, orders, _, _ = steady_motions(self._own, self.harmonics, start="rest")
        judged = assess(self._own, u, orders, EXACT, detail="map")
        return float(np.nan_to_num(judged.floquet.growth[0], nan=np.inf)), Kind(int(judged.kind[0]))

    def ship_at(self, name: str, factor: float) -> Ship:
        """The ship with one of its values times a factor; itself where the value is one of the condition."""
        if name in ("speed", "wave_height"):
            return self.ship
        return loaded(self.ship, {name: user_value(self.ship, name) * factor})

    def reach(self, name: str) -> Reached:
        """Factors with which there are a ship and a wave: as far as is searched, or less by a hundredth."""
        return Reached(1.0 / self._reach(name, 1.0 / REACH), self._reach(name, REACH))

    def _reach(self, name: str, end: float) -> float:
        """How far, as a ratio, a factor may go towards an end: what exists, exists nearer too."""
        far = abs(math.log(end))
        if name == "speed" or name[0] in "YKN" or self._exists(name, end):
            return math.exp(far)
        most, too_many = 0.0, far
        while too_many - most > 0.01:
            middle = 0.5 * (most + too_many)
            exists = self._exists(name, math.exp(math.copysign(middle, math.log(end))))
            most, too_many = (middle, too_many) if exists else (most, middle)
        return math.exp(most)

    def _exists(self, name: str, factor: float) -> bool:
        try:
            if name == "wave_height":
                Wave(self.wave.length, self.wave.height * factor)
            self.ship_at(name, factor)
        except InputError:  # no damping above 1, no wave that breaks
            return False
        return True

    def span(self, name: str, low: float, high: float) -> Reached:
        """Make what `exponents` needs between two factors; the factors between which it could be made."""
        if name in ("speed", "wave_height"):
            return Reached(low, high)
        made = self._made.setdefault(name, {1.0: self._own})
        if _affine(name):
            if len(made) == 1:
                self._node(name, high if high > 1.0 else low)
            return Reached(low, high) if len(made) > 1 else Reached(1.0, 1.0)
        for end in (low, high):
            side = max([abs(math.log(f)) for f in made if (f - 1.0) * (end - 1.0) > 0], default=0.0)
            apart = abs(math.log(end)) - side
            if apart > _WIDE:  # the last gap is halved: nodes are denser towards the ends, as Chebyshev's are
                self._node(name, math.exp(math.copysign(side + 0.5 * apart, end - 1.0)))
        return Reached(self._node(name, low), self._node(name, high))

    def _node(self, name: str, end: float) -> float:
        """Make the equations of the ship at a factor, or as far on the way there as they can be made; the factor."""
        made = self._made[name]
        known = min(made, key=lambda factor: abs(math.log(factor / end)))
        for share in (1.0, 0.5, 0.25, 0.125):
            factor = known * (end / known) ** share
            if abs(math.log(factor / known)) < 1e-3:
                return known
            try:
                made[factor] = self._settled(name, factor)
            except InputError:  # the equations of a ship this far cannot be made
                continue
            return factor
        return known

    def exponents(self, asked: Mapping[str, Floats], settled: bool = False) -> dict[str, Floats]:
        """Leading exponents (n,) at factors (n,) on each of some parameters, all in one batch [1/s].

        Infinite where there is no motion to judge. Settled: with nothing interpolated, as accurate as a verdict; else between
        the factors of `span`.
        """
        if not asked:
            return {}
        with _no_range_warnings():
            each = [self._equations(name, factors, settled) for name, factors in asked.items()]
            growth = self._leading(joined(each), asked, EXACT if settled else ACCURACY)
        return dict(zip(asked, np.split(growth, _ends(asked)), strict=True))

    def _equations(self, name: str, factors: Floats, settled: bool) -> System:
        """Equations of the ship at factors on one parameter."""
        if name == "wave_height":
            return self._high(self._at, factors)
        if name == "speed":
            return self._at_speeds(self.speed * factors)
        if not settled:
            return self._between(name, factors)
        return joined([self._settled_or_none(name, float(factor)) for factor in factors])

    def _settled_or_none(self, name: str, factor: float) -> System:
        try:
            return self._settled(name, factor)
        except InputError:  # a ship that cannot be, beyond one that can
            return self._own.each(lambda array: np.full_like(array, np.nan))

    def _settled(self, name: str, factor: float) -> System:
        with _no_range_warnings():
            return self._high(next(self._systems([self.ship_at(name, factor)])), 1.0)

    def _systems(self, ships: Sequence[Ship]) -> Iterator[ShipSystem]:
        """Equations of ships in the condition."""
        self.ships_built += len(ships)
        k, speed, heading = (np.array([value]) for value in (self.wave.wavenumber, self.speed, self.heading))
        return systems(ships, k, speed, heading, self.form, known=self._forces)

    def _at_speeds(self, speeds: Floats) -> System:
        self.ships_built += 1
        k, heading = (np.full(speeds.size, value) for value in (self.wave.wavenumber, self.heading))
        return self._high(next(systems([self.ship], k, speeds, heading, self.form)), 1.0)

    def _high(self, at: ShipSystem, factors: Floats | float) -> System:
        """Equations in the wave, its height times factors; NaN where there are none."""
        heights = np.broadcast_to(self.wave.amplitude * np.atleast_1d(factors), (at.system.count, np.size(factors)))
        system = at.at_amplitude(heights)
        none = np.repeat(at.slow | at.outside, np.size(factors))
        return (
            system.each(lambda array: np.where(none.reshape(-1, *[1] * (array.ndim - 1)), np.nan, array))
            if none.any()
            else system
        )

    def _between(self, name: str, factors: Floats) -> System:
        """Equations between the ships of `span`."""
        nodes = np.array(list(self._made[name]))
        if self._joined.get(name, self._own).count != nodes.size:
            self._joined[name] = joined(list(self._made[name].values()))
        if _affine(name):
            share = (factors - nodes[0]) / (nodes[1] - nodes[0])
            weights = np.stack([1.0 - share, share], axis=1)
        else:
            x, at = np.log(nodes), np.log(factors)
            # Lagrange's polynomials by their product form: no division by a distance that may be 0
            apart = x[:, None] - x + np.eye(x.size)
            terms = (at[:, None, None] - x) / apart
            terms[:, np.arange(x.size), np.arange(x.size)] = 1.0
            weights = terms.prod(axis=2)
        return self._joined[name].each(lambda array: np.ascontiguousarray(np.tensordot(weights, array, axes=1)))

    def _limits_at(self, name: str, factors: Floats) -> Floats:
        """Roll angles that count as a capsize [deg]: of the ship itself, but where the righting arm changes."""
        if name in _UNMOVED or (name[0] in "YKN" and "phi" not in name):
            return np.full(factors.size, capsize_limit(self.ship).angle)
        nodes = np.sort(list(self._made[name]))
        if self._limits.get(name, nodes[:0]).size != nodes.size:
            self._limits[name] = np.array([capsize_limit(self.ship_at(name, float(f))).angle for f in nodes])
        return np.interp(np.log(factors), np.log(nodes), self._limits[name])

    def _leading(self, system: System, asked: Mapping[str, Floats], accuracy: float) -> Floats:
        """Leading exponents of motions from rest; infinite without one, and where it rolls past the capsize limit."""
        self.batches, self.judged = self.batches + 1, self.judged + system.count
        u, orders, status, _ = steady_motions(system, self.harmonics, start="rest")
        roll = np.degrees(roll_peaks(u, orders))
        within = np.concatenate(
            [
                own <= (self._limits_at(name, factors) if (own > _LARGE_ROLL).any() else np.inf)
                for (name, factors), own in zip(asked.items(), np.split(roll, _ends(asked)), strict=True)
            ]
        )
        kept = np.flatnonzero((status <= Status.CONVERGED_BY_FOLLOWING) & within)
        growth = np.full(system.count, np.inf)
        if kept.size:
            with np.errstate(
                over="ignore"
            ):  # multipliers of ships far from the one asked about may be beyond all numbers
                found = leading_growth(rows(system, kept), u[kept], orders, accuracy)
            growth[kept] = np.where(np.isfinite(found), found, np.inf)
        return growth


def _ends(asked: Mapping[str, Floats]) -> list[int]:
    """Where in a batch the conditions of one parameter end and the next one's begin."""
    return [int(end) for end in np.cumsum([factors.size for factors in asked.values()])[:-1]]


def _affine(name: str) -> bool:
    return name[0] in "YKN" or name == "roll_damping"


def _no_range_warnings() -> warnings.catch_warnings[None]:
    """Range warnings left out: trials look at ships far from the one asked about."""
    return warnings.catch_warnings(action="ignore", category=RangeWarning)
