"""Constants of the criteria as data: value, place in the circular, and how sure it is."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import yaml

__all__ = ["Constant", "constant", "constants", "interpolated", "limit"]

_FILE = Path(__file__).with_name("constants.yaml")


class Constant(NamedTuple):
    """One number of the circular.

    Parameters
    ----------
    name : str      such as "pure_loss.steepness"
    value : float
    unit : str
    place : str     in MSC.1/Circ.1627, or the code it refers to
    status : str    "recalled", or by what it was checked
    """

    name: str
    value: float
    unit: str
    place: str
    status: str


@cache
def _whole() -> dict[str, Any]:
    return dict(yaml.safe_load(_FILE.read_text(encoding="utf-8")))


def constant(name: str) -> Constant:
    """A constant by its name, "pure_loss.steepness"."""
    group, _, key = name.partition(".")
    entry = _whole()[group][key]
    return Constant(name, float(entry["value"]), str(entry["unit"]), str(entry["place"]), str(entry["status"]))


def limit(name: str) -> float:
    """Value of a constant."""
    return constant(name).value


def constants(mode: str) -> list[Constant]:
    """All constants of a failure mode, in the order of the file."""
    return [constant(f"{mode}.{key}") for key in _whole()[mode]]


def interpolated(table: str, value: float) -> float:
    """A table of the weather criterion at a value, linear between its entries and held beyond them."""
    x, y = (np.array(column, dtype=float) for column in list(_whole()[table].values())[:2])
    return float(np.interp(value, x, y))
