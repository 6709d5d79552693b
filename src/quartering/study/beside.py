"""What stands beside a stable verdict: capsizing on the way to the motion, and other stable motions in the same wave."""

from __future__ import annotations

from typing import Final, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from quartering.motion.approach import capsizes_before
from quartering.motion.equations import Floats, Model, System
from quartering.motion.homotopy import carried
from quartering.motion.search import from_grid
from quartering.motion.status import OnTheWay
from quartering.motion.steady import Motion, roll_peaks, steady_motions
from quartering.stability.assessment import Assessment, assess
from quartering.stability.kind import Kind, near_fold
from quartering.threads import small_matrices

Way = Literal["upright", "raised"]
"""How a ship comes to its motion: met upright by the whole wave, or by a wave raised in three steps."""

_STEEP: Final = 0.5
"""Share of the capsize limit past which a stable motion is asked for the way to it."""
_FEW: Final = 4
"""Lanes of a row for one condition: as many as a processor works on together."""
_SAME_ROLL = 0.02


def capsizes_on_the_way(model: Model) -> dict[Way, float]:
    """From which beginnings the ship capsizes before it comes to a steady motion, and after how long.

    Parameters
    ----------
    model : Model

    Returns
    -------
    dict             "upright", from rest in the whole wave, ten periods; "raised", from rest in a third of the wave, two thirds
                     and the whole, ten periods each: the time of the capsize from the beginning [s]; empty when there is none

    Notes
    -----
    A stable motion attracts only what is near it: a transient may pass the model's ``capsize_limit`` first.
    Source: [H71] eq. (3), integrated; [Thompson89] for the use.

    Examples
    --------
    >>> terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_p": -0.1, "K_phiphiphi": 1.0}
    >>> capsizes_on_the_way(Model(np.eye(3), terms, 0.85, (0, 0.05, 0), (0, 0, 0)))
    {}
    """
    times = capsizes_before(model.system, np.array([model.capsize_limit.radians]), width=_FEW)[0]
    return {way: float(time) for way, time in zip(get_args(Way), times, strict=True) if np.isfinite(time)}


def on_the_way(system: System, judged: Assessment, peaks: Floats, limit: float) -> NDArray[np.int8]:
    """Whether ships capsize before they come to their stable motions, asked where it may be.

    Parameters
    ----------
    system : System         n conditions
    judged : Assessment     of their motions
    peaks : (n,) float      largest roll over a cycle [rad]
    limit : float           roll angle that counts as a capsize [rad]

    Returns
    -------
    (n,) int8               values of `OnTheWay`

    Notes
    -----
    Asked of stable motions that roll past half the limit, and of those near a fold (`near_fold`), beside which a larger motion
    stands or none.  Source: [Thompson89] for the use.

    Examples
    --------
    See `judged` of `quartering.study.conditions`, which calls this.
    """
    found = np.full(system.count, int(OnTheWay.NOT_ASKED), dtype=np.int8)
    steep = np.nan_to_num(peaks) > _STEEP * limit
    asked = np.flatnonzero((judged.kind == Kind.STABLE) & (steep | near_fold(judged.floquet)))
    if asked.size:
        times = capsizes_before(system.each(lambda array: array[asked]), np.full(asked.size, limit))
        found[asked] = np.isfinite(times) @ [int(OnTheWay.FROM_UPRIGHT), int(OnTheWay.WAVE_RAISED)]
    return found


def other_stable_motions(model: Model, motion: Motion, harmonics: int = 3) -> list[float]:
    """Largest roll over a cycle of the other stable motions of the wave's period in one condition.

    Parameters
    ----------
    model : Model
    motion : Motion    the one that is known
    harmonics : int    of the motions sought, odd; at least 3

    Returns
    -------
    list of float      the smallest first, below the model's ``capsize_limit`` [rad]

    Notes
    -----
    From the grid of one-harmonic starts and its motions carried over to more harmonics, as in `all_motions`, which looks
    further: for leaning motions and such of two periods too.  Source: [Krack19].

    Examples
    --------
    >>> from quartering.motion.steady import steady_motion
    >>> terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_p": -0.00808, "K_phiphiphi": 0.9795}
    >>> model = Model(np.eye(3), terms, 0.83386, (0, 0.00918, 0), (0, 0, 0))
    >>> [round(roll, 2) for roll in other_stable_motions(model, steady_motion(model, 3, start="rest"))]
    [0.65]
    """
    system = model.system
    with small_matrices():
        low, seeds = from_grid(system)
        own, many, _, _ = steady_motions(system, max(3, harmonics), start="rest")
        ends = [one for one in carried(system, seeds, low, many) if one is not None]
    # The motion that is known may be one of one harmonic, which rolls otherwise than the same one with more of them.
    same_with_more = float(roll_peaks(own, many)[0])
    rolls: list[float] = []
    for u in ends:
        peak = float(roll_peaks(u[None], many)[0])
        known = [*rolls, float(motion.peak[1]), same_with_more]
        if peak > model.capsize_limit.radians or any(abs(peak - one) <= _SAME_ROLL * peak for one in known):
            continue
        if assess(system, u[None], many, 1e-9).kind[0] == Kind.STABLE:
            rolls.append(peak)
    return sorted(rolls)
