"""How time grows with the size of the work: points a section, sections, frequencies, headings, terms, harmonics, states, cells.

    python benchmarks/growth.py                # one table, two minutes
    python benchmarks/growth.py --json growth.json

Each row takes one size from small to large with all others held, in turn, in processor time on one thread, and tells the median
of each and the exponent e of time ~ size^e: the slope of the straight line through the logarithms of the last three, where what
does not grow with the size weighs least. What is not linear says why.
"""

import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ[_name] = "1"  # before anybody counts the cores
if hasattr(os, "sched_setaffinity"):
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})

import argparse
import json
import statistics
from dataclasses import dataclass, replace
from itertools import combinations_with_replacement

import numpy as np
from hull_database import frequencies, new_ship, outlines
from rivals import systems
from rivals.measure import busy, in_turn, processor

import quartering as qt
from quartering.hydro.section.diffraction import section_diffraction
from quartering.loads.sea.cells import wave_cells
from quartering.motion.equations.batch import copies
from quartering.motion.sea.closure import linear_response
from quartering.motion.steady.harmonic import harmonic_balance
from quartering.stability.variational.transition import transition_matrices
from quartering.study.seas.response import sea_equations

TURNS = 5
CONDITIONS = 512


@dataclass(frozen=True)
class Row:
    """One size grown: its name, the sizes, the work at a size, and why it is not linear where it is not."""

    name: str
    sizes: tuple[int, ...]
    work: object
    why: str = ""


def of_sections():
    """Rows of the close-fit sections: points, sections, frequencies, headings."""
    one = new_ship()
    every, w = outlines(one), frequencies(one)
    mu = np.linspace(0.0, 180.0, 7)

    def solved(count=8, frequencies=12, headings=mu, panels=25):
        own = [replace(part) for part in every[:count]]  # anew each time, so that nothing prepared is used again
        return section_diffraction(own, np.linspace(w[0], w[-1], frequencies), headings, panels=panels)

    return [
        Row(
            "points a section",
            (20, 30, 45, 68),
            lambda n: lambda: solved(panels=n),
            "every point feels every other: influences grow with the square, and solving for them tends to the cube",
        ),
        Row("sections (stations)", (4, 8, 16, 24), lambda n: lambda: solved(count=min(n, len(every)))),
        Row(
            "frequencies",
            (10, 40, 80, 160),
            lambda n: lambda: solved(frequencies=n),
            "what belongs to the contour alone is computed once, and weighs less and less",
        ),
        Row(
            "headings",
            (37, 145, 289, 577),
            lambda n: lambda: solved(headings=np.linspace(0.0, 180.0, n)),
            "they share the solution of each frequency, which most of the time goes into; few of them are almost free",
        ),
    ]


def with_terms(count):
    """A system with products of degrees 7, 5 and 3 of four states, all small: as many samples for few as for many."""
    job = systems.cubic(CONDITIONS)
    base = job.system()
    powers = []
    for degree in (7, 5, 3):
        for factors in combinations_with_replacement(range(4), degree):
            powers.append([factors.count(s) for s in range(4)])
    random = np.random.default_rng(5)
    chosen = np.array(powers[:count])
    coefficients = random.normal(0.0, 0.001, (3, len(chosen)))
    return replace(
        base,
        powers=chosen,
        modulus=np.zeros(len(chosen), dtype=np.int64),
        coefficients=np.tile(coefficients, (base.count, 1, 1)),
    )


def of_motions():
    """Rows of periodic motions: terms, harmonics; and states in the integration of variational equations."""
    cubic = systems.cubic(CONDITIONS).system()

    def by_terms(n):
        system = with_terms(n)
        return lambda: harmonic_balance(system, (1, 3))

    def by_harmonics(n):
        return lambda: harmonic_balance(cubic, tuple(range(1, n + 1, 2)))

    def by_states(n):
        ship = qt.ship("series60-cb60")
        if n > 4:
            lag = 2.0 if n == 6 else 0.0
            ship = ship.with_(autopilot=qt.Autopilot(gain=1.0, rate_gain=8.0, lag=lag))
        model = qt.equations(ship, qt.Wave(150.0, 3.0), 7.5, 60.0)
        if model.system.states != n:
            raise SystemExit(f"{n} states wanted, the model has {model.system.states}")
        system = copies(model.system, 64)
        u = np.zeros((64, 3, 4))
        steps = np.full(64, 200)
        return lambda: transition_matrices(system, u, (1, 3), 0.5, steps)

    return [
        Row(
            "terms",
            (25, 50, 100, 196),
            by_terms,
            "evaluation is linear in them; the matrices of Newton's method are as large with few as with many",
        ),
        Row(
            "harmonics",
            (5, 9, 17, 33),
            by_harmonics,
            "unknowns grow with them, and samples: the matrices' sums and factors with the cube, the rest with the square",
        ),
        Row(
            "states",
            (4, 5, 6),
            by_states,
            "the drag by strips, which takes most, does not feel them; products of matrices grow with the cube",
        ),
    ]


def of_seas():
    """The row of a sea: cells of frequency and heading."""
    ship, sea = qt.ship("series60-cb60"), qt.Sea(hs=3.0, tp=9.0, heading=60.0, spreading=2.0)

    def by_cells(n):
        damping, cells = 0.2, None
        while cells is None or cells.sigma.size * cells.heading.size < n:
            damping *= 0.97
            cells = wave_cells([sea], 7.5, 0.5, damping)
        return lambda: linear_response(sea_equations(ship, cells, None, "stf"))

    return [
        Row(
            "sea cells",
            (2000, 4000, 8000, 16000),
            by_cells,
            "coefficients are interpolated in tables whose making does not grow with the cells",
        )
    ]


def exponent(sizes, times):
    """Slope of log time over log size through the last three."""
    return float(np.polyfit(np.log(sizes[-3:]), np.log(times[-3:]), 1)[0])


def measured(row, turns=TURNS):
    work = {str(n): row.work(n) for n in row.sizes}
    times = [statistics.median(own) for own in in_turn(work, turns).values()]
    return {"sizes": row.sizes, "seconds": times, "exponent": exponent(row.sizes, times), "why": row.why}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--turns", type=int, default=TURNS)
    parser.add_argument("--json", metavar="FILE", help="write the results there")
    options = parser.parse_args()
    print(f"{processor()}; one thread; {busy():.1f} programs a core wanted to run")
    print(f"{'grown':20s} {'sizes':>24s}  {'processor time [ms]':>36s}  exponent")
    found = {}
    for row in [*of_sections(), *of_motions(), *of_seas()]:
        one = found[row.name] = measured(row, options.turns)
        sizes = " ".join(str(n) for n in one["sizes"])
        times = " ".join(f"{1e3 * t:.3g}" for t in one["seconds"])
        print(f"{row.name:20s} {sizes:>24s}  {times:>36s}  {one['exponent']:.2f}", flush=True)
    for name, one in found.items():
        if one["why"]:
            print(f"{name}: {one['why']}")
    if options.json:
        with open(options.json, "w") as file:
            json.dump({"processor": processor(), "load": busy(), "rows": found}, file, indent=1)


if __name__ == "__main__":
    main()
