"""Compiling, ahead of need, the kernels that a first map meets last: run as a process of its own beside the map's.

``python -m quartering.stability.ahead`` leaves them in the cache on disk, where the other process finds them.
"""

from __future__ import annotations

import numpy as np

from quartering.motion.equations import Model
from quartering.motion.harmonic import solve_with_care
from quartering.stability.assessment import assess


def compile_ahead() -> None:
    """Solve and judge one small case by the kernels for hard conditions, multipliers and indices.

    Notes
    -----
    Source: none needed; the compiler works on one thread, so a second process is what shortens the first wait.
    """
    terms = {"Y_v": -0.4, "K_phi": -1.0, "K_p": -0.05, "K_ppp": -0.1, "K_phiphiphi": -0.2, "N_r": -0.6}
    system = Model(np.eye(3), terms, 0.85, (0, 0.05, 0), (0, 0.02, 0)).system
    u, _, _ = solve_with_care(system, (1, 3), from_rest=True)
    assess(system, u, (1, 3), detail="map")


if __name__ == "__main__":
    compile_ahead()
