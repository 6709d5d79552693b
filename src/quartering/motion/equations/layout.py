"""State layout: variables, kinematic relations and displacements, as arrays for the kernels."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Indices = NDArray[np.int64]


@dataclass(frozen=True)
class Layout:
    """The state of a ship as a list of variables.

    Parameters
    ----------
    states : tuple of str          names, in their order
    rows : tuple of int            row of the right-hand side that is the rate of each; -1 where it follows another state
    follows : tuple of int         state whose value is its rate, as phi' = p; -1 where the equations give it
    velocities : tuple of int      state that is the velocity of each mode of motion (sway, roll, yaw)
    displacements : tuple of int   state that is its displacement; -1 where the equations do not hold it: the mean of such a
                                   mode is a velocity

    Examples
    --------
    >>> SHIP.states[SHIP.velocities[1]], SHIP.states[SHIP.displacements[1]]
    ('p', 'phi')
    """

    states: tuple[str, ...]
    rows: tuple[int, ...]
    follows: tuple[int, ...]
    velocities: tuple[int, ...]
    displacements: tuple[int, ...]

    @cached_property
    def arrays(self) -> tuple[Indices, Indices, Indices, Indices]:
        """Rows, follows, velocities and displacements in the order kernels take them."""
        parts = (self.rows, self.follows, self.velocities, self.displacements)
        rows, follows, velocities, displacements = (np.array(part, dtype=np.int64) for part in parts)
        return rows, follows, velocities, displacements


SHIP = Layout(("v", "phi", "p", "r"), (0, -1, 1, 2), (-1, 2, -1, -1), (0, 2, 3), (-1, 1, -1))
"""Sway, roll, yaw of a ship whose rudder stays amidships."""

# A heading that is held enters harmonic balance through the rudder's answer to each harmonic of yaw (`steering.add_steering`),
# not as a displacement: its mean is a heading or a rate of turn as the gains decide.
STEERED = Layout((*SHIP.states, "psi"), (*SHIP.rows, -1), (*SHIP.follows, 3), SHIP.velocities, SHIP.displacements)
"""With an autopilot: the heading as well."""

LAGGING = Layout(
    (*STEERED.states, "delta"), (*STEERED.rows, 3), (*STEERED.follows, -1), SHIP.velocities, SHIP.displacements
)
"""With a steering gear that lags: the rudder angle as well, whose equation is the fourth row."""
