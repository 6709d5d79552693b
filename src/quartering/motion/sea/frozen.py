"""Equations of a ship in a sea for integration in time: with memory of the waves it makes, or its coefficients of free roll."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from quartering.motion.equations.few_strips import gauss_rule
from quartering.motion.equations.layout import LAGGING, SHIP, STEERED, Layout
from quartering.motion.equations.steering import steered
from quartering.motion.equations.system import System
from quartering.motion.sea.closure import coefficients_at
from quartering.motion.sea.equations import SeaEquations, Terms
from quartering.motion.sea.memory import Memory

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class FrozenEquations:
    """Equations in time, and what a metre of each wave drives them with.

    Parameters
    ----------
    system : System           one condition, without excitation
    channels : (c, m) complex    per metre in each cell, phasors of e^{i |omega| t}: three accelerations, the known inputs, the
                              water at the strips as `System` takes it
    """

    system: System
    channels: Complex


def with_few_strips(equations: SeaEquations, points: int) -> SeaEquations:
    """The same equations with the drag and the water's velocity on fewer strips.

    points: strips wanted, see `gauss_rule`; where there are no more, or two of them stand at one place, the equations
        come back as they are

    The velocity of the water at the new strips is that of the polynomial of degree ``points`` - 1 along the hull that comes
    nearest to it: as many shapes as strips.
    """
    terms = equations.terms
    x = terms.forms[:, 2]
    if x.size <= points or np.unique(x).size < x.size or (terms.drag <= 0).any():
        return equations
    order = np.argsort(x)
    at, c, values = gauss_rule(x[order], terms.drag[order], points)
    forms = np.stack([np.ones_like(at), values @ terms.forms[order, 1], at], axis=1)
    water = np.ascontiguousarray(equations.water[:, :, order] @ values.T)
    return replace(equations, water=water, terms=replace(terms, forms=forms, drag=c))


def frozen_equations(equations: SeaEquations, variance: Floats, memory: Memory | None = None) -> FrozenEquations:
    """Equations in time of those over the cells of a sea.

    variance (z,): of the strips' velocity through the water, by which matched cubic drag is made [m2/s2]
    memory: of the radiated waves, whose states follow those of the ship; None: without

    Without memory inertia and linear forces are those of free roll. The wave force of each cell, lift in it, is that
    of its own encounter frequency.
    """
    terms, (inertia, linear) = equations.terms, equations.at_roll
    if memory is not None:
        inertia, linear = memory.inertia, memory.linear(linear)
    inverse = np.asarray(np.linalg.inv(inertia), dtype=np.float64)
    coefficients = coefficients_at(terms, variance)
    used = _uses_the_water(terms)
    powers = terms.powers if used else terms.powers[:, :4]
    inputs = equations.inputs if used else equations.inputs[:, :0]
    pushed = terms.matched is None and terms.drag.size > 0
    strips, water = np.zeros((1, 0, 5)), np.zeros((len(equations.force), 0), dtype=complex)
    if pushed:
        scale = np.cbrt(terms.drag)
        strips = np.zeros((1, terms.drag.size, 5))
        strips[0, :, :3] = terms.forms * scale[:, None]
        water = (equations.water[:, 0] + 1j * equations.water[:, 1]) * scale
    pilot = equations.autopilot
    rates = (inverse @ linear)[None]
    layout = SHIP if pilot is None else STEERED if pilot.lag == 0.0 else LAGGING
    if pilot is not None:
        rates = steered(rates, (inverse @ equations.rudder)[None], pilot)
    if memory is not None:
        rates, layout = _with_memory(rates[0], layout, memory, inverse)
    system = System(
        linear=rates,
        coefficients=np.ascontiguousarray(inverse @ coefficients)[None],
        powers=np.ascontiguousarray(powers),
        modulus=terms.modulus,
        mean=(inverse @ terms.mean)[None],
        cos=np.zeros((1, 3)),
        sin=np.zeros((1, 3)),
        frequency=np.array([equations.roll_frequency]),
        inputs=np.zeros((1, inputs.shape[1], 3)),
        extra=terms.extra if used else terms.extra[:0],
        strips=strips,
        push=-inverse[None],
        knots=terms.knots[None],
        cubics=terms.cubics[None],
        arm=np.ascontiguousarray(inverse[:, 1])[None],
        layout=layout,
    )
    channels = np.concatenate([equations.force @ inverse.T, inputs, water], axis=1)
    return FrozenEquations(system, channels)


def _with_memory(linear: Floats, layout: Layout, memory: Memory, inverse: Floats) -> tuple[Floats, Layout]:
    """Linear part (1, k + m, s + m) and layout with the states of the memory after the others."""
    own, drive, force = memory.states()
    (k, s), m = linear.shape, len(own)
    out = np.zeros((k + m, s + m))
    out[:k, :s] = linear
    out[:3, s:] = inverse @ force
    out[k:, [0, 2, 3]] = drive
    out[k:, s:] = own
    more = tuple(f"memory_{i}" for i in range(m))
    rows, follows = (*layout.rows, *range(k, k + m)), (*layout.follows, *(-1,) * m)
    return out[None], Layout((*layout.states, *more), rows, follows, layout.velocities, layout.displacements)


def _uses_the_water(terms: Terms) -> bool:
    """Does a product hold a velocity through the water?"""
    return bool(terms.powers[:, 4:].any() or (terms.modulus > 4).any())
