"""The paper's Appendix C: Duffing's equation by three formulas, beside which harmonic balance is exact."""

from __future__ import annotations

from typing import Final

import numpy as np

from quartering.conventions import InputError
from quartering.motion.equations.model import Model
from quartering.motion.equations.system import Floats

FORMULAS: Final = {
    "C-3": "Struble's method: omega = 1 + 3/8 beta P^2 - X0/(2 P)",
    "C-4": "the modified method, P the fundamental: omega^2 = 1 + 3/4 beta P^2 - X0/P",
    "C-5": "Hsu's, the modified method with its third harmonic: omega^2 = 1 + (7 w^2-1)/(9 w^2-1) beta P^2 - X0/P",
}
"""Name of a formula -> what it says of x'' + x + beta x^3 = X0 cos(omega t)."""


def duffing_amplitudes(formula: str, beta: float, force: float, frequency: float) -> Floats:
    """Signed amplitudes of the periodic motions of Duffing's equation by one of the paper's formulas.

    formula: "C-3", "C-4" or "C-5"
    beta: of x'' + x + beta x^3 = X0 cos(omega t)
    force: X0
    frequency: omega > 0
    Returns (m,): P, ascending, 1 to 3 of them; negative: opposite in phase to the force

    All three are cubics in P.  Source: [H71] eqs. (C-3), (C-4), (C-5); C-5 is C-4 with the third harmonic. Away from resonance
    its P is the peak, fundamental plus third harmonic; on the backbone curve it is the fundamental, which the third harmonic
    corrects.  Valid: small beta P^2; away from omega = 1/3 for C-5.
    """
    if formula not in FORMULAS:
        raise InputError(f"formula {formula!r} is unknown; allowed are {', '.join(FORMULAS)}")
    if not (np.isfinite([beta, force, frequency]).all() and frequency > 0):
        raise InputError(f"beta {beta}, force {force} and frequency {frequency} must be finite, the frequency above 0")
    w2 = frequency**2
    if formula == "C-3":
        cubic, linear, constant = 0.375 * beta, 1.0 - frequency, -0.5 * force
    elif formula == "C-4":
        cubic, linear, constant = 0.75 * beta, 1.0 - w2, -force
    else:
        if abs(9 * w2 - 1) < 1e-9:
            raise InputError("formula C-5 has a pole at frequency 1/3 (third superharmonic); take another frequency")
        cubic, linear, constant = beta * (7 * w2 - 1) / (9 * w2 - 1), 1.0 - w2, -force
    roots = np.roots(np.array([cubic, 0.0, linear, constant]))
    return np.asarray(np.sort(roots[np.abs(roots.imag) < 1e-9 * (1 + np.abs(roots))].real))


def duffing_model(beta: float, force: float, frequency: float, damping: float = 0.0) -> Model:
    """Duffing's equation as the roll equation of a `Model`, sway and yaw idle.

    beta: of x'' + damping x' + x + beta x^3 = force cos(frequency t)
    frequency: > 0
    Returns x is its roll angle

    Source: [H71] Appendix C.
    """
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -beta, "K_p": -damping}
    return Model(np.eye(3), terms, frequency, force_cos=(0, force, 0), force_sin=(0, 0, 0))
