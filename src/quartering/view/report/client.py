"""The first page of a report: where this loading rolls furthest and fails first, and what a step it can make changes there."""

from __future__ import annotations

import math
import warnings
from typing import NamedTuple

import numpy as np

from quartering.conventions import RangeWarning
from quartering.hydro.calm_water import calm_water_exponents
from quartering.hydro.capsize import vanishing_of_equations
from quartering.loads.waves import Wave
from quartering.study.condition.examine import Examined, examine
from quartering.study.condition.failure_events import failure_angle
from quartering.study.condition.first_failure import STEEPNESSES, FirstFailure, first_failure
from quartering.study.effects.loading_steps import Step, loading_steps
from quartering.study.loadings import loaded
from quartering.study.maps.query import OF_CONDITIONS
from quartering.view.report.conditions import Condition
from quartering.view.report.source import Source
from quartering.view.report.tables import Row, Table
from quartering.view.wording import CALM_COURSE, speed_words

_EVERY = 2
"""Of headings and wave lengths of a map every second one is searched for the first failure."""
_NEUTRAL = 1e-9


class Place(NamedTuple):
    """A condition of the first page: why it stands there, where it is, what is said of it, and the steps."""

    why: str
    where: str
    sentence: str
    steps: Table


class Short(NamedTuple):
    """The first page.

    Parameters
    ----------
    places : list of Place      at the largest roll, and at the first failure where there is one
    failure : str               when it fails first, in words
    course : str                course stability in calm water, once
    limit : float               roll of a failure event [deg]
    """

    places: list[Place]
    failure: str
    course: str
    limit: float


def first_page(source: Source, worst: Condition) -> Short:
    """What the client asks of a result.

    worst: the condition of the largest roll
    """
    one = loaded(source.ship, {n: value for n, value in worst.place.items() if n not in OF_CONDITIONS})
    limit = failure_angle(vanishing_of_equations(one), one.value("openings"))
    result = source.result
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)  # the page counts what is out of range by itself
        failed = first_failure(
            one, np.unique(result["speed"].values), np.unique(result["heading"].values)[::_EVERY],
            np.unique(result["wave_length"].values)[::-_EVERY], limit, harmonics=source.harmonics, form=source.form,
        )  # fmt: skip
        places = [_place("Largest roll of the map", _examined(source, one, worst.place), limit)]
        if failed is not None:
            places.append(_place("First failure", _examined(source, one, failed._asdict()), limit))
    return Short(places, _failure_words(failed, limit), _course(source), limit)


def _examined(source: Source, one: object, place: dict[str, float]) -> Examined:
    wave = Wave(place["wave_length"], place["wave_height"])
    return examine(one, wave, place["speed"], place["heading"], source.harmonics, source.form)  # type: ignore[arg-type]


def _place(why: str, found: Examined, limit: float) -> Place:
    """A condition with its steps."""
    length = found.ship.hull.length
    where = (
        f"heading {found.heading:g} deg, {speed_words(found.speed, length)}, wave {found.wave.length:.4g} x "
        f"{found.wave.height:.3g} m (λ/L {found.wave.length / length:.3g}, H/λ 1/{found.wave.length / found.wave.height:.3g})"
    )
    sentence = " ".join([found.verdict.sentence, *found.beside.sentences])
    rows = [Row(_step_cells(step, limit)) for step in loading_steps(found)]
    return Place(why, where, sentence, Table(_COLUMNS, rows, (1, 2)))


_COLUMNS = ("change", "largest roll [deg]", "largest exponent [1/s]", "verdict", "also stable [deg]")


def _step_cells(step: Step, limit: float) -> tuple[str, ...]:
    """A line of the steps."""
    found = step.found
    if found is None:
        return step.words, "", "", f"not possible: {step.reason}", ""
    if not found.motion.status.ok:
        return step.words, "no answer", "", found.motion.status.advice, ""
    also = ", ".join(f"{roll:.3g}" for roll in found.beside.others) or "none"
    roll = math.degrees(found.motion.peak[1])
    kind = "stable" if found.verdict.stable else f"unstable: {found.verdict.kind}"
    if found.beside.capsizes:
        kind = "fails: capsizes on the way"
    elif roll > limit:
        kind = f"fails: roll beyond {limit:.3g} deg"
    return (
        step.words,
        f"{roll:.1f}",
        f"{found.verdict.exponents[0].real:+.4f}",
        kind,
        also if found.verdict.stable else "not looked for",
    )


def _failure_words(failed: FirstFailure | None, limit: float) -> str:
    """When the ship fails first, in words."""
    event = f"roll beyond {limit:.3g} deg, a capsize at the motion or on the way to it, or an unstable motion"
    if failed is None:
        steepest = f"H/λ = 1/{1 / STEEPNESSES[-1]:.3g}"
        return f"No failure ({event}) at speeds, headings and wave lengths of the map in waves up to {steepest}."
    what = "an unstable motion" if failed.unstable else "a failure event"
    return (
        f"As all waves grow steeper together, {what} comes first at H/λ = 1/{1 / failed.steepness:.3g}, in {failed.failing} of "
        f"{failed.conditions} conditions ({event})."
    )


def _course(source: Source) -> str:
    """Course stability in calm water, said once."""
    one = source.ship
    speeds = np.unique(source.result["speed"].values)
    growing = [float(u) for u in speeds if calm_water_exponents(one, float(u)).real.max() > _NEUTRAL]
    if one.autopilot is not None:
        return "Course in calm water: held by the autopilot."
    if not growing:
        return "Course in calm water, rudder amidships: stable at every speed of the map."
    several = ", ".join(f"{u:.3g}" for u in growing)
    which = "at every speed of the map" if len(growing) == speeds.size else f"at {several} m/s"
    return f"Course in calm water, rudder amidships: unstable {which}. {CALM_COURSE}"
