"""Spectra over frequency and direction as wavespectra shapes them, read without that package."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import InputError, RangeWarning
from quartering.loads.sea.systems import MeasuredSystem, wrapped

if TYPE_CHECKING:
    import xarray as xr

Floats = NDArray[np.float64]
_WIDEST: Final = 3.0
_STATED: Final = 0.02


def read_spectrum(dataset: xr.Dataset | xr.DataArray, course: float) -> MeasuredSystem:
    """A spectrum from the north and in hertz, as one from the bow of a ship and in rad/s; see `Sea.from_spectrum`.

    See `Sea.from_spectrum`.
    """
    efth = _efth(dataset)
    sigma = 2.0 * np.pi * np.asarray(efth["freq"].values, dtype=float)
    _check_sense(efth["dir"])
    direction = wrapped(np.asarray(efth["dir"].values, dtype=float) + 180.0 - course)
    values = np.asarray(efth.transpose("freq", "dir").values, dtype=float) * (180.0 / np.pi) / (2.0 * np.pi)
    by_frequency, by_direction = np.argsort(sigma), np.argsort(direction)
    sigma, direction = sigma[by_frequency], direction[by_direction]
    values = values[by_frequency][:, by_direction]
    _check_grid(sigma, direction, values)
    system = MeasuredSystem(sigma, direction, _without_negative(sigma, direction, values))
    _check_height(dataset, system)
    return system


def _efth(dataset: Any) -> xr.DataArray:
    named = getattr(dataset, "data_vars", None)
    efth = dataset["efth"] if named is not None and "efth" in named else dataset if named is None else None
    dims = getattr(efth, "dims", ())
    if efth is None or not {"freq", "dir"} <= set(dims):
        raise InputError(
            "no spectrum found: give a Dataset with efth over freq [Hz] and dir [deg] as wavespectra reads it, or its DataArray"
        )
    further = {name: efth.sizes[name] for name in dims if name not in ("freq", "dir") and efth.sizes[name] > 1}
    if further:
        name, size = next(iter(further.items()))
        raise InputError(f"the spectrum has {size} values of {name}; choose one, such as dataset.isel({name}=0)")
    return efth.squeeze([name for name in dims if name not in ("freq", "dir")], drop=True)


def _check_sense(direction: xr.DataArray) -> None:
    said = " ".join(str(direction.attrs.get(key, "")) for key in ("standard_name", "long_name", "comment")).lower()
    said = said.replace("_", " ").replace("-", " ")
    comes, goes = "from" in said.replace("from north", "").replace("from the north", ""), "to direction" in said
    if goes or "going to" in said or "towards" in said:
        raise InputError(
            'the directions of this spectrum go to; here they come from: add 180 deg and set dir.attrs["standard_name"] ='
            ' "sea_surface_wave_from_direction"'
        )
    if not comes:
        raise InputError(
            "the sense of the directions is not said: waves come from, or go to? Where they come from, clockwise from north,"
            ' set dataset["dir"].attrs["standard_name"] = "sea_surface_wave_from_direction"; else add 180 deg first'
        )


def _check_grid(sigma: Floats, direction: Floats, values: Floats) -> None:
    if sigma.size < 3 or direction.size < 4:
        raise InputError(
            f"a spectrum of {sigma.size} frequencies and {direction.size} directions is no sea; give at least 3 and 4, or a"
            " regular wave, quartering.Wave"
        )
    if not (np.isfinite(sigma).all() and np.isfinite(direction).all() and np.isfinite(values).all()):
        holes = int((~np.isfinite(values)).sum())
        raise InputError(
            f"the spectrum has gaps: {holes} of {values.size} values are no numbers; fill them, or choose another"
        )
    steps = np.diff(sigma)
    if sigma[0] <= 0 or (steps <= 0).any():
        raise InputError("freq must be above 0 Hz and hold each frequency once")
    wide = (
        (steps[1:-1] > _WIDEST * steps[:-2]) & (steps[1:-1] > _WIDEST * steps[2:])
        if steps.size > 2
        else np.zeros(1, bool)
    )
    if wide.any():
        i = int(wide.argmax()) + 1
        raise InputError(
            f"the spectrum has a gap between {sigma[i] / 2 / np.pi:.4g} and {sigma[i + 1] / 2 / np.pi:.4g} Hz; fill it in"
        )
    around = np.diff(np.append(direction, direction[0] + 360.0))
    even = 360.0 / direction.size
    if np.abs(around - even).max() > 0.02 * even:
        raise InputError(
            f"directions are {around.min():.4g} to {around.max():.4g} deg apart; they must go evenly round the circle, each"
            f" once, {even:.4g} deg here: bring the spectrum to such directions first"
        )


def _without_negative(sigma: Floats, direction: Floats, values: Floats) -> Floats:
    """Energy below 0 set to 0, and the rest scaled to the same total."""
    if values.min() >= 0.0:
        total = values.sum()
        if not total > 0:
            raise InputError("the spectrum holds no energy; give one of a sea")
        return values
    before, clipped = MeasuredSystem(sigma, direction, values), np.maximum(values, 0.0)
    after = MeasuredSystem(sigma, direction, clipped)
    if not before.moment(0) > 0:
        raise InputError("the spectrum holds no energy in all; give one of a sea")
    share = before.moment(0) / after.moment(0)
    warnings.warn(
        f"the spectrum holds negative energy, {(1 - share) / share:.2g} of its total: set to 0, the rest scaled to that total",
        RangeWarning,
        stacklevel=4,
    )
    return np.asarray(clipped * share)


def _check_height(dataset: Any, system: MeasuredSystem) -> None:
    stated = dataset["hs"] if "hs" in getattr(dataset, "data_vars", ()) else None
    if stated is None or stated.size != 1:
        return
    told = float(np.asarray(stated.values).ravel()[0])
    if abs(system.hs - told) > _STATED * told:
        raise InputError(
            f"the spectrum holds Hs {system.hs:.4g} m and states hs {told:.4g} m: units are m2/Hz/deg and Hz; check them"
        )
