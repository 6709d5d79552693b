"""The file of one block of results: netCDF, with the coordinates of its conditions and what it counts."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from quartering._machine.digest import fingerprint
from quartering.study.grid import Block, Grid
from quartering.study.maps.kinds import StudyKind, kind_of
from quartering.study.maps.stored.seal import sealed

Arrays = Mapping[str, NDArray[np.generic]]


def block_file(index: int, found: Arrays, grid: Grid, counts: Mapping[str, int]) -> bytes:
    """Content of a block's file: netCDF, 64-bit offsets, with the coordinates of its conditions, and its seal.

    index: of the block in the grid
    found: from `evaluate_block`
    counts: from `counted`, kept with the block
    """
    from scipy.io import netcdf_file

    block, kind = grid.blocks[index], kind_of(grid)
    points = grid.points(block.points)
    buffer = io.BytesIO()
    file: Any = netcdf_file(buffer, "w", version=2)
    file.counts = json.dumps(counts)
    file.Conventions = "CF-1.8"
    sizes = {"loading": block.loadings.stop - block.loadings.start, "point": points[0].size}
    sizes[grid.sea] = grid.sea_count
    for name, extra in kind.dims.items():
        sizes[extra[0]] = kind.results[name][0]
    for name, size in sizes.items():
        file.createDimension(name, size)
    for name, values in zip(grid.point_axes, points, strict=True):
        _variable(file, kind, name, ("point",), values)
    _variable(file, kind, grid.sea, (grid.sea,), grid.axes[grid.sea])
    for name, column in grid.loadings.items():
        _variable(file, kind, name, ("loading",), column[block.loadings])
    for name in kind.results:
        _variable(file, kind, name, ("loading", "point", grid.sea, *kind.dims.get(name, ())), found[name])
    for name in kind.of_points:
        _variable(file, kind, name, ("point",), found[name])
    file.flush()
    data = buffer.getvalue()
    held = {name: np.array(one.data) for name, one in file.variables.items()}
    file.close()
    return sealed(data, held, {"counts": dict(counts), **belongs(fingerprint(grid.described), part_of(block))})


def part_of(block: Block) -> list[int]:
    """The part of a grid that a block is: first and last loading, first and last point."""
    return [block.loadings.start, block.loadings.stop, block.points.start, block.points.stop]


def belongs(case: str, part: list[int]) -> dict[str, Any]:
    """What a block's seal says about where it belongs: no block of another case or place is taken for it."""
    return {"case": case, "part": part}


def _variable(file: Any, kind: StudyKind, name: str, dims: tuple[str, ...], values: NDArray[np.generic]) -> None:
    """One variable with its unit and meaning."""
    made = file.createVariable(name, "i1" if values.dtype == np.int8 else "f8", dims)
    made[:] = values
    for key, value in kind.attributes(name).items():
        if value != "" if isinstance(value, str) else True:
            setattr(made, key, value)


def counted(found: Arrays, kind: StudyKind) -> dict[str, int]:
    """Numbers of conditions by the values of their flags, and what the kind of study counts beside them.

    Returns "verdict 0": .., "status 0": .., "beyond": .., "more harmonics": ..; zeros left out
    """
    counts: dict[str, int] = {}
    for name in kind.flags:
        values, numbers = np.unique(found[name], return_counts=True)
        counts |= {f"{name} {value}": int(number) for value, number in zip(values, numbers, strict=True)}
    return counts | {name: number for name, number in kind.others(found).items() if number}
