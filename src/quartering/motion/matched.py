"""Cubic cross-flow drag whose reference velocity is matched at the motion.

The cubic ``-c kappa q^3/u0`` of a strip, kappa = 32/(9 pi), loses in a cycle of amplitude q the energy of ``-c |q| q`` when
u0 = q. One u0 for hull and cycle loses that of all strips together, sum c (4/3 pi) q^3 = (kappa/u0) sum c (3/8) q^4, when

    u0 = sum c q^4 / sum c q^3 ,    q = |v + x r - h p - w| of each strip at the motion.

The motion is that of |q| q itself, by its fundamental. About it a strip matched at its own velocity would damp a disturbance by
(16/3 pi) q where the law has (4/pi) q, 4/3 of it; with one u0 for the hull, and the water as the line w0 + w1 x, less or more.
"""

# mypy: disable-error-code="no-untyped-def, no-untyped-call"
from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from quartering._machine.compiled import summing
from quartering._machine.threads import in_threads
from quartering.motion.equations.batch import rows
from quartering.motion.equations.system import Floats, System
from quartering.motion.steady.harmonic import harmonic_balance


@dataclass(frozen=True, eq=False)
class Matching:
    """What of a ship's equations is cubic drag, and the law it stands for, per metre of wave amplitude.

    Parameters
    ----------
    cubics : System     with the cubic drag alone among its products
    strips : System     with the law alone: its strips and their push
    scale : float       reference velocity u0 that the cubics were made with [m/s]
    terms : mapping     the cubics by name [SI]
    """

    cubics: System
    strips: System
    scale: float
    terms: Mapping[str, float] = field(default_factory=dict)

    def part(self, which: slice) -> Matching:
        """The match of some of the conditions."""
        return replace(self, cubics=rows(self.cubics, which), strips=rows(self.strips, which))

    def at_motion(self, system: System, amplitude: Floats) -> System:
        """Equations with u0 matched at the motion that |q| q gives.

        system: m h conditions, the h heights of one of the m conditions beside each other
        amplitude (m h,): of the wave [m]
        Returns where no motion is found, with u0 as it was
        """
        found, share = self.velocity(system, amplitude), self._share(system)
        more = np.where(found > 0, self.scale / np.where(found > 0, found, 1.0) - 1.0, 0.0)
        return replace(system, coefficients=system.coefficients + share * more[:, None, None])

    def added(self, system: System, amplitude: float) -> dict[str, float]:
        """What the match adds to each of the terms of one condition, per metre of wave amplitude, in one wave."""
        height = np.array([amplitude])
        found = float(self.velocity(system.raised(height), height)[0])
        more = self.scale / found - 1.0 if found > 0 else 0.0
        return {name: more * value for name, value in self.terms.items()}

    def velocity(self, system: System, amplitude: Floats) -> Floats:
        """The matched u0 (m h,) [m/s]; NaN where no motion is found. Parameters as of `at_motion`."""
        count = system.count // self.strips.count
        law = self.strips.each(lambda array: np.repeat(array, count, axis=0)).raised(amplitude)
        coefficients = system.coefficients - self._share(system)
        of_law = replace(system, coefficients=coefficients, strips=law.strips, push=law.push)
        return matched_velocity(of_law, harmonic_balance(of_law, (1,), from_rest=True, with_residual=False)[0])

    def _share(self, system: System) -> Floats:
        """The part of the coefficients (m h, 3, t) of a system that is cubic drag."""
        own = np.repeat(self.cubics.coefficients, system.count // self.cubics.count, axis=0)
        share = np.zeros_like(system.coefficients)
        for column, powers in enumerate(self.cubics.powers):
            alike = (system.powers == powers).all(axis=1) & (system.modulus == 0)
            share[:, :, alike] += own[:, :, [column]]
        return share


@summing
def _energies(first, last, strips, velocity, out):
    """sum c q^4/sum c q^3 (n,) over the strips (n, z, 5) at velocities (n, 3) of the fundamental; NaN where both vanish."""
    for i in range(first, last):
        cube, fourth = 0.0, 0.0
        sway, roll, yaw = velocity[i]
        for z in range(strips.shape[1]):
            root, lever, place, cos, sin = strips[i, z]  # c^(1/3), which stands before every part
            if root <= 0.0:
                continue
            real = root * sway.real + lever * roll.real + place * yaw.real - cos
            imag = root * sway.imag + lever * roll.imag + place * yaw.imag + sin
            square = real * real + imag * imag
            one = square * math.sqrt(square)  # c q^3
            cube += one
            fourth += one * math.sqrt(square) / root
        out[i] = fourth / cube if cube > 0.0 else np.nan


def energy_velocity(system: System, displacement: NDArray[np.complex128]) -> Floats:
    """Reference velocity u0 (n,) of equal energy at phasors (n, 3) of the fundamental [m/s]; NaN where none is known."""
    out = np.empty(system.count)
    velocity = 1j * system.frequency[:, None] * displacement
    in_threads(_energies, system.count, np.require(system.strips, requirements=("C", "W")), velocity, out)
    return out


def matched_velocity(system: System, u: Floats) -> Floats:
    """As `energy_velocity`, from the coefficients (n, 3, 2) of the fundamental."""
    return energy_velocity(system, u[:, :, 0] - 1j * u[:, :, 1])
