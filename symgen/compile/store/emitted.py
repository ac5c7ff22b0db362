"""Functions of emitted modules, compiled from their text.

An emitted module is one that Numba could compile: it imports ``njit``, and looped code some of Numba's internals. Here
`import_library` replaces these imports, so that a run loads no Numba; with ``NUMBA_DISABLE_JIT=1`` the functions
remain Python functions.
"""

from __future__ import annotations

import ast
import builtins
import functools
from collections.abc import Callable, Mapping
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar, cast

from symgen.compile.native import types
from symgen.compile.native.compiler import is_by_numba, is_interpreted, selected_compiler
from symgen.compile.native.read_tables import Written
from symgen.compile.store.function_source import syntax_tree
from symgen.compile.store.identity import combined_digest, file_content
from symgen.compile.store.jit import Arguments, CacheEntry, MachineFunction, argument_types, numba_arguments
from symgen.compile.store.sources import source_stamp

if TYPE_CHECKING:
    from symgen.compile.native.language import Function
    from symgen.compile.native.read import Kind

_Function = TypeVar("_Function", bound=Callable[..., Any])
#: Most statements of functions that are copied into their callers, if LLVM's heuristics agree.
_SHORT = 60


class CodeOrigin(NamedTuple):
    """Origin of a function: digest of all sources it depends on, and the text of its file as it was loaded.

    The loaded text counts, as the file may have been removed or changed. A function of symgen has no digest here: it
    follows from imports.
    """

    stamp: str | None
    content: bytes


class EmittedFunction(MachineFunction):
    """A function of an emitted module, on numbers and arrays of one dimension."""

    origin: CodeOrigin

    def tree(self) -> ast.FunctionDef | None:
        """Return the syntax tree of the function, None where its source is not available."""
        return syntax_tree(_read_lines(self.origin.content), self.py_func)

    def read(self, arguments: Arguments) -> Function:
        """Return the function in the language of `symgen.compile.native`.

        Raises
        ------
        Foreign
            If it is outside the language.
        """
        from symgen.compile.native.read import read_function

        return read_function(self, argument_types(arguments))

    def identity(self) -> str:
        """Return the sources and options that machine code depends on."""
        stamp, text = self.origin
        if stamp is None:
            stamp = combined_digest(text, source_stamp(self.py_func))
        return f"{self.__name__}\n{stamp}\n{_has_common_sines()}"

    def compiled_entry(self, arguments: Arguments, symbol: str) -> CacheEntry:
        """Return machine code, made from the source."""
        from symgen.compile.native.llvm import llvm_module

        function = self.read(arguments)
        return _compile_emitted(self, function, llvm_module(function, _symbol, _is_short, _has_common_sines()), symbol)


class NodesFunction(EmittedFunction):
    """A right-hand side at the nodes of a step, by `symgen.compile.native.node_functions` from one at a single node.

    Parameters
    ----------
    function : EmittedFunction
        ``rhs(t, y, p, w, iw, ydot)``.
    """

    def __init__(self, function: EmittedFunction) -> None:
        super().__init__(function.py_func)
        self.origin = function.origin

    def identity(self) -> str:
        """Return the sources and options that machine code depends on."""
        return f"nodes {super().identity()}"

    def __reduce__(self) -> Any:
        raise TypeError("machine code does not travel")

    def compiled_entry(self, arguments: Arguments, symbol: str) -> CacheEntry:
        """Return machine code, made from the source."""
        from symgen.compile.native.node_functions import node_module

        number, array, whole = types.float64, types.float64[::1], types.int64[::1]
        function = self.read((number, array, array, array, whole, array))
        return _compile_emitted(self, function, node_module(function, symbol, _symbol, _is_short), symbol)


class TangentFunction(EmittedFunction):
    """A function with directions beside each float, by `symgen.compile.native.tangents`, of the same arguments.

    Parameters
    ----------
    function : EmittedFunction
        The function without directions.
    lanes : int
        Number of directions.
    places : mapping of str to int
        First element of the directions after each array.
    """

    def __init__(self, function: EmittedFunction, lanes: int, places: Mapping[str, int]) -> None:
        super().__init__(function.py_func)
        names = function.py_func.__code__.co_varnames[: function.py_func.__code__.co_argcount]
        self.origin, self.lanes = function.origin, lanes
        self.places = {name: place for name, place in places.items() if name in names}

    def identity(self) -> str:
        """Return the sources and options that machine code depends on."""
        return f"directions {self.lanes} {sorted(self.places.items())} {super().identity()}"

    def __reduce__(self) -> Any:
        raise TypeError("machine code does not travel")

    def compiled_entry(self, arguments: Arguments, symbol: str) -> CacheEntry:
        """Return machine code, made from the source; short callees are in it."""
        from symgen.compile.native.llvm import functions_of_module, is_copied
        from symgen.compile.native.machine import compile_module
        from symgen.compile.native.tangents import tangent_module

        function, called = self.read(arguments), dict[str, Any]()
        names = {id(value): name for name, value in self.py_func.__globals__.items()}

        def apart(f: Function) -> str:
            if is_copied(f) or all(map(_is_short, functions_of_module(f, lambda _: True)[0])):
                return ""
            name = names[id(f.source)]
            called[name] = _parameter_kinds(f)
            return self.callee(name).symbol(numba_arguments(called[name]))

        text = tangent_module(function, symbol, self.lanes, self.places, _has_common_sines(), apart)
        return CacheEntry(function.returned, tuple(called.items()), compile_module(text, symbol))

    def callee(self, name: str) -> TangentFunction:
        """Return a callee with directions."""
        return with_directions(self.py_func.__globals__[name], self.lanes, tuple(sorted(self.places.items())))


@functools.lru_cache(maxsize=256)
def with_directions(function: EmittedFunction, lanes: int, places: tuple[tuple[str, int], ...]) -> TangentFunction:
    """Return the form of a function with directions, the same one for all callers; see `TangentFunction`."""
    return TangentFunction(function, lanes, dict(places))


class AdjointFunction(EmittedFunction):
    """The adjoint of a straight function, by `symgen.compile.native.adjoints`: adjoints of arrays follow its arguments.

    Parameters
    ----------
    function : EmittedFunction
        ``rhs``, or one of ``rhs`` and ``accept`` with a number of rounds.
    rounds : int, optional
        Iterations of the rates, or rounds of a correction before its last one.
    """

    def __init__(self, function: EmittedFunction, rounds: int | None = None) -> None:
        super().__init__(function.py_func)
        self.origin, self.rounds = function.origin, rounds

    def identity(self) -> str:
        """Return the sources and options that machine code depends on."""
        return f"adjoint {self.rounds} {super().identity()}"

    def __reduce__(self) -> Any:
        raise TypeError("machine code does not travel")

    def compiled_entry(self, arguments: Arguments, symbol: str) -> CacheEntry:
        """Return machine code, made from the source."""
        from symgen.compile.native.adjoints import adjoint_module
        from symgen.compile.native.machine import compile_module
        from symgen.compile.native.straightening import with_fixed_passes

        function, ends = self.read(arguments[: self.py_func.__code__.co_argcount]), "ydot"
        if self.rounds is not None:
            function, ends = with_fixed_passes(function, self.rounds)
        return CacheEntry(
            function.returned, (), compile_module(adjoint_module(function, symbol, ends, _has_common_sines()), symbol)
        )


def plain(function: _Function) -> _Function:
    """Compile a function of symgen like emitted ones: on numbers and flat arrays of plain types.

    Parameters
    ----------
    function : plain function
        In the language of `symgen.compile.native`, without other decorators; its callees are of the same kind, in the
        same module.

    Returns
    -------
    EmittedFunction
        The plain function where nothing is compiled.
    """
    if is_interpreted():
        return function
    compiled: Any = EmittedFunction(function)
    compiled.origin = CodeOrigin(None, file_content(function.__code__.co_filename))  # an import makes no digests
    return cast("_Function", compiled)


def import_library(name: str, *arguments: Any) -> Any:
    """Import for emitted modules; this module's decorators replace Numba's."""
    names = arguments[2] if len(arguments) > 2 else ()
    if name.partition(".")[0] != "numba" or "cuda" in names:
        return builtins.__import__(name, *arguments)
    if is_by_numba():
        from symgen.compile.store.numba_route import library

        return library(builtins.__import__(name, *arguments), names, _decorate_emitted)
    return _INSTEAD


def _decorate_emitted(**options: object) -> Any:
    """Decorate a function of an emitted module."""
    return lambda function: (
        function if is_interpreted() else EmittedFunction(function, options.get("inline") == "always")
    )


#: Names that emitted modules import from Numba and its packages.
_INSTEAD = SimpleNamespace(
    njit=_decorate_emitted,
    types=types,
    config=SimpleNamespace(DISABLE_JIT=is_interpreted()),
    intrinsic=lambda define: Written(define.__name__, define),
    cgutils=None,
    populate_array=None,
)


def _has_common_sines() -> bool:
    """Whether sines and cosines of several angles have a common call."""
    return selected_compiler() != "libm"


def _compile_emitted(own: EmittedFunction, function: Function, text: str, symbol: str) -> CacheEntry:
    """Return the machine code of a module, and the callees of its function."""
    from symgen.compile.native.llvm import is_copied
    from symgen.compile.native.machine import compile_module

    apart = [f for f in function.called if not is_copied(f)]
    names = {id(value): name for name, value in own.py_func.__globals__.items()}
    called = tuple((names[id(f.source)], _parameter_kinds(f)) for f in apart)
    return CacheEntry(function.returned, called, compile_module(text, symbol))


def _emitted_source(function: Function) -> EmittedFunction:
    assert isinstance(function.source, EmittedFunction), "functions are read from emitted ones"
    return function.source


def _parameter_kinds(function: Function) -> tuple[Kind, ...]:
    return tuple((p.type, p.array) for p in function.parameters)


def _symbol(function: Function) -> str:
    return _emitted_source(function).symbol(numba_arguments(_parameter_kinds(function)))


def _is_short(function: Function) -> bool:
    from symgen.compile.native.language import ArrayView

    # looped code has machine code already, as loops and starts call its functions
    return len(function.body) <= _SHORT and not any(isinstance(statement, ArrayView) for statement in function.body)


@functools.lru_cache(maxsize=4)
def _read_lines(content: bytes) -> tuple[str, ...]:
    """Return the lines of a file."""
    return tuple(content.decode().split("\n"))
