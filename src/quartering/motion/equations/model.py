"""Equations of one ship in one regular wave from numbers, every one taken literally."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from quartering.conventions import InputError
from quartering.hull.autopilot import Autopilot
from quartering.hull.righting.limit import CapsizeLimit, first_vanishing, least_limit
from quartering.hull.righting.spline import OddSpline, odd_spline
from quartering.hull.told import real
from quartering.motion.equations.system import Floats, System, acceleration_form
from quartering.motion.equations.terms import checked_number, parse, term_table
from quartering.motion.equations.water import Strips
from quartering.names import RUDDER_NAMES, term
from quartering.notebook import ShownInNotebooks
from quartering.option_checks import quoted


def _triple(values: ArrayLike, name: str) -> Floats:
    array = real(values)
    if array is None or array.shape != (3,) or not np.isfinite(array).all():
        raise InputError(f"{name} needs three finite numbers (sway N, roll N m, yaw N m); given {values!r}")
    array.flags.writeable = False
    return array


@dataclass(frozen=True, eq=False, init=False)
class Model(ShownInNotebooks):
    """Equations of sway, roll and yaw of one ship in one regular wave, every number taken literally.

    ``inertia d/dt (v, p, r) = sum of terms + force_mean + force_cos cos(w t) + force_sin sin(w t)``.

    Parameters
    ----------
    inertia : (3, 3) float         rigid body plus added mass [kg, kg m, kg m2]
    terms : mapping                name -> coefficient [SI]; ``Y_r`` already contains ``-m U``
    frequency : float              encounter frequency w > 0 [rad/s]
    force_cos, force_sin : (3,)    wave excitation [N, N m, N m]
    force_mean : (3,)              steady excitation [N, N m, N m]
    source : mapping               where the model comes from (ship, wave, speed, heading), for the record
    autopilot : Autopilot          that moves the rudder, whose terms are "Y_delta", "K_delta", "N_delta" [N, N m]; without
                                   one the rudder stays amidships and those terms do nothing
    restoring : (angles, moments)  righting moment [N m], positive where it rights the ship, at heel angles [deg]: a spline, to
                                   which "K_phi", .. of the terms add; or the spline of the moment K itself
    water : (w0, w1) complex       phasors of e^{i w t}: velocity of the water across the ship at G [m/s] and its slope along it
                                   [1/s]; velocity products are then on v - w0, p, r - w1. Without them on v, p, r: the paper's
                                   equations
    strips : Strips                cross-flow drag of the velocity through the water, strip by strip, beside the terms
    told_vanishing : float         angle of vanishing stability [deg], where it is known otherwise than from the terms and the
                                   restoring moment of the model
    openings : float               heel at which unprotected openings go under [deg]

    Raises
    ------
    InputError    a frequency that is not positive, an unknown term, a singular inertia, a NaN

    Notes
    -----
    Source: [H71] eqs. (1)-(3).  Valid: constant speed, small yaw from the mean course, deep water.

    Examples
    --------
    >>> model = Model(inertia=np.eye(3), terms={"Y_v": -0.4, "K_phi": -1.0, "K_p": -0.05, "N_r": -0.6}, frequency=0.8,
    ...               force_cos=(0, 0.1, 0), force_sin=(0, 0, 0))
    >>> model.system.count, model.vanishing_angle
    (1, inf)
    """

    inertia: Floats
    terms: Mapping[str, float]
    frequency: float
    force_cos: Floats
    force_sin: Floats
    force_mean: Floats
    source: Mapping[str, object]
    references: tuple[str, ...]
    autopilot: Autopilot | None
    restoring: OddSpline | None
    water: tuple[complex, complex] | None
    strips: Strips | None
    told_vanishing: float | None
    openings: float | None
    system: System = field(init=False, repr=False)

    def __init__(
        self,
        inertia: ArrayLike,
        terms: Mapping[str, float],
        frequency: float,
        force_cos: ArrayLike,
        force_sin: ArrayLike,
        force_mean: ArrayLike = (0.0, 0.0, 0.0),
        source: Mapping[str, object] = MappingProxyType({}),
        references: tuple[str, ...] = ("H71",),
        autopilot: Autopilot | None = None,
        restoring: tuple[ArrayLike, ArrayLike] | OddSpline | None = None,
        water: tuple[complex, complex] | None = None,
        strips: Strips | None = None,
        told_vanishing: float | None = None,
        openings: float | None = None,
    ) -> None:
        masses, omega = real(inertia), real(frequency)
        if masses is None or masses.shape != (3, 3) or not np.isfinite(masses).all():
            raise InputError(f"inertia needs a 3 x 3 array of finite numbers (sway, roll, yaw); given {inertia!r}")
        if not isinstance(terms, Mapping):
            raise InputError(
                f'terms = {quoted(terms)}; they are a mapping of names to values, such as {{"K_phi": -1.0}}'
            )
        if omega is None or omega.ndim or not (np.isfinite(omega) and omega > 0):
            raise InputError(
                f"encounter frequency {frequency} rad/s must be greater than zero: a wave that keeps pace with the"
                " ship has no periodic motion; change speed or heading (for a negative one, give its modulus and the"
                " conjugate force: reverse the sign of force_sin)"
            )
        masses.flags.writeable = False
        values: dict[str, object] = {
            "inertia": masses,
            "terms": MappingProxyType({name: float(value) for name, value in terms.items()}),
            "frequency": float(frequency),
            "force_cos": _triple(force_cos, "force_cos"),
            "force_sin": _triple(force_sin, "force_sin"),
            "force_mean": _triple(force_mean, "force_mean"),
            "source": MappingProxyType(dict(source)),
            "references": references,
            "autopilot": autopilot,
            "restoring": odd_spline(*restoring).times(-1.0) if isinstance(restoring, tuple) else restoring,
            "water": None if water is None else (complex(water[0]), complex(water[1])),
            "strips": strips,
            "told_vanishing": _told_angle(told_vanishing, "told_vanishing"),
            "openings": _told_angle(openings, "openings"),
        }
        for name, value in values.items():
            object.__setattr__(self, name, value)
        rudder = [checked_number(name, self.terms.get(name, 0.0)) for name in RUDDER_NAMES]
        table = term_table({name: value for name, value in self.terms.items() if name not in RUDDER_NAMES})
        forces = (self.force_cos, self.force_sin, self.force_mean)
        known: dict[str, Any] = {"restoring": self.restoring, "water": self.water, "strips": strips}
        if strips is not None and len(strips.water) != 1:
            raise InputError(f"strips of {len(strips.water)} conditions; a model is one: give water one number a strip")
        system = acceleration_form(masses, table, frequency, forces, rudder=rudder, autopilot=autopilot, **known)
        object.__setattr__(self, "system", system)

    @cached_property
    def vanishing_angle(self) -> float:
        """Angle of vanishing stability [deg]: as told, or where K over phi vanishes on either side; else infinite."""
        if self.told_vanishing is not None:
            return self.told_vanishing
        return min(first_vanishing(lambda phi: -self._moment(phi)), first_vanishing(lambda phi: self._moment(-phi)))

    @cached_property
    def capsize_limit(self) -> CapsizeLimit:
        """Roll angle that counts as a capsize: the least of the vanishing angle, the openings and 90 deg."""
        return least_limit(self.vanishing_angle, self.openings)

    @property
    def righting(self) -> str:
        """The restoring moment in words: its terms, a spline, or both."""
        names = [name for name in self.terms if name.startswith("K_phi") and set(term(name).factors) == {"phi"}]
        parts = [", ".join(names)] if names else []
        if self.restoring is not None:
            parts.append(f"spline to {np.degrees(self.restoring.end):.3g} deg")
        return " + ".join(parts) or "none"

    def _moment(self, phi: Floats) -> Floats:
        """Moment K of roll angles (n,) alone [N m]."""
        moment = np.zeros(phi.shape) if self.restoring is None else self.restoring.value(phi)
        for name, value in self.terms.items():
            if name.startswith("K_") and set(term(name).factors) == {"phi"}:
                powers = parse(name)[1]
                moment = moment + value * phi ** powers.powers[1] * (np.abs(phi) if powers.modulus else 1.0)
        return moment

    def __repr__(self) -> str:
        """What it holds, in a line."""
        of = f"{self.source['ship']}: " if "ship" in self.source else ""
        velocities = "absolute" if self.water is None and self.strips is None else "relative"
        drag = f", drag by {self.strips.x.size} strips" if self.strips is not None else ""
        return (
            f"<Model {of}w {self.frequency:.4g} rad/s, {len(self.terms)} terms on {velocities} velocities{drag}, righting"
            f" {self.righting}, capsize at {self.capsize_limit.words}>"
        )


def _told_angle(angle: float | None, name: str) -> float | None:
    if angle is None or angle > 0:
        return None if angle is None else float(angle)
    raise InputError(f"{name} = {angle} deg: give a heel above 0, infinite for none, or leave it out; try 60")
