"""Rare rolls without extrapolation: the likeliest sea that leads to one, and importance sampling about it."""

# A record is linear in independent normal variables, of which those that roll the ship are searched: at each frequency one
# complex direction, that of the closure's roll. Of all records from rest whose roll at the end is f, the likeliest is the
# shortest u with phi(u) = f, at the distance b (first-order reliability): P(phi > f) is about N(-b), and exactly so for a
# linear ship, for which u is its impulse response run backwards. It is found by steps along the gradient (Hasofer and Lind,
# Rackwitz and Fiessler):
#
#     u <- u + s {[g.u + f - phi(u)] g/|g|^2 - u} ,   g = d phi/du by differences, 64 runs at a time
#
# Records drawn about it, z + u in all variables, count by w = exp(-z.u - |u|^2/2): their mean over those with phi > f is
# unbiased whatever u is, and has an error measured from the weights. Where some few weights are most of their sum,
# (sum w)^2/sum w^2 is small and the estimate is refused.

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.special import ndtr

from quartering._machine.threads import spread_in_order
from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.ship import Ship
from quartering.hull.told import count, number
from quartering.loads.forces import Form
from quartering.loads.sea.sea import Sea
from quartering.motion.equations.model import Model
from quartering.motion.sea.closure import linear_response
from quartering.motion.sea.equations import Force
from quartering.motion.sea.synthesis import RECORDS, Record, cross_spectra, record_of, series_from
from quartering.motion.sea.windows import roll_of_windows
from quartering.motion.transient.rk4 import Alike
from quartering.study.dataset import made_by
from quartering.study.seas.dataset import name_of, scalars, sea_coordinates
from quartering.study.seas.response import limit_of
from quartering.study.seas.simulated.asked import asked_of
from quartering.study.seas.simulated.planned import Ready, planned

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

FEWEST_EFFECTIVE: Final = 50.0
"""Effective number of failing windows below which the estimate is refused [1]."""
_WINDOW, _TIMES = 220.0, 6.0
_OVER: Final = 4.0
"""Length of the record over that of a window: its frequencies stand so near that a narrow resonance is not smeared [1]."""
_HELD, _SMALLEST = 1e-4, 1e-3
_DIFFERENCE: Final = 0.02
_ITERATIONS, _LONG, _SHORT = 40, 0.6, 0.3
_CLOSE: Final = 2e-3
_MOST_CAPSIZED: Final = 0.1


class _Windows(NamedTuple):
    """What windows of one condition need: equations, record, steps, their length [s], and the roll of a capsize [rad]."""

    equations: Alike
    record: Record
    steps: int
    step: float
    limit: float

    def rolls(self, draws: NDArray[np.float32]) -> Floats:
        """Roll (steps + 1, W) of windows of given draws (W, j, m, 2) [rad]."""
        found = np.zeros((self.steps + 1, RECORDS))
        roll_of_windows(self.equations, series_from(self.record, draws), self.steps, self.step, self.limit, found)
        return found

    def at_end(self, many: Floats) -> Floats:
        """Roll at the end of windows of many draws (n, j, m, 2), 64 at a time."""
        bins, m = self.record.roots.shape[:2]
        rows = math.ceil(len(many) / RECORDS)
        padded = np.zeros((rows * RECORDS, bins, m, 2), dtype=np.float32)
        padded[: len(many)] = many
        parts = [slice(i * RECORDS, (i + 1) * RECORDS) for i in range(rows)]
        found = spread_in_order(lambda part: self.rolls(padded[part])[-1], parts)
        return np.concatenate(found)[: len(many)]


@dataclass(frozen=True, eq=False)
class _Basis:
    """Directions of the normal variables that move the roll: (n, j, m, 2) draws, of length 1 each and at right angles."""

    directions: Floats

    def draws(self, u: Floats) -> Floats:
        """Draws (j, m, 2) of variables (n,)."""
        return np.asarray(np.einsum("n,njmk->jmk", u, self.directions))


@takes(ship="Ship, Model", form="word")
def design_point(
    ship: Ship | Model,
    sea: Sea,
    speed: float | str,
    roll: float | str,
    heading: float | str | None = None,
    *,
    windows: int = 4096,
    seed: int = 0,
    memory: bool = True,
    force: Force | None = None,
    form: Form = "stf",
) -> xr.Dataset:
    """Probability of a roll too rare to count, by the likeliest sea that leads to it and importance sampling about that.

    Parameters
    ----------
    ship, sea, speed, heading, memory, force, form    as of `irregular`
    roll : float       level, above 0 and below the roll that counts as a capsize [deg]
    windows : int      to sample; each 220 s from rest, or six times the decay of roll
    seed : int

    Returns
    -------
    Dataset            beta: distance of the design point, and linear_beta without nonlinear terms; probability_form: N(-beta);
                       probability with probability_error: that the roll at an instant is above the level, to one side [1];
                       crossing_rate, crossing_rate_error of up-crossings of the level, to one side [1/s]; effective: windows
                       that count [1]; roll over time of the likeliest window [deg]

    Raises
    ------
    InputError         what `irregular` refuses; a level that is not met, or beyond the capsize roll; fewer than 50 effective
                       windows; a tenth of the weight in windows that capsized before: several ways lead there, and one design
                       point is not enough

    Notes
    -----
    The probability is of an instant. Crossings come in groups: the rate of first passages is up to twice below that of both
    sides. For a linear ship both are exact.  Source: [Jensen07] for rolls; HL-RF.  Valid: failures by one way, no capsize
    before; several ways need several points, which are not looked for.

    Examples
    --------
    >>> import quartering as qt
    >>> found = design_point(qt.ship("wigley"), qt.Sea(hs=1, tp=8, heading=60), 5.0, roll=15, windows=1024)
    >>> bool(abs(found["probability"] / found["probability_form"] - 1) < 0.5)
    True
    """
    asked = asked_of(ship, sea, speed, heading, seed, memory, force, form)
    limit = limit_of(ship)
    level = math.radians(number(None, "roll_level", roll))
    if not level < limit.radians:
        raise InputError(
            f"roll = {math.degrees(level):.3g} deg; it is below {limit.words}: beyond it a ship does not come back, and one"
            " design point does not tell how it got there; take failure_rate_at of higher seas"
        )
    many = count("windows", windows, RECORDS, 4096, 10_000_000)
    ready = planned(asked)
    own = _windows(ready, asked.sea, limit.radians)
    basis, u, linear = _start(own, ready, asked.sea, level)
    u, beta, steps = _found(own, basis, u, level)
    sampled = _sampled(own, basis.draws(u), beta, level, many, (asked.seed, ready.plan.condition), ready.roll_frequency)
    about = {
        "ship": name_of(ship),
        "seas": asked.sea.words, "speed": asked.speed, "seed": asked.seed, "windows": many, "iterations": steps,
        "variables": u.size, "window": own.steps * own.step, "level": math.degrees(level),
    }  # fmt: skip
    history = own.rolls(np.repeat(basis.draws(u)[None], RECORDS, axis=0).astype(np.float32))[:, 0]
    return _dataset(asked.sea, own, beta, linear, sampled, history, about)


def _windows(ready: Ready, sea: Sea, limit: float) -> _Windows:
    step = ready.plan.step
    long = max(_WINDOW, _TIMES / max(ready.damping * ready.roll_frequency, 1e-3))
    steps = math.ceil(long / step)
    record = record_of(ready.cells, sea, ready.channels, _OVER * steps * step, 0.5 * step)
    return _Windows(ready.plan.equations, record, steps, step, limit)


def _start(own: _Windows, ready: Ready, sea: Sea, level: float) -> tuple[_Basis, Floats, float]:
    """Directions that roll the ship, a first point in them, and the distance of the level for the linear ship."""
    energy, equations = ready.cells.energy(sea), ready.equations
    linear = math.sqrt(float(energy @ np.abs(linear_response(equations)[1]) ** 2))
    if not linear > 0:
        raise InputError(
            "this sea does not roll the ship: from ahead or astern there is no moment; give another heading"
        )
    directions = _directions(own, ready, sea)
    rolls = own.at_end(np.concatenate([_DIFFERENCE * directions, -_DIFFERENCE * directions]))
    slope = (rolls[: len(directions)] - rolls[len(directions) :]) / (2.0 * _DIFFERENCE)
    return _Basis(directions), np.asarray(level * slope / float(slope @ slope)), level / linear


def _directions(own: _Windows, ready: Ready, sea: Sea) -> Floats:
    """Draws (n, j, m, 2) that roll the closure's motion: of each frequency one, and the same a quarter of a period later.

    At one frequency the channels are F = C z and roll is k^H z but for what differs between its cells: k is the least squares
    solution of E[F conj(roll)] = C k.
    """
    record, solution = own.record, ready.solution
    roll = np.zeros(len(ready.channels), dtype=complex)
    roll[solution.cells] = solution.motion[1]
    spacing = 2.0 * math.pi / (record.samples * record.interval)
    both = np.concatenate([ready.channels, roll[:, None]], axis=1)
    bins, m, _ = record.roots.shape
    cross = cross_spectra(ready.cells, sea, both, spacing, record.samples // 2)[:bins, :m, m]
    roots = record.roots.astype(complex)
    deviation = np.sqrt(np.maximum(np.einsum("jab,jab->a", roots, roots.conj()).real, 1e-300))
    k = np.einsum("jab,jb->ja", np.linalg.pinv(roots / deviation[:, None], rcond=_SMALLEST), cross / deviation)
    size = np.linalg.norm(k, axis=1)
    order = np.argsort(-size)
    left = 1.0 - np.cumsum(size[order] ** 2) / (size**2).sum()
    kept = order[: int((left > _HELD).sum()) + 1]
    vectors = k[kept] / size[kept, None]
    out = np.zeros((2 * kept.size, bins, m, 2))
    for half, turned in enumerate((vectors, 1j * vectors)):
        at = np.arange(half, 2 * kept.size, 2)
        out[at, kept, :, 0], out[at, kept, :, 1] = turned.real, turned.imag
    return out


def _found(own: _Windows, basis: _Basis, u: Floats, level: float) -> tuple[Floats, float, int]:
    """Nearest variables whose window ends at the level: their place, distance, and the steps it took."""
    for turn in range(_ITERATIONS):
        here = basis.draws(u)
        rolls = own.at_end(np.concatenate([here[None], here + _DIFFERENCE * basis.directions]))
        value, slope = float(rolls[0]), (rolls[1:] - rolls[0]) / _DIFFERENCE
        square = float(slope @ slope)
        if not (square > 0 and abs(value) < own.limit):
            u = 0.7 * u  # past the capsize: back towards rest
            continue
        wanted = (float(slope @ u) + level - value) / square * slope
        beta = float(np.sqrt(u @ u))
        if abs(value - level) < _CLOSE * level and float(np.abs(wanted - u).max()) < 20 * _CLOSE * max(beta, 1.0):
            return u, beta, turn
        u = u + (_LONG if turn < 6 else _SHORT) * (wanted - u)
    raise InputError(
        f"no likeliest window to a roll of {math.degrees(level):.3g} deg was found in {_ITERATIONS} steps: several ways may"
        " lead there; take irregular, or failure_rate_at of higher seas"
    )


class _Sampled(NamedTuple):
    """Probability at the end, up-crossings a second, each with its error, and the effective number of windows."""

    probability: float
    probability_error: float
    rate: float
    rate_error: float
    effective: float


def _sampled(
    own: _Windows, shift: Floats, beta: float, level: float, many: int, seeds: tuple[int, int], frequency: float
) -> _Sampled:
    """Importance sampling about a point: windows of draws z + shift, each with the weight exp(-z.shift - beta^2/2)."""
    rows = math.ceil(many / RECORDS)
    last = max(1, round(0.1 * 2.0 * math.pi / frequency / own.step))

    def row(i: int) -> tuple[Floats, Floats, Floats, Floats]:
        draws = np.empty((RECORDS, *shift.shape), dtype=np.float32)
        for l in range(RECORDS):
            seed = np.random.SeedSequence(seeds[0], spawn_key=(seeds[1], 1, i * RECORDS + l))
            np.random.Generator(np.random.PCG64(seed)).standard_normal(dtype=np.float32, out=draws[l])
        weight = np.exp(-np.einsum("ljmk,jmk->l", draws.astype(float), shift) - 0.5 * beta**2)
        rolls = own.rolls(draws + shift.astype(np.float32))
        crossed = ((rolls[-last - 1 : -1] <= level) & (rolls[-last:] > level)).sum(axis=0)
        before = (np.abs(rolls[: -2 * last]) >= own.limit).any(axis=0)
        return weight, (rolls[-1] > level).astype(float), crossed.astype(float), before.astype(float)

    found = spread_in_order(row, range(rows))
    weight, above, crossed, before = (np.concatenate([part[k] for part in found]) for k in range(4))
    own_weight = weight * above
    total = float(own_weight.sum())
    effective = total**2 / float((own_weight**2).sum()) if total > 0 else 0.0
    if effective < FEWEST_EFFECTIVE:
        raise InputError(
            f"{effective:.3g} effective windows of {weight.size} count, {FEWEST_EFFECTIVE:g} are needed: the likeliest way is"
            " not the only one; draw more windows, or take failure_rate_at of higher seas"
        )
    if float((own_weight * before).sum()) > _MOST_CAPSIZED * total:
        raise InputError(
            "a tenth of the weight or more is in windows that capsized before: one design point does not stand for them; take"
            " irregular, or failure_rate_at of higher seas"
        )
    per = weight * crossed / (last * own.step)
    return _Sampled(*_mean(own_weight), *_mean(per), effective)


def _mean(values: Floats) -> tuple[float, float]:
    return float(values.mean()), float(values.std(ddof=1) / math.sqrt(values.size))


def _dataset(
    sea: Sea,
    own: _Windows,
    beta: float,
    linear: float,
    sampled: _Sampled,
    history: Floats,
    about: dict[str, Any],
) -> xr.Dataset:
    rows = {
        "beta": (beta, "1", "distance of the likeliest window from rest, in deviations"),
        "linear_beta": (linear, "1", "the same of the linear ship: level over root mean square roll"),
        "probability_form": (float(ndtr(-beta)), "1", "probability of roll above the level, by the distance alone"),
        "probability": (sampled.probability, "1", "probability of roll above the level at an instant, to one side, sampled"),
        "probability_error": (sampled.probability_error, "1", "its standard error"),
        "crossing_rate": (sampled.rate, "s-1", "up-crossings of the level, to one side, sampled"),
        "crossing_rate_error": (sampled.rate_error, "s-1", "its standard error"),
        "effective": (sampled.effective, "1", "effective number of windows"),
    }  # fmt: skip
    data = scalars(rows)
    data["roll"] = xr.Variable(
        ("time",), np.degrees(history), {"units": "deg", "long_name": "roll of the likeliest window"}
    )
    time = own.step * (np.arange(own.steps + 1) - own.steps)
    coords = sea_coordinates([sea], {}, {}) | {"time": ("time", time, {"units": "s", "long_name": "before the roll"})}
    heads = {"title": "A rare roll in an irregular sea", "references": "H71, Jensen07, Tucker84", "source": made_by()}
    return xr.Dataset(data, coords, heads | about)
