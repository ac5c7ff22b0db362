"""Numba in the place of symgen's own compiler: ``SYMGEN_COMPILER=numba``.

Emitted functions, loops and their parts stay the objects that they are; what Numba makes of them stands behind their
calls. Numba compiles in every process anew, as its cache does not know functions without a file.

Loops with events are many functions that pass records with 200 arrays. By default Numba copies the text of a callee
into each of its callers, wraps each function for Python, and counts references to every array: a run with modes
had not ended after 420 s. Here each function is compiled once and called by its name, only those that Python calls are
wrapped, and nothing is counted, as the arrays of a run are Python's and outlive all calls.
"""

from __future__ import annotations

import functools
import operator
from collections.abc import Callable, Sequence
from types import ModuleType, SimpleNamespace
from typing import TYPE_CHECKING, Any

import llvmlite.binding as llvm
import numba
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder, StateDict
from numba.core.compiler_machinery import AnalysisPass, register_pass
from numba.core.typed_passes import IRLegalization
from numba.core.types import Dispatcher
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.experimental.function_type import _get_jit_address

from symgen.compile.native import types
from symgen.compile.store.stats import CompilationClock

if TYPE_CHECKING:
    from symgen.compile.store.jit import MachineFunction

#: Level of LLVM's optimisation. At level 3 compilation of a loop takes longer than any run saves.
_LEVEL = 1


def numba_type(kind: types.Kind) -> Any:
    """Return a type as Numba's."""
    if isinstance(kind, types.NumberType):
        return getattr(numba.types, kind.name)
    if isinstance(kind, types.ArrayType):
        return numba.types.Array(numba_type(kind.dtype), kind.ndim, "C")
    if isinstance(kind, types.FunctionType):
        return numba.types.FunctionType(numba_signature(kind.signature))
    return numba.types.BaseTuple.from_types(tuple(map(numba_type, kind)), kind.constructor if kind.fields else None)


def numba_signature(signature: types.Signature) -> Any:
    """Return a signature in Numba's types."""
    return numba_type(signature.result)(*map(numba_type, signature.arguments))


class OwnLibrary(JITCodeLibrary):  # type: ignore[misc]  # Numba has no types
    """Machine code of one function, which calls others by their names."""

    def add_linking_library(self, library: object) -> None:
        """Copy what Numba itself has for operations; callees of the runtime are in memory before."""
        if isinstance(library, OwnLibrary):
            library._ensure_finalized()
        else:
            super().add_linking_library(library)

    def _optimize_functions(self, ll_module: llvm.ModuleRef) -> None:
        ll_module.data_layout = self._codegen._data_layout  # passes over the module follow, once

    def _optimize_final_module(self) -> None:
        passes, builder = self._codegen._module_pass_manager(opt=_LEVEL, loop_vectorize=False, slp_vectorize=False)
        passes.run(self._final_module, builder)


@register_pass(mutates_CFG=False, analysis_only=True)
class KeepApart(AnalysisPass):  # type: ignore[misc]  # Numba has no types
    """Has a function compiled into a library of its own, without counts of references."""

    _name = "keep_apart"

    def __init__(self) -> None:
        super().__init__()

    def run_pass(self, state: StateDict) -> bool:
        """Choose how a function is compiled, after its types are known."""
        state.targetctx = state.targetctx.subtarget(enable_nrt=False)
        if not state.flags.forceinline:
            state.library = OwnLibrary(state.targetctx.codegen(), state.func_id.func_qualname)
        return False


class CompilerOfRuns(CompilerBase):  # type: ignore[misc]  # Numba has no types
    """Numba's compiler with `KeepApart`."""

    def define_pipelines(self) -> list[Any]:
        """Return the passes."""
        passes = DefaultPassBuilder.define_nopython_pipeline(self.state)
        passes.add_pass_after(KeepApart, IRLegalization)
        passes.finalize()
        return [passes]


@infer_global(operator.add)
class SumOfRecords(AbstractTemplate):  # type: ignore[misc]  # Numba has no types
    """Type of a sum of tuples, as in ``(*record, x)``: Numba adds tuples without names alone."""

    def generic(self, arguments: tuple[Any, ...], keywords: object) -> Any:
        """Return the types of the sum, None where a number is added."""
        tuples = numba.types.BaseTuple
        if not all(isinstance(x, tuples) for x in arguments):
            return None
        return signature(tuples.from_types(tuple(kind for x in arguments for kind in x)), *arguments)


@functools.cache
def dispatcher(
    function: Callable[..., Any],
    contracted: bool = True,
    wrapped: bool = True,
    inlined: bool = False,
    own: types.Signature | None = None,
) -> Any:
    """Return Numba's form of a plain function; with a signature of its own it is compiled at once."""
    with CompilationClock():
        return numba.njit(
            *([] if own is None else [numba_signature(own)]),
            nogil=True,
            error_model="numpy",
            fastmath={"contract"} if contracted else False,
            forceinline=inlined,
            no_cpython_wrapper=not wrapped,
            no_cfunc_wrapper=not wrapped,
            pipeline_class=CompilerOfRuns,
        )(function)


def form_of(function: MachineFunction) -> Any:
    """Return Numba's form of a function of the runtime or of an emitted module.

    A loop has the types of its signature, so that all models share its machine code, unless a record with names holds a
    function: Numba takes such a one by its own type only, and compiles the loop for each.
    """
    own = getattr(function, "signature", None)
    if own is not None and any(map(_names_a_function, own.arguments)):
        own = None
    return dispatcher(function.py_func, function.contracted, own=own)


def _names_a_function(kind: types.Kind) -> bool:
    parts = list(kind) if isinstance(kind, types.RecordType) and kind.fields else []
    return any(isinstance(part, types.FunctionType) or _names_a_function(part) for part in parts)


def argument(value: object) -> Any:
    """Return an argument as Numba's functions take it: functions, also those in records, as Numba's own."""
    from symgen.compile.store.jit import MachineFunction

    if isinstance(value, tuple):
        parts = tuple(map(argument, value))
        return type(value)(*parts) if hasattr(value, "_fields") else parts
    # an argument is compiled for the type of its parameter, which one with a signature of its own does not allow
    if isinstance(value, MachineFunction):
        return dispatcher(value.py_func, value.contracted)
    return value


def call_by_numba(function: MachineFunction, *arguments: object) -> Any:
    """Call Numba's form of a function."""
    return form_of(function)(*map(argument, arguments))


def address_by_numba(function: MachineFunction, signature: types.Signature) -> int:
    """Return the address of Numba's machine code, for calls from other code of Numba."""
    return int(_get_jit_address(form_of(function), numba_signature(signature)))


def type_in_callers(function: MachineFunction) -> Any:
    """Return the type of a function where compiled code names it."""
    return Dispatcher(dispatcher(function.py_func, function.contracted, wrapped=False))


def type_of_plain(function: Callable[..., Any]) -> Any:
    """Return the type of a plain function where compiled code names it, copied into its callers."""
    return Dispatcher(dispatcher(function, wrapped=False, inlined=True))


def library(module: ModuleType, names: Sequence[str], decorator: object) -> Any:
    """Return what an emitted module imports from Numba, with symgen's decorator in the place of ``njit``."""
    return SimpleNamespace(**{name: decorator if name == "njit" else getattr(module, name) for name in names})
