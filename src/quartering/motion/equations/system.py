"""The equations of motion: from named terms to accelerations, the acceleration coupling removed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from quartering._machine.compiled import kernel
from quartering._machine.rowwise import contracted
from quartering._machine.threads import in_threads
from quartering.conventions import InputError
from quartering.hull.autopilot import Autopilot
from quartering.hull.righting.spline import OddSpline
from quartering.motion.equations.basis import Basis, basis
from quartering.motion.equations.layout import LAGGING, SHIP, STEERED, Layout
from quartering.motion.equations.program import PLAIN, Program, program
from quartering.motion.equations.rates import Parts
from quartering.motion.equations.steering import steered
from quartering.motion.equations.terms import TermTable
from quartering.motion.equations.water import Strips, relative_inputs, relative_terms

Floats = NDArray[np.float64]


PER_CONDITION: Final = Parts._fields
"""What of a `System` has a row a condition; the products are alike in all."""


@dataclass(frozen=True, eq=False)
class System:
    """The equations of n conditions: accelerations as explicit functions of the state and the time.

    ``d/dt (v, p, r) = linear (v, phi, p, r) + coefficients products + push strips + arm moment(phi) + mean + cos cos(w t)
    + sin sin(w t)``, d phi/dt = p. With an autopilot the heading psi (d psi/dt = r), and with a lag the rudder angle delta,
    stand among the linear columns. The products are of the state and of variables that known inputs in time enter: a state with
    an input added, as the velocity through the water v - w0, or an input alone, as a stiffness that changes with the wave.

    Parameters
    ----------
    linear : (n, 3, 4) float          rows sway, roll, yaw; columns v, phi, p, r, and as `steered` adds them psi, delta
    coefficients : (n, 3, t) float    of the nonlinear products
    powers : (t, 4 + e) int           of (v, phi, p, r) and of the e variables that known inputs enter, in each product
    modulus : (t,) int                variable (from 1) between modulus bars, 0 for none
    mean, cos, sin : (n, 3) float     excitation accelerations
    frequency : (n,) float            w > 0 [rad/s]
    inputs : (n, e, 1 + 2 h) float    Fourier series of the known inputs: mean, cos and sin of each harmonic of the wave
    extra : (e,) int                  state that each is added to; -1 for an input alone
    strips : (n, z, 5) float          cross-flow drag, as `Strips.array`
    push : (n, 3, 3) float            accelerations per unit of |q| q of the strips
    knots, cubics : (n, b), (n, b, 4) table of the restoring moment beyond its slope at 0, odd in phi: on from each knot
    arm : (n, 3) float                accelerations per unit of that moment
    layout : Layout                   of the state
    periods : int                     of the wave in one of ``frequency``
    """

    linear: Floats
    coefficients: Floats
    powers: NDArray[np.int64]
    modulus: NDArray[np.int64]
    mean: Floats
    cos: Floats
    sin: Floats
    frequency: Floats
    inputs: Floats = field(default_factory=lambda: np.zeros((1, 0, 3)))
    extra: NDArray[np.int64] = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    strips: Floats = field(default_factory=lambda: np.zeros((1, 0, 5)))
    push: Floats = field(default_factory=lambda: np.zeros((1, 3, 3)))
    knots: Floats = field(default_factory=lambda: np.zeros((1, 0)))
    cubics: Floats = field(default_factory=lambda: np.zeros((1, 0, 4)))
    arm: Floats = field(default_factory=lambda: np.zeros((1, 3)))
    layout: Layout = SHIP
    periods: int = 1

    def __post_init__(self) -> None:
        for name in PER_CONDITION:  # what was left out is alike in all conditions
            array = getattr(self, name)
            if len(array) != self.count and len(array) == 1:
                object.__setattr__(self, name, np.repeat(array, self.count, axis=0))

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
        """Is there nothing but (v, phi, p, r)? Then many conditions are solved in a batch."""
        return self.states == 4

    @property
    def degree(self) -> int:
        """Highest degree of the polynomial products (1 when the system is linear), known inputs alone not counted."""
        return int(self.powers[:, self._of_state].sum(axis=1).max(initial=1))

    @property
    def _of_state(self) -> NDArray[np.bool_]:
        return np.concatenate([np.ones(PLAIN, dtype=bool), self.extra >= 0])

    @property
    def has_kinked_slopes(self) -> bool:
        """Has the derivative of some term a jump, that of a product with a modulus?"""
        return bool(self.modulus.any())

    @property
    def has_table(self) -> bool:
        """Is there a table of the restoring moment, whose derivative is smooth but for jumps of its curvature?"""
        return self.knots.shape[1] > 0

    @property
    def has_drag(self) -> bool:
        """Is there cross-flow drag by strips, whose second derivative jumps?"""
        return self.strips.shape[1] > 0

    @property
    def smooth(self) -> bool:
        """Have the equations all derivatives?"""
        return not (self.has_kinked_slopes or self.has_table or self.has_drag)

    @property
    def symmetric(self) -> bool:
        """Does reversing the state and shifting by half a period leave the equations as they are?"""
        if self.mean.any():
            return False
        harmonics = np.repeat(np.arange(1 + self.inputs.shape[2] // 2), 2)[1:]
        odd, even = (self.inputs[:, :, harmonics % 2 == parity].any(axis=(0, 2)) for parity in (1, 0))
        used = self.powers[:, PLAIN:].any(axis=0)
        if (used & even & (odd | (self.extra >= 0))).any():
            return False
        changes_sign = np.concatenate([np.ones(PLAIN, dtype=bool), odd | (self.extra >= 0)])
        return bool((self.powers[:, changes_sign].sum(axis=1) % 2 == 1).all())

    @cached_property
    def finite(self) -> NDArray[np.bool_]:
        """Conditions (n,) of which every number is finite and the frequency positive."""
        ok = np.isfinite(self.frequency) & (self.frequency > 0)
        for name in PER_CONDITION:
            array = getattr(self, name).reshape(self.count, -1)
            if not np.isfinite(array.sum()):  # mostly all of them are: a sum tells, but for one beyond the number range
                ok &= np.isfinite(array).all(axis=1)
        ok.flags.writeable = False
        return ok

    def each(self, change: Callable[[Floats], Floats]) -> System:
        """The same products, with a function applied to every array that has the conditions in front."""
        arrays: dict[str, Any] = {name: change(getattr(self, name)) for name in PER_CONDITION}
        return replace(self, **arrays)

    def repeated(self, count: int) -> System:
        """Each condition a number of times, its copies beside each other."""
        return self if count == 1 else self.each(lambda array: np.repeat(array, count, axis=0))

    def raised(self, factor: Floats, copies: int = 1) -> System:
        """The excitation and all known inputs times a factor (n,) or (1,): the wave at another height.

        copies: of each condition beside each other, each with a factor of its own
        """
        rest = replace(self, strips=self.strips[:, :0]).repeated(copies)
        by = np.array(np.broadcast_to(np.asarray(factor, dtype=float).reshape(-1), (rest.count,)))
        strips = rest.strips
        if self.has_drag:
            strips = np.empty((rest.count, *self.strips.shape[1:]))
            in_threads(_raise_water, rest.count, np.require(self.strips, requirements=("C", "W")), by, copies, strips)
        parts = {name: by[:, None] * getattr(rest, name) for name in ("mean", "cos", "sin")}
        return replace(rest, inputs=by[:, None, None] * rest.inputs, strips=strips, **parts)

    def begun_at(self, phase: Floats) -> System:
        """The equations with the time counted from phases (n,) of a cycle [rad]."""
        turn = self.periods * np.asarray(phase, dtype=float)[:, None]

        def turned(cos: Floats, sin: Floats, h: int = 1) -> tuple[Floats, Floats]:
            c, s = np.cos(h * turn), np.sin(h * turn)
            return cos * c + sin * s, sin * c - cos * s

        cos, sin = turned(self.cos, self.sin)
        strips, inputs = self.strips.copy(), self.inputs.copy()
        strips[:, :, 3], strips[:, :, 4] = turned(self.strips[:, :, 3], self.strips[:, :, 4])
        for h in range(1, inputs.shape[2] // 2 + 1):
            own = turned(self.inputs[:, :, 2 * h - 1], self.inputs[:, :, 2 * h], h)
            inputs[:, :, 2 * h - 1], inputs[:, :, 2 * h] = own
        return replace(self, cos=cos, sin=sin, strips=strips, inputs=inputs)

    def basis(self, orders: tuple[int, ...], *, lower: int = 0, extra: int = 0, fewest: int = 0) -> Basis:
        """Sampled harmonics with enough phases for these equations, `lower` in degree.

        With drag by strips at least `fewest` a cycle, which a table of the restoring moment beside it is content with; a table
        alone is sampled as finely as kinks are, so that nothing but its own series is left out.
        """
        alone = int(self.powers[:, ~self._of_state].sum(axis=1).max(initial=0))
        extra += self.periods * alone * (self.inputs.shape[2] // 2)
        fine = self.has_kinked_slopes or (self.has_table and not self.has_drag)
        return basis(orders, self.degree - lower, fine, extra, fewest=fewest if self.has_drag else 0)

    @property
    def program(self) -> Program:
        """How the kernels make the products."""
        return program(self.powers, self.modulus, self.extra, self.layout)

    @property
    def parts(self) -> Parts:
        """Arrays in the order every compiled kernel takes them.

        All are writeable and contiguous: a kernel is compiled again for arrays that are not.
        """
        own = (getattr(self, name) for name in PER_CONDITION)
        return Parts(*(a if a.flags.carray else np.require(a, requirements=("C", "W")) for a in own))


@kernel
def _raise_water(first, last, strips, by, copies, out):  # type: ignore[no-untyped-def]
    """Strips (n, z, 5) of conditions first..last, the water times ``by`` (n,), of some copies of each of those given."""
    for i in range(first, last):
        for z in range(strips.shape[1]):
            own = strips[i // copies, z]
            out[i, z, 0], out[i, z, 1], out[i, z, 2] = own[0], own[1], own[2]
            out[i, z, 3], out[i, z, 4] = by[i] * own[3], by[i] * own[4]


FEWEST: Final = 48
"""Samples of a cycle with drag |q| q: 48 misjudge its fundamental by 6/48^3, 5e-5. A table of the restoring moment beside it,
of which no derivative below the third jumps, is content with them: its harmonics fall with the fourth power of their order."""


def kernel_arguments(system: System, table: Basis) -> tuple[Any, ...]:
    """Program, parts, and the tables of a basis with the wave's harmonics, as every kernel takes them."""
    return system.program, system.parts, (*table.arrays, table.waves(system.periods, system.inputs.shape[2]))


def acceleration_form(
    inertia: ArrayLike,
    table: TermTable,
    frequency: ArrayLike,
    excitation: tuple[ArrayLike, ArrayLike, ArrayLike],
    *,
    linear: ArrayLike | None = None,
    rudder: ArrayLike = 0.0,
    autopilot: Autopilot | None = None,
    restoring: OddSpline | None = None,
    water: tuple[ArrayLike, ArrayLike] | None = None,
    strips: Strips | None = None,
) -> System:
    """The equations solved for the accelerations: every row multiplied by the inverse inertia.

    inertia (n, 3, 3): rigid body plus added mass [kg, kg m, kg m2]
    table: the terms on the right
    frequency (n,): w > 0 [rad/s]
    excitation: of cos, of sin, and the mean, (n, 3) each [N, N m, N m]
    linear (n, 3, 4): linear terms of each condition in place of the table's
    rudder (n, 3): Y_delta, K_delta, N_delta [N, N m, N m]
    autopilot: that moves it; without one it stays amidships
    restoring: a moment K over phi beside the terms [N m]
    water (w0, w1): (n,) complex each: the velocity products of the table are then on the velocity through the water,
        see `relative_terms` [m/s, 1/s]
    strips: cross-flow drag on the velocity through the water; of one or of n conditions

    Source: [H71] eq. (3); the restoring moment then stands in all three rows.
    """
    w = np.atleast_1d(np.asarray(frequency, dtype=float))
    inverse = _inverse(np.asarray(inertia, dtype=float))
    cos, sin, mean = excitation

    def row(force: ArrayLike) -> Floats:
        forces = np.broadcast_to(np.asarray(force, dtype=float), (w.size, 3))
        return np.ascontiguousarray(contracted(inverse, forces[..., None, :]))

    def rows(matrix: Floats) -> Floats:
        product = inverse @ matrix
        return np.ascontiguousarray(np.broadcast_to(product, (w.size, *product.shape[-2:])))

    extra, known = np.empty(0, dtype=np.int64), dict[str, Any]()
    if water is not None:
        table, extra = relative_terms(table)
        known = {"inputs": np.array(np.broadcast_to(relative_inputs(*water), (w.size, 2, 3)))}
    if strips is not None:
        known |= {"strips": strips.array, "push": rows(-np.eye(3))}
    raw_linear = table.linear if linear is None else np.array(linear, dtype=float)
    if restoring is not None:
        raw_linear = raw_linear.copy()
        raw_linear[..., 1, 1] += restoring.slope
        knots, cubics = restoring_table(restoring)
        known |= {"knots": knots[None], "cubics": cubics[None], "arm": row((0.0, 1.0, 0.0))}
    accelerations = rows(raw_linear)
    layout = SHIP if autopilot is None else STEERED if autopilot.lag == 0.0 else LAGGING
    return System(
        linear=accelerations if autopilot is None else steered(accelerations, row(rudder), autopilot),
        coefficients=rows(table.coefficients),
        powers=table.powers,
        modulus=table.modulus,
        mean=row(mean),
        cos=row(cos),
        sin=row(sin),
        frequency=w,
        extra=extra,
        layout=layout,
        **known,
    )


def _inverse(masses: Floats) -> Floats:
    """Inverse inertia; NaN for one condition of many whose matrix has none, which gets a status of its own."""
    scale = np.sqrt(np.abs(np.diagonal(masses, axis1=-2, axis2=-1)))
    whole = np.where((scale > 0).all(axis=-1, keepdims=True), scale, np.inf)
    balanced = np.abs(np.linalg.det(masses / (whole[..., :, None] * whole[..., None, :])))
    singular = np.asarray(~(balanced > 1e-12))
    if singular.all():
        raise InputError(
            "the inertia matrix (rigid body plus added mass) is singular or has a zero on its diagonal;"
            " give mass, roll and yaw inertia greater than zero"
        )
    inverse = np.linalg.inv(np.where(singular[..., None, None], np.eye(3), masses))
    return np.asarray(np.where(singular[..., None, None], np.nan, inverse))


def restoring_table(spline: OddSpline) -> tuple[Floats, Floats]:
    """Cubics of a righting spline between its knots, without its slope at 0.

    Returns knots (b,): where each begins, the first 0 [rad]; cubics (b, 4): a, b, c, d of a + b x + c x^2 + d x^3, x
        beyond the knot
    """
    knots = np.append(0.0, spline.knots)
    cubics = [np.array([0.0, 0.0, 0.0, spline.cubic])]
    for x, jump in zip(np.diff(knots), spline.jumps, strict=True):
        a, b, c, d = cubics[-1]
        at_knot = [a + x * (b + x * (c + x * d)), b + x * (2 * c + 3 * x * d), c + 3 * x * d, d + jump]
        cubics.append(np.array(at_knot))
    return knots, np.array(cubics)
