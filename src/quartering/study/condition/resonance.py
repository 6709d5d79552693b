"""Where waves meet a ship at its roll frequency, and whether a grid steps over that resonance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import GRAVITY
from quartering.hydro.calm_water import calm_water_exponents
from quartering.loads.waves import encounter_frequency
from quartering.study.grid import Grid

Floats = NDArray[np.float64]
_LIGHTEST_WAVE_FROM_SIDE = 0.1


def resonance_fields(
    wave_length: ArrayLike, speed: float, heading: ArrayLike, roll_frequency: float
) -> dict[str, tuple[Floats, float]]:
    """Encounter frequency beside n2, 2 n2, and zero, at which the ship keeps pace with the wave.

    wave_length, heading (...): broadcast [m, deg]
    speed: U [m/s]
    roll_frequency: n2 [rad/s]
    Returns a field and the level its line is drawn at: "resonance": abs(omega), n2; "twice": abs(omega), 2 n2; "pace":
        omega, 0 [rad/s]

    >>> at = resonance_fields(2 * np.pi * GRAVITY / 0.6**2, 0.0, 90.0, 0.6)
    >>> {name: (round(float(field), 12), level) for name, (field, level) in at.items()}
    {'resonance': (0.6, 0.6), 'twice': (0.6, 1.2), 'pace': (0.6, 0.0)}
    """
    sigma = np.sqrt(GRAVITY * (2 * np.pi / np.asarray(wave_length, dtype=float)))
    omega = np.asarray(encounter_frequency(sigma, speed, np.asarray(heading, dtype=float)))
    size = np.abs(omega)
    return {"resonance": (size, roll_frequency), "twice": (size, 2 * roll_frequency), "pace": (omega, 0.0)}


def resonant_headings(ds: xr.Dataset) -> list[float]:
    """Headings at which the encounter frequency passes the natural frequency of roll.

    ds: of `polar` or `sweep` over ``heading`` alone
    Returns [deg], interpolated between the headings of the dataset

    Source: [H71] Figs. 5, 8: where it places the peak of roll.
    """
    heading = np.asarray(ds["heading"], dtype=float)
    gap = np.abs(np.asarray(ds["encounter_frequency"])) - float(ds.attrs["natural_roll_frequency"])
    here = np.flatnonzero(gap[:-1] * gap[1:] < 0)
    return [float(heading[i] - gap[i] * (heading[i + 1] - heading[i]) / (gap[i + 1] - gap[i])) for i in here]


def missed_resonance(grid: Grid) -> tuple[str, ...]:
    """Parts of a grid that step over the roll resonance without a condition inside its peak.

    Returns for each axis (wave length, speed) and loading concerned: the widest range missed, and what to add

    The peak reaches from n2 (1 - zeta) to n2 (1 + zeta) in encounter frequency, zeta the damping of free roll in calm
    water at that speed (closed form, half power).  Lines along which no neighbouring values lie on the two sides of n2 are
    not concerned, nor are waves within 6 degrees of ahead or astern, which do not roll the ship. Of many loadings nine are
    looked at.
    """
    heading, length = grid.axes["heading"], grid.axes["wave_length"]
    speed = grid.axes["speed"]
    found: list[str] = []
    for i in np.unique(np.linspace(0, grid.loading_count - 1, 9).astype(int)):
        n2, zeta = _free_roll(grid, int(i))
        said = _loading_words(grid, int(i))
        for values, along, words in ((length, "wave_length", "wave lengths {} m"), (speed, "speed", "speeds {} m/s")):
            order = np.argsort(values)
            line = _Line(along, speed, heading, length, n2, zeta)
            found += _missed_along(values[order], line, words, said)
    return tuple(found)


@dataclass(frozen=True)
class _Line:
    """How far from roll resonance conditions are, along speed or wave length."""

    along: str
    speed: Floats
    heading: Floats
    length: Floats
    n2: Floats
    zeta: Floats

    def others(self) -> tuple[Floats, Floats]:
        """Wave length (or speed) and heading of every line, flat; without headings from which waves do not roll the ship."""
        mu = self.heading[np.abs(np.sin(np.radians(self.heading))) > _LIGHTEST_WAVE_FROM_SIDE]
        other, mu = np.meshgrid(self.speed if self.along == "wave_length" else self.length, mu, indexing="ij")
        return other.ravel(), mu.ravel()

    def off(self, value: Floats, other: Floats, mu: Floats) -> tuple[Floats, Floats]:
        """|omega|/n2 - 1, and the width of the peak in it."""
        u, length = (other, value) if self.along == "wave_length" else (value, other)
        order = np.argsort(self.speed)
        n2, zeta = (np.interp(u, self.speed[order], known[order]) for known in (self.n2, self.zeta))
        return np.abs(encounter_frequency(np.sqrt(2 * np.pi * GRAVITY / length), u, mu)) / n2 - 1.0, zeta


def _missed_along(values: Floats, line: _Line, words: str, said: str) -> list[str]:
    """Ranges missed along one axis in a sentence: where the peaks lie, by bisection, and a step that meets the narrowest."""
    other, mu = line.others()
    if values.size < 2 or not other.size:
        return []
    off, zeta = line.off(values, other[:, None], mu[:, None])
    inside = np.abs(off) <= zeta
    missed = (off[:, :-1] * off[:, 1:] < 0) & ~inside[:, :-1] & ~inside[:, 1:]
    if not missed.any():
        return []
    which, gap = np.nonzero(missed)
    low, high, where = values[gap], values[gap + 1], (other[which], mu[which])
    begins = line.off(low, *where)[0]
    for _ in range(40):
        middle = 0.5 * (low + high)
        same = line.off(middle, *where)[0] * begins > 0
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    peak, small = 0.5 * (low + high), 1e-4 * (values[gap + 1] - values[gap])
    slope = (line.off(peak + small, *where)[0] - line.off(peak - small, *where)[0]) / (2 * small)
    step = float(np.min(line.off(peak, *where)[1] / np.abs(slope)))
    first, last = f"{peak.min():.4g}", f"{peak.max():.4g}"
    near = first if first == last else f"{first} to {last}"
    between = f"between {values[gap.min()]:.4g} and {values[gap.max() + 1]:.4g}"
    return [
        f"{words.format(between)} step over the roll resonance on {missed.any(axis=1).sum()} of {other.size} lines{said};"
        f" add values near {near}, or take steps of {step:.2g} there"
    ]


def _free_roll(grid: Grid, index: int) -> tuple[Floats, Floats]:
    """Natural frequency [rad/s] and fraction of critical damping of free roll at each speed, for one loading."""
    ship = grid.loaded(index)
    n2, zeta = [], []
    for u in grid.axes["speed"]:
        z = np.asarray(calm_water_exponents(ship, float(u)))
        roll = z[np.argmax(z.imag)]
        n2.append(max(abs(roll), 1e-6))
        zeta.append(min(max(-roll.real / max(abs(roll), 1e-6), 1e-3), 1.0))
    return np.array(n2), np.array(zeta)


def _loading_words(grid: Grid, index: int) -> str:
    if not grid.loadings:
        return ""
    return " (" + ", ".join(f"{name} {column[index]:.4g}" for name, column in grid.loadings.items()) + ")"
