"""The wave-making singularity at the centre of the unit circle a Lewis form is mapped from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from quartering.hull.lines.section import Floats

Complexes = NDArray[np.complex128]
Symmetry = Literal["even", "odd"]

POWERS: Final[dict[str, Floats]] = {"even": np.array([1.0, 3.0, 5.0, 7.0]), "odd": np.array([2.0, 4.0, 6.0, 8.0])}
"""Powers of 1/xi whose sum makes the waves: heave (even in y), sway and roll (odd)."""

_RING_POINTS: Final = 64
_RAY_POINTS: Final = 80
_STEP_POINTS: Final = 6


@dataclass(frozen=True, eq=False)
class Wavemaker:
    """Outgoing wave-making potential on the contour; unit scale M = 1.

    Parameters
    ----------
    potential : (f, s, n) complex    phi, e^{+i w t} [1]
    flux : (f, s, n) complex         d phi / d ln|xi|: normal velocity times ds/dtheta [1]
    wave : (f, s) complex            D of the wave far to starboard, phi -> D exp(-nu z - i nu y) [1]
    """

    potential: Complexes
    flux: Complexes
    wave: Complexes


def wavemaker(wavenumber: Floats, a1: Floats, a3: Floats, angle: Floats, symmetry: Symmetry) -> Wavemaker:
    """Potential of a singularity inside a Lewis form that sends waves to both sides.

    wavenumber (f, s): K = nu M > 0, nu = w^2/g [1]
    a1, a3 (s,): map coefficients [1]
    angle (n,): theta on the contour, ascending in (0, pi/2] [rad]

    With Z = xi + a1/xi + a3/xi^3 the free surface asks F' - i K Z' F to be real on the real axis, |xi| > 1. So it
    is for

        F(xi) = e^{iKZ(xi)} int_xi^inf e^{-iKZ(s)} R(s) ds,    R(s) = sum_m w_m s^{-p_m},  w_m real;

    for a circle and R = 1/s that is e^{iKxi} E1(iKxi), Ursell's source. Adding i pi c e^{iKZ}, c the residue of
    e^{-iKZ} R, makes Re F even (odd) across the centre plane below the keel; a standing wave in quadrature, amplitude
    -i pi c cos (odd, i c the residue: +i pi c sin), leaves only outgoing waves. The weights w_m are the residues c_m of
    the single powers, normalised: c = sum w_m c_m never vanishes, while one power makes no waves at some frequencies
    (on a flat plate those of J_0(2K) = 0).
    Source: [Ursell49] source potential, carried to the plane of the mapped circle.
    Valid: deep water, 1e-8 <= K <= 100.
    """
    p = POWERS[symmetry]
    weight, strength = _weights(wavenumber, a1, a3, p, symmetry)
    K, point = wavenumber[..., None], _map(a1, a3, np.exp(1j * angle))
    xi = np.exp(1j * angle)
    xi_Z = xi - a1[:, None] / xi - 3.0 * a3[:, None] / xi**3
    start = _ray_integral(wavenumber, a1, a3, weight, p)
    F = _march(wavenumber, a1, a3, angle, weight, p, start)
    wave = np.exp(1j * K * point)
    c = np.pi * strength[..., None]
    turned = 1j * c if symmetry == "even" else -c  # i pi times the residue, which is real or imaginary
    F = F + turned * wave
    R = _singular_part(weight, p, xi)
    slope = 1j * K * xi_Z
    if symmetry == "even":
        potential = F.real - 1j * c * wave.real
        flux = (slope * F - xi * R).real - 1j * c * (slope * wave).real
        far = -1j * np.pi * strength
    else:
        potential = F.real + 1j * c * wave.imag
        flux = (slope * F - xi * R).real + 1j * c * (slope * wave).imag
        far = -np.pi * strength + 0j
    return Wavemaker(potential, flux, np.asarray(far, dtype=np.complex128))


def _map(a1: Floats, a3: Floats, xi: Complexes) -> Complexes:
    return np.asarray(xi + a1[:, None] / xi + a3[:, None] / xi**3)


def _singular_part(weight: Floats, p: Floats, s: Complexes) -> Complexes:
    square = s**-2.0
    total = weight[..., -1:] * square
    for m in range(p.size - 2, 0, -1):
        total = (total + weight[..., m, None]) * square
    return np.asarray((total + weight[..., 0, None]) * s ** -p[0])


def _weights(K: Floats, a1: Floats, a3: Floats, p: Floats, symmetry: Symmetry) -> tuple[Floats, Floats]:
    """Weights w_m (f, s, m) of the powers and the strength c (f, s); residues by the midpoint rule on a ring."""
    radius = np.clip(np.sqrt(np.maximum(np.abs(a1), np.sqrt(3.0 * np.abs(a3)))), 0.3, 1.0)
    phase = (np.arange(_RING_POINTS) + 0.5) * np.pi / _RING_POINTS - np.pi / 2.0
    s = radius[:, None] * np.exp(1j * phase)
    kernel = np.exp(-1j * K[..., None] * _map(a1, a3, s))
    powers = s[..., None] ** (1.0 - p) / _RING_POINTS
    # the left half of the ring is the mirror image: it doubles the real (imaginary) part and cancels the other
    residue = np.matmul(kernel.swapaxes(0, 1), powers).swapaxes(0, 1)
    c = residue.real if symmetry == "even" else residue.imag
    weight = c / np.linalg.norm(c, axis=-1, keepdims=True)
    return weight, (weight * c).sum(axis=-1)


def _ray_integral(K: Floats, a1: Floats, a3: Floats, weight: Floats, p: Floats) -> Complexes:
    """F at the waterline xi = 1: along s = 1 - i t the kernel decays; t = exp(x - e^-x) suits the trapezoid rule."""
    lowest = -3.6
    highest = np.maximum(np.log(45.0 / K) + 1.0, 1.5)
    step = (highest - lowest) / (_RAY_POINTS - 1)
    x = lowest + step[..., None] * np.arange(_RAY_POINTS)
    t = np.exp(x - np.exp(-x))
    s = 1.0 - 1j * t
    Z = s + a1[:, None] / s + a3[:, None] / s**3
    kernel = np.exp(1j * K[..., None] * ((1.0 + a1 + a3)[:, None] - Z))
    integrand = kernel * _singular_part(weight, p, s) * t * (1.0 + np.exp(-x))
    return np.asarray(-1j * step * integrand.sum(axis=-1))


def _march(K: Floats, a1: Floats, a3: Floats, angle: Floats, weight: Floats, p: Floats, start: Complexes) -> Complexes:
    """F along the contour from the waterline down, Gauss rule between neighbours; every exponential stays below one."""
    edges = np.concatenate([[0.0], angle])
    x, w = np.polynomial.legendre.leggauss(_STEP_POINTS)
    half = np.diff(edges)[:, None] / 2.0
    xi = np.exp(1j * (edges[:-1, None] + half * (x + 1.0)))
    inner = _map(a1, a3, xi.ravel()).reshape(a1.size, *xi.shape)
    outer = _map(a1, a3, np.exp(1j * edges))
    kernel = np.exp(1j * K[..., None, None] * (outer[:, 1:, None] - inner))
    source = (_singular_part(weight, p, xi.ravel()) * xi.ravel()).reshape(*weight.shape[:2], *xi.shape)
    step = -1j * (kernel * source * (half * w)).sum(axis=-1)
    carry = np.exp(1j * K[..., None] * np.diff(outer, axis=-1))
    F = np.empty(step.shape, dtype=np.complex128)
    value = start
    for j in range(angle.size):
        value = carry[..., j] * value + step[..., j]
        F[..., j] = value
    return F
