"""The exact derivatives against differences of motions solved again and integrated over the whole cycle."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import quartering as qt
from quartering.hull.autopilot import Autopilot
from quartering.motion.equations.batch import joined
from quartering.motion.equations.terms import parse
from quartering.motion.steady.derivative import OFFSETS, difference, products, states_along
from quartering.motion.steady.harmonic import harmonic_balance, orders_for
from quartering.stability.assessment import assess
from quartering.stability.variational.hill import exponents_of_batch
from quartering.study.effects.sensitivity import coefficient_rows, derivatives

SHIP = qt.paper_ship("series60-cb60")  # every term has a name and all derivatives
LENGTH = SHIP.hull.length
WAVE, SPEED, HEADING = qt.Wave(LENGTH, LENGTH / 60), 8.0, 45.0
MEASURES = ("sway", "roll", "yaw", "k2", "index", "exponent")

INERTIA = np.array([[1.3, 0.2, 0.1], [0.2, 1.1, -0.05], [0.1, -0.05, 1.2]])
TERMS = {
    "Y_v": -0.5, "Y_p": 0.06, "Y_r": -0.3, "K_v": 0.1, "K_p": -0.12, "K_r": 0.05, "N_v": -0.1, "N_p": 0.03, "N_r": -0.7,
    "K_phi": -1.4, "K_phiphiphi": 0.5, "K_phi5": -0.2, "Y_vvv": -0.4, "K_ppp": -0.1, "K_prr": 0.2, "K_vpp": 0.07,
    "N_rrr": -0.3, "N_rvv": 0.2, "N_vpr": 0.1, "K_vvphi": 0.15,
}  # fmt: skip
RUDDER = {"Y_delta": 0.1, "K_delta": -0.05, "N_delta": -0.4}
FORCE = {"force_cos": (0.2, 0.1, 0.05), "force_sin": (-0.1, 0.15, 0.1)}


def model(terms=TERMS, **more):
    return qt.Model(INERTIA, terms, 0.8, **FORCE, **more)


MODELS = {
    "symmetric": model(),
    "steady heel": model(force_mean=(0.02, 0.15, 0.01)),
    "rudder at once": model(TERMS | RUDDER, autopilot=Autopilot(gain=0.5, rate_gain=1.0)),
    "rudder that lags": model(TERMS | RUDDER, autopilot=Autopilot(gain=0.5, rate_gain=1.0, lag=0.7)),
    "rudder that lags, steady heel": model(
        TERMS | RUDDER, autopilot=Autopilot(gain=0.5, rate_gain=1.0, lag=0.7), force_mean=(0.02, 0.15, 0.01)
    ),
}


def measures(system, orders, start):
    """Amplitudes, K2, index and leading exponent (n, 6) of the motions nearest to `start`."""
    u, _, _ = harmonic_balance(system, orders, start=np.repeat(start[None], system.count, axis=0))
    first = 1 if orders[0] == 0 else 0
    amplitude = np.hypot(u[:, :, first], u[:, :, first + 1]) * [1, 180 / np.pi, 180 / np.pi]
    judged = assess(system, u, orders, accuracy=1e-12)
    return np.column_stack([amplitude, judged.first_order.k2, judged.first_order.index, judged.floquet.growth])


def resolved(around, orders, start, step):
    """Derivatives (m, 6) by differences of motions, from m times four systems, one at each of `OFFSETS` times the step."""
    found = measures(joined([one for four in around for one in four]), orders, start)
    return difference(found.reshape(len(around), OFFSETS.size, -1).swapaxes(0, 1), step)


@pytest.mark.parametrize("name", MODELS)
def test_every_coefficient_of_a_model_agrees_with_motions_solved_again(name):
    one = MODELS[name]
    orders, step = orders_for(one.system, 3), 1e-3
    u = harmonic_balance(one.system, orders)[0][0]
    rows = coefficient_rows(one)
    here, slopes, why = derivatives(one.system, [row.change for row in rows], u, orders)
    assert why == ""
    assert len(rows) == len(one.terms)
    assert here[5] == pytest.approx(exponents_of_batch(one.system, u[None], orders, reach=8)[0][0, 0].real, rel=1e-8)
    around = [
        [replace(one, terms=dict(one.terms) | {row.name: row.value * (1 + step * o)}).system for o in OFFSETS]
        for row in rows
    ]
    np.testing.assert_allclose(slopes, resolved(around, orders, u, step), rtol=1e-6, atol=1e-9)


@pytest.fixture(scope="module")
def table():
    return qt.sensitivity(SHIP, WAVE, SPEED, HEADING)


def changed_model(name, value):
    """The equations of the ship with one parameter of the table at another value."""
    if name in ("gm", "kg", "gyradius_roll", "gyradius_yaw", "roll_damping"):
        return qt.equations(SHIP.with_(**{name: value}), WAVE, SPEED, HEADING)
    if name == "speed":
        return qt.equations(SHIP, WAVE, value, HEADING)
    if name == "wave_height":
        return qt.equations(SHIP, qt.Wave(WAVE.length, value), SPEED, HEADING)
    one = qt.equations(SHIP, WAVE, SPEED, HEADING)
    return replace(one, terms=dict(one.terms) | {name: value})


def test_every_parameter_of_a_ship_agrees_with_motions_solved_again(table):
    """KG changes GM ten times as much, relatively: a step of 1e-4 leaves its differences exact to 1e-6 too."""
    system = qt.equations(SHIP, WAVE, SPEED, HEADING).system
    orders, step = orders_for(system, 3), 1e-4
    u = harmonic_balance(system, orders, from_rest=True)[0][0]
    names, values = table["parameter"].values.tolist(), table["value"].values
    design = {"gm", "kg", "gyradius_roll", "gyradius_yaw", "roll_damping", "speed", "wave_height"}
    assert design < set(names)
    around = [
        [changed_model(name, value * (1 + step * o)).system for o in OFFSETS]
        for name, value in zip(names, values, strict=True)
    ]
    expected = resolved(around, orders, u, step)
    base = np.abs([table.attrs[f"base_{m}"] for m in MEASURES])
    found = np.column_stack([table[m] for m in MEASURES])
    error = np.abs(found - expected) / np.maximum(np.abs(expected), 0.01 * base)
    assert error.max() < 1e-6, {name: one.max() for name, one in zip(names, error, strict=True) if one.max() > 1e-6}


@pytest.mark.parametrize(
    "changes",
    [{}, {"roll_damping": "ikeda", "bilge_keels": (30.0, 0.33)}],
    ids=str,
)
def test_force_and_nonlinear_terms_balance(changes):
    """Closed form (Euler): a motion s times as large solves the equations with s times the force and each product of
    degree d divided by s^(d - 1), and is as stable."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", qt.RangeWarning)
        ship = SHIP.with_(**changes)
        ds = qt.sensitivity(ship, qt.Wave(LENGTH, LENGTH / 40), SPEED, 60.0)
    total = {m: float(ds[m].sel(parameter="wave_height")) for m in MEASURES}
    for name in ds["parameter"].values:
        if name[:2] in ("Y_", "K_", "N_"):
            for m in MEASURES:
                total[m] -= (parse(name)[1].degree - 1) * float(ds[m].sel(parameter=name))
    expected = [ds.attrs[f"base_{m}"] if m in ("sway", "roll", "yaw") else 0.0 for m in MEASURES]
    scale = np.abs([ds.attrs[f"base_{m}"] for m in MEASURES])
    np.testing.assert_allclose(np.array(list(total.values())) / scale, expected / scale, atol=1e-6)


def judged_by_pieces(one, u, orders):
    """K2 and leading exponent of a motion whose one modulus is p|p|: integrated from one zero of p to the next."""
    w, s = one.frequency, one.system

    def state(t):
        return states_along(u[None], s.frequency, orders, np.array([w * t]))[0, 0]

    grid = np.linspace(0.0, np.pi / w, 200)
    rates = [state(t)[2] for t in grid]
    zeros = [brentq(lambda t: state(t)[2], a, b, xtol=1e-14) for a, b, x, y in
             zip(grid[:-1], grid[1:], rates[:-1], rates[1:], strict=True) if x * y < 0]  # fmt: skip
    assert len(zeros) == 1
    sign = np.sign(rates[0])
    phi, stiffness, damping = np.eye(4), 0.0, 0.0

    def slope(t, y, sign):
        product = products(state(t)[None], np.full((1, 4), sign), s.powers, s.modulus)
        rows = s.linear[0] + s.coefficients[0] @ np.stack([product((q,))[0] for q in range(4)], axis=1)
        whole = np.array([rows[0], [0, 0, 1, 0], rows[1], rows[2]])
        return np.append((whole @ y[:16].reshape(4, 4)).ravel(), rows[1, 1:3])

    y = np.append(phi.ravel(), [stiffness, damping])
    for begin, end, side in ((0.0, zeros[0], sign), (zeros[0], np.pi / w, -sign)):
        y = solve_ivp(slope, (begin, end), y, "DOP853", args=(side,), rtol=1e-12, atol=1e-14).y[:, -1]
    mu = np.abs(np.linalg.eigvals(y[:16].reshape(4, 4))).max()
    stiffness, damping = y[16:] * w / np.pi
    return np.array([np.sqrt(-stiffness) * damping, np.log(mu) * w / np.pi])


@pytest.mark.parametrize("name", ["K_p|p|", "K_phi", "K_p"])
def test_modulus_agrees_with_integration_from_zero_to_zero(name):
    """The derivative of p|p|'s slope jumps where p is zero; the reference stops there. Roll shape: identity inertia."""
    terms = {"Y_v": -0.6, "K_p": -0.05, "K_v": 0.1, "N_r": -0.7, "K_phi": -1.4, "K_phiphiphi": 0.4, "K_p|p|": -0.3}
    one = qt.Model(np.eye(3), terms, 0.9, (0.2, 0.25, 0.05), (-0.1, 0.15, 0.1))
    orders, step = (1, 3), 1e-3
    u = harmonic_balance(one.system, orders)[0]
    row = next(row for row in coefficient_rows(one) if row.name == name)
    found = derivatives(one.system, [row.change], u[0], orders)[1][0, [3, 5]]
    others = [replace(one, terms=terms | {name: row.value * (1 + step * o)}) for o in OFFSETS]
    motions = [harmonic_balance(other.system, orders, start=u)[0][0] for other in others]
    expected = difference(
        np.array([judged_by_pieces(o, m, orders) for o, m in zip(others, motions, strict=True)]), step
    )
    np.testing.assert_allclose(found, expected, rtol=1e-6)


def test_exponent_has_no_derivative_where_two_multipliers_meet():
    """Critical damping of uncoupled roll: 2 sqrt(1.0), a double root of the linear motion."""
    one = qt.Model(np.eye(3), {"Y_v": -3.0, "K_p": -2.0, "K_phi": -1.0, "N_r": -3.0}, 0.8, (0, 0.1, 0), (0, 0, 0))
    u = harmonic_balance(one.system, (1, 3))[0][0]
    _, slopes, why = derivatives(one.system, [row.change for row in coefficient_rows(one)], u, (1, 3))
    assert np.isnan(slopes[:, 5]).all()
    assert np.isfinite(slopes[:, 1]).all()
    assert "meet" in why


def test_heading_that_nothing_holds_does_not_lead():
    """Without gain the heading's multiplier is 1; the roll mode's exponent K_p/2 is differentiated (closed form)."""
    terms = {"Y_v": -1.0, "K_p": -0.1, "K_phi": -1.0, "N_r": -1.0, "N_delta": -0.3}
    one = qt.Model(np.eye(3), terms, 0.8, (0, 0.1, 0), (0, 0, 0), autopilot=Autopilot(gain=0.0, rate_gain=1.0))
    u = harmonic_balance(one.system, (1, 3))[0][0]
    rows = coefficient_rows(one)
    here, slopes, _ = derivatives(one.system, [row.change for row in rows], u, (1, 3))
    assert here[5] == pytest.approx(-0.05, abs=1e-9)
    np.testing.assert_allclose(slopes[:, 5], [-0.05 if row.name == "K_p" else 0.0 for row in rows], atol=1e-9)
