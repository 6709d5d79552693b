"""Cross-flow cubics: dissipative, equal to the direct integral, and of the dissipation of the drag law."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from quartering.conventions import CUBIC_MONOMIALS, InputError
from quartering.hydro.manoeuvring.crossflow import ENERGY_CUBE, cross_flow_cubics, reference_velocity

pytestmark = pytest.mark.quick

X, WEIGHT = np.polynomial.legendre.leggauss(12)
X, WEIGHT = 60.0 * X - 3.0, 60.0 * WEIGHT
DRAUGHT = 6.5 * (1 - 0.3 * (X / 63) ** 2)
LEVER = 0.7 + DRAUGHT / 2
SCALE, DENSITY, DRAG = 1.1, 1025.0, 0.8
CUBICS = cross_flow_cubics(X, WEIGHT, DRAUGHT, LEVER, DRAG, SCALE, DENSITY)

velocity = st.floats(-3.0, 3.0)
rate = st.floats(-0.3, 0.3)


def monomials(v, p, r):
    letter = {"v": v, "p": p, "r": r}
    return np.array([np.prod([letter[c] for c in monomial]) for monomial in CUBIC_MONOMIALS])


@given(velocity, rate, rate)
@settings(max_examples=200, deadline=None)
def test_cross_flow_never_gives_energy_to_the_ship(v, p, r):
    force = CUBICS @ monomials(v, p, r)
    scale = np.abs(np.array([v, p, r]) * (np.abs(CUBICS) @ np.abs(monomials(v, p, r)))).sum()
    assert v * force[0] + p * force[1] + r * force[2] <= 1e-12 * scale


@given(velocity, rate, rate)
@settings(max_examples=100, deadline=None)
def test_the_ten_cubics_equal_the_direct_integral_of_the_local_cube(v, p, r):
    local = -0.5 * DENSITY * DRAG * DRAUGHT * ENERGY_CUBE / SCALE * (v + X * r - LEVER * p) ** 3 * WEIGHT
    direct = np.array([local.sum(), (-LEVER * local).sum(), (X * local).sum()])
    scale = np.abs(CUBICS) @ np.abs(monomials(v, p, r))
    np.testing.assert_allclose(CUBICS @ monomials(v, p, r), direct, atol=1e-13 * scale.max(), rtol=1e-10)


def test_energy_constant_dissipates_what_the_modulus_law_dissipates_over_a_cycle():
    # quadrature of both dissipated energies over a cycle of u = u0 cos t
    for u0 in (0.3, 2.0):
        modulus = quad(lambda t, u0=u0: abs(u0 * np.cos(t)) ** 3, 0, 2 * np.pi, points=[np.pi / 2, 3 * np.pi / 2])[0]
        cube = quad(lambda t, u0=u0: ENERGY_CUBE / u0 * (u0 * np.cos(t)) ** 4, 0, 2 * np.pi)[0]
        assert cube == pytest.approx(modulus, rel=1e-12)


def test_uniform_hull_has_the_closed_form_of_a_rectangular_plate():
    # constant draught T and lever h, x in (-a, a): int dx = 2a, int x^2 dx = 2a^3/3, int x^4 dx = 2a^5/5
    a, t, h = 50.0, 5.0, 3.0
    x, w = np.polynomial.legendre.leggauss(6)
    c = -0.5 * DENSITY * DRAG * t * 32 / (9 * np.pi) / SCALE
    cubics = cross_flow_cubics(a * x, a * w, np.full(6, t), np.full(6, h), DRAG, SCALE, DENSITY)
    got = {f"{row}_{m}": cubics[i, j] for i, row in enumerate("YKN") for j, m in enumerate(CUBIC_MONOMIALS)}
    i0, i2, i4 = 2 * a, 2 * a**3 / 3, 2 * a**5 / 5
    wanted = {
        "Y_vvv": i0, "Y_ppp": -(h**3) * i0, "Y_vpp": 3 * h**2 * i0, "Y_vrr": 3 * i2, "Y_pvv": -3 * h * i0,
        "Y_prr": -3 * h * i2, "K_ppp": h**4 * i0, "K_vvv": -h * i0, "K_vrr": -3 * h * i2, "K_prr": 3 * h**2 * i2,
            "K_pvv": 3 * h**2 * i0, "K_vpp": -3 * h**3 * i0,
        "N_rrr": i4, "N_rvv": 3 * i2, "N_rpp": 3 * h**2 * i2, "N_vpr": -6 * h * i2,
    }  # fmt: skip
    for name, value in wanted.items():
        assert got[name] == pytest.approx(c * value, rel=1e-12), name
    largest = np.abs(cubics).max()
    for name in set(got) - set(wanted):
        assert abs(got[name]) < 1e-12 * largest, name


@pytest.mark.parametrize(
    ("scale", "drag"), [(0.0, 0.8), (-1.0, 0.8), (float("nan"), 0.8), (1.0, -0.1), (1.0, float("nan"))]
)
def test_bad_scale_or_drag_is_refused(scale, drag):
    with pytest.raises(InputError, match=r"velocity scale|drag coefficient"):
        cross_flow_cubics(X, WEIGHT, DRAUGHT, LEVER, drag, scale, DENSITY)


def test_reference_velocity_follows_froude_scaling():
    assert reference_velocity(400.0) == pytest.approx(2 * reference_velocity(100.0), rel=1e-14)
