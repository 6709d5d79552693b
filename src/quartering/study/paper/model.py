"""The paper's modified model: Table I as ratios on the coefficients of a ship of ours."""

from __future__ import annotations

from functools import cache
from types import MappingProxyType
from typing import Final

from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.file.read import ship
from quartering.hull.ship import Ship

TABLE_I: Final = MappingProxyType(
    {
        "Y_prr": (0.4723, 1.4168),
        "Y_vrr": (-11.9663, -5.9832),
        "Y_ppp": (0.0037, 0.0112),
        "Y_vpp": (-0.026, 0.0),
        "K_prr": (-1.88, 0.0),
        "K_vpp": (0.1035, 0.3104),
        "K_vrr": (13.0517, 39.155),
    }
)
"""Coefficient -> (original, modified) as printed; their unit is not stated, so only the ratios carry over.

The scan has lost the repeated subscript ("pr", "vr", "pp", "vp"). The subscripts here are those of the coefficients in I2 and
I3, which the paper says it varies; the letters Y and K are as scanned. K_ppp is not in the table.
"""

PAPER_SHIP: Final = "series60-cb60"


@takes(name="word")
@cache
def paper_ship(name: str = PAPER_SHIP) -> Ship:
    """A built-in ship with the paper's equations: velocities over ground, no ends, righting moment in powers of phi.

    Parameters
    ----------
    name : str

    Returns
    -------
    Ship

    Examples
    --------
    >>> paper_ship().name, paper_ship().velocities
    ('Series 60, CB 0.60', 'absolute')
    """
    return ship(name).with_(velocities="absolute", drag="cubic", ends="strips", righting="polynomial")


def table_ratios() -> dict[str, float]:
    """Modified over original value of each coefficient of Table I.

    Returns by name [1]

    Source: [H71] Table I, printed to 2 to 6 digits: near 3, near 1/2, and 0.
    """
    return {name: modified / original + 0.0 for name, (original, modified) in TABLE_I.items()}


def modified_model(of: Ship | None = None, strength: float = 1.0) -> Ship:
    """A ship with its coefficients changed in the ratios of Table I.

    of: by default Series 60, CB 0.60, with the paper's equations
    strength: 0 the ship as it is, 1 the table, values between in proportion
    Returns the seven coefficients multiplied; all others, and the loading, unchanged

    The table's own numbers cannot be used: no unit, inertia or linear coefficient is printed with them. What carries over is
    the mechanism.  Source: [H71] Table I.  Valid: as far as the ship's own seven coefficients are; those of the built-in
    hulls are estimates from cross-flow drag.
    """
    if not 0.0 <= strength <= 1.0:
        raise InputError(f"strength {strength} of the modification: give a value from 0 (none) to 1 (Table I)")
    factors = {name: 1.0 + strength * (ratio - 1.0) for name, ratio in table_ratios().items()}
    return (of or paper_ship()).with_(factors=factors)


FEEDING: Final = -35.0
"""Multiplier of K_prr in `feeding_model`: invented, for a demonstration."""


def feeding_model(of: Ship | None = None, multiplier: float = FEEDING) -> Ship:
    """The modified model with K_prr turned round, so that yaw feeds roll: the paper's mechanism, made strong enough to show.

    of: by default Series 60, CB 0.60, with the paper's equations
    multiplier: of the ship's own K_prr, in place of the table's 0

    In the paper's numbers I3 = 0.1 K_vrr + K_prr goes from -0.575 to +3.92, and yaw feeds roll where it took from it. With
    cross-flow drag the same ratios only take I3 from strongly negative to about nothing.  Source: [H71] Table I, I3; the
    multiplier is invented.
    """
    factors = table_ratios() | {"K_prr": multiplier}
    return (of or paper_ship()).with_(factors=factors)
