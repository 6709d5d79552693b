"""The file of one block of results: netCDF, with the coordinates of its conditions and what it counts."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.io import netcdf_file

from quartering._machine.digest import fingerprint
from quartering.motion.steady.truncation import ENOUGH
from quartering.study.conditions import FLAGS, RESULTS
from quartering.study.dataset import EXTRA_DIMS, attributes
from quartering.study.grid import Block, Grid
from quartering.study.maps.query import MISSED
from quartering.study.maps.seal import sealed

Arrays = Mapping[str, NDArray[np.generic]]


def block_file(index: int, found: Arrays, grid: Grid, counts: Mapping[str, int]) -> bytes:
    """Content of a block's file: netCDF, 64-bit offsets, with the coordinates of its conditions, and its seal.

    index: of the block in the grid
    found: from `evaluate_block`
    counts: from `counted`, kept with the block
    """
    block = grid.blocks[index]
    u, mu, length = grid.points(block.points)
    buffer = io.BytesIO()
    file: Any = netcdf_file(buffer, "w", version=2)
    file.counts = json.dumps(counts)
    file.Conventions = "CF-1.8"
    sizes = {"loading": block.loadings.stop - block.loadings.start, "point": u.size}
    sizes[grid.sea] = grid.sea_count
    for name, extra in EXTRA_DIMS.items():
        sizes[extra[0]] = RESULTS[name][0]
    for name, size in sizes.items():
        file.createDimension(name, size)
    for name, values in {"speed": u, "heading": mu, "wave_length": length}.items():
        _variable(file, name, ("point",), values)
    _variable(file, grid.sea, (grid.sea,), grid.axes[grid.sea])
    for name, column in grid.loadings.items():
        _variable(file, name, ("loading",), column[block.loadings])
    for name in RESULTS:
        _variable(file, name, ("loading", "point", grid.sea, *EXTRA_DIMS.get(name, ())), found[name])
    _variable(file, "encounter_frequency", ("point",), found["encounter_frequency"])
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


def _variable(file: Any, name: str, dims: tuple[str, ...], values: NDArray[np.generic]) -> None:
    """One variable with its unit and meaning."""
    made = file.createVariable(name, "i1" if values.dtype == np.int8 else "f8", dims)
    made[:] = values
    for key, value in attributes(name).items():
        if value != "" if isinstance(value, str) else True:
            setattr(made, key, value)


def counted(found: Arrays) -> dict[str, int]:
    """Numbers of conditions by verdict, status and way to the motion, beyond the righting arm's fit, and short of harmonics.

    found: `FLAGS`, beyond and missed
    Returns "verdict 0": .., "status 0": .., "beyond": .., "more harmonics": ..; zeros left out
    """
    counts: dict[str, int] = {}
    for name in FLAGS:
        values, numbers = np.unique(found[name], return_counts=True)
        counts |= {f"{name} {value}": int(number) for value, number in zip(values, numbers, strict=True)}
    others = {
        "beyond": int(found["beyond"]),
        "more harmonics": int((np.asarray(found[MISSED], dtype=float) > ENOUGH).sum()) if MISSED in found else 0,
    }
    return counts | {name: number for name, number in others.items() if number}
