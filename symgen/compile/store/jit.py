"""Functions compiled from their source at the first call, in a cache that survives crashes.

`jit` compiles functions of the runtime, which take records of arrays, numbers and functions;
`symgen.compile.store.emitted` compiles those of emitted modules. An entry of the cache is one self-checking file for
each function and types of its arguments. Its key holds everything that machine code depends on: the sources, the types,
the processor, and the version of llvmlite.
"""

from __future__ import annotations

import ast
import functools
import marshal
import sys
from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple, TypeGuard, TypeVar, cast

import llvmlite

from symgen.base.errors import InputError
from symgen.base.memory import without_garbage_collection
from symgen.compile.native import types
from symgen.compile.native.annotations import signature_from
from symgen.compile.native.calls import argument_type, lockless_caller
from symgen.compile.native.compiler import is_by_numba, is_interpreted, selected_compiler
from symgen.compile.native.machine import load_machine_code, lock, processor_features
from symgen.compile.store.entries import get_or_make_data, plain_name
from symgen.compile.store.identity import combined_digest
from symgen.compile.store.sources import COMPILER, reached_digest, source_stamp
from symgen.compile.store.stats import CompilationClock
from symgen.compile.store.upkeep import NATIVE

if TYPE_CHECKING:
    from symgen.compile.native.read import Kind
from symgen.compile.store.function_source import lines_when_loaded, syntax_tree

__all__ = ["CacheEntry", "MachineFunction", "RuntimeFunction", "jit", "object_file"]

_Function = TypeVar("_Function", bound=Callable[..., Any])
_FORMAT = "3"
#: Types of the arguments of a function.
Arguments = tuple[types.Kind, ...]
_NUMBERS = {"float": types.float64, "int": types.int64, "bool": types.boolean}


class CacheEntry(NamedTuple):
    """Machine code in the cache: type of the result, callees with types of their arguments, object file."""

    returned: str
    called: tuple[tuple[str, tuple[Kind, ...]], ...]
    code: bytes


class MachineCode(NamedTuple):
    """Machine code in memory."""

    address: int
    signature: types.Signature


class MachineFunction(ABC):
    """A function whose machine code is made when it is called, or its address requested.

    Parameters
    ----------
    function : function
        The Python function.
    inlined : bool
        Whether compiled callers have its statements instead of a call.
    contracted : bool
        Whether multiplication and addition may be fused.

    Attributes
    ----------
    py_func : function
        The Python function.
    """

    __name__: str
    __qualname__: str

    def __init__(self, function: Any, inlined: bool = False, contracted: bool = True) -> None:
        self.py_func, self.inlined, self.contracted = function, inlined, contracted
        functools.update_wrapper(self, function, updated=())
        self._codes = dict[Arguments, MachineCode]()
        self._latest: tuple[types.Signature, int] | None = None
        self._callers = dict[Arguments, Callable[..., Any]]()

    @abstractmethod
    def tree(self) -> ast.FunctionDef | None:
        """Return the syntax tree of the function, None where its source is not available."""

    @abstractmethod
    def identity(self) -> str:
        """Return the sources and options that machine code depends on."""

    @abstractmethod
    def compiled_entry(self, arguments: Arguments, symbol: str) -> CacheEntry:
        """Return machine code, made from the source.

        Raises
        ------
        Foreign
            If the function is outside the language.
        """

    def code(self, arguments: Arguments) -> MachineCode:
        """Return the machine code for arguments of some types.

        Raises
        ------
        InputError
            If the function is outside the language.
        """
        found = self._codes.get(arguments)  # types of large records are hashed at each look
        if found is None:
            with lock:
                found = self._codes.get(arguments)
                if found is None:
                    found = self._codes[arguments] = self._load_code(arguments)
        return found

    def address(self, signature: types.Signature) -> int:
        """Return the address of the machine code."""
        # callers ask with the same object again and again, whose types take long to hash
        latest = self._latest
        if latest is None or latest[0] is not signature:
            if is_by_numba():
                from symgen.compile.store.numba_route import address_by_numba

                return address_by_numba(self, signature)
            latest = self._latest = signature, self.code(signature.arguments).address
        return latest[1]

    def caller(self, arguments: Arguments) -> Callable[..., Any]:
        """Return a function that calls the machine code with arguments of some types."""
        if is_by_numba():
            from symgen.compile.store.numba_route import call_by_numba

            return functools.partial(call_by_numba, self)
        if arguments not in self._callers:
            self._callers[arguments] = lockless_caller(*self.code(arguments))
        return self._callers[arguments]

    def __call__(self, *arguments: object) -> Any:
        """Call the machine code for the types of the arguments."""
        return self.caller(() if is_by_numba() else tuple(map(argument_type, arguments)))(*arguments)

    @property
    def _numba_type_(self) -> Any:
        """Type of the function where code compiled by Numba names it."""
        from symgen.compile.store.numba_route import type_in_callers

        return type_in_callers(self)

    def __reduce__(self) -> str:
        return str(self.__qualname__)  # pickled by name, as functions are: another process compiles or loads its own

    def key(self, arguments: Arguments) -> str:
        """Return the key of the machine code for arguments of some types, with all that it depends on."""
        return "\n".join(
            (
                self.identity(),
                repr(arguments),
                processor_features(),
                _digest_of_environment(),
                reached_digest(*COMPILER),
            )
        )

    def symbol(self, arguments: Arguments) -> str:
        """Return the name in machine code, with a digest of all that the machine code depends on."""
        return self._symbol(self.key(arguments))

    def _symbol(self, key: str) -> str:
        name = f"{self.__name__}_{combined_digest(key)[:32]}"
        return f"_ZN6symgen{len(name)}{name}E"  # as of a function in a namespace

    def callee(self, name: str) -> MachineFunction:
        """Return the function in memory that the name of a callee means."""
        function: MachineFunction = self.py_func.__globals__[name]
        return function

    def _load_code(self, arguments: Arguments) -> MachineCode:
        """Put machine code into memory, from the cache or made anew, after its callees."""
        key = self.key(arguments)
        symbol = self._symbol(key)
        with CompilationClock() as clock:
            clock.loaded = True

            def make_code() -> bytes:
                clock.loaded = False
                return marshal.dumps(tuple(self._compile(arguments, symbol)))

            place = f"{NATIVE}/{plain_name(self.__module__, 100)}"
            entry = CacheEntry(*marshal.loads(get_or_make_data(place, self.__qualname__, key, make_code)))
            for name, kinds in entry.called:
                self.callee(name).code(numba_arguments(kinds))
            address = load_machine_code(entry.code, symbol)
        if not clock.loaded and selected_compiler() == "explain":
            print(f"{self.__module__}.{self.__name__} compiled in {clock.seconds:.3f} s", file=sys.stderr)
        return MachineCode(address, types.Signature(_NUMBERS[entry.returned], arguments))

    def _compile(self, arguments: Arguments, symbol: str) -> CacheEntry:
        from symgen.compile.native.read import Foreign

        try:
            with without_garbage_collection():
                return self.compiled_entry(arguments, symbol)
        except Foreign as foreign:
            own = f"the function '{self.__module__}.{self.__name__}'"
            raise InputError(own, "the language of compiled functions", str(foreign)) from foreign


class RuntimeFunction(MachineFunction):
    """A function of the runtime: a loop, or a part that loops call.

    Parameters
    ----------
    function, inlined, contracted
        As for `MachineFunction`.
    signature : Signature, optional
        Types of a loop; by default those of the arguments of a call.
    entry : bool
        Whether it is a loop with the types of its annotations.
    once : bool
        Whether it is called about once a run: then it is compiled without optimisation; its bits are the same
        unless operations are contracted.
    unrolled : bool
        As for `jit`.
    """

    def __init__(
        self,
        function: object,
        inlined: bool = False,
        contracted: bool = True,
        signature: types.Signature | None = None,
        entry: bool = False,
        once: bool = False,
        unrolled: bool = False,
    ) -> None:
        super().__init__(function, inlined, contracted)
        self._signature, self._entry, self._once, self.unrolled = signature, entry, once, unrolled

    @functools.cached_property
    def signature(self) -> types.Signature | None:
        """Types of a loop, None of a part."""
        return signature_from(self.py_func) if self._entry else self._signature

    def __call__(self, *arguments: object) -> Any:
        """Call the machine code."""
        if self.signature is None:
            return super().__call__(*arguments)
        return self.entry(*arguments)

    @functools.cached_property
    def entry(self) -> Callable[..., Any]:
        """The machine code of a loop, called with arguments of its signature."""
        assert self.signature is not None, "a loop has a signature"
        return self.caller(self.signature.arguments)

    def tree(self) -> ast.FunctionDef | None:
        """Return the syntax tree of the function, None where its source is not available."""
        return syntax_tree(lines_when_loaded(self.py_func.__code__.co_filename), self.py_func)

    def identity(self) -> str:
        """Return the sources and options that machine code depends on."""
        function = self.py_func
        meanings = (
            f"{name} {_identity_of_global(function.__globals__.get(name))}" for name in function.__code__.co_names
        )
        options = f"{self.contracted} {self._once} {self.unrolled}"
        return "\n".join((f"{self.__module__}.{self.__qualname__}", options, *meanings, source_stamp(function)))

    def compiled_entry(self, arguments: Arguments, symbol: str) -> CacheEntry:
        """Return machine code, made from the source."""
        from symgen.compile.native.llvm import loop_module
        from symgen.compile.native.loops import read_loop
        from symgen.compile.native.machine import compile_module

        function = read_loop(self, arguments)
        code = compile_module(loop_module(function, symbol), symbol, once=self._once)
        return CacheEntry(function.returned, (), code)


def jit(
    signature: types.Signature | None = None,
    *,
    entry: bool = False,
    once: bool = False,
    contracted: bool = True,
    unrolled: bool = False,
) -> Callable[[_Function], _Function]:
    """Return a decorator that compiles a function of the runtime at its first call, through the cache.

    Parameters
    ----------
    signature : Signature, optional
        Types of a loop, which is called from Python; None for a function that loops call.
    entry : bool
        Whether it is a loop with the types of its annotations.
    once : bool
        Whether the function is called about once a run: then it is compiled faster.
    contracted : bool
        Whether multiplication and addition may be fused.
    unrolled : bool
        Whether its loops run over the entries of a matrix, so that copies of their bodies pay.

    Returns
    -------
    callable
        Returns a `RuntimeFunction`, or the plain function under ``NUMBA_DISABLE_JIT=1``.

    Examples
    --------
    >>> from symgen.compile.native.types import float64
    >>> from symgen.compile.store.jit import jit
    >>> @jit(float64(float64))
    ... def double(x):
    ...     return 2.0 * x
    >>> double(2)
    4.0
    """

    def decorate_function(function: _Function) -> _Function:
        if is_interpreted():
            return function
        compiled: Any = RuntimeFunction(
            function, contracted=contracted, signature=signature, entry=entry, once=once, unrolled=unrolled
        )
        return cast("_Function", compiled)

    return decorate_function


def object_file(text: str, symbol: str) -> bytes:
    """Return the object file of a module in LLVM's language, from the cache or made anew.

    Parameters
    ----------
    text : str
        The module, with everything that matters on this processor.
    symbol : str
        Its function.
    """
    from symgen.compile.native.machine import compile_module

    key = "\n".join((text, processor_features(), _digest_of_environment()))
    place = f"{NATIVE}/{plain_name(symbol.rpartition('.')[0], 100)}"
    return get_or_make_data(place, symbol, key, lambda: compile_module(text, symbol))


def numba_arguments(kinds: tuple[Kind, ...]) -> Arguments:
    """Return the types of compiled functions for types of arguments in the language of emitted functions."""
    numbers = {**_NUMBERS, "unsigned": types.uint32}
    return tuple(types.ArrayType(numbers[kind], 1) if array else numbers[kind] for kind, array in kinds)


def argument_types(arguments: Arguments) -> tuple[Kind, ...]:
    """Return types of arguments in the language of emitted functions.

    Raises
    ------
    InputError
        If the language has no such type.
    """
    names: dict[Any, Any] = {number: name for name, number in _NUMBERS.items()} | {types.uint32: "unsigned"}
    try:
        return tuple((names[x.dtype], True) if _is_flat(x) else (names[x], False) for x in arguments)
    except KeyError:
        expected = "numbers and arrays of one dimension"
        raise InputError("arguments of an emitted function", expected, repr(arguments)) from None


def _is_flat(kind: types.Kind) -> TypeGuard[types.ArrayType]:
    return isinstance(kind, types.ArrayType) and kind.ndim == 1


@functools.cache
def _digest_of_environment() -> str:
    """Return all dependencies of machine code outside a function, apart from the processor."""
    return "\n".join((_FORMAT, llvmlite.__version__))


def _identity_of_global(value: object) -> str:
    """Return the meaning of a global name: the identity of a function, or the number."""
    function = getattr(value, "py_func", value)
    if hasattr(function, "__qualname__"):
        return f"{function.__module__}.{function.__qualname__}"
    return repr(value) if value is None or isinstance(value, int | float | str) else ""
