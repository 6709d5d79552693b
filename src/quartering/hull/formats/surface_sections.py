"""Plane cuts of a triangulated hull surface: its sections as lines."""

from __future__ import annotations

from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import InputError
from quartering.hull.formats.offset_tables import Lines
from quartering.hull.formats.surface import Surface
from quartering.hull.lines.datum import Datum, Profile
from quartering.hull.lines.hull import Contour
from quartering.hull.lines.section import Floats
from quartering.hull.lines.stations import check_contour

STATIONS: Final = 61
"""Stations cut through a surface whose points do not lie on stations of their own."""
_OWN_STATIONS: Final = 80
_FLAT: Final = 0.01  # area of a flat across the ship, of its breadth times its height, from which on the lines step
_GAP: Final = 0.05  # distance of two ends of a section that are joined, of its size
_INNER: Final = 0.35  # share of the length to each side of the middle where nothing lies apart from the hull
_MERGE: Final = 1e-6


def surface_profile(surface: Surface) -> Profile:
    """Lowest and highest points of a surface along the ship.

    >>> from quartering.hull.formats.meshes import box_triangles
    >>> from quartering.hull.formats.surface import joined_surface
    >>> surface_profile(joined_surface("box", box_triangles(60.0, 10.0, 6.0), half=False, waterline=None)).middle
    (0.0, 6.0)
    """
    x = surface.points[:, 0]
    low, high = float(x.min()), float(x.max())
    at = low + (high - low) * np.linspace(0.005, 0.995, 41)
    cuts = [(one, cut) for one in at if (cut := _segments(surface, float(one))).size]
    if not cuts:
        raise InputError(f"{surface.name}: the panels have no length along x; x is counted to the bow")
    z = [cut[:, :, 1] for _, cut in cuts]
    lowest, highest = (np.array([float(pick(one)) for one in z]) for pick in (np.min, np.max))
    lowest[np.argmin(lowest)] = float(surface.points[:, 2].min())
    return Profile(np.array([one for one, _ in cuts]), lowest, highest)


def surface_lines(
    surface: Surface,
    stations: int = STATIONS,
    *,
    datum: Datum | None = None,
    calm: float | None = None,
    remarks: tuple[str, ...] = (),
) -> Lines:
    """Sections of a surface as lines.

    surface: checked
    stations: how many to cut when the surface has no stations of its own
    datum: where its heights are counted from
    calm: z of the calm plane; pieces of a section above it are left out [m]
    remarks: what was found
    Returns aft to fore

    Cut at the rows of points when they lie on 8 to 80 stations, else at distances that shorten towards the ends; on both
    sides of a flat across the ship, where the lines step.  Source: geometry.

    >>> from quartering.hull.formats.meshes import box_triangles
    >>> from quartering.hull.formats.surface import joined_surface
    >>> box = joined_surface("box", box_triangles(60.0, 10.0, 6.0), half=False, waterline=None)
    >>> lines = surface_lines(box)
    >>> len(lines.x), lines.contours[5][0].max().round(6)
    (61, np.float64(5.0))
    """
    at = _stations(surface, stations)
    labels = tuple(f"station {k + 1} (x = {one:.5g} m)" for k, one in enumerate(at))
    contours = tuple(_section(surface, float(one), label, calm) for one, label in zip(at, labels, strict=True))
    return Lines(at, contours, labels, f"sections of the surface {surface.name}", datum, None, remarks)


def _stations(surface: Surface, stations: int) -> Floats:
    """Where a surface is cut."""
    x = surface.points[:, 0]
    low, high = float(x.min()), float(x.max())
    step = 1e-5 * (high - low)
    rows = np.unique(np.round(x / step)) * step
    if not 8 <= len(rows) <= _OWN_STATIONS:
        angle = np.linspace(0.0, np.pi, stations)
        rows = low + (high - low) * (0.5 * (1 - np.cos(angle)) / 2 + 0.5 * angle / np.pi)
    flats = [one for one in _flats(surface, step) if low + 2 * step < one < high - 2 * step]
    for one in flats:
        rows = rows[np.abs(rows - one) > 3 * step]
    at = np.clip(rows - np.sign(rows - (low + high) / 2) * step, low + step, high - step)
    sides = [one + side * step for one in flats for side in (-1, 1)]
    return np.unique(np.concatenate([at, np.array(sides)]))


def _flats(surface: Surface, step: float) -> list[float]:
    """Places of flats across the ship."""
    a, b, c = (surface.points[surface.triangles[:, k]] for k in range(3))
    across = (np.abs(a[:, 0] - b[:, 0]) < step) & (np.abs(a[:, 0] - c[:, 0]) < step)
    if not across.any():
        return []
    place = np.round(a[across, 0] / step).astype(np.int64)
    area = np.abs(np.cross(b - a, c - a)[across, 0]) / 2
    least = _FLAT * float(np.prod(np.ptp(surface.points[:, 1:], axis=0)))
    return [float(one * step) for one in np.unique(place) if area[place == one].sum() > least]


def _section(surface: Surface, x: float, label: str, calm: float | None) -> Contour:
    """Starboard half of the cut at x, keel to deck."""
    where = f"{surface.name}: {label}"
    pieces = [_upward(piece) for piece in _pieces(_segments(surface, x))]
    if calm is not None:
        wet = [piece for piece in pieces if piece[:, 1].min() < calm + 1e-6 * np.ptp(surface.points[:, 2])]
        pieces = wet or pieces
    if not pieces:
        raise InputError(f"{where}: the surface has no section here")
    size = max(float(np.ptp(np.concatenate(pieces), axis=0).max()), 1e-9)
    reach = max(float(np.abs(surface.points[:, 1]).max()), 1e-9)
    for piece in pieces:
        nearest, farthest = float(piece[:, 0].min()), float(piece[:, 0].max())
        if nearest > 0.02 * reach:
            raise InputError(
                f"{where}: the section lies apart from the centreplane, y from {nearest:.4g} to {farthest:.4g} m: half of a "
                "catamaran, twin skegs or an appendage; only hulls in one piece about the centreplane are treated here"
            )
    pieces.sort(key=lambda piece: float(piece[:, 1].min()))
    along = surface.points[:, 0]
    inner = abs(x - (along.min() + along.max()) / 2) < _INNER * np.ptp(along)
    for low, high in pairwise(pieces):
        if inner or low[:, 1].max() > high[:, 1].min() + 1e-3 * size:
            raise InputError(
                f"{where}: the section is in several pieces (an appendage apart from the hull, or a second surface inside the "
                "first); only a bulb at the ends may lie apart, under the hull; leave one of them out"
            )
    y, z = np.concatenate([_to_centre(piece, k < len(pieces) - 1) for k, piece in enumerate(pieces)]).T
    while len(y) > 2 and y[-1] < y[-2] and abs(z[-1] - z[-2]) < 0.1 * (y[-2] - y[-1]):  # the deck
        y, z = y[:-1], z[:-1]
    rise = np.maximum.accumulate(z)
    z = np.where(rise - z < 2e-3 * np.ptp(z), rise, z)
    y = np.where(y < 1e-6 * max(float(y.max()), 1e-9), 0.0, y)
    check_contour(where, y, z)
    return y, z


def _upward(piece: Floats) -> Floats:
    """A piece from its lower end to its higher one."""
    return piece if piece[0, 1] <= piece[-1, 1] else piece[::-1]


def _to_centre(piece: Floats, closed: bool) -> Floats:
    """A piece that ends on the centreplane where another one lies over it."""
    return np.concatenate([piece, [[0.0, piece[-1, 1]]]]) if closed and piece[-1, 0] > 0 else piece


def _segments(surface: Surface, x: float) -> Floats:
    """Lines (m, 2, 2) in which the plane at x cuts the triangles, (y, z) on the side y >= 0."""
    side = surface.points[:, 0] > x
    over = side[surface.triangles]
    count = over.sum(axis=1)
    cut = (count == 1) | (count == 2)
    lone = np.argmax(over[cut] == (count[cut] == 1)[:, None], axis=1)
    rows = np.arange(len(lone))
    p, q, r = (surface.points[surface.triangles[cut][rows, (lone + k) % 3]] for k in range(3))
    ends = [p + ((x - p[:, 0]) / (end[:, 0] - p[:, 0]))[:, None] * (end - p) for end in (q, r)]
    lines = np.stack(ends, axis=1)[:, :, 1:]
    if surface.half:
        lines[:, :, 0] = np.abs(lines[:, :, 0])
        return lines
    lines = lines[(lines[:, :, 0] >= 0).any(axis=1)]
    a, b = lines[:, 0].copy(), lines[:, 1].copy()
    for one, other in ((a, b), (b, a)):
        out = one[:, 0] < 0
        share = one[out, 0] / (one[out, 0] - other[out, 0])
        one[out] = one[out] + share[:, None] * (other[out] - one[out])
        one[out, 0] = 0.0
    return np.stack([a, b], axis=1)


def _pieces(lines: Floats) -> list[Floats]:
    """Runs (n, 2) of points that lines make, ends that nearly meet joined."""
    if not len(lines):
        return []
    size = max(float(np.ptp(lines.reshape(-1, 2), axis=0).max()), 1e-9)
    _, first, node = np.unique(
        np.round(lines.reshape(-1, 2) / (_MERGE * size)), axis=0, return_index=True, return_inverse=True
    )
    place = lines.reshape(-1, 2)[first]
    pairs = np.sort(node.reshape(-1, 2), axis=1)
    pairs = np.unique(pairs[pairs[:, 0] != pairs[:, 1]], axis=0)
    runs = [place[run] for run in _runs(pairs, len(place))]
    return _joined(runs, _GAP * size)


def _runs(pairs: NDArray[np.intp], count: int) -> list[list[int]]:
    """Runs of nodes along pairs, from their ends first, then the closed ones."""
    others: list[list[int]] = [[] for _ in range(count)]
    for a, b in pairs.tolist():
        others[a].append(b)
        others[b].append(a)
    left = {(a, b) for a, b in pairs.tolist()}
    found = []
    for start in sorted(range(count), key=lambda node: len(others[node]) != 1):
        while (ahead := _next(start, others, left)) is not None:
            run = [start]
            while ahead is not None:
                run.append(ahead)
                ahead = _next(ahead, others, left)
            found.append(run)
    return found


def _next(node: int, others: list[list[int]], left: set[tuple[int, int]]) -> int | None:
    """The next node along a pair that was not gone yet."""
    for other in others[node]:
        pair = (min(node, other), max(node, other))
        if pair in left:
            left.remove(pair)
            return other
    return None


def _joined(runs: list[Floats], gap: float) -> list[Floats]:
    """Runs whose ends nearly meet made one, the nearest first; an end on the centreplane is one."""
    runs = list(runs)
    while len(runs) > 1:
        best: tuple[float, int, int, int, int] = (gap, -1, -1, 0, 0)
        for i in range(len(runs)):
            for j in range(i + 1, len(runs)):
                for a in (0, -1):
                    for b in (0, -1):
                        p, q = runs[i][a], runs[j][b]
                        if p[0] <= 0 and q[0] <= 0:
                            continue
                        best = min(best, (float(np.hypot(*(p - q))), i, j, a, b))
        if best[1] < 0:
            break
        _, i, j, a, b = best
        one = runs[i] if a == -1 else runs[i][::-1]
        other = runs[j] if b == 0 else runs[j][::-1]
        runs = [run for k, run in enumerate(runs) if k not in (i, j)] + [np.concatenate([one, other])]
    return runs
