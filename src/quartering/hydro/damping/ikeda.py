"""Roll damping by components: friction, lift of the hull, and what forward speed does to waves and eddies.

The equivalent linear damping of a hull rolling harmonically about G is the sum

    B44 = friction + eddies + lift + waves + bilge keels

each from a formula of Ikeda and others, most of them fitted to model tests of cargo ships. Eddies are in
`ikeda_eddy`, bilge keels in `ikeda_bilge_keel`; the sum is made by `rolldamping.roll_damping`.
G lies ``og`` below the calm plane, positive down: ``og = T - KG``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from quartering.conventions import GRAVITY, WATER_DENSITY, InputError
from quartering.hull.lines.section import Floats

VISCOSITY: Final = 1.19e-6
"""Kinematic viscosity of sea water at 15 deg C [m2/s]."""


@dataclass(frozen=True)
class Particulars:
    """What the component formulas ask of a hull.

    Parameters
    ----------
    length, beam, draught : float    [m]
    block, midship : float           C_B, C_M [1]
    og : float                       depth of G below the calm plane, T - KG, + down [m]
    density : float                  of the water [kg/m3]
    viscosity : float                kinematic, of the water [m2/s]
    """

    length: float
    beam: float
    draught: float
    block: float
    midship: float
    og: float
    density: float = WATER_DENSITY
    viscosity: float = VISCOSITY

    def __post_init__(self) -> None:
        for name in ("length", "beam", "draught", "block", "midship", "density", "viscosity"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value > 0):
                raise InputError(f"{name} = {value:g} must be a number above 0")
        if not (np.isfinite(self.og) and self.og < self.draught):
            raise InputError(f"og = {self.og:g} m puts G under the keel; og is T - KG, at most T = {self.draught:g} m")

    @property
    def scale(self) -> float:
        """Damping of which the non-dimensional one is a fraction: rho (L B T C_B) B^2 sqrt(2 g/B) [N m s]."""
        volume = self.length * self.beam * self.draught * self.block
        return float(self.density * volume * self.beam**2 * np.sqrt(2 * GRAVITY / self.beam))


@dataclass(frozen=True, eq=False)
class Rolling:
    """A harmonic roll motion of a ship that moves ahead.

    Parameters
    ----------
    frequency : float        omega > 0 [rad/s]
    amplitude : (n,) float   phi_a > 0, one or several [rad]
    speed : float            U >= 0 [m/s]
    """

    frequency: float
    amplitude: Floats
    speed: float = 0.0

    def __post_init__(self) -> None:
        phi = np.array(self.amplitude, dtype=float)
        object.__setattr__(self, "amplitude", phi)
        if not (np.isfinite(self.frequency) and self.frequency > 0):
            raise InputError(f"roll frequency {self.frequency:g} rad/s must be a number above 0")
        if not (np.isfinite(phi).all() and (phi > 0).all() and (phi < np.pi / 2).all()):
            raise InputError(f"roll amplitude {np.degrees(phi)} deg must lie between 0 and 90 deg; try 10")
        if not (np.isfinite(self.speed) and self.speed >= 0):
            raise InputError(f"speed {self.speed:g} m/s must be a number >= 0")


def friction(hull: Particulars, motion: Rolling, *, turbulent: bool = True) -> Floats:
    """Damping by skin friction.

    turbulent: with the turbulent term of the friction coefficient; False is a smooth model at small scale
    Returns (n,): B_F [N m s]

    Kato: mean radius r_f = ((0.887 + 0.145 C_B)(1.7 T + C_B B) - 2 OG)/pi, R = 0.512 (r_f phi_a)^2 omega/nu,
    C_f = 1.328 R^-0.5 (+ 0.014 R^-0.114), B_F0 = (4/(3 pi)) rho S r_f^3 omega phi_a C_f; Tamiya: B_F = B_F0
    (1 + 4.1 U/(omega L)).
    Source: [ITTC11] 2.2.3; [Himeno81] ch. 4.  Valid: small part of the whole at full scale (1 to 3 %).
    """
    L, B, T, CB, OG = hull.length, hull.beam, hull.draught, hull.block, hull.og
    phi, omega = motion.amplitude, motion.frequency
    surface = L * (1.7 * T + CB * B)
    radius = ((0.887 + 0.145 * CB) * surface / L - 2 * OG) / np.pi
    reynolds = 0.512 * (radius * phi) ** 2 * omega / hull.viscosity
    coefficient = 1.328 * reynolds**-0.5 + (0.014 * reynolds**-0.114 if turbulent else 0.0)
    at_rest = 4 / (3 * np.pi) * hull.density * surface * radius**3 * omega * phi * coefficient
    return np.asarray(at_rest * (1 + 4.1 * motion.speed / (omega * L)))


def section_lift_slope(midship: float) -> float:
    """Factor of the hull's lift slope that depends on the fullness of the midship section.

    midship: C_M [1]
    Returns kappa: 0 below 0.91, then 106 (C_M - 0.91)^2 - 700 (C_M - 0.91)^3, held above 0.99 [1]

    Ikeda gives steps, 0 up to C_M = 0.92, 0.1 up to 0.97, 0.3 up to 0.99; the curve runs through them without jumps.
    Source: [Journee03] fit to the steps of [Ikeda78b].  Valid: 0.91 < C_M < 0.99.
    """
    excess = min(max(midship - 0.91, 0.0), 0.08)
    return 106 * excess**2 - 700 * excess**3


def lift(hull: Particulars, motion: Rolling, *, section_slope: float | None = None) -> Floats:
    """Damping by the lift of the hull, which rolls and moves ahead like a wing of small aspect ratio.

    section_slope: kappa; None: `section_lift_slope`
    Returns (n,): B_L, proportional to speed, alike at all amplitudes [N m s]

    B_L = (rho/2) U L T k_N l0 lR (1 - 1.4 OG/lR + 0.7 OG^2/(l0 lR)), k_N = 2 pi T/L + kappa (4.1 B/L - 0.045),
    l0 = 0.3 T, lR = 0.5 T.  Source: [Ikeda78b], [ITTC11] 2.2.2.  Valid: no propeller, no rudder, no heel.
    """
    L, T, OG = hull.length, hull.draught, hull.og
    kappa = section_lift_slope(hull.midship) if section_slope is None else section_slope
    slope = 2 * np.pi * T / L + kappa * (4.1 * hull.beam / L - 0.045)
    l0, lR = 0.3 * T, 0.5 * T
    lever = l0 * lR * (1 - 1.4 * OG / lR + 0.7 * OG**2 / (l0 * lR))
    value = 0.5 * hull.density * motion.speed * L * T * slope * lever
    return np.full_like(motion.amplitude, value)


def wave_speed_factor(frequency: float, speed: float, draught: float) -> float:
    """How forward speed changes the wave damping of roll.

    frequency: omega > 0 [rad/s]
    speed: U >= 0 [m/s]
    draught: T [m]
    Returns B_W(U)/B_W(0), 1 at rest [1]

    With x = omega^2 T/g and Omega = omega U/g: A1 = 1 + x^-1.2 e^(-2x), A2 = 0.5 + x^-1 e^(-2x),
    0.5 (A2 + 1 + (A2 - 1) tanh(20 Omega - 6) + (2 A1 - A2 - 1) exp(-150 (Omega - 0.25)^2)), less what its two curves
    leave at Omega = 0 (1e-5 to 1e-4 of them), so that the ship at rest has exactly 1.
    Source: [Ikeda78b], [ITTC11] 2.2.1, from a flat plate's dipoles.  Valid: x of order 0.1 to 2; as x -> 0 the factor
    grows without bound on a wave damping that vanishes faster.
    """
    x, Omega = frequency**2 * draught / GRAVITY, frequency * speed / GRAVITY
    A1 = 1 + x**-1.2 * np.exp(-2 * x)
    A2 = 0.5 + np.exp(-2 * x) / x
    far = (A2 - 1) * (np.tanh(20 * Omega - 6) - np.tanh(-6.0)) + 2
    near = (2 * A1 - A2 - 1) * (np.exp(-150 * (Omega - 0.25) ** 2) - np.exp(-150 * 0.25**2))
    return float(0.5 * (far + near))


def eddy_speed_factor(frequency: float, speed: float, length: float) -> float:
    """How forward speed changes the eddy damping of roll: the eddies are washed away.

    frequency: omega > 0 [rad/s]
    speed: U >= 0 [m/s]
    length: L [m]
    Returns B_E(U)/B_E(0) = (0.04 K)^2/(1 + (0.04 K)^2), K = omega L/U; 1 at rest [1]

    Source: [Ikeda78b], [ITTC11] 2.2.4.
    """
    return float(1 / (1 + (speed / (0.04 * frequency * length)) ** 2))
