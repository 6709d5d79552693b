"""The equations with an autopilot: periodic motions, histories in time, rudder forces."""

import warnings

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import quartering as qt
from quartering.hull.autopilot import Rudder
from quartering.hydro.manoeuvring.rudder import rudder_derivatives
from quartering.motion.branches.branch import balance_of
from quartering.motion.equations.system import kernel_arguments
from quartering.motion.steady.struble import modified_struble
from quartering.study.conditions import RESULTS

INERTIA = np.array([[1.1, 0.1, 0.1], [0.1, 1.1, 0.0], [0.05, 0.0, 1.2]])
TERMS = {
    "Y_v": -0.4, "Y_r": -0.9, "K_v": 0.1, "K_phi": -1.0, "K_p": -0.05, "K_phiphiphi": -0.25, "K_ppp": -0.08,
    "K_prr": 0.3, "N_v": -0.3, "N_r": -0.6, "Y_delta": -0.2, "K_delta": 0.1, "N_delta": 0.5,
}  # fmt: skip
AUTOPILOTS = [qt.Autopilot(1.0, 2.0), qt.Autopilot(1.0, 2.0, 1.5), qt.Autopilot(0.0, 2.0, 1.5), qt.Autopilot(0.0, 2.0)]
COS, SIN, W = np.array([0.1, 0.05, 0.06]), np.array([0.0, 0.12, 0.1]), 0.85


def model_with(autopilot, mean=(0.0, 0.0, 0.0)):
    return qt.Model(INERTIA, TERMS, W, COS, SIN, mean, autopilot=autopilot)


def rates(t, y, autopilot, mean):
    """The raw equations written out, the rudder's among them: the authority the compiled ones are held against."""
    v, phi, p, r, psi = y[:5]
    order = -autopilot.gain * psi - autopilot.rate_gain * r
    delta = y[5] if autopilot.lag else order
    push = np.array([
        -0.4 * v - 0.9 * r - 0.2 * delta,
        0.1 * v - phi - 0.05 * p - 0.25 * phi**3 - 0.08 * p**3 + 0.3 * p * r**2 + 0.1 * delta,
        -0.3 * v - 0.6 * r + 0.5 * delta,
    ])  # fmt: skip
    a = np.linalg.solve(INERTIA, push + mean + COS * np.cos(W * t) + SIN * np.sin(W * t))
    out = [a[0], p, a[1], a[2], r]
    return np.array([*out, (order - delta) / autopilot.lag] if autopilot.lag else out)


@pytest.mark.parametrize("mean", [(0.0, 0.0, 0.0), (0.02, 0.1, 0.05)], ids=["symmetric", "wind"])
@pytest.mark.parametrize("autopilot", AUTOPILOTS, ids=str)
def test_the_periodic_motion_is_one_of_the_written_out_equations(autopilot, mean):
    """Authority: integration over a period of the raw equations by scipy's DOP853 at relative tolerance 1e-12."""
    motion = qt.steady_motion(model_with(autopilot, mean), 9)
    start = list(motion.state(0.0))
    c, s = motion.cos[:, 2], motion.sin[:, 2]
    heading = c.sum() + (motion.heading or 0.0)  # where it is free it may start anywhere, and turns on with the mean
    h = np.array(motion.orders) * W
    # The rudder's own harmonics answer those of the heading through (gain + i h w rate_gain)/(1 + i h w lag).
    psi = c - 1j * s
    delta = -(autopilot.gain + 1j * h * autopilot.rate_gain) / (1 + 1j * h * autopilot.lag) * psi
    steady = -autopilot.gain * (motion.heading or 0.0) - autopilot.rate_gain * motion.mean[2]
    y0 = [*start, heading, *([delta.real.sum() + steady] if autopilot.lag else [])]
    end = solve_ivp(rates, (0, 2 * np.pi / W), y0, "DOP853", args=(autopilot, mean), rtol=1e-12, atol=1e-13).y[:, -1]
    drift = np.zeros(len(y0))
    drift[4] = motion.mean[2] * 2 * np.pi / W
    np.testing.assert_allclose(end, y0 + drift, rtol=0, atol=2e-8)


@pytest.mark.parametrize("lag", [0.0, 1.5])
def test_a_steady_moment_leaves_a_heading_error_and_no_turning(lag):
    """Closed form, linear: r = 0 and the rudder balances sway and yaw, psi = (N0 - N_v/Y_v Y0)/(gain (N_delta - ..))."""
    terms = {k: v for k, v in TERMS.items() if k not in ("K_phiphiphi", "K_ppp", "K_prr")}
    y0, n0, gain = 0.02, 0.05, 0.8
    model = qt.Model(INERTIA, terms, W, COS, SIN, (y0, 0.0, n0), autopilot=qt.Autopilot(gain, 2.0, lag))
    motion = qt.steady_motion(model)
    effect = terms["N_delta"] - terms["N_v"] / terms["Y_v"] * terms["Y_delta"]
    assert motion.heading == pytest.approx((n0 - terms["N_v"] / terms["Y_v"] * y0) / (gain * effect), rel=1e-12)
    assert motion.mean[2] == 0.0


@pytest.mark.parametrize("lag", [0.0, 1.5])
def test_history_with_an_autopilot_is_that_of_the_written_out_equations(lag):
    autopilot = qt.Autopilot(1.0, 2.0, lag)
    y0 = [0.1, 0.3, 0.0, 0.05, 0.2, *([-0.1] if lag else [])]
    trace = qt.simulate(model_with(autopilot), 60.0, y0, step=60.0, tolerance=1e-12)
    end = solve_ivp(rates, (0, 60.0), y0, "DOP853", args=(autopilot, np.zeros(3)), rtol=1e-12, atol=1e-13).y[:, -1]
    names = ("roll", "roll_rate", "yaw_rate", "heading", *(["rudder"] if lag else []))
    found = [float(trace["sway_velocity"][-1]), *(np.radians(float(trace[name][-1])) for name in names)]
    np.testing.assert_allclose(found, end, rtol=0, atol=1e-9)


def test_without_lag_the_rudder_is_where_it_is_ordered():
    trace = qt.simulate(model_with(qt.Autopilot(1.0, 2.0)), 20.0, (0, 0, 0, 0, 0.2))
    np.testing.assert_allclose(trace["rudder"], -trace["heading"] - 2.0 * trace["yaw_rate"], atol=1e-12)


def test_gains_of_zero_leave_the_motion_of_the_bare_ship():
    bare, idle = (qt.steady_motion(model_with(a, (0.0, 0.1, 0.0)), 5) for a in (None, qt.Autopilot(0.0, 0.0)))
    np.testing.assert_allclose(idle.cos, bare.cos, rtol=0, atol=1e-14)
    np.testing.assert_allclose(idle.mean, bare.mean, rtol=0, atol=1e-14)
    assert idle.heading is None


def test_derivative_of_the_balance_is_exact_with_a_rudder_that_lags():
    """Authority: central differences of the residual."""
    from quartering.motion.steady.balance import balance_at

    s = model_with(qt.Autopilot(1.0, 2.0, 1.5), (0.02, 0.1, 0.05)).system
    given = kernel_arguments(s, s.basis((0, 1, 2, 3)))
    u = np.random.default_rng(1).normal(size=(3, 7)) * 0.3

    def residual(at, matrix):
        out = np.empty(21)
        balance_at(*given, at, out, matrix)
        return out

    exact = np.empty((21, 21))
    residual(u, exact)
    step, none = 1e-6, np.empty((0, 0))
    columns = []
    for i in range(21):
        e = np.zeros(21)
        e[i] = step
        columns.append((residual(u + e.reshape(3, 7), none) - residual(u - e.reshape(3, 7), none)) / (2 * step))
    np.testing.assert_allclose(exact, np.array(columns).T, atol=1e-8)


@pytest.mark.parametrize("mean", [(0.0, 0.0, 0.0), (0.02, 0.1, 0.05)], ids=["symmetric", "wind"])
@pytest.mark.parametrize("autopilot", AUTOPILOTS, ids=str)
def test_linear_third_harmonic_with_a_rudder_solves_the_balance_equations(autopilot, mean):
    """Authority: (A-8) in the general balance equations: the products of the fundamental against the linear rows alone."""
    from dataclasses import replace

    s = model_with(autopilot, mean).system
    u, orders, _, _ = modified_struble(s)
    known = 2 if orders[0] else 3
    fundamental = np.zeros_like(u[0])
    fundamental[:, :known] = u[0, :, :known]
    left, bare = balance_of(s, orders, fundamental)[0], replace(s, coefficients=0.0 * s.coefficients)
    answered = balance_of(bare, orders, u[0])[0] - balance_of(bare, orders, fundamental)[0]
    unbalanced = (left + answered).reshape(3, -1)[:, known:]
    np.testing.assert_allclose(unbalanced, 0.0, rtol=0, atol=1e-15)
    assert np.abs(left.reshape(3, -1)[:, known:]).max() > 1e-3


def test_estimated_rudder_of_the_s175_against_her_measured_one():
    """[Son82] publishes area 33.0376 m2 and aspect 1.8219 beside Y_delta' = -0.002578, N_delta' = 0.00126 (their linear model).

    The estimate takes the ship's speed for that of the water at the rudder and no share of the hull; within 20 % of both.
    """
    from dataclasses import replace

    ship = replace(qt.ship("s175"), rudder=Rudder(33.0376, 1.8219))
    estimated, kind, _ = rudder_derivatives(ship, np.array([10.0]))
    measured, measured_kind, _ = rudder_derivatives(qt.ship("s175").with_(measured="son-nomoto-1982"), np.array([10.0]))
    assert (kind, measured_kind) == ("regression", "measured")
    np.testing.assert_allclose(estimated[0, [0, 2]], measured[0, [0, 2]], rtol=0.2)
    half = 0.5 * 1025 * 175.0**2 * 10.0**2
    assert measured[0, 0] == pytest.approx(-0.002578 * half, rel=1e-12)


def test_a_set_that_counts_port_rudder_positive_is_turned_round():
    """[Chislett65] prints Y_delta' = 278e-5 and N_delta' = -139e-5 about midship: port rudder positive."""
    ((y, _, n),) = rudder_derivatives(qt.ship("mariner"), np.array([7.0]))[0]
    half = 0.5 * 1025 * 160.93**2 * 7.0**2
    assert y == pytest.approx(-278e-5 * half, rel=1e-3)
    assert n > 0


def test_a_ship_file_sets_autopilot_and_rudder(tmp_path):
    file = tmp_path / "my.yaml"
    file.write_text(
        "base: wigley\nautopilot: {gain: 1.5, rate_gain: 20 s, lag: 0.05 min}\nrudder: {area: 4 m2}\n"
        "coefficients: {N_delta: 1.0e6}\nmultipliers: {Y_delta: 2.0}\n"
    )
    ship = qt.ship(file)
    assert ship.autopilot == qt.Autopilot(1.5, 20.0, 3.0)
    assert ship.rudder == Rudder(4.0, 1.8)
    table = {entry.name: entry for entry in qt.coefficients(ship, 0.5, 5.0).table()}
    assert table["N_delta"].value == 1e6
    assert table["K_delta"].source.startswith("estimated: rudder lift")
    assert table["Y_delta"].value == pytest.approx(2.0 * -0.5 * 1025 * 25 * 4 * 6.13 * 1.8 / (1.8 + 2.25))
    assert ship.with_(autopilot="none").autopilot is None
    assert "N_delta" not in {entry.name for entry in qt.coefficients(qt.ship("wigley"), 0.5, 5.0).table()}


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("autopilot: {gain: -1}", "gain = -1"),
        ("autopilot: {rate_gain: 3}", "autopilot: gain is missing"),
        ("autopilot: {gain: 1, kd: 3}", "rate_gain, lag"),
        ("autopilot: {gain: 1, lag: 2 m}", "lag"),
        ("rudder: {area: 0 m2}", "area = 0"),
    ],
)
def test_a_bad_autopilot_is_named_by_key(tmp_path, line, words):
    file = tmp_path / "my.yaml"
    file.write_text(f"base: wigley\n{line}\n")
    with pytest.raises(qt.InputError, match=r"my\.yaml") as error:
        qt.ship(file)
    assert words in str(error.value)


def test_a_map_of_a_ship_with_an_autopilot_is_that_of_its_verdicts():
    ship = qt.ship("wigley").with_(autopilot=qt.Autopilot(1.0, 10.0, 2.0))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ds = qt.sweep(
            ship, speed=[0.0, 5.0], heading=[40.0], wave_length=[100.0], wave_height=[1.0], N_delta=[0.5, 1.0]
        )
    for factor in (0.5, 1.0):
        one = ship.with_(factors={"N_delta": factor})
        model = qt.equations(one, qt.Wave(100.0, 1.0), 5.0, 40.0)
        verdict = qt.stability(model, qt.steady_motion(model))
        cell = ds.sel(speed=5.0).where(ds["N_delta"] == factor, drop=True).squeeze()
        assert float(cell["exponent"]) == pytest.approx(verdict.exponents[0].real, rel=1e-5)
        np.testing.assert_allclose(cell["multiplier_modulus"], np.abs(verdict.multipliers[:4]), atol=1e-5)
    assert RESULTS["multiplier_modulus"] == (4,)
    assert np.isfinite(ds["exponent"]).all()  # at rest the rudder has no force and the heading is free
