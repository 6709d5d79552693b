"""What has no answer gets a status with advice, and never takes the rest of a batch with it."""

from dataclasses import replace

import numpy as np
import pytest

import quartering as qt
from quartering.motion.equations.system import acceleration_form
from quartering.motion.equations.terms import term_table
from quartering.motion.status import Status
from quartering.motion.steady.motion import steady_motions
from quartering.stability.assessment import assess
from quartering.stability.kind import Kind

pytestmark = pytest.mark.quick

IDLE = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0}


def escape(force):
    return qt.Model(np.eye(3), IDLE | {"K_p": -0.1, "K_phiphi": 1.0}, 0.85, (0, 0, 0), (0, force, 0))


@pytest.mark.parametrize("harmonics", [1, 3, 5])
def test_a_batch_outlives_its_impossible_members(harmonics):
    one = qt.Model(np.eye(3), IDLE | {"K_p": -0.1, "K_phiphi": 0.3}, 0.9, (0, 0.05, 0), (0, 0, 0)).system
    arrays = ("linear", "coefficients", "mean", "cos", "sin", "frequency")
    many = replace(one, **{name: np.repeat(getattr(one, name), 6, axis=0) for name in arrays})
    many.coefficients[1, 1, 0] = np.nan
    many.frequency[2] = 0.0
    many.linear[3] = np.inf
    many.cos[4, 1] = 50.0  # far beyond capsize
    u, orders, status, _ = steady_motions(many, harmonics)
    kind = assess(many, u, orders).kind
    assert [Status(int(code)) for code in status[1:4]] == [Status.NOT_FINITE] * 3
    assert Status(int(status[4])) is Status.NO_MOTION_FOUND
    assert set(kind[1:5]) == {Kind.NO_ANSWER}
    alone, _, _, _ = steady_motions(one, harmonics)
    for i in (0, 5):
        assert Status(int(status[i])).ok
        np.testing.assert_array_equal(u[i], alone[0])
    assert all(Status(int(code)).advice for code in status)


def test_capsize_leaves_no_motion_and_says_what_to_try():
    model = escape(5.0)
    assert qt.all_motions(model) == []
    motion = qt.steady_motion(model, 3)
    assert motion.status is Status.NO_MOTION_FOUND
    assert "capsize" in qt.stability(model, motion).sentence
    with pytest.raises(qt.InputError, match="capsize"):
        qt.branch(model, "excitation", limits=(0.9, 1.1))
    with pytest.raises(qt.InputError, match="capsize"):
        qt.edge(model, ("excitation", "frequency"), limits=((0.9, 1.1), (0.8, 0.9)))


def test_an_undamped_resonance_is_not_a_motion_of_astronomic_size():
    """Closed form: x'' + x = cos t has no bounded solution."""
    model = qt.Model(np.eye(3), IDLE, 1.0, (0, 0.1, 0), (0, 0, 0))
    motion = qt.steady_motion(model, 1)
    assert motion.status is Status.SINGULAR
    assert "damping" in motion.status.advice
    assert not qt.steady_motion(model, 3).status.ok
    assert qt.stability(model, motion).kind == "no-answer"


def test_one_singular_inertia_of_many_is_that_conditions_alone():
    inertia = np.repeat(np.eye(3)[None], 3, axis=0)
    inertia[1, 1, 1] = 0.0
    table = term_table(IDLE | {"K_p": -0.1})
    system = acceleration_form(inertia, table, [0.8, 0.8, 0.8], (np.zeros(3), np.array([0.0, 0.1, 0.0]), 0.0))
    _, _, status, _ = steady_motions(system, 3)
    assert [Status(int(code)).ok for code in status] == [True, False, True]
    assert "inertia" in Status(int(status[1])).advice
    with pytest.raises(qt.InputError, match="singular"):
        acceleration_form(inertia[1], table, [0.8], (np.zeros(3), np.ones(3), 0.0))
    with pytest.raises(qt.InputError, match="greater than zero"):
        qt.Model(np.eye(3), IDLE, 0.0, (0, 0, 0), (0, 0, 0))


@pytest.mark.parametrize("harmonics", [0, -1, 2, 201, 1001, 3.0, True, "3"])
def test_harmonics_that_cannot_be_are_refused_before_the_work(harmonics, tmp_path):
    model, ship, wave = escape(0.1), qt.ship("wigley"), qt.Wave(100.0, 1.0)
    asked = (
        lambda: qt.steady_motion(model, harmonics),
        lambda: qt.all_motions(model, harmonics),
        lambda: qt.polar(ship, wave, [5.0], [60.0], harmonics=harmonics),
        lambda: qt.sweep(ship, 5.0, 60.0, 100.0, 1.0, harmonics=harmonics, store=tmp_path / "s"),
        lambda: qt.branch(model, "excitation", limits=(0.9, 1.1), harmonics=harmonics),
    )
    for ask in asked:
        with pytest.raises(qt.InputError, match=r"odd number.* up to 199"):
            ask()
    assert list(tmp_path.iterdir()) == []
