"""The largest roll of a map on its edge: on which one, and the map carried on past it until the largest stands inside."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.options import OPTIONS

if TYPE_CHECKING:
    import xarray as xr

Floats = NDArray[np.float64]
AXES: Final = ("speed", "heading", "wave_length")
MOST_STEPS: Final = 8
"""Times a map is carried on past its edges, by `AT_ONCE` values of an axis each: then it says that the edge still holds it."""
AT_ONCE: Final = 3


class Edge(NamedTuple):
    """An edge of a map that the largest roll stands on.

    Parameters
    ----------
    axis : str      "speed", "heading" or "wave_length"
    value : float   on it [m/s, deg, m]
    roll : float    the largest roll over a cycle [deg]
    """

    axis: str
    value: float
    roll: float


def edges_of_largest(result: xr.Dataset) -> list[Edge]:
    """Edges of a result that its largest roll stands on, beyond which there are conditions.

    Parameters
    ----------
    result : xarray.Dataset    of `polar` or `sweep`

    Returns
    -------
    list of Edge               empty where the largest stands inside; an axis of one value has no edge, nor have heading 0 and
                               180, whose other side is the mirror image, headings all round, and speed 0

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> from quartering.study.maps.sweep import sweep
    >>> [edge.axis for edge in edges_of_largest(sweep(ship("wigley"), [4.0, 5.0], [80.0, 90.0, 100.0], 100.0, 1.0))]
    ['speed', 'heading']
    """
    roll = result["roll_peak"]
    values = roll.values
    if not np.isfinite(values).any():
        return []
    at = dict(zip(roll.dims, np.unravel_index(int(np.nanargmax(values)), values.shape), strict=True))
    found = []
    for axis in AXES:
        if axis not in at or roll.sizes[axis] < 2:
            continue
        along = result[axis].values
        value = float(along[at[axis]])
        if value in (along.min(), along.max()) and not _natural(axis, value, along):
            found.append(Edge(axis, value, float(np.nanmax(values))))
    return found


def _natural(axis: str, value: float, along: Floats) -> bool:
    """Is there nothing new beyond this end of an axis?"""
    if axis == "heading":
        return value % 180.0 == 0.0 or float(np.ptp(along)) + float(np.diff(np.sort(along)).max()) >= 360.0
    return axis == "speed" and value == 0.0


def carried_on(
    result: xr.Dataset, further: Callable[[Mapping[str, Floats]], xr.Dataset], most: int | None = None
) -> xr.Dataset:
    """A map with values added to its axes until its largest roll stands inside, or nothing can be added.

    result: of `polar`
    further: the map of other axes: speed [m/s], heading [deg], wave_length [m]
    most: conditions that it may have in the end
    Returns values added in steps of the last interval, `AT_ONCE` at a time and at most `MOST_STEPS` times, within the
        ranges of the options
    """
    for _ in range(MOST_STEPS):
        grown = result
        for edge in edges_of_largest(result):
            more = beyond(grown[edge.axis].values, edge)
            cells = more.size * grown["verdict"].size // grown.sizes[edge.axis]
            if more.size and (most is None or grown["verdict"].size + cells <= most):
                axes = {name: grown[name].values for name in AXES} | {edge.axis: more}
                grown = _joined(grown, further(axes), edge.axis)
        if grown is result:
            break
        result = grown
    return result


def beyond(along: Floats, edge: Edge) -> Floats:
    """Up to `AT_ONCE` values past an end of an axis, in steps of its last interval, within the range of the option."""
    values = np.sort(along)
    step = values[-1] - values[-2] if edge.value == values[-1] else values[0] - values[1]
    one = OPTIONS[edge.axis]
    low, high = (bound if isinstance(bound, (int, float)) else None for bound in (one.low, one.high))
    if edge.axis == "heading":
        low, high = (0.0, 180.0) if values[0] >= 0.0 and values[-1] <= 180.0 else (None, None)
    made = edge.value + step * np.arange(1, AT_ONCE + 1)
    if low is not None and edge.axis != "wave_length":
        made = np.maximum(made, low)
    made = np.minimum(made, high) if high is not None else made
    return np.setdiff1d(made[made > 0] if edge.axis == "wave_length" else made, values)


def _joined(one: xr.Dataset, other: xr.Dataset, axis: str) -> xr.Dataset:
    import xarray as xr

    return xr.concat(
        [one, other], dim=axis, data_vars="all", coords="minimal", compat="override", combine_attrs="override"
    ).sortby(axis)
