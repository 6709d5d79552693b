"""The file of one block of results: netCDF, with the coordinates of its conditions and what it counts."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from quartering._machine.digest import fingerprint
from quartering.study.grid import Block, Grid
from quartering.study.maps.kinds import StudyKind, kind_of
from quartering.study.maps.stored.classic_file import Held, classic_file
from quartering.study.maps.stored.seal import sealed

Arrays = Mapping[str, NDArray[np.generic]]


def block_file(index: int, found: Arrays, grid: Grid, counts: Mapping[str, int]) -> bytes:
    """Content of a block's file: netCDF, 64-bit offsets, with the coordinates of its conditions, and its seal.

    index: of the block in the grid
    found: from `evaluate_block`
    counts: from `counted`, kept with the block
    """
    block, kind = grid.blocks[index], kind_of(grid)
    points = grid.points(block.points)
    sizes = {"loading": block.loadings.stop - block.loadings.start, "point": points[0].size}
    sizes[grid.sea] = grid.sea_count
    for name, extra in kind.dims.items():
        sizes[extra[0]] = kind.results[name][0]
    coordinates = {name: (("point",), values) for name, values in zip(grid.point_axes, points, strict=True)}
    coordinates[grid.sea] = ((grid.sea,), grid.axes[grid.sea])
    coordinates |= {name: (("loading",), column[block.loadings]) for name, column in grid.loadings.items()}
    results = {name: (("loading", "point", grid.sea, *kind.dims.get(name, ())), found[name]) for name in kind.results}
    results |= {name: (("point",), found[name]) for name in kind.of_points}
    held = {name: Held(dims, values, kind.attributes(name)) for name, (dims, values) in (coordinates | results).items()}
    made = classic_file(sizes, {"counts": json.dumps(counts), "Conventions": "CF-1.8"}, held)
    return sealed(made, {"counts": dict(counts), **belongs(fingerprint(grid.described), part_of(block))})


def part_of(block: Block) -> list[int]:
    """The part of a grid that a block is: first and last loading, first and last point."""
    return [block.loadings.start, block.loadings.stop, block.points.start, block.points.stop]


def belongs(case: str, part: list[int]) -> dict[str, Any]:
    """What a block's seal says about where it belongs: no block of another case or place is taken for it."""
    return {"case": case, "part": part}


def counted(found: Arrays, kind: StudyKind) -> dict[str, int]:
    """Numbers of conditions by the values of their flags, and what the kind of study counts beside them.

    Returns "verdict 0": .., "status 0": .., "beyond": .., "more harmonics": ..; zeros left out
    """
    counts: dict[str, int] = {}
    for name in kind.flags:
        numbers = np.bincount(
            found[name].ravel().astype(np.int64) + 128, minlength=256
        )  # of the 256 that a byte can be
        counts |= {f"{name} {value - 128}": int(numbers[value]) for value in np.flatnonzero(numbers)}
    return counts | {name: number for name, number in kind.others(found).items() if number}
