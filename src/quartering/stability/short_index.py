"""The paper's short index: K2 from I1, I2, I3 and the amplitudes of sway, roll and yaw.

``K2 = n2 w^2/2 (I1 P1^2 + I2 P2^2 + I3 P3^2) + n2 sum_j rho_j e_2j``. Where the water moves, drag feels the ship's velocity
through it: P1 and P3 are then the amplitudes of ``(v - w0)/w`` and ``(r - w1)/w``, in place of those over ground. Drag by
strips has no cubics; those matched at the motion stand for it (`motion.matched`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from quartering.hydro.manoeuvring.crossflow import ENERGY_CUBE
from quartering.motion.equations.program import PLAIN
from quartering.motion.equations.system import Floats, System
from quartering.motion.equations.water import SWAY, YAW
from quartering.motion.matched import energy_velocity
from quartering.motion.steady.derivative import of_states

Complex = NDArray[np.complex128]


def roll_cubic(system: System, factors: str) -> Floats:
    """Coefficient (n,) of one velocity cubic in the canonical roll equation.

    factors: such as "ppp" or "prr"
    Returns (n,): zero when the system has no such term

    Source: [H71] eq. (3).

    >>> from quartering.motion.equations.system import Model
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


def short_index(system: System, displacement: Complex, n2: Floats, roll_axis: Floats | None, *, moving: bool) -> Floats:
    """What the amplitudes of sway, roll and yaw add to K2 in the paper's form [1/s2].

    system: n conditions
    displacement (n, 3): fundamental of sway [m], roll, yaw: phasors of e^{i w t}
    n2 (n,): [rad/s]
    roll_axis (n,): rho_1 [m/rad]; None for the paper's 0.3 and 0.1
    moving: with amplitudes through the water, in place of those over ground
    Returns (n, 3): n2 w^2/2 times I1 P1^2, I2 P2^2 and I3 P3^2; K2 is their sum and n2 sum_j rho_j e_2j

    Source: [H71] eq. (13).
    """
    of_drag = _cubics_of_strips(system, displacement)
    c = {name: roll_cubic(system, name) + of_drag.get(name, 0.0) for name in ("vvv", "pvv", "vpp", "ppp", "vrr", "prr")}
    three, one = (3 * roll_axis, roll_axis) if roll_axis is not None else (0.3, 0.1)
    i1 = three * c["vvv"] + c["pvv"]
    i2 = one * c["vpp"] + 3 * c["ppp"]
    i3 = one * c["vrr"] + c["prr"]
    amplitude = np.abs(through_water(system, displacement) if moving else displacement)
    strength = 0.5 * n2 * system.frequency**2
    return np.asarray(strength[:, None] * np.stack([i1, i2, i3], axis=1) * amplitude**2)


def _cubics_of_strips(system: System, displacement: Complex) -> dict[str, Floats]:
    """Cubics (n,) of the roll equation that lose the energy of |q| q at the motion: kappa sum c (e of roll) e^3/u0."""
    if not system.has_drag:
        return {}
    root = system.strips[:, :, 0]  # c^(1/3), which stands before 1, -h, x and the water
    known = np.where(root > 0, root, 1.0)
    ones, levers, places = np.moveaxis(system.strips[:, :, :3], 2, 0) / known
    scale = energy_velocity(system, displacement)
    per_scale = np.where(scale > 0, 1.0 / np.where(scale > 0, scale, 1.0), 0.0)
    push = system.push[:, 1, 0, None] + system.push[:, 1, 1, None] * levers + system.push[:, 1, 2, None] * places
    strength = ENERGY_CUBE * per_scale[:, None] * root**3 * push
    products = {
        "vvv": ones,
        "pvv": 3 * levers,
        "vpp": 3 * levers**2,
        "ppp": levers**3,
        "vrr": 3 * places**2,
        "prr": 3 * levers * places**2,
    }
    return {name: (strength * product).sum(axis=1) for name, product in products.items()}
