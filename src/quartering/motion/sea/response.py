"""Linear response of a ship in every wave cell of a sea, and its covariance, with gains that stand for what is not linear."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
# In each cell, phasors of e^{i w t} with w = |omega| (conjugate where the ship overtakes the wave), unknowns v, phi, r:
#
#     (i w M[:, v] - B[:, v]) v + (-w^2 M[:, p] - i w B[:, p] - B[:, phi]) phi + (i w M[:, r] - B[:, r] - D) r = F
#
# with B the linear terms plus gains, D the rudder's answer to a rate of turn, F the wave force plus what gains on the water's
# motion add. The roll angle, not its rate, is the unknown, so that nothing is singular at w = 0. A covariance is the sum of
# energies times Re(a conj b): never a spectrum over w.

from __future__ import annotations

from quartering._machine.compiled import summing


@summing
def respond(cells, w, inertia, linear, steering, gain, extra, force, inputs, forms, drag, water, out):
    """Phasors per metre of (v, phi, p, r) and of the variables the water enters, out (m, n), in the cells listed.

    indices into the arrays over cells that follow
    |omega|
    (c or 1, 3, 3), (c or 1, 3, 4), (c or 0, 3) complex
    on variables, those beyond the fourth being state extra[j] plus input j
    (c, 3), (c, e) complex per metre
    of the strips, with their gains
    (2, z, c) real and imaginary part of the water's velocity at the strips
    """
    n, many = cells.size, inertia.shape[0] > 1
    total = gain[:, :4].copy()
    for j in range(extra.size):
        if extra[j] >= 0:
            for k in range(3):
                total[k, extra[j]] += gain[k, 4 + j]
    place = (0, 2, 3)
    for s in range(drag.size):
        for k in range(3):
            for j in range(3):
                total[k, place[j]] -= drag[s] * forms[s, k] * forms[s, j]
    for index in range(n):
        i = cells[index]
        at = i if many else 0
        iw = 1j * w[i]
        m, b = inertia[at], linear[at]
        f0, f1, f2 = force[i, 0], force[i, 1], force[i, 2]
        for j in range(extra.size):
            f0 += gain[0, 4 + j] * inputs[i, j]
            f1 += gain[1, 4 + j] * inputs[i, j]
            f2 += gain[2, 4 + j] * inputs[i, j]
        real0 = real1 = real2 = imag0 = imag1 = imag2 = 0.0
        for s in range(drag.size):
            real, imag = drag[s] * water[i, 0, s], drag[s] * water[i, 1, s]
            real0 += real
            imag0 += imag
            real1 += real * forms[s, 1]
            imag1 += imag * forms[s, 1]
            real2 += real * forms[s, 2]
            imag2 += imag * forms[s, 2]
        f0 += complex(real0, imag0)
        f1 += complex(real1, imag1)
        f2 += complex(real2, imag2)
        a00 = iw * m[0, 0] - (b[0, 0] + total[0, 0])
        a10 = iw * m[1, 0] - (b[1, 0] + total[1, 0])
        a20 = iw * m[2, 0] - (b[2, 0] + total[2, 0])
        a01 = iw * (iw * m[0, 1] - (b[0, 2] + total[0, 2])) - (b[0, 1] + total[0, 1])
        a11 = iw * (iw * m[1, 1] - (b[1, 2] + total[1, 2])) - (b[1, 1] + total[1, 1])
        a21 = iw * (iw * m[2, 1] - (b[2, 2] + total[2, 2])) - (b[2, 1] + total[2, 1])
        a02 = iw * m[0, 2] - (b[0, 3] + total[0, 3])
        a12 = iw * m[1, 2] - (b[1, 3] + total[1, 3])
        a22 = iw * m[2, 2] - (b[2, 3] + total[2, 3])
        if steering.shape[0] > 0:
            a02 -= steering[i, 0]
            a12 -= steering[i, 1]
            a22 -= steering[i, 2]
        c00, c01, c02 = a11 * a22 - a12 * a21, a12 * a20 - a10 * a22, a10 * a21 - a11 * a20
        inverse = 1.0 / (a00 * c00 + a01 * c01 + a02 * c02)
        v = inverse * (c00 * f0 + (a02 * a21 - a01 * a22) * f1 + (a01 * a12 - a02 * a11) * f2)
        phi = inverse * (c01 * f0 + (a00 * a22 - a02 * a20) * f1 + (a02 * a10 - a00 * a12) * f2)
        r = inverse * (c02 * f0 + (a01 * a20 - a00 * a21) * f1 + (a00 * a11 - a01 * a10) * f2)
        out[0, index], out[1, index], out[2, index], out[3, index] = v, phi, iw * phi, r
        for j in range(extra.size):
            out[4 + j, index] = inputs[i, j] + (out[extra[j], index] if extra[j] >= 0 else 0.0)


@summing
def covariances(cells, energy, motion, forms, water, c, variance):
    """Covariance (m, m) of the variables and variances (z,) of the strips' velocity through the water.

    of the cells listed [m2]
    from `respond`
    as there
    to write
    """
    c[:], variance[:] = 0.0, 0.0
    size = motion.shape[0]
    for i in range(cells.size):
        e = energy[i]
        for a in range(size):
            real, imag = e * motion[a, i].real, e * motion[a, i].imag
            for b in range(a, size):
                c[a, b] += real * motion[b, i].real + imag * motion[b, i].imag
        v, p, r, at = motion[0, i], motion[2, i], motion[3, i], water[cells[i]] if variance.size > 0 else water[0]
        for s in range(variance.size):
            real = v.real + forms[s, 1] * p.real + forms[s, 2] * r.real - at[0, s]
            imag = v.imag + forms[s, 1] * p.imag + forms[s, 2] * r.imag - at[1, s]
            variance[s] += e * (real * real + imag * imag)
    for a in range(size):
        for b in range(a):
            c[a, b] = c[b, a]
