"""Cauchy's integral theorem on a section and its mirror images, as a matrix that is linear in the wavenumber."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from quartering.hull.lines.section import Floats
from quartering.hydro.section.closefit.grid import Interpolation, Nodes, interpolation
from quartering.hydro.section.wavemaker import Complexes, Symmetry


class Stream(NamedTuple):
    """A stream function on the contour, d psi/d theta = -(normal velocity) ds/d theta; columns are motions.

    Parameters
    ----------
    node, node_slope : (n+1, m) float              at the nodes
    middle, middle_slope, middle_curvature : (n, m)  at the collocation points
    """

    node: Floats
    node_slope: Floats
    middle: Floats
    middle_slope: Floats
    middle_curvature: Floats


@dataclass(frozen=True, eq=False)
class CauchyRows:
    """Complex rows that say: no wave-free velocity inside the body.

    They multiply the nodal potentials and the stream function, both real, and each is meant times |dZ/d theta|.

    Parameters
    ----------
    nodes : Nodes
    symmetry : "even" (heave) or "odd" (sway, roll)
    potential : (2, n, n+1) complex        on phi at the nodes: constant part and part to be multiplied by nu
    sheet : (2, n, n+1) complex            on d psi/d theta (constant part) and psi (part with nu) at the nodes
    near : (2, n, 3) complex               on d psi/d theta, d2 psi/d theta2, psi at the collocation points
    """

    nodes: Nodes
    symmetry: Symmetry
    potential: Complexes
    sheet: Complexes
    near: Complexes

    def of_stream(self, stream: Stream) -> Complexes:
        """What a stream function adds to the rows: constant part and part to be multiplied by nu (2, n, m)."""
        middle = np.stack([stream.middle_slope, stream.middle_curvature, stream.middle])
        nodal = (stream.node_slope, stream.node)
        return np.stack([self.sheet[k] @ nodal[k] + np.einsum("nk,knm->nm", self.near[k], middle) for k in (0, 1)])


def cauchy_rows(nodes: Nodes, symmetry: Symmetry) -> CauchyRows:
    """Discretise Cauchy's integral of the wave-free velocity over an outline and its three mirror images.

    F = phi + i psi is the complex potential, Z = y + i z (z down). The free-surface condition says that
    H = F' - i nu F is real on z = 0, so H continues to the mirror image of the body, H(conj Z) = conj H(Z), and to the
    port side, H(-Z) = +-H(Z). H is analytic outside the double body and vanishes at infinity, hence

        oint H dZ/(Z - zeta) = 0 inside the body;  on the contour  PV oint H dZ/(Z - zeta) - i pi H(zeta) = 0,

    with H dZ = (phi' + i psi') d theta - i nu (phi + i psi) dZ and psi known from the normal velocity: equations for
    phi, linear in nu, without a wave function. They say that an analytic function vanishes inside the body, not a wave
    potential: there is no interior wave problem, so there are no irregular frequencies.
    The integral is the trapezoid rule on the nodes; collocation half-way between them makes its principal value exact to
    the order of the rule. Where the opposite side of a thin section (or the image of a flat one) is near, the pole at
    complex theta* misses the trapezoid rule by i pi sgn(Im theta*) - pi tan(pi theta*) times its residue, which is added.
    Both components of the complex equation are kept (for least squares): which of the two carries the solution differs
    between the sides of a thin section, flat parts and corners.
    Source: [Frank67] section problem; the wave-free velocity is [Ursell49]'s condition in complex form; [Kress90] mesh.
    Valid: deep water, contours symmetric in y.

    A circle moving sideways under a rigid lid (nu = 0) has the potential -y/r2:

    >>> import numpy as np
    >>> from quartering.hull.lines.section import Section
    >>> from quartering.hydro.section.outline import section_outline
    >>> from quartering.hydro.section.closefit.grid import nodes_on
    >>> t = np.linspace(0.0, np.pi / 2, 400)
    >>> nodes = nodes_on(section_outline(Section(np.sin(t), np.cos(t))), 24)
    >>> rows = cauchy_rows(nodes, "odd")
    >>> known = rows.of_stream(rigid_stream(nodes, "odd"))[0]
    >>> bool(np.abs(rows.potential[0] @ -nodes.point.real + known[:, 0])[2:-2].max() < 1e-4)
    True
    """
    odd = symmetry == "odd"
    rule = interpolation(nodes.split, odd)
    first, second = _kernels(nodes, 1.0 if odd else -1.0)
    T, t = nodes.tangent, nodes.middle_tangent[:, None]
    on_slope = np.einsum("ni,ij->nj", first - second, rule.node_slope, optimize=False)  # the same bits with any threads
    constant = on_slope - 1j * np.pi * rule.slope / t
    linear = -1j * (first * T + second * T.conj()) - np.pi * rule.value
    sheet = np.stack([1j * (first + second), first * T - second * T.conj()])
    near = np.zeros((2, t.size, 3), dtype=complex)
    near[0, :, 0], near[1, :, 2] = np.pi / t[:, 0], -1j * np.pi
    for factor, step in _near_poles(nodes, 1.0 if odd else -1.0):
        constant, linear, near = _with_near_pole(constant, linear, near, nodes, rule, factor, step)
    size = np.abs(t)
    return CauchyRows(nodes, symmetry, size * np.stack([constant, linear]), size * sheet, size * near)


def _kernels(nodes: Nodes, sign: float) -> tuple[Complexes, Complexes]:
    """Kernels (n, n+1) of h and of conj h, the images folded onto the starboard contour; trapezoid weights included."""
    Z, zeta = nodes.point, nodes.middle[:, None]
    weight = np.ones(Z.size)
    weight[[0, -1]] = 0.5
    direct = 1.0 / (Z - zeta) + sign / (Z + zeta)
    mirrored = 1.0 / (Z.conj() - zeta) + sign / (Z.conj() + zeta)
    return direct * weight, mirrored * weight


def _near_poles(nodes: Nodes, sign: float) -> list[tuple[Complexes, Complexes]]:
    """Factor of conj h and step theta* - theta for the port side and the image in the surface."""
    zeta, t, bend = nodes.middle, nodes.middle_tangent.conj(), nodes.bend.conj()
    found = []
    for gap, share in ((zeta.conj() + zeta, -sign), (zeta.conj() - zeta, -1.0)):
        step = -gap / t
        near = (np.abs(step.imag) > np.abs(step.real)) & (np.abs(step) < 3.0)  # the rule sees poles further away
        for _ in range(3):
            step = step - (gap + t * step + 0.5 * bend * step**2) / (t + bend * step)
        close = near & (np.abs(step.imag) > np.abs(step.real)) & (np.abs(step) < 3.0)
        step = np.where(close, step, 1j)
        missed = 1j * np.pi * np.sign(step.imag) - np.pi * np.tan(np.pi * step)
        found.append((np.where(close, share * missed / (t + bend * step), 0.0), step))
    return found


def _with_near_pole(
    constant: Complexes, linear: Complexes, near: Complexes, nodes: Nodes, rule: Interpolation, factor: Complexes,
    step: Complexes,
) -> tuple[Complexes, Complexes, Complexes]:  # fmt: skip
    """Add factor * conj h at the pole, h continued by its value and slope at the collocation point."""
    f, d = factor[:, None], step[:, None]
    t, bend = nodes.middle_tangent.conj()[:, None], nodes.bend.conj()[:, None]
    constant = constant + f * (rule.slope + d * rule.curvature)
    linear = linear + 1j * f * ((t + d * bend) * rule.value + d * t * rule.slope)
    added = np.zeros_like(near)
    added[0, :, 0], added[0, :, 1] = -1j * factor, -1j * factor * step
    added[1, :, 0], added[1, :, 2] = factor * step * t[:, 0], factor * (t + d * bend)[:, 0]
    return constant, linear, near + added


def rigid_stream(nodes: Nodes, symmetry: Symmetry) -> Stream:
    """Stream functions of unit heave velocity, or of unit sway, unit roll rate and the constant 1.

    Returns columns (heave,) or (sway, roll, constant)

    psi = z in sway, -(y2 + z2)/2 in roll, -y in heave.  Source: [Frank67] boundary conditions, as stream functions.

    >>> from quartering.hull.lines.section import Section
    >>> from quartering.hydro.section.outline import section_outline
    >>> from quartering.hydro.section.closefit.grid import nodes_on
    >>> nodes = nodes_on(section_outline(Section(y=[0.0, 2.0, 2.0], z=[1.0, 1.0, 0.0])), 16)
    >>> rigid_stream(nodes, "even").node[-1].tolist()
    [-2.0]
    """
    at = ((nodes.point, nodes.tangent, None), (nodes.middle, nodes.middle_tangent, nodes.bend))
    found = []
    for Z, t, bend in at:
        zero, one = np.zeros(Z.size), np.ones(Z.size)
        if symmetry == "even":
            found += [-Z.real[:, None], -t.real[:, None]]
            found += [] if bend is None else [-bend.real[:, None]]
            continue
        found.append(np.stack([Z.imag, -0.5 * np.abs(Z) ** 2, one], axis=-1))
        found.append(np.stack([t.imag, -(Z.conj() * t).real, zero], axis=-1))
        if bend is not None:
            found.append(np.stack([bend.imag, -(np.abs(t) ** 2 + (Z.conj() * bend).real), zero], axis=-1))
    return Stream(*found)
