"""Numbers in words: speeds, waves, complex exponents, and what in a result is estimated or assumed."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from importlib.metadata import version
from typing import TYPE_CHECKING

import numpy as np

from quartering.conventions import in_unit, written
from quartering.hull.righting.arm import fitted_to
from quartering.hull.ship import Ship
from quartering.hydro.strip.ends import ENDS_WORDS
from quartering.loads.waves import Wave
from quartering.names import DRAG_NAME
from quartering.references import REFERENCES
from quartering.units import quantity

if TYPE_CHECKING:
    import xarray as xr

MOST_ROWS = 16
"""Values of a tornado that are shown, those with the largest effect; its dataset has all."""
_ESTIMATED = {"regression": "velocity derivatives ", "cross-flow drag": "cubic damping "}
"""Method of estimate -> what it estimates; another method's coefficients, and one drag coefficient, are named alone."""

_LOADING = ("gm", "kg", "gyradius_roll", "gyradius_yaw", "roll_damping")


WAY_WORDS = "the ship capsizes on the way, from upright or with the wave raised in three steps"

CALM_WORDS = (
    "of the linear motion where no wave acts, each with the coefficients of its own frequency, rudder amidships; above 0 the"
    " ship leaves its course"
)
WITHOUT_WAVES = "the equations of this verdict with the wave left out: coefficients of the frequency of encounter"
CALM_COURSE = "The ship leaves its course without any wave unless it is steered; the waves are not to blame."

OVER_GROUND = " Lift and drag act on velocities over ground (absolute), as in the paper."


def carries_curve(ship: Ship) -> bool:
    """Do its equations carry the righting curve itself, so that no fit of it ends?"""
    return fitted_to(ship) == math.inf


def froude(speed: float, length: float) -> float:
    """Froude number of a speed [m/s] at a length [m]."""
    return speed / quantity("1 Fn", "speed", length=length)


def speed_words(speed: float, length: float) -> str:
    """A speed in m/s, knots and as Froude number.

    >>> speed_words(8.65, 121.92)
    '8.65 m/s (16.8 kn, Fn 0.250)'
    """
    knots = speed / quantity("1 kn", "speed")
    return f"{speed:.3g} m/s ({knots:.1f} kn, Fn {froude(speed, length):.3f})"


def duffing_words(beta: float, force: float, damping: float) -> str:
    """Duffing's equation with its numbers.

    >>> duffing_words(-0.2, 0.1, 0.0), duffing_words(0.2, 0.3, 0.05)
    ("x'' + x - 0.2 x³ = 0.1 cos ωt", "x'' + 0.05 x' + x + 0.2 x³ = 0.3 cos ωt")
    """
    friction = f" + {damping:g} x'" if damping else ""
    return f"x''{friction} + x {'-' if beta < 0 else '+'} {abs(beta):g} x³ = {force:g} cos ωt"


def metric_prefix(largest: float) -> tuple[float, str]:
    """Factor and prefix in which a largest value is written with few digits.

    >>> metric_prefix(19.3e6), metric_prefix(250.0)
    ((1000000.0, 'M'), (1.0, ''))
    """
    for factor, prefix in ((1e6, "M"), (1e3, "k")):
        if largest >= factor:
            return factor, prefix
    return 1.0, ""


def exponents_words(exponents: Iterable[complex], digits: int = 3) -> str:
    """Complex exponents in a line, conjugate pairs once.

    >>> exponents_words([-0.02 + 0.47j, -0.02 - 0.47j, -0.1])
    '-0.02 ± 0.47i, -0.1'
    """
    words = []
    for z in (complex(z) for z in exponents):
        if z.imag > 0:
            words.append(f"{z.real:.{digits}g} ± {z.imag:.{digits}g}i")
        elif z.imag == 0:
            words.append(f"{z.real + 0.0:.{digits}g}")
    return ", ".join(words) or "none"


def estimated_words(estimated: Mapping[str, Sequence[str]], provenance: Mapping[str, str]) -> str:
    """What in a result is estimated or assumed, in one line.

    estimated: method of estimate -> coefficients, of `estimates`
    provenance: where the ship's values come from: "assumed: .."

    >>> estimated_words({"regression": ["Y_v", "N_r"], "cross-flow drag": ["K_ppp"]}, {"gm": "assumed: 0.05 B"})
    'Estimated: velocity derivatives Y_v, N_r (regression); cubic damping K_ppp (cross-flow drag). Assumed: GM.'
    >>> estimated_words({"cross-flow drag": ["C_D"]}, {})
    'Estimated: C_D (cross-flow drag).'
    >>> estimated_words({"eddies of a heeled hull": ["K_pphiphi"]}, {})
    'Estimated: K_pphiphi (eddies of a heeled hull).'
    """
    parts = [
        f"{'' if DRAG_NAME in group else _ESTIMATED.get(method, '')}{_names(group)} ({method})"
        for method, group in estimated.items()
    ]
    assumed = [written(key) for key in _LOADING if provenance.get(key, "").startswith("assumed")]
    lines = [
        f"Estimated: {'; '.join(parts)}." if parts else "No coefficient rests on regression or on cross-flow drag."
    ]
    if assumed:
        lines.append(f"Assumed: {', '.join(assumed)}.")
    return " ".join(lines)


def _names(names: Sequence[str]) -> str:
    return ", ".join(names) if len(names) <= 4 else f"{names[0]} .. {names[-1]} ({len(names)})"


def provenance_of(text: str) -> dict[str, str]:
    """Where the loading values come from, out of the ``provenance`` attribute of a dataset.

    >>> provenance_of("lines: published: X; Y; gm: assumed: 0.05 B; usual; kg: derived: from KM")
    {'gm': 'assumed', 'kg': 'derived'}
    """
    found = {}
    for key in _LOADING:
        _, marker, after = f"; {text}".rpartition(f"; {key}: ")
        if marker:
            found[key] = after.split(":")[0]
    return found


def estimated_names(ds: xr.Dataset) -> list[str]:
    """Names of the coefficients of a map that are estimated."""
    return [name for name in str(ds.attrs["estimated_coefficients"]).split(", ") if name]


def estimates_of(attributes: Mapping[str, object]) -> dict[str, list[str]]:
    """Estimated coefficients by method, out of the attributes of a dataset."""
    if "estimated_by" not in attributes:  # a file of an earlier version names them alone
        names = [name for name in str(attributes["estimated_coefficients"]).split(", ") if name]
        return {"estimates": names} if names else {}
    groups = (part.split(": ") for part in str(attributes["estimated_by"]).split("; ") if part)
    return {method: names.split(", ") for method, names in groups}


def notes(ds: xr.Dataset) -> list[str]:
    """Small print of a map: what is estimated, and how it was computed."""
    words = estimated_words(estimates_of(ds.attrs), provenance_of(str(ds.attrs["provenance"])))
    ground = OVER_GROUND if ds.attrs.get("velocities") == "absolute" else ""
    damping = f" {sentence(ds.attrs['roll_damping'])}" if "roll_damping" in ds.attrs else ""
    return [f"{words}{damping}{ground} Steady motion: {ds.attrs['steady_motion']}; {ds.attrs['source']}."]


def ship_notes(one: Ship) -> str:
    """Small print of one condition: what is estimated, and by which version it was computed."""
    from quartering.hydro.coefficients import coefficients
    from quartering.hydro.decay.free_roll import damping_words
    from quartering.hydro.terms import estimates

    estimated = estimates(coefficients(one, 0.5, 0.0).table())
    ground = OVER_GROUND if one.velocities == "absolute" else ""
    damping = sentence(damping_words(one))
    return f"{estimated_words(estimated, one.provenance)} {damping}{ground} quartering {version('quartering')}."


def sentence(words: str) -> str:
    """Words with a capital and a full stop."""
    return f"{words[:1].upper()}{words[1:]}."


_MAP_OPTIONS = {"speed": "speed", "heading": "headings", "wave_length": "wave-lengths"}
"""Axes of a map as the options of `quartering polar` name them."""


def edge_words(ds: xr.Dataset, advice: str, otherwise: str = "") -> list[str]:
    """That the largest roll of a result stands on an edge of it, a sentence for all edges; nothing where it stands inside.

    ds: of `polar` or `sweep`
    advice: how to go on past an edge, with the axis in the place of {}
    otherwise: said after that
    """
    from quartering.study.maps.extension import edges_of_largest

    edges = edges_of_largest(ds)
    if not edges:
        return []
    length = float(ds.attrs["ship_length"])
    words = {
        "speed": lambda value: f"speed {speed_words(value, length)}",
        "heading": lambda value: f"heading {value:g} deg",
        "wave_length": lambda value: f"wave length {value:.4g} m, {value / length:.3g} L",
    }
    where = " and ".join(words[edge.axis](edge.value) for edge in edges)
    further = " and ".join(advice.format(_MAP_OPTIONS[edge.axis]) for edge in edges)
    return [
        f"The largest roll, {edges[0].roll:.3g} deg, stands on the edge of the map ({where}): the true largest may lie beyond;"
        f" extend with {further}{otherwise}."
    ]


def value_words(name: str, value: float, unit: str) -> str:
    """A value with its unit, or the word that it is the place of.

    >>> value_words("gm", 0.8, "m"), value_words("velocities", 1.0, "1")
    ('0.8 m', 'absolute')
    """
    from quartering.study.loadings import CHOICE_AXES

    if name in CHOICE_AXES:
        return CHOICE_AXES[name][int(value)]
    return f"{float(value):.4g}{in_unit(unit)}"


def verdict_words(one: xr.Dataset) -> str:
    """Verdict of one condition of a result.

    >>> import xarray as xr
    >>> verdict_words(xr.Dataset({"verdict": 1})), verdict_words(xr.Dataset({"verdict": 0, "capsizes_on_the_way": 3}))
    ('roll', 'stable motion, capsizes on the way')
    """
    from quartering.motion.status import OnTheWay
    from quartering.stability.kind import Kind
    from quartering.study.condition.beside import also_words
    from quartering.study.maps.query import capsizing, other_rolls

    words = OnTheWay.BOTH.label if bool(capsizing(one)) else Kind(int(one["verdict"])).label
    return f"{words}, {also_words(other_rolls(one).values)}".removesuffix(", ")


def wave_words(ds: xr.Dataset) -> str:
    """Height or steepness of the waves of a map."""
    height, length = np.asarray(ds["wave_height"]), np.asarray(ds["wave_length"])
    steepness = height / length
    if np.ptp(steepness) <= 1e-9 * steepness.max():
        one = Wave(float(length[0]), float(height[0]))
        slope = np.degrees(one.wavenumber * one.amplitude)
        return f"H/λ = {steepness_words(float(steepness[0]))} (wave slope kA = {slope:.2g}°)"
    return f"H = {height[0]:g} m" if np.ptp(height) == 0 else f"H = {height.min():.3g} to {height.max():.3g} m"


def more_harmonics_words(count: int, total: int, harmonics: int) -> str:
    """That some conditions want more harmonics than they were given.

    >>> more_harmonics_words(12, 481, 1)
    '12 of 481 conditions need more harmonics than 1 (roll more than 1 % different, by estimate): harmonics 3 or more.'
    """
    return (
        f"{count:,} of {total:,} conditions need more harmonics than {harmonics} (roll more than 1 % different, by estimate):"
        f" harmonics {harmonics + 2} or more."
    )


def harmonics_of(ds: xr.Dataset) -> int:
    """Highest harmonic of the motions of a result, out of its attributes.

    >>> import xarray as xr
    >>> harmonics_of(xr.Dataset(attrs={"steady_motion": "harmonic balance to order 5"}))
    5
    """
    last = str(ds.attrs["steady_motion"]).rpartition(" ")[2]
    return int(last) if last.isdigit() else 1


def sea_words(sea: str, value: float) -> str:
    """A wave height [m] or a steepness.

    >>> sea_words("wave_height", 3.0), sea_words("steepness", 0.02)
    ('wave height 3 m', 'steepness 1/50')
    """
    return f"wave height {value:.3g} m" if sea == "wave_height" else f"steepness {steepness_words(value)}"


def steepness_words(steepness: float) -> str:
    """A steepness as 1/n."""
    return f"1/{1 / steepness:.4g}" if steepness > 0 else "0"


def condition_words(ds: xr.Dataset) -> str:
    """What in a dataset of `quartering.vary` is the same everywhere: heading, speed and wave.

    >>> import xarray as xr
    >>> at = {"heading": 30.0, "speed": 7.5, "wave_length": 150.0, "wave_height": ("wave_height", [2.0, 4.0])}
    >>> condition_words(xr.Dataset(coords=at, attrs={"ship_length": 121.92}))
    'Heading 30 deg, 7.5 m/s (14.6 kn, Fn 0.217), wave length 150 m (1.23 L)'
    """
    length, words = float(ds.attrs["ship_length"]), []
    fixed = {name: float(ds[name]) for name in ("heading", "speed", "wave_length", "wave_height") if ds[name].ndim == 0}
    if "heading" in fixed:
        words.append(f"heading {fixed['heading']:g} deg")
    if "speed" in fixed:
        words.append(speed_words(fixed["speed"], length))
    if "wave_length" in fixed:
        words.append(f"wave length {fixed['wave_length']:.4g} m ({fixed['wave_length'] / length:.3g} L)")
    if "wave_height" in fixed:
        words.append(f"height {fixed['wave_height']:.3g} m")
    text = ", ".join(words)
    return text[:1].upper() + text[1:]


def row_words(row: xr.Dataset) -> str:
    """Name of a value of a tornado and what it is now."""
    name, unit = str(row["parameter"].values), str(row["unit"].values)
    if _is_coefficient(name):
        return name
    return f"{written(name)} {float(row['value']):.3g}{in_unit(unit)}"


def flip_words(row: xr.Dataset) -> str:
    """Where the verdict flips when only this value is changed."""
    from quartering.stability.kind import Kind

    flip = float(row["flip"])
    if not np.isfinite(flip):
        return ""
    name, unit = str(row["parameter"].values), str(row["unit"].values)
    times = "x " if _is_coefficient(name) else ""
    return f"{Kind(int(row['verdict_beyond'])).label} at {times}{flip:.3g}{in_unit(unit)}"


def _is_coefficient(name: str) -> bool:
    return name[0] in "YKN" and "_" in name


def forces_note(compared: xr.Dataset) -> str:
    """What the forms of a comparison are, about which point, from which source, by which mesh.

    compared: of `compare_forces`
    """
    from quartering.loads.comparison import MEANINGS, PANELS

    meanings = "; ".join(f"{form}: {MEANINGS[form]}" for form in map(str, compared["form"].to_numpy()))
    mesh = f" Panels: {compared.attrs['panels']}." if PANELS in compared["form"] else ""
    ends = "" if compared.attrs["ends"] == "strips" else f" Strips {ENDS_WORDS}."
    ends += OVER_GROUND if compared.attrs["velocities"] == "absolute" else ""
    papers = (REFERENCES[key].partition(")")[0] + ")" for key in compared.attrs["references"].split(", "))
    return f"Moments about {compared.attrs['reference_point']}. {meanings}.{ends}{mesh} Sources: {'; '.join(papers)}."
