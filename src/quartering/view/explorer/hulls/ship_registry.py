"""The ships a server knows: the built-in ones, the one it was started with, and hulls brought by visitors."""

from __future__ import annotations

import re
import threading
from collections import OrderedDict
from collections.abc import Mapping
from dataclasses import dataclass, field

from quartering.conventions import InputError
from quartering.hull.file.built_in import available_ships
from quartering.hull.file.read import ship
from quartering.hull.ship import Ship

MOST_UPLOADS = 64
"""Uploaded hulls kept; the one unused for longest goes first."""


@dataclass(frozen=True, eq=False)
class Known:
    """A ship the server knows.

    Parameters
    ----------
    key : str                   what links and calls name it by
    label : str                 what people read
    ship : Ship
    files : mapping             name -> content of the files it was made of, for an upload
    """

    key: str
    label: str
    ship: Ship
    files: Mapping[str, bytes] = field(default_factory=dict)


class ShipRegistry:
    """Ships by key. A key never is a path: nobody opens a file of the server by naming it, or learns where it stands.

    Parameters
    ----------
    given : str or None    ship file or built-in ship the server was started with; `first` is its key

    Examples
    --------
    >>> ShipRegistry().known("wigley").ship.name
    'Wigley hull'
    """

    def __init__(self, given: str | None = None) -> None:
        self._names = [entry.name for entry in available_ships()]
        own = given if given is not None and given not in self._names else None
        self._given = None if own is None else _key(own, self._names)
        if own is not None and self._given is not None:
            self._own = Known(self._given, self._given, ship(own))
        self.first: str | None = given if own is None else self._given
        self._uploads: OrderedDict[str, Known] = OrderedDict()
        self._lock = threading.Lock()

    def check(self, key: str) -> None:
        """Refuse a key that is none of this server's; the ship itself is not read."""
        if key not in self._names:
            self.known(key)

    def known(self, key: str) -> Known:
        """A ship by its key."""
        if key == self._given:
            return self._own
        if key in self._names:
            return Known(key, key, ship(key))
        with self._lock:
            if key in self._uploads:
                self._uploads.move_to_end(key)
                return self._uploads[key]
        if key.startswith("upload-"):
            raise InputError(
                "this server does not hold the hull of this link (any more); upload the same file with the same dimensions"
                " and the link works again"
            )
        raise InputError(f'ship "{key[:80]}" is unknown here; known are {", ".join(self.options())}')

    def options(self) -> dict[str, str]:
        """Key -> label of the ships everybody may choose."""
        own = {self._given: self._given} if self._given else {}
        return own | {name: name for name in self._names}

    def keep(self, found: Known) -> None:
        """Hold an uploaded hull; links name it by the digest of its content."""
        with self._lock:
            self._uploads[found.key] = found
            self._uploads.move_to_end(found.key)
            while len(self._uploads) > MOST_UPLOADS:
                self._uploads.popitem(last=False)


def _key(path: str, taken: list[str]) -> str:
    """Name of a ship file for those who do not know this machine: that of the file, without its place."""
    name = re.split(r"[/\\]", path)[-1]
    return f"own-{name}" if name in taken else name
