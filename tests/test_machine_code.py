"""Kept machine code is loaded without the compiler's tables, and links with what is compiled later."""

import subprocess
import sys

import numpy as np

from quartering._machine.compiled import _LOADED_ALONE

KERNELS = """
from quartering._machine.compiled import inner, kernel

@inner
def squared(x):
    return x * x

@kernel
def summed(values):
    total = 0.0
    for value in values:
        total += squared(value)
    return total

@kernel
def scaled(values, by):
    return by * summed(values)
"""
CALL = """
import sys
import numpy as np
from quartering._machine import compiled
compiled._LOADED_ALONE = {releases!r}
import kernels
found = [getattr(kernels, name)(np.array([1.0, 2.0, 3.0]), *rest) for name, *rest in {calls!r}]
hits = sum(sum(one.stats.cache_hits.values()) for one in (kernels.squared, kernels.summed, kernels.scaled))
print(*found, hits, "scipy.linalg" in sys.modules)
"""


def called(folder, *calls, releases=_LOADED_ALONE):
    """Values of kernels called in a process of its own, how many were found in the cache, and whether numba could compile."""
    call = [sys.executable, "-c", CALL.format(calls=calls, releases=releases)]
    result = subprocess.run(call, cwd=folder, capture_output=True, text=True, check=True)
    return result.stdout.split()


def test_kept_code_is_loaded_alone_and_links_with_what_is_compiled_later(tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=":")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "kept"))
    (tmp_path / "kernels.py").write_text(KERNELS)
    sum_of_squares = np.square([1.0, 2.0, 3.0]).sum()
    assert called(tmp_path, ("summed",)) == [str(sum_of_squares), "0", "True"]  # compiled
    assert called(tmp_path, ("summed",)) == [str(sum_of_squares), "1", "False"]  # loaded: nothing is linked
    both = called(tmp_path, ("summed",), ("scaled", 2.0))
    assert both == [str(sum_of_squares), str(2 * sum_of_squares), "1", "True"]  # the one compiled of the other, loaded
    assert called(tmp_path, ("scaled", 2.0)) == [str(2 * sum_of_squares), "1", "False"]


def test_kernels_work_where_nothing_can_be_kept(tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=":")
    monkeypatch.setenv("NUMBA_CACHE_DIR", "/dev/null/nowhere")
    (tmp_path / "kernels.py").write_text(KERNELS)
    assert called(tmp_path, ("scaled", 2.0)) == [str(2 * 14.0), "0", "True"]


def test_a_release_of_the_compiler_nobody_has_tried_keeps_its_code_itself(tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=":")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "kept"))
    (tmp_path / "kernels.py").write_text(KERNELS)
    assert called(tmp_path, ("scaled", 2.0), releases=()) == ["28.0", "0", "True"]
    assert called(tmp_path, ("scaled", 2.0), releases=()) == ["28.0", "1", "True"]
    assert called(tmp_path, ("scaled", 2.0)) == ["28.0", "1", "False"]  # and either reads what the other kept
