"""Rudder and autopilot: course keeping."""

from __future__ import annotations

from dataclasses import dataclass

from quartering.hull.told import number
from quartering.options import parts

ASPECT = 1.8
"""Height over chord of a rudder of which nothing is known (assumed)."""


@dataclass(frozen=True)
class Autopilot:
    """Proportional and derivative control of the heading by the rudder, off unless a ship is given one.

    The rudder ordered is ``-gain psi - rate_gain r``; with a lag T the rudder follows as ``T d delta/dt = order - delta``.
    A positive rudder angle delta turns the bow to starboard (N_delta > 0), so a ship that has yawed to starboard (psi > 0)
    is turned back.

    Parameters
    ----------
    gain : float         numbers, or text with a unit: rudder angle per angle off course, >= 0 [1]
    rate_gain : float    rudder angle per rate of turn, >= 0 [s]
    lag : float          time constant of the steering gear, >= 0; 0: the rudder is at once where it is ordered [s]

    Raises
    ------
    InputError    a value that is no number in the range of its option

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
        _by_options(self, "autopilot")


@dataclass(frozen=True)
class Rudder:
    """What the lift of a rudder is estimated from.

    Parameters
    ----------
    area : float      of the blade, side view [m2]
    aspect : float    height over chord [1]

    Raises
    ------
    InputError    a value that is no number in the range of its option

    Examples
    --------
    >>> Rudder(area=20.0, aspect=1.8).area
    20.0
    """

    area: float
    aspect: float

    def __post_init__(self) -> None:
        _by_options(self, "rudder")


def _by_options(record: object, group: str) -> None:
    """Numbers, or text with a unit, each in the range of its option."""
    for key, one in parts(group).items():
        object.__setattr__(record, key, number(None, one.name, getattr(record, key)))
