"""Stability boundary in two parameters: curves of folds and bifurcations by continuation."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from quartering._machine.threads import alone, small_matrices, spread
from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.ship import Ship
from quartering.hull.told import condition, count
from quartering.loads.waves import Wave
from quartering.motion.branches.arclength import Equations, Path, corrected, follow
from quartering.motion.branches.branch import within
from quartering.motion.equations.batch import apart, joined
from quartering.motion.equations.model import Model
from quartering.motion.equations.system import Floats, System
from quartering.motion.steady.balance import balance_of
from quartering.motion.steady.motion import peaks
from quartering.motion.steady.subharmonic import ascending, columns, slowed
from quartering.option_checks import quoted
from quartering.stability.assessment import assess
from quartering.stability.precompile import announce_compilation
from quartering.study.branches.bifurcation_functions import STEP, Boundary
from quartering.study.branches.branch import lines_of, references_of, steepest_of
from quartering.study.branches.family import Limits, Parameters, along, parameter_attributes, parameters
from quartering.study.dataset import attributes

_SCAN = 5
_SAME = 0.02
_LONGEST = 0.05


class Edge(NamedTuple):
    """One curve of an edge: what changes there, its points (scaled unknowns, two shares), whether it closes."""

    boundary: Boundary
    points: Floats
    closed: bool


@takes(ship_or_model="Ship, Model", wave="Wave, None")
def edge(
    ship_or_model: Ship | Model,
    over: tuple[str, str] = ("wave_height", "heading"),
    *,
    limits: tuple[Limits, Limits] = (None, None),
    harmonics: int = 9,
    wave: Wave | None = None,
    speed: float | str = 0.0,
    heading: float | str = 90.0,
    points: int = 400,
) -> xr.Dataset:
    """Follow the edge of stability itself through the plane of two parameters.

    Parameters
    ----------
    ship_or_model : Ship or Model    a ship needs `wave`, `speed` and `heading`
    over : (str, str)                two parameters, each as in `quartering.branch`
    limits : ((low, high), (low, high))    of each; by default as in `quartering.branch`
    harmonics : int                  highest harmonic of the wave's frequency, odd
    wave, speed, heading             of a ship [m/s, deg]
    points : int                     of one curve, at the most

    Returns
    -------
    xarray.Dataset    along ``point``: both parameters, roll, roll_peak [deg], exponent [1/s] (zero when the mode that
                      changes is the last unstable one); ``kind`` is "fold", "symmetry-breaking", "period-doubling" or
                      "neimark-sacker"; ``curve`` numbers the curves, ``periods`` and ``closed`` as in `quartering.branch`;
                      no points where stability does not change between the limits

    Raises
    ------
    InputError        what `quartering.branch` refuses; one parameter given twice; no motion to start from anywhere

    Notes
    -----
    Branches over the first parameter, at its own and at five more values of the second, give the points to start from; each
    edge is followed both ways by pseudo-arclength continuation of the balance equations with one equation more: the
    smallest singular value of the equations for the disturbance that comes in (fold, symmetry breaking, period doubling),
    or the growth of the oscillating pair of multipliers (Neimark-Sacker).  An edge that closes between the values looked
    at is missed.  On an edge the number of growing disturbances of a motion changes; another motion may be stable there.
    Source: [Krack19]; [H71] Figs. 20-22 (boundaries found point by point).

    Examples
    --------
    The folds of Duffing's equation meet in a cusp; below it no jump occurs:

    >>> terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.2, "K_p": -0.04}
    >>> model = Model(np.eye(3), terms, 1.0, (0, 0.1, 0), (0, 0, 0))
    >>> ds = edge(model, ("frequency", "excitation"), limits=((1.0, 1.1), (0.1, 0.3)), harmonics=1)
    >>> round(float(ds["frequency"].min()), 3), set(ds["kind"].values.tolist())
    (1.035, {'fold'})
    """
    speed, heading = condition(ship_or_model if isinstance(ship_or_model, Ship) else None, speed, heading)
    count("points", points, 2, 400)
    two = isinstance(over, (list, tuple)) and len(over) == 2 and all(isinstance(one, str) for one in over)
    if not two or not isinstance(limits, (list, tuple)) or len(limits) != 2:
        raise InputError(
            f"over = {quoted(over)}, limits = {quoted(limits)}; two of each are needed, such as ('wave_height', 'heading')"
        )
    if over[0] == over[1]:
        raise InputError(f"over={over!r}: give two different parameters")
    announce_compilation()
    of = parameters(ship_or_model, over, limits, wave, speed, heading)
    edges: list[Edge] = []
    with small_matrices():
        steepest = steepest_of(ship_or_model)
        for boundary, start in _starts(of, harmonics, steepest, splined=isinstance(ship_or_model, Ship)):
            found = alone(lambda begin: _followed(of, *begin, edges, points, steepest), (boundary, start))
            if found is not None:
                edges.append(found)
    parts = [_columns(of, one, i) for i, one in enumerate(edges)] or [_nothing(of)]
    return xr.concat(parts, "point").assign_attrs(references=references_of(ship_or_model))


def _starts(of: Parameters, harmonics: int, steepest: float, *, splined: bool) -> list[tuple[Boundary, Floats]]:
    """Points (scaled unknowns, two shares) of edges, from branches over the first parameter."""
    own = float((of.own[1] - of.low[1]) / (of.high[1] - of.low[1]))
    shares = [*([own] if 0 <= own <= 1 else []), *((np.arange(_SCAN) + 0.5) / _SCAN)]

    def starts_at(share: float) -> list[tuple[Boundary, Floats]] | InputError:
        others = np.array([of.low[0], of.low[1] + share * (of.high[1] - of.low[1])])
        try:
            lines = lines_of(along(of, 0, others, splined=splined), harmonics, steepest=steepest)
        except InputError as refusal:  # no motion, or the ship keeps pace with the wave, at this value: others may do
            return refusal
        return [
            (Boundary(str(event), line.curve), np.append(point, share))
            for line in lines
            for event in np.unique(line.events[line.events != ""])
            for point in line.points[line.events == event]
        ]

    found = [one for _, one in sorted(spread(starts_at, shares), key=lambda pair: pair[0])]
    refusals = [one for one in found if isinstance(one, InputError)]
    if len(refusals) == len(shares):
        raise refusals[0]
    return [start for one in found if not isinstance(one, InputError) for start in one]


def _equations(of: Parameters, boundary: Boundary) -> Equations:
    """Balance equations and the test function of one edge, as `follow` takes them."""
    curve, offsets = boundary.curve, STEP * np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]])

    def equations(point: Floats) -> tuple[Floats, Floats]:
        x, m = point[:-2], point.size - 2
        here, *near = _systems(of, point[-2:] + offsets)
        u = curve.coefficients(point[:-1])
        value, matrix = balance_of(slowed(here, curve.periods), curve.orders, u)
        if not np.isfinite(matrix).all():
            return np.full(m + 1, np.nan), np.full((m + 1, m + 2), np.nan)
        derivative = np.empty((m + 1, m + 2))
        derivative[:m, :m] = matrix * curve.scale
        tests, derivative[m, :m] = boundary.evaluated(here, near, x)
        for j in (0, 1):
            ahead, behind = near[2 * j], near[2 * j + 1]
            values = [
                balance_of(slowed(s, curve.periods), curve.orders, u, with_matrix=False)[0] for s in (ahead, behind)
            ]
            derivative[:m, m + j] = (values[0] - values[1]) / (2 * STEP)
            derivative[m, m + j] = (tests[1 + 2 * j] - tests[2 + 2 * j]) / (2 * STEP)
        return np.append(value, tests[0]), derivative

    return equations


def _systems(of: Parameters, shares: Floats) -> list[System]:
    """The systems at shares (k, 2), one by one; NaN frequencies where the ship or the wave does not exist."""
    return apart(of.systems(of.low + (of.high - of.low) * shares))


def _followed(
    of: Parameters, boundary: Boundary, guess: Floats, known: list[Edge], points: int, steepest: float
) -> Edge | None:
    """The edge through a point both ways, or None where the point is on a known one or on none."""
    if any(_on(one, boundary, guess) for one in known):
        return None
    equations, low = _equations(of, boundary), within(boundary.curve, steepest)
    across = np.zeros(guess.size)
    across[-1] = 1.0
    start = corrected(equations, guess, across)
    if start is None or np.abs(start - guess).max() > 0.2:
        return None

    def inside(point: Floats) -> bool:
        return bool((point[-2:] >= 0).all() and (point[-2:] <= 1).all() and low(point[:-1]))

    ahead = follow(equations, start, across, inside, points=points, longest=_LONGEST)
    if ahead.closed:
        return Edge(boundary, ahead.points, True)
    back = follow(equations, start, -across, inside, points=points, longest=_LONGEST)
    both = [_cut(equations, path) for path in (back, ahead)]
    return Edge(boundary, np.concatenate([both[0][:0:-1], both[1]]), False)


def _cut(equations: Equations, path: Path) -> Floats:
    """Points of a path with the last one, if beyond the limits, brought back onto them."""
    last = path.points[-1]
    beyond = np.maximum(last[-2:] - 1.0, -last[-2:])
    if beyond.max() <= 0 or len(path.points) < 2:
        return path.points
    j = int(beyond.argmax())
    level, before = float(last[-2 + j] > 0.5), path.points[-2]
    guess = before + (level - before[-2 + j]) / (last[-2 + j] - before[-2 + j]) * (last - before)
    held = np.zeros(last.size)
    held[-2 + j] = 1.0
    end = corrected(equations, guess, held)
    return path.points[:-1] if end is None else np.concatenate([path.points[:-1], end[None]])


def _on(one: Edge, boundary: Boundary, point: Floats) -> bool:
    """Does a known edge pass through a point, or through the mirror image or the delayed copy of its motion?"""
    if one.boundary.kind != boundary.kind or one.boundary.curve.orders != boundary.curve.orders:
        return False
    path = _unsigned(one.boundary, one.points, boundary)
    target = _unsigned(boundary, point[None], boundary)[0]
    a, chord = path[:-1], np.diff(path, axis=0)
    share = np.clip(((target - a) * chord).sum(axis=1) / (chord**2).sum(axis=1), 0.0, 1.0)
    return bool(np.linalg.norm(a + share[:, None] * chord - target, axis=1).min() < _SAME)


def _unsigned(of: Boundary, points: Floats, scale: Boundary) -> Floats:
    """Shares and harmonic amplitudes (n, 2 + 3 h) of points: what a mirror image and a delayed copy have in common."""
    u = (points[:, :-2] * of.curve.scale / scale.curve.scale).reshape(len(points), 3, -1)
    amplitudes = [np.linalg.norm(u[:, :, where], axis=2) for where in columns(of.curve.orders).values()]
    return np.column_stack([points[:, -2:], *amplitudes])


def _columns(of: Parameters, one: Edge, number: int) -> xr.Dataset:
    """One edge as a dataset along ``point``."""
    points, curve = one.points, one.boundary.curve
    u, orders = ascending((points[:, :-2] * curve.scale).reshape(len(points), 3, -1), curve.orders)
    systems = slowed(joined(_systems(of, points[:, -2:])), curve.periods)
    own = columns(orders)[curve.periods].start
    values = {
        "roll": np.degrees(np.hypot(u[:, 1, own], u[:, 1, own + 1])),
        "roll_peak": np.degrees(peaks(u, orders)[:, 1]),
        "exponent": assess(systems, u, orders, 1e-9).floquet.growth,
    }
    ends = of.low + (of.high - of.low) * points[:, -2:]
    words = {
        "kind": (np.full(len(points), one.boundary.kind), "what happens at the edge"),
        "curve": (np.full(len(points), number), "number of the curve"),
        "periods": (np.full(len(points), curve.periods), "wave periods after which the motion repeats"),
        "closed": (np.full(len(points), one.closed), "the curve returns to its beginning"),
    }
    data: dict[str, object] = {
        name: ("point", ends[:, j], parameter_attributes(name)) for j, name in enumerate(of.names)
    }
    data |= {name: ("point", v, attributes(name)) for name, v in values.items()}
    data |= {name: ("point", v, {"units": "1", "long_name": text, "symbol": ""}) for name, (v, text) in words.items()}
    return xr.Dataset(data)


def _nothing(of: Parameters) -> xr.Dataset:
    """An edge without points."""
    names = (*of.names, "roll", "roll_peak", "exponent")
    data: dict[str, object] = {name: ("point", np.zeros(0), parameter_attributes(name)) for name in names}
    data |= {"kind": ("point", np.zeros(0, dtype=str)), "closed": ("point", np.zeros(0, dtype=bool))}
    return xr.Dataset(data | {name: ("point", np.zeros(0, dtype=int)) for name in ("curve", "periods")})
