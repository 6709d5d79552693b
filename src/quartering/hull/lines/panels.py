"""Panels along a contour for quadrature, refined or merged to a wanted count."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.hull.lines.contour import Curve, along
from quartering.hull.lines.quadrature import gauss
from quartering.hull.lines.section import Floats

POINTS_PER_PANEL: Final = 2
MANY: Final = 64
"""Panels above which many are joined at a time, so that the cost of a contour does not grow with its points' square."""

Nodes = tuple[Floats, Floats, Floats, Floats]
"""Half breadths and heights of quadrature points, and their differentials with the weights in them."""


class _Ends(NamedTuple):
    """Ends of panels: chord length (n,), and y, h, dy/ds, dh/ds towards the panel after and before each (n, 4)."""

    chord: Floats
    after: Floats
    before: Floats


def panel_ends(curve: Curve, end: float, count: int) -> Floats:
    """Chord lengths between which a contour is integrated by Gauss rules of two points.

    curve: of the contour
    end: chord length up to which it is integrated [m]
    count: panels wanted
    Returns (count + 1,): ascending from 0 to ``end``, points of the contour wherever it has enough [m]

    Pieces between points are joined where the rule on one panel in place of two loses least of the area and its moments;
    the longest are halved where there are too few. Up to 64 pieces are joined one pair at a time; of more, every second
    of the cheaper half of the joints goes in one step.
    """
    inner = np.unique(curve.chord[(curve.chord > 1e-9 * end) & (curve.chord < end * (1 - 1e-9))])
    chord = np.concatenate([[0.0], inner, [end]])
    if chord.size - 1 < count:
        return _halved(chord, count)
    below = curve.point[: max(2, int(np.searchsorted(curve.chord, end)))]
    size = max(float(below[:, 0].max()), 1e-3 * end), float(np.ptp(below[:, 1])) or end
    after, before = (np.stack(along(curve, chord, side=side), axis=1) for side in ("right", "left"))
    exact = _moments(_gauss_nodes(curve, chord), size)
    ends, exact = _thinned(_Ends(chord, after, before), exact, size, max(MANY, 2 * count))
    return _joined(ends, exact, size, count)


def panel_nodes(curve: Curve, start: Floats, end: Floats) -> Nodes:
    """Gauss nodes (panels, 2) of the cubics that join panel ends with the curve's own points and tangents there.

    The differentials of a panel sum exactly to the step between its ends, however many offset points lie within.
    """
    first = np.stack(along(curve, start, side="right"), axis=1)
    last = np.stack(along(curve, end, side="left"), axis=1)
    return _cubic_nodes(end - start, first, last)


def _cubic_nodes(width: Floats, first: Floats, last: Floats) -> Nodes:
    """The same from chord lengths of panels and (y, h, dy/ds, dh/ds) at both of their ends."""
    u, du = gauss(POINTS_PER_PANEL, 0.0, 1.0)

    def cubic(v0: Floats, v1: Floats, t0: Floats, t1: Floats) -> tuple[Floats, Floats]:
        m0, m1, step = (t0 * width)[:, None], (t1 * width)[:, None], (v1 - v0)[:, None]
        c2, c3 = 3 * step - 2 * m0 - m1, m0 + m1 - 2 * step
        return v0[:, None] + u * (m0 + u * (c2 + u * c3)), (m0 + u * (2 * c2 + 3 * u * c3)) * du

    (y, dy), (h, dh) = (cubic(first[:, i], last[:, i], first[:, i + 2], last[:, i + 2]) for i in (0, 1))
    return y, h, dy, dh


def _halved(chord: Floats, count: int) -> Floats:
    """Ends with the longest panels halved, the first of equal ones before the others."""
    ends = [float(s) for s in chord]
    while len(ends) - 1 < count:
        widths = np.diff(ends)
        k = int(np.argmax(widths > (1 - 1e-9) * widths.max()))
        ends.insert(k + 1, 0.5 * (ends[k] + ends[k + 1]))
    return np.array(ends)


def _thinned(ends: _Ends, exact: Floats, size: tuple[float, float], enough: int) -> tuple[_Ends, Floats]:
    """Ends of at most ``enough`` panels, and their exact moments: in each step joints of small loss go, no two neighbours."""
    while (spare := ends.chord.size - 1 - enough) > 0:
        loss = _losses(ends, exact, size)
        dear = loss > np.median(loss)
        number = np.arange(loss.size)
        in_run = number - np.maximum.accumulate(np.where(dear, number, -1))  # 0 for a dear joint, then 1, 2, ..
        gone = np.flatnonzero(in_run % 2 == 1)
        gone = gone[np.argsort(loss[gone], kind="stable")[:spare]] + 1
        kept: NDArray[np.intp] = np.delete(np.arange(ends.chord.size), gone)
        exact = np.add.reduceat(exact, kept[:-1], axis=0)
        ends = _Ends(*(part[kept] for part in ends))
    return ends, exact


def _losses(ends: _Ends, exact: Floats, size: tuple[float, float]) -> Floats:
    """What one panel in place of two, either side of each inner end, loses of their moments [m2].

    A trace of the panel's length is added: where nothing is lost, as on a straight side, short panels go first.
    """
    width = ends.chord[2:] - ends.chord[:-2]
    rough = _moments(_cubic_nodes(width, ends.after[:-2], ends.before[2:]), size)
    return np.asarray(np.abs(rough - (exact[:-1] + exact[1:])).sum(axis=1) + 1e-7 * width**2)


def _joined(ends: _Ends, exact: Floats, size: tuple[float, float], count: int) -> Floats:
    """Ends of ``count`` panels: the joint of the smallest loss goes, then its neighbours' losses are found anew."""
    loss = [float(value) for value in _losses(ends, exact, size)]
    chord, after, before = ([*part.tolist()] for part in ends)
    whole = exact.tolist()
    while len(chord) - 1 > count:
        k = loss.index(min(loss)) + 1
        whole[k - 1 : k + 1] = [[a + b for a, b in zip(whole[k - 1], whole[k], strict=True)]]
        del chord[k], after[k], before[k], loss[k - 1]
        for j in (k - 1, k):
            if 1 <= j < len(chord) - 1:
                both = [a + b for a, b in zip(whole[j - 1], whole[j], strict=True)]
                loss[j - 1] = _loss(chord[j + 1] - chord[j - 1], after[j - 1], before[j + 1], both, size)
    return np.array(chord)


def _loss(width: float, first: list[float], last: list[float], both: list[float], size: tuple[float, float]) -> float:
    """`_losses` of one joint, operation by operation: calls on arrays of two numbers would take fifty times as long."""
    breadth, height = size
    y0, h0, ty0, th0 = first
    y1, h1, ty1, th1 = last
    my0, my1, sy = ty0 * width, ty1 * width, y1 - y0
    mh0, mh1, sh = th0 * width, th1 * width, h1 - h0
    cy2, cy3 = 3 * sy - 2 * my0 - my1, my0 + my1 - 2 * sy
    ch2, ch3 = 3 * sh - 2 * mh0 - mh1, mh0 + mh1 - 2 * sh
    parts = []
    for u, du in _RULE:
        y, dy = y0 + u * (my0 + u * (cy2 + u * cy3)), (my0 + u * (2 * cy2 + 3 * u * cy3)) * du
        h, dh = h0 + u * (mh0 + u * (ch2 + u * ch3)), (mh0 + u * (2 * ch2 + 3 * u * ch3)) * du
        parts.append((y * dh, y * h * dh / height, y * y * dy / breadth, h * h * dh / height))
    lost = [abs(a + b - c) for a, b, c in zip(*parts, both, strict=True)]
    return lost[0] + lost[1] + lost[2] + lost[3] + 1e-7 * (width * width)


_RULE: Final = [(float(u), float(du)) for u, du in zip(*gauss(POINTS_PER_PANEL, 0.0, 1.0), strict=True)]


def _moments(nodes: Nodes, size: tuple[float, float]) -> Floats:
    """Integrals of (y dh, y h dh / H, y2 dy / B, h2 dh / H) over pieces of a contour (pieces, 4) [m2]."""
    y, h, dy, dh = nodes
    breadth, height = size
    f = np.stack([y * dh, y * h * dh / height, y * y * dy / breadth, h * h * dh / height], axis=-1)
    return np.asarray(f.sum(axis=1))


def _gauss_nodes(curve: Curve, ends: Floats) -> Nodes:
    """Nodes (pieces, 4) of the curve itself between neighbouring offset points: exact for its moments."""
    u, du = gauss(4, 0.0, 1.0)
    width = np.diff(ends)[:, None]
    s = ends[:-1, None] + width * u
    y, h, dy, dh = (part.reshape(s.shape) for part in along(curve, s.ravel()))
    return y, h, dy * width * du, dh * width * du
