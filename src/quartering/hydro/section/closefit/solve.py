"""Real standing-wave solutions of the section problem, combined to satisfy the radiation condition."""

from __future__ import annotations

import math

import numpy as np

from quartering._machine.compiled import inner, kernel
from quartering.hull.lines.section import Floats
from quartering.hydro.section.exponential_integral import scaled_exponential_integral
from quartering.hydro.section.wavemaker import Complexes


@inner
def _far_field(nu: float, sign: float, Z: Complexes, of_h: Complexes, of_conjugate: Complexes) -> None:
    """Factors of h and conj h at the nodes in the integral of e^{-i nu s} H from the last node to infinity."""
    last = Z.size - 1
    end = Z[last]
    for i in range(last):
        share = 0.25j / math.pi if i == 0 else 0.5j / math.pi  # -1/(2 pi i), half of it at the keel
        q = Z[i]
        for image in range(4):
            p = q if image == 0 else q.conjugate() if image == 1 else -q.conjugate() if image == 2 else -q
            w = 1j * nu * (end - p)
            value = scaled_exponential_integral(w)
            if (image == 1 or image == 3) and p.real > end.real and p.imag < end.imag:
                value -= 2j * math.pi * np.exp(w)
            if image == 0:
                of_h[i] = share * value
            elif image == 1:
                of_conjugate[i] = -share * value
            elif image == 2:
                of_conjugate[i] += sign * share * value
            else:
                of_h[i] -= sign * share * value


@inner
def _solve_definite(G: Floats, R: Floats) -> None:
    """Solve G X = R for a symmetric positive definite G (lower triangle used), both overwritten, X in R."""
    n, m = R.shape
    for j in range(n):
        for k in range(j):
            f = G[j, k]
            for i in range(j, n):
                G[i, j] -= f * G[i, k]
        scale = 1.0 / math.sqrt(max(G[j, j], 1e-300))
        for i in range(j, n):
            G[i, j] *= scale
    for i in range(n):
        for k in range(i):
            for j in range(m):
                R[i, j] -= G[i, k] * R[k, j]
        # The known part of X: what the stream function given on the contour sends out, and the constant of the lid.
        for j in range(m):
            R[i, j] /= G[i, i]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            for j in range(m):
                R[i, j] -= G[k, i] * R[k, j]
        for j in range(m):
            R[i, j] /= G[i, i]


@inner
def _outgoing_row(
    nu: float, sign: float, submerged: bool, T: Complexes, slope: Floats, of_h: Complexes, of_conjugate: Complexes,
    row: Complexes,
) -> None:  # fmt: skip
    """The far-field amplitude X of each unknown, times nu for the odd symmetry."""
    n = T.size - 1
    skip = 1 if sign > 0.0 else 0
    row[:] = 0.0
    constant = 1j
    for i in range(n + 1):
        h = of_h[i] + of_conjugate[i]
        for j in range(skip, n + 1):
            row[j - skip] += h * slope[i, j]
        constant += nu * (of_h[i] * T[i] + of_conjugate[i] * T[i].conjugate())
    for j in range(skip, n + 1):
        row[j - skip] -= 1j * nu * (of_h[j] * T[j] - of_conjugate[j] * T[j].conjugate())
    row[n - skip] += 1.0
    if sign > 0.0:
        for j in range(n):
            row[j] *= nu
        row[n] = constant
        if submerged:
            row[n - 1] = 0.0


@inner
def _definite_matrix(nu: float, normal: Floats, row: Complexes, G: Floats) -> float:
    """The normal matrix at one wave number with a multiple of the far-field row's square, lower half; that multiple."""
    n = G.shape[0] - 1
    trace = size = 0.0
    for i in range(n + 1):
        for j in range(i + 1):
            G[i, j] = normal[0, i, j] + nu * (normal[1, i, j] + nu * normal[2, i, j])
        trace += G[i, i]
        size += row[i].real ** 2 + row[i].imag ** 2
    beta = trace / ((n + 1) * size)
    for i in range(n + 1):
        for j in range(i + 1):
            G[i, j] += beta * (row[i].real * row[j].real + row[i].imag * row[j].imag)
    return beta


@kernel
def standing_waves(
    first: int, last: int, wavenumber: Floats, sign: float, submerged: np.ndarray, normal: Floats, known: Floats,
    node: Complexes, tangent: Complexes, slope: Floats, stream: Floats, stream_slope: Floats, potential: Complexes,
    wave: Complexes,
) -> None:  # fmt: skip
    """Nodal potentials and far waves of section-frequencies first..last (frequency runs fastest).

    first, last: range of s f + frequency
    wavenumber (f, s): nu > 0 [1/m]
    sign: 1 for sway and roll, -1 for heave
    submerged (s,): the contour ends on the centre plane under water
    normal (s, 3, n+1, n+1): normal matrix of the rows: parts with 1, nu, nu^2
    known (f, s, n+1, m): its right-hand side
    node, tangent (s, n+1): points and derivatives by theta
    slope (s, n+1, n+1): nodal values to nodal derivatives
    stream, stream_slope (f, s, n+1, m): psi and its derivative at the nodes; f = 1 when all are alike
    potential (f, s, n+1, m): out: phi at the nodes
    wave (f, s, m): out: D of phi -> D exp(-nu (z - z_end) - i nu (y - y_end)) far to starboard

    The rows leave one standing wave free. With X = e^{-i nu Z_e} F(Z_e) + int_{Z_e}^inf e^{-i nu s} H ds, F -> X e^{i nu Z}
    far away; waves run outward when Im X = j Re X, j the imaginary unit of time: a constraint on the least squares.
    H in the integral is Cauchy's integral of its values on the body, the inner integral e^w E1(w).
    G + beta (r r* of X) is definite; its inverse on the right-hand side and on both parts of X gives the solution
    x = u + mu (v_i + j v_r) + beta j X_r (v_i - j v_r) - .., with the multiplier mu and X_r from two equations.
    The unknowns are phi; when odd, where phi vanishes at the keel, phi without the keel node and nu times the stream
    constant (a submerged body has phi = 0 at its top, too).
    Source: [Frank67] radiation problem; derived here.  Valid: deep water, nu > 0.
    """
    n, count, m = node.shape[1] - 1, wavenumber.shape[0], potential.shape[3]
    G, R = np.empty((n + 1, n + 1)), np.empty((n + 1, m + 2))
    of_h, of_conjugate = np.zeros(n + 1, dtype=np.complex128), np.zeros(n + 1, dtype=np.complex128)
    row = np.empty(n + 1, dtype=np.complex128)
    skip = 1 if sign > 0.0 else 0
    # Least squares |A x - b|^2 with one linear constraint (only outgoing waves) and complex x, A and b real: A^T A is singular
    # along the standing wave that the rows leave free, so beta r r^T of the constraint's row r is added, which changes nothing
    # where the constraint holds. Then x = G^-1 (A^T b + ..) with two unknowns left, the far amplitude X_r and the multiplier.
    for task in range(first, last):
        s, f = task // count, task % count
        g = f if stream.shape[0] > 1 else 0
        nu, T = wavenumber[f, s], tangent[s]
        _far_field(nu, sign, node[s], of_h, of_conjugate)
        _outgoing_row(nu, sign, submerged[s], T, slope[s], of_h, of_conjugate, row)
        beta = _definite_matrix(nu, normal[s], row, G)
        for i in range(n + 1):
            for j in range(m):
                R[i, j] = known[f, s, i, j]
            R[i, m], R[i, m + 1] = row[i].real, row[i].imag
        _solve_definite(G, R)
        rr = ri = ii = 0.0
        for i in range(n + 1):
            rr += row[i].real * R[i, m]
            ri += row[i].real * R[i, m + 1]
            ii += row[i].imag * R[i, m + 1]
        for j in range(m):
            fixed = 1j * stream[g, s, n, j]
            for i in range(n + 1):
                fixed += 1j * (of_h[i] - of_conjugate[i]) * stream_slope[g, s, i, j]
                fixed += nu * (of_h[i] * T[i] + of_conjugate[i] * T[i].conjugate()) * stream[g, s, i, j]
            if sign > 0.0:
                fixed *= nu
            d = fixed.imag - 1j * fixed.real  # constraint: X_i - j X_r + d = 0 for the unknowns' X
            ur = ui = 0.0
            for i in range(n + 1):
                ur += row[i].real * R[i, j]
                ui += row[i].imag * R[i, j]
            # X_r = ur + mu (ri + j rr) + beta [j X_r (ri - j rr) - d ri];  X_i = ui + mu (ii + j ri) + beta [..]
            a11, a12 = 1.0 - beta * (1j * ri + rr), -(ri + 1j * rr)
            a21, a22 = 1j - beta * (1j * ii + ri), -(ii + 1j * ri)
            b1, b2 = ur - beta * d * ri, ui + d - beta * d * ii
            det = a11 * a22 - a12 * a21
            amplitude = (b1 * a22 - a12 * b2) / det
            multiplier = (a11 * b2 - a21 * b1) / det
            on_real = multiplier * 1j + beta * amplitude
            on_imaginary = multiplier + beta * (1j * amplitude - d)
            wave[f, s, j] = (amplitude + fixed.real) / (nu if sign > 0.0 else 1.0)
            potential[f, s, 0, j] = 0.0
            for k in range(n + 1 - skip):
                potential[f, s, k + skip, j] = R[k, j] + on_real * R[k, m] + on_imaginary * R[k, m + 1]
