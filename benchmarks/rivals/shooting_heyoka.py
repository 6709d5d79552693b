"""Rival: shooting on Taylor series with variational equations, in heyoka's batch mode at the tolerance of the job.

A batch is as wide as the processor's vectors; the coefficients of the ship are numbers in the compiled code, only the wave is a
parameter; half a cycle is enough, as the motion returns with its sign reversed.
"""

from importlib.util import find_spec

import numpy as np

NEEDS = "heyoka"


def missing():
    return find_spec(NEEDS) is None


class Shooting:
    """Integrators compiled once for a ship."""

    def __init__(self, job, tolerance):
        import heyoka as hy

        v, phi, p, r = hy.make_vars("v", "phi", "p", "r")
        w, time = hy.par[0], hy.time
        cubes = [
            v * v * v,
            p * p * p,
            r * r * r,
            v * p * p,
            v * r * r,
            p * v * v,
            p * r * r,
            r * v * v,
            r * p * p,
            v * p * r,
        ]

        def row(k):
            value = -(job.damping[k, 0] * v + job.damping[k, 1] * p + job.damping[k, 2] * r)
            for t, cube in enumerate(cubes):
                value = value + job.products[k, t] * cube
            return value + hy.par[1 + k] * hy.cos(time) + hy.par[4 + k] * hy.sin(time)

        rates = [row(0), p, row(1) - phi + job.g * phi * phi * phi, row(2)]
        equations = [(x, rate / w) for x, rate in zip((v, phi, p, r), rates, strict=True)]
        self.width = hy.recommended_simd_size()
        pars = np.ones((7, self.width))
        self.plain = hy.taylor_adaptive_batch(equations, np.zeros((4, self.width)), tol=tolerance, pars=pars)
        varied = hy.var_ode_sys(equations, hy.var_args.vars, order=1)
        self.varied = hy.taylor_adaptive_batch(varied, np.zeros((4, self.width)), tol=tolerance, pars=pars)

    def _half(self, start, pars, grid=None):
        """State and its derivative after half a cycle, the sign turned back; and roll at instants of it."""
        of = self.varied
        of.set_time(0.0)
        of.pars[:], of.state[:4], of.state[4:] = pars, start, np.eye(4).reshape(16, 1)
        roll = None
        if grid is None:
            of.propagate_until(np.pi)
        else:
            roll = of.propagate_grid(grid)[1][:-1, 1]
        return -of.state[:4], -of.state[4:].reshape(4, 4, -1).transpose(2, 0, 1), roll

    def __call__(self, job, instants=16):
        n = job.w.size
        pars = np.vstack([job.w, job.cos.T, job.sin.T])
        size, monodromy = np.empty(n), np.empty((n, 4, 4))
        phases = np.linspace(0.0, np.pi, instants + 1)
        grid = np.repeat(phases[:, None], self.width, axis=1)
        for begin in range(0, n, self.width):
            which = np.minimum(np.arange(begin, begin + self.width), n - 1)
            own = pars[:, which]
            self.plain.set_time(0.0)
            self.plain.pars[:], self.plain.state[:] = own, 0.0
            self.plain.propagate_until(6.0 * np.pi)
            x = self.plain.state.copy()
            for _ in range(12):
                end, slope, _ = self._half(x, own)
                step = np.linalg.solve(np.eye(4) - slope, (end - x).T[:, :, None])[:, :, 0].T
                x = x + step
                if np.abs(step).max() < 1e-6:  # the next step would be its square
                    break
            _, slope, roll = self._half(x, own, grid)
            size[which] = np.abs(np.exp(-1j * phases[:-1]) @ roll) * 2.0 / instants
            monodromy[which] = slope
        return size, np.linalg.eigvals(monodromy) ** 2
