"""Roll and stability of a ship at many conditions in six modes: heave and pitch in the pressure over the whole wetted hull."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering.hull.ship import Ship
from quartering.hydro.calm_water import calm_water_exponents
from quartering.loads.validity import warn_of_conditions
from quartering.motion.status import Status
from quartering.motion.steady_course.balance import Harmonics, doubled_harmonics, oblique_doubled_harmonics
from quartering.motion.steady_course.course import ROLL, SWAY, YAW, Course, course, warn_across, warn_of_surge
from quartering.motion.steady_course.doubled import doubled_motions, largest_roll
from quartering.motion.steady_course.orbits import Orbits, forced_motions, symmetric_orbits
from quartering.stability.kind import Kind
from quartering.stability.parametric import doubled_multipliers, growths, roll_growth
from quartering.study.conditions import FLAGS, RESULTS, UNKNOWN
from quartering.study.six_modes.grid import SixGrid

Floats = NDArray[np.float64]
Results = dict[str, NDArray[np.generic]]

BEYOND: Final = 1.6
"""Motions of two periods are followed up to this multiple of the wave's height."""


def evaluate_six(
    ship: Ship, speed: Floats, heading: Floats, wave_length: Floats, wave_height: Floats,
    *, progress: Callable[[int, int], None] | None = None,
) -> Results:  # fmt: skip
    """Roll, growth and verdict at many conditions, each mode of heave, pitch, sway, roll and yaw free.

    speed, heading, wave_length, wave_height (m,): [m/s], [deg], [m], [m]
    Returns the results of `evaluate` with leading shape (m, 1), and encounter_frequency (m,); what the paper's first order
        gives is NaN. roll_peak is the largest stable roll, of two wave periods where small roll grows; NaN where none was found

    Motions of two periods are looked for in head and following seas, and in oblique ones where small roll grows.
    """
    m = speed.size
    out: Results = {name: np.full((m, 1, *shape), np.nan) for name, shape in RESULTS.items()}
    out |= {name: np.full((m, 1), int(UNKNOWN[name]), dtype=np.int8) for name in FLAGS}
    out["encounter_frequency"] = np.full(m, np.nan)
    done = 0
    for at, head_on, many in _courses(ship, speed, heading, wave_length, wave_height):
        found = _along(many) if head_on else _across(many)
        for name, values in found.items():
            out[name][at] = values if name == "encounter_frequency" else values[:, None]
        done += at.size
        if progress is not None:
            progress(done, m)
    for one in np.unique(speed):
        out["calm_exponent"][speed == one] = float(np.asarray(calm_water_exponents(ship, float(one))).real.max())
    return out


def _courses(
    ship: Ship, speed: Floats, heading: Floats, wave_length: Floats, wave_height: Floats
) -> Iterator[tuple[NDArray[np.intp], bool, Course]]:
    """Conditions of one wave length, head and following seas apart from oblique ones: which, whether head-on, the course."""
    folded = np.remainder(heading, 360.0)
    for length in np.unique(wave_length):
        for head_on in (True, False):
            at = np.flatnonzero((wave_length == length) & ((folded % 180.0 == 0) == head_on))
            if at.size:
                yield at, head_on, course(ship, 2 * np.pi / float(length), wave_height[at] / 2, speed[at], folded[at])


def warn_of_six(ship: Ship, speed: Floats, heading: Floats, wave_length: Floats, wave_height: Floats) -> None:
    """Say what conditions, as of `evaluate_six`, leave behind: the range of theory, and surge that is not small."""
    for _, _, many in _courses(ship, speed, heading, wave_length, wave_height):
        warn_of_surge(many)
    warn_of_conditions(ship, speed, wave_length)
    worst = int((np.abs(np.sin(np.radians(heading))) / wave_length).argmax())
    warn_across(ship, 2 * np.pi / float(wave_length[worst]), float(heading[worst]))


def evaluate_six_block(grid: SixGrid, index: int) -> Results:
    """One block of a grid: a function of nothing but the two.

    index: of the block
    Returns `RESULTS` with leading shape (loadings, points, heights), and encounter_frequency (points,)
    """
    block, heights = grid.blocks[index], grid.heights(grid.blocks[index].points)
    u, mu, length = (np.repeat(values, heights.shape[1]) for values in grid.points(block.points))
    loadings = range(block.loadings.start, block.loadings.stop)
    found = [evaluate_six(grid.loaded(i), u, mu, length, heights.ravel()) for i in loadings]
    out = {
        name: np.stack([one[name].reshape(*heights.shape, *shape) for one in found]) for name, shape in RESULTS.items()
    }
    return out | {"encounter_frequency": found[0]["encounter_frequency"].reshape(heights.shape)[:, 0]}


def _begun(many: Course, orbits: Orbits) -> Results:
    """What both kinds of sea have in common."""
    n = many.count
    names = ("roll_peak", "exponent", "roll", "sway", "yaw")
    found: Results = {name: np.full(n, np.nan) for name in names}
    found["status"] = orbits.status.copy()
    found["verdict"] = np.full(n, int(Kind.NO_ANSWER), dtype=np.int8)
    found["other_roll_peak"] = np.full((n, RESULTS["other_roll_peak"][0]), np.nan)
    found["encounter_frequency"] = many.signed.copy()
    return found


def _along(many: Course) -> Results:
    """Head and following seas: no roll but what grows by itself."""
    orbits = symmetric_orbits(many)
    growth = roll_growth(orbits, 0.0)
    found, basis = _begun(many, orbits), doubled_harmonics()
    for i in np.flatnonzero(orbits.found & np.isfinite(growth.growth)):
        rate = float(growth.growth[i])
        multiplier, least = complex(growth.multiplier[i]), float(growth.gm[i].min())
        found["exponent"][i], found["verdict"][i] = rate, int(_kind(rate, multiplier, least))
        rolls = [*([0.0] if rate <= 0 else []), *_stable_rolls(many.rows(np.array([i])), basis)]
        _settle(found, int(i), rolls)
        for name in ("roll", "sway", "yaw"):
            found[name][i] = 0.0
    return found


def _across(many: Course) -> Results:
    """Oblique seas: the forced motion, and those of two periods where it is unstable."""
    orbits = forced_motions(many)
    found, basis = _begun(many, orbits), oblique_doubled_harmonics()
    for i in np.flatnonzero(orbits.found):
        one, x = many.rows(np.array([i])), orbits.x[[i]]
        rates, multipliers = growths(one, orbits.basis, x, 1)
        rate = float(rates[0])
        if not np.isfinite(rate):
            found["status"][i] = int(Status.BEYOND_THE_DECK)
            continue
        gm = Orbits(one, orbits.basis, x, orbits.status[[i]]).metacentric_height(
            np.linspace(0, 2 * np.pi, 32, endpoint=False)
        )
        found["exponent"][i], found["verdict"][i] = rate, int(_kind(rate, complex(multipliers[0]), float(gm.min())))
        forced = float(np.degrees(largest_roll(orbits.basis, x)[0]))
        rolls = [forced] if rate <= 0 else _stable_rolls(one, basis)
        _settle(found, int(i), rolls)
        parts = orbits.basis.parts(x[0])
        omega = float(one.numbers.omega[0])
        first = {mode: float(np.hypot(parts[mode][1], parts[mode][2])) for mode in (SWAY, ROLL, YAW)}
        found["roll"][i] = np.degrees(first[ROLL])
        found["sway"][i], found["yaw"][i] = first[SWAY] / omega, np.degrees(first[YAW] / omega)
    return found


def _settle(found: Results, i: int, rolls: list[float]) -> None:
    """Largest stable roll, and others beside it."""
    if not rolls:
        found["status"][i] = int(Status.BEYOND_CAPSIZE_LIMIT)
        return
    found["roll_peak"][i] = max(rolls)
    others = sorted(rolls)[:-1][: found["other_roll_peak"].shape[1]]
    found["other_roll_peak"][i, : len(others)] = others


def _kind(rate: float, multiplier: complex, least: float) -> Kind:
    """What grows."""
    if rate <= 0:
        return Kind.STABLE
    if multiplier.real < 0:
        return Kind.PERIOD_DOUBLING
    return Kind.PURE_LOSS if least <= 0 else Kind.ROLL


def _stable_rolls(one: Course, basis: Harmonics) -> list[float]:
    """Largest roll of the stable motions of two periods of one condition [deg]."""
    amplitude = float(one.numbers.amplitude[0])
    x, _ = doubled_motions(one, amplitude, BEYOND * amplitude, basis=basis)
    if not len(x):
        return []
    if 0 in basis.lateral:
        stable = growths(one, basis, x, 2)[0] < 0.0
    else:
        stable = np.abs(doubled_multipliers(one, basis, x)).max(axis=1) < 1.0
    return [float(value) for value in np.degrees(largest_roll(basis, x[stable]))]
