"""Rival: an ensemble in time, where the phasor of each component is turned by one complex multiplication a half step.

One realisation after another in one compiled loop; the sums over components vectorise, no sine is left in it, and the
Runge-Kutta step has the cubic ship of `harmonic_numba` written out.
"""

import numpy as np
from numba import njit, prange

from rivals.harmonic_numba import _rates


@njit(parallel=True, fastmath=True)
def _march(a, d, g, w, force, phase, steps, h, rms, peak):
    count = w.size
    for q in prange(phase.shape[0]):
        c, s = np.cos(phase[q]), np.sin(phase[q])
        turn_c, turn_s = np.cos(0.5 * h * w), np.sin(0.5 * h * w)
        re, im = np.ascontiguousarray(force.real), np.ascontiguousarray(force.imag)
        f = np.zeros((3, 3))
        for k in range(3):
            for i in range(count):
                f[2, k] += re[k, i] * c[i] - im[k, i] * s[i]
        v, phi, p, r, square, most = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for _ in range(steps):
            for k in range(3):
                f[0, k] = f[2, k]
            for half in range(1, 3):
                x, y, z = 0.0, 0.0, 0.0
                for i in range(count):
                    turned = c[i] * turn_c[i] - s[i] * turn_s[i]
                    other = s[i] * turn_c[i] + c[i] * turn_s[i]
                    c[i], s[i] = turned, other
                    x += re[0, i] * turned - im[0, i] * other
                    y += re[1, i] * turned - im[1, i] * other
                    z += re[2, i] * turned - im[2, i] * other
                f[half, 0], f[half, 1], f[half, 2] = x, y, z
            a0, a1, a2 = _rates(v, phi, p, r, a, d, g)
            a0, a1, a2 = a0 + f[0, 0], a1 + f[0, 1], a2 + f[0, 2]
            p1 = p + 0.5 * h * a1
            b0, b1, b2 = _rates(v + 0.5 * h * a0, phi + 0.5 * h * p, p1, r + 0.5 * h * a2, a, d, g)
            b0, b1, b2 = b0 + f[1, 0], b1 + f[1, 1], b2 + f[1, 2]
            p2 = p + 0.5 * h * b1
            c0, c1, c2 = _rates(v + 0.5 * h * b0, phi + 0.5 * h * p1, p2, r + 0.5 * h * b2, a, d, g)
            c0, c1, c2 = c0 + f[1, 0], c1 + f[1, 1], c2 + f[1, 2]
            p3 = p + h * c1
            d0, d1, d2 = _rates(v + h * c0, phi + h * p2, p3, r + h * c2, a, d, g)
            d0, d1, d2 = d0 + f[2, 0], d1 + f[2, 1], d2 + f[2, 2]
            v += h / 6.0 * (a0 + 2.0 * (b0 + c0) + d0)
            phi += h / 6.0 * (p + 2.0 * (p1 + p2) + p3)
            p += h / 6.0 * (a1 + 2.0 * (b1 + c1) + d1)
            r += h / 6.0 * (a2 + 2.0 * (b2 + c2) + d2)
            square += phi * phi
            most = max(most, abs(phi))
        rms[q], peak[q] = np.sqrt(square / steps), most


def ensemble(job, sea, steps, h):
    """Root mean square and largest roll (n,) of realisations of a `Sea`."""
    n = sea.phase.shape[0]
    rms, peak = np.empty(n), np.empty(n)
    _march(job.damping, job.products, job.g, sea.w, np.ascontiguousarray(sea.force.T), sea.phase, steps, h, rms, peak)
    return rms, peak
