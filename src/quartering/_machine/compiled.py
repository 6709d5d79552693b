"""The kinds of compiled function: those Python calls, and those only other compiled functions call.

All are cached on disk, where a folder can be written, and release the interpreter lock. The second kind has no entry from
Python, which saves a good part of its compilation. The third is for the conditions of a batch, in the vectors of `simd`: of the
second kind, without checks of division, with multiply-add in one rounding, put into its callers as machine code, and without
counts of references, so that it may not make arrays: its callers do. The fourth is put into its callers before they are
compiled. The fifth is of the first kind, for long sums: it may take their terms several at a time, in one order for every
condition.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

import numba
from numba.core.caching import FunctionCache, NullCache
from numba.core.runtime.nrt import rtsys

_njit: Any = numba.njit  # its stubs do not know every option


class _MachineCode:
    """The disk cache of one kernel, found when the kernel is first called, and put into memory without the compiler's tables.

    Before numba loads kept code, it fills its tables of all types and functions that it can compile: two hundred modules,
    `scipy.linalg` among them, half a second. Code that is compiled already asks for none of them, and a compilation fills
    them itself. Most kernels are only parts of others, and their own files are never looked for. Without a folder for the
    cache (read-only package, no home) a kernel compiles in every process.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        self._function = function

    @cached_property
    def _kept(self) -> Any:
        try:
            return FunctionCache(self._function)  # type: ignore[no-untyped-call]
        except RuntimeError as error:
            if "cannot cache" not in str(error):
                raise
            return NullCache()

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Compiled result of a signature, None if none is kept."""
        if isinstance(self._kept, NullCache):
            return None
        rtsys.initialize(target_context)  # the functions that count references, of which kernels take addresses
        with self._kept._guard_against_spurious_io_errors():
            return self._kept._load_overload(sig, target_context)

    def __getattr__(self, name: str) -> Any:
        """All else a cache can do, as numba does it."""
        return getattr(self._kept, name)


def _kind(**options: Any) -> Callable[[Callable[..., Any]], Any]:
    """Decorator of one kind."""

    def compiled(function: Callable[..., Any]) -> Any:
        made = _njit(nogil=True, **options)(function)
        made._cache = _MachineCode(function)
        return made

    return compiled


kernel: Any = _kind()
inner: Any = _kind(no_cpython_wrapper=True, no_cfunc_wrapper=True)
batch_kernel: Any = _kind(
    no_cpython_wrapper=True,
    no_cfunc_wrapper=True,
    error_model="numpy",
    fastmath={"contract"},
    forceinline=True,
    _nrt=False,
)
inlined: Any = _kind(inline="always")
summing: Any = _kind(error_model="numpy", fastmath={"contract", "reassoc"})
