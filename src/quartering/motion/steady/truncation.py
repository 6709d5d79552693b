"""Truncation error of the harmonic balance: estimated with more harmonics, order raised where needed.

The residual of harmonic balance says nothing of it: it is nil in the harmonics kept, however much of the force lies in the
next ones. Solving once more with those, from the motion found, shows what they do to roll.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering.motion.equations.system import Floats, System
from quartering.motion.status import Status
from quartering.motion.steady.harmonic import MOST_HARMONICS, harmonic_balance, orders_for

ENOUGH: Final = 1e-2
"""Change of the roll amplitude by the next harmonics, as a share of it, that calls for more of them."""
_STEP: Final = 4
_MOST_RAISED: Final = 49


def widened(u: Floats, orders: tuple[int, ...], wider: tuple[int, ...]) -> Floats:
    """Coefficients (n, 3, b) of motions in a wider set of harmonics, the further ones nil."""
    columns = {h: i for i, h in enumerate(columns_of(wider))}
    out = np.zeros((*u.shape[:2], len(columns)))
    for i, h in enumerate(columns_of(orders)):
        out[:, :, columns[h]] = u[:, :, i]
    return out


def columns_of(orders: tuple[int, ...]) -> list[tuple[int, str]]:
    """Column after column: the mean, then cos and sin of each harmonic."""
    return [(h, part) for h in orders for part in (("mean",) if h == 0 else ("cos", "sin"))]


def followed_up(
    system: System, u: Floats, orders: tuple[int, ...]
) -> tuple[Floats, tuple[int, ...], float, NDArray[np.int8] | None]:
    """A motion with as many harmonics as it takes until four more change roll by less than 1 %.

    system: one condition
    u (1, 3, b): its motion
    orders: harmonics of it
    Returns with no harmonic more where those there suffice, or where more of them lead nowhere; missed: change of the
        roll amplitude by the last four harmonics, as a share of it; NaN where no answer was found with them; status
        (1,): of the motion with more harmonics; None where it is the one given
    """
    found: tuple[Floats, tuple[int, ...], NDArray[np.int8] | None] = (u, orders, None)
    while True:
        now, kept, _ = found
        more = min(max(kept) + _STEP, MOST_HARMONICS)
        wider = orders_for(system, more)
        v, status, _ = harmonic_balance(system, wider, widened(now, kept, wider))
        if status[0] > Status.CONVERGED_BY_FOLLOWING:
            return *found[:2], float("nan"), found[2]
        missed = _apart(now, kept, v, wider)
        if missed <= ENOUGH or more >= _MOST_RAISED:
            return *found[:2], missed, found[2]
        found = v, wider, status


def _apart(u: Floats, orders: tuple[int, ...], v: Floats, wider: tuple[int, ...]) -> float:
    """Largest roll between two series over a cycle, as a share of the larger amplitude of roll."""
    difference = v[0, 1] - widened(u, orders, wider)[0, 1]
    phases = 2 * np.pi * np.arange(512) / 512
    rows = [np.cos(h * phases) if part != "sin" else np.sin(h * phases) for h, part in columns_of(wider)]
    apart, size = (np.abs(one @ np.array(rows)).max() for one in (difference, v[0, 1]))
    return float(apart / size) if size > 0 else 0.0
