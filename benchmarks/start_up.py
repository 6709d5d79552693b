"""How a session feels: cold compilation, warm commands from the shell, the help text, and memory.

Each figure is of a whole process started from this one, in processor time: on a machine that others use the wall says more of
them than of us. It is as a user has it, with Python's own compiled files kept, which the first run writes. Beside it stands
what the least of such a process takes here and now, `import numba`, since a busy core is a slow one.

Usage: python benchmarks/start_up.py [runs of each]
"""

import argparse
import os
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

COMMAND = [str(Path(sys.executable).with_name("quartering"))]
CONDITION = ["--heading", "30", "--speed", "7.5", "--wave-length", "150", "--wave-height", "4"]
POLAR = ["polar", "series60-cb60"]
WARM = {
    "a map from the shell": (POLAR, 2.0),
    "quartering verdict": (["verdict", "series60-cb60", *CONDITION], 1.2),
    "quartering hull": (["hull", "series60-cb60"], 1.2),
    "quartering ships": (["ships"], 0.4),
    "quartering --help": (["--help"], 0.3),
}
"""What is asked -> words of the command and goal [s]."""
FIRST_COMPILE = 10.0


def used(words, folder, cache):
    """Processor time of one program in a folder, with its compiled kernels in another [s]."""
    environment = os.environ | {"NUMBA_CACHE_DIR": str(cache), "MPLCONFIGDIR": str(cache)}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # Python's compiled files are a part of an installation
    before = processor_time()
    subprocess.run(words, cwd=folder, env=environment, check=True, capture_output=True)
    return processor_time() - before


def processor_time():
    """Of all programs run so far [s]."""
    so_far = resource.getrusage(resource.RUSAGE_CHILDREN)
    return so_far.ru_utime + so_far.ru_stime


def line(title, runs, goal=None):
    """One line of the table: median, least, largest; goal."""
    wanted = "" if goal is None else f"{goal:g}"
    print(f"{title:42s}{statistics.median(runs):7.2f} {min(runs):6.2f} {max(runs):6.2f}   {wanted}", flush=True)


def main(count):
    """Measure by turns and print beside the goals."""
    floor = [sys.executable, "-c", "import numba"]
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as cache:
        cold = used([*COMMAND, *POLAR], folder, cache)
        for words, _ in WARM.values():  # the rest is compiled, and written down
            used([*COMMAND, *words], folder, cache)
        turns = [
            {"import numba": used(floor, folder, cache)}
            | {title: used([*COMMAND, *words], folder, cache) for title, (words, _) in WARM.items()}
            for _ in range(count)
        ]
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print("processor time [s]                         median    min    max   goal")
    later = statistics.median(turn["a map from the shell"] for turn in turns)
    line("compiling kernels: first map less later", [cold - later], FIRST_COMPILE)
    for title, (_, goal) in WARM.items():
        line(title, [turn[title] for turn in turns], goal)
    line("for comparison: import numba", [turn["import numba"] for turn in turns])
    print(f"peak memory of any of them [MB]           {memory:7.0f}                 500")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", nargs="?", type=int, default=5, help="of each")
    main(parser.parse_args().runs)
