"""Strip theory in all six modes for one ship over frequency, at one speed about one point."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import InputError
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.immersed import strips
from quartering.hull.lines.section import Floats
from quartering.hull.lines.strips import has_transom
from quartering.hull.ship import Ship
from quartering.hull.told import number, numbers
from quartering.hydro.strip.heave import heave_sections
from quartering.hydro.strip.hull_table import end_method, hull_table, section_references, section_words
from quartering.hydro.strip.lateral import frequency_floor
from quartering.hydro.strip.six_mode_matrices import seakeeping_axes, section_matrix, six_mode_matrices
from quartering.hydro.strip.surge import spheroid_surge

if TYPE_CHECKING:
    import xarray as xr

SIX_MODES: Final = ("surge", "sway", "heave", "roll", "pitch", "yaw")
"""Modes in body axes: x to the bow, y to starboard, z down; pitch positive bow up."""

Reference = Literal["G", "waterline"]
Axes = Literal["body", "seakeeping"]
Terms = Literal["cap", "drop"]
Sections = tuple[Floats, Floats]


def by_strips(
    ship: Ship,
    frequency: ArrayLike,
    speed: float | str = 0.0,
    reference: Reference | tuple[float, float] = "G",
    low_frequency: Terms = "cap",
    axes: Axes = "body",
    surge: Literal["spheroid", "zero"] = "spheroid",
) -> xr.Dataset:
    """What `hydrodynamics6` gives, whatever else the ship has."""
    speed = number(ship, "speed", speed)
    omega = np.atleast_1d(numbers(ship, "signed_frequency", frequency))
    _check(omega, low_frequency, axes, surge)
    hull, density, immersed = ship.hull, ship.loading.density, strips(ship.hull)
    x_o, depth, said = _reference_point(ship, reference)
    ascending, back = np.unique(np.abs(omega), return_inverse=True)
    table = hull_table(hull, ascending, density)
    heave = heave_sections(immersed, table)
    a, b = section_matrix(table.a, heave.a)[back], section_matrix(table.b, heave.b)[back]
    zero = section_matrix(table.a_zero, np.zeros(table.a_zero.shape[0]))  # heave grows there: filled in later
    edge = np.stack([zero, section_matrix(table.a_infinite, heave.a_infinite)])
    place = immersed.x - x_o, immersed.weight
    x_aft = hull.x_aft - x_o if has_transom(immersed) else None
    floor = frequency_floor(hull.beam) if low_frequency == "cap" else np.inf
    added, damping = six_mode_matrices(*place, a, b, speed, omega, depth=depth, x_aft=x_aft, floor=floor)
    ends = six_mode_matrices(*place, edge, 0 * edge, speed, [0.0, np.inf], depth=depth, x_aft=x_aft)
    along = _surge_matrix(ship, depth) if surge == "spheroid" else np.zeros((6, 6))
    added, ends = added + along, (ends[0] + along, ends[1])
    if axes == "seakeeping":
        added, damping = seakeeping_axes(added, damping, speed, np.maximum(np.abs(omega), floor))
        ends = seakeeping_axes(*ends, speed, np.full(2, np.inf))
    growth = section_matrix(np.zeros((1, immersed.x.size, 3)), immersed.half_breadth[None] ** 2)
    grows = six_mode_matrices(*place, growth, 0 * growth, speed, [np.inf], depth=depth, x_aft=x_aft)
    dataset = _dataset(omega, added, damping, _without_limit(ends, grows))
    if axes == "seakeeping":
        dataset = dataset.drop_vars(["added_mass_zero", "damping_zero"])
    by_ends = end_method(hull)
    said_ends = f"; sway, roll, yaw {by_ends.words}" if by_ends.words else ""
    return dataset.assign_attrs(
        ship=ship.name, speed=float(speed), reference_point=said, surge=surge, density=density,
        axes=f"{axes} axes: x to the bow, y to starboard, z down; pitch positive bow up",
        method=f"strip theory, {section_words(hull)}{said_ends}; low frequencies: {low_frequency}",
        references=", ".join(["STF70", *section_references(hull), "Lamb32", *by_ends.references]),
    )  # fmt: skip


def _check(omega: Floats, low_frequency: str, axes: str, surge: str) -> None:
    if omega.ndim != 1 or not (omega != 0).all():
        raise InputError(
            "frequency must be one list of numbers, none of them 0 rad/s; the dataset holds the limits at zero and "
            "infinite frequency beside it"
        )
    for name, value, allowed in (
        ("low_frequency", low_frequency, get_args(Terms)),
        ("axes", axes, get_args(Axes)),
        ("surge", surge, ("spheroid", "zero")),
    ):
        if value not in allowed:
            raise InputError(f'{name} "{value}" is unknown; allowed: {", ".join(allowed)}')


def _reference_point(ship: Ship, reference: Reference | tuple[float, float]) -> tuple[float, float, str]:
    """The point's x from midship, the depth of the calm plane below it, and what to call it."""
    lcb, z0 = hydrostatics(ship).lcb, ship.loading.kg - ship.hull.draught
    if reference == "G":
        return lcb, z0, "centre of gravity G"
    if reference == "waterline":
        return lcb, 0.0, "calm plane over G"
    if not isinstance(reference, (tuple, list, np.ndarray)) or len(reference) != 2:
        raise InputError(
            f'reference {reference!r} is not a point; allowed: "G", "waterline" or (x forward of midship, z below the '
            "calm plane) in metres"
        )
    point = number(ship, "reference_x", reference[0]), number(ship, "reference_z", reference[1])
    return point[0], -point[1], f"{point[0]:g} m forward of midship, {point[1]:g} m below the calm plane"


def _surge_matrix(ship: Ship, depth: float) -> Floats:
    """Added mass in surge with its moment, the force at the height of the centre of buoyancy."""
    water = hydrostatics(ship)
    mass = spheroid_surge(ship.hull.length, water.volume) * ship.loading.density * water.volume
    lever = np.zeros(6)
    lever[0], lever[4] = 1.0, depth + ship.hull.draught - water.kb  # u + z q at z below the reference point
    return np.asarray(mass * np.outer(lever, lever))


def _without_limit(ends: Sections, growth: Sections) -> Sections:
    """Infinite entries at zero frequency where the growing heave added mass of the sections does not cancel."""
    filled = []
    for values, share in zip(ends, growth, strict=True):
        scale = np.sqrt(np.abs(np.outer(share[0].diagonal(), share[0].diagonal())))
        grows = np.abs(share[0]) > np.maximum(1e-9 * scale, 1e-12 * np.abs(share[0]).max())
        out = values.copy()
        out[0] = np.where(grows, np.copysign(np.inf, share[0]), values[0])
        filled.append(out)
    return filled[0], filled[1]


def _dataset(omega: Floats, added: Floats, damping: Floats, ends: Sections) -> xr.Dataset:
    import xarray as xr

    matrix = ("mode", "mode_of_motion")
    units = "SI: kg, kg m, kg m2 (over s for damping) between forces [N, N m] and velocities [m/s, rad/s]"
    fields: dict[str, Any] = {}
    for name, letter, values, limits in (
        ("added_mass", "A", added, ends[0]), ("damping", "B", damping, ends[1]),
    ):  # fmt: skip
        words = name.replace("_", " ")
        fields[name] = (("frequency", *matrix), values, {"units": units, "symbol": letter, "long_name": words})
        for k, limit in enumerate(("zero", "infinite")):
            text = f"{words} at {limit} frequency"
            fields[f"{name}_{limit}"] = (matrix, limits[k], {"units": units, "symbol": letter, "long_name": text})
    axis = ("frequency", omega, {"units": "rad/s", "symbol": "omega", "long_name": "encounter frequency"})
    modes = list(SIX_MODES)
    return xr.Dataset(fields, coords={"frequency": axis, "mode": modes, "mode_of_motion": modes})
