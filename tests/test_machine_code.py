"""Kept machine code is loaded without the compiler's tables, and links with what is compiled later; parts have none."""

import multiprocessing
import subprocess
import sys

import numpy as np
import pytest

from quartering._machine import one_compiler
from quartering._machine.compiled import _LOADED_ALONE

KERNELS = """
import numpy as np
from quartering._machine.compiled import inner, kernel, maker

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

@maker
def counted(size):
    made = np.empty(size)
    for i in range(size):
        made[i] = i
    return made, made[::2]

@kernel
def of_counted(values, size):
    total = 0.0
    for _ in range(100):
        every, other = counted(size)
        total += squared(every[-1]) + other.sum() + values[0]
    return total

@kernel
def refused(values):
    if values[0] > 0.0:
        raise ValueError("above nought")
    return squared(values[0])
"""
CALL = """
import sys
import numpy as np
from quartering._machine import compiled
compiled._LOADED_ALONE = {releases!r}
import kernels
found = [getattr(kernels, name)(np.array([1.0, 2.0, 3.0]), *rest) for name, *rest in {calls!r}]
every = [one for one in vars(kernels).values() if hasattr(one, "stats")]
hits = sum(sum(one.stats.cache_hits.values()) for one in every)
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


@pytest.fixture
def kernels(tmp_path, monkeypatch):
    """A folder with kernels, and an empty one where they are kept."""
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=":")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "kept"))
    (tmp_path / "kernels.py").write_text(KERNELS)
    return tmp_path


def test_a_part_is_kept_without_machine_code_and_put_into_what_is_compiled_later(kernels):
    assert called(kernels, ("summed",)) == ["14.0", "0", "True"]
    machine = b"\x7fELF" if sys.platform == "linux" else None
    for path in (kernels / "kept").rglob("*.nbc"):
        assert machine is None or (machine in path.read_bytes()) == ("squared" not in path.name), path.name
    # 100 (9^2 + 0 + 2 + 4 + 6 + 8 + 1): `squared` is found, and is in no kernel that was
    assert called(kernels, ("of_counted", 10)) == ["10200.0", "1", "True"]
    assert called(kernels, ("of_counted", 10), ("summed",)) == ["10200.0", "14.0", "2", "False"]


def test_a_refusal_of_a_kernel_is_that_of_the_function_it_was_compiled_from(kernels):
    for _ in ("compiled", "kept"):
        call = [sys.executable, "-c", "import numpy as np, kernels; kernels.refused(np.ones(1))"]
        assert "ValueError: above nought" in subprocess.run(call, cwd=kernels, capture_output=True, text=True).stderr


def test_programs_that_begin_together_compile_a_kernel_once(kernels):
    code = (
        "import numpy as np, kernels; kernels.scaled(np.ones(3), 2.0);"
        " print(sum(sum(one.stats.cache_misses.values()) for one in (kernels.squared, kernels.summed, kernels.scaled)))"
    )
    together = [
        subprocess.Popen([sys.executable, "-c", code], cwd=kernels, stdout=subprocess.PIPE, text=True) for _ in range(3)
    ]
    assert sum(int(one.communicate()[0]) for one in together) == 3


def _mark(folder, marked, enough):
    one_compiler.begin(folder, "kernel")
    marked.set()
    enough.wait()


@pytest.mark.skipif(not one_compiler._MARKS, reason="no marks on this system: every process compiles for itself")
def test_nobody_waits_for_a_kernel_for_ever_and_a_mark_goes_with_its_process(tmp_path, monkeypatch):
    spawn = multiprocessing.get_context("spawn")
    marked, enough = spawn.Event(), spawn.Event()
    other = spawn.Process(target=_mark, args=(str(tmp_path), marked, enough))
    other.start()
    marked.wait()
    waits = []
    monkeypatch.setattr(one_compiler, "_LONGEST", 0.05)
    monkeypatch.setattr(one_compiler.time, "sleep", waits.append)
    one_compiler.begin(str(tmp_path), "another")
    assert not waits
    one_compiler.begin(str(tmp_path), "kernel")
    assert waits
    enough.set()
    other.join()
    waits.clear()
    one_compiler.begin(str(tmp_path), "kernel")
    assert not waits
    one_compiler.end(str(tmp_path), "kernel")
