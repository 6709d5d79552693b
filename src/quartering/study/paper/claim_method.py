"""Claims of the paper about its method of solution, measured."""

from __future__ import annotations

import numpy as np

from quartering.motion.equations.model import Model
from quartering.motion.of_ship import equations
from quartering.motion.steady.harmonic import harmonic_balance
from quartering.motion.steady.motion import steady_motion
from quartering.motion.transient.simulate import simulate
from quartering.study.paper.claim import MODERATE, STEEP, Finding, Ships, graded
from quartering.study.paper.conditions import speed_of, wave_of
from quartering.study.paper.duffing_formulas import duffing_amplitudes, duffing_model

_PERIODS = 40


def approximation_agrees_with_integration(ships: Ships) -> Finding:
    """Fig. 11: largest roll over a cycle by the modified Struble method and by integration until it repeats."""
    one, worst, words = ships.one(), [], []
    for steepness in (MODERATE, STEEP):
        apart = []
        for heading in (30.0, 50.0, 60.0, 70.0, 90.0, 120.0, 150.0):
            model = equations(one, wave_of(one, 1.0, 1 / steepness), speed_of(one), heading)
            motion = steady_motion(model, 1, start="rest")
            apart.append(motion.peak[1] / _settled_peak(model, motion.state(0.0)) - 1)
        i = int(np.argmax(np.abs(apart)))
        worst.append(abs(apart[i]))
        words.append(f"H/lambda 1/{steepness}: largest difference of the roll peak {apart[i]:+.2%}")
    return graded(max(worst) < 0.02, min(worst) < 0.02, "; ".join(words))


def _settled_peak(model: Model, state0: np.ndarray) -> float:
    """Largest roll in the last of many periods [rad]."""
    period = 2 * np.pi / model.frequency
    trace = simulate(model, _PERIODS * period, state0.tolist(), step=period / 100, tolerance=1e-9)
    last = trace["roll"].values[trace["time"].values > (_PERIODS - 1) * period]
    return float(np.radians(np.abs(last).max()))


def third_harmonic_is_small(ships: Ships) -> Finding:
    """Third over first harmonic of roll, by nine harmonics."""
    one, words, worst = ships.one(), [], 0.0
    for steepness in (MODERATE, STEEP):
        shares = []
        for heading in np.arange(10.0, 171.0, 10.0):
            motion = steady_motion(
                equations(one, wave_of(one, 1.0, 1 / steepness), speed_of(one), float(heading)), 9, start="rest"
            )
            size = np.hypot(motion.cos[:, 1], motion.sin[:, 1])
            shares.append(size[1] / size[0])
        worst = max(worst, max(shares))
        words.append(f"H/lambda 1/{steepness}: at most {max(shares):.2%} of the first")
    return graded(worst < 0.05, worst < 0.1, "; ".join(words))


_BETA, _FORCE = 0.2, 0.3
_BELOW, _LARGE = (0.5, 0.6, 0.7), (1.0, 1.1, 1.3, 1.5)
"""Frequencies below resonance, and those at which the motion that resonance makes large is looked at."""


def modified_method_beats_the_plain(_: Ships) -> Finding:
    """Appendix C and Fig. 23: fundamental by (C-3) and (C-4) against many harmonics in balance."""
    plain, modified = (_errors(formula, (*_BELOW, 0.8, 0.9, *_LARGE)) for formula in ("C-3", "C-4"))
    words = (
        f"beta {_BETA:g}, X0 {_FORCE:g}, omega 0.5 to 1.5: error of the fundamental up to {plain.max():.1%} by (C-3) and "
        f"{modified.max():.1%} by (C-4), which is nearer in {int((modified < plain).sum())} of {plain.size} motions"
    )
    return graded(bool((modified < plain).all()), bool((modified < plain).mean() > 0.5), words)


def c5_is_a_rival_of_c4(_: Ships) -> Finding:
    """Are both approximations of one amplitude? The fundamental and the peak differ by the third harmonic."""
    fundamental, peak = _errors("C-5", _BELOW), _errors("C-5", _BELOW, peak=True)
    halved = _errors("C-5", _BELOW, _BETA / 2, peak=True)
    large, c4 = (_errors(formula, _LARGE, large=True) for formula in ("C-5", "C-4"))
    large_peak = _errors("C-5", _LARGE, peak=True, large=True)
    words = (
        f"below resonance no: (C-5) misses the fundamental by up to {fundamental.max():.2%} and the peak by {peak.max():.2%} "
        f"({peak.max() / halved.max():.1f} times less with half beta); on the large motion at and above resonance yes: "
        f"it misses the fundamental by {large.max():.2%}, (C-4) by {c4.max():.2%}, and the peak by {large_peak.max():.1%}"
    )
    below, above = bool((fundamental < peak).all()), bool((large < c4).any())
    return graded(below and above, below or above, words)


def _errors(
    formula: str, frequencies: tuple[float, ...], beta: float = _BETA, *, peak: bool = False, large: bool = False
) -> np.ndarray:
    """Relative error of a formula's amplitude, nearest to each motion of 21 harmonics, or to the largest of them."""
    errors = []
    for frequency in frequencies:
        amplitudes = duffing_amplitudes(formula, beta, _FORCE, frequency)
        exact = [float(u.sum() if peak else u[0]) for u in _exact(beta, frequency)]
        errors += [np.abs(amplitudes / one - 1).min() for one in exact if not large or one == max(exact)]
    return np.array(errors)


def _exact(beta: float, frequency: float) -> np.ndarray:
    """Cosine harmonics 1, 3, .. 21 of Duffing's motions of the wave's period, found from the roots of (C-4)."""
    orders = tuple(range(1, 22, 2))
    model = duffing_model(beta, _FORCE, frequency)
    start = np.zeros((1, 3, 2 * len(orders)))
    found = []
    for root in duffing_amplitudes("C-4", beta, _FORCE, frequency):
        start[0, 1, 0] = root
        found.append(harmonic_balance(model.system, orders, start=start)[0][0, 1, ::2])
    return np.array(found)
