"""The two kinds of compiled function: those Python calls, and those only other compiled functions call.

Both are cached on disk and release the interpreter lock. The second kind has no entry from Python, which saves a good part of
its compilation.
"""

from __future__ import annotations

from typing import Any

import numba

_compile: Any = numba.njit  # its stubs do not know every option

kernel: Any = _compile(cache=True, nogil=True)
inner: Any = _compile(cache=True, nogil=True, no_cpython_wrapper=True, no_cfunc_wrapper=True)
