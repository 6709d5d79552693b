"""Reference to a user's hydrodynamic database: path, reading options, digest of its content."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from quartering.conventions import InputError
from quartering.option_checks import Refused, quoted
from quartering.options import unknown
from quartering.units import quantity

DATABASE_IS: Final = "it is a path of a Capytaine netCDF (.nc) or of WAMIT's .1"


@dataclass(frozen=True)
class Database:
    """A user's own coefficients and wave forces, in place of strip theory.

    Parameters
    ----------
    source : str                path of a Capytaine netCDF (.nc), or of WAMIT's .1 (its .3 beside it)
    digest : str                of the content: two databases are the same when it is
    midship : float             x of midship in the file's axes [m]
    moments_about : (x, z)      point of the moments in the file's axes [m]; None: what the file says, else midship at z = 0
    length : float              ULEN, of WAMIT files [m]
    """

    source: str
    digest: str
    midship: float = 0.0
    moments_about: tuple[float, float] | None = None
    length: float = 1.0

    @property
    def capytaine(self) -> bool:
        """Is it a Capytaine netCDF?"""
        return self.source.endswith(".nc")

    @property
    def reference(self) -> str:
        """Key of the paper that defines the file."""
        return "Ancellin19" if self.capytaine else "WAMIT"

    @property
    def name(self) -> str:
        """The file and its kind in words."""
        return f"database {Path(self.source).name} ({'Capytaine' if self.capytaine else 'WAMIT'})"


def database_of(
    path: str | Path,
    where: str,
    *,
    midship: float = 0.0,
    moments_about: tuple[float, float] | None = None,
    length: float = 1.0,
    said: str = "",
) -> Database:
    """The database in a file, with the digest of what it holds now.

    path: .nc of Capytaine, or .1 of WAMIT
    where: ship or file named in the message
    midship: x of midship in the file's axes [m]
    moments_about (x, z): point of the moments in the file's axes [m]
    length: ULEN, of WAMIT files [m]
    said: the path as it was written, for the message
    """
    file = Path(path)
    words = f"database = {quoted(str(said or path))}"
    if file.suffix not in (".nc", ".1"):
        raise Refused("database", f"{words}; {DATABASE_IS}", where)
    if not file.is_file():
        raise Refused("database", f"{words}; there is no such file; {DATABASE_IS}", where)
    if not length > 0:
        raise Refused(
            "database", f"database, length = {length:g} m; WAMIT's ULEN is above 0; leave it out for 1", where
        )
    return Database(str(file.absolute()), content_digest(file), midship, moments_about, length)


def database_of_keys(given: Mapping[str, Any], where: str) -> Database:
    """The database of a mapping with the keys a ship file has.

    >>> database_of_keys({"fille": "my.nc"}, "my ship")
    Traceback (most recent call last):
    ...
    quartering.option_checks.Refused: my ship: database: fille is unknown; did you mean file?
    """
    keys = ("file", "midship", "moments_about", "length")
    for key in given:
        if key not in keys:
            raise Refused("database", f"database: {unknown(str(key), keys).words}", where)
    if not isinstance(given.get("file"), (str, Path)):
        raise Refused("database", f"database = {quoted(given)}; {DATABASE_IS}", where)
    point = given.get("moments_about")
    try:
        midship, length = (
            quantity(given.get(key, usual), "length", what=key) for key, usual in (("midship", 0.0), ("length", 1.0))
        )
        about = None if point is None else (quantity(point[0], "length"), quantity(point[1], "length"))
    except (InputError, TypeError, IndexError, KeyError) as error:
        raise Refused("database", f"database = {quoted(given)}; {error}", where) from None
    return database_of(given["file"], where, midship=midship, moments_about=about, length=length)


def content_digest(path: str | Path) -> str:
    """Digest of what a database's file, or its two files, hold.

    path: .nc, or .1 with or without a .3 beside it
    Returns 32 hexadecimal digits
    """
    file, digest = Path(path), hashlib.sha256()
    beside = file.with_suffix(".3")
    for one in [file, beside] if file.suffix == ".1" and beside.is_file() else [file]:
        digest.update(one.read_bytes())
    return digest.hexdigest()[:32]
