"""How response and stability change with every coefficient and every value a designer can set."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import xarray as xr

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.loads.waves import Wave
from quartering.motion.batch import joined
from quartering.motion.equations import Floats, Model, System
from quartering.motion.harmonic import harmonic_balance, orders_for
from quartering.motion.of_ship import equations
from quartering.names import unit
from quartering.stability.assessment import assess
from quartering.study.grid import loaded

_STEP = 1e-3
_OFFSETS = np.array([-2.0, -1.0, 1.0, 2.0])
_WEIGHTS = np.array([1.0, -8.0, 8.0, -1.0]) / 12.0
_DESIGN = {
    "gm": ("m", "metacentric height"),
    "gyradius_roll": ("m", "radius of gyration in roll"),
    "gyradius_yaw": ("m", "radius of gyration in yaw"),
    "roll_damping": ("1", "added roll damping, fraction of critical"),
    "speed": ("m/s", "forward speed"),
    "wave_height": ("m", "wave height"),
}


def sensitivity(ship: Ship, wave: Wave, speed: float, heading: float, *, harmonics: int = 3) -> xr.Dataset:
    """Derivatives of roll amplitude, K2 and the leading Floquet exponent by every coefficient and design value.

    Parameters
    ----------
    ship : Ship
    wave : Wave
    speed : float        [m/s]
    heading : float      [deg]
    harmonics : int      of the steady motion, odd, at least 3

    Returns
    -------
    xarray.Dataset       over ``parameter``: value, unit, and ``roll`` [deg], ``k2`` [1/s2], ``exponent`` [1/s] per relative
                         change of the parameter (theta d/d theta); attributes hold the base values

    Raises
    ------
    InputError           no motion to start from, fewer than 3 harmonics, what `equations` refuses

    Notes
    -----
    Fourth-order central differences of the converged solution (relative step 1e-3, error below 1e-8 of the value); each
    neighbouring solution starts from the base motion, so all belong to one branch.  Singular at a fold.
    Source: [H71] Fig. 22 (K2 against the percentage change of each coefficient).

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> ds = sensitivity(ship("wigley"), Wave(length=100.0, height=1.0), speed=5.0, heading=60.0)
    >>> bool(ds["roll"].sel(parameter="wave_height") > 0)
    True
    """
    if harmonics < 3:
        raise InputError(f"harmonics={harmonics}: sensitivities are of harmonic balance; give 3, 5, 7, ...")
    model = equations(ship, wave, speed, heading)
    orders = orders_for(model.system, harmonics)
    base, _, _ = harmonic_balance(model.system, orders, from_rest=True)
    if not np.isfinite(base).all():
        raise InputError("no periodic motion in this condition, so nothing to differentiate; try a lower wave")
    names, units, values, systems = _neighbours(ship, wave, speed, heading, model)
    found = _measures(joined(systems), orders, np.repeat(base, len(systems), axis=0))
    slopes = np.einsum("o,pom->pm", _WEIGHTS, found.reshape(len(names), _OFFSETS.size, 3)) / _STEP
    here = _measures(model.system, orders, base)[0]
    columns = {"roll": ("deg", "roll amplitude"), "k2": ("1/s2", "K2"), "exponent": ("1/s", "leading Floquet exponent")}
    data = {
        name: (
            "parameter",
            slopes[:, i],
            {"units": u, "long_name": f"change of {text} per relative change of the parameter"},
        )
        for i, (name, (u, text)) in enumerate(columns.items())
    }
    data["value"] = ("parameter", np.array(values), {"long_name": "value of the parameter, in its own unit"})
    data["unit"] = ("parameter", np.array(units), {"long_name": "unit of the parameter"})
    attributes: dict[str, object] = {f"base_{name}": float(here[i]) for i, name in enumerate(columns)}
    attributes |= {"ship": ship.name, "references": ", ".join(model.references)}
    return xr.Dataset(data, {"parameter": np.array(names)}, attributes)


def _neighbours(
    ship: Ship, wave: Wave, speed: float, heading: float, model: Model
) -> tuple[list[str], list[str], list[float], list[System]]:
    """Parameters, and for each the systems at the four offsets in turn."""
    names, units, values, systems = [], [], [], []
    for name, value in model.terms.items():
        if value == 0.0:
            continue
        names.append(name)
        units.append(unit(name))
        values.append(value)
        for offset in _OFFSETS:
            changed = dict(model.terms) | {name: value * (1 + _STEP * offset)}
            systems.append(replace(model, terms=changed).system)
    here = {key: getattr(ship.loading, key) for key in ("gm", "gyradius_roll", "gyradius_yaw", "roll_damping")}
    here |= {"speed": float(speed), "wave_height": wave.height}
    for name, value in here.items():
        if value == 0.0:
            continue
        names.append(name)
        units.append(_DESIGN[name][0])
        values.append(value)
        for offset in _OFFSETS:
            other = value * (1 + _STEP * offset)
            at_speed = other if name == "speed" else speed
            at_wave = Wave(wave.length, other) if name == "wave_height" else wave
            changed_ship = ship if name in ("speed", "wave_height") else loaded(ship, {name: other})
            systems.append(equations(changed_ship, at_wave, at_speed, heading).system)
    return names, units, values, systems


def _measures(system: System, orders: tuple[int, ...], start: Floats) -> Floats:
    """Roll amplitude [deg], K2 [1/s2] and leading exponent [1/s] (n, 3) of the motions nearest to `start`."""
    u, _, _ = harmonic_balance(system, orders, start=start)
    result = assess(system, u, orders, accuracy=1e-11)
    roll = np.degrees(np.hypot(u[:, 1, -2 * _waves(orders)], u[:, 1, 1 - 2 * _waves(orders)]))
    return np.column_stack([roll, result.first_order.k2, result.floquet.growth])


def _waves(orders: tuple[int, ...]) -> int:
    """Number of harmonics without the mean: the fundamental's columns stand that many pairs from the end."""
    return sum(h > 0 for h in orders)
