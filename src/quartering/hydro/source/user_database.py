"""User database as a source of hydrodynamics: longitudinal moments over frequency, forces over heading."""

from __future__ import annotations

import warnings
from functools import lru_cache, partial
from pathlib import Path
from typing import NamedTuple

from quartering.conventions import InputError, RangeWarning
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.hull import Hull
from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hull.user_database import Database, content_digest
from quartering.hydro.database.about_point import AboutPoint, moved_to_point
from quartering.hydro.database.capytaine import read_capytaine_file
from quartering.hydro.database.check import soundness, strip_agreement
from quartering.hydro.database.raw import RawDatabase
from quartering.hydro.database.wamit import read_wamit_files
from quartering.hydro.source.interpolated import FEWEST_HEADINGS, Surfaces, force_surfaces, tabled_moments
from quartering.hydro.source.record import AtRest, Held, Hydrodynamics
from quartering.hydro.strip.integrals import moment_matrix
from quartering.hydro.strip.moments import HullMoments, Moments, hull_moments

FEWEST = 4


class OwnDatabase(NamedTuple):
    """A ship's own database about midship at the calm plane, per unit density ratio of the ship's water.

    Parameters
    ----------
    frequency : (f,) float    of the wave, ascending [rad/s]
    at : AboutPoint               matrices and forces, of the density asked for
    """

    frequency: Floats
    at: AboutPoint


@lru_cache(maxsize=8)
def user_database(database: Database, density: float) -> OwnDatabase:
    """Read a ship's own database, once for a content.

    density: of the ship's water; all of the file goes with it [kg/m3]

    Source: [Ancellin19], [WAMIT].  Valid: zero speed, deep water, one body symmetric port and starboard.
    """
    raw = _raw(database, density)
    if raw.frequency.size < FEWEST:
        raise InputError(
            f"{database.source}: {raw.frequency.size} frequencies are too few to interpolate between; give at least {FEWEST}"
        )
    about = database.moments_about or raw.centre or (database.midship, 0.0)
    found, ratio = moved_to_point(raw, (database.midship, 0.0), about), density / raw.density
    return OwnDatabase(
        raw.frequency,
        AboutPoint(
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


def database_source(ship: Ship) -> Hydrodynamics:
    """Hydrodynamics of a ship from its own database.

    ship: with a database
    Returns at zero speed, between the frequencies and headings of the file; forces in sway, roll, yaw

    Source: [STF70] integrals over the length; the database's matrices are those integrals without strips.

    See `quartering.hydro.source.of_ship.source_of`.
    """
    database, density = ship.database, ship.loading.density
    if database is None:
        raise InputError(f"{ship.name} has no database of its own; give one (database=), or take 'strips'")
    own = user_database(database, density)
    heading = own.at.heading
    centre = hydrostatics(ship).lcb, ship.loading.kg - ship.hull.draught

    def radiation() -> HullMoments:
        _warn_of_findings(ship.hull, database, density)
        return _database_moments(database, density)

    def solved(frequency: Floats) -> Moments:
        return radiation().at(frequency).about(*centre)

    return Hydrodynamics(
        ship=ship,
        kind="database",
        words=database.name,
        method=f"{database.name}, zero speed; speed terms of strip theory without those of the aft end",
        references=(database.reference,),
        force_words=f"{database.name}, zero speed, with speed terms of strip theory",
        force_references=("STF70", database.reference),
        centre=centre,
        radiation=radiation,
        solved=solved,
        held=Held(
            (float(own.frequency[0]), float(own.frequency[-1])),
            "zero" in own.at.limits,
            (float(heading[0]), float(heading[-1])) if heading.size else None,
        ),
        at_rest=partial(_at_rest, database, density),
    )


def _at_rest(database: Database, density: float, frequency: Floats, heading: Floats) -> AtRest:
    return {one.name: one.at(frequency, heading) for one in _surfaces(database, density)}


@lru_cache(maxsize=8)
def _warn_of_findings(hull: Hull, database: Database, density: float) -> None:
    """One warning, when a database is first used for a hull, of what is wrong with it or does not fit the ship."""
    own = user_database(database, density)
    middle = own.frequency.size // 2
    by_strips = moment_matrix(hull_moments(hull, density).at(own.frequency[middle]).a)
    found = soundness(own.frequency, own.at.added_mass, own.at.damping)
    found += strip_agreement(own.at.added_mass[middle], by_strips, hull.draught)
    if found:
        warnings.warn(f"{database.name}: {'; '.join(found)}", RangeWarning, stacklevel=4)


@lru_cache(maxsize=8)
def _database_moments(database: Database, density: float) -> HullMoments:
    """The added mass at zero frequency is the file's limit, else held."""
    own = user_database(database, density)
    return tabled_moments(own.frequency, own.at.added_mass, own.at.damping, own.at.limits.get("zero"))


@lru_cache(maxsize=8)
def _surfaces(database: Database, density: float) -> tuple[Surfaces, ...]:
    """Splines of every force of a database."""
    own = user_database(database, density)
    if not own.at.forces:
        raise InputError(
            f"{database.source} holds no wave forces; add the forces of every heading wanted (Capytaine: Froude-Krylov and "
            "diffraction; WAMIT: the .3 file)"
        )
    if own.at.heading.size < FEWEST_HEADINGS:
        raise InputError(
            f"{database.source}: {own.at.heading.size} headings are too few to interpolate between; give at least "
            f"{FEWEST_HEADINGS}, closer than 15 deg for good forces"
        )
    return force_surfaces(own.frequency, own.at.heading, own.at.forces)
