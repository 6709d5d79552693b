"""The polar map: headings all round, for one or several speeds and waves."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.ship import Ship
from quartering.loads.forces import Form
from quartering.loads.waves import STEEPEST, Wave
from quartering.motion.modes import Modes, in_six
from quartering.motion.steady.harmonic import checked_harmonics
from quartering.option_checks import checked, quoted
from quartering.options import OPTIONS
from quartering.study.conditions import RESULTS, evaluate
from quartering.study.dataset import labelled
from quartering.study.grid import axis
from quartering.study.maps.extension import carried_on
from quartering.study.six_modes.grid import STEADY_MOTION

Floats = NDArray[np.float64]
"""Sway, roll and yaw, or heave and pitch too."""
MOST_CONDITIONS = 1_000_000
"""Conditions a map that is extended may have: about 1 GB of results."""


@takes(ship="Ship", form="word")
def polar(
    ship: Ship,
    wave: Wave | Sequence[Wave],
    speeds: ArrayLike,
    headings: ArrayLike | None = None,
    *,
    harmonics: int = 1,
    form: Form = "stf",
    extend: bool | str = False,
    modes: Modes = "three",
    progress: Callable[[int, int], None] | None = None,
) -> xr.Dataset:
    """Response and stability over headings and speeds, for one wave or a list of waves.

    Parameters
    ----------
    ship : Ship
    wave : Wave or sequence of Wave    in a sequence each length stands once, with a height of its own
    speeds : (u,) float                [m/s]
    headings : (h,) float              [deg]; by default 0 to 180 every 5
    harmonics : int                    of the steady motion: 1 is the paper's method
    form : str                         of the diffraction force
    extend : bool, or "yes" or "no"    where the largest roll stands on an edge of the map, carry the map on past it, in steps
                                       of its last interval, until the largest stands inside (see `edges_of_largest`)
    modes : str                        "three": sway, roll and yaw; "six": heave and pitch too, in the pressure over the
                                       whole wetted hull, so that head and following seas have answers
    progress : function(done, total), optional

    Returns
    -------
    xarray.Dataset    dims speed, heading, wave_length; ``wave_height`` [m] along wave_length; variables as in `sweep`

    Raises
    ------
    InputError        no wave, two waves of one length, an axis that is empty or not numbers, harmonics that cannot
                      be; to extend a map of waves that have neither one height nor one steepness

    Notes
    -----
    Headings from 180 to 360 mirror those from 0 to 180.  In six modes what the paper's first order gives is NaN, and the
    largest roll is that of a stable motion, of two wave periods where small roll grows.  Source: [H71] Figs. 5-10, 20-21.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> ds = polar(ship("wigley"), Wave(length=100.0, height=1.5), speeds=[5.0], headings=[0, 60, 120])
    >>> ds["roll_amplitude"].shape, float(ds["roll_amplitude"].sel(heading=0).item())
    ((1, 3, 1), 0.0)
    """
    checked_harmonics(harmonics)
    if in_six(modes) and (harmonics != 1 or form != "stf"):
        raise InputError("modes = six has harmonics and diffraction of its own; leave harmonics and form out")
    waves = [wave] if isinstance(wave, Wave) else wave
    if not isinstance(waves, (list, tuple)) or not all(isinstance(one, Wave) for one in waves):
        raise InputError(
            f"wave = {quoted(wave)} is no Wave and no list of them; give one, such as quartering.Wave(100.0, 2.0)"
        )
    waves = sorted(waves, key=lambda one: one.length)
    lengths = np.array([one.length for one in waves])
    if lengths.size == 0 or (np.diff(lengths) == 0).any():
        raise InputError("polar needs at least one wave, and each wave length once; use sweep for several heights")
    carry_on = extend if isinstance(extend, bool) else checked(OPTIONS["extend"], extend) == "yes"
    height_of = _height_of(waves) if carry_on else None
    axes = {
        "speed": axis("speed", speeds, ship),
        "heading": axis("heading", np.arange(0.0, 181.0, 5.0) if headings is None else headings, ship),
        "wave_length": lengths,
    }
    height = np.array([one.height for one in waves])
    ds = _mapped(ship, axes, height, harmonics, form, modes, progress)
    if height_of is None:
        return ds

    def further(wanted: Mapping[str, Floats]) -> xr.Dataset:
        return _mapped(ship, wanted, height_of(wanted["wave_length"]), harmonics, form, modes, None)

    return carried_on(ds, further, MOST_CONDITIONS)


def _height_of(waves: Sequence[Wave]) -> Callable[[Floats], Floats]:
    """Height of waves of other lengths: that of all, or of the same steepness; no wave steeper than the steepest of them."""
    height, length = (np.array([getattr(one, name) for one in waves]) for name in ("height", "length"))
    steepness = height / length
    if np.ptp(steepness) <= 1e-9 * steepness.max():
        return lambda other: np.asarray(steepness[0] * other)
    if np.ptp(height) == 0:
        return lambda other: np.minimum(height[0], STEEPEST * other)
    raise InputError(
        "extend = yes; the waves given have neither one height nor one steepness, so those of other lengths are not known; give"
        " waves of one of the two, or leave extend out"
    )


def _mapped(
    ship: Ship,
    axes: Mapping[str, Floats],
    heights: Floats,
    harmonics: int,
    form: Form,
    modes: Modes,
    progress: Callable[[int, int], None] | None,
) -> xr.Dataset:
    """Every combination of speeds, headings and waves."""
    speed, heading, lengths = (axes[name] for name in ("speed", "heading", "wave_length"))
    u, mu, length = (a.ravel() for a in np.meshgrid(speed, heading, lengths, indexing="ij"))
    height = np.tile(heights, speed.size * heading.size)[:, None]
    if modes == "six":
        from quartering.study.six_modes.conditions import evaluate_six, warn_of_six

        warn_of_six(ship, u, mu, length, height[:, 0])
        found = evaluate_six(ship, u, mu, length, height[:, 0], progress=progress)
    else:
        found = evaluate(ship, u, mu, length, height, harmonics=harmonics, form=form, progress=progress)
    shape = (speed.size, heading.size, lengths.size)
    results = {name: found[name].reshape(*shape, *s) for name, s in RESULTS.items()}
    results["encounter_frequency"] = found["encounter_frequency"].reshape(shape)
    dims = ("speed", "heading", "wave_length")
    coordinates = {name: ((name,), axes[name]) for name in dims} | {"wave_height": (("wave_length",), heights)}
    ds = labelled(ship, results, coordinates, dims, dims, form=form, harmonics=harmonics)
    return ds.assign_attrs(steady_motion=STEADY_MOTION, modes="six") if modes == "six" else ds
