"""How often each rung of first-order theory agrees with Floquet multipliers, which decide.

Random systems in time units of the roll frequency (damping in roll 0.05, cubic coefficients, wave forces and frequency drawn
with a fixed seed; roll amplitude near 0.23 rad), and every built-in ship over the map of headings, wave lengths and speeds.

Usage: python benchmarks/verdict_agreement.py [systems per level, 2000 by default]
"""

import sys

import numpy as np

import quartering as qt
from quartering.conventions import CUBIC_MONOMIALS
from quartering.hull.file.read import available_ships
from quartering.motion.equations.system import System
from quartering.motion.of_ship import ship_system
from quartering.motion.steady.motion import peaks, steady_motions
from quartering.stability.assessment import assess
from quartering.stability.kind import Kind

LEVELS = ((0.05, 0.3), (0.2, 0.3), (0.5, 0.5), (1.0, 0.5), (1.0, 1.5))
POWERS = np.array([[m.count("v"), 0, m.count("p"), m.count("r")] for m in CUBIC_MONOMIALS] + [[0, 3, 0, 0]])


def random_systems(count, damping, strength, seed):
    """Canonical systems with sway and yaw damping near `damping` and cubic coefficients near `strength`."""
    random = np.random.default_rng(seed)
    linear = np.zeros((count, 3, 4))
    linear[:, :, [0, 2, 3]] = 0.1 * damping * random.normal(size=(count, 3, 3))
    linear[:, 0, 0] = -damping * random.uniform(0.5, 1.5, count)
    linear[:, 2, 3] = -damping * random.uniform(0.5, 1.5, count)
    linear[:, 1, 2] = -0.05 * random.uniform(0.5, 1.5, count)
    rho = np.stack([random.uniform(-0.3, 0.3, count), np.ones(count), random.uniform(-0.1, 0.1, count)], axis=1)
    linear[:, :, 1] = -rho
    coefficients = strength * random.normal(size=(count, 3, len(POWERS)))
    for row, own in ((0, 0), (1, 1), (2, 2)):
        coefficients[:, row, own] = -np.abs(coefficients[:, row, own])
    coefficients[:, :, -1] = rho * strength * random.uniform(-1, 1, count)[:, None]
    w = random.uniform(0.3, 1.7, count)
    size = 0.23 * np.abs(1 - w**2 + 0.05j * w)
    force = size[:, None] * random.normal(size=(count, 3)) * [0.7, 1.0, 0.7]
    phase = random.uniform(0, 2 * np.pi, (count, 3))
    zero = np.zeros((count, 3))
    return System(linear, coefficients, POWERS, np.zeros(len(POWERS), dtype=np.int64), zero,
                  force * np.cos(phase), force * np.sin(phase), w)  # fmt: skip


def rungs(system):
    """Does each rung call each motion unstable; the last column is Floquet's answer. Motions not found are left out."""
    u, orders, _, _ = steady_motions(system, 9)
    found = np.isfinite(u).all(axis=(1, 2))
    keep = found & (np.hypot(u[:, 1, 0], u[:, 1, 1]) < 1.0)
    chosen = system.each(lambda array: array[keep])
    result = assess(chosen, u[keep], orders)
    f = result.first_order
    slow = f.slow.max(axis=1)
    columns = {
        "K2 with rho": f.k2_rho,
        "K2 full": f.k2,
        "K2, q, slow": np.fmax(np.fmax(f.roll_rate, f.q[:, 0]), slow),
        "averaged, slow": np.fmax(f.averaged.real.max(axis=1), slow),
        "mean matrix": f.mean_jacobian.real.max(axis=1),
    }
    return {name: values > 0 for name, values in columns.items()}, result.floquet.growth > 0


def random_table(count):
    """Agreement [%] and, of the unstable motions, how many each rung finds [%]."""
    print("sway and yaw damping / cubic strength, in units of the roll frequency; agreement % (unstable found %)")
    for damping, strength in LEVELS:
        said, truth = rungs(random_systems(count, damping, strength, seed=1971))
        cells = [f"{name} {100 * (v == truth).mean():.1f} ({100 * v[truth].mean():.0f})" for name, v in said.items()]
        print(f"{damping:g} / {strength:g}  n {truth.size}, unstable {truth.mean():.1%}:  " + ";  ".join(cells))


def ship_motions(name, steepness, harmonics):
    """Motions of a built-in ship reached from rest, all over a map of headings, wave lengths and two speeds, judged."""
    ship = qt.paper_ship(name)
    length = ship.hull.length
    axes = (
        np.array([0.1, 0.2]) * np.sqrt(9.81 * length),
        np.arange(0.0, 181.0, 5.0),
        np.linspace(0.4, 2.3, 20) * length,
    )
    speed, heading, wave = (a.ravel() for a in np.meshgrid(*axes, indexing="ij"))
    system = ship_system(ship, 2 * np.pi / wave, speed, heading).at_amplitude(0.5 * steepness * wave[:, None])
    u, orders, _, _ = steady_motions(system, harmonics, start="rest")
    return assess(system, u, orders), np.isfinite(u).all(axis=(1, 2)), np.degrees(peaks(u, orders)[:, 1])


def ship_table(steepness, harmonics):
    """Every built-in ship: how often first-order theory and Floquet differ, and by which rung."""
    print(
        f"built-in ships, H/lambda = {steepness:.3g}, harmonics = {harmonics}: motions; unstable by Floquet, by first order,"
    )
    print(
        "by both; missed (of them without n2), false alarms (of them by the combination rung); roll where they differ; kinds"
    )
    for name in (entry.name for entry in available_ships()):
        result, found, roll = ship_motions(name, steepness, harmonics)
        f = result.first_order
        truth, first = result.floquet.growth > 0, found & (f.growth > 0)
        missed, false = truth & ~first, first & ~truth
        differ = roll[missed | false]
        where = f"{differ.min():.0f}-{differ.max():.0f} deg" if differ.size else ""
        kinds, numbers = np.unique(result.kind[truth], return_counts=True)
        words = ", ".join(f"{n} {Kind(k).label}" for k, n in zip(kinds, numbers, strict=True))
        print(
            f"{name:14s} {found.sum():5d} {truth.sum():4d} {first.sum():4d} {(truth & first).sum():4d}"
            f"   missed {missed.sum()} ({np.isnan(f.n2[missed]).sum()}), false {false.sum()}"
            f" ({(f.combination[false] > 0).sum()})   {where}   {words}"
        )


if __name__ == "__main__":
    random_table(int(sys.argv[1]) if len(sys.argv) > 1 else 2000)
    for steepness, harmonics in ((1 / 50, 1), (1 / 20, 1), (1 / 20, 5)):
        ship_table(steepness, harmonics)
