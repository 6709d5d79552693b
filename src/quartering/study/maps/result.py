"""A stored sweep as one labelled dataset whose numbers are read when they are used."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from xarray.backends import BackendArray
from xarray.core import indexing

from quartering.conventions import InputError
from quartering.study.grid import STEEPNESS, Grid
from quartering.study.maps.kinds import StudyKind, kind_of, kind_of_case
from quartering.study.maps.stored.store import Store, read_block, read_store


def open_result(folder: str | Path, *, partial: bool = False) -> xr.Dataset:
    """The dataset a sweep has stored in a folder.

    partial: take a sweep that is not complete: conditions not yet computed are NaN, without a verdict
    Returns as `sweep` returns it in memory; each variable is read from the disk where it is used, and only the blocks
        that hold the part wanted

    No file stays open.  Source: the blocks written by `sweep`.
    """
    store = read_store(folder)
    missing = set(store.missing())
    if missing and not partial:
        raise InputError(
            f'"{folder}" is not complete: {len(missing)} of {store.count} blocks are missing or damaged; run the same sweep'
            " again, only those are computed (or open it with partial=True)"
        )
    case = store.content["case"]
    kind = kind_of_case(case)
    axes = {name: np.array(case[name], dtype=float) for name in kind.axes if name in case}
    loadings = {name: np.array(values, dtype=float) for name, values in case["loadings"].items()}
    shape = tuple(values.size for values in axes.values())
    several = next(iter(loadings.values())).size if loadings else 0
    results: dict[str, Any] = {
        name: _lazy(store, name, kind, several, (*shape, *extra), missing) for name, extra in kind.results.items()
    }
    results |= {name: _of_points(store, name, shape[:3], missing) for name in kind.of_points}
    return kind.labelled(store.content["attributes"], results, *coordinates_of(axes, loadings))


def in_memory(
    grid: Grid, found: Mapping[int, Mapping[str, NDArray[np.generic]]], heading: Mapping[str, object]
) -> xr.Dataset:
    """The dataset of a grid whose blocks are all at hand.

    found: results of each block, by index
    heading: attributes of the whole
    """
    kind = kind_of(grid)
    loadings, points, shape = grid.loading_count, grid.point_count, grid.shape[-4:]
    results: dict[str, NDArray[np.generic]] = {}
    for name, extra in kind.results.items():
        whole = np.empty((loadings, points, shape[3], *extra), kind.dtype(name))
        for i, block in enumerate(grid.blocks):
            whole[block.loadings, block.points] = found[i][name]
        results[name] = whole.reshape(*grid.shape, *extra)
    for name in kind.of_points:
        values = np.empty(points)
        for i, block in enumerate(grid.blocks):
            values[block.points] = found[i][name]
        results[name] = values.reshape(shape[:3])
    return kind.labelled(heading, results, *coordinates_of(grid.axes, grid.loadings))


def coordinates_of(
    axes: Mapping[str, NDArray[np.float64]], loadings: Mapping[str, NDArray[np.float64]]
) -> tuple[dict[str, tuple[tuple[str, ...], NDArray[np.float64]]], tuple[str, ...]]:
    """Coordinates and dimensions of a result.

    axes: of the conditions; with a steepness, wave_height goes along wave length and steepness
    loadings: columns by name, empty for one loading

    >>> coordinates_of({"speed": np.ones(2), "heading": np.ones(3)}, {"gm": np.ones(4)})[1]
    ('loading', 'speed', 'heading')
    """
    coordinates: dict[str, tuple[tuple[str, ...], NDArray[np.float64]]]
    coordinates = {name: ((name,), values) for name, values in axes.items()}
    if STEEPNESS in axes:
        coordinates["wave_height"] = (("wave_length", STEEPNESS), np.outer(axes["wave_length"], axes[STEEPNESS]))
    coordinates |= {name: (("loading",), column) for name, column in loadings.items()}
    return coordinates, (("loading",) if loadings else ()) + tuple(axes)


def _lazy(store: Store, name: str, kind: StudyKind, loadings: int, shape: tuple[int, ...], missing: set[int]) -> Any:
    whole = shape if loadings == 0 else (loadings, *shape)
    return indexing.LazilyIndexedArray(_Blocks(store, name, kind, whole, loadings > 0, missing))


def _of_points(store: Store, name: str, shape: tuple[int, ...], missing: set[int]) -> NDArray[np.float64]:
    """A result of all points; that of missing blocks is NaN."""
    values = np.full(int(np.prod(shape)), np.nan)
    done: set[tuple[int, int]] = set()
    for i, (_, _, start, stop) in enumerate(store.content["blocks"]):
        if i not in missing and (start, stop) not in done:
            values[start:stop] = read_block(store, i, name)
            done.add((start, stop))
    return values.reshape(shape)


class _Blocks(BackendArray):
    """One variable over all blocks of a store, read when it is indexed."""

    def __init__(
        self, store: Store, name: str, kind: StudyKind, shape: tuple[int, ...], with_loading: bool, missing: set[int]
    ) -> None:
        self.unknown = kind.flags.get(name, np.nan)
        self.store, self.name, self.with_loading, self.missing = store, name, with_loading, missing
        self.shape = shape
        self.dtype = np.dtype(kind.dtype(name))

    def __getitem__(self, key: Any) -> Any:
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.OUTER, self._read)

    def _read(self, key: tuple[Any, ...]) -> NDArray[np.generic]:
        """The part wanted, by an index, slice or list for each dimension."""
        wanted = [np.atleast_1d(np.arange(n)[k]) for k, n in zip(key, self.shape, strict=True)]
        dropped = tuple(i for i, k in enumerate(key) if isinstance(k, (int, np.integer)))
        loadings = wanted[0] if self.with_loading else np.zeros(1, dtype=int)
        u, mu, length, *rest = wanted[1:] if self.with_loading else wanted
        sizes = self.shape[1:4] if self.with_loading else self.shape[:3]
        points = np.ravel_multi_index(np.ix_(u, mu, length), sizes).ravel()
        out = np.full((loadings.size, points.size, *(r.size for r in rest)), self.unknown, self.dtype)
        for i, (l0, l1, p0, p1) in enumerate(self.store.content["blocks"]):
            inside = np.flatnonzero((loadings >= l0) & (loadings < l1)), np.flatnonzero((points >= p0) & (points < p1))
            if i in self.missing or not (inside[0].size and inside[1].size):
                continue
            block = read_block(self.store, i, self.name)
            out[np.ix_(*inside)] = block[np.ix_(loadings[inside[0]] - l0, points[inside[1]] - p0, *rest)]
        whole = out.reshape([w.size for w in wanted])
        return whole.reshape([n for i, n in enumerate(whole.shape) if i not in dropped])
