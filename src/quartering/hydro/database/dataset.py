"""Coefficients and wave forces of another code, read into our axes and written out of them.

Both codes have x to the bow, y to port, z up from the calm plane, and count the direction the wave runs towards from x to
y; Capytaine's phasors belong to e^{-i omega t}, WAMIT's to e^{+i omega t}. Ours: see
`moved_to_point`; moments about G, e^{+i omega t}.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from quartering.conventions import GRAVITY, HEADING_CONVENTION, MODES, REFERENCE_POINT, InputError
from quartering.doors import takes
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.database.about_point import HALF_TURN, incident, moved_to_point
from quartering.hydro.database.capytaine import read_capytaine_file, write_capytaine_file
from quartering.hydro.database.raw import RawDatabase
from quartering.hydro.database.wamit import read_wamit_files, write_wamit_files
from quartering.hydro.transfer import transfer, transfer_matrix


@takes(path="file", ship="Ship")
def read_capytaine(
    path: str | Path, ship: Ship, *, midship: float = 0.0, moments_about: tuple[float, float] | None = None
) -> xr.Dataset:
    """Read a Capytaine netCDF into body axes about the ship's G.

    Parameters
    ----------
    path : str or Path          dataset with added_mass, radiation_damping and, if wanted, both forces
    ship : Ship                 where G is
    midship : float             x of midship in the file's axes [m]
    moments_about : (x, z)      point of the moments in the file's axes [m]; None: its rotation_center, or its origin

    Returns
    -------
    Dataset    added_mass, damping (frequency, mode, mode_of_motion); froude_krylov, diffraction, total (frequency,
               heading, part, mode) per metre of wave amplitude: cos and sin part, as `wave_forces`; SI

    Raises
    ------
    InputError    a file that is cut short, a variable, mode or frequency that is missing, a forward speed

    Notes
    -----
    Source: [Ancellin19] conventions.  Valid: one body, symmetric port and starboard, deep water, zero speed.

    Examples
    --------
    >>> import tempfile
    >>> from quartering.hull.file.read import ship
    >>> from quartering.hydro.added_mass import hydrodynamics
    >>> box = ship("box")
    >>> ours = hydrodynamics(box, [0.5, 0.8])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_capytaine(ours, folder + "/box.nc", box)
    ...     back = read_capytaine(folder + "/box.nc", box)
    >>> bool(np.allclose(back.added_mass, ours.added_mass))
    True
    """
    return _dataset(
        read_capytaine_file(path), ship, midship, moments_about, f"Capytaine: {Path(path).name}", "Ancellin19"
    )


@takes(dataset="Dataset", path="file", ship="Ship")
def write_capytaine(dataset: xr.Dataset, path: str | Path, ship: Ship, *, midship: float = 0.0) -> None:
    """Write coefficients and forces about G as a Capytaine netCDF, moments about midship at the calm plane.

    Parameters
    ----------
    dataset : Dataset      as `read_capytaine` gives, or `hydrodynamics`
    path : str or Path     file to write
    ship : Ship            where G is
    midship : float        x of midship in the file's axes [m]

    Raises
    ------
    InputError    a variable is missing

    Notes
    -----
    Source: [Ancellin19] conventions.

    Examples
    --------
    See `read_capytaine`.
    """
    with _writing(path):
        write_capytaine_file(path, _raw(dataset, ship, midship))


@takes(stem="file", ship="Ship")
def read_wamit(
    stem: str | Path,
    ship: Ship,
    *,
    length: float = 1.0,
    midship: float = 0.0,
    moments_about: tuple[float, float] | None = None,
    gravity: float = GRAVITY,
) -> xr.Dataset:
    """Read the .1 and .3 files of a WAMIT run into body axes about the ship's G.

    Parameters
    ----------
    stem : str or Path          path of the files without ending; the .3 may be absent
    ship : Ship                 where G is, and the density of the water
    length : float              ULEN [m]
    midship : float             x of midship in the file's axes [m]
    moments_about : (x, z)      origin of the body system in the file's axes [m]; None: the same origin
    gravity : float             [m/s2]

    Returns
    -------
    Dataset    as `read_capytaine`, without the two parts of the force; added_mass_zero and added_mass_infinite where
               the files have those periods

    Raises
    ------
    InputError    a file that is cut short, a mode, period or direction that is missing

    Notes
    -----
    Source: [WAMIT] definition of quantities.  Valid: one body, symmetric port and starboard, deep water, zero speed.

    Examples
    --------
    >>> import tempfile
    >>> from quartering.hull.file.read import ship
    >>> from quartering.hydro.added_mass import hydrodynamics
    >>> box = ship("box")
    >>> ours = hydrodynamics(box, [0.5, 0.8])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_wamit(ours, folder + "/box", box)
    ...     back = read_wamit(folder + "/box", box)
    >>> bool(np.allclose(back.damping, ours.damping))
    True
    """
    raw = read_wamit_files(stem, length=length, density=ship.loading.density, gravity=gravity)
    return _dataset(raw, ship, midship, moments_about, f"WAMIT: {Path(stem).name}", "WAMIT")


@takes(dataset="Dataset", stem="file", ship="Ship")
def write_wamit(
    dataset: xr.Dataset, stem: str | Path, ship: Ship, *, length: float = 1.0, midship: float = 0.0
) -> None:
    """Write coefficients and forces about G as .1 and .3 files, moments about midship at the calm plane.

    Parameters
    ----------
    dataset : Dataset      as `read_wamit` gives, or `hydrodynamics`
    stem : str or Path     path without ending
    ship : Ship            where G is
    length : float         ULEN [m]
    midship : float        x of midship in the file's axes [m]

    Raises
    ------
    InputError    a variable is missing

    Notes
    -----
    Source: [WAMIT] definition of quantities.

    Examples
    --------
    See `read_wamit`.
    """
    with _writing(stem):
        write_wamit_files(stem, _raw(dataset, ship, midship), length=length)


@contextmanager
def _writing(path: str | Path) -> Iterator[None]:
    """Refusals of the system to write become one message."""
    try:
        yield
    except OSError as error:
        raise InputError(
            f'output "{path}" cannot be written ({error.strerror}); give a file in a folder you may write to'
        ) from None


def _gravity_centre(ship: Ship, midship: float) -> tuple[float, float]:
    """G in file axes: x, and z up from the calm plane."""
    return midship + hydrostatics(ship).lcb, ship.loading.kg - ship.hull.draught


def _dataset(
    raw: RawDatabase, ship: Ship, midship: float, about: tuple[float, float] | None, method: str, reference: str
) -> xr.Dataset:
    """Our dataset of a file's database."""
    x_g, z_g = _gravity_centre(ship, midship)
    about_g = moved_to_point(raw, (x_g, z_g), about or raw.centre or (midship, 0.0))
    fields: dict[str, Any] = {
        name: (("frequency", "mode", "mode_of_motion"), matrix, {"units": _UNITS, "symbol": letter, "long_name": words})
        for name, matrix, letter, words in (
            ("added_mass", about_g.added_mass, "A", "added mass"), ("damping", about_g.damping, "B", "damping"),
        )
    }  # fmt: skip
    for name, limit in about_g.limits.items():
        words = f"added mass at {name} frequency"
        fields[f"added_mass_{name}"] = (
            ("mode", "mode_of_motion"), limit, {"units": _UNITS, "symbol": "A", "long_name": words}
        )  # fmt: skip
    coords: dict[str, Any] = {
        "frequency": ("frequency", raw.frequency, {"units": "rad/s", "symbol": "omega", "long_name": "wave frequency"}),
        "mode": list(MODES),
        "mode_of_motion": list(MODES),
    }
    if about_g.forces:
        parts = dict(about_g.forces)
        parts.setdefault("total", sum(parts.values(), np.zeros(1, dtype=complex)))
        coords |= {"heading": ("heading", about_g.heading, {"units": "deg", "symbol": "mu"}), "part": ["cos", "sin"]}
        for name, force in parts.items():
            fields[name] = (
                ("frequency", "heading", "part", "mode"), np.stack([force.real, -force.imag], axis=-2),
                {"units": "N/m (sway), N m/m (roll, yaw)", "long_name": f"{name} wave force per metre of amplitude"},
            )  # fmt: skip
    return xr.Dataset(fields, coords=coords, attrs=_attributes(ship, method, reference))


_UNITS = "SI: kg, kg m, kg m2 (over s for damping) between forces [N, N m] and velocities [m/s, rad/s]"


def _attributes(ship: Ship, method: str, reference: str) -> dict[str, str | float]:
    """What the dataset says of itself."""
    return {
        "ship": ship.name,
        "speed": 0.0,
        "axes": "body axes: x to the bow, y to starboard, z down; modes sway, roll, yaw",
        "reference_point": REFERENCE_POINT,
        "heading_convention": HEADING_CONVENTION,
        "signal": "cos cos(omega t) + sin sin(omega t); at t = 0 the surface at G passes its mean level going down",
        "density": ship.loading.density,
        "method": method,
        "references": reference,
    }


def _raw(dataset: xr.Dataset, ship: Ship, midship: float) -> RawDatabase:
    """A file's database of our dataset, about midship at the calm plane."""
    for name in ("added_mass", "damping"):
        if name not in dataset:
            raise InputError(f"the dataset has no `{name}`; give one of hydrodynamics, read_capytaine or read_wamit")
    if float(dataset.attrs.get("speed", 0.0)) != 0.0:
        raise InputError(f"speed {dataset.attrs['speed']} m/s: these formats hold results at zero speed; give speed 0")
    x_g, z_g = _gravity_centre(ship, midship)
    lever = x_g - midship, -z_g  # of G from the file's point, x forward and z down

    def moved(name: str) -> Floats:
        return transfer(dataset[name].to_numpy(), *lever) * HALF_TURN[:, None] * HALF_TURN

    frequency = dataset["frequency"].to_numpy()
    direction, forces = np.zeros(0), {}
    if "heading" in dataset.dims:
        direction = -dataset["heading"].to_numpy()
        phase = incident(frequency**2 / GRAVITY, x_g, direction)[..., None]
        for name in ("froude_krylov", "diffraction") if "diffraction" in dataset else ("total",):
            values = dataset[name].transpose("frequency", "heading", "part", "mode").to_numpy()
            about_g = values[:, :, 0] - 1j * values[:, :, 1]
            forces[name] = (about_g @ transfer_matrix(*lever)) * HALF_TURN / phase
    limits = {k: moved(f"added_mass_{k}") for k in ("zero", "infinite") if f"added_mass_{k}" in dataset}
    return RawDatabase(
        frequency, direction, moved("added_mass"), moved("damping"), forces, float(ship.loading.density), GRAVITY,
        (midship, 0.0), limits,
    )  # fmt: skip
