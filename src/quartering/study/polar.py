"""The polar map: headings all round, for one or several speeds and waves."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.ship import Ship
from quartering.loads.forces import Form
from quartering.loads.waves import Wave
from quartering.motion.harmonic import checked_harmonics
from quartering.options import quoted
from quartering.study.conditions import RESULTS, evaluate
from quartering.study.dataset import labelled
from quartering.study.grid import axis


@takes(ship="Ship")
def polar(
    ship: Ship,
    wave: Wave | Sequence[Wave],
    speeds: ArrayLike,
    headings: ArrayLike | None = None,
    *,
    harmonics: int = 1,
    form: Form = "stf",
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
    progress : function(done, total), optional

    Returns
    -------
    xarray.Dataset    dims speed, heading, wave_length; ``wave_height`` [m] along wave_length; variables as in `sweep`

    Raises
    ------
    InputError        no wave, two waves of one length, an axis that is empty or not numbers, harmonics that cannot be

    Notes
    -----
    Headings from 180 to 360 mirror those from 0 to 180.  Source: [H71] Figs. 5-10, 20-21.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> ds = polar(ship("wigley"), Wave(length=100.0, height=1.5), speeds=[5.0], headings=[0, 60, 120])
    >>> ds["roll"].shape, float(ds["roll"].sel(heading=0).item())
    ((1, 3, 1), 0.0)
    """
    checked_harmonics(harmonics)
    waves = [wave] if isinstance(wave, Wave) else wave
    if not isinstance(waves, (list, tuple)) or not all(isinstance(one, Wave) for one in waves):
        raise InputError(
            f"wave = {quoted(wave)} is no Wave and no list of them; give one, such as quartering.Wave(100.0, 2.0)"
        )
    waves = sorted(waves, key=lambda one: one.length)
    lengths = np.array([one.length for one in waves])
    if lengths.size == 0 or (np.diff(lengths) == 0).any():
        raise InputError("polar needs at least one wave, and each wave length once; use sweep for several heights")
    speed, heading = (
        axis("speed", speeds, ship),
        axis("heading", np.arange(0.0, 181.0, 5.0) if headings is None else headings, ship),
    )
    u, mu, length = (a.ravel() for a in np.meshgrid(speed, heading, lengths, indexing="ij"))
    height = np.tile([one.height for one in waves], speed.size * heading.size)[:, None]
    found = evaluate(ship, u, mu, length, height, harmonics=harmonics, form=form, progress=progress)
    shape = (speed.size, heading.size, lengths.size)
    results = {name: found[name].reshape(*shape, *s) for name, s in RESULTS.items()}
    results["encounter_frequency"] = found["encounter_frequency"].reshape(shape)
    dims = ("speed", "heading", "wave_length")
    coordinates = {
        "speed": (("speed",), speed),
        "heading": (("heading",), heading),
        "wave_length": (("wave_length",), lengths),
        "wave_height": (("wave_length",), np.array([one.height for one in waves])),
    }
    return labelled(ship, results, coordinates, dims, dims, form=form, harmonics=harmonics)
