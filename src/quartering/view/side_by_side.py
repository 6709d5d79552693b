"""Two ships, or two loadings of one, side by side: what they are called, what their reader should know, and the one table."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from quartering.view.map_summary import Summary

if TYPE_CHECKING:
    import xarray as xr

    from quartering.hull.ship import Ship

ALIKE = "are one ship, loaded alike; give another ship or loading to compare it with"
"""What is said of two that have nothing to compare."""
_HUNDREDS, _THOUSANDS = 1e3, 1e4
"""From here on a difference, and a value, is told in whole numbers."""
_SAME = 1e-6
"""Lengths nearer than this are the same."""


def alike(one: Ship, other: Ship) -> bool:
    """Are two ships one, loaded alike?"""
    from quartering._machine.digest import fingerprint

    return fingerprint(one) == fingerprint(other)


def told_apart(ships: Sequence[Ship], words: Sequence[str]) -> list[str]:
    """What two ships are called: their names, with a word for each where these are the same."""
    names = [one.name for one in ships]
    if len(set(names)) == len(names):
        return names
    apart = words if len(set(words)) == len(words) else [str(i + 1) for i in range(len(names))]
    return [f"{name} ({word})" for name, word in zip(names, apart, strict=True)]


def warned(ships: Sequence[Ship], labels: Sequence[str], *, same_name: bool, measured_by: int = 0) -> list[str]:
    """What the reader of a comparison should know: ships of one name, and of other sizes.

    measured_by: which of them Fn and wave length ratios are of
    """
    said = []
    if same_name:
        said.append(f"Both are called {ships[0].name}; here they are {labels[0]} and {labels[1]}.")
    sizes = [(one.hull.length, one.hull.beam) for one in ships]
    if any(not math.isclose(a, b, rel_tol=_SAME) for a, b in zip(*sizes, strict=True)):
        lengths = " and ".join(f"{length:.4g} x {beam:.4g} m" for length, beam in sizes)
        said.append(
            f"The ships are of other sizes (L x B {lengths}): both meet the same waves and speeds in metres; Fn and λ/L are "
            f"those of {labels[measured_by]}."
        )
    return said


def comparison_rows(
    ships: Sequence[Ship], maps: Sequence[xr.Dataset], summaries: Sequence[Sequence[Summary]]
) -> list[tuple[str, str, str, str]]:
    """Rows of the one table: what the ships are, and what stands out at each speed; the last column is second less first."""
    from quartering.hull.hydrostatics import hydrostatics

    floats = [hydrostatics(one) for one in ships]
    rows = [
        _row("length [m]", [one.hull.length for one in ships]),
        _row("beam [m]", [one.hull.beam for one in ships]),
        _row("draught [m]", [one.hull.draught for one in ships]),
        _row("displacement [t]", [h.displacement for h in floats]),
        _row("GM [m]", [one.loading.gm for one in ships]),
        _row("KG [m]", [one.loading.kg for one in ships]),
        _row("roll gyradius k_xx [m]", [one.loading.gyradius_roll for one in ships]),
        _row("natural roll frequency [rad/s]", [float(m.attrs["natural_roll_frequency"]) for m in maps]),
    ]
    for pair in zip(*summaries, strict=True):
        at = f"at {pair[0].speed:.3g} m/s"
        rows.append(_row(f"largest roll [deg], {at}", [one.worst_roll for one in pair]))
        rows.append((f"  where, {at}", _where(pair[0]), _where(pair[1]), ""))
        rows.append(_row(f"unstable cells [%], {at}", [100 * one.unstable_share for one in pair]))
        if any(one.capsize_on_the_way for one in pair):
            rows.append(
                _row(f"capsizes on the way [%], {at}", [100 * one.capsize_on_the_way / one.cells for one in pair])
            )
        if any(one.no_answer for one in pair):
            rows.append(_row(f"no answer [%], {at}", [100 * sum(one.no_answer.values()) / one.cells for one in pair]))
        course = [float(one.calm_water.real.max()) for one in pair]
        rows.append(_row(f"calm-water exponent [1/s], {at}", course))
    return rows


def _row(words: str, values: Sequence[float]) -> tuple[str, str, str, str]:
    first, second = values
    more = second - first
    change = f"{more:+.0f}" if abs(more) >= _HUNDREDS else f"{more:+.3g}" if abs(more) > 1e-9 else "0"
    return words, _figures(first), _figures(second), change


def _figures(value: float) -> str:
    """Four figures, and thousands in full."""
    return f"{value:.0f}" if abs(value) >= _THOUSANDS else f"{value:.4g}"


def _where(one: Summary) -> str:
    return f"{one.heading:g} deg, {one.wave_length:.4g} m" if math.isfinite(one.heading) else "no answer"
