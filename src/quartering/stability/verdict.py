"""The verdict on one motion: stable or not, by which mechanism, and do the methods agree."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from quartering.doors import takes
from quartering.hull.righting.limit import CapsizeLimit
from quartering.motion.equations.model import Model
from quartering.motion.equations.system import Floats
from quartering.motion.steady.motion import Motion, advice
from quartering.motion.steady.subharmonic import slowed
from quartering.notebook import ShownInNotebooks
from quartering.stability.assessment import Assessment, assess
from quartering.stability.contribution import contributions
from quartering.stability.first_order import RESONANCES
from quartering.stability.kind import Kind, growing_mode, linear_exponents

_ACCURACY = 1e-12
_NEUTRAL = 1e-12


@dataclass(frozen=True, eq=False)
class Verdict(ShownInNotebooks):
    """Is a motion stable, and if not why.

    Parameters
    ----------
    stable : bool              decided by the Floquet multipliers; False when there is no motion to judge
    kind : str                 "stable", "roll", "fold", "symmetry-breaking", "course", "course-in-calm-water",
                               "combination", "period-doubling" or "no-answer"
    sentence : str             the verdict in words, with the mechanism and the coefficient most to blame
    k2, k2_rho, k2_paper : float    index [1/s2]: full; from I1, I2, I3 with this ship's rho and the amplitudes through the
                               water; with the paper's 0.3, 0.1 and the amplitudes over ground
    through_water : (3,)       amplitudes of sway [m], roll, yaw [rad] relative to the water; over ground where it is still
    index : float              S = -K2/(2 n2) [1/s], positive is stable
    n2 : float                 natural roll frequency about the motion [rad/s]
    q : dict                   m -> (paper, full) growth rate at the resonance n2 = m omega/2 [1/s]
    slow : (2,)                growth rates of the sway-yaw modes averaged over the wave [1/s]
    averaged : (2,) complex    roll pair of the averaged equations (A-10) [1/s]
    combination : float        growth rate of roll and slow modes combined, n2 near 2 omega [1/s]
    mean_jacobian : (4,) complex    eigenvalues of the mean variational matrix [1/s]
    multipliers : (4,) complex      Floquet multipliers of (v, phi, p, r) over a period of the motion, the largest first;
                               with an autopilot 5, psi among them, with a rudder that lags 6
    exponents : (4,) complex        as many Floquet exponents [1/s]
    calm_water : (4,) complex       as many exponents without waves [1/s]
    roll_share : float         participation of roll in the deciding mode, 0 to 1
    liouville : float          relative error of the product of the multipliers; NaN when too small to tell
    strongest : (name, rate)   coefficient that adds most to the growth, and how much [1/s]
    without_autopilot : float  largest exponent without waves and with the rudder amidships; NaN for a ship without an
                               autopilot [1/s]
    first_order_stable : bool  what the first-order theory alone would say
    """

    stable: bool
    kind: str
    sentence: str
    k2: float
    k2_rho: float
    k2_paper: float
    through_water: Floats
    index: float
    n2: float
    q: dict[int, tuple[float, float]]
    slow: Floats
    averaged: NDArray[np.complex128]
    combination: float
    mean_jacobian: NDArray[np.complex128]
    multipliers: NDArray[np.complex128]
    exponents: NDArray[np.complex128]
    calm_water: NDArray[np.complex128]
    roll_share: float
    liouville: float
    strongest: tuple[str, float]
    first_order_stable: bool
    references: tuple[str, ...] = ("H71",)
    without_autopilot: float = float("nan")

    def __repr__(self) -> str:
        return f"<Verdict {self.kind}: largest exponent {self.exponents.real.max():+.3g} 1/s, K2 {self.k2:.3g} 1/s2>"

    def __str__(self) -> str:
        """The verdict in words."""
        return self.sentence


@takes(model="Model", motion="Motion")
def stability(model: Model, motion: Motion) -> Verdict:
    """Judge one motion by first-order theory and by Floquet multipliers, which decide.

    motion: a steady motion of that model
    Returns ``kind`` "no-answer" and NaN when the motion was not found

    Source: [H71] eqs. (8)-(15) corrected and completed.  Valid: as the motion; multipliers to 1e-10 of the motion given,
    whose own harmonics are the larger error: ask for more of them when a verdict is close.
    """
    u = motion.coefficients[None]
    result = assess(slowed(model.system, motion.periods), u, motion.orders_with_mean, _ACCURACY)
    f, m = result.first_order, result.floquet
    kind = Kind(int(result.kind[0]))
    mode = int(growing_mode(m, result.calm)[0])
    share = float(m.roll_share[0, mode])
    strongest = ("", float("nan"))
    if kind is not Kind.NO_ANSWER:
        strongest = _strongest(kind, model, motion, result, share)
    agrees = bool(f.growth[0] < _NEUTRAL)
    bare = float("nan")
    if model.autopilot is not None:
        bare = float(linear_exponents(replace(model, autopilot=None).system)[0, 0].real)
    steering = "" if kind is Kind.NO_ANSWER else _steering(model, motion, bare, float(result.calm[0, 0].real))
    return Verdict(
        stable=kind is Kind.STABLE,
        kind=kind.label,
        sentence=_sentence(_condition(model.source), kind, result, motion, model.capsize_limit, strongest, mode)
        + steering,
        k2=float(f.k2[0]),
        k2_rho=float(f.k2_rho[0]),
        k2_paper=float(f.k2_paper[0]),
        through_water=f.through_water[0],
        index=float(f.index[0]),
        n2=float(f.n2[0]),
        q={s: (float(f.q_paper[0, i]), float(f.q[0, i])) for i, s in enumerate(RESONANCES)},
        slow=f.slow[0],
        averaged=f.averaged[0],
        combination=float(f.combination[0]),
        mean_jacobian=f.mean_jacobian[0],
        multipliers=m.multipliers[0],
        exponents=m.exponents[0],
        calm_water=result.calm[0],
        roll_share=share,
        liouville=float(m.liouville[0]),
        strongest=strongest,
        first_order_stable=agrees,
        references=motion.references,
        without_autopilot=bare,
    )


def _steering(model: Model, motion: Motion, bare: float, calm: float) -> str:
    """What the autopilot does for the course, in a sentence of its own; nothing without one."""
    if model.autopilot is None:
        return ""
    if motion.heading is None:
        return " The autopilot does not act on the heading, which drifts."
    error = f" The mean heading is {np.degrees(motion.heading):+.2g} deg off course." if motion.heading else ""
    if bare <= 0:
        return error
    if calm < 0:
        return f" The autopilot keeps the course, which without it is lost in calm water ({bare:+.3g} 1/s).{error}"
    return f" In calm water the course is lost with the autopilot ({calm:+.3g} 1/s) as without it ({bare:+.3g} 1/s).{error}"


def _strongest(kind: Kind, model: Model, motion: Motion, result: Assessment, share: float) -> tuple[str, float]:
    """Coefficient to blame: at a fold driven by the righting moment its largest nonlinear term, else the mean's."""
    f = result.first_order
    by_restoring, by_both = f.q_paper[0, 0] - f.roll_rate[0], f.q[0, 0] - f.roll_rate[0]
    restoring = [name for name in model.terms if name in ("K_phiphiphi", "K_phi5", "K_phi7")]
    if kind is Kind.FOLD and model.restoring is not None and by_restoring > 0.5 * by_both:
        return "the righting curve", float(by_restoring)
    if kind is Kind.FOLD and restoring and by_restoring > 0.5 * by_both:
        roll = float(motion.amplitude[1])
        size = {
            name: abs(model.terms[name]) * roll ** (3 if name == "K_phiphiphi" else int(name[-1])) for name in restoring
        }
        return max(size, key=lambda name: size[name]), float(by_restoring)
    parts = contributions(model, motion, oscillating=share >= 0.5)
    # A stiffness turns a growing motion round; it does not feed it.
    feeding = {name: rate for name, rate in parts.items() if "phi" not in name}
    return next(iter(feeding.items()), ("", float("nan")))


def _condition(source: Mapping[str, object]) -> str:
    """The condition a ship's model was made for, to open a sentence; nothing for a model from bare numbers."""
    if "heading" not in source:
        return ""
    return (
        f"Heading {source['heading']:g} deg, {source['speed']:.3g} m/s,"
        f" wave {source['wave_length']:.4g} x {source['wave_height']:.3g} m: "
    )


def _sentence(
    where: str,
    kind: Kind,
    result: Assessment,
    motion: Motion,
    limit: CapsizeLimit,
    strongest: tuple[str, float],
    mode: int,
) -> str:
    """The verdict in one plain sentence, with what first-order theory says beside it."""
    if kind is Kind.NO_ANSWER:
        return f"{where}no answer: {advice(motion, limit)}."
    growth = float(result.floquet.exponents[0, mode].real)
    first = float(result.first_order.growth[0])
    stable_by_first_order = first < _NEUTRAL
    no_opinion = "has no answer (the mean roll stiffness is negative)" if np.isnan(first) else ""
    if kind is Kind.STABLE:
        opinion = "says the same" if stable_by_first_order else f"would call it unstable ({first:+.3g} 1/s)"
        dying = f"{abs(growth):.3g} 1/s"
        return f"{where}stable: disturbances die out at {dying} or faster; first-order theory {no_opinion or opinion}."
    opinion = f"says the same ({first:+.3g} 1/s)" if not stable_by_first_order else f"misses it ({first:+.3g} 1/s)"
    opinion = no_opinion or opinion
    index = float(result.first_order.k2[0])
    index_says = "no K2 here" if np.isnan(index) else f"K2 alone {'agrees' if index > 0 else 'does not see it'}"
    if kind is Kind.COURSE_IN_CALM_WATER:
        return f"{where}course-unstable in calm water: {kind.meaning} ({growth:+.3g} 1/s by Floquet)."
    blame = f"; {strongest[0]} adds most ({strongest[1]:+.3g} 1/s)" if strongest[1] > 0 else ""
    judges = f"{growth:+.3g} 1/s by Floquet; first-order theory {opinion}, {index_says}"
    return f"{where}unstable ({kind.label}): {kind.meaning} ({judges}){blame}."
