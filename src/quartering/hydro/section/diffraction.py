"""Wave forces on a section held fixed in a beam or oblique wave: diffraction solved directly and by Haskind's relation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, Literal

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import GRAVITY, WATER_DENSITY, InputError
from quartering.hull.lines.section import Floats
from quartering.hydro.section.closefit.coefficients import (
    PANELS,
    _frequencies,
    _outgoing,
    _problem,
    _right_side,
    _wavenumbers,
    close_fit,
)
from quartering.hydro.section.closefit.grid import Nodes, interpolation
from quartering.hydro.section.closefit.kernel import Stream
from quartering.hydro.section.outline import Outline
from quartering.hydro.section.wavemaker import Complexes, Symmetry

Form = Literal["direct", "haskind"]
_MODES: Final[tuple[Symmetry, Symmetry]] = ("odd", "even")


def section_diffraction(
    outlines: Sequence[Outline],
    frequency: ArrayLike,
    heading: ArrayLike,
    form: Form = "haskind",
    *,
    density: float = WATER_DENSITY,
    panels: int = PANELS,
) -> Complexes:
    """Diffraction force on fixed sections in regular waves, per metre of length and of wave amplitude, at zero speed.

    outlines: (s,) sections
    frequency (f,): w > 0 [rad/s]
    heading (h,): mu: 0 following, 90 beam (from port), 180 head [deg]
    form: From the radiation potentials, or from the scattered potential solved on the contour.
    density: of the water [kg/m3]
    panels: on the half contour
    Returns (f, s, h, 3): sway, heave [N/m per m] and roll about the waterline point [N m/m per m], phasors of e^{i w
        t}, z down, wave elevation (down) sin w t at the section

    The orbital velocity u ~ e^{-k z - i k sin(mu) y} meets the contour with u.n; the two-dimensional scattered potential
    phi has the normal velocity -u.n. F_j = -i w rho int psi_j (u.n) ds (Haskind) = i w rho int phi n_j ds (direct).
    Source: [STF70] sectional diffraction; [Frank67] section problem.
    Valid: deep water; sections slender against the wave along the ship (no e^{i k cos(mu) x} variation in the solution).
    """
    if form not in ("haskind", "direct"):
        raise InputError(f"form {form!r} is unknown; allowed: haskind, direct")
    w = _frequencies(frequency)
    mu = np.atleast_1d(np.asarray(heading, dtype=float))
    if not ((w > 0.0).all() and np.isfinite(mu).all()):
        raise InputError("frequencies must be above 0 rad/s and headings finite degrees")
    k, across = w**2 / GRAVITY, np.sin(np.deg2rad(mu))
    if form == "direct" and any(o.submerged for o in outlines) and (np.abs(np.abs(across) - 1.0) > 1e-9).any():
        raise InputError("the direct form needs a beam wave (heading 90 or -90) for a submerged section; use haskind")
    solve = _by_haskind if form == "haskind" else _directly
    odd, even = (solve(tuple(outlines), w, k, across, symmetry, density, panels) for symmetry in _MODES)
    return np.stack([odd[..., 0], even[..., 0], odd[..., 1]], axis=-1)


def _by_haskind(
    outlines: tuple[Outline, ...], w: Floats, k: Floats, across: Floats, symmetry: Symmetry, density: float, panels: int
) -> Complexes:
    solution = close_fit(outlines, w, "lateral" if symmetry == "odd" else "heave", density=density, panels=panels)
    flux = _through(solution.point, solution.normal, k, across, symmetry)
    integral = np.einsum("fsnj,fshn->fshj", solution.potential, flux)
    return -2j * density * w[:, None, None, None] * _speed(w, symmetry) * integral


def _directly(
    outlines: tuple[Outline, ...], w: Floats, k: Floats, across: Floats, symmetry: Symmetry, density: float, panels: int
) -> Complexes:
    problem = _problem(outlines, panels, symmetry)
    nu = _wavenumbers(problem, k[:, None])
    streams = [[_incident_stream(n, float(ki), across, symmetry) for n in problem.nodes] for ki in k]
    known = np.stack([_right_side(problem, nu[f : f + 1], streams[f], across.size)[0] for f in range(w.size)])
    value, slope = (np.stack([[getattr(s, name) for s in row] for row in streams]) for name in ("node", "node_slope"))
    phi, _ = _outgoing(problem, nu, known, value, slope)
    normal = problem.normals
    unit = normal.imag[..., None]
    if symmetry == "odd":
        unit = np.stack([normal.real, (problem.node.conj() * normal).imag], axis=-1)
    integral = np.einsum("fsnh,snj->fshj", phi, unit)  # phi has +u.n; the scattered wave has the opposite sign
    return -2j * density * w[:, None, None, None] * _speed(w, symmetry) * integral


def _speed(w: Floats, symmetry: Symmetry) -> Complexes:
    """Factor of the real flux of `_through`: the orbital velocity per amplitude, in its phase."""
    return np.asarray((1j if symmetry == "odd" else 1.0 + 0j) * w[:, None, None, None])


def _through(point: Complexes, normal: Complexes, k: Floats, across: Floats, symmetry: Symmetry) -> Floats:
    """Flux u.n ds of the wave over its speed factor (f, s, h, n): the part of one symmetry, real."""
    y, z = point.real[:, None], point.imag[:, None]
    ny, nz = normal.real[:, None], normal.imag[:, None]
    wave, side = k[:, None, None, None], across[:, None]
    phase = wave * side * y
    if symmetry == "odd":
        return np.asarray(np.exp(-wave * z) * (side * np.cos(phase) * ny - np.sin(phase) * nz))
    return np.asarray(np.exp(-wave * z) * (side * np.sin(phase) * ny + np.cos(phase) * nz))


def _incident_stream(nodes: Nodes, k: float, across: Floats, symmetry: Symmetry) -> Stream:
    """Stream function of the wave's flux through the contour, one column for each heading."""
    rule = interpolation(nodes.split, False)
    wave = np.array([k])
    at_node = -_through(nodes.point[None], 1j * nodes.tangent[None], wave, across, symmetry)[0, 0].T
    at_middle = -_through(nodes.middle[None], 1j * nodes.middle_tangent[None], wave, across, symmetry)[0, 0].T
    value = np.zeros_like(at_node)
    value[1:] = np.linalg.solve(rule.slope[:, 1:], at_middle)
    return Stream(value, at_node, rule.value @ value, at_middle, np.diff(at_node, axis=0))
