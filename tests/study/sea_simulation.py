"""Simulation of a ship in a sea, beside the product: Gaussian amplitudes in every wave cell, FFT, Runge-Kutta in numpy."""

import numpy as np
from scipy.sparse import csr_matrix

from quartering.hydro.coefficients import coefficients
from quartering.loads.lift import ship_lift_phasors, ship_water_velocity
from quartering.loads.sea.cells import wave_cells
from quartering.motion.drag_of_ship import drag_strips
from quartering.motion.equations.model import Model
from quartering.motion.equations.water import Strips
from quartering.motion.of_ship import excitation, nonlinear_terms
from quartering.motion.sea.equations import equations_of_model, free_roll_of
from quartering.names import LINEAR_NAMES


def frozen(ship, speed):
    """The ship as a model with the coefficients of its free roll, and the force (with the water's motion) of its waves."""
    frequency = free_roll_of(ship, speed)[0]
    c = coefficients(ship, frequency, speed)
    terms = {name: float(c.linear[0, i, j]) for i, row in enumerate(LINEAR_NAMES) for j, name in enumerate(row)}
    one = drag_strips(ship, np.array([0.05]), np.array([speed]), np.array([90.0]))
    model = Model(
        c.inertia[0], terms | nonlinear_terms(c), frequency, (0, 0, 0), (0, 0, 0), restoring=c.righting, water=(0, 0),
        strips=Strips(one.x, one.lever, one.c, 0.0 * one.water[0]),
    )  # fmt: skip

    def force(sigma, heading):
        at = (sigma**2 / 9.81, np.full(sigma.shape, speed), heading)
        waves, omega = excitation(ship, *at)
        waves = waves + ship_lift_phasors(ship, coefficients(ship, omega, speed), *at)
        w = np.stack(ship_water_velocity(ship, *at), axis=1)
        everything = np.concatenate([waves, w, drag_strips(ship, *at).water], axis=1)
        return np.where((omega < 0)[:, None], everything.conj(), everything)

    return model, force


def simulated(model, force, sea, speed, *, records, seed, duration=1800.0, before=240.0, step=0.2):
    """Covariance (4, 4) of v, phi, p, r, its standard error, and the largest |phi| of each record after the run-up."""
    frequency, damping = free_roll_of(model, speed)
    cells = wave_cells([sea], speed, frequency, damping / 5.0)
    equations = equations_of_model(model, cells, force)
    energy = cells.energy(sea)
    used = np.flatnonzero(energy > 1e-9 * energy.sum())
    samples = 2 * round((duration + before) / step)
    bins = np.rint(np.abs(cells.omega[used]) * samples * step / 2 / (2 * np.pi)).astype(int)
    water = equations.water[used, 0] + 1j * equations.water[used, 1]
    phasors = np.concatenate([equations.force[used], equations.inputs[used], water], axis=1)
    phasors *= np.sqrt(2.0 * energy[used])[:, None]
    rng, series = np.random.default_rng(seed), []
    for _ in range(records):
        z = (rng.standard_normal(used.size) + 1j * rng.standard_normal(used.size)) / np.sqrt(2.0)
        matrix = csr_matrix((z, (bins, np.arange(used.size))), (samples // 2 + 1, used.size))
        spectrum = matrix @ phasors
        spectrum[0] *= 2.0
        series.append(np.fft.irfft(0.5 * samples * spectrum, samples, axis=0).astype(np.float32))
    return _march(model, np.stack(series, axis=2), step, round(before / step))


def _march(model, series, step, first):
    """Runge-Kutta over (samples, channels, records) at half steps."""
    system, inverse = model.system, np.linalg.inv(model.inertia)
    linear, drag = system.linear[0], model.strips
    forms = None if drag is None else np.stack([np.ones_like(drag.x), -drag.lever, drag.x])
    extra = 0 if model.water is None else 2

    def rate(y, given):
        accelerations = linear @ y + inverse @ given[:3]
        variables = np.concatenate([y, y[system.extra] + given[3 : 3 + extra]]) if extra else y
        for t in range(system.modulus.size):
            product = np.prod(variables ** system.powers[t][:, None], axis=0)
            if system.modulus[t]:
                product = product * np.abs(variables[system.modulus[t] - 1])
            accelerations += system.coefficients[0, :, t][:, None] * product
        if model.restoring is not None:
            beyond = model.restoring.value(y[1]) - model.restoring.slope * y[1]
            accelerations += inverse[:, [1]] * beyond
        if drag is not None:
            q = forms.T @ y[[0, 2, 3]] - given[3 + extra :]
            accelerations -= inverse @ (forms @ (drag.c[:, None] * np.abs(q) * q))
        return np.stack([accelerations[0], y[2], accelerations[1], accelerations[2]])

    records = series.shape[2]
    y, sums, largest, count = np.zeros((4, records)), np.zeros((records, 4, 4)), np.zeros(records), 0
    for n in range(series.shape[0] // 2 - 1):
        now, half, later = series[2 * n], series[2 * n + 1], series[2 * n + 2]
        k1 = rate(y, now)
        k2 = rate(y + 0.5 * step * k1, half)
        k3 = rate(y + 0.5 * step * k2, half)
        k4 = rate(y + step * k3, later)
        y = y + step / 6.0 * (k1 + 2 * k2 + 2 * k3 + k4)
        if n >= first:
            sums += np.einsum("ir,jr->rij", y, y)
            largest = np.maximum(largest, np.abs(y[1]))
            count += 1
    each = sums / count
    return each.mean(axis=0), each.std(axis=0) / np.sqrt(records), largest
