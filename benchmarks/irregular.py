"""An ensemble in time: 1,000 realisations of 30 minutes, 50 wave components, steps of 0.2 s; two of them checked by scipy.

Series 60, CB 0.60, three modes with all cubics. Beside a well-written compiled loop: `beside_rivals.py --job ensemble`.

Usage: python benchmarks/irregular.py
"""

import statistics
import time

import numpy as np
from scipy.integrate import solve_ivp

import quartering as qt

REALISATIONS, COMPONENTS, DURATION, STEP, GOAL = 1000, 50, 1800.0, 0.2, 0.6
BY_SCIPY = 2


def ensemble():
    """A model and the components of a made-up sea: equal forces over 0.2 to 1.2 rad/s, random phases."""
    model = qt.equations(qt.paper_ship("series60-cb60"), qt.Wave(150.0, 4.0), 7.5, 45.0)
    frequency = np.linspace(0.2, 1.2, COMPONENTS)
    force = np.tile((model.force_cos - 1j * model.force_sin) / 7, (COMPONENTS, 1))
    phase = np.random.default_rng(1971).uniform(0, 2 * np.pi, (REALISATIONS, COMPONENTS))
    return model, frequency, force, phase


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
    ends = np.array([by_scipy(system, acceleration, frequency, phase[i]) for i in range(BY_SCIPY)])
    apart = np.abs(ends - found["state"].values[:BY_SCIPY])[:, 1].max()
    print(f"roll at the end of {BY_SCIPY} of them within {apart:.0e} rad of solve_ivp")


if __name__ == "__main__":
    main()
