"""The word about compilation: said on a cold cache, once, and not on a warm one."""

import os
import subprocess
import sys

import pytest

import quartering as qt
import quartering._machine.compiled
from quartering.stability.precompile import NOTICE, compile_ahead, compiled


def test_compilation_is_announced_once_and_only_when_the_cache_is_cold(tmp_path):
    """A fresh cache folder has nothing in it, whatever this machine has compiled before."""
    code = (
        "from quartering.stability.precompile import announce_compilation, compiled; print(compiled());"
        " announce_compilation(); announce_compilation()"
    )
    cold = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], env=os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)},
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert cold.stdout.strip() == "False"
    assert cold.stderr.strip() == NOTICE
    qt.polar(qt.ship("wigley"), qt.Wave(100.0, 1.0), [5.0], [60.0])
    compile_ahead()
    assert compiled("map")
    assert compiled("verdict")


def test_kernels_run_where_no_folder_for_them_can_be_written(monkeypatch):
    """The compiler refuses to cache then, in these words; anything else it refuses is passed on."""

    def njit(cache=False, **_):
        def compiler(function):
            if cache:
                raise RuntimeError("cannot cache function 'double': no locator available for file 'kernels.py'")
            return function

        return compiler

    monkeypatch.setattr(quartering._machine.compiled, "_njit", njit)
    assert quartering._machine.compiled._kind()(lambda x: 2 * x)(3.0) == 6.0
    monkeypatch.setattr(
        quartering._machine.compiled, "_njit", lambda **_: lambda _: (_ for _ in ()).throw(RuntimeError("other"))
    )
    with pytest.raises(RuntimeError, match="other"):
        quartering._machine.compiled._kind()(lambda x: x)
