"""A text that says what a function compiles to: its code, what it closes over and the sources it may reach.

Nothing here depends on memory addresses, on the order of sets or on time stamps, so the text is the same in every
process that would compile the same thing.
"""

from __future__ import annotations

import functools
import hashlib
import inspect
import types
from collections.abc import Iterable
from pathlib import Path
from typing import Any

# Loops call helpers of these packages, and Numba does not notice when a helper is edited.
_SOURCE_FOLDERS = ("runtime", "integrators")
_DEEPEST = 16


class NotDescribable(Exception):
    """A value whose content cannot be told from another's, so that nothing that depends on it may be cached."""


def digest(*parts: str | bytes) -> str:
    """Return the SHA-256 of the parts in hexadecimal; where one part ends and the next begins matters."""
    result = hashlib.sha256()
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        result.update(b"%d:" % len(data))
        result.update(data)
    return result.hexdigest()


def source_stamp(function: Any) -> str:
    """Return the digest of all sources that a function's machine code depends on.

    These are the runtime and the integrators of symgen as a whole, the function's own file, and the files of compiled
    functions that it calls, directly or through others.

    Parameters
    ----------
    function : function
        Python function with a source file.

    Returns
    -------
    str
        Hexadecimal digest.

    Raises
    ------
    NotDescribable
        If the function has no file that can be read.
    """
    try:
        files = sorted({inspect.getfile(reached) for reached in _reached(function, {})})
        # Contents without names: the same sources in another place give the same machine code.
        return digest(*sorted(file_digest(file) for file in files), sources_digest(*_SOURCE_FOLDERS))
    except (OSError, TypeError) as error:
        raise NotDescribable(str(error)) from error


def _reached(function: Any, seen: dict[int, Any]) -> Iterable[Any]:
    """Give a function and those compiled functions that it names, by themselves or in a module, and so on."""
    seen[id(function)] = function
    for name in function.__code__.co_names:
        value = function.__globals__.get(name)
        values = vars(value).values() if isinstance(value, types.ModuleType) and _near(value, function) else (value,)
        for each in values:
            called = getattr(each, "py_func", None)
            if isinstance(called, types.FunctionType) and id(called) not in seen:
                _reached(called, seen)
    return seen.values()


def _near(module: types.ModuleType, function: Any) -> bool:
    """Whether a module belongs to the function's package; what is installed is covered by versions in the key."""
    return module.__name__.partition(".")[0] == str(function.__module__).partition(".")[0]


def describe_function(function: Any) -> str:
    """Return a text for the code of a function and the values it closes over.

    Raises
    ------
    NotDescribable
        If it closes over something without canonical content.
    """
    return digest(_describe(function, 0))


def describe(value: Any) -> str:
    """Return a text that is equal for equal content, in any process.

    Raises
    ------
    NotDescribable
        If the value has no canonical content.
    """
    return _describe(value, 0)


def _describe(value: Any, depth: int) -> str:
    if depth > _DEEPEST:
        raise NotDescribable("too deep or recursive")
    if value is None or value is Ellipsis or isinstance(value, bool | int | float | complex | str | bytes):
        # NumPy's float64 is a float: the type's name keeps them apart.
        return f"{type(value).__name__} {value!r}"
    if isinstance(value, tuple | list):
        return f"{type(value).__name__}({_describe_all(value, depth)})"
    if isinstance(value, set | frozenset):
        return f"set({','.join(sorted(_describe(item, depth + 1) for item in value))})"
    if isinstance(value, dict):
        items = sorted((_describe(key, depth + 1), _describe(item, depth + 1)) for key, item in value.items())
        return f"dict({items!r})"
    if isinstance(value, types.CodeType):
        code_parts = (
            value.co_code,
            value.co_consts,
            value.co_names,
            value.co_varnames,
            value.co_freevars,
            value.co_flags,
        )
        return f"code({_describe_all(code_parts, depth)})"
    if isinstance(value, types.FunctionType):
        cells = tuple(cell.cell_contents for cell in value.__closure__ or ())
        parts = (value.__module__, value.__code__, value.__defaults__, value.__kwdefaults__, cells)
        return f"function({_describe_all(parts, depth)})"
    if isinstance(value, types.BuiltinFunctionType | type):
        return f"named {value.__module__}.{value.__qualname__}"
    if isinstance(value, types.ModuleType):
        return f"module {value.__name__}"
    return _describe_numerical(value, depth)


def _describe_all(values: Iterable[Any], depth: int) -> str:
    return ",".join(_describe(value, depth + 1) for value in values)


def _describe_numerical(value: Any, depth: int) -> str:
    """Describe what NumPy and Numba add; only reached when they have been imported."""
    import numba
    import numpy as np

    if isinstance(value, np.ndarray) and not value.dtype.hasobject:
        return f"array({value.dtype.str} {value.shape} {digest(value.tobytes())})"
    if isinstance(value, np.generic):
        return f"scalar({value.dtype.str} {value.tobytes()!r})"
    if isinstance(value, numba.types.Type):
        return f"type {type_text(value)}"
    function = getattr(value, "py_func", None)
    if isinstance(function, types.FunctionType):
        # What the dispatcher calls in turn is covered by the stamp of its sources.
        stamp = getattr(getattr(value, "_cache", None), "stamp", None) or source_stamp(function)
        return f"jitted({stamp} {_describe(function, depth + 1)} {_describe(value.targetoptions, depth + 1)})"
    raise NotDescribable(f"a value of type '{type(value).__qualname__}' has no canonical content")


def type_text(numba_type: Any) -> str:
    """Return the name of a Numba type, which is its identity unless it stands for one object in memory.

    Raises
    ------
    NotDescribable
        If the type is that of one object, such as a dispatcher.
    """
    text = str(numba_type)
    if " at 0x" in text:
        raise NotDescribable(f"the type '{text}' stands for one object of one process")
    return text


@functools.cache
def file_digest(path: str) -> str:
    """Return the digest of what a file held when it was first asked for, at the latest when it was loaded."""
    return digest(Path(path).read_bytes())


@functools.cache
def sources_digest(*folders: str) -> str:
    """Return the digest of all sources in folders of symgen."""
    base = Path(__file__).parent.parent
    files = sorted(path for folder in folders for path in (base / folder).rglob("*.py"))
    return digest(*(text for path in files for text in (path.relative_to(base).as_posix(), path.read_bytes())))
