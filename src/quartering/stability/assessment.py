"""All judgements of many motions at once: first order, Floquet, mechanism."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from quartering.motion.equations.steering import RUDDER
from quartering.motion.equations.system import Floats, System
from quartering.stability.first_order import Detail, FirstOrder, first_order
from quartering.stability.kind import kinds, linear_exponents
from quartering.stability.variational.floquet import Floquet, fastest_rate, floquet
from quartering.stability.variational.one_pass import goes_in_one_pass, in_one_pass
from quartering.stability.variational.variation import variation_along


@dataclass(frozen=True, eq=False)
class Assessment:
    """Stability of n motions by every method.

    Parameters
    ----------
    first_order : FirstOrder    the paper's analysis, completed
    floquet : Floquet           what decides
    kind : (n,) int8            `Kind`
    calm : (n, s) complex       exponents of the linear motion without waves [1/s]
    """

    first_order: FirstOrder
    floquet: Floquet
    kind: NDArray[np.int8]
    calm: NDArray[np.complex128]


def assess(
    system: System, u: Floats, orders: tuple[int, ...], accuracy: float = 1e-6, *, detail: Detail = "full"
) -> Assessment:
    """Judge the stability of periodic motions by every method.

    system: n conditions
    u (n, 3, b): motions, as from `harmonic_balance`
    orders: their harmonics
    accuracy: of the Floquet multipliers
    detail: "full", or what a "map" needs: no shares of stable motions, no mean_jacobian

    Source: [H71] eqs. (8)-(15), completed; Floquet's theorem.
    """
    first = 1 if orders[0] == 0 else 0
    fundamental = u[:, :, first] - 1j * u[:, :, first + 1]
    along, transition = None, None
    if detail == "map" and goes_in_one_pass(system, accuracy):
        phasors, rate, transition = in_one_pass(system, u, orders, accuracy)
        indices = first_order(system, phasors, fundamental, detail)
    else:
        phasors, along = variation_along(system, u, orders)
        indices = first_order(system, phasors, fundamental, detail)
        rate = fastest_rate(phasors, indices.mean_jacobian)
    variation = None if along is None else (phasors, along)
    multipliers = floquet(
        system, u, orders, rate, _trace(system, phasors), accuracy,
        variation=variation, transition=transition, detail=detail,
    )  # fmt: skip
    calm = linear_exponents(system)
    return Assessment(indices, multipliers, kinds(multipliers, calm), calm)


def leading_growth(system: System, u: Floats, orders: tuple[int, ...], accuracy: float = 1e-6) -> Floats:
    """Real part of the leading Floquet exponent of many motions, and nothing else of `assess`.

    as in `assess`
    Returns (n,): as `assess` with detail="map" has it, to its accuracy; NaN where there is none [1/s]

    >>> from quartering.motion.equations.model import Model
    >>> from quartering.motion.steady.motion import steady_motions
    >>> terms = {"Y_v": -1.0, "K_phi": -1.0, "K_p": -0.1, "N_r": -0.5}
    >>> system = Model(np.eye(3), terms, 0.8, (0, 0.01, 0), (0, 0, 0)).system
    >>> u, orders, *_ = steady_motions(system)
    >>> leading_growth(system, u, orders).round(4).tolist()
    [-0.05]
    """
    if not goes_in_one_pass(system, accuracy):
        return assess(system, u, orders, accuracy, detail="map").floquet.growth
    phasors, rate, transition = in_one_pass(system, u, orders, accuracy)
    trace = _trace(system, phasors)
    return floquet(system, u, orders, rate, trace, accuracy, transition=transition, detail="map").growth


def _trace(system: System, phasors: NDArray[np.complex128]) -> Floats:
    """Mean trace (n,) of the variational matrix [1/s]."""
    rudder = system.linear[:, 3, RUDDER] if system.states > RUDDER else np.zeros(system.count)
    return np.asarray(rudder + phasors[:, 0, 0, 0].real + phasors[:, 0, 1, 2].real + phasors[:, 0, 2, 3].real)
