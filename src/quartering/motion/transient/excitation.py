"""Excitation of many realisations of a sum of waves: samples from one matrix product, and what lies between them.

What is sampled has no wave faster than its fastest component, so that a polynomial through eight neighbours gives all that lies
between them. It errs, of a component w at samples s apart, by at most

    (w s)^8 (1/2 3/2 5/2 7/2)^2 / 8! = (w s)^8 / 936

With a sample a step the matrix product of all components takes about as long as the steps of a ship whose equations are
products alone. Samples stand as many steps apart as leave the polynomial's error negligible beside that of the steps.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import batch_kernel
from quartering._machine.simd import every, load
from quartering.motion.equations.rates import WIDTH
from quartering.motion.equations.system import Floats

APART = (4, 2, 1)
"""Steps from one sample to the next, the first that is accurate."""

ACCURACY = 1e-6
"""Of an excitation's root mean square, which the polynomial may err by."""

_NEIGHBOURS = 8
_BEFORE = _NEIGHBOURS // 2 - 1
"""Samples before the one a step begins at or after."""

_SAMPLES = 256
"""Samples computed together, besides the neighbours."""


@batch_kernel
def excitation_at(forcing, weights, group, first, place, kind, row):
    """Excitation between sample ``first`` of its chunk and the next.

    ``forcing`` (groups of rows, samples + 7, kinds, rows, W), ``weights`` (2 apart + 1, 8); ``place`` half steps after it
    """
    if place == 0:
        return load(forcing, (group, first + _BEFORE, kind, row))
    if place == weights.shape[0] - 1:
        return load(forcing, (group, first + _BEFORE + 1, kind, row))
    total = every(0.0)
    for i in range(_NEIGHBOURS):
        total += weights[place, i] * load(forcing, (group, first + i, kind, row))
    return total


def steps_apart(frequency: Floats, amplitude: Floats, step: float) -> int:
    """Steps from one sample to the next.

    frequency (c,): of the components [rad/s]
    amplitude (kinds, c): of each excitation's components
    step: of time [s]

    >>> steps_apart(np.array([0.5]), np.array([[2.0]]), 0.2), steps_apart(np.array([3.0]), np.array([[2.0]]), 0.2)
    (4, 1)
    """
    power = np.square(amplitude)
    for apart in APART[:-1]:
        error = np.square((frequency * apart * step) ** 8 / 936)
        if (power @ error <= ACCURACY**2 * power.sum(axis=1)).all():
            return apart
    return APART[-1]


def weights_between(apart: int) -> Floats:
    """Weights (2 apart + 1, 8) of the samples around, at every half step from one sample to the next.

    >>> (2048 * weights_between(1)[1]).round(9).tolist()
    [-5.0, 49.0, -245.0, 1225.0, 1225.0, -245.0, 49.0, -5.0]
    """
    nodes = np.arange(_NEIGHBOURS) - _BEFORE
    places = np.linspace(0.0, 1.0, 2 * apart + 1)
    weights = np.ones((places.size, _NEIGHBOURS))
    for i, node in enumerate(nodes):
        others = np.delete(nodes, i)
        weights[:, i] = np.prod((places[:, None] - others) / (node - others), axis=1)
    return weights


def in_chunks(
    frequency: Floats, phasors: NDArray[np.complex128], mean: Floats, step: float, steps: int, apart: int, together: int
) -> Iterator[tuple[int, int, Floats]]:
    """Samples of every realisation, chunk by chunk of time.

    phasors (kinds, n, c): of each realisation's components
    mean (k,): what the first kinds have besides
    together: rows of W realisations that stand together
    Yields (step it begins at, its steps, (groups of rows, samples + 7, kinds, rows, W)); overwritten by the next
    """
    kinds, count, c = phasors.shape
    groups = -(-count // (WIDTH * together))
    amplitude = np.zeros((2 * c + 1, kinds, groups * together * WIDTH))
    amplitude[:c, :, :count] = phasors.real.transpose(2, 0, 1)
    amplitude[c:-1, :, :count] = -phasors.imag.transpose(2, 0, 1)
    amplitude[-1, : mean.size] = mean[:, None]
    # of a few rows at a time (groups, 2 c + 1, kinds rows W), so that what a step takes stands close together
    amplitude = amplitude.reshape(2 * c + 1, kinds, groups, -1).transpose(2, 0, 1, 3)
    amplitude = np.ascontiguousarray(amplitude).reshape(groups, 2 * c + 1, -1)
    ahead = np.exp(
        1j * np.multiply.outer((np.arange(_SAMPLES + _NEIGHBOURS - 1) - _BEFORE) * (apart * step), frequency)
    )
    waves = np.ones((len(ahead), 2 * c + 1))
    room = np.empty((groups, len(ahead), kinds * together * WIDTH))
    for begin in range(0, steps, apart * _SAMPLES):
        some = min(apart * _SAMPLES, steps - begin)
        samples = -(-some // apart) + _NEIGHBOURS - 1
        turned = ahead * np.exp(1j * (begin * step) * frequency)
        waves[:, :c], waves[:, c:-1] = turned.real, turned.imag
        forcing = np.matmul(waves, amplitude, out=room) if samples == len(waves) else waves[:samples] @ amplitude
        yield begin, some, forcing.reshape(groups, samples, kinds, together, WIDTH)
