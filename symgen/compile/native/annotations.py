"""Types of compiled functions from Python's annotations, so that a type checker and the compiler read the same words.

A number is annotated `float`, `int` or `bool`, an array `Array`, `Integers`, `Matrix` or `Cube`, a function by
its address an alias of a ``Callable``, several values a ``tuple``. A `Record` is a class of named tuples; its fields
are annotated alike. Types are made at the first use: a run whose machine code is in the cache asks for few of them.
"""

from __future__ import annotations

import builtins
import functools
import sys
from collections import namedtuple
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, dataclass_transform, get_args, get_origin

import numpy as np
from numpy.typing import NDArray

from symgen.compile.native import types

if TYPE_CHECKING:
    from typing import Self

Array = NDArray[np.float64]
Integers = NDArray[np.int64]
#: Arrays of two and three dimensions.
Matrix = Annotated[NDArray[np.float64], types.float64[:, ::1]]
Cube = Annotated[NDArray[np.float64], types.float64[:, :, ::1]]

_KINDS: dict[Any, types.Kind] = {
    **{float: types.float64, int: types.int64, bool: types.boolean},
    **{Array: types.float64[::1], Integers: types.int64[::1]},
}


@dataclass_transform(frozen_default=True)
class RecordClass(type):
    """Metaclass of records: a class has the fields of its base and, after these, the names that it annotates."""

    def __new__(cls, name: str, bases: tuple[type, ...], space: dict[str, Any]) -> RecordClass:
        """Return the class of a record."""
        own = space.get("__annotations__", {})
        if not own:
            return super().__new__(cls, name, bases, space)
        made: Any = namedtuple(name, (*getattr(bases[0], "_fields", ()), *own), module=space["__module__"])  # type: ignore[misc]  # made of names
        return super().__new__(cls, name, bases, {**vars(made), **space})


if TYPE_CHECKING:
    _Base = object  # methods of a tuple, as `count`, are names of fields
else:
    _Base = tuple


class Record(_Base, metaclass=RecordClass):
    """A named tuple of numbers, arrays, functions and other records, which a compiled function takes as one argument.

    A record with more fields than another one is a subclass of it: its fields come after those of the base.
    """

    __slots__ = ()
    if TYPE_CHECKING:
        _fields: ClassVar[tuple[str, ...]]

        @classmethod
        def _make(cls, values: Iterable[object]) -> Self: ...

        def _replace(self, **values: object) -> Self: ...

        def _asdict(self) -> dict[str, Any]: ...

        def __len__(self) -> int: ...

        def __iter__(self) -> Iterator[Any]: ...

        def __getitem__(self, index: int | slice) -> Any: ...

    else:
        _fields = ()


@functools.cache
def record_type(record: type[Record]) -> types.RecordType:
    """Return the type of a record from the annotations of its fields."""
    names = vars(sys.modules[record.__module__])
    own = tuple(type_of(hint, names) for hint in vars(record).get("__annotations__", {}).values())
    base = record.__bases__[0]
    before = record_type(base) if issubclass(base, Record) else ()
    return types.RecordType((*before, *own), record)


def function_type(meant: Any) -> types.FunctionType:
    """Return the type of a function by its address, from an annotated one or from an alias of a ``Callable``."""
    if get_origin(meant) is None:
        return types.FunctionType(signature_from(meant))
    kind = type_of(meant)
    assert isinstance(kind, types.FunctionType), f"{meant} is no function"
    return kind


def signature_from(function: Callable[..., Any]) -> types.Signature:
    """Return the signature of a function from its annotations; one without a result returns an unused 0."""
    plain: Any = getattr(function, "py_func", function)
    hints, names, code = plain.__annotations__, plain.__globals__, plain.__code__
    result = _named(hints["return"], names)
    number = types.int64 if result is None else type_of(result, names)
    assert isinstance(number, types.NumberType), f"{plain.__qualname__} returns no number"
    return types.Signature(number, tuple(type_of(hints[x], names) for x in code.co_varnames[: code.co_argcount]))


def type_of(hint: object, names: Mapping[str, Any] | None = None) -> types.Kind:
    """Return the type that an annotation means.

    Parameters
    ----------
    hint : object
        The annotation; in a module with annotations as text, the text.
    names : mapping, optional
        Names of that module.

    Raises
    ------
    TypeError
        If compiled functions have no such type.
    """
    hint = _named(hint, names or {})
    if isinstance(hint, types.NumberType | types.ArrayType | types.FunctionType | types.RecordType):
        return hint
    if isinstance(hint, type) and issubclass(hint, Record):
        return record_type(hint)
    if hint in _KINDS:
        return _KINDS[hint]
    kind = _KINDS[hint] = _composed(hint)
    return kind


def _named(hint: object, names: Mapping[str, Any]) -> Any:
    """Return the meaning of an annotation that is text: a name in most cases, for which nothing has to be compiled."""
    if not isinstance(hint, str):
        return hint
    if hint == "None":
        return None
    name, *rest = hint.split(".")
    if all(word.isidentifier() for word in (name, *rest)):
        return functools.reduce(getattr, rest, names[name] if name in names else getattr(builtins, name))
    return eval(hint, dict(names))  # the text of an annotation in a module of our own


def _composed(hint: object) -> types.Kind:
    """Return the type of an annotation that is made of others."""
    origin, arguments = get_origin(hint), get_args(hint)
    if origin is Annotated:
        return type_of(arguments[1])
    if origin is tuple:
        return types.RecordType(tuple(map(type_of, arguments)))
    if origin is Callable:
        taken, returned = arguments
        result = type_of(returned)
        assert isinstance(result, types.NumberType), f"{hint} returns no number"
        return types.FunctionType(types.Signature(result, tuple(map(type_of, taken))))
    raise TypeError(f"compiled functions have no type for {hint}")
