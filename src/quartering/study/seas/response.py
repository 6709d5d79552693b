"""The response of a ship to a sea: linear, or closed with Gaussian gains, for many seas and headings at one speed."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from enum import IntEnum
from typing import Any, Final, Literal, NamedTuple, get_args

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from quartering._machine.threads import spread
from quartering.conventions import InputError, RangeWarning
from quartering.doors import takes
from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.righting.limit import CapsizeLimit
from quartering.hull.ship import Ship
from quartering.hull.told import number, numbers
from quartering.hydro.capsize import capsize_limit
from quartering.loads.forces import Form
from quartering.loads.sea.cells import Cells, wave_cells
from quartering.loads.sea.sea import STEEP_SEA, Sea
from quartering.motion.equations.model import Model
from quartering.motion.sea.closure import closure_solutions, linear_response, linear_solution
from quartering.motion.sea.equations import Force, SeaEquations, equations_of_model, equations_of_ship, free_roll_of
from quartering.option_checks import quoted
from quartering.stability.sea import sea_stability
from quartering.study.seas.dataset import sea_dataset
from quartering.study.seas.moments import Moments, moments_of, products

Floats = NDArray[np.float64]
Method = Literal["linear", "closure"]
NEAR: Final = 0.1
"""Encounter frequency, in natural roll frequencies, below which a wave pushes the ship as a steady force does [1]."""
LEAST_DAMPING: Final = 0.01
"""Damping ratio that the cells resolve at least [1]."""
MOST_NEAR: Final = 0.2
"""Share of the energy there above which a ship is in the regime of surf-riding and broaching [1]."""


class SeaStatus(IntEnum):
    """Whether a sea and heading have an answer.

    Examples
    --------
    >>> SeaStatus.SURF_RIDING.name.lower()
    'surf_riding'
    """

    ANSWERED = 0
    UNSTABLE = 1
    NOT_CONVERGED = 2
    SURF_RIDING = 3
    PAST_CAPSIZE_LIMIT = 4
    BREAKS = 5


class Answer(NamedTuple):
    """The response to one sea at one heading; see `sea_response` for what each is."""

    covariance: Floats
    mean: Floats
    moments: Moments
    gains: Floats
    n2: float
    k2: float
    slow: Floats
    exponents: NDArray[np.complex128]
    shares: tuple[float, float, float]
    rolls: list[float]
    passes: int
    converged: bool
    cells: int


@takes(ship="Ship, Model", form="word")
def sea_response(
    ship: Ship | Model,
    sea: Sea | Sequence[Sea],
    speed: float | str,
    heading: ArrayLike | None = None,
    method: Method = "linear",
    *,
    force: Force | None = None,
    place: tuple[float | str, float | str] | None = None,
    form: Form = "stf",
    hours: float = 3.0,
) -> xr.Dataset:
    """Root mean squares, largest motions and first-order stability of a ship in one or several seas.

    Parameters
    ----------
    ship : Ship or Model
    sea : Sea or sequence of Sea
    speed : float or str          U >= 0 [m/s]
    heading : () or (h,), optional    in place of the seas' own: of the first system of each, the others turned with it [deg]
    method : str                  "linear", or "closure": statistical linearisation of every nonlinear term
    force : callable              of a `Model`: frequencies (n,) [rad/s], headings (n,) [deg] -> (n, 3) complex force per metre
                                  [N/m, N m/m], phasors of e^{i omega t} with the signed encounter frequency, as
                                  ``force_cos - 1j force_sin``; of a model with water in motion further columns, as `irregular`
    place : (x, height)           of the lateral acceleration: forward of midship, over the keel [m]; by default the ship's
                                  ``highest_position``, or G. Of a `Model` from G: forward, upward
    form : str                    of the diffraction force of a ship
    hours : float                 that largest motions are of

    Returns
    -------
    xarray.Dataset    dims sea and heading where several were given: covariance (state, state_2) of v, phi, p, r [SI]; roll_rms,
                      roll_mean [deg]; roll_period [s]; roll_most_probable, roll_mean_largest [deg], and ``_bound`` of both, of
                      independent swings; lateral_acceleration_rms, .._mean_largest, .._mean_largest_bound [m/s2]; gains (mode,
                      state) [SI]; n2, k2, slow (slow_mode), exponent (exponent_of); overtaken, near_zero, cut_off energy [1];
                      roll_of_each (solution) [deg]; passes; status. pile_up (line) [m/s], pile_up_heading (line) [deg]

    Raises
    ------
    InputError        no sea, a heading or speed out of range, a force missing or given beside a ship, an unknown method; what
                      the ship's own sources of forces do not hold

    Warns
    -----
    RangeWarning      a steep sea; energy near omega = 0; statistics that did not converge; several solutions

    Notes
    -----
    Q = sum S Re(V V*) over wave cells (sigma, mu), with coefficients at each encounter frequency and conjugate phasors where
    the ship overtakes the wave: never a spectrum over omega. "closure" replaces f(y) by E[f] + E[df/dy] y until the covariance
    agrees with it; drag by strips has the gain 2 c E|q| on V and on w alike.
    The largest motion is Vanmarcke's, which counts groups of swings; its bound is Rice's with every swing counted.
    Source: [Kazakov54] closure, [Vanmarcke75], [Rice44].  Valid: linear waves, constant speed, mean heading; roll well below
    the vanishing angle. Against simulation of the same equations "closure" errs by a few percent of roll, "linear" up to 50 %.

    Examples
    --------
    >>> import quartering as qt
    >>> sea = qt.Sea(hs=3, tp=9, heading=60)
    >>> linear, closed = (qt.sea_response(qt.ship("wigley"), sea, 5.0, method=how) for how in ("linear", "closure"))
    >>> bool(closed["roll_rms"] < linear["roll_rms"]), linear["covariance"].dims
    (True, ('state', 'state_2'))
    """
    if method not in get_args(Method):
        raise InputError(
            f"method = {quoted(method)}; allowed: linear, closure (statistical linearisation); try 'closure'"
        )
    seas = _seas(sea)
    of = ship if isinstance(ship, Ship) else None
    U, hours = number(of, "speed", speed), number(None, "hours", hours)
    turned, shape = _turned(
        seas, None if heading is None else numbers(of, "heading", heading), not isinstance(sea, Sea)
    )
    at = place_of(ship, place)
    roll_frequency, damping = free_roll_of(ship, U)
    cells = wave_cells(turned, U, roll_frequency, max(damping, LEAST_DAMPING))
    equations = sea_equations(ship, cells, force, form)
    by_linear = linear_response(equations) if method == "linear" else None
    ready = None if by_linear is None else products(by_linear, equations.frequency, U, at)

    def answer(one: Sea) -> Answer:
        return answer_of(equations, one, at, by_linear, ready, roll_frequency)

    answers: list[Any] = [None] * len(turned)
    for i, found in spread(answer, turned):
        answers[i] = found
    status = [status_of(found, ship, hours) for found in answers]
    _warn(seas, answers, status)
    given = {
        "method": method,
        "hours": hours,
        "place": at,
        "roll_frequency": roll_frequency,
        "damping": damping,
        "form": form,
    }
    return sea_dataset(ship, turned, shape, answers, status, cells, given)


def _seas(sea: Any) -> list[Sea]:
    seas = [sea] if isinstance(sea, Sea) else list(sea) if isinstance(sea, (list, tuple)) else []
    if not seas or not all(isinstance(one, Sea) for one in seas):
        raise InputError(
            f"sea = {quoted(sea)} is no Sea and no list of them; give one, such as quartering.Sea(hs=6, tp=11)"
        )
    return seas


def _turned(seas: list[Sea], heading: Floats | None, several: bool) -> tuple[list[Sea], dict[str, Any]]:
    """Each sea at each heading, and the dimensions of the result with the number of each."""
    if heading is None:
        return seas, {"sea": len(seas)} if several else {}
    if heading.ndim > 1 or heading.size == 0:
        raise InputError(f"heading of shape {heading.shape}; give one, or a list of at least one")
    towards = np.atleast_1d(heading)
    shape = ({"sea": len(seas)} if several else {}) | ({"heading": towards} if heading.ndim else {})
    return [one.turned_to(float(mu)) for one in seas for mu in towards], shape


def place_of(ship: Ship | Model, place: Any) -> tuple[float, float]:
    """Point of the lateral acceleration from G: forward, down [m]."""
    if place is not None and (not isinstance(place, (list, tuple, np.ndarray)) or len(place) != 2):
        raise InputError(
            f"place = {quoted(place)}; it is x forward of midship and the height over the keel, such as (10, 20), or of a model"
            " (forward, up) from G"
        )
    if isinstance(ship, Model):
        x, up = (0.0, 0.0) if place is None else (number(None, "reference_x", one) for one in place)
        return float(x), -float(up)
    if place is None:
        x, height = (ship.value(f"highest_position_{key}") for key in ("x", "height"))
        if height is None:
            return 0.0, 0.0
        place = (0.0 if x is None else x, height)
    x, height = (number(ship, "reference_x", one) for one in place)
    return x - hydrostatics(ship.hull).lcb, ship.loading.kg - height


def sea_equations(ship: Ship | Model, cells: Cells, force: Force | None, form: Form) -> SeaEquations:
    """Equations over cells of a ship, or of a model with its force."""
    if isinstance(ship, Model):
        if force is None:
            raise InputError(
                "force is missing: a model is of one wave; give a function of frequencies [rad/s] and headings [deg] that gives"
                " the complex force per metre (n, 3)"
            )
        return equations_of_model(ship, cells, force)
    if force is not None:
        raise InputError(f"{ship.name}: force is given beside a ship, which has its own; leave it out")
    return equations_of_ship(ship, cells, form)


def shares_of(cells: Cells, sea: Sea, roll_frequency: float) -> tuple[float, float, float]:
    """Shares of the wave energy that the ship overtakes, that is near encounter frequency 0, and that is beyond the cut."""
    energy, omega = cells.energy(sea), cells.omega
    total = float(energy.sum())
    near = np.abs(omega) < NEAR * roll_frequency
    return float(energy[omega < 0].sum()) / total, float(energy[near].sum()) / total, 1.0 - total / sea.moment(0)


def answer_of(
    equations: SeaEquations,
    sea: Sea,
    at: tuple[float, float],
    by_linear: NDArray[np.complex128] | None,
    ready: Floats | None,
    roll_frequency: float,
) -> Answer:
    """The response to one sea: by the linear phasors where they are given, else by the closure.

    at: point of the lateral acceleration from G, forward and down [m]
    by_linear, ready: phasors of the linear equations in all cells, and their `products`
    """
    energy = equations.cells.energy(sea)
    shares = shares_of(equations.cells, sea, roll_frequency)
    if by_linear is not None and ready is not None:
        found = [linear_solution(equations, energy, by_linear)]
        moments = moments_of(energy @ ready)
    else:
        found = closure_solutions(equations, energy)
        one = found[0]
        moments = moments_of(
            one.energy @ products(one.motion, equations.frequency[one.cells], equations.cells.speed, at)
        )
    one = found[0]
    slopes = equations.at_roll[1] + one.gains.by_state(equations.terms)
    stable = sea_stability(equations.at_roll[0], slopes, equations.rudder, equations.autopilot)
    rolls = [float(np.degrees(solution.roll)) for solution in found]
    return Answer(
        moments.covariance, one.statistics.mean, moments, slopes, stable.n2, stable.k2, stable.slow, stable.exponents, shares,
        rolls, sum(solution.passes for solution in found), one.converged, one.cells.size,
    )  # fmt: skip


def status_of(found: Answer, ship: Ship | Model, hours: float) -> SeaStatus:
    """Whether an answer counts, and why not."""
    if not found.converged:
        return SeaStatus.NOT_CONVERGED
    if found.shares[1] > MOST_NEAR:
        return SeaStatus.SURF_RIDING
    if found.exponents.real[0] > 0:
        return SeaStatus.UNSTABLE
    limit = limit_of(ship).angle
    if found.rolls[0] * found.moments.roll_largest(hours)[1] > limit:
        return SeaStatus.PAST_CAPSIZE_LIMIT
    return SeaStatus.ANSWERED


def limit_of(ship: Ship | Model) -> CapsizeLimit:
    """Roll angle that counts as a capsize."""
    return ship.capsize_limit if isinstance(ship, Model) else capsize_limit(ship)


def warn_of_steepness(seas: Sequence[Sea]) -> None:
    """Warn of the steepest of seas where linear waves are doubtful."""
    steep = max(seas, key=lambda one: one.steepness)
    if steep.steepness > STEEP_SEA:
        warnings.warn(
            f"sea of {steep.words}: steepness {steep.steepness:.3g}, above {STEEP_SEA:g}: linear waves are doubtful",
            RangeWarning,
            stacklevel=5,
        )


def _warn(seas: Sequence[Sea], answers: Sequence[Answer], status: Sequence[SeaStatus]) -> None:
    warn_of_steepness(seas)
    near = [found.shares[1] for found, one in zip(answers, status, strict=True) if one == SeaStatus.SURF_RIDING]
    if near:
        warnings.warn(
            f"{len(near)} of {len(answers)} conditions have more than {MOST_NEAR:.0%} of the energy near encounter frequency 0"
            f" (up to {max(near):.0%}): surf-riding and broaching, this model is not valid; change speed or heading",
            RangeWarning,
            stacklevel=4,
        )
    failed = sum(one == SeaStatus.NOT_CONVERGED for one in status)
    if failed:
        warnings.warn(
            f"{failed} of {len(answers)} conditions did not converge: no Gaussian motion found; simulate them",
            RangeWarning,
            stacklevel=4,
        )
    several = [found for found in answers if len(found.rolls) > 1]
    if several:
        rolls = ", ".join(f"{roll:.3g}" for roll in several[0].rolls)
        warnings.warn(
            f"{len(several)} of {len(answers)} conditions have several motions (roll RMS {rolls} deg in the first): the ship"
            " may jump between them; the one from rest is given",
            RangeWarning,
            stacklevel=4,
        )
