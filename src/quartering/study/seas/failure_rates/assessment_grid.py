"""What direct assessment simulates: which cells can matter to the sum of failures, and how exactly each has to be known."""

# A cell is a sea, speed and heading; it adds w r to the rate over all seas, w its share of the ship's time. The closure has an
# upper end of r for every cell. From the least w r upwards cells are left out as long as all of these upper ends together stay
# below a stated share of what matters: the safety level, or the sum itself where that is known to be higher.
#
# A cell whose upper end by the closure is below what the hours there are could show, were there no failure in them, is not
# simulated either: its upper end stands for it, or a line through higher seas.
#
# Of n cells that are left each may be wrong by a share of its own contribution, or of what matters over sqrt(n): errors of
# independent counts add up by their squares, so that all together are wrong by that share of what matters.

from __future__ import annotations

import math
from dataclasses import dataclass, field
from enum import IntEnum
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.digest import fingerprint
from quartering.study.seas.over_seas.grid import SeaGrid
from quartering.study.seas.response import SeaStatus

Floats = NDArray[np.float64]
Flags = NDArray[np.int8]


class Assessed(IntEnum):
    """How a cell of a direct assessment was answered.

    Examples
    --------
    >>> Assessed.BUDGET_SPENT.label
    'budget spent'
    """

    COUNTED = 0
    BUDGET_SPENT = 1
    EXTRAPOLATED = 2
    BELOW_HIGHER_SEA = 3
    TOO_RARE = 4
    EXCLUDED = 5
    NEVER_MET = 6
    SURF_RIDING = 7
    BREAKS = 8
    NOT_KNOWN = 9

    @property
    def label(self) -> str:
        """In words."""
        return self.name.lower().replace("_", " ")


class Tasks(NamedTuple):
    """What is to be done.

    Parameters
    ----------
    task : (l, p, h) int8     `Assessed` of cells that are not simulated, NOT_KNOWN of the others; TOO_RARE may be carried down
    scale : (l,) float        rate that matters [1/s]
    """

    task: Flags
    scale: Floats


def tasks_of(
    status: Flags, lower: Floats, upper: Floats, weight: Floats, share: float, level: float, least: float
) -> Tasks:
    """Which cells are left out, by the closure.

    status, lower, upper (l, p, h): of the closure, by loading, point and height; rates [1/s]
    weight (p, h): shares of time
    share: of what matters that all cells left out may add up to [1]
    level: rate that matters at the least [1/s]
    least: lowest upper end that a simulation may show [1/s]
    """
    answered = status == SeaStatus.ANSWERED
    task = np.full(status.shape, Assessed.NOT_KNOWN, dtype=np.int8)
    task[status == SeaStatus.SURF_RIDING] = Assessed.SURF_RIDING
    task[status == SeaStatus.BREAKS] = Assessed.BREAKS
    task[:, weight == 0.0] = Assessed.NEVER_MET
    scale = np.empty(len(task))
    for i, own in enumerate(task):
        known = answered[i] & (own == Assessed.NOT_KNOWN)
        scale[i] = _rounded(max(level, float((weight * np.where(np.isfinite(lower[i]), lower[i], 0.0)).sum())))
        most = np.where(known, weight * upper[i], np.inf).ravel()
        order = np.argsort(most, kind="stable")
        left = order[np.cumsum(most[order]) <= share * scale[i]]
        own[known & (upper[i] <= least)] = Assessed.TOO_RARE
        own.ravel()[left] = Assessed.EXCLUDED
    return Tasks(task, scale)


def _rounded(rate: float) -> float:
    """Two digits are enough, and the same on every processor."""
    return float(f"{rate:.1e}")


@dataclass(frozen=True, eq=False)
class AssessmentGrid(SeaGrid):
    """Every condition of a direct assessment.

    Parameters
    ----------
    weight : (p, h) float        share of the ship's time of a point (speed, heading, tz) and height
    task : (l, p, h) int8        see `Tasks`
    scale : (l,) float           rate that matters [1/s]
    precision : float            half width of an interval over the contribution [1]
    """

    weight: Floats = field(default_factory=lambda: np.zeros((0, 0)))
    task: Flags = field(default_factory=lambda: np.zeros((0, 0, 0), dtype=np.int8))
    scale: Floats = field(default_factory=lambda: np.zeros(0))
    precision: float = 0.2

    @property
    def usual_block_size(self) -> int:
        """All heights of one point: a lower sea may rest on higher ones."""
        return self.sea_count

    @cached_property
    def described(self) -> dict[str, Any]:
        """What decides the results, in types JSON knows."""
        plan = {"name": "cells", "digest": fingerprint([self.weight, self.task, self.scale])}
        return super().described | {"kind": "assessment", "precision": self.precision, "cells": plan}

    def allowed(self, loading: int) -> float:
        """Half width of the interval of a contribution that is small enough whatever the contribution [1/s]."""
        simulated = max(int((self.task[loading] == Assessed.NOT_KNOWN).sum()), 1)
        return float(self.precision * self.scale[loading] / math.sqrt(simulated))
