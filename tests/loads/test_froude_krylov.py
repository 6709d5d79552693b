import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from quartering.conventions import GRAVITY, WATER_DENSITY
from quartering.hull.lines.strips import Strips
from quartering.loads.strips.froude_krylov import froude_krylov
from tests.loads.hulls import box, gauss, phasor, rows, stations_of, wigley

pytestmark = pytest.mark.quick

RG = WATER_DENSITY * GRAVITY
REFERENCE = rows("froude_krylov_reference.csv")
BOX = box(100.0, 20.0, 5.0)
WIGLEY = wigley(100.0, 10.0, 6.25)
LOPSIDED = wigley(100.0, 10.0, 6.25, stations=30)


def of_rows(strips, table):
    """The 24 conditions have two centres; each row is a batch of one."""
    place = [stations_of(strips, r["z0"], r["x0"]) for r in table]
    return np.array(
        [
            froude_krylov(strips, s, [2 * np.pi / r["wave_length"]], [r["mu"]])[0]
            for s, r in zip(place, table, strict=True)
        ]
    )


def volume_form(beam, draught, length, z0, x0, k, mu, wall_sided):
    """Printed (B-4) with F from the calm plane: (3,) phasor, hull by formula, Gauss points in x and y."""
    x, dx = gauss(-length / 2, length / 2, 64)
    t, dt = gauss(0, 1, 40)
    b = beam / 2 * (np.ones_like(x) if wall_sided else 1 - (2 * x / length) ** 2)
    y, F, dy = (t, draught + 0 * t, dt) if wall_sided else (1 - t**2, draught * t, 2 * t * dt)
    y, w = np.outer(b, y), np.outer(b * dx, dy)
    delta = np.pi - np.deg2rad(mu)
    k1, k2 = k * np.cos(delta), k * np.sin(delta)
    e, x = np.exp(-k * F), (x - x0)[:, None]
    braces = (F + 1 / k) * e - 1 / k + z0 * (e - 1)
    c1, s1, c2, s2 = np.cos(k1 * x), np.sin(k1 * x), np.cos(k2 * y), np.sin(k2 * y)
    cos = [
        2 * (k2 / k) * np.sum(w * (e - 1) * c1 * c2),
        -2 * np.sum(w * (y * e * c1 * s2 + (k2 / k) * braces * c1 * c2)),
        2 * np.sum(w * ((k1 / k) * y * (e - 1) * s1 * s2 + (k2 / k) * x * (e - 1) * c1 * c2)),
    ]
    sin = [
        -2 * (k2 / k) * np.sum(w * (e - 1) * s1 * c2),
        2 * np.sum(w * (y * e * s1 * s2 + (k2 / k) * braces * s1 * c2)),
        2 * np.sum(w * ((k1 / k) * y * (e - 1) * c1 * s2 - (k2 / k) * x * (e - 1) * s1 * c2)),
    ]
    return RG * (np.array(cos) - 1j * np.array(sin))


def box_closed_form(length, beam, draught, z0, x0, k, mu):
    """Pressure on the faces of a box barge, integrated by hand."""
    delta, b = np.pi - np.deg2rad(mu), beam / 2
    k1, k2 = k * np.cos(delta), k * np.sin(delta)
    a, c, e = -length / 2 - x0, length / 2 - x0, np.exp(-k * draught)
    E0 = (np.exp(1j * k1 * c) - np.exp(1j * k1 * a)) / (1j * k1)
    E1 = (c * np.exp(1j * k1 * c) - a * np.exp(1j * k1 * a) - E0) / (1j * k1)
    s, J = np.sin(k2 * b) / k2, (np.sin(k2 * b) - k2 * b * np.cos(k2 * b)) / k2**2
    braces = (draught + 1 / k) * e - 1 / k + z0 * (e - 1)
    return 2 * RG * np.array([
        (k2 / k) * (e - 1) * s * E0,
        -(e * J + (k2 / k) * braces * s) * E0,
        (e - 1) * ((k2 / k) * s * E1 - 1j * (k1 / k) * J * E0),
    ])  # fmt: skip


@pytest.mark.parametrize(("name", "strips"), [("box", BOX), ("wigley", WIGLEY)])
def test_reference_set_of_24_conditions_to_1e_11(name, strips):
    table = [r for r in REFERENCE if r["hull"] == name]
    assert len(table) == 24
    expected = np.array([phasor(r) for r in table])
    assert np.all(np.abs(of_rows(strips, table) - expected) < 1e-11 * np.abs(expected).max(axis=0))


@pytest.mark.parametrize(("name", "strips", "wall_sided"), [("box", BOX, True), ("wigley", WIGLEY, False)])
def test_section_contour_form_agrees_with_the_printed_volume_form_b4(name, strips, wall_sided):
    table = [r for r in REFERENCE if r["hull"] == name]
    shape = [(r["beam"], r["draught"], r["length"], r["z0"], r["x0"]) for r in table]
    printed = np.array(
        [volume_form(*s, 2 * np.pi / r["wave_length"], r["mu"], wall_sided) for s, r in zip(shape, table, strict=True)]
    )
    assert np.all(np.abs(of_rows(strips, table) - printed) < 1e-10 * np.abs(printed).max(axis=0))


@settings(max_examples=60, deadline=None)
@given(st.floats(0.002, 0.25), st.floats(5.0, 85.0), st.floats(-3.0, 3.0), st.floats(-10.0, 10.0))
def test_box_barge_closed_form_over_waves_headings_and_centres(k, mu, z0, x0):
    force = froude_krylov(BOX, stations_of(BOX, z0, x0), [k], [mu])[0]
    scale = RG * 2000.0 * np.array([1.0, 10.0, 50.0])
    assert np.all(np.abs(force - box_closed_form(100.0, 20.0, 5.0, z0, x0, k, mu)) < 1e-10 * scale)


def test_long_beam_wave_limit_is_displaced_mass_times_acceleration_and_stiffness_times_slope():
    k, z0 = 1e-6, 1.0
    Y, K, _ = froude_krylov(BOX, stations_of(BOX, z0), [k], [90.0])[0]
    volume, bm, depth_of_buoyancy = 100 * 20 * 5.0, 20**2 / (12 * 5.0), 2.5
    gm = bm - (z0 + depth_of_buoyancy)
    assert Y.real == pytest.approx(-RG * volume * k, rel=1e-4)
    assert K.real == pytest.approx(RG * volume * gm * -k, rel=1e-4)
    assert abs(Y.imag) < 1e-12 * abs(Y)


@pytest.mark.parametrize("mu", [30.0, 120.0])
def test_long_oblique_wave_limit_of_yaw_moment_closed_form(mu):
    k, delta = 1e-5, np.pi - np.deg2rad(mu)
    k1, k2 = k * np.cos(delta), k * np.sin(delta)
    N = froude_krylov(BOX, stations_of(BOX, 0.0, 4.0), [k], [mu])[0, 2]
    volume = 100 * 20 * 5.0
    first, xx, yy = -4.0 * volume, (100**2 / 12 + 16.0) * volume, 20**2 / 12 * volume
    expected = -RG * k2 * first - 1j * RG * k1 * k2 * (xx - yy)
    assert N.real == pytest.approx(expected.real, rel=1e-3)
    assert N.imag == pytest.approx(expected.imag, rel=1e-3)


def test_head_and_following_seas_push_nothing_sideways():
    force = froude_krylov(WIGLEY, stations_of(WIGLEY, -1.25, 3.0), [0.05, 0.05, 0.05], [0.0, 180.0, -180.0])
    np.testing.assert_array_equal(force, 0.0)


@settings(max_examples=50, deadline=None)
@given(st.floats(0.005, 0.3), st.floats(0.0, 180.0))
def test_waves_from_the_other_side_reverse_the_force(k, mu):
    stations = stations_of(LOPSIDED, -1.25, 3.0)
    port, starboard = froude_krylov(LOPSIDED, stations, [k, k], [mu, -mu])
    np.testing.assert_allclose(port, -starboard, rtol=1e-9, atol=1e-3)


@settings(max_examples=50, deadline=None)
@given(st.floats(0.005, 0.3), st.floats(1.0, 179.0))
def test_a_fore_and_aft_symmetric_hull_sees_the_same_force_and_opposite_yaw_moment_at_the_opposite_heading(k, mu):
    ahead, astern = froude_krylov(WIGLEY, stations_of(WIGLEY), [k, k], [mu, 180.0 - mu])
    scale = np.abs(ahead).max()
    np.testing.assert_allclose(astern, ahead * [1, 1, -1], rtol=1e-9, atol=1e-9 * scale)


@settings(max_examples=40, deadline=None)
@given(st.floats(0.01, 0.2), st.floats(0.0, 180.0), st.floats(-4.0, 4.0), st.floats(-20.0, 20.0))
def test_moving_g_moves_the_moments_like_any_force(k, mu, z0, x0):
    about_o = froude_krylov(WIGLEY, stations_of(WIGLEY), [k], [mu])[0]
    about_g = froude_krylov(WIGLEY, stations_of(WIGLEY, z0, x0), [k], [mu])[0]
    shifted = about_o * np.exp(1j * k * np.cos(np.pi - np.deg2rad(mu)) * -x0)  # the phase is counted from G
    expected = [shifted[0], shifted[1] - z0 * shifted[0], shifted[2] - x0 * shifted[0]]
    np.testing.assert_allclose(about_g, expected, rtol=1e-9, atol=1e-7 * np.abs(expected).max())


def test_three_dimensional_panel_code_capytaine_gives_the_same_force_and_phase_on_wigley_iii():
    hull = wigley(3.0, 0.3, 0.1875, bluntness=0.2)
    table = [r for r in rows("wigley3_forces_3d.csv") if r["force"] == "FK"]
    sign = {"sway": -1, "roll": 1, "yaw": -1}  # their y to port, z up
    for mode, column in (("sway", 0), ("roll", 1), ("yaw", 2)):
        chosen = [r for r in table if r["mode"] == mode]
        k, mu = np.array([r["omega"] ** 2 / GRAVITY for r in chosen]), np.array([-r["heading"] for r in chosen])
        ours = (froude_krylov(hull, stations_of(hull), k, mu, density=1000.0)[:, column] / 1j).conj() * sign[mode]
        theirs = np.array([r["real"] + 1j * r["imag"] for r in chosen])
        finest = np.array([r["finest_real"] + 1j * r["finest_imag"] for r in chosen])
        assert len(chosen) == 18
        assert np.abs(ours - theirs).max() < np.abs(finest - theirs).max()


def test_force_converges_at_the_second_order_of_the_trapezoidal_rule_on_a_trapezoidal_contour():
    errors = []
    exact = froude_krylov(BOX, stations_of(BOX), [0.1], [50.0])[0]
    for points in (8, 16, 32):
        z = np.linspace(5.0, 0.0, points + 1)
        dz = np.full(points + 1, -5.0 / points)
        dz[[0, -1]] /= 2
        yb = np.linspace(0.0, 10.0, points + 1)
        dyb = np.full(points + 1, 10.0 / points)
        dyb[[0, -1]] /= 2
        contour = (
            np.r_[yb, np.full(points + 1, 10.0)],
            np.r_[np.full(points + 1, 5.0), z],
            np.r_[dyb, 0 * dz],
            np.r_[0 * dyb, dz],
        )
        s = BOX.x.size
        coarse = Strips(
            BOX.x, BOX.weight, *(np.tile(c, (s, 1)) for c in contour), BOX.half_breadth, BOX.draught, BOX.area
        )
        errors.append(np.abs(froude_krylov(coarse, stations_of(coarse), [0.1], [50.0])[0] - exact))
    order = np.log2(np.array(errors[0]) / errors[1]), np.log2(np.array(errors[1]) / errors[2])
    np.testing.assert_allclose(order, 2.0, atol=0.05)
