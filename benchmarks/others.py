"""The same conditions by other tools, each used simply: a function of a sample's numbers for every tool.

They check answers. As measures of speed they are weak: products by powers, a general solver for every sample, one condition
at a time.

A sample holds linear (n, 3, 4), coefficients (n, 3, t), powers (t, 4), cos and sin (n, 3) and frequency (n,) of the equations
of motion. Each function returns seconds a condition after compilation, amplitudes of the fundamental (n, 3) and, where the tool
gives them, multipliers (n, 4) by falling modulus; or None where it is not installed.
"""

import time
from importlib.util import find_spec

import numpy as np
from numba import njit, prange
from scipy.integrate import solve_ivp

PERIODS, SAMPLES = 40, 64


def products(x, powers):
    """Products (t,) of one state."""
    return np.prod(x**powers, axis=1)


def fundamental(states, phases):
    """Amplitudes of sway, roll and yaw displacement from states (4, m) over a cycle, velocities divided by the frequency."""
    return np.abs(states @ np.exp(-1j * phases)) * 2 / phases.size


def sorted_multipliers(matrix):
    values = np.linalg.eigvals(matrix)
    return values[np.argsort(-np.abs(values))]


# Plain numba -------------------------------------------------------------------------------------------------------------


@njit(cache=True)
def _rhs(linear, coefficients, powers, x, force, jacobian):
    for k in range(3):
        force[k] = 0.0
        for s in range(4):
            jacobian[k, s] = linear[k, s]
            force[k] += linear[k, s] * x[s]
    for t in range(powers.shape[0]):
        value = 1.0
        for s in range(4):
            value *= x[s] ** powers[t, s]
        for k in range(3):
            force[k] += coefficients[k, t] * value
        for s in range(4):
            if powers[t, s] > 0:
                slope = float(powers[t, s])
                for o in range(4):
                    slope *= x[o] ** (powers[t, o] - (1 if o == s else 0))
                for k in range(3):
                    jacobian[k, s] += coefficients[k, t] * slope


@njit(cache=True)
def _cycle(u, w, n, m):
    """State at sample n of m from u (3, 4): cos and sin of harmonics 1 and 3."""
    x = np.zeros(4)
    for c in range(2):
        h = 1 + 2 * c
        a, b = np.cos(2 * np.pi * h * n / m), np.sin(2 * np.pi * h * n / m)
        for k in range(3):
            rate = h * w * (u[k, 2 * c + 1] * a - u[k, 2 * c] * b)
            x[0 if k == 0 else 2 if k == 1 else 3] += rate
            if k == 1:
                x[1] += u[k, 2 * c] * a + u[k, 2 * c + 1] * b
    return x


@njit(parallel=True, cache=True)
def _plain(linear, coefficients, powers, cos, sin, frequency, u, multipliers):
    m, steps = 14, 100
    for i in prange(frequency.size):
        w = frequency[i]
        force, jacobian = np.zeros(3), np.zeros((3, 4))
        for _ in range(30):
            residual, matrix = np.zeros(12), np.zeros((12, 12))
            for n in range(m):
                _rhs(linear[i], coefficients[i], powers, _cycle(u[i], w, n, m), force, jacobian)
                for c in range(4):
                    angle = 2 * np.pi * (1 + 2 * (c // 2)) * n / m
                    project = 2.0 / m * (np.cos(angle) if c % 2 == 0 else np.sin(angle))
                    for k in range(3):
                        residual[4 * k + c] -= project * force[k]
                        for b in range(4):
                            h = 1 + 2 * (b // 2)
                            turn = 2 * np.pi * h * n / m
                            value = np.cos(turn) if b % 2 == 0 else np.sin(turn)
                            rate = -h * w * np.sin(turn) if b % 2 == 0 else h * w * np.cos(turn)
                            matrix[4 * k + c, b] -= project * jacobian[k, 0] * rate
                            matrix[4 * k + c, 4 + b] -= project * (jacobian[k, 1] * value + jacobian[k, 2] * rate)
                            matrix[4 * k + c, 8 + b] -= project * jacobian[k, 3] * rate
            for k in range(3):
                for c in range(4):
                    h = 1 + 2 * (c // 2)
                    matrix[4 * k + c, 4 * k + c] -= (h * w) ** 2
                    residual[4 * k + c] -= (h * w) ** 2 * u[i, k, c]
                residual[4 * k] -= cos[i, k]
                residual[4 * k + 1] -= sin[i, k]
            step = np.linalg.solve(matrix, -residual)
            size = 0.0
            for row in range(12):
                u[i, row // 4, row % 4] += step[row]
                size = max(size, abs(step[row]))
            if size < 1e-12:
                break
        a = np.zeros((2 * steps + 1, 4, 4))
        for n in range(2 * steps + 1):
            _rhs(linear[i], coefficients[i], powers, _cycle(u[i], w, n, 4 * steps), force, jacobian)
            a[n, 1, 2] = 1.0
            for s in range(4):
                a[n, 0, s], a[n, 2, s], a[n, 3, s] = jacobian[0, s], jacobian[1, s], jacobian[2, s]
        phi, dt = np.eye(4), np.pi / w / steps
        for n in range(steps):
            k1 = a[2 * n] @ phi
            k2 = a[2 * n + 1] @ (phi + 0.5 * dt * k1)
            k3 = a[2 * n + 1] @ (phi + 0.5 * dt * k2)
            k4 = a[2 * n + 2] @ (phi + dt * k3)
            phi = phi + dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        multipliers[i] = np.linalg.eigvals(phi.astype(np.complex128)) ** 2


def plain_numba(s):
    """Harmonic balance and Runge-Kutta over half a cycle, one condition after another on all cores."""

    def run():
        u, multipliers = np.zeros((s.frequency.size, 3, 4)), np.empty((s.frequency.size, 4), complex)
        _plain(s.linear, s.coefficients, s.powers, s.cos, s.sin, s.frequency, u, multipliers)
        return u, multipliers

    run()
    begin = time.perf_counter()
    u, multipliers = run()
    each = (time.perf_counter() - begin) / s.frequency.size
    order = np.argsort(-np.abs(multipliers), axis=1)
    return each, np.hypot(u[:, :, 0], u[:, :, 1]), np.take_along_axis(multipliers, order, axis=1)


# scipy -------------------------------------------------------------------------------------------------------------------


def _functions(s, i):
    linear, coefficients, w = s.linear[i], s.coefficients[i], s.frequency[i]

    def motion(t, y):
        a = linear @ y + coefficients @ products(y, s.powers) + s.cos[i] * np.cos(w * t) + s.sin[i] * np.sin(w * t)
        return np.array([a[0], y[2], a[1], a[2]])

    def jacobian(y):
        slope = linear.copy()
        for o in range(4):
            lower = np.maximum(s.powers - np.eye(4, dtype=int)[o], 0)
            slope[:, o] += coefficients @ (s.powers[:, o] * products(y, lower))
        return np.vstack([slope[0], [0, 0, 1, 0], slope[1:]])

    return motion, jacobian, w


def scipy(s):
    """solve_ivp to the steady motion, then with the variational equations over one period."""
    begin, amplitudes, multipliers = time.perf_counter(), [], []
    for i in range(s.frequency.size):
        motion, jacobian, w = _functions(s, i)
        period = 2 * np.pi / w

        def both(t, z, motion=motion, jacobian=jacobian):
            return np.concatenate([motion(t, z[:4]), (jacobian(z[:4]) @ z[4:].reshape(4, 4)).ravel()])

        options = {"method": "DOP853", "rtol": 1e-9, "atol": 1e-11}
        end = solve_ivp(motion, (0, PERIODS * period), np.zeros(4), **options).y[:, -1]
        times = np.arange(SAMPLES) * period / SAMPLES
        cycle = solve_ivp(both, (0, period), np.append(end, np.eye(4)), t_eval=[*times, period], **options).y
        sizes = fundamental(cycle[:4, :-1], w * times)
        amplitudes.append([sizes[0] / w, sizes[1], sizes[3] / w])
        multipliers.append(sorted_multipliers(cycle[4:, -1].reshape(4, 4)))
    return (time.perf_counter() - begin) / s.frequency.size, np.array(amplitudes), np.array(multipliers)


# mousai ------------------------------------------------------------------------------------------------------------------


def mousai(s):
    """Harmonic balance in the time domain; no multipliers."""
    if find_spec("mousai") is None:
        return None
    from mousai import hb_time

    begin, amplitudes = time.perf_counter(), []
    for i in range(s.frequency.size):
        motion, _, w = _functions(s, i)

        def slope(x, parameters, motion=motion):
            return motion(parameters["cur_time"], np.ravel(x)).reshape(4, 1)

        count = 2 * 3 + 1
        _, x, *_ = hb_time(slope, x0=np.zeros((4, count)), omega=w, eqform="first_order", num_harmonics=3)
        sizes = fundamental(x, 2 * np.pi * np.arange(x.shape[1]) / x.shape[1])
        amplitudes.append([sizes[0] / w, sizes[1], sizes[3] / w])
    return (time.perf_counter() - begin) / s.frequency.size, np.array(amplitudes), None


# heyoka ------------------------------------------------------------------------------------------------------------------


def _taylor(s):
    """One integrator for all conditions: their numbers are its parameters."""
    import heyoka as hy

    names = ("v", "phi", "p", "r")
    x = hy.make_vars(*names)
    terms = s.powers.shape[0]
    a = []
    for k in range(3):
        value = sum((hy.par[4 * k + o] * x[o] for o in range(4)), start=hy.expression(0.0))
        for t in range(terms):
            product = hy.par[12 + terms * k + t]
            for o in range(4):
                for _ in range(s.powers[t, o]):
                    product = product * x[o]
            value = value + product
        shift = 12 + 3 * terms
        w = hy.par[shift + 6]
        a.append(value + hy.par[shift + k] * hy.cos(w * hy.time) + hy.par[shift + 3 + k] * hy.sin(w * hy.time))
    equations = [(x[0], a[0]), (x[1], x[2]), (x[2], a[1]), (x[3], a[2])]
    system = hy.var_ode_sys(equations, args=hy.var_args.vars)
    return hy.taylor_adaptive(system, np.zeros(4), compact_mode=True)


def heyoka(s):
    """Newton's method on the period map, its derivative from the variational equations, from rest."""
    if find_spec("heyoka") is None:
        return None
    integrator = _taylor(s)
    start = np.append(np.zeros(4), np.eye(4).ravel())
    begin, amplitudes, multipliers = time.perf_counter(), [], []
    for i in range(s.frequency.size):
        w = s.frequency[i]
        integrator.pars[:] = np.concatenate([s.linear[i].ravel(), s.coefficients[i].ravel(), s.cos[i], s.sin[i], [w]])
        times = np.linspace(0, 2 * np.pi / w, SAMPLES + 1)
        x = np.zeros(4)
        for _ in range(12):
            integrator.time, integrator.state[:] = 0.0, start
            integrator.state[:4] = x
            cycle = integrator.propagate_grid(times)[-1]
            phi = cycle[-1, 4:].reshape(4, 4)
            step = np.linalg.solve(np.eye(4) - phi, cycle[-1, :4] - x)
            x = x + step
            if np.abs(step).max() < 1e-10:
                break
        sizes = fundamental(cycle[:-1, :4].T, w * times[:-1])
        amplitudes.append([sizes[0] / w, sizes[1], sizes[3] / w])
        multipliers.append(sorted_multipliers(phi))
    return (time.perf_counter() - begin) / s.frequency.size, np.array(amplitudes), np.array(multipliers)


# jax and diffrax -----------------------------------------------------------------------------------------------------------


def diffrax(s):
    """Shooting on Tsit5 with its Jacobian by forward differentiation, all conditions in one vmap."""
    if find_spec("diffrax") is None:
        return None
    import diffrax as dfx
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)
    powers = s.powers

    def motion(t, y, args):
        linear, coefficients, cos, sin, w = args
        columns = [jnp.prod(jnp.stack([y[o] ** int(p) for o, p in enumerate(row)])) for row in powers]
        a = linear @ y + coefficients @ jnp.stack(columns) + cos * jnp.cos(w * t) + sin * jnp.sin(w * t)
        return jnp.stack([a[0], y[2], a[1], a[2]])

    def cycle(x, args, saves):
        return dfx.diffeqsolve(
            dfx.ODETerm(motion), dfx.Tsit5(), 0.0, 2 * jnp.pi / args[-1], None, x, args, saveat=dfx.SaveAt(ts=saves),
            stepsize_controller=dfx.PIDController(rtol=1e-9, atol=1e-11), max_steps=2048,
            adjoint=dfx.ForwardMode(),
        ).ys  # fmt: skip

    def one(*args):
        saves = jnp.linspace(0, 2 * jnp.pi / args[-1], SAMPLES + 1)

        def end(x):
            return cycle(x, args, saves[-1:])[-1]

        def newton(x, _):
            return x + jnp.linalg.solve(jnp.eye(4) - jax.jacfwd(end)(x), end(x) - x), None

        x, _ = jax.lax.scan(newton, jnp.zeros(4), None, length=8)
        return cycle(x, args, saves), jax.jacfwd(end)(x)

    run = jax.jit(jax.vmap(one))
    arrays = [jnp.asarray(a) for a in (s.linear, s.coefficients, s.cos, s.sin, s.frequency)]
    jax.block_until_ready(run(*arrays))
    begin = time.perf_counter()
    states, phi = (np.asarray(a) for a in jax.block_until_ready(run(*arrays)))
    each = (time.perf_counter() - begin) / s.frequency.size
    phases = 2 * np.pi * np.arange(SAMPLES) / SAMPLES
    sizes = np.array([fundamental(c[:-1].T, phases) for c in states])
    w = s.frequency
    amplitudes = np.column_stack([sizes[:, 0] / w, sizes[:, 1], sizes[:, 3] / w])
    return each, amplitudes, np.array([sorted_multipliers(p) for p in phi])


ALL = {"plain numba": plain_numba, "jax + diffrax": diffrax, "heyoka": heyoka, "mousai": mousai, "scipy": scipy}
SIZES = {"plain numba": 4096, "jax + diffrax": 128, "heyoka": 64, "mousai": 4, "scipy": 8}
"""Conditions of the sample: enough for a steady time, few enough to wait for."""
