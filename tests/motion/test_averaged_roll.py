"""Steady roll of two wave periods: the closed form, and the balance of many harmonics of the general equations."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from quartering.motion.equations.model import Model
from quartering.motion.equations.terms import term_table
from quartering.motion.steady.harmonic import solve_with_care
from quartering.motion.steady.subharmonic import slowed
from quartering.stability.averaged_roll import threshold
from tests.reference import table

ROWS = [{key: float(value) for key, value in row.items()} for row in table("amplitudes_of_two_periods.csv")]
ORDERS = (0, 2, 1, *range(3, 18))


def averaged(row):
    """Steady amplitudes of roll of two periods by averaging, least first, to 3 rad (theory of six degrees, `amplitude_2T`).

    With R = 1 - W^2/4 + 3/4 alpha3 A^2 + 5/8 alpha5 A^4 and I = (2 zeta + 8/(3 pi) delta (W/2) A + 3/4 beta3 (W/2)^2 A^2) W/2,
    (R/(h/2 + h3 A^2/2))^2 + (I/(h/2 + h3 A^2/4))^2 = 1.
    """
    half = row["W"] / 2.0

    def excess(A):
        stiff = 1.0 - half**2 + 0.75 * row["alpha3"] * A**2 + 0.625 * row["alpha5"] * A**4
        by = 2 * row["zeta"] + 8 / (3 * np.pi) * row["delta"] * half * A + 0.75 * row["beta3"] * half**2 * A**2
        first, second = row["h"] / 2 + row["h3"] * A**2 / 2, row["h"] / 2 + row["h3"] * A**2 / 4
        return (stiff * second) ** 2 + (by * half * first) ** 2 - (first * second) ** 2

    grid = np.linspace(0.0, 3.0, 3001)[1:]
    crossed = np.flatnonzero(np.diff(np.sign(excess(grid))))
    return np.array([brentq(excess, grid[k], grid[k + 1], xtol=1e-14) for k in crossed])


def system(row):
    """Roll alone, sway and yaw damped and apart; the wave changes the stiffness."""
    terms = {
        "Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_p": -2 * row["zeta"], "K_p|p|": -row["delta"], "K_ppp": -row["beta3"],
        "K_phiphiphi": -row["alpha3"], "K_phi5": -row["alpha5"],
    }  # fmt: skip
    still = Model(np.eye(3), {k: v for k, v in terms.items() if v}, row["W"], (0, 0, 0), (0, 0, 0)).system
    own = term_table({k: v for k, v in terms.items() if v and k not in ("Y_v", "N_r", "K_phi", "K_p")})
    count = own.modulus.size
    coefficients = np.zeros((1, 3, count + 2))
    coefficients[0, :, :count] = own.coefficients.reshape(3, count)
    coefficients[0, 1, count:] = -row["h"], -row["h3"]
    powers = np.zeros((count + 2, 5), dtype=int)
    powers[:count, :4] = own.powers.reshape(count, 4)
    powers[count], powers[count + 1] = (0, 1, 0, 0, 1), (0, 3, 0, 0, 1)
    made = replace(
        still, powers=powers, modulus=np.append(own.modulus, [0, 0]).astype(int), coefficients=coefficients,
        extra=np.array([-1]), inputs=np.array([[[0.0, 1.0, 0.0]]]),
    )  # fmt: skip
    return slowed(made, 2)


@pytest.mark.parametrize("row", ROWS, ids=lambda r: f"W{r['W']}-A{r['averaged']:.2f}")
def test_steady_roll_of_two_periods(row):
    """All roots of the averaged equation to 1e-6; the balance started from one finds the independent code's motion to 1e-4."""
    roots = averaged(row)
    wanted = sorted(r["averaged"] for r in ROWS if all(r[key] == row[key] for key in list(row)[:8]))
    assert roots == pytest.approx(wanted, abs=1e-6)
    equations, found = system(row), []
    for phase in np.linspace(0.0, np.pi, 6, endpoint=False):
        start = np.zeros((1, 3, 2 * len(ORDERS) - 1))
        start[0, 1, 3:5] = row["first"] * np.cos(phase), row["first"] * np.sin(phase)  # order 1 stands third
        u, status, _ = solve_with_care(equations, ORDERS, start)
        if status[0] <= 1:
            found.append(float(np.hypot(*u[0, 1, 3:5])))
    assert min(abs(a - row["first"]) for a in found) < 1e-4


def test_threshold_by_one_harmonic():
    """Authority: the one-harmonic thresholds of theory of six degrees, `mathieu_threshold`."""
    for row in table("mathieu_thresholds.csv"):
        W, zeta, h = (float(row[key]) for key in ("W", "zeta", "h_one_harmonic"))
        assert float(threshold(W, zeta)) == pytest.approx(h, abs=1e-10)
