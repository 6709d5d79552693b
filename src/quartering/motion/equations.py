"""The equations of motion: from named terms to accelerations, the acceleration coupling removed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering.conventions import InputError
from quartering.hull.autopilot import Autopilot
from quartering.hull.spline import OddSpline, odd_spline
from quartering.motion.steering import steered
from quartering.motion.terms import TermTable, checked_number, term_table, with_spline
from quartering.names import RUDDER_NAMES

Floats = NDArray[np.float64]


PER_CONDITION: Final = ("linear", "coefficients", "mean", "cos", "sin", "frequency")
"""What of a `System` has a row a condition; the products are alike in all."""


@dataclass(frozen=True, eq=False)
class System:
    """The canonical equations of n conditions: accelerations as explicit functions of the state and the time.

    ``d/dt (v, p, r) = linear (v, phi, p, r) + coefficients products + mean + cos cos(w t) + sin sin(w t)``, d phi/dt = p.
    With an autopilot the heading psi (d psi/dt = r), and with a lag the rudder angle delta, stand among the linear columns.

    Parameters
    ----------
    linear : (n, 3, 4) float          rows sway, roll, yaw; columns v, phi, p, r, and as `steered` adds them psi, delta
    coefficients : (n, 3, t) float    of the nonlinear products
    powers : (t, 4) int               powers of (v, phi, p, r) in each product
    modulus : (t,) int                1-4 for the variable between modulus bars, 0 for none
    mean, cos, sin : (n, 3) float     excitation accelerations
    frequency : (n,) float            w > 0 [rad/s]
    """

    linear: Floats
    coefficients: Floats
    powers: NDArray[np.int64]
    modulus: NDArray[np.int64]
    mean: Floats
    cos: Floats
    sin: Floats
    frequency: Floats

    @property
    def count(self) -> int:
        """Number of conditions."""
        return int(self.frequency.size)

    @property
    def states(self) -> int:
        """Number of state variables: 4, with an autopilot 5, with a rudder that lags 6."""
        return int(self.linear.shape[2])

    @property
    def plain(self) -> bool:
        """Is there nothing but (v, phi, p, r)? Then many conditions are solved abreast."""
        return self.states == 4

    @property
    def degree(self) -> int:
        """Highest degree of the polynomial products (1 when the system is linear)."""
        return int(self.powers.sum(axis=1).max(initial=1))

    @property
    def has_modulus(self) -> bool:
        """Is some product not smooth? A spline is not: its third derivative jumps."""
        return bool(self.modulus.any())

    @property
    def symmetric(self) -> bool:
        """Does reversing the state and shifting by half a period leave the equations as they are?"""
        return not self.mean.any() and bool((self.powers.sum(axis=1) % 2 == 1).all())

    @property
    def finite(self) -> NDArray[np.bool_]:
        """Conditions (n,) of which every number is finite and the frequency positive."""
        ok = np.isfinite(self.frequency) & (self.frequency > 0)
        for array in (self.linear, self.coefficients, self.mean, self.cos, self.sin):
            ok &= np.isfinite(array).reshape(self.count, -1).all(axis=1)
        return ok

    def each(self, change: Callable[[Floats], Floats]) -> System:
        """The same products, with a function applied to every array that has the conditions in front."""
        arrays: dict[str, Any] = {name: change(getattr(self, name)) for name in PER_CONDITION}
        return replace(self, **arrays)

    def kernel_arrays(self) -> tuple[NDArray[Any], ...]:
        """Arrays in the order every compiled kernel takes them.

        All are writeable and contiguous: a kernel is compiled again for arrays that are not.
        """
        own = (self.linear, self.coefficients, self.powers, self.modulus, self.mean, self.cos, self.sin, self.frequency)
        return tuple(array if array.flags.carray else np.require(array, requirements=("C", "W")) for array in own)


def canonical(
    inertia: ArrayLike,
    table: TermTable,
    frequency: ArrayLike,
    force_cos: ArrayLike,
    force_sin: ArrayLike,
    force_mean: ArrayLike = 0.0,
    linear: ArrayLike | None = None,
    rudder: ArrayLike = 0.0,
    autopilot: Autopilot | None = None,
) -> System:
    """Remove the acceleration coupling: multiply every row by the inverse inertia.

    Parameters
    ----------
    inertia : (n, 3, 3) or (3, 3) float    rigid body plus added mass [kg, kg m, kg m2]
    table : TermTable                      the terms on the right
    frequency : (n,) float                 w > 0 [rad/s]
    force_cos, force_sin, force_mean : (n, 3) or (3,) float    excitation [N, N m, N m]
    linear : (n, 3, 4) float, optional     linear terms of each condition in place of the table's
    rudder : (n, 3) or (3,) float          Y_delta, K_delta, N_delta [N, N m, N m]
    autopilot : Autopilot, optional        that moves it; without one it stays amidships

    Returns
    -------
    System

    Raises
    ------
    InputError    every inertia matrix is singular; where only some of many are, their conditions come back as NaN

    Notes
    -----
    Source: [H71] eq. (3); the restoring moment then stands in all three rows.

    Examples
    --------
    >>> system = canonical(2 * np.eye(3), term_table({"K_phi": -3.0}), [0.5], np.zeros(3), np.ones(3))
    >>> float(system.linear[0, 1, 1]), float(system.sin[0, 0])
    (-1.5, 0.5)
    """
    w = np.atleast_1d(np.asarray(frequency, dtype=float))
    masses = np.asarray(inertia, dtype=float)
    scale = np.sqrt(np.abs(np.diagonal(masses, axis1=-2, axis2=-1)))
    whole = np.where((scale > 0).all(axis=-1)[..., None], scale, np.inf)
    balanced = np.abs(np.linalg.det(masses / (whole[..., :, None] * whole[..., None, :])))
    singular = ~(balanced > 1e-12)
    if singular.all():
        raise InputError(
            "the inertia matrix (rigid body plus added mass) is singular or has a zero on its diagonal;"
            " give mass, roll and yaw inertia greater than zero"
        )
    # One condition of many without an inverse gets NaN, and with it a status of its own; the others go on.
    inverse = np.linalg.inv(np.where(singular[..., None, None], np.eye(3), masses))
    inverse = np.where(singular[..., None, None], np.nan, inverse)

    def row(force: ArrayLike) -> Floats:
        forces = np.broadcast_to(np.asarray(force, dtype=float), (w.size, 3))
        return np.ascontiguousarray(np.einsum("...ij,...j->...i", inverse, forces))

    def rows(matrix: Floats) -> Floats:
        product = inverse @ matrix
        return np.ascontiguousarray(np.broadcast_to(product, (w.size, *product.shape[-2:])))

    raw_linear = table.linear if linear is None else np.asarray(linear, dtype=float)
    accelerations = rows(raw_linear)
    return System(
        linear=accelerations if autopilot is None else steered(accelerations, row(rudder), autopilot),
        coefficients=rows(table.coefficients),
        powers=table.powers,
        modulus=table.modulus,
        mean=row(force_mean),
        cos=row(force_cos),
        sin=row(force_sin),
        frequency=w,
    )


def _triple(values: ArrayLike, name: str) -> Floats:
    array = np.array(values, dtype=float)
    if array.shape != (3,) or not np.isfinite(array).all():
        raise InputError(f"{name} needs three finite numbers (sway N, roll N m, yaw N m); given {values!r}")
    array.flags.writeable = False
    return array


@dataclass(frozen=True, eq=False, init=False)
class Model:
    """Equations of sway, roll and yaw of one ship in one regular wave, every number taken literally.

    ``inertia d/dt (v, p, r) = sum of terms + force_mean + force_cos cos(w t) + force_sin sin(w t)``.

    Parameters
    ----------
    inertia : (3, 3) float         rigid body plus added mass [kg, kg m, kg m2]
    terms : mapping                name -> coefficient [SI]; ``Y_r`` already contains ``-m U``
    frequency : float              encounter frequency w > 0 [rad/s]
    force_cos, force_sin : (3,)    wave excitation [N, N m, N m]
    force_mean : (3,)              steady excitation [N, N m, N m]
    source : mapping               where the model comes from (ship, wave, speed, heading), for the record
    autopilot : Autopilot          that moves the rudder, whose terms are "Y_delta", "K_delta", "N_delta" [N, N m]; without
                                   one the rudder stays amidships and those terms do nothing
    restoring : (angles, moments)  righting moment [N m], positive where it rights the ship, at heel angles [deg]: a spline, to
                                   which "K_phi", .. of the terms add; or the spline of the moment K itself

    Raises
    ------
    InputError    a frequency that is not positive, an unknown term, a singular inertia, a NaN

    Notes
    -----
    Source: [H71] eqs. (1)-(3).  Valid: constant speed, small yaw from the mean course, deep water.

    Examples
    --------
    >>> model = Model(inertia=np.eye(3), terms={"Y_v": -0.4, "K_phi": -1.0, "K_p": -0.05, "N_r": -0.6}, frequency=0.8,
    ...               force_cos=(0, 0.1, 0), force_sin=(0, 0, 0))
    >>> model.system.count
    1
    """

    inertia: Floats
    terms: Mapping[str, float]
    frequency: float
    force_cos: Floats
    force_sin: Floats
    force_mean: Floats
    source: Mapping[str, object]
    references: tuple[str, ...]
    autopilot: Autopilot | None
    restoring: OddSpline | None
    system: System = field(init=False, repr=False)

    def __init__(
        self,
        inertia: ArrayLike,
        terms: Mapping[str, float],
        frequency: float,
        force_cos: ArrayLike,
        force_sin: ArrayLike,
        force_mean: ArrayLike = (0.0, 0.0, 0.0),
        source: Mapping[str, object] = MappingProxyType({}),
        references: tuple[str, ...] = ("H71",),
        autopilot: Autopilot | None = None,
        restoring: tuple[ArrayLike, ArrayLike] | OddSpline | None = None,
    ) -> None:
        masses = np.array(inertia, dtype=float)
        if masses.shape != (3, 3) or not np.isfinite(masses).all():
            raise InputError(f"inertia needs a 3 x 3 array of finite numbers (sway, roll, yaw); given {inertia!r}")
        if not (np.isfinite(frequency) and frequency > 0):
            raise InputError(
                f"encounter frequency {frequency} rad/s must be greater than zero: a wave that keeps pace with the"
                " ship has no periodic motion; change speed or heading (for a negative one, give its modulus and the"
                " conjugate force: reverse the sign of force_sin)"
            )
        masses.flags.writeable = False
        values: dict[str, object] = {
            "inertia": masses,
            "terms": MappingProxyType({name: float(value) for name, value in terms.items()}),
            "frequency": float(frequency),
            "force_cos": _triple(force_cos, "force_cos"),
            "force_sin": _triple(force_sin, "force_sin"),
            "force_mean": _triple(force_mean, "force_mean"),
            "source": MappingProxyType(dict(source)),
            "references": references,
            "autopilot": autopilot,
            "restoring": odd_spline(*restoring).times(-1.0) if isinstance(restoring, tuple) else restoring,
        }
        for name, value in values.items():
            object.__setattr__(self, name, value)
        rudder = [checked_number(name, self.terms.get(name, 0.0)) for name in RUDDER_NAMES]
        table = term_table({name: value for name, value in self.terms.items() if name not in RUDDER_NAMES})
        if self.restoring is not None:
            table = with_spline(table, self.restoring)
        forces = (self.force_cos, self.force_sin, self.force_mean)
        system = canonical(masses, table, frequency, *forces, rudder=rudder, autopilot=autopilot)
        object.__setattr__(self, "system", system)
