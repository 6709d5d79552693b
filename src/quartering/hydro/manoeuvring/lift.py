"""Manoeuvring derivatives: Clarke's regression, the levered lift force, and the prime systems."""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import InputError
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.section import Floats
from quartering.hull.lines.sense import BLOCK
from quartering.hull.ship import Ship
from quartering.hydro.transfer import transfer, transfer_cubic, transfer_matrix
from quartering.names import term

__all__ = [
    "PrimeSystem",
    "clarke_derivatives",
    "hull_lift",
    "lift_derivatives",
    "to_prime",
    "to_si",
    "transfer",
    "transfer_cubic",
    "transfer_matrix",
]

PrimeSystem = Literal["sname", "mmg"]


def clarke_derivatives(length: float, beam: float, draught: float, block: float) -> dict[str, float]:
    """Linear sway-yaw derivatives of a merchant hull by Clarke's regression, prime values about midship.

    length, beam, draught: L, B, T [m]
    block: C_B, 0 to 1 [1]
    Returns "Y_v", "Y_r", "N_v", "N_r", "Y_vdot", "Y_rdot", "N_vdot", "N_rdot": SNAME prime values [1], hydrodynamic
        only (no rigid-body -m U in Y_r)

    Source: [Clarke83] regression over rotating-arm and planar-motion tests.  Valid: merchant hulls on even keel in deep
    water; single ships lie tens of per cent off (Y_r of the S-175 by 29 %, N_v of the Mariner by 57 %).
    """
    sizes = {"length": length, "beam": beam, "draught": draught}
    for name, size in sizes.items():
        if not (size > 0 and np.isfinite(size)):
            raise InputError(f"{name} {size:g} m must be a positive number of metres")
    if not 0 < block <= BLOCK[1]:
        raise InputError(
            f"block coefficient {block:g} must lie between 0 and 1 (volume over L B T), or {BLOCK[1]:g} with what stands out"
        )
    slender, b_t, b_l = -np.pi * (draught / length) ** 2, beam / draught, beam / length
    factors = {
        "Y_v": 1 + 0.40 * block * b_t,
        "Y_r": -1 / 2 + 2.2 * b_l - 0.080 * b_t,
        "N_v": 1 / 2 + 2.4 * draught / length,
        "N_r": 1 / 4 + 0.039 * b_t - 0.56 * b_l,
        "Y_vdot": 1 + 0.16 * block * b_t - 5.1 * b_l**2,
        "Y_rdot": 0.67 * b_l - 0.0033 * b_t**2,
        "N_vdot": 1.1 * b_l - 0.041 * b_t,
        "N_rdot": 1 / 12 + 0.017 * block * b_t - 0.33 * b_l,
    }
    return {name: float(slender * factor) for name, factor in factors.items()}


def lift_derivatives(
    prime: dict[str, float], length: float, density: float, *, x: float, z: float, speed: ArrayLike = 1.0
) -> Floats:
    """Velocity derivatives of the lateral lift force in sway, roll and yaw about G.

    prime: "Y_v", "Y_r", "N_v", "N_r" of `clarke_derivatives`, or measured, SNAME prime about O
    length: L [m]
    density: rho [kg/m3]
    x, z: position of O from G: its x is where the set is given about, its z the depth of the force [m]
    speed (...): U [m/s]
    Returns (..., 3, 3): [[Y_v, Y_p, Y_r], [K_v, K_p, K_r], [N_v, N_p, N_r]], no rigid-body term, SI

    The force acts at depth z, where the sway velocity is v - z p: K_v = Y_p = -z Y_v, K_p = z^2 Y_v, N_p = -z N_v.
    Source: [Clarke83] for the set; the lever is the user's (half the draught is assumed).  Valid: no lift from rolling
    other than by this sideways velocity.
    """
    set_about_o = np.zeros((3, 3))
    for name, (row, column) in {"Y_v": (0, 0), "Y_r": (0, 2), "N_v": (2, 0), "N_r": (2, 2)}.items():
        set_about_o[row, column] = to_si(name, prime[name], length, 1.0, density)
    per_speed = transfer(set_about_o, x, z) + 0.0
    lift: Floats = np.asarray(speed, dtype=float)[..., None, None] * per_speed
    return lift


def hull_lift(ship: Ship, speed: ArrayLike) -> Floats:
    """Estimated lift derivatives of a ship in sway, roll and yaw about G, from its main dimensions.

    speed (...): U [m/s]
    Returns (..., 3, 3): [[Y_v, Y_p, Y_r], [K_v, K_p, K_r], [N_v, N_p, N_r]], hydrodynamic only, SI

    Regression about midship, the force at half the draught (assumed), moved to G above the centre of buoyancy.
    Source: [Clarke83].  Valid: as `clarke_derivatives`; an estimate, the Munk moment included.
    """
    hull, loading, floating = ship.hull, ship.loading, hydrostatics(ship)
    prime = clarke_derivatives(hull.length, hull.beam, hull.draught, floating.cb)
    depth = loading.kg - hull.draught / 2  # of the point at half draught, below G
    return lift_derivatives(prime, hull.length, loading.density, x=-floating.lcb, z=depth, speed=speed)


def _prime_divisor(
    name: str, length: float, speed: float, density: float, draught: float | None, system: PrimeSystem
) -> float:
    """The SI value of one prime unit: force or moment scale over the scales of the factors."""
    row, factors = term(name)
    if system not in get_args(PrimeSystem):
        raise InputError(f'system "{system}" is unknown; allowed are "sname" (L^2) and "mmg" (L T)')
    if system == "mmg" and draught is None:
        raise InputError('system "mmg" divides by L T: give draught=')
    if not (length > 0 and density > 0 and (draught is None or draught > 0) and speed >= 0):
        raise InputError(
            f"length {length:g} m, density {density:g} kg/m3 and draught {draught} m must be positive, "
            f"speed {speed:g} m/s >= 0"
        )
    area = length * (draught if system == "mmg" and draught is not None else length)
    arm = 1.0 if row == "Y" else length
    powers = {
        "phi": (0, 0),
        "delta": (0, 0),
        "v": (0, 1),
        "p": (-1, 1),
        "r": (-1, 1),
        "vdot": (-1, 2),
        "pdot": (-2, 2),
        "rdot": (-2, 2),
    }
    length_power = sum(powers[factor][0] for factor in factors)
    speed_power = 2 - sum(powers[factor][1] for factor in factors)
    if speed == 0 and speed_power < 0:
        raise InputError(f"{name} has no prime value at zero speed (it divides by U); give a positive speed")
    return float(0.5 * density * area * arm * length**-length_power * speed**speed_power)


def to_si(
    name: str,
    value: float,
    length: float,
    speed: float,
    density: float,
    draught: float | None = None,
    system: PrimeSystem = "sname",
) -> float:
    """Dimensional value of a prime coefficient.

    name: coefficient name such as "Y_v", "N_rdot", "K_vpp", "K_phi"; also "m", "I_x", "I_z", "I_xz"
    value: prime value [1]
    length: L [m]
    speed: U [m/s]
    density: rho [kg/m3]
    draught: T, for "mmg" only [m]
    system: "sname": forces over 1/2 rho L^2 U^2; "mmg": forces over 1/2 rho L T U^2; moments another L
    Returns the same coefficient in SI

    The scales of the factors are U (v), U/L (p, r), 1 (phi), U^2/L (vdot), U^2/L^2 (pdot, rdot).
    Source: [Abkowitz64] SNAME prime system; [MMG78] for the L T form.  Taylor factors (1/6, 1/2) are not touched.
    """
    return value * _prime_divisor(name, length, speed, density, draught, system)


def to_prime(
    name: str,
    value: float,
    length: float,
    speed: float,
    density: float,
    draught: float | None = None,
    system: PrimeSystem = "sname",
) -> float:
    """Prime value of a dimensional coefficient: the inverse of `to_si`.

    value: coefficient in SI
    Returns prime value [1]

    Source: [Abkowitz64] SNAME prime system; [MMG78] for the L T form.
    """
    divisor = _prime_divisor(name, length, speed, density, draught, system)
    if divisor == 0:
        raise InputError(f"{name} has no prime value at zero speed (it divides by U); give a positive speed")
    return value / divisor
