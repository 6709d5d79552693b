"""The righting arm GZ(phi) of heeled sections at constant displacement, and the odd polynomial fitted to it."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import InputError, RangeWarning
from quartering.doors import takes
from quartering.hull.lines.section import Floats
from quartering.hull.righting.heeled import cross_curve, deck_angle
from quartering.hull.righting.limit import first_vanishing
from quartering.hull.righting.spline import OddSpline, odd_spline
from quartering.hull.ship import Ship
from quartering.hull.told import numbers

SPLINE_STEP, SPLINE_END = 4.0, 96.0
"""Between the angles a righting spline goes through, and the last of them, beyond every capsize limit [deg]."""
WARNED_MISS = 0.05
"""Miss of the polynomial within a motion, as a fraction of the largest |GZ| there, that is warned of."""
MISS = 0.02
"""Largest miss of the cubic, as a fraction of the largest |GZ|, before phi^5 and then phi^7 are added."""


@dataclass(frozen=True)
class RightingFit:
    """GZ ~ gm phi + gz3 phi^3 + gz5 phi^5 + gz7 phi^7 with phi in radians.

    Parameters
    ----------
    gm : float                  metacentric height: the slope at 0, not fitted [m]
    gz3, gz5, gz7 : float       fitted coefficients; gz5, gz7 are 0 when the cubic serves [m]
    residual : float            largest miss over the range, as a fraction of the largest |GZ| [1]
    max_angle : float           end of the range fitted [deg]
    deck_angle : float          heel at which the deck edge (top of the offsets) goes under; inf when not below 90 [deg]
    """

    gm: float
    gz3: float
    gz5: float
    gz7: float
    residual: float
    max_angle: float
    deck_angle: float

    def arm(self, angles_deg: ArrayLike) -> Floats:
        """Fitted GZ [m] at heel angles [deg]."""
        phi = np.radians(np.asarray(angles_deg, dtype=float))
        return np.asarray(phi * (self.gm + phi**2 * (self.gz3 + phi**2 * (self.gz5 + phi**2 * self.gz7))))


@takes(ship="Ship")
def righting_arm(ship: Ship, angles_deg: ArrayLike) -> Floats:
    """Righting arm of a ship heeled in calm water at constant displacement.

    angles_deg (...): heel, positive starboard side down, between -90 and 90 [deg]
    Returns (...): GZ [m], positive when it rights the ship

    GZ = KN - (KM - GM) sin(phi), with KN and KM from the centroid of the heeled sections, cut by the waterline that
    keeps the volume.
    Source: [Lewis88] ch. 2.  Valid: no trim, watertight deck closed at the top of the offsets, no water on deck.
    """
    angles = numbers(ship, "heel", angles_deg)
    if (np.abs(angles) == 90).any():
        raise InputError("heel = 90 deg; it is less than 90 deg to either side; try 40 deg")
    phi = np.radians(angles.ravel())
    arm, freeboard = _arm(ship, phi)
    if (freeboard < 0).any():
        deck = deck_angle(ship.hull)
        warnings.warn(
            f"{ship.name}: the deck edge goes under at {deck:.1f} deg of heel and GZ is asked up to "
            f"{np.abs(angles).max():g} deg; beyond it GZ rests on a watertight deck at the top of the offsets",
            RangeWarning,
            stacklevel=2,
        )
    return arm.reshape(angles.shape)


def _arm(ship: Ship, phi: Floats) -> tuple[Floats, Floats]:
    """GZ and freeboard [m] at heel angles [rad], with G set GM below the metacentre of the very sections heeled."""
    small = 1e-4
    kn, freeboard = cross_curve(ship.hull, (*phi.tolist(), small))
    height_of_g = kn[-1] / np.sin(small) - ship.loading.gm
    return kn[:-1] - height_of_g * np.sin(phi), freeboard[:-1]


@lru_cache(maxsize=64)
def righting_polynomial(ship: Ship, max_angle: float = 40.0) -> RightingFit:
    """Odd polynomial of the righting arm, with the slope at 0 held at GM.

    max_angle: end of the range fitted, above 0 and below 80 [deg]
    Returns cubic; phi^5 and then phi^7 are added when the fit misses by more than 2 % of the largest |GZ|

    Least squares at 20 equally spaced angles. K_phi = -rho g volume gm, K_phiphiphi = -rho g volume gz3.
    Source: [H71] eq. (2), restoring terms.  Valid: up to max_angle; ``deck_angle`` says beyond which heel the curve
    rests on a closed deck.
    """
    if not 0 < max_angle < 80:
        raise InputError(f"max_angle = {max_angle:g} deg; give an angle above 0 and below 80 deg, such as 40")
    angles = np.linspace(0.0, max_angle, 21)[1:]
    phi = np.radians(angles)
    gz, _ = _arm(ship, phi)
    gm, largest = ship.loading.gm, float(np.abs(gz).max())
    for powers in ((3,), (3, 5), (3, 5, 7)):
        basis = np.stack([phi**power for power in powers], axis=1)
        found = np.linalg.lstsq(basis, gz - gm * phi, rcond=None)[0]
        residual = float(np.abs(basis @ found + gm * phi - gz).max()) / largest
        if residual <= MISS:
            break
    gz3, gz5, gz7 = (*(float(value) for value in found), 0.0, 0.0)[:3]
    return RightingFit(gm, gz3, gz5, gz7, residual, float(max_angle), deck_angle(ship.hull))


@lru_cache(maxsize=16)
def righting_spline(ship: Ship) -> OddSpline:
    """Spline through the righting arm of the lines every 4 degrees to 96, past the vanishing angle and 90 deg.

    Returns GZ [m] over the roll angle [rad]; within 0.2 % of the largest |GZ| of the built-in ships' own curves

    Its slope at 0 is GM, as that of the curve.  Source: `righting_arm`.
    Valid: as `righting_arm`; beyond the deck edge a watertight deck at the top of the offsets.
    """
    angles = np.arange(SPLINE_STEP, SPLINE_END + 1.0, SPLINE_STEP)
    return odd_spline(angles, _arm(ship, np.radians(angles))[0], slope=ship.loading.gm)


def polynomial_miss(ship: Ship, max_angle: float) -> float:
    """By how much the fitted polynomial misses the righting arm in a range of heel.

    max_angle: end of the range, above 0 [deg]
    Returns largest miss as a fraction of the largest |GZ| in the range [1]

    Source: `righting_arm` and `righting_polynomial`, every 2.5 degrees, up to 2.5 degrees at least.
    """
    within = max(int(np.searchsorted(_ALL_ANGLES, max_angle, side="right")), 1)
    arms = _arm(ship, np.radians(_ALL_ANGLES))[0][:within]  # always the same angles, so that they are computed once
    missed = np.abs(righting_polynomial(ship).arm(_ALL_ANGLES[:within]) - arms).max()
    return float(missed / np.abs(arms).max())


def warn_of_polynomial(ship: Ship, largest_roll: float) -> None:
    """Say that the polynomial misses the righting arm by more than 5 % within the motion, and that there is a spline.

    largest_roll: [deg]; nothing is said of NaN or of none

    Source: `polynomial_miss`; the 5 % are ours.
    """
    if ship.righting == "spline" or not largest_roll > 0:
        return
    miss = polynomial_miss(ship, largest_roll)
    if miss > WARNED_MISS:
        warnings.warn(
            f"{ship.name}: up to the {largest_roll:.3g} deg of roll reached, the polynomial misses the righting arm by "
            f'{miss:.0%} of its largest; take the curve itself with righting="spline"',
            RangeWarning,
            stacklevel=3,
        )


def fitted_to(ship: Ship) -> float:
    """Heel up to which the righting moment of a ship's equations follows its lines.

    Returns end of the polynomial's range [deg]; infinite with a spline, which says its own end

    >>> from quartering.hull.file.read import ship
    >>> fitted_to(ship("box").with_(righting="polynomial")), fitted_to(ship("box"))
    (40.0, inf)
    """
    return float("inf") if ship.righting == "spline" else righting_polynomial(ship).max_angle


_ALL_ANGLES = np.arange(2.5, 90.0, 2.5)


@lru_cache(maxsize=64)
def vanishing_angle(ship: Ship) -> float:
    """Heel at which the righting arm of a ship's equations vanishes, or that of its lines where that is sooner.

    Returns [deg]; infinite when the arm is positive up to 90

    With a spline its root; with a polynomial the first positive root of the polynomial or the root of the spline, the smaller:
    a polynomial may right the ship again where the lines do not.
    Source: `righting_spline` and `righting_polynomial`, with the hull closed at the top of the offsets.
    """
    of_lines = first_vanishing(righting_spline(ship).value)
    if ship.righting == "spline":
        return of_lines
    fit = righting_polynomial(ship)
    return min(of_lines, first_vanishing(lambda phi: fit.arm(np.degrees(phi))))
