"""The paper's modified Struble method: one harmonic in balance, the third (and any second) as a linear correction."""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import kernel
from quartering._machine.threads import in_threads
from quartering.motion.equations.rates import WIDTH, gather, row_of_lanes
from quartering.motion.equations.steering import feedback, turning
from quartering.motion.equations.system import FEWEST, Floats, System, kernel_arguments
from quartering.motion.steady.harmonic import harmonic_balance
from quartering.motion.steady.newton import balance_batch, gather_motions, linear_response, room_for_balance


@kernel
def _add_linear_harmonics(first, last, program, parts, tables, fundamental, answer, u):
    """Fill the columns of ``u`` (n, 3, b) beyond those of ``fundamental`` with their linear response to its products.

    ``answer`` (n, 3, b) is the autopilot's to each harmonic of yaw.
    """
    factors = tables[2]
    nb, known = factors.size, fundamental.shape[2]
    lanes = row_of_lanes(parts, WIDTH)
    room = room_for_balance(program, lanes, tables)
    row, residual = np.zeros((3, nb, WIDTH)), np.zeros((3 * nb, WIDTH))
    for begin in range(first, last, WIDTH):
        gather(begin, last, parts, lanes)
        gather_motions(begin, last, fundamental, row[:, :known])
        balance_batch(program, tables, lanes, row, residual, room)
        for l in range(min(WIDTH, last - begin)):
            i = begin + l
            for b in range(known, nb, 2):
                x = 1j * residual[b + 1, l] - residual[b, l]
                y = 1j * residual[nb + b + 1, l] - residual[nb + b, l]
                z = 1j * residual[2 * nb + b + 1, l] - residual[2 * nb + b, l]
                steering = (answer[i, 0, b], answer[i, 1, b], answer[i, 2, b])
                sway, roll, yaw = linear_response(lanes.linear, l, factors[b] * lanes.frequency[l], x, y, z, steering)
                u[i, 0, b], u[i, 0, b + 1] = sway.real, -sway.imag
                u[i, 1, b], u[i, 1, b + 1] = roll.real, -roll.imag
                u[i, 2, b], u[i, 2, b + 1] = yaw.real, -yaw.imag


def modified_struble(
    system: System, *, from_rest: bool = False, start: Floats | None = None, with_residual: bool = True
) -> tuple[Floats, tuple[int, ...], NDArray[np.int8], Floats]:
    """Periodic motions of a batch of conditions by the paper's method.

    system: n conditions
    from_rest: which motion where several exist, as in `harmonic_balance`
    start (n, 3, b): start of Newton's method for the fundamental, as in `harmonic_balance`
    with_residual: as there
    Returns u (n, 3, b): coefficients as from `harmonic_balance`, third harmonic included; orders: (1, 3); (0, 1, 2, 3)
        when a steady force or an even term breaks the symmetry; status (n,): `Status` of the fundamental; residual
        (n,): imbalance of the fundamental relative to the excitation

    The six equations (A-11) for the fundamental are one-harmonic balance; (A-8) is one linear solve for the third harmonic,
    which does not act back on the fundamental: its error is of second order in the nonlinearity.
    Source: [H71] eqs. (A-3)-(A-11), [Struble62].
    """
    low, orders = ((1,), (1, 3)) if system.symmetric else ((0, 1), (0, 1, 2, 3))
    fundamental, status, residual = harmonic_balance(
        system, low, start, from_rest=from_rest, with_residual=with_residual
    )
    table = system.basis(orders, fewest=FEWEST)
    u = np.zeros((system.count, 3, table.factors.size))
    u[:, :, : fundamental.shape[2]] = fundamental
    # A rudder is linear: it takes no part in what the fundamental's products leave, only in the response to it.
    moving = np.ascontiguousarray(turning(system.linear, fundamental, low))
    answer = np.stack([feedback(system.linear, h * system.frequency) for h in table.factors], axis=2)
    in_threads(_add_linear_harmonics, system.count, *kernel_arguments(system, table), moving, answer, u)
    return u, orders, status, residual
