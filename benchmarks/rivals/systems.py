"""The systems all tools solve: numbers alone, so that nobody needs another's objects.

`cubic` is one made-up ship of sway, roll and yaw in many waves, in units of its natural roll frequency: every cubic product
of (v, p, r) and phi^3, velocities over ground. `by_strips` is Series 60, CB 0.60, as it is read: cross-flow drag by strips in
moving water and the hull's own righting curve; its conditions are those of a map.
"""

from dataclasses import dataclass

import numpy as np

MONOMIALS = (
    (3, 0, 0),
    (0, 3, 0),
    (0, 0, 3),
    (1, 2, 0),
    (1, 0, 2),
    (2, 1, 0),
    (0, 1, 2),
    (2, 0, 1),
    (0, 2, 1),
    (1, 1, 1),
)
"""Powers of v, p, r in the ten cubic products, in the order every tool writes them."""


@dataclass(frozen=True, eq=False)
class Cubic:
    """``(v, p, r)' = -damping (v, p, r) + products (ten) + (0, g phi^3 - phi, 0) + cos cos(w t) + sin sin(w t)``, phi' = p.

    Alike in all conditions are ``damping`` (3, 3), ``products`` (3, 10) and ``g``; ``w`` (n,), ``cos`` and ``sin`` (n, 3).
    """

    damping: np.ndarray
    products: np.ndarray
    g: float
    w: np.ndarray
    cos: np.ndarray
    sin: np.ndarray

    def first(self, count):
        return Cubic(self.damping, self.products, self.g, self.w[:count], self.cos[:count], self.sin[:count])

    def system(self):
        """As this library takes it: every condition with a matrix of its own, every product a row of powers."""
        from quartering.motion.equations.system import System

        n = self.w.size
        linear, coefficients = np.zeros((3, 4)), np.zeros((3, 11))
        linear[:, [0, 2, 3]] = -self.damping
        linear[1, 1] = -1.0
        coefficients[:, :10], coefficients[1, 10] = self.products, self.g
        powers = np.array([(a, 0, b, c) for a, b, c in MONOMIALS] + [(0, 3, 0, 0)], dtype=np.int64)
        return System(
            linear=np.tile(linear, (n, 1, 1)),
            coefficients=np.tile(coefficients, (n, 1, 1)),
            powers=powers,
            modulus=np.zeros(11, dtype=np.int64),
            mean=np.zeros((n, 3)),
            cos=self.cos,
            sin=self.sin,
            frequency=self.w,
        )


def cubic(count):
    """A ship that rolls to half a radian, and waves from well below its roll resonance to well above."""
    of_ship, of_waves = np.random.default_rng(22), np.random.default_rng(7)
    damping = np.array([[0.30, 0.05, -0.25], [0.06, 0.06, 0.04], [0.08, -0.02, 0.35]])
    products = of_ship.normal(0.0, 0.06, (3, 10))
    for row, own in ((0, (0, 3, 4)), (1, (1, 5, 6)), (2, (2, 7, 8))):  # each mode loses energy by its own velocity
        products[row, own] = -0.05
        products[row, own[0]] = -0.25
    w = of_waves.uniform(0.6, 1.5, count)
    force = of_waves.uniform((0.05, 0.02, 0.02), (0.30, 0.12, 0.15), (count, 3))
    phase = of_waves.uniform(0.0, 2.0 * np.pi, (count, 3))
    return Cubic(damping, products, 0.15, w, force * np.sin(phase), force * np.cos(phase))


@dataclass(frozen=True, eq=False)
class ByStrips:
    """``(v, p, r)' = linear (v, phi, p, r) - push sum |q| q e + arm moment(phi) + cos cos(w t) + sin sin(w t)``.

    ``q = e (v, p, r) - (water cos(w t) + .. sin(w t))`` at each strip, ``forms`` (z, 3) of e alike in all conditions, ``water``
    (n, z, 2); ``moment`` odd, of cubics (b, 4) beyond ``knots`` (b,); ``linear`` (n, 3, 4), ``push`` (n, 3, 3), ``arm`` (n, 3).
    """

    linear: np.ndarray
    push: np.ndarray
    arm: np.ndarray
    forms: np.ndarray
    water: np.ndarray
    knots: np.ndarray
    cubics: np.ndarray
    w: np.ndarray
    cos: np.ndarray
    sin: np.ndarray
    own: object

    def first(self, count):
        """Some of the conditions, spread over all of them."""
        from quartering.motion.equations.batch import rows

        return _by_strips(rows(self.own, np.linspace(0, self.w.size - 1, count).astype(np.intp)))

    def system(self):
        return self.own


def _by_strips(s):
    same = np.ascontiguousarray
    return ByStrips(
        same(s.linear), same(s.push), same(s.arm), same(s.strips[0, :, :3]), same(s.strips[:, :, 3:]), same(s.knots[0]),
        same(s.cubics[0]), same(s.frequency), same(s.cos), same(s.sin), s,
    )  # fmt: skip


def by_strips(count):
    """Series 60, CB 0.60, at three speeds, 37 headings, 20 wave lengths and several steepnesses, drawn with a fixed seed."""
    import quartering as qt
    from quartering.motion.equations.batch import joined, rows
    from quartering.motion.of_ship import ship_system

    ship = qt.ship("series60-cb60")
    length = ship.hull.length
    speeds = np.array([0.15, 0.2, 0.25]) * np.sqrt(9.81 * length)
    lengths = np.linspace(0.5, 2.4, 20) * length
    u, mu, wave = (a.ravel() for a in np.meshgrid(speeds, np.linspace(2.5, 177.5, 37), lengths, indexing="ij"))
    base = ship_system(ship, 2 * np.pi / wave, u, mu)
    made = [base.at_amplitude((steepness * wave / 2)[:, None]) for steepness in (1 / 150, 1 / 80, 1 / 50)]
    every = joined(made)
    chosen = np.random.default_rng(7).choice(every.count, count, replace=count > every.count)
    return _by_strips(rows(every, np.sort(chosen)))
