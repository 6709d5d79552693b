"""Rudder and autopilot: what keeps a ship on her course."""

from __future__ import annotations

import math
from dataclasses import dataclass

from quartering.conventions import InputError

ASPECT = 1.8
"""Height over chord of a rudder of which nothing is known (assumed)."""
MOST = {"gain": 100.0, "rate_gain": 1000.0, "lag": 1000.0}
"""Largest values of an autopilot; those in use are a few units and tens of seconds [1, s, s]."""


@dataclass(frozen=True)
class Autopilot:
    """Proportional and derivative control of the heading by the rudder, off unless a ship is given one.

    The rudder ordered is ``-gain psi - rate_gain r``; with a lag T the rudder follows as ``T d delta/dt = order - delta``.
    A positive rudder angle delta turns the bow to starboard (N_delta > 0), so a ship that has yawed to starboard (psi > 0)
    is turned back.

    Parameters
    ----------
    gain : float         rudder angle per angle off course, >= 0 [1]
    rate_gain : float    rudder angle per rate of turn, >= 0 [s]
    lag : float          time constant of the steering gear, >= 0; 0: the rudder is at once where it is ordered [s]

    Raises
    ------
    InputError    a value that is negative, not a finite number, or above `MOST`

    Notes
    -----
    Without limits on the angle or its rate.  Source: [Lewis89] ch. IX (steering by autopilot).

    Examples
    --------
    >>> Autopilot(gain=1.0, rate_gain=8.0)
    Autopilot(gain=1.0, rate_gain=8.0, lag=0.0)
    """

    gain: float
    rate_gain: float = 0.0
    lag: float = 0.0

    @property
    def words(self) -> str:
        """The three numbers with their units."""
        return f"gain {self.gain:.4g}, rate gain {self.rate_gain:.4g} s, lag {self.lag:.4g} s"

    def __post_init__(self) -> None:
        _checked(self, "autopilot", {"gain": 1.0, "rate_gain": 10.0, "lag": 2.0}, least=True)
        for key, most in MOST.items():
            if getattr(self, key) > most:
                raise InputError(
                    f"autopilot: {key} = {getattr(self, key):g}; it is at most {most:g}; is the unit right?"
                )


@dataclass(frozen=True)
class Rudder:
    """What the lift of a rudder is estimated from.

    Parameters
    ----------
    area : float      of the blade, side view [m2]
    aspect : float    height over chord [1]

    Raises
    ------
    InputError    a value that is not above 0

    Examples
    --------
    >>> Rudder(area=20.0, aspect=1.8).area
    20.0
    """

    area: float
    aspect: float

    def __post_init__(self) -> None:
        _checked(self, "rudder", {"area": 20.0, "aspect": 1.8}, least=False)


def _checked(record: object, name: str, usual: dict[str, float], *, least: bool) -> None:
    """Refuse values that are not numbers above 0 (or at `least` 0)."""
    for key, example in usual.items():
        value = getattr(record, key)
        if not (math.isfinite(value) and (value > 0 or (least and value == 0))):
            allowed = "0 or more" if least else "above 0"
            raise InputError(f"{name}: {key} = {value:g}; it is a number {allowed}; try {example:g}")
