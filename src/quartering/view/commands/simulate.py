"""`quartering simulate`: the full equations in time."""

from __future__ import annotations

import math

import numpy as np

from quartering.motion.of_ship import equations
from quartering.motion.simulate import simulate
from quartering.motion.steady import steady_motion
from quartering.view.commands.conditions import condition, sizes
from quartering.view.options import value
from quartering.view.output import PICTURES, claim, write
from quartering.view.progress import announce_compilation
from quartering.view.terminal import next_steps, show, show_json


def run_simulation(
    name: str,
    typed: tuple[str, str, str, str],
    roll: str,
    duration: str,
    autopilot: str | None,
    output: str | None,
    as_json: bool,
) -> None:
    """Integrate from a roll angle, print what happened, draw it where asked."""
    one, wave, speed, heading = condition(name, typed, autopilot)
    path = claim(output, PICTURES) if output else None
    seconds = value(duration, "time", sizes(one), "--duration")
    heel = value(roll, "angle", sizes(one), "--roll")
    announce_compilation()
    model = equations(one, wave, speed, heading)
    trace = simulate(model, seconds, (0.0, math.radians(heel), 0.0, 0.0))
    motion = steady_motion(model, 3, start="rest")
    steady = math.degrees(motion.peak[1]) if motion.status.ok else None
    late = trace["roll"].where(trace["time"] > 0.75 * seconds)
    facts = {
        "ship": one.name, "condition": dict(model.source), "roll_at_start_deg": heel,
        "largest_roll_deg": float(np.abs(trace["roll"]).max()), "largest_late_roll_deg": float(np.abs(late).max()),
        "steady_roll_peak_deg": steady, "capsize_time": trace.attrs.get("capsize_time"),
    }  # fmt: skip
    if path is not None:
        from quartering.view.plots import style
        from quartering.view.plots.trace import trace_picture

        title = f"{one.name}: heading {heading:g} deg, {speed:.3g} m/s, wave {wave.length:.4g} x {wave.height:.3g} m"
        note = "Full nonlinear equations, from rest but for the roll angle."
        write((path, lambda part: style.save(trace_picture(trace, steady, title, note), part)))
    if as_json:
        show_json(facts)
        return
    if facts["capsize_time"] is not None:
        show(f"Capsizes after {facts['capsize_time']:.3g} s (roll past 90 deg).")
    else:
        words = (
            f"; the steady motion peaks at {steady:.3g} deg" if steady is not None else "; no steady motion was found"
        )
        largest, late_largest = facts["largest_roll_deg"], facts["largest_late_roll_deg"]
        show(f"Largest roll {largest:.3g} deg, in the last quarter {late_largest:.3g} deg{words}.")
    if path is not None:
        show(f"Wrote {path}")
    condition_words = f"--heading {typed[0]} --speed {typed[1]} --wave-length {typed[2]} --wave-height {typed[3]}"
    show(next_steps(f"quartering verdict {name} {condition_words}"))
