"""Surf-riding of a ship in following waves: from which speed on a wave may hold it, and from which it surely does."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, Final, Literal

import numpy as np
import xarray as xr

from quartering.conventions import GRAVITY, InputError
from quartering.doors import takes
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.propulsion import Propulsion
from quartering.hull.ship import Ship
from quartering.hull.told import number, numbers
from quartering.hydro.propulsion import Drive, drive_of
from quartering.hydro.strip.surge import spheroid_surge
from quartering.loads.strips.vertical import vertical_forces
from quartering.loads.waves import STEEPEST, Wave
from quartering.loads.wetted_hull.frozen import along_following
from quartering.motion.surf_riding import Thresholds, surf_riding_thresholds
from quartering.study.dataset import attributes, made_by

Kind = Literal[
    "not judged", "periodic surging", "surf-riding from some starts", "surf-riding always", "held by a wave it overtakes",
    "overtakes the wave",
]  # fmt: skip
KINDS: Final[tuple[Kind, ...]] = (
    "not judged", "periodic surging", "surf-riding from some starts", "surf-riding always", "held by a wave it overtakes",
    "overtakes the wave",
)  # fmt: skip
"""What becomes of a ship at a speed, in the order of rising speed."""
POSITIONS: Final = 24
"""Places on the wave at which the ship is balanced."""


class Riding(IntEnum):
    """Whether thresholds of surf-riding were found; `advice` says what to try.

    Examples
    --------
    >>> Riding.NO_PROPULSION.advice.partition(":")[0]
    'no propulsion was given and none can be estimated'
    """

    FOUND = 0
    NO_PROPULSION = 1
    NO_SECOND_THRESHOLD = 2
    FORCE_OF_LOW_WAVE = 3
    FASTER_THAN_THE_WAVE = 4

    @property
    def ok(self) -> bool:
        """Are there thresholds, by the force of this very wave?"""
        return self is Riding.FOUND

    @property
    def advice(self) -> str:
        """One line: what happened and what to try."""
        return _ADVICE[self]


_ADVICE: Final = {
    Riding.FOUND: "both thresholds were found",
    Riding.NO_PROPULSION: "no propulsion was given and none can be estimated: give resistance and propeller",
    Riding.NO_SECOND_THRESHOLD: "no revolutions were found at which every start is caught: the propeller does not reach the "
    "speed of the wave; try a shorter or higher wave, or check the resistance",
    Riding.FORCE_OF_LOW_WAVE: "the ship does not balance on the wave everywhere, and the force is that of a low wave scaled "
    "up; try a lower wave, or carry the sides up with depth",
    Riding.FASTER_THAN_THE_WAVE: "the nominal speed is above the celerity of the wave, which may hold the ship back or be "
    "passed: the thresholds are those of a slower ship; slow down below the second one, or alter course",
}


@dataclass(frozen=True)
class SurfRiding:
    """Surf-riding of a ship in one following wave.

    Parameters
    ----------
    ship : str
    wave : Wave
    status : Riding
    celerity, celerity_froude : float          of the wave [m/s], and as a Froude number of the ship
    force : float                              surging force of the wave, first harmonic, heave and trim balanced [N]
    force_low : float                          the same of a low wave scaled up [N]
    mass, added_mass : float                   of the ship, and in surge [kg]
    source : str                               of resistance and thrust: "given: ..", or "estimated: .."
    first_revolutions, first_froude : float    from here on some starts are caught [1/s]; 0: with a stopped propeller
    revolutions, froude : float                from here on every start is, by Melnikov's method; NaN where there is none
    revolutions_exact, froude_exact : float    the same by the connection of one saddle with the next
    last_revolutions, last_froude : float      up to here the wave can hold the ship; NaN: resistance never lets it pass
    speed, speed_froude : float                nominal, in calm water, asked about [m/s]; NaN where none was
    kind : str                                 what becomes of the ship at that speed, one of `KINDS`
    sentence : str                             the answer in words
    """

    ship: str
    wave: Wave
    status: Riding
    celerity: float
    celerity_froude: float
    force: float
    force_low: float
    mass: float
    added_mass: float
    source: str
    first_revolutions: float
    first_froude: float
    revolutions: float
    froude: float
    revolutions_exact: float
    froude_exact: float
    last_revolutions: float
    last_froude: float
    speed: float
    speed_froude: float
    kind: Kind
    sentence: str

    @property
    def estimated(self) -> bool:
        """Are resistance and thrust an estimate?"""
        return self.source.startswith("estimated")

    def __repr__(self) -> str:
        return f"<SurfRiding {self.sentence}>"

    def __str__(self) -> str:
        return self.sentence


@takes(ship="Ship", wave="Wave", propulsion="Propulsion, None")
def surf_riding(
    ship: Ship, wave: Wave, propulsion: Propulsion | None = None, speed: float | str | None = None
) -> SurfRiding:
    """Thresholds of surf-riding of a ship in a following wave.

    Parameters
    ----------
    ship : Ship
    wave : Wave
    propulsion : Propulsion    resistance and thrust; None: the ship's own (option ``propulsion``), or an estimate, said so
    speed : float              nominal speed to judge, that of the ship in calm water [m/s]; None: none

    Returns
    -------
    SurfRiding

    Raises
    ------
    InputError    a wave of no height, a speed out of its range

    Notes
    -----
    The force is that of the pressure over the whole hull, balanced in heave and trim at 24 places of the wave; its first
    harmonic enters (m + m_x) xi'' + f sin k xi = T(u; n) - R(u). No factor of diffraction: that of the criteria would lower it.
    Below the first threshold the wave overtakes the ship, which surges with it; above the second it is caught from any start.
    Source: as `surf_riding_thresholds`; [Lamb32] added mass; [Holtrop82], [Holtrop84] where nothing is given.
    Valid: following sea, deep water, thrust and resistance of calm water.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> found = surf_riding(ship("s175"), Wave(175.0, 8.0), speed="20 kn")
    >>> found.kind, found.estimated, 0.2 < found.froude < found.froude_exact < 0.4
    ('surf-riding from some starts', True, True)
    """
    nominal = math.nan if speed is None else number(ship, "speed", speed)
    if not wave.height > 0:
        raise InputError("wave_height = 0 m; surf-riding needs a wave; try 0.03 of its length")
    facts = _on_the_wave(ship, wave)
    try:
        drive = drive_of(ship, propulsion, estimate=True)
    except InputError:
        drive = None
    facts |= _thresholds(ship, wave, facts, drive)
    facts |= {"speed": nominal, "speed_froude": nominal / math.sqrt(GRAVITY * ship.hull.length)}
    facts["kind"] = _kind(facts)
    if facts["status"] is Riding.FOUND and facts["speed_froude"] >= facts["celerity_froude"]:
        facts["status"] = Riding.FASTER_THAN_THE_WAVE
    return SurfRiding(**facts, sentence=_sentence(facts))


def _on_the_wave(ship: Ship, wave: Wave) -> dict[str, Any]:
    """Celerity, force of the wave, masses."""
    k, celerity = wave.wavenumber, math.sqrt(GRAVITY / wave.wavenumber)
    place, held = along_following(ship, k, wave.amplitude, POSITIONS)
    low = wave.amplitude * float(abs(vertical_forces(ship, np.array([k]), np.zeros(1), np.zeros(1))[0][0, 0]))
    found = bool(held.found.all())
    force = float(2 * abs(np.mean(held.load[:, 0] * np.exp(1j * place)))) if found else low
    water = hydrostatics(ship)
    return {
        "ship": ship.name, "wave": wave, "status": Riding.FOUND if found else Riding.FORCE_OF_LOW_WAVE,
        "celerity": celerity, "celerity_froude": celerity / math.sqrt(GRAVITY * ship.hull.length),
        "force": force, "force_low": low, "mass": water.mass,
        "added_mass": water.mass * spheroid_surge(ship.hull.length, water.volume),
    }  # fmt: skip


_NOTHING: Final = dict.fromkeys(
    ("first_revolutions", "first_froude", "revolutions", "froude", "revolutions_exact", "froude_exact", "last_revolutions",
     "last_froude"), math.nan,
)  # fmt: skip


def _thresholds(ship: Ship, wave: Wave, facts: dict[str, Any], drive: Drive | None) -> dict[str, Any]:
    """Revolutions and Froude numbers of every threshold."""
    if drive is None:
        return dict(_NOTHING) | {"status": Riding.NO_PROPULSION, "source": "none"}
    density, driven = ship.loading.density, drive.propulsion
    found: Thresholds = surf_riding_thresholds(
        mass=facts["mass"], added_mass=facts["added_mass"], length=ship.hull.length, propulsion=driven,
        wave_length=wave.length, force=facts["force"], density=density,
    )  # fmt: skip
    celerity, unit = facts["celerity"], math.sqrt(GRAVITY * ship.hull.length)
    first = found.first_revolutions
    stopped = driven.thrust_terms(density)[2] * celerity**2 - driven.drag(celerity) + facts["force"] >= 0
    first = 0.0 if math.isnan(first) and stopped else first
    last = driven.revolutions(celerity, density, facts["force"])
    status = Riding.NO_SECOND_THRESHOLD if math.isnan(found.revolutions_exact) else facts["status"]
    return {
        "status": status, "source": drive.source,
        "first_revolutions": first, "first_froude": 0.0 if first == 0 else driven.speed(first, density) / unit,
        "revolutions": found.revolutions, "froude": found.froude,
        "revolutions_exact": found.revolutions_exact, "froude_exact": found.froude_exact,
        "last_revolutions": last, "last_froude": driven.speed(last, density) / unit,
    }  # fmt: skip


def kind_at(froude: float, first: float, second: float, celerity: float, last: float) -> Kind:
    """What becomes of a ship at a nominal Froude number, by those of the thresholds and of the wave.

    Examples
    --------
    >>> kind_at(0.3, 0.2, 0.35, 0.4, 0.5), kind_at(0.45, 0.2, 0.35, 0.4, 0.5)
    ('surf-riding from some starts', 'held by a wave it overtakes')
    """
    if math.isnan(froude) or math.isnan(first):
        return "not judged"
    if froude < first:
        return "periodic surging"
    if froude < min(second, celerity) if not math.isnan(second) else froude < celerity:
        return "surf-riding from some starts"
    if froude < celerity:
        return "surf-riding always"
    return "overtakes the wave" if froude > last else "held by a wave it overtakes"


def _kind(facts: dict[str, Any]) -> Kind:
    return kind_at(
        *(facts[k] for k in ("speed_froude", "first_froude", "froude_exact", "celerity_froude", "last_froude"))
    )


_KIND_WORDS: Final = {
    "periodic surging": "the wave overtakes it and it surges",
    "surf-riding from some starts": "the wave may hold it, depending on how it starts",
    "surf-riding always": "the wave catches it from any start",
    "held by a wave it overtakes": "it is faster than the wave in calm water, and the wave may hold it back",
    "overtakes the wave": "it is faster than the wave and passes it",
}


def _sentence(facts: dict[str, Any]) -> str:
    """The answer in words."""
    f, wave = facts, facts["wave"]
    where = f"{f['ship']} in a following sea, {wave.length:.4g} m long and {wave.height:.3g} m high"
    if f["status"] is Riding.NO_PROPULSION:
        return f"{where}: no answer; {f['status'].advice}."
    n, fn = f["first_revolutions"], f["first_froude"]
    first = f"from Fn {fn:.3g} ({n:.3g} 1/s)" if n > 0 else "even with its propeller stopped"
    second = (
        f"from Fn {f['froude_exact']:.3g} ({f['revolutions_exact']:.3g} 1/s; Melnikov {f['froude']:.3g}) every start is caught"
        if not math.isnan(f["froude_exact"])
        else f["status"].advice
    )
    at = "" if f["kind"] == "not judged" else f" At Fn {f['speed_froude']:.3g} {_KIND_WORDS[f['kind']]}."
    advised = f["status"] in (Riding.FORCE_OF_LOW_WAVE, Riding.FASTER_THAN_THE_WAVE)
    said = f" {f['status'].advice[0].upper()}{f['status'].advice[1:]}." if advised else ""
    driven = f" Resistance and thrust {f['source']}." if f["source"].startswith("estimated") else ""
    return (
        f"{where}, running at {f['celerity']:.3g} m/s (Fn {f['celerity_froude']:.3g}): surf-riding is possible {first}; "
        f"{second}.{at}{said}{driven}"
    )


_VARIABLES: Final = {
    "first": ("first_froude", "Froude number from which some starts are caught; 0: with a stopped propeller"),
    "second": ("froude_exact", "Froude number from which every start is caught"),
    "second_melnikov": ("froude", "the same by Melnikov's method"),
    "celerity": ("celerity_froude", "celerity of the wave as a Froude number of the ship"),
    "last": ("last_froude", "Froude number up to which the wave can hold the ship"),
}


@takes(ship="Ship", propulsion="Propulsion, None")
def surf_riding_map(
    ship: Ship,
    wave_length: float | str | Sequence[float | str],
    steepness: float | str | Sequence[float | str],
    propulsion: Propulsion | None = None,
) -> xr.Dataset:
    """Thresholds of surf-riding of a ship over wave length and steepness.

    Parameters
    ----------
    ship : Ship
    wave_length : float or (l,) float    [m]
    steepness : float or (s,) float      height over length, above 0 [1]
    propulsion : Propulsion              as for `surf_riding`

    Returns
    -------
    Dataset    over wave_length and steepness: Froude numbers ``first``, ``second``, ``second_melnikov``, ``celerity``,
               ``last``, and ``status`` (int8)

    Raises
    ------
    InputError    a number out of its range, a wave that breaks

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> ds = surf_riding_map(ship("wigley"), "1 L", [0.02, 0.05])
    >>> bool(ds.second[0, 0] > ds.second[0, 1] > ds["first"][0, 1])
    True
    """
    lengths = np.atleast_1d(numbers(ship, "wave_length", wave_length))
    steep = np.atleast_1d(numbers(ship, "steepness", steepness))
    shape = (lengths.size, steep.size)
    values = {name: np.full(shape, np.nan) for name in _VARIABLES}
    status = np.zeros(shape, np.int8)
    sources: set[str] = set()
    for i, length in enumerate(lengths):
        for j, one in enumerate(steep):
            found = surf_riding(ship, Wave(float(length), float(min(one, STEEPEST) * length)), propulsion)
            status[i, j] = found.status
            sources.add(found.source)
            for name, (attribute, _) in _VARIABLES.items():
                values[name][i, j] = getattr(found, attribute)
    dims = ("wave_length", "steepness")
    fields: dict[str, Any] = {
        name: (dims, values[name], {"units": "1", "long_name": meaning}) for name, (_, meaning) in _VARIABLES.items()
    }
    flags = np.array([one.value for one in Riding], np.int8)
    said = {"flag_values": flags, "flag_meanings": " ".join(one.name for one in Riding), "units": "1"}
    fields["status"] = (dims, status, said | {"long_name": "whether thresholds were found"})
    coords = {name: (name, array, attributes(name)) for name, array in (("wave_length", lengths), ("steepness", steep))}
    about = {
        "title": f"Surf-riding of {ship.name}", "ship": ship.name, "ship_length": ship.hull.length,
        "propulsion": "; ".join(sorted(sources)), "references": "Holtrop82 Holtrop84 Lamb32", "source": made_by(),
    }  # fmt: skip
    return xr.Dataset(fields, coords, about)
