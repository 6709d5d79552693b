"""Types of what `quartering.options` declares, for editors; written by ``tools/write_options.py``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypedDict

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from quartering.hull.autopilot import Autopilot, Rudder
    from quartering.hull.propulsion import Propulsion
    from quartering.hull.user_database import Database

Datum = Literal["keel", "waterline"]
Linear = Literal["default", "strip"]
Velocities = Literal["relative", "absolute"]
Righting = Literal["spline", "polynomial"]
Sections = Literal["auto", "lewis", "close-fit"]
Hydrodynamics = Literal["strips", "panels"]
Ends = Literal["strips", "three-dimensional"]
Drag = Literal["strips", "cubic"]
Extend = Literal["no", "yes"]


class ShipOptions(TypedDict, total=False):
    """What `Ship.with_` takes."""

    name: str | None
    """What the ship is called."""
    length: float | str | None
    """Between perpendiculars; stretches the lines, the loading in proportion [m, L, B, T]."""
    beam: float | str | None
    """Moulded; stretches the lines [m, L, B, T]."""
    design_draught: float | str | None
    """Draught the lines are drawn for; stretches their heights [m, L, B, T]."""
    draught: float | str | None
    """Draught the ship floats at; the lines stay [m, L, B, T]."""
    depth: float | str | None
    """Side of the hull from the keel to the deck; carries the lines up where they end below [m, L, B, T]."""
    datum: Datum | None
    """Where the heights of the lines are counted from; found from the lines where they tell it: keel (up from the kee ..."""
    gm: float | str | None
    """Transverse metacentric height [m, L, B, T]."""
    kg: float | str | None
    """Height of the centre of gravity over the keel [m, L, B, T]."""
    gyradius_roll: float | str | None
    """Radius of gyration in roll, without added mass [m, L, B, T]."""
    roll_period: float | str | None
    """Natural roll period; gives the radius of gyration in roll, in its place [s, min]."""
    gyradius_pitch: float | str | None
    """Radius of gyration in pitch, without added mass [m, L, B, T]."""
    gyradius_yaw: float | str | None
    """Radius of gyration in yaw, without added mass [m, L, B, T]."""
    roll_damping: float | str | None
    """Added roll damping, fraction of critical [1, %], or ikeda or ikeda-simplified."""
    water_density: float | str | None
    """Of the water; fresh water 1000 [kg/m3, t/m3]."""
    loadings: Mapping[str, Mapping[str, Any]] | None
    """Named loading cases, each with keys of a loading and a draught; recorded."""
    loading_case: str | None
    """One of the named loading cases, which the ship then has."""
    linear: Linear | None
    """Sway-yaw derivatives: default (lift from regression), strip (potential flow alone)."""
    velocities: Velocities | None
    """Velocity that lift acts on: relative (to the water, which the wave moves), absolute (over ground, as in the pap ..."""
    righting: Righting | None
    """Righting curve in the equations: spline (the curve itself), polynomial (odd, to phi^7, as in the paper)."""
    sections: Sections | None
    """Section coefficients: auto (the section's own contour), lewis (its Lewis form), close-fit (its own contour)."""
    hydrodynamics: Hydrodynamics | None
    """Added mass, damping and wave forces at zero speed, where no database gives them: strips (strip theory), panels  ..."""
    ends: Ends | None
    """Water round stem and stern: strips (none), three-dimensional (the water finds its way round them)."""
    drag_coefficient: float | str | None
    """Cross-flow drag of the sections [1, %]."""
    drag: Drag | None
    """Form of the cross-flow drag: strips (|q| q strip by strip), cubic (ten cubic coefficients, one reference veloci ..."""
    velocity_scale: float | str | None
    """Velocity at which the cross-flow drag is made cubic [m/s, kn, km/h, Fn]."""
    measured: str | Path | None
    """Measured manoeuvring set that replaces regression and cross-flow, or none."""
    database: Database | str | Path | None
    """Your own coefficients and wave forces at zero speed, in place of strip theory: a file of Capytaine or WAMIT, or ..."""
    autopilot: Autopilot | Mapping[str, float | str] | str | None
    """Keeps the course: rudder angle = gain x heading off course + rate_gain x rate of turn."""
    autopilot_gain: float | str | None
    """Rudder angle per angle off course [1, %]."""
    autopilot_rate_gain: float | str | None
    """Rudder angle per rate of turn [s, min]."""
    autopilot_lag: float | str | None
    """Time constant of the steering gear [s, min]."""
    rudder: Rudder | Mapping[str, float | str] | str | None
    """Its lift is estimated from these; by rule when left out."""
    rudder_area: float | str | None
    """Of the blade, side view [m2]."""
    rudder_aspect: float | str | None
    """Height over chord [1, %]."""
    bilge_keels: tuple[float | str, float | str] | Mapping[str, float | str] | str | None
    """One of the pair; ikeda and ikeda-simplified allow for them."""
    bilge_keel_length: float | str | None
    """Length of one bilge keel of the pair [m, L, B, T]."""
    bilge_keel_breadth: float | str | None
    """Breadth of one bilge keel of the pair [m, L, B, T]."""
    bilge_keel_area: float | str | None
    """Total area of the bilge keels, where their length and breadth are not given [m2]."""
    openings: float | str | None
    """Heel at which unprotected openings go under: a capsize [deg, rad]."""
    highest_position: Mapping[str, float | str] | str | None
    """Where people are highest, whose acceleration in a sea counts."""
    highest_position_x: float | str | None
    """From midship, + forward [m, L, B, T]."""
    highest_position_height: float | str | None
    """Over the keel [m, L, B, T]."""
    windage: Mapping[str, float | str] | str | None
    """What the wind meets: side above the water."""
    windage_area: float | str | None
    """Projected on the side [m2]."""
    windage_lever: float | str | None
    """Its centre over half the draught [m, L, B, T]."""
    propulsion: Propulsion | Mapping[str, float | str] | str | None
    """Resistance r0 + r1 u + .. + r5 u^5, propeller k0 + k1 J + k2 J^2: estimated (from the lines)."""
    propeller_diameter: float | str | None
    """Of the propeller [m, L, B, T]."""
    thrust_at_rest: float | str | None
    """K0 of the thrust coefficient [1, %]."""
    thrust_slope: float | str | None
    """K1 of the thrust coefficient [1, %]."""
    thrust_curvature: float | str | None
    """K2 of the thrust coefficient [1, %]."""
    thrust_deduction: float | str | None
    """Of the propeller behind the hull [1, %]."""
    wake_fraction: float | str | None
    """Of the propeller behind the hull [1, %]."""
    propellers: float | str | None
    """How many equal ones [1, %]."""
    resistance_0: float | str | None
    """R0 of the resistance [N/(m/s)^0] [1, %]."""
    resistance_1: float | str | None
    """R1 of the resistance [N/(m/s)^1] [1, %]."""
    resistance_2: float | str | None
    """R2 of the resistance [N/(m/s)^2] [1, %]."""
    resistance_3: float | str | None
    """R3 of the resistance [N/(m/s)^3] [1, %]."""
    resistance_4: float | str | None
    """R4 of the resistance [N/(m/s)^4] [1, %]."""
    resistance_5: float | str | None
    """R5 of the resistance [N/(m/s)^5] [1, %]."""
    values: Mapping[str, float] | None
    """Coefficients you know, in SI about G, by name; they replace the estimates."""
    factors: Mapping[str, float] | None
    """Factors on coefficients, however they were found."""


class StudyAxes(TypedDict, total=False):
    """What a study may vary of a ship: one value or several, each a number or text with a unit; coefficients by factors."""

    draught: ArrayLike | str | Sequence[float | str]
    """Draught the ship floats at; the lines stay [m, L, B, T]."""
    gm: ArrayLike | str | Sequence[float | str]
    """Transverse metacentric height [m, L, B, T]."""
    kg: ArrayLike | str | Sequence[float | str]
    """Height of the centre of gravity over the keel [m, L, B, T]."""
    gyradius_roll: ArrayLike | str | Sequence[float | str]
    """Radius of gyration in roll, without added mass [m, L, B, T]."""
    roll_period: ArrayLike | str | Sequence[float | str]
    """Natural roll period; gives the radius of gyration in roll, in its place [s, min]."""
    gyradius_yaw: ArrayLike | str | Sequence[float | str]
    """Radius of gyration in yaw, without added mass [m, L, B, T]."""
    roll_damping: ArrayLike | str | Sequence[float | str]
    """Added roll damping, fraction of critical [1, %], or ikeda or ikeda-simplified."""
    water_density: ArrayLike | str | Sequence[float | str]
    """Of the water; fresh water 1000 [kg/m3, t/m3]."""
    velocities: ArrayLike | str | Sequence[float | str]
    """Velocity that lift acts on: relative (to the water, which the wave moves), absolute (over ground, as in the pap ..."""
    drag: ArrayLike | str | Sequence[float | str]
    """Form of the cross-flow drag: strips (|q| q strip by strip), cubic (ten cubic coefficients, one reference veloci ..."""
    bilge_keel_length: ArrayLike | str | Sequence[float | str]
    """Length of one bilge keel of the pair [m, L, B, T]."""
    bilge_keel_breadth: ArrayLike | str | Sequence[float | str]
    """Breadth of one bilge keel of the pair [m, L, B, T]."""
    Y_v: ArrayLike | str | Sequence[float | str]
    Y_p: ArrayLike | str | Sequence[float | str]
    Y_r: ArrayLike | str | Sequence[float | str]
    K_v: ArrayLike | str | Sequence[float | str]
    K_p: ArrayLike | str | Sequence[float | str]
    K_r: ArrayLike | str | Sequence[float | str]
    N_v: ArrayLike | str | Sequence[float | str]
    N_p: ArrayLike | str | Sequence[float | str]
    N_r: ArrayLike | str | Sequence[float | str]
    Y_phi: ArrayLike | str | Sequence[float | str]
    Y_phiphiphi: ArrayLike | str | Sequence[float | str]
    Y_phi5: ArrayLike | str | Sequence[float | str]
    Y_phi7: ArrayLike | str | Sequence[float | str]
    K_phi: ArrayLike | str | Sequence[float | str]
    K_phiphiphi: ArrayLike | str | Sequence[float | str]
    K_phi5: ArrayLike | str | Sequence[float | str]
    K_phi7: ArrayLike | str | Sequence[float | str]
    N_phi: ArrayLike | str | Sequence[float | str]
    N_phiphiphi: ArrayLike | str | Sequence[float | str]
    N_phi5: ArrayLike | str | Sequence[float | str]
    N_phi7: ArrayLike | str | Sequence[float | str]
    Y_vvv: ArrayLike | str | Sequence[float | str]
    Y_ppp: ArrayLike | str | Sequence[float | str]
    Y_rrr: ArrayLike | str | Sequence[float | str]
    Y_vpp: ArrayLike | str | Sequence[float | str]
    Y_vrr: ArrayLike | str | Sequence[float | str]
    Y_pvv: ArrayLike | str | Sequence[float | str]
    Y_prr: ArrayLike | str | Sequence[float | str]
    Y_rvv: ArrayLike | str | Sequence[float | str]
    Y_rpp: ArrayLike | str | Sequence[float | str]
    Y_vpr: ArrayLike | str | Sequence[float | str]
    K_vvv: ArrayLike | str | Sequence[float | str]
    K_ppp: ArrayLike | str | Sequence[float | str]
    K_rrr: ArrayLike | str | Sequence[float | str]
    K_vpp: ArrayLike | str | Sequence[float | str]
    K_vrr: ArrayLike | str | Sequence[float | str]
    K_pvv: ArrayLike | str | Sequence[float | str]
    K_prr: ArrayLike | str | Sequence[float | str]
    K_rvv: ArrayLike | str | Sequence[float | str]
    K_rpp: ArrayLike | str | Sequence[float | str]
    K_vpr: ArrayLike | str | Sequence[float | str]
    N_vvv: ArrayLike | str | Sequence[float | str]
    N_ppp: ArrayLike | str | Sequence[float | str]
    N_rrr: ArrayLike | str | Sequence[float | str]
    N_vpp: ArrayLike | str | Sequence[float | str]
    N_vrr: ArrayLike | str | Sequence[float | str]
    N_pvv: ArrayLike | str | Sequence[float | str]
    N_prr: ArrayLike | str | Sequence[float | str]
    N_rvv: ArrayLike | str | Sequence[float | str]
    N_rpp: ArrayLike | str | Sequence[float | str]
    N_vpr: ArrayLike | str | Sequence[float | str]
