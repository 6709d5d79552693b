"""The equations of a ship over the wave cells of a sea at one speed: what all cells share, and what each has of its own."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import GRAVITY, InputError
from quartering.hull.autopilot import Autopilot
from quartering.hull.ship import Ship
from quartering.hydro.coefficient_table import Coefficients
from quartering.hydro.coefficients import coefficients
from quartering.hydro.manoeuvring.crossflow import reference_velocity
from quartering.loads.forces import Form
from quartering.loads.lift import ship_lift_phasors, ship_water_velocity
from quartering.loads.sea.cells import Cells
from quartering.loads.sea.forces import cell_forces
from quartering.loads.waves import folded, least_encounter_frequency
from quartering.motion.drag_of_ship import drag_strips
from quartering.motion.equations.model import Model
from quartering.motion.equations.system import restoring_table
from quartering.motion.equations.terms import term_table
from quartering.motion.equations.water import Strips, relative_terms
from quartering.motion.of_ship import nonlinear_terms
from quartering.names import CUBIC_NAMES, DRAG_NAME, RUDDER_NAMES
from quartering.option_checks import quoted

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]
Force = Callable[[Floats, Floats], ArrayLike]
"""Of a `Model`: frequencies (n,) [rad/s] and headings (n,) [deg] -> force (n, 3) per metre, as phasors of e^{i omega t}."""


@dataclass(frozen=True, eq=False)
class Terms:
    """Everything on the right that is alike in all cells of one speed, as forces.

    Parameters
    ----------
    powers : (t, 4 + e) int      of v, phi, p, r and of the e variables that the water's motion enters
    modulus : (t,) int           variable (from 1) between modulus bars, 0 for none
    coefficients : (3, t)        of the products [N, N m]
    extra : (e,) int             state that each further variable is the relative velocity of
    knots, cubics : (b,), (b, 4) of the restoring moment beyond its slope at 0 [N m]
    forms : (z, 3), drag : (z,)  1, -h, x of each strip, and c = (1/2) rho C_D T dx [kg/m]
    mean : (3,)                  steady force [N, N m]
    matched : (3, t), float      of cubic drag whose reference velocity follows the motion: its part of the coefficients, and
                                 the velocity they are made at [m/s]; the strips then serve to match it and do not push
    """

    powers: NDArray[np.int64]
    modulus: NDArray[np.int64]
    coefficients: Floats
    extra: NDArray[np.int64]
    knots: Floats
    cubics: Floats
    forms: Floats
    drag: Floats
    mean: Floats
    matched: tuple[Floats, float] | None = None

    @property
    def biased(self) -> bool:
        """May the mean of the motion differ from zero?"""
        return bool(self.mean.any() or (self.powers.sum(axis=1) % 2 == 0).any())


@dataclass(frozen=True, eq=False)
class SeaEquations:
    """Equations of one ship at one speed in the cells of a sea, per metre of amplitude in each.

    Parameters
    ----------
    cells : Cells
    inertia : (c or 1, 3, 3)    by cell, or one for all
    linear : (c or 1, 3, 4)     linear forces by v, phi, p, r
    force : (c, 3) complex      per metre, phasors of e^{i |omega| t} as everything over cells
    inputs : (c, e) complex     -w0, -w1 that the further variables hold
    water : (c, 2, z)           the water's velocity at the strips, real and imaginary part
    terms : Terms
    at_roll : (3, 3), (3, 4)    inertia and linear forces at the frequency of free roll
    roll_frequency : float      of free roll, w2 [rad/s]
    rudder : (3,), autopilot    forces per radian of rudder, and what moves it
    least : float               encounter frequency below which coefficients are those of it [rad/s]
    """

    cells: Cells
    inertia: Floats
    linear: Floats
    force: Complex
    inputs: Complex
    water: Floats
    terms: Terms
    at_roll: tuple[Floats, Floats]
    roll_frequency: float
    rudder: Floats = field(default_factory=lambda: np.zeros(3))
    autopilot: Autopilot | None = None
    least: float = 0.0

    @cached_property
    def frequency(self) -> Floats:
        """|omega| of each cell, at least `least` [rad/s]."""
        return np.maximum(np.abs(self.cells.omega), self.least)

    @cached_property
    def steering(self) -> Complex:
        """Force (c, 3) the rudder answers a unit rate of turn with; (0, 3) without an autopilot."""
        pilot, iw = self.autopilot, 1j * np.maximum(self.frequency, 1e-6)
        if pilot is None:
            return np.zeros((0, 3), dtype=complex)
        angle = -(pilot.gain / iw + pilot.rate_gain) / (1.0 + iw * pilot.lag)
        return np.asarray(angle[:, None] * self.rudder)


def roll_mode_of(inertia: Floats, linear: Floats) -> tuple[float, float, float]:
    """Frequency and damping ratio of free roll, and the rate of the slowest other mode, of a linear ship.

    inertia, linear (3, 3)
    Returns frequency: |lambda| of the pair that oscillates [rad/s]; without one sqrt of stiffness over inertia;
        damping: -Re lambda/|lambda|; slow: least |Re| of the others [1/s]

    >>> linear = np.array([[-1.0, 0, 0, 0], [0, -4.0, -0.4, 0], [0, 0, 0, -0.5]])
    >>> [round(one, 3) for one in roll_mode_of(np.eye(3), linear)]
    [2.0, 0.1, 0.5]
    """
    matrix = np.zeros((4, 4))
    matrix[[0, 2, 3]] = np.linalg.solve(inertia, linear)
    matrix[1, 2] = 1.0
    values, vectors = np.linalg.eig(matrix)
    share = np.abs(vectors[1]) / np.linalg.norm(vectors[[0, 1, 3]], axis=0) * (values.imag > 1e-9)
    if not share.any():
        return float(np.sqrt(abs(matrix[2, 1]))), 0.05, float(np.abs(values.real).min())
    k = int(share.argmax())
    others = np.abs(values.real[np.abs(np.abs(values.imag) - values.imag[k]) > 1e-12 * abs(values[k])])
    return float(abs(values[k])), float(-values.real[k] / abs(values[k])), float(others.min(initial=np.inf))


def angle_of_largest_arm(equations: SeaEquations) -> float:
    """Heel of the largest righting moment, 90 deg at most [rad]: beyond it a larger roll meets a smaller moment."""
    phi = np.linspace(0.0, 0.5 * np.pi, 901)
    terms = equations.terms
    moment = equations.at_roll[1][1, 1] * phi
    alone = (np.delete(terms.powers, 1, axis=1) == 0).all(axis=1) & np.isin(terms.modulus, (0, 2))
    for t in np.flatnonzero(alone):
        moment = moment + terms.coefficients[1, t] * phi ** (terms.powers[t, 1] + (terms.modulus[t] == 2))
    if terms.knots.size:
        b = np.searchsorted(terms.knots, phi, side="right") - 1
        x = phi - terms.knots[b]
        moment = moment + (terms.cubics[b] * x[:, None] ** np.arange(4)).sum(axis=1)
    falls = np.flatnonzero(np.diff(-moment) < 0)
    return float(phi[falls[0]] if falls.size else phi[-1])


def free_roll_of(ship: Ship | Model, speed: float) -> tuple[float, float]:
    """Natural frequency [rad/s] and damping ratio of small free roll, all linear terms in."""
    if isinstance(ship, Model):
        named = {name: value for name, value in ship.terms.items() if name not in RUDDER_NAMES}
        return roll_mode_of(np.array(ship.inertia), _table(named, ship.restoring, False)[0])[:2]
    frequency = coefficients(ship, 0.0, speed).roll_frequency
    c = coefficients(ship, frequency, speed)
    linear = _with_roll(c.linear)[0] + _table(nonlinear_terms(c), c.righting, False)[0]
    return frequency, roll_mode_of(c.inertia[0], linear)[1]


def _table(named: dict[str, float], restoring: Any, relative: bool) -> tuple[Floats, dict[str, Any]]:
    """Linear forces (3, 4) of terms, and the arrays of `Terms` for the rest."""
    table = term_table(named)
    extra = np.empty(0, dtype=np.int64)
    if relative:
        table, extra = relative_terms(table)
    linear = table.linear.copy()
    knots, cubics = np.zeros(0), np.zeros((0, 4))
    if restoring is not None:
        linear[1, 1] += restoring.slope
        knots, cubics = restoring_table(restoring)
    return linear, {
        "powers": np.ascontiguousarray(table.powers),
        "modulus": table.modulus,
        "coefficients": np.ascontiguousarray(table.coefficients),
        "extra": extra,
        "knots": np.ascontiguousarray(knots),
        "cubics": np.ascontiguousarray(cubics),
    }


def _strips(strips: Strips | None, count: int) -> tuple[dict[str, Any], Floats]:
    if strips is None:
        return {"forms": np.zeros((0, 3)), "drag": np.zeros(0)}, np.zeros((count, 2, 0))
    forms = np.stack([np.ones_like(strips.x), -strips.lever, strips.x], axis=1)
    water = np.broadcast_to(strips.water, (count, strips.x.size))
    return {"forms": forms, "drag": strips.c.copy()}, np.ascontiguousarray(np.stack([water.real, water.imag], axis=1))


def equations_of_ship(ship: Ship, cells: Cells, form: Form = "stf") -> SeaEquations:
    """Equations of a ship in the cells of a sea: coefficients at each encounter frequency, forces of each wave.

    form: of the diffraction force

    >>> from quartering.hull.file.read import ship
    >>> from quartering.loads.sea.cells import wave_cells
    >>> from quartering.loads.sea.sea import Sea
    >>> cells = wave_cells([Sea(hs=3, tp=9, heading=60)], 5.0, 0.5, 0.1)
    >>> equations_of_ship(ship("wigley"), cells).force.shape == (cells.sigma.size, 3)
    True
    """
    sigma, mu = cells.flat
    k, U = sigma**2 / GRAVITY, np.full(sigma.shape, cells.speed)
    force, omega = cell_forces(ship, cells, form), cells.omega
    least = float(least_encounter_frequency(ship.hull.length))
    c = coefficients(ship, np.maximum(np.abs(omega), least), U)
    if form != "paper":
        force = force + ship_lift_phasors(ship, c, k, U, mu)
    still = ship.velocities == "absolute" or form == "paper"
    shared, parts = _table(nonlinear_terms(c), c.righting, not still)
    inputs = np.zeros((sigma.size, 0), dtype=complex)
    if not still:
        inputs = -np.stack(ship_water_velocity(ship, k, U, mu), axis=1)
    matched = None if still else _matched_cubics(ship, c)
    strips = drag_strips(ship, k, U, mu) if DRAG_NAME in c.terms or matched is not None else None
    if strips is not None and still:
        strips = Strips(strips.x, strips.lever, strips.c, 0.0 * strips.water)
    more, water = _strips(strips, sigma.size)
    at = coefficients(ship, c.roll_frequency, cells.speed)
    return SeaEquations(
        cells=cells,
        inertia=np.ascontiguousarray(c.inertia),
        linear=_with_roll(c.linear) + shared,
        force=np.ascontiguousarray(force),
        inputs=np.ascontiguousarray(inputs),
        water=water,
        terms=Terms(**parts, **more, mean=np.zeros(3), matched=matched),
        at_roll=(at.inertia[0], _with_roll(at.linear)[0] + shared),
        roll_frequency=c.roll_frequency,
        rudder=np.zeros(3) if c.rudder is None else c.rudder[0],
        autopilot=None if c.rudder is None else ship.autopilot,
        least=least,
    )


def _matched_cubics(ship: Ship, c: Coefficients) -> tuple[Floats, float] | None:
    """The part of the products that is cubic drag with a reference velocity of the motion; None where it has none."""
    named = nonlinear_terms(c)
    cubic = {name for row in CUBIC_NAMES for name in row if name in c.terms and c.terms[name].kind == "cross-flow"}
    if ship.velocity_scale is not None or not cubic & named.keys():
        return None
    table = term_table({name: value if name in cubic else 0.0 for name, value in named.items()})
    return np.ascontiguousarray(table.coefficients), reference_velocity(ship.hull.length)


def _with_roll(linear: Floats) -> Floats:
    """Velocity derivatives (n, 3, 3) with a column of zeros for the roll angle."""
    return np.concatenate([linear[:, :, :1], np.zeros((len(linear), 3, 1)), linear[:, :, 1:]], axis=2)


def equations_of_model(model: Model, cells: Cells, force: Force) -> SeaEquations:
    """Equations given by numbers in the cells of a sea, coefficients alike in all.

    model: its regular wave is left out
    force: frequencies (n,) [rad/s], headings (n,) [deg] -> (n, 3 + m) complex: force per metre, then of a model with
        water in motion w0, w1 and the velocity at each strip, as `irregular` takes them; phasors of e^{i omega t} with
        the signed omega
    """
    sigma, mu = cells.flat
    relative, z = model.water is not None, 0 if model.strips is None else model.strips.x.size
    width = 3 + 2 * relative + z
    if not callable(force):
        raise InputError(
            f"force = {quoted(force)}; of a model it is a function of frequencies [rad/s] and headings [deg], (n,) each, that"
            " gives the complex force per metre (n, 3) [N/m, N m/m]"
        )
    given = np.asarray(force(sigma, mu), dtype=complex)
    if given.shape != (sigma.size, width) or not np.isfinite(given).all():
        more = f": three forces, {'w0, w1, ' if relative else ''}{f'{z} velocities at the strips' if z else ''}"
        raise InputError(
            f"force gives {given.shape} for {sigma.size} frequencies; it must give finite numbers ({sigma.size}, {width})"
            + (more.rstrip(", ") if width > 3 else "")
        )
    given = folded(cells.omega, given)[1]
    named = {name: value for name, value in model.terms.items() if name not in RUDDER_NAMES}
    linear, parts = _table(named, model.restoring, relative)
    strips = (
        None
        if model.strips is None
        else Strips(model.strips.x, model.strips.lever, model.strips.c, given[:, width - z :])
    )
    more_parts, water = _strips(strips, sigma.size)
    return SeaEquations(
        cells=cells,
        inertia=np.array(model.inertia)[None],
        linear=linear[None],
        force=np.ascontiguousarray(given[:, :3]),
        inputs=np.ascontiguousarray(-given[:, 3 : 3 + 2 * relative]),
        water=water,
        terms=Terms(**parts, **more_parts, mean=np.array(model.force_mean)),
        at_roll=(np.array(model.inertia), linear),
        roll_frequency=roll_mode_of(np.array(model.inertia), linear)[0],
        rudder=np.array([model.terms.get(name, 0.0) for name in RUDDER_NAMES]),
        autopilot=model.autopilot,
    )
