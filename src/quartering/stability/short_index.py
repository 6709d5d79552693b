"""The paper's short index: K2 from I1, I2, I3 and the amplitudes of sway, roll and yaw.

``K2 = n2 w^2/2 (I1 P1^2 + I2 P2^2 + I3 P3^2) + n2 sum_j rho_j e_2j``. Where the water moves, drag feels the ship's velocity
through it: P1 and P3 are then the amplitudes of ``(v - w0)/w`` and ``(r - w1)/w``, in place of those over ground. Drag by
strips has no cubics; those matched at the motion stand for it (`motion.matched`).
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import summing
from quartering._machine.threads import in_threads
from quartering.hydro.manoeuvring.crossflow import ENERGY_CUBE
from quartering.motion.equations.program import PLAIN
from quartering.motion.equations.system import Floats, System
from quartering.motion.equations.water import SWAY, YAW
from quartering.motion.matched import energy_velocity
from quartering.motion.steady.derivative import of_states

Complex = NDArray[np.complex128]

CUBICS: Final = ("vvv", "pvv", "vpp", "ppp", "vrr", "prr")
"""Velocity cubics of the roll equation that the paper's I1, I2, I3 are made of."""


def roll_cubic(system: System, factors: str) -> Floats:
    """Coefficient (n,) of one velocity cubic in the canonical roll equation.

    factors: such as "ppp" or "prr"
    Returns (n,): zero when the system has no such term

    Source: [H71] eq. (3).

    >>> from quartering.motion.equations.model import Model
    >>> terms = {"Y_v": -1.0, "K_phi": -1.0, "K_prr": 0.3, "N_r": -1.0}
    >>> roll_cubic(Model(np.eye(3), terms, 1.0, (0, 0, 0), (0, 0, 0)).system, "prr").tolist()
    [0.3]
    """
    powers = [factors.count("v"), 0, factors.count("p"), factors.count("r")]
    alone = system.powers[:, PLAIN:][:, system.extra < 0].any(axis=1)
    own = system.powers @ of_states(system).astype(np.int64)  # v - w0 counts as v
    column = (own == powers).all(axis=1) & ~alone & (system.modulus == 0)
    return np.asarray(system.coefficients[:, 1, column].sum(axis=1))


def through_water(system: System, displacement: Complex) -> Complex:
    """Phasors (n, 3) of sway, roll, yaw relative to the water, from those over ground."""
    relative = np.array(displacement)
    w = np.where(system.finite, system.frequency, np.nan)
    for state, mode in ((SWAY, 0), (YAW, 2)):
        for one in np.flatnonzero(system.extra == state):
            inputs = system.inputs[:, one]  # -w0 or -w1
            relative[:, mode] += (-inputs[:, 2] - 1j * inputs[:, 1]) * (1 / w)  # over i w; NaN where nothing moves
    return relative


def roll_cubics(system: System, displacement: Complex) -> Floats:
    """Coefficients (n, 6) of vvv, pvv, vpp, ppp, vrr and prr in the roll equation, drag by strips among them.

    displacement (n, 3): fundamental of sway [m], roll, yaw, at which the strips' cubics lose the energy of |q| q
    """
    cubics = np.zeros((system.count, len(CUBICS)))
    if len(system.powers):
        cubics[:] = np.stack([roll_cubic(system, name) for name in CUBICS], axis=1)
    if system.has_drag:
        strips, push = (np.require(a, requirements=("C", "W")) for a in (system.strips, system.push))
        in_threads(_add_cubics_of_strips, system.count, strips, push, energy_velocity(system, displacement), cubics)
    return cubics


@summing
def _add_cubics_of_strips(first, last, strips, push, scale, cubics):
    """Add kappa sum c (e of roll) e^3/u0 over the strips (n, z, 5), e their (1, -h, x), u0 = ``scale``, to ``cubics``."""
    for i in range(first, last):
        if not scale[i] > 0.0:
            continue
        y, k, n = push[i, 1]
        vvv, pvv, vpp, ppp, vrr, prr = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for z in range(strips.shape[1]):
            root, lever, place = strips[i, z, 0], strips[i, z, 1], strips[i, z, 2]  # (1, -h, x) times c^(1/3)
            if root <= 0.0:
                continue
            share = y + (k * lever + n * place) / root
            vvv += share * root * root * root
            pvv += share * root * root * lever
            vpp += share * root * lever * lever
            ppp += share * lever * lever * lever
            vrr += share * root * place * place
            prr += share * lever * place * place
        strength = ENERGY_CUBE / scale[i]
        cubics[i, 0] += strength * vvv
        cubics[i, 1] += 3.0 * strength * pvv
        cubics[i, 2] += 3.0 * strength * vpp
        cubics[i, 3] += strength * ppp
        cubics[i, 4] += 3.0 * strength * vrr
        cubics[i, 5] += 3.0 * strength * prr


def short_index(cubics: Floats, amplitude: Floats, frequency: Floats, n2: Floats, roll_axis: Floats | None) -> Floats:
    """What the amplitudes of sway, roll and yaw add to K2 in the paper's form [1/s2].

    cubics (n, 6): from `roll_cubics`
    amplitude (n, 3): of sway [m], roll, yaw [rad], over ground or through the water
    frequency, n2 (n,): [rad/s]
    roll_axis (n,): rho_1 [m/rad]; None for the paper's 0.3 and 0.1
    Returns (n, 3): n2 w^2/2 times I1 P1^2, I2 P2^2 and I3 P3^2; K2 is their sum and n2 sum_j rho_j e_2j

    Source: [H71] eq. (13).
    """
    vvv, pvv, vpp, ppp, vrr, prr = cubics.T
    three, one = (3 * roll_axis, roll_axis) if roll_axis is not None else (0.3, 0.1)
    indices = np.stack([three * vvv + pvv, one * vpp + 3 * ppp, one * vrr + prr], axis=1)
    return np.asarray((0.5 * n2 * frequency**2)[:, None] * indices * amplitude**2)
