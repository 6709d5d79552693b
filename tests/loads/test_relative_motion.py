from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from quartering.conventions import GRAVITY
from quartering.hull.lines.strips import Strips
from quartering.loads.strips.relative_motion import relative_motion_diffraction, section_average
from tests.loads.hulls import box, phasor, rows, stations_of, wigley

REFERENCE = rows("strip_correction_box_reference.csv")
BOX = box(100.0, 20.0, 5.0)
WIGLEY = wigley(100.0, 10.0, 6.25)
FORMS = ("paper", "paper-corrected", "relative-motion")


def constant_table(strips, a, b, frequency=(0.1, 1.0)):
    """A table of coefficients a, b = [22, 24, 44], the same at all sections and frequencies."""
    shape = (len(frequency), strips.x.size, 1)
    return SimpleNamespace(
        frequency=np.array(frequency), a=np.tile(np.array(a, float), shape), b=np.tile(np.array(b, float), shape)
    )


@pytest.mark.parametrize(
    ("form", "column", "transom"),
    [
        ("paper", "paper", True),
        ("paper-corrected", "corrected", True),
        ("relative-motion", "relative", True),
        ("relative-motion", "relative_pointed", False),
    ],
)
def test_reference_box_of_8_conditions_to_1e_11(form, column, transom):
    errors, scales = [], []
    for r in REFERENCE:
        a, b = ([r[f"{letter}{ij}"] for ij in (22, 24, 44)] for letter in "ab")
        table = constant_table(BOX, a, b, frequency=[r["omega"]])
        stations = stations_of(BOX, 0.0, r["x0"], transom, length=r["L"])
        ours = relative_motion_diffraction(
            BOX, stations, table, [2 * np.pi / r["lam"]], [r["U"]], [r["mu"]], form=form
        )[0]
        expected = phasor(r, f"{column}_")
        errors.append(np.abs(ours - expected))
        scales.append(np.abs(expected))
    assert len(errors) == 8
    assert np.all(np.array(errors) < 1e-11 * np.max(scales, axis=0))


@pytest.mark.parametrize("factor", [1.0, 2.0])
def test_average_over_a_rectangle_closed_form(factor):
    k, mu = np.array([0.01, 0.1, 0.3]), np.array([90.0, 40.0, 10.0])
    k2 = k * np.sin(np.deg2rad(mu))
    exact = np.sin(k2 * 10) / (k2 * 10) * (1 - np.exp(-factor * k * 5)) / (factor * k * 5)
    np.testing.assert_allclose(
        section_average(BOX, k, mu, depth_factor=factor), np.tile(exact[:, None], 40), rtol=1e-13
    )


def test_average_over_a_triangle_closed_form_in_a_head_sea():
    depth = (np.polynomial.legendre.leggauss(12)[0][None] + 1) / 2
    dz = -np.polynomial.legendre.leggauss(12)[1][None] / 2
    one = np.ones(1)
    triangle = Strips(0 * one, one, 1 - depth, depth, -dz, dz, one, one, one)
    k = 0.8
    exact = 2 * (k - 1 + np.exp(-k)) / k**2
    assert section_average(triangle, [k], [180.0])[0, 0] == pytest.approx(exact, rel=1e-13)


@settings(max_examples=40, deadline=None)
@given(st.floats(1e-4, 0.5), st.floats(-180, 180))
def test_average_of_the_wave_motion_is_at_most_one_and_even_in_heading(k, mu):
    left, right = section_average(WIGLEY, [k, k], [mu, -mu])
    assert np.all(np.abs(left) <= 1)
    np.testing.assert_allclose(left, right, rtol=1e-12)


def test_average_over_a_section_without_breadth_is_the_average_over_its_depth():
    z, dz = np.full((1, 1), 0.5), np.full((1, 1), -1.0)
    one = np.ones(1)
    line = Strips(0 * one, one, 0 * z, z, 0 * z, dz, 0 * one, one, 0 * one)
    assert section_average(line, [0.4], [90.0])[0, 0] == pytest.approx(np.exp(-0.2), rel=1e-15)
    nothing = Strips(0 * one, one, 0 * z, 0 * z, 0 * z, 0 * z, 0 * one, 0 * one, 0 * one)
    assert section_average(nothing, [0.4], [90.0])[0, 0] == 1.0


@pytest.mark.parametrize("form", FORMS)
def test_waves_from_the_other_side_reverse_the_force_and_head_seas_push_nothing(form):
    table = constant_table(WIGLEY, [4e4, -3e4, 1.5e6], [1.5e4, -1.2e4, 2e5])
    stations = stations_of(WIGLEY, 0.4, 2.0)
    mu = np.array([35.0, -35.0, 0.0, 180.0])
    force = relative_motion_diffraction(WIGLEY, stations, table, np.full(4, 0.05), np.full(4, 8.0), mu, form=form)
    np.testing.assert_allclose(force[0], -force[1], rtol=1e-12)
    np.testing.assert_array_equal(force[2:], 0.0)


def test_relative_motion_about_g_from_coefficients_moved_to_g_gives_the_same_force():
    """The two ways of taking one reference point agree: V2 at G = V2 at O + z0 V4, coefficients moved to G."""
    a, b, z0, k, mu, U = np.array([4e4, -3e4, 1.5e6]), np.array([1.5e4, -1.2e4, 2e5]), 1.3, 0.06, 50.0, 7.0
    sigma, delta = np.sqrt(GRAVITY * k), np.pi - np.deg2rad(mu)
    k1, k2 = k * np.cos(delta), k * np.sin(delta)
    w, x = sigma + U * k1, BOX.x - 2.0
    table, stations = constant_table(BOX, a, b, frequency=[w]), stations_of(BOX, z0, 2.0, True, 100.0)
    force = relative_motion_diffraction(BOX, stations, table, [k], [U], [mu], form="relative-motion")[0]
    c22, c24, c44 = a + b / (1j * w)
    c22, c24, c44 = c22, c24 - z0 * c22, c44 - 2 * z0 * c24 + z0**2 * c22
    V4 = -1j * sigma * k2 * np.sin(k2 * 10) / (k2 * 10)
    V2 = 1j * sigma * np.sin(delta) * section_average(BOX, [k], [mu], depth_factor=2)[0, 0] + z0 * V4
    m2, m4, E, end = c22 * V2 + c24 * V4, c24 * V2 + c44 * V4, np.exp(1j * k1 * x), np.exp(1j * k1 * -52.0)
    expected = [
        1j * w * m2 * (BOX.weight @ E) + U * m2 * end,
        1j * w * m4 * (BOX.weight @ E) + U * m4 * end,
        m2 * (BOX.weight @ ((1j * w * x + U) * E)) - 52.0 * U * m2 * end,
    ]
    np.testing.assert_allclose(force, expected, rtol=1e-12)


@pytest.mark.parametrize("form", FORMS)
def test_zero_and_negative_encounter_frequency_give_finite_forces(form):
    k, mu = 0.08, 0.0
    crest_speed = np.sqrt(GRAVITY / k)
    table = constant_table(WIGLEY, [4e4, -3e4, 1.5e6], [1.5e4, -1.2e4, 2e5])
    for U in (crest_speed / np.cos(np.deg2rad(20.0)), crest_speed, 2 * crest_speed):
        for mu in (0.0, 20.0):
            assert np.isfinite(
                relative_motion_diffraction(WIGLEY, stations_of(WIGLEY), table, [k], [U], [mu], form=form)
            ).all()


def test_overtaking_ship_feels_damping_that_still_opposes_relative_motion():
    """Section force f = a du/dt + b u of the signal itself, written at a negative frequency."""
    one = np.ones(1)
    sheet = Strips(0 * one, one, *(np.full((1, 1), v) for v in (1e-6, 1e-6, 0.0, -1e-6)), 1e-6 * one, 1e-6 * one, one)
    k, mu, U, a, b = 0.1, 60.0, 40.0, 3.0, 0.7
    sigma = np.sqrt(GRAVITY * k)
    omega = sigma - k * U * np.cos(np.deg2rad(mu))
    assert omega < 0
    table = constant_table(sheet, [a, 0, 0], [b, 0, 0], frequency=[-omega])
    ours = relative_motion_diffraction(sheet, stations_of(sheet), table, [k], [U], [mu], form="relative-motion")[0, 0]
    velocity = 1j * sigma * np.sin(np.deg2rad(mu))
    assert ours == pytest.approx(1j * omega * a * velocity + b * velocity, rel=1e-5)
