"""Maps over seas as one labelled dataset: operational guidance with units, meanings, and where its thresholds come from."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering.conventions import HEADING_CONVENTION, REFERENCE_POINT
from quartering.loads.forces import form_words
from quartering.loads.sea.sea import spectrum_words
from quartering.motion.sea.equations import free_roll_of
from quartering.study import dataset
from quartering.study.criteria.constants import constant
from quartering.study.seas.dataset import MEANINGS, pile_up_lines
from quartering.study.seas.over_seas.advice import CLOSURE_OVER, RATE_OPEN, Advice
from quartering.study.seas.over_seas.conditions import RESULTS, RUNGS
from quartering.study.seas.over_seas.grid import SeaGrid
from quartering.study.seas.over_seas.map_axes import dims_of
from quartering.study.seas.over_seas.settings import mean_periods, period_ratio
from quartering.study.seas.response import SeaStatus
from quartering.study.seas.simulated.asked import felt_limit_of, roll_limit_of

_FLAGS: Final[Mapping[str, Mapping[int, str]]] = {
    "status": {int(one): one.name.lower() for one in SeaStatus},
    "recommended": {int(one): one.name.lower() for one in Advice},
    "rung": RUNGS,
}
_ENDS: Final = "its interval, inside which the true mean lies as far as is known"
_OWN: Final[Mapping[str, tuple[str, str]]] = {
    "roll_mean_3h_max": ("deg", "mean largest |roll| of 3 h"),
    "roll_3h_max_lower": ("deg", f"lower end of {_ENDS}"),
    "roll_3h_max_upper": ("deg", f"upper end of {_ENDS}"),
    "lateral_acceleration_3h_max": (
        "m s-2",
        "mean largest lateral acceleration of 3 h, gravity of the heeled deck in it",
    ),
    "lateral_acceleration_3h_max_lower": ("m s-2", f"lower end of {_ENDS}"),
    "lateral_acceleration_3h_max_upper": ("m s-2", f"upper end of {_ENDS}"),
    "failures": ("1", "failures simulated, by roll or by lateral acceleration; NaN where not simulated"),
    "exposure": ("h", "time simulated until failure or end, run-up left out; NaN where not simulated"),
    "failure_rate": ("s-1", "rate of failures: counted, or of a Gaussian motion with every swing counted"),
    "rate_lower": ("s-1", "lower end of its 95 % interval, or a hundredth of a Gaussian rate"),
    "rate_upper": ("s-1", "upper end of its 95 % interval, or a hundred times a Gaussian rate"),
    "exponent": ("s-1", "largest growth rate of the mean Jacobian; below 0 the motion is steady on average"),
    "status": ("1", "whether the closure has an answer"),
    "rung": ("1", "how the condition was answered"),
    "recommended": ("1", "what guidance says; undecided where an interval straddles its limit"),
    "speed": ("m s-1", "forward speed"),
    "heading": ("deg", f"heading the sea goes to: {HEADING_CONVENTION}"),
    "hs": ("m", "significant wave height"),
    "tz": ("s", "mean zero-crossing period"),
    "tp": ("s", "period of the peak"),
}


def attributes(name: str) -> dict[str, object]:
    """Unit and meaning of a variable, and the meaning of its flags.

    >>> attributes("recommended")["flag_meanings"]
    'recommended not_recommended undecided not_valid'
    """
    if name not in _OWN and name not in MEANINGS:
        return dataset.attributes(name)  # of a loading
    unit, meaning = _OWN[name] if name in _OWN else MEANINGS[name][:2]
    known: dict[str, object] = {"units": unit, "long_name": meaning}
    if name in _FLAGS:
        known["flag_values"] = np.array(list(_FLAGS[name]), dtype=np.int8)
        known["flag_meanings"] = " ".join(_FLAGS[name].values())
    return known


def labelled(
    heading: Mapping[str, object],
    results: Mapping[str, Any],
    coordinates: Mapping[str, tuple[tuple[str, ...], NDArray[np.float64]]],
    dims: tuple[str, ...],
) -> xr.Dataset:
    """Dataset of a map over seas, in the order of `DIMS`; a single loading is one too."""
    data = {name: xr.Variable(dims, results[name], attributes(name)) for name in RESULTS}
    coords = {name: xr.Variable(where, values, attributes(name)) for name, (where, values) in coordinates.items()}
    coords |= other_period(heading, coordinates)
    speeds = pile_up_lines(float(heading["roll_frequency"]), 1.0)["pile_up"]  # type: ignore[arg-type]
    made = xr.Dataset(data | {"pile_up": speeds}, coords | {"line": ["synchronous", "parametric"]}, dict(heading))
    if "loading" not in made.dims:
        made = xr.merge([made[[n for n in made if n not in RESULTS]], made[list(RESULTS)].expand_dims("loading")])
        made.attrs = dict(heading)
    return made.transpose(*dims_of(made), ...)


def other_period(
    heading: Mapping[str, object], coordinates: Mapping[str, tuple[tuple[str, ...], NDArray[np.float64]]]
) -> dict[str, xr.Variable]:
    """Of the two periods of a sea that which is no axis: tp along tz, or tz over height and tp."""
    spectrum, gamma = str(heading["spectrum"]), float(heading["gamma"])  # type: ignore[arg-type]
    if "tz" in coordinates:
        peaks = coordinates["tz"][1] / period_ratio(spectrum, gamma)
        return {"tp": xr.Variable(("tz",), peaks, attributes("tp"))}
    mean = mean_periods(spectrum, gamma, coordinates["hs"][1], coordinates["tp"][1])
    return {"tz": xr.Variable(("hs", "tp"), mean, attributes("tz"))}


def heading_of(grid: SeaGrid) -> dict[str, object]:
    """Attributes of the whole: ship, sea, what it is judged by, and how sure that is."""
    ship = grid.ship
    roll, why = roll_limit_of(ship, None)
    felt = felt_limit_of(ship, None, None)
    spreading = "long-crested" if grid.spreading is None else f"spreading {_spreading(grid)}"
    peak = f" gamma {grid.gamma:.3g}" if grid.spectrum == "jonswap" else ""
    own = dataset.heading_of(ship, form=grid.form, harmonics=1)
    kept = ("ship", "ship_length", "ship_beam", "ship_draught", "loading", "autopilot", "righting_curve", "provenance")
    return {
        "title": f"Operational guidance for {ship.name} in irregular seas",
        **{name: own[name] for name in (*kept, "estimated_coefficients", "estimated_by", "Conventions", "source")},
        "sea": f"{spectrum_words(grid.spectrum)}{peak}, {spreading}{_swell(grid)}",
        "spectrum": grid.spectrum,
        "gamma": grid.gamma,
        "spreading": "none" if grid.spreading is None else _spreading(grid).removeprefix("s "),
        "sides": "differ" if grid.one_sided else "mirror each other",
        "judge": grid.judge,
        "threshold": grid.threshold,
        "threshold_words": _threshold_words(grid),
        "threshold_source": _source(grid),
        "roll_limit": math.degrees(roll),
        "roll_limit_reason": why,
        "acceleration_limit": felt if math.isfinite(felt) else "none: no highest position is known",
        "hours": grid.hours,
        "seed": grid.seed,
        "roll_frequency": free_roll_of(ship, 0.0)[0],
        "interval_of_closure": f"largest of 3 h from Vanmarcke's mean over {CLOSURE_OVER:g} to Rice's; rate by a factor of"
        f" {RATE_OPEN:g} either way",
        "diffraction": form_words(ship, grid.form),
        "heading_convention": HEADING_CONVENTION,
        "reference_point": REFERENCE_POINT,
        "references": "H71, STF70, Kazakov54, Vanmarcke75, Rice44, Tucker84",
    }


def _spreading(grid: SeaGrid) -> str:
    return "cos2" if grid.spreading == "cos2" else f"s {grid.spreading:g}"


def _swell(grid: SeaGrid) -> str:
    """The swell beside each sea, in words."""
    if grid.swell is None:
        return ""
    return f"; beside it a swell of {grid.swell.words}, {grid.swell.heading:g} deg off"


def _threshold_words(grid: SeaGrid) -> str:
    if grid.judge == "rate":
        return f"not recommended where the rate of failures is above {grid.threshold:.3g} 1/s"
    return f"not recommended where {grid.threshold:.3g} times the mean largest motion of 3 h is beyond the limit of a failure"


def _source(grid: SeaGrid) -> str:
    one = constant(f"operational_guidance.{'safety_factor' if grid.judge == 'largest' else 'failure_rate'}")
    own = "" if grid.threshold == one.value else f"given; that of the circular is {one.value:g}, "
    return f"{own}MSC.1/Circ.1627, {one.place}: {one.status}"
