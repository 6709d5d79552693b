"""Coefficients from a ship's own database, in the form strip theory has them: integrals over the length, by frequency."""

from __future__ import annotations

import warnings
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from quartering.conventions import GRAVITY, InputError, RangeWarning
from quartering.hull.offsets import Hull
from quartering.hull.own_database import Database, content_digest
from quartering.hull.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.capytaine_file import read_capytaine_file
from quartering.hydro.database_check import likeness, soundness
from quartering.hydro.integrals import moment_matrix
from quartering.hydro.moments import HullMoments, hull_moments
from quartering.hydro.placed import Placed, placed
from quartering.hydro.raw_database import RawDatabase
from quartering.hydro.wamit_file import read_wamit_files

LOWEST = 0.3
"""Lowest w sqrt(B/2g) a database without the limit at zero frequency must reach: there added mass is near that limit [1]."""
FEWEST = 4


class OwnDatabase(NamedTuple):
    """A ship's own database about midship at the calm plane, per unit density ratio of the ship's water.

    Parameters
    ----------
    frequency : (f,) float    of the wave, ascending [rad/s]
    at : Placed               matrices and forces, of the density asked for
    """

    frequency: Floats
    at: Placed


@lru_cache(maxsize=8)
def own_database(database: Database, density: float) -> OwnDatabase:
    """Read a ship's own database, once for a content.

    Parameters
    ----------
    database : Database
    density : float       of the ship's water; all of the file goes with it [kg/m3]

    Returns
    -------
    OwnDatabase

    Raises
    ------
    InputError    what the readers refuse, a file that has changed since the ship was read, or fewer than four frequencies

    Notes
    -----
    Source: [Ancellin19], [WAMIT].  Valid: zero speed, deep water, one body symmetric port and starboard.
    """
    raw = _raw(database, density)
    if raw.frequency.size < FEWEST:
        raise InputError(
            f"{database.source}: {raw.frequency.size} frequencies are too few to interpolate between; give at least {FEWEST}"
        )
    about = database.moments_about or raw.centre or (database.midship, 0.0)
    found, ratio = placed(raw, (database.midship, 0.0), about), density / raw.density
    return OwnDatabase(
        raw.frequency,
        Placed(
            found.added_mass * ratio,
            found.damping * ratio,
            {name: limit * ratio for name, limit in found.limits.items()},
            found.heading,
            {name: force * ratio for name, force in found.forces.items()},
        ),
    )


def _raw(database: Database, density: float) -> RawDatabase:
    if not Path(database.source).is_file() or content_digest(database.source) != database.digest:
        raise InputError(f"{database.source} has changed or gone since the ship was read; read the ship again")
    if database.capytaine:
        return read_capytaine_file(database.source)
    return read_wamit_files(Path(database.source).with_suffix(""), length=database.length, density=density)


def ship_moments(ship: Ship) -> HullMoments:
    """Integrals of added mass and damping of a ship: those of its sections, or of its own database.

    Parameters
    ----------
    ship : Ship

    Returns
    -------
    HullMoments    about the waterline amidships

    Raises
    ------
    InputError     what `own_database` refuses

    Warns
    -----
    RangeWarning   once for a database and hull: what `soundness` and `likeness` find

    Notes
    -----
    Source: [STF70] integrals over the length; the database's matrices are those integrals without strips.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> ship_moments(ship("wigley")).transom
    False
    """
    density = ship.loading.density
    if ship.database is None:
        return hull_moments(ship.hull, density)
    _warn_of_findings(ship.hull, ship.database, density)
    return _database_moments(ship.database, density)


@lru_cache(maxsize=8)
def _warn_of_findings(hull: Hull, database: Database, density: float) -> None:
    """One warning, when a database is first used for a hull, of what is wrong with it or does not fit the ship."""
    own = own_database(database, density)
    middle = own.frequency.size // 2
    by_strips = moment_matrix(hull_moments(hull, density).at(own.frequency[middle]).a)
    found = soundness(own.frequency, own.at.added_mass, own.at.damping)
    found += likeness(own.at.added_mass[middle], by_strips, hull.draught)
    if found:
        warnings.warn(f"{database.name}: {'; '.join(found)}", RangeWarning, stacklevel=4)


@lru_cache(maxsize=8)
def _database_moments(database: Database, density: float) -> HullMoments:
    """Spline from zero frequency, where the damping vanishes; the added mass there is the file's limit, else held."""
    own = own_database(database, density)
    slow = own.at.limits.get("zero", own.at.added_mass[0])
    a = _integrals(np.concatenate([slow[None], own.at.added_mass]))
    b = _integrals(np.concatenate([np.zeros((1, 3, 3)), own.at.damping]))
    frequency = np.concatenate([[0.0], own.frequency])
    none = np.zeros_like(a)
    spline = CubicSpline(frequency, np.stack([a, b, none, none], axis=1))
    return HullMoments(spline, float(frequency[-1]), transom=False)


def _integrals(matrix: Floats) -> Floats:
    """Integrals (n, 3, 3), power of x then [22, 24, 44], that have these sway-roll-yaw matrices; what none holds is 0."""
    m = (matrix + matrix.swapaxes(-1, -2)) / 2
    out = np.zeros_like(m)
    out[:, 0] = np.stack([m[:, 0, 0], m[:, 0, 1], m[:, 1, 1]], axis=-1)
    out[:, 1, :2] = np.stack([m[:, 0, 2], m[:, 1, 2]], axis=-1)
    out[:, 2, 0] = m[:, 2, 2]
    return out


def check_frequencies(ship: Ship, frequency: Floats) -> None:
    """Refuse frequencies a ship's own database does not hold.

    Parameters
    ----------
    ship : Ship
    frequency : (n,) float    of oscillation, >= 0 [rad/s]

    Raises
    ------
    InputError    above the highest; below the lowest when that is not low and the file has no limit at zero frequency

    Notes
    -----
    Source: none; a check.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> check_frequencies(ship("wigley"), np.array([0.0, 99.0]))  # strips hold every frequency
    """
    if ship.database is None or frequency.size == 0:
        return
    if frequencies_held(ship, frequency).all():
        return
    own = own_database(ship.database, ship.loading.density)
    low, high = own.frequency[0], own.frequency[-1]
    wanted = float(frequency.max())
    holds = f"{ship.name}: {ship.database.name} holds {low:.4g} to {high:.4g} rad/s"
    if wanted > high:
        raise InputError(
            f"{holds}, and {wanted:.4g} rad/s is asked for (encounter frequency, or that of roll); compute up to there, or ask "
            "for longer waves, less speed or other headings"
        )
    raise InputError(
        f"{holds}, and {float(frequency.min()):.4g} rad/s is asked for; low frequencies are needed for calm water and "
        f"quartering seas: compute from {_low_enough(ship):.2g} rad/s, or add the limit at zero frequency (WAMIT: period -1)"
    )


def frequencies_held(ship: Ship, frequency: Floats) -> NDArray[np.bool_]:
    """Which frequencies of oscillation a ship's own database holds; strips hold every one.

    Parameters
    ----------
    ship : Ship
    frequency : (n,) float    of oscillation, >= 0 [rad/s]

    Returns
    -------
    (n,) bool                 up to the highest; down to zero where the lowest is low or the file has the limit at zero

    Raises
    ------
    InputError                what `own_database` refuses

    Notes
    -----
    Source: none; a check.

    Examples
    --------
    >>> from quartering.hull.ship import ship
    >>> frequencies_held(ship("wigley"), np.array([0.0, 99.0])).tolist()
    [True, True]
    """
    if ship.database is None:
        return np.ones(frequency.shape, dtype=bool)
    own = own_database(ship.database, ship.loading.density)
    low, high = own.frequency[0], own.frequency[-1]
    to_zero = low <= _low_enough(ship) or "zero" in own.at.limits
    return np.asarray((frequency <= high * (1 + 1e-9)) & (to_zero | (frequency >= low)))


def _low_enough(ship: Ship) -> float:
    """Frequency below which added mass is near its limit at zero [rad/s]."""
    return float(LOWEST * np.sqrt(2 * GRAVITY / ship.hull.beam))
