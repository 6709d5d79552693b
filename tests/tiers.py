"""Cases of one test in two tiers: a few always, all of them by `make soak`."""

from collections.abc import Iterable

import pytest


def mostly_soak(cases: Iterable, *always, several: bool = False):
    """Cases of which all but some are of the long tier; `several` where each is a tuple of arguments."""
    cases = list(cases)
    assert set(always) <= set(cases), f"{set(always) - set(cases)} are no cases of {cases}"
    return [
        pytest.param(*(one if several else (one,)), marks=() if one in always else pytest.mark.soak) for one in cases
    ]
