"""Many realisations of an irregular sea at once: motion in time under a sum of waves."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from quartering.compiled import kernel
from quartering.conventions import InputError
from quartering.motion.abreast import WIDTH, forces, raise_powers, rows_abreast
from quartering.motion.equations import Floats, Model
from quartering.motion.simulate import CAPSIZE_ANGLE
from quartering.threads import in_threads

if TYPE_CHECKING:
    import xarray as xr

_CHUNK = 512
"""Steps whose excitation is computed together."""


@kernel
def _march(first, last, linear, coefficients, powers, modulus, forcing, h, begin, limit, states, peak, square, capsize):
    """Fourth-order Runge-Kutta for rows first..last of realisations abreast; `forcing` (2 steps + 1, 3, n) at half steps.

    ``states`` (rows, 4, W), ``peak``, ``square`` (the sum of roll squared) and ``capsize`` (time, NaN before) (rows, W)
    go on from where they are; a realisation past ``limit`` stands still.
    """
    own, room, degrees = rows_abreast(powers, 1)
    lin, coef = own[0], own[1]
    stage, table, force, _, _ = room
    rate, total = np.empty((4, WIDTH)), np.empty((4, WIDTH))
    for l in range(WIDTH):
        for k in range(3):
            for s in range(4):
                lin[k, s, l] = linear[k, s]
            for t in range(powers.shape[0]):
                coef[k, t, l] = coefficients[k, t]
    for row in range(first, last):
        y = states[row]
        for n in range(forcing.shape[0] // 2):
            for s in range(4):
                for l in range(WIDTH):
                    stage[s, l], total[s, l] = y[s, l], 0.0
            for j in range(4):
                raise_powers(stage, degrees, table)
                forces(lin, coef, powers, modulus, stage, table, force)
                excitation = forcing[2 * n + (j + 1) // 2, :, row * WIDTH : (row + 1) * WIDTH]
                weight = 1.0 if j == 0 or j == 3 else 2.0
                ahead = 0.5 * h if j < 2 else h
                for l in range(WIDTH):
                    rate[0, l] = force[0, l] + excitation[0, l]
                    rate[1, l] = stage[2, l]
                    rate[2, l] = force[1, l] + excitation[1, l]
                    rate[3, l] = force[2, l] + excitation[2, l]
                for s in range(4):
                    for l in range(WIDTH):
                        total[s, l] += weight * rate[s, l]
                        stage[s, l] = y[s, l] + ahead * rate[s, l]
            for l in range(WIDTH):
                going = 1.0 if np.isnan(capsize[row, l]) else 0.0
                for s in range(4):
                    y[s, l] += going * h / 6.0 * total[s, l]
                roll = abs(y[1, l])
                peak[row, l] = max(peak[row, l], roll)
                square[row, l] += going * roll * roll
                if going > 0.0 and not roll <= limit:
                    capsize[row, l] = begin + (n + 1) * h


def irregular(
    model: Model,
    frequency: ArrayLike,
    force: ArrayLike,
    phase: ArrayLike,
    duration: float,
    *,
    step: float = 0.2,
    limit: float = CAPSIZE_ANGLE,
) -> xr.Dataset:
    """Largest roll of many realisations of an irregular sea, from rest.

    Parameters
    ----------
    model : Model               its terms, inertia and steady force; its regular wave is left out
    frequency : (c,) float      encounter frequencies of the components [rad/s]
    force : (c, 3) complex      amplitude and phase of sway force [N], roll and yaw moment [N m] of each component:
                                the real part of force exp(i (w t + phase)) acts
    phase : (n, c) float        phases of the components in each of n realisations [rad]
    duration : float            [s]
    step : float                of time [s]
    limit : float               roll angle that counts as capsize [rad]; a realisation stops there

    Returns
    -------
    xarray.Dataset    over realisation: roll_peak, roll_rms [deg] (until a capsize), capsize_time [s] (NaN where none), and
                      state at the end (realisation, component: v [m/s], phi [rad], p, r [rad/s])

    Raises
    ------
    InputError        an autopilot, shapes that do not fit together, numbers that are not finite, a step or duration not above 0

    Notes
    -----
    Fourth-order Runge-Kutta with a fixed step; the excitation is one matrix product for all realisations.
    Source: [H71] eq. (3), superposition of components.  Valid: coefficients taken at one frequency stand for all
    components (they are those of ``model``); long waves and small steepness, so that components add.

    Examples
    --------
    >>> model = Model(np.eye(3), {"Y_v": -1.0, "K_phi": -1.0, "K_p": -0.1, "N_r": -1.0}, 1.0, (0, 0, 0), (0, 0, 0))
    >>> sea = irregular(model, [0.5], [[0, 0.03, 0]], [[0.0], [1.0]], duration=400.0)
    >>> sea["roll_peak"].dims, bool((sea["roll_peak"] > 2.29).all())  # 0.04 rad once the start has died out
    (('realisation',), True)
    """
    if model.autopilot is not None:
        raise InputError("an irregular sea is run with the rudder amidships: give a model with autopilot=None")
    w, f, phases = np.asarray(frequency, float), np.asarray(force, complex), np.asarray(phase, float)
    if w.ndim != 1 or f.shape != (w.size, 3) or phases.ndim != 2 or phases.shape[1] != w.size or phases.shape[0] == 0:
        raise InputError(
            f"frequency {w.shape}, force {f.shape} and phase {phases.shape} do not fit together: give c frequencies, (c, 3)"
            " forces and (n, c) phases"
        )
    if not (np.isfinite(w).all() and np.isfinite(f).all() and np.isfinite(phases).all()):
        raise InputError("frequency, force and phase must be finite numbers")
    if not (np.isfinite(duration) and np.isfinite(step) and 0 < step <= duration):
        raise InputError(f"step {step} s and duration {duration} s: both greater than zero, the step the smaller")
    count, steps = phases.shape[0], round(duration / step)
    rows = -(-count // WIDTH)
    acceleration = np.linalg.solve(model.inertia, f.T)  # (3, c)
    turned = acceleration[:, None, :] * np.exp(1j * phases)  # (3, n, c)
    amplitude = np.zeros((2 * w.size, 3, rows * WIDTH))
    amplitude[: w.size, :, :count] = turned.real.transpose(2, 0, 1)
    amplitude[w.size :, :, :count] = -turned.imag.transpose(2, 0, 1)
    amplitude = amplitude.reshape(2 * w.size, -1)
    linear, coefficients, powers, modulus, mean, *_ = model.system.kernel_arrays()
    states, peak, square = np.zeros((rows, 4, WIDTH)), np.zeros((rows, WIDTH)), np.zeros((rows, WIDTH))
    capsize, room = np.full((rows, WIDTH), np.nan), np.empty((2 * _CHUNK + 1, amplitude.shape[1]))
    for begin in range(0, steps, _CHUNK):
        ahead = min(_CHUNK, steps - begin)
        angle = np.multiply.outer((begin + 0.5 * np.arange(2 * ahead + 1)) * step, w)
        waves = np.concatenate([np.cos(angle), np.sin(angle)], axis=1)
        forcing = np.matmul(waves, amplitude, out=room[: 2 * ahead + 1]).reshape(2 * ahead + 1, 3, -1)
        if mean[0].any():
            forcing += mean[0][:, None]
        in_threads(_march, rows, linear[0], coefficients[0], powers, modulus, forcing, step, begin * step, limit,
                   states, peak, square, capsize)  # fmt: skip
    return _dataset(model, states, peak, square, capsize, count, steps * step, step)


def _dataset(
    model: Model,
    states: Floats,
    peak: Floats,
    square: Floats,
    capsize: Floats,
    count: int,
    duration: float,
    step: float,
) -> xr.Dataset:
    import xarray as xr

    time = capsize.ravel()[:count]
    past = np.where(np.isnan(time), duration, time)
    data = {
        "roll_peak": (np.degrees(peak.ravel()[:count]), "deg", "largest roll angle"),
        "roll_rms": (np.degrees(np.sqrt(square.ravel()[:count] * step / past)), "deg", "root mean square roll angle"),
        "capsize_time": (time, "s", "time of capsize"),
    }
    result = xr.Dataset(
        {
            name: ("realisation", values, {"units": unit, "long_name": words})
            for name, (values, unit, words) in data.items()
        }
    )
    ends = states.transpose(0, 2, 1).reshape(-1, 4)[:count]
    result["state"] = (("realisation", "component"), ends, {"units": "m/s, rad, rad/s, rad/s", "long_name": "end"})
    result.attrs = {"duration": duration, "step": step, "references": ", ".join(model.references)}
    return result.assign_coords(component=["v", "phi", "p", "r"])
