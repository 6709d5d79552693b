"""`quartering verdict`: one condition, judged every way."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict
from typing import Final, NamedTuple

import numpy as np
from rich.table import Table

from quartering.hull.righting.arm import warn_of_polynomial
from quartering.hull.ship import Ship
from quartering.hydro.calm_water import calm_water_exponents
from quartering.hydro.coefficient_table import Entry
from quartering.hydro.coefficients import coefficients
from quartering.hydro.terms import estimates
from quartering.loads.forces import Form
from quartering.loads.waves import Wave
from quartering.motion.equations.system import Model
from quartering.motion.of_ship import equations
from quartering.motion.steady.motion import Motion, advice, steady_motion, within_limit
from quartering.stability.ahead import announce_compilation
from quartering.stability.verdict import Verdict, stability
from quartering.study.beside import Way, capsizes_on_the_way, other_stable_motions
from quartering.study.effects.cure import Cure, seek
from quartering.view.commands.conditions import condition
from quartering.view.ship_options import option_words
from quartering.view.terminal import next_steps, show, show_json, table
from quartering.view.wording import CALM_COURSE, CALM_WORDS, WITHOUT_WAVES, also_words, estimated_words, exponents_words

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


def judge(
    name: str, typed: tuple[str, str, str, str], harmonics: int, form: str, changes: Mapping[str, str], as_json: bool
) -> None:
    """Print the verdict on one condition."""
    one, wave, speed, heading = condition(name, typed, changes)
    announce_compilation()
    chosen: Form = form  # type: ignore[assignment]  # equations refuses an unknown one
    found = examine(one, wave, speed, heading, harmonics, chosen)
    healing = helps(found)
    if as_json:
        show_json(facts(found, healing))
        return
    show(found.verdict.sentence)
    for sentence in found.beside.sentences:
        show(sentence)
    if healing:
        show("Each of these alone restores stability: " + "; ".join(cure.sentence for cure in healing) + ".")
    if found.motion.status.ok:
        show(_motion_table(one, wave, found))
        calm = calm_water_exponents(one, speed)
        show(_stability_table(found.verdict, calm))
        if calm.real.max() > 0 and one.autopilot is None:
            show(f"Course-unstable in calm water, rudder amidships ({calm.real.max():+.3g} 1/s). {CALM_COURSE}")
    show(estimated_words(estimated(found), one.provenance))
    words = f"--heading {typed[0]} --speed {typed[1]} --wave-length {typed[2]} --wave-height {typed[3]}"
    again = option_words(changes)
    show(
        next_steps(
            f"quartering simulate {name} {words}{again} -o roll.png",
            f"quartering polar {name} --speed {typed[1]}{again}",
        )
    )


def estimated(found: Examined) -> dict[str, list[str]]:
    """Names of the coefficients that are estimated, by method."""
    return estimates(_entries(found))


def _entries(found: Examined) -> list[Entry]:
    return list(coefficients(found.ship, found.model.frequency, found.speed).table())


def _motion_table(one: Ship, wave: Wave, found: Examined) -> Table:
    model, motion = found.model, found.motion
    past = found.verdict.through_water
    still = one.velocities == "absolute"
    slope = wave.amplitude * wave.wavenumber
    sway, roll, yaw = motion.amplitude

    def share(part: float, whole: float, words: str) -> str:
        return f"{part / whole:.3g} of the wave {words}" if whole > 0 else "no wave"

    def through(mode: int, unit: str) -> str:
        """The same motion against the water that moves past the ship."""
        return (
            "" if still else f"; {past[mode] if unit == 'm' else math.degrees(past[mode]):.3g} {unit} through the water"
        )

    rows = [
        (
            "largest roll",
            f"{math.degrees(motion.peak[1]):.3g} deg",
            f"over a cycle; {share(motion.peak[1], slope, 'slope')}",
        ),
        ("sway amplitude, fundamental", f"{sway:.3g} m", share(sway, wave.amplitude, "amplitude") + through(0, "m")),
        ("roll amplitude, fundamental", f"{math.degrees(roll):.3g} deg", share(roll, slope, "slope")),
        ("yaw amplitude, fundamental", f"{math.degrees(yaw):.3g} deg", share(yaw, slope, "slope") + through(2, "deg")),
        ("encounter frequency", f"{model.frequency:.3g} rad/s", f"period {2 * math.pi / model.frequency:.3g} s"),
        ("natural roll frequency", f"{coefficients(one, 0.0, 0.0).roll_frequency:.3g} rad/s", "small roll, alone"),
        ("motion", motion.method, f"{motion.status.advice}; residual {motion.residual:.1e}"),
    ]
    return table("Steady motion", ("quantity", "value", "remark"), rows)


def _stability_table(v: Verdict, calm: np.ndarray) -> Table:
    rows = [
        ("Floquet exponents [1/s]", exponents_words(v.exponents), "decide: all below 0 is stable"),
        ("Floquet multipliers, moduli", ", ".join(f"{m:.3g}" for m in np.abs(v.multipliers)), "below 1 is stable"),
        (
            "K2 [1/s2]",
            f"{v.k2:.3g}",
            f"from I1, I2, I3 with rho {v.k2_rho:.3g}; paper's 0.3 and 0.1 {v.k2_paper:.3g}; below 0 is stable",
        ),
        ("S = -K2/(2 n2) [1/s]", f"{v.index:.3g}", f"n2 {v.n2:.3g} rad/s about the motion; above 0 is stable"),
        *(
            (f"q, n2 near {m} omega/2 [1/s]", f"{full:.3g}", f"paper's form {paper:.3g}; below 0 is stable")
            for m, (paper, full) in v.q.items()
        ),
        (
            "slow sway-yaw modes [1/s]",
            ", ".join(f"{s:.3g}" for s in v.slow),
            "averaged over the wave; below 0 is stable",
        ),
        ("averaged roll pair [1/s]", exponents_words(v.averaged), "equations (A-10)"),
        ("roll with slow modes [1/s]", f"{v.combination:.3g}", "n2 near 2 omega"),
        ("without waves [1/s]", exponents_words(v.calm_water), WITHOUT_WAVES),
        ("in calm water [1/s]", exponents_words(calm), CALM_WORDS),
    ]
    return table("Stability", ("quantity", "value", "remark"), rows)


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
