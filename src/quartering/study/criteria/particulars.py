"""What the criteria ask of a ship: main particulars, volumes, waterplanes at other draughts, roll period, bilge keels."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from quartering.conventions import InputError
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.hull import at_draught
from quartering.hull.ship import Ship
from quartering.hydro.damping.natural_roll import free_roll
from quartering.study.criteria.constants import limit


class Particulars(NamedTuple):
    """A ship as the criteria see it.

    Parameters
    ----------
    ship : Ship
    base : Ship                             the same with G where the waves are balanced
    length, beam, draught, depth : float    [m]; the depth is that of the lowest deck edge
    volume, waterplane_area : float         [m3], [m2]
    kb, kg, gm : float                      [m]
    cb, cm : float                          block and midship coefficient [1]
    keel_area : float                       of both bilge keels [m2]
    keels_told : bool
    roll_period : float                     [s]
    speed : float                           service speed [m/s]; NaN: not known
    """

    ship: Ship
    base: Ship
    length: float
    beam: float
    draught: float
    depth: float
    volume: float
    waterplane_area: float
    kb: float
    kg: float
    gm: float
    cb: float
    cm: float
    keel_area: float
    keels_told: bool
    roll_period: float
    speed: float

    @property
    def raised(self) -> float:
        """Height of G over that of the base ship [m]."""
        return self.kg - self.base.loading.kg

    @property
    def froude(self) -> float:
        """Froude number of the service speed."""
        return self.speed / math.sqrt(limit("general.gravity") * self.length)

    @property
    def og(self) -> float:
        """Height of G over the waterline [m]."""
        return self.kg - self.draught

    @property
    def reserve_ratio(self) -> float:
        """Volume between waterline and deck over that of vertical sides [1]; at least 1 for a hull that flares."""
        top = _volume(self, self.depth)
        return (top - self.volume) / (self.waterplane_area * (self.depth - self.draught))

    def waterplane_inertia(self, draught: float) -> float:
        """Transverse second moment of the waterplane at a draught on even keel [m4]."""
        floating = hydrostatics(at_draught(self.ship.hull, draught))
        return floating.bm * floating.volume

    def keels_percent(self) -> float:
        """Area of the bilge keels in per cent of L B."""
        return 100 * self.keel_area / (self.length * self.beam)

    @property
    def keel_note(self) -> tuple[str, ...]:
        """What is assumed of the bilge keels."""
        return () if self.keels_told else ("no bilge keels told: none taken",)

    @property
    def depth_note(self) -> tuple[str, ...]:
        """What is assumed of the sides above the waterline."""
        assumed = self.ship.provenance.get("depth", "").startswith("assumed")
        return (f"the depth {self.depth:.4g} m of the sides, which the ship's file says is assumed",) if assumed else ()


def _volume(p: Particulars, draught: float) -> float:
    return hydrostatics(at_draught(p.ship.hull, draught)).volume


def particulars(ship: Ship, speed: float | None, roll_period: float | None, base: Ship | None = None) -> Particulars:
    """What the criteria ask of a ship; ``base`` is the same ship with another height of G."""
    hull, floating = ship.hull, hydrostatics(ship)
    if hull.depth <= hull.draught * (1 + 1e-9):
        raise InputError(
            f"{ship.name}: the lowest deck edge is {hull.depth:.4g} m high and the draught {hull.draught:.4g} m: no freeboard, "
            "no criterion applies; give the sides above the waterline (depth:), or a smaller draught"
        )
    keels, area = ship.value("bilge_keels"), ship.value("bilge_keel_area")
    if area is None and keels is not None:
        area = 2 * keels[0] * keels[1]
    own = 2 * math.pi / free_roll(ship).frequency
    return Particulars(
        ship=ship, base=base or ship,
        length=hull.length, beam=hull.beam, draught=hull.draught, depth=hull.depth, volume=floating.volume,
        waterplane_area=floating.waterplane_area, kb=floating.kb, kg=ship.loading.kg, gm=ship.loading.gm, cb=floating.cb,
        cm=float(np.clip(floating.cm, 0.0, 1.0)), keel_area=area or 0.0, keels_told=area is not None,
        roll_period=own if roll_period is None else roll_period, speed=math.nan if speed is None else speed,
    )  # fmt: skip
