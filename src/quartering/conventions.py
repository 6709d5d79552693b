"""Axes, signs, units and names used by every package.

Body axes: x to the bow, y to starboard, z down, origin at the centre of gravity G. Positive roll puts the starboard
side down, positive yaw turns the bow to starboard. Modes in the paper's order: 1 sway, 2 roll, 3 yaw. The state is
``(v, phi, p, r)``: sway velocity [m/s], roll angle [rad], roll rate and yaw rate [rad/s].

Heading mu: 0 following, 90 beam (the wave runs from port to starboard), 180 head; the paper's delta = 180 - mu.
A wave of amplitude A passes G as ``surface displacement (down) = A sin(omega t)``.

Harmonics are real: ``x(t) = sum_n a_n cos(n w t) + b_n sin(n w t)``; the phasor of ``(a, b)`` is ``a - i b``.
People type and read SI units and degrees; what is integrated is in radians.
"""

from __future__ import annotations

import copyreg
import math
from types import MappingProxyType
from typing import Any, Final, NamedTuple

GRAVITY: Final = 9.81
"""Acceleration of gravity [m/s2]."""

NORMAL_95: Final = 1.96
"""Standard errors to either side of a mean that leave 5 % outside [1]."""

WATER_DENSITY: Final = 1025.0
"""Density of sea water [kg/m3]."""

MODES: Final = ("sway", "roll", "yaw")
STATE: Final = ("v", "phi", "p", "r")
CUBIC_MONOMIALS: Final = ("vvv", "ppp", "rrr", "vpp", "vrr", "pvv", "prr", "rvv", "rpp", "vpr")
"""The ten velocity cubics of the paper's equations, in the order every (3, 10) array of them follows."""

HEADING_CONVENTION: Final = "0 deg following, 90 deg beam (wave from port to starboard), 180 deg head sea"
REFERENCE_POINT: Final = "centre of gravity G; axes x to the bow, y to starboard, z down"


def _read_only(content: dict[Any, Any]) -> MappingProxyType[Any, Any]:
    return MappingProxyType(content)


# Ships, models and coefficients hold read-only mappings; with this they go to other processes and are copied.
copyreg.pickle(MappingProxyType, lambda mapping: (_read_only, (dict(mapping),)))


class InputError(ValueError):
    """Bad input: the message says what was given, what is allowed and what to try."""


def as_float(value: Any) -> Any:
    """A whole number too large for floating point made infinite; anything else as it is.

    >>> as_float(10**400), as_float(3), as_float("3 m")
    (inf, 3, '3 m')
    """
    if isinstance(value, int):
        try:
            float(value)
        except OverflowError:
            return math.inf if value > 0 else -math.inf
    return value


class RangeWarning(UserWarning):
    """A result leaves the range in which its method is valid."""


class DamageWarning(UserWarning):
    """Something kept on disk is not what was written, and is made anew."""


class Symbol(NamedTuple):
    """How a quantity is written: its letter, its unit and what it means."""

    symbol: str
    unit: str
    meaning: str


SYMBOLS: Final[dict[str, Symbol]] = {
    "length": Symbol("L", "m", "length between perpendiculars"),
    "beam": Symbol("B", "m", "moulded breadth at the waterline"),
    "draught": Symbol("T", "m", "draught"),
    "gm": Symbol("GM", "m", "transverse metacentric height"),
    "kg": Symbol("KG", "m", "height of the centre of gravity over the keel"),
    "gyradius_roll": Symbol("k_xx", "m", "radius of gyration in roll, without added mass"),
    "gyradius_yaw": Symbol("k_zz", "m", "radius of gyration in yaw, without added mass"),
    "bilge_keel_length": Symbol("l_BK", "m", "length of one bilge keel of the pair"),
    "bilge_keel_breadth": Symbol("b_BK", "m", "breadth of one bilge keel of the pair"),
    "velocities": Symbol(
        "velocities", "1", "velocity that lift acts on: relative to the water, or absolute (over ground)"
    ),
    "speed": Symbol("U", "m/s", "forward speed"),
    "heading": Symbol("mu", "deg", "heading to the waves: " + HEADING_CONVENTION),
    "wave_length": Symbol("lambda", "m", "wave length"),
    "wave_height": Symbol("H", "m", "wave height, crest to trough"),
    "steepness": Symbol("H/lambda", "1", "wave steepness, height over length"),
    "frequency": Symbol("omega", "rad/s", "frequency of encounter"),
    "wave_frequency": Symbol("sigma", "rad/s", "wave frequency seen from a fixed point"),
    "encounter_frequency": Symbol(
        "omega", "rad/s", "frequency of encounter; negative when the ship overtakes the wave"
    ),
    "position": Symbol(
        "x_c/lambda", "1", "how far the crest has run from midship, the way the wave runs, of its length"
    ),
    "gz": Symbol("GZ", "m", "righting arm; positive rights the ship"),
    "heel": Symbol("phi", "deg", "angle of heel, + starboard side down"),
    "heave": Symbol("zeta", "m", "heave of G, + down"),
    "trim": Symbol("theta", "deg", "trim, + bow up"),
    "sway_amplitude": Symbol("P1", "m", "amplitude of the integrated sway velocity, fundamental"),
    "roll_amplitude": Symbol("P2", "deg", "amplitude of roll, fundamental"),
    "yaw_amplitude": Symbol("P3", "deg", "amplitude of yaw, fundamental"),
    "sway": Symbol("P1", "m", "sway_amplitude under its name until version 0.2"),
    "roll": Symbol("P2", "deg", "roll_amplitude under its name until version 0.2"),
    "yaw": Symbol("P3", "deg", "yaw_amplitude under its name until version 0.2"),
    "roll_peak": Symbol("max|phi|", "deg", "largest roll angle over a cycle"),
    "missed": Symbol(
        "", "1", "change of roll by the next harmonics, estimated, as a share of its amplitude; above 0.01 take more"
    ),
    "k2": Symbol("K2", "1/s2", "first-order stability index, all averages kept; negative is stable"),
    "k2_rho": Symbol("K2", "1/s2", "index from I1, I2, I3 with the ship's roll axis and amplitudes through the water"),
    "k2_paper": Symbol("K2", "1/s2", "index with the paper's literal 0.3 and 0.1 and amplitudes over ground"),
    "index": Symbol("S", "1/s", "stability index -K2/(2 n2); positive is stable"),
    "n2": Symbol("n2", "rad/s", "natural roll frequency about the steady motion"),
    "q": Symbol("q", "1/s", "growth rate near the resonance n2 = m omega/2, first order, all terms kept"),
    "q_paper": Symbol("q", "1/s", "growth rate near the resonance n2 = m omega/2, the paper's form"),
    "slow": Symbol("nu", "1/s", "growth rates of the sway-yaw modes averaged over the wave"),
    "first_order": Symbol("", "1/s", "largest growth rate by first-order theory, all its rungs; positive is unstable"),
    "calm_exponent": Symbol("lambda", "1/s", "largest real part of the linear motion without waves, same coefficients"),
    "roll_damping": Symbol("zeta", "1", "added roll damping, fraction of critical"),
    "exponent": Symbol("lambda", "1/s", "largest real part of the Floquet exponents; positive is unstable"),
    "multiplier_modulus": Symbol("|mu|", "1", "moduli of the Floquet multipliers of (v, phi, p, r)"),
    "verdict": Symbol("", "1", "is the motion stable, and if not by which mechanism"),
    "status": Symbol("", "1", "whether the condition has an answer"),
    "other_roll_peak": Symbol(
        "max|phi|",
        "deg",
        "largest roll angle over a cycle of other stable motions in the same wave; NaN where none is known or asked for",
    ),
    "capsizes_on_the_way": Symbol(
        "",
        "1",
        "does the ship capsize before it comes to its stable motion, from upright or with the wave raised in steps",
    ),
}
"""Name -> letter, unit and meaning: labels of every table, dataset and plot come from here."""

_BY_SYMBOL: Final = ("gm", "kg", "gyradius_roll", "gyradius_yaw")


def written(name: str) -> str:
    """A quantity as titles, tables and sentences write it.

    name: of a condition, a loading value, a coefficient
    """
    if name in _BY_SYMBOL:
        return SYMBOLS[name].symbol
    if name == "roll_damping":
        return "added roll damping"
    return name.replace("_", " ") if name.islower() else name


def in_unit(unit: str) -> str:
    """A unit after a number, nothing for what has none.

    unit: "1" for what has none

    >>> in_unit("m"), in_unit("1")
    (' m', '')
    """
    return "" if unit == "1" else f" {unit}"


def headed(name: str, unit: str) -> str:
    """Head of a column or label of an axis: a quantity and, in brackets, its unit.

    name: of a condition, a loading value, a coefficient
    unit: "1" for what has none

    >>> headed("gyradius_roll", "m"), headed("K_p", "1")
    ('k_xx [m]', 'K_p')
    """
    return written(name) if unit == "1" else f"{written(name)} [{unit}]"


_SECTORS: Final = ((15.0, "following"), (75.0, "stern quartering"), (105.0, "beam"), (165.0, "bow"), (180.0, "head"))


def sector(heading: float) -> str:
    """Name of the sector a heading lies in.

    heading: mu, any sign or turn [deg]
    Returns "following" (below 15), "stern quartering" (15-75), "beam" (75-105), "bow" (105-165) or "head"

    Source: [H71] Fig. 1; sector limits as in common seakeeping practice.

    >>> sector(30.0), sector(-90.0), sector(180.0)
    ('stern quartering', 'beam', 'head')
    """
    folded = abs((heading + 180.0) % 360.0 - 180.0)
    return next(name for upper, name in _SECTORS if folded < upper or upper == 180.0)
