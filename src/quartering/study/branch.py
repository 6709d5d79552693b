"""Response curves: the branch of motions over one parameter, each point judged, each change of stability located."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import xarray as xr
from scipy.interpolate import CubicSpline

from quartering.conventions import InputError
from quartering.hull.ship import Ship
from quartering.loads.waves import Wave
from quartering.motion.branch import Curve, Family, follow_branch, start_of_branch
from quartering.motion.equations import Floats, Model, System
from quartering.motion.of_ship import equations, ship_system
from quartering.motion.steady import peaks
from quartering.motion.terms import parse
from quartering.stability.assessment import Assessment, assess
from quartering.study.dataset import attributes
from quartering.study.grid import LOADING_AXES, loaded

_OF_CONDITION = ("speed", "heading", "wave_length", "wave_height")
_NODES = 65
_UNITS = {"frequency": "rad/s", "excitation": "1"}


def branch(
    ship_or_model: Ship | Model,
    over: str = "frequency",
    *,
    limits: tuple[float, float] | None = None,
    harmonics: int = 3,
    wave: Wave | None = None,
    speed: float = 0.0,
    heading: float = 90.0,
    points: int = 2000,
) -> xr.Dataset:
    """Follow the periodic motions over one parameter through their folds, and judge every one.

    Parameters
    ----------
    ship_or_model : Ship or Model    a ship needs `wave`, `speed` and `heading`
    over : str                       "frequency" [rad/s] or "excitation" (share of the wave force), coefficients held; the name
                                     of a term, as a multiplier; for a ship also "speed" [m/s], "heading" [deg],
                                     "wave_length", "wave_height" [m], or a loading value such as "gm" [m]
    limits : (low, high)             of the parameter; by default 0.5 to 1.5 times its value (0 to 2 for an excitation)
    harmonics : int                  highest harmonic, odd
    wave, speed, heading             of a ship [m/s, deg]
    points : int                     at the most

    Returns
    -------
    xarray.Dataset    along ``point``: the parameter, sway [m], roll, yaw, roll_peak [deg], exponent [1/s], verdict; ``event``
                      is "fold", "symmetry-breaking", "neimark-sacker" or "period-doubling" where stability changes or the
                      curve turns back, and "" elsewhere; ``fold`` is True at the folds

    Raises
    ------
    InputError        unknown parameter, limits that do not rise, no motion to start from

    Notes
    -----
    Pseudo-arclength continuation from the motion at the lower limit. Several motions coexist where the curve passes one value
    more than once. A ship's coefficients and forces are splined through 65 values of the parameter.
    Source: [Krack19]; [H71] eq. (A-11).

    Examples
    --------
    >>> terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.2, "K_p": -0.04}
    >>> model = Model(np.eye(3), terms, 1.0, (0, 0.1, 0), (0, 0, 0))
    >>> curve = branch(model, "frequency", limits=(0.8, 1.5), harmonics=1)
    >>> curve["frequency"][curve["event"] == "fold"].values.round(2).tolist()
    [1.26, 1.1]
    """
    low, high, family = _family(ship_or_model, over, limits, wave, speed, heading)
    curve, start = start_of_branch(family, harmonics)
    path, folds = follow_branch(curve, start, points)
    path, events = _with_events(curve, path, folds)
    result = _judged(curve, path)
    u = np.array([curve.coefficients(point) for point in path])
    first = 1 if curve.orders[0] == 0 else 0
    amplitude = np.hypot(u[:, :, first], u[:, :, first + 1])
    values = low + (high - low) * path[:, -1]
    columns = {
        over: values, "sway": amplitude[:, 0], "roll": np.degrees(amplitude[:, 1]), "yaw": np.degrees(amplitude[:, 2]),
        "roll_peak": np.degrees(peaks(u, curve.orders)[:, 1]), "exponent": result.floquet.growth, "verdict": result.kind,
    }  # fmt: skip
    data = {name: ("point", v, _described(name, over)) for name, v in columns.items()}
    references = ship_or_model.references if isinstance(ship_or_model, Model) else ("H71", "STF70")
    ds = xr.Dataset(data, attrs={"references": ", ".join((*references, "Krack19"))})
    return ds.assign(
        event=("point", events, {"long_name": "what happens here", "units": "1", "symbol": ""}),
        fold=("point", events == "fold", {"long_name": "the parameter turns back here", "units": "1", "symbol": ""}),
    )


def _described(name: str, over: str) -> dict[str, object]:
    if name == over and name in _UNITS:
        return {"units": _UNITS[name], "long_name": "parameter of the branch", "symbol": name}
    return attributes(name)


def _family(
    ship_or_model: Ship | Model,
    over: str,
    limits: tuple[float, float] | None,
    wave: Wave | None,
    speed: float,
    heading: float,
) -> tuple[float, float, Family]:
    """Limits of the parameter, and the system at each share of the way between them."""
    if isinstance(ship_or_model, Ship) and wave is None:
        raise InputError(
            "a branch of a ship needs a wave: branch(ship, wave=Wave(length=.., height=..), speed=.., heading=..)"
        )
    of_ship = isinstance(ship_or_model, Ship) and over in (*_OF_CONDITION, *LOADING_AXES)
    if isinstance(ship_or_model, Ship):
        assert wave is not None
        model = equations(ship_or_model, wave, speed, heading)
        own = {"speed": speed, "heading": heading, "wave_length": wave.length, "wave_height": wave.height}
        own |= {name: getattr(ship_or_model.loading, name, np.nan) for name in LOADING_AXES}
    else:
        model, own = ship_or_model, {}
    if not of_ship and over not in ("frequency", "excitation"):
        _check_term(model, over, isinstance(ship_or_model, Ship))
    centre = own[over] if of_ship else {"frequency": model.frequency}.get(over, 1.0)
    low, high = limits or ((0.0, 2.0) if over == "excitation" else (0.5 * centre, 1.5 * centre))
    if not (np.isfinite(low) and np.isfinite(high) and 0 <= low < high) or (over == "frequency" and low == 0):
        raise InputError(f"limits ({low:g}, {high:g}) of {over} must be two rising numbers, above zero for a frequency")
    if of_ship:
        assert isinstance(ship_or_model, Ship)
        assert wave is not None
        return low, high, _splined(ship_or_model, over, low, high, wave, speed, heading)

    def at(share: float) -> System:
        value, s = low + (high - low) * share, model.system
        if over == "frequency":
            return replace(s, frequency=np.array([value]))
        if over == "excitation":
            return replace(s, mean=value * s.mean, cos=value * s.cos, sin=value * s.sin)
        return replace(model, terms=dict(model.terms) | {over: value * model.terms[over]}).system

    return low, high, at


def _check_term(model: Model, over: str, of_ship: bool) -> None:
    """Refuse a parameter that is neither a condition nor a term the model has."""
    known = "'frequency', 'excitation'" + (
        ", " + ", ".join(map(repr, (*_OF_CONDITION, *LOADING_AXES))) if of_ship else ""
    )
    if "_" not in over:
        raise InputError(f"over={over!r}: a branch can be followed over {known}, or a term such as 'K_ppp'")
    parse(over)
    if model.terms.get(over, 0.0) == 0.0:
        raise InputError(f"over={over!r}: the model has no such term (or it is zero), so there is nothing to multiply")


def _splined(ship: Ship, over: str, low: float, high: float, wave: Wave, speed: float, heading: float) -> Family:
    """Systems of a ship between two values of a parameter, through a spline of every coefficient and force."""
    share = np.linspace(0.0, 1.0, _NODES)
    values = low + (high - low) * share
    if over in _OF_CONDITION:
        own = {"speed": speed, "heading": heading, "wave_length": wave.length, "wave_height": wave.height} | {
            over: values
        }
        u, mu, length, height = (np.broadcast_to(own[name], values.shape).astype(float) for name in _OF_CONDITION)
        at = ship_system(ship, 2 * np.pi / length, u, mu)
        if at.slow.any() or (at.encounter_frequency.min() < 0 < at.encounter_frequency.max()):
            raise InputError(
                f"between {over} = {low:g} and {high:g} the ship keeps pace with the wave; take narrower limits"
            )
        systems = at.at_amplitude(0.5 * height[:, None])
    else:
        each = [equations(loaded(ship, {over: float(v)}), wave, speed, heading).system for v in values[:: _NODES // 16]]
        share = share[:: _NODES // 16]
        systems = replace(each[0], **{name: np.concatenate([getattr(s, name) for s in each]) for name in _ARRAYS})
    splines = {name: CubicSpline(share, getattr(systems, name), axis=0) for name in _ARRAYS}

    def family(t: float) -> System:
        return replace(systems, **{name: np.ascontiguousarray(spline(t)[None]) for name, spline in splines.items()})

    return family


_ARRAYS = ("linear", "coefficients", "mean", "cos", "sin", "frequency")


def _judged(curve: Curve, path: Floats) -> Assessment:
    """Stability of every point of a path, as one batch."""
    systems = [curve.family(float(t)) for t in path[:, -1]]
    joined = replace(systems[0], **{name: np.concatenate([getattr(s, name) for s in systems]) for name in _ARRAYS})
    u = np.array([curve.coefficients(point) for point in path])
    return assess(joined, u, curve.orders, accuracy=1e-9)


def _unstable(result: Assessment) -> np.ndarray:
    """Number of unstable multipliers at each point."""
    return np.asarray((np.abs(result.floquet.multipliers) > 1.0).sum(axis=1))


def _with_events(curve: Curve, path: Floats, folds: list[int]) -> tuple[Floats, np.ndarray]:
    """The path with the points where stability changes set in, and the name of what happens at each point."""
    count = _unstable(_judged(curve, path))
    points, names = [], []
    for i, point in enumerate(path):
        changed = i > 0 and count[i] != count[i - 1]
        if changed and i not in folds and i - 1 not in folds:
            event = _located(curve, path[i - 1], point, int(count[i - 1]))
            name = _named(curve, event)
            if name != "fold":  # the curve itself locates folds, and better than the multipliers of a truncated motion
                points.append(event)
                names.append(name)
        points.append(point)
        names.append("fold" if i in folds else "")
    return np.array(points), np.array(names)


def _located(curve: Curve, a: Floats, b: Floats, before: int) -> Floats:
    """Point between two where the number of unstable multipliers changes, by bisection."""
    chord = (b - a) / np.linalg.norm(b - a)
    inside, outside = 0.0, float(np.linalg.norm(b - a))
    found = b
    for _ in range(40):
        middle = 0.5 * (inside + outside)
        point = curve.corrected(a + middle * chord, chord)
        if point is None:
            break
        found = point
        if _unstable(_judged(curve, point[None]))[0] == before:
            inside = middle
        else:
            outside = middle
    return found


def _named(curve: Curve, point: Floats) -> str:
    """What kind of change of stability a point is, from the multiplier nearest to the unit circle."""
    floquet = _judged(curve, point[None]).floquet
    critical = int(np.argmin(np.abs(np.abs(floquet.multipliers[0]) - 1.0)))
    half, full = floquet.half[0, critical], floquet.multipliers[0, critical]
    deciding = half if np.isfinite(half) else full
    if abs(deciding.imag) > 1e-6:
        return "neimark-sacker"
    if np.isfinite(half):
        return "fold" if half.real < 0 else "symmetry-breaking"
    return "fold" if full.real > 0 else "period-doubling"
