"""Conditions a second: the periodic motion in three harmonics with its Floquet multipliers, K2 and S.

Series 60, CB 0.60, with the paper's cubic righting moment: 3 speeds x 37 headings x 20 wave lengths x 14 steepnesses, on all
cores; the same with drag by strips, and of a ship with the defaults. How many operations that is, how much of it what the
processor can do, and how exact. Prints medians of one run. Beside other tools: `beside_rivals.py`.

Usage: python benchmarks/conditions.py
"""

import statistics
import time
from dataclasses import replace

import numpy as np

import quartering as qt
from quartering._machine.threads import spread, workers
from quartering.motion.equations.basis import basis
from quartering.motion.equations.batch import rows
from quartering.motion.of_ship import ship_system
from quartering.motion.status import Status
from quartering.motion.steady.harmonic import harmonic_balance, solve_with_care
from quartering.stability.assessment import assess
from quartering.stability.first_order import roll_mode
from quartering.stability.variational.floquet import fastest_rate, floquet
from quartering.stability.variational.magnus import magnus_steps
from quartering.stability.variational.one_pass import in_one_pass
from quartering.stability.variational.variation import variation_along

BLOCK, ORDERS, ACCURACY = 1024, (1, 3), 1e-6
FOUND = (Status.CONVERGED, Status.CONVERGED_BY_FOLLOWING)


def systems(drag="cubic"):
    """The conditions in blocks, with a cubic righting moment; cross-flow drag as cubics over ground, or by strips in water."""
    ship = qt.paper_ship("series60-cb60")
    if drag == "strips":
        ship = ship.with_(velocities="relative", drag="strips")
    base, wave = ship_at(ship)
    cubic = base.system.powers.sum(axis=1) <= 3
    blocks = []
    for steepness in np.linspace(1 / 200, 1 / 40, 14):
        one = base.at_amplitude((steepness * wave / 2)[:, None])
        one = replace(
            one,
            powers=one.powers[cubic],
            modulus=one.modulus[cubic],
            coefficients=np.ascontiguousarray(one.coefficients[:, :, cubic]),
        )
        blocks += [rows(one, slice(i, i + BLOCK)) for i in range(0, one.count, BLOCK)]
    return blocks


def default_systems():
    """The same conditions of the ship as it is read: drag by strips in moving water, righting arm by a spline."""
    ship = qt.ship("series60-cb60")
    base, wave = ship_at(ship)
    made = []
    for steepness in np.linspace(1 / 200, 1 / 40, 14):
        one = base.at_amplitude((steepness * wave / 2)[:, None])
        made += [rows(one, slice(i, i + BLOCK)) for i in range(0, one.count, BLOCK)]
    return made


def ship_at(ship):
    """Equations of a ship at all speeds, headings and wave lengths, and the lengths."""
    length = ship.hull.length
    speeds = np.array([0.15, 0.2, 0.25]) * np.sqrt(9.81 * length)
    lengths = np.linspace(0.5, 2.4, 20) * length
    u, mu, wave = (a.ravel() for a in np.meshgrid(speeds, np.linspace(2.5, 177.5, 37), lengths, indexing="ij"))
    return ship_system(ship, 2 * np.pi / wave, u, mu), wave


def motion_and_stability(system, accuracy=ACCURACY):
    """Periodic motion, multipliers, K2, S = -K2/(2 n2)."""
    u, status, _ = harmonic_balance(system, ORDERS, with_residual=False)
    phasors, rate, transition = in_one_pass(system, u, ORDERS, accuracy)
    n2, _, roll_rate = roll_mode(phasors[:, 0].real, system.linear)
    trace = phasors[:, 0, 0, 0].real + phasors[:, 0, 1, 2].real + phasors[:, 0, 2, 3].real
    result = floquet(system, u, ORDERS, rate, trace, accuracy, transition=transition, detail="map")
    return u, status, result.multipliers, 2 * n2 * roll_rate, -roll_rate


def whole_ladder(system):
    u, status, _ = harmonic_balance(system, ORDERS, with_residual=False)
    return u, status, assess(system, u, ORDERS, detail="map")


def seconds(work, blocks, repeats=7):
    """Median, smallest and largest time of several runs over all blocks on all cores, after one that is not counted."""
    list(spread(work, blocks))
    times = []
    for _ in range(repeats):
        begin = time.perf_counter()
        list(spread(work, blocks))
        times.append(time.perf_counter() - begin)
    return statistics.median(times), min(times), max(times)


def accuracy(block):
    """Against the careful solver and multipliers to 1e-10, the same harmonics.

    Returns the largest error of amplitude and of the multipliers, how many conditions got another motion, how many got none.
    """
    u, status, multipliers, *_ = motion_and_stability(block)
    exact, careful, _ = solve_with_care(block, ORDERS)
    fine = assess(block, exact, ORDERS, accuracy=1e-10).floquet.multipliers
    solved = np.isin(status, FOUND) & np.isin(careful, FOUND)
    same = solved & (np.abs(u - exact).max(axis=(1, 2)) < 1e-6 * np.abs(exact).max(axis=(1, 2)))
    size, other = np.hypot(u[:, :, 0], u[:, :, 1]), np.hypot(exact[:, :, 0], exact[:, :, 1])
    apart = np.abs(multipliers[:, :, None] - fine[:, None, :]).min(axis=1).max(axis=1)
    errors = np.max(np.abs(size - other)[same] / other.max()), np.nanmax(apart[same])
    return *errors, int((solved & ~same).sum()), int((~solved).sum())


NEWTON_MATRICES = 2.5
"""Matrices a condition takes on the way from the linear motion, each for three steps; most take two, some three."""


def operations(system):
    """Additions and multiplications a condition takes, counted from the loops; and this machine's rate in dgemm [1/s]."""
    table, along = basis(ORDERS, system.degree, False), basis(ORDERS, system.degree - 2, False, extra=14)
    nb, samples, points = table.values.shape[0], table.values.shape[1], along.values.shape[1]
    size, terms = 3 * nb, system.powers.shape[0]
    slopes = int((system.powers > 0).sum())
    state, force, jacobian = 9 * nb, 24 + 9 * terms, 12 + 10 * slopes
    derivative = samples * (state + jacobian + 12 * nb * (nb + 1)) + 27 * nb**2
    residual = samples * (state + force + 6 * nb)
    newton = derivative + 2 * size**3 / 3 + 3 * (residual + 2 * size**2)
    phasors, _ = variation_along(system, *motion_of(system))
    rate = fastest_rate(phasors, np.full((system.count, 4), np.nan))
    steps = magnus_steps(system.frequency, phasors, rate, 0.5, ACCURACY)[0].mean()
    product = 128
    magnus = steps * (3 * 24 * points + 12 * product + 16 * 30)
    count = NEWTON_MATRICES * newton + points * (state + jacobian + 24 * 7) + magnus + 2500
    square = np.random.default_rng(0).random((1500, 1500))
    square @ square
    begin = time.perf_counter()
    square @ square
    return count, 2 * 1500**3 / (time.perf_counter() - begin)


def motion_of(system):
    u, *_ = harmonic_balance(system, ORDERS)
    return u, ORDERS


CURES = (
    ("series60-cb60", {"factors": {"K_prr": -60.0}}, (121.92, 4.0), 8.6, 30.0),
    ("dtmb5415", {"ends": "three-dimensional"}, (200.0, 10.0), 14.0, 50.0),
)
"""Unstable conditions of the paper's ships: six cures and four are found among seven parameters, the second one's at jumps."""


def seconds_for_cures(name, changes, wave, speed, heading, repeats=5):
    """Processor time of one search, the median of several after one that compiles and keeps what belongs to the hull [s]."""
    ship, times = qt.paper_ship(name).with_(**changes), []
    for _ in range(repeats + 1):
        begin = time.process_time()
        qt.cures(ship, qt.Wave(*wave), speed, heading)
        times.append(time.process_time() - begin)
    return statistics.median(times[1:])


def main():
    blocks = systems()
    count = sum(b.count for b in blocks)
    print(f"{count} conditions of the cubic system, three harmonics, {workers()} cores; median of 7 (min, max)")
    rates = {}
    for words, goal, work in (
        ("motion, multipliers, K2, S", 100_000, motion_and_stability),
        ("the whole ladder as well", 50_000, whole_ladder),
    ):
        median, least, most = seconds(work, blocks)
        rates[words] = median / count
        print(
            f"{words:28s} {count / median:9,.0f} a second ({count / most:,.0f} to {count / least:,.0f}), goal {goal:,};"
            f" {1e6 * median / count:.1f} us each"
        )
    ours = rates["motion, multipliers, K2, S"]
    median, least, most = seconds(motion_and_stability, systems("strips"))
    print(
        f"{'drag by strips in the water':28s} {count / median:9,.0f} a second ({count / most:,.0f} to {count / least:,.0f}),"
        f" {ours * count / median:.2f} of the rate with cubics, goal 0.50"
    )
    median, least, most = seconds(motion_and_stability, default_systems())
    print(
        f"{'a ship with the defaults':28s} {count / median:9,.0f} a second ({count / most:,.0f} to {count / least:,.0f}),"
        f" {ours * count / median:.2f} of the rate with cubics, goal 0.50"
    )
    for one in CURES:
        print(f"{'cures, ' + one[0]:28s} {seconds_for_cures(*one):9.2f} s of processor time, goal 0.50")
    work, machine = operations(blocks[len(blocks) // 2])
    print(
        f"about {work:,.0f} operations a condition; dgemm does {machine / 1e9:.0f} thousand million a second here, so the"
        f" arithmetic limit is {1e6 * work / machine:.1f} us a condition: {work / machine / ours:.0%} of it is reached"
    )
    found = [accuracy(b) for b in blocks[::5]]
    print(
        f"largest error: amplitude {max(f[0] for f in found):.1e} of the largest, multipliers {max(f[1] for f in found):.1e};"
        f" of {sum(b.count for b in blocks[::5])}, another motion than one at a time finds: {sum(f[2] for f in found)},"
        f" none found by one or both: {sum(f[3] for f in found)}"
    )


if __name__ == "__main__":
    main()
