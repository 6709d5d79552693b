"""All five failure modes of a ship, at two levels each."""

from __future__ import annotations

from quartering.doors import takes
from quartering.hull.propulsion import Propulsion
from quartering.hull.ship import Ship
from quartering.hull.told import number
from quartering.study.criteria import dead_ship, excessive_acceleration, parametric_rolling, pure_loss, surf_riding
from quartering.study.criteria.particulars import particulars
from quartering.study.criteria.record import Criteria


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
    service = None if speed is None else number(ship, "speed", speed)
    period = None if roll_period is None else number(ship, "roll_period", roll_period)
    p = particulars(ship, service, period)
    judgements = (
        parametric_rolling.level1(p), parametric_rolling.level2(p), pure_loss.level1(p), pure_loss.level2(p),
        surf_riding.level1(p), surf_riding.level2(p, propulsion), dead_ship.level1(p), dead_ship.level2(p),
        excessive_acceleration.level1(p), excessive_acceleration.level2(p),
    )  # fmt: skip
    speed_words = "no service speed told" if service is None else f"{service:.4g} m/s, Fn {p.froude:.3g}"
    loading = f"draught {p.draught:.4g} m, GM {p.gm:.4g} m, {speed_words}, roll period {p.roll_period:.4g} s"
    return Criteria(ship.name, loading, judgements)
