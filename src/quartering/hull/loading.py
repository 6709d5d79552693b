"""How a ship is loaded: GM and KG, radii of gyration, added roll damping, water."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace

from quartering.conventions import WATER_DENSITY
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.hull import Hull
from quartering.hull.told import number
from quartering.option_checks import Refused

ROLL_DAMPING = 0.05
"""Added roll damping, fraction of critical, when none is given (assumed)."""


@dataclass(frozen=True)
class Loading:
    """How a ship is loaded.

    Parameters
    ----------
    gm, kg : float                          metacentric height, and height of G over the baseline [m]; numbers, or text: "5.1 m"
    gyradius_roll, gyradius_yaw : float     k_xx, k_zz without added mass [m]
    roll_damping : float                    added viscous roll damping, fraction of critical; 0 by a component method [1]
    density : float                         of the water [kg/m3]
    """

    gm: float
    kg: float
    gyradius_roll: float
    gyradius_yaw: float
    roll_damping: float = ROLL_DAMPING
    density: float = WATER_DENSITY

    def __post_init__(self) -> None:
        """Text with a unit becomes a number; numbers are checked where a ship gets them."""
        for one in fields(self):
            given = getattr(self, one.name)
            if isinstance(given, str):
                name = "water_density" if one.name == "density" else one.name
                object.__setattr__(self, one.name, number(None, name, given))


def reloaded(
    name: str,
    hull: Hull,
    loading: Loading,
    *,
    gm: float | None = None,
    kg: float | None = None,
    gyradius_roll: float | None = None,
    gyradius_yaw: float | None = None,
    roll_damping: float | str | None = None,
) -> Loading:
    """Loading with some values changed, checked, and GM and KG tied by the hull's KM.

    name: ship or file named in messages
    hull: at the draught of the loading
    loading: what is not given is taken from here
    gm, kg: at most one of them, in their ranges [m]
    gyradius_roll, gyradius_yaw: [m]
    roll_damping: fraction of critical, or the word of a component method, which has none

    KG = KM - GM.  Source: [Lewis88] ch. 2.

    >>> from quartering.hull.lines.hull import box_hull
    >>> box = box_hull(100.0, 20.0, 5.0, 10.0)
    >>> round(reloaded("box", box, Loading(1.0, 8.17, 7.0, 25.0), kg=6.0).gm, 4)
    3.1667
    """
    km = hydrostatics(hull).km
    if gm is None:
        kg = loading.kg if kg is None else kg
        gm = km - kg
        source = f"kg = {kg:g} m under KM = {km:.3f} m gives "
    else:
        kg, source = km - gm, ""
    if not (math.isfinite(gm) and gm > 0):
        raise Refused(
            "kg" if source else "gm",
            f"{source}gm = {gm:g} m; the metacentric height must be above 0 (an upright ship that floats stably); "
            f"try gm = 0.05 B = {0.05 * hull.beam:.3g} m",
            name,
        )
    if kg < -hull.draught:
        raise Refused(
            "gm",
            f"gm = {gm:g} m over KM = {km:.3f} m puts G {-kg:.4g} m below the keel, deeper than the ship's draught; is "
            f"the unit right? try 0.05 B = {0.05 * hull.beam:.3g} m",
            name,
        )
    others = {"gyradius_roll": gyradius_roll, "gyradius_yaw": gyradius_yaw, "roll_damping": roll_damping}
    return loaded_alike(replace(loading, gm=gm, kg=kg), {name: one for name, one in others.items() if one is not None})


def loaded_alike(loading: Loading, values: Mapping[str, float | str]) -> Loading:
    """Loading with radii of gyration and roll damping changed; by a component method the damping is no fraction.

    >>> loaded_alike(Loading(1.0, 6.0, 5.0, 25.0), {"roll_damping": "ikeda"}).roll_damping
    0.0
    """
    numbers = {name: 0.0 if isinstance(value, str) else value for name, value in values.items()}
    return replace(loading, **numbers)
