"""Rational fit of a matrix of transfer functions with poles in common: vector fitting."""

# Every entry e of a matrix is fitted by  f_e(s) = d_e + s h_e + sum_n r_ne/(s - p_n)  at s = i w, all with the same poles.
# The poles are found by relocation [Gustavsen99]: with poles q_n assumed, sigma(s) = 1 + sum_n c_n/(s - q_n) and sigma f_e
# are both sums over the same fractions, which is a linear least-squares problem; the zeros of sigma, eigenvalues of
# diag(q) - b c^T, are the next poles. Those to the right are mirrored to the left. Pairs of conjugate poles are written with
# the real fractions 1/(s-p) + 1/(s-p*) and i/(s-p) - i/(s-p*), so that series in time are real.

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]
_ROUNDS = 12
_REAL = 1e-9
_LEAST = 0.02


@dataclass(frozen=True, eq=False)
class RationalFit:
    """d + s h + sum over real fractions: in time, a state for each.

    Parameters
    ----------
    constant, slope : (k, k) float    d and h
    dynamics : (n, n) float           rates of the n states of one input: x' = A x + b u
    drive : (n,) float                b
    output : (n, k, k) float          f = sum of output times state, of each input
    """

    constant: Floats
    slope: Floats
    dynamics: Floats
    drive: Floats
    output: Floats

    @property
    def poles(self) -> Complex:
        """Poles (n,)."""
        return np.asarray(np.linalg.eigvals(self.dynamics), dtype=complex)

    def memory(self, frequency: Floats) -> Complex:
        """The fractions alone (f, k, k) at s = i w: what the past adds."""
        n = self.drive.size
        solved = np.linalg.solve(
            1j * frequency[:, None, None] * np.eye(n) - self.dynamics, self.drive[:, None].astype(complex)
        )
        return np.asarray(np.einsum("fn,nij->fij", solved[:, :, 0], self.output))

    def value(self, frequency: Floats) -> Complex:
        """All of it (f, k, k) at s = i w."""
        return np.asarray(self.constant + 1j * frequency[:, None, None] * self.slope + self.memory(frequency))

    def least_damping(self, frequency: Floats) -> float:
        """Least eigenvalue of the symmetric part of Re memory(i w) over frequencies, as a share of its largest: at least 0
        where the fractions are passive."""
        real = self.memory(frequency).real
        values = np.linalg.eigvalsh(0.5 * (real + real.transpose(0, 2, 1)))
        return float(values.min() / max(np.abs(values).max(), 1e-300))


def rational_fit(
    frequency: Floats, response: Complex, order: int, *, vanishing: bool = True, weight: Floats | None = None
) -> RationalFit:
    """Fit transfer functions at s = i w.

    frequency (f,): w > 0 [rad/s]
    response (f, k, k)
    order: number of poles
    weight (f,): of each frequency
    vanishing: are the fractions to add up to 0 at s = 0, as radiation damping does?

    Each entry counts by its `change_with_frequency`.  Source: [Gustavsen99].
    """
    k = response.shape[1]
    entries = response.reshape(frequency.size, -1).T
    s = np.asarray(1j * frequency, dtype=np.complex128)
    by_frequency = np.ones(frequency.size) if weight is None else weight
    change = change_with_frequency(frequency, response).ravel()
    weights = np.multiply.outer(1.0 / np.where(change > 0, change, np.inf), by_frequency)
    poles = _first_poles(frequency, order)
    for _ in range(_ROUNDS):
        poles = _relocated(s, entries, weights, poles)
    columns = _with_rest(s, _fractions(s, poles))
    at_zero = np.append(_fractions(np.zeros(1, dtype=complex), poles)[0].real, (0.0, 0.0))
    rows = []
    for values, weight in zip(entries, weights, strict=True):
        matrix, right = _real(weight[:, None] * columns), _real(weight * values)
        if vanishing:  # a heavy row, so that it holds but for rounding
            matrix, right = np.vstack([matrix, 1e6 * weight.max() * at_zero]), np.append(right, 0.0)
        rows.append(_solved(matrix, right))
    found = np.array(rows)
    dynamics, drive = _realised(poles)
    return RationalFit(
        constant=found[:, -2].reshape(k, k),
        slope=found[:, -1].reshape(k, k),
        dynamics=dynamics,
        drive=drive,
        output=np.ascontiguousarray(found[:, :-2].T).reshape(-1, k, k),
    )


def change_with_frequency(frequency: Floats, response: Complex) -> Floats:
    """Root mean square (k, k) of what of each entry is neither constant nor in proportion to s.

    An entry that hardly changes beside the diagonal ones it couples, such as one that symmetry makes 0, counts with 2 % of
    their geometric mean, so that rounding is not fitted.
    """
    s = 1j * frequency
    plain = _real(np.stack([np.ones_like(s), s], axis=1))
    flat = np.concatenate([response.real, response.imag]).reshape(2 * frequency.size, -1)
    rest = flat - plain @ np.linalg.lstsq(plain, flat, rcond=None)[0]
    change = np.sqrt(2.0 * np.mean(rest**2, axis=0)).reshape(response.shape[1:])
    own = np.sqrt(np.diag(change))
    return np.asarray(np.maximum(change, _LEAST * np.multiply.outer(own, own)))


def _first_poles(frequency: Floats, order: int) -> Complex:
    """Pairs across the band, damped; of an odd order a real one besides."""
    at = np.linspace(frequency.min(), 0.8 * frequency.max(), order // 2 + 2)[1:-1]
    poles = (-0.3 + 1j) * at
    return np.asarray(poles if order % 2 == 0 else np.append(poles, -at.mean()), dtype=np.complex128)


def _fractions(s: Complex, poles: Complex) -> Complex:
    """Columns (f, n): of poles above the axis two real fractions each, of real ones one."""
    columns = []
    for p in poles:
        if p.imag > 0:
            one, other = 1.0 / (s - p), 1.0 / (s - p.conjugate())
            columns += [one + other, 1j * (one - other)]
        else:
            columns.append(1.0 / (s - p.real))
    return np.stack(columns, axis=1)


def _realised(poles: Complex) -> tuple[Floats, Floats]:
    """Rates and drive of states whose transfer functions are the fractions."""
    size = int(sum(2 if p.imag > 0 else 1 for p in poles))
    dynamics, drive, k = np.zeros((size, size)), np.zeros(size), 0
    for p in poles:
        if p.imag > 0:
            # 2 Re and -2 Im of x' = p x + u: fractions 1/(s-p) + 1/(s-p*) and i/(s-p) - i/(s-p*)
            dynamics[k : k + 2, k : k + 2] = [[p.real, p.imag], [-p.imag, p.real]]
            drive[k] = 2.0
            k += 2
        else:
            dynamics[k, k], drive[k] = p.real, 1.0
            k += 1
    return dynamics, drive


def _with_rest(s: Complex, fractions: Complex) -> Complex:
    return np.concatenate([fractions, np.ones((s.size, 1)), s[:, None]], axis=1)


def _real(values: Complex) -> Floats:
    """Real parts, then imaginary ones."""
    return np.concatenate([values.real, values.imag])


def _solved(matrix: Floats, right: Floats) -> Floats:
    """Least squares with columns of one size."""
    size = np.linalg.norm(matrix, axis=0)
    size[size == 0] = 1.0
    return np.asarray(np.linalg.lstsq(matrix / size, right, rcond=1e-13)[0] / size)


def _relocated(s: Complex, entries: Complex, weights: Floats, poles: Complex) -> Complex:
    """Poles one round on, all to the left."""
    fractions = _fractions(s, poles)
    n = fractions.shape[1]
    own = _with_rest(s, fractions)
    matrices, rights = [], []
    for values, weight in zip(entries, weights, strict=True):
        if not weight.any():
            continue
        matrix = _real(weight[:, None] * np.concatenate([own, -values[:, None] * fractions], axis=1))
        q, _ = np.linalg.qr(matrix[:, : n + 2])
        shared, right = matrix[:, n + 2 :], _real(weight * values)
        matrices.append(shared - q @ (q.T @ shared))
        rights.append(right - q @ (q.T @ right))
    if not matrices:
        return poles
    c = _solved(np.concatenate(matrices), np.concatenate(rights))
    dynamics, drive = _realised(poles)
    found = np.linalg.eigvals(dynamics - np.outer(drive, c))
    found = -np.abs(found.real) + 1j * np.where(np.abs(found.imag) < _REAL * np.abs(found), 0.0, found.imag)
    found = np.where(found.real > -_REAL, found - _REAL, found)
    return np.asarray(found[found.imag >= 0])
