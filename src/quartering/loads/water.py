"""Velocity of the water across a ship in a wave, as a straight line along its length."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import GRAVITY
from quartering.loads.waves import Floats, Phasors, encounter_frequency, folded, heading_components

_SMALL = 0.1


def water_velocity(
    wavenumber: ArrayLike, speed: ArrayLike, heading: ArrayLike, *, length: float, middle: float, depth: float
) -> tuple[Phasors, Phasors]:
    """Velocity of the water across a ship and its rate of turn, per metre of wave amplitude.

    wavenumber (n,): k > 0 [1/m]
    speed (n,): U >= 0 [m/s]
    heading (n,): mu: 0 following, 90 beam, 180 head [deg]
    length: L over which the line is fitted [m]
    middle: x_M of the middle of that length, forward of G [m]
    depth: d at which the velocity is taken, below the calm plane [m]
    Returns w0 (n,): the line's value at G [(m/s)/m]; w1 (n,): its slope along the ship [(1/s)/m]; both phasors of e^{i
        |omega| t}

    A ship's sections move sideways with v + x r, in water that moves with w(x) = i sigma sin(delta) e^{-k d} e^{i k1 x},
    to first order in wave and motion; the factor is sigma, since it is a velocity of the water, seen from wherever. The
    line w0 + w1 x that comes nearest to w in the mean square over the length is, with X = k1 L/2 and W = w(x_M),

        w1 = W (6 i/L) (sin X - X cos X)/X^2,    w0 = W sin(X)/X - x_M w1

    Source: [STF70] wave kinematics; least squares, closed form.  Valid: deep water, linear wave.
    """
    k, U, mu = np.broadcast_arrays(*(np.atleast_1d(np.asarray(v, dtype=float)) for v in (wavenumber, speed, heading)))
    along, across = heading_components(mu)
    sigma = np.sqrt(GRAVITY * k)
    X = k * along * length / 2
    W = 1j * sigma * across * np.exp(-k * depth + 1j * k * along * middle)
    w1 = W * (6j / length) * _turning(X)
    w0 = W * np.sinc(X / np.pi) - middle * w1
    omega = encounter_frequency(sigma, U, mu)
    return folded(omega, w0)[1], folded(omega, w1)[1]


def surface_slope(
    wavenumber: ArrayLike, speed: ArrayLike, heading: ArrayLike, *, length: float, middle: float, depth: float
) -> Phasors:
    """Slope across a ship of the surface of equal pressure, the mean over its length, per metre of wave amplitude.

    as in `water_velocity`
    Returns (n,): heel of a raft that rides on it [rad/m]; phasor of e^{i |omega| t}

    -k sin(delta) e^{-k d} e^{i k1 x}, its mean over the length.  Source: [H71] eq. (B-7).  Valid: deep water, linear wave.

    >>> surface_slope([0.01], [0.0], [90.0], length=100.0, middle=0.0, depth=0.0)
    array([-0.01+0.j])
    """
    k, U, mu = np.broadcast_arrays(*(np.atleast_1d(np.asarray(v, dtype=float)) for v in (wavenumber, speed, heading)))
    along, across = heading_components(mu)
    mean = np.sinc(k * along * length / 2 / np.pi) * np.exp(-k * depth + 1j * k * along * middle)
    return folded(encounter_frequency(np.sqrt(GRAVITY * k), U, mu), -k * across * mean)[1]


def _turning(X: Floats) -> Floats:
    """(sin X - X cos X)/X^2, by its series where the difference would lose digits."""
    near = np.abs(X) < _SMALL
    x = np.where(near, 1.0, X)
    q = X**2
    series = X / 3 * (1 - q / 10 * (1 - q / 28 * (1 - q / 54)))
    return np.asarray(np.where(near, series, (np.sin(x) - x * np.cos(x)) / x**2))
