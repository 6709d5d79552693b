"""Roll damping of a cargo ship at rest from its main particulars: the regression of Kawahara, Maekawa and Ikeda.

The component method was run over a family of hulls and fitted by polynomials in B/T, C_B, C_M, OG/T, the frequency and the
bilge keel's size. It needs no lines. Outside the family it is a polynomial out of its range: the wave part above all
goes wrong, and an eddy part below zero is possible. A `RangeWarning` says which limit is passed.
"""

from __future__ import annotations

import warnings
from typing import Final, NamedTuple

import numpy as np

from quartering.conventions import GRAVITY, RangeWarning
from quartering.hull.lines.section import Floats
from quartering.hydro.damping.ikeda import Particulars, Rolling
from quartering.hydro.damping.ikeda_bilge_keel import BilgeKeel

LIMITS: Final[dict[str, tuple[float, float]]] = {
    "C_B": (0.5, 0.85),
    "B/T": (2.5, 4.5),
    "C_M": (0.9, 0.99),
    "OG/T": (-1.5, 0.2),
    "omega sqrt(B/2g)": (0.0, 1.0),
    "bilge keel breadth/B": (0.01, 0.06),
    "bilge keel length/L": (0.05, 0.4),
}
"""Range of the hulls behind the regression; OG/T is positive with G below the waterline."""

# Wave part. Each row is a polynomial in B/T, highest power first; rows are the powers of C_B, highest first.
_HEIGHT_2: Final = (
    (-0.002222, 0.040871, -0.286866, 0.599424),
    (0.010185, -0.161176, 0.904989, -1.641389),
    (-0.015422, 0.220371, -1.084987, 1.834167),
)
_HEIGHT_1: Final = (
    (-0.0628667, 0.4989259, 0.52735, -10.7918672, 16.616327),
    (0.1140667, -0.8108963, -2.2186833, 25.1269741, -37.7729778),
    (-0.0589333, 0.2639704, 3.1949667, -21.8126569, 31.4113508),
    (0.0107667, 0.0018704, -1.2494083, 6.9427931, -10.2018992),
)
_HEIGHT_0: Final = (
    (0.192207, -2.787462, 12.507855, -14.764856),
    (-0.350563, 5.222348, -23.974852, 29.007851),
    (0.237096, -3.535062, 16.368376, -20.539908),
    (-0.067119, 0.966362, -4.407535, 5.894703),
)
_HEIGHT_MIDSHIP_1: Final = (
    (17.945, -166.294, 489.799, -493.142),
    (-25.507, 236.275, -698.683, 701.494),
    (9.077, -84.332, 249.983, -250.787),
)
_HEIGHT_MIDSHIP_0: Final = (
    (-16.872, 156.399, -460.689, 463.848),
    (24.015, -222.507, 658.027, -660.665),
    (-8.56, 79.549, -235.827, 236.579),
)
_WIDTH: Final = (-1.402, 7.189, -10.993, 9.45)
# Each row is a polynomial in C_B, highest power first; rows are the powers of 1 - OG/T, highest first.
_PEAK: Final = (
    (-7686.0287, 30131.5678, -49048.9664, 42480.7709, -20665.147, 5355.2035, -577.8827),
    (61639.9103, -241201.0598, 392579.5937, -340629.4699, 166348.6917, -43358.7938, 4714.7918),
    (-130677.4903, 507996.2604, -826728.7127, 722677.104, -358360.7392, 95501.4948, -10682.8619),
    (-110034.6584, 446051.22, -724186.4643, 599411.9264, -264294.7189, 58039.7328, -4774.6414),
    (709672.0656, -2803850.2395, 4553780.5017, -3888378.9905, 1839829.259, -457313.6939, 46600.823),
    (-822735.9289, 3238899.7308, -5256636.5472, 4500543.147, -2143487.3508, 538548.1194, -55751.1528),
    (299122.8727, -1175773.1606, 1907356.1357, -1634256.8172, 780020.9393, -196679.7143, 20467.0904),
)
_SHIFT_SLOPE: Final = (-17.102, 41.495, -33.234, 8.8007)
_SHIFT_START: Final = (36.566, -89.203, 71.8, -18.108)
_SHIFT_BREADTH: Final = (-0.3767, 3.39, -10.356, 11.588)
_SHIFT_ORIGIN: Final = (-0.0727, 0.7, -1.2818)
_SHIFT_CONSTANT: Final = (-0.0495, 0.4518, -0.61655)
_SHIFT: Final = (-1.05584, 12.688, -63.70534, 172.84571, -274.05701, 257.68705, -141.40915, 44.13177, -7.1654, 0.0)


class SimplifiedDamping(NamedTuple):
    """Non-dimensional equivalent linear damping at rest, in units of `Particulars.scale`.

    Parameters
    ----------
    friction, wave, eddy, bilge_keel : (n,) float    [1]
    """

    friction: Floats
    wave: Floats
    eddy: Floats
    bilge_keel: Floats

    @property
    def total(self) -> Floats:
        """Sum of the four [1]."""
        return self.friction + self.wave + self.eddy + self.bilge_keel


def simplified_ikeda(hull: Particulars, motion: Rolling, keel: BilgeKeel | None = None) -> SimplifiedDamping:
    """Roll damping at rest by the regression of Kawahara, Maekawa and Ikeda.

    motion: its speed plays no part
    keel: None: none

    B = value * rho (L B T C_B) B^2 sqrt(2g/B).
    Source: [Kawahara09] equations (3) to (14).  Valid: `LIMITS`; cargo ships of ordinary form, without speed.
    """
    _warn_outside(hull, motion, keel)
    frequency = motion.frequency * np.sqrt(hull.beam / (2 * GRAVITY))
    wave = np.full_like(motion.amplitude, _wave(hull, frequency))
    none = np.zeros_like(motion.amplitude)
    keels = none if keel is None else _bilge_keel(hull, motion, keel, frequency)
    return SimplifiedDamping(_friction(hull, motion), wave, _eddy(hull, motion, frequency), keels)


def _warn_outside(hull: Particulars, motion: Rolling, keel: BilgeKeel | None) -> None:
    values = {
        "C_B": hull.block,
        "B/T": hull.beam / hull.draught,
        "C_M": hull.midship,
        "OG/T": hull.og / hull.draught,
        "omega sqrt(B/2g)": motion.frequency * np.sqrt(hull.beam / (2 * GRAVITY)),
    }
    if keel is not None:
        values |= {"bilge keel breadth/B": keel.breadth / hull.beam, "bilge keel length/L": keel.length / hull.length}
    out = [
        f"{name} = {values[name]:.3g} (range {low:g} to {high:g})"
        for name, (low, high) in LIMITS.items()
        if name in values and not low - 1e-9 <= values[name] <= high + 1e-9
    ]
    if out:
        message = "simplified Ikeda damping outside the range of its regression: " + ", ".join(out)
        warnings.warn(message + '; method "ikeda" works from the lines', RangeWarning, stacklevel=3)


def _polynomial(table: tuple[tuple[float, ...], ...], outer: float, inner: float) -> float:
    """Polynomial in ``outer`` whose coefficients are polynomials in ``inner``, highest power first."""
    return float(np.polyval([np.polyval(row, inner) for row in table], outer))


def _friction(hull: Particulars, motion: Rolling) -> Floats:
    L, B, T, CB = hull.length, hull.beam, hull.draught, hull.block
    omega, phi = motion.frequency, motion.amplitude
    radius = T * ((0.887 + 0.145 * CB) * (1.7 + CB * B / T) - 2 * hull.og / T) / np.pi
    surface = L * (1.75 * T + CB * B)
    coefficient = 1.328 * (3.22 * radius**2 * phi**2 * omega / (2 * np.pi * hull.viscosity)) ** -0.5
    damping = 4 / (3 * np.pi) * hull.density * surface * radius**3 * phi * omega * coefficient
    return np.asarray(damping / hull.scale)


def _wave(hull: Particulars, frequency: float) -> float:
    breadth, block, depth = hull.beam / hull.draught, hull.block, 1 - hull.og / hull.draught
    powers = [_polynomial(table, block, breadth) for table in (_HEIGHT_2, _HEIGHT_1, _HEIGHT_0)]
    height = float(np.polyval(powers, depth))
    of_midship = _polynomial(_HEIGHT_MIDSHIP_1, block, breadth) * hull.midship
    height *= 1 + (1 - depth) * (of_midship + _polynomial(_HEIGHT_MIDSHIP_0, block, breadth))
    slope, start = np.polyval(_SHIFT_SLOPE, block), np.polyval(_SHIFT_START, block)
    size = np.polyval(_SHIFT_BREADTH, breadth) * (slope * depth + start)
    from_origin = depth - np.polyval(_SHIFT_ORIGIN, breadth)
    shift = size * (np.polyval(_SHIFT, from_origin) + np.polyval(_SHIFT_CONSTANT, breadth))
    peak = _polynomial(_PEAK, depth, block) + shift
    return float(height / frequency * np.exp(-np.polyval(_WIDTH, depth) * (np.log(frequency) - peak) ** 2 / 1.44))


def _eddy(hull: Particulars, motion: Rolling, frequency: float) -> Floats:
    breadth, CB, og = hull.beam / hull.draught, hull.block, hull.og / hull.draught
    height = (-0.0182 * CB + 0.0155) * (breadth - 1.8) ** 3 + np.polyval(
        (-79.414, 215.695, -215.883, 93.894, -14.848), CB
    )
    of_axis = np.polyval((0.9717, -1.55, 0.723), CB) * og + 0.04567 * CB + 0.9408
    exponent = (3.98 * CB - 5.1525) * (1.6 - 0.2 * breadth) * og * of_axis
    factor = (0.25 * og + 0.95) * og + np.polyval((-219.2, 443.7, -283.3, 59.6), CB)
    power = -15.0 * CB * breadth + 46.5 * CB + 11.2 * breadth - 28.6
    coefficient = height * np.exp(exponent + factor * hull.midship**power)
    return np.asarray(4 * frequency * motion.amplitude / (3 * np.pi * CB * breadth**3) * coefficient)


def _bilge_keel(hull: Particulars, motion: Rolling, keel: BilgeKeel, frequency: float) -> Floats:
    breadth, CB, og = hull.beam / hull.draught, hull.block, hull.og / hull.draught
    b, l, angle = keel.breadth / hull.beam, keel.length / hull.length, np.degrees(motion.amplitude)
    of_hull = (-0.3651 * CB + 0.3907) * (breadth - 2.83) ** 2 - 2.21 * CB + 2.632
    of_angle = np.polyval((0.00255, 0.122, 0.4794), angle)
    of_keel = (-0.8913 * b**2 - 0.0733 * b) * l**2 + (5.2857 * b**2 - 0.01185 * b + 0.00189) * l
    exponent = (5.0 * b + 0.3 * breadth - 0.2 * l + np.polyval((0.00125, -0.0425, -1.86), angle)) * og
    factor = -15.0 * b + 1.2 * CB - 0.1 * breadth + np.polyval((-0.0657, 0.0586, 1.6164), og)
    power = 2.5 * og + 15.75
    return np.asarray(of_hull * of_angle * of_keel * np.exp(exponent + factor * hull.midship**power) * frequency)
