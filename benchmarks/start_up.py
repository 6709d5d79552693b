"""How a session feels: cold compilation, a warm map from the shell, the help text, and memory.

Each figure is of a whole process started from this one. Usage: python benchmarks/start_up.py
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
    """Wall time of one command in a folder, with its compiled kernels in another [s]."""
    begin = time.perf_counter()
    environment = os.environ | {"NUMBA_CACHE_DIR": str(cache), "MPLCONFIGDIR": str(cache)}
    subprocess.run([*COMMAND, *words], cwd=folder, env=environment, check=True, capture_output=True)
    return time.perf_counter() - begin


def main():
    """Measure and print beside the goals."""
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as cache:
        polar = ["polar", "series60-cb60"]
        cold = run(polar, folder, cache)
        warm = [run(polar, folder, cache) for _ in range(5)]
        asked = [run(["--help"], folder, cache) for _ in range(5)]
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print("                                          median    min    max   goal")
    print(f"first map, kernels compiled [s]          {cold:7.2f}                 {statistics.median(warm) + 20:.0f}")
    print(f"  of it compilation, first less later [s]{cold - statistics.median(warm):7.2f}                 20")
    print(
        f"later maps from the shell [s]            {statistics.median(warm):7.2f} {min(warm):6.2f} {max(warm):6.2f}   4"
    )
    print(
        f"quartering --help [s]                    {statistics.median(asked):7.2f} {min(asked):6.2f} {max(asked):6.2f}   0.5"
    )
    print(f"peak memory of any of them [MB]          {memory:7.0f}                 500")


if __name__ == "__main__":
    main()
