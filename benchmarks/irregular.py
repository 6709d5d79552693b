"""An ensemble in time: 1,000 realisations of 30 minutes, 50 wave components, steps of 0.2 s, beside other ways.

Series 60, CB 0.60, three modes with all cubics. The alternatives compute a part of the same ensemble, scaled to the whole:
a plain compiled Runge-Kutta loop over realisations that adds up the components at every stage, and scipy's solve_ivp.
They check that the motions agree and are no rivals: a loop that turns phasors, instead of computing cosines at every stage, is
as fast as ours (docs/how_fast.md).

Usage: python benchmarks/irregular.py
"""

import statistics
import time

import numpy as np
from numba import njit, prange
from scipy.integrate import solve_ivp

import quartering as qt

REALISATIONS, COMPONENTS, DURATION, STEP, GOAL = 1000, 50, 1800.0, 0.2, 0.6
PLAIN, BY_SCIPY = 100, 2


def ensemble():
    """A model and the components of a made-up sea: equal forces over 0.2 to 1.2 rad/s, random phases."""
    model = qt.equations(qt.paper_ship("series60-cb60"), qt.Wave(150.0, 4.0), 7.5, 45.0)
    frequency = np.linspace(0.2, 1.2, COMPONENTS)
    force = np.tile((model.force_cos - 1j * model.force_sin) / 7, (COMPONENTS, 1))
    phase = np.random.default_rng(1971).uniform(0, 2 * np.pi, (REALISATIONS, COMPONENTS))
    return model, frequency, force, phase


@njit(parallel=True, cache=True)
def _plain(linear, coefficients, powers, acceleration, frequency, phase, h, steps, end):
    for i in prange(phase.shape[0]):
        y, total, stage, k = np.zeros(4), np.zeros(4), np.zeros(4), np.zeros(4)
        for n in range(steps):
            total[:] = 0.0
            stage[:] = y
            for j in range(4):
                t = (n + (0.0 if j == 0 else 1.0 if j == 3 else 0.5)) * h
                a = np.zeros(3)
                for c in range(frequency.size):
                    angle = frequency[c] * t + phase[i, c]
                    for m in range(3):
                        a[m] += acceleration[m, c].real * np.cos(angle) - acceleration[m, c].imag * np.sin(angle)
                for m in range(3):
                    for s in range(4):
                        a[m] += linear[m, s] * stage[s]
                for term in range(powers.shape[0]):
                    value = 1.0
                    for s in range(4):
                        value *= stage[s] ** powers[term, s]
                    for m in range(3):
                        a[m] += coefficients[m, term] * value
                k[0], k[1], k[2], k[3] = a[0], stage[2], a[1], a[2]
                weight = 1.0 if j == 0 or j == 3 else 2.0
                for s in range(4):
                    total[s] += weight * k[s]
                    stage[s] = y[s] + (0.5 * h if j < 2 else h) * k[s]
            y += h / 6.0 * total
        end[i] = y


def by_scipy(system, acceleration, frequency, phase):
    """One realisation with solve_ivp (DOP853, 1e-6)."""

    def rate(t, y):
        turn = np.exp(1j * (frequency * t + phase))
        a = (
            system.linear[0] @ y
            + system.coefficients[0] @ np.prod(y**system.powers, axis=1)
            + (acceleration @ turn).real
        )
        return [a[0], y[2], a[1], a[2]]

    return solve_ivp(rate, (0, DURATION), np.zeros(4), method="DOP853", rtol=1e-6, atol=1e-8).y[:, -1]


def main():
    model, frequency, force, phase = ensemble()
    system, acceleration = model.system, np.linalg.solve(model.inertia, force.T)
    times = []
    for _ in range(6):
        begin = time.perf_counter()
        found = qt.irregular(model, frequency, force, phase, DURATION, step=STEP)
        times.append(time.perf_counter() - begin)
    ours = statistics.median(times[1:])
    print(f"{REALISATIONS} x {DURATION / 60:g} min, {COMPONENTS} components, step {STEP} s; median of 5 (min, max)")
    print(f"quartering     {ours:8.2f} s ({min(times[1:]):.2f}, {max(times[1:]):.2f}), goal {GOAL}")
    numbers = (system.linear[0], system.coefficients[0], system.powers, acceleration, frequency)
    end = np.zeros((PLAIN, 4))
    _plain(*numbers, phase[:2], STEP, 10, end[:2])
    begin = time.perf_counter()
    _plain(*numbers, phase[:PLAIN], STEP, round(DURATION / STEP), end)
    plain = (time.perf_counter() - begin) * REALISATIONS / PLAIN
    apart = np.abs(end - found["state"].values[:PLAIN])[:, 1].max()
    print(f"plain numba    {plain:8.2f} s in simple use; roll at the end apart by {apart:.0e} rad")
    begin = time.perf_counter()
    ends = np.array([by_scipy(system, acceleration, frequency, phase[i]) for i in range(BY_SCIPY)])
    slow = (time.perf_counter() - begin) * REALISATIONS / BY_SCIPY
    apart = np.abs(ends - found["state"].values[:BY_SCIPY])[:, 1].max()
    print(f"scipy          {slow:8.0f} s in simple use; roll at the end apart by {apart:.0e} rad")


if __name__ == "__main__":
    main()
