"""Where speeds and waves leave what the theory describes: one warning for all conditions of a study."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import GRAVITY, RangeWarning
from quartering.hydro.table import FREQUENCY_RANGE

if TYPE_CHECKING:
    from quartering.hull.ship import Ship

FASTEST: Final = 0.5
"""Froude number above which a hull no longer floats as at rest: it trims, and lift carries part of it [1]."""
SHORTEST: Final = np.pi / FREQUENCY_RANGE[1] ** 2
"""Wave length over beam below which the waves are beyond the frequencies of the section coefficients [1]."""


def warn_of_conditions(ship: Ship, speed: ArrayLike, wave_length: ArrayLike, *, stacklevel: int = 3) -> None:
    """Say that a speed or a wave of a study is beyond what strip theory describes.

    Parameters
    ----------
    ship : Ship
    speed : (n,) float          U [m/s]
    wave_length : (n,) float    [m]
    stacklevel : int            as in `warnings.warn`

    Warns
    -----
    RangeWarning                a Froude number above `FASTEST`, a wave shorter than `SHORTEST` times the beam

    Notes
    -----
    The limit of the speed is this library's choice; that of the wave is where w sqrt(B/2g) = 3.5, w^2 = 2 pi g/lambda.
    Source: [STF70] assumptions (slender hull, moderate speed); `default_frequencies`.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> warn_of_conditions(ship("wigley"), [5.0, 15.0], 100.0)
    """
    length, beam = ship.hull.length, ship.hull.beam
    froude = float(np.max(speed, initial=0.0) / np.sqrt(GRAVITY * length))
    if froude > FASTEST:
        warnings.warn(
            f"{ship.name}: a speed of {np.max(speed):g} m/s is Froude number {froude:.3g}; strip theory describes a hull up "
            f"to about {FASTEST:g} ({FASTEST * np.sqrt(GRAVITY * length):.3g} m/s); is the unit right? 15kn and 0.25Fn are understood",
            RangeWarning,
            stacklevel=stacklevel,
        )
    shortest = float(np.min(wave_length, initial=np.inf))
    if shortest < SHORTEST * beam:
        warnings.warn(
            f"{ship.name}: a wave of {shortest:.3g} m is shorter than {SHORTEST:.2g} B = {SHORTEST * beam:.3g} m, beyond the "
            "frequencies of the section coefficients, which keep their last value there; is the unit right? 1L is understood",
            RangeWarning,
            stacklevel=stacklevel,
        )
