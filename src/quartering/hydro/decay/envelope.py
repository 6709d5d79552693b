"""Froude's energy balance: damping from the extremes of a free decay alone."""

from __future__ import annotations

import numpy as np
from scipy.stats import t as student

from quartering.hull.lines.section import Floats
from quartering.hydro.decay.fit import DecayFit, Estimate, Form, Restoring, check_choices
from quartering.hydro.decay.record import DecayRecord, extremes


def energy_decay(
    record: DecayRecord,
    form: Form = "quadratic",
    *,
    restoring: Restoring = "cubic",
    skip: int = 0,
    confidence: float = 0.95,
) -> DecayFit:
    """Damping by Froude's energy balance from the extremes alone.

    Swing amplitudes A are half the heights from extreme to extreme, which frees them of the mean. Their half periods
    give w^2 = w0^2 + (3/4) k3 A^2 by least squares. The loss from swing to swing of V = w0^2 A^2/2 + k3 A^4/4 is
    pi zeta w0 w A^2 + (4/3) d w^2 A^3 + (3 pi/8) c w^3 A^4; over the first of these it is linear in zeta and d or c, and is
    fitted with weights A^2. Intervals by Student's t; neighbouring losses share an extreme, which widens them.
    Source: [Froude1874]; [Himeno81] ch. 2.  Valid: small damping, the swing harmonic.
    """
    check_choices(form, restoring, confidence)
    found = extremes(record, skip=skip)
    swing, half = found.swings, np.diff(found.time)
    columns = [np.ones_like(swing), 0.75 * swing**2] if restoring == "cubic" else [np.ones_like(swing)]
    stiffness, _ = _straight(np.stack(columns, axis=1), (np.pi / half) ** 2, swing**2, confidence)
    square, k3 = stiffness[0], stiffness[1] if restoring == "cubic" else Estimate(0.0, 0.0, 0.0)
    w0 = float(np.sqrt(square.value))
    amplitude = (swing[:-1] + swing[1:]) / 2
    w = np.sqrt(np.maximum(square.value + 0.75 * k3.value * amplitude**2, 1e-12))
    loss = -np.diff(square.value * swing**2 / 2 + k3.value * swing**4 / 4)
    ratio = loss / (np.pi * w0 * w * amplitude**2)
    basis = 4 * w * amplitude / (3 * np.pi * w0) if form == "quadratic" else 3 * (w * amplitude) ** 2 / (8 * w0)
    found_damping, misfit = _straight(np.stack([np.ones_like(basis), basis], axis=1), ratio, amplitude**2, confidence)
    middle, _ = _straight(np.ones((swing.size - 1, 1)), found.middles, np.ones(swing.size - 1), confidence)
    return DecayFit(
        source=record.source,
        method="energy",
        form=form,
        frequency=Estimate(w0, float(np.sqrt(max(square.low, 0.0))), float(np.sqrt(square.high))),
        damping_ratio=found_damping[0],
        nonlinear=found_damping[1],
        restoring_cubic=k3,
        offset=middle[0],
        largest=float(swing[0]),
        smallest=float(swing[-1]),
        swings=swing.size,
        misfit=misfit,
        confidence=confidence,
    )


def _straight(matrix: Floats, values: Floats, weight: Floats, confidence: float) -> tuple[tuple[Estimate, ...], float]:
    """Weighted linear least squares: estimates with intervals, and the weighted misfit over the mean."""
    root = np.sqrt(weight / weight.mean())
    scaled, target = matrix * root[:, None], values * root
    inverse = np.linalg.pinv(scaled.T @ scaled)
    solution = inverse @ scaled.T @ target
    left = scaled @ solution - target
    freedom = max(values.size - matrix.shape[1], 1)
    width = student.ppf(0.5 + confidence / 2, freedom) * np.sqrt(np.diag(inverse) * float(left @ left) / freedom)
    estimates = tuple(Estimate(float(v), float(v - s), float(v + s)) for v, s in zip(solution, width, strict=True))
    return estimates, float(np.sqrt(np.mean(left**2)) / max(abs(np.mean(target)), 1e-300))
