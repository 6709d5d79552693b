"""Parametric roll and pure loss of stability of a ship in regular waves: one record with its sentence."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from typing import Any, Final, Literal

import numpy as np

from quartering.conventions import InputError, RangeWarning
from quartering.doors import takes
from quartering.hull.ship import Ship
from quartering.hull.told import condition
from quartering.hydro.calm_water import calm_water_exponents
from quartering.loads.validity import warn_of_conditions
from quartering.loads.waves import Wave
from quartering.loads.wetted_hull.floating import floating_hull
from quartering.loads.wetted_hull.pressure import Waves, immersion
from quartering.motion.status import Status
from quartering.motion.steady_course.balance import columns, doubled_harmonics, oblique_doubled_harmonics
from quartering.motion.steady_course.course import (
    ROLL,
    Course,
    course,
    roll_inertia,
    surge_at,
    warn_across,
    warn_of_surge,
)
from quartering.motion.steady_course.doubled import doubled_motions, largest_roll
from quartering.motion.steady_course.orbits import POINTS, Orbits, forced_motions, symmetric_orbits
from quartering.stability.averaged_roll import threshold
from quartering.stability.parametric import doubled_multipliers, forced_growth, growths, roll_growth
from quartering.study.six_modes.gm_in_waves import gm_in_waves

Kind = Literal["parametric", "pure-loss", "forced", "stable"]

POSITIONS: Final = 24
"""Crest positions of the values at rest on the wave."""
BEYOND: Final = 1.6
"""Branches of motions of two periods are looked for up to this multiple of the wave's height."""
PACE: Final = 0.05
"""Encounter frequency over that of roll below which the wave counts as frozen: roll grows or decays on each crest position."""
_TENFOLD: Final = math.log(10.0)


@dataclass(frozen=True)
class ParametricRoll:
    """What happens to roll in a regular sea.

    Parameters
    ----------
    ship : str
    wave : Wave
    speed, heading : float        [m/s], [deg]
    status : Status               whether heave and pitch have a periodic motion; its advice stands in the sentence
    encounter_frequency : float   negative where the ship overtakes the wave [rad/s]
    unstable : bool               does small roll grow, sway and yaw free, with the ship's own damping
    growth : float                its rate; below 0 it decays [1/s]
    growth_roll_only : float      sway and yaw locked, `roll_damping` as the whole damping of roll [1/s]
    gm_mean, gm_first : float     mean and first harmonic (amplitude) of GM along the heave and pitch of the ship [m]
    gm_least : float              [m]
    gm_mean_quasistatic, gm_first_quasistatic : float    the same where the ship balances on the wave at rest [m]
    frequency_ratio : float       encounter frequency over the natural frequency of roll at the mean GM
    threshold : float             least gm_first/gm_mean with which roll alone grows, closed form near a ratio of 2
    margin : float                gm_first/gm_mean over the threshold: above 1 roll grows
    amplitude : tuple of float    largest roll of every stable motion of two wave periods; in an oblique sea first that of the
                                  forced motion where it is stable [deg]
    tenfold : float               time for roll to grow tenfold [s]; infinite where it does not
    time_below_zero : float       with a GM below zero, in each period of encounter [s]
    growth_below_zero : float     by how much roll grows meanwhile, in powers of e
    deck_under : float            how far the water stands over the top of the offsets at the most [m]; below 0 it is dry
    kind : str                    "parametric", "pure-loss", "forced" or "stable"
    sentence : str                the answer in words
    """

    ship: str
    wave: Wave
    speed: float
    heading: float
    status: Status
    encounter_frequency: float
    unstable: bool
    growth: float
    growth_roll_only: float
    gm_mean: float
    gm_first: float
    gm_least: float
    gm_mean_quasistatic: float
    gm_first_quasistatic: float
    frequency_ratio: float
    threshold: float
    margin: float
    amplitude: tuple[float, ...]
    tenfold: float
    time_below_zero: float
    growth_below_zero: float
    deck_under: float
    kind: Kind
    sentence: str

    def __repr__(self) -> str:
        return f"<ParametricRoll {self.sentence}>"

    def __str__(self) -> str:
        return self.sentence


@takes(ship="Ship", wave="Wave")
def parametric_roll(ship: Ship, wave: Wave, speed: float | str, heading: float | str = 180.0) -> ParametricRoll:
    """Parametric roll and pure loss of stability of a ship in regular waves.

    Parameters
    ----------
    ship : Ship
    wave : Wave
    speed : float      U >= 0 [m/s]
    heading : float    mu: 0 following, 90 beam, 180 head [deg]

    Returns
    -------
    ParametricRoll

    Raises
    ------
    InputError    a wave of no height, a number out of its range

    Warns
    -----
    RangeWarning  the wave passes over the deck, or is short across the ship; surge so far along the wave that it is not
                  small; what `warn_of_conditions` finds

    Notes
    -----
    Heave and pitch by harmonic balance of the pressure over the instantaneous wetted hull, with linear radiation and
    diffraction, and the surge of linear theory; the stability of roll on that motion by Floquet's theorem, with sway and yaw;
    the roll beyond by continuation of the motions of two wave periods. An oblique sea forces roll of its own period: that
    motion is judged, and those of two periods that branch off it are followed, with all multiples of half the encounter in
    every mode. Where the ship keeps pace with the wave there is no periodic motion: then GM is that of the balance on each
    crest position, and one below zero a permanent loss.
    Source: [STF70] radiation and diffraction; Floquet's theorem.  Valid: constant speed, deep water, hull watertight to the top
    of its offsets, no water on deck.

    Examples
    --------
    >>> from quartering.hull.file.read import ship
    >>> found = parametric_roll(ship("s175").with_(gm=1.0, roll_damping=0.02), Wave(length=175.0, height=3.0), speed=2.0)
    >>> found.kind, found.status.ok
    ('stable', True)
    """
    U, mu = condition(ship, speed, heading)
    if not wave.height > 0:
        raise InputError("wave_height = 0 m; parametric roll needs a wave; try 0.02 of its length")
    warn_of_conditions(ship, U, wave.length)
    warn_across(ship, wave.wavenumber, mu)
    one = course(ship, wave.wavenumber, np.array([wave.amplitude]), np.array([U]), np.array([mu]))
    facts, zeta = _at_rest(ship, wave, mu), whole_damping(ship, U)
    if abs(float(one.signed[0])) < PACE * _natural(one):
        status = Status.ENCOUNTER_FREQUENCY_NEAR_ZERO
        facts |= _keeping_pace(ship, one, facts, zeta)
    else:
        warn_of_surge(one)
        orbits = symmetric_orbits(one) if mu in (0.0, 180.0) else forced_motions(one)
        status = Status(int(orbits.status[0]))
        facts |= _along(one, orbits, zeta) if status.ok else {}
    said: dict[str, Any] = {"ship": ship.name, "wave": wave, "speed": U, "heading": mu, "status": status}
    facts = dict(_EMPTY) | facts | said | {"encounter_frequency": float(one.signed[0])}
    facts["kind"] = _kind(facts)
    for name in ("multiplier", "gm_rest", "forced"):
        facts.pop(name)
    return ParametricRoll(**facts, sentence=_sentence(facts))


_EMPTY: Final[dict[str, Any]] = {
    "unstable": False, "forced": False, "multiplier": math.nan, "gm_rest": (), "amplitude": (), "tenfold": math.inf,
    **dict.fromkeys(
        ("growth", "growth_roll_only", "gm_mean", "gm_first", "gm_least", "frequency_ratio", "threshold", "margin",
         "time_below_zero", "growth_below_zero", "deck_under"), math.nan,
    ),
}  # fmt: skip


def whole_damping(ship: Ship, speed: float) -> float:
    """Fraction of critical of roll alone: the `roll_damping` of the ship, or that of its small free roll by another method.

    >>> from quartering.hull.file.read import ship
    >>> whole_damping(ship("wigley").with_(roll_damping=0.03), 0.0)
    0.03
    """
    if ship.loading.roll_damping > 0:
        return float(ship.loading.roll_damping)
    exponents = np.asarray(calm_water_exponents(ship, speed))
    roll = exponents[np.argmax(exponents.imag)]
    return float(-roll.real / abs(roll))


def _at_rest(ship: Ship, wave: Wave, heading: float) -> dict[str, Any]:
    """Mean and first harmonic of GM where the ship balances on the wave."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)  # said once, of the motion
        gm = gm_in_waves(ship, wave, heading, POSITIONS)["gm"].to_numpy()
    mean, first = _harmonics(gm)
    return {"gm_mean_quasistatic": mean, "gm_first_quasistatic": first, "gm_rest": gm}


def _along(one: Course, orbits: Orbits, zeta: float) -> dict[str, Any]:
    """What the motion in heave and pitch does to roll."""
    growth = roll_growth(orbits, zeta)
    gm, rate, multiplier = growth.gm[0], float(growth.growth[0]), complex(growth.multiplier[0])
    forced = bool(orbits.basis.lateral.size)
    if forced:
        rate, multiplier = forced_growth(orbits)
        largest = float(np.degrees(largest_roll(orbits.basis, orbits.x)[0]))
        rolls: tuple[float, ...] = (*(() if rate > 0 else (largest,)), *_oblique_amplitudes(one))
    else:
        rolls = _amplitudes(one)
    mean, first = _harmonics(gm)
    w0 = _natural(one)
    at_mean = w0 * math.sqrt(max(mean, 0.0) / one.ship.loading.gm)
    ratio = float(one.numbers.omega[0]) / at_mean if at_mean > 0 else math.inf
    limit = float(threshold(ratio, zeta * w0 / at_mean)) if at_mean > 0 else math.nan
    return {
        "unstable": rate > 0, "growth": rate, "growth_roll_only": float(growth.growth_roll_only[0]),
        "multiplier": multiplier, "gm_mean": mean, "gm_first": first, "gm_least": float(gm.min()),
        "frequency_ratio": ratio, "threshold": limit, "margin": first / mean / limit if mean > 0 else math.inf,
        "amplitude": rolls, "forced": forced, "tenfold": _TENFOLD / rate if rate > 0 else math.inf,
        "deck_under": _deck(one, orbits), **_below_zero(gm, one, w0, zeta),
    }  # fmt: skip


def _harmonics(gm: np.ndarray) -> tuple[float, float]:
    spectrum = np.fft.rfft(gm) / gm.size
    return float(spectrum[0].real), float(2 * abs(spectrum[1]))


def _natural(one: Course) -> float:
    """omega_0 of roll alone at the GM of calm water, with the added inertia at half the encounter frequency [rad/s]."""
    inertia = float(roll_inertia(one.ship, 0.5 * one.numbers.omega)[0])
    return math.sqrt(float(one.numbers.scale.prod()) * one.ship.loading.gm / inertia)


def _below_zero(gm: np.ndarray, one: Course, w0: float, zeta: float) -> dict[str, Any]:
    """Time below zero GM in a period, and growth over it: int sqrt(-w0^2 GM(t)/GM - (zeta w0)^2) dt - zeta w0 t."""
    step = 2 * math.pi / float(one.numbers.omega[0]) / gm.size
    bad = float(step * np.count_nonzero(gm < 0))
    rates = np.sqrt(np.maximum(-(w0**2) * gm / one.ship.loading.gm - (zeta * w0) ** 2, 0.0))
    return {"time_below_zero": bad, "growth_below_zero": float(step * rates.sum() - zeta * w0 * bad)}


def _keeping_pace(ship: Ship, one: Course, facts: dict[str, Any], zeta: float) -> dict[str, Any]:
    """Permanent crest: the worst position of the balance."""
    gm = np.asarray(facts["gm_rest"])
    least = float(np.nanmin(gm))
    w0 = _natural(one)
    inside = (zeta * w0) ** 2 - w0**2 * least / ship.loading.gm
    rate = float(-zeta * w0 + (math.sqrt(inside) if inside > 0 else 0.0))
    mean, first = _harmonics(gm)
    return {
        "unstable": rate > 0, "growth": rate, "growth_roll_only": rate, "multiplier": 1.0, "gm_mean": mean, "gm_first": first,
        "gm_least": least, "tenfold": _TENFOLD / rate if rate > 0 else math.inf,
    }  # fmt: skip


def _amplitudes(one: Course) -> tuple[float, ...]:
    """Largest roll of the stable motions of two periods [deg]."""
    amplitude = float(one.numbers.amplitude[0])
    x, _ = doubled_motions(one, amplitude, BEYOND * amplitude)
    if not len(x):
        return ()
    basis = doubled_harmonics()
    stable = np.abs(doubled_multipliers(one, basis, x)).max(axis=1) < 1.0
    return tuple(float(v) for v in np.degrees(largest_roll(basis, x[stable])))


def _oblique_amplitudes(one: Course) -> tuple[float, ...]:
    """Largest roll of the stable motions of two periods in an oblique sea [deg]."""
    amplitude, basis = float(one.numbers.amplitude[0]), oblique_doubled_harmonics()
    x, _ = doubled_motions(one, amplitude, BEYOND * amplitude, basis=basis)
    if not len(x):
        return ()
    stable = growths(one, basis, x, 2)[0] < 0.0
    return tuple(float(v) for v in np.degrees(largest_roll(basis, x[stable])))


def _deck(one: Course, orbits: Orbits) -> float:
    """How far the water comes over the top of the offsets along the motion; said where it does [m]."""
    phase = 2 * np.pi * np.arange(POINTS) / POINTS
    up = columns(orbits.basis.vertical, phase)[0]
    heave, pitch = (up @ part for part in orbits.basis.parts(orbits.x[0])[:2])
    roll = columns(orbits.basis.lateral, phase)[0] @ orbits.basis.parts(orbits.x[0])[ROLL]
    along, across, way = one.numbers.wave[0]
    ones = np.ones(POINTS)
    met = way * phase - along * surge_at(one, phase / float(one.numbers.omega[0]))
    waves = Waves(one.numbers.amplitude[0] * ones, along * ones, across * ones, met)
    over = float(immersion(floating_hull(one.ship).hull, roll, heave, pitch, waves).max())
    if over > 0:
        warnings.warn(
            f"{one.ship.name}: the water comes up to {over:.3g} m over the top of the offsets; from there on the hull is a "
            f"watertight box; carry the sides up with depth, such as depth={1.2 * one.ship.hull.depth:.3g}, where the ship has "
            "them",
            RangeWarning,
            stacklevel=5,
        )
    return over


def _kind(facts: dict[str, Any]) -> Kind:
    """Period doubling, a restoring moment lost for a time, or neither."""
    if not facts["unstable"]:
        return "forced" if facts["forced"] else "stable"
    multiplier = complex(facts["multiplier"])
    if multiplier.real > 0 and float(facts["gm_least"]) <= 0:
        return "pure-loss"
    return "parametric"


def _sentence(facts: dict[str, Any]) -> str:
    """The answer in words."""
    f, wave, status = facts, facts["wave"], facts["status"]
    sea = {180.0: "a head sea", 0.0: "a following sea"}.get(f["heading"], f"a sea from heading {f['heading']:g} deg")
    where = f"{f['ship']} in {sea}, {wave.length:.4g} m long and {wave.height:.3g} m high, at {f['speed']:.3g} m/s"
    if status is Status.ENCOUNTER_FREQUENCY_NEAR_ZERO:
        lost = (
            f"GM is {f['gm_least']:.3g} m on the worst crest position, where roll grows tenfold in {f['tenfold']:.3g} s"
            if f["unstable"]
            else f"GM stays above zero on every crest position, {f['gm_least']:.3g} m at the least"
        )
        return f"{where}: {lost} (the wave as if frozen). {status.advice[0].upper()}{status.advice[1:]}."
    if not status.ok:
        return f"{where}: no answer; {status.advice}."
    gm = (
        f"GM is {f['gm_mean']:.3g} m along its heave and pitch and varies by {f['gm_first']:.3g} m, {f['margin']:.2g} of what "
        f"roll alone needs to grow (at rest on the wave {f['gm_mean_quasistatic']:.3g} and {f['gm_first_quasistatic']:.3g} m)"
    )
    rolls = " or ".join(f"{one:.3g}" for one in f["amplitude"])
    lost = f"GM is below zero for {f['time_below_zero']:.3g} s of each encounter"
    if f["kind"] == "parametric":
        end = f"settles at {rolls} deg" if rolls else "no stable roll was found beyond: it may capsize"
        if f["heading"] not in (0.0, 180.0):
            end = f"out of the forced roll grows one of two wave periods that {end}" if rolls else end
        what = f"parametric roll, tenfold in {f['tenfold']:.3g} s; {end}"
        what += f"; {lost}" if f["time_below_zero"] > 0 else ""
    elif f["kind"] == "pure-loss":
        what = f"pure loss of stability, tenfold in {f['tenfold']:.3g} s; {lost}"
    elif f["kind"] == "forced":
        forced, *others = (f"{one:.3g}" for one in f["amplitude"])
        what = f"the wave rolls it {forced} deg, and that motion is stable"
        what += f"; one of two wave periods, {' or '.join(others)} deg, is stable too" if others else ""
    else:
        what = f"small roll decays, but a large one lasts at {rolls} deg" if rolls else "roll decays"
        what += f", though {lost}" if f["time_below_zero"] > 0 else ""
    return f"{where}: {what}. {gm}."
