"""What of a page's state, and of a call, says which irregular sea is meant: fields in the words and ranges of the one table."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final, Literal

from quartering.arguments import ARGUMENTS
from quartering.conventions import InputError
from quartering.hull.told import number
from quartering.loads.sea.sea import Sea
from quartering.loads.sea.spreading import Spreading, checked_spreading
from quartering.option_checks import checked

if TYPE_CHECKING:
    from quartering.view.explorer.state import State

Mode = Literal["wave", "sea"]
"""What a page is about: a regular wave, or an irregular sea."""
PERIODS: Final = ("tp", "tz")
NO_SEA: Final[dict[str, Any]] = {
    "mode": "wave", "hs": None, "tp": None, "tz": None, "spectrum": "jonswap", "spreading": "none"
}  # fmt: skip
"""What a state has where no sea is chosen."""
SPECTRA: Final[dict[str, str]] = {
    "jonswap": "JONSWAP, γ 3.3", "bretschneider": "Bretschneider", "pierson-moskowitz": "Pierson-Moskowitz",
    "torsethaugen": "Torsethaugen, two peaks",
}  # fmt: skip
"""Spectra of a page, in words."""
LONG_CRESTED: Final = "none"
SPREADINGS: Final[dict[str, str]] = {
    LONG_CRESTED: "long-crested", "cos2": "cos², ±90°", "2": "spread, s = 2 (wide)", "5": "spread, s = 5",
    "10": "spread, s = 10", "25": "spread, s = 25 (swell)",
}  # fmt: skip
"""Spreadings that a page offers, in words."""
SPREADING_WORDS: Final = "s of cos^2s of half the angle, cos2, or none for a long-crested sea"
_HIGHEST, _OF_LENGTH, _PERIOD = 6.0, 30.0, 5.0
"""Where nothing is said: Hs a thirtieth of the ship's length, 6 m at most, and Tp 5 sqrt(Hs), a steepness of 0.042."""


def checked_sea(given: Any) -> Any:
    """Refuse numbers that no sea has, in the words of the table."""
    if not isinstance(given, Mapping):
        return given
    for name in ("hs", *PERIODS):
        if given.get(name) is not None:
            checked(ARGUMENTS[name], given[name])
    if given.get("tp") is not None and given.get("tz") is not None:
        raise ValueError("tp and tz are both given; one follows from the other, leave one out")
    told_spreading(given.get("spreading"))
    return given


def told_spreading(given: Any) -> Spreading:
    """A spreading as a link or a call has it, for `Sea`."""
    if given is None or given == LONG_CRESTED:
        return None
    try:
        return checked_spreading(float(given) if isinstance(given, str) and given != "cos2" else given)
    except InputError:
        raise
    except ValueError:
        raise InputError(f"spreading = {given[:40]!r}; it is {SPREADING_WORDS}; try 10") from None


def told_of(state: State, length: float) -> dict[str, float]:
    """Height [m] and period [s], "tp" or "tz", of a state, for a ship of a length [m]; what is not said is chosen."""
    hs = min(length / _OF_LENGTH, _HIGHEST) if state.hs is None else number(None, "hs", state.hs)
    if state.tz is not None:
        return {"hs": hs, "tz": number(None, "tz", state.tz)}
    return {"hs": hs, "tp": _PERIOD * math.sqrt(hs) if state.tp is None else number(None, "tp", state.tp)}


def sea_of(state: State, told: Mapping[str, float]) -> Sea:
    """The sea of a state with its height and period."""
    return Sea(**told, spectrum=state.spectrum, heading=state.heading, spreading=told_spreading(state.spreading))  # type: ignore[arg-type]  # hs and one period
