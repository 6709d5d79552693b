"""Added mass, damping and wave forces of a ship from one source: the record every source of hydrodynamics fills.

What strips, a database or panels give is the same to whoever uses it: added mass and damping over frequency, forces of waves at
zero speed, the range of both, and what to say of them. A source is one file with a function that makes this record from a
ship, and one line of `ship_source.SOURCES`. The forces come in one of two ways. Strips have the potentials on their contours,
from which `loads` makes the force at speed; whatever else has forces at zero speed, which `loads` gives their terms of speed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import GRAVITY, MODES, InputError
from quartering.hull.lines.section import Floats
from quartering.hydro.strip.integrals import moment_matrix
from quartering.hydro.terms import Kind

if TYPE_CHECKING:
    from quartering.hull.ship import Ship
    from quartering.hydro.strip.moments import HullMoments, Moments

Phasors = NDArray[np.complex128]
AtRest = Mapping[str, Phasors]
"""Forces at zero speed: "froude_krylov" and "diffraction", or their "total" alone, (n, modes) complex."""

LOWEST: Final = 0.3
"""Lowest w sqrt(B/2g) a source without the limit at zero frequency must reach: there added mass is near that limit [1]."""


class Held(NamedTuple):
    """What a source holds.

    Parameters
    ----------
    frequency : (low, high)    of oscillation and of the waves [rad/s]
    to_zero : bool             the limit at zero frequency, or so low a frequency that it is near, is there too
    heading : (low, high)      0 following to 180 head, to starboard [deg]; None without forces
    """

    frequency: tuple[float, float]
    to_zero: bool
    heading: tuple[float, float] | None


EVERYTHING: Final = Held((0.0, np.inf), True, (0.0, 180.0))


@dataclass(frozen=True, eq=False)
class Hydrodynamics:
    """Linear hydrodynamics of one ship by one source, at zero speed, made once.

    Parameters
    ----------
    ship : Ship
    kind : str                      of the coefficients in their table
    words : str                     what "added mass of .." and "wave damping of .." end with
    method : str                    of added mass and damping, for a dataset
    references : tuple of str       keys of the papers behind it
    force_words : str               what the wave forces are and come from
    force_references : tuple        keys of the papers behind them
    centre : (x_g, z0)              G forward of midship and above the calm plane [m]
    radiation : callable            -> HullMoments: added mass and damping over frequency about midship at the calm plane
    solved : callable               (f,) frequencies [rad/s] -> Moments about G, without interpolation where it can be
    held : Held
    at_rest : callable or None      (n,) wave frequencies [rad/s], (n,) headings 0 to 180 [deg] -> `AtRest` about midship at the
                                    calm plane; None: the forces follow from the potentials on the sections
    force_modes : tuple of str      modes of those forces, in the order of their columns
    """

    ship: Ship
    kind: Kind
    words: str
    method: str
    references: tuple[str, ...]
    force_words: str
    force_references: tuple[str, ...]
    centre: tuple[float, float]
    radiation: Callable[[], HullMoments]
    solved: Callable[[Floats], Moments]
    held: Held = EVERYTHING
    at_rest: Callable[[Floats, Floats], AtRest] | None = None
    force_modes: tuple[str, ...] = MODES

    @cached_property
    def moments(self) -> HullMoments:
        """Added mass and damping over frequency, about midship at the calm plane."""
        return self.radiation()

    def at(self, frequency: Floats) -> Moments:
        """Integrals of added mass and damping about G at (n,) frequencies >= 0 [rad/s]."""
        return self.moments.at(frequency).about(*self.centre)

    def matrices(self, frequency: Floats) -> tuple[Floats, Floats]:
        """Added mass and damping in sway, roll and yaw about G, (n, 3, 3) each, at (n,) frequencies >= 0 [rad/s]."""
        at = self.at(frequency)
        return moment_matrix(at.a), moment_matrix(at.b)

    def holds(self, frequency: Floats) -> NDArray[np.bool_]:
        """Which frequencies of oscillation (n,), >= 0 [rad/s], are held."""
        low, high = self.held.frequency
        return np.asarray((frequency <= high * (1 + 1e-9)) & (self._to_zero | (frequency >= low)))

    def check(self, frequency: Floats) -> None:
        """Refuse frequencies of oscillation (n,), >= 0 [rad/s], that are not held."""
        if frequency.size == 0 or self.holds(frequency).all():
            return
        low, high = self.held.frequency
        wanted = float(frequency.max())
        holds = f"{self.ship.name}: {self.words} holds {low:.4g} to {high:.4g} rad/s"
        if wanted > high:
            raise InputError(
                f"{holds}, and {wanted:.4g} rad/s is asked for (encounter frequency, or that of roll); compute up to there, "
                "or ask for longer waves, less speed or other headings"
            )
        raise InputError(
            f"{holds}, and {float(frequency.min()):.4g} rad/s is asked for; low frequencies are needed for calm water and "
            f"quartering seas: compute from {self._low_enough:.2g} rad/s, or add the limit at zero frequency (WAMIT: period -1)"
        )

    def holds_waves(self, frequency: Floats, heading: Floats) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Which wave frequencies [rad/s] and which headings 0 to 180 [deg], (n,) each, have forces."""
        if self.held.heading is None:  # no forces at all: whoever asks for one is told so
            return np.ones(frequency.shape, dtype=bool), np.ones(heading.shape, dtype=bool)
        (low, high), (first, last) = self.held.frequency, self.held.heading
        return (
            (frequency >= low * (1 - 1e-9)) & (frequency <= high * (1 + 1e-9)),
            (heading >= first - 1e-9) & (heading <= last + 1e-9),
        )

    @property
    def _to_zero(self) -> bool:
        return self.held.to_zero or self.held.frequency[0] <= self._low_enough

    @property
    def _low_enough(self) -> float:
        """Frequency below which added mass is near its limit at zero [rad/s]."""
        return float(LOWEST * np.sqrt(2 * GRAVITY / self.ship.hull.beam))
