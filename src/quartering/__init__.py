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

import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any

from quartering.hull import roll_period as _roll_period

if TYPE_CHECKING:
    from quartering.conventions import DamageWarning, InputError, RangeWarning
    from quartering.hull.autopilot import Autopilot
    from quartering.hull.file.read import ship
    from quartering.hull.hydrostatics import hydrostatics
    from quartering.hull.lines.section import Section
    from quartering.hull.propulsion import Propulsion
    from quartering.hull.ship import Loading, Ship
    from quartering.hydro.added_mass import hydrodynamics, hydrodynamics6
    from quartering.hydro.coefficients import coefficients
    from quartering.hydro.database.dataset import read_capytaine, read_wamit, write_capytaine, write_wamit
    from quartering.hydro.decay.of_ship import roll_decay
    from quartering.hydro.decay.record import decay_record, read_decay
    from quartering.hydro.section.dataset import section_coefficients
    from quartering.hydro.source.capytaine_run import bem_forces, bem_hydrodynamics
    from quartering.hydro.strip.kramers_kronig import kramers_kronig, retardation
    from quartering.loads.comparison import compare_forces
    from quartering.loads.forces import wave_forces
    from quartering.loads.sea.sea import Sea
    from quartering.loads.waves import Wave, encounter_frequency
    from quartering.motion.equations.model import Model
    from quartering.motion.of_ship import equations
    from quartering.motion.steady.motion import Motion, steady_motion
    from quartering.motion.surf_riding import surf_riding_thresholds
    from quartering.motion.transient.basin import basin
    from quartering.motion.transient.simulate import simulate
    from quartering.references import cite
    from quartering.stability.variational.hill import hill_exponents
    from quartering.stability.verdict import Verdict, stability
    from quartering.study.branches.branch import branch
    from quartering.study.branches.coexisting import all_motions
    from quartering.study.branches.edge import edge
    from quartering.study.criteria.judged import criteria
    from quartering.study.criteria.limiting_kg import limiting_kg
    from quartering.study.criteria.operational import operational_guidance
    from quartering.study.effects.cure import cures
    from quartering.study.effects.sensitivity import sensitivity
    from quartering.study.effects.tornado import tornado
    from quartering.study.effects.vary import vary
    from quartering.study.maps.assessment import direct_assessment
    from quartering.study.maps.extension import edges_of_largest
    from quartering.study.maps.guidance import guidance
    from quartering.study.maps.polar import polar
    from quartering.study.maps.sweep import sweep
    from quartering.study.paper.model import paper_ship
    from quartering.study.seas.failure_rates.long_term import long_term
    from quartering.study.seas.lyapunov import lyapunov
    from quartering.study.seas.response import sea_response
    from quartering.study.seas.simulated.design_point import design_point
    from quartering.study.seas.simulated.rare import failure_rate_at, largest_roll
    from quartering.study.seas.simulated.simulation import irregular
    from quartering.study.six_modes.broaching import broaching
    from quartering.study.six_modes.broaching_branch import broaching_branch
    from quartering.study.six_modes.gm_in_waves import gm_in_waves, righting_arm
    from quartering.study.six_modes.parametric_map import parametric_map
    from quartering.study.six_modes.parametric_roll import parametric_roll
    from quartering.study.six_modes.responses import responses
    from quartering.study.six_modes.surf_riding import surf_riding, surf_riding_map
    from quartering.study.solve import solve

    __version__: str

_HOMES = {
    "InputError": "conventions",
    "DamageWarning": "conventions",
    "RangeWarning": "conventions",
    "cite": "references",
    "Autopilot": "hull.autopilot",
    "hydrostatics": "hull.hydrostatics",
    "Propulsion": "hull.propulsion",
    "Section": "hull.lines.section",
    "Loading": "hull.ship",
    "Ship": "hull.ship",
    "ship": "hull.file.read",
    "write_wamit": "hydro.database.dataset",
    "read_wamit": "hydro.database.dataset",
    "write_capytaine": "hydro.database.dataset",
    "read_capytaine": "hydro.database.dataset",
    "retardation": "hydro.strip.kramers_kronig",
    "kramers_kronig": "hydro.strip.kramers_kronig",
    "coefficients": "hydro.coefficients",
    "decay_record": "hydro.decay.record",
    "read_decay": "hydro.decay.record",
    "roll_decay": "hydro.decay.of_ship",
    "section_coefficients": "hydro.section.dataset",
    "hydrodynamics": "hydro.added_mass",
    "hydrodynamics6": "hydro.added_mass",
    "bem_forces": "hydro.source.capytaine_run",
    "bem_hydrodynamics": "hydro.source.capytaine_run",
    "wave_forces": "loads.forces",
    "compare_forces": "loads.comparison",
    "Sea": "loads.sea.sea",
    "Wave": "loads.waves",
    "encounter_frequency": "loads.waves",
    "basin": "motion.transient.basin",
    "Model": "motion.equations.model",
    "equations": "motion.of_ship",
    "irregular": "study.seas.simulated.simulation",
    "simulate": "motion.transient.simulate",
    "Motion": "motion.steady.motion",
    "steady_motion": "motion.steady.motion",
    "surf_riding": "study.six_modes.surf_riding",
    "surf_riding_map": "study.six_modes.surf_riding",
    "surf_riding_thresholds": "motion.surf_riding",
    "hill_exponents": "stability.variational.hill",
    "Verdict": "stability.verdict",
    "all_motions": "study.branches.coexisting",
    "branch": "study.branches.branch",
    "broaching": "study.six_modes.broaching",
    "broaching_branch": "study.six_modes.broaching_branch",
    "criteria": "study.criteria.judged",
    "limiting_kg": "study.criteria.limiting_kg",
    "operational_guidance": "study.criteria.operational",
    "cures": "study.effects.cure",
    "direct_assessment": "study.maps.assessment",
    "design_point": "study.seas.simulated.design_point",
    "edge": "study.branches.edge",
    "edges_of_largest": "study.maps.extension",
    "failure_rate_at": "study.seas.simulated.rare",
    "gm_in_waves": "study.six_modes.gm_in_waves",
    "guidance": "study.maps.guidance",
    "righting_arm": "study.six_modes.gm_in_waves",
    "largest_roll": "study.seas.simulated.rare",
    "long_term": "study.seas.failure_rates.long_term",
    "lyapunov": "study.seas.lyapunov",
    "paper_ship": "study.paper.model",
    "parametric_map": "study.six_modes.parametric_map",
    "parametric_roll": "study.six_modes.parametric_roll",
    "polar": "study.maps.polar",
    "responses": "study.six_modes.responses",
    "sea_response": "study.seas.response",
    "solve": "study.solve",
    "sensitivity": "study.effects.sensitivity",
    "sweep": "study.maps.sweep",
    "tornado": "study.effects.tornado",
    "vary": "study.effects.vary",
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
    "basin",
    "bem_forces",
    "bem_hydrodynamics",
    "branch",
    "broaching",
    "broaching_branch",
    "cite",
    "coefficients",
    "compare_forces",
    "criteria",
    "cures",
    "decay_record",
    "design_point",
    "direct_assessment",
    "edge",
    "edges_of_largest",
    "encounter_frequency",
    "equations",
    "failure_rate_at",
    "gm_in_waves",
    "guidance",
    "hill_exponents",
    "hydrodynamics",
    "hydrodynamics6",
    "hydrostatics",
    "irregular",
    "kramers_kronig",
    "largest_roll",
    "limiting_kg",
    "long_term",
    "lyapunov",
    "operational_guidance",
    "paper_ship",
    "parametric_map",
    "parametric_roll",
    "polar",
    "read_capytaine",
    "read_decay",
    "read_wamit",
    "responses",
    "retardation",
    "righting_arm",
    "roll_decay",
    "sea_response",
    "section_coefficients",
    "sensitivity",
    "ship",
    "simulate",
    "solve",
    "stability",
    "steady_motion",
    "surf_riding",
    "surf_riding_map",
    "surf_riding_thresholds",
    "sweep",
    "tornado",
    "vary",
    "wave_forces",
    "write_capytaine",
    "write_wamit",
]


@_roll_period.find_by
def _gyradius_of_period(ship: Ship, period: float, where: str) -> float:
    """Radius of gyration in roll of a natural roll period, which `hull` is told and `hydro` works out."""
    from quartering.hydro.damping.natural_roll import gyradius_of_period

    return gyradius_of_period(ship, period, where)


def __getattr__(name: str) -> Any:
    """Import a public name from its room on first use, so that ``import quartering`` costs nothing."""
    if name == "stability":  # a room that can be called: see its own page
        return import_module("quartering.stability")
    if name == "__version__":
        from importlib.metadata import version

        return version("quartering")
    if name not in _HOMES:
        raise AttributeError(f"module 'quartering' has no attribute {name!r}")
    value = getattr(import_module(f"quartering.{_HOMES[name]}"), name)
    if "xarray" in sys.modules:  # datasets may come of it, and show themselves
        import_module("quartering.accessor")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Public names alone, imported or not yet."""
    return sorted(__all__)
