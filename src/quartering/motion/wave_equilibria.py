"""Equilibria of a ship that a wave carries along, their eigenvalues, and branches over heading or revolutions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from quartering.loads.wetted_hull.frozen import along_following
from quartering.motion.wave_riding import PLACE, ROLL, RUDDER, YAW, P, R, Rider, U, V

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]
Over = Literal["heading", "revolutions"]

PLACES: Final = 48
"""Places on the wave at which equilibria are looked for."""
_UNKNOWN: Final = np.array([PLACE, ROLL, YAW, V, U])
_BALANCED: Final = np.array([U, V, P, R, PLACE])
_SIZES: Final = np.array([1.0, 0.3, 0.3, 2.0, 2.0])
"""Unit of length of the unknowns."""
_UNIT: Final[dict[Over, float]] = {"heading": 0.3, "revolutions": 0.5}
"""Unit of length of the parameter [rad], [1/s]."""
_SMALL: Final = 1e-5
"""Steps of the derivatives, in these units."""
_CLOSE: Final = 1e-9
"""Accelerations at which an equilibrium is found: of gravity, and of 1 rad/s2."""
_ITERATIONS: Final = 30
_FIRST, _LONGEST, _SHORTEST = 0.03, 0.12, 1e-4
_LARGEST: Final = np.radians(75.0)
"""Heel at which a branch is left [rad]."""


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """A ship at rest on the wave.

    Parameters
    ----------
    state : (s,) float          as `STATES`
    revolutions, ordered        of the propeller [1/s], heading ordered off the wave's direction [rad]
    rudder : float              [rad]
    eigenvalues : (s,) complex  of small disturbances, the fastest growing first [1/s]
    """

    state: Floats
    revolutions: float
    ordered: float
    rudder: float
    eigenvalues: Complex

    @property
    def growth(self) -> float:
        """Of the fastest growing disturbance [1/s]."""
        return float(self.eigenvalues[0].real)


def places(rider: Rider, revolutions: float) -> list[tuple[float, bool]]:
    """Equilibria of a ship that runs straight with the wave: k xi, and whether it is stable in surge."""
    place, held = along_following(rider.ship, rider.wave.wavenumber, rider.wave.amplitude, PLACES)
    density, c = rider.ship.loading.density, rider.celerity
    tau0, tau1, tau2 = rider.propulsion.thrust_terms(density)
    push = tau0 * revolutions**2 + tau1 * revolutions * c + tau2 * c**2 - rider.propulsion.drag(c)
    total = np.where(held.found, held.load[:, 0], np.nan) + push
    found = []
    for i in range(PLACES):
        a, b = total[i], total[(i + 1) % PLACES]
        if a * b < 0:
            where = place[i] + 2 * np.pi / PLACES * a / (a - b)
            found.append((float((where + np.pi) % (2 * np.pi) - np.pi), bool(b < a)))
    return found


class Search:
    """Equilibria of a rider over one parameter: the heading ordered or the revolutions, the other one held."""

    def __init__(self, rider: Rider, over: Over, held: float) -> None:
        self.rider: Rider = rider
        self.over: Over = over
        self.held: float = held
        self.sizes: Floats = np.append(_SIZES, _UNIT[over])
        self._start: Floats = np.zeros(2)

    def _split(self, parameter: Floats) -> tuple[Floats, Floats]:
        """Revolutions and heading ordered."""
        still = np.full_like(parameter, self.held)
        return (still, parameter) if self.over == "heading" else (parameter, still)

    def state(self, point: Floats) -> Floats:
        """State of a point (5 unknowns and the parameter)."""
        y = np.zeros(self.rider.states)
        y[_UNKNOWN] = point[:5]
        if self.rider.lag > 0:
            y[RUDDER] = -self.rider.gain * (y[YAW] - float(self._split(point[[5]])[1][0]))
        return y

    def residual(self, points: Floats) -> Floats:
        """What does not balance (n, 5) at points (n, 6)."""
        n, ordered = self._split(points[:, 5])
        y = np.array([self.state(one) for one in points])
        return self.rider.rates(y, n, ordered, self._start)[:, _BALANCED]

    def _both(self, point: Floats) -> tuple[Floats, Floats]:
        """Residual (5,) and its derivatives (5, 6) by the scaled point."""
        self._start = self.rider.near(self.state(point))
        step = np.diag(_SMALL * self.sizes)
        found = self.residual(np.concatenate([point[None], point + step, point - step]))
        return found[0], (found[1:7] - found[7:]).T / (2 * _SMALL)

    def corrected(self, guess: Floats, along: Floats) -> tuple[Floats, Floats] | None:
        """The equilibrium on the plane through a guess at right angles to a direction, with its derivatives."""
        point = guess.copy()
        for _ in range(_ITERATIONS):
            residual, slope = self._both(point)
            if not np.isfinite(residual).all() or not np.isfinite(slope).all():
                return None
            if np.abs(residual).max() < _CLOSE:
                return point, slope
            try:
                change = np.linalg.solve(np.vstack([slope, along]), np.append(residual, 0.0))
            except np.linalg.LinAlgError:
                return None
            point = point - change / max(1.0, float(np.abs(change).max()) / 0.3) * self.sizes
            if abs(point[1]) > _LARGEST or abs(point[2]) > _LARGEST:
                return None
        return None

    def at(self, guess: Floats) -> Floats | None:
        """The equilibrium at the guess's own parameter."""
        found = self.corrected(guess, np.eye(6)[5])
        return None if found is None else found[0]

    def judged(self, point: Floats) -> Equilibrium:
        """An equilibrium with its eigenvalues."""
        n, ordered = (float(v[0]) for v in self._split(point[[5]]))
        y = self.state(point)
        found = np.linalg.eigvals(self.rider.matrix(y, n, ordered)).astype(complex)
        order = np.lexsort((-found.imag, -found.real.round(12)))
        return Equilibrium(y, n, ordered, -self.rider.gain * (y[YAW] - ordered), found[order])

    def branch(self, point: Floats, end: float, most: int = 200) -> list[Floats]:
        """Points of the branch from a point on, towards an end of the parameter, through folds.

        It ends past that end, where it comes back past its beginning, or where the ship balances no more.
        """
        towards = 1.0 if end > point[5] else -1.0
        points, step = [point], _FIRST
        tangent = _tangent(self._both(point)[1], towards * np.eye(6)[5])
        if abs(tangent[5]) < 1e-6:
            tangent = towards * np.abs(tangent)
        while len(points) < most and step > _SHORTEST:
            found = self.corrected(points[-1] + step * tangent * self.sizes, tangent)
            turned = None if found is None else _tangent(found[1], tangent)
            if found is None or turned is None or turned @ tangent < 0.9:
                step *= 0.5
                continue
            points.append(found[0])
            tangent, step = turned, min(_LONGEST, 1.4 * step)
            if (found[0][5] - end) * towards > 0 or (found[0][5] - point[5]) * towards < 0:
                break
        return points


def _tangent(slope: Floats, before: Floats) -> Floats:
    """Unit direction of a branch that goes on as the one before."""
    found = np.linalg.svd(slope)[2][-1]
    return np.asarray(found if found @ before >= 0 else -found)


def straight(rider: Rider, place: float) -> Floats:
    """Point of the search over heading of a ship that runs straight with the wave."""
    return np.array([place, 0.0, 0.0, 0.0, rider.celerity, 0.0])
