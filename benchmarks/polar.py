"""The main job timed, and checked by general-purpose integration on a sample of the same conditions.

The map of Series 60, CB 0.60: 37 headings x 20 wave lengths x 3 speeds = 2,220 conditions, each with response, K2, q and
Floquet multipliers. The check is written with scipy alone: solve_ivp (DOP853) through the transient to the steady motion, then
the variational equations over one period, in plain Python. It is a check, and no rival.

Usage: python benchmarks/polar.py
"""

import statistics
import time

import numpy as np
from scipy.integrate import solve_ivp

import quartering as qt
from quartering._machine.threads import spread
from quartering.motion.of_ship import ship_system
from quartering.motion.steady.motion import steady_motions
from quartering.stability.assessment import assess
from quartering.study.conditions import BLOCK

SHIP = qt.ship("series60-cb60")
LENGTH = SHIP.hull.length
SPEEDS = np.array([0.15, 0.20, 0.25]) * np.sqrt(9.81 * LENGTH)
HEADINGS = np.linspace(0.0, 180.0, 37)
WAVES = [qt.Wave(f * LENGTH, f * LENGTH / 50) for f in np.linspace(0.4, 2.3, 20)]
SAMPLE, TRANSIENT = 8, 40


def seconds(work, repeats=5):
    """Median, smallest and largest time of several runs, after one that is not counted."""
    work()
    times = []
    for _ in range(repeats):
        begin = time.perf_counter()
        work()
        times.append(time.perf_counter() - begin)
    return statistics.median(times), min(times), max(times)


def systems():
    """Every condition of the map as equations, in the blocks a map is computed in."""
    u, mu, k = (a.ravel() for a in np.meshgrid(SPEEDS, HEADINGS, [w.wavenumber for w in WAVES], indexing="ij"))
    amplitude = np.tile([w.amplitude for w in WAVES], SPEEDS.size * HEADINGS.size)[:, None]
    blocks = [slice(i, i + BLOCK) for i in range(0, u.size, BLOCK)]
    return [ship_system(SHIP, k[b], u[b], mu[b]).at_amplitude(amplitude[b]) for b in blocks]


def dynamics(system):
    """Steady motions and every judgement of their stability."""
    u, orders, _, _ = steady_motions(system, 1, start="rest")
    return assess(system, u, orders)


def by_integration(model):
    """Roll amplitude [rad] and multipliers from solve_ivp: 40 periods of transient, one of variational equations."""
    s, w = model.system, model.frequency
    period = 2 * np.pi / w

    def jacobian_and_force(y):
        force, slope = s.linear[0] @ y, s.linear[0].copy()
        for column, powers in enumerate(s.powers):
            term = np.prod(y**powers)
            force = force + s.coefficients[0, :, column] * term
            for i in np.flatnonzero(powers):
                lower = powers - np.eye(4, dtype=int)[i]
                slope[:, i] += s.coefficients[0, :, column] * powers[i] * np.prod(y**lower)
        return force, slope

    def motion(t, y):
        force, _ = jacobian_and_force(y)
        a = force + s.cos[0] * np.cos(w * t) + s.sin[0] * np.sin(w * t)
        return np.array([a[0], y[2], a[1], a[2]])

    def both(t, z):
        y, phi = z[:4], z[4:].reshape(4, 4)
        _, slope = jacobian_and_force(y)
        matrix = np.vstack([slope[0], [0, 0, 1, 0], slope[1:]])
        return np.concatenate([motion(t, y), (matrix @ phi).ravel()])

    options = {"method": "DOP853", "rtol": 1e-8, "atol": 1e-10}
    steady = solve_ivp(motion, (0, TRANSIENT * period), np.zeros(4), **options).y[:, -1]
    times = np.arange(64) * period / 64
    start = np.concatenate([steady, np.eye(4).ravel()])
    cycle = solve_ivp(both, (0, period), start, t_eval=[*times, period], **options).y
    roll = cycle[1, :-1]
    fundamental = np.abs(roll @ np.exp(-1j * w * times)) * 2 / times.size
    return fundamental, np.linalg.eigvals(cycle[4:, -1].reshape(4, 4))


def sample():
    """A few conditions of the map, drawn with a fixed seed, as models."""
    random = np.random.default_rng(1971)
    for _ in range(SAMPLE):
        u, mu, wave = random.choice(SPEEDS), random.choice(HEADINGS[4:-4]), WAVES[random.integers(len(WAVES))]
        yield qt.equations(SHIP, wave, float(u), float(mu))


def main():
    """Time, compare, print."""
    blocks = systems()
    count = sum(block.count for block in blocks)
    whole = seconds(lambda: qt.polar(SHIP, WAVES, SPEEDS, HEADINGS))
    inner = seconds(lambda: list(spread(dynamics, blocks)))
    print(f"{count} conditions         median [s]   min     max   goal [s]")
    print(f"whole map (after compile)    {whole[0]:8.3f} {whole[1]:7.3f} {whole[2]:7.3f}   10")
    print(f"dynamics kernels alone       {inner[0]:8.3f} {inner[1]:7.3f} {inner[2]:7.3f}   0.3")
    roll_errors, multiplier_errors = [], []
    for model in sample():
        roll, multipliers = by_integration(model)
        motion = qt.steady_motion(model, start="rest")
        found = qt.stability(model, motion).multipliers
        roll_errors.append(abs(motion.amplitude[1] / roll - 1))
        multiplier_errors.append(max(np.abs(found - m).min() for m in multipliers))
    print(
        f"agreement on the sample: roll within {max(roll_errors):.1e}, multipliers within {max(multiplier_errors):.1e}"
    )
    print("(the paper's method keeps one harmonic in balance: that is the difference, not the integration)")


if __name__ == "__main__":
    main()
