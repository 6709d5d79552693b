"""Resistance and propulsion of a ship in calm water: polynomials of the speed and of the propeller's revolutions."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from quartering.conventions import WATER_DENSITY, InputError
from quartering.hull.told import real

_DEGREE = 5


@dataclass(frozen=True)
class Propulsion:
    """Resistance as a polynomial of speed, and a propeller by its thrust coefficient.

    Resistance R(u) = sum r_i u^i [N]; thrust T(u; n) = (1 - t) rho n^2 D^4 K_T(J), K_T = k0 + k1 J + k2 J^2 and
    J = (1 - w) u/(n D), so that T = tau0 n^2 + tau1 n u + tau2 u^2.

    Parameters
    ----------
    resistance : up to 6 float    r0, r1, .. r5 [N/(m/s)^i]
    diameter : float              of the propeller, > 0 [m]
    thrust_deduction : float      t, from 0 to below 1
    wake : float                  w, from 0 to below 1
    thrust : (3,) float           k0, k1, k2 of the thrust coefficient, k0 > 0
    propellers : int              equal ones

    Raises
    ------
    InputError    numbers that are not finite or out of these ranges

    Notes
    -----
    Source: [Lewis89] ch. VI.

    Examples
    --------
    >>> driven = Propulsion((0, 0, 2500.0), diameter=2.6, thrust_deduction=0.1, wake=0.2, thrust=(0.36, -0.28, -0.12))
    >>> driven.drag(4.0), round(driven.speed(driven.revolutions(4.0)), 9)
    (40000.0, 4.0)
    """

    resistance: Sequence[float]
    diameter: float
    thrust_deduction: float = 0.0
    wake: float = 0.0
    thrust: Sequence[float] = (0.0, 0.0, 0.0)
    propellers: int = 1

    def __post_init__(self) -> None:
        r, k = real(self.resistance), real(self.thrust)
        if r is None or r.ndim != 1 or not 1 <= r.size <= _DEGREE + 1 or not np.isfinite(r).all():
            raise InputError(
                f"resistance = {self.resistance}; it is up to six finite numbers r0, r1, .. r5 [N/(m/s)^i]"
            )
        if k is None or k.shape != (3,) or not np.isfinite(k).all() or k[0] <= 0:
            raise InputError(
                f"thrust = {self.thrust}; it is three numbers k0, k1, k2 of K_T = k0 + k1 J + k2 J^2, k0 above 0"
            )
        diameter = real(self.diameter)
        if diameter is None or diameter.ndim or not 0 < diameter < 100:
            raise InputError(f"diameter = {self.diameter} m; it is above 0 m and below 100 m")
        for name in ("thrust_deduction", "wake"):
            share = real(getattr(self, name))
            if share is None or share.ndim or not 0 <= share < 1:
                raise InputError(f"{name} = {getattr(self, name)}; it is from 0 to below 1")
        if not isinstance(self.propellers, int) or self.propellers < 1:
            raise InputError(f"propellers = {self.propellers}; it is a whole number of 1 or more")
        object.__setattr__(self, "resistance", tuple(float(x) for x in np.pad(r, (0, _DEGREE + 1 - r.size))))
        object.__setattr__(self, "thrust", tuple(float(x) for x in k))

    @property
    def parts(self) -> dict[str, float]:
        """The same numbers by the keys of a ship file."""
        k0, k1, k2 = self.thrust
        named = {"diameter": self.diameter, "k0": k0, "k1": k1, "k2": k2}
        named |= {"thrust_deduction": self.thrust_deduction, "wake": self.wake, "propellers": self.propellers}
        return named | {f"r{i}": r for i, r in enumerate(self.resistance)}

    def thrust_terms(self, density: float = WATER_DENSITY) -> tuple[float, float, float]:
        """Coefficients tau0, tau1, tau2 of T = tau0 n^2 + tau1 n u + tau2 u^2, all propellers together [SI]."""
        k0, k1, k2 = self.thrust
        factor = self.propellers * (1 - self.thrust_deduction) * density * self.diameter**2
        inflow = 1 - self.wake
        return factor * self.diameter**2 * k0, factor * self.diameter * inflow * k1, factor * inflow**2 * k2

    def drag(self, speed: float) -> float:
        """Resistance R(u) [N] at a speed [m/s]."""
        return float(np.polynomial.polynomial.polyval(speed, self.resistance))

    def revolutions(self, speed: float, density: float = WATER_DENSITY, extra: float = 0.0) -> float:
        """Revolutions [1/s] at which thrust is resistance and an extra force [N] at a speed; NaN where none is."""
        tau0, tau1, tau2 = self.thrust_terms(density)
        return larger_root(tau0, tau1 * speed, tau2 * speed**2 - self.drag(speed) - extra)

    def speed(self, revolutions: float, density: float = WATER_DENSITY) -> float:
        """Self-propulsion speed [m/s] at given revolutions [1/s]: the least at which resistance overtakes thrust."""
        if math.isnan(revolutions):
            return math.nan
        tau0, tau1, tau2 = self.thrust_terms(density)
        surplus = -np.array(self.resistance)
        surplus[:3] += (tau0 * revolutions**2, tau1 * revolutions, tau2)
        roots = np.roots(surplus[::-1])
        real = roots.real[(np.abs(roots.imag) < 1e-9 * np.abs(roots)) & (roots.real > 0)]
        return float(real.min()) if real.size else math.nan


def larger_root(a: float, b: float, c: float) -> float:
    """Larger root of a x^2 + b x + c with a > 0; NaN where there is none above 0."""
    inside = b * b - 4 * a * c
    if inside < 0:
        return math.nan
    found = (-b + math.sqrt(inside)) / (2 * a)
    return found if found > 0 else math.nan


def propulsion_of_parts(parts: Mapping[str, float]) -> Propulsion:
    """Propulsion from the keys of a ship file: diameter, k0, k1, k2, thrust_deduction, wake, propellers, r0, .. r5.

    Raises
    ------
    InputError    as `Propulsion`

    Examples
    --------
    >>> told = dict(diameter=2.6, k0=0.36, k1=-0.28, k2=-0.12, thrust_deduction=0.1, wake=0.2, propellers=1, r2=2500.0)
    >>> propulsion_of_parts(told).drag(2.0)
    10000.0
    """
    if not any(parts.get(f"r{i}", 0.0) for i in range(_DEGREE + 1)):
        raise InputError("r0 to r5 are all 0; give the resistance r0 + r1 u + .. + r5 u^5 [N], such as r2: 20e3")
    count = parts["propellers"]
    return Propulsion(
        [parts.get(f"r{i}", 0.0) for i in range(_DEGREE + 1)],
        parts["diameter"],
        parts["thrust_deduction"],
        parts["wake"],
        (parts["k0"], parts["k1"], parts["k2"]),
        int(count) if float(count).is_integer() else count,  # type: ignore[arg-type]  # refused with its words
    )
