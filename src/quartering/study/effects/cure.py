"""Cures: the smallest change of each design or operating value that restores stability."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import InputError, in_unit, written
from quartering.doors import takes
from quartering.hull.ship import Ship
from quartering.hull.told import condition, number
from quartering.loads.forces import Form
from quartering.loads.strip_forces import checked_form
from quartering.loads.waves import Wave
from quartering.motion.equations.system import Floats
from quartering.names import term
from quartering.options import quoted, unknown
from quartering.stability.kind import Kind
from quartering.study.effects.trials import Trials
from quartering.study.loadings import LOADING_AXES, own_value

CURES = ("roll_damping", "gm", "gyradius_roll", "speed", "wave_height", "K_ppp", "K_prr")
"""Values tried when none are named: loading, condition, and the coefficients the paper finds decisive (as multipliers)."""

_REACH, _STEPS = 5.0, 33
_INSIDE = 1e-6
"""How far below minus the margin the exponent is at a cure [1/s]: beyond what a verdict's error may turn."""

_SECTIONS, _ROUNDS = 63, 3
"""Of a bracket, and how often: a row of 64 conditions takes as long as one of 16."""
_SMOOTH, _SECANTS, _FARTHEST = 0.02, 4, 0.05
"""Change of the exponent between two neighbours that is no jump [1/s]; steps of the secant, and the longest (of log factor)."""
_NUDGES = (1e-4, 1e-3, 1e-2)


@dataclass(frozen=True)
class Cure:
    """The smallest change of one value that makes the motion stable.

    Parameters
    ----------
    parameter : str    loading value, condition, or coefficient
    now : float        its value; 1 for a coefficient, which is multiplied
    needed : float     the value at which the leading exponent is 1e-6 1/s below minus the margin
    unit : str
    """

    parameter: str
    now: float
    needed: float
    unit: str

    @property
    def change(self) -> float:
        """Relative change needed."""
        return self.needed / self.now - 1.0

    @property
    def rounded(self) -> float:
        """The value needed as the sentence gives it: three digits, a coefficient's factor to a hundredth, never short of it."""
        digits = 2 if self._factor else 2 - math.floor(math.log10(abs(self.needed)))
        away = math.ceil if self.needed > self.now else math.floor
        return round(away(self.needed * 10.0**digits) * 10.0**-digits, digits)

    @property
    def _factor(self) -> bool:
        return "_" in self.parameter and self.parameter[0] in "YKN"

    @property
    def sentence(self) -> str:
        """The change in words."""
        more, told = "more" if self.change > 0 else "less", self.rounded
        if self._factor:
            if told <= 0:
                return f"{self.parameter} times {told:.2f}"
            return f"{abs(told - self.now):.0%} {more} {self.parameter}"
        unit, name = in_unit(self.unit), written(self.parameter)
        return f"{abs(told - self.now):.3g}{unit} {more} {name} ({self.now:.3g} -> {told:.3g}{unit})"


@takes(ship="Ship", wave="Wave")
def cures(
    ship: Ship,
    wave: Wave,
    speed: float | str,
    heading: float | str,
    *,
    parameters: Sequence[str] = CURES,
    margin: float = 0.0,
    harmonics: int = 1,
    form: Form = "stf",
) -> list[Cure]:
    """Smallest change of each parameter that makes the motion stable with a margin, the smallest relative change first.

    Parameters
    ----------
    ship : Ship
    wave : Wave
    speed : float              [m/s]
    heading : float            [deg]
    parameters : sequence      "gm", "gyradius_roll", "gyradius_yaw", "roll_damping", "speed", "wave_height", or coefficients
    margin : float             the leading exponent must be below minus this, >= 0 [1/s]
    harmonics : int            of the steady motion, as in `steady_motion`: those of the verdict that is to change
    form : str                 of the diffraction force

    Returns
    -------
    list of Cure               empty when the motion is stable with that margin already, when no change up to fivefold helps,
                               and when the ship is unstable on course without any wave: no matter of this condition

    Raises
    ------
    InputError                 a margin below zero, an unknown parameter or form, harmonics as `steady_motion`

    Notes
    -----
    Each parameter alone, over a fifth to five times its value, in steps of 5 %, then between two of them to 1e-6; coefficients
    that are zero cannot be multiplied.  At every cure the motion of the ship itself is stable with the margin.
    Source: [H71] Figs. 20-22 (what restores stability).

    Examples
    --------
    >>> from quartering.study.paper.model import paper_ship
    >>> restless = paper_ship().with_(factors={"K_prr": -60})
    >>> found = cures(restless, Wave(121.92, 4.0), 8.6, 30.0, parameters=["K_prr", "roll_damping"])
    >>> [one.parameter for one in found]
    ['K_prr', 'roll_damping']
    """
    return list(seek(ship, wave, speed, heading, parameters=parameters, margin=margin, harmonics=harmonics, form=form))[
        -1
    ]


def seek(
    ship: Ship,
    wave: Wave,
    speed: float | str,
    heading: float | str,
    *,
    parameters: Sequence[str] = CURES,
    margin: float = 0.0,
    harmonics: int = 1,
    form: Form = "stf",
) -> Iterator[list[Cure]]:
    """The search of `cures` in small steps, for whoever has others to serve meanwhile.

    Parameters
    ----------
    ship, wave, speed, heading, parameters, margin, harmonics, form    as in `cures`

    Yields
    ------
    list of Cure    found so far, after each step of the search

    Raises
    ------
    InputError      as `cures`

    Notes
    -----
    Source: [H71] Figs. 20-22 (what restores stability).

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> list(seek(ship("wigley"), Wave(100.0, 0.5), 3.0, 90.0))
    [[]]
    """
    speed, heading = condition(ship, speed, heading)
    margin, form, parameters = number(ship, "margin", margin), checked_form(form), _names(parameters)

    trials, found = Trials(ship, wave, float(speed), float(heading), harmonics, form), list[Cure]()
    yield found
    exponent, kind = trials.as_it_is()
    done = exponent < -margin or kind == Kind.COURSE_IN_CALM_WATER
    for name in () if done else parameters:
        now, unit = _present(ship, wave, float(speed), name)
        if now == 0.0:  # nothing to multiply: roll damping by a component method is no fraction of critical
            continue
        needed = None
        for needed in _nearest(trials, name, margin):  # noqa: B007
            yield found
        if needed is not None:
            found = sorted([*found, Cure(name, now, now * needed, unit)], key=_size)
            yield found


def _names(parameters: Sequence[str]) -> tuple[str, ...]:
    """Parameters to try, refused when they are no list, or one is none that can be changed by a factor."""
    if isinstance(parameters, str) or not isinstance(parameters, (Sequence, np.ndarray)):
        raise InputError(f"parameters = {quoted(parameters)}; they are a list of names; try {list(CURES[:2])}")
    known = ("speed", "wave_height", *LOADING_AXES)
    for name in parameters:
        try:
            if name not in known:
                term(str(name))
        except InputError:
            message = unknown(str(name), (*known, *CURES)).words
            raise InputError(
                f"parameters: {message}; a coefficient by its name, such as K_ppp, may stand too"
            ) from None
    return tuple(map(str, parameters))


def _size(cure: Cure) -> float:
    return float(abs(np.log(abs(cure.needed / cure.now))))


def _present(ship: Ship, wave: Wave, speed: float, name: str) -> tuple[float, str]:
    """Present value of a parameter, and its unit."""
    if name == "speed":
        return speed, "m/s"
    if name == "wave_height":
        return wave.height, "m"
    return own_value(ship, name), "m" if name in LOADING_AXES and name != "roll_damping" else "1"


def _nearest(trials: Trials, name: str, margin: float) -> Iterator[float | None]:
    """Factor nearest to 1 (in ratio) with which the motion is stable: the last of what comes; None where there is none."""
    ladder = np.geomspace(1.0, _REACH, _STEPS)
    up, down = (side[: trials.reach(name, side)] for side in (ladder, 1.0 / ladder))
    low, high = trials.span(name, float(down[-1]), float(up[-1]))
    yield None
    factors = np.concatenate([down[(down >= low) & (down < 1.0)][::-1], up[(up <= high) & (up > 1.0)]])
    if not factors.size:
        return
    stable = trials.exponents(name, factors) < -margin - _INSIDE
    yield None
    for near, far in _brackets(factors, stable):
        crossing = _crossing(trials, name, margin, near, far)
        yield None
        if crossing is not None:
            yield crossing
            return
    yield None


def _brackets(factors: Floats, stable: NDArray[np.bool_]) -> list[tuple[float, float]]:
    """The last factor on either side of 1 that leaves the motion unstable and the first that does not, the nearer first."""
    found = []
    for side in (np.flatnonzero(factors < 1.0)[::-1], np.flatnonzero(factors > 1.0)):
        first = np.flatnonzero(stable[side])
        if first.size:
            before = 1.0 if first[0] == 0 else float(factors[side[first[0] - 1]])
            found.append((before, float(factors[side[first[0]]])))
    return sorted(found, key=lambda pair: abs(math.log(pair[1])))


def _crossing(trials: Trials, name: str, margin: float, unstable: float, stable: float) -> float | None:
    """Factor between two at which the exponent is just below minus the margin, by the ship itself; None where it is nowhere.

    One row of factors between the two, then the secant; at a jump of the exponent, where a motion appears or vanishes, a row
    between two of them again.
    """
    target, slope = -margin - _INSIDE, math.nan
    factor = stable
    for _ in range(_ROUNDS):
        factors = np.geomspace(unstable, stable, _SECTIONS + 1)
        growth = trials.exponents(name, factors)
        inside = growth < -margin - _INSIDE
        if not inside.any():
            return None
        first = max(1, int(inside.argmax()))
        unstable, stable = float(factors[first - 1]), float(factors[first])
        rise, apart = growth[first] - growth[first - 1], math.log(stable / unstable)
        factor, slope = stable, rise / apart
        if math.isfinite(rise) and abs(rise) < _SMOOTH:
            factor = stable * math.exp(min(1.0, max((target - growth[first]) / rise, -1.0)) * apart)
            break
    return _by_the_ship(trials, name, margin, factor, slope, math.copysign(1.0, stable - unstable))


def _by_the_ship(trials: Trials, name: str, margin: float, factor: float, slope: float, away: float) -> float | None:
    """A factor near an interpolated one at which the ship itself is stable with the margin: by the secant, or beyond it."""
    target, good = -margin - _INSIDE, None
    for _ in range(_SECANTS):
        growth = float(trials.settled(name, np.array([factor]))[0])
        if growth < -margin - 0.5 * _INSIDE:
            good = factor
            if growth > -margin - 2.0 * _INSIDE:
                return good
        if not math.isfinite(growth) or not slope or abs(step := (target - growth) / slope) > _FARTHEST:
            break
        factor *= math.exp(step)
    if good is not None:
        return good
    for nudge in _NUDGES:  # the equations were interpolated, or the exponent jumps here
        beyond = factor * (1.0 + nudge * away)
        if trials.settled(name, np.array([beyond]))[0] < -margin - 0.5 * _INSIDE:
            return beyond
    return None
