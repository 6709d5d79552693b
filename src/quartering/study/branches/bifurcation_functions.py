"""Test functions that vanish where a periodic motion gains or loses stability, with their derivatives."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from quartering.motion.branches.branch import Curve
from quartering.motion.branches.switching import new_columns
from quartering.motion.equations.batch import joined
from quartering.motion.equations.system import Floats, System
from quartering.motion.steady.balance import balance_of
from quartering.motion.steady.subharmonic import ascending, columns, orders_of, rearranged, slowed
from quartering.stability.assessment import assess
from quartering.stability.variational.magnus import FINEST
from quartering.study.branches.events import FOLD, NEIMARK_SACKER, PERIOD_DOUBLING

STEP = 1e-4
"""Of differences, in scaled unknowns and shares of the limits: long beside errors of 1e-7, short beside any bend."""
_ACCURACY = 1e-8
_OSCILLATES = 1e-4


@dataclass(frozen=True, eq=False)
class Boundary:
    """What vanishes at one kind of change of stability, for motions of given harmonics.

    Parameters
    ----------
    kind : str               "fold", "symmetry-breaking", "period-doubling" or "neimark-sacker"
    curve : Curve            whose harmonics, scale and period the motions have
    """

    kind: str
    curve: Curve

    def evaluated(self, here: System, near: list[System], x: Floats) -> tuple[Floats, Floats]:
        """The test function of a motion x (m,), scaled unknowns: in one condition and some near ones; its derivative by x.

        here: one condition
        near: k others
        x (m,): the motion, the same in all
        Returns values (k + 1,): good enough in the others for differences; gradient (m,): in the first condition
        """
        if self.kind == NEIMARK_SACKER:
            beside = np.concatenate([x + STEP * np.eye(x.size), x - STEP * np.eye(x.size)])
            motions = np.concatenate([np.repeat(x[None], len(near), axis=0), beside])
            others = self._growth(joined([*near, *[here] * len(beside)]), motions, FINEST)
            up, down = others[len(near) : -x.size], others[-x.size :]
            values = np.append(self._growth(here, x[None], _ACCURACY), others[: len(near)])
            return values, np.asarray((up - down) / (2 * STEP))
        value, left, right = self._singular(here, x)
        values = np.array([value, *(self._singular(system, x)[0] for system in near)])
        # The second derivative of the balance equations is symmetric: one directional difference gives the whole row.
        u, v = self._enlarged(x), right.reshape(3, -1) * self._scale().reshape(3, -1)
        slow, orders = slowed(here, self._periods()), self._orders()
        ahead, behind = (balance_of(slow, orders, u + sign * STEP * v)[1] for sign in (1.0, -1.0))
        row = (left @ self._weighted(slow, (ahead - behind) / (2 * STEP))).reshape(1, 3, -1)
        factor = self._periods() // self.curve.periods
        kept = columns(orders)
        return values, np.concatenate([row[:, :, kept[factor * h]] for h in self.curve.orders], axis=2).ravel()

    def _growth(self, system: System, x: Floats, accuracy: float) -> Floats:
        """Growth rate times the period (n,) of the oscillating pair nearest to the unit circle."""
        u = (x * self.curve.scale).reshape(len(x), 3, -1)
        rising, orders = ascending(u, self.curve.orders)
        slow = slowed(system, self.curve.periods)
        multipliers = assess(slow, rising, orders, accuracy, detail="map").floquet.multipliers
        logarithm = np.log(np.abs(multipliers))
        oscillating = np.abs(multipliers.imag) > _OSCILLATES * np.abs(multipliers)
        nearest = np.where(oscillating, np.abs(logarithm), np.inf).argmin(axis=1)
        return np.where(oscillating.any(axis=1), logarithm[np.arange(len(x)), nearest], np.nan)

    def _singular(self, system: System, x: Floats) -> tuple[float, Floats, Floats]:
        """Signed smallest singular value of the equations for the harmonics that come in, and its vectors.

        The sign is that of the determinant: the value passes through zero smoothly.
        """
        slow, orders = slowed(system, self._periods()), self._orders()
        matrix = self._weighted(slow, balance_of(slow, orders, self._enlarged(x))[1])
        new = self._new()
        left, sizes, right = np.linalg.svd(matrix[np.ix_(new, new)])
        sign = float(np.sign(np.linalg.det(left) * np.linalg.det(right)))
        w, v = np.zeros(len(matrix)), np.zeros(len(matrix))
        w[new], v[new] = sign * left[:, -1], right[-1]
        return sign * float(sizes[-1]), w, v

    def _weighted(self, slow: System, matrix: Floats) -> Floats:
        """Derivative of the balance equations free of units: unknowns and equations in the scale of the motion."""
        scale = self._scale()
        return matrix * scale / (scale[:, None] * float(slow.frequency[0]) ** 2)

    def _periods(self) -> int:
        return 2 * self.curve.periods if self.kind == PERIOD_DOUBLING else self.curve.periods

    def _orders(self) -> tuple[int, ...]:
        """Harmonics of the motions that come in."""
        if self.kind == FOLD:
            return self.curve.orders
        return orders_of(max(self.curve.orders) // self.curve.periods, self._periods())

    def _enlarged(self, x: Floats) -> Floats:
        u = (x * self.curve.scale).reshape(1, 3, -1)
        return rearranged(u, self.curve.orders, self._orders(), factor=self._periods() // self.curve.periods)[0]

    def _scale(self) -> Floats:
        width = self.curve.scale.size // 3
        return np.repeat(self.curve.scale[::width], sum(1 if h == 0 else 2 for h in self._orders()))

    def _new(self) -> Floats:
        orders = self._orders()
        width = sum(1 if h == 0 else 2 for h in orders)
        own = range(width) if self.kind == FOLD else new_columns(orders, self._periods() // self.curve.periods)
        return np.array([k * width + c for k in range(3) for c in own])
