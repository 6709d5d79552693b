"""Nonlinear sway-roll-yaw motion of a ship in regular oblique waves, and its stability.

The pipeline, room by room: ``hull`` (lines, loading) -> ``hydro`` (coefficients) -> ``loads`` (wave forces) -> ``motion``
(steady and transient motion) -> ``stability`` (verdict) -> ``study`` (maps) -> ``view`` (command line, plots).

Examples
--------
>>> import quartering as qt
>>> ship = qt.ship("series60-cb60")
>>> model = qt.equations(ship, qt.Wave(length=150.0, height=4.0), speed=7.5, heading=30.0)
>>> qt.stability(model, qt.steady_motion(model)).kind
'stable'
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from quartering.hull import roll_period as _roll_period

if TYPE_CHECKING:
    from quartering.conventions import DamageWarning, InputError, RangeWarning
    from quartering.hull.autopilot import Autopilot
    from quartering.hull.hydrostatics import hydrostatics
    from quartering.hull.propulsion import Propulsion
    from quartering.hull.section import Section
    from quartering.hull.ship import Loading, Ship, ship
    from quartering.hydro.bem import bem_forces, bem_hydrodynamics
    from quartering.hydro.coefficients import coefficients
    from quartering.hydro.decayrecord import decay_record, read_decay
    from quartering.hydro.sections import section_coefficients
    from quartering.hydro.shipdecay import roll_decay
    from quartering.hydro.sixmodes import hydrodynamics6
    from quartering.hydro.strip import hydrodynamics
    from quartering.loads.comparison import compare_forces
    from quartering.loads.forces import wave_forces
    from quartering.loads.sea.sea import Sea
    from quartering.loads.waves import Wave, encounter_frequency
    from quartering.motion.equations import Model
    from quartering.motion.irregular import irregular
    from quartering.motion.of_ship import equations
    from quartering.motion.simulate import simulate
    from quartering.motion.steady import Motion, steady_motion
    from quartering.motion.surf_riding import surf_riding_thresholds
    from quartering.references import cite
    from quartering.stability.verdict import Verdict, stability
    from quartering.study.branch import branch
    from quartering.study.coexisting import all_motions
    from quartering.study.criteria.judged import criteria
    from quartering.study.criteria.limiting_kg import limiting_kg
    from quartering.study.cure import cures
    from quartering.study.edge import edge
    from quartering.study.extension import edges_of_largest
    from quartering.study.gm_in_waves import gm_in_waves, righting_arm
    from quartering.study.paper.model import paper_ship
    from quartering.study.polar import polar
    from quartering.study.responses import responses
    from quartering.study.seas.response import sea_response
    from quartering.study.sensitivity import sensitivity
    from quartering.study.sweep import sweep
    from quartering.study.tornado import tornado
    from quartering.study.vary import vary

_HOMES = {
    "Autopilot": "hull.autopilot",
    "InputError": "conventions",
    "DamageWarning": "conventions",
    "RangeWarning": "conventions",
    "hydrostatics": "hull.hydrostatics",
    "Propulsion": "hull.propulsion",
    "Section": "hull.section",
    "Loading": "hull.ship",
    "Ship": "hull.ship",
    "ship": "hull.ship",
    "coefficients": "hydro.coefficients",
    "decay_record": "hydro.decayrecord",
    "read_decay": "hydro.decayrecord",
    "roll_decay": "hydro.shipdecay",
    "section_coefficients": "hydro.sections",
    "hydrodynamics": "hydro.strip",
    "hydrodynamics6": "hydro.sixmodes",
    "wave_forces": "loads.forces",
    "bem_forces": "hydro.bem",
    "bem_hydrodynamics": "hydro.bem",
    "compare_forces": "loads.comparison",
    "Sea": "loads.sea.sea",
    "Wave": "loads.waves",
    "encounter_frequency": "loads.waves",
    "all_motions": "study.coexisting",
    "branch": "study.branch",
    "criteria": "study.criteria.judged",
    "limiting_kg": "study.criteria.limiting_kg",
    "cures": "study.cure",
    "edge": "study.edge",
    "edges_of_largest": "study.extension",
    "gm_in_waves": "study.gm_in_waves",
    "righting_arm": "study.gm_in_waves",
    "Model": "motion.equations",
    "equations": "motion.of_ship",
    "irregular": "motion.irregular",
    "simulate": "motion.simulate",
    "Motion": "motion.steady",
    "steady_motion": "motion.steady",
    "surf_riding_thresholds": "motion.surf_riding",
    "cite": "references",
    "Verdict": "stability.verdict",
    "paper_ship": "study.paper.model",
    "polar": "study.polar",
    "responses": "study.responses",
    "sea_response": "study.seas.response",
    "sensitivity": "study.sensitivity",
    "sweep": "study.sweep",
    "tornado": "study.tornado",
    "vary": "study.vary",
}
__all__ = [
    "Autopilot",
    "DamageWarning",
    "InputError",
    "Loading",
    "Model",
    "Motion",
    "Propulsion",
    "RangeWarning",
    "Sea",
    "Section",
    "Ship",
    "Verdict",
    "Wave",
    "all_motions",
    "bem_forces",
    "bem_hydrodynamics",
    "branch",
    "cite",
    "coefficients",
    "compare_forces",
    "criteria",
    "cures",
    "decay_record",
    "edge",
    "edges_of_largest",
    "encounter_frequency",
    "equations",
    "gm_in_waves",
    "hydrodynamics",
    "hydrodynamics6",
    "hydrostatics",
    "irregular",
    "limiting_kg",
    "paper_ship",
    "polar",
    "read_decay",
    "responses",
    "righting_arm",
    "roll_decay",
    "sea_response",
    "section_coefficients",
    "sensitivity",
    "ship",
    "simulate",
    "stability",
    "steady_motion",
    "surf_riding_thresholds",
    "sweep",
    "tornado",
    "vary",
    "wave_forces",
]


@_roll_period.find_by
def _gyradius_of_period(ship: Ship, period: float, where: str) -> float:
    """Radius of gyration in roll of a natural roll period, which `hull` is told and `hydro` works out."""
    from quartering.hydro.freeroll import gyradius_of_period

    return gyradius_of_period(ship, period, where)


def __getattr__(name: str) -> Any:
    """Import a public name from its room on first use, so that ``import quartering`` costs nothing."""
    if name == "stability":  # a room that can be called: see its own page
        return import_module("quartering.stability")
    if name not in _HOMES:
        raise AttributeError(f"module 'quartering' has no attribute {name!r}")
    value = getattr(import_module(f"quartering.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Public names alone, imported or not yet."""
    return sorted(__all__)
