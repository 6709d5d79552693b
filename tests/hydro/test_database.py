"""Databases of other codes: conventions against closed forms, round trips, and what is said of broken files."""

import numpy as np
import pytest
import xarray as xr

from quartering.conventions import GRAVITY, InputError
from quartering.hull.file.read import ship
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.immersed import strips
from quartering.hull.lines.quadrature import gauss
from quartering.hydro.added_mass import hydrodynamics
from quartering.hydro.database.dataset import read_capytaine, read_wamit, write_capytaine, write_wamit
from quartering.loads.strips.froude_krylov import froude_krylov
from quartering.loads.strips.stations import stations

BOX = ship("box").with_(kg=6.5)
S60 = ship("series60-cb60")
DENSITY = BOX.loading.density
OMEGA = np.array([0.4, 0.7, 1.1])
BETA = np.array([0.0, 30.0, 90.0, 135.0])  # the wave runs towards, from x to y (port)


def pressure_on_a_box(k, beta, about, midship):
    """Froude-Krylov sway, roll, yaw in Capytaine's conventions, faces of the box by Gauss quadrature, e^{-i omega t}.

    p = rho g e^{kz} e^{ik(x cos b + y sin b)}, F = -int p n dS, n out of the body, moments about (x, z), z up.
    """
    length, beam, draught = BOX.hull.length, BOX.hull.beam, BOX.hull.draught
    x, wx = gauss(40, midship - length / 2, midship + length / 2)
    y, wy = gauss(40, -beam / 2, beam / 2)
    z, wz = gauss(40, -draught, 0.0)
    faces = []
    for side in (-1, 1):
        faces.append(
            (*np.meshgrid(x, [side * beam / 2], z, indexing="ij"), np.einsum("i,k->ik", wx, wz)[:, None], (0, side, 0))
        )
        end = [midship + side * length / 2]
        faces.append((*np.meshgrid(end, y, z, indexing="ij"), np.einsum("j,k->jk", wy, wz)[None], (side, 0, 0)))
    faces.append((*np.meshgrid(x, y, [-draught], indexing="ij"), np.einsum("i,j->ij", wx, wy)[:, :, None], (0, 0, -1)))
    total = np.zeros(3, dtype=complex)
    for px, py, pz, weight, normal in faces:
        p = DENSITY * GRAVITY * np.exp(k * pz + 1j * k * (px * np.cos(beta) + py * np.sin(beta))) * weight
        arm = np.stack([px - about[0], py, pz - about[1]], axis=-1)
        moment = np.cross(arm, np.array(normal, dtype=float))
        total -= [(p * normal[1]).sum(), (p * moment[..., 0]).sum(), (p * moment[..., 2]).sum()]
    return total


def capytaine_box(midship, about):
    """A dataset with the names and the layout of Capytaine's assemble_dataset, complex values separated."""
    pressure = np.array(
        [[pressure_on_a_box(w**2 / GRAVITY, b, about, midship) for b in np.radians(BETA)] for w in OMEGA]
    )
    dofs = ["Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"]
    six = np.zeros((3, BETA.size, 6), dtype=complex)
    six[..., [1, 3, 5]] = pressure
    matrix = np.zeros((3, 6, 6))
    matrix[:, [1, 3, 5], [1, 3, 5]] = [2e7, 3e9, 2e10]
    force = ("complex", "omega", "wave_direction", "influenced_dof")
    parts = np.stack([six.real, six.imag])
    return xr.Dataset(
        {
            "added_mass": (("omega", "radiating_dof", "influenced_dof"), matrix),
            "radiation_damping": (("omega", "radiating_dof", "influenced_dof"), 0.1 * matrix),
            "Froude_Krylov_force": (force, parts),
            "diffraction_force": (force, 0.5 * parts),
            "rho": DENSITY,
            "g": GRAVITY,
        },
        coords={
            "omega": OMEGA, "wave_direction": np.radians(BETA), "radiating_dof": dofs, "influenced_dof": dofs,
            "complex": ["re", "im"],
        },
    )  # fmt: skip


@pytest.mark.parametrize(("midship", "about"), [(0.0, (0.0, 0.0)), (50.0, (47.0, 1.0)), (-3.0, (0.0, -2.0))])
def test_a_capytaine_pressure_field_on_a_box_reads_as_our_closed_form_froude_krylov(tmp_path, midship, about):
    capytaine_box(midship, about).to_netcdf(tmp_path / "box.nc")
    read = read_capytaine(tmp_path / "box.nc", BOX, midship=midship, moments_about=about)
    # our own Froude-Krylov of the box is exact to 1e-11 against the closed form (tests/loads)
    scale = DENSITY * GRAVITY * np.array([100 * 5.0, 100 * 20.0 * 5, 100**2 * 5.0])
    for beta in BETA:
        heading = abs((-beta + 180) % 360 - 180)
        ours = froude_krylov(strips(BOX.hull), stations(BOX), OMEGA**2 / GRAVITY, np.full(3, heading), density=DENSITY)
        parts = read.froude_krylov.sel(heading=heading).to_numpy()
        phasor = parts[:, 0] - 1j * parts[:, 1]
        np.testing.assert_allclose(phasor / scale, ours / scale, atol=1e-10)
        np.testing.assert_allclose(read.total.sel(heading=heading), 1.5 * parts, rtol=1e-12)


def test_a_wave_from_starboard_is_folded_to_the_heading_from_port_with_reversed_force(tmp_path):
    both = capytaine_box(0.0, (0.0, 0.0))
    mirrored = both.assign_coords(wave_direction=-both.wave_direction)
    for name in ("Froude_Krylov_force", "diffraction_force"):  # port-starboard symmetry of the box
        mirrored[name] = (both[name].dims, -both[name].to_numpy())
    both.to_netcdf(tmp_path / "a.nc")
    mirrored.to_netcdf(tmp_path / "b.nc")
    xr.testing.assert_allclose(read_capytaine(tmp_path / "a.nc", BOX), read_capytaine(tmp_path / "b.nc", BOX))


def test_added_mass_moves_to_g_by_rigid_kinematics(tmp_path):
    # closed form: a pure sway added mass A at (x0, z0 below G) has A44 = z0^2 A, A24 = -z0 A, A26 = x0 A, A66 += x0^2 A
    data = capytaine_box(0.0, (0.0, 0.0))
    data.to_netcdf(tmp_path / "box.nc")
    read = read_capytaine(tmp_path / "box.nc", BOX).added_mass.isel(frequency=0).to_numpy()
    depth, x_g = BOX.loading.kg - BOX.hull.draught, hydrostatics(BOX).lcb
    assert read[0, 0] == pytest.approx(2e7)
    assert read[0, 1] == pytest.approx(-depth * 2e7)
    assert read[1, 1] == pytest.approx(3e9 + depth**2 * 2e7)
    assert read[0, 2] == pytest.approx(-x_g * 2e7, abs=1e-3)
    assert read[2, 2] == pytest.approx(2e10)


def excitation(dataset):
    """A dataset with made-up forces at every frequency and heading, all different."""
    heading = np.array([0.0, 45.0, 120.0])
    rng = np.random.default_rng(3)
    shape = (dataset.sizes["frequency"], heading.size, 2, 3)
    dims = ("frequency", "heading", "part", "mode")
    dataset = dataset.assign(
        froude_krylov=(dims, rng.normal(size=shape) * 1e6), diffraction=(dims, rng.normal(size=shape) * 1e6)
    ).assign_coords(heading=heading, part=["cos", "sin"])
    return dataset.assign(total=dataset.froude_krylov + dataset.diffraction)


@pytest.mark.parametrize("midship", [0.0, 60.0])
def test_what_is_written_for_capytaine_reads_back_the_same(tmp_path, midship):
    ours = excitation(hydrodynamics(S60, OMEGA))
    write_capytaine(ours, tmp_path / "s60.nc", S60, midship=midship)
    back = read_capytaine(tmp_path / "s60.nc", S60, midship=midship)
    for name in ("added_mass", "damping", "froude_krylov", "diffraction", "total"):
        scale = np.abs(ours[name]).max(dim="frequency")
        assert float((np.abs(back[name] - ours[name]) / scale).max()) < 1e-9, name


@pytest.mark.parametrize("length", [1.0, 121.92])
def test_what_is_written_for_wamit_reads_back_the_same(tmp_path, length):
    ours = excitation(hydrodynamics(S60, OMEGA))
    write_wamit(ours, tmp_path / "s60", S60, length=length)
    back = read_wamit(tmp_path / "s60", S60, length=length)
    for name in ("added_mass", "damping", "total"):  # nine digits are written
        want = ours[name].to_numpy()
        assert np.abs(back[name].to_numpy() - want).max() < 1e-7 * np.abs(want).max(), name


def test_wamit_numbers_are_nondimensional_as_its_manual_defines(tmp_path):
    # WAMIT manual: A = rho L^k Abar, B = rho L^k omega Bbar, X = rho g L^m Xbar; k = 3, 4, 5, m = 2, 3
    lines = []
    for i, j, a, b in ((2, 2, 2.0, 0.5), (2, 4, 0.1, 0.02), (4, 2, 0.1, 0.02), (4, 4, 3.0, 0.1), (6, 6, 4.0, 0.2)):
        lines.append(f"  8.0 {i} {j} {a} {b}")
    (tmp_path / "a.1").write_text("\n".join([f" -1.0 {k} {k} 1.5" for k in (2, 4, 6)] + [" 0.0 2 2 1.25", *(
        f" 0.0 {k} {k} 1.0" for k in (4, 6))] + lines))  # fmt: skip
    (tmp_path / "a.3").write_text(
        "".join(f" 0.0 -90.0 {i} 0 0 0 0\n 8.0 -90.0 {i} 1.0 90.0 0.0 1.0\n" for i in (2, 4, 6))
    )
    # moments about G itself, so that nothing is moved
    about = (hydrostatics(BOX).lcb, BOX.loading.kg - BOX.hull.draught)
    read = read_wamit(tmp_path / "a", BOX, length=10.0, moments_about=about)
    omega = 2 * np.pi / 8
    added, damping = read.added_mass[0].to_numpy(), read.damping[0].to_numpy()
    assert read.frequency.item() == pytest.approx(omega)
    assert added[0, 0] == pytest.approx(2.0 * DENSITY * 1e3)
    assert added[0, 1] == pytest.approx(-0.1 * DENSITY * 1e4)  # sway reverses, roll does not
    assert added[2, 2] == pytest.approx(4.0 * DENSITY * 1e5)
    assert damping[1, 1] == pytest.approx(0.1 * omega * DENSITY * 1e5)
    assert read.added_mass_zero[0, 0].item() == pytest.approx(1.5 * DENSITY * 1e3)
    assert read.added_mass_infinite[0, 0].item() == pytest.approx(1.25 * DENSITY * 1e3)
    # phasor i per unit elevation; half a turn about x: -i, +i, -i; times i: 1, -1, 1 (cos part), at heading 90
    want = DENSITY * GRAVITY * np.array([1e2, -1e3, 1e3])
    np.testing.assert_allclose(read.total.sel(heading=90.0, part="cos")[0], want, rtol=1e-9)
    np.testing.assert_allclose(read.total.sel(heading=90.0, part="sin")[0], 0.0, atol=1e-3)


def test_a_netcdf_cut_short_is_refused_in_one_message(tmp_path):
    capytaine_box(0.0, (0.0, 0.0)).to_netcdf(tmp_path / "box.nc")
    whole = (tmp_path / "box.nc").read_bytes()
    (tmp_path / "box.nc").write_bytes(whole[: len(whole) // 3])
    with pytest.raises(InputError, match="cut short"):
        read_capytaine(tmp_path / "box.nc", BOX)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda d: d.drop_vars("radiation_damping"), ["radiation_damping", "missing"]),
        (lambda d: d.sel(radiating_dof=["Sway", "Roll"]), ["Yaw", "missing"]),
        (lambda d: d.assign(added_mass=d.added_mass.where(d.omega != 0.7)), ["added mass", "0.7", "1 of 3"]),
        (lambda d: d.assign(forward_speed=5.0), ["forward speed", "zero"]),
        (lambda d: d.isel(omega=[0, 0, 1]), ["each once"]),
    ],
)
def test_a_capytaine_dataset_with_something_missing_is_refused_by_name(tmp_path, change, words):
    change(capytaine_box(0.0, (0.0, 0.0))).to_netcdf(tmp_path / "box.nc")
    with pytest.raises(InputError) as refusal:
        read_capytaine(tmp_path / "box.nc", BOX)
    assert all(word in str(refusal.value) for word in ["box.nc", *words])


@pytest.mark.parametrize(
    ("ending", "edit", "words"),
    [
        (".1", lambda text: text[: len(text) - 25], ["cut short"]),
        (".1", lambda text: "\n".join(text.splitlines()[:-1]), ["lacks mode 6", "cut short"]),
        (".3", lambda text: "\n".join(text.splitlines()[:-2]), ["2 forces are missing", "120", "mode 4"]),
        (".3", lambda text: text[:0], ["no forces"]),
        (".1", lambda text: "\n".join(text.splitlines()[:9]), ["not in the .1 file"]),
        (".1", lambda text: text.replace("E+", "?", 1), ["line"]),
    ],
)
def test_a_broken_wamit_file_is_refused_in_one_message(tmp_path, ending, edit, words):
    write_wamit(excitation(hydrodynamics(S60, OMEGA)), tmp_path / "s60", S60)
    path = tmp_path / f"s60{ending}"
    path.write_text(edit(path.read_text()))
    with pytest.raises(InputError) as refusal:
        read_wamit(tmp_path / "s60", S60)
    assert all(word in str(refusal.value) for word in ["s60", *words]), str(refusal.value)


def test_a_dataset_at_speed_is_not_written_where_the_format_has_no_speed(tmp_path):
    with pytest.raises(InputError, match="zero speed"):
        write_wamit(hydrodynamics(S60, OMEGA, speed=5.0), tmp_path / "s60", S60)
