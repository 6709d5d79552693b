"""Many starts at once: which of them capsize, and how much of the safe basin a wave leaves."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.compiled import kernel
from quartering.conventions import InputError
from quartering.motion.equations import Floats, Model
from quartering.motion.polynomial import accelerations
from quartering.motion.simulate import CAPSIZE_ANGLE
from quartering.motion.steering import steer
from quartering.threads import in_threads

if TYPE_CHECKING:
    import xarray as xr
MOST_PERIODS: Final = 10_000
"""Longest march taken [wave periods]: most ships that capsize do so within tens."""


@kernel
def _march(first, last, linear, coefficients, powers, modulus, mean, cos, sin, h, forcing, steps, limit, states, times):
    """Fourth-order Runge-Kutta with a fixed step; `forcing` (2 per period, 2) holds cosine and sine at half steps.

    Row i of `states` goes on until |roll| passes `limit`; `times` is when it did, NaN when it did not.
    """
    table, force, jacobian = np.empty((4, 8)), np.empty(3), np.empty((0, 4))
    n_states = states.shape[1]
    y, stage, k, total = np.empty(n_states), np.empty(n_states), np.empty(n_states), np.empty(n_states)
    per_period = forcing.shape[0] // 2
    for i in range(first, last):
        for s in range(n_states):
            y[s] = states[i, s]
        times[i] = np.nan
        for n in range(steps):
            for s in range(n_states):
                stage[s], total[s] = y[s], 0.0
            for j in range(4):
                accelerations(linear, coefficients, powers, modulus, 1.0, stage, table, force, jacobian)
                phase = (2 * (n % per_period) + (0 if j == 0 else 1 if j < 3 else 2)) % forcing.shape[0]
                c, s1 = forcing[phase, 0], forcing[phase, 1]
                k[0] = force[0] + mean[0] + cos[0] * c + sin[0] * s1
                k[1] = stage[2]
                k[2] = force[1] + mean[1] + cos[1] * c + sin[1] * s1
                k[3] = force[2] + mean[2] + cos[2] * c + sin[2] * s1
                if n_states > 4:
                    steer(linear, stage, k)
                weight = 1.0 if j == 0 or j == 3 else 2.0
                ahead = 0.5 * h if j < 2 else h
                for s in range(n_states):
                    total[s] += weight * k[s]
                    stage[s] = y[s] + ahead * k[s]
            for s in range(n_states):
                y[s] += h / 6.0 * total[s]
            if not abs(y[1]) <= limit:
                times[i] = (n + 1) * h
                break
        for s in range(n_states):
            states[i, s] = y[s]


def capsize_times(
    model: Model, starts: ArrayLike, periods: int = 32, *, steps: int = 80, limit: float = CAPSIZE_ANGLE
) -> tuple[Floats, Floats]:
    """When each of many starts capsizes, and where the others have got to.

    Parameters
    ----------
    model : Model
    starts : (n, 4) float    v [m/s], phi [rad], p, r [rad/s] at time 0; an autopilot starts on course, its rudder amidships
    periods : int            of the wave, to go on for
    steps : int              Runge-Kutta steps a period
    limit : float            roll angle that counts as capsize [rad]

    Returns
    -------
    times : (n,) float       [s]; NaN for a start that does not capsize
    states : (n, 4) float    at the end (or at the capsize)

    Raises
    ------
    InputError               starts that are not four finite numbers each, periods below 1 or above `MOST_PERIODS`, fewer than 4
                             steps

    Notes
    -----
    Fixed-step Runge-Kutta of order 4: for statistics of many starts, not for one exact history (see `simulate`).
    Source: [H71] eq. (3); [Thompson89] for the use.

    Examples
    --------
    >>> model = Model(np.eye(3), {"Y_v": -1.0, "K_phi": -1.0, "K_phiphi": 1.0, "N_r": -1.0}, 1.0, (0, 0, 0), (0, 0, 0))
    >>> times, _ = capsize_times(model, [[0, 0.5, 0, 0], [0, 1.2, 0, 0]])
    >>> np.isnan(times).tolist()
    [True, False]
    """
    states = np.array(starts, dtype=float)
    if states.ndim != 2 or states.shape[1] != 4 or not np.isfinite(states).all():
        raise InputError(f"starts need four finite numbers each (v, phi, p, r); given shape {states.shape}")
    if not 1 <= periods <= MOST_PERIODS or steps < 4:
        raise InputError(
            f"periods = {periods} and steps = {steps}: give 1 to {MOST_PERIODS:,} periods and at least 4 steps each; most"
            " capsizes come within 16 periods"
        )
    states = np.pad(states, ((0, 0), (0, model.system.states - 4)))
    linear, coefficients, powers, modulus, mean, cos, sin, _ = model.system.kernel_arrays()
    phase = np.pi * np.arange(2 * steps) / steps
    forcing = np.column_stack([np.cos(phase), np.sin(phase)])
    times = np.empty(len(states))
    in_threads(
        _march, len(states), linear[0], coefficients[0], powers, modulus, mean[0], cos[0], sin[0],
        2 * np.pi / model.frequency / steps, forcing, periods * steps, limit, states, times,
    )  # fmt: skip
    return times, states[:, :4]


def basin(
    model: Model, roll: ArrayLike, roll_rate: ArrayLike, *, periods: int = 32, limit: float = CAPSIZE_ANGLE
) -> xr.Dataset:
    """Safe basin: from which roll angles and rates the ship does not capsize in a given wave.

    Parameters
    ----------
    model : Model
    roll : (a,) float         roll angles at time 0 [deg]
    roll_rate : (b,) float    roll rates at time 0 [deg/s]
    periods : int             of the wave, to go on for
    limit : float             roll angle that counts as capsize [rad]

    Returns
    -------
    xarray.Dataset            capsize_time (roll_rate, roll) [s], NaN where safe; attribute ``safe_share`` of all starts

    Raises
    ------
    InputError                as `capsize_times`

    Notes
    -----
    Sway velocity and yaw rate start at zero.  Source: [Thompson89] (integrity of the safe basin).

    Examples
    --------
    >>> model = Model(np.eye(3), {"Y_v": -1.0, "K_phi": -1.0, "K_phiphi": 1.0, "N_r": -1.0}, 1.0, (0, 0, 0), (0, 0, 0))
    >>> ds = basin(model, roll=[20.0, 70.0], roll_rate=[0.0])
    >>> ds.attrs["safe_share"]
    0.5
    """
    import xarray as xr

    angles, rates = (np.atleast_1d(np.asarray(axis, dtype=float)) for axis in (roll, roll_rate))
    phi, p = np.meshgrid(np.radians(angles), np.radians(rates))
    starts = np.zeros((phi.size, 4))
    starts[:, 1], starts[:, 2] = phi.ravel(), p.ravel()
    times, _ = capsize_times(model, starts, periods, limit=limit)
    data = {"capsize_time": (("roll_rate", "roll"), times.reshape(phi.shape), _TIME)}
    coordinates = {
        "roll": ("roll", angles, {"units": "deg", "long_name": "roll angle at the start", "symbol": "phi"}),
        "roll_rate": ("roll_rate", rates, {"units": "deg/s", "long_name": "roll rate at the start", "symbol": "p"}),
    }
    attributes = {
        "safe_share": float(np.isnan(times).mean()),
        "references": ", ".join((*model.references, "Thompson89")),
    }
    return xr.Dataset(data, coordinates, attributes)


_TIME = {"units": "s", "long_name": "time of the capsize, NaN where there is none", "symbol": "t"}


def safe_shares(
    models: list[Model], starts: ArrayLike, *, periods: int = 32, limit: float = CAPSIZE_ANGLE
) -> NDArray[np.float64]:
    """Share of the starts that stay safe in each of several waves: the integrity curve.

    Parameters
    ----------
    models : list of Model    such as one ship in waves of rising height
    starts : (n, 4) float     as for `capsize_times`
    periods : int             of the wave, to go on for
    limit : float             roll angle that counts as capsize [rad]

    Returns
    -------
    (m,) float                0 to 1, of each model

    Notes
    -----
    Source: [Thompson89].

    Examples
    --------
    >>> calm = Model(np.eye(3), {"Y_v": -1.0, "K_phi": -1.0, "K_phiphi": 1.0, "N_r": -1.0}, 1.0, (0, 0, 0), (0, 0, 0))
    >>> safe_shares([calm], [[0, 0.5, 0, 0], [0, 1.2, 0, 0]]).tolist()
    [0.5]
    """
    return np.array([np.isnan(capsize_times(m, starts, periods, limit=limit)[0]).mean() for m in models])
