"""Capytaine's netCDF: its names and its time factor, translated at the border."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering.conventions import GRAVITY, InputError
from quartering.hydro.raw_database import RawDatabase, lateral_dofs, needed_rows

_DOFS = ("Sway", "Roll", "Yaw")


def read_capytaine_file(path: str | Path) -> RawDatabase:
    """What a Capytaine netCDF holds, with the time factor e^{+i omega t}.

    Parameters
    ----------
    path : str or Path    written by Capytaine with complex values separated, or by `write_capytaine_file`

    Returns
    -------
    RawDatabase    file axes: x to the bow, y to port, z up; radiation and forces in sway, roll, yaw

    Raises
    ------
    InputError    not a netCDF file, a variable, mode or frequency that is missing, a value that is not finite

    Notes
    -----
    Capytaine's phasors belong to e^{-i omega t}; a real signal has the conjugate with e^{+i omega t}.
    Source: [Ancellin19] conventions.
    """
    try:
        with xr.open_dataset(path, engine="netcdf4") as opened:
            data = opened.load()
    except (OSError, ValueError, RuntimeError) as error:
        raise InputError(
            f"{path}: cannot be read as netCDF ({type(error).__name__}); the file is cut short or not one"
        ) from None
    if float(np.max(np.abs(data["forward_speed"].to_numpy()))) > 0 if "forward_speed" in data.variables else False:
        raise InputError(f"{path}: results with forward speed are of no use here; give those at zero speed")
    for name in ("added_mass", "radiation_damping"):
        if name not in data:
            raise InputError(
                f"{path}: variable `{name}` is missing; give the dataset of assemble_dataset, radiation included"
            )
    frequency, data = _by_frequency(path, data)
    radiation = ("omega", "influenced_dof", "radiating_dof")
    added, damping = (_matrix(path, data[name], radiation) for name in ("added_mass", "radiation_damping"))
    parts = {ours: _force(path, data, theirs) for ours, theirs in _FORCES.items() if theirs in data}
    if not {"froude_krylov", "diffraction"} <= parts.keys():
        parts = {}
    direction = np.degrees(np.atleast_1d(data["wave_direction"].to_numpy())) if parts else np.zeros(0)
    return needed_rows(path, RawDatabase(
        frequency, np.asarray(direction, dtype=float), added, damping, parts,
        _scalar(data, "rho", 1025.0), _scalar(data, "g", GRAVITY), _centre(data),
    ))  # fmt: skip


_FORCES = {"froude_krylov": "Froude_Krylov_force", "diffraction": "diffraction_force"}


def _by_frequency(path: str | Path, data: xr.Dataset) -> tuple[NDArray[np.float64], xr.Dataset]:
    """Frequencies, and the data along `omega`."""
    for name in ("omega", "period", "wavenumber"):
        if name in data.dims or (name == "omega" and name in data.coords):
            break
    else:
        raise InputError(f"{path}: no frequencies; one of the coordinates omega or period is needed")
    if "omega" not in data.coords:
        raise InputError(f"{path}: frequencies are given as {name} alone; save the dataset with omega")
    if "omega" not in data.dims:
        data = data.swap_dims({name: "omega"}) if name in data.dims else data.expand_dims("omega")
    data = data.sortby("omega")
    return np.asarray(data["omega"].to_numpy(), dtype=float), data


def _matrix(path: str | Path, field: xr.DataArray, dims: tuple[str, str, str]) -> NDArray[np.float64]:
    if not set(dims) <= set(field.dims):
        raise InputError(f"{path}: {field.name} has the dimensions {field.dims}; needed are {', '.join(dims)}")
    for dim in dims[1:]:
        lateral_dofs(path, [str(name) for name in field[dim].to_numpy()], _DOFS)
    chosen: Any = field.squeeze().expand_dims([d for d in dims if d not in field.squeeze().dims])
    chosen = chosen.sel({dim: list(_DOFS) for dim in dims[1:]}).transpose(*dims)
    return np.asarray(chosen.to_numpy(), dtype=float)


def _force(path: str | Path, data: xr.Dataset, name: str) -> NDArray[np.complex128]:
    """A force (f, h, 3) of e^{+i omega t}."""
    field = data[name]
    if "complex" in field.dims:
        field = field.sel(complex="re") + 1j * field.sel(complex="im")
    dims = ("omega", "wave_direction", "influenced_dof")
    for dim in dims:
        if dim not in field.dims:
            if dim not in field.coords:
                raise InputError(f"{path}: {name} has no {dim}; needed are {', '.join(dims)}")
            field = field.expand_dims(dim)
    lateral_dofs(path, [str(dof) for dof in field["influenced_dof"].to_numpy()], _DOFS)
    chosen = field.sel(influenced_dof=list(_DOFS)).transpose(*dims, ...).squeeze(drop=True)
    values = np.asarray(chosen.to_numpy(), dtype=complex)
    return np.conj(values.reshape(data.sizes["omega"], -1, 3))


def _scalar(data: xr.Dataset, name: str, usual: float) -> float:
    return float(np.atleast_1d(data[name].to_numpy())[0]) if name in data.variables else usual


def _centre(data: xr.Dataset) -> tuple[float, float] | None:
    """Point of the moments (x, z) where the file says it."""
    if "rotation_center" not in data.variables:
        return None
    centre = np.asarray(data["rotation_center"].to_numpy(), dtype=float).ravel()
    return (float(centre[0]), float(centre[2])) if centre.size == 3 else None


def write_capytaine_file(path: str | Path, raw: RawDatabase) -> None:
    """Write a database as Capytaine does.

    Parameters
    ----------
    path : str or Path    netCDF file
    raw : RawDatabase     file axes, e^{+i omega t}

    Notes
    -----
    Complex values are separated along `complex`; rotation_center holds the point of the moments.
    Source: [Ancellin19] conventions.
    """
    dofs = list(_DOFS)
    radiation = ("omega", "radiating_dof", "influenced_dof")
    fields: dict[str, Any] = {
        "added_mass": (radiation, raw.added_mass.transpose(0, 2, 1)),
        "radiation_damping": (radiation, raw.damping.transpose(0, 2, 1)),
        "rho": raw.density,
        "g": raw.gravity,
        "rotation_center": ("xyz", [raw.centre[0], 0.0, raw.centre[1]] if raw.centre else [0.0, 0.0, 0.0]),
    }
    coords: dict[str, Any] = {
        "omega": ("omega", raw.frequency, {"units": "rad/s"}),
        "radiating_dof": dofs,
        "influenced_dof": dofs,
        "xyz": ["x", "y", "z"],
    }
    if raw.forces:
        for name, theirs in _FORCES.items():
            values = np.conj(raw.forces[name])
            dims = ("complex", "omega", "wave_direction", "influenced_dof")
            fields[theirs] = (dims, np.stack([values.real, values.imag]))
        coords |= {"wave_direction": ("wave_direction", np.radians(raw.direction), {"units": "rad"})}
        coords |= {"complex": ["re", "im"]}
    xr.Dataset(fields, coords=coords).to_netcdf(path, engine="netcdf4")
