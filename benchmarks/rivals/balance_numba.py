"""What both harmonic balances in plain numba use: elimination, tables of sines, and the end of the job."""

import numpy as np
from numba import njit


@njit(fastmath=True)
def eliminate(a, b):
    """Solve ``a x = b`` in place, by elimination with pivoting; ``b`` is then x."""
    n = a.shape[0]
    for j in range(n):
        best = j
        for i in range(j + 1, n):
            if abs(a[i, j]) > abs(a[best, j]):
                best = i
        if best != j:
            for k in range(j, n):
                a[j, k], a[best, k] = a[best, k], a[j, k]
            b[j], b[best] = b[best], b[j]
        inverse = 1.0 / a[j, j]
        for i in range(j + 1, n):
            factor = a[i, j] * inverse
            for k in range(j + 1, n):
                a[i, k] -= factor * a[j, k]
            b[i] -= factor * b[j]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            b[i] -= a[i, k] * b[k]
        b[i] /= a[i, i]


def sampled(orders, phases):
    """Values and rates (b, m) of the harmonics, and the order (b,) of each."""
    values, rates, factors = [], [], []
    for h in orders:
        if h == 0:
            values.append(np.ones_like(phases))
            rates.append(np.zeros_like(phases))
            factors.append(0.0)
            continue
        values += [np.cos(h * phases), np.sin(h * phases)]
        rates += [-h * np.sin(h * phases), h * np.cos(h * phases)]
        factors += [float(h)] * 2
    return np.array(values), np.array(rates), np.array(factors)


def tables_of(orders, samples, steps):
    """Harmonics at the samples of a cycle and at the half steps of Runge-Kutta; half a cycle of each where all are odd."""
    odd = 0 not in orders
    used = samples // 2 if odd else samples
    values, rates, factors = sampled(orders, 2 * np.pi * np.arange(used) / samples)
    weights = np.where(factors > 0, 2.0, 1.0) / used
    along, along_rates, _ = sampled(orders, (1 if odd else 2) * np.pi * np.arange(2 * steps + 1) / (2 * steps))
    return values, rates, factors, weights, along, along_rates


def harmonics(u, mean, floquet, odd):
    """Fundamental amplitudes (n, 3), multipliers (n, 4) of a whole cycle, K2 and S of the motions."""
    first = 0 if odd else 1
    multipliers = np.linalg.eigvals(floquet)
    stiffness = mean[:, :, 1]
    n2, rho = np.sqrt(-stiffness[:, 1]), stiffness / stiffness[:, [1]]
    k2 = n2 * (rho * mean[:, 1][:, [0, 2, 3]]).sum(axis=1)
    return np.hypot(u[:, :, first], u[:, :, first + 1]), multipliers**2 if odd else multipliers, k2, -k2 / (2 * n2)
