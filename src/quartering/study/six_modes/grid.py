"""Conditions of a study in six modes: the axes of regular waves, in blocks as small as its conditions are dear."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, Final

from quartering.conventions import InputError
from quartering.study.grid import Grid

STEADY_MOTION: Final = "six modes: harmonic balance, pressure over the instantaneous wetted hull"
"""What datasets say of the steady motion."""
_PARTS, _SMALLEST, _LARGEST = 64, 8, 128


@dataclass(frozen=True, eq=False)
class SixGrid(Grid):
    """Every condition of a study in six modes."""

    sampled: ClassVar[int] = 24

    @property
    def usual_block_size(self) -> int:
        """Conditions of one block, by their number alone."""
        return min(max(self.count // _PARTS, _SMALLEST), _LARGEST)

    @cached_property
    def described(self) -> dict[str, Any]:
        """What decides the results, in types JSON knows."""
        return {"kind": "six modes"} | super().described


def in_six_modes(grid: Grid) -> SixGrid:
    """The same conditions in six modes.

    Raises
    ------
    InputError    harmonics or a form of diffraction, which six modes have of their own; waves of no height
    """
    if grid.harmonics != 1 or grid.form != "stf":
        raise InputError("modes = six has harmonics and diffraction of its own; leave harmonics and form out")
    if not (grid.axes[grid.sea] > 0).all():
        raise InputError(f"modes = six and {grid.sea} = 0: six modes are judged in a wave; give heights above 0")
    made = SixGrid(grid.ship, grid.axes, grid.loadings, text=grid.text)
    made._ships.update(grid._ships)
    return made
