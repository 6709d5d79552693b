"""Where every coefficient of the equations comes from, in words."""

from __future__ import annotations

from typing import Literal

from quartering.hull.ship import Ship
from quartering.hydro.crossflow import reference_velocity
from quartering.hydro.ship_damping import AMPLITUDE, MODULUS
from quartering.names import CUBIC_NAMES, INERTIA_NAMES, LINEAR_NAMES, RESTORING_NAMES

Kind = Literal["measured", "regression", "strip", "database", "cross-flow", "estimated", "derived", "given"]


def coefficient_sources(ship: Ship) -> dict[str, tuple[Kind, str]]:
    """Kind and source of every standard coefficient before overrides and measured sets.

    Parameters
    ----------
    ship : Ship

    Returns
    -------
    dict of str to (kind, source)    by coefficient name

    Notes
    -----
    Source: each line names its own.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> coefficient_sources(ship("wigley"))["Y_vvv"][0]
    'cross-flow'
    """
    loading, scale = ship.loading, ship.velocity_scale or reference_velocity(ship.hull.length)
    said = {key: ship.provenance.get(key, "given") for key in ("gm", "gyradius_roll", "gyradius_yaw", "roll_damping")}
    potential: Kind = "strip" if ship.database is None else "database"
    waves = f"wave damping of {ship.radiation_words}"
    lift, lever = "estimated: Clarke's regression", "estimated: Clarke's regression at half draught"
    sources: dict[str, tuple[Kind, str]] = {
        "m": ("derived", "displacement of the lines"),
        "I_x": ("derived", f"m k_xx^2; k_xx {said['gyradius_roll']}"),
        "I_z": ("derived", f"m k_zz^2; k_zz {said['gyradius_yaw']}"),
        "I_xz": ("derived", "principal axes"),
    }
    sources |= {
        name: (potential, f"added mass of {ship.radiation_words} at omega") for row in INERTIA_NAMES for name in row
    }
    for name in (name for row in LINEAR_NAMES for name in row):
        levered = "K" in name or "p" in name
        sources[name] = ("regression", f"{lever if levered else lift}, and {waves} at omega")
        if ship.linear == "strip":
            by = "strip theory with speed terms at omega"
            if ship.database is not None:
                by = (
                    f"{ship.radiation_words} at omega, zero speed, and strip theory's speed terms without the aft end's"
                )
            sources[name] = (potential, f"{by}; no lift")
    kind, source = sources["K_p"]
    if ship.roll_method == "fraction":
        sources["K_p"] = (kind, f"{source}, and {loading.roll_damping:g} of critical ({said['roll_damping']})")
    else:
        form = f"{said['roll_damping']}; K_p and K_p|p| fitted about {AMPLITUDE:g} deg at the natural frequency and this speed"
        sources["K_p"] = ("estimated", f"{form}; and {waves} at omega")
        sources[MODULUS] = ("estimated", form)
    sources |= {name: ("derived", "upright symmetry") for row in RESTORING_NAMES for name in row}
    sources |= dict.fromkeys(RESTORING_NAMES[1], ("derived", "fit to the righting arm of the lines"))
    if ship.righting == "spline":
        curve = "in the spline through the righting arm of the lines"
        sources |= dict.fromkeys(RESTORING_NAMES[1][1:], ("derived", curve))
    sources["K_phi"] = ("derived", f"-rho g V GM; GM {said['gm']}")
    drag = f"estimated: cross-flow drag, C_D {ship.drag_coefficient:g}, u0 {scale:.3g} m/s, at half draught"
    sources |= {name: ("cross-flow", drag) for row in CUBIC_NAMES for name in row}
    return sources
