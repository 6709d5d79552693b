"""Wave forces of a ship's own database beside those of strips on its lines: size, and phases by mode."""

from __future__ import annotations

import warnings
from functools import lru_cache
from typing import Final

import numpy as np

from quartering.conventions import GRAVITY, MODES, RangeWarning
from quartering.hull.lines.hull import Hull
from quartering.hull.lines.immersed import strips
from quartering.hull.lines.strips import has_transom
from quartering.hull.user_database import Database
from quartering.hydro.source.record import AtRest, Hydrodynamics, Phasors
from quartering.hydro.strip.moments import section_table
from quartering.loads.strips.stations import Stations
from quartering.loads.strips.strip_forces import wave_force_phasors
from quartering.loads.waves import Floats

SIZE: Final = (0.6, 1.7)
"""Sway force over that of strip theory on the ship's lines; 3-D and strips differ by less [1]."""
APART: Final = 0.5
"""Mean cosine of the phases between a database and strips below which they differ: 60 deg [1]."""
EXPLAINED: Final = 0.9
"""Mean cosine from which on another sign explains a database, if it does so better by `BETTER` [1]."""
BETTER: Final = 0.08
LARGE: Final = 0.2
"""Forces that are compared, of the largest of their mode [1]."""
LEVER: Final = 0.03
"""Smallest roll moment compared, of the sway force times the draught: the rest of two that cancel has no phase [1]."""
_FEWEST: Final = 4
_LENGTHS: Final = (0.7, 1.0, 1.4, 2.0, 3.0, 5.0, 8.0)
_HEADINGS: Final = (30.0, 60.0, 90.0, 120.0, 150.0)


def warn_of_forces(source: Hydrodynamics) -> None:
    """One warning for a database and hull of wave forces whose size or phases are not those of strips.

    source: with forces at zero speed; others than databases are passed over
    """
    database = source.ship.database
    if source.kind != "database" or database is None:
        return
    found = _findings(source.ship.hull, database, source.ship.loading.density, _OfHull(source))
    if found and not found.told:
        found.told = True
        warnings.warn(f"{database.name}: {'; '.join(found)}", RangeWarning, stacklevel=5)


class _OfHull:
    """A source that stands for all with its hull and database in the eyes of a cache."""

    def __init__(self, source: Hydrodynamics) -> None:
        self.source = source

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _OfHull)

    def __hash__(self) -> int:
        return 0


class _Told(list[str]):
    told = False


@lru_cache(maxsize=8)
def _findings(hull: Hull, database: Database, density: float, of: _OfHull) -> _Told:
    source = of.source
    (low, high), headings = source.held.frequency, source.held.heading
    sigma = np.sqrt(GRAVITY * 2 * np.pi / (hull.length * np.array(_LENGTHS)))
    sigma = sigma[(sigma >= low) & (sigma <= high)]
    mu = np.array([one for one in _HEADINGS if headings is not None and headings[0] <= one <= headings[1]])
    if source.at_rest is None or not sigma.size or not mu.size:
        return _Told()
    w, m = (v.ravel() for v in np.meshgrid(sigma, mu))
    x_mid = np.exp(1j * w**2 / GRAVITY * database.midship * np.cos(np.radians(m)))
    theirs, ours = source.at_rest(w, m), _by_strips(hull, density, w, m)
    return _Told([*_size_findings(theirs, ours), *phase_findings(theirs, ours, hull.draught, turn=x_mid)])


def _by_strips(hull: Hull, density: float, sigma: Floats, mu: Floats) -> AtRest:
    """Froude-Krylov force and diffraction by strips about midship at the calm plane, at zero speed."""
    s = strips(hull)
    place = Stations(s.x, s.weight, 0.0, hull.x_aft, has_transom(s))
    table = section_table(hull, density)
    pressure, scattered, _ = wave_force_phasors(s, place, table, sigma**2 / GRAVITY, 0.0, mu, density=density)
    return {"froude_krylov": pressure, "diffraction": scattered}


def phase_findings(theirs: AtRest, of_strips: AtRest, draught: float, turn: Phasors | float = 1.0) -> list[str]:
    """What tells that the phases of a database's forces have another sign than those of its ship.

    theirs: "froude_krylov" and "diffraction", or "total": (n, 3) phasors in sway, roll, yaw about midship at the calm
        plane
    of_strips: "froude_krylov" and "diffraction" of the same waves
    draught: [m]
    turn (n,): e^{i k x cos mu} with x of midship in the file's axes, from whose origin its phases count
    Returns nothing, or the modes and parts, the mean difference of the phases, and the sign that would explain it

    The phases of forces that are not small are compared by the mean of cos(difference), each weighted by both amplitudes. Over
    the ships of the library and panels it is 0.83 or more (0.97 or more for the sum); with imaginary parts of the other sign -1
    to 0.6 in roll. In yaw the force is nearly real about midship, so that the other sign leaves 0.7 to 0.9: it is told where
    it explains the forces better. A phasor F of a file turns into -turn^2 F* about midship if the file has the other sign.
    Valid: waves of 0.7 L and more.  Source: strip theory of [STF70]; the thresholds are this library's.

    >>> ours = np.exp(1j * np.linspace(0.0, 1.0, 8))[:, None] * np.array([1.0, 2.0, 9.0])
    >>> phase_findings({"total": ours}, {"froude_krylov": ours}, 4.0)
    []
    >>> phase_findings({"total": ours * np.array([1.0, -1.0, 1.0])}, {"froude_krylov": ours}, 4.0)[0][:58]
    'the phases of its forces in roll (total, 180 deg) differ f'
    """
    whole = {**of_strips, "total": sum(of_strips.values(), np.zeros(1, dtype=complex))}
    causes: dict[str, list[str]] = {}
    for part, force in theirs.items():
        for mode, name in enumerate(MODES[: force.shape[-1]]):
            if name == "roll" and _size(whole[part], 1) < LEVER * draught * _size(whole[part], 0):
                continue
            cosine, others = _cosines(force[:, mode], whole[part][:, mode], turn)
            if cosine is None:
                continue
            best = max(others, key=lambda cause: others[cause])
            explained = others[best] > max(EXPLAINED, cosine + BETTER)
            if cosine < APART or explained:
                differ = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
                words = f"{name} ({part.replace('froude_krylov', 'Froude-Krylov')}, {differ:.0f} deg)"
                causes.setdefault(best if explained else "", []).append(words)
    return [
        f"the phases of its forces in {', '.join(forces)} differ from those of strip theory on the ship's lines"
        + (f", and agree with {cause}" if cause else "")
        for cause, forces in causes.items()
    ]


def _size_findings(theirs: AtRest, of_strips: AtRest) -> list[str]:
    """Sway forces whose sum over the waves compared is far from that of strips."""
    whole = {**of_strips, "total": sum(of_strips.values(), np.zeros(1, dtype=complex))}
    ratios = {
        part: float(np.abs(force[:, 0]).sum() / np.abs(whole[part][:, 0]).sum()) for part, force in theirs.items()
    }
    unlike = [
        f"{ratio:.2g} times ({part.replace('froude_krylov', 'Froude-Krylov')})"
        for part, ratio in ratios.items()
        if not SIZE[0] < ratio < SIZE[1]
    ]
    if not unlike:
        return []
    return [
        f"its sway force is {' and '.join(unlike)} that of strip theory on the ship's lines: another ship, draught or scale, "
        "forces of another amplitude, or frequencies in Hz"
    ]


def _size(force: Phasors, mode: int) -> float:
    return float(np.abs(force[:, mode]).max())


def _cosines(theirs: Phasors, ours: Phasors, turn: Phasors | float) -> tuple[float | None, dict[str, float]]:
    """Mean cosine of the phases as they are, None where too few are large; and as they were with other signs."""
    large = (np.abs(theirs) > LARGE * np.abs(theirs).max()) & (np.abs(ours) > LARGE * np.abs(ours).max())
    if large.sum() < _FEWEST:
        return None, {}
    weight = float((np.abs(ours) * np.abs(theirs))[large].sum())
    here, mirrored = (
        float((np.conj(ours) * one)[large].real.sum()) / weight for one in (theirs, -(turn**2) * np.conj(theirs))
    )
    return here, {
        "the other sign of their imaginary parts": mirrored,
        "the other sign of these forces": -here,
        "the other sign of their real parts": -mirrored,
    }
