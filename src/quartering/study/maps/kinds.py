"""What a study computes at each condition: three modes or six in regular waves, or irregular seas. Stores ask here alone."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering.hull.righting.arm import fitted_to
from quartering.loads.validity import warn_of_conditions, warn_outside_database
from quartering.motion.status import Status
from quartering.motion.steady.truncation import ENOUGH
from quartering.study import conditions, dataset
from quartering.study.condition.resonance import missed_resonance
from quartering.study.grid import CONDITION_AXES, STEEPNESS, Grid
from quartering.study.maps.query import MISSED
from quartering.study.seas.failure_rates import assessed, assessment_dataset
from quartering.study.seas.failure_rates.assessment_grid import AssessmentGrid
from quartering.study.seas.over_seas import conditions as sea_conditions
from quartering.study.seas.over_seas import guidance_dataset
from quartering.study.seas.over_seas.grid import SeaGrid
from quartering.study.six_modes.grid import STEADY_MOTION, SixGrid

Found = Mapping[str, NDArray[np.generic]]
Coordinates = Mapping[str, tuple[tuple[str, ...], NDArray[np.float64]]]


@dataclass(frozen=True)
class StudyKind:
    """One kind of study.

    Parameters
    ----------
    results : mapping            name of every result, and the shape it adds to that of the conditions
    flags : mapping              results that are small integers, and what stands where nothing is known
    of_points : tuple of str     results of a point, whatever the last axis
    dims : mapping               dimensions a result adds
    axes : tuple of str          in the order of a result, those that may stand for the last one at the end
    evaluate : callable          of a grid and the index of a block -> results
    others : callable            of results -> further counts by name
    attributes : callable        of the name of a variable -> its attributes
    heading : callable           of a grid -> attributes of the whole
    labelled : callable          of heading, results, coordinates and dims -> dataset
    warn : callable              of a grid and the counts of all its blocks
    missed : callable            of a grid -> parts of it that step over a resonance, in words
    code : tuple of str          source files that decide the numbers, beside the rooms of the physics
    """

    results: Mapping[str, tuple[int, ...]]
    flags: Mapping[str, int]
    of_points: tuple[str, ...]
    dims: Mapping[str, tuple[str, ...]]
    axes: tuple[str, ...]
    evaluate: Callable[[Any, int], dict[str, NDArray[np.generic]]]
    others: Callable[[Found], dict[str, int]]
    attributes: Callable[[str], dict[str, object]]
    heading: Callable[[Any], dict[str, object]]
    labelled: Callable[[Mapping[str, object], Mapping[str, Any], Coordinates, tuple[str, ...]], xr.Dataset]
    warn: Callable[[Any, Counter[str]], None]
    missed: Callable[[Any], tuple[str, ...]]
    code: tuple[str, ...]

    @property
    def size(self) -> int:
        """Bytes of one condition."""
        return sum(int(np.prod(extra)) * (1 if name in self.flags else 8) for name, extra in self.results.items())

    def dtype(self, name: str) -> Any:
        """Type of a result."""
        return np.int8 if name in self.flags else np.float64


def kind_of(grid: Grid) -> StudyKind:
    """Kind of a grid."""
    if isinstance(grid, AssessmentGrid):
        return ASSESSMENT
    if isinstance(grid, SixGrid):
        return SIX_MODES
    return SEAS if isinstance(grid, SeaGrid) else WAVES


def kind_of_case(case: Mapping[str, Any]) -> StudyKind:
    """Kind of what a store says of its case."""
    return {"seas": SEAS, "assessment": ASSESSMENT, "six modes": SIX_MODES}.get(str(case.get("kind")), WAVES)


def _waves_labelled(
    heading: Mapping[str, object], results: Mapping[str, Any], coordinates: Coordinates, dims: tuple[str, ...]
) -> xr.Dataset:
    return dataset.described(heading, results, coordinates, dims, CONDITION_AXES[:3])


def _waves_heading(grid: Grid) -> dict[str, object]:
    return dataset.heading_of(grid.ship, form=grid.form, harmonics=grid.harmonics)


def _beside_waves(found: Found) -> dict[str, int]:
    """Conditions that roll beyond the righting arm's fit, and those short of harmonics."""
    short = int((np.asarray(found[MISSED], dtype=float) > ENOUGH).sum()) if MISSED in found else 0
    return {"beyond": int(found["beyond"]), "more harmonics": short}


def _warn_of_waves(wanted: Grid, counts: Counter[str]) -> None:
    warn_of_conditions(wanted.ship, wanted.axes["speed"], wanted.axes["wave_length"])
    warn_outside_database(wanted.ship, counts[f"status {int(Status.OUTSIDE_DATABASE)}"], wanted.count)
    conditions.warn_outside_range(wanted.ship.name, counts["beyond"], fitted_to(wanted.ship))


_SHARED_CODE: Final = ("study/grid.py", "study/loadings.py", "study/case/values.py")

WAVES: Final = StudyKind(
    results=conditions.RESULTS,
    flags={name: int(value) for name, value in conditions.UNKNOWN.items()},
    of_points=("encounter_frequency",),
    dims=dataset.EXTRA_DIMS,
    axes=(*CONDITION_AXES, STEEPNESS),
    evaluate=conditions.evaluate_block,
    others=_beside_waves,
    attributes=dataset.attributes,
    heading=_waves_heading,
    labelled=_waves_labelled,
    warn=_warn_of_waves,
    missed=missed_resonance,
    code=("study/conditions.py", "study/condition/beside.py", "study/loading_systems.py", *_SHARED_CODE),
)


def _six_block(grid: SixGrid, index: int) -> dict[str, NDArray[np.generic]]:
    from quartering.study.six_modes.conditions import evaluate_six_block

    return evaluate_six_block(grid, index)


def _six_heading(grid: SixGrid) -> dict[str, object]:
    return _waves_heading(grid) | {"steady_motion": STEADY_MOTION, "modes": "six"}


def _warn_of_six(grid: SixGrid, _counts: Counter[str]) -> None:
    from quartering.study.six_modes.conditions import warn_of_six

    every = slice(0, grid.point_count)
    warn_of_six(grid.ship, *grid.points(every), grid.heights(every).max(axis=1))


SIX_MODES: Final = replace(
    WAVES,
    evaluate=_six_block,
    others=lambda _: {},
    heading=_six_heading,
    warn=_warn_of_six,
    missed=lambda _: (),
    code=("study/six_modes", "study/conditions.py", *_SHARED_CODE),
)
_SEA_CODE: Final = (
    "study/seas",
    "study/criteria/constants.py",
    "study/dataset.py",
    "study/conditions.py",
    "study/condition/beside.py",
    "study/loading_systems.py",
    *_SHARED_CODE,
)
SEAS: Final = StudyKind(
    results=sea_conditions.RESULTS,
    flags={name: int(value) for name, value in sea_conditions.UNKNOWN.items()},
    of_points=(),
    dims={},
    axes=("speed", "heading", "tz", "tp", "hs"),
    evaluate=sea_conditions.evaluate_sea_block,
    others=lambda _: {},
    attributes=guidance_dataset.attributes,
    heading=guidance_dataset.heading_of,
    labelled=guidance_dataset.labelled,
    warn=sea_conditions.warn_of_seas,
    missed=lambda _: (),
    code=_SEA_CODE,
)
ASSESSMENT: Final = StudyKind(
    results=assessed.RESULTS,
    flags={name: int(value) for name, value in assessed.UNKNOWN.items()},
    of_points=(),
    dims={},
    axes=("speed", "heading", "tz", "hs"),
    evaluate=assessed.evaluate_assessment_block,
    others=assessed.often_lost,
    attributes=assessment_dataset.attributes,
    heading=assessment_dataset.heading_of,
    labelled=assessment_dataset.labelled,
    warn=assessed.warn_of_lost,
    missed=lambda _: (),
    code=_SEA_CODE,
)
