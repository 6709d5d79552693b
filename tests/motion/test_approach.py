"""Capsizes on the way to a motion, many conditions in a batch, against integration by another code with its own steps."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import quartering as qt
from quartering.motion.equations.model import Model
from quartering.motion.equations.rates import WIDTH
from quartering.motion.equations.system import System
from quartering.motion.of_ship import ship_system
from quartering.motion.transient.approach import PERIODS, RAISED_IN, STEPS, capsizes_before

OLD = qt.ship("dtmb5415").with_(velocities="absolute", righting="polynomial", drag="cubic")
LENGTH = OLD.hull.length


def systems(ship: qt.Ship, count: int, steepness: float, seed: int) -> System:
    """Steep waves from abaft the beam, drawn with a fixed seed."""
    random = np.random.default_rng(seed)
    length = random.uniform(1.4, 2.4, count) * ship.hull.length
    at = ship_system(ship, 2 * np.pi / length, random.uniform(4.0, 9.0, count), random.uniform(60.0, 110.0, count))
    return at.at_amplitude(0.5 * steepness * length[:, None])


def by_scipy(system: System, i: int, share: float, start: np.ndarray, limit: float) -> tuple[float, np.ndarray]:
    """Time until |roll| passes the limit (NaN: not in ten periods), and the end: DOP853 on plain (v, phi, p, r) equations."""
    w = system.frequency[i]
    products, spread = system.powers, system.coefficients[i]

    def rates(t: float, y: np.ndarray) -> np.ndarray:
        force = system.linear[i] @ y + spread @ np.prod(y**products, axis=1)
        a = force + share * (system.cos[i] * np.cos(w * t) + system.sin[i] * np.sin(w * t))
        return np.array([a[0], y[2], a[1], a[2]])

    def passes(_: float, y: np.ndarray) -> float:
        return limit - abs(y[1])

    passes.terminal = True  # type: ignore[attr-defined]
    end = 2 * np.pi / w * PERIODS
    made = solve_ivp(rates, (0, end), start, method="DOP853", rtol=1e-9, atol=1e-11, events=passes)
    return (made.t_events[0][0] if made.t_events[0].size else np.nan), made.y[:, -1]


def expected(system: System, i: int, limit: float) -> list[float]:
    """Both times by `by_scipy`."""
    upright, _ = by_scipy(system, i, 1.0, np.zeros(4), limit)
    state, each = np.zeros(4), 2 * np.pi / system.frequency[i] * PERIODS
    for k in range(RAISED_IN):
        time, state = by_scipy(system, i, (k + 1) / RAISED_IN, state, limit)
        if np.isfinite(time):
            return [upright, k * each + time]
    return [upright, np.nan]


@pytest.mark.parametrize("count", [12, pytest.param(36, marks=pytest.mark.soak)])
def test_verdict_and_time_are_those_of_adaptive_integration(count):
    """Authority: scipy's DOP853 at 1e-9 on equations in which the products are written out."""
    system = systems(OLD, count, 1 / 20, 1971)
    assert system.plain
    assert not system.has_drag
    assert not system.has_table
    assert system.powers.shape[1] == 4
    limit = qt.equations(OLD, qt.Wave(200.0, 4.0), 7.0, 60.0).capsize_limit.radians
    found = capsizes_before(system, np.full(count, limit))
    step = 2 * np.pi / system.frequency / STEPS
    for i in range(count):
        for own, other in zip(found[i], expected(system, i, limit), strict=True):
            assert np.isfinite(own) == np.isfinite(other), (i, own, other)
            assert np.isnan(own) or -0.05 * step[i] <= own - other <= 1.05 * step[i], (i, own, other)
    capsized = np.isfinite(found).sum(axis=0)
    assert (count // 9 < capsized).all()
    assert (capsized < count - count // 9).all()


@pytest.mark.filterwarnings("ignore::quartering.conventions.RangeWarning")
@pytest.mark.parametrize("changes", [{}, {"drag": "strips"}, {"autopilot": (1.0, 5.0, 2.0)}], ids=str)
def test_every_part_of_the_equations_is_marched(changes):
    """Authority: `simulate`, adaptive, from rest, with moving water, drag by strips, the righting spline and a rudder's lag."""
    ship = qt.ship("dtmb5415").with_(gm=0.38, **changes)
    models = [qt.equations(ship, qt.Wave(252.0, 19.5), speed, 56.0) for speed in (11.0, 11.7, 12.4)]
    capsized = 0
    for model in models:
        limit = model.capsize_limit.radians
        period = 2 * np.pi / model.frequency
        (found,) = capsizes_before(model.system, np.array([limit]))
        told = qt.simulate(model, PERIODS * period, (0, 0, 0, 0)).attrs.get("capsize_time", np.nan)
        assert np.isfinite(found[0]) == np.isfinite(told), (found, told)
        if np.isfinite(told):
            capsized += 1
            assert found[0] == pytest.approx(told, abs=2 * period / STEPS)
    assert capsized


def test_no_condition_feels_its_neighbours():
    """Identity: more conditions than stand in a row, in one call and one by one in another order."""
    system = systems(qt.ship("dtmb5415"), WIDTH + 5, 1 / 15, 7)
    limit = np.full(system.count, 0.35)
    whole = capsizes_before(system, limit)
    assert np.isfinite(whole).any()
    for i in range(0, system.count, 9):
        alone = capsizes_before(system.each(lambda array, i=i: array[[i]]), limit[:1])
        np.testing.assert_array_equal(alone[0], whole[i])


def test_a_ship_much_faster_than_its_wave_is_followed_in_smaller_steps():
    """Closed form: undamped roll begun by a constant moment a swings to 2 a; it passes a after a quarter of its own period."""
    terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0}
    model = Model(np.eye(3), terms, 0.01, (0, 0, 0), (0, 0, 0), (0, 0.1, 0))
    ((upright, raised),) = capsizes_before(model.system, np.array([0.1]))
    step = 2 * np.pi / 0.01 / (STEPS * 100)  # the ship is a hundred times as fast as the wave
    assert upright == pytest.approx(np.pi / 2, abs=step)
    each = 2 * np.pi / 0.01 * PERIODS
    assert raised > each  # at a third of the moment it swings to two thirds of the limit
