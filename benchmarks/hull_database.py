"""Time of a whole-ship database of a new hull, and of one section and frequency against other programs.

The database: added mass and damping in six modes at 40 frequencies, diffraction force in sway, heave, roll, pitch and yaw at
37 headings. Every repeat takes another hull, so that nothing prepared is used again, and no table is kept on disk.

One section and frequency, with diffraction at 7 headings: PDSTRIP (Fortran) was measured at 2.8 ms with 21 offsets a section
and 5.1 ms with 41, on a machine of two cores; those figures were measured elsewhere and are only quoted. In the same run stands
a plain numpy close-fit with 20 panels, radiation alone: sources on the contour [Frank67], one frequency at a time.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import replace
from itertools import count

import numpy as np
from scipy.special import exp1

from quartering.conventions import GRAVITY
from quartering.hull.file.read import ship
from quartering.hull.lines.hull import scaled
from quartering.hull.lines.immersed import strips
from quartering.hull.ship import Ship
from quartering.hydro.added_mass import hydrodynamics6
from quartering.hydro.section.diffraction import section_diffraction
from quartering.hydro.section.outline import Outline, strip_outline

FREQUENCIES, HEADINGS, FEW_HEADINGS = 40, 37, 7
REPEATS = 7
PDSTRIP = {21: 2.8, 41: 5.1}
"""Offsets a section -> ms per section and frequency with 7 headings, measured elsewhere on two cores."""
_number = count()


def new_ship() -> Ship:
    """Series 60 of a length, beam and draught nobody had before."""
    base = ship("series60-cb60")
    factor = 1 + 1e-4 * (1 + next(_number))
    return replace(base, hull=scaled(base.hull, length=factor, beam=factor, height=factor))


def outlines(one: Ship) -> list[Outline]:
    s = strips(one.hull)
    parts = zip(s.y, s.z, s.dy, s.dz, s.half_breadth, s.draught, strict=True)
    return [strip_outline(y, z, dy, dz, float(b), float(T)) for y, z, dy, dz, b, T in parts]


def frequencies(one: Ship) -> np.ndarray:
    return np.linspace(0.05, 3.0, FREQUENCIES) * np.sqrt(2.0 * GRAVITY / one.hull.beam)


def database(one: Ship) -> tuple[np.ndarray, np.ndarray]:
    """Matrices (f, 6, 6) and diffraction forces (f, h, 5) in sway, heave, roll, pitch and yaw."""
    w, mu = frequencies(one), np.linspace(0.0, 180.0, HEADINGS)
    matrices = hydrodynamics6(one, w).added_mass.to_numpy()
    s = strips(one.hull)
    sections = section_diffraction(outlines(one), w, mu, panels=25)  # (f, s, h, sway heave roll)
    k = w**2 / GRAVITY
    along = np.exp(-1j * k[:, None, None] * np.cos(np.deg2rad(mu)) * s.x[:, None])[..., None]
    total = np.einsum("s,fshm->fhm", s.weight, sections * along)
    moments = np.einsum("s,fshm->fhm", s.weight * s.x, sections[..., :2] * along)
    return matrices, np.concatenate([total, -moments[..., 1:], moments[..., :1]], axis=-1)


def sections(one: Ship, panels: int) -> None:
    """All sections and frequencies: sway, heave and roll with diffraction at 7 headings."""
    section_diffraction(outlines(one), frequencies(one), np.linspace(0.0, 180.0, FEW_HEADINGS), panels=panels)


def plain_close_fit(p: np.ndarray, nu: float) -> np.ndarray:
    """a + b/(i w) over density in sway, heave and roll (3, 3) by sources on straight panels [Frank67], numpy alone.

    Contour p = y + i z, z down, from the port waterline over the keel. The green function is ln r, integrated exactly, and
    the rest, by four Gauss points.
    """
    step = np.diff(p)
    length, tangent, middle = np.abs(step), step / np.abs(step), (p[1:] + p[:-1]) / 2
    normal = 1j * tangent
    node, weight = np.polynomial.legendre.leggauss(4)
    source = middle[:, None] + step[:, None] * node / 2
    X = middle.real[:, None, None] - source.real
    Y = -(middle.imag[:, None, None] + source.imag)
    Z = Y + 1j * np.abs(X)
    wave = np.exp(nu * Z) * (exp1(nu * Z) + 1j * np.pi)
    out = 2j * np.pi * np.exp(nu * Y)
    slope = nu * wave - 1 / Z
    rest = -np.log(np.abs(Z)) - 2 * wave.real + out * np.cos(nu * X)
    along_y = -X / np.abs(Z) ** 2 + 2 * np.sign(X) * slope.imag - nu * out * np.sin(nu * X)
    along_z = Y / np.abs(Z) ** 2 + 2 * slope.real - nu * out * np.cos(nu * X)
    share = length[:, None] * weight / 2
    rest, along_y, along_z = (np.einsum("ijk,jk->ij", f, share) for f in (rest, along_y, along_z))
    local = (middle[:, None] - p[None, :-1]) * tangent.conj()
    with np.errstate(divide="ignore"):
        near = (np.log(local) - np.log(local - length)) * tangent.conj()
    log = (local * np.log(local) - (local - length) * np.log(local - length)).real - length
    own = (near * normal[:, None]).real
    np.fill_diagonal(own, np.pi)
    flux = own + along_y * normal.real[:, None] + along_z * normal.imag[:, None]
    motion = np.stack([normal.real, normal.imag, (middle.conj() * normal).imag], axis=1)
    psi = (log + rest) @ np.linalg.solve(flux, motion.astype(complex))
    return -(psi * length[:, None]).T @ motion


def plain(one: Ship) -> None:
    w = frequencies(one)
    for outline in outlines(one):
        y, z, *_ = outline.at(np.linspace(0.0, outline.corners[-1], 11))
        half = y + 1j * z
        contour = np.concatenate([-half[::-1].conj(), half[1:]])
        for one_frequency in w:
            plain_close_fit(contour, float(one_frequency**2 / GRAVITY))


def best(job: Callable[[Ship], object]) -> tuple[float, float]:
    """Least elapsed time and least processor time, of all threads together, of several ships."""
    elapsed, processor = [], []
    for _ in range(REPEATS):
        one = new_ship()
        start = time.perf_counter(), time.process_time()
        job(one)
        elapsed.append(time.perf_counter() - start[0])
        processor.append(time.process_time() - start[1])
    return min(elapsed), min(processor)


def main() -> None:
    sections_there = len(strips(new_ship().hull).x)
    to_ms = 1e3 / (sections_there * FREQUENCIES)
    start = time.perf_counter()
    database(new_ship())
    print(f"{os.cpu_count()} cores; first call (compiled or from cache) {time.perf_counter() - start:.2f} s")
    print(
        f"whole-ship database, {sections_there} sections x {FREQUENCIES} frequencies x {HEADINGS} headings, six modes and"
    )
    print("diffraction: {:.2f} s, processor {:.2f} s".format(*best(database)))
    print(f"one section and frequency, sway, heave and roll with diffraction at {FEW_HEADINGS} headings [ms]:")
    slow = best(plain)[1] * to_ms
    for offsets, theirs in PDSTRIP.items():
        elapsed, processor = (t * to_ms for t in best(lambda one, panels=offsets - 1: sections(one, panels)))
        print(
            f"  {offsets} offsets: {elapsed:.3f}, processor {processor:.3f}; PDSTRIP, measured elsewhere, {theirs}: "
            f"{theirs / processor:.0f} times this processor time"
        )
    print(f"  plain numpy close-fit, 20 panels, radiation alone, in this run: processor {slow:.2f}")


if __name__ == "__main__":
    os.environ["QUARTERING_CACHE"] = "off"
    main()
