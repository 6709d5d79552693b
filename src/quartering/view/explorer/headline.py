"""The sentence on top of a page, and what has to be said below it."""

from __future__ import annotations

import html
import math

from quartering.hull.righting.arm import fitted_to
from quartering.stability.kind import Kind
from quartering.study.condition.examine import Examined

NO_MOTION = "<h1><b class='unstable'>No periodic motion here</b></h1>"


def beyond(found: Examined) -> list[str]:
    """A note where the motion leaves the range of the righting arm's polynomial."""
    fitted = fitted_to(found.ship)
    peak = math.degrees(found.motion.peak[1]) if found.motion.status.ok else 0.0
    if peak <= fitted:
        return []
    return [
        f"With all harmonics it rolls to {peak:.3g}°, beyond {fitted:g}° where the fit of the righting arm ends: extrapolated."
    ]


def headline(found: Examined) -> str:
    """The verdict's sentence: the condition quiet, the verdict bold, its numbers in a smaller line below."""
    where, _, said = found.verdict.sentence.partition(": ")
    first, mark, rest = said.partition(": ")
    because, numbers = _parted(rest)
    calm = found.verdict.kind == Kind.COURSE_IN_CALM_WATER.label
    look = "stable" if found.verdict.stable or calm else "unstable"
    size = f"Largest roll {math.degrees(found.motion.peak[1]):.3g}° over a cycle. " if found.motion.status.ok else ""
    escaped = [html.escape(text) for text in (where, first, because, numbers)]
    return (
        f"<h1><span class='when'>{escaped[0]}:</span> <b class='{look}'>{escaped[1]}</b>{mark}{escaped[2]}.</h1>"
        f"<p>{size}{escaped[3][:1].upper()}{escaped[3][1:]}</p>"
    )


def _parted(reasons: str) -> tuple[str, str]:
    """What grows or dies out, and the numbers behind it.

    >>> _parted("roll grows (+0.1 1/s by Floquet; K2 (full) agrees); K_vpp adds most (+0.2 1/s).")
    ('roll grows', '+0.1 1/s by Floquet; K2 (full) agrees; K_vpp adds most (+0.2 1/s).')
    >>> _parted("disturbances die out at 0.03 1/s or faster; first-order theory says the same.")
    ('disturbances die out at 0.03 1/s or faster', 'first-order theory says the same.')
    """
    opened, semicolon = reasons.find(" ("), reasons.find("; ")
    if opened < 0 or 0 <= semicolon < opened:
        because, _, numbers = reasons.partition("; ")
        return because.removesuffix("."), numbers
    depth, closed = 1, opened + 2
    while depth and closed < len(reasons):
        depth += {"(": 1, ")": -1}.get(reasons[closed], 0)
        closed += 1
    return reasons[:opened], reasons[opened + 2 : closed - 1] + reasons[closed:]
