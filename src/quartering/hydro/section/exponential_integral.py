"""The exponential integral of a complex argument, scaled so that it neither over- nor underflows."""

from __future__ import annotations

import cmath
from typing import Final

from quartering._machine.compiled import kernel

EULER: Final = 0.5772156649015329
_TERMS: Final = 400
_FAR: Final = 40.0
_NEAR: Final = 3.0
_WORK: Final = 125.0


@kernel
def scaled_exponential_integral(w: complex) -> complex:
    """e^w E1(w), principal branch (cut along the negative real axis, which belongs to the upper side).

    w: not 0 [1]
    Returns about 1/w far from the origin [1]

    p = |w| + Re w says how far w is from the cut: the power series loses the digits of e^p, the continued fraction
    1/(w+1 - 1/(w+3 - 4/(w+5 - ...))) needs about 112/p steps. Series for p < 3, continued fraction (numerators and
    denominators by recurrence, one division) beyond; near the cut and |w| > 40 the asymptotic series.
    Source: [Abramowitz64] 5.1.11, 5.1.22, 5.1.51.  Valid: w != 0; relative error below 1e-12.
    """
    size = abs(w)
    p = size + w.real
    if p >= _NEAR:
        steps = int(_WORK / p) + 9
        before, now = 0.0 + 0.0j, 1.0 + 0.0j  # numerators
        below, down = 1.0 + 0.0j, w + 1.0  # denominators
        for n in range(1, steps):
            term = w + (2.0 * n + 1.0)
            square = float(n * n)
            before, now = now, term * now - square * before
            below, down = down, term * down - square * below
        return now / down
    if size > _FAR:
        term, total = 1.0 / w, 1.0 / w
        for n in range(1, int(_FAR)):
            term *= -n / w
            total += term
        return total
    total, term = -EULER - cmath.log(w), 1.0 + 0.0j
    for n in range(1, _TERMS):
        term *= -w / n
        step = term / n
        total -= step
        if abs(step.real) + abs(step.imag) < 1e-17 * (abs(total.real) + abs(total.imag)):
            break
    return total * cmath.exp(w)
