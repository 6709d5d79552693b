"""Added roll damping of a ship from a measured decay: total less the parts already in its equations."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from quartering.conventions import InputError, RangeWarning
from quartering.doors import takes
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hull.told import count, number
from quartering.hydro.coefficients import coefficients
from quartering.hydro.damping.natural_roll import free_roll
from quartering.hydro.damping.roll import fraction_of_critical
from quartering.hydro.decay.analysis import fit_decay
from quartering.hydro.decay.envelope import energy_decay
from quartering.hydro.decay.fit import DecayFit
from quartering.hydro.decay.free_roll import QUADRATIC, FreeDamping, free_damping, linear_for
from quartering.hydro.decay.record import DecayRecord, extremes, read_decay
from quartering.hydro.source.of_ship import source_of

PERIOD_APART: Final = 0.05
"""Share by which the period of the record may differ from the ship's before it is said."""


class Part(NamedTuple):
    """One part of the damping, as a share of critical or as d.

    Parameters
    ----------
    name, unit : str
    record : float      found from the record
    has : float         what the ship has without anything added
    added : float       what is added, 0 or more
    now : float         what the ship has with it
    """

    name: str
    unit: str
    record: float
    has: float
    added: float
    now: float


@dataclass(frozen=True, eq=False)
class RollDecay:
    """A roll decay fitted, and what of its damping a ship lacks.

    Parameters
    ----------
    record : DecayRecord
    fit : DecayFit           linear + quadratic, by the equation of motion
    energy : DecayFit        the same by Froude's energy balance, which uses the extremes alone
    skip : int               extremes left out after the release
    speed : float            at which the decay was measured [m/s]
    bare : FreeDamping       free roll of the ship with nothing added: waves, lift, drag
    lift : float             of `bare.ratio`, what the speed brings [1]
    damped : FreeDamping     free roll of `ship`
    roll_damping : float     to be added, fraction of critical as the ship file counts it: of 2 n2 (I_x + a44) [1]
    quadratic : float        K_p|p| to be added, <= 0 [kg m2]
    ship : Ship              with both, in place of what it had added
    notes : tuple of str     what was set to 0, and what does not fit together
    """

    record: DecayRecord
    fit: DecayFit
    energy: DecayFit
    skip: int
    speed: float
    bare: FreeDamping
    lift: float
    damped: FreeDamping
    roll_damping: float
    quadratic: float
    ship: Ship
    notes: tuple[str, ...]

    @property
    def provenance(self) -> dict[str, str]:
        """Where the two values come from, by key of a ship file."""
        name, at = Path(self.record.source).name, f" at {self.speed:.3g} m/s" if self.speed else ""
        waves = f"waves of {source_of(self.ship).words}" + (" and lift" if self.speed else "")
        d = self.fit.nonlinear.value
        nothing = "; that is all of it and more: 0"
        ratio = f"{self.fit.damping_ratio.value:.4g}"
        return {
            "roll_damping": f"measured: decay record {name}{at}, {ratio} of critical, less the {waves} "
            f"({self.bare.ratio:.4g}){'' if self.roll_damping else nothing}",
            QUADRATIC: f"measured: decay record {name}{at}, d = {d:.4g} 1/rad, less the drag of the sections "
            f"({self.bare.drag:.4g} 1/rad){'' if self.quadratic else nothing}",
        }

    def parts(self) -> tuple[Part, ...]:
        """Linear and quadratic part, and the two together at half and at the whole of the largest swing.

        Source: [Himeno81], equivalent linear damping.
        """
        fit, bare, damped = self.fit, self.bare, self.damped
        rows = [
            Part("linear", "1", fit.damping_ratio.value, bare.ratio, damped.ratio - bare.ratio, damped.ratio),
            Part("quadratic", "1/rad", fit.nonlinear.value, bare.quadratic, damped.added, damped.quadratic),
        ]
        for amplitude in (fit.largest / 2, fit.largest):
            before, now = bare.equivalent(amplitude), damped.equivalent(amplitude)
            name = f"in all at {np.degrees(amplitude):.3g} deg"
            rows.append(Part(name, "1", fit.equivalent(amplitude), before, now - before, now))
        return tuple(rows)

    def envelope(self, time: Floats, damping: FreeDamping | None = None) -> Floats:
        """Amplitude of the decay over time after its first swing, as fitted or with another damping.

        time (t,): after the middle of the first swing [s]
        damping: of a ship; None for the fit
        Returns (t,): [rad]

        dA/dt = -w0 (zeta + (4/(3 pi)) d A) A, averaged over a swing, w0 that of the record:
        A = A0 E/(1 + A0 (e/zeta)(1 - E)), E = exp(-zeta w0 t), e = (4/(3 pi)) d.  Source: [Himeno81] ch. 2.
        """
        zeta = self.fit.damping_ratio.value if damping is None else damping.ratio
        strong = 4 / (3 * np.pi) * (self.fit.nonlinear.value if damping is None else damping.quadratic)
        w0, first = self.fit.frequency.value, self.fit.largest
        fading = np.exp(-zeta * w0 * time)
        lost = -np.expm1(-zeta * w0 * time) / zeta if zeta else w0 * time
        return np.asarray(first * fading / (1 + first * strong * lost))


@takes(ship="Ship", record="DecayRecord, str, Path")
def roll_decay(
    ship: Ship,
    record: DecayRecord | str | Path,
    *,
    speed: float | str = 0.0,
    skip: int = 0,
) -> RollDecay:
    """Added roll damping of a ship from a measured decay, less what its equations have already.

    Parameters
    ----------
    ship : Ship
    record : DecayRecord, str or Path    roll over time at full scale; a file with the unit of the angle in its column's name
    speed : float                        U >= 0 at which it was measured, full scale [m/s]
    skip : int                           extremes left out after the release

    Returns
    -------
    RollDecay    whose `ship` has the damping of the record

    Raises
    ------
    InputError       what `read_decay` and `fit_decay` refuse; a ship whose K_p or K_ppp is given, multiplied or measured: the
                     decay holds that damping too

    Warns
    -----
    RangeWarning     less damping in the record than in the strips or the drag (that part is then 0), a period that is not the
                     ship's, a fit below zero

    Notes
    -----
    Damping ratio and d are carried over, not moments: both are losses per swing, whatever the period. With the free roll of
    `free_damping`, K_p is raised until the roll roots of the ship have the ratio of the record, and K_p|p| = -(d I - D), D the
    drag's share; neither below zero. What the ship had added before is replaced.
    Source: [Himeno81], [H71] equation (3).  Valid: the loading of the record is that of the ship.

    Examples
    --------
    >>> import numpy as np
    >>> from quartering.hull.file.read import ship
    >>> from quartering.hydro.decay.equation import free_decay
    >>> from quartering.hydro.decay.record import decay_record
    >>> t = np.linspace(0.0, 270.0, 1801)
    >>> phi = free_decay(t, (0.2, 0.0), 0.466, 0.02, quadratic=0.3)
    >>> found = roll_decay(ship("series60-cb60"), decay_record(t, phi, unit="rad"))
    >>> round(found.damped.ratio, 4), round(found.damped.quadratic, 3), found.roll_damping < 0.02
    (0.02, 0.3, True)
    """
    speed, skip = number(ship, "speed", speed), count("skip", skip, 0, 0)
    if not isinstance(record, DecayRecord):
        record = read_decay(record)
    bare_ship = _without_added(ship)
    fit, energy = fit_decay(record, skip=skip), energy_decay(record, skip=skip)
    bare = free_damping(bare_ship, speed)
    lift = bare.ratio - free_damping(bare_ship, 0.0).ratio if speed else 0.0
    change = linear_for(bare_ship, speed, fit.damping_ratio.value) if fit.damping_ratio.value > bare.ratio else 0.0
    roll = free_roll(bare_ship)
    fraction = change / fraction_of_critical(1.0, roll.frequency, roll.inertia) + 0.0
    quadratic = -max(fit.nonlinear.value - bare.drag, 0.0) * bare.inertia + 0.0
    damped_ship = with_damping(bare_ship, fraction, quadratic)
    found = RollDecay(
        record=record,
        fit=fit,
        energy=energy,
        skip=skip,
        speed=speed,
        bare=bare,
        lift=lift,
        damped=free_damping(damped_ship, speed),
        roll_damping=fraction,
        quadratic=quadratic,
        ship=damped_ship,
        notes=(),
    )
    notes = _notes(found, ship)
    for note in notes:
        warnings.warn(note, RangeWarning, stacklevel=2)
    provenance = {**damped_ship.provenance, **found.provenance}
    return replace(found, ship=replace(damped_ship, provenance=provenance), notes=tuple(notes))


def with_damping(ship: Ship, fraction: float, quadratic: float) -> Ship:
    """The ship with a fraction of critical and K_p|p| [kg m2] as its added roll damping."""
    made = ship.with_(roll_damping=fraction)
    return replace(made, overrides={**made.overrides, QUADRATIC: quadratic} if quadratic else made.overrides)


def _without_added(ship: Ship) -> Ship:
    """The ship with no roll damping added, after refusing one whose own words on it would be counted twice."""
    rest = {name: value for name, value in ship.overrides.items() if name != QUADRATIC}
    bare = replace(ship.with_(roll_damping=0.0), overrides=rest)
    if QUADRATIC in ship.multipliers:
        raise InputError(f"{ship.name}: a multiplier is given for {QUADRATIC}, which the decay gives; leave it out")
    roll = free_roll(bare)
    none, some = ({e.name: e for e in coefficients(bare.with_(roll_damping=f), 0.0, 0.0).table()} for f in (0.0, 0.1))
    whole = fraction_of_critical(0.1, roll.frequency, roll.inertia)
    if not np.isclose(some["K_p"].value - none["K_p"].value, whole, rtol=1e-6):
        raise InputError(
            f"{ship.name}: K_p ({none['K_p'].source}) does not take what is added as it is, and the decay holds that damping "
            "too; leave out what is given or multiplied of K_p, or take `measured: none`"
        )
    cubic = none.get("K_ppp")
    if cubic is not None and cubic.kind != "cross-flow" and cubic.value:
        raise InputError(
            f"{ship.name}: K_ppp ({cubic.source}) is damping that the decay holds too; leave it out, or take "
            "`measured: none`, so that the drag of the sections stands in its place"
        )
    return bare


def _notes(found: RollDecay, ship: Ship) -> list[str]:
    """What was set to 0, and what does not fit together."""
    fit, bare, notes = found.fit, found.bare, []
    source = Path(found.record.source).name
    waves = f"the waves of {source_of(ship).words}" + (" and lift" if found.speed else "")
    if found.roll_damping == 0.0:
        notes.append(
            f"{source}: its linear damping {100 * fit.damping_ratio.value:.3g} % of critical is not above what {waves} have "
            f"already, {100 * bare.ratio:.3g} %; roll_damping is set to 0"
        )
    if found.quadratic == 0.0:
        notes.append(
            f"{source}: its quadratic damping {fit.nonlinear.value:.3g} 1/rad is not above the drag's share in a free roll, "
            f"{bare.drag:.3g} 1/rad; no {QUADRATIC} is added"
        )
    if found.quadratic == 0.0 or found.roll_damping == 0.0:
        now, then = found.damped.equivalent(fit.largest), fit.equivalent(fit.largest)
        if now > 1.05 * then:
            notes.append(
                f"{source}: at {np.degrees(fit.largest):.3g} deg the ship has {100 * now:.3g} % of critical now and the record "
                f"{100 * then:.3g} %: nothing can be taken off the ship's own waves and drag; look at its lines and loading"
            )
    period, own = fit.period, 2 * np.pi / bare.frequency
    if abs(period / own - 1) > PERIOD_APART:
        notes.append(
            f"{source}: its period is {period:.3g} s and that of {ship.name} {own:.3g} s{_radius_words(ship, period)}"
        )
    return notes


def _radius_words(ship: Ship, period: float) -> str:
    """The radius of gyration that would give the period, where there is one."""
    roll, mass = free_roll(ship), hydrostatics(ship).mass
    missing = ((period * roll.frequency / (2 * np.pi)) ** 2 - 1) * free_damping(ship).inertia
    square = ship.loading.gyradius_roll**2 + missing / mass
    if square <= 0:
        return "; is the loading that of the record?"
    return f"; is the loading that of the record? With this GM, gyradius_roll of about {np.sqrt(square):.3g} m would give it"


def swings(record: DecayRecord, skip: int = 0) -> tuple[Floats, Floats]:
    """Middle times [s] and amplitudes [rad] of the swings of a record."""
    found = extremes(record, skip=skip)
    return (found.time[:-1] + found.time[1:]) / 2, found.swings
