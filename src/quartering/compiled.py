"""The kinds of compiled function: those Python calls, and those only other compiled functions call.

All are cached on disk and release the interpreter lock. The second kind has no entry from Python, which saves a good part of
its compilation. The third is of the second kind and made for loops over conditions abreast: without checks of division, and
with multiply-add in one rounding, its loops become vector instructions.
"""

from __future__ import annotations

from typing import Any

import numba

_compile: Any = numba.njit  # its stubs do not know every option

kernel: Any = _compile(cache=True, nogil=True)
inner: Any = _compile(cache=True, nogil=True, no_cpython_wrapper=True, no_cfunc_wrapper=True)
abreast: Any = _compile(
    cache=True, nogil=True, no_cpython_wrapper=True, no_cfunc_wrapper=True, error_model="numpy", fastmath={"contract"}
)
