"""What stands out in a map at one speed: where roll is largest and the motion least stable, and how many cells are what."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import numpy as np
    import xarray as xr

    from quartering.hull.ship import Ship


class Summary(NamedTuple):
    """What stands out at one speed: where roll is largest over a cycle, and where the motion is least stable but for the course
    in calm water; NaN without any answer."""

    speed: float
    worst_roll: float
    heading: float
    wave_length: float
    least_stable: float
    least_stable_heading: float
    least_stable_wave_length: float
    verdicts: dict[str, int]
    no_answer: dict[str, int]
    calm_water: np.ndarray
    capsize_on_the_way: int
    more_harmonics: int
    several_stable: int
    unstable_share: float
    cells: int


def summary_of(one: Ship, ds: xr.Dataset) -> Summary:
    """What stands out in a map of one speed."""
    import numpy as np

    from quartering.hydro.calm_water import calm_water_exponents
    from quartering.motion.status import Status
    from quartering.stability.kind import Kind
    from quartering.study.maps.query import capsizing, coexisting, needing_more

    kinds, counts = np.unique(ds["verdict"].values, return_counts=True)
    statuses, failures = np.unique(ds["status"].values, return_counts=True)
    return Summary(
        float(ds["speed"]),
        *_largest(ds["roll_peak"]),
        *_largest(ds["exponent"].where(ds["verdict"] != int(Kind.COURSE_IN_CALM_WATER))),
        {Kind(int(k)).label: int(n) for k, n in zip(kinds, counts, strict=True)},
        {Status(int(s)).name.lower(): int(n) for s, n in zip(statuses, failures, strict=True) if not Status(int(s)).ok},
        calm_water_exponents(one, float(ds["speed"])),
        int(capsizing(ds).sum()),
        int(needing_more(ds).sum()),
        int(coexisting(ds).sum()),
        float(((ds["verdict"] > int(Kind.STABLE)) & (ds["verdict"] != int(Kind.COURSE_IN_CALM_WATER))).mean()),
        int(ds["verdict"].size),
    )


def _largest(field: xr.DataArray) -> tuple[float, float, float]:
    """Largest value of a map at one speed, and the heading and wave length it stands at; NaN where there is no answer."""
    import numpy as np

    if not np.isfinite(field).any():
        return math.nan, math.nan, math.nan
    i, j = np.unravel_index(int(np.nanargmax(field.values)), field.shape)
    cell = field[i, j]
    return float(cell), float(cell["heading"]), float(cell["wave_length"])


def place_words(value: str, heading: float, ratio: float) -> str:
    """A largest value and where it is, in words."""
    return f"{value} at {heading:g} deg, lambda/L {ratio:.3g}" if math.isfinite(heading) else "no answer"
