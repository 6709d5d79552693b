"""A ship in an irregular sea in six modes: ensembles of half hours, their failures counted."""

from __future__ import annotations

import math
import warnings
from dataclasses import replace
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering._machine.threads import spread_in_order
from quartering.conventions import GRAVITY, InputError, RangeWarning
from quartering.hull.ship import Ship
from quartering.hull.told import condition, count, number
from quartering.hydro.coefficients import coefficients
from quartering.loads.sea.sea import Sea
from quartering.loads.validity import warn_of_conditions
from quartering.loads.waves import encounter_frequency, least_encounter_frequency
from quartering.loads.wetted_hull.floating import floating_tables
from quartering.loads.wetted_hull.section_tables import SectionTables
from quartering.motion.six_modes import vertical_motion
from quartering.motion.steady_course.course import Course, course, radiation, waves_met
from quartering.motion.steady_course.free_heave import force_with, free_matrices
from quartering.motion.steady_course.march import AFLOAT, UNDER
from quartering.motion.steady_course.sea_march import Components, march_in_a_sea
from quartering.study.seas.simulated.asked import roll_limit_of
from quartering.study.seas.simulated.failures import failure_rate

Floats = NDArray[np.float64]

BLOCK: Final = 1800.0
"""Length of a block [s]."""
RUN_UP: Final = 300.0
"""From rest before a block counts; over its first third the sea rises [s]."""
KICK: Final = math.radians(1.0)
"""Heel added when a block begins to count: head and following long-crested seas roll no ship by themselves [rad]."""
WAVES: Final = 200
"""Components of a block, of one energy each."""
BANDS: Final = 3
"""Of the wave number, in which the decay with depth is that of one."""
_STEPS: Final = 36
_NEAR, _SHARE, _MOST_NEAR = 0.05, 0.05, 0.2
_SLOW: Final = 0.25
"""Of its own frequency, below which a wave is met too slowly for its surge to be linear: the ship does not surge in it."""
_GRID, _WIDTH = 600, 5.0


class Banded(NamedTuple):
    """Bands of the wave number: edges in frequency (b - 1,), k (b,), tables of the first, splines (b, s, d, c, 8) of all."""

    edges: Floats
    k: Floats
    tables: SectionTables
    splines: Floats


class Drawn(NamedTuple):
    """Cells of a sea: cumulative share of energy, frequency [rad/s] and its width, heading and breadth [deg], (c,); m0 [m2]."""

    share: Floats
    sigma: Floats
    step: Floats
    heading: Floats
    breadth: Floats
    m0: float


def irregular_six(
    ship: Ship,
    sea: Sea,
    speed: float | str,
    heading: float | str | None = None,
    *,
    hours: float | str = 32.0,
    seed: int = 0,
    limit: float | str | None = None,
    bands: int = BANDS,
) -> xr.Dataset:
    """A ship simulated in an irregular sea, the pressure of all waves on its whole hull: its roll and its failures.

    speed, heading: U [m/s]; None: as the sea has it [deg]
    hours: in blocks of half an hour
    seed: with the condition everything is drawn from it
    limit: roll of a failure [rad]; by default as `irregular`
    bands: of the wave number, each with tables of its own
    Returns heave_rms [m], pitch_rms, roll_rms [deg]; exposure [h], failures, failure_rate, rate_lower, rate_upper [1/s]; over
        block: roll_largest [deg], failure_time [s], failure_cause ("", "roll", "under water")

    The equations of `simulate_on_course` with the surface, diffraction, lift, drag and surge of 200 waves of one energy each,
    their phases by chance. Radiation: heave and pitch at the mean frequency of their own linear motion, or at the lowest above
    with which they die out in calm water, the wave's force making up for the rest; sway, roll and yaw at the natural frequency
    of roll. A block ends with its failure; failures have the exact interval of a Poisson count.
    Source: superposition of linear waves, [STF70].  Valid: as `parametric_roll`; the surface straight across a section.
    """
    U, mu = condition(ship, speed, sea.heading if heading is None else heading)
    sea = sea if heading is None else sea.turned_to(mu)
    duration, seed = number(None, "simulated_hours", hours), count("seed", seed, 0, 0)
    roll_limit, why = roll_limit_of(ship, limit)
    cells = _cells(sea)
    near = _near_zero(cells, U)
    if near > _MOST_NEAR:
        raise InputError(
            f"{sea.words}, {U:.3g} m/s: {near:.0%} of the energy is near encounter frequency 0, where surge is not small; "
            "change speed or heading, or see surf_riding"
        )
    one, banded = _at_rest(ship, sea, cells, U), _banded(ship, cells, bands)
    blocks = range(math.ceil(2 * duration))
    found = spread_in_order(lambda i: _block(one, cells, banded, (seed, i), roll_limit), blocks)
    sums = np.array([one[0] for one in found])
    _warn(ship, sea, cells, U, sums)
    return _dataset(ship, sea, U, sums, np.array([one[1] for one in found]), (roll_limit, why, seed))


def _cells(sea: Sea) -> Drawn:
    """Energy of a sea in fine cells."""
    parts: list[Floats] = []
    for one in sea.partitions:
        low, high = one.band
        step = (high - low) / _GRID
        sigma = np.asarray(low + step * (np.arange(_GRID) + 0.5), dtype=float)
        spread = one.spreading is not None
        headings = np.arange(-180.0, 180.0, _WIDTH) if spread else np.array([one.heading])
        energy = one.energy(sigma, step, headings, _WIDTH if spread else 0.0)
        grid = np.broadcast_arrays(sigma[:, None], step, headings[None, :], _WIDTH if spread else 0.0, energy)
        parts.append(np.stack([np.ravel(part) for part in grid]))
    sigma, step, mu, breadth, energy = np.concatenate(parts, axis=1)
    order = np.lexsort((mu, sigma))
    m0 = float(energy.sum())
    return Drawn(np.cumsum(energy[order]) / m0, sigma[order], step[order], mu[order], breadth[order], m0)


def _drawn(cells: Drawn, chance: np.random.Generator) -> tuple[Floats, Floats, Floats]:
    """Frequencies, headings and phases of the waves of a block: one from each share of the energy."""
    at = np.searchsorted(cells.share, (np.arange(WAVES) + chance.random(WAVES)) / WAVES).clip(0, cells.share.size - 1)
    sigma = cells.sigma[at] + cells.step[at] * (chance.random(WAVES) - 0.5)
    heading = cells.heading[at] + cells.breadth[at] * (chance.random(WAVES) - 0.5)
    return sigma, heading, chance.uniform(0.0, 2 * np.pi, WAVES)


def _weights(cells: Drawn) -> Floats:
    return np.diff(cells.share, prepend=0.0)


def _at_rest(ship: Ship, sea: Sea, cells: Drawn, speed: float) -> Course:
    """The ship's matrices: heave and pitch at the mean frequency of their motion, the rest at the frequency of roll."""
    some = np.unique(np.searchsorted(cells.share, (np.arange(WAVES) + 0.5) / WAVES).clip(0, cells.share.size - 1))
    met = np.abs(encounter_frequency(cells.sigma[some], speed, cells.heading[some]))
    k = cells.sigma[some] ** 2 / GRAVITY
    moved = vertical_motion(ship, k, np.full(k.size, speed), cells.heading[some], float(ship.value("gyradius_pitch")))
    energy = np.nan_to_num(np.abs(moved[:, 1]) ** 2)
    omega = float(energy @ met / energy.sum()) if energy.sum() > 0 else float(met.mean())
    many = course(ship, float(k[k.size // 2]), np.zeros(1), np.array([speed]), np.array([sea.heading]))
    natural = coefficients(ship, np.array([omega]), np.array([speed])).roll_frequency
    of_heave = radiation(ship, np.array([omega]), np.array([speed]))
    of_roll = radiation(ship, np.array([2 * natural]), np.array([speed]))  # held at halves of a frequency
    mass, damping = (part.copy() for part in of_heave)
    mass[:, 1, 2:, 2:], damping[:, 1, 2:, 2:] = (part[:, 1, 2:, 2:] for part in of_roll)
    mass[:, 2, :2, :2], damping[:, 2, :2, :2], _ = free_matrices(ship, np.array([omega]), np.array([speed]))
    return replace(many, numbers=many.numbers._replace(mass=mass, damping=damping, omega=np.array([omega])))


def _banded(ship: Ship, cells: Drawn, bands: int) -> Banded:
    """Bands of the wave number, each with the same share of the energy, and their tables."""
    edges = np.interp(np.arange(1, bands) / bands, cells.share, cells.sigma)
    middle = np.interp((np.arange(bands) + 0.5) / bands, cells.share, cells.sigma)
    tables = [floating_tables(ship, float(k))[0] for k in middle**2 / GRAVITY]
    k = np.array([one.wavenumber for one in tables])
    return Banded(edges, k, tables[0], np.stack([one.spline for one in tables]))


def components(one: Course, banded: Banded, waves: tuple[Floats, ...]) -> Components:
    """Waves that meet a ship, with all they do beside their pressure.

    one: the ship, with the matrices it is marched with
    waves: amplitude [m], frequency [rad/s], heading [deg] and phase [rad], (n,) each

    To their force stands added what the matrices of heave and pitch lack at their own frequency, as in `free_heave`.
    """
    ship, speed = one.ship, float(one.speed[0])
    amplitude, sigma, heading, phase = (np.ascontiguousarray(part, dtype=float) for part in waves)
    k, speeds = sigma**2 / GRAVITY, np.full(sigma.size, speed)
    signed = np.asarray(encounter_frequency(sigma, speed, heading))
    slow = np.abs(signed) < least_encounter_frequency(ship.hull.length)
    c = coefficients(ship, np.where(slow, least_encounter_frequency(ship.hull.length), np.abs(signed)), speeds)
    met = waves_met(ship, c, k, speeds, heading, signed, slow | (np.abs(signed) < _SLOW * sigma))
    angle = met.wave[:, :1] * banded.tables.x
    held = one.numbers.mass[:, 2, :2, :2], one.numbers.damping[:, 2, :2, :2]
    force = force_with(ship, (k, speeds, heading, signed), met.force, held)
    return Components(
        amplitude, np.abs(signed), phase, met.wave, force, np.ascontiguousarray(met.strips[:, :, 3:]),
        np.ascontiguousarray(met.surge[:, 0]), np.searchsorted(banded.edges, sigma).astype(np.int64),
        np.ascontiguousarray(np.stack([np.cos(angle), np.sin(angle)], axis=1)),
    )  # fmt: skip


def _block(one: Course, cells: Drawn, banded: Banded, seeds: tuple[int, int], limit: float) -> tuple[Floats, int]:
    """Sums, largest roll and end of one block, and how it ends."""
    sigma, heading, phase = _drawn(cells, np.random.default_rng(seeds))
    amplitude = np.full(WAVES, math.sqrt(2 * cells.m0 / WAVES))
    sea = components(one, banded, (amplitude, sigma, heading, phase))
    shortest = 2 * math.pi / max(float(np.quantile(sea.omega, 0.95)), 1e-9)
    h = min(shortest, 2 * math.pi * math.sqrt(2 * one.draught / GRAVITY)) / _STEPS
    out, steps = np.zeros(6), math.ceil(BLOCK / h)
    ended = marched(one, banded, sea, BLOCK / steps, RUN_UP, KICK, limit, steps, out)
    return out, ended


def marched(
    one: Course,
    banded: Banded,
    sea: Components,
    h: float,
    run_up: float,
    kick: float,
    limit: float,
    steps: int,
    out: Floats,
) -> int:
    """`march_in_a_sea` of a ship: heave and pitch with their own matrices, sway, roll and yaw with theirs."""
    n = one.numbers
    up, across = np.linalg.inv(n.mass[0, 2, :2, :2]), np.linalg.inv(n.mass[0, 1, 2:, 2:])
    damp_up, damp_across = n.damping[0, 2, :2, :2].copy(), n.damping[0, 1, 2:, 2:].copy()
    bands, matrices = (banded.tables, banded.splines, banded.k), (up, across, damp_up, damp_across)
    told = (h, round(run_up / h), run_up / 3, kick, limit, steps)
    return int(march_in_a_sea(*bands, n, sea, *matrices, *told, out))


def _near_zero(cells: Drawn, speed: float) -> float:
    """Share of the energy that the ship nearly keeps pace with."""
    return float(_weights(cells)[np.abs(encounter_frequency(cells.sigma, speed, cells.heading)) < _NEAR].sum())


def _warn(ship: Ship, sea: Sea, cells: Drawn, speed: float, sums: Floats) -> None:
    """What leaves the range of the method."""
    warn_of_conditions(ship, speed, 2 * math.pi * GRAVITY / float(_weights(cells) @ cells.sigma) ** 2)
    share, lost = _near_zero(cells, speed), int((sums[:, 5] < 0).sum())
    said = []
    if share > _SHARE:
        said.append(f"{share:.0%} of the energy is near encounter frequency 0: surf-riding; change speed or heading")
    if lost:
        said.append(
            f"{lost} of {len(sums)} blocks failed in their run-up and do not count; the sea is too much for this ship"
        )
    for words in said:
        warnings.warn(f"{sea.words}: {words}", RangeWarning, stacklevel=5)


def _dataset(
    ship: Ship, sea: Sea, speed: float, sums: Floats, ended: NDArray[np.int64], known: tuple[float, str, int]
) -> xr.Dataset:
    limit, why, seed = known
    counted = sums[:, 5] >= 0
    total, exposure = sums[counted].sum(axis=0), float(sums[counted, 5].sum())
    failed = counted & (ended != AFLOAT)
    rate = failure_rate(int(failed.sum()), exposure)
    rms = np.sqrt(total[:3] / total[3]) if total[3] > 0 else np.full(3, np.nan)
    cause = np.where(~failed, "", np.where(ended == UNDER, "under water", "roll"))
    single = {
        "heave_rms": (rms[0], "m", "heave of G, root mean square"),
        "pitch_rms": (np.degrees(rms[1]), "deg", "pitch, root mean square"),
        "roll_rms": (np.degrees(rms[2]), "deg", "roll, root mean square"),
        "exposure": (exposure / 3600.0, "h", "time until failure or end, summed"),
        "failures": (int(failed.sum()), "1", "blocks that ended in a failure"),
        "failure_rate": (rate.rate, "s-1", "failures over exposure"),
        "rate_lower": (rate.lower, "s-1", "lower end of its interval of 95 %"),
        "rate_upper": (rate.upper, "s-1", "upper end of its interval of 95 %"),
    }
    largest = np.where(counted, np.degrees(sums[:, 4]), np.nan)
    fields: dict[str, Any] = {
        name: ((), value, {"units": unit, "long_name": words}) for name, (value, unit, words) in single.items()
    }
    along = {
        "roll_largest": (largest, "deg", "largest roll"),
        "failure_time": (np.where(failed, sums[:, 5], np.nan), "s", "time of the failure"),
    }
    fields |= {
        name: (("block",), value, {"units": unit, "long_name": words}) for name, (value, unit, words) in along.items()
    }
    fields["failure_cause"] = (("block",), cause, {"units": "1", "long_name": "what failed"})
    said = {
        "title": f"{ship.name} in {sea.words}, six modes", "ship": ship.name, "speed": speed, "sea": sea.words, "modes": "six",
        "failure_roll": math.degrees(limit), "failure_reason": why, "seed": seed, "waves": WAVES, "references": "STF70",
    }  # fmt: skip
    return xr.Dataset(
        fields, {"block": ("block", np.arange(len(sums)), {"units": "1", "long_name": "half hour"})}, said
    )
