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
    "Blanes09": "Blanes, S., Casas, F., Oteo, J. A., Ros, J. (2009). The Magnus expansion and some of its applications. "
    "Physics Reports 470.",
    "Owen97": "Owen, A. B. (1997). Scrambled net variance for integrals of smooth functions. Annals of Statistics 25.",
    "Francis61": "Francis, J. G. F. (1961). The QR transformation. Computer Journal 4.",
    "Holtrop82": "Holtrop, J., Mennen, G. G. J. (1982). An approximate power prediction method. International "
    "Shipbuilding Progress 29.",
    "Holtrop84": "Holtrop, J. (1984). A statistical re-analysis of resistance and propulsion data. International "
    "Shipbuilding Progress 31.",
    "Krack19": "Krack, M., Gross, J. (2019). Harmonic balance for nonlinear vibration problems. Springer.",
    "Thompson89": "Thompson, J. M. T. (1989). Chaotic phenomena triggering the escape from a potential well. "
    "Proceedings of the Royal Society A 421.",
    "DormandPrince80": "Dormand, J. R., Prince, P. J. (1980). A family of embedded Runge-Kutta formulae. "
    "Journal of Computational and Applied Mathematics 6.",
    "HL74": "Hasofer, A. M., Lind, N. C. (1974). Exact and invariant second-moment code format. "
    "Journal of the Engineering Mechanics Division, ASCE 100.",
    "Hoerner65": "Hoerner, S. F. (1965). Fluid-dynamic drag. Published by the author.",
    "MMG78": "Ogawa, A., Kasai, H. (1978). On the mathematical model of manoeuvring motion of ships. "
    "International Shipbuilding Progress 25.",
    "Himeno81": "Himeno, Y. (1981). Prediction of ship roll damping: state of the art. "
    "University of Michigan, Department of Naval Architecture and Marine Engineering, Report 239.",
    "Fritsch84": "Fritsch, F. N., Butland, J. (1984). A method for constructing local monotone piecewise cubic "
    "interpolants. SIAM Journal on Scientific and Statistical Computing 5.",
    "deBoor78": "de Boor, C. (1978). A practical guide to splines. Springer.",
    "Brent73": "Brent, R. P. (1973). Algorithms for minimization without derivatives. Prentice-Hall.",
    "Gill72": "Gill, P. E., Miller, G. F. (1972). An algorithm for the integration of unequally spaced data. "
    "The Computer Journal 15.",
    "Abramowitz64": "Abramowitz, M., Stegun, I. A. (1964). Handbook of mathematical functions. National Bureau of "
    "Standards.",
    "Golub69": "Golub, G. H., Welsch, J. H. (1969). Calculation of Gauss quadrature rules. Mathematics of Computation 23.",
    "Lewis88": "Lewis, E. V., ed. (1988). Principles of naval architecture, volume I: stability and strength. SNAME.",
    "Lewis89": "Lewis, E. V., ed. (1989). Principles of naval architecture, volume III: motions in waves and "
    "controllability. SNAME.",
    "Yasukawa15": "Yasukawa, H., Yoshimura, Y. (2015). Introduction of MMG standard method for ship maneuvering "
    "predictions. Journal of Marine Science and Technology 20.",
    "Journee92": "Journée, J. M. J. (1992). Experiments and calculations on 4 Wigley hull forms in head waves. "
    "Delft University of Technology, Report 0909.",
    "Chislett65": "Chislett, M. S., Strøm-Tejsen, J. (1965). Planar motion mechanism tests and full-scale steering and "
    "manoeuvring predictions for a Mariner class vessel. Hydro- and Aerodynamics Laboratory Report Hy-5.",
    "Son82": "Son, K.-H., Nomoto, K. (1982). On the coupled motion of steering and rolling of a high speed container "
    "ship. Naval Architecture and Ocean Engineering 20.",
    "Blanke93": "Blanke, M., Christensen, A. (1993). Rudder-roll damping autopilot robustness to sway-yaw-roll "
    "couplings. 10th Ship Control Systems Symposium, Ottawa.",
    "Ancellin19": "Ancellin, M., Dias, F. (2019). Capytaine: a Python-based linear potential flow solver. Journal of Open "
    "Source Software 4.",
    "WAMIT": "WAMIT, Inc. WAMIT user manual, version 7: definition of quantities, output files, geometric data file.",
    "Bertram06": "Bertram, V., Veelo, B., Söding, H., Graf, K. (2006). Development of a freely available strip method for "
    "seakeeping. COMPIT, Oegstgeest.",
    "Nomoto57": "Nomoto, K., Taguchi, T., Honda, K., Hirano, S. (1957). On the steering qualities of ships. International "
    "Shipbuilding Progress 4.",
    "Ikeda78a": "Ikeda, Y., Himeno, Y., Tanaka, N. (1978). On eddy making component of roll damping force on naked hull. "
    "Journal of the Society of Naval Architects of Japan 142; University of Osaka Prefecture, Report 00403.",
    "Ikeda78b": "Ikeda, Y., Himeno, Y., Tanaka, N. (1978). Components of roll damping of ship at forward speed. "
    "Journal of the Society of Naval Architects of Japan 143; University of Osaka Prefecture, Report 00404.",
    "Ikeda78c": "Ikeda, Y., Himeno, Y., Tanaka, N. (1978). A prediction method for ship roll damping. "
    "University of Osaka Prefecture, Department of Naval Architecture, Report 00405.",
    "ITTC11": "ITTC (2011). Numerical estimation of roll damping. Recommended procedure 7.5-02-07-04.5.",
    "Kawahara09": "Kawahara, Y., Maekawa, K., Ikeda, Y. (2009). A simple prediction formula of roll damping of "
    "conventional cargo ships on the basis of Ikeda's method and its limitation. Proc. 10th Int. Conf. on Stability "
    "of Ships and Ocean Vehicles (STAB 2009).",
    "Journee03": "Journée, J. M. J., Adegeest, L. J. M. (2003). Theoretical manual of strip theory program SEAWAY for "
    "Windows. Delft University of Technology, Report 1370.",
    "Froude1874": "Froude, W. (1874). On resistance in rolling of ships. Naval Science 3.",
    "NeweyWest87": "Newey, W. K., West, K. D. (1987). A simple, positive semi-definite, heteroskedasticity and "
    "autocorrelation consistent covariance matrix. Econometrica 55.",
    "Lamb32": "Lamb, H. (1932). Hydrodynamics, 6th edition. Cambridge University Press.",
    "Taylor28": "Taylor, G. I. (1928). The forces on a body placed in a curved or converging stream of fluid. Proceedings of "
    "the Royal Society A 120.",
    "Timman62": "Timman, R., Newman, J. N. (1962). The coupled damping coefficients of a symmetric ship. Journal of Ship "
    "Research 5.",
    "Cummins62": "Cummins, W. E. (1962). The impulse response function and ship motions. Schiffstechnik 9.",
    "Ogilvie64": "Ogilvie, T. F. (1964). Recent progress toward the understanding and prediction of ship motions. 5th "
    "Symposium on Naval Hydrodynamics, Bergen.",
    "Frank67": "Frank, W. (1967). Oscillation of cylinders in or below the free surface of deep fluids. "
    "Naval Ship Research and Development Center, Report 2375.",
    "Hess67": "Hess, J. L., Smith, A. M. O. (1967). Calculation of potential flow about arbitrary bodies. Progress in "
    "Aeronautical Sciences 8.",
    "Morino74": "Morino, L., Kuo, C.-C. (1974). Subsonic potential aerodynamics for complex configurations: a general "
    "theory. AIAA Journal 12.",
    "VanOosterom83": "Van Oosterom, A., Strackee, J. (1983). The solid angle of a plane triangle. IEEE Transactions on "
    "Biomedical Engineering 30.",
    "Hasselmann73": "Hasselmann, K. et al. (1973). Measurements of wind-wave growth and swell decay during the Joint North Sea "
    "Wave Project (JONSWAP). Deutsche Hydrographische Zeitschrift, Reihe A, 8.",
    "Bretschneider59": "Bretschneider, C. L. (1959). Wave variability and wave spectra for wind-generated gravity waves. "
    "Beach Erosion Board, Technical Memorandum 118.",
    "PiersonMoskowitz64": "Pierson, W. J., Moskowitz, L. (1964). A proposed spectral form for fully developed wind seas "
    "based on the similarity theory of S. A. Kitaigorodskii. Journal of Geophysical Research 69.",
    "OchiHubble76": "Ochi, M. K., Hubble, E. N. (1976). Six-parameter wave spectra. 15th Coastal Engineering Conference.",
    "TorsethaugenHaver04": "Torsethaugen, K., Haver, S. (2004). Simplified double peak spectral model for ocean waves. 14th "
    "International Offshore and Polar Engineering Conference.",
    "LonguetHiggins63": "Longuet-Higgins, M. S., Cartwright, D. E., Smith, N. D. (1963). Observations of the directional "
    "spectrum of sea waves using the motions of a floating buoy. Ocean Wave Spectra, Prentice-Hall.",
    "Kazakov54": "Kazakov, I. E. (1954). An approximate method for the statistical investigation of nonlinear systems. "
    "Trudy VVIA im. Zhukovskogo 394.",
    "Rice44": "Rice, S. O. (1944). Mathematical analysis of random noise. Bell System Technical Journal 23, 24.",
    "Vanmarcke75": "Vanmarcke, E. H. (1975). On the distribution of the first-passage time for normal stationary random "
    "processes. Journal of Applied Mechanics 42.",
    "Fay97": "Fay, M. P., Feuer, E. J. (1997). Confidence intervals for directly standardized rates: a method based on the "
    "gamma distribution. Statistics in Medicine 16.",
    "Tucker84": "Tucker, M. J., Challenor, P. G., Carter, D. J. T. (1984). Numerical simulation of a random sea: a common "
    "error and its effect upon wave group statistics. Applied Ocean Research 6.",
    "Gustavsen99": "Gustavsen, B., Semlyen, A. (1999). Rational approximation of frequency domain responses by vector fitting. "
    "IEEE Transactions on Power Delivery 14.",
    "Coles01": "Coles, S. (2001). An Introduction to Statistical Modeling of Extreme Values. Springer.",
    "Jensen07": "Jensen, J. J. (2007). Efficient estimation of extreme non-linear roll motions using the first-order "
    "reliability method (FORM). Journal of Marine Science and Technology 12.",
    "Kress90": "Kress, R. (1990). A Nystrom method for boundary integral equations in domains with corners. "
    "Numerische Mathematik 58.",
}
"""Key -> full reference; the source line of a docstring names one of these keys."""


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
