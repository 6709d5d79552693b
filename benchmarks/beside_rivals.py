"""This library beside rivals written to win: the same systems, the same accuracy, in turn, on one thread.

    python benchmarks/beside_rivals.py                       # all jobs
    python benchmarks/beside_rivals.py --job cubic --turns 9
    python benchmarks/beside_rivals.py --json ratios.json

Jobs: `cubic`, periodic motion in three harmonics, multipliers, K2 and S of a made-up ship over ground; `relative`, the same of
a ship as it is read, drag by strips in moving water, the rivals given the water's velocity at every strip; `ensemble`, the
cubic ship through half hours of a sea of 50 components. Each rival stands in a file of its own in `rivals/`; heyoka and jax
come with the extra `bench`, and one that is missing is named as not run. Times are of the processor, so that other work on
the machine hardly counts, and ratios are of neighbours in time: the median, in brackets the least and the most.
"""

import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ[_name] = "1"  # before anybody counts the cores
if hasattr(os, "sched_setaffinity"):
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})

import argparse
import json
from dataclasses import dataclass

import numpy as np
from rivals import harmonic_jax, harmonic_numba, phasors_numba, shooting_heyoka, strips_numba, systems
from rivals.measure import busy, in_turn, processor, ratios, spread_of
from rivals.reference import apart, shot

OURS = "quartering"
AMPLITUDE, MULTIPLIERS = 2e-6, 5e-6
"""Accuracy that all are held to: of roll, in radians, and of the multipliers."""
OF_KINKS = 2e-5
"""Accuracy of roll, relative, with drag |q| q: what 48 samples a cycle give, ours and the rival's."""
GOALS = {
    ("cubic", "numba, every harmonic"): 8.0,
    ("relative", "numba, drag by strips"): 5.0,
    ("ensemble", "numba, phasors"): 3.0,
}


@dataclass(frozen=True)
class Sea:
    """Components (c,), their forces (c, 3) complex, and phases (n, c)."""

    w: np.ndarray
    force: np.ndarray
    phase: np.ndarray


def sea(realisations, components=50):
    random = np.random.default_rng(3)
    gap = (2.2 - 0.45) / (components - 1)
    w = np.linspace(0.45, 2.2, components) + random.uniform(-0.4, 0.4, components) * gap
    spectrum = w**-5 * np.exp(-1.25 * (0.9 / w) ** 4)
    size = np.sqrt(2 * spectrum / spectrum.sum())
    force = size[:, None] * np.array([0.15, 0.035 * np.exp(0.6j), 0.05 * np.exp(-0.9j)])
    return Sea(w, force, random.uniform(0, 2 * np.pi, (realisations, components)))


def by_us(system, accuracy):
    """Amplitudes, multipliers, K2 and S, as a map has them."""
    from conditions import motion_and_stability

    u, _, multipliers, k2, s = motion_and_stability(system, accuracy)
    return np.hypot(u[:, :, 0], u[:, :, 1]), multipliers, k2, s


def cubic(count, turns, others=True):
    """Every tool on the cubic system, slow rivals on fewer of its conditions; ``others``: with those that packages bring."""
    job, checked = systems.cubic(count), 12
    own = job.system()
    solve = {
        OURS: (count, lambda job: by_us(job.system() if job.w.size != count else own, MULTIPLIERS)),
        "numba, every harmonic": (count, lambda job: harmonic_numba.harmonic_balance(job, odd=False, steps=112)),
        "numba, odd harmonics": (count, lambda job: harmonic_numba.harmonic_balance(job, odd=True, steps=56)),
    }
    left_out = []
    if not others or harmonic_jax.missing():
        left_out.append("jax, vmap")
    else:
        run = harmonic_jax.compiled(job, steps=56)
        solve["jax, vmap"] = (1024, run)
    if not others or shooting_heyoka.missing():
        left_out.append("heyoka, batch mode")
    else:
        shoot = shooting_heyoka.Shooting(job, 1e-8)
        solve["heyoka, batch mode"] = (512, shoot)
    right, multipliers = shot(job, checked)
    errors = {}
    for name, (_, one) in solve.items():
        found = one(job.first(checked))
        size = found[0][:, 1] if found[0].ndim == 2 else found[0]
        errors[name] = {
            "amplitude": float(np.abs(size - right).max()),
            "multipliers": float(apart(found[1], multipliers).max()),
        }
    parts = {name: job.first(n) for name, (n, _) in solve.items()}
    work = {name: (lambda one=one, part=parts[name]: one(part)) for name, (_, one) in solve.items()}
    times = in_turn(work, turns)
    each = {name: [t / solve[name][0] for t in own_times] for name, own_times in times.items()}
    return told("cubic", each, errors, left_out, (AMPLITUDE, MULTIPLIERS))


def relative(count, turns, others=True):  # noqa: ARG001
    """Drag by strips in moving water; right is a harmonic balance of many samples and steps."""
    job, checked = systems.by_strips(count), 200
    own = job.system()
    few = job.first(checked)
    right, multipliers, *_ = strips_numba.harmonic_balance(few, samples=2048, steps=2048)
    solve = {
        OURS: lambda job: by_us(job.system(), MULTIPLIERS),
        "numba, drag by strips": lambda job: strips_numba.harmonic_balance(job, samples=48, steps=84),
    }
    errors = {}
    for name, one in solve.items():
        size, found, *_ = one(few)
        errors[name] = {
            "amplitude": float((np.abs(size[:, 1] - right[:, 1]) / right[:, 1]).max()),
            "multipliers": float(apart(found, multipliers).max()),
        }
    work = {OURS: lambda: by_us(own, MULTIPLIERS), "numba, drag by strips": lambda: solve["numba, drag by strips"](job)}
    each = {name: [t / count for t in own_times] for name, own_times in in_turn(work, turns).items()}
    left_out = ["jax and heyoka (written for the cubic system alone)"]
    return told("relative", each, errors, left_out, (OF_KINKS, MULTIPLIERS))


def ensemble(count, turns, others=True):  # noqa: ARG001
    """Half hours of a sea with steps of 0.2 s where a roll period is 12 s; right is one with steps a quarter as long."""
    import quartering as qt

    job, waves = systems.cubic(1), sea(count)
    unit = 2 * np.pi / 12.0
    h, steps = 0.2 * unit, 9000
    terms = {"K_phi": -1.0, "K_phiphiphi": job.g}
    for k, row in enumerate("YKN"):
        terms |= {f"{row}_{name}": -job.damping[k, i] for i, name in enumerate("vpr")}
        names = ["v" * a + "p" * b + "r" * c for a, b, c in systems.MONOMIALS]
        terms |= {f"{row}_{name}": job.products[k, i] for i, name in enumerate(names)}
    model = qt.Model(np.eye(3), terms, 1.0, (0, 0, 0), (0, 0, 0))

    def ours(which, h, steps):
        found = qt.irregular(model, waves.w, waves.force, which, steps * h, step=h, limit=10.0)
        return np.radians(found["roll_rms"].values), np.radians(found["roll_peak"].values)

    def rival(which, h, steps):
        return phasors_numba.ensemble(job, Sea(waves.w, waves.force, which), steps, h)

    few = waves.phase[:8]
    right = rival(few, h / 4, 4 * steps)[0]
    solve = {OURS: ours, "numba, phasors": rival}
    errors = {name: {"amplitude": float(np.abs(one(few, h, steps)[0] - right).max())} for name, one in solve.items()}
    work = {name: (lambda one=one: one(waves.phase, h, steps)) for name, one in solve.items()}
    each = {name: [1000 * t / count for t in own] for name, own in in_turn(work, turns).items()}
    return told("ensemble", each, errors, [], (1e-4, np.inf))


def told(job, each, errors, left_out, allowed):
    """The result of a job, and whether all kept the accuracy."""
    kept = all(e["amplitude"] <= allowed[0] and e.get("multipliers", 0.0) <= allowed[1] for e in errors.values())
    return {
        "job": job,
        "seconds": {name: spread_of(values) for name, values in each.items()},
        "ratios": ratios(each, OURS),
        "errors": errors,
        "accuracy_kept": kept,
        "not_run": left_out,
    }


JOBS = {"cubic": (cubic, 4096), "relative": (relative, 4096), "ensemble": (ensemble, 256)}
UNITS = {
    "cubic": (1e6, "us a condition"),
    "relative": (1e6, "us a condition"),
    "ensemble": (1.0, "s a thousand half hours"),
}


def printed(result):
    job = result["job"]
    scale, unit = UNITS[job]
    print(f"{job}: processor time [{unit}], median (least, most); ratio to ours; largest errors")
    for name, t in result["seconds"].items():
        line = f"  {name:24s} {scale * t['median']:9.2f} ({scale * t['least']:.2f}, {scale * t['most']:.2f})"
        if name in result["ratios"]:
            r = result["ratios"][name]
            line += f"  {r['median']:6.2f} ({r['least']:.2f}, {r['most']:.2f})"
            goal = GOALS.get((job, name))
            line += f", goal {goal:g}" if goal else ""
        errors = ", ".join(f"{what} {value:.1e}" for what, value in result["errors"][name].items())
        print(f"{line}; {errors}")
    for name in result["not_run"]:
        print(f"  {name}: not run")
    if not result["accuracy_kept"]:
        print("  NOT of equal accuracy: these ratios mean nothing")


def measured(jobs=tuple(JOBS), turns=7, others=True):
    """Results of some jobs, with or without the rivals that other packages bring, and where they were measured."""
    results = {}
    for name in jobs:
        run, count = JOBS[name]
        results[name] = run(count, turns, others)
    return {"processor": processor(), "load": busy(), "turns": turns, "jobs": results}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--job", nargs="+", choices=JOBS, default=list(JOBS))
    parser.add_argument("--turns", type=int, default=7)
    parser.add_argument("--json", metavar="FILE", help="write the results there")
    options = parser.parse_args()
    if options.turns < 1:
        parser.error(f"--turns {options.turns}: give 1 or more; try 7")
    found = measured(options.job, options.turns)
    print(f"{found['processor']}; one thread; {found['load']:.1f} programs a core wanted to run")
    for result in found["jobs"].values():
        printed(result)
    if options.json:
        with open(options.json, "w") as file:
            json.dump(found, file, indent=1)


if __name__ == "__main__":
    main()
