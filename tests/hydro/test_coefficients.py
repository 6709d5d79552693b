"""Whole-ship coefficients: physical checks on every built-in ship, closed forms, scaling, sources, overrides."""

from dataclasses import replace
from importlib.resources import files

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from quartering.conventions import CUBIC_MONOMIALS, GRAVITY, InputError
from quartering.hull.autopilot import Autopilot
from quartering.hull.file.read import ship
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.hull import scaled
from quartering.hull.lines.immersed import strips
from quartering.hull.righting.arm import righting_polynomial
from quartering.hull.ship import Ship
from quartering.hydro.added_mass import hydrodynamics
from quartering.hydro.calm_water import calm_water_exponents, state_matrix
from quartering.hydro.coefficient_table import Coefficients, rigid_inertia
from quartering.hydro.coefficients import coefficients
from quartering.hydro.damping.natural_roll import natural_roll_frequency
from quartering.hydro.damping.roll import fraction_of_critical
from quartering.hydro.manoeuvring.lift import clarke_derivatives, hull_lift, to_si
from quartering.hydro.strip.integrals import moment_matrix
from quartering.hydro.strip.lateral import frequency_floor
from quartering.hydro.strip.moments import hull_moments, section_table
from quartering.names import CUBIC_NAMES, DRAG_NAME, KNOWN, RESTORING_NAMES, RUDDER_NAMES, canonical, dimension, unit
from tests.tiers import mostly_soak

SHIPS = sorted(entry.name.removesuffix(".yaml") for entry in (files("quartering.hull") / "library").iterdir())
S60 = ship("series60-cb60").with_(ends="strips", righting="polynomial", drag="cubic")  # its terms are what is tested
SPEED = 0.25 * np.sqrt(GRAVITY * S60.hull.length)
OMEGA = np.concatenate([[0.0], np.geomspace(0.005, 12.0, 200)])


def with_coefficients(base: Ship, **values: float) -> Ship:
    return replace(base, overrides={**base.overrides, **values})


def by_name(c: Coefficients, condition: int = 0) -> dict[str, float]:
    return {entry.name: entry.value for entry in c.table(condition)}


@pytest.mark.parametrize("name", mostly_soak(SHIPS, "wigley", "dtmb5415", "coaster-90m"))
def test_inertia_is_symmetric_and_positive_definite_at_all_frequencies(name):
    inertia = coefficients(ship(name), OMEGA, 0.0).inertia
    np.testing.assert_allclose(inertia, inertia.transpose(0, 2, 1), rtol=1e-12)
    scale = np.sqrt(np.einsum("nii->ni", inertia))
    assert np.linalg.eigvalsh(inertia / scale[:, :, None] / scale[:, None, :]).min() > 0


@pytest.mark.parametrize("name", mostly_soak(SHIPS, "wigley", "dtmb5415", "coaster-90m"))
def test_wave_damping_takes_energy_from_every_motion(name):
    s = ship(name)
    about_g = hull_moments(s.hull, 1025.0).at(OMEGA).about(hydrostatics(s).lcb, s.loading.kg - s.hull.draught)
    damping = moment_matrix(about_g.b)
    scale = np.sqrt(np.einsum("nii->ni", np.abs(damping)).max(axis=0))
    eigenvalues = np.linalg.eigvalsh(damping / scale[:, None] / scale)
    assert (
        eigenvalues.min() > -3e-5
    )  # stated error of a spline through the table's frequencies, of each curve's largest


@pytest.mark.parametrize(("method", "tolerance"), [("lewis", 1e-6), ("auto", 6e-3)])
@pytest.mark.parametrize("name", ["box", "series60-cb60"])
def test_sway_force_of_roll_equals_roll_moment_of_sway(name, method, tolerance):
    # Reciprocity, from the two potentials on the contours, summed over the ship. Lewis sections are solved by series, to
    # rounding; close-fit potentials stand on 25 panels and kinks of the offsets are good to half a percent.
    s = ship(name).with_(sections=method, ends="strips")
    table, weight = section_table(s.hull, 1025.0), strips(s.hull).weight
    n4 = table.y * table.nz - table.z * table.ny
    force_of_roll = np.einsum("s,fsn,sn->f", weight, table.psi[..., 1], table.ny)
    moment_of_sway = np.einsum("s,fsn,sn->f", weight, table.psi[..., 0], n4)
    np.testing.assert_allclose(force_of_roll, moment_of_sway, atol=tolerance * np.abs(moment_of_sway).max())


def test_box_is_its_section_times_the_closed_form_lengthwise_integrals():
    box = ship("box").with_(ends="strips")
    length, z0, omega = box.hull.length, box.loading.kg - box.hull.draught, 0.7
    sections = hydrodynamics(box, [omega]).added_mass.values[0] / length  # sections about G
    got = by_name(coefficients(box, omega, 0.0))
    a22, a24, a44 = sections[0, 0], sections[0, 1], sections[1, 1]
    wanted = {
        "Y_vdot": -a22 * length,
        "K_vdot": -a24 * length,
        "K_pdot": -a44 * length,
        "N_rdot": -a22 * length**3 / 12,
    }
    for name, value in wanted.items():
        assert got[name] == pytest.approx(value, rel=1e-4), name
    assert abs(got["N_vdot"]) < 1e-9 * a22 * length**2
    zero = section_table(box.hull, 1025.0).a_zero[0]
    at_rest = by_name(coefficients(box, 0.0, 0.0))
    assert at_rest["Y_pdot"] == pytest.approx(-(zero[1] - z0 * zero[0]) * length, rel=1e-12)
    assert at_rest["K_pdot"] == pytest.approx(-(zero[2] - 2 * z0 * zero[1] + z0**2 * zero[0]) * length, rel=1e-12)


@pytest.mark.parametrize("name", ["series60-cb60", "box"])
def test_interpolated_strip_coefficients_agree_with_the_direct_solution(name):
    s, omega, speed = (
        ship(name).with_(ends="strips", linear="strip", roll_damping=0.0),
        np.array([0.31, 0.55, 0.83, 1.27]),
        6.0,
    )
    c, direct = coefficients(s, omega, speed), hydrodynamics(s, omega, speed)
    mass = c.body["m"]
    linear = c.linear + mass * speed * np.array([[0, 0, 1], [0, 0, 0], [0, 0, 0]])
    for got, wanted in (
        (linear, -direct.damping.values),
        (c.inertia - rigid_inertia(c.body), direct.added_mass.values),
    ):
        np.testing.assert_allclose(got, wanted, atol=1e-4 * np.abs(wanted).max(axis=0).max(), rtol=2e-3)


def test_default_linear_terms_at_zero_frequency_are_the_regression_alone():
    # no waves at omega = 0, and none of the speed terms of strip theory (U int a22 would be in N_v)
    c = coefficients(S60.with_(roll_damping=0.0), 0.0, SPEED)
    floating, hull = hydrostatics(S60), S60.hull
    wanted = hull_lift(S60, SPEED)
    wanted[0, 2] -= floating.mass * SPEED
    np.testing.assert_allclose(c.linear[0], wanted, rtol=1e-12)
    # about midship the set is Clarke's own: N_v at G plus x_G Y_v
    prime = clarke_derivatives(hull.length, hull.beam, hull.draught, floating.cb)
    n_v = to_si("N_v", prime["N_v"], hull.length, SPEED, 1025.0)
    assert c.linear[0, 2, 0] + floating.lcb * c.linear[0, 0, 0] == pytest.approx(n_v, rel=1e-12)
    munk = coefficients(S60.with_(linear="strip"), 0.0, SPEED).linear[0, 2, 0]
    assert munk == pytest.approx(-SPEED * (c.inertia[0, 0, 0] - c.body["m"]), rel=1e-12)
    assert 0.2 < c.linear[0, 2, 0] / munk < 0.8  # lift takes about half of the Munk moment away


def test_added_roll_damping_is_the_stated_fraction_at_the_natural_frequency():
    c, bare = coefficients(S60, 0.4, SPEED), coefficients(S60.with_(roll_damping=0.0), 0.4, SPEED)
    at_n2 = coefficients(S60, c.roll_frequency, 0.0).inertia[0]
    added = c.linear[0] - bare.linear[0]
    assert added[1, 1] == pytest.approx(-2 * 0.05 * c.roll_frequency * at_n2[1, 1], rel=1e-12)
    assert np.count_nonzero(added) == 1


def test_natural_roll_frequency_is_that_of_the_undamped_coupled_system():
    c = coefficients(S60, 0.4, 0.0)
    at_n2 = coefficients(S60, c.roll_frequency, 0.0)
    square = -np.linalg.inv(at_n2.inertia[0])[1, 1] * at_n2.terms["K_phi"].value[0]
    assert c.roll_frequency == pytest.approx(np.sqrt(square), rel=1e-12)


def test_series60_has_the_roll_frequency_and_course_stability_found_independently():
    # An earlier, separate computation on the same lines (GM 0.05 B, k_xx 0.35 B, Fn 0.25): n2 0.467 rad/s; largest
    # calm-water exponent about +0.13 1/s by strip theory, negative and above -0.04 by Clarke's regression.
    lewis = S60.with_(sections="lewis")  # the sections of that computation; the true contours give 0.3 % less
    assert coefficients(lewis, 0.4, 0.0).roll_frequency == pytest.approx(0.467, abs=0.001)
    assert coefficients(S60, 0.4, 0.0).roll_frequency == pytest.approx(0.467, rel=0.005)
    assert calm_water_exponents(S60.with_(linear="strip"), SPEED).real.max() == pytest.approx(0.13, abs=0.01)
    assert -0.04 < calm_water_exponents(S60, SPEED).real.max() < 0


def test_calm_water_exponents_satisfy_the_equations_of_motion():
    c = coefficients(S60, [0.0, 0.467], SPEED)
    for k in range(2):
        for exponent in np.linalg.eigvals(state_matrix(c, k)):
            pencil = exponent * c.inertia[k] - c.linear[k] + 0j
            pencil[1, 1] -= c.terms["K_phi"].value[k] / exponent
            scale = np.sqrt(np.abs(np.diag(c.inertia[k])))
            values = np.linalg.svd(pencil / scale[:, None] / scale, compute_uv=False)
            assert values[-1] < 1e-10 * values[0]


def test_calm_water_exponents_hold_the_course_roots_of_rest_and_the_roll_roots_of_roll():
    course, roll = np.split(calm_water_exponents(S60, SPEED), 2)
    c = coefficients(S60, [0.0, coefficients(S60, 0.0, 0.0).roll_frequency], SPEED)
    slow, at_n2 = (np.linalg.eigvals(state_matrix(c, k)) for k in range(2))
    assert all(np.abs(slow - root).min() < 1e-12 for root in course)
    assert all(np.abs(at_n2 - root).min() < 1e-12 for root in roll)
    assert np.abs(roll.imag) == pytest.approx(c.roll_frequency, rel=0.02)
    at_rest = calm_water_exponents(S60, 0.0)
    np.testing.assert_allclose(at_rest[:2], 0.0, atol=1e-12)  # nothing resists a slow drift without speed


@given(st.floats(0.02, 30.0), st.floats(0.1, 2.0), st.floats(0.0, 0.35))
@settings(max_examples=2, deadline=None)  # each solves the sections of a hull anew
def test_coefficients_obey_froude_scaling(scale, omega_hat, froude):
    # similar ships at equal omega sqrt(L/g) and Fn: every value goes with scale^(3 kg + m + s/2) of its unit
    wigley = ship("wigley")
    hull, loading = wigley.hull, wigley.loading
    large = replace(
        wigley,
        hull=scaled(hull, scale, scale, scale),
        loading=replace(
            loading,
            gm=loading.gm * scale,
            kg=loading.kg * scale,
            gyradius_roll=loading.gyradius_roll * scale,
            gyradius_yaw=loading.gyradius_yaw * scale,
        ),
    )
    tables = []
    for s in (wigley, large):
        omega = omega_hat * np.sqrt(GRAVITY / s.hull.beam)
        tables.append(by_name(coefficients(s, omega, froude * np.sqrt(GRAVITY * s.hull.length))))
    largest = max(abs(v) for v in tables[0].values())
    for name, value in tables[0].items():
        kg, metre, second = (0, 0, 0) if name == DRAG_NAME else dimension(name)
        wanted = value * scale ** (3 * kg + metre + second / 2)
        tolerance = 1e-9 * largest * scale ** (3 * kg + metre + second / 2)
        assert tables[1][name] == pytest.approx(wanted, rel=1e-6, abs=tolerance), name


def test_many_conditions_at_once_equal_one_at_a_time():
    omega, speed = np.array([0.0, 0.2, 0.9, 3.0]), np.array([0.0, 4.0, 8.0, 2.0])
    together = coefficients(S60, omega, speed)
    for k in range(4):
        alone = coefficients(S60, omega[k], speed[k])
        np.testing.assert_allclose(together.inertia[k], alone.inertia[0], rtol=1e-13)
        np.testing.assert_allclose(together.linear[k], alone.linear[0], rtol=1e-13)


@pytest.mark.parametrize("linear", ["default", "strip"])
def test_zero_speed_and_zero_frequency_give_numbers(linear):
    c = coefficients(S60.with_(linear=linear), [0.0, 0.0, 0.5], [0.0, SPEED, 0.0])
    for values in (c.inertia, c.linear, *(term.value for term in c.terms.values())):
        assert np.isfinite(values).all()


def test_a_ship_that_overtakes_the_wave_has_the_coefficients_of_the_folded_frequency():
    np.testing.assert_array_equal(coefficients(S60, -0.4, SPEED).linear, coefficients(S60, 0.4, SPEED).linear)


@pytest.mark.parametrize(("frequency", "speed"), [(np.nan, 5.0), (0.5, np.nan), (0.5, -1.0), (np.inf, 1.0)])
def test_bad_conditions_are_refused(frequency, speed):
    with pytest.raises(InputError):
        coefficients(S60, frequency, speed)
    with pytest.raises(InputError):
        hydrodynamics(S60, frequency, speed)


def test_restoring_is_the_righting_arm_of_the_lines():
    c, fit = coefficients(S60, 0.5, 0.0), righting_polynomial(S60)
    weight = hydrostatics(S60).mass * GRAVITY
    assert c.terms["K_phi"].value[0] == pytest.approx(-weight * S60.loading.gm, rel=1e-12)
    assert c.terms["K_phiphiphi"].value[0] == pytest.approx(-weight * fit.gz3, rel=1e-12)
    assert not any(c.terms[name].value.any() for row in (RESTORING_NAMES[0], RESTORING_NAMES[2]) for name in row)


def test_a_given_coefficient_replaces_the_estimate_and_a_multiplier_scales_it():
    given = with_coefficients(S60, Y_v=-1e6, N_rdot=-9e9, K_ppp=-5e6, K_phi=-4e7, Y_vvr=-7.0, Y_r=2e7)
    c = by_name(coefficients(given.with_(factors={"K_ppp": 0.5, "N_v": 2.0, "N_vvr": 3.0}), 0.5, SPEED))
    plain = by_name(coefficients(S60, 0.5, SPEED))
    wanted = {"Y_v": -1e6, "N_rdot": -9e9, "K_ppp": -2.5e6, "K_phi": -4e7, "Y_rvv": -7.0, "Y_r": 2e7}
    wanted |= {"N_v": 2 * plain["N_v"], "N_rvv": 3 * plain["N_rvv"]}
    for name, value in plain.items():
        assert c[name] == pytest.approx(wanted.get(name, value), rel=1e-12), name


@pytest.mark.parametrize("name", KNOWN)
def test_every_name_a_ship_file_may_give_reaches_the_coefficients(name):
    ship = S60.with_(autopilot=Autopilot(gain=1.0)) if name in RUDDER_NAMES else S60  # what moves the rudder
    c = coefficients(with_coefficients(ship, **{name: 123.0}), 0.5, SPEED)
    assert by_name(c)[canonical(name)] == pytest.approx(123.0, abs=1e-5)  # beside 1e10 kg m2 of added inertia


def test_y_r_in_the_equations_contains_minus_m_u_once():
    given = coefficients(with_coefficients(S60, Y_r=2e7), 0.5, SPEED)
    assert given.linear[0, 0, 2] == pytest.approx(2e7 - hydrostatics(S60).mass * SPEED, rel=1e-12)


def test_terms_beyond_the_cubics_are_passed_on():
    extra = {"K_p|p|": -3e6, "K_vvphi": 2e5, "K_phi5": 7e6}
    c = coefficients(with_coefficients(S60, **extra).with_(factors={"K_p|p|": 2.0}), 0.5, SPEED)
    assert {name: c.terms[name].value[0] for name in ("K_p|p|", "K_vvphi")} == {"K_p|p|": -6e6, "K_vvphi": 2e5}
    assert c.terms["K_phi5"].value[0] == 7e6
    assert [entry.name for entry in c.table()][-2:] == ["K_p|p|", "K_vvphi"]


def test_a_multiplier_of_a_term_without_value_is_refused_with_the_nearest_name():
    with pytest.raises(InputError, match=r"K_p\|p\|"):
        coefficients(S60.with_(factors={"K_p|p|": 2.0}), 0.5, SPEED)


def test_drag_by_strips_is_one_coefficient_among_the_estimates():
    table = coefficients(S60.with_(drag="strips", drag_coefficient=0.9), 0.5, SPEED).table()
    entry = {one.name: one for one in table}["C_D"]
    assert (entry.value, entry.unit, entry.kind, entry.estimated) == (0.9, "1", "cross-flow", True)
    assert not {name for row in CUBIC_NAMES for name in row} & {one.name for one in table}


def test_the_table_names_unit_source_and_kind_of_every_coefficient_in_a_fixed_order():
    table = coefficients(with_coefficients(S60, Y_v=-1e6), 0.5, SPEED).table()
    names = [entry.name for entry in table]
    assert names[:7] == ["m", "I_x", "I_z", "I_xz", "Y_vdot", "Y_pdot", "Y_rdot"]
    assert names[-10:] == [f"N_{monomial}" for monomial in CUBIC_MONOMIALS]
    assert len(names) == len(set(names)) == 4 + 9 + 9 + 12 + 30
    kinds = {entry.name: entry.kind for entry in table}
    assert (kinds["Y_v"], kinds["N_v"], kinds["Y_vdot"], kinds["K_ppp"], kinds["K_phi"]) == (
        "given", "regression", "strip", "cross-flow", "derived",
    )  # fmt: skip
    for entry in table:
        assert entry.unit == unit(entry.name)
        assert entry.source
        if entry.kind in ("regression", "cross-flow"):
            assert entry.source.startswith("estimated")


def test_a_measured_coefficient_is_called_measured():
    tank = replace(with_coefficients(S60, N_v=-5e7), provenance={**S60.provenance, "N_v": "measured: towing tank"})
    entry = next(e for e in coefficients(tank, 0.5, SPEED).table() if e.name == "N_v")
    assert (entry.kind, entry.source) == ("measured", "measured: towing tank")


def test_strip_terms_of_the_aft_end_are_kept_for_a_transom_only():
    # box: Y_v = -(int b22 + U a22 at the transom); Series 60 has a pointed stern: no speed term in Y_v
    for name, transom in (("box", True), ("series60-cb60", False)):
        s = ship(name).with_(ends="strips", linear="strip")
        at_speed, at_rest = (coefficients(s, 0.6, u).linear[0, 0, 0] for u in (5.0, 0.0))
        end = hull_moments(s.hull, 1025.0).at([0.6]).about(0.0, 0.0)
        assert (end.aft is not None) == transom
        wanted = -5.0 * end.aft[0][0, 0, 0] if end.aft else 0.0
        assert at_speed - at_rest == pytest.approx(wanted, rel=1e-9)


def test_hydrodynamics_is_labelled_and_keeps_the_order_asked_for():
    ds = hydrodynamics(S60, [0.9, 0.3, 0.9], speed=SPEED)
    np.testing.assert_array_equal(ds.frequency, [0.9, 0.3, 0.9])
    np.testing.assert_array_equal(ds.added_mass[0], ds.added_mass[2])
    assert float(ds.added_mass[1, 0, 0]) > float(ds.added_mass[0, 0, 0]) > 0  # sway added mass falls past its hump
    for key in ("axes", "reference_point", "density", "method", "references"):
        assert ds.attrs[key]
    for variable in ds.data_vars.values():
        assert {"units", "long_name", "symbol"} <= set(variable.attrs)


def test_low_frequency_options_differ_only_where_they_say():
    low, high = 0.5 * frequency_floor(S60.hull.beam), 0.5
    cap, drop = (hydrodynamics(S60, [low, high], SPEED, low_frequency=o) for o in ("cap", "drop"))
    np.testing.assert_allclose(cap.damping, drop.damping, rtol=1e-12)
    a = hydrodynamics(S60, [low, high], 0.0).added_mass
    np.testing.assert_allclose(drop.added_mass, a, rtol=1e-12)
    assert not np.allclose(cap.added_mass[1], a[1], rtol=1e-3)
    slow = hydrodynamics(S60, [low, high], SPEED, low_frequency="manoeuvring")
    np.testing.assert_allclose(slow.damping, -np.stack([hull_lift(S60, SPEED)] * 2), rtol=1e-12)
    np.testing.assert_allclose(slow.added_mass[0], hydrodynamics(S60, [0.0]).added_mass[0], rtol=1e-12)
    with pytest.raises(InputError, match="manoeuvring"):
        hydrodynamics(S60, [low], SPEED, low_frequency="none")  # type: ignore[arg-type]


def test_roll_that_has_no_frequency_or_negative_damping_is_refused():
    with pytest.raises(InputError, match="GM"):
        natural_roll_frequency(0.0, lambda _: 1.0, 3.0)
    with pytest.raises(InputError, match="radius of gyration"):
        natural_roll_frequency(100.0, lambda _: 1.0, 3.0)
    with pytest.raises(InputError, match="common value"):
        fraction_of_critical(-0.01, 0.5, 1.0)
