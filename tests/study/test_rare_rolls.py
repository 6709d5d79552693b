"""Extrapolation of largest rolls and of rates: against laws in closed form, published counts, and counting."""

import numpy as np
import pytest
import xarray as xr

import quartering as qt
from quartering.study.seas.simulated.rare import failure_rate_at, largest_roll

# failures and exposure [h] at wave heights [m]: an independent program's count for a ship with a limit of 40 deg, long-crested
HEIGHTS, FAILURES, HOURS = [7, 6.5, 6, 5.5], [476, 386, 262, 201], [92.9, 136.2, 181.6, 325.9]


def blocks(largest, arm=90.0, failures=0):
    return xr.Dataset({"roll_largest": ("block", largest), "failures": ((), failures)}, attrs={"largest_arm": arm})


@pytest.mark.parametrize("tail", ["gev", "gpd"])
def test_a_tail_of_known_law_is_met(tail):
    """Rayleigh peaks, 200 a block: P(largest < x) = (1 - e^(-x^2/2))^200; the level in closed form lies in the interval."""
    rng = np.random.default_rng(1)
    inside, hours = 0, 300.0
    exact = 5.0 * np.sqrt(2 * np.log(200 * 2 * hours))
    for _ in range(10):
        u = rng.random(1200)
        level = largest_roll(blocks(5.0 * np.sqrt(-2 * np.log(-np.expm1(np.log(u) / 200)))), hours, tail)
        inside += level.lower < exact < level.upper
        assert level.shape < 0.15
    assert inside >= 7  # of ten; 9.5 expected but for what is not yet in the limit


def test_rates_over_height_meet_what_was_counted_lower():
    """The same program counted 102 in 486 h at 5 m and 40 in 1,015 h at 4.5 m: intervals overlap with the exact ones."""
    for hs, lower, upper in ((5.0, 4.8e-5, 7.1e-5), (4.5, 0.78e-5, 1.49e-5)):
        at = failure_rate_at(hs, HEIGHTS, FAILURES, HOURS)
        assert at.lower < upper
        assert at.upper > lower


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: failure_rate_at(3.5, HEIGHTS, FAILURES, HOURS), "at most 2 are answered for"),
        (lambda: failure_rate_at(5, HEIGHTS[:2], FAILURES[:2], HOURS[:2]), "3 different heights at least"),
        (lambda: failure_rate_at(5, HEIGHTS, [5, *FAILURES[1:]], HOURS), "each needs 30 at least"),
        (lambda: failure_rate_at(5, HEIGHTS, FAILURES[::-1], HOURS[::-1]), "do not rise with wave height"),
        (lambda: failure_rate_at(0, HEIGHTS, FAILURES, HOURS), "hs = 0"),
        (lambda: largest_roll(blocks(np.ones(10)), 10), "a tail needs 20 at least"),
        (lambda: largest_roll(blocks(np.ones(500), failures=2), 10), "ended with a failure"),
        (lambda: largest_roll(blocks(np.random.default_rng(2).gumbel(20, 2, 600), arm=30.0), 1e4), "reaches the largest"),
        (lambda: largest_roll(3.0, 10), "is no simulation"),
        (lambda: largest_roll(blocks(np.ones(500)), 10, "guess"), "allowed: gev, gpd"),
    ],
)  # fmt: skip
def test_what_is_not_answered_for_is_refused(call, words):
    with pytest.raises(qt.InputError, match=words):
        call()
