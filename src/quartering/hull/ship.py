"""A ship: its lines, its loading, and the coefficients given for it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Unpack

from quartering.hull.autopilot import Autopilot, Rudder
from quartering.hull.changes import changed
from quartering.hull.lines.hull import Hull
from quartering.hull.loading import Loading
from quartering.hull.option_types import Drag, Hydrodynamics, Linear, Righting, ShipOptions, Velocities
from quartering.hull.roll_method import BilgeKeels, RollMethod, roll_damping_note
from quartering.hull.user_database import Database
from quartering.hull.user_measured import MeasuredFile
from quartering.notebook import ShownInNotebooks
from quartering.option_checks import checked
from quartering.options import OPTIONS, described, option, signature
from quartering.units import Sizes

__all__ = [
    "DRAG_COEFFICIENT",
    "Loading",
    "Ship",
]

DRAG_COEFFICIENT = 0.8
"""Cross-flow drag coefficient when none is given (assumed)."""


@dataclass(frozen=True, eq=False)
class Ship(ShownInNotebooks):
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
    righting : str                           the righting curve as "spline" (the curve itself) or "polynomial" (odd, to phi^7)
    roll_method : str                        "fraction" (of critical), "ikeda" or "ikeda-simplified"
    bilge_keels : (float, float) or None     length and breadth of one of the pair [m]
    database : Database or None              own coefficients and wave forces in place of strip theory
    hydrodynamics : str                      without a database, those of "strips" or of "panels"
    drag : str                               of the cross-flow: "strips", or "cubic" coefficients
    velocities : str                         lift acts on the velocity "relative" to the water, or "absolute", as in the paper
    particulars : mapping of str to value    what else is known of it, by option: depth, openings, windage, ..
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
    righting: Righting = "spline"
    roll_method: RollMethod = "fraction"
    bilge_keels: BilgeKeels | None = None
    database: Database | None = None
    velocities: Velocities = "relative"
    drag: Drag = "strips"
    hydrodynamics: Hydrodynamics = "strips"
    particulars: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for mapping in ("overrides", "multipliers", "provenance", "particulars"):
            object.__setattr__(self, mapping, MappingProxyType(dict(getattr(self, mapping))))

    def with_(self, **given: Unpack[ShipOptions]) -> Ship:
        """The same ship with some options changed.

        Numbers are SI and degrees, or text with a unit: "5.1 m", "0.38 B", "15kn".  What is not given stays.

        Parameters
        ----------
        **given    options of `quartering.options`, as `ShipOptions` lists them

        Returns
        -------
        Ship

        Raises
        ------
        InputError    an unknown option, a value out of its range: what was given, the range, what to try

        Notes
        -----
        KG = KM - GM.  ``factors`` multiply, and times those already there; ``values`` give, in place of an estimate and of
        factors given before.  Source: [Lewis88] ch. 2.

        Examples
        --------
        >>> from quartering.hull.file.read import ship
        >>> stiff = ship("series60-cb60").with_(gm=1.2, gyradius_roll="0.38 B", factors={"K_p": 0.5})
        >>> stiff.loading.gm, round(stiff.loading.gyradius_roll, 4), stiff.multipliers["K_p"]
        (1.2, 6.1773, 0.5)
        """
        return changed(self, given)

    @property
    def sizes(self) -> Sizes:
        """What L, B and T stand for [m]."""
        return Sizes(self.hull.length, self.hull.beam, self.hull.draught)

    def value(self, name: str) -> Any:
        """What the ship has for an option.

        Parameters
        ----------
        name : str    of `quartering.options`

        Returns
        -------
        float, str or record    in SI or degrees; the default of an option that was not given, None where there is none

        Raises
        ------
        InputError    no such option

        Examples
        --------
        >>> from quartering.hull.file.read import ship
        >>> box = ship("box").with_(openings="40 deg")
        >>> box.value("openings"), box.value("gyradius_pitch"), box.value("draught"), box.value("windage")
        (40.0, 25.0, 5.0, None)
        """
        one = option(name)
        if one.group:
            whole = self.value(one.group)
            if whole is None or isinstance(whole, str):
                return None
            key = one.path[-1]
            if isinstance(whole, tuple):
                return whole[[other.name for other in OPTIONS.values() if other.group == one.group].index(name)]
            return whole[key] if isinstance(whole, Mapping) else getattr(whole, key)
        if one.home:
            found: Any = self
            for part in one.home.split("."):
                found = getattr(found, part)
            return found
        if name in self.particulars:
            return self.particulars[name]
        return None if one.default is None else checked(one, one.default, self.name, self.sizes)

    @property
    def damped_by_components(self) -> bool:
        """Does its added roll damping come from a component method, not from a fraction of critical?"""
        return self.roll_method != "fraction"

    @property
    def roll_damping_words(self) -> str:
        """The added roll damping in words."""
        if not self.damped_by_components:
            return f"{self.loading.roll_damping:.3g} of critical"
        return roll_damping_note(self.roll_method, self.bilge_keels).partition(": ")[2]

    def __repr__(self) -> str:
        """Name, size and loading in a line."""
        hull, load = self.hull, self.loading
        return f"<Ship {self.name}: L {hull.length:.5g} B {hull.beam:.4g} T {hull.draught:.4g} m, GM {load.gm:.4g} m>"


Ship.with_.__signature__ = signature()  # type: ignore[attr-defined]
Ship.with_.__doc__ = described(Ship.with_.__doc__)
