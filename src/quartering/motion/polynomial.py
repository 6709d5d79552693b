"""Accelerations and their derivatives at one state: the right-hand side every kernel shares."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from quartering.compiled import inner
from quartering.motion.terms import KNOT, KNOT_CODE


@inner
def accelerations(linear, coefficients, powers, modulus, strength, state, table, force, jacobian):
    """Right-hand side of the canonical equations without excitation and, if asked for, its derivative by the state.

    Parameters
    ----------
    linear : (3, 4) float           columns v, phi, p, r
    coefficients : (3, t) float     of the nonlinear products
    powers : (t, 4) int             powers of (v, phi, p, r)
    modulus : (t,) int              1-4: the variable between modulus bars; 0: none; above: the knot of a righting spline
    strength : float                multiplies the nonlinear products (1 is the equation itself; less in a homotopy)
    state : (4,) float              (v, phi, p, r)
    table : (4, 8) float            scratch: powers of each variable
    force : (3,) float              out
    jacobian : (3, 4) float         out; (0, 4) when it is not wanted (a flag would be compiled as two functions)

    Notes
    -----
    Source: [H71] eq. (3).
    """
    with_jacobian = jacobian.shape[0] > 0
    for k in range(3):
        force[k] = 0.0
        for s in range(4):
            force[k] += linear[k, s] * state[s]
            if with_jacobian:
                jacobian[k, s] = linear[k, s]
    for s in range(4):
        table[s, 0] = 1.0
        for d in range(1, 8):
            table[s, d] = table[s, d - 1] * state[s]
    for t in range(powers.shape[0]):
        a, b, c, d = powers[t, 0], powers[t, 1], powers[t, 2], powers[t, 3]
        va, fb, pc, rd = table[0, a], table[1, b], table[2, c], table[3, d]
        bars = modulus[t]
        if bars > KNOT_CODE:
            beyond = abs(state[1]) - (bars - KNOT_CODE) * KNOT
            if beyond > 0.0:
                side = strength if state[1] > 0.0 else -strength
                for k in range(3):
                    force[k] += coefficients[k, t] * side * beyond**3
                    if with_jacobian:
                        jacobian[k, 1] += coefficients[k, t] * 3.0 * strength * beyond**2
            continue
        size, sign = strength, 0.0
        if bars > 0:
            sign = strength if state[bars - 1] >= 0.0 else -strength
            size = sign * state[bars - 1]
        vf, pr = va * fb, pc * rd
        product = vf * pr
        for k in range(3):
            force[k] += coefficients[k, t] * product * size
        if not with_jacobian:
            continue
        dv = a * table[0, a - 1] * fb * pr * size if a > 0 else 0.0
        df = b * table[1, b - 1] * va * pr * size if b > 0 else 0.0
        dp = c * table[2, c - 1] * vf * rd * size if c > 0 else 0.0
        dr = d * table[3, d - 1] * vf * pc * size if d > 0 else 0.0
        for k in range(3):
            coefficient = coefficients[k, t]
            jacobian[k, 0] += coefficient * dv
            jacobian[k, 1] += coefficient * df
            jacobian[k, 2] += coefficient * dp
            jacobian[k, 3] += coefficient * dr
            if bars > 0:
                jacobian[k, bars - 1] += coefficient * product * sign
