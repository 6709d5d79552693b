"""Three-dimensional end corrections to the section added mass, from a double-body panel solution.

Section coefficients are those of an infinitely long cylinder. At zero frequency no waves are made, and strip and hull can both
be solved (`double_body`); their difference d is added to the section potentials. How the water's part changes from there
with frequency, its memory, keeps the form it has in the section and is scaled by one factor m: that which sets right the
sway added mass between zero and infinite frequency, where both can be solved again:

    psi(w) = psi_2D(0) + f d + m (psi_2D(w) - psi_2D(0)),    a and b likewise.

The factor f takes d into short waves. d rests on the calm plane being a wall, in which the section, of draught T, has its
image. Sway and roll set the water moving as dipoles do; the flow of one, 2 T away in the image, is made of wave numbers q along
the plane with weights q e^{-2 q T}. Those above w^2/g make no waves, and the plane is a wall to them; those below do, and
radiate from the section as in the strip. So what is left of d is

    f = int_{w^2/g}^inf q e^{-2 q T} dq / int_0^inf q e^{-2 q T} dq = (1 + 2 T w^2/g) e^{-2 T w^2/g} .

f is real: what it takes from added mass has no damping of its own, so Kramers and Kronig hold for the memory and not for f d.

Nothing is fitted. m is held between 0 and 1: a shallow overhang beside a deep skeg would have more, from water that is not
its own. So damping stays above zero and below that of the strip, and radiation and diffraction use the same potentials.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np

from quartering._machine.cache import cached
from quartering._machine.digest import fingerprint, source_digest
from quartering._machine.threads import small_matrices
from quartering.conventions import GRAVITY
from quartering.hull.lines.hull import STEM_HALF_THICKNESS, Hull
from quartering.hull.lines.mesh import Grid, hull_grid
from quartering.hull.lines.section import Floats
from quartering.hull.lines.strips import Strips, wholly_under_water
from quartering.hydro.strip.double_body import double_body
from quartering.hydro.strip.table import SectionTable

ENDS_WORDS: Final = "with three-dimensional ends"
PANELS: Final = (30, 12)
"""Panels along the hull and from keel to waterline: four times as many change the hull's added mass by less than 1 %."""


class EndEffect(NamedTuple):
    """What the ends change, at places along a hull: its two ends, and the middles of columns of panels between.

    Parameters
    ----------
    x : (n,) float            from midship [m]
    share : (n, m) float      of the girth of the contour, from the keel (0) to the waterline [1]
    change : (n, m, 2) float  of the potential at zero frequency, over the draught there in sway, over its square in roll [1]
    memory : (n,) float       factor on how the section's water changes from zero frequency on, 0 to 1
    """

    x: Floats
    share: Floats
    change: Floats
    memory: Floats


@lru_cache(maxsize=8)
def end_effect(hull: Hull) -> EndEffect:
    """What the ends of a hull change at its sections, kept for the process and on disk.

    hull: at its draught

    At an end that closes in a line no potential and no waves are left; at one that closes in a flat (a transom, the water
    does not leave it) the last column's values are held.
    Source: [Morino74], [Hess67] double body; [Cummins62], [Ogilvie64] memory.  Valid: no forward speed.
    """
    grid = _opened(hull_grid(hull, *PANELS))
    name = f"ends-{fingerprint([source_digest('hull', 'hydro'), *grid])}"
    return EndEffect(**cached(name, lambda: _effect(grid)._asdict()))


def _opened(grid: Grid) -> Grid:
    """The grid with a bare skeg or web as thick as the line of a stem, so that its two sides are not one."""
    y = np.maximum(grid.y, STEM_HALF_THICKNESS * grid.y.max())
    y[:, 0] = 0.0
    y[~grid.y.any(axis=1)] = 0.0
    return grid._replace(y=y)


def _effect(grid: Grid) -> EndEffect:
    with small_matrices():  # a library that shares out a large matrix rounds otherwise with every number of threads
        body = double_body(grid)
    y, z = (0.5 * (points[1:] + points[:-1]) for points in (grid.y, grid.z))
    piece = np.hypot(np.diff(y, axis=1), np.diff(z, axis=1))
    share = (np.cumsum(piece, axis=1) - 0.5 * piece) / piece.sum(axis=1, keepdims=True)
    scale = z.max(axis=1)[:, None, None] ** np.array([1, 2])
    change, strip = (body.hull[0] - body.sections[0]) / scale, body.sections[0] / scale
    memory = np.clip(_memory(body.hull, body.velocity) / _memory(body.sections, body.along), 0.0, 1.0)
    pointed = [not grid.y[end].any() for end in (0, -1)]
    at_ends = [-strip[end] if bare else change[end] for end, bare in zip((0, -1), pointed, strict=True)]
    left = [0.0 if bare else memory[end] for end, bare in zip((0, -1), pointed, strict=True)]
    keel = np.zeros((len(z) + 2, 1))
    return EndEffect(
        np.concatenate([grid.x[:1], 0.5 * (grid.x[1:] + grid.x[:-1]), grid.x[-1:]]),
        np.hstack([keel, np.concatenate([share[:1], share, share[-1:]])]),
        np.concatenate([keel[..., None] * [1, 1], np.concatenate([at_ends[:1], change, at_ends[1:]])], axis=1),
        np.concatenate([left[:1], memory, left[1:]]),
    )


def _memory(potential: Floats, flux: Floats) -> Floats:
    """Sway added mass of each column at zero frequency less that at infinite frequency, over -density: (n,)."""
    return np.asarray(((potential[0] - potential[1]) * flux)[..., 0].sum(axis=1))


def with_ends(table: SectionTable, immersed: Strips, effect: EndEffect, draught: float) -> SectionTable:
    """Section coefficients and potentials with three-dimensional ends.

    table: of strips, the first of its frequencies 0
    immersed: the same sections
    effect: of their hull
    draught: T of the hull [m]
    Returns the integrals over the length are those of the hull; at one section a24 is the mean of the roll moment by
        sway and the sway force by roll, which only agree on the whole

    Where the waves are short against the draught the correction of the potentials fades into the strips.
    Source: [Morino74] double body; [Cummins62] memory; the fading is closed form (the head of this file).
    """
    own = ~wholly_under_water(immersed)[:, None]
    m = own * np.interp(immersed.x, effect.x, effect.memory)[:, None]
    short = 2.0 * draught * table.frequency**2 / GRAVITY
    fading = ((1.0 + short) * np.exp(-short))[:, None, None, None]
    change = fading * (own[..., None] * _on_contours(table, immersed, effect))
    normal = np.stack([table.ny, table.y * table.nz - table.z * table.ny], axis=-1)
    mass = -2.0 * table.density * np.einsum("fsni,snj->fsij", change, normal)
    added = np.stack([mass[..., 0, 0], 0.5 * (mass[..., 0, 1] + mass[..., 1, 0]), mass[..., 1, 1]], axis=-1)
    start = table.psi[0]
    return replace(
        table,
        a=table.a_zero + added + m * (table.a - table.a_zero),
        b=m * table.b,
        psi=start + change + m[..., None] * (table.psi - start),
        a_zero=table.a_zero + added[0],
        a_infinite=table.a_zero + m * (table.a_infinite - table.a_zero),
    )


def _on_contours(table: SectionTable, immersed: Strips, effect: EndEffect) -> Floats:
    """Change of the potentials (s, n, 2) at the contour points of a table, by place and share of the girth."""
    piece = np.hypot(table.ny, table.nz)[:, ::-1]  # from the keel
    share = (np.cumsum(piece, axis=1) - 0.5 * piece) / piece.sum(axis=1, keepdims=True)
    after = np.clip(np.searchsorted(effect.x, immersed.x), 1, effect.x.size - 1)
    step = np.clip((immersed.x - effect.x[after - 1]) / np.diff(effect.x)[after - 1], 0.0, 1.0)
    change = np.empty((*table.y.shape, 2))
    for s, (k, t) in enumerate(zip(after, step, strict=True)):
        known = (1 - t) * effect.share[k - 1] + t * effect.share[k]
        value = (1 - t) * effect.change[k - 1] + t * effect.change[k]
        for mode in (0, 1):
            change[s, ::-1, mode] = np.interp(share[s], known, value[:, mode]) * immersed.draught[s] ** (mode + 1)
    return change
