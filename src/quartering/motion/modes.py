"""Which modes of motion are free: sway, roll and yaw, or all six."""

from __future__ import annotations

from typing import Literal, get_args

from quartering.conventions import InputError
from quartering.option_checks import quoted

Modes = Literal["three", "six"]
"""three: sway, roll and yaw; six: surge, heave and pitch too, in the pressure over the whole wetted hull."""


def in_six(modes: object) -> bool:
    """Are all six modes asked for?

    Raises
    ------
    InputError    neither "three" nor "six"
    """
    if modes not in get_args(Modes):
        raise InputError(f'modes = {quoted(modes)}; it is "three" (sway, roll, yaw) or "six" (heave and pitch too)')
    return modes == "six"
