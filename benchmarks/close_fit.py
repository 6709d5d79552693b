"""Time of the close-fit section solution: ms per section and frequency, against the Lewis multipole path.

Both do the same job in the same run: sway and roll, with diffraction forces at seven headings by Haskind's relation.
"""

from __future__ import annotations

import os
import time

import numpy as np

from quartering.conventions import GRAVITY
from quartering.hull.file.read import ship
from quartering.hull.lines.immersed import strips
from quartering.hydro.section.closefit.coefficients import close_fit
from quartering.hydro.section.lewis import lewis_forms
from quartering.hydro.section.multipole import Radiation, radiation
from quartering.hydro.section.outline import strip_outline

FREQUENCIES = 40
HEADINGS = np.arange(0.0, 181.0, 30.0)
REPEATS = 5


def diffraction(solution: Radiation, frequency: np.ndarray) -> np.ndarray:
    """Haskind integrals in sway and roll (f, s, h, 2)."""
    k, across = (frequency**2 / GRAVITY)[:, None, None, None], np.sin(np.deg2rad(HEADINGS))[:, None]
    y, z = solution.point.real[:, None], solution.point.imag[:, None]
    ny, nz = solution.normal.real[:, None], solution.normal.imag[:, None]
    phase = k * across * y
    through = np.exp(-k * z) * (across * np.cos(phase) * ny - np.sin(phase) * nz)
    return np.matmul(through, solution.potential)


def best(job) -> float:
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        job()
        times.append(time.perf_counter() - start)
    return min(times)


def main() -> None:
    hull = ship("series60-cb60").hull
    s = strips(hull)
    w = np.linspace(0.05, 3.5, FREQUENCIES) * np.sqrt(2.0 * GRAVITY / hull.beam)
    parts = list(zip(s.y, s.z, s.dy, s.dz, s.half_breadth, s.draught, strict=True))

    def contours():  # made anew each time, so that no prepared matrix is reused
        return [strip_outline(y, z, dy, dz, float(b), float(T)) for y, z, dy, dz, b, T in parts]

    start = time.perf_counter()
    close_fit(contours(), w[:2])
    first = time.perf_counter() - start
    tasks = len(parts) * w.size
    print(f"{len(parts)} sections x {w.size} frequencies, {HEADINGS.size} headings, {os.cpu_count()} cores")
    print(f"first call (compiled or from cache)      {first:8.2f} s")
    lewis = best(lambda: diffraction(radiation(lewis_forms(s.half_breadth, s.draught, s.area), w), w))
    print(f"Lewis multipoles, sway-roll              {1e3 * lewis / tasks:8.4f} ms per section-frequency")
    for panels in (20, 25, 30, 36):
        fitted = best(lambda panels=panels: diffraction(close_fit(contours(), w, panels=panels), w))
        print(
            f"close-fit, {panels} panels, sway-roll           {1e3 * fitted / tasks:8.4f} ms per section-frequency, "
            f"{fitted / lewis:.2f} x Lewis"
        )
    all_modes = best(lambda: [close_fit(contours(), w, mode) for mode in ("lateral", "heave")])
    print(f"whole hull, sway, roll and heave         {all_modes:8.3f} s")


if __name__ == "__main__":
    main()
