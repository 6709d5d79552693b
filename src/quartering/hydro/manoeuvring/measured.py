"""Measured manoeuvring sets: read with their own conventions, given in SI about G under our names.

A set is a YAML file of our own (those of ``hydro/library``, or one's own): the numbers as printed, and beside them what
they mean: the system they are divided by, the point they are about, whether they are Taylor derivatives, and whether the
rigid-body terms ``-m U`` and ``-m x_G U`` are inside ``Y_r`` and ``N_r``.
"""

from __future__ import annotations

import math
from functools import lru_cache
from pathlib import Path

from quartering.conventions import InputError
from quartering.hull.file.yaml_text import read_yaml
from quartering.hull.user_measured import LIBRARY, MeasuredFile, available_sets, file_digest, measured_source
from quartering.hydro.manoeuvring.lift import to_si
from quartering.hydro.manoeuvring.measured_file import MeasuredSet, MeasuredTerm, assembled_set, taylor_factor
from quartering.hydro.manoeuvring.term_transfer import moved_terms
from quartering.names import dimension, term, unit

__all__ = [
    "LIBRARY",
    "MeasuredSet",
    "MeasuredTerm",
    "available_sets",
    "measured_set",
    "scaled_terms",
    "taylor_factor",
    "to_terms",
]

LEAST_FROUDE_NUMBER = 0.1
"""Below this U/sqrt(g L) terms divided by U keep the value they have there: drift angles in waves leave what was tested."""


def measured_set(name_or_path: str | Path | MeasuredFile) -> MeasuredSet:
    """A measured set of manoeuvring derivatives, by built-in name or from a file of the same form.

    name_or_path: "chislett-stroem-tejsen-1965" (Mariner), "son-nomoto-1982" (S-175, with roll),
        "blanke-christensen-1993" (naval vessel, modulus terms), or a YAML file

    Source: [Chislett65], [Son82], [Blanke93].
    """
    if isinstance(name_or_path, MeasuredFile):
        return _read_set(name_or_path)
    path = LIBRARY / f"{name_or_path}.yaml" if str(name_or_path) in available_sets() else Path(name_or_path)
    source = measured_source(path)
    assert isinstance(source, MeasuredFile)  # a name has become its file
    return _read_set(source)


@lru_cache(maxsize=16)
def _read_set(file: MeasuredFile) -> MeasuredSet:
    """The set in a file, read once for a content."""
    path = Path(file.source)
    if not path.is_file() or file_digest(path) != file.digest:
        raise InputError(f"measured: {path} has changed or gone since the ship was read; read the ship again")
    data = read_yaml(path)
    if not isinstance(data, dict):
        raise InputError(f"{path}: a measured set is a list of keys with values; see the built-in sets for the form")
    try:
        return assembled_set(path.stem, data)
    except (KeyError, TypeError, AttributeError, ValueError) as error:
        reason = f"key {error} is missing" if isinstance(error, KeyError) else str(error)
        raise InputError(f"{path}: {reason}; see the built-in sets for the form") from None


def _speed_power(name: str) -> int:
    """Power of U in a coefficient whose prime value is constant."""
    powers = {"v": 1, "p": 1, "r": 1, "phi": 0}
    return 2 - sum(powers.get(factor, 2) for factor in term(name).factors)


def scaled_terms(
    measured: MeasuredSet, length: float, density: float, *, x_g: float | None = None, z_g: float | None = None
) -> dict[tuple[str, int], float]:
    """The set at the size of a ship and about its G, as values over powers of the speed.

    length: L of the ship [m]
    density: of the water [kg/m3]
    x_g, z_g: G of the ship from the point the set is about, + forward, + down [m]; None: as published, scaled
    Returns (name, power) -> value: the coefficient is the sum of value U^power over its powers, SI about G

    A set in SI is brought to another length by Froude's law (time with the root of the length).
    Source: [Abkowitz64] prime system and rigid-body kinematics; [MMG78] for L T.
    Valid: the ship is geometrically like the one tested.
    """
    if not (length > 0 and density > 0 and math.isfinite(length) and math.isfinite(density)):
        raise InputError(f"length {length:g} m and density {density:g} kg/m3 must be positive numbers")
    ratio = length / measured.condition["length"]
    x = measured.x_g * ratio if x_g is None else x_g
    z = measured.z_g * ratio if z_g is None else z_g
    at_point: dict[int, dict[str, float]] = {}
    for name, value, power in measured.terms:
        if measured.system == "si":
            mass, metre, second = dimension(name)
            scale = (
                density / measured.condition["density"] * ratio ** (3 * mass + metre - power + 0.5 * (second + power))
            )
            at_point.setdefault(power, {})[name] = value * scale
        else:
            draught = measured.condition.get("draught", math.nan) * ratio
            power = _speed_power(name)
            in_si = to_si(
                name, value, length, 1.0, density, draught if measured.system == "mmg" else None, measured.system
            )
            at_point.setdefault(power, {})[name] = in_si
    return {
        (name, power): value for power, group in at_point.items() for name, value in moved_terms(group, -x, -z).items()
    }


def to_terms(
    measured: MeasuredSet,
    length: float,
    speed: float,
    density: float,
    x_g: float | None = None,
    z_g: float | None = None,
) -> dict[str, tuple[float, str, str]]:
    """The set in SI about G, under our names, at one speed.

    length: L of the ship [m]
    speed: U > 0 where a term divides by it [m/s]
    density: of the water [kg/m3]
    x_g, z_g: G of the ship from the point the set is about, + forward, + down [m]; None: as published, scaled
    Returns name -> (value, unit, source): complete coefficients of the right-hand side, hydrodynamic only (no -m U)

    Source: the paper of the set; [Abkowitz64] prime system and rigid-body kinematics.
    """
    if not (speed >= 0 and math.isfinite(speed)):
        raise InputError(f"speed {speed!r} m/s must be a number >= 0")
    total: dict[str, float] = {}
    for (name, power), value in scaled_terms(measured, length, density, x_g=x_g, z_g=z_g).items():
        if speed == 0 and power < 0 and value:
            raise InputError(f"{measured.name}: {name} divides by the speed; give a positive speed")
        total[name] = total.get(name, 0.0) + (value * speed**power if value else 0.0)
    source = f"measured: [{measured.reference}] {measured.title}"
    return {name: (value, unit(name), source) for name, value in total.items()}
