"""How a ship is loaded: GM and KG, radii of gyration, added roll damping, water."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from quartering.conventions import WATER_DENSITY, InputError
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.offsets import Hull
from quartering.hull.roll_method import roll_method
from quartering.hull.units import quantity

ROLL_DAMPING = 0.05
"""Added roll damping, fraction of critical, when none is given (assumed)."""
LARGEST_RADIUS = 2.0
"""Largest radius of gyration over the beam (roll) or the length (yaw): beyond it the mass would lie outside the ship [1]."""


@dataclass(frozen=True)
class Loading:
    """How a ship is loaded.

    Parameters
    ----------
    gm, kg : float                          metacentric height, and height of G over the baseline [m]
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

    Parameters
    ----------
    name : str                              ship or file named in messages
    hull : Hull                             at the draught of the loading
    loading : Loading                       what is not given is taken from here
    gm, kg : float                          at most one of them [m]
    gyradius_roll, gyradius_yaw : float     [m]
    roll_damping : float or str             fraction of critical; 0 by a component method

    Returns
    -------
    Loading

    Raises
    ------
    InputError    both gm and kg, GM or a radius not above 0, G more than a draught below the keel, a radius above
                  `LARGEST_RADIUS` of the beam (roll) or length (yaw), damping below 0 or above 1

    Notes
    -----
    KG = KM - GM.  Source: [Lewis88] ch. 2.

    Examples
    --------
    >>> from quartering.hull.offsets import box_hull
    >>> box = box_hull(100.0, 20.0, 5.0, 10.0)
    >>> round(reloaded("box", box, Loading(1.0, 8.17, 7.0, 25.0), kg=6.0).gm, 4)
    3.1667
    """
    if gm is not None and kg is not None:
        raise InputError(
            f"{name}: gm = {gm:g} m and kg = {kg:g} m are both given; one follows from the other, leave one out"
        )
    km = hydrostatics(hull).km
    if gm is None:
        kg = loading.kg if kg is None else kg
        gm = km - kg
        source = f"kg = {kg:g} m under KM = {km:.3f} m gives "
    else:
        kg, source = km - gm, ""
    if not (math.isfinite(gm) and gm > 0):
        raise InputError(
            f"{name}: {source}gm = {gm:g} m; the metacentric height must be above 0 (an upright ship that floats stably); "
            f"try 0.05 B = {0.05 * hull.beam:.3g} m"
        )
    if kg < -hull.draught:
        raise InputError(
            f"{name}: gm = {gm:g} m over KM = {km:.3f} m puts G {-kg:.4g} m below the keel, deeper than the ship's draught; is "
            f"the unit right? try 0.05 B = {0.05 * hull.beam:.3g} m"
        )
    _check_radii(name, hull, gyradius_roll, gyradius_yaw)
    if roll_damping is None:
        damping = loading.roll_damping
    elif roll_method(roll_damping) != "fraction":
        damping = 0.0
    else:
        damping = quantity(roll_damping, "ratio", what=f"{name}: roll_damping")
    if not 0 <= damping <= 1:
        raise InputError(
            f"{name}: roll_damping = {damping:g}; it is a fraction of critical damping, from 0 to 1; try 0.05"
        )
    return replace(
        loading,
        gm=gm,
        kg=kg,
        gyradius_roll=gyradius_roll or loading.gyradius_roll,
        gyradius_yaw=gyradius_yaw or loading.gyradius_yaw,
        roll_damping=damping,
    )


def _check_radii(name: str, hull: Hull, gyradius_roll: float | None, gyradius_yaw: float | None) -> None:
    """Refuse radii of gyration no ship has."""
    radii = {
        "gyradius_roll": (gyradius_roll, hull.beam, 0.35, "B"),
        "gyradius_yaw": (gyradius_yaw, hull.length, 0.25, "L"),
    }
    for key, (radius, size, usual, letter) in radii.items():
        if radius is not None and not 0 < radius <= LARGEST_RADIUS * size:
            raise InputError(
                f"{name}: {key} = {radius:g} m; a radius of gyration is above 0 and at most {LARGEST_RADIUS:g} {letter} = "
                f"{LARGEST_RADIUS * size:.4g} m; try {usual:g} {letter} = {usual * size:.4g} m"
            )
