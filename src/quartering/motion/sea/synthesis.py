"""Records of a sea: series of everything it drives a ship with, by Fourier transform from cross-spectral matrices."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
# A record of length T has the frequencies w_j = j 2 pi/T. Every wave cell, its phasors f per metre, goes to the two of them
# that its |omega| lies between, in proportion: G_j = sum S dsigma dmu f f^H. With the Hermitian root C_j C_j = G_j and z_j
# complex Gaussian of E|z|^2 = 2, the series Re sum C_j z_j e^{i w_j t} are Gaussian, with the covariances and coherences of
# the sea, for any number of cells: irfft(N C_j z_j/2), the mean N Re C_0 z_0. The root is Hermitian because eigenvectors have
# no phase of their own: any other would make the record hang on who computed them.
#
# A single cell must not be wider than w_1, or the record would consist of lines with nothing between, and its groups would
# repeat. The phasors are smooth over wave frequency but for the conjugation at omega = 0: with that undone they are
# interpolated by cubic splines to as many cells as the record tells apart.

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.fft import irfft, next_fast_len
from scipy.interpolate import CubicSpline

from quartering._machine.compiled import batch_kernel, kernel
from quartering.loads.sea.cells import Cells
from quartering.loads.sea.sea import Sea

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]
Single = NDArray[np.float32]

RECORDS: Final = 64
"""Records of a row: what is drawn, and counted, together."""

HELD: Final = 0.999
"""Share of the energy of every force that the frequencies of a record hold at least [1]."""
_FORCES: Final = 3
_NEGLIGIBLE: Final = 1e-12
_CELLS_AT_ONCE: Final = 20_000


@dataclass(frozen=True, eq=False)
class Record:
    """What records of one sea are made of.

    Parameters
    ----------
    samples : int                N
    interval : float             between them [s]
    roots : (j, m, m) complex    Hermitian roots of the cross-spectral matrices, at 0, 2 pi/T, ..
    left_out : float             largest share of the energy of a force beyond the last frequency [1]
    """

    samples: int
    interval: float
    roots: NDArray[np.complex64]
    left_out: float

    @property
    def covariance(self) -> Floats:
        """Covariance (m, m) of the channels in the mean over many records."""
        g = self.roots.astype(complex) @ self.roots.astype(complex)
        return np.asarray(g.real.sum(axis=0))


def record_of(cells: Cells, sea: Sea, channels: Complex, duration: float, interval: float) -> Record:
    """What records of a sea are made of.

    channels (c, m): per metre in each cell, phasors of e^{i |omega| t}; the first three are forces
    duration: of a record at the least [s]
    interval: between samples [s]
    """
    samples = int(next_fast_len(math.ceil(duration / interval), real=True))
    spacing = 2.0 * math.pi / (samples * interval)
    spectra = cross_spectra(cells, sea, channels, spacing, samples // 2)
    energy = np.cumsum(np.einsum("jaa->ja", spectra[:, :_FORCES, :_FORCES]).real, axis=0)
    whole = np.where(energy[-1] > 0, energy[-1], 1.0)
    held = (energy >= HELD * energy[-1]).all(axis=1)
    last = min(int(held.argmax()) + 1, samples // 2)
    left_out = float((1.0 - energy[last - 1] / whole).max())
    return Record(samples, interval, _roots(spectra[:last]), left_out)


def cross_spectra(cells: Cells, sea: Sea, channels: Complex, spacing: float, bins: int) -> Complex:
    """Cross-spectral matrices (j, m, m) at multiples of a spacing, of cells no wider than it."""
    f, d, m = cells.sigma.size, cells.heading.size, channels.shape[1]
    slope = np.abs(np.gradient(cells.omega.reshape(f, d), cells.step, axis=0)).max()
    parts = max(1, math.ceil(cells.step * slope / spacing))
    step = cells.step / parts
    sigma = cells.sigma[0] - 0.5 * cells.step + step * (np.arange(parts * f) + 0.5)
    whole = np.where(cells.omega[:, None] < 0, channels.conj(), channels).reshape(f, d, m)
    fine = CubicSpline(cells.sigma, whole, axis=0)
    spectra: Complex = np.zeros((bins + 1, m, m), dtype=complex)
    rows = max(1, _CELLS_AT_ONCE // d)
    for first in range(0, sigma.size, rows):
        part = Cells(sigma[first : first + rows], step, cells.heading, cells.breadth, cells.speed)
        phasors = np.ascontiguousarray(fine(part.sigma).reshape(-1, m))
        _add_cells(part.omega, part.energy(sea), phasors, spacing, spectra)
    return spectra


@kernel
def _add_cells(omega, energy, phasors, spacing, spectra):
    """Add the energy of cells to the upper halves of the two matrices each lies between; beyond the last it is dropped."""
    m = phasors.shape[1]
    for i in range(omega.size):
        place = abs(omega[i]) / spacing
        j = int(place)
        if energy[i] > 0.0 and j + 1 < spectra.shape[0]:
            for a in range(m):
                left = energy[i] * (phasors[i, a] if omega[i] >= 0.0 else phasors[i, a].conjugate())
                for b in range(m):
                    right = phasors[i, b].conjugate() if omega[i] >= 0.0 else phasors[i, b]
                    spectra[j, a, b] += (1.0 - (place - j)) * (left * right)
                    spectra[j + 1, a, b] += (place - j) * (left * right)


def _roots(spectra: Complex) -> NDArray[np.complex64]:
    """Hermitian roots, each channel measured by its own deviation, so that small ones do not drown in rounding."""
    deviation = np.sqrt(np.einsum("jaa->a", spectra).real)
    scale = np.where(deviation > 0, deviation, 1.0)
    values, vectors = np.linalg.eigh(spectra / np.multiply.outer(scale, scale))
    trace = np.maximum(values, 0.0).sum(axis=1, keepdims=True)
    size = np.sqrt(np.where(values > _NEGLIGIBLE * trace, values, 0.0))
    roots = (vectors * size[:, None, :]) @ vectors.conj().transpose(0, 2, 1)
    return np.ascontiguousarray(scale[None, :, None] * roots).astype(np.complex64)


def series_of(record: Record, entropy: int, condition: int, first: int) -> Single:
    """A row of records, each from a seed of its own.

    entropy: the user's seed
    condition: number of the condition the records are of
    first: number of the first of the `RECORDS` records
    Returns (n, m, W)
    """
    bins, m, _ = record.roots.shape
    draws = np.empty((RECORDS, bins, m, 2), dtype=np.float32)
    for l in range(RECORDS):
        seed = np.random.SeedSequence(entropy, spawn_key=(condition, first + l))
        np.random.Generator(np.random.PCG64(seed)).standard_normal(dtype=np.float32, out=draws[l])
    return series_from(record, draws)


def series_from(record: Record, draws: Single) -> Single:
    """A row of records of given draws.

    draws (W, j, m, 2): real and imaginary parts of z, of variance 1 each
    Returns (n, m, W)
    """
    bins, m, _ = record.roots.shape
    # the roots' own numbers as pairs, so that compiled loops run over plain numbers
    pairs = record.roots.view(np.float32).reshape(bins, m, m, 2)
    spectrum = np.zeros((record.samples // 2 + 1, m, RECORDS), dtype=np.complex64)
    _fill(pairs, draws, 0.5 * record.samples, spectrum.view(np.float32).reshape(-1, m, RECORDS, 2))
    flat = irfft(spectrum.reshape(-1, m * RECORDS), record.samples, axis=0, overwrite_x=True, workers=1)
    return np.asarray(flat).reshape(record.samples, m, RECORDS)


@kernel
def _fill(roots, draws, scale, spectrum):
    """Write N/2 C_j z_j (N Re C_0 z_0) into the spectra (j, m, W, 2)."""
    m, width = roots.shape[1], draws.shape[0]
    z = np.empty((m, 2, width), np.float32)
    total = np.empty((2, width), np.float32)
    for j in range(roots.shape[0]):
        for k in range(m):
            for l in range(width):
                z[k, 0, l], z[k, 1, l] = draws[l, j, k, 0], draws[l, j, k, 1]
        for c in range(m):
            _row(roots[j, c], z, total)
            for l in range(width):
                spectrum[j, c, l, 0] = np.float32(scale if j > 0 else 2.0 * scale) * total[0, l]
                spectrum[j, c, l, 1] = np.float32(scale) * total[1, l] if j > 0 else np.float32(0.0)


@batch_kernel
def _row(root, z, total):
    """Sums (2, W) of one row of a root (m, 2) times all draws (m, 2, W)."""
    for l in range(total.shape[1]):
        total[0, l], total[1, l] = 0.0, 0.0
    for k in range(z.shape[0]):
        re, im = root[k, 0], root[k, 1]
        for l in range(total.shape[1]):
            total[0, l] += re * z[k, 0, l] - im * z[k, 1, l]
            total[1, l] += re * z[k, 1, l] + im * z[k, 0, l]
