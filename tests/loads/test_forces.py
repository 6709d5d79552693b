from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from hypothesis import given, settings
from hypothesis import strategies as st

from quartering.conventions import GRAVITY, WATER_DENSITY, InputError
from quartering.hull.file.read import ship
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.hull import scaled
from quartering.hull.lines.immersed import strips
from quartering.hydro.strip.moments import section_table
from quartering.hydro.strip.table import radiation_table
from quartering.loads.forces import FORMS, wave_force_phasors, wave_forces
from quartering.loads.strips.diffraction import contour_diffraction
from quartering.loads.strips.froude_krylov import froude_krylov
from quartering.loads.strips.stations import stations
from quartering.loads.waves import Wave
from tests.loads.hulls import rows, stations_of, wigley

CARGO = ship("series60-cb60")
FINE = ship("wigley")
BARGE = ship("box")


def phasors(vessel, k, U, mu, form="stf"):
    density = vessel.loading.density
    return wave_force_phasors(
        strips(vessel.hull), stations(vessel), section_table(vessel.hull, density), k, U, mu, form=form, density=density
    )


@pytest.mark.parametrize("form", FORMS)
def test_head_and_following_seas_push_nothing_sideways(form):
    forces = wave_forces(CARGO, Wave(120.0, 4.0), 7.0, [0.0, 180.0], form)
    assert np.all(forces["total"].values == 0.0)


@pytest.mark.parametrize("form", FORMS)
@settings(max_examples=25, deadline=None)
@given(length=st.floats(30, 600), speed=st.floats(0, 12), heading=st.floats(1, 179))
def test_waves_from_the_other_side_reverse_every_force(form, length, speed, heading):
    k = np.full(2, 2 * np.pi / length)
    pressure, scattered, omega = phasors(CARGO, k, np.full(2, speed), np.array([heading, -heading]), form)
    for part in (pressure, scattered):
        np.testing.assert_allclose(part[0], -part[1], rtol=1e-9, atol=1e-9 * np.abs(part).max())
    assert omega[0] == pytest.approx(omega[1], abs=1e-12)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("vessel", [FINE, BARGE, CARGO], ids=["wigley", "box", "series60"])
def test_long_beam_wave_limit_is_displaced_plus_added_mass_times_acceleration(form, vessel):
    """Exact limit, sway; the added mass is the strip integral at zero frequency."""
    k = 2e-4
    pressure, scattered, _ = phasors(vessel, [k], [0.0], [90.0], form)
    hull, rho = strips(vessel.hull), vessel.loading.density
    added = hull.weight @ section_table(vessel.hull, rho).a_zero[:, 0]
    assert pressure[0, 0].real == pytest.approx(-rho * hydrostatics(vessel).volume * GRAVITY * k, rel=5e-3)
    assert scattered[0, 0].real == pytest.approx(-added * GRAVITY * k, rel=2e-2)


def test_long_beam_wave_roll_moment_is_stiffness_times_surface_slope():
    """Exact limit of the Froude-Krylov moment: rho g V GM times -k."""
    k = 1e-5
    for vessel in (FINE, BARGE, CARGO):
        moment = phasors(vessel, [k], [0.0], [90.0])[0][0, 1].real
        stiffness = vessel.loading.density * GRAVITY * hydrostatics(vessel).volume * vessel.loading.gm
        assert moment == pytest.approx(-stiffness * k, rel=0.02)


def test_the_two_consistent_forms_agree_in_long_waves_at_zero_speed():
    """Contour potentials and relative motion differ at first order in kT by at most 0.15 kT: the exact value of a plate."""
    L, T = CARGO.hull.length, CARGO.hull.draught
    k, mu = np.full(3, 2 * np.pi / (8 * L)), np.array([40.0, 90.0, 130.0])
    exact, relative = (phasors(CARGO, k, np.zeros(3), mu, form)[1] for form in ("stf", "relative-motion"))
    scale = np.abs(exact[:, :1]) * [1.0, T, L / 2]
    assert np.all(np.abs(relative - exact) < 0.15 * k[0] * T * scale)


def test_forces_obey_froude_scaling():
    scale, k, mu, U = 3.0, np.array([0.03, 0.06]), np.array([50.0, 120.0]), np.array([5.0, 8.0])
    loading = replace(CARGO.loading, kg=scale * CARGO.loading.kg)
    large = replace(CARGO, hull=scaled(CARGO.hull, scale, scale, scale), loading=loading)
    for form in FORMS:
        small_forces = phasors(CARGO, k, U, mu, form)
        large_forces = phasors(large, k / scale, U * np.sqrt(scale), mu, form)
        for small, big in zip(small_forces[:2], large_forces[:2], strict=True):
            np.testing.assert_allclose(big, small * [scale**2, scale**3, scale**3], rtol=1e-6)


@pytest.mark.parametrize("form", FORMS)
def test_a_ship_that_overtakes_the_wave_gets_the_conjugate_phasor_of_the_positive_frequency(form):
    """Froude-Krylov phasors do not know the speed: overtaking only turns their sine part round."""
    k, slow, fast = [0.1], [1.0], [25.0]
    ahead, _, omega = phasors(CARGO, k, slow, [30.0], form)
    behind, scattered, overtaken = phasors(CARGO, k, fast, [30.0], form)
    assert omega[0] > 0 > overtaken[0]
    np.testing.assert_array_equal(behind, ahead.conj())
    assert np.isfinite(scattered).all()


def test_diffraction_when_overtaking_is_the_signed_formula_folded_once():
    k, U, mu = np.array([0.1]), np.array([25.0]), np.array([30.0])
    table = section_table(CARGO.hull, CARGO.loading.density)
    signed = contour_diffraction(stations(CARGO), table, k, U, mu, density=CARGO.loading.density)
    np.testing.assert_array_equal(phasors(CARGO, k, U, mu)[1], signed.conj())


@pytest.mark.parametrize("form", FORMS)
def test_force_is_continuous_through_zero_encounter_frequency(form):
    k, mu = 0.1, 30.0
    crest = np.sqrt(GRAVITY / k) / np.cos(np.deg2rad(mu))
    pressure, scattered, omega = phasors(
        CARGO, np.full(3, k), crest * np.array([1 - 1e-7, 1.0, 1 + 1e-7]), np.full(3, mu), form
    )
    signed = np.where(omega[:, None] < 0, scattered.conj(), scattered)
    assert np.isfinite(signed).all()
    np.testing.assert_allclose(signed[0], signed[2], rtol=1e-2, atol=1e-3 * np.abs(signed).max())
    np.testing.assert_allclose(np.abs(pressure[0]), np.abs(pressure[2]), rtol=1e-12)


def test_many_speeds_and_headings_are_the_single_conditions_side_by_side():
    wave, speeds, headings = Wave(150.0, 3.0), [0.0, 7.5], [30.0, 90.0, 150.0]
    grid = wave_forces(CARGO, wave, speeds, headings)
    assert grid["total"].dims == ("speed", "heading", "part", "mode")
    for U in speeds:
        for mu in headings:
            one = wave_forces(CARGO, wave, U, mu)
            assert one["total"].dims == ("part", "mode")
            for name in ("froude_krylov", "diffraction", "total"):
                np.testing.assert_allclose(grid[name].sel(speed=U, heading=mu), one[name], rtol=1e-12)


def test_total_is_the_sum_and_grows_with_the_wave_amplitude():
    low, high = (wave_forces(CARGO, Wave(150.0, height), 5.0, 60.0) for height in (2.0, 6.0))
    np.testing.assert_allclose(low["froude_krylov"] + low["diffraction"] + low["lift"], low["total"], rtol=1e-14)
    np.testing.assert_allclose(3 * low["total"], high["total"], rtol=1e-12)


def test_dataset_says_what_it_is_and_survives_netcdf(tmp_path):
    forces = wave_forces(CARGO, Wave(150.0, 4.0), 7.5, 30.0)
    assert forces.attrs["form"] == "stf"
    assert "0 deg following" in forces.attrs["heading_convention"]
    assert "centre of gravity" in forces.attrs["reference_point"]
    assert forces.attrs["references"] == "H71, STF70, Morino74"
    assert forces.attrs["ship"] == CARGO.name
    assert forces.attrs["frequency"] == pytest.approx(abs(forces["encounter_frequency"].item()))
    for variable in forces.data_vars.values():
        assert {"units", "long_name", "symbol"} <= set(variable.attrs)
    forces.to_netcdf(tmp_path / "forces.nc")
    with xr.open_dataset(tmp_path / "forces.nc") as again:
        np.testing.assert_array_equal(again["total"], forces["total"])


def test_unknown_form_is_refused_with_the_allowed_ones():
    with pytest.raises(InputError) as caught:
        wave_forces(CARGO, Wave(150.0, 4.0), 7.5, 30.0, form="smith")
    for form in FORMS:
        assert form in str(caught.value)
    assert "'smith'" in str(caught.value)


@pytest.mark.parametrize(("speed", "heading"), [(-1.0, 30.0), (np.nan, 30.0), (5.0, np.inf), ([[1.0]], 30.0)])
def test_bad_speed_and_heading_are_refused(speed, heading):
    with pytest.raises(InputError):
        wave_forces(CARGO, Wave(150.0, 4.0), speed, heading)


@pytest.mark.parametrize("k", [0.0, -0.1, np.nan])
def test_bad_wave_number_is_refused(k):
    with pytest.raises(InputError, match="wave number"):
        phasors(CARGO, [k], [0.0], [90.0])


def test_short_beam_waves_are_thrown_back_as_by_a_wall():
    """Closed form: pressure twice that of the wave on a side deep in the water, 2 rho g A/k a metre; by strips, 1 %.

    With three-dimensional ends it does not hold: they are for waves of a quarter of the length and more.
    """
    box = ship("box").with_(ends="strips")
    for length in (0.35, 0.3, 0.27):
        wave = Wave(length=length * box.hull.beam, height=0.1)
        cos, sin = wave_forces(box, wave, 0.0, 90.0)["total"].sel(mode="sway").values
        wall = 2 * box.loading.density * 9.81 * wave.amplitude / wave.wavenumber * box.hull.length
        assert np.hypot(cos, sin) == pytest.approx(wall, rel=0.02 if length > 0.3 else 0.01)


@pytest.mark.soak
def test_total_force_in_a_beam_sea_is_that_of_the_panel_code_capytaine_within_what_strip_theory_misses():
    """Journee's Wigley III. Lewis strips over 3-D panels give A22 1.12 and A44 1.29 times at most: the error bar."""
    hull, table = wigley(3.0, 0.3, 0.1875, stations=24, bluntness=0.2), rows("wigley3_forces_3d.csv")
    omega = np.unique([r["omega"] for r in table])
    k, mu = omega**2 / GRAVITY, np.full(omega.size, -90.0)
    coefficients = radiation_table(hull, omega, 1000.0)
    place = stations_of(hull)
    ours = froude_krylov(hull, place, k, mu, density=1000.0)
    ours = ours + contour_diffraction(place, coefficients, k, 0 * k, mu, density=1000.0)
    for mode, column, sign, missed in (("sway", 0, -1, 0.12), ("roll", 1, 1, 0.29)):
        chosen = [r for r in table if r["mode"] == mode and r["heading"] == 90.0]
        parts = {f: np.array([r["real"] + 1j * r["imag"] for r in chosen if r["force"] == f]) for f in ("FK", "FD")}
        theirs = parts["FK"] + parts["FD"]
        assert np.abs(sign * (ours[:, column] / 1j).conj() - theirs).max() < missed * np.abs(theirs).max()


def test_density_multiplies_every_force():
    salt, fresh = (replace(CARGO, loading=replace(CARGO.loading, density=d)) for d in (WATER_DENSITY, 1000.0))
    for form in FORMS:
        pairs = zip(
            phasors(salt, [0.05], [6.0], [60.0], form)[:2], phasors(fresh, [0.05], [6.0], [60.0], form)[:2], strict=True
        )
        for heavy, light in pairs:
            np.testing.assert_allclose(heavy / light, WATER_DENSITY / 1000.0, rtol=1e-9)
