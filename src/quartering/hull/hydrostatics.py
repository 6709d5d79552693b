"""Volume, centres and metacentre of a hull on even keel."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from quartering.conventions import WATER_DENSITY
from quartering.doors import takes
from quartering.hull.lines.hull import Hull
from quartering.hull.lines.immersed import strips

if TYPE_CHECKING:
    from quartering.hull.ship import Ship


@dataclass(frozen=True)
class Hydrostatics:
    """What a hull displaces, and where it acts.

    Parameters
    ----------
    volume : float              displaced volume [m3]
    mass : float                displaced mass [kg]
    displacement : float        the same [t]
    lcb, lcf : float            centres of buoyancy and flotation from midship, + forward [m]
    lcb_from_ap, lcf_from_ap : float    the same from the aft perpendicular, half a length aft of midship, + forward [m]
    kb, bm, km : float          centre of buoyancy over the baseline, metacentric radius, their sum [m]
    gm, kg : float              metacentric height and height of G [m]; nan for a bare hull, which has no G
    cb, cm, cp, cw : float      block, midship, prismatic and waterplane coefficient, on L, B and T [1]
    waterplane_area : float     [m2]
    wetted_surface : float      from the girths of the sections, without their slope along the ship [m2]
    bml, gml : float            longitudinal metacentric radius and height [m]; gml is nan for a bare hull
    tpc : float                 tonnes that sink the ship by a centimetre [t/cm]
    mct : float                 moment that trims it by a centimetre between perpendiculars [t m/cm]; nan for a bare hull
    """

    volume: float
    mass: float
    displacement: float
    lcb: float
    lcf: float
    lcb_from_ap: float
    lcf_from_ap: float
    kb: float
    bm: float
    km: float
    gm: float
    kg: float
    cb: float
    cm: float
    cp: float
    cw: float
    waterplane_area: float
    wetted_surface: float
    bml: float
    gml: float
    tpc: float
    mct: float


@takes(ship="Ship, Hull")
def hydrostatics(ship: Ship | Hull) -> Hydrostatics:
    """Hydrostatic particulars of a ship, or of its bare hull.

    Parameters
    ----------
    ship : Ship or Hull    a bare hull has no G: its ``gm`` and ``kg`` are nan, its mass is in sea water of 1025 kg/m3

    Returns
    -------
    Hydrostatics

    Notes
    -----
    volume = int A dx, KB = T - int int z dA dx / volume, BM = int (2/3) b^3 dx / volume, from the strips.
    CM is the area amidships (x = 0) over B T.  BML = int 2 b (x - LCF)^2 dx / volume, GML = KB + BML - KG,
    TPC = rho Aw / 1e5, MCT = displacement GML / (100 L).  Source: [Lewis88] ch. 2.  Valid: even keel, symmetric hull.

    Examples
    --------
    >>> from quartering.hull.lines.hull import box_hull
    >>> h = hydrostatics(box_hull(100.0, 20.0, 5.0, 10.0))
    >>> round(h.volume, 6), round(h.km, 6), round(h.cb, 6)
    (10000.0, 9.166667, 1.0)
    """
    if isinstance(ship, Hull):
        return _upright(ship, WATER_DENSITY, float("nan"))
    return _upright(ship.hull, ship.loading.density, ship.loading.kg)


@lru_cache(maxsize=256)
def _upright(hull: Hull, density: float, kg: float) -> Hydrostatics:
    """The hull's particulars in a water of a density [kg/m3], with G at a height [m]."""
    floating = _floating(hull)
    tonnes, gml = density * floating.volume / 1e3, floating.kb + floating.bml - kg
    return replace(
        floating, mass=density * floating.volume, displacement=tonnes, gm=floating.km - kg, kg=kg, gml=gml,
        tpc=density * floating.waterplane_area / 1e5, mct=tonnes * gml / (100 * hull.length),
    )  # fmt: skip


@lru_cache(maxsize=64)
def _floating(hull: Hull) -> Hydrostatics:
    """What follows from the hull alone, found once for it: neither mass nor G is known yet."""
    s = strips(hull)
    volume = float(s.weight @ s.area)
    moment = float(s.weight @ (-2 * (s.y * s.z * s.dz).sum(axis=1)))
    waterplane = float(s.weight @ (2 * s.half_breadth))
    kb = hull.draught - moment / volume
    bm = float(s.weight @ (2 / 3 * s.half_breadth**3)) / volume
    cb = volume / (hull.length * hull.beam * hull.draught)
    cm = float(np.interp(0.0, s.x, s.area)) / (hull.beam * hull.draught)
    unknown = float("nan")
    lcb = float(s.weight @ (s.x * s.area)) / volume
    lcf = float(s.weight @ (2 * s.x * s.half_breadth)) / waterplane
    return Hydrostatics(
        volume=volume,
        mass=unknown,
        displacement=unknown,
        lcb=lcb,
        lcf=lcf,
        lcb_from_ap=lcb + hull.length / 2,
        lcf_from_ap=lcf + hull.length / 2,
        kb=kb,
        bm=bm,
        km=kb + bm,
        gm=unknown,
        kg=unknown,
        cb=cb,
        cm=cm,
        cp=cb / cm,
        cw=waterplane / (hull.length * hull.beam),
        waterplane_area=waterplane,
        wetted_surface=float(s.weight @ (2 * np.hypot(s.dy, s.dz).sum(axis=1))),
        bml=float(s.weight @ (2 * s.half_breadth * (s.x - lcf) ** 2)) / volume,
        gml=unknown,
        tpc=unknown,
        mct=unknown,
    )
