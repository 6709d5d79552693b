"""Response curves in six modes: motions of one wave period and of two over the wave's height, the speed or the heading."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.hydro.capsize import capsize_limit
from quartering.loads.waves import Wave
from quartering.motion.status import Status
from quartering.motion.steady_course.balance import Harmonics, doubled_harmonics, oblique_doubled_harmonics
from quartering.motion.steady_course.continuation import Family, OfAmplitude, Path, Splined
from quartering.motion.steady_course.course import Course, course, warn_across, warn_of_surge
from quartering.motion.steady_course.doubled import (
    LARGEST_ROLL,
    branch_from,
    doubled_motions,
    doubled_roll,
    doubling_sign,
    largest_roll,
    onset_between,
)
from quartering.motion.steady_course.orbits import followed_up
from quartering.stability.kind import Kind
from quartering.stability.parametric import doubled_multipliers, growths
from quartering.study.branches.family import Limits, parameter_attributes, parameters
from quartering.study.dataset import amplitudes_named
from quartering.study.six_modes.conditions import BEYOND

Floats = NDArray[np.float64]

OVER: Final = ("wave_height", "speed", "heading")
"""What a branch in six modes goes over: the wave's length is that of the tables of the sections."""
_VALUES: Final = 33
"""Values of speed or heading that the numbers of the equations are splined through."""
_MOST: Final = 400
_GONE, _SMALL = 2e-3, 0.1
"""Roll of two periods below which there is none, and below which a curve comes to its end [rad]."""
_SEEDS: Final = (0.0, 0.5, 1.0)
"""Where between the limits motions of two periods are looked for over the wave's height: a curve may begin beyond them."""


class Points(NamedTuple):
    """One curve: points (n, m + 1) of x and parameter, what happens at each, its harmonics, where it began."""

    points: Floats
    events: list[str]
    basis: Harmonics
    origin: str
    closed: bool

    @property
    def periods(self) -> int:
        """Wave periods after which its motions repeat."""
        return 2 if self.basis.odd.any() else 1


def branch_six(
    ship: Ship, wave: Wave, speed: float, heading: float, over: str = "wave_height", limits: Limits = None
) -> xr.Dataset:
    """Follow the motions of one and of two wave periods of a ship in six modes.

    speed, heading: U [m/s], mu [deg]
    over: "wave_height" [m], "speed" [m/s] or "heading" [deg]
    limits: as `branch`
    Returns as `branch`, with heave [m] and pitch [deg]; multipliers over the periods of each motion

    The curve of one period by arc length from the lower limit; motions of two periods from where they begin on it, and from
    those found over the wave's height at both limits and midway, so that a curve that begins beyond the limits is met
    too. Between the 33 values at which they are computed the numbers of the equations are splined over speed or heading.
    Source: [Krack19].  Valid: as `parametric_roll`.

    >>> from quartering.hull.file.read import ship
    >>> ds = branch_six(ship("wigley"), Wave(100.0, 1.0), 3.0, 180.0, limits=(0.5, 1.0))
    >>> ds.curve.values.max(), bool((ds.verdict == 0).all())
    (np.int64(0), True)
    """
    if over not in OVER:
        raise InputError(f'over = "{over}"; in six modes a branch goes over {", ".join(OVER)}; try wave_height')
    asked = parameters(ship, [over], [limits], wave, speed, heading)
    low, high = float(asked.low[0]), float(asked.high[0])
    if over == "wave_height":
        low = max(low, 1e-3 * Wave(wave.length, high).height)  # refuses one that breaks
    one, family, basis = _family(ship, wave, (speed, heading), over, (low, high))
    if over == "wave_height":
        low, high = low / 2, high / 2
    main = _of_one_period(one, family, basis.of_one_period, over, low, high)
    begun = _onsets(family, basis, main)
    lines = [
        _marked(main, begun, basis),
        *_of_two_periods(_path(one, family, basis, 0.25 * (high - low)), begun, low, high),
    ]
    scale = 2.0 if over == "wave_height" else 1.0
    limit = capsize_limit(ship).radians
    parts = [_columns(line, i, over, family, scale, limit) for i, line in enumerate(lines)]
    whole = amplitudes_named(xr.concat(parts, "point"))
    return whole.assign_attrs(
        over=over, modes="six", references="STF70, Krack19", harmonics=int(main.basis.vertical[-1]) // 2
    )


def _family(
    ship: Ship, wave: Wave, at: tuple[float, float], over: str, between: tuple[float, float]
) -> tuple[Course, Family, Harmonics]:
    """The condition at the lower limit, over its parameter, and the harmonics of two periods."""
    (speed, heading), (low, high) = at, between
    values = np.linspace(low, high, _VALUES)
    fixed = {"wave_height": wave.amplitude, "speed": speed, "heading": heading}
    if over == "wave_height":
        many = course(ship, wave.wavenumber, *(np.array([v]) for v in (low / 2, speed, heading)))
    else:
        varied = {name: values if name == over else np.full(_VALUES, value) for name, value in fixed.items()}
        many = course(ship, wave.wavenumber, varied["wave_height"], varied["speed"], varied["heading"])
    if many.slow.any() or (np.sign(many.signed) != np.sign(many.signed[0])).any():
        raise InputError(
            f"{over} = {low:g} to {high:g}: there the ship keeps pace with the wave, which has no periodic motion; take limits "
            "on one side of that"
        )
    along = bool((many.numbers.wave[:, 1] == 0.0).all())
    one = many.rows(np.array([0]))
    warn_of_surge(many.at_amplitude(np.full(many.count, high / 2)) if over == "wave_height" else many)
    warn_across(ship, wave.wavenumber, heading if over != "heading" else 0.5 * (low + high))
    family: Family = OfAmplitude(one) if over == "wave_height" else Splined(many, values)
    return one, family, doubled_harmonics() if along else oblique_doubled_harmonics()


def _path(one: Course, family: Family, basis: Harmonics, unit: float) -> Path:
    return Path(family, basis, one.draught, unit, 1e-5 * unit)


def _of_one_period(one: Course, family: Family, basis: Harmonics, over: str, low: float, high: float) -> Points:
    """The curve from the motion at the lower limit, to a limit or to where the hull leaves its tables."""
    found = followed_up(one, basis)
    status = Status(int(found.status[0]))
    if not status.ok:
        raise InputError(f"no motion to start from at the lower limit of {over}: {status.advice}")
    path = _path(one, family, basis, 0.25 * (high - low))
    rising = np.append(np.zeros(found.x.shape[1]), 1.0)
    points = path.followed(np.append(found.x[0], low), rising, _MOST, lambda p, _: low <= p[-1] <= high)
    return Points(*_with_folds(path, _ended(path, points, low, high)), basis, "start", False)


def _ended(path: Path, points: list[Floats], low: float, high: float) -> list[Floats]:
    """Points whose last, beyond a limit, is brought back onto it."""
    last = points[-1]
    if low <= last[-1] <= high or len(points) < 2:
        return points
    end, before = (high if last[-1] > high else low), points[-2]
    t = (end - before[-1]) / (last[-1] - before[-1])
    on_it = path.at((1 - t) * before + t * last, end)
    return points[:-1] if on_it is None else [*points[:-1], on_it]


def _with_folds(path: Path, points: list[Floats]) -> tuple[Floats, list[str]]:
    """Points with one at each fold: where the parabola of the parameter over the arc through three neighbours turns."""
    made, events = [points[0]], [""]
    for k in range(1, len(points)):
        if k > 1 and (points[k][-1] - points[k - 1][-1]) * (points[k - 1][-1] - points[k - 2][-1]) < 0.0:
            three = np.array(points[k - 2 : k + 1])
            chords = np.linalg.norm(np.diff(three, axis=0) / path.sizes, axis=1)
            arc = np.array([-chords[0], 0.0, chords[1]])
            curve = np.polyfit(arc, three, 2)  # exact through three points
            turn = -curve[1, -1] / (2 * curve[0, -1])
            tangent = (2 * curve[0] * turn + curve[1]) / path.sizes
            fold = path.corrected(np.array([turn**2, turn, 1.0]) @ curve, tangent / np.linalg.norm(tangent))
            if fold is not None:
                place = len(made) if turn > 0 else len(made) - 1
                made.insert(place, fold)
                events.insert(place, "fold")
        made.append(points[k])
        events.append("")
    return np.array(made), events


Onset = tuple[float, Floats, Floats]


def _marked(main: Points, begun: list[Onset], basis: Harmonics) -> Points:
    """The curve of one period with the points on it where motions of two begin."""
    points, events = list(main.points), list(main.events)
    for value, x, _ in begun:
        here = np.append(x[~basis.odd], value)
        ahead = np.array([(p[-1] - value) * (q[-1] - value) <= 0.0 for p, q in itertools.pairwise(points)])
        near = np.array([np.abs(p - here).max() + np.abs(q - here).max() for p, q in itertools.pairwise(points)])
        place = int(np.where(ahead, near, np.inf).argmin()) + 1
        points.insert(place, here)
        events.insert(place, "period-doubling")
    return main._replace(points=np.array(points), events=events)


def _of_two_periods(path: Path, begun: list[Onset], low: float, high: float) -> list[Points]:
    """Motions of two periods: from their onsets on the curve of one period, and met over the wave's height at some values."""
    lines: list[Points] = []
    family, basis, ended = path.family, path.basis, set[int]()
    for i, onset in enumerate(begun):
        if i in ended:
            continue
        points = branch_from(path, onset, lambda p: low <= p[-1] <= high)
        if doubled_roll(basis, points[-1][:-1])[0] < _SMALL and len(points) > 2:  # back at another onset
            span = float(np.ptp([p[-1] for p in points]))
            others = [j for j, other in enumerate(begun) if j != i and abs(other[0] - points[-1][-1]) < 0.1 * span]
            if others:
                ended.add(others[0])
                points.append(np.append(begun[others[0]][1], begun[others[0]][0]))
        lines += _line(path, points, low, high, "period-doubling")
    for share in _SEEDS:
        value = low + share * (high - low)
        there = family.at(value)
        there = there.at_amplitude(there.numbers.amplitude.copy())
        amplitude = float(there.numbers.amplitude[0])
        for x in doubled_motions(there, amplitude, BEYOND * amplitude, basis=basis)[0]:
            point = np.append(x, value)
            if not any(_passes(line, point, basis) for line in lines):
                both = [
                    path.followed(point, np.append(np.zeros(x.size), way), _MOST, _within(basis, low, high))
                    for way in (-1, 1)
                ]
                lines += _line(path, [*_ended(path, both[0], low, high)[:0:-1], *both[1]], low, high, "search")
    return lines


def _within(basis: Harmonics, low: float, high: float) -> Callable[[Floats, Floats], bool]:
    """Is a curve between its limits, its roll of two periods neither gone nor beyond what is followed?"""

    def go_on(point: Floats, _before: Floats) -> bool:
        large = largest_roll(basis, point[:-1])[0] <= LARGEST_ROLL
        return low <= point[-1] <= high and bool(large and doubled_roll(basis, point[:-1])[0] > _GONE)

    return go_on


def _line(path: Path, points: list[Floats], low: float, high: float, origin: str) -> list[Points]:
    """A curve of two periods, or none where it has no length."""
    if len(points) < 2:
        return []
    return [Points(*_with_folds(path, _ended(path, points, low, high)), path.basis, origin, False)]


def _passes(line: Points, point: Floats, basis: Harmonics) -> bool:
    """Does a curve pass a motion of that roll?"""
    values, rolls = line.points[:, -1] - point[-1], largest_roll(basis, line.points[:, :-1])
    wanted = float(largest_roll(basis, point[:-1])[0])
    for k in np.flatnonzero(values[:-1] * values[1:] <= 0.0):
        t = values[k] / (values[k] - values[k + 1]) if values[k] != values[k + 1] else 0.0
        if abs((1 - t) * rolls[k] + t * rolls[k + 1] - wanted) < 0.02 * wanted + _GONE:
            return True
    return False


def _onsets(family: Family, basis: Harmonics, main: Points) -> list[Onset]:
    """Where motions of two periods begin on a curve of one."""
    whole = np.zeros((len(main.points), basis.odd.size))
    whole[:, ~basis.odd] = main.points[:, :-1]
    values = main.points[:, -1]
    signs = np.array([doubling_sign(family.at(v), basis, x) for v, x in zip(values, whole, strict=True)])
    found = [
        onset_between(family, basis, (values[k], values[k + 1]), (whole[k], whole[k + 1]))
        for k in np.flatnonzero(signs[:-1] * signs[1:] < 0.0)
        if values[k] != values[k + 1]
    ]
    return [onset for onset in found if onset is not None]


def _columns(line: Points, number: int, over: str, family: Family, scale: float, limit: float) -> xr.Dataset:
    """One curve as a dataset along ``point``, up to the capsize limit."""
    basis, x = line.basis, line.points[:, :-1]
    peak = largest_roll(basis, x)
    kept = peak <= limit
    x, values, peak = x[kept], line.points[kept, -1], peak[kept]
    events = [event for event, here in zip(line.events, kept, strict=True) if here]
    growth, multipliers = _stability(family, basis, values, x, line.periods)
    parts = basis.parts(x)
    omega = np.array([float(family.at(v).numbers.omega[0]) for v in values])
    size = {
        name: _first(basis, part) for name, part in zip(("heave", "pitch", "sway", "roll", "yaw"), parts, strict=True)
    }
    kinds = [_kind(rate, m, line.periods) for rate, m in zip(growth, multipliers, strict=True)]
    columns = {
        over: scale * values, "heave": size["heave"], "pitch": np.degrees(size["pitch"]), "sway": size["sway"] / omega,
        "roll": np.degrees(size["roll"]), "yaw": np.degrees(size["yaw"]) / omega, "roll_peak": np.degrees(peak),
        "exponent": growth, "verdict": np.array([int(kind) for kind in kinds], dtype=np.int8),
    }  # fmt: skip
    ds = xr.Dataset({name: ("point", v, _attributes(name)) for name, v in columns.items()})
    count = len(x)
    words = {
        "event": (np.array(events, dtype=str), "what happens here"),
        "fold": (np.array([event == "fold" for event in events], dtype=bool), "the parameter turns back here"),
        "curve": (np.full(count, number), "number of the curve"),
        "origin": (np.full(count, line.origin), "where the curve began"),
        "periods": (np.full(count, line.periods), "wave periods after which the motion repeats"),
        "closed": (np.full(count, line.closed), "the curve returns to its beginning"),
    }
    made: dict[str, Any] = {
        name: ("point", v, {"units": "1", "long_name": text, "symbol": ""}) for name, (v, text) in words.items()
    }
    for part in ("real", "imag"):
        text = {"units": "1", "long_name": f"{part} part of the Floquet multipliers", "symbol": "mu"}
        made[f"multiplier_{part}"] = (("point", "multiplier"), getattr(multipliers, part), text)
    return ds.assign(made)


def _attributes(name: str) -> dict[str, object]:
    own = {"heave": ("m", "heave of G", "eta3"), "pitch": ("deg", "pitch", "theta")}
    if name in own:
        unit, meaning, symbol = own[name]
        return {"units": unit, "long_name": f"{meaning}, amplitude at the encounter frequency", "symbol": symbol}
    return parameter_attributes(name)


def _first(basis: Harmonics, part: Floats) -> Floats:
    """Amplitude (k,) of a mode at the encounter frequency, or at half of it where it has no other."""
    orders = basis.vertical if part.shape[1] == basis.sizes[0] else basis.lateral
    if not part.shape[1]:
        return np.zeros(len(part))
    at = 0
    for order in orders:
        if order == 2 or (order == 1 and 2 not in orders):
            return np.asarray(np.hypot(part[:, at], part[:, at + 1]))
        at += 1 if order == 0 else 2
    return np.zeros(len(part))


def _stability(family: Family, basis: Harmonics, values: Floats, x: Floats, periods: int) -> tuple[Floats, Floats]:
    """Growth (k,) [1/s], that of the course left out, and multipliers (k, s) over the periods of the motions."""
    growth, multipliers = np.empty(len(x)), []
    for i, value in enumerate(values):
        there = family.at(float(value))
        growth[i] = growths(there, basis, x[[i]], periods)[0][0]
        multipliers.append(doubled_multipliers(there, basis, x[[i]], mirrored=False, periods=periods)[0])
    return growth, np.array(multipliers)


def _kind(growth: float, multipliers: Floats, periods: int) -> Kind:
    """What grows."""
    if not np.isfinite(growth):
        return Kind.NO_ANSWER
    if growth <= 0.0:
        return Kind.STABLE
    largest = multipliers[np.abs(multipliers).argmax()]
    if periods == 1:
        return Kind.PERIOD_DOUBLING if largest.real < 0 else Kind.ROLL
    return Kind.FOLD if abs(largest.imag) < 1e-9 and largest.real > 0 else Kind.ROLL
