"""The kinds of compiled function: those Python calls, and those only other compiled functions call.

All are cached on disk, where a folder can be written, and release the interpreter lock. The second kind has no entry from
Python, and no machine code of its own (`parts`), which saves most of its compilation; nor does it count references, so that it
may neither make arrays nor return them. The third is the second for those that make arrays. The fourth is for the conditions of
a batch, in the vectors of `simd`: of the second kind, without checks of division, with multiply-add in one rounding, put into
its callers as machine code. The fifth is put into its callers before they are compiled. The sixth is of the first kind, for
long sums: it may take their terms several at a time, in one order for every condition.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numba

from quartering._machine.machine_code import MachineCode
from quartering._machine.parts import InParts

_njit: Any = numba.njit  # its stubs do not know every option


_LOADED_ALONE = ((0, 68),)
"""Releases of numba that `MachineCode` and `InParts` are tested with. With every other kernels are compiled, kept and loaded as
numba itself does: the same numbers, half a second later, and after a first compilation of twice the time."""


def _kind(**options: Any) -> Callable[[Callable[..., Any]], Any]:
    """Decorator of one kind; without a folder for the cache (read-only package, no home) it compiles in every process."""

    def compiled(function: Callable[..., Any]) -> Any:
        if numba.version_info.short in _LOADED_ALONE:
            made = _njit(nogil=True, pipeline_class=InParts, **options)(function)
            made._cache = MachineCode(function)
            return made
        made = _njit(nogil=True, **options)(function)
        try:
            made.enable_caching()
        except RuntimeError as error:
            if "cannot cache" not in str(error):
                raise
        return made

    return compiled


kernel: Any = _kind()
inner: Any = _kind(no_cpython_wrapper=True, no_cfunc_wrapper=True, _nrt=False)
maker: Any = _kind(no_cpython_wrapper=True, no_cfunc_wrapper=True, _nrt=True)
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
