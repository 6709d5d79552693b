"""The steady periodic motion of a model, as a record a person can read."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering._machine.rowwise import largest_of_rows
from quartering.conventions import InputError, RangeWarning
from quartering.doors import takes
from quartering.hull.righting.limit import CapsizeLimit
from quartering.motion.equations.model import Model
from quartering.motion.equations.steering import holds_heading
from quartering.motion.equations.system import Floats, System
from quartering.motion.status import Status
from quartering.motion.steady.harmonic import checked_harmonics, harmonic_balance, orders_for
from quartering.motion.steady.struble import modified_struble
from quartering.motion.steady.truncation import followed_up
from quartering.notebook import ShownInNotebooks

_PEAK_SAMPLES = 256
Start = Literal["linear", "rest"]


@dataclass(frozen=True, eq=False)
class Motion(ShownInNotebooks):
    """A periodic motion: harmonics of sway [m], roll [rad] and yaw [rad].

    Sway and yaw are the integrals of sway velocity and yaw rate, the paper's x1 and x3.

    Parameters
    ----------
    frequency : float          of the motion [rad/s]: the wave's, w, or w/2 where it takes two wave periods
    orders : tuple of int      harmonics of that frequency present, without the mean
    cos, sin : (h, 3) float    coefficients of sway, roll, yaw
    mean : (3,) float          mean sway velocity [m/s], heel [rad], yaw rate [rad/s]
    status : Status            how it was found; ``status.advice`` says what to do when it was not
    residual : float           largest imbalance relative to the excitation
    method : str               "modified Struble" or "harmonic balance"
    heading : float or None    mean heading off course where an autopilot holds it, then the mean yaw rate is 0 [rad]; None
                               where the heading is free
    periods : int              wave periods after which the motion repeats
    missed : float             what four further harmonics change of roll, as a share of it; NaN where it is not known
    """

    frequency: float
    orders: tuple[int, ...]
    cos: Floats
    sin: Floats
    mean: Floats
    status: Status
    residual: float
    method: str
    references: tuple[str, ...] = ("H71",)
    heading: float | None = None
    periods: int = 1
    missed: float = float("nan")

    def __repr__(self) -> str:
        sway, roll, yaw = self.amplitude
        size = f"sway {sway:.3g} m, roll {math.degrees(roll):.3g} deg, yaw {math.degrees(yaw):.3g} deg"
        orders = ", ".join(map(str, self.orders))
        return f"<Motion w {self.frequency:.3g} rad/s: {size}, harmonics {orders}; {self.status.advice}>"

    @property
    def amplitude(self) -> Floats:
        """Amplitude (3,) at the wave's frequency: sway [m], roll [rad], yaw [rad]."""
        own = self.orders.index(self.periods)
        return np.hypot(self.cos[own], self.sin[own])

    @property
    def peak(self) -> Floats:
        """Largest |sway| [m], |roll| [rad], |yaw| [rad] (3,) over a cycle, heel included."""
        return peaks(self.coefficients[None], self.orders_with_mean)[0]

    @property
    def orders_with_mean(self) -> tuple[int, ...]:
        """Harmonics as the kernels take them: 0 in front when the motion has a mean."""
        return (0, *self.orders) if self.mean.any() or self.heading or 2 in self.orders else self.orders

    @property
    def coefficients(self) -> Floats:
        """Coefficients (3, b) as the kernels take them, the mean if present, then cos and sin of each harmonic."""
        pairs = np.stack([self.cos, self.sin], axis=1).reshape(-1, 3).T
        mean = self.mean if self.heading is None else np.append(self.mean[:2], self.heading)
        return np.ascontiguousarray(np.column_stack([mean, pairs]) if 0 in self.orders_with_mean else pairs)

    def state(self, time: ArrayLike) -> Floats:
        """State (v, phi, p, r) at given times.

        Parameters
        ----------
        time : (...) float    [s]; the wave's surface passes the mean level moving down at G at time 0

        Returns
        -------
        (..., 4) float        [m/s, rad, rad/s, rad/s]

        Notes
        -----
        Source: [H71] eq. (A-3).
        """
        h = np.array(self.orders, dtype=float)
        phase = np.asarray(time, dtype=float)[..., None] * self.frequency * h
        position = np.cos(phase) @ self.cos + np.sin(phase) @ self.sin
        velocity = (-np.sin(phase) * h) @ self.cos + (np.cos(phase) * h) @ self.sin
        velocity = velocity * self.frequency
        v, heel, r = self.mean
        return np.stack(
            [velocity[..., 0] + v, position[..., 1] + heel, velocity[..., 1], velocity[..., 2] + r], axis=-1
        )


def peaks(u: Floats, orders: tuple[int, ...]) -> Floats:
    """Largest |sway|, |roll|, |yaw| of each motion over a cycle.

    u (n, 3, b): coefficients as from `harmonic_balance`
    orders: their harmonics
    Returns (n, 3): [m, rad, rad]; sway and yaw without their drift

    Source: closed form; sampled at 256 phases, which finds a maximum to 1e-4 of a fundamental and 1e-3 of a ninth harmonic.
    """
    displacement = u @ _sampled(orders)
    if 0 in orders:
        displacement[:, 0] -= u[:, 0, :1]
        displacement[:, 2] -= u[:, 2, :1]
    return np.abs(displacement).max(axis=2)


def roll_peaks(u: Floats, orders: tuple[int, ...]) -> Floats:
    """Largest |roll| of each motion over a cycle, heel included.

    u (n, 3, b): coefficients as from `harmonic_balance`
    orders: their harmonics
    Returns (n,): [rad]

    Source: as `peaks`, for one mode of many conditions.
    """
    return largest_of_rows(u[:, 1], _sampled(orders))


def _sampled(orders: tuple[int, ...]) -> Floats:
    """Rows (b, m): the mean, cosines and sines at phases of a cycle, or of half of one when the rest mirrors it."""
    mirrored = all(h % 2 == 1 for h in orders)
    phases = 2 * np.pi * np.arange(_PEAK_SAMPLES // 2 if mirrored else _PEAK_SAMPLES) / _PEAK_SAMPLES
    rows = [np.ones_like(phases)] if 0 in orders else []
    rows += [f(h * phases) for h in orders if h > 0 for f in (np.cos, np.sin)]
    return np.array(rows)


def steady_motions(
    system: System, harmonics: int = 1, *, start: Start = "linear", with_residual: bool = True
) -> tuple[Floats, tuple[int, ...], NDArray[np.int8], Floats]:
    """Periodic motions of a batch of conditions.

    system: n conditions
    harmonics: 1: the paper's modified Struble method; 3, 5, ..: harmonic balance to that order
    start: which motion where several exist, as in `steady_motion`
    with_residual: as in `harmonic_balance`
    Returns u (n, 3, b): coefficients as from `harmonic_balance`; orders: their harmonics; status (n,): `Status`;
        residual (n,): largest imbalance relative to the excitation

    Source: [H71] Appendix A, [Krack19].
    """
    if start not in get_args(Start):
        raise InputError(
            f"start={start!r}: 'linear' (Newton from the linear motion) or 'rest' (raising the wave from nothing)"
        )
    if checked_harmonics(harmonics) == 1:
        return modified_struble(system, from_rest=start == "rest", with_residual=with_residual)
    orders = orders_for(system, harmonics)
    u, status, residual = harmonic_balance(system, orders, from_rest=start == "rest", with_residual=with_residual)
    return u, orders, status, residual


def _warn_beyond(end: float, peak: float) -> None:
    """Say that a motion rolls beyond the last angle of its righting curve."""
    if peak > end:
        warnings.warn(
            f"the motion rolls to {np.degrees(peak):.3g} deg, beyond the {np.degrees(end):.3g} deg to which its righting curve"
            " is given; the curve's last cubic is carried on",
            RangeWarning,
            stacklevel=4,
        )


def motion_record(
    model: Model, u: Floats, orders: tuple[int, ...], status: int, residual: float, method: str
) -> Motion:
    """One motion of a batch as a record.

    u (3, b): coefficients as from `harmonic_balance`
    orders: their harmonics
    status: `Status`
    residual: relative imbalance
    method: how it was found

    Source: [H71] eq. (A-3).
    """
    mean = u[:, 0].copy() if orders[0] == 0 else np.zeros(3)
    pairs = u[:, 1:] if orders[0] == 0 else u
    if model.restoring is not None:
        _warn_beyond(model.restoring.end, float(roll_peaks(u[None], orders)[0]))
    used = tuple(h for h in orders if h > 0)
    heading = None
    if holds_heading(model.system.linear)[0]:
        heading, mean[2] = float(mean[2]), 0.0
    return Motion(
        frequency=model.frequency,
        orders=used,
        cos=np.ascontiguousarray(pairs[:, 0::2].T),
        sin=np.ascontiguousarray(pairs[:, 1::2].T),
        mean=mean,
        status=Status(status),
        residual=float(residual),
        method=method,
        heading=heading,
        references=(*model.references, *(("Struble62",) if method == "modified Struble" else ("Krack19",))),
    )


@takes(model="Model")
def steady_motion(model: Model, harmonics: int = 1, *, start: Start = "linear", fixed: bool = False) -> Motion:
    """The steady periodic motion that grows out of the linear solution.

    Parameters
    ----------
    model : Model
    harmonics : int    1: the paper's modified Struble method with its linear third harmonic; 3, 5, 7, ..: harmonic balance,
                       with more harmonics than asked for where four more change roll by over 1 %
    start : str        where several motions exist: "linear", the one Newton's method reaches from the linear motion, which may
                       be an unstable one; "rest", the one a wave raised slowly from nothing leads to

    fixed : bool       stay at the harmonics asked for; what further ones change is then not known

    Returns
    -------
    Motion    its ``status`` says whether one was found; NaN coefficients when not

    Raises
    ------
    InputError    `harmonics` even, not positive or above 199, `start` unknown

    Warns
    -----
    RangeWarning  the harmonics asked for did not suffice

    Notes
    -----
    Source: [H71] Appendix A; [Krack19] for more harmonics.  Valid: one of several motions may be found; see `all_motions`.

    Examples
    --------
    >>> terms = {"Y_v": -0.4, "K_phi": -1.0, "K_p": -0.05, "K_phiphiphi": -0.25, "K_ppp": -0.08, "N_r": -0.6}
    >>> model = Model(np.eye(3), terms, 0.85, force_cos=(0, 0.05, 0), force_sin=(0, 0.12, 0))
    >>> motion = steady_motion(model)
    >>> round(float(motion.amplitude[1]), 6), motion.status.name
    (0.414599, 'CONVERGED')
    """
    u, orders, status, residual = steady_motions(model.system, harmonics, start=start)
    if harmonics == 1:
        return motion_record(model, u[0], orders, int(status[0]), float(residual[0]), "modified Struble")
    missed, asked = float("nan"), orders
    if status[0] <= Status.CONVERGED_BY_FOLLOWING and not fixed:
        u, orders, missed, more = followed_up(model.system, u, orders)
        status = status if more is None else more
    if orders != asked:
        warnings.warn(
            f"{max(asked)} harmonics do not suffice for this motion; it has {max(orders)} now, beyond which roll changes by"
            f" {missed:.2g} of itself",
            RangeWarning,
            stacklevel=3,
        )
    found = motion_record(model, u[0], orders, int(status[0]), float(residual[0]), "harmonic balance")
    return replace(found, missed=missed)


def within_limit(model: Model, motion: Motion) -> Motion:
    """A motion, or none where it rolls past the capsize limit of its model, as in a map.

    Returns of status `BEYOND_CAPSIZE_LIMIT` and NaN where it passes the limit
    """
    if not motion.peak[1] > model.capsize_limit.radians:
        return motion
    nothing = np.full_like(motion.cos, np.nan)
    return replace(motion, cos=nothing, sin=nothing, status=Status.BEYOND_CAPSIZE_LIMIT)


def within_limits(
    u: Floats, status: NDArray[np.int8], largest: Floats, limit: Floats | float
) -> tuple[Floats, NDArray[np.int8]]:
    """Motions (n, 3, b) of a batch and their status: none where the largest roll is past the limit, or no motion was found."""
    status = np.where(largest > limit, Status.BEYOND_CAPSIZE_LIMIT, status).astype(np.int8)
    return np.where((status > Status.CONVERGED_BY_FOLLOWING)[:, None, None], np.nan, u), status


def advice(motion: Motion, limit: CapsizeLimit) -> str:
    """What the status of a motion says and what to try, with the capsize limit it passes where it passes one."""
    return motion.status.advice if motion.status is not Status.BEYOND_CAPSIZE_LIMIT else capsize_advice(limit)


def capsize_advice(limit: CapsizeLimit) -> str:
    """`Status.advice` of a motion past a capsize limit that is known."""
    return f"the motion rolls past {limit.words}; treat as capsize risk and try a lower wave"
