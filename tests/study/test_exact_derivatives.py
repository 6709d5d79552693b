"""The exact derivatives against differences of motions solved again, whose exponents come from Hill's determinant."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import quartering as qt
from quartering.hull.autopilot import Autopilot
from quartering.motion.change import OFFSETS, difference, products, states_along
from quartering.motion.harmonic import harmonic_balance, orders_for
from quartering.motion.terms import parse
from quartering.stability.assessment import assess
from quartering.stability.hill import hill_exponents
from quartering.study.family import joined
from quartering.study.sensitivity import coefficient_rows, derivatives

SHIP = qt.ship("series60-cb60")
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
    f = assess(system, u, orders).first_order
    exponent = hill_exponents(system, u, orders, reach=16)[0][:, 0].real
    return np.column_stack([amplitude, f.k2, f.index, exponent])


def resolved(systems, orders, start, step):
    """Derivatives (6,) by differences of the motions of four systems, one at each of `OFFSETS` times the step."""
    return difference(measures(joined(systems), orders, start), step)


@pytest.mark.parametrize("name", MODELS)
def test_every_coefficient_of_a_model_agrees_with_motions_solved_again(name):
    one = MODELS[name]
    orders, step = orders_for(one.system, 5), 1e-3
    u = harmonic_balance(one.system, orders)[0][0]
    rows = coefficient_rows(one)
    here, slopes, why = derivatives(one.system, [row.change for row in rows], u, orders)
    assert why == ""
    assert len(rows) == len(one.terms)
    np.testing.assert_allclose(here, measures(one.system, orders, u)[0], rtol=1e-8)
    for row, found in zip(rows, slopes, strict=True):
        changed = [dict(one.terms) | {row.name: row.value * (1 + step * o)} for o in OFFSETS]
        expected = resolved([replace(one, terms=terms).system for terms in changed], orders, u, step)
        np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-9, err_msg=row.name)


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
    """Of the step: KG changes GM ten times as much, relatively, so it takes a tenth of the others'."""
    system = qt.equations(SHIP, WAVE, SPEED, HEADING).system
    orders = orders_for(system, 3)
    u = harmonic_balance(system, orders, from_rest=True)[0][0]
    assert set(table["parameter"].values) >= {
        "gm", "kg", "gyradius_roll", "gyradius_yaw", "roll_damping", "speed", "wave_height", "K_ppp", "N_r"
    }  # fmt: skip
    base = np.abs([table.attrs[f"base_{m}"] for m in MEASURES])
    for name in table["parameter"].values:
        step, value = 1e-4 if name == "kg" else 1e-3, float(table["value"].sel(parameter=name))
        around = [changed_model(name, value * (1 + step * o)).system for o in OFFSETS]
        expected = resolved(around, orders, u, step)
        found = np.array([float(table[m].sel(parameter=name)) for m in MEASURES])
        error = np.abs(found - expected) / np.maximum(np.abs(expected), 0.01 * base)
        assert error.max() < 1e-6, (name, error)


@pytest.mark.parametrize(
    "changes",
    [{}, {"righting": "spline"}, {"roll_damping": "ikeda", "bilge_keels": (30.0, 0.33)}, {"measured": "none"}],
    ids=str,
)
def test_force_and_nonlinear_terms_balance(changes):
    """Closed form (Euler): a motion s times as large solves the equations with s times the force and each product of
    degree d divided by s^(d - 1), and is as stable."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", qt.RangeWarning)
        ship = SHIP.with_(**changes)
        ds = qt.sensitivity(ship, qt.Wave(LENGTH, LENGTH / 40), SPEED, 60.0)
    if ship.righting == "spline":
        pytest.skip("its knots do not grow with the motion")
    total = {m: float(ds[m].sel(parameter="wave_height")) for m in MEASURES}
    for name in ds["parameter"].values:
        if name[:2] in ("Y_", "K_", "N_"):
            for m in MEASURES:
                total[m] -= (parse(name)[1].degree - 1) * float(ds[m].sel(parameter=name))
    expected = [ds.attrs[f"base_{m}"] if m in ("sway", "roll", "yaw") else 0.0 for m in MEASURES]
    scale = np.abs([ds.attrs[f"base_{m}"] for m in MEASURES])
    np.testing.assert_allclose(np.array(list(total.values())) / scale, expected / scale, atol=1e-6)
