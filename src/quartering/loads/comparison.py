"""Wave forces in several forms side by side, and how far they are apart."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final, get_args

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import HEADING_CONVENTION, MODES, REFERENCE_POINT, SYMBOLS, InputError
from quartering.doors import takes
from quartering.hull.ship import Ship
from quartering.hull.told import number, numbers
from quartering.loads.forces import FORMS, Form, keeps_speed_terms, relative_phasors
from quartering.loads.source import WaveForces, wave_source
from quartering.loads.validity import conditions_held, warn_of_conditions, warn_outside_database
from quartering.loads.waves import Floats, Phasors

if TYPE_CHECKING:
    import xarray as xr

PRESSURE_ALONE: Final = "froude-krylov"
PANELS: Final = "bem"
OWN: Final = "database"
MEASURE: Final = "stf"
MEANINGS: Final[dict[str, str]] = {
    PRESSURE_ALONE: "pressure of the undisturbed wave alone, no diffraction",
    **FORMS,
    PANELS: "three-dimensional panels (Capytaine) at zero speed",
    OWN: "the ship's own database, or its panels, at zero speed, with the ship's terms of speed",
}
"""Form of the wave force -> what it is."""
MOST_CONDITIONS: Final = 100_000
"""Largest comparison, wave lengths times headings: some 1 GB at work."""


@takes(ship="Ship", bem="Dataset, None")
def compare_forces(
    ship: Ship,
    wave_lengths: ArrayLike,
    headings: ArrayLike,
    speed: float | str = 0.0,
    *,
    bem: xr.Dataset | None = None,
) -> xr.Dataset:
    """Wave forces on a ship in every form, and their differences from strip theory with contour potentials.

    Parameters
    ----------
    ship : Ship
    wave_lengths : (n,) float    lambda > 0 [m]
    headings : (h,) float        mu: 0 following, 90 beam (wave from port to starboard), 180 head [deg]
    speed : float                U >= 0 [m/s]
    bem : Dataset                of `bem_forces` for the same ship, wave lengths and headings; None leaves panels out

    Returns
    -------
    Dataset    force (form, wave_length, heading, part, mode), amplitude (form, wave_length, heading, mode) per metre of
               wave amplitude [N/m; N m/m about G]; difference (form, wave_length, heading, mode) and
               largest_difference (form, wave_length, mode): modulus of the difference from "stf", over the largest force
               of "stf" at any heading in that wave and mode [1]; forms "froude-krylov", "paper", "paper-corrected",
               "relative-motion", "stf", "bem", and "database" for a ship with its own or with panels (NaN where that does
               not hold the condition)

    Raises
    ------
    InputError    a wave length not positive, a speed that is negative or, with panels, not zero, panels of other waves,
                  more than `MOST_CONDITIONS`

    Notes
    -----
    The differences count phase as well as size.  All forms but "froude-krylov" and "paper" hold the lift of the ship in
    moving water, see `wave_forces`.
    Source: [H71] eqs. (B-3)-(B-11), Figs. 2-4; [STF70] exciting force; [Ancellin19].  Valid: deep water, linear wave.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> found = compare_forces(ship("wigley"), [100.0, 200.0], [30.0, 90.0])
    >>> found.force.dims, float(found.largest_difference.sel(form="stf").max())
    (('form', 'wave_length', 'heading', 'part', 'mode'), 0.0)
    """
    speed = number(ship, "speed", speed)
    wave_lengths, headings = numbers(ship, "wave_length", wave_lengths), numbers(ship, "heading", headings)
    length, mu = (np.atleast_1d(np.asarray(v, dtype=float)) for v in (wave_lengths, headings))
    if length.ndim != 1 or not (np.isfinite(length).all() and (length > 0).all()):
        raise InputError(f"wave_lengths {wave_lengths!r} must be a list of lengths above 0 m")
    if mu.ndim != 1 or np.ndim(speed):
        raise InputError("headings must be one list [deg] and speed one number [m/s]")
    if length.size * mu.size > MOST_CONDITIONS:
        raise InputError(
            f"{length.size:,} wave lengths and {mu.size} headings are {length.size * mu.size:,} conditions; a comparison takes "
            f"up to {MOST_CONDITIONS:,}: take fewer wave lengths"
        )
    warn_of_conditions(ship, speed, length)
    force, omega = _strip_forces(ship, length, mu, speed)
    own = wave_source(ship)
    if own.source is not None:
        force[OWN] = _own_forces(ship, own, length, mu, speed)
    if bem is not None:
        force[PANELS] = _panel_forces(bem, length, mu, speed)
    _add_lift(force, ship, length, mu, speed)
    made = _dataset(ship, length, mu, speed, force, omega)
    return made if bem is None else made.assign_attrs(panels=str(bem.attrs.get("method", "of unknown make")))


def _strip_forces(ship: Ship, length: Floats, mu: Floats, speed: float) -> tuple[dict[str, Phasors], Floats]:
    """Phasors (n, h, 3) of every form of strip theory, and the encounter frequencies (n, h)."""
    shape, speed_terms = (length.size, mu.size), keeps_speed_terms(ship)
    k, heading = (v.ravel() for v in np.meshgrid(2 * np.pi / length, mu, indexing="ij"))
    u = np.full(k.size, float(speed))
    force: dict[str, Phasors] = {}
    for form in get_args(Form):
        pressure, scattered, omega = wave_source(ship, form, "strips").phasors(k, u, heading, speed_terms)
        force.setdefault(PRESSURE_ALONE, pressure.reshape(*shape, 3))
        force[form] = (pressure + scattered).reshape(*shape, 3)
    return force, omega.reshape(shape)


def _add_lift(force: dict[str, Phasors], ship: Ship, length: Floats, mu: Floats, speed: float) -> None:
    """Add the force of lift and measured added mass in moving water to every form but the paper's."""
    k, heading = (v.ravel() for v in np.meshgrid(2 * np.pi / length, mu, indexing="ij"))
    u = np.full(k.size, float(speed))
    # lift is what the potential flow lacks: a database or panels have no part in it, and need not hold the condition
    lift = relative_phasors(replace(ship, database=None, hydrodynamics="strips"), k, u, heading)
    for form in set(force) - {PRESSURE_ALONE, "paper"}:
        force[form] = force[form] + lift.reshape(length.size, mu.size, 3)


def _own_forces(ship: Ship, own: WaveForces, length: Floats, mu: Floats, speed: float) -> Phasors:
    """Phasors (n, h, 3) of the ship's own database, NaN where it does not hold them."""
    k, heading = (v.ravel() for v in np.meshgrid(2 * np.pi / length, mu, indexing="ij"))
    u = np.full(k.size, float(speed))
    held = conditions_held(ship, k, u, heading)
    force = np.full((k.size, 3), np.nan + 0j)
    if held.any():
        force[held] = sum(own.phasors(k[held], u[held], heading[held], keeps_speed_terms(ship))[:2])
    warn_outside_database(ship, int((~held).sum()), held.size)
    return force.reshape(length.size, mu.size, 3)


def _panel_forces(bem: xr.Dataset, length: Floats, mu: Floats, speed: float) -> Phasors:
    """Phasors (n, h, 3) of the panels, refused when they are not of these waves."""
    if speed != 0:
        raise InputError(f"speed {speed} m/s: the panels are at zero speed; compare at speed 0, or leave bem out")
    for name, wanted in (("wave_length", length), ("heading", mu)):
        given = np.atleast_1d(bem[name].to_numpy()) if name in bem.coords else np.zeros(0)
        if given.shape != wanted.shape or not np.allclose(given, wanted, rtol=1e-9):
            raise InputError(
                f"the panels have {name} {given.tolist()}, the comparison {wanted.tolist()}; give bem_forces the same"
            )
    values = bem["total"].transpose("wave_length", "heading", "part", "mode").to_numpy()
    return np.asarray(values[:, :, 0] - 1j * values[:, :, 1])


def _dataset(
    ship: Ship, length: Floats, mu: Floats, speed: float, force: dict[str, Phasors], omega: Floats
) -> xr.Dataset:
    import xarray as xr

    names = [name for name in MEANINGS if name in force]
    phasor = np.stack([force[name] for name in names])
    largest = np.abs(force[MEASURE]).max(axis=1, keepdims=True)
    apart = np.abs(phasor - force[MEASURE])
    share = np.divide(apart, largest, out=np.zeros_like(apart), where=np.broadcast_to(largest > 0, apart.shape))
    where, unit = ("form", "wave_length", "heading"), "N/m (sway), N m/m (roll, yaw)"
    words = "wave force and moments per metre of wave amplitude"
    over = "difference from stf over its largest at any heading"
    fields: dict[str, Any] = {
        "force": (
            (*where, "part", "mode"), np.stack([phasor.real, -phasor.imag], axis=-2),
            {"units": unit, "symbol": "Y, K, N", "long_name": words},
        ),
        "amplitude": ((*where, "mode"), np.abs(phasor), {"units": unit, "symbol": "|Y|, |K|, |N|", "long_name": words}),
        "difference": ((*where, "mode"), share, {"units": "1", "symbol": "", "long_name": over}),
        "largest_difference": (
            ("form", "wave_length", "mode"), np.fmax.reduce(share, axis=2),
            {"units": "1", "symbol": "", "long_name": f"largest {over}"},
        ),
        "encounter_frequency": (
            where[1:], omega, dict(zip(("symbol", "units", "long_name"), SYMBOLS["encounter_frequency"], strict=True)),
        ),
    }  # fmt: skip
    coords = {
        "form": names, "wave_length": ("wave_length", length, {"units": "m", "symbol": "lambda"}),
        "heading": ("heading", mu, {"units": "deg", "symbol": "mu", "long_name": "heading to the waves"}),
        "part": ["cos", "sin"], "mode": list(MODES), "unit": ("mode", ["N", "N m", "N m"]),
        "ratio": ("wave_length", length / ship.hull.length, {"units": "1", "long_name": "wave length over ship length"}),
        "meaning": ("form", [MEANINGS[name] for name in names]),
    }  # fmt: skip
    references = [*wave_source(ship, MEASURE, "strips").references, *(["Ancellin19"] if PANELS in force else [])]
    references += wave_source(ship).references if OWN in force else ()
    return xr.Dataset(fields, coords=coords).assign_attrs(
        axes="body axes: x to the bow, y to starboard, z down; modes sway, roll, yaw",
        ship=ship.name, speed=float(speed), reference_point=REFERENCE_POINT, heading_convention=HEADING_CONVENTION,
        signal="cos cos(|omega| t) + sin sin(|omega| t); at t = 0 the surface at G passes its mean level going down",
        ends=ship.hull.ends, velocities=ship.velocities,
        references=", ".join(dict.fromkeys(references)),
    )  # fmt: skip
