"""The file of hydrodynamic results a ship brings: where it is, what it needs to be read, and a digest of its content."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

from quartering.conventions import InputError


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
) -> Database:
    """The database in a file, with the digest of what it holds now.

    Parameters
    ----------
    path : str or Path          .nc of Capytaine, or .1 of WAMIT
    where : str                 ship or file named in the message
    midship : float             x of midship in the file's axes [m]
    moments_about : (x, z)      point of the moments in the file's axes [m]
    length : float              ULEN, of WAMIT files [m]

    Returns
    -------
    Database

    Raises
    ------
    InputError    no such file, another kind of file, or a length not above 0

    Notes
    -----
    Source: the formats of [Ancellin19] and [WAMIT].

    Examples
    --------
    >>> database_of("none.nc", "my ship")
    Traceback (most recent call last):
    ...
    quartering.conventions.InputError: my ship: database none.nc is not there; give a path seen from the ship file
    """
    file = Path(path)
    if file.suffix not in (".nc", ".1"):
        raise InputError(
            f"{where}: database {file.name} is of no known kind; give a Capytaine netCDF (.nc) or the .1 file of WAMIT"
        )
    if not file.is_file():
        raise InputError(f"{where}: database {path} is not there; give a path seen from the ship file")
    if not length > 0:
        raise InputError(f"{where}: database, length = {length:g} m; WAMIT's ULEN is above 0; leave it out for 1")
    return Database(str(file.absolute()), content_digest(file), midship, moments_about, length)


def content_digest(path: str | Path) -> str:
    """Digest of what a database's file, or its two files, hold.

    Parameters
    ----------
    path : str or Path    .nc, or .1 with or without a .3 beside it

    Returns
    -------
    str                   32 hexadecimal digits

    Notes
    -----
    Source: none; a digest.
    """
    file, digest = Path(path), hashlib.sha256()
    beside = file.with_suffix(".3")
    for one in [file, beside] if file.suffix == ".1" and beside.is_file() else [file]:
        digest.update(one.read_bytes())
    return digest.hexdigest()[:32]
