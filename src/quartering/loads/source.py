"""The wave forces of a ship by its source of hydrodynamics: from potentials on sections, or from forces at zero speed."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering._machine.rowwise import rowwise
from quartering.conventions import GRAVITY, MODES, InputError
from quartering.hull.lines.immersed import strips
from quartering.hydro.source.of_ship import source_of
from quartering.hydro.source.record import Hydrodynamics
from quartering.hydro.strip.moments import section_table
from quartering.hydro.transfer import transfer_matrix
from quartering.loads.database_forces import warn_of_forces
from quartering.loads.strips.froude_krylov import froude_krylov
from quartering.loads.strips.stations import stations
from quartering.loads.strips.strip_forces import FORMS, Form, wave_force_phasors
from quartering.loads.waves import Floats, Phasors, encounter_frequency, folded

if TYPE_CHECKING:
    from quartering.hull.ship import Ship

Forces = tuple[Phasors, Phasors, Floats]


class WaveForces(NamedTuple):
    """How the wave force of a ship is found in one form.

    Parameters
    ----------
    source : Hydrodynamics or None    that holds the forces at zero speed; None: strips, which hold every wave
    words : str                       what the form is, and where it comes from
    references : tuple of str         keys of the papers behind it
    phasors : callable                wavenumber, speed, heading (n,), speed_terms -> Froude-Krylov and diffraction force
                                      (n, 3) and encounter frequency (n,), as `wave_force_phasors`
    """

    source: Hydrodynamics | None
    words: str
    references: tuple[str, ...]
    phasors: Callable[[Floats, Floats, Floats, bool], Forces]

    def hold(self, wavenumber: Floats, heading: Floats) -> NDArray[np.bool_]:
        """Which waves (n,) it holds the forces of."""
        if self.source is None:
            return np.ones(wavenumber.shape, dtype=bool)
        frequencies, headings = self.source.holds_waves(*_wave(wavenumber, heading))
        return frequencies & headings


def wave_source(ship: Ship, form: Form = "stf", by: str | None = None) -> WaveForces:
    """Where the wave forces of a ship come from in one form: the one place that chooses.

    form: "stf" comes from the ship's own source where that has forces, the others from strips
    by: another source than the ship's own, see `source_of`
    """
    own = source_of(ship, by)
    if own.at_rest is not None and form == "stf":
        return WaveForces(own, own.force_words, own.force_references, partial(_at_speed_of, own))
    by_strips = source_of(ship, "strips")
    words = "; ".join(part for part in (FORMS.get(form, form), by_strips.force_words) if part)
    return WaveForces(None, words, by_strips.force_references, partial(_by_strips, ship, form))


def _by_strips(ship: Ship, form: Form, k: Floats, U: Floats, mu: Floats, speed_terms: bool) -> Forces:
    density = ship.loading.density
    return wave_force_phasors(
        strips(ship.hull), stations(ship), section_table(ship.hull, density), k, U, mu,
        form=form, density=density, speed_terms=speed_terms,
    )  # fmt: skip


def _at_speed_of(source: Hydrodynamics, k: Floats, U: Floats, mu: Floats, speed_terms: bool) -> Forces:
    """Forces of a source at zero speed, moved to G and given what speed changes.

    The pressure of the undisturbed wave does not feel the speed. The diffraction D0 at the wave frequency sigma is that of a
    hull moving with -W, W = C(sigma)^-1 D0/(i sigma), C = A + B/(i omega); at speed

        D = i omega C(|omega|, sign of omega) W,  and  N_D += U (C W)_1

    which are the speed terms of strip theory with the motion of the water averaged over the hull ([STF70]; no aft terms; exact
    at zero speed, waves not short at speed). A source of totals alone gives D0 as the total less the Froude-Krylov force of the
    ship's lines.
    """
    omega = encounter_frequency(np.sqrt(GRAVITY * k), U, mu)
    at_rest, pressure = _at_rest(source, k, mu)
    scattered = _at_speed(source, at_rest, np.sqrt(GRAVITY * k), omega, U, speed_terms)
    return folded(omega, pressure)[1], folded(omega, scattered)[1], omega


def _at_rest(source: Hydrodynamics, k: Floats, mu: Floats) -> tuple[Phasors, Phasors]:
    """Diffraction at zero speed and Froude-Krylov force about G, (n, 3) each."""
    assert source.at_rest is not None
    ship, (sigma, starboard) = source.ship, _wave(k, mu)
    _check(source, sigma, starboard)
    columns = _columns(source)
    warn_of_forces(source)
    port = np.where((mu + 180.0) % 360.0 - 180.0 < 0, -1.0, 1.0)[:, None]
    held = source.at_rest(sigma, starboard)
    found = {
        name: port * _about_gravity_centre(source, force[:, columns], k, starboard) for name, force in held.items()
    }
    if "total" not in found:
        return found["diffraction"], found["froude_krylov"]
    pressure = froude_krylov(strips(ship.hull), stations(ship), k, mu, density=ship.loading.density)
    return found["total"] - pressure, pressure


def _columns(source: Hydrodynamics) -> list[int]:
    """Columns of sway, roll and yaw among the modes a source has forces of; further modes are left to whoever asks for them."""
    missing = [mode for mode in MODES if mode not in source.force_modes]
    if missing:
        raise InputError(
            f"{source.ship.name}: {source.words} holds no wave force in {', '.join(missing)}; take the forces from strips"
        )
    return [source.force_modes.index(mode) for mode in MODES]


def _at_speed(
    source: Hydrodynamics, at_rest: Phasors, sigma: Floats, omega: Floats, speed: Floats, speed_terms: bool
) -> Phasors:
    """Diffraction at speed from that at rest; what stays at rest is left as it is."""
    moving = np.flatnonzero(speed > 0.0)
    out = at_rest.copy()
    if moving.size:
        w, U = omega[moving], speed[moving]
        source.check(np.abs(w))
        motion = np.linalg.solve(_radiation(source, sigma[moving]), at_rest[moving, :, None]) / (
            1j * sigma[moving, None, None]
        )
        slow = np.where(np.abs(w) > 0.0, w, 1.0)
        momentum = (_radiation(source, slow) @ motion)[..., 0]
        out[moving] = 1j * w[:, None] * momentum
        if speed_terms:
            out[moving, 2] += U * momentum[:, 0]
    return out


def _radiation(source: Hydrodynamics, omega: Floats) -> Phasors:
    """C = A + B/(i omega) about G (n, 3, 3), omega of either sign."""
    a, b = source.matrices(np.abs(omega))
    return np.asarray(a + b / (1j * omega[:, None, None]))


def _about_gravity_centre(source: Hydrodynamics, force: Phasors, k: Floats, mu: Floats) -> Phasors:
    """Forces about midship at the calm plane, moved to G with the surface at G as reference of the phases."""
    x_g, z0 = source.centre
    phase = np.exp(1j * k * x_g * np.cos(np.radians(mu)))
    return rowwise(phase[:, None] * force, transfer_matrix(-x_g, z0))


def _wave(wavenumber: Floats, heading: Floats) -> tuple[Floats, Floats]:
    """Frequency at rest [rad/s] and heading folded to starboard, 0 to 180 [deg]."""
    return np.sqrt(GRAVITY * wavenumber), np.abs((heading + 180.0) % 360.0 - 180.0)


def _check(source: Hydrodynamics, sigma: Floats, mu: Floats) -> None:
    """Refuse waves and headings the source does not hold."""
    in_frequency, in_heading = source.holds_waves(sigma, mu)
    name, held = source.ship.name, source.held
    if not in_frequency.all():
        low, high = held.frequency
        short, long = (2 * np.pi * GRAVITY / w**2 for w in (high, low))
        worst = sigma[~in_frequency][0]
        raise InputError(
            f"{name}: {source.words} holds wave frequencies {low:.4g} to {high:.4g} rad/s (waves "
            f"of {short:.4g} to {long:.4g} m), and {worst:.4g} rad/s ({2 * np.pi * GRAVITY / worst**2:.4g} m) is asked for; "
            "ask for waves between these, or compute further"
        )
    if not in_heading.all() and held.heading is not None:
        raise InputError(
            f"{name}: {source.words} holds headings {held.heading[0]:g} to {held.heading[1]:g} deg, and "
            f"{mu[~in_heading][0]:g} deg is asked for; compute that heading too (0 is a following sea: minus the direction "
            "of the file), or leave it out"
        )
