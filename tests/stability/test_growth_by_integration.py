"""Leading Floquet exponents against the growth of a disturbance: random systems, integrated in time by equations of their own.

Nothing here is the library's but the systems' numbers: right-hand side and Jacobian are written out, the motion and its
variation are integrated, Newton's method closes the motion on itself, and the growth is that of the integrated map applied
2^30 times.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import quartering as qt
from quartering.motion.equations.batch import joined, rows
from quartering.motion.equations.water import Strips
from quartering.motion.steady.derivative import states_along
from quartering.motion.steady.harmonic import harmonic_balance
from quartering.stability.assessment import assess

CUBICS = ("vvv", "vvp", "vvr", "vpp", "vpr", "vrr", "ppp", "ppr", "prr", "rrr")
OWN = {"K_phi": (1, 0, 1), "K_phiphiphi": (1, 0, 3), "K_phi5": (1, 0, 5), "K_vvphi": (1, 2, 1), "N_vphiphi": (2, 1, 2)}
"""Terms in phi: row, power of v, power of phi."""
DOUBLINGS = 30
STRIPS, STEPS = 6, 750
ORDERS = tuple(range(1, 22, 2))
LARGEST = 1.2
"""Roll [rad] of the motions taken: beyond it the righting moment turns over and neighbours are gone within a cycle."""


def letters(monomial):
    return [monomial.count(letter) for letter in "vpr"]


def random_model(random, drag):
    """A damped or driven system in water that moves, at a frequency near its own or not."""
    inertia = np.eye(3) + np.triu(random.uniform(-0.2, 0.2, (3, 3)), 1)
    inertia = np.triu(inertia) + np.triu(inertia, 1).T
    terms = {"Y_v": -random.uniform(0.05, 1.0), "N_r": -random.uniform(-0.05, 1.0), "K_p": -random.uniform(-0.1, 0.3)}
    terms |= {name: random.uniform(-0.2, 0.2) for name in ("Y_p", "Y_r", "K_v", "K_r", "N_v", "N_p")}
    terms |= {
        "K_phi": -random.uniform(0.5, 1.5),
        "K_phiphiphi": random.uniform(-1.5, 0.8),
        "K_phi5": random.uniform(-0.3, 0.3),
    }
    strips, water, size = None, None, random.uniform(0.02, 0.5)
    if drag:
        x, phase = np.linspace(-1.0, 1.0, STRIPS), random.uniform(0.0, 2 * np.pi)
        moving = size * random.uniform(0.0, 1.0) * np.exp(1j * (random.uniform(-2.0, 2.0) * x + phase))
        strips = Strips(x, random.uniform(-0.3, 0.6, STRIPS), random.uniform(0.0, 0.3, STRIPS), moving)
    else:
        terms |= {f"{row}_{m}": random.uniform(-0.3, 0.3) for row in "YKN" for m in CUBICS}
        terms |= {"K_vvphi": random.uniform(-0.2, 0.2), "N_vphiphi": random.uniform(-0.2, 0.2)}
        water = tuple(size * random.uniform(0.0, 0.5, 2) * np.exp(2j * np.pi * random.uniform(size=2)))
    cos, sin = size * random.uniform(-1.0, 1.0, (2, 3))
    return qt.Model(inertia, terms, random.uniform(0.4, 2.2), cos, sin, water=water, strips=strips)


class Written:
    """The same systems, their equations written out for n at once; time is the wave's phase."""

    def __init__(self, models):
        def each(make):
            return np.array([make(m) for m in models])

        self.inverse = np.linalg.inv(each(lambda m: m.inertia))
        self.w = each(lambda m: m.frequency)
        self.cos, self.sin = each(lambda m: m.force_cos), each(lambda m: m.force_sin)
        self.linear = each(lambda m: [[m.terms[f"{row}_{s}"] for s in "vpr"] for row in "YKN"])
        self.cubics = each(lambda m: [[m.terms.get(f"{row}_{c}", 0.0) for c in CUBICS] for row in "YKN"])
        self.own = {name: each(lambda m, name=name: m.terms.get(name, 0.0)) for name in OWN}
        self.water = each(lambda m: m.water or (0.0, 0.0))
        self.dragged = models[0].strips is not None
        if self.dragged:
            # q = v - h p + x r - w, and its gradient stands in the force too
            self.form = each(lambda m: np.stack([np.ones(STRIPS), -m.strips.lever, m.strips.x], axis=1))
            self.c, self.flow = each(lambda m: m.strips.c), each(lambda m: m.strips.water[0])

    def __call__(self, phase, y):
        """Rates of the states v, phi, p, r (n, 4) and of their variations (n, 4, 4), in one row."""
        state, varied = y.reshape(-1, 20)[:, :4], y.reshape(-1, 20)[:, 4:].reshape(-1, 4, 4)
        (v, phi, p, r), turn = state.T, np.exp(1j * phase)
        own = np.stack([v, p, r], axis=1)
        force = self.cos * turn.real + self.sin * turn.imag + np.einsum("nkj,nj->nk", self.linear, own)
        slope = np.zeros((len(v), 3, 4))
        slope[:, :, [0, 2, 3]] = self.linear
        for name, (row, of_v, of_phi) in OWN.items():
            force[:, row] += self.own[name] * v**of_v * phi**of_phi
            slope[:, row, 1] += self.own[name] * v**of_v * of_phi * phi ** (of_phi - 1)
            if of_v:
                slope[:, row, 0] += self.own[name] * of_v * v ** (of_v - 1) * phi**of_phi
        if self.dragged:
            q = np.einsum("nzj,nj->nz", self.form, own) - (self.flow * turn).real
            force -= np.einsum("nz,nzj->nj", self.c * np.abs(q) * q, self.form)
            slope[:, :, [0, 2, 3]] -= np.einsum("nz,nzj,nzk->njk", 2 * self.c * np.abs(q), self.form, self.form)
        else:
            w0, w1 = (self.water.T * turn).real
            past = np.stack([v - w0, p, r - w1], axis=1)
            for i, name in enumerate(CUBICS):
                power = letters(name)
                force += self.cubics[:, :, i] * np.prod(past**power, axis=1)[:, None]
                for j, state_column in enumerate((0, 2, 3)):
                    if power[j]:
                        less = np.array(power) - np.eye(3, dtype=int)[j]
                        slope[:, :, state_column] += (
                            self.cubics[:, :, i] * (power[j] * np.prod(past**less, axis=1))[:, None]
                        )
        rate, change = np.empty((len(v), 4)), np.zeros((len(v), 4, 4))
        rate[:, 1], change[:, 1, 2] = p, 1.0
        rate[:, [0, 2, 3]] = np.einsum("nkj,nj->nk", self.inverse, force)
        change[:, [0, 2, 3]] = self.inverse @ slope
        whole = np.concatenate([rate, (change @ varied).reshape(-1, 16)], axis=1)
        return (whole / self.w[:, None]).ravel()

    def cycle(self, start):
        """State and map of disturbances after a cycle."""
        y = np.concatenate([start, np.tile(np.eye(4).ravel(), (len(start), 1))], axis=1).ravel()
        y = self.marched(y) if self.dragged else self.adapted(y)
        return y.reshape(-1, 20)[:, :4], y.reshape(-1, 20)[:, 4:].reshape(-1, 4, 4)

    def adapted(self, y):
        """Dormand and Prince's method of order 8 in scipy."""
        return solve_ivp(self, (0.0, 2 * np.pi), y, "DOP853", rtol=1e-10, atol=1e-12).y[:, -1]

    def marched(self, y):
        """Runge and Kutta's steps, all alike: ones that adapt would look for the corners of |q|, twelve a cycle of each system.

        Twice as many move the growth by less than 1e-7 1/s.
        """
        h = 2 * np.pi / STEPS
        for n in range(STEPS):
            t = n * h
            a = self(t, y)
            b = self(t + h / 2, y + h / 2 * a)
            c = self(t + h / 2, y + h / 2 * b)
            y = y + h / 6 * (a + 2 * b + 2 * c + self(t + h, y + h * c))
        return y

    def growth(self, start):
        """Rate [1/s] at which the fastest disturbance of the motion that begins near ``start`` grows."""
        end, phi = self.cycle(start)
        start = start + np.linalg.solve(phi - np.eye(4), (start - end)[:, :, None])[:, :, 0]
        end, phi = self.cycle(start)
        assert np.abs(end - start).max() < 1e-7  # closed
        grown = np.zeros(len(start))
        for _ in range(DOUBLINGS):  # |phi^n|^(1/n), n = 2^30, the size taken out before each squaring
            size = np.linalg.norm(phi, axis=(1, 2))
            phi = (phi / size[:, None, None]) @ (phi / size[:, None, None])
            grown = 2 * (grown + np.log(size))
        return (grown + np.log(np.linalg.norm(phi, axis=(1, 2)))) / 2**DOUBLINGS * self.w / (2 * np.pi)


def apart(count, drag, seed):
    """Leading exponents (count,) of random systems by the library, and what the integration makes of them."""
    random = np.random.default_rng(seed)
    models = [random_model(random, drag) for _ in range(count + count // 2)]
    system = joined([m.system for m in models])
    u, _, _ = harmonic_balance(system, ORDERS, from_rest=True)
    roll = np.hypot(u[:, 1, ::2], u[:, 1, 1::2]).sum(axis=1)
    kept = np.flatnonzero(roll < LARGEST)[:count]
    assert kept.size == count
    system, u = rows(system, kept), u[kept]
    found = assess(system, u, ORDERS, accuracy=1e-9).floquet.growth
    start = states_along(u, system.frequency, ORDERS, np.zeros(1))[:, 0]
    return found, Written([models[i] for i in kept]).growth(start)


@pytest.mark.parametrize(("drag", "tolerance"), [(False, 1e-6), (True, 1e-5)], ids=["smooth", "drag by strips"])
@pytest.mark.parametrize("count", [20, pytest.param(100, marks=pytest.mark.soak)])
def test_leading_exponent_is_the_growth_of_a_disturbance(count, drag, tolerance):
    """Authority: integration in time; 1e-6 1/s where the equations are smooth, 1e-5 with |q| q."""
    found, grown = apart(count, drag, seed=1972)
    np.testing.assert_allclose(found, grown, rtol=0, atol=tolerance)
    # stable and unstable ones, both
    assert count / 10 <= (grown > 1e-3).sum() <= count / 2
