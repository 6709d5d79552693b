"""Memory of the radiated waves: frequency-dependent inertia and damping as further states of the equations in time."""

# In a cell of encounter frequency w the motion feels i w M(w) - B(w) on its velocities. Fitted by d + s h + sum of fractions,
# h is the inertia and -d the linear forces of equations whose further states x' = A x + b V carry the fractions: one set of
# states for each of sway, roll and yaw. Any source of coefficients serves, as only their values in the cells are asked.

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering.motion.sea.equations import SeaEquations
from quartering.motion.sea.rational import RationalFit, change_with_frequency, rational_fit

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

ORDERS: Final = (4, 6, 8, 10)
_POINTS, _BEYOND, _LITTLE = 80, 12, 0.03
_TOP: Final = 2.5
_NEAR = (0.6, 1.7)
_VELOCITIES: Final = [0, 2, 3]
MISFIT: Final = 0.03
"""Root mean square misfit of an entry, as a share of how it changes with frequency, that a fit may have [1]."""
PASSIVE: Final = -0.02
"""Least damping of the fractions, as a share of their largest, that counts as passive [1]."""


@dataclass(frozen=True, eq=False)
class Memory:
    """A fit of what a ship's motion feels at every frequency.

    Parameters
    ----------
    fit : RationalFit     of i w M - B over v, p, r, as forces
    misfit : float        largest of the entries, see `MISFIT`
    passive : bool        do the fractions take energy at every frequency?
    sound : bool          is the inertia at infinite frequency near that at the highest sampled? Else a march may run away
                          by what the fit does beyond the samples
    """

    fit: RationalFit
    misfit: float
    passive: bool
    sound: bool

    @property
    def inertia(self) -> Floats:
        """Inertia (3, 3) at infinite frequency, of the fit."""
        return self.fit.slope

    def linear(self, at: Floats) -> Floats:
        """Linear forces (3, 4) by v, phi, p, r without memory; the column of phi is that of ``at``."""
        out = at.copy()
        out[:, _VELOCITIES] = -self.fit.constant
        return out

    def in_cells(self, equations: SeaEquations) -> SeaEquations:
        """The equations over cells with the fit in place of the coefficients."""
        z = self.fit.value(equations.frequency)
        linear = np.repeat(equations.at_roll[1][None], len(z), axis=0)
        linear[:, :, _VELOCITIES] = -z.real
        inertia = np.ascontiguousarray(z.imag / equations.frequency[:, None, None])
        return replace(equations, inertia=inertia, linear=np.ascontiguousarray(linear))

    def states(self) -> tuple[Floats, Floats, Floats]:
        """Rates (m, m), drive by v, p, r (m, 3) and forces (3, m) of all further states, input by input."""
        fit = self.fit
        n = fit.drive.size
        rates, drive, force = np.zeros((3 * n, 3 * n)), np.zeros((3 * n, 3)), np.zeros((3, 3 * n))
        for j in range(3):
            own = slice(j * n, (j + 1) * n)
            rates[own, own], drive[own, j] = fit.dynamics, fit.drive
            force[:, own] = -fit.output[:, :, j].T
        return rates, drive, force


def eigenvalues(memory: Memory, linear: Floats) -> Complex:
    """Eigenvalues of the linear motion with its further states [1/s].

    linear (3, 4): linear forces by v, phi, p, r at the frequency of free roll

    The fractions act back on the motion: together they may be three times as fast as the poles of the fit, and a step of time
    has to be short enough for that. A real part above 0 is that of the course: sway and yaw in slow motion make no waves, whose
    damping keeps them where coefficients are those of free roll.
    """
    rates, drive, force = memory.states()
    inverse = np.linalg.inv(memory.inertia)
    whole = np.zeros((4 + len(rates), 4 + len(rates)))
    whole[_VELOCITIES, :4] = inverse @ memory.linear(linear)
    whole[_VELOCITIES, 4:] = inverse @ force
    whole[1, 2] = 1.0
    whole[4:, _VELOCITIES] = drive
    whole[4:, 4:] = rates
    return np.asarray(np.linalg.eigvals(whole), dtype=complex)


def memory_of(equations: SeaEquations, energy: Floats) -> Memory | None:
    """The fit of least order that is near enough, stable and passive; None where nothing changes with frequency.

    energy (c,): of the sea, which tells the frequencies that count [m2]

    With the speed terms of strip theory the fractions neither vanish at frequency 0 nor are passive: where a fit that vanishes
    is not near enough, one that does not is taken, and said not to be passive.
    """
    if len(equations.linear) == 1:
        return None
    frequency, response = _samples(equations, energy)
    scale = np.sqrt(np.abs(np.diagonal(equations.at_roll[0])))
    scaled = response / np.multiply.outer(scale, scale)
    found: list[Memory] = []
    for vanishing in (True, False):
        for order in ORDERS:
            one = _judged(frequency, scaled, order, vanishing, scale, equations.roll_frequency)
            if one.sound and one.misfit < MISFIT and (one.passive or not vanishing):
                return one
            found.append(one)
    return min((one for one in found if one.sound), key=lambda one: one.misfit, default=None)


def _samples(equations: SeaEquations, energy: Floats) -> tuple[Floats, Complex]:
    """Frequencies (f,) across those that hold all but 1e-4 of the energy, and i w M - B at them (f, 3, 3).

    Beyond 2.5 times that of roll inertia rules the motion, and a fit that serves both serves neither: a few samples there, of
    little weight, hold the inertia at infinite frequency in place.
    """
    order = np.argsort(equations.frequency)
    w = equations.frequency[order]
    share = np.cumsum(energy[order]) / energy.sum()
    high = w[min(int(np.searchsorted(share, 1.0 - 1e-4)), w.size - 1)]
    low = max(w[0], 0.02 * high)
    top = max(min(high, _TOP * equations.roll_frequency), 2.0 * equations.roll_frequency)
    wanted = np.append(np.geomspace(low, top, _POINTS), np.geomspace(top, max(w[-1], top), _BEYOND))
    at = order[np.unique(np.searchsorted(w, wanted).clip(0, w.size - 1))]
    frequency, first = np.unique(equations.frequency[at], return_index=True)
    at = at[first]
    iw = 1j * frequency[:, None, None]
    return frequency, iw * equations.inertia[at] - equations.linear[at][:, :, _VELOCITIES]


def _judged(
    frequency: Floats, scaled: Complex, order: int, vanishing: bool, scale: Floats, roll_frequency: float
) -> Memory:
    """A fit, the frequencies above that of roll counting less: there the motion is ruled by inertia."""
    top = max(_TOP * roll_frequency, float(frequency[0]))
    weight = np.where(frequency <= top, np.minimum(1.0, 1.5 * roll_frequency / frequency), _LITTLE)
    fit = rational_fit(frequency, scaled, order, vanishing=vanishing, weight=weight)
    wrong = weight[:, None, None] * np.abs(fit.value(frequency) - scaled)
    wrong = wrong[frequency <= top]
    misfit = float(
        (
            np.sqrt(np.mean(wrong**2, axis=0))
            / change_with_frequency(frequency[frequency <= top], scaled[frequency <= top])
        ).max()
    )
    wide = np.concatenate([np.zeros(1), np.geomspace(0.05, 20.0, 200) * frequency.max()])
    passive = bool(fit.least_damping(wide) > PASSIVE)
    by = np.multiply.outer(scale, scale)
    whole = RationalFit(fit.constant * by, fit.slope * by, fit.dynamics, fit.drive, fit.output * by)
    last = scaled[-1].imag / frequency[-1]
    ratio = np.linalg.eigvals(np.linalg.solve(last, fit.slope))
    sound = bool((ratio.real > _NEAR[0]).all() and (ratio.real < _NEAR[1]).all())
    return Memory(whole, misfit, passive, sound)
