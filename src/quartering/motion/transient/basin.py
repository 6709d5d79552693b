"""Safe basin: which initial conditions capsize, and its integrity over wave height."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering._machine.compiled import kernel
from quartering._machine.threads import in_threads
from quartering.conventions import InputError
from quartering.doors import takes
from quartering.hull.told import count, number, real
from quartering.motion.equations.basis import waves_at
from quartering.motion.equations.model import Model
from quartering.motion.equations.rates import WIDTH
from quartering.motion.equations.system import Floats
from quartering.motion.transient.rk4 import alike, room_to_march, step_sum
from quartering.option_checks import quoted

if TYPE_CHECKING:
    import xarray as xr

MOST_PERIODS: Final = 10_000
"""Longest march taken [wave periods]: most ships that capsize do so within tens."""

_LARGEST_START: Final = 360.0  # of a roll angle [deg] and of a roll rate [deg/s]
_AT_ONCE = 64
"""Periods between which an interrupt is heard."""


@kernel
def _march(first, last, equations, h, forcing, begin, steps, limit, states, times):
    """Runge-Kutta steps for rows first..last of starts, a row being a batch; `forcing` (2 per period, h): the wave's harmonics.

    ``begin`` steps, whole periods, have been taken before. ``states`` (rows, 4 to 6, W) of a start go on until |roll| passes
    `limit`; ``times`` (rows, W) is when it did, NaN before.
    """
    room, excitation = room_to_march(equations), np.empty((3, 3, WIDTH))
    lanes, total, waves = room[0], room[4], np.empty((3, forcing.shape[1]))
    roll = equations.program.displacements[1]
    for row in range(first, last):
        y, going = states[row], np.isnan(times[row]).sum()
        for n in range(steps):
            if going == 0:
                break
            for j in range(3):
                phase = (2 * n + j) % forcing.shape[0]
                for i in range(forcing.shape[1]):
                    waves[j, i] = forcing[phase, i]
                for k in range(3):
                    for l in range(WIDTH):
                        wave = lanes.cos[k, l] * waves[j, 1] + lanes.sin[k, l] * waves[j, 2]
                        excitation[j, k, l] = lanes.mean[k, l] + wave
            step_sum(equations, h, excitation, waves, y, room)
            for s in range(y.shape[0]):
                for l in range(WIDTH):
                    if np.isnan(times[row, l]):
                        y[s, l] += h / 6.0 * total[s, l]
            for l in range(WIDTH):
                if np.isnan(times[row, l]) and not abs(y[roll, l]) <= limit:
                    times[row, l] = (begin + n + 1) * h
                    going -= 1


def capsize_times(
    model: Model, starts: ArrayLike, periods: int = 32, *, steps: int = 80, limit: float | None = None
) -> tuple[Floats, Floats]:
    """When each of many starts capsizes, and where the others have got to.

    starts (n, 4): v [m/s], phi [rad], p, r [rad/s] at time 0; an autopilot starts on course, its rudder amidships
    periods: of the wave, to go on for
    steps: Runge-Kutta steps a period
    limit: roll angle that counts as capsize [rad]; by default the model's ``capsize_limit``
    Returns times (n,): [s]; NaN for a start that does not capsize; states (n, 4): at the end (or at the capsize)

    Fixed-step Runge-Kutta of order 4: for statistics of many starts, not for one exact history (see `simulate`).
    Source: [H71] eq. (3); [Thompson89] for the use.
    """
    states = np.array(starts, dtype=float)
    if states.ndim != 2 or states.shape[1] != 4 or not np.isfinite(states).all():
        raise InputError(f"starts need four finite numbers each (v, phi, p, r); given shape {states.shape}")
    periods, steps = count("periods", periods, 1, 32), count("steps", steps, 4, 80, 100_000)
    if periods > MOST_PERIODS:
        raise InputError(f"periods = {periods}; give 1 to {MOST_PERIODS:,}: most capsizes come within 16 periods")
    angle = model.capsize_limit.radians if limit is None else number(None, "limit", limit)
    rows = -(-len(states) // WIDTH)
    # the last row is filled up with its last start, and all stand in batches: (rows, states, W)
    filled = np.pad(states, ((0, rows * WIDTH - len(states)), (0, 0)), mode="edge")
    filled = np.pad(filled, ((0, 0), (0, model.system.states - 4)))
    going = np.ascontiguousarray(filled.reshape(rows, WIDTH, -1).transpose(0, 2, 1))
    phase = np.pi * np.arange(2 * steps) / steps
    forcing = np.ascontiguousarray(waves_at(phase, model.system.inputs.shape[2]).T)
    times = np.full((rows, WIDTH), np.nan)
    wave = (alike(model.system), 2 * np.pi / model.frequency / steps, forcing)
    for begin in range(0, periods, _AT_ONCE):
        ahead = min(_AT_ONCE, periods - begin)
        in_threads(_march, rows, *wave, begin * steps, ahead * steps, angle, going, times, smallest=1)
    ends = going.transpose(0, 2, 1).reshape(rows * WIDTH, -1)
    return times.ravel()[: len(states)], ends[: len(states), :4]


@takes(model="Model")
def basin(
    model: Model, roll: ArrayLike, roll_rate: ArrayLike, *, periods: int = 32, limit: float | None = None
) -> xr.Dataset:
    """Safe basin: from which roll angles and rates the ship does not capsize in a given wave.

    Parameters
    ----------
    model : Model
    roll : (a,) float         roll angles at time 0 [deg]
    roll_rate : (b,) float    roll rates at time 0 [deg/s]
    periods : int             of the wave, to go on for
    limit : float             roll angle that counts as capsize [rad]; by default the model's ``capsize_limit``

    Returns
    -------
    xarray.Dataset            capsize_time (roll_rate, roll) [s], NaN where safe; attributes ``safe_share`` of all
                              starts, ``capsize_angle`` [deg] and ``capsize_reason``

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

    angles, rates = _axis("roll", roll, "deg"), _axis("roll_rate", roll_rate, "deg/s")
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
        "capsize_angle": model.capsize_limit.angle if limit is None else float(np.degrees(limit)),
        "capsize_reason": model.capsize_limit.reason if limit is None else "given",
        "references": ", ".join((*model.references, "Thompson89")),
    }
    return xr.Dataset(data, coordinates, attributes)


def _axis(name: str, given: ArrayLike, unit: str) -> Floats:
    """Values of one axis of the starts."""
    found = real(given)
    values = np.empty(0) if found is None else np.atleast_1d(found)
    if values.ndim != 1 or not values.size or not (np.abs(values) <= _LARGEST_START).all():
        raise InputError(
            f"{name} = {quoted(given)}; it is one list of numbers [{unit}] from -{_LARGEST_START:g} to {_LARGEST_START:g}, "
            "such as numpy.linspace(-40, 40, 41)"
        )
    return values


_TIME = {"units": "s", "long_name": "time of the capsize, NaN where there is none", "symbol": "t"}


def safe_shares(
    models: list[Model], starts: ArrayLike, *, periods: int = 32, limit: float | None = None
) -> NDArray[np.float64]:
    """Share of the starts that stay safe in each of several waves: the integrity curve.

    models: such as one ship in waves of rising height
    starts (n, 4): as for `capsize_times`
    periods: of the wave, to go on for
    limit: roll angle that counts as capsize [rad]; by default the model's ``capsize_limit``
    Returns (m,): 0 to 1, of each model

    Source: [Thompson89].
    """
    return np.array([np.isnan(capsize_times(m, starts, periods, limit=limit)[0]).mean() for m in models])
