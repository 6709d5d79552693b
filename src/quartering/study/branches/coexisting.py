"""All motions that coexist in one condition, each with its verdict."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields

from quartering._machine.threads import small_matrices
from quartering.doors import takes
from quartering.motion.branches.search import periodic_motions
from quartering.motion.equations.model import Model
from quartering.motion.steady.motion import Motion
from quartering.stability.verdict import Verdict, stability


@dataclass(frozen=True, eq=False, kw_only=True)
class JudgedMotion(Motion):
    """A periodic motion that carries its verdict.

    Parameters
    ----------
    verdict : Verdict    as from `stability`; the other fields as in `Motion`
    """

    verdict: Verdict

    @property
    def stable(self) -> bool:
        """Does every small disturbance of it die out?"""
        return self.verdict.stable


class JudgedMotions(list[JudgedMotion]):
    """Motions from the smallest roll to the largest, each judged, and what the search for them left open.

    Parameters
    ----------
    motions : iterable of JudgedMotion
    left_open : sequence of str    as in `search.Motions`; empty where every trace was followed to its end
    """

    def __init__(self, motions: Iterable[JudgedMotion], left_open: Sequence[str] = ()) -> None:
        super().__init__(motions)
        self.left_open = tuple(left_open)


@takes(model="Model")
def all_motions(model: Model, harmonics: int = 9) -> JudgedMotions:
    """Every periodic motion found in one condition, from the smallest roll to the largest, each judged.

    Parameters
    ----------
    model : Model
    harmonics : int    of the motions returned, odd

    Returns
    -------
    list of JudgedMotion    motions of the wave's period, leaning ones among them (each beside its mirror image), and of twice
                            that (``periods`` is 2); ``verdict`` and ``stable`` beside all that a `Motion` has; empty when
                            none was found: the ship may capsize in this condition.  Its attribute ``left_open`` says in
                            sentences which traces of motions could not be followed

    Raises
    ------
    InputError              `harmonics` even, not positive or above 199

    Notes
    -----
    Nothing proves that no further motion exists: see `quartering.motion.branches.search` for where it is looked for.
    Source: [Krack19]; [H71] eq. (A-11) has up to as many roots as its cubics allow.

    Examples
    --------
    >>> import numpy as np
    >>> terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.2, "K_p": -0.04}
    >>> model = Model(np.eye(3), terms, 1.2, (0, 0.1, 0), (0, 0, 0))
    >>> [(round(float(m.amplitude[1]), 2), m.stable) for m in all_motions(model, 5)]
    [(0.23, True), (1.63, False), (1.76, True)]
    """
    with small_matrices():
        motions = periodic_motions(model, harmonics)
    judged = (
        JudgedMotion(
            **{own.name: getattr(motion, own.name) for own in fields(motion)}, verdict=stability(model, motion)
        )
        for motion in motions
    )
    return JudgedMotions(judged, motions.left_open)
