"""Contestants measured in turn: medians of processor time, and what a ratio of two of them is worth.

Work that other programs share the machine with is counted in processor time, which hardly feels them, and in turn, so that
what they do to one they do to all: a ratio is taken of two times of the same turn, and the median of these is told with the
least and the most.
"""

import os
import platform
import statistics
import time
from collections.abc import Callable
from typing import Any


def in_turn(work: dict[str, Callable[[], Any]], turns: int) -> dict[str, list[float]]:
    """Processor seconds of each, once around before any counts, then ``turns`` times around."""
    for one in work.values():
        one()
    times: dict[str, list[float]] = {name: [] for name in work}
    for _ in range(turns):
        for name, one in work.items():
            begin = time.process_time()
            one()
            times[name].append(time.process_time() - begin)
    return times


def spread_of(values: list[float]) -> dict[str, float]:
    """Median, least and most."""
    return {"median": statistics.median(values), "least": min(values), "most": max(values)}


def ratios(times: dict[str, list[float]], ours: str) -> dict[str, dict[str, float]]:
    """How many times longer each of the others takes, turn by turn."""
    return {
        name: spread_of([a / b for a, b in zip(own, times[ours], strict=True)])
        for name, own in times.items()
        if name != ours
    }


def processor() -> str:
    """The processor's kind in words, as far as the machine tells it."""
    name = platform.processor() or platform.machine()
    if os.path.exists("/proc/cpuinfo"):
        with open("/proc/cpuinfo") as file:
            told = dict(part.split(":", 1) for part in file.read().split("\n\n")[0].splitlines() if ":" in part)
        told = {key.strip(): value.strip() for key, value in told.items()}
        family = f"family {told['cpu family']} model {told['model']}" if "cpu family" in told else ""
        name = " ".join(part for part in (told.get("model name", name), family) if part)
    return f"{name}, {platform.machine()}"


def busy() -> float:
    """Programs that want to run, per core: 1 or more is a machine that other work shares."""
    return os.getloadavg()[0] / (os.cpu_count() or 1) if hasattr(os, "getloadavg") else float("nan")
