"""Moving water: cubic terms on the relative velocity, and strip-wise cross-flow drag."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import InputError
from quartering.motion.equations.terms import TermTable

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

SWAY, YAW = 0, 3
"""States whose velocity through the water differs from that over ground."""
_ROLL = 1


@dataclass(frozen=True, eq=False)
class Strips:
    """Cross-flow drag of a hull cut across: ``f = -c |q| q`` on each strip, ``q = v + x r - h p - w``.

    Parameters
    ----------
    x : (z,) float         of each strip, forward of G [m]
    lever : (z,) float     h, depth below G of the point the drag acts at [m]
    c : (z,) float         (1/2) rho C_D T dx, 0 or above [kg/m]
    water : (n, z) complex, or (z,)    phasors of e^{i w t} of the water's velocity across the ship at each strip [m/s], w being
                           the encounter frequency above zero: where the ship overtakes the wave, the conjugates

    Raises
    ------
    InputError             shapes that do not fit together, numbers that are not finite, a c below zero

    Examples
    --------
    >>> still = Strips(x=[-10.0, 10.0], lever=[2.0, 2.0], c=[5.0, 5.0], water=[0.0, 0.0])
    >>> still.array.shape  # one condition, two strips
    (1, 2, 5)
    """

    x: Floats
    lever: Floats
    c: Floats
    water: Complex

    def __init__(self, x: ArrayLike, lever: ArrayLike, c: ArrayLike, water: ArrayLike) -> None:
        places, levers, sizes = (np.array(part, dtype=float) for part in (x, lever, c))
        velocity = np.atleast_2d(np.array(water, dtype=complex))
        shapes = {places.shape, levers.shape, sizes.shape, velocity.shape[1:]}
        if places.ndim != 1 or len(shapes) != 1 or velocity.ndim != 2:
            raise InputError(
                f"strips: x {places.shape}, lever {levers.shape}, c {sizes.shape} and water {velocity.shape} do not fit"
                " together; give a number of each for every strip"
            )
        if not all(np.isfinite(part).all() for part in (places, levers, sizes)) or not np.isfinite(velocity).all():
            raise InputError("strips: x, lever, c and water must be finite numbers")
        if (sizes < 0).any():
            raise InputError(f"strips: c = {sizes.min():g} kg/m; drag does not push with the flow: give 0 or above")
        for name, value in (("x", places), ("lever", levers), ("c", sizes), ("water", velocity)):
            value.flags.writeable = False
            object.__setattr__(self, name, value)

    def __repr__(self) -> str:
        return (
            f"Strips({self.x.size} strips from {self.x.min():.4g} to {self.x.max():.4g} m)"
            if self.x.size
            else "Strips()"
        )

    @property
    def array(self) -> Floats:
        """As the right-hand side takes them (n, z, 5): c^(1/3) times 1, -h, x, and times the water's cos and sin parts."""
        form = np.stack([np.ones_like(self.x), -self.lever, self.x], axis=1)
        out = np.empty((*self.water.shape, 5))
        out[..., :3], out[..., 3], out[..., 4] = form, self.water.real, -self.water.imag
        return np.asarray(out * np.cbrt(self.c)[:, None])


def relative_terms(table: TermTable) -> tuple[TermTable, NDArray[np.int64]]:
    """The terms with their velocity products on ``v - w0, p, r - w1``.

    table: products of v, phi, p, r
    Returns table: with two columns of powers more, of v - w0 and r - w1; products that contain phi, and those of p
        alone, stay as they are; extra (2,): states to which the known inputs -w0 and -w1 are added

    Linear terms stay on the velocity over ground: what the water does through lift and added mass stands in the wave force.

    >>> from quartering.motion.equations.terms import term_table
    >>> relative_terms(term_table({"K_vvr": 1.0, "K_ppp": 1.0}))[0].powers.tolist()
    [[0, 0, 0, 0, 2, 1], [0, 0, 3, 0, 0, 0]]
    """
    powers = np.pad(table.powers, ((0, 0), (0, 2)))
    modulus = table.modulus.copy()
    moved = (powers[:, _ROLL] == 0) & (modulus != _ROLL + 1)
    for state, column in ((SWAY, 4), (YAW, 5)):
        powers[moved, column] = powers[moved, state]
        powers[moved, state] = 0
        modulus[moved & (modulus == state + 1)] = column + 1
    return TermTable(table.linear, powers, modulus, table.coefficients), np.array([SWAY, YAW], dtype=np.int64)


def relative_inputs(w0: ArrayLike, w1: ArrayLike) -> Floats:
    """Known inputs -w0 and -w1 as Fourier series.

    w0, w1 (n,): phasors of e^{i w t}: velocity of the water across the ship at G [m/s], its slope along it [1/s]
    Returns (n, 2, 3): mean, cos and sin parts

    >>> relative_inputs(1 + 2j, 0)[0, 0].tolist()
    [0.0, -1.0, 2.0]
    """
    phasors = np.stack(np.broadcast_arrays(np.atleast_1d(w0), np.atleast_1d(w1)), axis=1).astype(complex)
    if not np.isfinite(phasors).all():
        raise InputError("water: w0 and w1 must be finite complex numbers")
    return np.stack([np.zeros(phasors.shape), -phasors.real, phasors.imag], axis=2)
