"""Kramers-Kronig check: added mass and damping follow from one another over all frequencies."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline

from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.lines.quadrature import gauss
from quartering.hull.lines.section import Floats
from quartering.hull.told import real
from quartering.hydro.strip.table import SectionTable
from quartering.option_checks import quoted

TOLERANCE: Final = 0.02
"""Inconsistency up to which a set passes, beside what the damping outside its frequencies may add [1]."""
_LOW_POWERS: Final = (1.0, 7.0)
_TAIL_POWERS: Final = (-8.0, -1.0)
_TAIL_REACH: Final = 40.0
_NEGLIGIBLE: Final = 1e-3


@dataclass(frozen=True, eq=False)
class KramersKronig:
    """How far added mass and damping are from being a causal pair.

    Parameters
    ----------
    frequency : (f,) float               omega [rad/s]
    added_mass : (f, ...) float          given, SI
    from_damping : (f, ...) float        a(inf) plus the transform of the damping, SI
    added_mass_infinite : (...) float    given, or the constant that fits best, SI
    difference : (f, ...) float          given less transformed, over the size of its row and column [1]
    outside : (f, ...) float             share of the transform that rests on damping assumed outside the frequencies [1]
    largest : float                      largest |difference| [1]
    worst : tuple                        entry and frequency [rad/s] of it
    fitted : bool                        was added_mass_infinite fitted
    consistent : bool                    |difference| <= 0.02 + |outside| everywhere
    """

    frequency: Floats
    added_mass: Floats
    from_damping: Floats
    added_mass_infinite: Floats
    difference: Floats
    outside: Floats
    largest: float
    worst: tuple[tuple[str, ...], float]
    fitted: bool
    consistent: bool

    @property
    def sentence(self) -> str:
        """The finding in words."""
        entry, omega = self.worst
        where = f"largest inconsistency {100 * self.largest:.2g} %, {' '.join(entry)}, at {omega:.4g} rad/s"
        if self.consistent:
            return f"added mass and damping belong together: {where}"
        return (
            f"added mass and damping do not belong together: {where}; look there for a spike of an irregular frequency, "
            "a wrong sign or unit, another reference point, or too few frequencies"
        )


@takes(data="Dataset, SectionTable")
def kramers_kronig(data: xr.Dataset | SectionTable, *, added_mass_infinite: ArrayLike | None = None) -> KramersKronig:
    """Compare given added mass with the one that follows from the damping.

    Parameters
    ----------
    data : Dataset or SectionTable
        Dataset: added_mass, damping (frequency, mode, mode_of_motion) as of `hydrodynamics`, `hydrodynamics6`,
        `read_capytaine`, `read_wamit`; or a22 b22 .. (frequency) as of `section_coefficients`.
    added_mass_infinite : (...) float    limit at infinite frequency, SI; None: that of the data, else fitted

    Returns
    -------
    KramersKronig

    Raises
    ------
    InputError    variables missing, fewer than 8 frequencies, not ascending or not positive, a forward speed, values
                  that are not finite

    Notes
    -----
    a(w) - a(inf) = (2/pi) PV int_0^inf b(u)/(u^2 - w^2) du . Below the lowest frequency b goes like the power
    of its first points (1 to 7), above the highest like that of its last (-1 to -8). Terms of a matrix are measured by
    the geometric mean of the two diagonal terms of their modes, each by its largest departure from a(inf).
    Source: [Ogilvie64], [Cummins62].  Valid: linear, any geometry; frequencies dense enough for a spline of b.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> from quartering.hydro.strip.moments import section_table
    >>> kramers_kronig(section_table(ship("wigley").with_(ends="strips").hull, 1025.0)).consistent
    True
    """
    given = _table_pair(data) if isinstance(data, SectionTable) else _dataset_pair(data)
    omega, a, b, limit, labels = given
    _check(omega, a, b)
    inside, outside = _transform(omega, b, omega)
    fitted = added_mass_infinite is None and limit is None
    if fitted:
        infinite = np.median(a - inside - outside, axis=0)
    else:
        told = real(limit if added_mass_infinite is None else added_mass_infinite)
        if told is None or told.shape != a.shape[1:]:
            raise InputError(
                f"added_mass_infinite = {quoted(added_mass_infinite)}; it is numbers of shape {a.shape[1:]}"
            )
        infinite = told
    expected = infinite + inside + outside
    size = _size(np.abs(a - infinite).max(axis=0), labels)
    difference = np.divide(a - expected, size, out=np.zeros_like(a), where=size > 0)
    share = np.abs(np.divide(outside, size, out=np.zeros_like(a), where=size > 0))
    at = np.unravel_index(int(np.argmax(np.abs(difference))), difference.shape)
    worst = tuple(str(labels[k][i]) for k, i in enumerate(at[1:])), float(omega[at[0]])
    return KramersKronig(
        omega, a, expected, infinite, difference, share, float(np.abs(difference).max()), worst, fitted,
        bool((np.abs(difference) <= TOLERANCE + share).all()),
    )  # fmt: skip


def retardation(frequency: ArrayLike, damping: ArrayLike, time: ArrayLike) -> Floats:
    """Retardation function of the time-domain equations from the damping.

    Parameters
    ----------
    frequency : (f,) float      omega > 0, ascending, at least 8 [rad/s]
    damping : (f, ...) float    b, going to zero at both ends, SI
    time : (t,) float           [s]

    Returns
    -------
    (t, ...) float    K(t) = (2/pi) int b cos(w t) dw, SI

    Raises
    ------
    InputError    too few frequencies, or not ascending and positive

    Notes
    -----
    a(w) = a(inf) - (1/w) int_0^inf K(t) sin(w t) dt; ends of b as in `kramers_kronig`.
    Source: [Cummins62], [Ogilvie64].  Valid: t below about the inverse of the frequency spacing.

    Examples
    --------
    For b = w^2 exp(-w) the integral is (4/pi)(1 - 3 t^2)/(1 + t^2)^3.

    >>> w = np.linspace(0.02, 25.0, 400)
    >>> K = retardation(w, w**2 * np.exp(-w), [0.0, 1.0])
    >>> np.round(K * np.pi / 4, 3).tolist()
    [1.0, -0.25]
    """
    omega, b, t = (real(values) for values in (frequency, damping, time))
    if omega is None or b is None or t is None:
        raise InputError("frequency, damping and time are lists of numbers; one of them is not")
    _check(omega, b, b)
    nodes, values, _ = _completed(omega, b.reshape(omega.size, -1))
    moments = np.atleast_1d(np.abs(t))
    out = np.empty((moments.size, values.shape[1]))
    early = moments < 1 / omega[-1]
    u, du, field = _points(nodes, values)
    out[early] = (np.cos(moments[early, None] * u) * du) @ field
    out[~early] = _cosine_integral(nodes, values, moments[~early])
    return np.asarray(2 / np.pi * out.reshape(-1, *b.shape[1:]))


def _cosine_integral(nodes: Floats, values: Floats, t: Floats) -> Floats:
    """Integral of the spline times cos(u t), exact: by parts only its ends and the jumps of its third derivative count."""
    spline = CubicSpline(nodes, values)
    s = 1j * t[:, None]
    total = np.zeros((t.size, values.shape[1]), dtype=complex)
    for order in range(3):
        ends = spline(nodes[[0, -1]], order)
        total += (-1) ** order / s ** (order + 1) * (np.exp(s * nodes[-1]) * ends[1] - np.exp(s * nodes[0]) * ends[0])
    third = np.concatenate([0 * values[:1], 6 * spline.c[0], 0 * values[:1]])
    return np.asarray((total + np.exp(s * nodes) @ np.diff(third, axis=0) / s**4).real)


def _table_pair(table: SectionTable) -> tuple[Floats, Floats, Floats, Floats | None, tuple[list[str], ...]]:
    """Matrices (f, s, 2, 2) in sway and roll of every section."""
    keep = table.frequency > 0

    def matrix(c: Floats) -> Floats:
        return np.asarray(c[..., [0, 1, 1, 2]].reshape(*c.shape[:-1], 2, 2))

    labels = [f"section {k + 1}" for k in range(table.a.shape[1])], ["sway", "roll"], ["sway", "roll"]
    return table.frequency[keep], matrix(table.a[keep]), matrix(table.b[keep]), matrix(table.a_infinite), labels


def _dataset_pair(data: xr.Dataset) -> tuple[Floats, Floats, Floats, Floats | None, tuple[list[str], ...]]:
    """Frequencies, added mass, damping, limit and labels of a dataset of a ship or of a section."""
    if "frequency" not in data.coords:
        raise InputError("the dataset has no frequency; give one of hydrodynamics, section_coefficients or a database")
    omega = np.asarray(data["frequency"].to_numpy(), dtype=float)
    if {"added_mass", "damping"} <= set(data.data_vars):
        order = ("frequency", "mode", "mode_of_motion")
        a, b = (data[name].transpose(*order).to_numpy() for name in ("added_mass", "damping"))
        if float(data.attrs.get("speed", 0.0)) != 0.0:
            raise InputError(
                f"speed {data.attrs['speed']} m/s: strip theory with speed mixes the two with terms of U/omega^2 that are "
                "held at low frequency; check the same ship at speed 0"
            )
        limit = data["added_mass_infinite"].to_numpy() if "added_mass_infinite" in data else None
        return omega, a, b, limit, ([str(m) for m in data["mode"].to_numpy()],) * 2
    names = [name for name in ("22", "24", "44", "33") if {f"a{name}", f"b{name}"} <= set(data.data_vars)]
    if not names:
        raise InputError("the dataset has neither added_mass and damping nor a22 and b22; give both of a pair")
    a, b = (np.stack([data[letter + name].to_numpy() for name in names], axis=-1) for letter in "ab")
    return omega, a, b, None, ([f"a{name}" for name in names],)


def _check(omega: Floats, a: Floats, b: Floats) -> None:
    if omega.ndim != 1 or omega.size < 8 or not ((omega > 0).all() and (np.diff(omega) > 0).all()):
        raise InputError(
            f"{omega.size} frequencies given; the check needs at least 8, all above 0 and ascending [rad/s]"
        )
    for name, values in (("added mass", a), ("damping", b)):
        if values.shape[:1] != omega.shape or not np.isfinite(values).all():
            raise InputError(f"the {name} must be finite and given at each of the {omega.size} frequencies")


def _size(departure: Floats, labels: tuple[list[str], ...]) -> Floats:
    """What a difference is measured by: sqrt(ii jj) in a matrix; nothing where there is no motion at all."""
    if len(labels) >= 2:
        diagonal = np.sqrt(np.einsum("...ii->...i", departure))
        size = diagonal[..., :, None] * diagonal[..., None, :]
        mean = size.mean(axis=tuple(range(departure.ndim - 2)), keepdims=True)
    else:
        size, mean = departure, departure
    return np.where(size > _NEGLIGIBLE * mean, size, 0.0)


def _completed(omega: Floats, b: Floats) -> tuple[Floats, Floats, slice]:
    """Frequencies and damping (n, ..) with what is assumed below and above them, and which are the given ones."""
    below = np.array([0.0, 0.2, 0.4, 0.6, 0.8])
    steps = _TAIL_REACH ** (np.arange(1, 41) / 40)
    low = b[0] * below[:, None] ** np.clip(_power(omega, b, 0, 2, 3.0), *_LOW_POWERS)
    tail = b[-1] * steps[:, None] ** np.clip(_power(omega, b, -3, -1, -3.0), *_TAIL_POWERS)
    nodes = np.concatenate([omega[0] * below, omega, omega[-1] * steps])
    return nodes, np.concatenate([low, b, tail]), slice(below.size, below.size + omega.size)


def _power(omega: Floats, b: Floats, first: int, last: int, otherwise: float) -> Floats:
    """Power of the frequency with which b goes between two points; a default where it is zero or changes sign."""
    ratio = np.divide(b[last], b[first], out=np.zeros_like(b[0]), where=b[first] != 0)
    power = np.log(np.where(ratio > 0, ratio, 1.0)) / np.log(omega[last] / omega[first])
    return np.where(ratio > 0, power, otherwise)


def _points(nodes: Floats, values: Floats) -> tuple[Floats, Floats, Floats]:
    """Four Gauss points between neighbouring frequencies, their weights and the splined values there."""
    u, du = gauss(4, 0.0, 1.0)
    width = np.diff(nodes)[:, None]
    points = (nodes[:-1, None] + width * u).ravel()
    return points, (width * du).ravel(), np.asarray(CubicSpline(nodes, values)(points))


def _transform(omega: Floats, b: Floats, at: Floats) -> tuple[Floats, Floats]:
    """(2/pi) PV int b/(u^2 - w^2) du over the given frequencies and over the assumed rest.

    PV int_0^X du/(u^2 - w^2) = ln|(X - w)/(X + w)|/(2 w) carries the singularity: b(u) - b(w) is integrated.
    """
    flat = b.reshape(omega.size, -1)
    nodes, values, given = _completed(omega, flat)
    u, du, field = _points(nodes, values)
    low, high = nodes[given][0], nodes[given][-1]
    known = (u > low) & (u < high)
    inside, outside = np.empty((2, at.size, flat.shape[1]))
    for k, w in enumerate(at):
        kernel = 2 / np.pi * du / (u**2 - w**2)
        outside[k] = kernel[~known] @ field[~known]
        inside[k] = kernel @ (field - flat[k]) - outside[k]
        inside[k] += flat[k] * np.log((nodes[-1] - w) / (nodes[-1] + w)) / (np.pi * w)
    return inside.reshape(b.shape), outside.reshape(b.shape)
