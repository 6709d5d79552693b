"""What is right, for the check of accuracy in the run: the cubic system by shooting at 1e-12."""

import numpy as np
from scipy.integrate import solve_ivp

from rivals.systems import MONOMIALS


def shot(job, count):
    """Roll amplitudes (count,) and multipliers (count, 4) of a `systems.Cubic` by DOP853 at 1e-12, half a cycle each."""
    sizes, multipliers = np.empty(count), np.empty((count, 4), complex)
    powers = np.array(MONOMIALS)
    for i in range(count):
        w, x = job.w[i], _start(job, i)

        def both(t, z, i=i, w=w):
            y, phi = z[:4], z[4:].reshape(4, 4)
            speed = y[[0, 2, 3]]
            a = -job.damping @ speed + job.products @ np.prod(speed**powers, axis=1)
            a[1] += job.g * y[1] ** 3 - y[1]
            a += job.cos[i] * np.cos(w * t) + job.sin[i] * np.sin(w * t)
            slope = np.zeros((3, 4))
            for s, column in enumerate((0, 2, 3)):
                lower = np.maximum(powers - np.eye(3, dtype=int)[s], 0)
                slope[:, column] = -job.damping[:, s] + job.products @ (powers[:, s] * np.prod(speed**lower, axis=1))
            slope[1, 1] = 3 * job.g * y[1] ** 2 - 1
            matrix = np.vstack([slope[0], [0, 0, 1, 0], slope[1:]])
            return np.concatenate([[a[0], y[2], a[1], a[2]], (matrix @ phi).ravel()])

        for _ in range(12):
            begin = np.concatenate([x, np.eye(4).ravel()])
            times = np.linspace(0, np.pi / w, 33)
            cycle = solve_ivp(both, (0, np.pi / w), begin, "DOP853", times, rtol=1e-12, atol=1e-13).y
            half = -cycle[4:, -1].reshape(4, 4)
            step = np.linalg.solve(np.eye(4) - half, -cycle[:4, -1] - x)
            x = x + step
            if np.abs(step).max() < 1e-11:
                break
        sizes[i] = abs(np.exp(-1j * w * times[:-1]) @ cycle[1, :-1]) * 2 / 32
        multipliers[i] = np.linalg.eigvals(half) ** 2
    return sizes, multipliers


def _start(job, i):
    """State at time 0 of the motion in three harmonics."""
    from rivals.harmonic_numba import motion

    return motion(job, i)


def apart(found, right):
    """Largest distance of multipliers (n, 4) from those they stand for: each to the nearest."""
    return np.abs(np.asarray(found)[:, :, None] - np.asarray(right)[:, None, :]).min(axis=2).max(axis=1)
