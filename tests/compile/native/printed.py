"""Functions of the runtime printed as C and as JavaScript, and the same calls of all forms side by side."""

from __future__ import annotations

import base64
import ctypes
import functools
import json
import subprocess
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from symgen.compile.loopcode.exact import Exact, compiled_form
from symgen.compile.native import javascript_code as js
from symgen.compile.native import language as lang
from symgen.compile.native import types
from symgen.compile.native.c99_loops import c_loops
from symgen.compile.native.calls import lockless_caller
from symgen.compile.native.loops import read_loop
from symgen.compile.native.pieces import Piece
from symgen.compile.store.jit import RuntimeFunction

HEAD = "#include <math.h>\ntypedef double real;\n#define M(x) x\n#define SMALL(x) x\n#define LARGE(x) x\n"


@functools.cache
def plain_piece(piece: Piece) -> RuntimeFunction:
    """The plain form of a piece, as a function that loops call."""
    return RuntimeFunction(piece.plain, contracted=False)


def source_of(function: Any, signature: types.Signature | None = None) -> lang.Function:
    """A function of the runtime in the checked language."""
    function = compiled_form(function)
    return read_loop(function, (signature or function.signature).arguments, plain_piece)


class Library:
    """Printed functions, compiled by the C compiler of this machine without contraction."""

    def __init__(self, functions: Mapping[str, lang.Function], folder: Path) -> None:
        source, binary = folder / "printed.c", folder / "printed.so"
        source.write_text(HEAD + c_loops(functions))
        command = ["cc", "-std=c99", "-O1", "-ffp-contract=off", "-Wall", "-Wno-parentheses", "-Wno-unused"]
        built = subprocess.run(
            [*command, "-shared", "-fPIC", "-o", str(binary), str(source), "-lm"], capture_output=True, text=True
        )
        assert built.returncode == 0 and not built.stderr, built.stderr
        self.library = ctypes.CDLL(str(binary))

    def at(self, name: str) -> Address:
        """A function by its address, as argument of another one."""
        return Address(ctypes.cast(getattr(self.library, name), ctypes.c_void_p).value)

    def function(self, name: str, signature: types.Signature) -> Any:
        """A function that Python calls like a compiled one."""
        return lockless_caller(self.at(name).place, signature)


class Address:
    """A function at a place in memory."""

    def __init__(self, place: int) -> None:
        self.place = place

    def address(self, signature: types.Signature) -> int:
        return self.place


def leaves(kind: types.Kind, value: Any) -> Iterator[Any]:
    """Numbers, arrays and functions of an argument, in the order of parameters."""
    if isinstance(kind, types.RecordType):
        for part, item in zip(kind, value, strict=True):
            yield from leaves(part, item)
    else:
        yield value


def with_leaves(value: Any, change: Any) -> Any:
    """The same records with other leaves."""
    if isinstance(value, tuple):
        parts = [with_leaves(part, change) for part in value]
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return change(value)


def copied(value: Any) -> Any:
    """The same records with copies of arrays."""
    return with_leaves(value, lambda leaf: leaf.copy() if isinstance(leaf, np.ndarray) else leaf)


def arrays(value: Any) -> list[np.ndarray]:
    """Copies of the arrays of records."""
    found: list[np.ndarray] = []
    with_leaves(value, lambda leaf: found.append(leaf.copy()) if isinstance(leaf, np.ndarray) else None)
    return found


def assert_same_bits(one: list[np.ndarray], other: list[np.ndarray]) -> None:
    """Every number is the same; all undefined ones are."""
    for a, b in zip(one, other, strict=True):
        np.testing.assert_array_equal(a, b)
        np.testing.assert_array_equal(np.signbit(a[a == a]), np.signbit(b[b == b]))


def plain_of(function: RuntimeFunction) -> Any:
    """The plain Python of an exact function from its compiled form."""
    own = getattr(sys.modules[function.__module__], function.__name__)
    return own.plain if isinstance(own, Exact) else own


# -- JavaScript --------------------------------------------------------------------------------------------------------

#: Calls of emitted functions as they were recorded; arrays from and to text.
HARNESS = """
const unpacked = (text) => new Float64Array(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
function packed(array) {
  let text = "";
  for (const byte of new Uint8Array(array.slice().buffer)) text += String.fromCharCode(byte);
  return btoa(text);
}
let at = 0;
const recorded = (name) => (...given) => {
  const [own, before, after, result] = calls[at++];
  if (own !== name) throw new Error(`call ${at} is ${name}, not ${own}`);
  given.forEach((value, i) => {
    const expected = typeof before[i] === "string" ? unpacked(before[i]) : before[i];
    const same = (a, b) => Object.is(a, b);
    if (typeof expected === "number" ? !same(value, expected) : !expected.every((x, k) => same(x, value[k])))
      throw new Error(`argument ${i} of call ${at}, ${name}`);
    if (after[i] !== null) value.set(unpacked(after[i]));
  });
  return result;
};
"""


def packed(value: Any) -> Any:
    """A number or an array as text for JavaScript."""
    if isinstance(value, np.ndarray):
        return base64.b64encode(np.ascontiguousarray(value, dtype=np.float64).tobytes()).decode()
    return float(value)


class Recorder:
    """Calls of emitted functions, with their arguments before and after."""

    def __init__(self) -> None:
        self.calls: list[Any] = []

    def of(self, name: str, function: Any, kind: types.FunctionType) -> Any:
        """The function, whose calls are recorded."""
        own = function.caller(kind.signature.arguments)

        def call(*arguments: Any) -> Any:
            before = [packed(a) for a in arguments]
            result = own(*arguments)
            after = [packed(a) if isinstance(a, np.ndarray) else None for a in arguments]
            changed = [a if a != b else None for a, b in zip(after, before, strict=True)]
            self.calls.append([name, before, changed, result])
            return result

        return call


def script(functions: Mapping[str, lang.Function], name: str, arguments: list[Any], calls: list[Any]) -> str:
    """A text in JavaScript that calls a printed function; its value is the result and the arrays afterwards.

    Arguments are numbers, arrays, and functions as the text of an expression.
    """
    texts = [a if isinstance(a, str) else f"unpacked('{packed(a)}')" if isinstance(a, np.ndarray) else repr(a)
             for a in arguments]  # fmt: skip
    texts = ["NaN" if t == "nan" else t for t in texts]
    return f"""(() => {{
{js.HELPERS}{js.LOOP_HELPERS}
const calls = {json.dumps(calls)};
{HARNESS}
{js.javascript_functions(functions)}
const given = [{", ".join(texts)}];
const result = {name}(...given);
if (at !== calls.length) throw new Error("calls are left");
return JSON.stringify([result, given.filter((x) => x instanceof Float64Array).map(packed)]);
}})()"""


def unpacked(text: str) -> tuple[int, list[np.ndarray]]:
    """Result and arrays of a script."""
    result, found = json.loads(text)
    return result, [np.frombuffer(base64.b64decode(each)) for each in found]
