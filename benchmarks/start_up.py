"""How a session feels: cold compilation, a warm map from the shell, the help text, and memory.

Each figure is of a whole process started from this one. Wall time counts against the goal; processor time stands beside it,
because on a machine that others use the two part. Usage: python benchmarks/start_up.py
"""

import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

COMMAND = [str(Path(sys.executable).with_name("quartering"))]


def run(words, folder, cache):
    """Wall and processor time of one command in a folder, with its compiled kernels in another [s]."""
    environment = os.environ | {"NUMBA_CACHE_DIR": str(cache), "MPLCONFIGDIR": str(cache)}
    before, begin = processor_time(), time.perf_counter()
    subprocess.run([*COMMAND, *words], cwd=folder, env=environment, check=True, capture_output=True)
    return time.perf_counter() - begin, processor_time() - before


def processor_time():
    """Of all commands run so far [s]."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def line(title, runs, goal, less=(0.0, 0.0)):
    """One line of the table: wall time median, least, largest; processor time; goal."""
    wall, used = ([one[i] - less[i] for one in runs] for i in range(2))
    middle, processor = statistics.median(wall), statistics.median(used)
    print(f"{title:42s}{middle:7.2f} {min(wall):6.2f} {max(wall):6.2f} {processor:10.2f}   {goal:g}")


def main():
    """Measure and print beside the goals."""
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as cache:
        polar = ["polar", "series60-cb60"]
        cold = [run(polar, folder, cache)]
        warm = [run(polar, folder, cache) for _ in range(5)]
        asked = [run(["--help"], folder, cache) for _ in range(5)]
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print("                                           median    min    max  processor   goal")
    typical = [statistics.median(one[i] for one in warm) for i in range(2)]
    line("compiling kernels: first map less later [s]", cold, 20, typical)
    line("later maps from the shell [s]", warm, 4)
    line("quartering --help [s]", asked, 0.5)
    print(f"peak memory of any of them [MB]           {memory:7.0f}                               500")


if __name__ == "__main__":
    main()
