"""Kernels that are only parts of others: kept as the compiler's own language, and made machine code in the kernels they are in.

The compiler makes of every function it meets a library of its own: with all that the function calls it is optimised as a
whole, made machine code and put into memory, and once more in every function that calls it. Of a kernel ten calls deep the
innermost is so done ten times. But a function without an entry from Python is run in others alone. Here it is only simplified
for itself, and the whole kernel around it, the one that Python calls, is optimised and made machine code once.
"""

# mypy: disable-error-code="no-untyped-call, misc"
from __future__ import annotations

import gc
from typing import Any

from llvmlite import binding
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler
from numba.core.runtime.nrt import rtsys
from numba.core.targetconfig import ConfigStack


class _WithoutEnvironments:
    """What makes code, for a library that is not in memory: it has no place for the address of its environment."""

    def __init__(self, codegen: Any) -> None:
        self._codegen = codegen

    def set_env(self, name: str, environment: Any) -> None:
        """Leave it: a function in memory sets those of its parts."""

    def __getattr__(self, name: str) -> Any:
        return getattr(self._codegen, name)


class Part(JITCodeLibrary):
    """A function of which there is no machine code, with all that it calls."""

    @property
    def codegen(self) -> Any:
        return _WithoutEnvironments(self._codegen)

    def finalize(self) -> None:
        """Put in what it calls, and let it be put into many: the copies are one function."""
        self._raise_if_finalized()
        for library in dict.fromkeys(self._linking_libraries):
            self._reload_init.update(library._reload_init)
            self._final_module.link_in(library._get_module_for_linking(), preserve=True)
        self._finalize_dynamic_globals()
        self._verify_declare_only_symbols()
        for function in self._final_module.functions:
            if not function.is_declaration and function.linkage == binding.Linkage.external:
                function.linkage = "linkonce_odr"
        self._shared_module = self._final_module
        self._finalized = True

    def get_pointer_to_function(self, _name: str) -> int:
        """Address of a function: there is none."""
        self._ensure_finalized()
        return 0

    def serialize_using_object_code(self) -> Any:
        """As it is kept: without machine code."""
        return self.serialize_using_bitcode()

    @classmethod
    def kept(cls, codegen: Any, name: str, bitcode: bytes) -> Part:
        """A part that was kept."""
        made = cls(codegen, name)
        made._final_module = made._shared_module = binding.parse_bitcode(bitcode)
        made._finalized = True
        return made


def _of_the_compiler(codegen: Any, name: str) -> Any:
    """Library of a function of numba itself that a kernel calls, such as that which makes an array."""
    flags = ConfigStack.top_or_none()
    return (Part if flags is not None and flags.no_cpython_wrapper else JITCodeLibrary)(codegen, name)


class InParts(Compiler):
    """Numba's compiler, for which a function without an entry from Python is a part."""

    def define_pipelines(self) -> Any:
        """Its passes, with the library that they fill."""
        made = Part if self.state.flags.no_cpython_wrapper else JITCodeLibrary
        self.state.library = made(self.state.targetctx.codegen(), self.state.func_id.func_qualname)
        self.state.library.enable_object_caching()
        return super().define_pipelines()

    def _compile_core(self) -> Any:
        rtsys.initialize(self.state.targetctx)  # whose functions are no parts
        codegen = self.state.targetctx.codegen()
        before, codegen._library_class = codegen._library_class, _of_the_compiler
        collects = gc.isenabled()
        gc.disable()  # there is much to look through and little to find: a tenth of the time
        try:
            return super()._compile_core()
        finally:
            codegen._library_class = before
            if collects:
                gc.enable()
