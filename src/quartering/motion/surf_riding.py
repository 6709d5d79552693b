"""Surf-riding in following waves: the revolutions, and speeds, from which a ship is caught by the wave."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering._machine.compiled import inner, kernel
from quartering.conventions import GRAVITY, WATER_DENSITY, InputError
from quartering.doors import takes
from quartering.hull.propulsion import Propulsion, larger_root

Floats = NDArray[np.float64]

_STEPS = 4000
"""Steps of the march over one wave; its fourth-order error is below 1e-9 of the threshold."""
_START = 1e-4
"""Distance from the saddle, in kx, at which the march begins, along the unstable direction; its curvature leaves 1e-9."""

_EDGE = 1e-3
"""Distance from the ends of the range, as a share of it: there saddle and node are one, and leaving it takes for ever."""


@dataclass(frozen=True)
class Thresholds:
    """From which revolutions a ship rides the wave.

    Parameters
    ----------
    revolutions : float          second threshold by Melnikov's method: every start is caught [1/s]; NaN where none exists
    froude : float               Froude number at which the ship would go at these revolutions in calm water [1]
    revolutions_exact, froude_exact : float    the same by the heteroclinic connection itself
    first_revolutions : float    first threshold: some starts are caught [1/s]
    """

    revolutions: float
    froude: float
    revolutions_exact: float
    froude_exact: float
    first_revolutions: float


@takes(propulsion="Propulsion")
def surf_riding_thresholds(
    *,
    mass: float,
    added_mass: float,
    length: float,
    propulsion: Propulsion,
    wave_length: float,
    force: float,
    density: float = WATER_DENSITY,
) -> Thresholds:
    """Thresholds of surf-riding of a ship that a following wave overtakes.

    Parameters
    ----------
    mass, added_mass : float    of the ship, and in surge [kg]
    length : float              for the Froude number [m]
    propulsion : Propulsion     resistance and thrust
    wave_length : float         [m]
    force : float               amplitude of the surging force of the wave [N]
    density : float             of the water [kg/m3]

    Returns
    -------
    Thresholds

    Raises
    ------
    InputError    a number that is not finite, or not above 0 (the added mass may be 0)

    Notes
    -----
    The distance xi from a trough, along the wave, obeys (m + m_x) xi'' + f sin k xi = T(u; n) - R(u), u = c + xi'.
    Melnikov's method takes the energy that thrust and resistance give along the separatrix of the wave alone; it lies 0.4 to
    2.3 % below the connection of one saddle with the next, which ``revolutions_exact`` finds by integration. Where the wave is
    so low that every ship is caught as soon as an equilibrium exists, both thresholds are the first one, and Melnikov's
    value, which knows nothing of it, may lie below.
    Source: Melnikov's integral over the lower separatrix, as in MSC.1/Circ.1627 (recalled). Valid: deep water, following sea,
    ship slower than the wave.

    Examples
    --------
    >>> driven = Propulsion((0, 0, 2500, -600, 75), 2.6, thrust_deduction=0.142, wake=0.156, thrust=(0.36, -0.28, -0.12))
    >>> found = surf_riding_thresholds(
    ...     mass=450e3, added_mass=45e3, length=34.5, propulsion=driven, wave_length=34.5, force=462285.359
    ... )
    >>> round(found.froude, 4), round(found.froude_exact, 4)
    (0.2601, 0.2614)
    """
    given = {"mass": mass, "length": length, "wave_length": wave_length, "force": force, "density": density}
    for name, value in given.items():
        if not (math.isfinite(value) and value > 0):
            raise InputError(f"{name} = {value}; it is a finite number above 0")
    if not (math.isfinite(added_mass) and added_mass >= 0):
        raise InputError(f"added_mass = {added_mass} kg; it is a finite number of 0 or more")
    k = 2 * math.pi / wave_length
    surge = _Surge(propulsion, mass + added_mass, k, math.sqrt(GRAVITY / k), force, density)
    by_melnikov, exactly = surge.melnikov(), surge.exact()

    def froude(revolutions: float) -> float:
        return propulsion.speed(revolutions, density) / math.sqrt(GRAVITY * length)

    first = propulsion.revolutions(surge.celerity, density, -force)
    return Thresholds(by_melnikov, froude(by_melnikov), exactly, froude(exactly), first)


@dataclass(frozen=True)
class _Surge:
    """The surge equation in a wave of number k and celerity c."""

    propulsion: Propulsion
    inertia: float
    wavenumber: float
    celerity: float
    force: float
    density: float

    def melnikov(self) -> float:
        """Revolutions by Melnikov's method."""
        quadratic = melnikov_quadratic(
            self.propulsion, self.inertia, self.wavenumber, self.celerity, self.force, self.density
        )
        return larger_root(*(float(one) for one in quadratic))

    def exact(self) -> float:
        """Revolutions at which the way out of one saddle leads into the next, by bisection; NaN where none do.

        Below them the ship is overtaken (it passes the next saddle falling back), above them it turns before and is caught.
        Beyond the thrust at which no equilibrium is left (T - R at c = +f) it outruns the wave. The first threshold is
        returned where damping is so large that both are one.
        """
        low = self.propulsion.revolutions(self.celerity, self.density, -self.force)
        high = self.propulsion.revolutions(self.celerity, self.density, self.force)
        if math.isnan(high):
            return math.nan
        low, width = (0.0, high) if math.isnan(low) else (low, high - low)
        if self._caught(low + _EDGE * width):  # so damped that every ship is caught as soon as there is an equilibrium
            return low
        if not self._caught(high - _EDGE * width):
            return math.nan
        for _ in range(50):
            middle = 0.5 * (low + high)
            low, high = (low, middle) if self._caught(middle) else (middle, high)
        return 0.5 * (low + high)

    def _caught(self, revolutions: float) -> bool:
        tau0, tau1, tau2 = self.propulsion.thrust_terms(self.density)
        surplus = -np.array(self.propulsion.resistance)
        surplus[:3] += (tau0 * revolutions**2, tau1 * revolutions, tau2)
        shifted = np.array(_shifted(surplus, self.celerity))
        return bool(_turns(shifted, self.force, self.inertia, self.wavenumber, _STEPS, _START))


def melnikov_quadratic(
    propulsion: Propulsion, inertia: float, wavenumber: ArrayLike, celerity: ArrayLike, force: ArrayLike, density: float
) -> tuple[Floats, Floats, Floats]:
    """Melnikov's condition as a quadratic a n^2 + b n + c in the revolutions, for one wave or many.

    With T(u) - R(u) = [T - R](c) - sum A_i xi'^i and the lower separatrix xi' = -2 s cos(k xi/2), s^2 = f/(k M), whose
    integrals of cos^n over it are 4, pi, 8/3, 3 pi/4, 32/15:

        2 pi [T - R](c) + 8 A1 s - 4 pi A2 s^2 + (64/3) A3 s^3 - 12 pi A4 s^4 + (1024/15) A5 s^5 = 0.

    Only [T - R](c) and A1 hold n.
    """
    tau0, tau1, tau2 = propulsion.thrust_terms(density)
    c, s = np.asarray(celerity), np.sqrt(np.asarray(force) / (np.asarray(wavenumber) * inertia))
    drag, a1, a2, a3, a4, a5 = _shifted(propulsion.resistance, c)
    a1, a2 = a1 - 2 * tau2 * c, a2 - tau2
    rest = 8 * a1 * s - 4 * math.pi * a2 * s**2 + 64 / 3 * a3 * s**3 - 12 * math.pi * a4 * s**4 + 1024 / 15 * a5 * s**5
    whole = 2 * math.pi
    return np.asarray(whole * tau0), tau1 * (whole * c - 8 * s), whole * (tau2 * c**2 - drag) + rest


def _shifted(polynomial: ArrayLike, point: ArrayLike) -> list[Floats]:
    """Coefficients of a polynomial of degree 5 in powers of the distance from a point: its Taylor series there."""
    whole = np.polynomial.Polynomial(np.asarray(polynomial, dtype=float))
    return [np.asarray((whole.deriv(i) if i else whole)(np.asarray(point))) / math.factorial(i) for i in range(6)]


@inner
def _slope(surplus, x, y):
    """Acceleration of kx by thrust less resistance as a polynomial of its rate, and by the wave, all scaled."""
    value = 0.0
    for i in range(surplus.size - 1, -1, -1):
        value = value * y + surplus[i]
    return value - math.sin(x)


@kernel
def _turns(shifted, force, inertia, wavenumber, steps, start):
    """Does the motion that falls back from the saddle turn before the next one?

    In x = k xi and time in units of sqrt(M/(k f)) the equation is x'' + sin x = sum p_i x'^i. The saddle lies where
    sin x = p_0 with cos x < 0. The march leaves it along its unstable direction, x' = lambda (x - x_s), towards -x.
    """
    scale = math.sqrt(force / (inertia * wavenumber))  # velocity xi' for x' = 1
    p = np.empty(shifted.size)
    for i in range(p.size):
        p[i] = shifted[i] / force * scale**i
    if p[0] >= 1.0:
        return True
    if p[0] <= -1.0:
        return False
    saddle = math.pi - math.asin(p[0])
    growth = 0.5 * (p[1] + math.sqrt(p[1] * p[1] - 4.0 * math.cos(saddle)))
    x, y = saddle - start, -growth * start
    end = saddle - 2.0 * math.pi
    # The way takes some units of log(1/start) away from the saddle, and as long again near the next one.
    step = 60.0 / steps
    for _ in range(20 * steps):
        k1x, k1y = y, _slope(p, x, y)
        k2x, k2y = y + 0.5 * step * k1y, _slope(p, x + 0.5 * step * k1x, y + 0.5 * step * k1y)
        k3x, k3y = y + 0.5 * step * k2y, _slope(p, x + 0.5 * step * k2x, y + 0.5 * step * k2y)
        k4x, k4y = y + step * k3y, _slope(p, x + step * k3x, y + step * k3y)
        x += step * (k1x + 2.0 * k2x + 2.0 * k3x + k4x) / 6.0
        y += step * (k1y + 2.0 * k2y + 2.0 * k3y + k4y) / 6.0
        if y >= 0.0:
            return True
        if x <= end:
            return False
    return True
