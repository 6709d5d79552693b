"""A ship that runs from its own database: what is written from strips and read back must give what the strips give."""

import shutil

import numpy as np
import pytest
import xarray as xr

import quartering as qt
from quartering.conventions import GRAVITY, InputError
from quartering.hull.user_database import database_of
from quartering.hydro.database.dataset import write_capytaine, write_wamit
from quartering.hydro.source.user_database import user_database
from quartering.loads.comparison import compare_forces
from quartering.loads.forces import ship_force_phasors
from quartering.study.grid import grid
from tests.loads.own_file import OMEGA, S60, of_strips


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("own")
    whole = of_strips(S60)
    write_capytaine(whole, place / "own.nc", S60)
    write_wamit(whole, place / "own", S60)
    write_capytaine(of_strips(S60, OMEGA, forces=False), place / "no_forces.nc", S60)
    few = of_strips(S60, np.linspace(0.6, 1.2, 12), np.arange(30.0, 151.0, 15.0))
    write_capytaine(few, place / "few.nc", S60)
    return place


def ship_from(folder, name="own.nc", **changes):
    return S60.with_(database=folder / name, **changes)


def waves(low, high, U, count=300):
    """Wave numbers and headings at random, within the database at speed."""
    random = np.random.default_rng(7)
    k = 2 * np.pi / (S60.hull.length * random.uniform(low, high, count))
    mu = random.uniform(0.0, 180.0, count)
    inside = np.abs(np.sqrt(GRAVITY * k) - k * U * np.cos(np.radians(mu))) < OMEGA[-1]
    return k[inside], np.full(inside.sum(), U), mu[inside]


def off(ship, k, U, mu):
    """Largest difference of the wave force from that of the strips, over the largest, by mode."""
    own, ours = (sum(ship_force_phasors(s, k, U, mu)[:2]) for s in (ship, S60))
    return np.abs(own - ours).max(axis=0) / np.abs(ours).max(axis=0)


@pytest.mark.parametrize("linear", ["default", "strip"])
@pytest.mark.parametrize("name", ["own.nc", "own.1"])
def test_coefficients_from_the_file_are_those_of_the_strips_it_was_written_from(folder, name, linear):
    """Spline between frequencies 0.05 rad/s apart: measured 8e-5 of the largest.

    With speed terms U b/omega^2 stands in the inertia of yaw, and multiplies the error of b at 0.12 rad/s: 3e-4.
    """
    omega = np.array([0.123, 0.333, 0.5, 0.777, 1.234, 2.0])
    own, ours = (qt.coefficients(s.with_(linear=linear), omega, 7.5) for s in (ship_from(folder, name), S60))
    allowed = np.full((3, 3), 1e-4)
    for one, other in ((own.linear, ours.linear), (own.inertia, ours.inertia)):
        assert (np.abs(one - other).max(axis=0) / np.abs(other).max(axis=0) < allowed).all()
        if linear == "strip":
            allowed[2] = 5e-4
    assert own.roll_frequency == pytest.approx(ours.roll_frequency, rel=1e-6)


def test_hydrodynamics_at_speed_runs_from_the_file(folder):
    own, ours = (qt.hydrodynamics(s, [0.4, 0.9], speed=7.5) for s in (ship_from(folder), S60))
    for name in ("added_mass", "damping"):
        one, other = own[name].to_numpy(), ours[name].to_numpy()
        scale = np.sqrt(np.abs(np.einsum("fi,fj->fij", *[np.einsum("fii->fi", other)] * 2)))
        assert (np.abs(one - other) / scale).max() < 2e-3
    assert "database own.nc (Capytaine)" in own.attrs["method"]


@pytest.mark.parametrize("name", ["own.nc", "own.1"])
def test_forces_at_rest_between_frequencies_and_headings(folder, name):
    """Measured 2e-4 of the largest force: splines over 0.05 rad/s and 5 deg."""
    for low, high in ((0.4, 0.8), (0.8, 3.0)):
        assert (off(ship_from(folder, name), *waves(low, high, 0.0)) < 4e-4).all()


@pytest.mark.parametrize("heading", [60.0, 90.0, 150.0])
def test_in_very_long_waves_the_speed_terms_are_those_of_strip_theory(folder, heading):
    """[STF70]: all sections feel one and the same motion of the water, so the hull as a whole is as good as its strips."""
    k = np.full(1, 2 * np.pi / (8 * S60.hull.length))
    own, ours = (ship_force_phasors(s, k, np.full(1, 8.6), np.full(1, heading))[1] for s in (ship_from(folder), S60))
    np.testing.assert_allclose(np.abs(own - ours)[0, [0, 2]] / np.abs(ours)[0, [0, 2]], 0.0, atol=5e-3)


def test_forces_at_speed(folder):
    """[STF70] on strips against the hull as a whole, Fn 0.25. Measured over 400 conditions: sway, roll, yaw."""
    ship = ship_from(folder)
    assert (off(ship, *waves(1.5, 3.0, 8.6)) < [0.02, 0.08, 0.025]).all()
    assert (off(ship, *waves(0.8, 1.5, 8.6)) < [0.04, 0.40, 0.07]).all()


def test_a_beam_sea_from_starboard_and_phases_at_g(folder):
    k, mu = np.full(2, 0.05), np.array([60.0, -60.0])
    pressure, scattered, _ = ship_force_phasors(ship_from(folder), k, np.full(2, 5.0), mu)
    np.testing.assert_allclose(pressure[0], -pressure[1], rtol=1e-12)
    np.testing.assert_allclose(scattered[0], -scattered[1], rtol=1e-12)
    moved = ship_from(folder, kg=S60.loading.kg + 0.4)
    higher = sum(ship_force_phasors(moved, k, 0 * k, mu)[:2])
    expected = sum(ship_force_phasors(S60.with_(kg=S60.loading.kg + 0.4), k, 0 * k, mu)[:2])
    np.testing.assert_allclose(higher, expected, rtol=2e-3)


def test_an_overtaken_wave_has_the_conjugate_force(folder):
    k, U, mu = np.array([2 * np.pi / 60]), np.array([14.0]), np.array([20.0])
    own, ours = (ship_force_phasors(s, k, U, mu) for s in (ship_from(folder), S60))
    assert own[2][0] == ours[2][0] < 0.0
    np.testing.assert_allclose(own[0], ours[0], rtol=1e-3)


def test_motions_and_maps_run_from_the_file(folder):
    ship = ship_from(folder)
    conditions = {"speed": [0.0, 5.0], "heading": [60.0, 90.0], "wave_length": [122.0, 200.0], "wave_height": [2.0]}
    own, ours = qt.sweep(ship, **conditions), qt.sweep(S60, **conditions)
    np.testing.assert_allclose(own["roll"].sel(speed=0.0), ours["roll"].sel(speed=0.0), rtol=1e-3)
    np.testing.assert_allclose(own["roll"], ours["roll"], rtol=0.1)
    assert "database own.nc" in own.attrs["diffraction"]
    assert "database own.nc" in own.attrs["coefficient_sources"]
    motion = qt.steady_motion(qt.equations(ship, qt.Wave(122.0, 2.0), 5.0, 60.0))
    assert float(own["roll"].sel(speed=5.0, heading=60.0, wave_length=122.0).squeeze()) == pytest.approx(
        np.degrees(motion.amplitude[1]), rel=1e-8
    )


def test_every_source_line_of_added_mass_and_waves_names_the_file(folder):
    table = {e.name: e for e in qt.coefficients(ship_from(folder), 0.5, 5.0).table()}
    assert table["Y_vdot"].kind == "database"
    for name in ("Y_vdot", "N_rdot", "Y_v", "K_p", "N_r"):
        assert "database own.nc (Capytaine)" in table[name].source
        assert "strips" not in table[name].source
    assert "Ancellin19" in qt.coefficients(ship_from(folder), 0.5, 5.0).references
    forces = qt.wave_forces(ship_from(folder), qt.Wave(122.0, 2.0), heading=60.0)
    assert forces.attrs["form_meaning"].startswith("database own.nc (Capytaine), zero speed")
    assert {"stf", "database"} <= set(compare_forces(ship_from(folder), [122.0], [60.0, 90.0])["form"].to_numpy())


def test_a_study_is_of_the_content_of_the_file_not_of_its_name(folder, tmp_path):
    for name in ("a.nc", "b.nc"):
        shutil.copy(folder / "own.nc", tmp_path / name)
    digests = [
        grid(ship_from(tmp_path, n), 5.0, 60.0, 122.0, 2.0).described["ship"]["digest"] for n in ("a.nc", "b.nc")
    ]
    assert digests[0] == digests[1]
    shutil.copy(folder / "no_forces.nc", tmp_path / "a.nc")
    other = grid(ship_from(tmp_path, "a.nc"), 5.0, 60.0, 122.0, 2.0).described["ship"]["digest"]
    assert other != digests[0]


def test_a_file_that_changes_under_a_ship_is_noticed(folder, tmp_path):
    shutil.copy(folder / "own.nc", tmp_path / "a.nc")
    ship = ship_from(tmp_path, "a.nc", gm=0.77)
    shutil.copy(folder / "few.nc", tmp_path / "a.nc")
    user_database.cache_clear()
    with pytest.raises(InputError, match="changed or gone since the ship was read"):
        qt.coefficients(ship, 0.5, 5.0)


@pytest.mark.parametrize(
    ("name", "ask", "words"),
    [
        (
            "few.nc",
            lambda s: qt.coefficients(s, 0.7, 5.0),
            r"holds 0.6 to 1.2 rad/s, and 0.465\d rad/s.*compute from 0.33",
        ),
        (
            "own.nc",
            lambda s: qt.coefficients(s, 3.0, 5.0),
            r"holds 0.1 to 2.2 rad/s, and 3 rad/s is asked for.*longer waves",
        ),
        (
            "few.nc",
            lambda s: qt.wave_forces(s, qt.Wave(80.0, 1.0), heading=20.0),
            r"holds headings 30 to 150 deg, and 20 deg",
        ),
        (
            "few.nc",
            lambda s: qt.wave_forces(s, qt.Wave(300.0, 1.0), heading=90.0),
            r"0.6 to 1.2 rad/s .waves of 42.8 to 171",
        ),
        ("no_forces.nc", lambda s: qt.wave_forces(s, qt.Wave(80.0, 1.0)), r"no_forces.nc holds no wave forces"),
        ("own.nc", lambda s: s.with_(draught=5.0), r"is of draught 6.5\d* m, and 5 m is asked for"),
    ],
    ids=["low frequency", "high frequency", "heading", "long wave", "no forces", "draught"],
)
def test_what_the_file_does_not_hold_is_refused_naming_what_it_holds(folder, name, ask, words):
    with pytest.raises(InputError, match=words):
        ask(ship_from(folder, name))


@pytest.mark.parametrize(
    ("name", "words"), [("none.nc", "there is no such file"), ("own.h5", "a path of a Capytaine netCDF.*or of WAMIT")]
)
def test_a_file_that_is_missing_or_of_another_kind_is_refused(name, words):
    with pytest.raises(InputError, match=words):
        S60.with_(database=name)


def test_a_ship_file_names_its_database_beside_itself(folder):
    path = folder / "ship.yaml"
    path.write_text("base: series60-cb60\ndatabase: own.nc\n")
    assert qt.ship(path).database.digest == ship_from(folder).database.digest
    path.write_text("base: series60-cb60\ndatabase: {file: own.1, length: 1.0, midship: 0.0}\n")
    assert qt.ship(path).database.name == "database own.1 (WAMIT)"
    path.write_text("base: series60-cb60\ndatabase: {file: own.nc, midships: 3}\n")
    with pytest.raises(InputError, match=r"database, midships.*did you mean midship"):
        qt.ship(path)


def test_midship_and_density_of_the_file_count(folder, tmp_path):
    """The same results written about another origin and in fresh water are the same ship's."""
    fresh = xr.open_dataset(folder / "own.nc").load()
    for name in ("added_mass", "radiation_damping", "Froude_Krylov_force", "diffraction_force"):
        fresh[name] = fresh[name] * (1000.0 / 1025.0)
    fresh.assign(rho=1000.0).to_netcdf(tmp_path / "fresh.nc")
    one, other = (qt.coefficients(s, 0.7, 5.0) for s in (ship_from(folder), S60.with_(database=tmp_path / "fresh.nc")))
    np.testing.assert_allclose(one.inertia, other.inertia, rtol=1e-9)
    write_capytaine(of_strips(S60), tmp_path / "aft.nc", S60, midship=S60.hull.length / 2)
    aft = S60.with_(database=database_of(tmp_path / "aft.nc", "test", midship=S60.hull.length / 2))
    np.testing.assert_allclose(one.inertia, qt.coefficients(aft, 0.7, 5.0).inertia, rtol=1e-9)
    k, mu = np.full(3, 0.04), np.array([40.0, 90.0, 130.0])
    for part in range(2):
        np.testing.assert_allclose(
            ship_force_phasors(aft, k, 0 * k, mu)[part], ship_force_phasors(ship_from(folder), k, 0 * k, mu)[part],
            rtol=1e-6, atol=1.0,
        )  # fmt: skip


def test_a_ship_runs_from_panels(tmp_path):
    """Capytaine's own results at a frequency and heading of the file come out of the ship unchanged."""
    pytest.importorskip("capytaine", reason="the extra `bem` (Capytaine) is not installed")
    from quartering.hydro.source.capytaine_run import bem_forces

    wigley = qt.ship("wigley")
    lengths = wigley.hull.length * np.geomspace(0.8, 20.0, 10)[::-1]
    panels = bem_forces(wigley, lengths, np.arange(30.0, 151.0, 30.0), panels=(20, 6)).swap_dims(
        wave_length="frequency"
    )
    write_capytaine(panels.drop_vars("total").sortby("frequency"), tmp_path / "bem.nc", wigley)
    ship = wigley.with_(database=tmp_path / "bem.nc")
    wave = qt.Wave(float(lengths[-3]), 1.0)
    total = qt.wave_forces(ship, wave, heading=60.0)["total"].to_numpy() / wave.amplitude
    theirs = panels["total"].sel(heading=60.0).isel(frequency=-3).to_numpy()
    np.testing.assert_allclose(total, theirs, rtol=1e-6, atol=1e-6 * np.abs(theirs).max())
    assert qt.coefficients(ship, 0.5, 5.0).inertia[0, 0, 0] > 0


def test_six_modes_beside_a_database_say_that_they_are_by_strips(folder):
    own = ship_from(folder)
    with pytest.warns(qt.RangeWarning, match=r"all six modes are by strips, and .*own\.nc.* is left out"):
        found = qt.hydrodynamics6(own, [0.6])
    np.testing.assert_array_equal(found.added_mass, qt.hydrodynamics6(own.with_(database="none"), [0.6]).added_mass)
