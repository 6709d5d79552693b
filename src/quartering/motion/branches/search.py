"""All periodic motions that coexist in one condition: from grids of starts, and along the branch from rest."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from quartering.motion.branches.homotopy import carried, same
from quartering.motion.branches.raising import Raising, over_height
from quartering.motion.branches.seeds import grid_of_roll, heeled_starts, largest_roll
from quartering.motion.branches.switching import disturbance
from quartering.motion.equations.batch import copies
from quartering.motion.equations.model import Model
from quartering.motion.equations.system import Floats, System
from quartering.motion.status import Status
from quartering.motion.steady.balance import BalanceEquations
from quartering.motion.steady.harmonic import harmonic_balance, orders_for
from quartering.motion.steady.motion import Motion, motion_record
from quartering.motion.steady.subharmonic import ascending, columns, orders_of, rearranged, slowed

_ANGLES, _SIZES = 12, 12
_FEW = 4
_OFFSETS, _ITERATIONS = (0.1, 0.3), 10
_ZERO = 1e-5
_LOW = 3
_FURTHER = Raising(highest=100.0)
_BEYOND = 2.0

Found = tuple[Floats, int, float]
"""Coefficients of a motion, its status, its residual."""


class Motions(list[Motion]):
    """Motions from the smallest roll to the largest, and what the search for them left open.

    Parameters
    ----------
    motions : iterable of Motion
    left_open : sequence of str    one sentence for each motion of few harmonics that could not be carried on, and for a number
                                   of motions that cannot be all
    """

    def __init__(self, motions: Iterable[Motion], left_open: Sequence[str] = ()) -> None:
        super().__init__(motions)
        self.left_open = tuple(left_open)


def periodic_motions(model: Model, harmonics: int = 9) -> Motions:
    """Every periodic motion found in one condition, from the smallest roll to the largest.

    harmonics: of the motions returned, odd
    Returns a list of `Motion`: of the wave's period, leaning ones among them, and of twice that (``periods`` is 2);
        ``left_open`` says what could not be followed

    Motions of the wave's period: by Newton's method from the linear solution and from grids of roll amplitudes, phases and
    heels, with one harmonic, and carried over to all (see `carried`); and along the branch over the wave's height from rest to
    twenty times the wave.  Leaning ones also beside the symmetric ones, each with its mirror image.  Motions of two periods:
    from those of one, disturbed at half the frequency.  Where the number of motions is not odd as it should be (see
    `_odd`), the branches over the wave's height through all of them are followed.  Nothing proves that no further motion
    exists.
    Source: [Krack19]; [H71] eq. (A-11) has up to as many roots as its cubics allow.
    """
    system = model.system
    orders, whole = orders_for(system, harmonics), orders_of(harmonics, 1)
    begun = _polished(system, heeled_starts(system), (0, 1, 2), orders_of(_LOW, 1))
    heeled = [rearranged(u[None], orders_of(_LOW, 1), whole)[0] for u, _, _ in begun]
    plain, left_open = _of_one_period(system, orders, [] if system.symmetric else heeled)
    leaning: list[Found] = []
    if system.symmetric:
        heeled += _beside(system, [rearranged(u[None], orders, whole)[0] for u, _, _ in plain], whole, 1)
        heeled += [_turned(u, whole, 0) for u in heeled]  # the mirror image (y, t) -> (-y, t + T/2) is a motion too
        leaning = [found for found in _polished(system, heeled, whole, whole) if _has(found[0], whole, 0)]
    of_one = [rearranged(u[None], orders, whole)[0] for u, _, _ in plain] + [u for u, _, _ in leaning]
    doubled = _doubled(system, of_one, whole, harmonics)
    records = [_record(model, found, used, periods) for group, used, periods in (
        (plain, orders, 1), (leaning, whole, 1), (doubled, orders_of(harmonics, 2), 2)
    ) for found in group]  # fmt: skip
    return Motions(sorted(records, key=lambda m: float(m.amplitude[1])), left_open)


def _of_one_period(system: System, orders: tuple[int, ...], more: list[Floats]) -> tuple[list[Found], list[str]]:
    """Different motions of the wave's period, from every start there is, and what is left open about them."""
    low, seeds = from_grid(system)
    seeds += [u for u, _, _ in _polished(system, _linear(system, low), low, low) if not _among(u, seeds)]
    ends = carried(system, seeds, low, orders)
    starts = [one for one in ends if one is not None] + _from_rest(system, orders, seeds) + more
    found = _polished(system, starts, orders, orders)
    if not _odd(system, orders, found):
        size = _sizes(system, [u for u, _, _ in found] or seeds)
        further = [v for u, _, _ in found for v in over_height(system, orders, u, size, _FURTHER)]
        found = _polished(system, [u for u, _, _ in found] + further, orders, orders)
    left_open = [_lost(u, orders) for u, end in zip(seeds, ends, strict=True) if end is None]
    if not _odd(system, orders, found):
        left_open.append(
            f"{len(found)} motions of the wave's period were found where their number should be odd: one more exists, or two of"
            " them are about to merge"
        )
    return found, left_open


def _linear(system: System, low: tuple[int, ...]) -> list[Floats]:
    """The one-harmonic motion Newton's method reaches from the linear one, if any."""
    u, status, _ = harmonic_balance(system, low)
    return [u[0]] if Status(status[0]).ok else []


def _from_rest(system: System, orders: tuple[int, ...], seeds: list[Floats]) -> list[Floats]:
    """Guesses of motions on the branch over the wave's height from rest."""
    rest, size = np.zeros((3, sum(1 if h == 0 else 2 for h in orders))), _sizes(system, seeds)
    return over_height(system, orders, rest, size, Raising(steepest=_BEYOND * size[1]), height=0.0)


def _sizes(system: System, motions: list[Floats]) -> Floats:
    """Size (3,) of each mode: the largest of some motions, and where motions are looked for in roll."""
    size = np.max([np.zeros(3), *(np.abs(u).max(axis=1) for u in motions)], axis=0)
    size[1] = max(float(size[1]), largest_roll(system))
    return np.asarray(size)


# Why their number is odd. Lower the wave to nothing. On the way motions appear and disappear in pairs, at folds, and lean away
# from a symmetric one in pairs, so whether their number is odd or even stays as it is as long as none of them runs off to
# infinity: it is that of calm water. There, with damping, a motion of the wave's period is an equilibrium. Of a symmetric
# system (odd in the state) the only symmetric equilibrium is rest, so the number of symmetric motions is odd; so is that of
# all equilibria where the righting moment is odd, as every further one has its mirror image. (The degree of the equations in
# the sense of Brouwer says the same.) Equations that are not symmetric may have any number of equilibria, and are not asked.


def _odd(system: System, orders: tuple[int, ...], found: list[Found]) -> bool:
    """Is the number of motions odd, as that of all symmetric ones must be? True where it need not be."""
    return not system.symmetric or 0 in orders or len(found) % 2 == 1


def _lost(seed: Floats, orders: tuple[int, ...]) -> str:
    roll = np.degrees(np.hypot(*seed[1, -2:]))
    return (
        f"a motion of one harmonic that rolls {roll:.3g} deg belongs to none of harmonics up to {max(orders)}: it merges with"
        " another one when these come in, or could not be followed"
    )


def _record(model: Model, found: Found, orders: tuple[int, ...], periods: int) -> Motion:
    u, code, error = found
    rising, used = ascending(u[None], orders)
    motion = motion_record(model, rising[0], used, code, error, "harmonic balance")
    return motion if periods == 1 else replace(motion, frequency=model.frequency / periods, periods=periods)


def _polished(system: System, starts: Sequence[Floats], low: tuple[int, ...], orders: tuple[int, ...]) -> list[Found]:
    """Different motions of the given harmonics that Newton's method reaches: coefficients, status, residual."""
    if not starts:
        return []
    u = rearranged(np.array(starts), low, orders)
    u, status, residual = harmonic_balance(copies(system, len(u)), orders, start=u)
    found: list[Found] = []
    for one, code, error in zip(u, status, residual, strict=True):
        if Status(code).ok and not _among(one, (known for known, _, _ in found)):
            found.append((one, int(code), float(error)))
    return found


def _among(u: Floats, known: Iterable[Floats]) -> bool:
    return any(same(u, one) for one in known)


def _has(u: Floats, orders: tuple[int, ...], parity: int) -> bool:
    """Does a motion have even (0) or odd (1) harmonics, beyond rounding?"""
    own = [c for h, where in columns(orders).items() if h % 2 == parity for c in range(where.start, where.stop)]
    return bool(np.abs(u[:, own]).max() > _ZERO * np.abs(u).max())


def from_grid(system: System) -> tuple[tuple[int, ...], list[Floats]]:
    """One-harmonic motions reached by Newton's method from a grid of roll amplitudes and phases.

    system: one condition
    Returns orders: harmonics of the motions; motions: different from each other

    Amplitudes as far as `largest_roll`.
    """
    low = orders_for(system, 1)
    starts = grid_of_roll(largest_roll(system), _SIZES, _ANGLES, columns(low)[1].start, 3 if low[0] == 0 else 2)
    return low, [u for u, _, _ in _polished(system, list(starts), low, low)]


def _doubled(system: System, motions: list[Floats], orders: tuple[int, ...], harmonics: int) -> list[Found]:
    """Motions of two wave periods reached from those of one by a disturbance at half the frequency."""
    low, full, slow, starts = orders_of(_LOW, 2), orders_of(harmonics, 2), slowed(system, 2), []
    first = columns(low)[1].start
    for u in motions:
        start = np.repeat(rearranged(u[None], orders, low, factor=2), _FEW * 2 * _FEW, axis=0)
        start += grid_of_roll(float(np.abs(u[1]).max()), _FEW, 2 * _FEW, first, start.shape[2])
        starts += list(start)
    begun = [rearranged(u[None], low, full)[0] for u, _, _ in _polished(slow, starts, low, low) if _has(u, low, 1)]
    begun += _beside(slow, [rearranged(u[None], orders, full, factor=2)[0] for u in motions], full, 2)
    found: list[Found] = []
    for one in _polished(slow, begun, full, full):
        if _has(one[0], full, 1) and not _among(_turned(one[0], full, 1), (u for u, _, _ in found)):
            found.append(one)
    return found


def _beside(system: System, motions: list[Floats], orders: tuple[int, ...], periods: int) -> list[Floats]:
    """Starts beside motions, in the shape in which each is closest to losing its symmetry or its period."""
    starts = []
    for u in motions:
        size = np.abs(u).max(axis=1)
        # A mode that hardly moves must not look easy to disturb.
        scale = np.repeat(np.where(size > 1e-3 * size.max(), size, size.max()), u.shape[1])
        shape = disturbance(system, u, orders, scale, periods) * scale
        reached = [_undamped(system, u + offset * shape.reshape(u.shape), orders) for offset in _OFFSETS]
        starts += [one for one in reached if one is not None]
    return starts


def _undamped(system: System, u: Floats, orders: tuple[int, ...]) -> Floats | None:
    """Where Newton's whole steps lead: beside a bifurcation its damped ones fall back on the motion that was left."""
    equations = BalanceEquations(system, orders)
    for _ in range(_ITERATIONS):
        residual, matrix = equations.at(u)
        try:
            step = np.linalg.solve(matrix, -residual).reshape(u.shape)
        except np.linalg.LinAlgError:
            return None
        u = u + step
        size = np.abs(u).max()
        if not np.abs(step).max() < 10.0 * size:
            return None
        if np.abs(step).max() < 1e-9 * size:
            return u
    return None


def _turned(u: Floats, orders: tuple[int, ...], parity: int) -> Floats:
    """A motion with the sign of its even (0) or odd (1) harmonics changed: odd ones of half the frequency, a period later."""
    turned = u.copy()
    for h, where in columns(orders).items():
        if h % 2 == parity:
            turned[:, where] *= -1.0
    return turned
