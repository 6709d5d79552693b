"""Kept machine code of compiled kernels, put into memory without what only a compilation asks for.

Before numba loads kept code it fills its tables of all types and functions that it can compile: two hundred modules,
`scipy.linalg` among them, half a second. And with every kernel it reads the code in the compiler's own language, from which
others would be compiled, a third of the time a kernel takes to load. Code that is compiled already asks for neither: a
compilation fills the tables itself, and reads that code here when it first links with it.
"""

# mypy: disable-error-code="no-untyped-call"
from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

from llvmlite import binding
from numba.core.caching import CompileResultCacheImpl, FunctionCache, NullCache
from numba.core.codegen import JITCodeLibrary
from numba.core.runtime.nrt import rtsys

from quartering._machine.one_compiler import begin, end
from quartering._machine.parts import Part


class _Library(JITCodeLibrary):
    """Machine code, with the code for linking read when it is asked for."""

    _object: bytes = b""
    _bitcode: bytes | None = None
    _linked: Any = None

    @classmethod
    def _unserialize(cls, codegen: Any, state: tuple[str, str, Any]) -> Any:
        name, kind, data = state
        if kind == "bitcode":
            return Part.kept(codegen, name, data)
        made = cls(codegen, name)
        made._object, made._bitcode = data
        made.enable_object_caching()
        made._set_compiled_object(made._object)
        made._finalize_final_module()
        return made

    @property
    def _shared_module(self) -> Any:
        if self._linked is None and self._bitcode is not None:
            self._linked = binding.parse_bitcode(self._bitcode)
            self._codegen._engine._load_defined_symbols(self._linked)
        return self._linked

    @_shared_module.setter
    def _shared_module(self, module: Any) -> None:
        self._linked = module

    def get_pointer_to_function(self, name: str) -> int:
        """Address of a function of this code, 0 where it has none of the name: its table of names is part of it."""
        if self._linked is None and name.encode() in self._object:
            self._codegen._engine._defined_symbols.add(name)
        return int(super().get_pointer_to_function(name))


class _Results(CompileResultCacheImpl):
    """What is kept of a compiled kernel."""

    def reduce(self, result: Any) -> Any:
        """As numba does, but for environments that hold nothing: to make one again loads the module of its function."""
        *rest, environments = super().reduce(result)
        return (*rest, tuple(one for one in environments if one.consts))


class _Kept(FunctionCache):
    """Disk cache of one kernel."""

    _impl_class = _Results


class MachineCode:
    """The disk cache of one kernel, found when the kernel is first called.

    Most kernels are only parts of others, and their own files are never looked for. Without a folder for the cache (read-only
    package, no home) a kernel compiles in every process.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        self._function = function
        self._name = f"{function.__module__}.{function.__qualname__}"

    @cached_property
    def _kept(self) -> Any:
        try:
            return _Kept(self._function)
        except RuntimeError as error:
            if "cannot cache" not in str(error):
                raise
            return NullCache()

    def load_overload(self, signature: Any, target_context: Any) -> Any:
        """Compiled result of a signature, None if none is kept."""
        if isinstance(self._kept, NullCache):
            return None
        rtsys.initialize(target_context)  # the functions that count references, of which kernels take addresses
        found = self._loaded(signature, target_context)
        if found is None:
            begin(self._kept.cache_path, self._name)
            found = self._loaded(signature, target_context)  # another process may have compiled it meanwhile
            if found is not None:
                end(self._kept.cache_path, self._name)
        return found

    def save_overload(self, signature: Any, compiled: Any) -> None:
        """Keep a compiled result; who waits for it may have it."""
        self._kept.save_overload(signature, compiled)
        if not isinstance(self._kept, NullCache):
            end(self._kept.cache_path, self._name)

    def _loaded(self, signature: Any, target_context: Any) -> Any:
        codegen = target_context.codegen()
        before, codegen._library_class = codegen._library_class, _Library
        try:
            with self._kept._guard_against_spurious_io_errors():
                return self._kept._load_overload(signature, target_context)
        finally:
            codegen._library_class = before

    def __getattr__(self, name: str) -> Any:
        """All else a cache can do, as numba does it."""
        return getattr(self._kept, name)
