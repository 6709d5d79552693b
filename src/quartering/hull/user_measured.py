"""Reference to a user's measured manoeuvring set: path and digest of its content."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from quartering.option_checks import Refused, quoted

LIBRARY: Final = Path(__file__).parents[1] / "hydro" / "library"


@dataclass(frozen=True)
class MeasuredFile:
    """A user's own measured set.

    Parameters
    ----------
    source : str    path of the YAML file
    digest : str    of the content: two sets are the same when it is
    """

    source: str
    digest: str


def measured_source(named: str | Path) -> str | MeasuredFile:
    """A measured set as a ship keeps it: a file with the digest of what it holds now, or the name of a built-in set.

    named: path of a file; anything else counts as a name

    >>> measured_source("son-nomoto-1982")
    'son-nomoto-1982'
    """
    if isinstance(named, (str, Path)) and Path(named).is_file():
        return MeasuredFile(str(Path(named).absolute()), file_digest(Path(named)))
    if str(named) not in available_sets():
        given = str(named) if isinstance(named, (str, Path)) else named
        raise Refused("measured", f"measured = {quoted(given)}; it is a file, or one of {', '.join(available_sets())}")
    return str(named)


def available_sets() -> tuple[str, ...]:
    """Names of the built-in measured sets."""
    return tuple(sorted(path.stem for path in LIBRARY.glob("*.yaml")))


def file_digest(path: str | Path) -> str:
    """Digest of what a file holds.

    Returns 32 hexadecimal digits
    """
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()[:32]
