"""Samples of an excitation and what lies between them, beside the sum of its waves.  Authority: closed form."""

import numpy as np
import pytest

from quartering.motion.transient.excitation import ACCURACY, APART, in_chunks, steps_apart, weights_between

STEP = 0.2


@pytest.mark.parametrize("apart", APART)
@pytest.mark.parametrize("fastest", [0.3, 0.6, 1.2])
def test_every_half_step_is_the_sum_of_the_waves_to_the_bound_of_the_polynomial(apart, fastest):
    random = np.random.default_rng(1)
    w = np.linspace(0.2, fastest, 9)
    phasors = random.normal(size=(2, 3, w.size)) + 1j * random.normal(size=(2, 3, w.size))
    mean, steps, seen = np.array([0.7]), 2 * 256 * apart + 3, 0
    weights = weights_between(apart)
    bound = (np.abs(phasors) @ (w * apart * STEP) ** 8).max() / 936 + 1e-12
    for begin, some, forcing in in_chunks(w, phasors, mean, STEP, steps, apart, together=1):
        for n in range(some):
            for half in range(3):
                place = 2 * (n % apart) + half
                found = np.tensordot(weights[place], forcing[0, n // apart : n // apart + 8, :, 0, :3], axes=(0, 0))
                right = (phasors * np.exp(1j * w * (begin + n + 0.5 * half) * STEP)).sum(axis=2).real
                right[0] += mean[0]
                assert np.abs(found - right).max() <= bound
            seen += 1
    assert seen == steps


def test_samples_stand_as_far_apart_as_their_root_mean_square_stays_accurate():
    """Authority: the bound (w s)^8 / 936, of waves of two frequencies with a tenth of the force in the faster one."""
    size = np.array([[1.0, 0.1]])
    for fast in np.linspace(0.4, 3.0, 40):
        w = np.array([0.3, fast])
        apart = steps_apart(w, size, STEP)

        def error(steps, w=w):
            return np.sqrt((np.square(size) @ np.square((w * steps * STEP) ** 8 / 936) / np.square(size).sum()).item())

        allowed = [steps for steps in APART if error(steps) <= ACCURACY]
        assert apart == (max(allowed) if allowed else 1)


def test_an_excitation_that_is_nothing_needs_no_samples_between():
    assert steps_apart(np.array([50.0]), np.zeros((3, 1)), STEP) == max(APART)
