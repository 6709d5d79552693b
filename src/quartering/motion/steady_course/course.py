"""Equations of a ship on a steady course in a wave that its whole hull meets: heave, pitch, sway, roll and yaw about G.

The wave's pressure over the instantaneous wetted hull takes the place of the linear restoring and of the linear Froude-Krylov
force; radiation and diffraction stay linear, and sway, roll and yaw keep the lift, drag and damping of the ship's equations:

    (M + A) d(velocity)/dt + B velocity = F_w(heave, pitch, roll, t) + F_D(t) + F_v(velocity).

Heave and pitch are displacements in axes that move with the mean course, sway and yaw are velocities of the ship. Surge is that
of linear theory: the ship meets the wave earlier and later by it. What the pressure along the motion itself makes is 1 to 8 %
less in waves of 1/33 to 1/67, which moves growth and roll by less than 0.1 %; without any surge they are 1 to 2 % less.
"""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, replace
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import GRAVITY, RangeWarning
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.ship import Ship
from quartering.hydro.coefficient_table import Coefficients
from quartering.hydro.coefficients import coefficients
from quartering.hydro.source.of_ship import source_of
from quartering.hydro.strip.surge import spheroid_surge
from quartering.loads.forces import ship_force_phasors
from quartering.loads.lift import ship_lift_phasors
from quartering.loads.strips.vertical import vertical_forces
from quartering.loads.waves import encounter_frequency, heading_components, least_encounter_frequency
from quartering.loads.wetted_hull.floating import floating_tables
from quartering.loads.wetted_hull.section_tables import SectionTables
from quartering.motion.drag_of_ship import moving_water
from quartering.motion.equations.terms import parse, term_table
from quartering.motion.equations.water import Strips
from quartering.motion.six_modes import vertical_system

Floats = NDArray[np.float64]
Phasors = NDArray[np.complex128]

MODES: Final = ("heave", "pitch", "sway", "roll", "yaw")
"""What the equations solve for: heave [m], pitch [rad], sway velocity [m/s], roll [rad], rate of turn [rad/s]."""
HEAVE, PITCH, SWAY, ROLL, YAW = range(5)
SURGING: Final = 0.3
"""Surge times the wave number along the ship above which it is not small: the ship is on its way to ride the wave."""
STRAIGHT: Final = 0.3
"""k B sin mu above which the surface is not straight across the ship."""
HALVES: Final = 15
"""Multiples of half the encounter frequency at which the water's coefficients are held, 0 among them."""


class Numbers(NamedTuple):
    """The numbers of n conditions in one wave length, as the kernels take them.

    Parameters
    ----------
    amplitude, omega : (n,)      of the wave [m]; modulus of the encounter frequency [rad/s]
    wave : (n, 3)                its number along and across the ship [1/m], and 1, or -1 where the ship overtakes it
    mass, damping : (n, j, 5, 5) with added mass, and on the velocities (dh/dt, dtheta/dt, v, p, r), at j |omega|/2
    heel : (n, 3)                Y, K, N per roll that are no hydrostatics
    force : (n, 5) complex       diffraction and lift of the moving water, phasors of e^{i |omega| t} per metre of amplitude
    powers, modulus, products    of (v, phi, p, r): (t, 4), (t,) and coefficients (n, 3, t), as `TermTable`
    strips : (n, z, 5)           cross-flow drag, as `Strips.array`; the water's velocity per metre of amplitude
    rudder : (n, 3)              Y, K, N per radian
    surge : (n, h, 2)            of the ship about its mean place, cos and sin of multiples of omega per metre of amplitude
    gains : (3,)                 of the heading, of its rate, and the lag; 0 without an autopilot
    share : (5,)                 1, or 0 for a mode in which the pressure does not push
    scale : (2,)                 density times gravity, and the volume of the tables
    """

    amplitude: Floats
    omega: Floats
    wave: Floats
    mass: Floats
    damping: Floats
    heel: Floats
    force: Phasors
    powers: NDArray[np.int64]
    modulus: NDArray[np.int64]
    products: Floats
    strips: Floats
    rudder: Floats
    surge: Floats
    gains: Floats
    share: Floats
    scale: Floats


@dataclass(frozen=True, eq=False)
class Course:
    """A ship on a steady course at n conditions in waves of one length.

    Parameters
    ----------
    ship : Ship
    tables : SectionTables    of its sections, for this wave number
    numbers : Numbers
    speed : (n,) float        U [m/s]
    signed : (n,) float       encounter frequency, negative where the ship overtakes the wave [rad/s]
    slow : (n,) bool          the ship keeps pace with the wave: no periodic motion
    length, draught : float   [m]
    """

    ship: Ship
    tables: SectionTables
    numbers: Numbers
    speed: Floats
    signed: Floats
    slow: NDArray[np.bool_]
    length: float
    draught: float

    @property
    def count(self) -> int:
        """Conditions."""
        return int(self.signed.size)

    @property
    def steered(self) -> bool:
        """Is there an autopilot?"""
        return bool(self.numbers.gains.any())

    def at_amplitude(self, amplitude: Floats) -> Course:
        """The same conditions in waves of other amplitudes (n,), or one condition in many."""
        amplitudes = np.atleast_1d(np.asarray(amplitude, dtype=float))
        rows = np.zeros(amplitudes.size, dtype=int) if self.count == 1 else np.arange(self.count)
        found = self.rows(rows)
        return replace(found, numbers=found.numbers._replace(amplitude=amplitudes))

    def rows(self, rows: NDArray[np.int64] | NDArray[np.bool_]) -> Course:
        """Some of the conditions."""
        per_condition = (
            "amplitude",
            "omega",
            "wave",
            "mass",
            "damping",
            "heel",
            "force",
            "products",
            "strips",
            "rudder",
            "surge",
        )
        picked = {name: np.ascontiguousarray(getattr(self.numbers, name)[rows]) for name in per_condition}
        numbers = self.numbers._replace(**picked)
        return replace(self, numbers=numbers, speed=self.speed[rows], signed=self.signed[rows], slow=self.slow[rows])


def warn_across(ship: Ship, wavenumber: float, heading: float) -> None:
    """Say that a wave is too short across a ship for tables of its sections."""
    across = wavenumber * ship.hull.beam * abs(math.sin(math.radians(heading)))
    if across > STRAIGHT:
        warnings.warn(
            f"{ship.name}: k B sin(heading) is {across:.2g}; above {STRAIGHT:g} the surface is not straight across the ship, "
            "and heave, pitch and roll are some per cent off; take a longer wave, or the three modes of equations",
            RangeWarning,
            stacklevel=5,
        )


def warn_of_surge(many: Course) -> None:
    """Say that a ship surges so far along the wave that linear theory does not give it."""
    numbers = many.numbers
    if not numbers.surge.shape[1]:
        return
    far = np.abs(numbers.wave[:, 0]) * numbers.amplitude * np.hypot(*numbers.surge[:, 0].T)
    far[many.slow] = 0.0
    worst = int(far.argmax())
    if far[worst] > SURGING:
        warnings.warn(
            f"{many.ship.name} at {many.speed[worst]:.3g} m/s: the wave number times the surge of linear theory is "
            f"{far[worst]:.2g}; above {SURGING:g} surge is not small, and the wave may carry the ship along; see "
            "surf_riding, or take another speed",
            RangeWarning,
            stacklevel=5,
        )


def roll_inertia(ship: Ship, frequency: Floats) -> Floats:
    """I44 + A44 about G at frequencies (n,) [kg m2].

    >>> from quartering.hull.file.read import ship
    >>> bool(roll_inertia(ship("box"), np.array([0.5]))[0] > 10250e3 * ship("box").loading.gyradius_roll**2)
    True
    """
    own = hydrostatics(ship).mass * ship.loading.gyradius_roll**2
    return np.asarray(own + source_of(ship).matrices(np.abs(frequency))[0][:, 1, 1])


def course(ship: Ship, wavenumber: float, amplitude: Floats, speed: Floats, heading: Floats) -> Course:
    """Equations of a ship on a steady course at many conditions in waves of one length.

    wavenumber: k > 0 [1/m]
    amplitude, speed, heading (n,): of the wave [m]; U >= 0 [m/s]; mu [deg]

    Section tables hold the surface straight across a section: exact in head and following seas, and within about 1 % in
    oblique ones for k B sin mu below 0.3.
    Source: [STF70] radiation and diffraction.  Valid: deep water, constant speed, slender ship.
    """
    a, U, mu = (np.array(v, dtype=float) for v in np.broadcast_arrays(*map(np.atleast_1d, (amplitude, speed, heading))))
    k = np.full(a.size, wavenumber)
    signed = np.asarray(encounter_frequency(np.sqrt(GRAVITY * k), U, mu))
    slow = np.abs(signed) < least_encounter_frequency(ship.hull.length)
    omega = np.where(slow, least_encounter_frequency(ship.hull.length), np.abs(signed))
    tables, volume = floating_tables(ship, wavenumber)
    mass, damping = radiation(ship, omega, U)
    first = coefficients(ship, omega, U)
    met = waves_met(ship, first, k, U, mu, signed, slow)
    powers, modulus, products = _products(first, a.size)
    numbers = Numbers(
        amplitude=a,
        omega=omega,
        wave=met.wave,
        mass=mass,
        damping=damping,
        heel=first.relative_heel,
        force=met.force,
        powers=powers,
        modulus=modulus,
        products=products,
        strips=met.strips,
        rudder=np.zeros((a.size, 3)) if first.rudder is None else first.rudder,
        surge=met.surge,
        gains=_gains(ship),
        share=np.ones(5),
        scale=np.array([ship.loading.density * GRAVITY, volume]),
    )
    return Course(ship, tables, numbers, U, signed, slow, ship.hull.length, ship.hull.draught)


class WavesMet(NamedTuple):
    """What n waves do beside their pressure on the wetted hull, per metre of amplitude; as `Numbers` has them.

    Parameters
    ----------
    wave : (n, 3)
    force : (n, 5) complex
    strips : (n, z, 5)
    surge : (n, 1, 2)
    """

    wave: Floats
    force: Phasors
    strips: Floats
    surge: Floats


def waves_met(
    ship: Ship, c: Coefficients, k: Floats, speed: Floats, heading: Floats, signed: Floats, slow: NDArray[np.bool_]
) -> WavesMet:
    """Diffraction, lift of the moving water, its velocity at the strips of the drag, and surge, of n waves.

    c: of the ship at the modulus of each encounter frequency
    k, speed, heading (n,): [1/m], [m/s], [deg]
    signed, slow (n,): encounter frequency [rad/s]; the ship keeps pace with the wave
    """
    undisturbed, scattered = vertical_forces(ship, k, speed, heading)
    overtakes = signed[:, None] < 0
    # there the surface at G passes its mean level on the way down at t = 0; here a crest stands at G
    turn = np.where(overtakes, 1j, -1j)
    lateral = (ship_force_phasors(ship, k, speed, heading)[1] + ship_lift_phasors(ship, c, k, speed, heading)) * turn
    vertical = np.where(overtakes, np.conj(scattered[:, 1:]), scattered[:, 1:])
    ahead, across = heading_components(heading)
    along = undisturbed[:, 0] + scattered[:, 0]
    along = np.where(overtakes[:, 0], np.conj(along), along)
    omega = np.where(slow, 1.0, np.abs(signed))
    return WavesMet(
        np.stack([-k * ahead, k * across, np.where(overtakes[:, 0], -1.0, 1.0)], axis=1),
        np.concatenate([vertical, lateral], axis=1),
        _strips(ship, c, k, speed, heading, turn),
        _surge(ship, along, omega, slow),
    )


def surge_at(one: Course, time: Floats) -> Floats:
    """Surge (t,) of one condition about the place of its mean speed, + forward [m]."""
    numbers = one.numbers
    found = np.zeros(time.size)
    for j, (c, s) in enumerate(numbers.surge[0]):
        phase = (j + 1) * numbers.omega[0] * time
        found += numbers.amplitude[0] * (c * np.cos(phase) + s * np.sin(phase))
    return found


def _surge(ship: Ship, force: Phasors, omega: Floats, slow: NDArray[np.bool_]) -> Floats:
    """Surge (n, 1, 2) of linear theory from its wave force (n,), as `vertical_motion` has it: no damping."""
    water = hydrostatics(ship)
    inertia = water.mass * (1 + spheroid_surge(ship.hull.length, water.volume))
    found = np.where(slow, 0.0, -force / (omega**2 * inertia))
    return np.stack([found.real, -found.imag], axis=1)[:, None, :]


def radiation(ship: Ship, omega: Floats, speed: Floats) -> tuple[Floats, Floats]:
    """Mass with added mass, and damping, of the five modes at multiples of half the encounter frequency."""
    n = omega.size
    frequency = (0.5 * omega[:, None] * np.arange(HALVES)).ravel()
    speeds = np.repeat(speed, HALVES)
    kyy = float(ship.value("gyradius_pitch"))
    vertical_mass, vertical_damping, _ = vertical_system(ship, frequency, speeds, kyy)
    c = coefficients(ship, frequency, speeds)
    mass, damping = np.zeros((2, n, HALVES, 5, 5))
    mass[:, :, :2, :2] = vertical_mass[:, 1:, 1:].reshape(n, HALVES, 2, 2)
    damping[:, :, :2, :2] = vertical_damping[:, 1:, 1:].reshape(n, HALVES, 2, 2)
    mass[:, :, 2:, 2:] = c.inertia.reshape(n, HALVES, 3, 3)
    damping[:, :, 2:, 2:] = -c.linear.reshape(n, HALVES, 3, 3)
    return mass, damping


def _products(c: Coefficients, n: int) -> tuple[NDArray[np.int64], NDArray[np.int64], Floats]:
    """Products of the velocities, and of roll with them; those of roll alone are the pressure's."""
    names = [name for name in c.nonlinear if not of_roll_alone(name)]
    tables = [term_table({name: float(c.nonlinear[name][i]) for name in names}) for i in range(n)]
    first = tables[0]
    products = np.stack([one.coefficients.reshape(3, -1) for one in tables])
    return first.powers, first.modulus, products


def of_roll_alone(name: str) -> bool:
    """Is a term a product of the heel alone, which the pressure over the wetted hull holds?"""
    powers = parse(name)[1]
    return powers.powers[0] == powers.powers[2] == powers.powers[3] == 0 and powers.modulus in (0, 2)


def _strips(ship: Ship, c: Coefficients, k: Floats, speed: Floats, heading: Floats, turn: Phasors) -> Floats:
    """Cross-flow drag by strips (n, z, 5), the water counted from a crest at G."""
    found = moving_water(ship, c, k, speed, heading, "stf").get("strips")
    if found is None:
        return np.zeros((k.size, 0, 5))
    water = np.broadcast_to(found.water, (k.size, found.x.size)) * turn
    return np.ascontiguousarray(Strips(found.x, found.lever, found.c, water).array)


def _gains(ship: Ship) -> Floats:
    """Gain, rate gain and lag of the autopilot; 0 without one."""
    pilot = ship.autopilot
    return np.zeros(3) if pilot is None else np.array([pilot.gain, pilot.rate_gain, pilot.lag])
