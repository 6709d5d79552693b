"""Motions that coexist, against closed forms, shooting and long integration by NumPy (tests/batch_of_rolls.py)."""

import numpy as np
import pytest

import quartering as qt
from quartering.motion.branches.homotopy import along_arc, carried
from quartering.motion.branches.search import from_grid
from tests.batch_of_rolls import Rolls, attractors, by_shooting
from tests.tiers import mostly_soak

IDLE = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0}
SPECIMEN = Rolls(*np.array([[0.00808], [0.9795], [0.0], [0.83386], [0.00918]]))


def model_of(of, i=0):
    terms = IDLE | {"K_p": -of.c[i], "K_phiphiphi": of.k[i], "K_phi5": -of.q[i]}
    return qt.Model(np.eye(3), terms, of.w[i], (0, of.force[i], 0), (0, 0, 0))


def amplitudes(model, harmonics):
    """Roll amplitudes of the motions of period one that do not lean."""
    found = qt.all_motions(model, harmonics)
    return np.array([m.amplitude[1] for m in found if m.periods == 1 and abs(m.mean[1]) < 1e-6])


def exact_of_one_harmonic(c, k, w, force):
    """Balance of one harmonic, s = A^2: s ((1 - w^2 - 3/4 k s)^2 + w^2 c^2) = F^2."""
    roots = np.roots([(0.75 * k) ** 2, -1.5 * k * (1 - w**2), (1 - w**2) ** 2 + (w * c) ** 2, -(force**2)])
    return np.sort(np.sqrt(roots.real[(np.abs(roots.imag) < 1e-9 * np.abs(roots)) & (roots.real > 0)]))


def bistable(count, seed):
    """Softening oscillators of which the balance of one harmonic has three motions."""
    draw, rows = np.random.default_rng(seed), []
    while len(rows) < count:
        row = (
            10 ** draw.uniform(-2.5, -1),
            draw.uniform(0.3, 1.2),
            draw.uniform(0.72, 0.97),
            10 ** draw.uniform(-2.6, -0.9),
        )
        if len(exact_of_one_harmonic(*row)) == 3:
            rows.append((*row[:2], 0.0, *row[2:]))
    return Rolls(*np.array(rows).T)


@pytest.mark.parametrize("harmonics", mostly_soak([3, 5, 9], 3))
def test_the_upper_motion_newtons_method_loses_between_one_harmonic_and_more_is_found(harmonics):
    """Shooting: 0.0302, 0.6353 and 0.6625 rad."""
    (exact,) = by_shooting(SPECIMEN, 1.0)
    assert len(exact) == 3
    np.testing.assert_allclose(amplitudes(model_of(SPECIMEN), harmonics), exact, atol=2e-4 if harmonics == 3 else 1e-5)
    stable = [m.amplitude[1] for m in qt.all_motions(model_of(SPECIMEN), harmonics) if m.stable]
    np.testing.assert_allclose(stable, exact[[0, 2]], atol=2e-4 if harmonics == 3 else 1e-5)


@pytest.mark.soak
def test_all_motions_of_one_harmonic_are_the_roots_of_their_cubic():
    """Closed form: soft and hard, far out on the resonance too (10.5 rad in the first)."""
    draw = np.random.default_rng(12)
    rows = [(0.005, -0.0731, 2.6644, 0.1714)]
    for _ in range(15):
        hard = draw.choice([-1, 1]) * 10 ** draw.uniform(-1.3, 0.5)
        rows.append((10 ** draw.uniform(-2.5, -0.7), hard, draw.uniform(0.3, 3.0), 10 ** draw.uniform(-2.5, 0.3)))
    for c, k, w, force in rows:
        of = Rolls(*np.array([[c], [k], [0.0], [w], [force]]))
        np.testing.assert_allclose(amplitudes(model_of(of), 1), exact_of_one_harmonic(c, k, w, force), rtol=1e-9)


@pytest.mark.soak
def test_no_motion_of_softening_oscillators_is_missed():
    """Shooting from 576 starts each: every motion it meets is found, and the number of motions is odd."""
    of = bistable(16, 7)
    for i, exact in enumerate(by_shooting(of, 1.7)):
        found = amplitudes(model_of(of, i), 9)
        for one in exact:
            assert np.abs(found - one).min() < 1e-4, (Rolls(*(v[i] for v in of)), exact, found)
        assert len(found) % 2 == 1


def test_upper_motions_beyond_the_angle_where_cubic_and_linear_restoring_are_equal_are_found():
    """Shooting; softening, then hardening again: motions at 2.0 and 2.5 rad, where x = 0.84 x^3 is at 1.2 and 1.4."""
    rows = [(0.0359, 0.7398, 0.1549, 0.7172, 0.1655), (0.0122, 0.4839, 0.0922, 1.1759, 0.063)]
    of = Rolls(*np.array(rows).T)
    for i, exact in enumerate(by_shooting(of, 3.0, side=30)):
        found = amplitudes(model_of(of, i), 15)
        assert exact.max() > 2.0
        for one in exact:
            assert np.abs(found - one).min() < 1e-3


def test_a_motion_of_one_harmonic_that_belongs_to_none_of_many_is_not_dropped_without_a_word():
    """Just below the force where the two lower motions of one harmonic merge; with more they have merged (shooting: one)."""
    c, k, w = 0.02, -0.5, 1.3
    three = [f for f in np.geomspace(0.1, 1.0, 2000) if len(exact_of_one_harmonic(c, k, w, f)) == 3]
    of = Rolls(*np.array([[c], [k], [0.0], [w], three[-1:]]))
    (exact,) = by_shooting(of, 2.5)
    motions = qt.all_motions(model_of(of), 9)
    np.testing.assert_allclose([m.amplitude[1] for m in motions], exact, atol=1e-5)
    assert len(exact) == 1
    assert len(motions.left_open) == 2
    assert all("a motion of one harmonic that rolls" in words for words in motions.left_open)


def test_the_arc_from_one_harmonic_to_many_ends_where_newtons_method_does():
    """Two ways to the same motions, those of a stiff spring, where neither has any trouble."""
    of = Rolls(*np.array([[0.04], [-0.2], [0.0], [1.2], [0.1]]))
    system, many = model_of(of).system, (1, 3, 5, 7)
    few, seeds = from_grid(system)
    wide = [np.pad(u, ((0, 0), (0, 6))) for u in seeds]
    assert len(seeds) == 3
    for one, other in zip(
        carried(system, seeds, few, many), (along_arc(system, u, few, many)[0] for u in wide), strict=True
    ):
        np.testing.assert_allclose(one, other, atol=1e-9)


@pytest.mark.soak
def test_no_attractor_of_400_bistable_oscillators_is_missed():
    """Long integration from 36 starts, 16 times the decay of a small disturbance: every end is a stable motion found."""
    of = bistable(400, 2026)
    grid = np.linspace(-1.0, 1.0, 6)
    starts = np.array([axis.ravel() for axis in np.meshgrid(grid, grid)]).T
    periods = int(np.ceil((16 * 2 / of.c * of.w / (2 * np.pi)).max()))
    missed = []
    for i, ends in enumerate(attractors(of, starts, periods)):
        found = np.array([m.amplitude[1] for m in qt.all_motions(model_of(of, i), 9) if m.periods == 1 and m.stable])
        missed += [
            (model_of(of, i).terms, end, found) for end in ends if not np.abs(found - end).min(initial=1.0) < 1e-3
        ]
    assert missed == []
