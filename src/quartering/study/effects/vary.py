"""One or two values varied in one condition: curves and maps of response and stability, and where the verdict flips."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import InputError, RangeWarning, written
from quartering.doors import takes
from quartering.hull.ship import Ship
from quartering.hull.told import condition
from quartering.loads.forces import Form
from quartering.loads.waves import Wave
from quartering.names import canonical
from quartering.option_checks import quoted
from quartering.study.dataset import attributes
from quartering.study.grid import CONDITION_AXES, axis
from quartering.study.loadings import LOADING_AXES, VALUE, user_value
from quartering.study.maps.sweep import sweep

Floats = NDArray[np.float64]
Ints = NDArray[np.int8]
_ROUNDS, _POINTS = 3, 17
ACCURACY: Final = float(_POINTS - 1) ** -_ROUNDS
"""Error of the value at which the verdict flips, as a share of the step between the values around it."""


@takes(ship="Ship", wave="Wave")
def vary(
    ship: Ship,
    wave: Wave,
    speed: float | str,
    heading: float | str,
    parameters: Mapping[str, ArrayLike],
    *,
    harmonics: int = 1,
    form: Form = "stf",
    progress: Callable[[int, int], None] | None = None,
) -> xr.Dataset:
    """Response and stability in one condition while one or two values vary.

    Parameters
    ----------
    ship : Ship
    wave : Wave
    speed : float            [m/s]
    heading : float          [deg]
    parameters : mapping     one or two names and their values: gm, kg, gyradius_roll, gyradius_yaw, draught [m], roll_damping,
                             speed [m/s], heading [deg], wave_length, wave_height [m], or a coefficient, which is multiplied
    harmonics : int          of the steady motion: 1 is the paper's method
    form : str               of the diffraction force
    progress : function(done, total), optional

    Returns
    -------
    xarray.Dataset           over the parameters: what `sweep` gives; each parameter's present value in its attribute
                             ``user_value``. With one parameter also ``flip``: the values at which the verdict passes between
                             stable, unstable and no answer, and ``verdict_below``, ``verdict_above`` on either side

    Raises
    ------
    InputError               no parameter or more than two, a name twice or unknown, fewer than two values

    Notes
    -----
    A flip is found by dividing the step it lies in, to 1/4096 of that step; two flips within one step go unseen.
    Source: [H71] Figs. 14-22.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> ds = vary(ship("wigley"), Wave(100.0, 2.0), 5.0, 60.0, {"gm": [1.0, 1.5, 2.0]})
    >>> ds["roll_amplitude"].dims, ds["flip"].size
    (('gm',), 0)
    """
    speed, heading = condition(ship, speed, heading)
    wanted = checked_parameters(ship, parameters)
    conditions = dict(zip(CONDITION_AXES, (speed, heading, wave.length, wave.height), strict=True))

    def over(values: Mapping[str, Floats], told: Callable[[int, int], None] | None = None) -> xr.Dataset:
        return _swept(ship, conditions, values, harmonics, form, told)

    ds = over(wanted, progress)
    for name in wanted:
        ds[name].attrs["user_value"] = present_value(ship, conditions, name)
    ds.attrs["title"] = f"{ship.name}: response and stability over {' and '.join(map(written, wanted))}"
    if len(wanted) == 1:
        (name,) = wanted
        ds = ds.assign(_flips(ds, name, lambda values: np.asarray(over({name: values})["verdict"])))
    return ds


def varied(ds: xr.Dataset) -> list[str]:
    """Names of the parameters a dataset of `vary` is over."""
    return [str(name) for name in ds["roll"].dims]


def refined_flips(at: Callable[[Floats], Ints], values: Floats, kinds: ArrayLike) -> list[tuple[float, int, int]]:
    """Where the verdict passes between stable, unstable and no answer.

    at: of ascending values, gives their verdicts
    values (n,): ascending or descending
    kinds (n,): verdicts there
    """
    found = []
    known = np.asarray(kinds)
    for i in np.flatnonzero(np.diff(np.sign(known))):
        low, high, before, after = float(values[i]), float(values[i + 1]), int(known[i]), int(known[i + 1])
        for _ in range(_ROUNDS):
            inner = np.linspace(low, high, _POINTS)
            verdicts = np.concatenate([[before], at(inner[1:-1]), [after]])
            j = int(np.flatnonzero(np.sign(verdicts) != np.sign(before))[0])
            low, high, after = float(inner[j - 1]), float(inner[j]), int(verdicts[j])
        found.append(((low + high) / 2, before, after))
    return found


def checked_parameters(ship: Ship, parameters: Mapping[str, ArrayLike]) -> dict[str, Floats]:
    """Parameters by the names the grid knows, their values ascending."""
    if not isinstance(parameters, Mapping):
        raise InputError(
            f"parameters = {quoted(parameters)}; it is a mapping of names to their values, such as {{'gm': [0.8, 1.2]}}"
        )
    if not 1 <= len(parameters) <= 2:
        given = ", ".join(parameters) or "none"
        raise InputError(f"one or two parameters can be varied at a time, {given} given; for more axes use sweep")
    wanted: dict[str, Floats] = {}
    for given_name, given_values in parameters.items():
        known = given_name in (*CONDITION_AXES, *LOADING_AXES) or given_name.endswith(VALUE)
        name = given_name if known else canonical(given_name)
        if name in wanted:
            raise InputError(f"{name} is given twice; give each parameter once")
        wanted[name] = np.unique(axis(name, given_values, ship))
        if wanted[name].size < 2:
            raise InputError(f"{name} = {wanted[name][0]:g} is one value; give two or more to vary it over")
    return wanted


def _swept(
    ship: Ship,
    conditions: Mapping[str, float],
    values: Mapping[str, Floats],
    harmonics: int,
    form: Form,
    told: Callable[[int, int], None] | None,
) -> xr.Dataset:
    """The sweep over some values of the parameters, its dimensions those of the parameters."""
    at: dict[str, ArrayLike] = {**conditions, **{name: v for name, v in values.items() if name in CONDITION_AXES}}
    loading = {name: v for name, v in values.items() if name not in CONDITION_AXES}
    ds = sweep(ship, **at, harmonics=harmonics, form=form, progress=told, **loading)  # type: ignore[arg-type]
    if loading:
        ds = unstacked(ds, {name: v for name, v in values.items() if name in loading})
    return ds.isel({name: 0 for name in CONDITION_AXES if name not in values}).transpose(*values, ...)


def unstacked(ds: xr.Dataset, loading: Mapping[str, Floats]) -> xr.Dataset:
    """The dataset with a dimension for each loading parameter in place of one for all."""
    sizes = {name: v.size for name, v in loading.items()}
    coordinates = {name: ds[name].variable for name in ds.coords if name not in sizes}
    coordinates |= {name: xr.Variable(name, v, ds[name].attrs) for name, v in loading.items()}
    variables = {name: ds[name].variable for name in ds.data_vars}
    return xr.Dataset(
        {name: v.unstack(loading=sizes) if "loading" in v.dims else v for name, v in variables.items()},
        coordinates,
        ds.attrs,
    )


def present_value(ship: Ship, conditions: Mapping[str, float], name: str) -> float:
    """Present value of a parameter; 1 for a coefficient."""
    if name in CONDITION_AXES:
        return float(conditions[name])
    return user_value(ship, name)


def _flips(ds: xr.Dataset, name: str, at: Callable[[Floats], Ints]) -> dict[str, xr.Variable]:
    """The values at which the verdict flips, as variables of a dataset."""
    with warnings.catch_warnings():  # of roll beyond the fit: the whole range has said so
        warnings.simplefilter("ignore", RangeWarning)
        found = refined_flips(at, ds[name].values, ds["verdict"].values)
    value, below, above = zip(*found, strict=True) if found else ((), (), ())
    of_verdict = attributes("verdict")
    return {
        "flip": xr.Variable(
            "flip", np.array(value, float), ds[name].attrs | {"long_name": f"{name} where the verdict flips"}
        ),
        "verdict_below": xr.Variable("flip", np.array(below, np.int8), of_verdict),
        "verdict_above": xr.Variable("flip", np.array(above, np.int8), of_verdict),
    }
