"""Plotly figures of the panels, as plain dictionaries; their text takes its colour from the page."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from quartering.conventions import SYMBOLS, written
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.contour import along, contour_curve
from quartering.hull.righting.arm import righting_arm, righting_polynomial
from quartering.hull.ship import Ship
from quartering.stability.kind import Kind
from quartering.stability.verdict import Verdict
from quartering.view.explorer.computing.computations import History, Scene

Chart = dict[str, Any]
BLUE, ORANGE, GREEN, GREY = "#2f86c9", "#d9702b", "#1f9e77", "#8a919c"
"""Colours that hold on white and on black, and for colour-blind people; dashes and marks say the same."""

_MOST_BARS = 10
_MOST_SECTIONS = 24
_AXIS = {"zeroline": False, "ticks": "outside", "ticklen": 4, "title": {"standoff": 8}, "automargin": True}


def _chart(
    traces: Sequence[Mapping[str, Any]], x: str, y: str, *, height: int = 260, legend: bool = True, **layout: Any
) -> Chart:
    """A figure with one pair of axes; what `layout` says of an axis is added to it."""
    axes = {name: _axis(title) | layout.pop(name, {}) for name, title in (("xaxis", x), ("yaxis", y))}
    return {
        "data": list(traces),
        "layout": {
            "height": height,
            "margin": {"l": 52, "r": 12, "t": 26 if legend else 10, "b": 42},
            "paper_bgcolor": "rgba(0,0,0,0)",
            "plot_bgcolor": "rgba(0,0,0,0)",
            "font": {"family": "inherit", "size": 12},
            "showlegend": legend,
            "legend": {"orientation": "h", "x": 0, "y": 1.0, "yanchor": "bottom", "bgcolor": "rgba(0,0,0,0)"},
            "hovermode": "closest",
            **axes,
            **layout,
        },
        "config": {"displayModeBar": False, "responsive": False},  # page.js fits what is displayed
    }


def _axis(title: str) -> dict[str, Any]:
    return _AXIS | {"title": {"text": title, "standoff": 8}}


def _line(x: Any, y: Any, name: str, colour: str, dash: str = "solid", **more: Any) -> dict[str, Any]:
    shape = {"color": colour, "width": 1.8, "dash": dash}
    return {"type": "scatter", "mode": "lines", "x": _list(x), "y": _list(y), "name": name, "line": shape} | more


def _hatch(shape: str | list[str]) -> dict[str, Any]:
    """Pattern over the colour of a bar, for those who cannot tell the colours."""
    return {"shape": shape, "fillmode": "overlay", "fgcolor": "#ffffff", "size": 6, "solidity": 0.2}


def _list(values: Any) -> list[float | None]:
    """Numbers for JSON, four or five digits of them; None where there is none."""
    return [float(f"{v:.5g}") if math.isfinite(v) else None for v in np.asarray(values, dtype=float).ravel()]


def spectrum(sigma: Any, density: Any, met: Sequence[float]) -> Chart:
    """Density of a sea over wave frequency; dashed where its waves meet the ship at the frequency of roll."""
    top = float(np.max(density))
    traces = [_line(sigma, density, "sea", BLUE)]
    for i, at in enumerate(met):
        traces.append(_line([at, at], [0.0, top], "met at the roll frequency", ORANGE, "dash", showlegend=i == 0))
    return _chart(traces, "wave frequency [rad/s]", "density [m² s/rad]", height=220)


def time_history(found: History) -> Chart:
    """Roll in time after a push, and the steady motion it leaves or returns to."""
    time = found.trace["time"].values
    traces = [_line(time, found.trace["roll"].values, found.start, BLUE)]
    if np.isfinite(found.steady).all():
        traces.append(_line(time, np.degrees(found.steady[:, 1]), "steady motion", ORANGE, "dot"))
    return _chart(traces, "time [s]", "roll [deg]")


def harmonics(orders: Sequence[int], sizes: np.ndarray) -> Chart:
    """Amplitudes (h, 3) of the harmonics of sway [m], roll and yaw [rad]."""
    names = (
        ("sway [m]", GREY, 1.0, "x"),
        ("roll [deg]", BLUE, math.degrees(1), ""),
        ("yaw [deg]", ORANGE, math.degrees(1), "/"),
    )
    traces = [
        {
            "type": "bar", "x": [f"{n} ω" for n in orders], "y": _list(factor * sizes[:, i]), "name": name,
            "marker": {"color": colour, "pattern": _hatch(pattern)},
        }
        for i, (name, colour, factor, pattern) in enumerate(names)
    ]  # fmt: skip
    return _chart(traces, "", "amplitude", height=200, yaxis={"type": "log", "exponentformat": "power", "dtick": 1})


def unit_circle(v: Verdict) -> Chart:
    """Floquet multipliers in the complex plane."""
    angle = np.linspace(0.0, 2 * np.pi, 121)
    inside = np.abs(v.multipliers) < 1.0
    traces = [_line(np.cos(angle), np.sin(angle), "unit circle", GREY, hoverinfo="skip")]
    for name, chosen, colour, mark in (
        ("inside: dies out", inside, BLUE, "circle"),
        ("outside: grows", ~inside, ORANGE, "x"),
    ):
        z = v.multipliers[chosen]
        if z.size:
            traces.append({
                "type": "scatter", "mode": "markers", "x": _list(z.real), "y": _list(z.imag), "name": name,
                "marker": {"color": colour, "symbol": mark, "size": 10},
            })  # fmt: skip
    reach = max(1.15, 1.1 * float(np.nan_to_num(np.abs(v.multipliers)).max()))
    square = {"range": [-reach, reach]}
    return _chart(
        traces, "Re μ", "Im μ", height=300, xaxis=square | {"constrain": "domain"},
        yaxis=square | {"scaleanchor": "x", "constrain": "domain"},
    )  # fmt: skip


def response_curve(curve: xr.Dataset, over: str, now: float, roll: float) -> Chart:
    """Largest roll along the branch of motions; unstable parts dashed, folds and other events marked."""
    x, y = curve[over].values, curve["roll_peak"].values
    stable = curve["verdict"].values == Kind.STABLE
    traces = []
    for chosen, name, colour, dash in ((stable, "stable", BLUE, "solid"), (~stable, "unstable", ORANGE, "dot")):
        beside = chosen.copy()  # one point more at either end, so that the parts meet
        beside[1:] |= chosen[:-1]
        if chosen.any():
            traces.append(_line(np.where(beside, x, np.nan), np.where(beside, y, np.nan), name, colour, dash))
    marks = {
        "fold": "diamond",
        "symmetry-breaking": "triangle-up",
        "neimark-sacker": "star",
        "period-doubling": "square",
    }
    events = curve["event"].values
    for name, symbol in marks.items():
        if (at := events == name).any():
            traces.append({
                "type": "scatter", "mode": "markers", "x": _list(x[at]), "y": _list(y[at]), "name": name.replace("-", " "),
                "marker": {"symbol": symbol, "size": 9, "color": GREEN, "line": {"width": 1, "color": "#ffffff"}},
            })  # fmt: skip
    if math.isfinite(roll):
        here = {"symbol": "circle-open", "size": 12, "color": GREY, "line": {"width": 2}}
        traces.append({
            "type": "scatter", "mode": "markers", "x": [now], "y": [roll], "name": "this condition", "marker": here,
        })  # fmt: skip
    meaning = "encounter frequency" if over == "frequency" else over.replace("_", " ")
    return _chart(
        traces,
        f"{meaning} [{SYMBOLS[over].unit}]",
        "largest roll over a cycle [deg]",
        height=380,
        yaxis={"rangemode": "tozero"},
    )


def tornado(found: xr.Dataset, of: str) -> Chart:
    """The parameters that matter most for roll or for the leading exponent, per 10 % of change."""
    change = 0.1 * found[of].values
    kept = np.argsort(np.abs(change))[-_MOST_BARS:]
    names = [str(found["parameter"].values[i]) for i in kept]
    words = [written(name) for name in names]
    worse = change[kept] > 0
    bars = {
        "type": "bar", "orientation": "h", "y": words, "x": _list(change[kept]),
        "marker": {
            "color": [ORANGE if w else BLUE for w in worse],
            "pattern": _hatch(["/" if w else "" for w in worse]),
        },
        "hovertemplate": "%{y}: %{x}<extra></extra>",
    }  # fmt: skip
    what = "roll amplitude, fundamental [deg]" if of == "roll" else "leading exponent [1/s]"
    return _chart(
        [bars], f"change of {what} per +10 %", "", height=360, legend=False, xaxis={"zeroline": True, "zerolinewidth": 1},
    )  # fmt: skip


def body_plan(ship: Ship) -> Chart:
    """Sections, fore body on the right, and the waterline with G and M."""
    hull = ship.hull
    step = -(-len(hull.x) // _MOST_SECTIONS)
    traces = []
    for i in range(0, len(hull.x), step):
        curve = contour_curve(*hull.contours[i], hull.outline)
        y, height, *_ = along(curve, np.linspace(curve.chord[0], curve.chord[-1], 60))
        fore = hull.x[i] > 0
        traces.append(
            _line(y if fore else -y, height, f"x = {hull.x[i]:.3g} m", BLUE if fore else ORANGE, hoverinfo="name")
        )
    widest = 1.1 * max(float(y.max()) for y, _ in hull.contours)
    floating = hydrostatics(ship)
    traces.append(_line([-widest, widest], [hull.draught] * 2, f"T = {hull.draught:.3g} m", GREY, "dash"))
    traces.append({
        "type": "scatter", "mode": "markers+text", "x": [0, 0], "y": _list([floating.kg, floating.km]), "text": ["G", "M"],
        "textposition": "middle right", "marker": {"color": GREY, "size": 8}, "hoverinfo": "text+y",
    })  # fmt: skip
    return _chart(
        traces, "aft body ← half breadth [m] → fore body", "height [m]", height=260, legend=False,
        yaxis={"scaleanchor": "x"},
    )  # fmt: skip


def righting(ship: Ship) -> Chart:
    """Righting arm of the heeled hull, the polynomial fitted to it, and GM as a slope."""
    fit = righting_polynomial(ship)
    angles = np.linspace(0.0, 60.0, 31)
    fitted = np.linspace(0.0, fit.max_angle, 31)
    unused = "" if ship.righting == "polynomial" else ", not used"
    traces = [
        _line(angles, righting_arm(ship, angles), "heeled hull", BLUE),
        _line(fitted, fit.arm(fitted), f"polynomial, to {fit.max_angle:g}°{unused}", ORANGE, "dash"),
        _line([0, 30], [0, fit.gm * math.radians(30)], "slope GM", GREY, "dot"),
    ]
    return _chart(traces, "heel [deg]", "righting arm GZ [m]", height=240)


def place_on(over: str, of: Scene, frequency: float) -> float:
    """Where a condition lies on the axis of its response curve."""
    here = {"wave_height": of.wave.height, "wave_length": of.wave.length, "speed": of.speed, "frequency": frequency}
    return float(here[over])
