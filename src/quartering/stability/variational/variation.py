"""The equations of first variation about a periodic motion: their matrix along the motion and its harmonics."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import batch_kernel, kernel
from quartering._machine.threads import in_threads
from quartering.motion.equations.basis import Basis
from quartering.motion.equations.rates import WIDTH, gather, room_for, row_of_lanes, slopes
from quartering.motion.equations.steering import turning
from quartering.motion.equations.system import Floats, System, kernel_arguments
from quartering.motion.steady.newton import at_sample, gather_motions, project

EVEN_HARMONICS = (0, 2, 4, 6)
"""Harmonics of the variational matrix that first-order theory uses."""


FEWEST_ALONG: Final = 96
"""Samples of a cycle with drag |q| q, whose variation 2 |q| has kinks: 96 misjudge its mean by up to 2/96^2 of itself, 2e-4."""

PER_HARMONIC_OF_TABLE: Final = 64
"""Further samples a cycle for each harmonic of the motion where the curvature of the restoring moment jumps."""


@batch_kernel
def matrices_along(program, tables, motion, lanes, columns, strips, jacobian):
    """d(acceleration)/d(state) (n, k, s, W) at all samples of the motions (3, b, W)."""
    waves = tables[4]
    for n in range(jacobian.shape[0]):
        at_sample(program, tables, n, motion, lanes, columns)
        slopes(program, lanes, waves[1, n], waves[2, n], columns, strips, jacobian[n])


@kernel
def _harmonics(first, last, program, parts, tables, u, functions, out, along):
    """d(acceleration)/d(state) along each motion (n, samples, 3, 4), and its projections (m, samples) in out (n, m, 3, 4)."""
    nb, wanted = tables[0].shape[0], functions.shape[0]
    lanes = row_of_lanes(parts, WIDTH)
    columns, _, one, strips = room_for(program, lanes)  # with an autopilot there are more states than the four wanted
    samples = tables[0].shape[1]
    jacobian, sums = np.empty((samples, *one.shape)), np.empty((3, 4, wanted, WIDTH))
    motion = np.empty((3, nb, WIDTH))
    for begin in range(first, last, WIDTH):
        gather(begin, last, parts, lanes)
        gather_motions(begin, last, u, motion)
        count = min(WIDTH, last - begin)
        matrices_along(program, tables, motion, lanes, columns, strips, jacobian)
        project(jacobian, functions, sums)
        for l in range(count):
            for n in range(samples):
                for k in range(3):
                    for s in range(4):
                        along[begin + l, n, k, s] = jacobian[n, k, s, l]
            for m in range(out.shape[1]):
                for k in range(3):
                    for s in range(4):
                        out[begin + l, m, k, s] = sums[k, s, m, l]


def variational_harmonics(
    system: System, u: Floats, orders: tuple[int, ...], harmonics: tuple[int, ...] = EVEN_HARMONICS
) -> NDArray[np.complex128]:
    """Harmonics of the variational matrix along periodic motions.

    system: n conditions
    u (n, 3, b): motions, as from `harmonic_balance`
    orders: their harmonics
    harmonics (m,): wanted, 0 first; even ones where all of `orders` are odd (the others vanish)
    Returns (n, m, 3, 4): phasors J_m of d(v', p', r')/d(v, phi, p, r): J(t) = J_0 + Re sum_m J_m e^{i m w t}

    Exact for polynomial terms by the number of samples.  Source: [H71] eqs. (8)-(10), first-order form.
    """
    return variation_along(system, u, orders, harmonics)[0]


def variation_along(
    system: System, u: Floats, orders: tuple[int, ...], harmonics: tuple[int, ...] = EVEN_HARMONICS
) -> tuple[NDArray[np.complex128], Floats]:
    """Harmonics of the variational matrix along periodic motions, and the matrix itself at equal intervals.

    as in `variational_harmonics`

    Returns harmonics (n, m, 3, 4): as from `variational_harmonics`; along (n, s, 3, 4): at s equal intervals from phase
        0, over half a cycle where all orders are odd

    Source: [H71] eq. (8).

    >>> from quartering.motion.equations.model import Model
    >>> terms = {"Y_v": -1.0, "K_phi": -1.0, "K_p": -0.1, "N_r": -1.0}
    >>> system = Model(np.eye(3), terms, 1.0, (0, 0.01, 0), (0, 0, 0)).system
    >>> variation_along(system, np.zeros((1, 3, 2)), (1,))[1][0, 0, 1].tolist()
    [0.0, -1.0, -0.1, 0.0]
    """
    u = turning(system.linear, u, orders)
    table, functions = sampled(system, orders, harmonics)
    samples = table.values.shape[1]
    out = np.empty((system.count, 2 * len(harmonics) - 1, 3, 4))
    along = np.empty((system.count, samples, 3, 4))
    in_threads(
        _harmonics,
        system.count,
        *kernel_arguments(system, table),
        np.require(u, requirements=("C", "W")),
        functions,
        out,
        along,
        smallest=WIDTH,
    )
    phasors = np.empty((system.count, len(harmonics), 3, 4), dtype=complex)
    phasors[:, 0] = out[:, 0]
    phasors[:, 1:] = out[:, 1::2] - 1j * out[:, 2::2]
    return phasors, along


def sampled(system: System, orders: tuple[int, ...], harmonics: tuple[int, ...]) -> tuple[Basis, Floats]:
    """Samples of a motion for its variational matrix, and the functions (m, samples) at them that project on its harmonics.

    The functions are as many as make a multiple of four, the last ones nil.
    """
    # The matrix has degree one less than the equations; a margin of harmonics keeps the last one free of aliases.
    extra = (
        2 * max(harmonics) + 2 + (PER_HARMONIC_OF_TABLE * max(orders) if system.has_table and system.has_drag else 0)
    )
    table = system.basis(orders, lower=2, extra=extra, fewest=FEWEST_ALONG)
    samples = table.values.shape[1]
    half_cycle = all(h % 2 == 1 for h in orders)
    phases = (np.pi if half_cycle else 2 * np.pi) * np.arange(samples) / samples
    rows = [np.full(samples, 1.0 / samples)]
    for m in harmonics[1:]:
        rows += [2.0 / samples * np.cos(m * phases), 2.0 / samples * np.sin(m * phases)]
    return table, np.array(rows + [np.zeros(samples)] * (-len(rows) % 4))
