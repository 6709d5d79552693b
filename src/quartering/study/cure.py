"""What change makes an unstable motion stable: the smallest change of each value a designer or a master can set."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from quartering.conventions import InputError, RangeWarning, in_unit, written
from quartering.doors import takes
from quartering.hull.ship import Ship
from quartering.hull.told import condition
from quartering.loads.waves import Wave
from quartering.study.conditions import evaluate
from quartering.study.loadings import LOADING_AXES, loaded, own_value

CURES = ("roll_damping", "gm", "gyradius_roll", "speed", "wave_height", "K_ppp", "K_prr")
"""Values tried when none are named: loading, condition, and the coefficients the paper finds decisive (as multipliers)."""

_REACH, _STEPS = 5.0, 33


@dataclass(frozen=True)
class Cure:
    """The smallest change of one value that makes the motion stable.

    Parameters
    ----------
    parameter : str    loading value, condition, or coefficient
    now : float        its value; 1 for a coefficient, which is multiplied
    needed : float     the value at which the leading exponent is minus the margin
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
    def sentence(self) -> str:
        """The change in words."""
        more = "more" if self.change > 0 else "less"
        if "_" in self.parameter and self.parameter[0] in "YKN":
            if self.needed < 0:
                return f"{self.parameter} times {self.needed:.2f}"
            return f"{abs(self.change):.0%} {more} {self.parameter}"
        unit, name = in_unit(self.unit), written(self.parameter)
        return f"{abs(self.needed - self.now):.3g}{unit} {more} {name} ({self.now:.3g} -> {self.needed:.3g}{unit})"


@takes(ship="Ship", wave="Wave")
def cures(
    ship: Ship,
    wave: Wave,
    speed: float | str,
    heading: float | str,
    *,
    parameters: Sequence[str] = CURES,
    margin: float = 0.0,
    harmonics: int = 3,
) -> list[Cure]:
    """Smallest change of each parameter that makes the motion stable with a margin, the smallest relative change first.

    Parameters
    ----------
    ship : Ship
    wave : Wave
    speed : float              [m/s]
    heading : float            [deg]
    parameters : sequence      "gm", "gyradius_roll", "gyradius_yaw", "roll_damping", "speed", "wave_height", or coefficients
    margin : float             the leading exponent must be below minus this [1/s]
    harmonics : int            of the steady motion

    Returns
    -------
    list of Cure               empty when the motion is stable with that margin already, or no change up to fivefold helps

    Raises
    ------
    InputError                 a margin below zero, an unknown parameter

    Notes
    -----
    Each parameter alone, over a fifth to five times its value, in steps of 5 %, then refined to 1e-6; coefficients that are
    zero cannot be multiplied.  Source: [H71] Figs. 20-22 (what restores stability).

    Examples
    --------
    >>> from quartering.study.paper.model import paper_ship
    >>> restless = paper_ship().with_(factors={"K_prr": -60})
    >>> found = cures(restless, Wave(121.92, 4.0), 8.6, 30.0, parameters=["K_prr", "roll_damping"])
    >>> [one.parameter for one in found]
    ['K_prr', 'roll_damping']
    """
    return list(seek(ship, wave, speed, heading, parameters=parameters, margin=margin, harmonics=harmonics))[-1]


def seek(
    ship: Ship,
    wave: Wave,
    speed: float | str,
    heading: float | str,
    *,
    parameters: Sequence[str] = CURES,
    margin: float = 0.0,
    harmonics: int = 3,
) -> Iterator[list[Cure]]:
    """The search of `cures` in small steps, for whoever has others to serve meanwhile.

    Parameters
    ----------
    ship, wave, speed, heading, parameters, margin, harmonics    as in `cures`

    Yields
    ------
    list of Cure    found so far, after each ship that was tried

    Raises
    ------
    InputError      as `cures`

    Notes
    -----
    Source: [H71] Figs. 20-22 (what restores stability).

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> list(seek(ship("wigley"), Wave(100.0, 0.5), 3.0, 90.0))
    [[]]
    """
    speed, heading = condition(ship, speed, heading)
    if not margin >= 0:
        raise InputError(f"margin = {margin} 1/s; give zero or a rate by which disturbances must die out")

    def exponent(one: Ship, at_speed: float, height: float) -> float:
        with warnings.catch_warnings():  # the search looks at ships far from the one asked about
            warnings.simplefilter("ignore", RangeWarning)
            found = evaluate(
                one,
                np.array([at_speed]),
                np.array([heading]),
                np.array([wave.length]),
                np.array([[height]]),
                harmonics=harmonics,
            )
        return float(np.nan_to_num(float(found["exponent"][0, 0]), nan=np.inf))

    found: list[Cure] = []
    stable = exponent(ship, speed, wave.height) < -margin
    yield found
    for name in () if stable else parameters:
        now, unit, at = _handle(ship, wave, speed, name, exponent)
        if now == 0.0:  # nothing to multiply: roll damping by a component method is no fraction of critical
            continue
        needed = None
        for needed in _nearest(lambda factor, at=at, now=now: at(now * factor) + margin):  # type: ignore[misc]  # noqa: B007
            yield found
        if needed is not None:
            found = sorted([*found, Cure(name, now, now * needed, unit)], key=_size)
            yield found


def _size(cure: Cure) -> float:
    return float(abs(np.log(abs(cure.needed / cure.now))))


def _handle(
    ship: Ship, wave: Wave, speed: float, name: str, exponent: Callable[[Ship, float, float], float]
) -> tuple[float, str, Callable[[float], float]]:
    """Present value, unit, and the leading exponent as a function of one parameter."""
    if name == "speed":
        return speed, "m/s", lambda value: exponent(ship, value, wave.height)
    if name == "wave_height":
        return wave.height, "m", lambda value: exponent(ship, speed, value)
    now = own_value(ship, name)
    unit = "m" if name in LOADING_AXES and name != "roll_damping" else "1"
    return now, unit, lambda value: exponent(loaded(ship, {name: value}), speed, wave.height)


def _nearest(excess: Callable[[float], float]) -> Iterator[float | None]:
    """Factor nearest to 1 (in ratio) at which `excess` passes from above to below zero: the last of what comes."""
    factors = np.geomspace(1.0, _REACH, _STEPS)
    crossings: list[float] = []
    for side in (factors, 1.0 / factors):
        before = float(side[0])
        for factor in side[1:]:
            try:
                value = excess(float(factor))
            except InputError:  # the ship or wave does not exist that far: no damping above 1, no wave that breaks
                break
            yield None
            if value < 0:
                crossing = None
                for crossing in _refined(excess, before, float(factor)):  # noqa: B007
                    yield None
                crossings += [] if crossing is None else [crossing]
                break
            before = float(factor)
    yield min(crossings, key=lambda f: abs(np.log(f))) if crossings else None


def _refined(excess: Callable[[float], float], unstable: float, stable: float) -> Iterator[float | None]:
    """Factor where the sign changes, on its stable side: the last of what comes, after each ship that is tried.

    Brent's method is begun anew with one value more until it lacks none: it asks for the same ones each time.
    """
    known: dict[float, float] = {}
    while True:
        try:
            root = float(brentq(known.__getitem__, unstable, stable, xtol=1e-6))
        except KeyError as lacking:
            factor = float(lacking.args[0])
            known[factor] = min(excess(factor), 1e6)
            yield None
        else:
            yield root
            return
