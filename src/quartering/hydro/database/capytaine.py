"""Capytaine netCDF files: names and time factor converted on reading and writing."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import GRAVITY, InputError, RangeWarning
from quartering.hydro.database.raw import RawDatabase, lateral_dofs, needed_rows

if TYPE_CHECKING:
    import xarray as xr

_DOFS = ("Sway", "Roll", "Yaw")


def read_capytaine_file(path: str | Path) -> RawDatabase:
    """What a Capytaine netCDF holds, with the time factor e^{+i omega t}.

    path: written by Capytaine with complex values separated, or by `write_capytaine_file`
    Returns file axes: x to the bow, y to port, z up; radiation and forces in sway, roll, yaw

    Capytaine's phasors belong to e^{-i omega t}; a real signal has the conjugate with e^{+i omega t}.
    Source: [Ancellin19] conventions.
    """
    import xarray as xr

    try:
        with xr.open_dataset(path, engine="netcdf4") as opened:
            data = opened.load()
    except (OSError, ValueError, RuntimeError) as error:
        raise InputError(
            f"{path}: cannot be read as netCDF ({type(error).__name__}); the file is cut short or not one"
        ) from None
    for name in ("added_mass", "radiation_damping"):
        if name not in data:
            raise InputError(
                f"{path}: variable `{name}` is missing; give the dataset of assemble_dataset, radiation included"
            )
    _check_conditions(path, data)
    frequency, data = _by_frequency(path, _without_body(data))
    radiation = ("omega", "influenced_dof", "radiating_dof")
    added, damping = (_matrix(path, data[name], radiation) for name in ("added_mass", "radiation_damping"))
    parts = {ours: _force(path, data, theirs) for ours, theirs in _FORCES.items() if theirs in data}
    if not {"froude_krylov", "diffraction"} <= parts.keys():
        parts = {"total": _force(path, data, _TOTAL)} if _TOTAL in data else {}
    direction = _directions(path, data) if parts else np.zeros(0)
    held = np.isfinite(frequency) & (frequency > 0)
    limits = {
        name: added[at][0] for name, at in (("zero", frequency == 0), ("infinite", np.isposinf(frequency))) if at.any()
    }
    if (held | (frequency == 0) | np.isposinf(frequency)).all():  # what is no frequency is refused by its number
        frequency, added, damping = frequency[held], added[held], damping[held]
        parts = {name: values[held] for name, values in parts.items()}
    return needed_rows(path, RawDatabase(
        frequency, direction, added, damping, parts,
        _scalar(path, data, "rho", 1025.0), _scalar(path, data, "g", GRAVITY), _centre(path, data), limits,
    ))  # fmt: skip


_FORCES = {"froude_krylov": "Froude_Krylov_force", "diffraction": "diffraction_force"}
_TOTAL = "excitation_force"


def _check_conditions(path: str | Path, data: xr.Dataset) -> None:
    """Refuse forward speed and several depths, and tell of shallow water."""
    speed = _numbers(path, data, "forward_speed")
    if speed is not None and not (speed == 0).all():
        raise InputError(
            f"{path}: forward_speed = {', '.join(f'{one:g}' for one in speed[:4])} m/s; results with forward speed are of no "
            "use here; give those at zero speed"
        )
    depth = _numbers(path, data, "water_depth")
    if depth is None:
        return
    if depth.size > 1:
        raise InputError(
            f"{path}: results at {depth.size} water depths ({', '.join(f'{one:g}' for one in depth[:4])} m); save those of one "
            "depth, such as data.sel(water_depth=float('inf'))"
        )
    if np.isnan(depth[0]) or depth[0] <= 0:
        raise InputError(f"{path}: water_depth = {depth[0]:g} m; it is above 0, or infinite")
    if np.isfinite(depth[0]):
        warnings.warn(
            f"{path}: computed in {depth[0]:g} m of water; waves and strips here are those of deep water, which they are where "
            f"they are shorter than {2 * depth[0]:.4g} m",
            RangeWarning,
            stacklevel=4,
        )


def _without_body(data: xr.Dataset) -> xr.Dataset:
    """The data of one body named by its modes alone."""
    for dim in ("influenced_dof", "radiating_dof"):
        if dim not in data.coords:
            continue
        names = [str(name) for name in data[dim].to_numpy()]
        if len({name.partition("__")[0] for name in names if "__" in name}) == 1 and all(
            "__" in name for name in names
        ):
            data = data.assign_coords({dim: [name.partition("__")[2] for name in names]})
    return data


def _by_frequency(path: str | Path, data: xr.Dataset) -> tuple[NDArray[np.float64], xr.Dataset]:
    """Frequencies, and the data along `omega`, whichever of omega, period, frequency, wave number or length they lie over."""
    over = next((name for name in _OVER if name in data["added_mass"].dims), None)
    if over is None:
        over = next((name for name in _OVER if name in data.coords and data[name].ndim == 0), None)
        if over is None:
            raise InputError(f"{path}: no frequencies; one of the coordinates {', '.join(_OVER)} is needed")
        data = data.drop_vars([name for name in _OVER if name in data.coords and name != over]).expand_dims(over)
    if over != "omega":
        along = _numbers(path, data, "omega") if "omega" in data.coords and data["omega"].dims == (over,) else None
        omega = _frequency_of(path, data, over) if along is None else along
        others = [name for name in data.coords if name != over and name in _OVER]
        data = data.drop_vars(others).assign_coords({over: omega}).rename({over: "omega"})
    omega = np.asarray(_numbers(path, data, "omega"), dtype=float)
    if np.isnan(omega).any():
        raise InputError(f"{path}: frequency {int(np.argmax(np.isnan(omega))) + 1} is not a number")
    data = data.isel(omega=np.argsort(omega, kind="stable"))
    return np.sort(omega), data


_OVER = ("omega", "period", "freq", "wavenumber", "wavelength")
"""What frequencies may be given as."""


def _frequency_of(path: str | Path, data: xr.Dataset, over: str) -> NDArray[np.float64]:
    """Frequencies [rad/s] of periods, frequencies [Hz], wave numbers or lengths; omega^2 = g k tanh(k h)."""
    given = _numbers(path, data, over)
    assert given is not None
    depth = _numbers(path, data, "water_depth")
    h = np.inf if depth is None else float(depth[0])
    with np.errstate(divide="ignore", invalid="ignore"):
        if over == "period":
            return np.asarray(2 * np.pi / given)
        if over == "freq":
            return np.asarray(2 * np.pi * given)
        k = given if over == "wavenumber" else 2 * np.pi / given
        shallow = np.where(np.isfinite(k) & np.isfinite(h), np.tanh(k * np.where(np.isfinite(h), h, 1.0)), 1.0)
        return np.asarray(np.sqrt(_scalar(path, data, "g", GRAVITY) * k * shallow))


def _directions(path: str | Path, data: xr.Dataset) -> NDArray[np.float64]:
    """Directions of the waves [deg]; radians in the file, unless it says degrees or they can be nothing else."""
    given = _numbers(path, data, "wave_direction")
    if given is None:
        raise InputError(f"{path}: there are forces and no wave_direction; save the dataset with its coordinates")
    said = str(data["wave_direction"].attrs.get("units", "")).lower()
    if said.startswith("deg"):
        return given
    if np.abs(given).max() > 2 * np.pi + 1e-6:
        if said.startswith("rad"):
            raise InputError(
                f"{path}: wave_direction up to {np.abs(given).max():g} rad; are these degrees? Set its units to deg"
            )
        warnings.warn(
            f"{path}: wave_direction up to {np.abs(given).max():g} can be no radians and is read as degrees",
            RangeWarning,
            stacklevel=3,
        )
        return given
    return np.asarray(np.degrees(given))


def _numbers(path: str | Path, data: xr.Dataset, name: str) -> NDArray[np.float64] | None:
    """Values of a variable in one list; None where it is not there."""
    if name not in data.variables:
        return None
    try:
        return np.atleast_1d(np.asarray(data[name].to_numpy(), dtype=float)).ravel()
    except (TypeError, ValueError):
        raise InputError(f"{path}: {name} holds no numbers; save it as floating-point numbers") from None


def _matrix(path: str | Path, field: xr.DataArray, dims: tuple[str, str, str]) -> NDArray[np.float64]:
    chosen = _only(path, field, dims)
    for dim in dims[1:]:
        lateral_dofs(path, [str(name) for name in chosen[dim].to_numpy()], _DOFS)
    chosen = chosen.sel({dim: list(_DOFS) for dim in dims[1:]}).transpose(*dims)
    return np.asarray(_as_numbers(path, chosen), dtype=float)


def _only(path: str | Path, field: xr.DataArray, dims: tuple[str, ...]) -> xr.DataArray:
    """A field over certain dimensions, others of length one taken away."""
    for dim in set(map(str, field.dims)) - set(dims):
        if field.sizes[dim] > 1:
            raise InputError(
                f"{path}: {field.name} lies over {dim} too, {field.sizes[dim]} values of it; save the results of one of them"
            )
        field = field.squeeze(dim, drop=True)
    for dim in dims:
        if dim not in field.dims:
            if dim not in field.coords:
                raise InputError(f"{path}: {field.name} has the dimensions {field.dims}; needed are {', '.join(dims)}")
            field = field.expand_dims(dim)
        if dim not in field.coords:
            raise InputError(f"{path}: {field.name} has no values of {dim}; save the dataset with its coordinates")
    return field


def _as_numbers(path: str | Path, field: xr.DataArray) -> NDArray[Any]:
    values = field.to_numpy()
    if values.dtype.kind not in "fciu":
        raise InputError(
            f"{path}: {field.name} is stored as {values.dtype.name}, not as numbers; save it as floating-point numbers"
        )
    return values


def _force(path: str | Path, data: xr.Dataset, name: str) -> NDArray[np.complex128]:
    """A force (f, h, 3) of e^{+i omega t}."""
    field = data[name]
    _as_numbers(path, field)
    if "complex" in field.dims:
        parts = [str(part) for part in data["complex"].to_numpy()] if "complex" in data.coords else []
        if not {"re", "im"} <= set(parts):
            raise InputError(
                f"{path}: {name} has no parts `re` and `im` along `complex`; save it with separate_complex_values"
            )
        field = (field.sel(complex="re", drop=True) + 1j * field.sel(complex="im", drop=True)).rename(name)
    dims = ("omega", "wave_direction", "influenced_dof")
    field = _only(path, field, dims)
    lateral_dofs(path, [str(dof) for dof in field["influenced_dof"].to_numpy()], _DOFS)
    chosen = field.sel(influenced_dof=list(_DOFS)).transpose(*dims)
    return np.conj(np.asarray(chosen.to_numpy(), dtype=complex))


def _scalar(path: str | Path, data: xr.Dataset, name: str, usual: float) -> float:
    given = _numbers(path, data, name)
    if given is not None and given.size > 1 and np.ptp(given) > 0:
        raise InputError(f"{path}: {given.size} values of {name}; save the results of one of them")
    return usual if given is None else float(given[0])


def _centre(path: str | Path, data: xr.Dataset) -> tuple[float, float] | None:
    """Point of the moments (x, z) where the file says it."""
    centre = _numbers(path, data, "rotation_center")
    return (float(centre[0]), float(centre[2])) if centre is not None and centre.size == 3 else None


def write_capytaine_file(path: str | Path, raw: RawDatabase) -> None:
    """Write a database as Capytaine does.

    path: netCDF file
    raw: file axes, e^{+i omega t}

    Complex values are separated along `complex`; rotation_center holds the point of the moments. Limits stand at omega = 0
    and infinity, as Capytaine has them: damping 0 and forces nan there. A total alone is its `excitation_force`.
    Source: [Ancellin19] conventions.
    """
    import xarray as xr

    dofs = list(_DOFS)
    raw = _with_limits(raw)
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
        names = {**_FORCES, "total": _TOTAL}
        for name, force in raw.forces.items():
            if name == "total" and len(raw.forces) > 1:
                continue
            theirs, values = names[name], np.conj(force)
            dims = ("complex", "omega", "wave_direction", "influenced_dof")
            fields[theirs] = (dims, np.stack([values.real, values.imag]))
        coords |= {"wave_direction": ("wave_direction", np.radians(raw.direction), {"units": "rad"})}
        coords |= {"complex": ["re", "im"]}
    xr.Dataset(fields, coords=coords).to_netcdf(path, engine="netcdf4")


def _with_limits(raw: RawDatabase) -> RawDatabase:
    """The database with its limits among the frequencies."""
    for name, omega, front in (("zero", 0.0, True), ("infinite", np.inf, False)):
        if name not in raw.limits:
            continue

        def put(values: NDArray[Any], row: NDArray[Any], front: bool = front) -> NDArray[Any]:
            return np.concatenate([row[None], values] if front else [values, row[None]])

        raw = replace(
            raw, frequency=put(raw.frequency, np.array(omega)), added_mass=put(raw.added_mass, raw.limits[name]),
            damping=put(raw.damping, np.zeros((3, 3))),
            forces={key: put(force, np.full(force.shape[1:], np.nan)) for key, force in raw.forces.items()},
        )  # fmt: skip
    return raw
