"""The names of coefficients, and the units that follow from them.

A name is a row (Y sway, K roll, N yaw), an underscore and its factors: ``Y_v``, ``N_rdot``, ``K_vpp``, ``K_phiphiphi``,
``K_phi5`` (phi to the fifth), ``K_p|p|``. A cubic may be written in any order of its letters (``Y_vvr`` is ``Y_rvv``).
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from difflib import get_close_matches
from numbers import Real
from typing import Final, NamedTuple

from quartering.conventions import CUBIC_MONOMIALS, InputError, as_float

ROWS: Final = ("Y", "K", "N")
LINEAR_NAMES: Final = tuple(tuple(f"{row}_{factor}" for factor in "vpr") for row in ROWS)
INERTIA_NAMES: Final = tuple(tuple(f"{row}_{factor}dot" for factor in "vpr") for row in ROWS)
CUBIC_NAMES: Final = tuple(tuple(f"{row}_{monomial}" for monomial in CUBIC_MONOMIALS) for row in ROWS)
RUDDER_NAMES: Final = tuple(f"{row}_delta" for row in ROWS)
DRAG_NAME: Final = "C_D"
"""Drag coefficient of the sections, where the drag acts strip by strip and has no cubic coefficients."""
RESTORING_POWERS: Final = (1, 3, 5, 7)
RESTORING_NAMES: Final = tuple(tuple(f"{row}_{phi}" for phi in ("phi", "phiphiphi", "phi5", "phi7")) for row in ROWS)

_TAILS: Final = (
    *"vpr", "vdot", "pdot", "rdot", "phi", "phiphiphi", "phi5", "phi7", *CUBIC_MONOMIALS,
    "delta", "v|v|", "v|r|", "r|v|", "r|r|", "p|p|", "vvphi", "vphiphi", "rrphi", "rphiphi",
)  # fmt: skip
KNOWN: Final = (*(f"{row}_{tail}" for row in ROWS for tail in _TAILS), "m", "I_x", "I_z", "I_xz")
"""Names a misspelt one is compared with."""

_FACTOR: Final = re.compile(r"[vpr]dot|delta|phi[2-9]?|[vpr]")
_FACTORS: Final = re.compile(r"(?:[vpr]dot|delta|(?:phi[2-9]?|[vpr])+)")
_SORTED_CUBICS: Final = {"".join(sorted(monomial)): monomial for monomial in CUBIC_MONOMIALS}
_BODY: Final = {"m": ("Y", "vdot"), "I_x": ("K", "pdot"), "I_z": ("N", "rdot"), "I_xz": ("K", "rdot")}


class Term(NamedTuple):
    """A coefficient taken apart.

    Parameters
    ----------
    row : str        "Y", "K" or "N"
    factors : tuple  "v", "p", "r", "phi", "delta" (rudder angle), "vdot", "pdot" or "rdot", each as often as it stands
                     in the product
    """

    row: str
    factors: tuple[str, ...]


def term(name: str) -> Term:
    """Take a coefficient name apart.

    name: such as "Y_v", "K_vpp", "K_phi5", "N_rdot", "K_p|p|", or "m", "I_x", "I_z", "I_xz"
    Returns row and factors

    Source: [Abkowitz64] notation.
    """
    if name in _BODY:
        row, factor = _BODY[name]
        return Term(row, (factor,))
    row, _, tail = name.partition("_")
    bare = re.sub(r"\|([vpr]|phi)\|", r"\1", tail)
    if row not in ROWS or not _FACTORS.fullmatch(bare):
        near = get_close_matches(name, KNOWN, n=1, cutoff=0.3)
        hint = f'; the nearest known name is "{near[0]}"' if near else ""
        raise InputError(
            f'coefficient "{name}" is unknown{hint}; a name is Y, K or N, "_" and factors v, p, r, phi (or vdot, pdot, '
            'rdot): for instance "Y_v", "N_rdot", "K_ppp", "K_vvphi", "K_p|p|"'
        )
    factors: list[str] = []
    for token in _FACTOR.findall(bare):
        factors += ["phi"] * int(token[3:]) if token[:3] == "phi" and token[3:] else [token]
    return Term(row, tuple(factors))


def canonical(name: str) -> str:
    """The one spelling of a coefficient name under which the tables list it.

    name: any spelling `term` understands
    Returns cubic letters in the order of CUBIC_MONOMIALS, powers of phi as in RESTORING_NAMES; others unchanged

    Source: [H71] equation (2) for the order of the letters.
    """
    row, factors = term(name)
    if "|" in name or name in _BODY:
        return name
    if set(factors) == {"phi"} and len(factors) in RESTORING_POWERS:
        return RESTORING_NAMES[ROWS.index(row)][RESTORING_POWERS.index(len(factors))]
    return f"{row}_" + _SORTED_CUBICS.get("".join(sorted(factors)), name.partition("_")[2])


def dimension(name: str) -> tuple[int, int, int]:
    """Powers of kilogram, metre and second in the unit of a coefficient.

    name: any spelling `term` understands
    Returns (int, int, int): powers of kg, m and s

    Unit of the force or moment over the units of the factors.  Source: [Abkowitz64], the dimensional rule.
    """
    row, factors = term(name)
    metre = (1 if row == "Y" else 2) - sum(factor in ("v", "vdot") for factor in factors)
    second = -2 + sum({"phi": 0, "delta": 0, "v": 1, "p": 1, "r": 1}.get(factor, 2) for factor in factors)
    return 1, metre, second


def unit(name: str) -> str:
    """Unit of a coefficient, as printed.

    name: any spelling `term` understands
    Returns SI; radians are left out

    Source: [Abkowitz64], the dimensional rule.
    """
    if name == DRAG_NAME:
        return "1"
    powers = dict(zip(("kg", "m", "s"), dimension(name), strict=True))
    above = " ".join(f"{base}{power if power > 1 else ''}" for base, power in powers.items() if power > 0)
    below = " ".join(f"{base}{-power if power < -1 else ''}" for base, power in powers.items() if power < 0)
    return f"{above}/{below}" if below else above


def barred(name: str) -> tuple[str, ...]:
    """Factors that stand between modulus bars.

    name: any spelling `term` understands
    Returns such as ("p",) for "K_p|p|"

    Source: [Abkowitz64] notation, with the bars of later manoeuvring models.

    >>> barred("K_p|p|"), barred("K_ppp")
    (('p',), ())
    """
    return tuple(re.findall(r"\|([vpr]|phi)\|", name))


def checked_values(where: str, values: Mapping[str, float]) -> dict[str, float]:
    """Values by coefficient name, refused when a name is unknown or a value is not a finite number.

    where: ship or file named in the message
    values: by name

    Source: [Abkowitz64] notation.

    >>> checked_values("my ship", {"K_ppp": 2})
    {'K_ppp': 2.0}
    """
    for name, given in values.items():
        value: object = given
        try:
            term(name)
        except InputError as error:
            raise InputError(f"{where}: {error}") from None
        if isinstance(value, bool) or not isinstance(value, Real) or not math.isfinite(as_float(value)):
            raise InputError(f"{where}: {name} = {as_float(value)!r}; a coefficient needs a finite number, such as 1.0")
    return {name: float(value) for name, value in values.items()}
