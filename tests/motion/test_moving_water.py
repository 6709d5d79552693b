"""Ships in moving water: cubics on the velocity through it, and drag strip by strip."""

import json
from dataclasses import replace

import numpy as np
import pytest

from quartering.conventions import CUBIC_MONOMIALS, InputError
from quartering.hull.righting.spline import odd_spline
from quartering.motion.equations.batch import copies, joined
from quartering.motion.equations.model import Model
from quartering.motion.equations.steering import state_matrix
from quartering.motion.equations.system import PER_CONDITION
from quartering.motion.equations.water import Strips
from quartering.motion.steady.derivative import change_of_motion
from quartering.motion.steady.harmonic import harmonic_balance, solve_with_care
from quartering.motion.steady.motion import steady_motion
from quartering.motion.transient.irregular import irregular
from quartering.motion.transient.simulate import simulate
from quartering.stability.assessment import assess
from quartering.stability.contribution import contributions
from quartering.stability.derivative import change_of_stability
from quartering.stability.variational.variation import variational_harmonics
from tests.reference import HERE

WATER = json.loads((HERE / "moving_water.json").read_text())
RAW = WATER["raw"]["rows"]


def phasor(pair) -> complex:
    return complex(*pair)


def raw_model(row, water=True) -> Model:
    terms = {"K_phi": row["K_phi"], "K_phiphiphi": row["K_phiphiphi"]}
    for k, name in enumerate("YKN"):
        terms |= {f"{name}_{s}": row["linear_v_p_r"][k][j] for j, s in enumerate("vpr")}
        terms |= {f"{name}_{m}": row["cubic"][k][j] for j, m in enumerate(CUBIC_MONOMIALS)}
    force = np.array([phasor(f) for f in row["force"]])
    given = (phasor(row["w0"]), phasor(row["w1"])) if water else None
    return Model(np.array(row["inertia"]), terms, row["omega"], force.real, -force.imag, water=given)


def dragged_model(size=1.0, frequency=0.8, **more) -> Model:
    """A ship of six strips in water that moves with a wave along it, with a little of everything else."""
    x = np.linspace(-1.0, 1.0, 6)
    strips = Strips(x, np.full(6, 0.3), np.full(6, 0.15), size * 0.3 * np.exp(1j * (0.8 * x + 0.4)))
    terms = {"Y_v": -0.4, "K_phi": -1.0, "K_p": -0.02, "N_r": -0.6, "Y_r": 0.1, "N_v": 0.1, "K_phiphiphi": 0.2}
    inertia = np.array([[1.0, 0.05, 0.02], [0.05, 1.0, 0.0], [0.02, 0.0, 1.0]])
    cos, sin = size * np.array([0.2, 0.1, 0.05]), size * np.array([0.1, -0.05, 0.02])
    return Model(inertia, terms, frequency, cos, sin, strips=strips, **more)


@pytest.mark.parametrize("row", RAW, ids=[row["kind"] + str(i) for i, row in enumerate(RAW)])
def test_cubics_on_relative_velocity_agree_with_integration_elsewhere(row):
    """State to 1e-7 and multipliers to 1e-6 of the larger of 1 and themselves: independent Runge-Kutta integration."""
    model = raw_model(row)
    motion = steady_motion(model, 21)
    np.testing.assert_allclose(motion.state(0.0), row["state0_v_phi_p_r"], atol=1e-7)
    found = assess(model.system, motion.coefficients[None], motion.orders, accuracy=1e-10).floquet
    wanted = np.array([phasor(m) for m in row["multipliers"]])
    apart = np.abs(found.multipliers[0][:, None] - wanted[None]).min(axis=0) / np.maximum(1.0, np.abs(wanted))
    assert apart.max() < 1e-6
    assert found.exponents.real.max() == pytest.approx(row["largest_exponent"], abs=1e-6)


def test_a_model_of_bare_numbers_is_absolute():
    """Closed form: water at rest leaves the paper's equations; without water there is none."""
    still = raw_model(RAW[0] | {"w0": [0.0, 0.0], "w1": [0.0, 0.0]})
    absolute = raw_model(RAW[0], water=False)
    at_rest, bare = (harmonic_balance(m.system, (1, 3, 5))[0] for m in (still, absolute))
    np.testing.assert_allclose(at_rest, bare, atol=1e-14)
    assert absolute.water is None
    assert absolute.system.inputs.shape[1] == 0


def gentle() -> Model:
    """The second reference system in half its wave."""
    row = RAW[1]
    half = {name: [0.5 * part for part in row[name]] for name in ("w0", "w1")}
    return raw_model(row | half | {"force": [[0.5 * part for part in pair] for pair in row["force"]]})


@pytest.mark.parametrize(("model", "tolerance"), [(gentle(), 1e-8), (dragged_model(), 1e-4)])
def test_harmonic_balance_is_the_integrated_motion(model, tolerance):
    """Two methods, one of them in time: 1e-8 where the equations are smooth, 1e-4 with |q| q, of the roll at its frequency.

    What stands at one instant is further off by the harmonics left out.
    """
    motion = steady_motion(model, 9)
    period = 2 * np.pi / model.frequency
    times = np.arange(5) * period / 5
    trace = simulate(model, period, motion.state(0.0), step=period / 5, tolerance=1e-12)
    roll = motion.state(times)[:, 1]
    assert np.abs(np.radians(trace["roll"].values[:5]) - roll).max() < tolerance * np.abs(roll).max() * 10
    settled = simulate(model, 60 * period, step=period / 64, tolerance=1e-12)
    last = np.radians(settled["roll"].values[-65:-1])
    phases = 2 * np.pi * np.arange(64) / 64
    fundamental = last @ np.exp(-1j * phases) / 32
    assert abs(abs(fundamental) / motion.amplitude[1] - 1) < tolerance


def test_floquet_with_drag_is_the_growth_of_a_disturbance():
    """Two methods: neighbouring integrations over a period; leading exponents to 1e-5 1/s, all multipliers to 1e-6.

    They begin 1e-5 apart: nearer, the steps of the integration fall otherwise about the corners of |q| q, and its own error of
    1e-12, over the distance, is the larger one.
    """
    model = dragged_model()
    motion = steady_motion(model, 21)
    found = assess(model.system, motion.coefficients[None], motion.orders, accuracy=1e-9).floquet
    period = 2 * np.pi / model.frequency
    start, away = motion.state(0.0), 1e-5 * np.eye(4)
    ends = [
        np.array([trace[name].values[-1] * unit for name, unit in NAMES])
        for trace in (simulate(model, period, start + side * d, step=period, tolerance=1e-12)
                      for d in away for side in (1, -1))
    ]  # fmt: skip
    phi = np.stack([(ends[2 * i] - ends[2 * i + 1]) / 2e-5 for i in range(4)], axis=1)
    multipliers = np.sort(np.abs(np.linalg.eigvals(phi)))
    exponents = np.log(multipliers[-2:]) / period
    np.testing.assert_allclose(np.sort(np.abs(found.multipliers[0])), multipliers, atol=1e-6)
    np.testing.assert_allclose(np.sort(found.exponents[0].real)[-2:], exponents, atol=1e-5)
    coarse = assess(model.system, motion.coefficients[None], motion.orders, accuracy=1e-6).floquet
    np.testing.assert_allclose(coarse.exponents[0].real.max(), exponents.max(), atol=1e-5)


NAMES = (("sway_velocity", 1.0), ("roll", np.pi / 180), ("roll_rate", np.pi / 180), ("yaw_rate", np.pi / 180))


CURVE = odd_spline(np.arange(4.0, 97.0, 4.0), -(np.sin(np.radians(np.arange(4.0, 97.0, 4.0))) ** 3))


def test_batch_is_single_to_1e_12_with_strips_and_a_spline():
    """Motion, multipliers and K2 of conditions side by side, and of each by itself."""
    models = [dragged_model(0.5 + 0.1 * i, 0.6 + 0.01 * i, restoring=CURVE) for i in range(20)]
    batch = joined([m.system for m in models])
    u, status, _ = harmonic_balance(batch, (1, 3))
    assert (status == 0).all()
    assert np.hypot(u[:, 1, 0], u[:, 1, 1]).max() > np.radians(20.0)  # past knots
    np.testing.assert_allclose(u, solve_with_care(batch, (1, 3))[0], atol=1e-12)
    together = assess(batch, u, (1, 3))
    for i, model in enumerate(models):
        alone, _, _ = harmonic_balance(model.system, (1, 3))
        np.testing.assert_allclose(alone[0], u[i], rtol=0, atol=1e-12)
        found = assess(model.system, alone, (1, 3))
        np.testing.assert_allclose(found.floquet.multipliers[0], together.floquet.multipliers[i], rtol=0, atol=1e-12)
        assert found.first_order.k2[0] == pytest.approx(together.first_order.k2[i], abs=1e-12)


def test_batch_is_single_to_1e_12():
    """Two codes of the same equations: conditions in a batch, and one at a time over the instants of its cycle."""
    models = [dragged_model(0.5 + 0.02 * i, 0.6 + 0.01 * i) for i in range(20)]
    batch = joined([m.system for m in models] + [raw_model(RAW[1]).system])
    u, status, _ = harmonic_balance(batch, (1, 3))
    alone, careful, _ = solve_with_care(batch, (1, 3))
    assert (status == 0).all()
    assert (careful == 0).all()
    np.testing.assert_allclose(u, alone, atol=1e-12)
    by_itself, _, _ = harmonic_balance(raw_model(RAW[1]).system, (1, 3))
    assert np.abs(u[-1] - by_itself[0]).max() < 5e-3  # the others' |q| q asks for more samples: same motion, finer


def test_reversed_and_half_a_period_later_the_equations_are_the_same():
    """Symmetry: all harmonics are asked for, the even ones and the mean vanish."""
    for model in (dragged_model(), raw_model(RAW[2])):
        assert model.system.symmetric
        u, status, _ = harmonic_balance(model.system, (0, 1, 2, 3, 4, 5))
        assert status[0] == 0
        assert np.abs(u[0][:, [0, 3, 4, 7, 8]]).max() < 1e-12


def test_aliasing_of_drag_falls_with_the_cube_of_the_samples():
    """Order: N samples of |cos| cos misjudge its fundamental, 8/(3 pi), by up to 6/N^3 of itself (aliases N -+ 1)."""
    exact = 8 / (3 * np.pi)
    for n in (16, 32, 64):
        x = 2 * np.pi * (np.arange(n) + np.linspace(0, 1, 21)[:, None]) / n
        found = 2 / n * np.sum(np.abs(np.cos(x)) * np.cos(x) * np.exp(-1j * x), axis=1)
        assert np.abs(found / exact - 1).max() == pytest.approx(6 / n**3, rel=0.1)
    assert dragged_model().system.basis((1,), fewest=32).phases.size == 16  # half a cycle of 32


def test_a_wave_raised_from_nothing_moves_the_water_with_it():
    """Agreement: the careful solver from rest, by following, and Newton's method end on one motion."""
    for model in (dragged_model(2.0), raw_model(RAW[1])):
        rest, status, _ = harmonic_balance(model.system, (1, 3), from_rest=True)
        direct, _, _ = harmonic_balance(model.system, (1, 3), start=rest * (1 + 1e-3))
        assert status[0] in (0, 1)
        np.testing.assert_allclose(rest, direct, atol=1e-10)


def test_one_component_of_a_sea_is_the_regular_wave():
    """Agreement: the march of an ensemble against adaptive integration."""
    for model, water in (
        (raw_model(RAW[1]), [[phasor(RAW[1]["w0"]), phasor(RAW[1]["w1"])]]),
        (dragged_model(), [dragged_model().strips.water[0]]),
    ):
        force = model.force_cos - 1j * model.force_sin
        sea = irregular(model, [model.frequency], [force], [[0.0]], 60.0, step=0.02, water=water)
        trace = simulate(model, 60.0, step=0.5, tolerance=1e-11)
        assert sea["state"].values[0, 1] == pytest.approx(np.radians(float(trace["roll"][-1])), abs=1e-6)
        with pytest.raises(InputError, match="water"):
            irregular(model, [model.frequency], [force], [[0.0]], 60.0)


def test_blame_is_what_a_change_of_drag_does_to_the_roll_mode():
    """Authority: central difference of the mean matrix's eigenvalue, the motion held."""
    model = dragged_model()
    motion = steady_motion(model, 9)
    parts = contributions(model, motion, oscillating=True)
    eigenvalues = []
    for factor in (1.001, 0.999):
        more = replace(model.system, push=factor * model.system.push)
        mean = variational_harmonics(more, motion.coefficients[None], motion.orders)[:, 0].real
        eigenvalues.append(max(np.linalg.eigvals(state_matrix(mean, more.linear)[0]), key=lambda value: value.imag))
    change = (eigenvalues[0] - eigenvalues[1]).real / 0.002
    assert parts["cross-flow drag"] == pytest.approx(change, rel=1e-3)
    assert change < 0


@pytest.mark.parametrize(("model", "tolerance"), [(gentle(), 1e-7), (dragged_model(), 1e-6)])
def test_derivatives_by_the_wave_are_central_differences(model, tolerance):
    """Authority: motions and exponents of waves 1e-3 higher and lower, which are off by the square of that step.

    Ten times the tolerance for K2 and exponent: with |q| q their values, not their derivatives, hold errors of samples and
    steps near its zeros. Against values without, both are right to 1e-6: tests/study/test_derivatives_with_drag.py.
    """
    system, orders, step = model.system, (1, 3, 5, 7, 9), 1e-3

    def at(factor):
        other = system.raised(np.array([factor]))
        u, _, _ = harmonic_balance(other, orders)
        found = assess(other, u, orders, accuracy=1e-11)
        return u[0], found.first_order.k2[0], found.floquet.exponents[0].real.max()

    twice = system.raised(np.array([2.0]))
    change = replace(system, **{name: getattr(twice, name) - getattr(system, name) for name in PER_CONDITION})
    u, k2, exponent = at(1.0)
    (above, k2_above, up), (below, k2_below, down) = at(1 + step), at(1 - step)
    du = change_of_motion(system, change, u, orders)
    np.testing.assert_allclose(du[0], (above - below) / (2 * step), atol=tolerance * np.abs(du).max() + 1e-5 * step)
    rate = np.abs(system.linear[0]).max()
    found = change_of_stability(system, change, u, du, orders, rate)
    assert found.k2[0] == pytest.approx((k2_above - k2_below) / (2 * step), abs=10 * tolerance * abs(k2))
    assert found.exponent[0] == pytest.approx((up - down) / (2 * step), abs=10 * tolerance * abs(exponent))


def test_strips_refuse_what_is_no_drag():
    with pytest.raises(InputError, match="do not fit"):
        Strips([0.0, 1.0], [0.0], [1.0, 1.0], [0.0, 0.0])
    with pytest.raises(InputError, match="does not push"):
        Strips([0.0], [0.0], [-1.0], [0.0])
    with pytest.raises(InputError, match="finite"):
        Strips([0.0], [0.0], [1.0], [np.nan])
    two = Strips([0.0], [0.0], [1.0], [[1.0], [2.0]])
    with pytest.raises(InputError, match="a model is one"):
        Model(np.eye(3), {"K_phi": -1.0}, 1.0, (0, 0, 0), (0, 0, 0), strips=two)
    assert copies(dragged_model().system, 3).strips.shape == (3, 6, 5)
