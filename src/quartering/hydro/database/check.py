"""Consistency checks of a hydrodynamic database, each message with mode and frequency."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np
from numpy.typing import NDArray

from quartering.conventions import MODES
from quartering.hull.lines.section import Floats

NEGATIVE: Final = 0.02
"""Negative damping from which on it is told, of the largest of its modes over frequency [1]."""
UNLIKE: Final = 0.05
"""Difference of two couplings that should be one, of the geometric mean of their modes [1]."""
SPIKE: Final = 0.1
"""Departure of added mass from what its neighbours foretell, of its size; eight times the usual one as well [1]."""
_USUAL: Final = 8.0
_FEWEST: Final = 12
SIZE: Final = (0.6, 1.7)
"""Sway added mass over that of strip theory on the ship's lines; 3-D and strips differ by less [1]."""
LEVER: Final = 0.35
"""Difference of the levers of the sway force, of the draught [1]."""


def soundness(frequency: Floats, added_mass: Floats, damping: Floats) -> list[str]:
    """What is wrong with a database whatever the ship.

    frequency (f,): ascending [rad/s]
    added_mass, damping (f, 3, 3): sway, roll, yaw about one point, SI
    Returns nothing, or each finding: negative damping, couplings that differ, a spike

    Damping takes energy out in every motion, so its matrix has no negative eigenvalue; at zero speed both matrices are
    symmetric. A spike is looked for in the diagonal of the added mass, each value against cubic interpolation of its four
    neighbours, from 12 frequencies on.  Source: [Ogilvie64] for the properties; the thresholds are this library's.
    """
    return [*_negative(frequency, damping), *_unlike(frequency, added_mass), *_spikes(frequency, added_mass)]


def _scaled(matrix: Floats) -> Floats:
    """Matrices over the size of their rows and columns."""
    size = np.sqrt(np.abs(np.einsum("fii->fi", matrix)).max(axis=0))
    size[size == 0.0] = 1.0
    return np.asarray(matrix / (size[:, None] * size))


def _negative(frequency: Floats, damping: Floats) -> list[str]:
    scaled = _scaled(damping)
    values, vectors = np.linalg.eigh((scaled + scaled.swapaxes(1, 2)) / 2)
    at = int(np.argmin(values[:, 0]))
    if values[at, 0] > -NEGATIVE:
        return []
    mode = MODES[int(np.argmax(np.abs(vectors[at, :, 0])))]
    return [
        f"the damping is negative at {frequency[at]:.4g} rad/s, mostly in {mode} ({100 * values[at, 0]:.2g} % of its largest): "
        "a spike of an irregular frequency, a wrong sign of a coupling, or moments about another point in part of it"
    ]


def _unlike(frequency: Floats, added: Floats) -> list[str]:
    scaled = _scaled(added)
    difference = np.abs(scaled - scaled.swapaxes(1, 2))
    at, i, j = np.unravel_index(int(np.argmax(difference)), difference.shape)
    if difference[at, i, j] < UNLIKE:
        return []
    return [
        f"the added mass of {MODES[int(i)]} by {MODES[int(j)]} and of {MODES[int(j)]} by {MODES[int(i)]} differ by "
        f"{100 * difference[at, i, j]:.2g} % at {frequency[at]:.4g} rad/s: motions and moments are not about one point"
    ]


def _spikes(frequency: Floats, added: Floats) -> list[str]:
    if frequency.size < _FEWEST:
        return []
    curves = np.einsum("fii->fi", added)
    inner = np.arange(2, frequency.size - 2)
    near = inner[:, None] + np.array([-2, -1, 1, 2])
    w, x = frequency[near], frequency[inner]
    others = [[j for j in range(4) if j != i] for i in range(4)]
    weight = np.stack(
        [np.prod([(x - w[:, j]) / (w[:, i] - w[:, j]) for j in o], axis=0) for i, o in enumerate(others)], 1
    )
    departure = np.abs(np.einsum("fn,fnk->fk", weight, curves[near]) - curves[inner]) / np.abs(curves).max(axis=0)
    at, mode = np.unravel_index(int(np.argmax(departure)), departure.shape)
    largest = departure[at, mode]
    if largest < SPIKE or largest < _USUAL * np.median(departure[:, mode]):
        return []
    return [
        f"the added mass in {MODES[int(mode)]} leaves its neighbours by {100 * largest:.2g} % at {x[at]:.4g} rad/s: a spike of "
        "an irregular frequency; close the waterplane inside the hull with a lid, or leave that frequency out"
    ]


def strip_agreement(added_mass: Floats, of_strips: Floats, draught: float) -> list[str]:
    """What tells that a database is not of this ship, or not about the point said.

    added_mass, of_strips (3, 3): about midship at the calm plane, at one frequency, SI
    draught: [m]
    Returns nothing, or: size of the sway added mass, height or place of its force

    The force of a swaying hull acts at depth -A24/A22 below the point and at x = A26/A22 forward of it. Strip theory knows
    both well enough to find a wrong point.  Source: [STF70] matrices; the thresholds are this library's.
    """
    found = []
    ratio = added_mass[0, 0] / of_strips[0, 0]
    if not SIZE[0] < ratio < SIZE[1]:
        found.append(
            f"its sway added mass is {ratio:.2g} times that of strip theory on the ship's lines: another ship, draught or "
            "scale (WAMIT: is `length` its ULEN?), or half a hull"
        )
    names = (("depth", 1, -1.0, "below the calm plane"), ("place", 2, 1.0, "forward of midship"))
    for words, column, sign, where in names:
        theirs, ours = (sign * a[0, column] / a[0, 0] for a in (added_mass, of_strips))
        if abs(theirs - ours) > LEVER * draught * (1.0 if column == 1 else 4.0):
            found.append(
                f"the {words} of its sway force is {theirs:.3g} m {where}, by strip theory {ours:.3g} m: are `midship` and "
                "`moments_about` those of the file?"
            )
    return found


def sway_phase(frequency: Floats, direction: Floats, forces: Mapping[str, NDArray[np.complex128]]) -> list[str]:
    """Have the forces the phases of the other time factor?

    frequency (f,): ascending [rad/s]
    direction (h,): the wave runs towards, from x to y of the file [deg]
    forces: (f, h, 3) phasors of e^{+i omega t} per metre of wave amplitude, file axes
    Returns nothing, or which forces have it

    In long waves the sway force is the acceleration of the water times masses above zero: with the elevation cos(omega t)
    of a wave that runs towards +y, v_y = omega a cos(omega t), so that the phasor of the force is +i times a positive
    number, and -i times it where imaginary parts have the other sign.  Looked for in the three longest waves, from the
    direction nearest the beam.  Source: Morison's inertia force; waves on deep water.

    >>> force = np.zeros((4, 1, 3), dtype=complex)
    >>> force[:, 0, 0] = 1j
    >>> w, beam = np.linspace(0.3, 0.6, 4), np.array([90.0])
    >>> sway_phase(w, beam, {"total": force}), sway_phase(w, beam, {"total": -force})[0][:22]
    ([], 'total forces have the ')
    """
    if not direction.size or frequency.size < 3:  # too few to tell it from one odd value
        return []
    sine = np.sin(np.radians(direction))
    beam = int(np.argmax(np.abs(sine)))
    if abs(sine[beam]) < _OBLIQUE:
        return []
    turned = []
    for name, values in forces.items():
        sway = values[:3, beam, 0] * np.sign(sine[beam])
        if sway.imag.sum() < -0.5 * np.abs(sway).sum() < 0:
            turned.append(name)
    if not turned:
        return []
    return [
        f"{' and '.join(turned)} forces have the phases of the other time factor: in long waves the sway force leads the "
        "elevation by 90 deg, and here it lags; reverse the sign of the imaginary parts, or of y"
    ]


_OBLIQUE: Final = 0.3
"""Sine of the direction from which on a sway force tells its phase."""
