"""Broaching: is a ship that a wave carries along stable on its course, and with which autopilot?"""

from __future__ import annotations

import copy
import math
from dataclasses import dataclass
from enum import IntEnum
from itertools import pairwise
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.autopilot import Autopilot
from quartering.hull.propulsion import Propulsion
from quartering.hull.ship import Ship
from quartering.hull.told import number
from quartering.hydro.propulsion import Drive, drive_of
from quartering.loads.waves import Wave
from quartering.motion.wave_equilibria import Equilibrium, Search, places, straight
from quartering.motion.wave_riding import PLACE, ROLL, YAW, P, R, Rider, U, V

Complex = NDArray[np.complex128]
Kind = Literal["stable surf-riding", "broaches", "oscillates", "capsizes", "not on the wave"]

FURTHEST: Final = 60.0
"""Heading ordered up to which equilibria are followed [deg]."""
HARD_OVER: Final = 35.0
"""Rudder angle beyond which no rudder goes [deg]."""
LARGEST_GAIN: Final = 20.0
"""Gain up to which a stable course is looked for."""
_GAINS: Final = np.append(0.0, np.geomspace(0.02, LARGEST_GAIN, 31))


class OnTheWave(IntEnum):
    """Whether a ship is carried along by a wave; `advice` says what to try.

    Examples
    --------
    >>> OnTheWave.FOUND.ok, OnTheWave.PASSED.ok
    (True, False)
    """

    FOUND = 0
    PASSED = 1
    NO_PROPULSION = 2
    LOST_ON_THE_WAY = 3
    BEYOND_THE_RUDDER = 4

    @property
    def ok(self) -> bool:
        """Is there an equilibrium a rudder can hold?"""
        return self is OnTheWave.FOUND

    @property
    def advice(self) -> str:
        """One line: what happened and what to try."""
        return _ADVICE[self]


_ADVICE: Final = {
    OnTheWave.FOUND: "the wave carries the ship along",
    OnTheWave.PASSED: "at these revolutions the wave does not hold the ship: no surf-riding and no broaching out of it; see "
    "surf_riding for the speeds at which it does",
    OnTheWave.NO_PROPULSION: "no propulsion was given and none can be estimated: give resistance and propeller",
    OnTheWave.LOST_ON_THE_WAY: "the equilibria on the wave end before this heading: the wave lets the ship go there; try less",
    OnTheWave.BEYOND_THE_RUDDER: "the equilibrium asks for more rudder than 35 deg: the ship turns; steer nearer to the wave's "
    "direction, or slow down below surf-riding",
}


@dataclass(frozen=True, eq=False)
class Broaching:
    """A ship carried along by a wave, and its course.

    Parameters
    ----------
    ship : str
    wave : Wave
    status : OnTheWave
    source : str                  of resistance and thrust
    speed, revolutions : float    nominal, in calm water [m/s], and of the propeller [1/s]
    heading : float               ordered, off the wave's direction [deg]
    place : float                 k xi of G from a trough, below 0 on the face ahead of a crest [deg]
    yaw, heel, rudder : float     of the equilibrium [deg]
    gm : float                    -dK/dphi over the weight, heave and trim held [m]
    yaw_slope : float             dN/dpsi of the pressure: above 0 it turns the ship away [N m/rad]
    eigenvalues : (s,) complex    of small disturbances, the fastest growing first [1/s]
    growth, tenfold : float       of the fastest [1/s]; time to grow tenfold, infinite where it does not [s]
    gain, rate_gain, lag : float  of the autopilot; 0 without one
    critical_gain : float         least gain with which the course straight ahead is stable, rate gain and lag kept; infinite:
                                  none
    stable_to, exists_to : float  heading up to which the equilibria are stable, and are there, at most 60; NaN without an
                                  autopilot [deg]
    kind : str                    "stable surf-riding", "broaches", "oscillates", "capsizes" or "not on the wave"
    sentence : str
    """

    ship: str
    wave: Wave
    status: OnTheWave
    source: str
    speed: float
    revolutions: float
    heading: float
    place: float
    yaw: float
    heel: float
    rudder: float
    gm: float
    yaw_slope: float
    eigenvalues: Complex
    growth: float
    tenfold: float
    gain: float
    rate_gain: float
    lag: float
    critical_gain: float
    stable_to: float
    exists_to: float
    kind: Kind
    sentence: str

    def __repr__(self) -> str:
        return f"<Broaching {self.sentence}>"

    def __str__(self) -> str:
        return self.sentence


_EMPTY: Final[dict[str, Any]] = {
    **dict.fromkeys(
        ("revolutions", "place", "yaw", "heel", "rudder", "gm", "yaw_slope", "growth", "tenfold", "critical_gain", "stable_to",
         "exists_to"), math.nan,
    ),
    "eigenvalues": np.empty(0, dtype=complex), "source": "none",
}  # fmt: skip


@takes(ship="Ship", wave="Wave", propulsion="Propulsion, None")
def broaching(
    ship: Ship,
    wave: Wave,
    speed: float | str,
    heading: float | str = 0.0,
    propulsion: Propulsion | None = None,
) -> Broaching:
    """Equilibrium of a ship that a following or quartering wave carries along, and the stability of its course.

    Parameters
    ----------
    ship : Ship                with an autopilot, or the rudder stays amidships
    wave : Wave
    speed : float              nominal, that of the ship in calm water at the same revolutions [m/s]
    heading : float            ordered, off the wave's direction, 0 following [deg]
    propulsion : Propulsion    resistance and thrust; None: the ship's own, or an estimate, which is said

    Returns
    -------
    Broaching

    Raises
    ------
    InputError    a wave of no height, a heading above 60 deg, a number out of its range

    Notes
    -----
    Eigenvalues of the equations in body axes, linear about the equilibrium on the face of the wave; heave and trim in balance
    at every instant, pressure over the instantaneous wetted hull, lift and drag in the orbital motion of the water. Neglected:
    the orbital motion in the speed at hull, rudder and propeller; drag of rudder and drift; the limit of the rudder's angle.
    Source: closed form; [Holtrop82], [Holtrop84] where no propulsion is given.  Valid: regular wave, deep water.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> found = broaching(ship("s175"), Wave(175.0, 6.0), "0.35 Fn")
    >>> found.kind, found.yaw_slope > 0, 0.05 < found.critical_gain < 2
    ('broaches', True, True)
    """
    U0, mu = number(ship, "speed", speed), number(ship, "heading", heading)
    if not wave.height > 0:
        raise InputError("wave_height = 0 m; broaching needs a wave; try 0.03 of its length")
    if not 0 <= mu <= FURTHEST:
        raise InputError(f"heading = {mu:g} deg; it is from 0 (following) to {FURTHEST:g} deg; try 20")
    if mu > 0 and (ship.autopilot is None or ship.autopilot.gain == 0):
        raise InputError(
            f'heading = {mu:g} deg; without an autopilot no heading is held; give one, such as autopilot="1,10s"'
        )
    pilot = ship.autopilot or Autopilot(0.0)
    facts: dict[str, Any] = dict(_EMPTY) | {
        "ship": ship.name, "wave": wave, "speed": U0, "heading": mu, "gain": pilot.gain, "rate_gain": pilot.rate_gain,
        "lag": pilot.lag, "kind": "not on the wave",
    }  # fmt: skip
    try:
        drive = drive_of(ship, propulsion, estimate=True)
    except InputError:
        drive = None
    facts |= {"status": OnTheWave.NO_PROPULSION} if drive is None else _carried(ship, wave, drive, U0, mu)
    return Broaching(**facts, sentence=_sentence(facts))


def rider_of(ship: Ship, wave: Wave, drive: Drive) -> Rider:
    """The equations of a ship that a wave carries along."""
    return Rider(ship, wave, drive.propulsion, ship.autopilot)


def _carried(ship: Ship, wave: Wave, drive: Drive, speed: float, heading: float) -> dict[str, Any]:
    """The equilibrium and what follows from it."""
    n = drive.propulsion.revolutions(speed, ship.loading.density)
    rider = rider_of(ship, wave, drive)
    facts: dict[str, Any] = {"source": drive.source, "revolutions": n, "status": OnTheWave.PASSED}
    search = Search(rider, "heading", n)
    start = straight_ahead(rider, search, n)
    if start is None:
        return facts
    facts["critical_gain"] = critical_gain(rider, start, n)
    if rider.gain == 0:
        return facts | _of(rider, search.judged(start))
    points = search.branch(start, math.radians(FURTHEST))
    facts |= _range(points, [search.judged(one) for one in points])
    point = start if heading == 0 else _at(search, points, math.radians(heading))
    if point is None:
        return facts | {"status": OnTheWave.LOST_ON_THE_WAY}
    found = search.judged(point)
    return facts | _of(rider, found)


def straight_ahead(rider: Rider, search: Search, revolutions: float) -> Any:
    """The equilibrium straight ahead that is stable in surge; None without one."""
    for place, stable in places(rider, revolutions):
        if stable and (found := search.at(straight(rider, place))) is not None:
            return found
    return None


def _at(search: Search, points: list[Any], heading: float) -> Any:
    """The first equilibrium of a branch at a heading."""
    for a, b in pairwise(points):
        if (a[5] - heading) * (b[5] - heading) <= 0 and a[5] != b[5]:
            share = (heading - a[5]) / (b[5] - a[5])
            return search.at((1 - share) * a + share * b)
    return None


def _range(points: list[Any], judged: list[Equilibrium]) -> dict[str, float]:
    """Headings up to which equilibria are stable, and exist."""
    headings = np.degrees([one[5] for one in points])
    growth = np.array([one.growth for one in judged])
    first = np.flatnonzero(growth > 0)
    stable = FURTHEST
    if first.size:
        k = int(first[0])
        t = growth[k - 1] / (growth[k - 1] - growth[k]) if k else 0.0
        stable = float(headings[k - 1] + t * (headings[k] - headings[k - 1])) if k else 0.0
    return {"stable_to": min(stable, FURTHEST), "exists_to": float(min(headings.max(), FURTHEST))}


def _of(rider: Rider, found: Equilibrium) -> dict[str, Any]:
    """What is told of an equilibrium."""
    y = found.state
    held = rider.loads(y[[PLACE]], y[[ROLL]], y[[YAW]])
    small = 1e-3
    turned = rider.loads(y[[PLACE, PLACE]], y[[ROLL, ROLL]], y[YAW] + small * np.array([1.0, -1.0]))
    gm = float(-held.slope[0, 3, 1] / (-held.load[0, 2]))
    rudder = math.degrees(found.rudder)
    beyond = abs(rudder) > HARD_OVER
    return {
        "place": math.degrees(y[PLACE]), "yaw": math.degrees(y[YAW]), "heel": math.degrees(y[ROLL]), "rudder": rudder,
        "gm": gm, "yaw_slope": float(turned.load[0, 5] - turned.load[1, 5]) / (2 * small), "eigenvalues": found.eigenvalues,
        "growth": found.growth, "tenfold": math.log(10) / found.growth if found.growth > 0 else math.inf,
        "kind": _kind(found, gm),
        "status": OnTheWave.BEYOND_THE_RUDDER if beyond else OnTheWave.FOUND,
    }  # fmt: skip


def _kind(found: Equilibrium, gm: float) -> Kind:
    if not found.growth > 0:
        return "stable surf-riding"
    if gm < 0:
        return "capsizes"
    return "broaches" if abs(found.eigenvalues[0].imag) < 1e-9 else "oscillates"


def critical_gain(rider: Rider, point: Any, revolutions: float) -> float:
    """Least gain of the autopilot with which the course of a ship that runs straight with the wave is stable.

    rate gain and lag stay; of sway, roll and yaw alone, which surge leaves alone there
    Returns 0 where the rudder amidships suffices, infinity where no gain up to `LARGEST_GAIN` does
    """
    y = np.zeros(7)
    y[[PLACE, U]] = point[0], point[4]
    still = copy.copy(rider)
    still.gain, still.rate_gain, still.lag = 0.0, 0.0, 0.0
    free = still.matrix(y, revolutions, 0.0)[np.ix_([V, P, R, ROLL, YAW], [V, P, R, ROLL, YAW])]
    still.gain = 1.0
    blade = (free - still.matrix(y, revolutions, 0.0)[np.ix_([V, P, R, ROLL, YAW], [V, P, R, ROLL, YAW])])[:3, 4]

    def growth(gain: float) -> float:
        return float(np.linalg.eigvals(_steered(free, blade, gain, rider.rate_gain, rider.lag)).real.max())

    values = np.array([growth(float(one)) for one in _GAINS])
    if values[0] < 0:
        return 0.0
    below = np.flatnonzero(values < 0)
    if not below.size:
        return math.inf
    low, high = float(_GAINS[below[0] - 1]), float(_GAINS[below[0]])
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if growth(middle) < 0 else (middle, high)
    return high


def _steered(free: Any, blade: Any, gain: float, rate_gain: float, lag: float) -> Any:
    """Matrix of (v, p, r, roll, yaw[, rudder]) with an autopilot."""
    size = 6 if lag > 0 else 5
    matrix = np.zeros((size, size))
    matrix[:5, :5] = free
    if lag > 0:
        matrix[:3, 5] = blade
        matrix[5, [2, 4, 5]] = -rate_gain / lag, -gain / lag, -1 / lag
    else:
        matrix[:3, 4] -= gain * blade
        matrix[:3, 2] -= rate_gain * blade
    return matrix


def _sentence(facts: dict[str, Any]) -> str:
    """The answer in words."""
    f, wave = facts, facts["wave"]
    where = (
        f"{f['ship']} at {f['speed']:.3g} m/s nominal, {f['heading']:g} deg off a wave {wave.length:.4g} m long and "
        f"{wave.height:.3g} m high"
    )
    driven = f" Resistance and thrust {f['source']}." if f["source"].startswith("estimated") else ""
    if f["status"] in (OnTheWave.PASSED, OnTheWave.NO_PROPULSION, OnTheWave.LOST_ON_THE_WAY):
        end = f" They end at {f['exists_to']:.3g} deg." if f["status"] is OnTheWave.LOST_ON_THE_WAY else ""
        return f"{where}: {f['status'].advice}.{end}{driven}"
    what = {
        "stable surf-riding": "the wave carries it along on a stable course (disturbances decay at "
        f"{-f['growth']:.3g} 1/s at least)",
        "broaches": f"it turns away and broaches: a deviation grows tenfold in {f['tenfold']:.3g} s",
        "oscillates": f"it yaws about its course with growing swings, tenfold in {f['tenfold']:.3g} s",
        "capsizes": f"GM is {f['gm']:.3g} m there and it heels over, tenfold in {f['tenfold']:.3g} s",
    }[f["kind"]]
    steered = f"with gain {f['gain']:.3g}" if f["gain"] > 0 else "with the rudder amidships"
    gain = f["critical_gain"]
    needs = (
        "no gain of an autopilot holds it straight ahead" if math.isinf(gain)
        else "it is stable straight ahead without steering" if gain == 0
        else f"straight ahead it takes a gain of {gain:.3g}"
    )  # fmt: skip
    beyond = f" {f['status'].advice[0].upper()}{f['status'].advice[1:]}." if not f["status"].ok else ""
    turns = ""
    if f["gain"] > 0:
        turns = (
            f" The wave holds it up to an ordered heading of {f['exists_to']:.3g} deg, on a stable course up to "
            f"{f['stable_to']:.3g}."
        )
    return f"{where}: {steered} {what}; {needs}.{turns}{beyond}{driven}"
