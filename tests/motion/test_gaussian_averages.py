"""Averages over Gaussian motion against quadrature, and the closure of two oscillators against its closed form."""

import numpy as np
import pytest
from scipy.integrate import quad

from quartering.hull.righting.spline import odd_spline
from quartering.motion.equations.system import restoring_table
from quartering.motion.equations.terms import term_table
from quartering.motion.sea.averages import averages, drag_averages

ROOT = np.array([[0.5, 0, 0, 0], [0.2, 0.3, 0, 0], [-0.1, 0.1, 0.4, 0], [0.05, -0.1, 0.1, 0.2]])
COVARIANCE = ROOT @ ROOT.T
NODES, WEIGHTS = np.polynomial.hermite_e.hermegauss(8)
NAMES = ["Y_vvv", "K_vpr", "K_phi5", "K_phi7", "N_vr", "K_prr", "K_phiphiphi", "Y_vphi", "N_rrv"]


def found(table, mean, spline=None):
    gain, force = np.zeros((3, 4)), np.zeros(3)
    knots, cubics = (np.zeros(0), np.zeros((0, 4))) if spline is None else restoring_table(spline)
    coefficients = np.ascontiguousarray(table.coefficients)
    averages(
        table.powers, table.modulus, coefficients, knots, np.ascontiguousarray(cubics), mean, COVARIANCE, gain, force
    )
    return gain, force


@pytest.mark.parametrize("mean", [np.zeros(4), np.array([0.2, -0.1, 0.0, 0.3])], ids=["centred", "biased"])
def test_products_have_the_averages_of_quadrature(mean):
    """Gauss-Hermite rules of 8 points in four variables: exact for polynomials to degree 15; slopes by E[f (u - m)] C^-1."""
    table = term_table({name: 0.5 + 0.1 * k for k, name in enumerate(NAMES)})
    grid = np.stack(np.meshgrid(*[NODES] * 4, indexing="ij")).reshape(4, -1)
    weight = np.prod(np.stack(np.meshgrid(*[WEIGHTS] * 4, indexing="ij")).reshape(4, -1), axis=0) / (2 * np.pi) ** 2
    u = ROOT @ grid
    values = table.coefficients @ np.prod((u + mean[:, None])[None] ** table.powers[:, :, None], axis=1)
    gain, force = found(table, mean)
    np.testing.assert_allclose(force, values @ weight, atol=1e-13)
    np.testing.assert_allclose(gain, (values * weight) @ u.T @ np.linalg.inv(COVARIANCE), atol=1e-12)


def normal(x, mean, deviation):
    return np.exp(-0.5 * ((x - mean) / deviation) ** 2) / (deviation * np.sqrt(2 * np.pi))


@pytest.mark.parametrize("mean", [0.0, 0.25])
def test_kinked_terms_have_the_averages_of_quadrature(mean):
    """Adaptive quadrature; y |x| through the regression of y on x."""
    m = np.array([mean, -mean, 0.5 * mean, 0.0])
    v, p, s = np.sqrt(COVARIANCE[0, 0]), COVARIANCE[0, 2], np.sqrt(COVARIANCE[0, 0])
    size = quad(lambda x: abs(x) * normal(x, m[0], s), -5, 5, points=[0.0])[0]
    sign = quad(lambda x: np.sign(x) * (m[2] + p / v**2 * (x - m[0])) * normal(x, m[0], s), -5, 5, points=[0.0])[0]
    gain, force = found(term_table({"K_p|v|": 2.0, "Y_v|v|": 3.0}), m)
    np.testing.assert_allclose([gain[1, 2], gain[1, 0], gain[0, 0]], [2 * size, 2 * sign, 6 * size], rtol=1e-9)
    square = quad(lambda x: x * abs(x) * normal(x, m[0], s), -5, 5, points=[0.0])[0]
    np.testing.assert_allclose(force[0], 3 * square, atol=1e-10)
    spline = odd_spline([10, 20, 30, 45], [-1.0, -1.8, -1.9, -0.5])
    gain, force = found(term_table({}), m, spline)
    d, points = np.sqrt(COVARIANCE[1, 1]), [*(-np.append(0.0, spline.knots)), *spline.knots]

    def beyond(x):
        return spline.value(x) - spline.slope * x

    value = quad(lambda x: beyond(x) * normal(x, m[1], d), -4, 4, points=points, limit=200)[0]
    slope = quad(lambda x: beyond(x) * (x - m[1]) / d**2 * normal(x, m[1], d), -4, 4, points=points, limit=200)[0]
    np.testing.assert_allclose([force[1], gain[1, 1]], [value, slope], rtol=1e-8, atol=1e-12)
    drag, push = np.zeros(1), np.zeros(3)
    drag_averages(
        np.array([[1.0, -2.0, 3.0]]), np.array([4.0]), np.array([mean, 0.0, 0.0]), np.array([v**2]), drag, push
    )
    np.testing.assert_allclose(drag, 8 * size, rtol=1e-9)
    np.testing.assert_allclose(push, -4 * square * np.array([1.0, -2.0, 3.0]), atol=1e-10)


# Statistical linearisation of x'' + c x' + b x'^3 + x = w and of x'' + c x' + x + k3 x^3 + k5 x^5 = w, T = D/c: the root of
# <x^2> (c + 3 b <x^2>) = D, and of <x^2> (1 + 3 k3 <x^2> + 15 k5 <x^2>^2) = T, as an independent program has them
DAMPED = [(0.05, 0.5, 0.005, 0.0434258545911), (0.05, 1.0, 0.01, 0.05), (0.1, 0.3, 0.02, 0.103531345147)]
STIFF = [(-0.6, 0.5, 0.15, 0.165308160436), (0.5, 0.0, 0.2, 0.16107989914)]


def test_gains_close_two_oscillators():
    c, gain, force = np.zeros((4, 4)), np.zeros((3, 4)), np.zeros(3)

    def gain_of(terms, variance):
        c[1, 1] = c[2, 2] = variance
        table = term_table(terms)
        arrays = (table.powers, table.modulus, np.ascontiguousarray(table.coefficients), np.zeros(0), np.zeros((0, 4)))
        averages(*arrays, np.zeros(4), c, gain, force)
        return gain[1]

    for linear, b, noise, x2 in DAMPED:
        np.testing.assert_allclose(x2 * (linear + gain_of({"K_ppp": b}, x2)[2]), noise, rtol=1e-9)
    for k3, k5, temperature, x2 in STIFF:
        terms = {"K_phiphiphi": k3} | ({"K_phi5": k5} if k5 else {})
        np.testing.assert_allclose(x2 * (1 + gain_of(terms, x2)[1]), temperature, rtol=1e-9)
