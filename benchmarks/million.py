"""A million conditions of a Series 60 ship, stored: time, memory, cost per condition from 1e4 up, efficiency on two cores.

    python benchmarks/million.py                  # 1e4, 1e5 and 1e6 conditions, and 1e6 on one core
    python benchmarks/million.py --ten-million    # 1e7 as well: some minutes, 2 GB of disk
    python benchmarks/million.py --sizes 1e4
    python benchmarks/million.py --paper          # of the paper's equations: velocities over ground, cubic drag, the polynomial

Each size runs in a process of its own, so that peak memory is its own; kernels are compiled before the clock starts. Says at
the end which of the aims hold: a million in 25 s (of the paper's equations 14 s) and under 1 GB, a flat cost per condition,
85 % parallel efficiency. Run it on an idle machine.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
import warnings

SIZES = {  # headings, speeds, wave lengths, wave heights, GM values
    "1e4": (13, 4, 5, 10, 4),
    "1e5": (19, 8, 8, 10, 8),
    "1e6": (37, 15, 20, 10, 9),
    "1e7": (73, 30, 51, 10, 9),
}
PAPER = {"velocities": "absolute", "drag": "cubic", "righting": "polynomial"}


def run(name: str, cores: int, paper: bool) -> dict[str, float]:
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, set(sorted(os.sched_getaffinity(0))[:cores]))
    warnings.simplefilter("ignore")
    import numpy as np

    import quartering as qt

    ship = qt.ship("series60-cb60").with_(**PAPER if paper else {})
    length = ship.hull.length
    headings, speeds, lengths, heights, loadings = SIZES[name]
    axes = {
        "heading": np.linspace(0.0, 180.0, headings),
        "speed": np.linspace(0.0, 0.3, speeds) * np.sqrt(9.81 * length),
        "wave_length": np.linspace(0.4, 2.3, lengths) * length,
        "wave_height": np.linspace(0.3, 3.0, heights),
        "gm": np.linspace(0.4, 1.2, loadings),
    }
    with tempfile.TemporaryDirectory() as folder:  # compiles
        qt.sweep(ship, **{key: values[:2] for key, values in axes.items()}, store=f"{folder}/small")
    with tempfile.TemporaryDirectory() as folder:
        begin, cpu = time.perf_counter(), time.process_time()
        qt.sweep(ship, **axes, store=f"{folder}/million")
        wall, cpu = time.perf_counter() - begin, time.process_time() - cpu
        disk = sum(os.path.getsize(f"{folder}/million/blocks/{f}") for f in os.listdir(f"{folder}/million/blocks"))
    count = int(np.prod(SIZES[name]))
    return {"count": count, "cores": cores, "wall": wall, "cpu": cpu, "memory": peak_memory(), "disk": disk / 1e6}


def peak_memory() -> float:
    """Of this program alone [MB]; ru_maxrss of a started program may count the one that started it."""
    if os.path.exists("/proc/self/status"):
        with open("/proc/self/status") as file:
            return next(int(line.split()[1]) for line in file if line.startswith("VmHWM")) / 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def aims(found: dict[tuple[str, int], dict[str, float]], paper: bool) -> list[tuple[str, bool]]:
    """What this library promises, in words with the numbers found, and whether it holds."""
    said = []
    two = [r for (_, cores), r in found.items() if cores == 2]
    each = [1e6 * r["wall"] / r["count"] for r in two]
    if len(two) > 1:
        ratio = each[-1] / min(each)
        said.append(
            (
                f"cost per condition: the largest study costs {ratio:.2f} times the cheapest (flat: below 1.25)",
                ratio < 1.25,
            )
        )
    if ("1e6", 2) in found:
        wall, most = found["1e6", 2]["wall"], 14.0 if paper else 25.0
        said.append((f"999,000 conditions in {wall:.1f} s (below {most:g} s)", wall < most))
    memory = max(r["memory"] for r in two)
    said.append((f"peak memory {memory:.0f} MB (below 1,000 MB)", memory < 1000.0))
    if ("1e6", 1) in found and ("1e6", 2) in found:
        gain = found["1e6", 1]["wall"] / found["1e6", 2]["wall"]
        words = f"two cores are {gain:.2f} times as fast as one: parallel efficiency {50 * gain:.0f} % (85 % or more)"
        said.append((words, gain >= 1.7))
    return said


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", nargs="+", choices=SIZES, default=["1e4", "1e5", "1e6"])
    parser.add_argument("--ten-million", action="store_true", help="run 1e7 as well")
    parser.add_argument("--paper", action="store_true", help="of the paper's equations")
    parser.add_argument("--one", nargs=2, metavar=("SIZE", "CORES"), help="run one size in this process and print JSON")
    options = parser.parse_args()
    if options.one:
        print(json.dumps(run(options.one[0], int(options.one[1]), options.paper)))
        return
    print("conditions  cores   wall s   us per condition   cpu us   peak MB   disk MB", flush=True)
    found = {}
    sizes = list(dict.fromkeys([*options.sizes, *(["1e7"] if options.ten_million else [])]))
    for name, cores in [*((size, 2) for size in sizes), *([("1e6", 1)] if "1e6" in sizes else [])]:
        command = [sys.executable, __file__, "--one", name, str(cores), *(["--paper"] if options.paper else [])]
        r = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        found[name, cores] = r
        print(
            f"{r['count']:10d}  {cores:5d}  {r['wall']:7.2f}   {1e6 * r['wall'] / r['count']:16.1f}   "
            f"{1e6 * r['cpu'] / r['count']:6.1f}   {r['memory']:7.0f}   {r['disk']:7.0f}",
            flush=True,
        )
    for words, holds in aims(found, options.paper):
        print(f"{'holds' if holds else 'MISSED'}: {words}")


if __name__ == "__main__":
    main()
