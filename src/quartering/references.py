"""The papers this library rests on, by key, and which of them a result rests on."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Final

REFERENCES: Final[dict[str, str]] = {
    "H71": "Haddara, M. R. (1971). On the stability of ship motion in regular oblique waves.",
    "STF70": "Salvesen, N., Tuck, E. O., Faltinsen, O. (1970). Ship motions and sea loads. Trans. SNAME 78.",
    "Ursell49": "Ursell, F. (1949). On the heaving motion of a circular cylinder on the surface of a fluid. "
    "Quarterly Journal of Mechanics and Applied Mathematics 2.",
    "Tasai61": "Tasai, F. (1961). Hydrodynamic force and moment produced by swaying and rolling oscillation of "
    "cylinders on the free surface. Reports of Research Institute for Applied Mechanics, Kyushu University 9.",
    "Lewis29": "Lewis, F. M. (1929). The inertia of the water surrounding a vibrating ship. Trans. SNAME 37.",
    "Clarke83": "Clarke, D., Gedling, P., Hine, G. (1983). The application of manoeuvring criteria in hull design "
    "using linear theory. Trans. RINA 125.",
    "Todd63": "Todd, F. H. (1963). Series 60: Methodical experiments with models of single-screw merchant ships. "
    "DTMB Report 1712.",
    "Abkowitz64": "Abkowitz, M. A. (1964). Lectures on ship hydrodynamics: steering and manoeuvrability. "
    "Hydro- and Aerodynamics Laboratory Report Hy-5.",
    "Struble62": "Struble, R. A. (1962). Nonlinear differential equations. McGraw-Hill.",
    "Krack19": "Krack, M., Gross, J. (2019). Harmonic balance for nonlinear vibration problems. Springer.",
    "DormandPrince80": "Dormand, J. R., Prince, P. J. (1980). A family of embedded Runge-Kutta formulae. "
    "Journal of Computational and Applied Mathematics 6.",
    "Hoerner65": "Hoerner, S. F. (1965). Fluid-dynamic drag. Published by the author.",
    "MMG78": "Ogawa, A., Kasai, H. (1978). On the mathematical model of manoeuvring motion of ships. "
    "International Shipbuilding Progress 25.",
    "Himeno81": "Himeno, Y. (1981). Prediction of ship roll damping: state of the art. "
    "University of Michigan, Department of Naval Architecture and Marine Engineering, Report 239.",
    "Fritsch84": "Fritsch, F. N., Butland, J. (1984). A method for constructing local monotone piecewise cubic "
    "interpolants. SIAM Journal on Scientific and Statistical Computing 5.",
    "Gill72": "Gill, P. E., Miller, G. F. (1972). An algorithm for the integration of unequally spaced data. "
    "The Computer Journal 15.",
    "Abramowitz64": "Abramowitz, M., Stegun, I. A. (1964). Handbook of mathematical functions. National Bureau of "
    "Standards.",
    "Lewis88": "Lewis, E. V., ed. (1988). Principles of naval architecture, volume I: stability and strength. SNAME.",
    "Journee92": "Journée, J. M. J. (1992). Experiments and calculations on 4 Wigley hull forms in head waves. "
    "Delft University of Technology, Report 0909.",
}
"""Key -> full reference. A `Source:` line in a docstring names one of these keys."""


def cite(result: Any) -> str:
    """Name the papers a result rests on, one line each.

    Parameters
    ----------
    result : anything with a ``references`` attribute, or with an ``attrs`` mapping that has one (a Dataset)
        The keys, as a sequence or as one comma-separated string.

    Returns
    -------
    str    one reference a line; the method paper [H71] alone when the result names none

    Examples
    --------
    >>> print(cite(None))
    [H71] Haddara, M. R. (1971). On the stability of ship motion in regular oblique waves.
    """
    keys: Any = getattr(result, "references", None)
    attributes = getattr(result, "attrs", None)
    if keys is None and isinstance(attributes, Mapping):
        keys = attributes.get("references")
    if isinstance(keys, str):
        keys = [key.strip() for key in keys.split(",") if key.strip()]
    chosen: Iterable[str] = dict.fromkeys(keys or ["H71"])
    return "\n".join(f"[{key}] {REFERENCES[key]}" for key in chosen)
