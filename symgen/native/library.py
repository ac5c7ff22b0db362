"""Functions in machine code as results of a compilation, as Numba's dispatchers, loops and callers ask for them."""

from __future__ import annotations

import ctypes
import types as python
from collections.abc import Callable
from functools import cached_property
from typing import TYPE_CHECKING, Any, cast

import llvmlite.binding as llvm
import numpy as np
from numba.core import types
from numba.core.compiler import compile_result
from numba.core.compiler_lock import global_compiler_lock
from numba.core.environment import Environment
from numba.core.funcdesc import PythonFunctionDescriptor
from numba.core.registry import cpu_target
from numba.core.runtime import rtsys
from numba.core.typing import signature

from symgen.errors import SimulationError
from symgen.native.machine import codegen, compiled
from symgen.native.trampoline import FIRST, FUNCTION, RESULT, numbers, slots, trampoline

if TYPE_CHECKING:  # what compiles is not loaded by runs that find everything in the cache
    from symgen.native.language import Function, Scalar
    from symgen.native.read import Kind

_NUMBERS: dict[Scalar, Any] = {"float": types.float64, "int": types.int64, "unsigned": types.uint32}
_CTYPES: dict[Any, Any] = {types.float64: ctypes.c_double, types.int64: ctypes.c_int64, types.uint32: ctypes.c_uint32}
_KINDS: dict[Any, Kind] = {number: (kind, False) for kind, number in _NUMBERS.items()}
_KINDS |= {types.Array(number, 1, "C"): (kind, True) for kind, number in _NUMBERS.items()}


def kinds_of(arguments: tuple[Any, ...]) -> tuple[Kind, ...] | None:
    """Return arguments of Numba's types as types of the language, None where it has no such type."""
    kinds = tuple(_KINDS.get(argument) for argument in arguments)
    return None if None in kinds else kinds  # type: ignore[return-value]  # none of them is None


def arguments_of(kinds: tuple[Kind, ...]) -> tuple[Any, ...]:
    """Return arguments of types of the language as Numba's types."""
    return tuple(types.Array(_NUMBERS[kind], 1, "C") if array else _NUMBERS[kind] for kind, array in kinds)


def kinds_of_function(function: Function) -> tuple[Kind, ...]:
    """Return the types of the arguments of a function."""
    return tuple((p.type, p.array) for p in function.parameters)


class Library:
    """Machine code in memory.

    Parameters
    ----------
    addresses : dict of str to int
        Where its functions stand.
    linkable : Callable
        Gives the text of a module with the function and all that it calls, for callers that Numba compiles.
    made : Callable
        Gives the object file of a module in LLVM's language with the function of a name: of what calls a function with
        arguments from a block.
    """

    has_dynamic_globals = False
    _reload_init: frozenset[Any] = frozenset()

    def __init__(
        self,
        addresses: dict[str, int],
        linkable: Callable[[], str],
        made: Callable[[str, str], bytes] = compiled,
    ) -> None:
        self._addresses, self._linkable, self.made = addresses, linkable, made

    def get_pointer_to_function(self, name: str) -> int:
        """Return the address of a function, 0 where there is none of the name."""
        return self._addresses.get(name, 0)

    def _ensure_finalized(self) -> None:
        """Nothing is left to be done."""

    def _get_module_for_linking(self) -> Any:
        """Return a module that callers become one with."""
        module = llvm.parse_assembly(self._linkable())
        module.triple, module.data_layout = codegen()._llvm_module.triple, codegen()._data_layout
        return module


#: Calls from Python after which a wrapper is compiled: that takes as long as some thousands of them.
MANY_CALLS = 2000


class FromPython:
    """Calls of a function from Python: by its address, and by a compiled wrapper once there are many."""

    def __init__(self, keep: Callable[[Any], None]) -> None:
        self._keep = keep
        self._wrapper: Any = None
        self._calls = 0
        self.result: Any = None

    def __call__(self, *arguments: Any) -> Any:
        """Call the function; after many calls have the dispatcher call a wrapper itself from then on."""
        if self._wrapper is None:
            self._calls += 1
            if self._calls <= MANY_CALLS:
                return self._direct(*arguments)
            with global_compiler_lock:
                if self._wrapper is None:
                    self._wrapper = self.wrapper()  # the dispatcher holds no reference
                    self._keep(self._wrapper)
        return self._wrapper(*arguments)

    def wrapper(self, release_gil: bool = False) -> Any:
        """Return a compiled wrapper, which may let other threads run meanwhile."""
        return _wrapper(self.result, release_gil)

    @cached_property
    def _direct(self) -> Callable[..., Any]:
        """The function behind its address: (result, exception, arguments), an array as seven numbers."""
        expected, returned = self.result.signature.args, self.result.signature.return_type
        if kinds_of(expected) is None:
            return self._by_block()
        kinds: list[Any] = [ctypes.c_void_p, ctypes.c_void_p]
        for kind in expected:
            if isinstance(kind, types.Array):
                kinds += [ctypes.c_void_p] * 2 + [ctypes.c_int64] * 2 + [ctypes.c_void_p] + [ctypes.c_int64] * 2
            else:
                kinds.append(_CTYPES[kind])
        address = self.result.library.get_pointer_to_function(self.result.fndesc.llvm_func_name)
        function = ctypes.CFUNCTYPE(ctypes.c_int32, *kinds)(address)

        def call(*arguments: Any) -> Any:
            found, exception, flat = _CTYPES[returned](), ctypes.c_void_p(), list[Any]()
            for kind, value in zip(expected, arguments, strict=True):
                if isinstance(kind, types.Array):
                    flat += [None, None, value.size, value.itemsize, value.ctypes.data, value.size, value.itemsize]
                else:
                    flat.append(value)
            function(ctypes.addressof(found), ctypes.addressof(exception), *flat)  # emitted code raises nothing
            return found.value

        return call

    def _by_block(self) -> Callable[..., Any]:
        """Return the function behind its address, on arguments that are laid out in memory at every call."""
        found = self.result
        expected, returned = found.signature.args, found.signature.return_type
        call = trampoline(returned, expected, found.library.made)
        if call is None:  # Numba is not as expected
            return cast("Callable[..., Any]", self.wrapper(release_gil=True))
        address = found.library.get_pointer_to_function(found.fndesc.llvm_func_name)

        def enter(*arguments: Any) -> Any:
            if len(arguments) != len(expected):
                raise TypeError(f"{len(expected)} arguments, not {len(arguments)}")
            block: Any = np.zeros(FIRST + sum(1 for kind in expected for _ in slots(kind)), dtype=np.int64)
            floats, at = block.view(np.float64), FIRST
            block[FUNCTION] = address
            for kind, argument in zip(expected, arguments, strict=True):
                for value in numbers(kind, argument):
                    (floats if isinstance(value, float) else block)[at] = value
                    at += 1
            if call(block.ctypes.data) != 0:
                raise SimulationError("compiled code has raised an exception")
            return float(floats[RESULT]) if returned is types.float64 else int(block[RESULT])

        return enter


def result(
    function: python.FunctionType,
    arguments: tuple[Any, ...],
    returned: Scalar,
    symbol: str,
    library: Library,
    keep: Callable[[Any], None],
    known: bool = False,
) -> Any:
    """Return what Numba's compiler would give for a function.

    Parameters
    ----------
    function : function
        The Python function.
    arguments : tuple
        Numba's types of its arguments.
    returned : {"float", "int"}
        Type of its result.
    symbol : str
        Its name in machine code.
    library : Library
        Where it stands.
    keep : Callable
        Takes the wrapper for calls from Python once it is made.
    known : bool
        Whether Numba is told elsewhere that the function is there.
    """
    description = PythonFunctionDescriptor(
        native=True,
        modname=function.__module__,
        qualname=function.__qualname__,
        unique_name=symbol,
        doc="",
        typemap=None,
        restype=_NUMBERS[returned],
        calltypes=None,
        args=function.__code__.co_varnames[: function.__code__.co_argcount],
        kws=(),
        mangler=lambda name, types, abi_tags=(), uid=None: symbol,
        argtypes=arguments,
        env_name=f"environment.{symbol}",
    )
    entry = FromPython(keep)
    context = cpu_target.target_context
    entry.result = compile_result(
        typing_context=cpu_target.typing_context,
        target_context=context,
        entry_point=entry,
        signature=signature(_NUMBERS[returned], *arguments),
        objectmode=False,
        lifted=(),
        fndesc=description,
        library=library,
    )
    if not known:
        context.insert_user_function(entry, description, [library])
    return entry.result


def _wrapper(result: Any, release_gil: bool) -> Any:
    """Return a function in machine code as one of Python."""
    description = result.fndesc
    result.target_context.refresh()
    environment = Environment.from_fndesc(description)
    context = result.target_context.subtarget(environment=environment, fndesc=description)
    library = context.codegen().create_library(f"{description.unique_name}.python")
    library.add_linking_library(rtsys.library)
    context.create_cpython_wrapper(library, description, environment, None, release_gil)
    return context.get_executable(library, description, environment)
