"""The roll angle that counts as a capsize: one limit, the least of three."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, Literal, NamedTuple

import numpy as np

from quartering._machine.piecewise import zero
from quartering.hull.lines.section import Floats

ON_ITS_SIDE: Final = 90.0
"""Roll angle beyond which no righting moment is taken for a ship's [deg]."""

Reason = Literal["vanishing", "openings", "on its side"]

_WORDS: Final[dict[str, str]] = {
    "vanishing": "where the righting arm vanishes",
    "openings": "where unprotected openings go under",
    "on its side": "on its side",
}
_STEP = 0.125


class CapsizeLimit(NamedTuple):
    """Roll angle that counts as a capsize, and which of the three it is.

    Parameters
    ----------
    angle : float     [deg]
    reason : str      "vanishing" (of the righting arm), "openings" (go under), or "on its side" (90 deg)
    """

    angle: float
    reason: Reason

    @property
    def radians(self) -> float:
        """The angle [rad]."""
        return float(np.radians(self.angle))

    @property
    def words(self) -> str:
        """The angle with its reason."""
        return f"{self.angle:.3g} deg, {_WORDS[self.reason]}"


def least_limit(vanishing: float, openings: float | None = None) -> CapsizeLimit:
    """The least of the vanishing angle, the angle of the openings and 90 deg.

    vanishing: angle of vanishing stability [deg]; infinite where there is none
    openings: heel at which unprotected openings go under [deg]; None: not known
    """
    limits: tuple[tuple[float, Reason], ...] = (
        (float(vanishing), "vanishing"),
        (np.inf if openings is None else float(openings), "openings"),
        (ON_ITS_SIDE, "on its side"),
    )
    return CapsizeLimit(*min(limits, key=lambda one: one[0]))


def first_vanishing(arm: Callable[[Floats], Floats]) -> float:
    """Smallest heel up to 90 deg at which a righting arm that rights becomes 0.

    arm: of heel angles (n,) above 0 [rad], positive where it rights
    Returns [deg]; infinite where there is none

    Where an upright ship is unstable the range of stability begins at the angle of loll and ends at this one.  Every 1/8
    degree, then by Brent's method.

    >>> round(first_vanishing(lambda phi: phi - phi**3), 6)
    57.29578
    """
    angles = np.radians(np.arange(_STEP, ON_ITS_SIDE + _STEP / 2, _STEP))
    arms = arm(angles)
    gone = np.flatnonzero((arms[:-1] > 0) & (arms[1:] <= 0))
    if gone.size == 0:
        return float("inf")
    low, high = angles[gone[0]], angles[gone[0] + 1]
    return float(np.degrees(zero(lambda phi: float(arm(np.array([phi]))[0]), low, high, xtol=1e-12)))
