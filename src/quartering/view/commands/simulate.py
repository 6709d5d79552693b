"""`quartering simulate`: the full equations in time."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from quartering.hull.righting.arm import warn_of_polynomial
from quartering.motion.of_ship import equations
from quartering.motion.steady.motion import steady_motion, within_limit
from quartering.motion.transient.simulate import simulate
from quartering.stability.ahead import announce_compilation
from quartering.view.commands.conditions import condition, sizes
from quartering.view.options import value
from quartering.view.output import PICTURES, claim, write
from quartering.view.ship_options import option_words
from quartering.view.terminal import next_steps, show, show_json
from quartering.view.wording import ship_notes, speed_words


def run_simulation(
    name: str,
    typed: tuple[str, str, str, str],
    roll: str,
    duration: str,
    changes: Mapping[str, str],
    output: str | None,
    as_json: bool,
) -> None:
    """Integrate from a roll angle, print what happened, draw it where asked."""
    one, wave, speed, heading = condition(name, typed, changes)
    path = claim(output, PICTURES) if output is not None else None
    seconds = value(duration, "time", sizes(one), "--duration")
    heel = value(roll, "angle", sizes(one), "--roll")
    announce_compilation()
    model = equations(one, wave, speed, heading)
    trace = simulate(model, seconds, (0.0, math.radians(heel), 0.0, 0.0))
    motion = within_limit(model, steady_motion(model, 3, start="rest"))
    steady = math.degrees(motion.peak[1]) if motion.status.ok else None
    limit, capsize = model.capsize_limit, trace.attrs.get("capsize_time")
    warn_of_polynomial(one, min(float(np.abs(trace["roll"]).max()), limit.angle))
    late = trace["roll"].where(trace["time"] > 0.75 * seconds)
    facts = {
        "ship": one.name, "condition": dict(model.source), "roll_at_start_deg": heel,
        "largest_roll_deg": float(np.abs(trace["roll"]).max()), "largest_late_roll_deg": float(np.abs(late).max()),
        "steady_roll_peak_deg": steady, "capsize_time": capsize, "capsize_angle_deg": limit.angle,
        "capsize_reason": limit.reason,
    }  # fmt: skip
    if path is not None:
        from quartering.view.plots import style
        from quartering.view.plots.trace import trace_picture

        at = f"heading {heading:g} deg, {speed_words(speed, one.hull.length)}"
        title = f"{one.name}: {at}, wave {wave.length:.4g} x {wave.height:.3g} m"
        note = f"Full nonlinear equations, from rest but for the roll angle. {ship_notes(one)}"
        write((path, lambda part: style.save(trace_picture(trace, steady, title, note), part)))
    if as_json:
        show_json(facts)
        return
    if capsize is not None:
        show(f"Capsizes after {capsize:.3g} s (roll past {limit.words}).")
    else:
        words = (
            f"; the steady motion peaks at {steady:.3g} deg" if steady is not None else "; no steady motion was found"
        )
        largest, late_largest = facts["largest_roll_deg"], facts["largest_late_roll_deg"]
        show(f"Largest roll {largest:.3g} deg, in the last quarter {late_largest:.3g} deg{words}.")
    if path is not None:
        show(f"Wrote {path}")
    show(ship_notes(one))
    condition_words = f"--heading {typed[0]} --speed {typed[1]} --wave-length {typed[2]} --wave-height {typed[3]}"
    condition_words += option_words(changes)
    show(next_steps(f"quartering verdict {name} {condition_words}"))
