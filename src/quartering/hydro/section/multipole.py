"""Two-dimensional radiation by Lewis forms in deep water: multipole expansion in the plane of the mapped circle."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Final, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import GRAVITY, WATER_DENSITY, InputError
from quartering.hull.lines.section import Floats
from quartering.hydro.section.lewis import LewisForms, lewis_contour
from quartering.hydro.section.wavemaker import Complexes, Symmetry, wavemaker

CONTOUR_POINTS: Final = 24
"""Gauss-Legendre points in theta on the half contour."""
MULTIPOLES: Final = 14
"""Single wave-free potentials; three more gather the waterline corner."""
CORNER_POWERS: Final = (3.0, 4.0, 5.0)
"""Wave-free potentials summed with weights n^-p: they carry the weak singularity at the waterline."""
SCALED_WAVENUMBERS: Final = (1e-8, 100.0)
"""Range of nu M in which the problem is solved; outside it is held at the end of the range."""

_CORNER_TERMS: Final = 20_000


class _Nodes(NamedTuple):
    """Angles, weights and what wave-free potentials are on them for any section: xi^-n, n xi^-n, correction terms."""

    angle: Floats
    weight: Floats
    power: Complexes
    slope: Complexes
    correction: Complexes


@dataclass(frozen=True, eq=False)
class Radiation:
    """Forces and potentials of unit-velocity motions of Lewis forms, about the waterline point, z down.

    Modes k are (heave,) or (sway, roll); e^{+i w t}; all for both sides of the section, per metre of length.

    Parameters
    ----------
    added_mass : (f, s, k, k) float    a_ij, i force, j motion [kg/m, kg, kg m]
    damping : (f, s, k, k) float       b_ij from the radiated wave energy [kg/(m s), kg/s, kg m/s]
    potential : (f, s, n, k) complex   on the starboard contour per unit velocity [m, m2]
    wave : (f, s, k) complex           D: potential -> D exp(-nu z - i nu y) far to starboard [m, m2]
    residual : (f, s, k) float         root mean square error of the normal velocity over its own [1]
    point : (s, n) complex             contour points y + i z, waterline to keel [m]
    normal : (s, n) complex            (n_y + i n_z) ds with the quadrature weight, outward [m]
    """

    added_mass: Floats
    damping: Floats
    potential: Complexes
    wave: Complexes
    residual: Floats
    point: Complexes
    normal: Complexes


def radiation(
    forms: LewisForms,
    frequency: ArrayLike,
    modes: Literal["heave", "lateral"] = "lateral",
    *,
    density: float = WATER_DENSITY,
    points: int = CONTOUR_POINTS,
    multipoles: int = MULTIPOLES,
) -> Radiation:
    """Added mass, damping and contour potentials of Lewis forms oscillating in calm deep water.

    forms: (s,) sections
    frequency (f,): w >= 0 [rad/s]
    density: of the water [kg/m3]
    points: quadrature points on the half contour
    multipoles: wave-free potentials, fewer than points - 3

    phi = C phi_w + sum_n X_n Re[xi^-n + i K ( xi^{1-n}/(1-n) + a1 xi^{-1-n}/(n+1) + 3 a3 xi^{-3-n}/(n+3) )],
    n = 2, 4, .. in heave, 3, 5, .. in sway and roll, phi_w the wavemaker; C, X by least squares of the normal velocity.
    phi is singular like W^2 ln W at the waterline corner, so three of the unknowns multiply whole series
    sum_n n^-p (...), p = 3, 4, 5, which share that singularity: the error then falls geometrically.
    a + b/(iw) = -rho int psi_i n_j ds; b_ij = rho w Re(D_i conj D_j).
    In heave a33 grows without bound as w -> 0 (infinite at w = 0).
    Source: [Ursell49], [Tasai61]; the wave-making singularity and the corner series are derived here.
    Valid: deep water, small motions, nu B/2 up to about 20; beyond nu M = 100 the values there are held.
    """
    w = _frequencies(frequency)
    if multipoles + len(CORNER_POWERS) + 1 > points or multipoles < 1:
        raise InputError(
            f"{multipoles} multipoles on {points} contour points; give at least 1 and at most {points - 4} multipoles"
        )
    symmetry: Symmetry = "even" if modes == "heave" else "odd"
    nodes = _nodes(points, multipoles, symmetry)
    K = np.clip((w**2 / GRAVITY)[:, None] * forms.scale, *SCALED_WAVENUMBERS)
    point, normal = lewis_contour(forms, nodes.angle)
    velocity = _normal_velocities(point, normal, symmetry)  # (s, n, k), times ds/dtheta
    basis, flux, far = _basis(K, forms, nodes, symmetry)
    coefficient, residual = _least_squares(flux, velocity, np.sqrt(nodes.weight))
    psi = np.matmul(basis, coefficient)
    D = far[..., None] * coefficient[..., 0, :]
    pressure = -2.0 * density * np.einsum("fsni,snj->fsij", psi, velocity * nodes.weight[:, None])
    a = 0.5 * (pressure.real + pressure.real.swapaxes(-1, -2))
    if modes == "heave":
        a[w == 0.0] = np.inf
    b = density * w[:, None, None, None] * (D[..., :, None] * D[..., None, :].conj()).real
    return Radiation(a, b, psi, D, residual, point, normal * nodes.weight)


def _frequencies(frequency: ArrayLike) -> Floats:
    w = np.atleast_1d(np.asarray(frequency, dtype=float))
    if w.ndim != 1 or not (np.isfinite(w) & (w >= 0.0)).all():
        raise InputError(
            f"frequency {frequency!r} [rad/s]: give a list of finite numbers >= 0; "
            "the limits for infinite frequency have a function of their own"
        )
    return w


@lru_cache(maxsize=16)
def _nodes(points: int, multipoles: int, symmetry: Symmetry) -> _Nodes:
    """Gauss nodes with the wave-free potentials, single ones first, then the corner series."""
    x, weight = np.polynomial.legendre.leggauss(points)
    angle = (x + 1.0) * np.pi / 4.0
    xi = np.exp(1j * angle)[:, None]
    first = 2 if symmetry == "even" else 3
    n = np.arange(first, first + 2 * multipoles, 2, dtype=float)
    series = np.arange(first, _CORNER_TERMS, 2, dtype=float)
    share = series[:, None] ** -np.array(CORNER_POWERS)
    power = np.exp(-1j * angle[:, None] * series)

    def both(factor: Floats, single: Floats) -> Complexes:
        return np.concatenate([xi**-n * single, power @ (share * factor[:, None])], axis=1)

    correction = np.stack(
        [
            both(1.0 / (1.0 - series), 1.0 / (1.0 - n)) * xi,
            both(1.0 / (series + 1.0), 1.0 / (n + 1.0)) / xi,
            both(3.0 / (series + 3.0), 3.0 / (n + 3.0)) / xi**3,
        ]
    )
    ones = np.ones_like
    return _Nodes(angle, weight * np.pi / 4.0, both(ones(series), ones(n)), both(series, n), correction)


def _normal_velocities(point: Complexes, normal: Complexes, symmetry: Symmetry) -> Floats:
    if symmetry == "even":
        return np.asarray(normal.imag[..., None])  # n_z
    return np.stack([normal.real, (point.conj() * normal).imag], axis=-1)  # n_y, y n_z - z n_y


def _basis(K: Floats, forms: LewisForms, nodes: _Nodes, symmetry: Symmetry) -> tuple[Complexes, Complexes, Complexes]:
    """Potentials and fluxes (f, s, n, unknown) on the contour and the far wave (f, s) of the first of them."""
    made = wavemaker(K, forms.a1, forms.a3, nodes.angle, symmetry)
    a1, a3 = forms.a1[:, None, None], forms.a3[:, None, None]
    xi = np.exp(1j * nodes.angle)[:, None]
    stretch = xi - a1 / xi - 3.0 * a3 / xi**3
    added = nodes.correction[0] + a1 * nodes.correction[1] + a3 * nodes.correction[2]
    size = K[..., None, None]
    free_potential = nodes.power.real - size * added.imag
    free_flux = -nodes.slope.real - size * (stretch * nodes.power).imag
    potential = np.concatenate([made.potential[..., None], free_potential], axis=-1)
    flux = np.concatenate([made.flux[..., None], free_flux], axis=-1)
    return potential, flux, made.wave


def _least_squares(flux: Complexes, velocity: Floats, root_weight: Floats) -> tuple[Complexes, Floats]:
    """Unknowns that fit the normal velocity, columns scaled to unit length, by QR; and the relative misfit."""
    rows = flux * root_weight[:, None]
    length = np.linalg.norm(rows, axis=-2, keepdims=True)
    rows = rows / length
    target = velocity * root_weight[:, None]
    q, r = np.linalg.qr(rows)
    solution = np.linalg.solve(r, np.matmul(q.conj().swapaxes(-1, -2), target))
    misfit = np.linalg.norm(np.matmul(rows, solution) - target, axis=-2)
    size = np.linalg.norm(target, axis=-2)
    residual = misfit / np.where(size > 1e-9 * np.linalg.norm(root_weight), size, 1.0)
    return solution / length.swapaxes(-1, -2), residual
