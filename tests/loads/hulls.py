"""Hulls given by formula, as exact quadrature points, and readers of the reference tables beside this file."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from quartering.hull.lines.strips import Strips
from quartering.loads.strips.stations import Stations


def gauss(start, end, points):
    nodes, weights = np.polynomial.legendre.leggauss(points)
    return start + (end - start) * (nodes + 1) / 2, weights * (end - start) / 2


def box(length, beam, draught, stations=40, points=24):
    x, weight = gauss(-length / 2, length / 2, stations)
    (yb, dyb), (zs, dzs) = gauss(0, beam / 2, points), gauss(draught, 0, points)
    contour = (
        np.r_[yb, np.full(points, beam / 2)],
        np.r_[np.full(points, draught), zs],
        np.r_[dyb, 0 * dzs],
        np.r_[0 * dyb, dzs],
    )
    ones = np.ones(stations)
    return Strips(
        x,
        weight,
        *(np.tile(part, (stations, 1)) for part in contour),
        ones * beam / 2,
        ones * draught,
        ones * beam * draught,
    )


def wigley(length, beam, draught, stations=48, points=32, bluntness=0.0):
    """y = (B/2)(1 - u^2)(1 + bluntness u^2)(1 - (z/T)^2), u = 2x/L."""
    x, weight = gauss(-length / 2, length / 2, stations)
    t, dt = gauss(1, 0, points)
    u2 = (2 * x / length) ** 2
    b = beam / 2 * (1 - u2) * (1 + bluntness * u2)
    ones = np.ones(stations)
    y, dy = np.outer(b, 1 - t**2), np.outer(b, -2 * t * dt)
    z, dz = np.tile(draught * t, (stations, 1)), np.tile(draught * dt, (stations, 1))
    return Strips(x, weight, y, z, dy, dz, b, ones * draught, b * draught * 4 / 3)


def stations_of(strips, z0=0.0, x0=0.0, transom=False, length=None):
    aft = -length / 2 if length else strips.x[0]
    return Stations(strips.x - x0, strips.weight, z0, aft - x0, transom)


def rows(name):
    """Rows of a reference table: every column a float where it can be."""
    with open(Path(__file__).parent / name, encoding="utf-8") as file:
        table = csv.DictReader(line for line in file if not line.startswith("#"))
        return [{key: _number(value) for key, value in row.items()} for row in table]


def phasor(row, prefix=""):
    """(3,) complex of the columns Y_cos, Y_sin, ... : cos - i sin."""
    return np.array([row[f"{prefix}{mode}_cos"] - 1j * row[f"{prefix}{mode}_sin"] for mode in "YKN"])


def _number(text):
    try:
        return float(text)
    except ValueError:
        return text
