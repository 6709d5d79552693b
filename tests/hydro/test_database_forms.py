"""Result files in every form their codes write: over other frequencies, with limits, by other bodies; and what has no sense."""

import numpy as np
import pytest
import xarray as xr

from quartering.conventions import GRAVITY, InputError, RangeWarning
from quartering.hull.file.read import ship
from quartering.hydro.database.capytaine import read_capytaine_file, write_capytaine_file
from quartering.hydro.database.dataset import read_capytaine, read_wamit, write_capytaine
from quartering.hydro.database.raw import RawDatabase
from quartering.hydro.database.wamit import read_wamit_files, write_wamit_files

W = np.array([0.3, 0.5, 0.8, 1.2])
DIRECTION = np.array([0.0, 45.0, 90.0, 180.0])


def raw(**other):
    """A sound database: positive matrices, and long waves whose sway force leads the elevation by 90 deg."""
    a = np.array([[2.0, 0.1, 0.2], [0.1, 3.0, 0.3], [0.2, 0.3, 9.0]]) * 1e6
    force = np.zeros((W.size, DIRECTION.size, 3), dtype=complex)
    force[:] = (1j * W[:, None] ** 2 * np.sin(np.radians(DIRECTION)))[:, :, None] * [1e5, 2e5, 3e5]
    whole = {
        "frequency": W, "direction": DIRECTION, "added_mass": a / (1 + W)[:, None, None],
        "damping": a * 0.1 * W[:, None, None], "forces": {"froude_krylov": force, "diffraction": 0.4 * force},
        "density": 1025.0, "gravity": GRAVITY, "centre": (0.0, 0.0),
    }  # fmt: skip
    return RawDatabase(**{**whole, **other})


def dataset(folder, **other):
    write_capytaine_file(folder / "a.nc", raw(**other))
    with xr.open_dataset(folder / "a.nc") as opened:
        return opened.load()


def reread(folder, data):
    data.to_netcdf(folder / "b.nc", engine="netcdf4")
    return read_capytaine_file(folder / "b.nc")


def same(one, other):
    for name in ("frequency", "direction", "added_mass", "damping"):
        np.testing.assert_allclose(getattr(one, name), getattr(other, name), rtol=1e-9, atol=1e-6)
    assert one.forces.keys() == other.forces.keys()
    for name, force in one.forces.items():
        np.testing.assert_allclose(force, other.forces[name], rtol=1e-9, atol=1e-6)
    assert one.limits.keys() == other.limits.keys()
    for name, limit in one.limits.items():
        np.testing.assert_allclose(limit, other.limits[name], rtol=1e-9)


@pytest.mark.parametrize("keeps_omega", [True, False])
@pytest.mark.parametrize(
    ("over", "of"),
    [
        ("period", lambda w: 2 * np.pi / w),
        ("freq", lambda w: w / (2 * np.pi)),
        ("wavenumber", lambda w: w**2 / GRAVITY),
        ("wavelength", lambda w: 2 * np.pi * GRAVITY / w**2),
    ],
)
def test_frequencies_may_be_given_as_anything_that_tells_them(tmp_path, over, of, keeps_omega):
    """Authority: omega = 2 pi f = 2 pi / T, omega^2 = g k = 2 pi g / lambda on deep water."""
    data = dataset(tmp_path)
    omega = data["omega"].to_numpy()
    data = data.rename(omega=over).assign_coords({over: of(omega)})
    if keeps_omega:
        data = data.assign_coords(omega=(over, omega))
    same(reread(tmp_path, data), raw())


def test_the_limits_of_omega_are_limits(tmp_path):
    """Capytaine's form: omega 0 and infinity, the damping 0 and the forces nan there."""
    given = {"zero": raw().added_mass[0] * 1.2, "infinite": raw().added_mass[0] * 0.7}
    data = dataset(tmp_path, limits=given)
    assert data["omega"].to_numpy()[[0, -1]].tolist() == [0.0, np.inf]
    same(reread(tmp_path, data), raw(limits=given))


@pytest.mark.parametrize("code", ["capytaine", "wamit"])
def test_a_limit_that_is_no_number_is_left_out_and_told(tmp_path, code):
    limits = {"zero": np.full((3, 3), np.nan), "infinite": np.eye(3)}
    write_wamit_files(tmp_path / "a", raw(limits=limits))
    data = dataset(tmp_path, limits=limits)
    with pytest.warns(RangeWarning, match="zero frequency is not a number"):
        found = reread(tmp_path, data) if code == "capytaine" else read_wamit_files(tmp_path / "a")
    assert list(found.limits) == ["infinite"]


@pytest.mark.parametrize("parts", [("froude_krylov", "diffraction"), ("diffraction",)])
def test_phases_of_the_other_time_factor_are_told(tmp_path, parts):
    """Authority: Morison's inertia force in long waves, +i times a positive number for cos(omega t)."""
    forces = {name: np.conj(force) if name in parts else force for name, force in raw().forces.items()}
    data = dataset(tmp_path, forces=forces)
    with pytest.warns(RangeWarning, match=f"{' and '.join(parts)} forces have the phases of the other time factor"):
        reread(tmp_path, data)


def test_a_wamit_run_is_told_of_the_other_time_factor(tmp_path):
    write_wamit_files(tmp_path / "a", raw(forces={"total": np.conj(raw().forces["diffraction"])}))
    with pytest.warns(RangeWarning, match="total forces have the phases"):
        read_wamit_files(tmp_path / "a")


def test_directions_in_degrees_are_degrees(tmp_path):
    data = dataset(tmp_path)
    said = data.assign_coords(wave_direction=("wave_direction", DIRECTION, {"units": "deg"}))
    same(reread(tmp_path, said), raw())
    unsaid = data.assign_coords(wave_direction=("wave_direction", DIRECTION))
    with pytest.warns(RangeWarning, match="read as degrees"):
        same(reread(tmp_path, unsaid), raw())
    wrong = data.assign_coords(wave_direction=("wave_direction", DIRECTION, {"units": "rad"}))
    with pytest.raises(InputError, match="are these degrees"):
        reread(tmp_path, wrong)


def test_water_of_a_finite_depth_is_told(tmp_path):
    data = dataset(tmp_path).assign(water_depth=30.0)
    with pytest.warns(RangeWarning, match="30 m of water"):
        reread(tmp_path, data)
    same(reread(tmp_path, data.assign(water_depth=np.inf)), raw())


BODIES = ["ship__Sway", "ship__Roll", "ship__Yaw"]


def named(data, names):
    return data.assign_coords(influenced_dof=names, radiating_dof=names)


def test_modes_of_one_named_body_are_its_own(tmp_path):
    same(reread(tmp_path, named(dataset(tmp_path), BODIES)), raw())


def two_bodies(data):
    other = named(data, ["barge__Sway", "barge__Roll", "barge__Yaw"])
    return xr.concat(
        [named(data, BODIES), other.assign_coords(radiating_dof=BODIES)], "influenced_dof", data_vars="all"
    )


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda d: d.assign(rho=np.nan), "rho: water_density = nan"),
        (lambda d: d.assign(rho=1.0), "did you mean 1 t/m3"),
        (lambda d: d.assign(g=-9.81), "g = -9.81 m/s2"),
        (lambda d: d.assign(g=np.nan), "g = nan"),
        (lambda d: d.assign(forward_speed=np.nan), "forward_speed = nan"),
        (lambda d: d.assign(forward_speed=3.0), "zero speed"),
        (lambda d: d.assign(rotation_center=("xyz", [np.nan, 0.0, 0.0])), "point of the moments"),
        (lambda d: d.assign(water_depth=-5.0), "water_depth = -5 m"),
        (lambda d: d.expand_dims(water_depth=[20.0, np.inf]), "2 water depths"),
        (lambda d: d.assign(diffraction_force=d.diffraction_force.astype(str)), "not as numbers"),
        (lambda d: d.assign_coords(omega=[0.3, np.nan, 0.8, 1.2]), "is not a number"),
        (lambda d: d.assign_coords(omega=[-0.3, 0.5, 0.8, 1.2]), "positive numbers"),
        (two_bodies, "several bodies in it"),
        (lambda d: d.assign_coords(wave_direction=[0.0, np.nan, 1.0, 2.0]), "wave direction is not a number"),
    ],
)
def test_what_has_no_sense_is_refused_by_name(tmp_path, change, words):
    with pytest.raises(InputError) as caught:
        reread(tmp_path, change(dataset(tmp_path)))
    assert words in str(caught.value)
    assert "b.nc" in str(caught.value)


@pytest.mark.parametrize(
    ("file", "old", "new", "words"),
    [
        (".3", "     4", "   inf", "line 2: inf is no mode"),
        (".3", "     4", "   nan", "line 2: nan is no mode"),
        (".1", "     2     4", "     2   2.5", "2.5 is no mode"),
        (".1", "2.094395102E+01", "-2.09395102E+01", "period -20.9"),
        (".1", "2.094395102E+01", "            nan", "period nan"),
    ],
)
def test_a_mode_or_period_that_is_none_is_refused_with_its_line(tmp_path, file, old, new, words):
    write_wamit_files(tmp_path / "a", raw(forces={"total": raw().forces["diffraction"]}))
    path = tmp_path / f"a{file}"
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(InputError) as caught:
        read_wamit_files(tmp_path / "a")
    assert words in str(caught.value)


def test_what_the_wamit_reader_reads_the_capytaine_writer_writes(tmp_path):
    """Round trip: totals alone, with both limits."""
    box = ship("box")
    limits = {"zero": raw().added_mass[0] * 1.2, "infinite": raw().added_mass[0] * 0.7}
    write_wamit_files(tmp_path / "a", raw(forces={"total": raw().forces["diffraction"]}, limits=limits))
    first = read_wamit(tmp_path / "a", box)
    write_capytaine(first, tmp_path / "a.nc", box)
    back = read_capytaine(tmp_path / "a.nc", box)
    assert set(back) == set(first)
    for name in first:
        np.testing.assert_allclose(back[name], first[name], rtol=1e-6, atol=1e-6 * float(np.abs(first[name]).max()))
