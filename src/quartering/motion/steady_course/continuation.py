"""Branches of periodic motions of a ship on a steady course, followed by their arc length over a parameter of the condition.

Points are (x, parameter), in units of their own. Steps along the tangent are corrected at right angles to it; a step whose
correction fails, or behind which the tangent has turned too far, is halved. Source: [Krack19].
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Final, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from quartering.motion.steady_course.balance import Harmonics, balance
from quartering.motion.steady_course.course import Course

Floats = NDArray[np.float64]

_SIZES: Final = np.array([0.3, 0.1, 2.0, 0.3, 0.1])
"""Coefficients of one unit of length along a branch: heave in draughts, pitch [rad], sway [m/s], roll [rad], yaw [rad/s]."""
_FIRST, _LONGEST, _SHORTEST = 0.03, 0.25, 1e-4


class Family(Protocol):
    """One condition whose parameter changes."""

    def at(self, parameter: float) -> Course:
        """The condition at one value of the parameter, good until the next call."""
        ...


class OfAmplitude:
    """A condition over the amplitude of its wave [m]."""

    def __init__(self, course: Course) -> None:
        self._course = course.at_amplitude(course.numbers.amplitude.copy())

    def at(self, parameter: float) -> Course:
        """The condition in a wave of another amplitude."""
        self._course.numbers.amplitude[0] = parameter
        return self._course


class Splined:
    """A condition over a parameter that its numbers are splined through.

    course: the conditions at the values, one a row, in waves of one length
    values (n,): of the parameter, rising, five or more
    """

    _NAMES = ("amplitude", "omega", "wave", "mass", "damping", "heel", "force", "products", "strips", "rudder", "surge")

    def __init__(self, course: Course, values: Floats) -> None:
        self._course, n = course.rows(np.array([0])), values.size
        whole = [
            course.numbers.force.view(float) if name == "force" else getattr(course.numbers, name)
            for name in self._NAMES
        ]
        self._shapes = [(1, *part.shape[1:]) for part in whole]
        self._ends = np.cumsum([int(np.prod(shape)) for shape in self._shapes])[:-1]
        numbers = np.concatenate([part.reshape(n, -1) for part in whole], axis=1)
        self._spline = make_interp_spline(values, np.column_stack([numbers, course.speed, course.signed]), 5)

    def at(self, parameter: float) -> Course:
        """The condition at another value."""
        found = np.asarray(self._spline(parameter))
        parts = [
            np.ascontiguousarray(part.reshape(shape))
            for part, shape in zip(np.split(found[:-2], self._ends), self._shapes, strict=True)
        ]
        named = dict(zip(self._NAMES, parts, strict=True))
        named["force"] = named["force"].view(complex)
        numbers = self._course.numbers._replace(**named)
        return replace(self._course, numbers=numbers, speed=found[-2:-1].copy(), signed=found[-1:].copy())


class Path:
    """A branch in its own units: the balance at a point, corrections to the branch, tangents.

    family: the condition over its parameter
    unit: of the parameter, one unit of length along the branch
    small: change of the parameter by which the balance is differentiated
    """

    def __init__(self, family: Family, basis: Harmonics, draught: float, unit: float, small: float) -> None:
        self.family, self.basis, self.small = family, basis, small
        up, across = basis.sizes
        self.sizes = np.append(
            np.repeat(_SIZES * np.array([draught, 1, 1, 1, 1]), [up, up, across, across, across]), unit
        )

    def balance(self, point: Floats, column: Floats | None = None) -> tuple[Floats, Floats, bool]:
        """Residual (m,) and its derivatives (m, m + 1) by the scaled point; the last, by the parameter, may be given."""
        residual, jacobian, inside = balance(self.family.at(point[-1]), 0, self.basis, point[:-1])
        if column is None:
            by = self.small
            higher, _, inside_too = balance(self.family.at(point[-1] + by), 0, self.basis, point[:-1], derive=False)
            column, inside = (higher - residual) / by * self.sizes[-1], inside and inside_too
        return residual, np.column_stack([jacobian * self.sizes[:-1], column]), inside

    def corrected(self, guess: Floats, tangent: Floats) -> Floats | None:
        """The point of the branch on the plane through a guess at right angles to the tangent."""
        found = self.corrected_with(guess, tangent)
        return None if found is None else found[0]

    # Newton's method; the derivative by the parameter, which costs an evaluation of its own, is that of the second point from
    # there on: the steps left are small, and it changes little over them (as many steps in all as with a new one each time).
    def corrected_with(self, guess: Floats, tangent: Floats) -> tuple[Floats, Floats] | None:
        """`corrected`, and the derivatives of the balance there (m, m + 1)."""
        point, column = guess.copy(), None
        for n in range(8):
            residual, jacobian, inside = self.balance(point, column)
            if not inside:
                return None
            if np.abs(residual).max() < 1e-9:
                return point, jacobian
            column = jacobian[:, -1] if n >= 1 else None
            try:
                change = np.linalg.solve(np.vstack([jacobian, tangent]), np.append(residual, 0.0))
            except np.linalg.LinAlgError:
                return None
            if np.abs(change).max() > 2.0:
                return None
            point = point - change * self.sizes
        return None

    def at(self, guess: Floats, parameter: float) -> Floats | None:
        """The point of the branch at a value of the parameter."""
        held = np.zeros(guess.size)
        held[-1] = 1.0
        return self.corrected(np.append(guess[:-1], parameter), held)

    def tangent(self, jacobian: Floats, before: Floats) -> Floats:
        """Unit tangent that goes on as the one before, where the balance has these derivatives."""
        found = np.linalg.solve(np.vstack([jacobian, before]), np.append(np.zeros(jacobian.shape[0]), 1.0))
        return np.asarray(found / np.linalg.norm(found))

    def followed(
        self, start: Floats, direction: Floats, most: int, go_on: Callable[[Floats, Floats], bool]
    ) -> list[Floats]:
        """Points of the branch from one of them on.

        direction (m + 1,): the tangent to begin with goes on as this one, in the units of the path
        most: points
        go_on: of a point and the one before: is it followed further? The last fails it, unless steps have become too short
        """
        points, step = [start], _FIRST
        tangent = self.tangent(self.balance(start)[1], direction / np.linalg.norm(direction))
        while len(points) < most and step > _SHORTEST:
            found = self.corrected_with(points[-1] + step * tangent * self.sizes, tangent)
            turned = None if found is None else self.tangent(found[1], tangent)
            if found is None or turned is None or turned @ tangent < 0.8:
                step *= 0.5
                continue
            points.append(found[0])
            if not go_on(points[-1], points[-2]):
                break
            tangent, step = turned, min(_LONGEST, 1.4 * step)
        return points
