"""Rival: harmonic balance in jax, every condition in one vmap: Newton with derivatives by forward differentiation, then
Runge-Kutta steps for the multipliers."""

import os
from importlib.util import find_spec

import numpy as np

from rivals.balance_numba import tables_of

NEEDS = "jax"
# One thread, as all others in the run; it is read when the package is loaded.
os.environ.setdefault("XLA_FLAGS", "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1")


def missing():
    return find_spec(NEEDS) is None


def compiled(job, steps, newton=8):
    """A function of waves (w, cos, sin) that gives roll amplitudes and half-cycle matrices."""
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)
    values, rates, factors, weights, along, along_rates = (jnp.array(t) for t in tables_of((1, 3), 14, steps))
    damping, products, g, nb = jnp.array(job.damping), jnp.array(job.products), job.g, factors.size

    def accelerations(v, phi, p, r):
        cubes = [v**3, p**3, r**3, v * p * p, v * r * r, p * v * v, p * r * r, r * v * v, r * p * p, v * p * r]
        a = -damping @ jnp.stack([v, p, r]) + products @ jnp.stack(cubes)
        return a.at[1].add(g * phi**3 - phi)

    def residual(x, w, cos, sin):
        u = x.reshape(3, nb)
        v, phi, p, r = w * (u[0] @ rates), u[1] @ values, w * (u[1] @ rates), w * (u[2] @ rates)
        force = accelerations(v, phi, p, r) @ (weights[:, None] * values).T
        force = force.at[:, 0].add(cos).at[:, 1].add(sin)
        return (-((factors * w) ** 2) * u - force).ravel()

    def one(w, cos, sin):
        def step(x, _):
            return x - jnp.linalg.solve(jax.jacfwd(residual)(x, w, cos, sin), residual(x, w, cos, sin)), None

        x, _ = jax.lax.scan(step, jnp.zeros(3 * nb), None, length=newton)
        u = x.reshape(3, nb)
        states = jnp.stack(
            [w * (u[0] @ along_rates), u[1] @ along, w * (u[1] @ along_rates), w * (u[2] @ along_rates)], 1
        )
        rows = jax.vmap(jax.jacfwd(lambda y: accelerations(*y)))(states)
        turn = jnp.broadcast_to(jnp.array([[0.0, 0.0, 1.0, 0.0]]), (rows.shape[0], 1, 4))
        a = jnp.concatenate([rows[:, :1], turn, rows[:, 1:]], axis=1)
        h = jnp.pi / w / steps

        def march(phi, n):
            begin, middle, end = a[2 * n], a[2 * n + 1], a[2 * n + 2]
            k1 = begin @ phi
            k2 = middle @ (phi + 0.5 * h * k1)
            k3 = middle @ (phi + 0.5 * h * k2)
            k4 = end @ (phi + h * k3)
            return phi + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4), None

        phi, _ = jax.lax.scan(march, jnp.eye(4), jnp.arange(steps))
        return jnp.hypot(u[1, 0], u[1, 1]), phi

    run = jax.jit(jax.vmap(one))

    def solve(job):
        size, phi = run(jnp.array(job.w), jnp.array(job.cos), jnp.array(job.sin))
        return np.asarray(size), np.linalg.eigvals(np.asarray(phi)) ** 2

    return solve
