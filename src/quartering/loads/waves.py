"""The regular deep-water wave, how a moving ship meets it, and the rule for a ship that overtakes it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import GRAVITY, InputError
from quartering.hull.ship import Ship
from quartering.hull.told import number, numbers
from quartering.option_checks import Refused
from quartering.units import wave_length_of

Floats = NDArray[np.float64]
Phasors = NDArray[np.complex128]

STEEPEST = 1.0 / 7.0
"""Largest height over length a deep-water wave keeps without breaking (Stokes, rounded) [1]."""


@dataclass(frozen=True, init=False)
class Wave:
    """One regular wave on deep water.

    Parameters
    ----------
    length : float or str    lambda > 0 [m], or text with a unit: "150 m"; "1.2L" with a `ship`
    height : float or str    H >= 0, crest to trough [m], or text with a unit
    period : float or str    seen from a fixed point, in place of the length [s]
    ship : Ship              whose L, B and T are meant by text; the wave itself does not depend on it

    Raises
    ------
    InputError    length not above 0, height negative, either not a number, both or neither of length and period, a unit of a
                  ship where none is given, or the wave steeper than 1/7

    Notes
    -----
    sigma = sqrt(g k), k = 2 pi / lambda.  Source: [H71] list of symbols.  Valid: deep water, linear wave.

    Examples
    --------
    >>> wave = Wave(length=150.0, height=4.0)
    >>> wave.amplitude, round(wave.wavenumber, 5), round(wave.frequency, 4), round(wave.steepness, 4)
    (2.0, 0.04189, 0.641, 0.0267)
    >>> round(Wave(period="10 s", height="4 m").length, 2)
    156.13
    """

    length: float
    height: float

    def __init__(
        self,
        length: float | str | None = None,
        height: float | str | None = None,
        *,
        period: float | str | None = None,
        ship: Ship | None = None,
    ) -> None:
        if (length is None) == (period is None):
            both = "are both given; one follows from the other, leave one out" if length is not None else "are missing"
            raise InputError(
                f"wave_length and wave_period {both}; give one of the two, such as length=150 or period=9.8"
            )
        if height is None:
            raise InputError("wave_height is missing; give it crest to trough, such as height=4")
        try:
            if length is not None:
                metres = number(ship, "wave_length", length)
            else:
                metres = wave_length_of(number(ship, "wave_period", 0.0 if period is None else period))
            object.__setattr__(self, "length", metres)
            object.__setattr__(self, "height", number(ship, "wave_height", height))
        except Refused as error:
            more = "" if ship is not None or "of a ship" not in str(error) else ": give Wave(.., ship=ship)"
            raise Refused(error.option, error.words + more) from None
        if self.steepness > STEEPEST:
            raise InputError(
                f"wave of height {self.height:g} m on length {self.length:g} m has steepness {self.steepness:.3g}; "
                f"above 1/7 = 0.143 a wave breaks: try a height up to {self.length * STEEPEST:.3g} m"
            )

    @property
    def amplitude(self) -> float:
        """A = H/2 [m]."""
        return 0.5 * self.height

    @property
    def wavenumber(self) -> float:
        """Wave number k = 2 pi / lambda [1/m]."""
        return 2.0 * np.pi / self.length

    @property
    def frequency(self) -> float:
        """Wave frequency sigma = sqrt(g k), seen from a fixed point [rad/s]."""
        return float(np.sqrt(GRAVITY * self.wavenumber))

    @property
    def steepness(self) -> float:
        """Height over length H/lambda [1]."""
        return self.height / self.length


def encounter_frequency(wave_frequency: ArrayLike, speed: ArrayLike, heading: ArrayLike) -> Floats:
    """Frequency at which a moving ship meets regular deep-water waves.

    Parameters
    ----------
    wave_frequency : (...) float    sigma > 0 [rad/s]
    speed : (...) float             U >= 0 [m/s]
    heading : (...) float           mu: 0 following, 180 head [deg]

    Returns
    -------
    (...) float                     omega, broadcast of the inputs [rad/s]; negative when the ship overtakes the wave

    Raises
    ------
    InputError                      sigma not positive, speed negative or anything not a number

    Notes
    -----
    omega = sigma - k U cos(mu), k = sigma^2 / g.  Source: [H71] list of symbols.  Valid: deep water.

    Examples
    --------
    >>> round(float(encounter_frequency(0.6, 7.5, 180.0)), 4)
    0.8752
    """
    sigma, U = numbers(None, "wave_frequency", wave_frequency), numbers(None, "speed", speed)
    along, _ = heading_components(numbers(None, "heading", heading))
    return np.asarray(sigma + sigma**2 / GRAVITY * U * along)


def heading_components(heading: ArrayLike) -> tuple[Floats, Floats]:
    """Cosine and sine of the paper's angle delta = 180 deg - mu, exact at the quadrants.

    heading (...): mu: 0 following, 90 beam, 180 head [deg]
    Returns along (...): cos(delta) = -cos(mu): k1 = k along [1]; across (...): sin(delta) = sin(mu): k2 = k across [1];
        exactly 0 in head and following seas

    Source: [H71] Fig. 1 and list of symbols.  The wave phase is k1 x - k2 y + omega t.
    """
    mu = np.asarray(heading, dtype=float)
    _refuse(mu, np.isfinite(mu), "heading", "deg", "a number (0 following, 90 beam, 180 head)")
    angle = np.deg2rad(np.remainder(mu, 360.0))
    along = np.where(np.remainder(mu, 180.0) == 90.0, 0.0, -np.cos(angle))
    across = np.where(np.remainder(mu, 180.0) == 0.0, 0.0, np.sin(angle))
    return along, across


def folded(frequency: ArrayLike, phasor: ArrayLike) -> tuple[Floats, Phasors]:
    """Turn a signed encounter frequency and its phasors into a positive frequency and the phasors that go with it.

    A ship that overtakes the wave meets it at a negative frequency. The same real signal, written with |omega|, has
    the conjugate phasor: its cosine part stays and its sine part changes sign.

    frequency (n,): omega, of either sign [rad/s]
    phasor (n, ...): amplitudes Q of Q e^{i omega t}, any unit
    Returns frequency (n,): |omega| [rad/s]; phasor: amplitudes of e^{i |omega| t}

    Source: [H71] list of symbols, extended to ships faster than the wave.  Valid: any frequency, zero included.
    """
    omega, Q = np.asarray(frequency, dtype=float), np.asarray(phasor, dtype=complex)
    overtaking = (omega < 0).reshape(omega.shape + (1,) * (Q.ndim - omega.ndim))
    return np.abs(omega), np.where(overtaking, Q.conj(), Q)


def least_encounter_frequency(length: ArrayLike) -> Floats:
    """Encounter frequency below which a harmonic solution has no meaning.

    length (...): ship length L > 0 [m]
    Returns (...): 1e-3 sqrt(g/L) [rad/s]; a condition with |omega| below it gets a status, not an answer

    The ship then rides with the wave (surf-riding, broaching), which is not a periodic motion.
    Source: [H71] list of symbols (omega near zero); the threshold is this library's choice.
    """
    L = np.asarray(length, dtype=float)
    _refuse(L, L > 0, "ship length", "m", "above zero")
    return np.asarray(1e-3 * np.sqrt(GRAVITY / L))


def _refuse(value: Floats, allowed: NDArray[np.bool_], name: str, unit: str, wanted: str) -> None:
    """Raise InputError with the first value that is not finite or not allowed."""
    bad = ~(np.isfinite(value) & allowed)
    if bad.any():
        raise InputError(f"{name} {float(value[bad].flat[0]):g} {unit} given; it must be finite and {wanted}")
