"""Claims of the paper about wave forces and the size of the response, measured."""

from __future__ import annotations

import numpy as np
import xarray as xr

from quartering.loads.comparison import compare_forces
from quartering.study.paper.claim import HEADINGS, MODERATE, Finding, Ships, graded, over_headings
from quartering.study.paper.conditions import speed_of

_LARGE, _RIGHT, _CLOSE = 0.2, 0.1, 0.05
_FINE = np.arange(10.0, 171.0, 1.0)


def strip_correction_matters(ships: Ships) -> Finding:
    """Figs. 2-4: force with and without the correction for the ship's presence."""
    parts = _differences(ships, "froude-krylov")
    return graded(
        min(parts) > _LARGE, max(parts) > _LARGE, f"without it the error is {_of_modes(parts)} of the largest"
    )


def printed_correction_is_right(ships: Ships) -> Finding:
    """Equations (B-5) to (B-11) as printed, and with the sign of the wave slope mended."""
    at_rest, mended = _differences(ships, "paper", 0.0), _differences(ships, "paper-corrected", 0.0)
    under_way = _differences(ships, "paper")
    words = (
        f"error at zero speed {_of_modes(at_rest)}, with the sign of the wave slope mended {_of_modes(mended)}; "
        f"at Fn 0.25, where its speed terms are missing, {_of_modes(under_way)}"
    )
    return graded(max(at_rest + under_way) < _RIGHT, min(at_rest) < _RIGHT, words)


def moment_is_largest_in_beam_seas(ships: Ships) -> Finding:
    """The cause given for the peak of roll near beam seas."""
    one = ships.one()
    forces = compare_forces(one, [one.hull.length], HEADINGS, speed_of(one))
    found = forces["amplitude"].squeeze(drop=True).sel(mode="roll")
    where = {form: float(HEADINGS[int(np.argmax(found.sel(form=form).values))]) for form in ("froude-krylov", "stf")}
    total = found.sel(form="stf")
    words = (
        f"largest at {where['froude-krylov']:.0f} deg without diffraction, at {where['stf']:.0f} deg with it; in beam seas "
        f"{float(total.sel(heading=90.0) / total.max()):.0%} of the largest"
    )
    beam = {form: 75 <= heading <= 105 for form, heading in where.items()}
    return graded(beam["stf"], beam["froude-krylov"], words)


def peak_at_encounter_resonance(ships: Ships) -> Finding:
    """The peak in quartering seas stands where the frequency of encounter is that of roll."""
    off, words = [], []
    for ratio in (0.6, 0.75, 1.0, 1.5):
        ds = over_headings(ships.one(), 2000, ratio, harmonics=1, headings=_FINE)
        i = int(np.argmax(ds["roll"].values))
        over_n2 = float(abs(ds["encounter_frequency"][i])) / float(ds.attrs["natural_roll_frequency"])
        off.append(over_n2 - 1)
        words.append(f"{ratio:g} L: {_FINE[i]:.0f} deg, omega/n2 {over_n2:.2f}")
    return graded(max(np.abs(off)) < 0.1, min(np.abs(off)) < 0.1, "largest roll at " + "; ".join(words))


def two_peaks_over_heading(ships: Ships) -> Finding:
    """Roll over heading has one peak in quartering and one near beam seas."""
    words, hump, beam = [], False, False
    for ratio in (0.6, 0.75, 1.0, 1.5):
        roll = over_headings(ships.one(), 2000, ratio, harmonics=1, headings=_FINE)["roll"].values
        tops = [i for i in range(1, roll.size - 1) if roll[i - 1] < roll[i] >= roll[i + 1] and _FINE[i] > 75]
        hump, beam = hump or bool(tops), beam or any(_FINE[i] <= 105 for i in tops)
        said = ", ".join(f"{_FINE[i]:.0f} deg ({roll[i] / roll.max():.1%} of the largest)" for i in tops)
        words.append(f"{ratio:g} L: {said or 'none'}")
    return graded(beam, hump, "a peak beyond 75 deg: " + "; ".join(words))


def largest_roll_in_quartering_seas(ships: Ships) -> Finding:
    """The worst roll is met in quartering seas, not in beam seas."""
    words, inside = [], []
    for ratio in (0.6, 1.0, 1.5, 2.0):
        roll = over_headings(ships.one(), MODERATE, ratio)["roll"]
        heading = float(HEADINGS[int(np.nanargmax(roll.values))])
        inside.append(15 <= heading <= 75)
        words.append(
            f"{ratio:g} L: {float(roll.max()):.1f} deg at {heading:.0f} deg, {float(roll.sel(heading=90.0)):.1f} in beam seas"
        )
    return graded(all(inside), any(inside), "; ".join(words))


def gm_moves_roll_both_ways(ships: Ships) -> Finding:
    """Fig. 20: less GM lowers roll at one heading and raises it at another."""
    change = _changes(ships, "roll", gm=0.9)
    low, high = int(np.argmin(change)), int(np.argmax(change))
    words = f"10 % less GM: roll {change[low]:+.0%} at {HEADINGS[low]:.0f} deg, {change[high]:+.0%} at {HEADINGS[high]:.0f} deg"
    return graded(change[low] < -_CLOSE and change[high] > _CLOSE, change[low] < 0 < change[high], words)


def gyradii_matter(ships: Ships, name: str = "series60-cb60") -> Finding:
    """Figs. 14-19: the roll gyradius changes roll and stability, the yaw gyradius yaw."""
    roll, index = (_changes(ships, of, name, gyradius_roll=1.1) for of in ("roll", "index"))
    yaw, roll_of_yaw = (_changes(ships, of, name, gyradius_yaw=1.1) for of in ("yaw", "roll"))
    words = (
        f"10 % more k_xx: roll {roll.min():+.0%} to {roll.max():+.0%} over the headings, S {index.min():+.0%} to "
        f"{index.max():+.0%}; 10 % more k_zz: yaw {yaw.min():+.0%} to {yaw.max():+.0%}, roll {roll_of_yaw.min():+.0%} to "
        f"{roll_of_yaw.max():+.0%}"
    )
    parts = [float(np.abs(change).max()) > _CLOSE for change in (roll, index, yaw)]
    return graded(all(parts), any(parts), words)


def gyradii_matter_for_the_mariner(ships: Ships) -> Finding:
    """The same on Mariner's measured sway-yaw set, substitute lines."""
    return gyradii_matter(ships, "mariner")


def _changes(ships: Ships, of: str, name: str = "series60-cb60", **factors: float) -> np.ndarray:
    """Relative change over the headings when values of the loading are multiplied."""
    one = ships.one(name)
    changed = one.with_(**{key: factor * getattr(one.loading, key) for key, factor in factors.items()})
    before, after = (over_headings(ship, MODERATE)[of].values for ship in (one, changed))
    return np.asarray(after / before - 1)


def _differences(ships: Ships, form: str, speed: float | None = None) -> list[float]:
    """Largest difference of a form of the wave force from strip theory with contour potentials: sway, roll, yaw."""
    one = ships.one()
    found: xr.Dataset = compare_forces(one, [one.hull.length], HEADINGS, speed_of(one) if speed is None else speed)
    return [float(x) for x in found["largest_difference"].squeeze(drop=True).sel(form=form)]


def _of_modes(parts: list[float]) -> str:
    return ", ".join(f"{name} {part:.0%}" for name, part in zip(("sway", "roll", "yaw"), parts, strict=True))
