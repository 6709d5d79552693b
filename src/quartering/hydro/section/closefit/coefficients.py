"""Radiation and diffraction by sections of any shape in deep water: a boundary-element solution on their own contours.

The unknown is the potential on the half contour. Cauchy's integral of the wave-free velocity F' - i nu F over the
contour and its mirror images gives real equations that are linear in the wavenumber (`cauchy`); one complex row, the
only one with exponential integrals, lets waves run outward only (`standing`). Opposite sides of a thin section are one
unknown, and no interior wave problem exists that could put a spike at an irregular frequency.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Final, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering._machine.threads import in_threads
from quartering.conventions import GRAVITY, WATER_DENSITY, InputError
from quartering.hull.lines.section import Floats
from quartering.hydro.section.closefit.grid import Nodes, interpolation, nodes_on
from quartering.hydro.section.closefit.kernel import CauchyRows, Stream, cauchy_rows, rigid_stream
from quartering.hydro.section.multipole import Radiation
from quartering.hydro.section.outline import Outline
from quartering.hydro.section.wavemaker import Complexes, Symmetry

PANELS: Final = 25
"""Panels on the half contour: 1e-3 or better for smooth sections and for rectangles, 5e-3 for offsets with kinks."""
SCALED_WAVENUMBERS: Final = (1e-8, 100.0)
"""Range of nu times the section's largest extent in which the problem is solved; outside it is held at its end."""


@dataclass(frozen=True, eq=False)
class _Problem:
    """Sections with the same number of panels and one symmetry, stacked (s, ...)."""

    nodes: tuple[Nodes, ...]
    rows: tuple[CauchyRows, ...]
    symmetry: Symmetry
    slope: Floats
    unknowns: Complexes
    normal: Floats
    submerged: NDArray[np.bool_]
    size: Floats

    @property
    def node(self) -> Complexes:
        return np.stack([n.point for n in self.nodes])

    @property
    def tangent(self) -> Complexes:
        return np.stack([n.tangent for n in self.nodes])

    @property
    def normals(self) -> Complexes:
        """(n_y + i n_z) ds at the nodes, outward, with the weights of the trapezoid rule [m]."""
        return np.stack([_normals(n) for n in self.nodes])


def close_fit(
    outlines: Sequence[Outline],
    frequency: ArrayLike,
    modes: Literal["heave", "lateral"] = "lateral",
    *,
    density: float = WATER_DENSITY,
    panels: int = PANELS,
) -> Radiation:
    """Added mass, damping and contour potentials of sections of any shape oscillating in calm deep water.

    outlines: (s,) sections
    frequency (f,): w >= 0 [rad/s]
    density: of the water [kg/m3]
    panels: on the half contour, at least 8
    Returns on panels - 1 contour points; its residual is the relative difference of the damping by pressure and by
        radiated waves

    a + b/(iw) = -rho int psi_i n_j ds; b_ij = rho w Re(D_i conj D_j) from the waves D far away.
    In heave a33 grows without bound as w -> 0 (infinite at w = 0).
    The error falls with the third power of the panels on smooth contours, about the second with corners: 25 panels give
    2e-5 for a half circle and 3e-4 for rectangles, 36 panels 1e-4.
    Source: [Frank67] section problem; solved by Cauchy's theorem for the wave-free velocity, on [Kress90] meshes.
    Valid: deep water, small motions, contours symmetric in y; beyond nu times the extent = 100 values are held.
    """
    w = _frequencies(frequency)
    problem = _problem(tuple(outlines), panels, "even" if modes == "heave" else "odd")
    nu = _wavenumbers(problem, (w**2 / GRAVITY)[:, None])
    streams = [rigid_stream(n, problem.symmetry) for n in problem.nodes]
    phi, D = _solve(problem, nu, streams, 1 if modes == "heave" else 2)
    normal = problem.normals
    velocity = _normal_velocities(problem.node, normal, problem.symmetry)
    pressure = -2.0 * density * np.einsum("fsni,snj->fsij", phi, velocity)
    a = 0.5 * (pressure.real + pressure.real.swapaxes(-1, -2))
    if modes == "heave":
        a[w == 0.0] = np.inf
    b = density * w[:, None, None, None] * (D[..., :, None] * D[..., None, :].conj()).real
    outer = normal[:, -2:0:-1].copy()
    outer[:, 0] += normal[:, -1]  # the last trace of the ends, whose nodes have no part of the contour
    outer[:, -1] += normal[:, 0]
    return Radiation(a, b, phi[:, :, -2:0:-1], D, _mismatch(pressure, D, density), problem.node[:, -2:0:-1], outer)


def _normals(nodes: Nodes) -> Complexes:
    normal = 1j * nodes.tangent
    normal[[0, -1]] *= 0.5
    return np.asarray(normal)


def _mismatch(pressure: Complexes, D: Complexes, density: float) -> Floats:
    """Difference of the damping by pressure and by waves over the size of the complex added mass (f, s, k)."""
    own = np.diagonal(pressure, axis1=-2, axis2=-1)
    radiated = density * np.abs(D) ** 2
    size = np.abs(own.real - 1j * radiated)
    return np.asarray(np.abs(-own.imag - radiated) / np.where(size > 0.0, size, 1.0))


def _frequencies(frequency: ArrayLike) -> Floats:
    w = np.atleast_1d(np.asarray(frequency, dtype=float))
    if w.ndim != 1 or not (np.isfinite(w) & (w >= 0.0)).all():
        raise InputError(f"frequency {frequency!r} [rad/s]: give a list of finite numbers >= 0")
    return w


@lru_cache(maxsize=16)
def _problem(outlines: tuple[Outline, ...], panels: int, symmetry: Symmetry) -> _Problem:
    nodes = tuple(nodes_on(outline, panels) for outline in outlines)
    rows = tuple(cauchy_rows(n, symmetry) for n in nodes)
    odd = symmetry == "odd"
    unknowns = np.stack([_on_unknowns(r) for r in rows])
    return _Problem(
        nodes,
        rows,
        symmetry,
        np.stack([interpolation(n.split, odd).node_slope for n in nodes]),
        unknowns,
        _normal_matrix(unknowns, np.array([odd and n.submerged for n in nodes])),
        np.array([n.submerged for n in nodes]),
        np.array([outline.size for outline in outlines]),
    )


def _on_unknowns(rows: CauchyRows) -> Complexes:
    """Rows on the unknowns (2, n, n+1): nodal potentials; if odd, without the keel, and nu times the stream constant."""
    if rows.symmetry == "even":
        return rows.potential
    constant = rows.of_stream(rigid_stream(rows.nodes, "odd"))[1, :, 2:]
    constant = np.stack([constant, np.zeros_like(constant)])
    matrix = np.concatenate([rows.potential[:, :, 1:], constant], axis=2)
    if rows.nodes.submerged:
        matrix[:, :, -2] = 0.0  # the top lies on the centre plane
    return matrix


def _normal_matrix(unknowns: Complexes, vanishing: NDArray[np.bool_]) -> Floats:
    """Re (A0 + nu A1)* (A0 + nu A1) as parts with 1, nu, nu^2 (s, 3, n+1, n+1); 1 for a potential that vanishes."""
    a, b = unknowns[:, 0], unknowns[:, 1]
    aa, ab, bb = (_product(x, y) for x, y in ((a, a), (a, b), (b, b)))
    aa[vanishing, -2, -2] = 1.0
    return np.stack([aa, ab + ab.swapaxes(1, 2), bb], axis=1)


def _product(left: Complexes, right: Complexes) -> Floats:
    """Re left* right of each section, summed in a fixed order: the same bits however many threads a library uses."""
    x, y = (np.concatenate([m.real, m.imag], axis=1) for m in (left, right))
    return np.asarray(np.einsum("snk,snl->skl", x, y, optimize=False))


def _wavenumbers(problem: _Problem, nu: Floats) -> Floats:
    low, high = SCALED_WAVENUMBERS
    return np.clip(nu, low / problem.size, high / problem.size)


def _solve(problem: _Problem, nu: Floats, streams: Sequence[Stream], count: int) -> tuple[Complexes, Complexes]:
    """Nodal potentials (f, s, n+1, m) and far waves (f, s, m) of the first ``count`` stream functions of each section."""
    known = _right_side(problem, nu, streams, count)
    value = np.stack([stream.node[:, :count] for stream in streams])[None]
    slope = np.stack([stream.node_slope[:, :count] for stream in streams])[None]
    return _outgoing(problem, nu, known, value, slope)


def _right_side(problem: _Problem, nu: Floats, streams: Sequence[Stream], count: int) -> Floats:
    """Right-hand side of the normal equations (f, s, n+1, m)."""
    parts = np.stack([r.of_stream(stream)[..., :count] for r, stream in zip(problem.rows, streams, strict=True)])
    a, b, c, d = problem.unknowns[:, 0], problem.unknowns[:, 1], parts[:, 0], parts[:, 1]
    ac, ad, bc, bd = (-_product(x, y) for x, y in ((a, c), (a, d), (b, c), (b, d)))
    factor = nu[:, :, None, None]
    return np.asarray(ac + factor * (ad + bc + factor * bd))


def _outgoing(
    problem: _Problem, nu: Floats, known: Floats, value: Floats, slope: Floats
) -> tuple[Complexes, Complexes]:
    """Nodal potentials and far waves for a right-hand side (f, s, n+1, m) and its stream functions at the nodes."""
    from quartering.hydro.section.closefit.solve import standing_waves  # a kernel, which a table on disk needs not

    f, s, n, m = known.shape
    phi = np.empty((f, s, n, m), dtype=np.complex128)
    wave = np.empty((f, s, m), dtype=np.complex128)
    in_threads(
        standing_waves, f * s, nu, 1.0 if problem.symmetry == "odd" else -1.0, problem.submerged, problem.normal,
        known, problem.node, problem.tangent, problem.slope, value, slope, phi, wave,
    )  # fmt: skip
    depth = np.minimum(nu * problem.node[:, -1].imag, 300.0)  # waves are counted at the last node: up to the surface
    return phi, wave * np.exp(depth)[..., None]


def _normal_velocities(point: Complexes, normal: Complexes, symmetry: Symmetry) -> Floats:
    """Unit motions' normal velocities times arc length (s, n, k): n_z, or n_y and y n_z - z n_y."""
    if symmetry == "even":
        return np.asarray(normal.imag[..., None])
    return np.stack([normal.real, (point.conj() * normal).imag], axis=-1)


def close_fit_limits(
    outlines: Sequence[Outline], density: float = WATER_DENSITY, *, panels: int = PANELS
) -> tuple[Floats, Floats, Floats]:
    """Added mass for zero frequency (a rigid lid on the water) and for infinite frequency (no potential there).

    outlines: (s,) sections
    density: of the water [kg/m3]
    panels: on the half contour
    Returns (s, 3): a22 [kg/m], a24 [kg], a44 [kg m] for w -> 0, about the waterline point; (s, 3): the same for w ->
        infinity; (s,): a33 for w -> infinity [kg/m]; it grows without bound for w -> 0

    The constant part of the equations alone, and the part multiplied by nu alone with phi = 0 at the waterline.
    Source: [Frank67] limits.  Valid: contours symmetric in y.
    """
    lateral, heave = (_problem(tuple(outlines), panels, symmetry) for symmetry in ("odd", "even"))
    zero = np.stack([_limit(lateral, s, density, 0) for s in range(len(outlines))])
    infinite = np.stack([_limit(lateral, s, density, 1) for s in range(len(outlines))])
    flat = np.array([_limit(heave, s, density, 1)[0] for s in range(len(outlines))])
    return zero, infinite, flat


def _limit(problem: _Problem, s: int, density: float, order: int) -> Floats:
    """a22, a24, a44 (or a33 alone) of one section when only one part of its equations counts."""
    nodes, odd = problem.nodes[s], problem.symmetry == "odd"
    stream = rigid_stream(nodes, problem.symmetry)
    known = problem.rows[s].of_stream(stream)[order][:, : 2 if odd else 1]
    n = nodes.middle.size
    matrix = problem.rows[s].potential[order]
    dropped = [0] if odd or order == 0 else []  # phi = 0 at the keel, or known up to a constant
    if (order == 1 and not nodes.submerged) or (odd and nodes.submerged):
        dropped.append(n)  # phi = 0 at the waterline, or at the top
    kept = np.setdiff1d(np.arange(n + 1), dropped)
    matrix = matrix[:, kept]
    if odd and order == 1:
        matrix = np.concatenate([matrix, problem.unknowns[s, 0][:, -1:]], axis=1)
    real = np.concatenate([matrix.real, matrix.imag])
    solution, *_ = np.linalg.lstsq(real, -np.concatenate([known.real, known.imag]), rcond=None)
    phi = np.zeros((n + 1, known.shape[1]))
    phi[kept] = solution[: kept.size]
    velocity = _normal_velocities(nodes.point, _normals(nodes), problem.symmetry)
    a = -2.0 * density * phi.T @ velocity
    return np.array([a[0, 0], 0.5 * (a[0, 1] + a[1, 0]), a[1, 1]]) if odd else a[0]
