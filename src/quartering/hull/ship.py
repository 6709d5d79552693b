"""A ship: its lines, its loading, and the coefficients given for it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import Literal

from quartering.conventions import InputError
from quartering.hull.autopilot import Autopilot, Rudder
from quartering.hull.choices import (
    Ends,
    Linear,
    Righting,
    Sections,
    Velocities,
    checked_ends,
    checked_linear,
    checked_righting,
    checked_sections,
    checked_velocities,
)
from quartering.hull.loading import Loading, reloaded
from quartering.hull.offsets import Hull, at_draught
from quartering.hull.own_database import Database, database_of
from quartering.hull.own_measured import MeasuredFile, measured_source
from quartering.hull.roll_method import BilgeKeels, RollMethod, checked_bilge_keels, roll_damping_note, roll_method
from quartering.hull.units import quantity
from quartering.names import checked_values

__all__ = [
    "DRAG_COEFFICIENT",
    "Loading",
    "Ship",
    "ship",
]

DRAG_COEFFICIENT = 0.8
"""Cross-flow drag coefficient when none is given (assumed)."""


@dataclass(frozen=True, eq=False)
class Ship:
    """A ship ready for computation; nothing in it changes, ``with_`` returns another one.

    Parameters
    ----------
    name : str
    hull : Hull
    loading : Loading
    overrides : mapping of str to float      coefficients given in SI about G by SNAME name; they replace estimates
    multipliers : mapping of str to float    factors on coefficients by name
    linear : str                             "default" (lift from regression) or "strip" for the sway-yaw derivatives
    drag_coefficient : float                 of the cross-flow [1]
    velocity_scale : float or None           velocity at which the cross-flow drag is made cubic [m/s]; None: as documented
    provenance : mapping of str to str       for each value: published, derived, assumed or given, and its source
    measured : str, MeasuredFile or None     measured manoeuvring set that replaces regression and cross-flow: name or file
    autopilot : Autopilot or None            what keeps the course; None: the rudder amidships, as in the paper
    rudder : Rudder or None                  what its lift is estimated from; None: measured with the set, or least by rule
    righting : str                           the righting curve as "polynomial" (odd, to phi^7) or "spline" (through the curve)
    roll_method : str                        "fraction" (of critical), "ikeda" or "ikeda-simplified"
    bilge_keels : (float, float) or None     length and breadth of one of the pair [m]
    database : Database or None              own coefficients and wave forces in place of strip theory
    velocities : str                         lift acts on the velocity "relative" to the water, or "absolute", as in the paper
    """

    name: str
    hull: Hull
    loading: Loading
    overrides: Mapping[str, float] = field(default_factory=dict)
    multipliers: Mapping[str, float] = field(default_factory=dict)
    linear: Linear = "default"
    drag_coefficient: float = DRAG_COEFFICIENT
    velocity_scale: float | None = None
    provenance: Mapping[str, str] = field(default_factory=dict)
    measured: str | MeasuredFile | None = None
    autopilot: Autopilot | None = None
    rudder: Rudder | None = None
    righting: Righting = "polynomial"
    roll_method: RollMethod = "fraction"
    bilge_keels: BilgeKeels | None = None
    database: Database | None = None
    velocities: Velocities = "relative"

    def __post_init__(self) -> None:
        for mapping in ("overrides", "multipliers", "provenance"):
            object.__setattr__(self, mapping, MappingProxyType(dict(getattr(self, mapping))))

    def with_(
        self,
        *,
        gm: float | str | None = None,
        kg: float | str | None = None,
        gyradius_roll: float | str | None = None,
        gyradius_yaw: float | str | None = None,
        draught: float | str | None = None,
        roll_damping: float | str | None = None,
        linear: Linear | None = None,
        sections: Sections | None = None,
        ends: Ends | None = None,
        coefficients: Mapping[str, float] | None = None,
        measured: str | Path | None = None,
        autopilot: Autopilot | Literal["none"] | None = None,
        righting: Righting | None = None,
        bilge_keels: tuple[float | str, float | str] | None = None,
        database: Database | str | Path | None = None,
        velocities: Velocities | None = None,
    ) -> Ship:
        """The same ship with some values changed.

        Parameters
        ----------
        gm, kg : float or str                          one of the two; the other follows from KM [m, or "0.05 B"]
        gyradius_roll, gyradius_yaw : float or str     [m, or "0.38 B"]
        draught : float or str                         another waterline of the same lines; G stays unless given [m]
        roll_damping : float or str                    fraction of critical, 0 or more; or "ikeda", "ikeda-simplified"
        linear : str                                   "default" or "strip"
        sections : str                                 how section coefficients are found: "auto", "lewis" or "close-fit"
        ends : str                                     "strips", or "three-dimensional": with the water's way round them
        coefficients : mapping of str to float         factors by name, times those already there
        measured : str or Path                         measured manoeuvring set, by name or file; "none" goes without
        autopilot : Autopilot                          that keeps the course; "none" goes without
        righting : str                                 "polynomial" or "spline"
        bilge_keels : (float or str, float or str)     length and breadth of one of the pair, for "ikeda" [m]; (0, 0): none
        database : Database, str or Path               own coefficients and wave forces: a file; "none" goes without
        velocities : str                               "relative" (to the water) or "absolute" (the paper's equations)

        Returns
        -------
        Ship

        Raises
        ------
        InputError    GM not above 0, a radius not above 0, draught outside the lines, unknown coefficient name or choice, NaN

        Notes
        -----
        KG = KM - GM.  Source: [Lewis88] ch. 2.

        Examples
        --------
        >>> stiff = ship("series60-cb60").with_(gm=1.2, gyradius_roll="0.38 B", coefficients={"K_ppp": 0.5})
        >>> stiff.loading.gm, round(stiff.loading.gyradius_roll, 4), stiff.multipliers["K_ppp"]
        (1.2, 6.1773, 0.5)
        """
        hull = self.hull if draught is None else at_draught(self.hull, self._length("draught", draught))
        if self.database is not None and database is None and not math.isclose(hull.draught, self.hull.draught):
            raise InputError(
                f"{self.name}: {self.database.name} is of draught {self.hull.draught:g} m, and {hull.draught:g} m is asked "
                'for; give the database of that draught too, or database="none"'
            )
        if sections is not None:
            hull = replace(hull, section_method=checked_sections(self.name, sections))
        own_database = self.database if database is None else _database(self.name, database)
        called = None if own_database is None else own_database.name
        chosen = checked_ends(self.name, ends or hull.ends, called)
        if chosen != hull.ends:  # the same hull is solved once
            hull = replace(hull, ends=chosen)
        given = {"gm": gm, "kg": kg, "gyradius_roll": gyradius_roll, "gyradius_yaw": gyradius_yaw}
        lengths = {key: self._length(key, value) for key, value in given.items() if value is not None}
        loading = reloaded(self.name, hull, self.loading, roll_damping=roll_damping, **lengths)
        method = self.roll_method if roll_damping is None else roll_method(roll_damping)
        keels = self.bilge_keels
        if bilge_keels is not None:
            length, breadth = (self._length("bilge_keels", value) for value in bilge_keels)
            keels = checked_bilge_keels(self.name, hull.length, hull.beam, (length, breadth))
        notes = self._changes(loading, {*lengths, "roll_damping"}) | self._change_of_damping(method, keels)
        return replace(
            self,
            hull=hull,
            loading=loading,
            linear=checked_linear(self.name, linear or self.linear),
            multipliers=_multiplied(self.multipliers, checked_values(self.name, coefficients or {})),
            provenance={**self.provenance, **notes},
            measured=self.measured if measured is None else None if measured == "none" else measured_source(measured),
            autopilot=self.autopilot if autopilot is None else None if autopilot == "none" else autopilot,
            righting=checked_righting(self.name, righting or self.righting),
            roll_method=method,
            bilge_keels=keels,
            database=own_database,
            velocities=checked_velocities(self.name, velocities or self.velocities),
        )

    @property
    def radiation_words(self) -> str:
        """Where added mass, wave damping and wave forces come from, in words."""
        strips = "the strips" if self.hull.ends == "strips" else "the strips with three-dimensional ends"
        return strips if self.database is None else self.database.name

    @property
    def roll_damping_words(self) -> str:
        """The added roll damping in words."""
        if self.roll_method == "fraction":
            return f"{self.loading.roll_damping:.3g} of critical"
        return roll_damping_note(self.roll_method, self.bilge_keels).partition(": ")[2]

    def _changes(self, loading: Loading, given: set[str]) -> dict[str, str]:
        """What to say of the values in which another loading differs, given ones and those that follow."""
        keys = ("gm", "kg", "gyradius_roll", "gyradius_yaw", "roll_damping")
        changed = [key for key in keys if not math.isclose(getattr(self.loading, key), getattr(loading, key))]
        return {key: f"{'given' if key in given else 'derived'}: changed from the ship's own" for key in changed}

    def _change_of_damping(self, method: RollMethod, keels: BilgeKeels | None) -> dict[str, str]:
        """What to say of roll damping by another method, or with other keels."""
        if method != "fraction" and (method, keels) != (self.roll_method, self.bilge_keels):
            return {"roll_damping": roll_damping_note(method, keels)}
        return {"roll_damping": "given: changed from the ship's own"} if method != self.roll_method else {}

    def _length(self, key: str, value: float | str) -> float:
        hull = self.hull
        return quantity(
            value, "length", length=hull.length, beam=hull.beam, draught=hull.draught, what=f"{self.name}: {key}"
        )


def _database(name: str, given: Database | str | Path) -> Database | None:
    if isinstance(given, Database):
        return given
    return None if given == "none" else database_of(given, name)


def _multiplied(own: Mapping[str, float], factors: Mapping[str, float]) -> dict[str, float]:
    """Multipliers after further ones: a factor of 1 changes nothing."""
    return dict(own) | {name: factor * own.get(name, 1.0) for name, factor in factors.items()}


def ship(name_or_path: str | Path) -> Ship:
    """Read a ship: a built-in one by name, or one's own from a YAML file.

    Parameters
    ----------
    name_or_path : str or Path    such as "series60-cb60", or the path of a ship file

    Returns
    -------
    Ship

    Raises
    ------
    InputError    no such ship or file, or something in the file that cannot be right, named by key

    Notes
    -----
    Source: each built-in ship names its own in ``provenance``.

    Examples
    --------
    >>> ship("series60-cb60").hull.length
    121.92
    """
    from quartering.hull.readers import read_ship  # pydantic and yaml are loaded only when a ship is read

    return read_ship(name_or_path)
