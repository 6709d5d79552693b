"""Total roll damping of a free roll in calm water, and its parts: added, waves, lift, drag.

A free roll moves the ship in the shape V = rho p of the undamped roll mode, rho = M^-1 e_2/(M^-1)_22 (sway rho_1 [m/rad], roll
1, yaw rho_3), with the inertia I = 1/(M^-1)_22 = rho' M rho. Its linear damping is that of the roll roots lambda of the ship's
linear equations with the water's coefficients at n2: zeta = -Re(lambda)/|lambda|, which holds the waves of the strips, lift and
what is added to K_p. A strip at x meets the water sideways at

    q_s = v + x_s r - h_s p = (rho_1 + x_s rho_3 - h_s) p ,

h_s the depth of its drag centre (half its draught) below G. Its drag -c_s |q_s| q_s, c_s = 1/2 rho C_D T_s dx_s, takes from
the free roll the power sum c_s |q_s|^3 = D |p|^3 with

    D = sum_s c_s |rho_1 + x_s rho_3 - h_s|^3 .

So the free roll is phi'' + 2 zeta n2 phi' + d |phi'| phi' + n2^2 phi = 0 with d = (D - K_p|p|)/I, the equation a decay is
fitted by, and its equivalent damping at amplitude A is zeta + (4/(3 pi)) d A.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from quartering.hull.hydrostatics import hydrostatics
from quartering.hull.lines.immersed import strips
from quartering.hull.lines.section import Floats
from quartering.hull.ship import Ship
from quartering.hydro.calm_water import state_matrix
from quartering.hydro.coefficient_table import Coefficients
from quartering.hydro.coefficients import coefficients
from quartering.hydro.source.of_ship import source_of

QUADRATIC: Final = "K_p|p|"
AMPLITUDE: Final = 10.0
"""Roll amplitude at which damping with the quadratic part is told [deg]."""

_LOST: Final = 4 / (3 * np.pi)


class FreeDamping(NamedTuple):
    """Damping of a free roll of small amplitude, and of its quadratic part.

    Parameters
    ----------
    frequency : float    n2 [rad/s]
    inertia : float      I of the free roll, water and coupled sway and yaw included [kg m2]
    axis : float         rho_1, depth of the roll axis below G [m/rad]
    ratio : float        zeta, everything linear in it [1]
    drag : float         d of the sections' drag [1/rad]
    added : float        d of K_p|p| [1/rad]
    """

    frequency: float
    inertia: float
    axis: float
    ratio: float
    drag: float
    added: float

    @property
    def quadratic(self) -> float:
        """D of drag and K_p|p| over the inertia: d [1/rad]."""
        return self.drag + self.added

    def equivalent(self, amplitude: float) -> float:
        """Damping ratio of equal loss at an amplitude [rad]."""
        return self.ratio + _LOST * self.quadratic * amplitude


def free_damping(ship: Ship, speed: float = 0.0) -> FreeDamping:
    """Damping of a ship's free roll in calm water.

    speed: U >= 0 [m/s]

    Drag as |q| q of the strips, whose water is at rest. Cubic velocity terms that are given or measured are not in it.
    Source: [H71] equation (3) for the mode; [Himeno81] for the equivalent damping.  Valid: small damping.
    """
    c = _at_roll(ship, speed)
    shape, inertia = _free_roll_shape(c)
    terms = {entry.name: entry for entry in c.table()}
    own = QUADRATIC in terms
    cubic = terms.get("K_ppp")
    drag = _drag_share(ship, shape) if cubic is None or cubic.kind == "cross-flow" else 0.0
    return FreeDamping(
        frequency=c.roll_frequency,
        inertia=inertia,
        axis=float(shape[0]),
        ratio=_ratio(state_matrix(c), c.roll_frequency),
        drag=drag / inertia,
        added=-terms[QUADRATIC].value / inertia if own else 0.0,
    )


def linear_for(ship: Ship, speed: float, ratio: float) -> float:
    """What K_p must be raised by for a given damping of the free roll.

    speed: U >= 0 [m/s]
    ratio: zeta asked for [1]
    Returns change of K_p, below 0 for more damping [kg m2/s]

    zeta falls by 1/(2 n2 I) of K_p, first order in the damping; steps of that slope until zeta is met.
    """
    c = _at_roll(ship, speed)
    matrix, n2, inertia = state_matrix(c), c.roll_frequency, _free_roll_shape(c)[1]
    by_moment = np.linalg.inv(c.inertia[0])[:, 1]
    change = 0.0
    for _ in range(50):
        damped = matrix.copy()
        damped[[0, 2, 3], 2] += change * by_moment
        missing = ratio - _ratio(damped, n2)
        if abs(missing) < 1e-13:
            break
        change -= 2 * n2 * inertia * missing
    return change


def damping_words(ship: Ship, speed: float = 0.0) -> str:
    """Roll damping in a line: what is added, and what there is in all in a free roll at a speed [m/s]."""
    return f"added roll damping {_added_words(ship)}; {total_words(ship, free_damping(ship, speed), speed)}"


def total_words(ship: Ship, roll: FreeDamping, speed: float) -> str:
    """What there is in all in a free roll, with what it is made of."""
    others = ["the waves of " + source_of(ship).words]
    others += ["lift"] if speed > 0 else []
    others += ["the measured set"] if ship.measured else []
    nonlinear = " and ".join([*(["the drag"] if roll.drag else []), *([QUADRATIC] if roll.added else [])])
    where = f"at {speed:.3g} m/s" if speed > 0 else "at rest"
    at = f", at {AMPLITUDE:g} deg" + (f" with {nonlinear}" if nonlinear else "")
    largest = roll.equivalent(np.radians(AMPLITUDE))
    return f"in a free roll {where} with {' and '.join(others)} {_percent(roll.ratio)}{at} {_percent(largest)}"


def _added_words(ship: Ship) -> str:
    if not ship.damped_by_components:
        return f"{_percent(ship.loading.roll_damping)} of critical"
    return f"by components ({ship.roll_damping_words})"


def _percent(ratio: float) -> str:
    return f"{100 * ratio:.3g} %"


def _at_roll(ship: Ship, speed: float) -> Coefficients:
    """Coefficients at the natural roll frequency."""
    n2 = coefficients(ship, 0.0, speed).roll_frequency
    return coefficients(ship, n2, speed)


def _free_roll_shape(c: Coefficients) -> tuple[Floats, float]:
    """Shape rho (sway, roll, yaw) and inertia of the undamped free roll."""
    column = np.linalg.inv(c.inertia[0])[:, 1]
    return column / column[1], float(1 / column[1])


def _ratio(matrix: Floats, n2: float) -> float:
    """Damping ratio of the roll pair: the pair nearest to +- i n2."""
    roots = np.linalg.eigvals(matrix)
    root = roots[np.argmin(np.hypot(roots.real, np.abs(roots.imag) - n2))]
    return float(-root.real / abs(root))


def _drag_share(ship: Ship, shape: Floats) -> float:
    """D of the strips' drag in a free roll [kg m2]."""
    wet, loading = strips(ship.hull), ship.loading
    depth = loading.kg - ship.hull.draught + wet.draught / 2
    x = wet.x - hydrostatics(ship).lcb
    strength = 0.5 * loading.density * ship.drag_coefficient * wet.draught * wet.weight
    return float(strength @ np.abs(shape[0] + x * shape[2] - depth) ** 3)
