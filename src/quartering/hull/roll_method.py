"""Roll-damping option of a ship: fraction of critical damping, or a method with its bilge keels."""

from __future__ import annotations

from quartering.option_checks import Refused
from quartering.options import OPTIONS

RollMethod = str
"""Where added roll damping comes from: "fraction" (of critical), or a word of the option `roll_damping`."""

BilgeKeels = tuple[float, float]
_WORDS = OPTIONS["roll_damping"].words or {}
_WIDEST = 0.25


def roll_method(roll_damping: float | str) -> RollMethod:
    """The method a given roll damping names; a number is a fraction of critical.

    roll_damping: 0.05, "5 %", "ikeda" or "ikeda-simplified", which the table of options allows
    """
    word = roll_damping.strip() if isinstance(roll_damping, str) else ""
    return word if word in _WORDS else "fraction"


def roll_damping_note(method: RollMethod, keels: BilgeKeels | None) -> str:
    """Where the roll damping of a component method comes from.

    method: "ikeda" or "ikeda-simplified"
    keels (float, float): length and breadth of one bilge keel [m]

    Source: the methods' own papers, [Himeno81] and [Kawahara09].

    >>> roll_damping_note("ikeda", (30.0, 0.4))
    'estimated: component method of Ikeda on the lines, bilge keels 30 x 0.4 m'
    """
    fitted = "no bilge keels" if keels is None else f"bilge keels {keels[0]:.4g} x {keels[1]:.4g} m"
    return f"estimated: {_WORDS[method]}, {fitted}"


def checked_bilge_keels(where: str, length: float, beam: float, keels: BilgeKeels) -> BilgeKeels | None:
    """Bilge keels of a ship, refused when their size cannot be right.

    where: ship or file named in the message
    length, beam: of the ship [m]
    keels (float, float): length and breadth of one of the pair [m]; 0 for none

    Source: [Ikeda78c] for the keels meant.

    >>> checked_bilge_keels("my ship", 120.0, 16.0, (30.0, 0.4))
    (30.0, 0.4)
    """
    if 0.0 in keels:
        return None
    if not (0 < keels[0] <= length and 0 < keels[1] <= _WIDEST * beam):
        raise Refused(
            "bilge_keels",
            f"bilge_keels, length {keels[0]:g} m and breadth {keels[1]:g} m; the length is above 0 and within the "
            f"ship's {length:g} m, the breadth above 0 and below B/4; try {0.25 * length:.3g} m and {0.02 * beam:.2g} m",
            where,
        )
    return keels
