"""Sweeps: speed, heading, wave length, wave height, and any loading or coefficient."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.loads.forces import Form
from quartering.loads.waves import Wave
from quartering.study.conditions import RESULTS, evaluate
from quartering.study.dataset import labelled

LOADING_AXES = ("gm", "kg", "gyradius_roll", "gyradius_yaw", "roll_damping", "draught")
Floats = NDArray[np.float64]


def sweep(
    ship: Ship,
    speed: ArrayLike,
    heading: ArrayLike,
    wave_length: ArrayLike,
    wave_height: ArrayLike,
    *,
    harmonics: int = 1,
    form: Form = "stf",
    progress: Callable[[int, int], None] | None = None,
    **axes: ArrayLike,
) -> xr.Dataset:
    """Response and stability over a grid of conditions and loadings.

    Parameters
    ----------
    ship : Ship
    speed : (u,) float          [m/s]
    heading : (h,) float        [deg]
    wave_length : (w,) float    [m]
    wave_height : (a,) float    crest to trough [m]
    harmonics : int             of the steady motion: 1 is the paper's method
    form : str                  of the diffraction force
    progress : function(done, total), optional
    **axes : (l,) float         loading values (gm, kg, gyradius_roll, gyradius_yaw [m], roll_damping, draught) or
                                multipliers of coefficients by name (K_ppp=[0.5, 1, 2]); every combination is one "loading"

    Returns
    -------
    xarray.Dataset    dims (loading where axes are given) speed, heading, wave_length, wave_height; amplitudes ``sway`` [m],
                      ``roll``, ``yaw`` [deg], ``roll_peak``, ``k2``, ``q``, ``exponent`` [1/s], ``verdict``, ``status``, ..

    Raises
    ------
    InputError        an axis that is empty or not numbers, a wave that breaks, an unknown loading or coefficient

    Notes
    -----
    Forces and coefficients are computed once for all wave heights.  Source: [H71].

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> ds = sweep(ship("wigley"), speed=5.0, heading=[30, 60], wave_length=100.0, wave_height=[1.0, 2.0], K_ppp=[0.5, 1.0])
    >>> dict(ds.sizes)["loading"], ds["roll"].dims
    (2, ('loading', 'speed', 'heading', 'wave_length', 'wave_height'))
    """
    grid = {
        "speed": axis("speed", speed), "heading": axis("heading", heading),
        "wave_length": axis("wave_length", wave_length), "wave_height": axis("wave_height", wave_height),
    }  # fmt: skip
    _check_waves(grid["wave_length"], grid["wave_height"])
    extra = {name: axis(name, values) for name, values in axes.items()}
    loadings = [dict(zip(extra, values, strict=True)) for values in product(*extra.values())]
    u, mu, length = (
        a.ravel() for a in np.meshgrid(*(grid[n] for n in ("speed", "heading", "wave_length")), indexing="ij")
    )
    heights = np.broadcast_to(grid["wave_height"], (u.size, grid["wave_height"].size))
    total = len(loadings) * heights.size
    shape = tuple(values.size for values in grid.values())
    parts = []
    for i, loading in enumerate(loadings):

        def report(done: int, _: int, before: int = i * heights.size) -> None:
            if progress is not None:
                progress(before + done, total)

        parts.append(
            evaluate(_loaded(ship, loading), u, mu, length, heights, harmonics=harmonics, form=form, progress=report)
        )
    coordinates = {name: ((name,), values) for name, values in grid.items()}
    dims: tuple[str, ...] = tuple(grid)
    if not extra:
        results = {name: parts[0][name].reshape(*shape, *s) for name, s in RESULTS.items()}
    else:
        dims = ("loading", *dims)
        results = {name: np.stack([p[name].reshape(*shape, *s) for p in parts]) for name, s in RESULTS.items()}
        coordinates |= {name: (("loading",), np.array([one[name] for one in loadings])) for name in extra}
    results["encounter_frequency"] = parts[0]["encounter_frequency"].reshape(shape[:3])
    return labelled(ship, results, coordinates, dims, tuple(grid)[:3], form=form, harmonics=harmonics)


def axis(name: str, values: ArrayLike) -> Floats:
    """Values of one axis as a checked, flat array.

    Parameters
    ----------
    name : str             for the message
    values : (n,) float

    Returns
    -------
    (n,) float

    Raises
    ------
    InputError             empty, or not finite numbers

    Examples
    --------
    >>> axis("speed", 7.5).tolist()
    [7.5]
    """
    try:
        array = np.atleast_1d(np.array(values, dtype=float))
    except (TypeError, ValueError):
        raise InputError(f"{name} = {values!r} is not a number or a list of numbers; try [0, 5, 10]") from None
    if array.ndim != 1 or array.size == 0:
        raise InputError(f"{name} needs at least one value in a flat list; given shape {array.shape}")
    if not np.isfinite(array).all():
        raise InputError(f"{name} has a value that is not a finite number: {array[~np.isfinite(array)][0]}")
    return array


def _check_waves(lengths: Floats, heights: Floats) -> None:
    """Refuse waves that cannot be, by building the extreme ones."""
    Wave(length=float(lengths.min()), height=float(heights.max()))
    Wave(length=float(lengths.min()), height=float(heights.min()))


def _loaded(ship: Ship, loading: dict[str, float]) -> Ship:
    """The ship with one combination of loading values and coefficient multipliers."""
    if not loading:
        return ship
    own = {name: float(value) for name, value in loading.items() if name in LOADING_AXES}
    multipliers = {name: float(value) for name, value in loading.items() if name not in LOADING_AXES}
    return ship.with_(**own, coefficients=multipliers)  # type: ignore[arg-type]
