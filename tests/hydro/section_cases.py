"""Sections and reference tables that several tests share."""

import csv
from pathlib import Path

import numpy as np

from quartering.hull.lines.strips import Strips

DATA = Path(__file__).parents[1] / "data"


def read_table(name: str) -> list[dict[str, str]]:
    lines = [line for line in (DATA / name).read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def bare_strips(half_breadth, draught, area) -> Strips:
    """Strips that carry only what the section solution reads."""
    b, T, S = (np.atleast_1d(np.asarray(v, dtype=float)) for v in (half_breadth, draught, area))
    empty = np.zeros((b.size, 1))
    return Strips(np.arange(b.size) * 1.0, np.ones(b.size), empty, empty, empty, empty, b, T, S)
