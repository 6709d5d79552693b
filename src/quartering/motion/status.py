"""Whether a condition has an answer, what to do when it has none, and whether a ship gets to its motion."""

from __future__ import annotations

from enum import IntEnum


class Status(IntEnum):
    """Outcome of the search for a periodic motion; `advice` says what to try.

    Notes
    -----
    Stored as int8 in datasets, with CF ``flag_values`` and ``flag_meanings``.

    Examples
    --------
    >>> Status.NO_MOTION_FOUND.advice
    'no periodic motion was found from the linear solution: the ship may capsize here; try a lower wave or simulate'
    """

    CONVERGED = 0
    CONVERGED_BY_FOLLOWING = 1
    NO_MOTION_FOUND = 2
    SINGULAR = 3
    NOT_FINITE = 4
    ENCOUNTER_FREQUENCY_NEAR_ZERO = 5
    BEYOND_CAPSIZE_LIMIT = 6
    OUTSIDE_DATABASE = 7
    BEYOND_THE_DECK = 8

    @property
    def ok(self) -> bool:
        """Is there a motion?"""
        return self in (Status.CONVERGED, Status.CONVERGED_BY_FOLLOWING)

    @property
    def advice(self) -> str:
        """One line: what happened and what to try."""
        return _ADVICE[self]


_ADVICE = {
    Status.CONVERGED: "the motion that grows out of the linear solution",
    Status.CONVERGED_BY_FOLLOWING: "found by raising the wave from nothing along the branch of motions; other"
    " motions may exist: see all_motions",
    Status.NO_MOTION_FOUND: "no periodic motion was found from the linear solution: the ship may capsize here;"
    " try a lower wave or simulate",
    Status.SINGULAR: "the balance equations are singular here: a fold or an undamped resonance; change the frequency"
    " a little or add damping",
    Status.NOT_FINITE: "a coefficient or force is not a finite number, the frequency is zero, or the inertia matrix is"
    " singular; check the ship and the wave",
    Status.ENCOUNTER_FREQUENCY_NEAR_ZERO: "the ship keeps pace with the wave: no periodic motion, surf-riding and"
    " broaching are possible; change speed or heading",
    Status.BEYOND_CAPSIZE_LIMIT: "the motion rolls past the capsize limit, the least of the vanishing angle, the heel"
    " at which openings go under and 90 deg; treat as capsize risk and try a lower wave",
    Status.OUTSIDE_DATABASE: "outside the frequencies or headings of the ship's own database or panels: compute it further, or"
    " try longer waves, less speed or other headings",
    Status.BEYOND_THE_DECK: "the sections go deeper, or heel further, than their tables reach: the ship dives or capsizes here;"
    " carry the sides up with depth where the ship has them, or try a lower wave",
}


class OnTheWay(IntEnum):
    """From which beginnings a ship capsizes before it comes to its stable motion.

    Notes
    -----
    Stored as int8 in datasets, with CF ``flag_values`` and ``flag_meanings``; see `capsizes_before` for the beginnings.

    Examples
    --------
    >>> OnTheWay.BOTH.label, OnTheWay.NO.capsizes
    ('stable motion, capsizes on the way', False)
    """

    NOT_ASKED = -1
    NO = 0
    FROM_UPRIGHT = 1
    WAVE_RAISED = 2
    BOTH = 3

    @property
    def capsizes(self) -> bool:
        """Does it capsize from one of them?"""
        return self > OnTheWay.NO

    @property
    def label(self) -> str:
        """Name as shown to people."""
        return "stable motion, capsizes on the way" if self.capsizes else self.name.lower().replace("_", " ")
