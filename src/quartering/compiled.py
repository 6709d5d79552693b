"""The two kinds of compiled function: those Python calls, and those only other compiled functions call.

Both are cached on disk and release the interpreter lock. The second kind has no entry from Python, which saves a good part of
its compilation.
"""

from __future__ import annotations

from numba import njit

kernel = njit(cache=True, nogil=True)
inner = njit(cache=True, nogil=True, no_cpython_wrapper=True, no_cfunc_wrapper=True)
