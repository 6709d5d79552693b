"""Stability of a ship that is kept on course: five or six multipliers."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import brentq

import quartering as qt
from quartering.stability.assessment import assess
from quartering.stability.contribution import contributions
from quartering.stability.variational.hill import hill_exponents
from tests.motion.test_autopilot import AUTOPILOTS, INERTIA, TERMS, model_with
from tests.tiers import mostly_soak

LINEAR = {name: value for name, value in TERMS.items() if name not in ("K_phiphiphi", "K_ppp", "K_prr")}


def written_out(autopilot, terms=LINEAR, inertia=INERTIA):
    """Matrix of (v, phi, p, r, psi, delta), or without delta, put together from the raw numbers by hand."""
    right = np.zeros((3, 6))
    for k, row in enumerate("YKN"):
        right[k] = [terms.get(f"{row}_{s}", 0.0) for s in ("v", "phi", "p", "r", "psi", "delta")]
    a = np.zeros((6, 6))
    a[[0, 2, 3]] = np.linalg.solve(inertia, right)
    a[1, 2] = a[4, 3] = 1.0
    order = np.array([0, 0, 0, -autopilot.rate_gain, -autopilot.gain, 0])
    if autopilot.lag:
        a[5] = (order - np.eye(6)[5]) / autopilot.lag
        return a
    a += np.outer(a[:, 5], order)
    return a[:5, :5]


@pytest.mark.parametrize("autopilot", AUTOPILOTS, ids=str)
def test_multipliers_of_linear_equations_are_those_of_the_matrix_exponential(autopilot):
    """Closed form: Phi(T) = exp(A T)."""
    model = qt.Model(INERTIA, LINEAR, 0.85, (0.1, 0.05, 0.06), (0, 0.12, 0.1), autopilot=autopilot)
    verdict = qt.stability(model, qt.steady_motion(model))
    exact = np.linalg.eigvals(expm(written_out(autopilot) * 2 * np.pi / 0.85))
    np.testing.assert_allclose(np.sort(np.abs(verdict.multipliers)), np.sort(np.abs(exact)), rtol=0, atol=1e-10)
    calm = np.sort_complex(np.linalg.eigvals(written_out(autopilot)))
    np.testing.assert_allclose(np.sort_complex(verdict.calm_water), calm, rtol=0, atol=1e-12)


@pytest.mark.parametrize("mean", [(0.0, 0.0, 0.0), (0.02, 0.1, 0.05)], ids=["symmetric", "wind"])
@pytest.mark.parametrize("autopilot", mostly_soak(AUTOPILOTS, AUTOPILOTS[-1]), ids=str)
def test_hill_and_the_monodromy_matrix_agree_and_keep_liouville(autopilot, mean):
    model = model_with(autopilot, mean)
    motion = qt.steady_motion(model, 9)
    verdict = qt.stability(model, motion)
    by_hill, defect = hill_exponents(model, motion, 12)
    np.testing.assert_allclose(np.sort(by_hill.real), np.sort(verdict.exponents.real), rtol=0, atol=1e-9)
    assert verdict.liouville < 1e-9
    assert defect < 1e-9


def test_gains_of_zero_give_the_papers_multipliers_and_one_for_the_heading():
    bare, idle = (model_with(a) for a in (None, qt.Autopilot(0.0, 0.0)))
    paper, found = (qt.stability(model, qt.steady_motion(model, 5)) for model in (bare, idle))
    assert found.multipliers.shape == (5,)
    assert found.multipliers[-1] == 1.0
    np.testing.assert_allclose(found.multipliers[:4], paper.multipliers, rtol=1e-9, atol=1e-12)
    assert (found.stable, found.kind) == (paper.stable, paper.kind)
    assert found.k2 == pytest.approx(paper.k2, rel=1e-12)
    assert "does not act on the heading" in found.sentence


def test_first_order_course_modes_approach_floquet_as_the_coupling_to_roll_weakens():
    """The averaged course matrix leaves out the roll's fast oscillation: its error falls with the square of the coupling."""
    errors = []
    for size in (0.2, 0.1, 0.05):
        terms = dict(LINEAR) | {"K_v": 0.5 * size, "K_r": 0.3 * size, "N_p": 0.4 * size, "K_delta": 0.2 * size}
        model = qt.Model(np.eye(3), terms, 0.85, (0, 0.05, 0), (0, 0, 0), autopilot=qt.Autopilot(0.2, 1.0, 1.5))
        verdict = qt.stability(model, qt.steady_motion(model))
        course = [e.real for e in verdict.calm_water if abs(abs(e.imag) - 1.0) > 0.15]
        errors.append(np.abs(np.sort(course) - np.sort(verdict.slow)).max())
        roll = max(e.real for e in verdict.calm_water if abs(abs(e.imag) - 1.0) < 0.15)
        assert roll == pytest.approx(-verdict.index, abs=1.0 * size**2)
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.3)
    assert errors[1] / errors[2] == pytest.approx(4, rel=0.3)


def routh(polynomial):
    """First column of the Routh array: as many changes of sign as roots to the right of the imaginary axis."""
    width = (len(polynomial) + 1) // 2
    rows = np.zeros((len(polynomial), width))
    rows[0, : len(polynomial[0::2])] = polynomial[0::2]
    rows[1, : len(polynomial[1::2])] = polynomial[1::2]
    for i in range(2, len(polynomial)):
        above, twice = rows[i - 1], rows[i - 2]
        rows[i, :-1] = twice[1:] - twice[0] / above[0] * above[1:]
    return rows[:, 0]


def test_a_course_unstable_ship_is_cured_at_the_gain_routh_asks_for():
    """Authority: Routh's criterion on the characteristic polynomial of the written-out matrix, sway, roll, yaw, psi and delta.

    Series 60, C_B 0.80, at 11 m/s and 10 deg to waves of her length: course-unstable without waves.
    """
    wave, speed, heading, gain, lag = qt.Wave(121.92, 0.1), 11.0, 10.0, 0.1, 2.0
    ship = qt.paper_ship("series60-cb80")  # |q| q would damp the course in any wave
    bare = qt.equations(ship, wave, speed, heading)
    assert qt.stability(bare, qt.steady_motion(bare, 3)).kind == "course-in-calm-water"
    steered = qt.equations(ship.with_(autopilot=qt.Autopilot(gain, 0.0, lag)), wave, speed, heading)

    def least(rate_gain):
        matrix = written_out(qt.Autopilot(gain, rate_gain, lag), steered.terms, steered.inertia)
        return float(routh(np.poly(matrix)).min())

    assert least(0.0) < 0 < least(60.0)
    needed = brentq(least, 0.0, 60.0, xtol=1e-10)
    for rate_gain, stable in ((0.99 * needed, False), (1.01 * needed, True)):
        model = replace(steered, autopilot=qt.Autopilot(gain, rate_gain, lag))
        verdict = qt.stability(model, qt.steady_motion(model, 3))
        assert bool(verdict.calm_water[0].real < 0) is stable
        assert verdict.stable is stable
        assert verdict.multipliers.shape == (6,)
    assert "The autopilot keeps the course, which without it is lost in calm water" in verdict.sentence
    assert verdict.without_autopilot > 0


def test_a_map_finds_the_multipliers_to_its_accuracy():
    systems = model_with(AUTOPILOTS[1])
    motion = qt.steady_motion(systems, 5)
    u, orders = motion.coefficients[None], motion.orders_with_mean
    fine = assess(systems.system, u, orders, 1e-12).floquet.multipliers
    coarse = assess(systems.system, u, orders, 5e-6, detail="map").floquet.multipliers
    np.testing.assert_allclose(np.abs(coarse), np.abs(fine), rtol=0, atol=5e-6)


def test_share_of_the_autopilot_in_the_growth_rate_is_the_derivative_by_its_rudder():
    """Authority: central differences of the eigenvalue of the mean variational matrix, the motion held."""
    model = model_with(AUTOPILOTS[0])
    motion = qt.steady_motion(model, 5)

    def roll_rate(factor):
        terms = {name: value * (factor if name.endswith("delta") else 1.0) for name, value in model.terms.items()}
        eigenvalues = qt.stability(replace(model, terms=terms), motion).mean_jacobian
        return max(eigenvalues, key=lambda e: abs(e.imag)).real

    slope = (roll_rate(1 + 1e-4) - roll_rate(1 - 1e-4)) / 2e-4
    assert contributions(model, motion, oscillating=True)["autopilot"] == pytest.approx(slope, abs=1e-8)
