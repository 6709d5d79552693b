"""Realisations of an irregular sea against scipy, closed forms and the order of the method."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from quartering.conventions import InputError
from quartering.hull.autopilot import Autopilot
from quartering.motion.equations.model import Model
from quartering.motion.transient.basin import capsize_times
from quartering.motion.transient.irregular import irregular
from quartering.motion.transient.simulate import simulate

TERMS = {
    "Y_v": -0.4, "Y_p": 0.1, "Y_vvv": -0.2, "K_v": 0.05, "K_phi": -1.0, "K_p": -0.06, "K_phiphiphi": 0.3, "K_ppp": -0.1,
    "K_p|p|": -0.05, "K_prr": 0.2, "N_r": -0.5, "N_v": -0.1, "N_rrr": -0.3,
}  # fmt: skip
INERTIA = [[1.0, 0.05, 0.0], [0.02, 1.0, 0.01], [0.0, 0.03, 1.0]]
MODEL = Model(INERTIA, TERMS, 1.0, (0, 0, 0), (0, 0, 0), force_mean=(0.0, 0.01, 0.0))
PLAIN = {name: value for name, value in TERMS.items() if "|" not in name}
PRODUCTS = Model(
    INERTIA, PLAIN | {"K_phiphiphiphiphi": -0.2, "K_vvp": -0.1, "Y_vpr": 0.1, "N_pp": 0.02}, 1.0, (0, 0, 0), (0, 0, 0)
)
"""Without a modulus: rows go in pairs."""
FREQUENCY = np.array([0.6, 0.83, 1.1])
FORCE = np.array([[0.05, 0.02 + 0.03j, 0.01j], [0.02j, 0.05, 0.02], [0.03, -0.04, 0.01]])
PHASE = np.random.default_rng(4).uniform(0, 2 * np.pi, (40, 3))  # more than a batch


def by_scipy(model, phase, duration):
    """The same equations through solve_ivp (DOP853, 1e-11)."""
    system, inverse = model.system, np.linalg.inv(np.array(INERTIA))

    def rate(t, y):
        a = system.linear[0] @ y + system.mean[0]
        for column, (powers, bars) in enumerate(zip(system.powers, system.modulus, strict=True)):
            a = a + system.coefficients[0, :, column] * np.prod(y**powers) * (abs(y[bars - 1]) if bars else 1.0)
        a = a + inverse @ (FORCE * np.exp(1j * (FREQUENCY * t + phase))[:, None]).sum(axis=0).real
        return [a[0], y[2], a[1], a[2]]

    return solve_ivp(rate, (0, duration), np.zeros(4), method="DOP853", rtol=1e-11, atol=1e-13).y[:, -1]


@pytest.mark.parametrize("model", [MODEL, PRODUCTS], ids=["modulus", "products alone"])
def test_ends_where_scipy_ends_with_fourth_order(model):
    exact = np.array([by_scipy(model, PHASE[i], 60.0) for i in (0, 37)])
    errors = []
    for step in (0.2, 0.1, 0.05):
        end = irregular(model, FREQUENCY, FORCE, PHASE, 60.0, step=step)["state"].values[[0, 37]]
        errors.append(np.abs(end - exact).max())
    assert errors[-1] < 1e-7
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (orders > 3.5).all()


def test_one_wave_on_a_linear_ship_has_the_linear_response():
    """Closed form: amplitude K / sqrt((w2^2 - w^2)^2 + (2 n w)^2), root mean square amplitude / sqrt(2)."""
    model = Model(np.eye(3), {"Y_v": -1.0, "K_phi": -1.0, "K_p": -0.4, "N_r": -1.0}, 1.0, (0, 0, 0), (0, 0, 0))
    w, force, duration = 0.7, 0.05, 4000.0
    sea = irregular(model, [w], [[0, force, 0]], [[0.0], [2.0]], duration)
    amplitude = np.degrees(force / np.hypot(1 - w**2, 0.4 * w))
    np.testing.assert_allclose(sea["roll_rms"], amplitude / np.sqrt(2), rtol=3e-3)  # the start is part of it
    assert sea["roll_peak"].min() >= amplitude * (1 - 1e-4)


def test_a_capsize_stops_its_realisation_alone():
    escape = Model(np.eye(3), {"Y_v": -1.0, "K_phi": -1.0, "K_phiphiphi": 1.0, "K_p": -0.1, "N_r": -1.0}, 1.0,
                   (0, 0, 0), (0, 0, 0))  # fmt: skip
    sea = irregular(escape, [0.9, 0.9], [[0, 0.2, 0], [0, 0.2, 0]], [[0.0, 0.0], [0.0, np.pi]], 200.0, limit=1.2)
    assert np.isfinite(sea["capsize_time"][0])
    assert sea["roll_peak"][0] < np.degrees(1.5)
    assert np.isnan(sea["capsize_time"][1])  # its two waves are opposite: nothing moves
    assert sea["roll_peak"][1] < 1e-9


EVERY_KIND = TERMS | {
    "K_phi": 0.0, "K_phi7": 0.02, "Y_vpr": 0.1, "N_v|r|": -0.1, "K_phiphi": 0.05,
    "Y_delta": 0.02, "K_delta": 0.01, "N_delta": 0.3,
}  # fmt: skip
RIGHTING = ([10.0, 20.0, 30.0, 40.0], [0.17, 0.34, 0.45, 0.4])


@pytest.mark.parametrize("autopilot", [None, Autopilot(0.8, 1.0), Autopilot(0.8, 1.0, lag=2.0)])
def test_one_wave_gives_what_the_adaptive_integrator_gives(autopilot):
    """Agreement: every kind of product, a righting spline and a steered ship, by another integrator and another evaluation."""
    force = np.array([0.05, 0.1, 0.02])
    model = Model(INERTIA, EVERY_KIND, 0.8, force, (0, 0, 0), autopilot=autopilot, restoring=RIGHTING)
    history = simulate(model, 40.0, step=0.5, tolerance=1e-11)
    alone = history.isel(time=-1)
    exact = [float(alone["sway_velocity"]), *np.radians([float(alone[n]) for n in ("roll", "roll_rate", "yaw_rate")])]
    sea = irregular(model, [0.8], [force], np.zeros((70, 1)), 40.0, step=0.01)
    assert float(np.abs(history["roll"]).max()) > 12  # beyond the first knot
    assert len(sea["state"].attrs["units"].split(", ")) == sea.sizes["component"]
    np.testing.assert_allclose(
        sea["state"].sel(component=["v", "phi", "p", "r"]).values[[0, 69]], [exact] * 2, atol=2e-7
    )
    if autopilot is not None:
        np.testing.assert_allclose(np.degrees(sea["state"].sel(component="psi")[0]), alone["heading"], atol=2e-5)
    periods, steps = 5, 2000
    _, states = capsize_times(model, np.zeros((70, 4)), periods, steps=steps)
    alone = simulate(model, 2 * np.pi / 0.8 * periods, step=2 * np.pi / 0.8 * periods, tolerance=1e-11).isel(time=-1)
    np.testing.assert_allclose(np.degrees(states[[0, 69], 1]), float(alone["roll"]), atol=1e-5)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"force": np.zeros((2, 3))}, "do not fit together"),
        ({"phase": np.full((2, 3), np.nan)}, "finite"),
        ({"duration": 0.0}, "it is above 0 s"),
        ({"step": np.nan}, "it is above 0 s"),
    ],
)
def test_bad_input_is_refused(change, words):
    given = {"frequency": FREQUENCY, "force": FORCE, "phase": PHASE, "duration": 10.0, "step": 0.2} | change
    with pytest.raises(InputError, match=words):
        irregular(MODEL, given["frequency"], given["force"], given["phase"], given["duration"], step=given["step"])
