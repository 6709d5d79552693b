"""Which words name a coefficient, so that a misspelt one is caught where it is typed."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from difflib import get_close_matches
from numbers import Real
from typing import Final

from quartering.conventions import CUBIC_MONOMIALS, InputError

_TAILS: Final = (
    *"vpr", "vdot", "pdot", "rdot", "phi", "phiphiphi", "phi5", "phi7", *CUBIC_MONOMIALS,
    "v|v|", "v|r|", "r|v|", "r|r|", "p|p|", "vvphi", "vphiphi", "rrphi", "rphiphi",
)  # fmt: skip
KNOWN: Final = (*(f"{row}_{tail}" for row in "YKN" for tail in _TAILS), "m", "I_x", "I_z", "I_xz")
_FORM: Final = re.compile(r"[YKN]_(?:[vpr]dot|(?:phi[2-9]?|[vpr]|\|[vpr]\|)+)")


def check_coefficient_name(where: str, name: str) -> None:
    """Refuse a word that is not the name of a coefficient.

    Parameters
    ----------
    where : str    ship or file named in the message
    name : str     such as "K_ppp", "Y_v", "N_rdot", "K_vvphi", "K_p|p|"

    Raises
    ------
    InputError    unknown name; the message gives the nearest known one

    Notes
    -----
    Source: [Abkowitz64] notation.

    Examples
    --------
    >>> check_coefficient_name("my ship", "K_ppp")
    """
    if name in KNOWN or _FORM.fullmatch(name):
        return
    near = get_close_matches(name, KNOWN, n=1, cutoff=0.3)
    hint = f'; the nearest known name is "{near[0]}"' if near else ""
    raise InputError(
        f'{where}: coefficient "{name}" is unknown{hint}; a name is Y, K or N, "_", and factors v, p, r, phi '
        '(or vdot, pdot, rdot), such as "Y_v", "N_rdot", "K_ppp"'
    )


def checked_factors(name: str, factors: Mapping[str, float]) -> dict[str, float]:
    """Coefficient values by name, refused when a name is unknown or a value is not a finite number.

    Parameters
    ----------
    name : str                              ship or file named in the message
    factors : mapping of str to float       values by SNAME name

    Returns
    -------
    dict of str to float

    Raises
    ------
    InputError    unknown name, or a value that is not a finite number

    Notes
    -----
    Source: [Abkowitz64] notation.

    Examples
    --------
    >>> checked_factors("my ship", {"K_ppp": 2})
    {'K_ppp': 2.0}
    """
    for key, factor in factors.items():
        value: object = factor
        check_coefficient_name(name, key)
        if isinstance(value, bool) or not isinstance(value, Real) or not math.isfinite(value):
            raise InputError(f"{name}: {key} = {value!r}; a coefficient needs a finite number, such as 1.0")
    return {key: float(value) for key, value in factors.items()}
