"""Tornado: effect of a relative change of each value in one condition, and where the verdict flips."""

from __future__ import annotations

import warnings
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering.conventions import InputError, RangeWarning
from quartering.doors import takes
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.ship import Ship
from quartering.hull.told import condition, number
from quartering.loads.forces import Form
from quartering.loads.waves import Wave
from quartering.motion.equations.model import Model
from quartering.motion.of_ship import equations
from quartering.names import canonical
from quartering.study.dataset import attributes, heading_of
from quartering.study.effects.vary import refined_flips
from quartering.study.grid import Grid, grid
from quartering.study.loadings import LOADING_AXES, loaded, user_value
from quartering.study.maps.sweep import evaluated

Floats = NDArray[np.float64]
LOADING: Final = ("gm", "kg", "gyradius_roll", "gyradius_yaw", "roll_damping")
"""Values of the loading that are changed; the coefficients of the equations follow."""

MEASURES: Final = ("roll", "index", "exponent")
"""What is measured: roll amplitude [deg], stability index S [1/s], leading Floquet exponent [1/s]."""

REACH: Final = 5.0
"""A flip of the verdict is looked for from a fifth to five times the present value."""
_STEPS = 6


@takes(ship="Ship", wave="Wave", parameters="words, None")
def tornado(
    ship: Ship,
    wave: Wave,
    speed: float | str,
    heading: float | str,
    *,
    change: float | str = 0.1,
    parameters: Sequence[str] | None = None,
    harmonics: int = 1,
    form: Form = "stf",
    progress: Callable[[int, int], None] | None = None,
) -> xr.Dataset:
    """Roll, stability index and leading exponent when each value is a little less and a little more, one at a time.

    Parameters
    ----------
    ship : Ship
    wave : Wave
    speed : float                        [m/s]
    heading : float                      [deg]
    change : float or str                relative, above 0 and below 1: 0.1 or "10 %"
    parameters : sequence of str         by default those of `LOADING` and every coefficient on the right of the equations
    harmonics, form                      as in `sweep`
    progress : function(done, total), optional

    Returns
    -------
    xarray.Dataset                       over ``parameter`` and ``side`` (less, more): ``roll`` [deg], ``index``, ``exponent``
                                         [1/s], ``verdict``; ``value`` now (1 for a coefficient, which is multiplied) and the
                                         nearest ``flip`` at which the verdict becomes ``verdict_beyond`` (NaN: none within a
                                         fifth to five times). Sorted, the largest effect first; the present results are
                                         attributes ``base_roll``, ``base_index``, ``base_exponent``, ``base_verdict``

    Raises
    ------
    InputError                           a change not between 0 and 1, an unknown parameter, no motion in this condition, what
                                         `equations` refuses

    Notes
    -----
    A change that cannot be made (a KG above the metacentre) is NaN.  K_phi is left out: it is GM.  Flips are looked for in
    steps of 31 %, then refined.  Source: [H71] Figs. 20-22.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> ds = tornado(ship("wigley"), Wave(100.0, 2.0), 5.0, 60.0, parameters=["gm", "K_p"])
    >>> ds["roll"].dims, str(ds["parameter"].values[0])
    (('parameter', 'side'), 'gm')
    """
    speed, heading = condition(ship, speed, heading)
    change = number(ship, "change", change)
    if change == 1:
        raise InputError("change = 1; it is above 0 and less than 1; try 0.1")
    own = _user_values(ship, equations(ship, wave, speed, heading), parameters)
    one = grid(ship, speed, heading, wave.length, wave.height, harmonics=harmonics, form=form)
    probes = np.geomspace(1.0, REACH, _STEPS + 1)[1:]
    factors = np.concatenate([[1 - change, 1 + change], 1 / probes[::-1], [1.0], probes])
    tries = [(name, float(now * factor)) for name, now in own.items() for factor in factors]
    found = _judged(one, own, tries, progress)
    shape = (len(own), factors.size)
    results = {name: found[name].reshape(shape) for name in (*MEASURES, "verdict")}
    base = {name: results[name][0, 2 + _STEPS] for name in results}
    if not np.isfinite(base["roll"]):
        raise InputError("no periodic motion in this condition, so nothing to change; try a lower wave")
    flips = [
        _nearest_flip(one, own, name, own[name] * factors[2:], results["verdict"][i, 2:]) for i, name in enumerate(own)
    ]
    about = heading_of(ship, form=form, harmonics=harmonics)
    return _sorted(_dataset(about, own, change, {k: v[:, :2] for k, v in results.items()}, flips, base))


def _user_values(ship: Ship, model: Model, parameters: Sequence[str] | None) -> dict[str, float]:
    """Present value of each parameter, 1 for coefficients; those that are zero cannot be changed by a share."""
    if parameters is None:
        parameters = (*LOADING, *(name for name, value in model.terms.items() if value != 0.0 and name != "K_phi"))
    names = [name if name in LOADING_AXES else canonical(name) for name in parameters]
    if "draught" in names:
        raise InputError('"draught" is another hull in the water; vary it with quartering.vary')
    own = {name: user_value(ship, name) for name in names}
    return {name: value for name, value in own.items() if value != 0.0}


def _judged(
    one: Grid,
    own: Mapping[str, float],
    tries: Sequence[tuple[str, float]],
    progress: Callable[[int, int], None] | None = None,
) -> dict[str, NDArray[np.generic]]:
    """Results of one condition with one value changed at a time; NaN and no answer where that ship cannot be."""
    km = hydrostatics(one.ship.hull).km
    base = {name: value for name, value in own.items() if name != "kg"} | {"gm": one.ship.loading.gm}
    changes = [("gm", km - value) if name == "kg" else (name, value) for name, value in tries]
    possible = np.array([_possible(one.ship, name, value) for name, value in changes])
    columns = {name: np.full(len(changes), value) for name, value in base.items()}
    for i, (name, value) in enumerate(changes):
        columns[name][i] = value

    def told(done: int, _: Counter[str]) -> None:
        if progress is not None:
            progress(done, int(possible.sum()))  # the search for flips comes after

    with warnings.catch_warnings():  # these are many ships far from the one asked about
        warnings.simplefilter("ignore", RangeWarning)
        ds = evaluated(replace(one, loadings={name: column[possible] for name, column in columns.items()}), told=told)
    out: dict[str, NDArray[np.generic]] = {name: np.full(len(changes), np.nan) for name in MEASURES}
    out["verdict"] = np.full(len(changes), -1, np.int8)
    for name, values in out.items():
        values[possible] = ds[name].values.ravel()
    return out


def _possible(ship: Ship, name: str, value: float) -> bool:
    try:
        loaded(ship, {name: value})
    except InputError:
        return False
    return True


def _nearest_flip(
    one: Grid, own: Mapping[str, float], name: str, values: Floats, verdicts: NDArray[np.generic]
) -> tuple[float, int]:
    """The value nearest to the present one, in ratio, at which the verdict flips, and the verdict beyond it."""

    def at(inner: Floats) -> NDArray[np.int8]:
        return np.asarray(_judged(one, own, [(name, float(value)) for value in inner])["verdict"], np.int8)

    found = []
    for side in (slice(_STEPS, None), slice(_STEPS, None, -1)):
        kinds = verdicts[side].astype(int)
        steps = np.flatnonzero(np.diff(np.sign(kinds)))
        if steps.size:
            i = int(steps[0])
            found += refined_flips(at, values[side][i : i + 2], kinds[i : i + 2])
    if not found:
        return float("nan"), int(verdicts[_STEPS])
    value, _, beyond = min(found, key=lambda flip: abs(np.log(flip[0] / own[name])))
    return value, beyond


def _dataset(
    about: Mapping[str, object],
    own: Mapping[str, float],
    change: float,
    sides: Mapping[str, NDArray[np.generic]],
    flips: Sequence[tuple[float, int]],
    base: Mapping[str, np.generic],
) -> xr.Dataset:
    data = {name: (("parameter", "side"), values, attributes(name)) for name, values in sides.items()}
    columns = {
        "value": (np.array(list(own.values())), {"long_name": "value now; 1 for a coefficient"}),
        "unit": (np.array([str(attributes(name)["units"]) for name in own]), {"long_name": "unit of the value"}),
        "flip": (np.array([value for value, _ in flips]), {"long_name": "nearest value at which the verdict flips"}),
        "verdict_beyond": (np.array([kind for _, kind in flips], np.int8), attributes("verdict")),
    }
    return xr.Dataset(
        data | {name: ("parameter", values, attrs) for name, (values, attrs) in columns.items()},
        {"parameter": list(own), "side": ["less", "more"]},
        dict(about) | {"change": change} | {f"base_{name}": value.item() for name, value in base.items()},
    )


def _sorted(ds: xr.Dataset) -> xr.Dataset:
    """Largest effect first: of the three measures the one that changes most, each against the largest of its kind."""
    effects = []
    for name in MEASURES:
        effect = np.nan_to_num(np.abs(ds[name] - ds.attrs[f"base_{name}"])).max(axis=1)
        effects.append(effect / (effect.max() or 1.0))
    return ds.isel(parameter=np.argsort(-np.max(effects, axis=0), kind="stable"))
