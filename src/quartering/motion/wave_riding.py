"""A ship that a wave carries along: equations in body axes on the wave, equilibria, their stability, and branches of them.

The wave runs along X with celerity c; the ship heads psi off its direction. With xi the distance of G from a trough,

    (m + m_x) du/dt = T(u; n) - R(u) + X_w + m v r
    M d(v, p, r)/dt = L(u) (v - w0, p, r - w1) + drag of the strips + (Y, K, N)_w + rudder
    d(xi)/dt = u cos psi - v sin psi - c ,   d(phi)/dt = p ,   d(psi)/dt = r

X_w .. N_w are the pressure over the instantaneous wetted hull, heave and trim balanced at every instant, since the ship meets
the wave with a frequency near zero. M has the added mass of no frequency, where wave damping and diffraction are nil. Lift and
drag act on the velocity relative to the orbital motion of the water, which across the ship is -sin(psi) times that along X.
The rudder turns to -gain (psi - ordered) - rate_gain r.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import GRAVITY
from quartering.hull.autopilot import Autopilot
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.propulsion import Propulsion
from quartering.hull.ship import Ship
from quartering.hydro.coefficients import coefficients
from quartering.hydro.strip.surge import spheroid_surge
from quartering.loads.waves import Wave
from quartering.loads.wetted_hull.frozen import Frozen, frozen
from quartering.loads.wetted_hull.pressure import Waves
from quartering.motion.drag_of_ship import drag_strips
from quartering.motion.equations.terms import parse
from quartering.motion.equations.water import Strips
from quartering.motion.steady_course.course import of_roll_alone
from quartering.names import DRAG_NAME

Floats = NDArray[np.float64]

STATES: Final = ("u", "v", "p", "r", "place", "roll", "yaw", "rudder")
"""Velocities [m/s, rad/s]; k xi from a trough, heel and heading off the wave's direction [rad]; the rudder only with a lag."""
U, V, P, R, PLACE, ROLL, YAW, RUDDER = range(8)
_SPEEDS: Final = np.array([0.8, 1.0, 1.25])
"""Speeds over the celerity at which the coefficients are held; between them they are a parabola, which lift and rudder are."""
_SMALL: Final = np.array([1e-3, 1e-3, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4])
"""Steps of the derivatives."""


class Rider:
    """Equations of a ship on one wave; gains of an autopilot of 0: the rudder amidships."""

    def __init__(self, ship: Ship, wave: Wave, propulsion: Propulsion, pilot: Autopilot | None) -> None:
        self.ship: Ship = ship
        self.wave: Wave = wave
        self.propulsion: Propulsion = propulsion
        self.gain: float = 0.0 if pilot is None else pilot.gain
        self.rate_gain: float = 0.0 if pilot is None else pilot.rate_gain
        self.lag: float = 0.0 if pilot is None else pilot.lag
        steered = ship if ship.autopilot is not None else ship.with_(autopilot=Autopilot(1.0))
        held = coefficients(steered, np.zeros(3), _SPEEDS * self.celerity)
        assert held.rudder is not None  # every ship with an autopilot has one
        water = hydrostatics(ship)
        self._linear, self._lift, self._rudder = held.linear, held.relative, held.rudder
        self._heel, self._inverse = held.relative_heel[1], np.linalg.inv(held.inertia[1])
        self._mass, self._surge = water.mass, water.mass * (1 + spheroid_surge(ship.hull.length, water.volume))
        self._along = np.linspace(-0.5, 0.5, 41) * ship.hull.length - water.lcb
        self._products = [
            (parse(name), float(value[1])) for name, value in held.nonlinear.items() if not of_roll_alone(name)
        ]
        one = (np.array([v]) for v in (wave.wavenumber, self.celerity, 90.0))
        self._strips: Strips | None = drag_strips(ship, *one) if DRAG_NAME in held.terms else None

    @property
    def celerity(self) -> float:
        """Of the wave [m/s]."""
        return math.sqrt(GRAVITY / self.wave.wavenumber)

    @property
    def states(self) -> int:
        """Numbers of a state."""
        return 8 if self.lag > 0 else 7

    def _at_speed(self, held: Floats, u: Floats) -> Floats:
        """What is held at three speeds, at speeds (n,)."""
        s, (a, b, c) = u / self.celerity, _SPEEDS
        share = (
            (s - b) * (s - c) / ((a - b) * (a - c)),
            (s - a) * (s - c) / ((b - a) * (b - c)),
            (s - a) * (s - b) / ((c - a) * (c - b)),
        )
        return np.asarray(sum(np.multiply.outer(w, part) for w, part in zip(share, held, strict=True)))

    def water(self, place: Floats, yaw: Floats, x: Floats, depth: Floats | float) -> Floats:
        """Velocity of the water across the ship (n, x) at points x forward of G and at a depth [m/s].

        Along the wave the water moves with -a sigma e^{-kd} cos(k xi'), xi' from a trough.
        """
        k, a = self.wave.wavenumber, self.wave.amplitude
        along = place[:, None] + k * x * np.cos(yaw)[:, None]
        return np.asarray(np.sin(yaw)[:, None] * a * math.sqrt(GRAVITY * k) * np.exp(-k * depth) * np.cos(along))

    def lateral_water(self, place: Floats, yaw: Floats) -> tuple[Floats, Floats]:
        """Straight line through the velocity of the water across the ship at half the draught: at G, and its slope (n,)."""
        if self.ship.velocities == "absolute":
            return np.zeros_like(place), np.zeros_like(place)
        x = self._along
        w = self.water(place, yaw, x, 0.5 * self.ship.hull.draught)
        middle = x.mean()
        weight = np.ones_like(x)
        weight[[0, -1]] = 0.5  # trapezoids
        slope = (w * weight * (x - middle)).sum(axis=1) / (weight * (x - middle) ** 2).sum()
        return (w * weight).sum(axis=1) / weight.sum() - middle * slope, slope

    def loads(self, place: Floats, roll: Floats, yaw: Floats, start: Floats | None = None) -> Frozen:
        """The pressure's loads with heave and trim balanced, see `frozen`."""
        k = self.wave.wavenumber * np.ones_like(place)
        waves = Waves(self.wave.amplitude * np.ones_like(place), k * np.cos(yaw), -k * np.sin(yaw), np.pi - place)
        return frozen(self.ship, waves, roll, start)

    def rates(
        self, y: Floats, revolutions: Floats | float, ordered: Floats | float, start: Floats | None = None
    ) -> Floats:
        """Derivatives (n, s) of states (n, s) with the propeller's revolutions [1/s] and the heading ordered [rad]."""
        u, v, p, r, place, roll, yaw = y[:, :7].T
        held = self.loads(place, roll, yaw, start)
        force = held.load.copy()
        force[~held.found] = np.nan
        tau0, tau1, tau2 = self.propulsion.thrust_terms(self.ship.loading.density)
        n = np.asarray(revolutions, dtype=float)
        push = (
            tau0 * n**2 + tau1 * n * u + tau2 * u**2 - np.polynomial.polynomial.polyval(u, self.propulsion.resistance)
        )
        order = -self.gain * (yaw - ordered) - self.rate_gain * r
        rudder = y[:, RUDDER] if self.lag > 0 else order
        lateral = force[:, [1, 3, 5]] + self._lateral(u, np.stack([v, p, r], axis=1), place, roll, yaw, rudder)
        out = np.empty_like(y)
        out[:, U] = (push + force[:, 0] + self._mass * v * r) / self._surge
        out[:, [V, P, R]] = lateral @ self._inverse.T
        out[:, PLACE] = self.wave.wavenumber * (u * np.cos(yaw) - v * np.sin(yaw) - self.celerity)
        out[:, ROLL], out[:, YAW] = p, r
        if self.lag > 0:
            out[:, RUDDER] = (order - rudder) / self.lag
        return out

    def _lateral(self, u: Floats, q: Floats, place: Floats, roll: Floats, yaw: Floats, rudder: Floats) -> Floats:
        """Sway force, roll and yaw moment (n, 3) of lift, drag, damping and rudder."""
        water = np.stack([*self.lateral_water(place, yaw)], axis=1)
        linear, lift, blade = (self._at_speed(h, u) for h in (self._linear, self._lift, self._rudder))
        force = np.einsum("nij,nj->ni", linear, q) - np.einsum("nij,nj->ni", lift[:, :, ::2], water)
        force += blade * rudder[:, None] + self._heel * roll[:, None]
        relative = np.stack([q[:, 0] - water[:, 0], roll, q[:, 1], q[:, 2] - water[:, 1]], axis=1)
        for (row, factors), value in self._products:
            size = np.abs(relative[:, factors.modulus - 1]) if factors.modulus else 1.0
            force[:, row] += value * size * (relative ** np.array(factors.powers)).prod(axis=1)
        strips = self._strips
        if strips is not None:
            depth = strips.lever - (self.ship.loading.kg - self.ship.hull.draught)
            moving = 0.0 if self.ship.velocities == "absolute" else self.water(place, yaw, strips.x, depth)
            across = q[:, [0]] + strips.x * q[:, [2]] - strips.lever * q[:, [1]] - moving
            drag = -strips.c * np.abs(across) * across
            force += np.stack(
                [drag.sum(axis=1), -(drag * strips.lever).sum(axis=1), (drag * strips.x).sum(axis=1)], axis=1
            )
        return force

    def matrix(self, y: Floats, revolutions: float, ordered: float) -> Floats:
        """Derivatives (s, s) of the rates by the state, by central differences."""
        s = self.states
        step = np.diag(_SMALL[:s])
        start = self.near(y)
        both = self.rates(np.concatenate([y + step, y - step]), revolutions, ordered, start)
        return np.asarray(((both[:s] - both[s:]) / (2 * _SMALL[:s, None])).T)

    def near(self, y: Floats) -> Floats:
        """Heave and trim at a state, to start from."""
        held = self.loads(y[[PLACE]], y[[ROLL]], y[[YAW]])
        return np.array([held.heave[0], held.pitch[0]])
