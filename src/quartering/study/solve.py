"""Motions and stability of thousands of models in one call, on the kernels of maps."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from quartering._machine.threads import spread
from quartering.conventions import MODES, InputError
from quartering.motion.equations.batch import joined
from quartering.motion.equations.model import Model
from quartering.motion.equations.system import Floats
from quartering.motion.steady.harmonic import checked_harmonics, orders_for
from quartering.motion.steady.motion import Start, roll_peaks, steady_motions, within_limits
from quartering.option_checks import quoted
from quartering.stability.assessment import assess
from quartering.stability.precompile import announce_compilation
from quartering.study.conditions import ACCURACY
from quartering.study.dataset import attributes, made_by

_BLOCK: Final = 1024
_JUDGED: Final = ("k2", "k2_rho", "index", "n2", "exponent", "multiplier_modulus", "verdict")


def solve(
    models: Sequence[Model], harmonics: int = 3, *, stability: bool = True, start: Start = "linear"
) -> xr.Dataset:
    """Periodic motion and stability of many models at once, each with an answer or a status of its own.

    Parameters
    ----------
    models : sequence of Model    any mixture: other terms, inertia, waves, drag, autopilots
    harmonics : int               1: the paper's modified Struble method; 3, 5, 7, ..: harmonic balance; never raised by itself
    stability : bool              judge the motions too: Floquet multipliers, K2, S, verdict
    start : str                   "linear" or "rest", as in `steady_motion`

    Returns
    -------
    xarray.Dataset    along ``model``, in the order given: sway_amplitude [m], roll_amplitude, yaw_amplitude, roll_peak [deg],
                      status, residual; ``cos``, ``sin`` (model, harmonic, mode) and ``mean`` (model, mode) [m, rad, rad; m/s,
                      rad, rad/s], of which harmonics a motion does not hold are 0; and, judged, exponent [1/s], verdict, k2,
                      k2_rho, index, n2, multiplier_modulus (model, multiplier). A model without a motion has NaN and a status

    Raises
    ------
    InputError    no models, one that is no `Model` (its place is named), `harmonics` that cannot be, an unknown start

    Notes
    -----
    Models of one layout go through the compiled kernels 64 at a time, on all cores; the answer of one is that of
    `steady_motion(model, harmonics, fixed=True)` and `stability` to rounding, whoever stands beside it. A motion past the
    model's capsize limit is no answer.
    Source: [H71] Appendix A, eqs. (8)-(15); [Krack19].

    Examples
    --------
    >>> terms = {"Y_v": -0.4, "K_phi": -1.0, "K_p": -0.05, "K_phiphiphi": -0.25, "N_r": -0.6}
    >>> waves = [Model(np.eye(3), terms, 0.85, (0, force, 0), (0, 0, 0)) for force in (0.01, 0.02, 0.03)]
    >>> ds = solve(waves)
    >>> ds.roll_amplitude.dims, bool((ds.roll_amplitude.diff("model") > 0).all()), ds.verdict.values.tolist()
    (('model',), True, [0, 0, 0])
    """
    models = _checked(models)
    checked_harmonics(harmonics)
    announce_compilation()
    count, highest = len(models), max(harmonics, 3)
    columns: dict[str, NDArray[Any]] = {
        "cos": np.zeros((count, highest, 3)), "sin": np.zeros((count, highest, 3)), "mean": np.zeros((count, 3)),
        "roll_peak": np.full(count, np.nan), "residual": np.full(count, np.nan), "status": np.zeros(count, np.int8),
    }  # fmt: skip
    if stability:
        columns |= {name: np.full(count, np.nan) for name in _JUDGED}
        columns |= {"multiplier_modulus": np.full((count, 6), np.nan), "verdict": np.full(count, -1, np.int8)}
    blocks = list(_blocks(models, harmonics))
    for i, found in spread(lambda which: _solved([models[k] for k in which], harmonics, stability, start), blocks):
        for name, values in found.items():
            columns[name][_place(blocks[i], values)] = values
    return _dataset(models, columns, harmonics)


def _place(which: list[int], values: NDArray[Any]) -> Any:
    """Where results of some models go; one with fewer harmonics or states leaves the rest as it is."""
    return (np.array(which), *(slice(0, size) for size in values.shape[1:]))


def _checked(models: Any) -> list[Model]:
    if isinstance(models, Model):
        raise InputError("models is one Model; give a list of them, [model], or ask `steady_motion` and `stability`")
    try:
        given = list(models)
    except TypeError:
        raise InputError(f"models = {quoted(models)}; it is a list of Model") from None
    for k, one in enumerate(given):
        if not isinstance(one, Model):
            raise InputError(
                f"models[{k}] = {quoted(one)} is no Model; make it by quartering.equations or quartering.Model"
            )
    if not given:
        raise InputError("models is empty; give one Model or more")
    return given


def _blocks(models: Sequence[Model], harmonics: int) -> list[list[int]]:
    """Places of models with the same states, known inputs and harmonics: no motion takes part in another's equations."""
    alike: dict[object, list[int]] = {}
    for k, one in enumerate(models):
        s = one.system
        key = (
            s.states,
            tuple(s.extra.tolist()),
            orders_for(s, max(harmonics, 3)),
            s.strips.shape[1:],
            s.knots.shape[1:],
        )
        alike.setdefault(key, []).append(k)
    return [places[i : i + _BLOCK] for places in alike.values() for i in range(0, len(places), _BLOCK)]


def _solved(models: list[Model], harmonics: int, stability: bool, start: Start) -> dict[str, NDArray[Any]]:
    """Results of models that go together."""
    system = joined([one.system for one in models])
    u, orders, status, residual = steady_motions(system, harmonics, start=start)
    peak = roll_peaks(u, orders)
    u, status = within_limits(u, status, peak, np.array([one.capsize_limit.radians for one in models]))
    known = np.isfinite(u).all(axis=(1, 2))
    found = _harmonics(u, orders) | {
        "roll_peak": np.where(known, np.degrees(peak), np.nan), "status": status, "residual": residual,
    }  # fmt: skip
    if not stability:
        return found
    result = assess(system, u, orders, ACCURACY, detail="map")
    first, multipliers = result.first_order, result.floquet
    return found | {
        "k2": first.k2, "k2_rho": first.k2_rho, "index": first.index, "n2": first.n2, "exponent": multipliers.growth,
        "multiplier_modulus": np.abs(multipliers.multipliers), "verdict": result.kind,
    }  # fmt: skip


def _harmonics(u: Floats, orders: tuple[int, ...]) -> dict[str, NDArray[Any]]:
    """Coefficients at the place of their harmonic."""
    first = 1 if orders[0] == 0 else 0
    held = [h for h in orders if h > 0]
    cos, sin = np.zeros((2, len(u), max(held), 3))
    for i, h in enumerate(held):
        cos[:, h - 1], sin[:, h - 1] = u[:, :, first + 2 * i], u[:, :, first + 2 * i + 1]
    return {"cos": cos, "sin": sin, "mean": u[:, :, 0] if first else np.where(np.isfinite(u[:, :, 0]), 0.0, np.nan)}


def _dataset(models: Sequence[Model], columns: dict[str, NDArray[Any]], harmonics: int) -> xr.Dataset:
    size = np.hypot(columns["cos"][:, 0], columns["sin"][:, 0]) * [1.0, np.degrees(1.0), np.degrees(1.0)]
    fields: dict[str, Any] = {
        f"{mode}_amplitude": ("model", size[:, k], attributes(f"{mode}_amplitude")) for k, mode in enumerate(MODES)
    }
    of_motion = {"units": "m, rad, rad", "long_name": "coefficient of a harmonic"}
    fields |= {name: (("model", "harmonic", "mode"), columns.pop(name), of_motion) for name in ("cos", "sin")}
    of_mean = {"units": "m/s, rad, rad/s", "long_name": "mean sway velocity, heel and yaw rate"}
    fields["mean"] = (("model", "mode"), columns.pop("mean"), of_mean)
    residual = {"units": "1", "long_name": "largest imbalance over the excitation"}
    fields["residual"] = ("model", columns.pop("residual"), residual)
    if "multiplier_modulus" in columns:
        moduli = columns.pop("multiplier_modulus")
        kept = max(one.system.states for one in models)
        fields["multiplier_modulus"] = (("model", "multiplier"), moduli[:, :kept], attributes("multiplier_modulus"))
    fields |= {name: ("model", values, attributes(name)) for name, values in columns.items()}
    frequency = np.array([one.frequency for one in models])
    coordinates = {
        "encounter_frequency": ("model", frequency, attributes("encounter_frequency")),
        "harmonic": np.arange(1, fields["cos"][1].shape[1] + 1), "mode": list(MODES),
    }  # fmt: skip
    method = "modified Struble method" if harmonics == 1 else f"harmonic balance to order {harmonics}"
    keys = dict.fromkeys(key for one in models for key in one.references)
    return xr.Dataset(
        fields, coordinates, {"steady_motion": method, "references": ", ".join(keys), "source": made_by()}
    )
