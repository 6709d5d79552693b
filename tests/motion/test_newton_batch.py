"""Conditions solved in batches: the same motions as one at a time, and none the wiser of its neighbours."""

from dataclasses import replace

import numpy as np
import pytest

from quartering.conventions import CUBIC_MONOMIALS
from quartering.motion.equations.system import FEWEST, System, acceleration_form, kernel_arguments
from quartering.motion.equations.terms import term_table
from quartering.motion.steady.harmonic import harmonic_balance, solve_with_care
from quartering.motion.steady.newton import imbalances, newton_batch

COUNT = 75  # two full rows and part of one


def systems(extra=(), mean=0.0, force=0.1, seed=1971) -> System:
    """Random coupled conditions: damped, with every cubic of (v, p, r), of random strength."""
    random = np.random.default_rng(seed)
    names = [f"{row}_{m}" for row in "YKN" for m in CUBIC_MONOMIALS] + ["K_phiphiphi", *extra]
    table = term_table(dict.fromkeys(names, 1.0))
    linear = np.zeros((COUNT, 3, 4))
    for k, column in enumerate((0, 2, 3)):
        linear[:, k, column] = -random.uniform(0.05, 1.0, COUNT)
    linear[:, 1, 1] = -1.0
    excitation = force * random.uniform(-1, 1, (2, COUNT, 3))
    frequency = random.uniform(0.4, 2.0, COUNT)
    forces = (*excitation, mean * random.uniform(-1, 1, (COUNT, 3)))
    system = acceleration_form(np.eye(3), table, frequency, forces, linear=linear)
    return replace(system, coefficients=system.coefficients * random.uniform(-0.2, 0.2, (COUNT, 1, 1)))


def found_in_step(system, orders):
    table = system.basis(orders, fewest=FEWEST)
    u, waiting, error = np.zeros((system.count, 3, table.factors.size)), np.ones(system.count, np.int8), np.zeros(COUNT)
    given = kernel_arguments(system, table)
    newton_batch(0, system.count, *given, False, False, u, waiting)
    imbalances(0, system.count, *given, u, waiting, error)
    return u, waiting == 0, error


@pytest.mark.parametrize(
    ("extra", "mean", "orders"),
    [
        ((), 0.0, (1,)),
        ((), 0.0, (1, 3, 5)),
        (("K_p|p|", "Y_v|v|", "N_r|v|", "Y_v|r|"), 0.0, (1, 3)),
        (("K_phiphi",), 0.05, (0, 1, 2, 3)),
    ],
)
def test_motions_are_those_of_the_careful_solver(extra, mean, orders):
    """Two codes of the same balance equations: in batches, and one condition at a time with damped steps."""
    system = systems(extra, mean)
    u, found, error = found_in_step(system, orders)
    alone, status, _ = solve_with_care(system, orders)
    assert found.mean() > 0.9
    assert (status[found] == 0).all()
    np.testing.assert_allclose(u[found], alone[found], atol=1e-12)
    assert error[found].max() < 1e-12


def test_a_condition_does_not_depend_on_its_neighbours():
    system = systems()
    u, found, _ = found_in_step(system, (1, 3))
    order = np.random.default_rng(3).permutation(COUNT)
    names = ("linear", "coefficients", "mean", "cos", "sin", "frequency")
    other, also_found, _ = found_in_step(replace(system, **{n: getattr(system, n)[order] for n in names}), (1, 3))
    np.testing.assert_array_equal(other, u[order])
    np.testing.assert_array_equal(also_found, found[order])


def test_a_neighbour_that_is_no_number_disturbs_nobody():
    system = systems()
    u, status, _ = harmonic_balance(system, (1, 3))
    broken = replace(system, linear=system.linear.copy())
    broken.linear[7] = np.nan
    again, after, _ = harmonic_balance(broken, (1, 3))
    others = np.arange(COUNT) != 7
    np.testing.assert_array_equal(again[others], u[others])
    np.testing.assert_array_equal(after[others], status[others])
    assert np.isnan(again[7]).all()


def test_motions_are_the_same_whether_the_residual_is_asked_for_or_not():
    system = systems()
    u, status, residual = harmonic_balance(system, (1, 3))
    without, alike, unknown = harmonic_balance(system, (1, 3), with_residual=False)
    np.testing.assert_array_equal(without, u)
    np.testing.assert_array_equal(alike, status)
    assert (residual[status == 0] < 1e-12).all()
    assert np.isnan(unknown).all()
