"""Check of a close-fit solution: damping from pressure and from radiated waves must agree."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Final

import numpy as np

from quartering.conventions import RangeWarning
from quartering.hull.lines.section import Floats

LARGEST: Final = 0.03
"""Difference of the two dampings, over the complex added mass, from which on it is told; ships have below 0.01 [1]."""


def worst(residual: Floats, frequency: Floats) -> Floats:
    """Largest difference of each section and where it is.

    residual (f, s, k): of `close_fit`
    frequency (f,): [rad/s]
    Returns (2, s): difference [1] and frequency [rad/s]

    Source: [Frank67], energy of the radiated waves.
    """
    largest = residual.max(axis=-1)
    return np.stack([largest.max(axis=0), frequency[largest.argmax(axis=0)]])


def warn_of_mismatch(worst_of: Floats, names: Sequence[str], stacklevel: int) -> None:
    """One warning that names the worst section, its frequency, and how many there are.

    worst_of (2, s): of `worst`
    names: of the sections
    stacklevel: as in `warnings.warn`

    Source: [Frank67], energy of the radiated waves.
    """
    beyond = np.flatnonzero(worst_of[0] > LARGEST)
    if beyond.size == 0:
        return
    s = int(np.argmax(worst_of[0]))
    others = f" ({beyond.size} sections in all)" if beyond.size > 1 else ""
    warnings.warn(
        f"{names[s]}: damping by pressure and by radiated waves differ by {100 * worst_of[0, s]:.2g} % at "
        f"{worst_of[1, s]:.4g} rad/s{others}: the shape is not resolved there; check its offsets, or take Lewis forms",
        RangeWarning,
        stacklevel=stacklevel + 1,
    )
