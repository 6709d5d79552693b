"""Range of validity: speeds and waves outside the theory or a database, one warning for a study."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import GRAVITY, RangeWarning
from quartering.hydro.source.of_ship import source_of
from quartering.hydro.strip.table import FREQUENCY_RANGE
from quartering.loads.waves import Floats, encounter_frequency

if TYPE_CHECKING:
    from quartering.hull.ship import Ship
    from quartering.loads.strips.strip_forces import Form

FASTEST: Final = 0.5
"""Froude number above which a hull no longer floats as at rest: it trims, and lift carries part of it [1]."""
SHORTEST: Final = np.pi / FREQUENCY_RANGE[1] ** 2
"""Wave length over beam below which the waves are beyond the frequencies of the section coefficients [1]."""
UNFADED: Final = 0.15
"""Wave length over length of the ship below which three-dimensional ends should have faded out of a force, and have not [1]."""


def warn_of_conditions(ship: Ship, speed: ArrayLike, wave_length: ArrayLike) -> None:
    """Say that a speed or a wave of a study is beyond what strip theory describes.

    speed (n,): U [m/s]
    wave_length (n,): [m]

    The limit of the speed is this library's choice; that of the wave is where w sqrt(B/2g) = 3.5, w^2 = 2 pi g/lambda, and
    with three-dimensional ends sooner.
    Source: [STF70] assumptions (slender hull, moderate speed); `default_frequencies`.

    >>> from quartering.hull.file.read import ship
    >>> warn_of_conditions(ship("wigley"), [5.0, 15.0], 100.0)
    """
    length, beam = ship.hull.length, ship.hull.beam
    froude = float(np.max(speed, initial=0.0) / np.sqrt(GRAVITY * length))
    if froude > FASTEST:
        warnings.warn(
            f"{ship.name}: a speed of {np.max(speed):g} m/s is Froude number {froude:.3g}; strip theory describes a hull up "
            f"to about {FASTEST:g} ({FASTEST * np.sqrt(GRAVITY * length):.3g} m/s); is the unit right? Try 15kn or 0.25Fn",
            RangeWarning,
            stacklevel=3,
        )
    shortest = float(np.min(np.asarray(wave_length, dtype=float), initial=np.inf))
    if shortest < SHORTEST * beam:
        warnings.warn(
            f"{ship.name}: a wave of {shortest:.3g} m is shorter than {SHORTEST:.3g} B = {SHORTEST * beam:.3g} m, beyond the "
            "frequencies of the section coefficients, which keep their last value there; is the unit right? Try 1L",
            RangeWarning,
            stacklevel=3,
        )
    elif shortest < UNFADED * length and ship.hull.ends == "three-dimensional":
        warnings.warn(
            f"{ship.name}: a wave of {shortest:.3g} m is shorter than {UNFADED:g} L = {UNFADED * length:.3g} m, where "
            "three-dimensional ends leave 0.7 to 1.4 times the sway force by strips and 0.7 to 2.2 times the roll moment, and "
            "the strips are right; such waves hardly move a ship; try ends: strips",
            RangeWarning,
            stacklevel=3,
        )


def warn_outside_database(ship: Ship, outside: int, total: int) -> None:
    """Say that some conditions have no answer because the ship's own database does not hold them.

    outside: number of such conditions; nothing is said of none
    total: of all conditions

    >>> from quartering.hull.file.read import ship
    >>> warn_outside_database(ship("wigley"), 0, 10)
    """
    if outside:
        source = source_of(ship)
        (low, high), heading = source.held.frequency, source.held.heading
        headings = "" if heading is None else f" and headings {heading[0]:g} to {heading[1]:g} deg"
        warnings.warn(
            f"{ship.name}: {outside:,} of {total:,} conditions have no answer, outside {source.words}, which holds "
            f"{low:.4g} to {high:.4g} rad/s{headings}; compute it further, or ask for longer waves, less "
            "speed or other headings",
            RangeWarning,
            stacklevel=3,
        )


def conditions_held(
    ship: Ship, wavenumber: Floats, speed: Floats, heading: Floats, form: Form = "stf"
) -> NDArray[np.bool_]:
    """Which conditions a ship's own database holds coefficients and wave forces of; all of them without one.

    wavenumber, speed, heading (n,): [1/m, m/s, deg]
    form: of the diffraction force; only "stf" takes its waves from the database
    Returns (n,)

    >>> from quartering.hull.file.read import ship
    >>> conditions_held(ship("box"), np.array([0.1]), np.array([5.0]), np.array([90.0])).tolist()
    [True]
    """
    from quartering.loads.source import wave_source  # kernels, which what has no wave needs not

    omega = encounter_frequency(np.sqrt(GRAVITY * wavenumber), speed, heading)
    return source_of(ship).holds(np.abs(omega)) & wave_source(ship, form).hold(wavenumber, heading)
