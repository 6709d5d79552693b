"""One condition of a ship: its steady motion, the verdict, what stands beside it, and what would make it stable."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict
from typing import Final, NamedTuple

from quartering.hull.righting.arm import warn_of_polynomial
from quartering.hull.ship import Ship
from quartering.hydro.calm_water import calm_water_exponents
from quartering.hydro.coefficient_table import Entry
from quartering.hydro.coefficients import coefficients
from quartering.hydro.terms import estimates
from quartering.loads.forces import Form
from quartering.loads.waves import Wave
from quartering.motion.equations.model import Model
from quartering.motion.of_ship import equations
from quartering.motion.steady.motion import Motion, advice, steady_motion, within_limit
from quartering.stability.verdict import Verdict, stability
from quartering.study.condition.beside import Way, also_words, capsizes_on_the_way, other_stable_motions
from quartering.study.effects.cure import Cure, seek

_MOST_CURES = 3


class Beside(NamedTuple):
    """What stands beside a stable motion.

    Parameters
    ----------
    capsizes : dict            from which beginning the ship capsizes before it comes to the motion, and when [s]
    others : list of float     largest roll of other stable motions [deg]
    """

    capsizes: dict[Way, float]
    others: list[float]

    @property
    def sentences(self) -> list[str]:
        """What is to be said of it."""
        said = []
        if self.capsizes:
            beginnings = [f"{_BEGINNINGS[way]} after {time:.0f} s" for way, time in self.capsizes.items()]
            said.append(f"Stable motion, capsizes on the way: {', '.join(beginnings)}.")
        if self.others:
            said.append(
                f"Other stable motions exist in this wave: {also_words(self.others)}, largest roll over a cycle."
            )
        return said


_BEGINNINGS: Final[dict[Way, str]] = {
    "upright": "from upright in the whole wave", "raised": "with the wave raised in three steps of ten periods"
}  # fmt: skip
_NOTHING: Final = Beside({}, [])


class Examined(NamedTuple):
    """One condition with its equations, its steady motion and the verdict on it."""

    ship: Ship
    wave: Wave
    speed: float
    heading: float
    model: Model
    motion: Motion
    verdict: Verdict
    harmonics: int = 1
    form: Form = "stf"
    beside: Beside = _NOTHING


def examine(one: Ship, wave: Wave, speed: float, heading: float, harmonics: int = 1, form: Form = "stf") -> Examined:
    """Find and judge the motion that a wave raised slowly from nothing leads to, as a map does."""
    model = equations(one, wave, speed, heading, form=form)
    motion = within_limit(model, steady_motion(model, harmonics, start="rest"))
    if motion.status.ok:
        warn_of_polynomial(one, math.degrees(motion.peak[1]))
    verdict = stability(model, motion)
    return Examined(one, wave, speed, heading, model, motion, verdict, harmonics, form, _beside(model, motion, verdict))


def _beside(model: Model, motion: Motion, verdict: Verdict) -> Beside:
    """What stands beside a motion; asked of a stable one."""
    if not verdict.stable:
        return _NOTHING
    others = other_stable_motions(model, motion)
    return Beside(capsizes_on_the_way(model), [math.degrees(roll) for roll in others])


def helps(found: Examined) -> list[Cure]:
    """The few smallest changes that make an unstable motion stable; none for a stable one."""
    steps = list(seek_help(found))
    return steps[-1] if steps else []


def seek_help(found: Examined) -> Iterator[list[Cure]]:
    """The search of `helps` in small steps: what has been found so far."""
    if not found.verdict.stable and found.motion.status.ok:
        at = (found.ship, found.wave, found.speed, found.heading)
        for some in seek(*at, harmonics=found.harmonics, form=found.form):
            yield some[:_MOST_CURES]


def estimated(found: Examined) -> dict[str, list[str]]:
    """Names of the coefficients that are estimated, by method."""
    return estimates(_entries(found))


def _entries(found: Examined) -> list[Entry]:
    return list(coefficients(found.ship, found.model.frequency, found.speed).table())


def facts(found: Examined, healing: list[Cure] | None) -> dict[str, object]:
    """Everything about a condition, for programs: what `quartering verdict --json` prints; None where no cures were sought."""
    one, model, motion, v = found.ship, found.model, found.motion, found.verdict
    sway, roll, yaw = motion.amplitude
    return {
        "ship": one.name,
        "condition": dict(model.source),
        "sentence": v.sentence, "stable": v.stable, "kind": v.kind, "status": motion.status.name.lower(),
        "sway": sway, "roll_deg": math.degrees(roll), "yaw_deg": math.degrees(yaw),
        "roll_peak_deg": math.degrees(motion.peak[1]), "encounter_frequency": model.frequency,
        "k2": v.k2, "k2_rho": v.k2_rho, "k2_paper": v.k2_paper, "through_water": v.through_water,
        "index": v.index, "n2": v.n2, "q": v.q, "slow": v.slow,
        "averaged": v.averaged, "combination": v.combination, "multipliers": v.multipliers, "exponents": v.exponents,
        "calm_water": v.calm_water, "without_autopilot": v.without_autopilot, "heading_off_course": motion.heading,
        "autopilot": None if model.autopilot is None else asdict(model.autopilot), "first_order_stable": v.first_order_stable,
        "strongest": list(v.strongest), "roll_share": v.roll_share, "liouville": v.liouville,
        "mean_jacobian": v.mean_jacobian, "advice": advice(motion, found.model.capsize_limit), "residual": motion.residual,
        "natural_roll_frequency": coefficients(one, 0.0, 0.0).roll_frequency,
        "capsizes_on_the_way": found.beside.capsizes, "other_stable_rolls_deg": found.beside.others,
        "cures": None if healing is None else [
            {"parameter": c.parameter, "now": c.now, "needed": c.needed, "unit": c.unit} for c in healing
        ],
        "calm_water_at_own_frequencies": calm_water_exponents(one, found.speed),
        "estimated": [e.name for e in _entries(found) if e.estimated],
        "sources": {e.name: e.source for e in _entries(found)},
    }  # fmt: skip
