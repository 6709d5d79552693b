"""How response and stability change with every coefficient and every value a designer can set: exact derivatives."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
import xarray as xr

from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.ship import Ship
from quartering.hull.told import condition
from quartering.loads.lift import ship_water_velocity
from quartering.loads.waves import Wave
from quartering.motion.equations.batch import joined
from quartering.motion.equations.model import Model
from quartering.motion.equations.system import PER_CONDITION, Floats, System
from quartering.motion.of_ship import ShipSystem, equations, ship_system
from quartering.motion.steady.derivative import OFFSETS, change_of_motion, difference
from quartering.motion.steady.harmonic import checked_harmonics, harmonic_balance, orders_for
from quartering.names import unit
from quartering.stability.assessment import assess
from quartering.stability.derivative import change_of_stability
from quartering.stability.variational.floquet import fastest_rate
from quartering.stability.variational.variation import variational_harmonics
from quartering.study.loading_systems import systems
from quartering.study.loadings import loaded

_LOADING = {"gm": "m", "gyradius_roll": "m", "gyradius_yaw": "m", "roll_damping": "1"}
_EXACT = "exact"
_DIFFERENCED = "exact; of the equations' coefficients, differences"
_STEP = 1e-4
_FACTORS = 1 + _STEP * OFFSETS
_COLUMNS = {
    "sway": ("m", "sway amplitude"),
    "roll": ("deg", "roll amplitude"),
    "yaw": ("deg", "yaw amplitude"),
    "k2": ("1/s2", "K2"),
    "index": ("1/s", "stability index S"),
    "exponent": ("1/s", "leading Floquet exponent"),
}


class Row(NamedTuple):
    """One parameter: name, unit, value, and the derivative of the equations by its relative change."""

    name: str
    unit: str
    value: float
    change: System
    method: str


@takes(ship="Ship", wave="Wave")
def sensitivity(ship: Ship, wave: Wave, speed: float | str, heading: float | str, *, harmonics: int = 3) -> xr.Dataset:
    """Derivatives of amplitudes, K2, index and leading Floquet exponent by every coefficient and design value.

    Parameters
    ----------
    ship : Ship
    wave : Wave
    speed : float        [m/s]
    heading : float      [deg]
    harmonics : int      of the steady motion, odd, at least 3

    Returns
    -------
    xarray.Dataset       over ``parameter``: value, unit, method, and ``sway`` [m], ``roll``, ``yaw`` [deg], ``k2`` [1/s2],
                         ``index`` [1/s], ``exponent`` [1/s] per relative change of the parameter (theta d/d theta);
                         attributes hold the base values and, where the exponent has no derivative, the reason

    Raises
    ------
    InputError           no motion to start from, fewer than 3 harmonics, what `equations` refuses

    Notes
    -----
    Exact by implicit differentiation: of the motion, then along it of the variational equations.  By the coefficients on
    the right (and the wave height) there is no other step.  By loading and speed, the coefficients of the equations
    themselves are differenced (fourth order, relative step 1e-4), since they come from tables; then the chain is exact.
    KG = KM - GM, so the derivatives by KG and GM are in the ratio -KG/GM.  At a fold they grow without bound; NaN where
    the two leading multipliers meet, and for K2 where first-order theory has no roll mode.  Beside a modulus or a spline,
    K2 is differentiated as a mean over the whole cycle, to 1e-6; its value is a mean over samples, whose own slope is off
    by some 1e-3.
    Source: [H71] Fig. 22 (K2 against the percentage change of each coefficient); implicit function theorem, closed form.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> ds = sensitivity(ship("wigley"), Wave(length=100.0, height=1.0), speed=5.0, heading=60.0)
    >>> bool(ds["roll"].sel(parameter="wave_height") > 0)
    True
    """
    speed, heading = condition(ship, speed, heading)
    if checked_harmonics(harmonics) < 3:
        raise InputError(f"harmonics={harmonics}: sensitivities are of harmonic balance; give 3, 5, 7, ...")
    model = equations(ship, wave, speed, heading)
    orders = orders_for(model.system, harmonics)
    u, _, _ = harmonic_balance(model.system, orders, from_rest=True)
    if not np.isfinite(u).all():
        raise InputError("no periodic motion in this condition, so nothing to differentiate; try a lower wave")
    water = None if ship.velocities == "absolute" else _water(ship, wave, speed, heading)
    rows = coefficient_rows(model, water) + _design_rows(ship, wave, speed, heading, model)
    here, slopes, why = derivatives(model.system, [row.change for row in rows], u[0], orders)
    attributes: dict[str, object] = {f"base_{name}": float(here[i]) for i, name in enumerate(_COLUMNS)}
    attributes |= {"ship": ship.name, "references": ", ".join(model.references)}
    if why:
        attributes["no_exponent"] = why
    return _table(rows, slopes).assign_attrs(attributes)


def _table(rows: list[Row], slopes: Floats) -> xr.Dataset:
    """Parameters and derivatives (m, 6), labelled."""
    data = {
        name: (
            "parameter",
            slopes[:, i],
            {"units": u, "long_name": f"change of {text} per relative change of the parameter"},
        )
        for i, (name, (u, text)) in enumerate(_COLUMNS.items())
    }
    about = {
        "value": "value of the parameter, in its own unit",
        "unit": "unit of the parameter",
        "method": "how the derivatives were found",
    }
    data |= {
        name: ("parameter", np.array([getattr(row, name) for row in rows]), {"long_name": text})
        for name, text in about.items()
    }
    return xr.Dataset(data, {"parameter": np.array([row.name for row in rows])})


def derivatives(
    system: System, changes: list[System], u: Floats, orders: tuple[int, ...]
) -> tuple[Floats, Floats, str]:
    """Amplitudes, K2, index and exponent of one motion, and their derivatives by m parameters of its equations.

    system: one condition
    changes: derivative of its arrays by each parameter
    u (3, b): the motion, from `harmonic_balance`
    orders: its harmonics
    Returns here (6,): sway [m], roll, yaw [deg], K2 [1/s2], index, exponent [1/s]; slopes (m, 6); why: why the exponent
        has no derivative; empty where it has

    Source: `change_of_motion`, `change_of_stability`.
    """
    whole = joined([system, *changes])
    one, change = whole.each(lambda array: array[:1]), whole.each(lambda array: array[1:])
    judged = assess(one, u[None], orders, accuracy=1e-11)
    du = change_of_motion(one, change, u, orders)
    rate = fastest_rate(variational_harmonics(one, u[None], orders), judged.first_order.mean_jacobian)
    stability = change_of_stability(one, change, u, du, orders, float(rate[0]))
    first = 1 if orders[0] == 0 else 0
    cos, sin = u[:, first], u[:, first + 1]
    amplitude = np.hypot(cos, sin)
    # a mode at rest, as in a head sea, stays at rest
    growth = (cos * du[:, :, first] + sin * du[:, :, first + 1]) / np.where(amplitude > 0, amplitude, 1.0)
    scale = np.array([1.0, 180 / np.pi, 180 / np.pi])
    f = judged.first_order
    here = np.concatenate([scale * amplitude, f.k2, f.index, judged.floquet.growth])
    slopes = np.column_stack([scale * growth, stability.k2, stability.index, stability.exponent])
    return here, slopes, stability.why


def coefficient_rows(model: Model, water: Mapping[str, complex] | None = None) -> list[Row]:
    """Every term of a model that is not zero: the equations are linear in each.

    water: velocity of the water beside v and r, phasors of e^{i omega t} [m/s, rad/s]: a change of lift acts on the
        velocity relative to it
    """
    rows = []
    for name, value in model.terms.items():
        if value != 0.0:
            row, _, factor = name.partition("_")
            force = -value * (water or {}).get(factor, 0j) * np.eye(3)["YKN".index(row)]
            alone = Model(
                model.inertia,
                {name: value},
                model.frequency,
                force.real,
                -force.imag,
                autopilot=model.autopilot,
                water=model.water,
            ).system
            linear = alone.linear.copy()
            linear[:, 3:] = 0.0  # the rudder's own equation is the autopilot's
            change = replace(alone, linear=linear, frequency=np.zeros(1), inputs=np.zeros_like(alone.inputs))
            rows.append(Row(name, unit(name), value, change, _EXACT))
    return rows


def _water(ship: Ship, wave: Wave, speed: float, heading: float) -> dict[str, complex]:
    """Velocity of the water beside sway and yaw of a ship."""
    w0, w1 = ship_water_velocity(ship, wave.wavenumber, speed, heading)
    return {"v": wave.amplitude * complex(w0[0]), "r": wave.amplitude * complex(w1[0])}


def _design_rows(ship: Ship, wave: Wave, speed: float, heading: float, model: Model) -> list[Row]:
    """Loading, speed and wave height; a value of zero has no relative change."""
    loading = {name: getattr(ship.loading, name) for name in _LOADING if getattr(ship.loading, name) != 0.0}
    ships = [loaded(ship, {name: value * factor}) for name, value in loading.items() for factor in _FACTORS]
    k, u, mu = (np.array([one]) for one in (wave.wavenumber, float(speed), float(heading)))
    solved = list(systems(ships, k, u, mu))
    rows = []
    for i, (name, value) in enumerate(loading.items()):
        change = _differenced(solved[OFFSETS.size * i : OFFSETS.size * (i + 1)], wave.amplitude)
        rows.append(Row(name, _LOADING[name], value, change, _DIFFERENCED))
        if name == "gm":
            by_kg = change.each(partial(np.multiply, -ship.loading.kg / value))
            rows.append(Row("kg", "m", ship.loading.kg, by_kg, _DIFFERENCED))
    if speed > 0.0:
        four = np.ones(OFFSETS.size)
        change = _differenced([ship_system(ship, k * four, u * _FACTORS, mu * four)], wave.amplitude)
        rows.append(Row("speed", "m/s", float(speed), change, _DIFFERENCED))
    twice, once = model.system.raised(np.array([2.0])), model.system.raised(np.array([1.0]))
    change = replace(once, **{name: getattr(twice, name) - getattr(once, name) for name in PER_CONDITION})
    rows.append(Row("wave_height", "m", wave.height, change, _EXACT))
    return rows


def _differenced(around: list[ShipSystem], amplitude: float) -> System:
    """Derivative of the equations by the relative change of a parameter, from those at the four offsets."""
    whole = joined([one.at_amplitude(np.full((one.system.count, 1), amplitude)) for one in around])
    return whole.each(lambda array: difference(array, _STEP)[None])
