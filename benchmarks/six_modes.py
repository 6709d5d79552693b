"""What six modes cost: loads of a wave on the whole hull, GM in a wave, periodic motions with their stability, a march, a map.

    python benchmarks/six_modes.py                  # two minutes
    python benchmarks/six_modes.py --json six.json

Processor time on one thread, medians of several turns, each after one that does not count. Loads by tables stand beside the
pressure integrated directly, both compiled, in turn, over the same states: 62 edges a section, as one would write it
for this, and as many as the library's judge takes. The march by tables stands beside one by direct pressure: heave, pitch and
roll with the same matrices and diffraction, 48 steps of Runge-Kutta a wave period.
"""

import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ[_name] = "1"  # before anybody counts the cores
if hasattr(os, "sched_setaffinity"):
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})

import argparse
import json
import math
import warnings

import numpy as np
from rivals.measure import busy, in_turn, processor, ratios, spread_of

import quartering as qt
from quartering._machine.compiled import kernel
from quartering.loads.wetted_hull.floating import floating_hull, floating_tables
from quartering.loads.wetted_hull.pressure import Waves, direct_load, direct_loads
from quartering.loads.wetted_hull.section_tables import table_loads
from quartering.motion.steady_course.course import course
from quartering.motion.steady_course.doubled import doubled_motions
from quartering.motion.steady_course.march import STATES, march
from quartering.motion.steady_course.orbits import symmetric_orbits
from quartering.stability.parametric import doubled_multipliers, roll_growth

STEEPNESS, SPEED, STATES_TIMED = 0.02, 5.0, 1000
SHIPS = ("s175", "dtc", "series60-cb60")
EDGES = 31
"""Of half a section: 62 of a whole one."""


@kernel
def march_by_pressure(x, weight, count, y, z, z0, state, mass, damping, force, wave, omega, scale, volume, h, steps):
    """Heave, roll and pitch in time by the pressure itself; returns the largest roll [rad]."""
    scratch, load, jacobian = np.empty((7, max(y.shape[1], 8))), np.empty(6), np.empty((6, 3))
    s, frozen = np.empty(3), np.empty(4)
    u, rate, total, stage = state.copy(), np.empty(6), np.empty(6), np.empty(6)
    largest = 0.0
    frozen[:] = wave
    for n in range(steps):
        total[:] = 0.0
        for j in range(4):
            ahead = 0.0 if j == 0 else h if j == 3 else 0.5 * h
            for i in range(6):
                stage[i] = u[i] + ahead * rate[i] if j else u[i]
            time = n * h + ahead
            frozen[3] = omega * time
            s[:] = stage[:3]
            direct_load(x, weight, count, y, z, z0, s, frozen, True, False, scratch, load, jacobian)
            load[2] += volume
            for i in range(3):
                pushed = scale * load[2 + i] + (force[i] * np.exp(1j * omega * time)).real
                for k in range(3):
                    pushed -= damping[i, k] * stage[3 + k]
                rate[3 + i] = pushed
                rate[i] = stage[3 + i]
            a, b, c = rate[3], rate[4], rate[5]
            for i in range(3):
                rate[3 + i] = mass[i, 0] * a + mass[i, 1] * b + mass[i, 2] * c
            total += (1.0 if j in (0, 3) else 2.0) * rate
        u += h / 6.0 * total
        largest = max(largest, abs(u[1]))
    return largest


def states(ship):
    """States and waves of a ship that moves: heave, roll and pitch of some size at many phases."""
    phase = np.linspace(0.0, 60.0, STATES_TIMED)
    state = np.stack([0.1 * ship.hull.draught * np.cos(phase), 0.3 * np.cos(phase / 2), 0.03 * np.sin(phase)], axis=1)
    k = 2 * np.pi / ship.hull.length
    waves = Waves(np.full(phase.size, 0.5 * STEEPNESS * ship.hull.length), np.full(phase.size, -k), 0 * phase, phase)
    return state, waves, k


def loads(name, turns):
    """One load by tables and by direct pressure, of 62 edges and of the judge's [us]."""
    ship = qt.ship(name)
    state, waves, k = states(ship)
    tables, _ = floating_tables(ship, k)
    few, judge = floating_hull(ship, EDGES), floating_hull(ship)
    times = in_turn(
        {
            "table": lambda: table_loads(tables, state, waves),
            "direct, 62 edges": lambda: direct_loads(few.hull, state, waves),
            "direct, the judge": lambda: direct_loads(judge.hull, state, waves),
        },
        turns,
    )
    per_load = {what: spread_of([1e6 * t / STATES_TIMED for t in own]) for what, own in times.items()}
    return {"us": per_load, "ratio": ratios(times, "table"), "edges": 2 * int(judge.hull.points.max() - 1)}


def motions(name, turns):
    """GM in a wave, a symmetric motion with its stability, motions of two periods, and the whole record [ms]."""
    ship = qt.ship(name)
    length = ship.hull.length
    wave = qt.Wave(length, STEEPNESS * length)
    one = course(ship, wave.wavenumber, *(np.array([v]) for v in (wave.amplitude, SPEED, 180.0)))
    found, branches = doubled_motions(one, wave.amplitude, 1.6 * wave.amplitude)
    points = max(1, sum(len(branch.x) for branch in branches))
    times = in_turn(
        {
            "GM, 10 crests, direct": lambda: qt.gm_in_waves(ship, wave, 180.0),
            "GM, 10 crests, table": lambda: qt.gm_in_waves(ship, wave, 180.0, integration="table"),
            "symmetric motion and Floquet": lambda: roll_growth(symmetric_orbits(one), 0.05),
            "all motions of two periods": lambda: doubled_motions(one, wave.amplitude, 1.6 * wave.amplitude),
            "stability of one": lambda: doubled_multipliers(one, branches[0].basis, found[:1]) if len(found) else None,
            "the whole record": lambda: qt.parametric_roll(ship, wave, SPEED),
        },
        turns,
    )
    ms = {what: spread_of([1e3 * t for t in own]) for what, own in times.items()}
    return {"ms": ms, "points": points, "found": len(found)}


def marches(name, turns):
    """Times real time of a march by tables, five modes, and of one by direct pressure, three."""
    ship = qt.ship(name)
    length, k = ship.hull.length, 2 * np.pi / ship.hull.length
    a, periods, steps = 0.5 * STEEPNESS * length, 20, 48
    one = course(ship, k, *(np.array([v]) for v in (a, SPEED, 180.0)))
    omega, start = float(one.numbers.omega[0]), np.zeros(len(STATES))
    start[5] = 0.05
    floats = floating_hull(ship, EDGES)
    mass, damping = one.numbers.mass[0], one.numbers.damping[0]
    order = np.array([0, 3, 1])  # heave, roll, pitch
    inverse = np.linalg.inv(
        np.where(np.eye(3), 0, mass[2][np.ix_(order, order)]) + np.diag([mass[2][0, 0], mass[1][3, 3], mass[2][1, 1]])
    )
    damp = damping[2][np.ix_(order, order)]
    force = a * one.numbers.force[0][order]
    wave, h = np.array([a, -k, 0.0, 0.0]), 2 * math.pi / omega / steps
    first = np.array([0.0, 0.05, 0.0, 0.0, 0.0, 0.0])
    times = in_turn(
        {
            "tables, five modes": lambda: march(one, start, periods, steps),
            "direct, three modes": lambda: march_by_pressure(
                *floats.hull,
                first,
                inverse,
                damp,
                force,
                wave,
                omega,
                float(one.numbers.scale[0]),
                floats.volume,
                h,
                periods * steps,
            ),
        },
        turns,
    )
    sea = periods * 2 * math.pi / omega
    return {
        "times_real_time": {what: spread_of([sea / t for t in own]) for what, own in times.items()},
        "ratio": ratios(times, "tables, five modes"),
    }


def maps(name, turns):
    """A map of 25 speeds and 13 headings in one wave [s]."""
    ship = qt.ship(name)
    wave = qt.Wave(ship.hull.length, STEEPNESS * ship.hull.length)
    speeds, headings = np.linspace(0.0, 0.25 * math.sqrt(9.81 * ship.hull.length), 25), np.linspace(0.0, 180.0, 13)
    times = in_turn({"25 x 13": lambda: qt.polar(ship, wave, speeds, headings, modes="six")}, turns)
    return {"s": spread_of(times["25 x 13"])}


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--json", metavar="FILE", help="write the numbers there too")
    parser.add_argument("--turns", type=int, default=9)
    options = parser.parse_args(arguments)
    warnings.simplefilter("ignore", qt.RangeWarning)
    results = {"processor": processor(), "load": busy(), "ships": {}}
    print(f"{results['processor']}; {results['load']:.1f} programs a core wanted to run")
    for name in SHIPS:
        own = {
            "loads": loads(name, options.turns),
            "motions": motions(name, options.turns),
            "march": marches(name, options.turns),
        }
        results["ships"][name] = own
        print(name)
        for what, unit, values in (
            ("one load", "us", own["loads"]["us"]),
            ("motion", "ms", own["motions"]["ms"]),
            ("march", "times real time", own["march"]["times_real_time"]),
        ):
            for key, value in values.items():
                print(f"  {what}, {key}: {value['median']:.3g} {unit} ({value['least']:.3g} to {value['most']:.3g})")
        print(
            f"  points on the branches of two periods: {own['motions']['points']}; edges of the judge {own['loads']['edges']}"
        )
    results["map"] = maps("dtc", 1)
    print(f"dtc, map of 25 speeds x 13 headings in one wave: {results['map']['s']['median']:.3g} s")
    if options.json:
        with open(options.json, "w") as file:
            json.dump(results, file, indent=2)


if __name__ == "__main__":
    main()
