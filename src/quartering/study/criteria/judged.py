"""All five failure modes of a ship, at two levels each."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping
from functools import partial
from typing import NamedTuple

from quartering.doors import takes
from quartering.hull.propulsion import Propulsion
from quartering.hull.ship import Ship
from quartering.hull.told import number
from quartering.study.criteria import dead_ship, excessive_acceleration, parametric_rolling, pure_loss, surf_riding
from quartering.study.criteria.particulars import Particulars, particulars
from quartering.study.criteria.record import MODES, Criteria, Judgement


@takes(ship="Ship", propulsion="Propulsion, None")
def criteria(
    ship: Ship,
    speed: float | str | None = None,
    roll_period: float | str | None = None,
    propulsion: Propulsion | None = None,
) -> Criteria:
    """Vulnerability of a ship to the five failure modes of second-generation intact stability, levels 1 and 2.

    Parameters
    ----------
    ship : Ship
    speed : float           service speed [m/s]; None: what needs it is not judged
    roll_period : float     natural roll period [s]; None: the model's own at this GM
    propulsion : Propulsion resistance and thrust; None: the ship's own, if it was told (option ``propulsion``)

    Returns
    -------
    Criteria    every number by name: ``.value("pure_loss.level2.cr1")``; ``.table()``; ``.sentence``

    Raises
    ------
    InputError    a ship without freeboard, a number out of its range

    Notes
    -----
    Prepared in the form of MSC.1/Circ.1627; its text was not at hand. Every constant is recalled, with its place and status in
    ``Criteria.constants``, and nothing here shows compliance. What a hull does not hold (windage, highest place of people,
    openings, bilge keels) are options of the ship; a mode that lacks one says so.
    Source: MSC.1/Circ.1627 (recalled), IS Code A 2.3 (recalled).

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> found = criteria(ship("s175"), speed="0.275 Fn")
    >>> found.of("pure_loss", 1).verdict, found.of("dead_ship", 1).reason
    ('not vulnerable', 'needs windage: {area: .., lever: ..}')
    """
    *_, (_, found) = judging(ship, speed, roll_period, propulsion)
    return found


def judging(
    ship: Ship,
    speed: float | str | None = None,
    roll_period: float | str | None = None,
    propulsion: Propulsion | None = None,
    levels: Collection[int] = (1, 2),
) -> Iterator[tuple[float, Criteria]]:
    """The judgements of `criteria` in steps of a second or a few, level 1 of every mode first.

    levels: judged; the others are left out of the record
    Yields (share of the steps done, 0 to 1; the record as far as it goes, its judgements in the order of the modes)
    """
    service = None if speed is None else number(ship, "speed", speed)
    period = None if roll_period is None else number(ship, "roll_period", roll_period)
    p = particulars(ship, service, period)
    speed_words = "no service speed told" if service is None else f"{service:.4g} m/s, Fn {p.froude:.3g}"
    loading = f"draught {p.draught:.4g} m, GM {p.gm:.4g} m, {speed_words}, roll period {p.roll_period:.4g} s"
    made: dict[tuple[str, int], Judgement] = {}
    steps = [step for level in (1, 2) if level in levels for step in _steps(p, propulsion, level)]
    for done, step in enumerate(steps, 1):
        for _ in step.before(p) if step.before is not None else ():
            yield (done - 0.5) / len(steps), _record(ship, loading, made)
        one = step.judge()
        made[one.mode, one.level] = one
        yield done / len(steps), _record(ship, loading, made)


class _Step(NamedTuple):
    """One level of one mode, and what may be made ready before it piece by piece."""

    judge: Callable[[], Judgement]
    before: Callable[[Particulars], Iterator[None]] | None = None


def _steps(p: Particulars, propulsion: Propulsion | None, level: int) -> list[_Step]:
    """All modes at one level."""
    if level == 1:
        modes = (parametric_rolling, pure_loss, surf_riding, dead_ship, excessive_acceleration)
        return [_Step(partial(mode.level1, p)) for mode in modes]
    return [
        _Step(partial(parametric_rolling.level2, p), parametric_rolling.rolled),
        _Step(partial(pure_loss.level2, p), None if math.isnan(p.speed) else pure_loss.balanced),
        _Step(partial(surf_riding.level2, p, propulsion)),
        _Step(partial(dead_ship.level2, p)),
        _Step(partial(excessive_acceleration.level2, p)),
    ]


def _record(ship: Ship, loading: str, made: Mapping[tuple[str, int], Judgement]) -> Criteria:
    """What has been judged so far, mode by mode."""
    return Criteria(
        ship.name, loading, tuple(made[mode, level] for mode in MODES for level in (1, 2) if (mode, level) in made)
    )
