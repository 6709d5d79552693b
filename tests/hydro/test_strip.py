"""Strip theory: the reference numbers of the derivatives, moving the reference point, limits and symmetry."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from quartering.hydro.strip.integrals import about_gravity_centre, moment_matrix, section_moments, shifted_moments
from quartering.hydro.strip.lateral import derivatives_from_moments
from quartering.hydro.transfer import transfer

pytestmark = pytest.mark.quick

# Gauss-Legendre nodes: the integrands of the reference are polynomials, so its integrals are exact.
X, WEIGHT = np.polynomial.legendre.leggauss(8)
X, WEIGHT = 50 * X, 50 * WEIGHT
A_BASE = np.array([40000.0, -30000.0, 1500000.0])
B_BASE = np.array([15000.0, -12000.0, 200000.0])
SPEED, FREQUENCY = 6.0, 0.7

# 40-digit computation of the lateral derivatives with transom terms; section coefficients about G are
# base * (1 - x/50)(1 + x/60) on -50 < x < 50, U = 6 m/s, omega = 0.7 rad/s.
WITH_TRANSOM = {
    "Y_v": -1163333.3333333335, "Y_vdot": -2827664.3990929704, "Y_p": 926666.6666666667, "Y_pdot": 2117687.0748299323,
    "Y_r": 8166666.666666666, "Y_rdot": 8049886.6213151915, "K_v": 926666.6666666667, "K_vdot": 2117687.0748299323,
    "K_p": -17444444.444444448, "K_pdot": -107517006.8027211, "K_r": -6333333.333333334, "K_rdot": -5884353.741496598,
    "N_v": -9166666.66666667, "N_vdot": 21315192.743764173, "N_p": 6666666.666666668, "N_pdot": -16496598.639455784,
    "N_r": -758333333.3333334, "N_rdot": -1564625850.3401358,
}  # fmt: skip


def strip_derivatives(x, weight, a, b, speed, frequency, aft=None):
    """Derivatives of sections that are integrated here; `aft` is place, added mass and damping of a transom."""
    ends = None if aft is None else tuple(section_moments([aft[0]], [1.0], one[None]) for one in aft[1:])
    moments = (section_moments(x, weight, one) for one in (a, b))
    return derivatives_from_moments(*moments, speed, frequency, aft=ends)


def shape(x):
    return (1 - x / 50) * (1 + x / 60)


def reference_derivatives(**options):
    profile = shape(X)[:, None]
    return strip_derivatives(X, WEIGHT, A_BASE * profile, B_BASE * profile, SPEED, FREQUENCY, **options)


def test_derivatives_with_transom_meet_the_reference_numbers():
    end = shape(-50.0)
    damping, inertia = reference_derivatives(aft=(-50.0, A_BASE * end, B_BASE * end))
    for i, row in enumerate("YKN"):
        for j, factor in enumerate("vpr"):
            assert damping[i, j] == pytest.approx(WITH_TRANSOM[f"{row}_{factor}"], rel=1e-11)
            assert inertia[i, j] == pytest.approx(WITH_TRANSOM[f"{row}_{factor}dot"], rel=1e-11)


def test_without_transom_terms_each_entry_is_the_integral_of_the_table():
    # closed form: int p = 200/3 + 250/9 .. by exact rational integration of p = 1 - x/300 - x^2/3000 over (-50, 50)
    p0, p1, p2 = 100 - 250000 / 9000, -250000 / 900, 250000 / 3 - 2 * 50**5 / 5 / 3000
    a, b, u, w = A_BASE, B_BASE, SPEED, FREQUENCY
    damping, inertia = reference_derivatives()
    wanted_damping = -np.array(
        [
            [b[0] * p0, b[1] * p0, b[0] * p1],
            [b[1] * p0, b[2] * p0, b[1] * p1],
            [b[0] * p1 + u * a[0] * p0, b[1] * p1 + u * a[1] * p0, b[0] * p2 + u * a[0] * p1],
        ]
    )
    wanted_inertia = -np.array(
        [
            [a[0] * p0, a[1] * p0, a[0] * p1],
            [a[1] * p0, a[2] * p0, a[1] * p1],
            [a[0] * p1 - u / w**2 * b[0] * p0, a[1] * p1 - u / w**2 * b[1] * p0, a[0] * p2 - u / w**2 * b[0] * p1],
        ]
    )
    np.testing.assert_allclose(damping, wanted_damping, rtol=1e-11)
    np.testing.assert_allclose(inertia, wanted_inertia, rtol=1e-11)


def test_section_coefficients_move_to_g_as_a_rigid_shift():
    # congruent transform of the 2 x 2 section matrix with v_O = v - z0 p
    c22, c24, c44, z0 = 2.0, -0.7, 5.0, 0.9
    move = np.array([[1, -z0], [0, 1]])
    wanted = move.T @ np.array([[c22, c24], [c24, c44]]) @ move
    got = about_gravity_centre([c22, c24, c44], z0)
    np.testing.assert_allclose(got, [wanted[0, 0], wanted[0, 1], wanted[1, 1]], rtol=1e-14)


@given(st.floats(-20, 20), st.lists(st.floats(-1e3, 1e3), min_size=3, max_size=3))
@settings(max_examples=50, deadline=None)
def test_moving_a_section_there_and_back_is_the_identity(z0, coefficients):
    back = about_gravity_centre(about_gravity_centre(coefficients, z0), -z0)
    np.testing.assert_allclose(back, coefficients, atol=1e-9)


@given(st.floats(-20, 20), st.floats(-5, 5))
@settings(max_examples=50, deadline=None)
def test_moving_the_moments_equals_moving_the_whole_ship_matrix(x_g, z0):
    # two routes: shift section by section and integrate, or integrate about O and move the 3 x 3 matrix.
    # G sees O at (-x_g, z0).
    moments = section_moments(X, WEIGHT, A_BASE * shape(X)[:, None])
    by_section = section_moments(X - x_g, WEIGHT, about_gravity_centre(A_BASE * shape(X)[:, None], z0))
    moved = moment_matrix(shifted_moments(moments, x_g, z0))
    scale = np.abs(moved).max()
    np.testing.assert_allclose(moved, moment_matrix(by_section), atol=1e-12 * scale)
    np.testing.assert_allclose(moved, transfer(moment_matrix(moments), -x_g, z0), atol=1e-12 * scale)


def test_box_has_the_closed_form_of_a_uniform_ship():
    # constant section coefficients over (-L/2, L/2): S0 = c L, S1 = 0, S2 = c L^3/12
    length = 100.0
    damping, inertia = strip_derivatives(X, WEIGHT, np.tile(A_BASE, (8, 1)), np.tile(B_BASE, (8, 1)), SPEED, FREQUENCY)
    a, b, u = A_BASE * length, B_BASE * length, SPEED
    np.testing.assert_allclose(
        damping,
        -np.array([[b[0], b[1], 0], [b[1], b[2], 0], [u * a[0], u * a[1], b[0] * length**2 / 12]]),
        rtol=1e-12,
        atol=1e-6,
    )
    k = u / FREQUENCY**2
    np.testing.assert_allclose(
        inertia,
        -np.array([[a[0], a[1], 0], [a[1], a[2], 0], [-k * b[0], -k * b[1], a[0] * length**2 / 12]]),
        rtol=1e-12,
        atol=1e-5,
    )


def test_speed_terms_reproduce_the_seakeeping_coefficients_of_salvesen_tuck_faltinsen():
    # STF70 in inertial axes, pointed stern, sway-yaw: A26 = int x a22 + U/w^2 B22, B26 = int x b22 - U A22,
    # A62 = int x a22 - U/w^2 B22, B62 = int x b22 + U A22, A66 = int x^2 a22 + U^2/w^2 A22, B66 = .. + U^2/w^2 B22.
    # Forces on eta_2, eta_6 with v = i w eta_2 - U eta_6, r = i w eta_6 (sway-yaw keeps its sign between the axes).
    x, weight = np.polynomial.legendre.leggauss(10)
    x, weight = 50 * x, 50 * weight
    p = (1 - (x / 50) ** 2) * (1 + x / 90)  # zero at both ends
    damping, inertia = strip_derivatives(x, weight, A_BASE * p[:, None], B_BASE * p[:, None], SPEED, FREQUENCY)
    w, u = FREQUENCY, SPEED
    c = damping + 1j * w * inertia  # force = c (v, p, r)
    motion = {"sway": np.array([1j * w, 0, 0]), "yaw": np.array([-u, 0, 1j * w])}
    (a22, a26, a66), (b22, b26, b66) = (
        [base * (weight * p * x**k).sum() for k in range(3)] for base in (A_BASE[0], B_BASE[0])
    )
    added = {"22": a22, "26": a26 + u / w**2 * b22, "62": a26 - u / w**2 * b22, "66": a66 + u**2 / w**2 * a22}
    damp = {"22": b22, "26": b26 - u * a22, "62": b26 + u * a22, "66": b66 + u**2 / w**2 * b22}
    for name, row, mode in (("22", 0, "sway"), ("26", 0, "yaw"), ("62", 2, "sway"), ("66", 2, "yaw")):
        force = (c @ motion[mode])[row]
        assert force == pytest.approx(w**2 * added[name] - 1j * w * damp[name], rel=1e-11), name


def test_the_floor_holds_the_frequency_of_the_speed_terms_and_infinity_drops_them():
    profile = shape(X)[:, None]
    a, b = section_moments(X, WEIGHT, A_BASE * profile), section_moments(X, WEIGHT, B_BASE * profile)
    _, capped = derivatives_from_moments(a, b, SPEED, 0.01, floor=FREQUENCY)
    _, free = derivatives_from_moments(a, b, SPEED, FREQUENCY)
    np.testing.assert_allclose(capped, free, rtol=1e-14)
    _, dropped = derivatives_from_moments(a, b, SPEED, FREQUENCY, floor=np.inf)
    np.testing.assert_allclose(dropped, -moment_matrix(a), rtol=1e-14)


def test_zero_frequency_and_zero_speed_give_numbers():
    profile = shape(X)[:, None]
    damping, inertia = strip_derivatives(X, WEIGHT, A_BASE * profile, 0 * B_BASE * profile, [0.0, SPEED], 0.0)
    assert np.isfinite(damping).all()
    assert np.isfinite(inertia).all()
    assert not damping[0].any()


def test_many_conditions_at_once_equal_one_at_a_time():
    rng = np.random.default_rng(5)
    a, b = rng.uniform(1, 2, (4, 8, 3)), rng.uniform(1, 2, (4, 8, 3))
    speed, frequency = np.array([0.0, 3.0, 6.0, 9.0]), np.array([0.3, 0.5, 0.7, 0.9])
    together = strip_derivatives(X, WEIGHT, a, b, speed, frequency)
    for i in range(4):
        alone = strip_derivatives(X, WEIGHT, a[i], b[i], speed[i], frequency[i])
        np.testing.assert_allclose(together[0][i], alone[0], rtol=1e-13)
        np.testing.assert_allclose(together[1][i], alone[1], rtol=1e-13)
