"""`quartering verdict`: one condition, judged every way."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from quartering.conventions import InputError
from quartering.view.console.answer import Answer
from quartering.view.console.arguments import (
    Changes,
    FormName,
    Harmonics,
    Heading,
    Modes,
    ShipName,
    Speed,
    TableFile,
    WaveHeight,
    WaveLength,
)
from quartering.view.console.files import TABLES, reserve_path
from quartering.view.console.printed import table
from quartering.view.console.ship_options import option_words
from quartering.view.console.typed_ship import Typed

if TYPE_CHECKING:
    from pathlib import Path

    import numpy as np

    from quartering.hull.ship import Ship
    from quartering.loads.forces import Form
    from quartering.loads.waves import Wave
    from quartering.stability.verdict import Verdict
    from quartering.study.condition.examine import Examined
    from quartering.study.effects.cure import Cure
    from quartering.view.console.printed import Table


def verdict(
    ship: ShipName,
    heading: Heading,
    speed: Speed,
    wave_length: WaveLength,
    wave_height: WaveHeight,
    changes: Changes,
    harmonics: Harmonics = 1,
    form: FormName = "stf",
    output: TableFile = None,
    modes: Modes = "three",
) -> Answer:
    """Judge the steady motion in one condition: how large, stable or not, why, and what cures it."""
    from quartering.motion.modes import in_six
    from quartering.stability.precompile import announce_compilation
    from quartering.study.condition.examine import examine, facts, helps

    typed = Typed(ship, heading, speed, wave_length, wave_height, changes)
    one, wave, u, mu = typed.read()
    path = reserve_path(output, TABLES)
    if in_six(modes):
        return _six(typed, one, wave, (u, mu), path, own=(harmonics, form) == (1, "stf"))
    announce_compilation("verdict")
    chosen: Form = form  # type: ignore[assignment]  # equations refuses an unknown one
    found = examine(one, wave, u, mu, harmonics, chosen)
    cures = helps(found)
    again = option_words(changes)
    return Answer(
        _lines(found, cures),
        lambda: facts(found, cures),
        output=path,
        next_steps=[
            f"quartering simulate {ship} {typed.words}{again} -o roll.png",
            f"quartering polar {ship} --speed {speed}{again}",
        ],
    )


def _six(typed: Typed, one: Ship, wave: Wave, condition: tuple[float, float], path: Path | None, own: bool) -> Answer:
    """The same judged with heave and pitch, in the pressure over the whole wetted hull."""
    from quartering.stability.precompile import announce_compilation
    from quartering.study.six_modes.cure import cures_six
    from quartering.study.six_modes.parametric_roll import parametric_roll
    from quartering.view.parametric_record import parametric_facts, parametric_lines

    if not own:
        raise InputError("--modes six has harmonics and diffraction of its own; leave --harmonics and --form out")
    announce_compilation()
    found = parametric_roll(one, wave, *condition)
    cured = cures_six(one, wave, *condition) if found.unstable and found.status.ok else []
    again = f"{typed.ship}{option_words(typed.changes)}"
    return Answer(
        _with_cures(parametric_lines(found), cured),
        lambda: parametric_facts(found) | {"cures": [cure.sentence for cure in cured]},
        output=path,
        next_steps=[
            f"quartering polar {again} --speed {typed.speed} --modes six",
            f"quartering verdict {again} {typed.words}",
        ],
    )


def _with_cures(lines: Iterator[Table | str], cured: list[Cure]) -> Iterator[Table | str]:
    """The verdict's lines, after its sentence what lets small roll decay."""
    yield next(lines)
    if cured:
        yield "Each of these alone lets small roll decay: " + "; ".join(cure.sentence for cure in cured) + "."
    yield from lines


def _lines(found: Examined, cures: list[Cure]) -> Iterator[Table | str]:
    """The verdict in sentences, then its numbers."""
    from quartering.hydro.calm_water import calm_water_exponents
    from quartering.study.condition.examine import estimated
    from quartering.view.wording import CALM_COURSE, estimated_words

    one = found.ship
    yield found.verdict.sentence
    yield from found.beside.sentences
    if cures:
        yield "Each of these alone restores stability: " + "; ".join(cure.sentence for cure in cures) + "."
    if found.motion.status.ok:
        yield _motion_table(found)
        calm = calm_water_exponents(one, found.speed)
        yield _stability_table(found.verdict, calm)
        if calm.real.max() > 0 and one.autopilot is None:
            yield f"Course-unstable in calm water, rudder amidships ({calm.real.max():+.3g} 1/s). {CALM_COURSE}"
    yield estimated_words(estimated(found), one.provenance)


def _motion_table(found: Examined) -> Table:
    from quartering.hydro.coefficients import coefficients

    one, wave, model, motion = found.ship, found.wave, found.model, found.motion
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
    import numpy as np

    from quartering.view.wording import CALM_WORDS, WITHOUT_WAVES, exponents_words

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
