"""The choices a ship is given by a word, each refused when the word is none of those allowed."""

from __future__ import annotations

from difflib import get_close_matches
from typing import Literal, cast, get_args

from quartering.conventions import InputError

Linear = Literal["default", "strip"]
Righting = Literal["polynomial", "spline"]
Velocities = Literal["relative", "absolute"]
"""What lift acts on: the velocity relative to the water the wave moves, or the ship's own, as in the paper."""
Sections = Literal["auto", "lewis", "close-fit"]
"""How the section problem is solved: on the section's own contour ("auto", "close-fit") or on its Lewis form."""
Ends = Literal["strips", "three-dimensional"]


def checked_linear(name: str, linear: str) -> Linear:
    """The choice of linear derivatives.

    Parameters
    ----------
    name : str      ship or file named in the message
    linear : str    "default" or "strip"

    Returns
    -------
    str    the same

    Raises
    ------
    InputError    another word

    Notes
    -----
    Source: the format of the ship file.

    Examples
    --------
    >>> checked_linear("my ship", "strip")
    'strip'
    """
    if linear not in get_args(Linear):
        raise InputError(f'{name}: linear = "{linear}"; allowed are "default" (lift from regression) and "strip"')
    return cast(Linear, linear)


def checked_sections(name: str, sections: str) -> Sections:
    """The way section coefficients are found.

    Notes
    -----
    Source: [Lewis29], [Frank67]: the ways there are.
    """
    if sections not in get_args(Sections):
        raise InputError(f'{name}: sections = "{sections}"; allowed are {", ".join(get_args(Sections))}; try "auto"')
    return cast(Sections, sections)


def checked_righting(name: str, righting: str) -> Righting:
    """The form of the righting curve.

    Notes
    -----
    Source: the format of the ship file.
    """
    if righting not in get_args(Righting):
        raise InputError(f'{name}: righting = "{righting}"; allowed are "polynomial" (odd, to phi^7) and "spline"')
    return cast(Righting, righting)


def checked_velocities(name: str, velocities: str) -> Velocities:
    """The velocity that lift, and measured or given added mass, act on.

    Parameters
    ----------
    name : str          ship or file named in the message
    velocities : str    "relative" or "absolute"

    Returns
    -------
    str    the same

    Raises
    ------
    InputError    another word; the message has the nearest one

    Examples
    --------
    >>> checked_velocities("my ship", "absolute")
    'absolute'
    """
    if velocities not in get_args(Velocities):
        near = get_close_matches(str(velocities).lower(), get_args(Velocities), n=1, cutoff=0.0)[0]
        raise InputError(
            f'{name}: velocities = "{velocities}"; did you mean "{near}"? Allowed are "relative" (to the water, which the wave '
            'moves) and "absolute" (over ground, as in the paper)'
        )
    return cast(Velocities, velocities)


def checked_ends(name: str, ends: str, database: str | None = None) -> Ends:
    """The way the water at the ends of a hull is found; a ship with its own database has no choice.

    Parameters
    ----------
    name : str                ship or file named in the message
    ends : str                "strips" or "three-dimensional"
    database : str or None    what the ship's own database is called

    Returns
    -------
    str    the same

    Raises
    ------
    InputError    another word, or "three-dimensional" beside a database

    Notes
    -----
    Source: [Morino74], the ends.

    Examples
    --------
    >>> checked_ends("my ship", "round")
    Traceback (most recent call last):
    ...
    quartering.conventions.InputError: my ship: ends = "round"; allowed are strips, three-dimensional; try "strips"
    """
    if ends not in get_args(Ends):
        raise InputError(f'{name}: ends = "{ends}"; allowed are {", ".join(get_args(Ends))}; try "strips"')
    if ends == "three-dimensional" and database is not None:
        raise InputError(
            f'{name}: ends = "{ends}" corrects the strips, and {database} takes their place; leave one of the two out '
            "(ends: strips, or database: none)"
        )
    return cast(Ends, ends)
