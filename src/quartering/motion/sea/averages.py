"""Averages over Gaussian motion: of every nonlinear term and of its slopes, in closed form."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
# For variables u, jointly Gaussian with means m and covariance C, and any f: the best linear stand-in for f(u) is
# E[f] + sum_j E[df/du_j] (u_j - m_j) (Kazakov), exact in its covariance with u. So all that is needed of a term is E[f] and
# E[df/du_j]:
#
#   products        E[u_i] = m_i, E[u_i u_j] = m_i m_j + C_ij, E[u_i u_j u_k] = m m m + m_i C_jk + m_j C_ik + m_k C_ij
#   powers of one   M_n = m M_(n-1) + (n - 1) C M_(n-2)
#   y |x|           with t = m_x/(s sqrt 2): E|x| = s sqrt(2/pi) e^(-t^2) + m_x erf t, E[y |x|] = m_y E|x| + C_xy erf t,
#                   E[y sign x] = m_y erf t + C_xy sqrt(2/pi) e^(-t^2)/s
#   q |q|           E = (m^2 + s^2) erf t + m s sqrt(2/pi) e^(-t^2), and its slope 2 E|q|
#   a table of cubics, odd in phi: integrals of x^k against the normal density over each interval, exact

from __future__ import annotations

import math

import numpy as np

from quartering._machine.compiled import inner, kernel

_ROOT = math.sqrt(2.0 / math.pi)
_LEAST = 1e-300


@inner
def _size(mean, deviation):
    """E|x|, E[sign x] and its slope by the mean over covariance, of a normal variable."""
    s = max(deviation, _LEAST)
    t = mean / (s * math.sqrt(2.0))
    sign, bell = math.erf(t), _ROOT * math.exp(-min(t * t, 700.0))
    return s * bell + mean * sign, sign, bell / s


@inner
def _mean_product(i, n, mean, c):
    """E of a product of n <= 3 variables i."""
    if n == 0:
        return 1.0
    if n == 1:
        return mean[i[0]]
    if n == 2:
        return mean[i[0]] * mean[i[1]] + c[i[0], i[1]]
    a, b, d = mean[i[0]], mean[i[1]], mean[i[2]]
    return a * b * d + a * c[i[1], i[2]] + b * c[i[0], i[2]] + d * c[i[0], i[1]]


@inner
def _mean_power(mean, variance, n):
    """E[x^n], and n E[x^(n-1)]."""
    before, now = 0.0, 1.0
    for k in range(1, n + 1):
        before, now = now, mean * now + (k - 1) * variance * before
    return now, n * before


@inner
def _restoring(knots, cubics, mean, deviation):
    """Mean moment and mean slope of the table of cubics, odd in the angle."""
    s, last = max(deviation, _LEAST), knots.size - 1
    value = slope = 0.0
    for side in range(2):
        m = mean if side == 0 else -mean
        for b in range(last + 1):
            t1 = (knots[b] - m) / s
            n1, tail1 = (
                math.exp(-0.5 * min(t1 * t1, 1400.0)) / math.sqrt(2.0 * math.pi),
                0.5 * math.erfc(t1 / math.sqrt(2.0)),
            )
            t2, n2, tail2 = 0.0, 0.0, 0.0
            if b < last:
                t2 = (knots[b + 1] - m) / s
                n2 = math.exp(-0.5 * min(t2 * t2, 1400.0)) / math.sqrt(2.0 * math.pi)
                tail2 = 0.5 * math.erfc(t2 / math.sqrt(2.0))
            j0, j1 = tail1 - tail2, n1 - n2
            j2 = j0 + t1 * n1 - t2 * n2
            j3 = 2.0 * j1 + t1 * t1 * n1 - t2 * t2 * n2
            o = m - knots[b]  # x = o + s t
            x1, x2 = o * j0 + s * j1, o * o * j0 + 2.0 * o * s * j1 + s * s * j2
            x3 = o**3 * j0 + 3.0 * o * o * s * j1 + 3.0 * o * s * s * j2 + s**3 * j3
            sign = 1.0 if side == 0 else -1.0
            value += sign * (cubics[b, 0] * j0 + cubics[b, 1] * x1 + cubics[b, 2] * x2 + cubics[b, 3] * x3)
            slope += cubics[b, 1] * j0 + 2.0 * cubics[b, 2] * x1 + 3.0 * cubics[b, 3] * x2
    return value, slope


@kernel
def averages(powers, modulus, coefficients, knots, cubics, mean, c, gain, force):
    """Mean forces (3,) and gains (3, m) of the nonlinear terms of one ship over Gaussian variables.

    (t, m), (t,), (3, t) of the products
    (b,), (b, 4) of the restoring moment K beyond its slope at 0
    (m,), (m, m) of v, phi, p, r and the variables that the water enters
    (3, m), (3,) to write

    Source: [Kazakov54], [Rice44] for the moments of normal variables.
    """
    gain[:], force[:] = 0.0, 0.0
    # For normal variables E[(x_j - m_j) g(x)] = sum_k c_jk E[dg/dx_k] (Price, Novikov): the linear term that errs least in
    # the mean square has the gains E[dg/dx_k], whatever g. A modulus times y: d/dy = E|x|, d/dx = E[y sign x]; a product
    # of up to three: Isserlis' sum over pairs; a power of one variable: E[x^n] = m E[x^(n-1)] + (n-1) c E[x^(n-2)].
    i, rest = np.zeros(8, np.int64), np.zeros(8, np.int64)
    for t in range(modulus.size):
        n = 0
        for v in range(powers.shape[1]):
            for _ in range(powers[t, v]):
                i[n] = v
                n += 1
        if modulus[t] > 0:
            x, y = modulus[t] - 1, i[0]
            size, sign, slope = _size(mean[x], math.sqrt(max(c[x, x], 0.0)))
            value = mean[y] * size + c[x, y] * sign
            by_x = mean[y] * sign + c[x, y] * slope
            for k in range(3):
                force[k] += coefficients[k, t] * value
                gain[k, y] += coefficients[k, t] * size
                gain[k, x] += coefficients[k, t] * by_x
        elif n > 3:
            value, by = _mean_power(mean[i[0]], c[i[0], i[0]], n)
            for k in range(3):
                force[k] += coefficients[k, t] * value
                gain[k, i[0]] += coefficients[k, t] * by
        else:
            for k in range(3):
                force[k] += coefficients[k, t] * _mean_product(i, n, mean, c)
            for out in range(n):
                left = 0
                for j in range(n):
                    if j != out:
                        rest[left] = i[j]
                        left += 1
                by = _mean_product(rest, left, mean, c)
                for k in range(3):
                    gain[k, i[out]] += coefficients[k, t] * by
    if knots.size > 0:
        value, slope = _restoring(knots, cubics, mean[1], math.sqrt(max(c[1, 1], 0.0)))
        force[1] += value
        gain[1, 1] += slope


@kernel
def drag_averages(forms, c, mean, variance, gain, force):
    """Gains 2 c E|q| of strips (z,) and their mean force (3,); forms (z, 3) are 1, -h, x.

    q = v + x r - h p - w with ``mean`` of v, p, r (3,) and variance (z,) of q; the force is -c q|q| (1, -h, x).
    """
    force[:] = 0.0
    for s in range(c.size):
        m, deviation = 0.0, math.sqrt(max(variance[s], 0.0))
        for k in range(3):
            m += forms[s, k] * mean[k]
        size, sign, _ = _size(m, deviation)
        gain[s] = 2.0 * c[s] * size
        # m E|q| = m s bell + m^2 erf, and s^2 erf is left
        value = c[s] * (m * size + deviation * deviation * sign)
        for k in range(3):
            force[k] -= value * forms[s, k]
