"""Response curves: the branches of motions over one parameter, each point judged, each change of stability located."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering._machine.threads import small_matrices
from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.ship import Ship
from quartering.hull.told import condition, count
from quartering.hydro.capsize import capsize_limit
from quartering.loads.waves import Wave
from quartering.motion.branches.branch import Curve, Family, follow_branch, start_of_branch, within
from quartering.motion.branches.isola import loops
from quartering.motion.branches.switching import doubled, leaning, strength
from quartering.motion.equations.model import Model
from quartering.motion.equations.system import Floats
from quartering.motion.modes import Modes, in_six
from quartering.motion.steady.motion import peaks
from quartering.motion.steady.subharmonic import columns
from quartering.stability.precompile import announce_compilation
from quartering.study.branches.events import PERIOD_DOUBLING, SYMMETRY_BREAKING, judged, with_events
from quartering.study.branches.family import Limits, family, parameter_attributes
from quartering.study.dataset import amplitudes_named

_MOST_BRANCHES = 12


class Line(NamedTuple):
    """One curve of motions: where it began, its points (n, m + 1), what happens at each, whether it closes."""

    curve: Curve
    origin: str
    points: Floats
    events: NDArray[np.str_]
    closed: bool


@takes(ship_or_model="Ship, Model", over="word", wave="Wave, None")
def branch(
    ship_or_model: Ship | Model,
    over: str = "frequency",
    *,
    limits: Limits = None,
    harmonics: int = 9,
    wave: Wave | None = None,
    speed: float | str = 0.0,
    heading: float | str = 90.0,
    points: int = 2000,
    modes: Modes = "three",
) -> xr.Dataset:
    """Follow the periodic motions over one parameter through their folds and onto every branch that leaves them.

    Parameters
    ----------
    ship_or_model : Ship or Model    a ship needs `wave`, `speed` and `heading`
    over : str                       "frequency" [rad/s] or "excitation" (share of the wave force), coefficients held; the name
                                     of a term, as a multiplier; for a ship also "speed" [m/s], "heading" [deg],
                                     "wave_length", "wave_height" [m], or a loading value such as "gm" [m]
    limits : (low, high)             of the parameter, or text with a unit; by default 0.5 to 1.5 times its value (0 to 2 for
                                     an excitation)
    harmonics : int                  highest harmonic of the wave's frequency, odd
    wave, speed, heading             of a ship [m/s, deg]
    points : int                     of one curve, at the most
    modes : str                      "three": sway, roll and yaw; "six": heave and pitch too, in the pressure over the whole
                                     wetted hull, over "wave_height", "speed" or "heading" of a ship: motions of one wave period
                                     and of two (`parametric_roll`), head and following seas among them

    Returns
    -------
    xarray.Dataset    along ``point``: the parameter, sway_amplitude [m], roll_amplitude, yaw_amplitude (of the wave's
                      frequency), roll_peak [deg], exponent [1/s], verdict; ``multiplier_real`` and ``multiplier_imag`` over
                      one period of the motion; ``event`` is "fold", "symmetry-breaking", "neimark-sacker" or
                      "period-doubling" where stability changes or the curve turns back, and "" elsewhere; ``fold`` is True
                      at the folds.  The curves stand one after the other: ``curve`` is 0 on the one from the start and
                      counts up, ``origin`` says where a curve began ("start", "symmetry-breaking", "period-doubling",
                      "search"), ``periods`` is 2 where a motion repeats after two wave periods, ``closed`` is True on a
                      curve that returns to its beginning; the attributes say the parameter, ``over``, and the highest of
                      the ``harmonics`` taken

    Raises
    ------
    InputError        unknown parameter, limits that do not rise, no motion to start from

    Notes
    -----
    Pseudo-arclength continuation from the motion at the lower limit.  Where it loses its symmetry the leaning motions are
    followed (one of each mirrored pair), where its period doubles those of two wave periods; further doublings are
    marked, not followed.  Loops that touch none of these are found from motions at values between the limits (see
    `quartering.motion.branches.isola`): nothing proves that none is missed.  Several motions coexist where the curves pass one
    value more than once.  A ship's curves end at its capsize limit (`capsize_limit`); its
    coefficients and forces are splined through 65 values of the parameter.
    Source: [Krack19]; [H71] eq. (A-11).

    Examples
    --------
    >>> terms = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.2, "K_p": -0.04}
    >>> model = Model(np.eye(3), terms, 1.0, (0, 0.1, 0), (0, 0, 0))
    >>> curve = branch(model, "frequency", limits=(0.8, 1.5), harmonics=1)
    >>> curve["frequency"][curve["event"] == "fold"].values.round(2).tolist()
    [1.26, 1.1]
    """
    speed, heading = condition(ship_or_model if isinstance(ship_or_model, Ship) else None, speed, heading)
    count("points", points, 2, 2000)
    if in_six(modes):
        from quartering.study.six_modes.branch import branch_six

        if not isinstance(ship_or_model, Ship) or wave is None:
            raise InputError(
                'modes = six takes a ship and its wave; try branch(ship, "wave_height", wave=wave, modes="six")'
            )
        if (harmonics, points) != (9, 2000):
            raise InputError("modes = six has harmonics and points of its own; leave both out")
        return branch_six(ship_or_model, wave, speed, heading, over, limits)
    announce_compilation()
    low, high, at = family(ship_or_model, over, limits, wave, speed, heading)
    with small_matrices():
        parts = [
            _columns(line, i, over, low, high)
            for i, line in enumerate(lines_of(at, harmonics, points, steepest_of(ship_or_model)))
        ]
    whole = amplitudes_named(xr.concat(parts, "point"))
    return whole.assign_attrs(over=over, references=references_of(ship_or_model), harmonics=harmonics)


def lines_of(at: Family, harmonics: int, points: int = 2000, steepest: float = np.inf) -> list[Line]:
    """Every curve of motions found over one parameter, the one from the start first.

    at: of the parameter (0 to 1), gives the system
    harmonics: highest harmonic of the wave's frequency, odd
    points: of one curve, at the most
    steepest: roll past which no curve is followed [rad]

    See `branch`.
    """
    curve, start = start_of_branch(at, harmonics)
    path, folds = follow_branch(curve, start, points, go_on=within(curve, steepest))
    lines = [Line(curve, "start", *with_events(curve, path.points, folds), path.closed)]
    for own, loop, folds in loops(curve, path.points, points, steepest):
        lines.append(Line(own, "search", *with_events(own, loop.points, folds), loop.closed))
    for line in lines:  # grows while it is gone through: a branch that left may lose its own symmetry or period
        if len(lines) < _MOST_BRANCHES:
            lines += _leaving(line, [other for other in lines if other.origin != "start"], points, steepest)
    return lines


def steepest_of(ship_or_model: Ship | Model) -> float:
    """Largest admissible roll [rad]: the capsize limit of a ship; no bound for bare numbers."""
    return capsize_limit(ship_or_model).radians if isinstance(ship_or_model, Ship) else np.inf


def references_of(ship_or_model: Ship | Model) -> str:
    """Keys of the papers behind curves of motions, for a dataset."""
    own = ship_or_model.references if isinstance(ship_or_model, Model) else ("H71", "STF70")
    return ", ".join((*own, "Krack19"))


def _leaving(line: Line, known: list[Line], points: int, steepest: float) -> list[Line]:
    """The branches that leave a curve, each once though it may leave at one point and come back at another."""
    symmetric = all(h % 2 == 1 for h in line.curve.orders)
    name, switch = (SYMMETRY_BREAKING, leaning) if symmetric else (PERIOD_DOUBLING, doubled)
    if line.curve.periods > 1:
        return []
    found: list[Line] = []
    for event in line.points[line.events == name]:
        left = switch(line.curve, event)
        if left is None or any(_ends_at(other, left[0], event) for other in (*known, *found)):
            continue
        curve, start, along = left
        path, folds = follow_branch(curve, start, points, along=along, go_on=_away(curve, start, steepest))
        found.append(Line(curve, name, *with_events(curve, path.points, folds), path.closed))
    return found


def _away(curve: Curve, start: Floats, steepest: float) -> Callable[[Floats], bool]:
    """Is a branch that left another one still on its own side of it?"""
    home, low = strength(curve, start[None])[0], within(curve, steepest)
    return lambda point: bool(strength(curve, point[None])[0] @ home > 0) and low(point)


def _ends_at(line: Line, curve: Curve, event: Floats) -> bool:
    """Is a branch that left elsewhere back at this point of the first one?"""
    if line.curve.orders != curve.orders or line.curve.periods != curve.periods:
        return False
    return bool(abs(line.points[-1, -1] - event[-1]) < 0.02 and np.abs(strength(curve, line.points[-1:])).max() < 0.2)


def _columns(line: Line, number: int, over: str, low: float, high: float) -> xr.Dataset:
    """One curve as a dataset along ``point``."""
    result = judged(line.curve, line.points)
    u, orders = line.curve.motions(line.points)
    own = columns(orders)[line.curve.periods]
    amplitude = np.hypot(u[:, :, own.start], u[:, :, own.start + 1])
    roll, yaw = np.degrees(amplitude[:, 1]), np.degrees(amplitude[:, 2])
    share = line.points[:, -1]
    values = {
        over: low * (1 - share) + high * share, "sway": amplitude[:, 0], "roll": roll, "yaw": yaw,
        "roll_peak": np.degrees(peaks(u, orders)[:, 1]), "exponent": result.floquet.growth, "verdict": result.kind,
    }  # fmt: skip
    ds = xr.Dataset({name: ("point", v, parameter_attributes(name)) for name, v in values.items()})
    count = len(line.points)
    words = {
        "event": (line.events, "what happens here"),
        "fold": (line.events == "fold", "the parameter turns back here"),
        "curve": (np.full(count, number), "number of the curve"),
        "origin": (np.full(count, line.origin), "where the curve began"),
        "periods": (np.full(count, line.curve.periods), "wave periods after which the motion repeats"),
        "closed": (np.full(count, line.closed), "the curve returns to its beginning"),
    }
    made: dict[str, object] = {
        name: ("point", v, {"units": "1", "long_name": text, "symbol": ""}) for name, (v, text) in words.items()
    }
    for part in ("real", "imag"):
        text = {"units": "1", "long_name": f"{part} part of the Floquet multipliers", "symbol": "mu"}
        made[f"multiplier_{part}"] = (("point", "multiplier"), getattr(result.floquet.multipliers, part), text)
    return ds.assign(made)
