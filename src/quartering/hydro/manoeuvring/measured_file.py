"""The file of a measured set, and the record it becomes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Literal, NamedTuple

from quartering.conventions import InputError
from quartering.names import canonical, term

_POWERS = {"terms": 0, "per_speed": 1, "per_speed_squared": 2}
_KEYS = {
    "title", "reference", "system", "taylor", "about", "condition", "g", "height", "rigid_body", "body", "left_side",
    "rudder", "notes", *_POWERS,
}  # fmt: skip


class MeasuredTerm(NamedTuple):
    """A coefficient as a value times a power of the speed.

    Parameters
    ----------
    name : str       as in `coefficients`, hydrodynamic, a complete coefficient of the right-hand side
    value : float    prime value of the set's system, or SI over U^power
    power : int      of U, for a set in SI; a prime value has its power from its name
    """

    name: str
    value: float
    power: int


@dataclass(frozen=True, eq=False)
class MeasuredSet:
    """A measured set of derivatives, complete coefficients without rigid-body terms, about its own point.

    Parameters
    ----------
    name, title : str             of the set
    reference : str               key of the paper
    system : str                  "sname" (over L^2), "mmg" (over L T), or "si"
    midship : bool                the set is about a point amidships
    x_g, z_g : float              G from the set's point as published, + forward, + down [m]
    height : float or None        of the set's point over the baseline [m]; None: no roll was measured
    condition : mapping           published length, beam, draught [m], speed [m/s], density [kg/m3], volume [m3], gm [m]
    terms : tuple of MeasuredTerm
    body : mapping                "m", "I_x", "I_z" in the set's system, as published
    rudder : mapping              "Y", "K", "N": derivatives to the rudder angle, prime, as printed, where given
    printed : mapping             name -> number as printed, before rigid-body terms or Taylor factors are dealt with
    notes : str                   where it was read and what to know of it
    """

    name: str
    title: str
    reference: str
    system: Literal["sname", "mmg", "si"]
    midship: bool
    x_g: float
    z_g: float
    height: float | None
    condition: Mapping[str, float]
    terms: tuple[MeasuredTerm, ...]
    body: Mapping[str, float]
    rudder: Mapping[str, float]
    printed: Mapping[str, float]
    notes: str


def taylor_factor(name: str) -> float:
    """Factor from a Taylor derivative to a complete coefficient.

    name: such as "Y_vvv" (1/6), "Y_vrr" (1/2), "K_vpr" (1)
    Returns 1 over the product of the factorials of the powers; 1 for modulus terms, which no Taylor series has

    Source: [Abkowitz64] expansion.
    """
    factors = term(name).factors
    if "|" in name:
        return 1.0
    return 1.0 / math.prod(math.factorial(factors.count(factor)) for factor in set(factors))


def assembled_set(name: str, data: Mapping[str, Any]) -> MeasuredSet:
    """The record of a file: Taylor factors applied, left-side and rigid-body terms taken out.

    data: what the YAML holds

    Y_r = printed + m' and N_r = printed + m' x_G' where the rigid-body terms are inside.  Source: [Abkowitz64] expansion.
    """
    unknown = sorted(set(data) - _KEYS)
    if unknown:
        raise InputError(f"key `{unknown[0]}` is unknown; keys allowed: {', '.join(sorted(_KEYS))}")
    for key, allowed in (
        ("system", ("sname", "mmg", "si")),
        ("taylor", ("complete", "derivatives")),
        ("rigid_body", ("inside", "separate")),
        ("about", ("midship", "point")),
    ):
        if data[key] not in allowed:
            raise InputError(f"{key}: {data[key]!r} is given; allowed: {', '.join(allowed)}")
    if data["rigid_body"] == "inside" and data["system"] == "si":
        raise InputError("rigid_body: inside is for prime values; in SI take m U out of Y_r first")
    condition, body, g = _numbers(data["condition"]), _numbers(data["body"]), _numbers(data["g"])
    for key, unit in (("length", "m"), ("speed", "m/s"), ("density", "kg/m3")):
        if not condition.get(key, 0.0) > 0.0:
            given = f"{key}: {condition[key]:g}" if key in condition else f"no {key}"
            raise InputError(f"condition: {given} is given; write what the set was measured at, above 0 {unit}")
    printed: dict[str, float] = {}
    terms: dict[tuple[str, int], float] = {}
    for block, power in _POWERS.items():
        for key, value in _numbers(data.get(block) or {}).items():
            factor = taylor_factor(key) if data["taylor"] == "derivatives" else 1.0
            terms[canonical(key), power] = terms.get((canonical(key), power), 0.0) + factor * value
            printed[f"{key} U^{power}" if power else key] = value
    for key, value in _numbers(data.get("left_side") or {}).items():
        terms[canonical(key), 0] = terms.get((canonical(key), 0), 0.0) - value
    if data["rigid_body"] == "inside":
        terms["Y_r", 0] += body["m"]
        terms["N_r", 0] += body["m"] * g["x"] / condition["length"]
    return MeasuredSet(
        name=name,
        title=data["title"],
        reference=data["reference"],
        system=data["system"],
        midship=data["about"] == "midship",
        x_g=g["x"],
        z_g=g["z"],
        height=None if data["height"] is None else float(data["height"]),
        condition=MappingProxyType(condition),
        terms=tuple(MeasuredTerm(key, value, power) for (key, power), value in terms.items()),
        body=MappingProxyType(body),
        rudder=MappingProxyType(_numbers(data.get("rudder") or {})),
        printed=MappingProxyType(printed),
        notes=data.get("notes", ""),
    )


def _numbers(block: Mapping[str, Any]) -> dict[str, float]:
    numbers = {key: float(value) for key, value in block.items()}
    for key, value in numbers.items():
        if not math.isfinite(value):
            raise ValueError(f"{key}: {value} is not a finite number")
    return numbers
