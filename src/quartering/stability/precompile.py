"""Kernel compilation: notice on first use, and a helper process that compiles in parallel.

``python -m quartering.stability.precompile`` leaves the kernels that a first map, or verdict, meets last in the cache on disk,
where the other process finds them.
"""

from __future__ import annotations

import atexit
import logging
import subprocess
import sys
from functools import partial
from multiprocessing import parent_process
from pathlib import Path
from types import ModuleType
from typing import Final, Literal

import numpy as np

from quartering._machine.threads import workers
from quartering.loads.strips import diffraction
from quartering.motion.equations.model import Model
from quartering.motion.steady import harmonic
from quartering.motion.steady.harmonic import solve_with_care
from quartering.motion.transient import approach
from quartering.motion.transient.approach import capsizes_before
from quartering.stability.assessment import assess
from quartering.stability.variational import one_pass, transition

NOTICE = "compiling numerical kernels, once (about a minute on two cores)"
NOT_KEPT = (
    "compiling numerical kernels (about a minute on two cores), in every process, since no folder for them can be written;"
    " name one in "
    "NUMBA_CACHE_DIR"
)


First = Literal["map", "verdict"]
"""What is asked for; its kernels are compiled before those of the other."""
_ANNOUNCED: Final[list[First]] = []


def announce_compilation(first: First = "map") -> None:
    """Say that kernels will be compiled, when they are not in the cache, and have a second process compile some; once.

    first: what this process goes on to

    A warning of the logger "quartering", which stands on stderr unless logging is set up otherwise.  Worker processes of
    `multiprocessing` keep quiet: there may be many.
    """
    if _ANNOUNCED:
        return
    _ANNOUNCED.append(first)
    if parent_process() is not None or compiled(first):
        return
    kept = all(_folders(module) for module in _MODULES[first])
    logging.getLogger("quartering").warning(NOTICE if kept else NOT_KEPT)
    if kept and workers() > 1 and sys.executable:
        beside = subprocess.Popen(
            [sys.executable, "-m", "quartering.stability.precompile", first],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        atexit.register(_stop, beside)


def _stop(process: subprocess.Popen[bytes]) -> None:
    process.terminate()
    process.wait()


def compiled(first: First = "map") -> bool:
    """Are kernels of every module that a map, or a verdict, compiles in the cache, and newer than their source?"""
    return all(_cached(module) for module in _MODULES[first])


_OF_BOTH = (diffraction, harmonic, transition, approach)
_MODULES: Final[dict[First, tuple[ModuleType, ...]]] = {"map": (*_OF_BOTH, one_pass), "verdict": _OF_BOTH}


def _folders(module: ModuleType) -> set[str]:
    """Where the kernels of a module are kept; nowhere, if no folder can be written."""
    paths = (kernel.stats.cache_path for kernel in vars(module).values() if hasattr(kernel, "stats"))
    return {path for path in paths if path}


def _cached(module: ModuleType) -> bool:
    source = Path(str(module.__file__))
    pattern = f"{source.stem}.*.py{sys.version_info.major}{sys.version_info.minor}*.nbi"
    entries = [entry for folder in _folders(module) for entry in Path(folder).glob(pattern)]
    return any(entry.stat().st_mtime >= source.stat().st_mtime for entry in entries)


def compile_ahead(first: First = "map") -> None:
    """Solve and judge one small case by the kernels for hard conditions, of a map, of a verdict, and the way to a motion.

    first: what is waited for
    """
    terms = {"Y_v": -0.4, "K_phi": -1.0, "K_p": -0.05, "K_ppp": -0.1, "K_phiphiphi": -0.2, "N_r": -0.6}
    system = Model(np.eye(3), terms, 0.85, (0, 0.05, 0), (0, 0.02, 0)).system
    u, _, _ = solve_with_care(system, (1, 3), from_rest=True)
    of_map, of_verdict = partial(assess, system, u, (1, 3), detail="map"), partial(assess, system, u, (1, 3), 1e-10)
    sooner, later = (of_map, of_verdict) if first == "map" else (of_verdict, of_map)
    sooner()
    capsizes_before(system, np.ones(1))
    later()


if __name__ == "__main__":
    compile_ahead("verdict" if "verdict" in sys.argv else "map")
