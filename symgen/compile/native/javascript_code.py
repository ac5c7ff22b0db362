"""Functions of `symgen.compile.native.language` as JavaScript: the emitted code of a mechanism for a page.

Numbers of both languages are the same 64 bits; operations have the order of the source. Integers of emitted code
are indices and counters, far below 2^53. Arrays are ``Float64Array``, of integers too.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

from symgen.compile.native import language as lang
from symgen.compile.native.binding import MEMORY, BoundFunctions, is_bound
from symgen.compile.native.printing import FunctionPrinter, order_functions, variable_name

#: Helpers of printed functions. Sines and cosines of browsers are rounded wrongly once in thirty times,
#: those of C libraries once in a thousand: here the first terms of their series have twice the digits.
HELPERS = """\
const copysign = (x, y) => (y < 0 || Object.is(y, -0) ? -Math.abs(x) : Math.abs(x));
const floored = (a, b) => Math.floor(a / b);
const rest = (a, b) => a - b * Math.floor(a / b);
const least = (a, b) => (b < a ? b : a);
const greatest = (a, b) => (b > a ? b : a);
const square = (x) => x * x;
function power(x, n) {
  let result = 1;
  for (; n; n >>= 1) {
    if (n & 1) result *= x;
    x *= x;
  }
  return result;
}
const low = new Float64Array(1);
function times(a, b) {
  const p = a * b, u = 134217729 * a, v = 134217729 * b, c = u - (u - a), d = v - (v - b);
  low[0] = (c * d - p + c * (b - d) + (a - c) * d) + (a - c) * (b - d);
  return p;
}
function sineOf(x, y) {
  const z = times(x, x), zl = low[0], p = z * z * x;
  const c = times(z, x), cl = low[0] + zl * x;
  const d = times(c, 0.16666666666666666), dl = low[0] + c * 9.25185853854297e-18 + cl * 0.16666666666666666;
  const s = x - d, e = x - s - d;
  let more = 1 / 1307674368000 - z / 355687428096000;
  more = 1 / 6227020800 - z * more;
  more = 1 / 39916800 - z * more;
  more = 1 / 362880 - z * more;
  more = 1 / 5040 - z * more;
  more = 1 / 120 - z * more;
  return s + (e - dl + p * more + y * (1 - z * (0.5 - z / 24)));
}
function cosineOf(x, y) {
  const z = times(x, x), zl = low[0] + 2 * x * y;
  const q = times(z, z), ql = low[0] + 2 * z * zl;
  const r = times(q, 0.041666666666666664), rl = low[0] + q * 2.3129646346357427e-18 + ql * 0.041666666666666664;
  const s = 1 - 0.5 * z, e = 1 - s - 0.5 * z, t = s + r, f = s - t + r;
  let more = 1 / 20922789888000 - z / 6402373705728000;
  more = 1 / 87178291200 - z * more;
  more = 1 / 479001600 - z * more;
  more = 1 / 3628800 - z * more;
  more = 1 / 40320 - z * more;
  more = 1 / 720 - z * more;
  return t + (e + f - 0.5 * zl + rl - q * z * more);
}
function quarter(x, k, otherwise) {
  if (!(Math.abs(x) < 1e5)) return otherwise(x);
  const n = Math.abs(x) < 0.785 ? 0 : Math.round(x * 0.6366197723675814);
  const t = x - n * 1.5707963267341256, w = n * 6.077100506303966e-11, u = t - w;
  const l = t - u - w - n * 2.0222662487959506e-21, hi = u + l, lo = u - hi + l;
  const i = (n + k) & 3, value = i & 1 ? cosineOf(hi, lo) : sineOf(hi, lo);
  return i & 2 ? -value : value;
}
const sine = (x) => (x === 0 ? x : quarter(x, 0, Math.sin));
const cosine = (x) => quarter(x, 1, Math.cos);
"""
#: Helpers of printed functions of the runtime, beside `HELPERS`.
LOOP_HELPERS = """\
const quotient = (a, b) => (b === 0 ? 0 : Math.floor(a / b));
const modulus = (a, b) => (b === 0 ? 0 : a - b * Math.floor(a / b));
const nearest = (x) => {
  const n = Math.round(x);
  return n - x === 0.5 && n % 2 !== 0 ? n - 1 : n;
};
const part = (array, first, size) => array.subarray(first, first + size);
"""
#: Names that a text with looped code defines: its tables, one ``Int32Array`` for all arrays that end with them, and
#: the functions that are called by addresses; numbers in these arrays are places in that list.
INDEX_TABLES, ADDRESSED = "indexTables", "addressed"
#: Reserved words; emitted code uses none of them today.
RESERVED = frozenset(
    "arguments await break case catch class const debugger default delete enum eval export extends function implements "
    "in instanceof interface let new package private protected public static super switch this throw typeof undefined "
    "var void with yield Math copysign floored rest least greatest square power "
    "derive describe end newMemory quotient modulus nearest part low times sineOf cosineOf quarter sine cosine "
    f"prepareModel masses {INDEX_TABLES} {ADDRESSED}".split()
)

_CALLED = {"floordiv": "floored", "mod": "rest", "min": "least", "max": "greatest", "abs": "Math.abs"}
_CALLED |= {"math.sin": "sine", "math.cos": "cosine", "pow": "Math.pow"}
_CALLED |= {"quotient": "quotient", "round": "nearest"}
_CALLED |= {"math.fabs": "Math.abs", "math.copysign": "copysign", "math.pow": "Math.pow"}


def javascript_functions(
    functions: Mapping[str, lang.Function],
    bound: BoundFunctions | None = None,
    written: Mapping[str, str] | None = None,
) -> str:
    """Return the text of functions and their callees, each once, callees first.

    Parameters
    ----------
    functions : mapping of str to Function
        Functions to define, by their names in the text.
    bound : BoundFunctions, optional
        Functions of the runtime bound to a model, which follow; their first argument is an object with memory, which
        ``newMemory(p, w, iw)`` returns.
    written : mapping of str to str, optional
        Texts of functions of `functions` that have no body.
    """
    bound, written = bound or BoundFunctions({}), written or {}
    order, names = order_functions({**functions, **bound.functions}, RESERVED)
    tables = [
        f"const {variable_name(table.name, RESERVED)} = [{', '.join(map(js_number, table.values))}];"
        for table in bound.tables.values()
    ]
    texts = (
        written.get(names[f.key]) or (_BoundPrinter(f, names, bound) if is_bound(f) else _Printer(f, names)).text()
        for f in order
    )
    return "\n".join([*tables, *texts, *_memory_function(bound)])


def _memory_function(bound: BoundFunctions) -> list[str]:
    """Return the function of the object with memory, where there is any.

    Its members are literal: V8 looks up members that are added later, one by one, in a dictionary.
    """
    outside = ("p", "w", "iw")
    own = [f"{name}: new Float64Array({size})" for name, (_, size) in bound.memory.items() if name not in outside]
    shared = ", ".join(outside)
    return [f"const newMemory = ({shared}) => ({{ {', '.join([shared, *own])} }});"] if bound.memory else []


def js_number(value: float | int | bool) -> str:
    """Return the text of a number."""
    if isinstance(value, float) and not math.isfinite(value):
        return "NaN" if math.isnan(value) else "Infinity" if value > 0 else "-Infinity"
    return repr(value).removesuffix(".0")


class _Printer(FunctionPrinter):
    """Prints one function."""

    reserved = RESERVED
    signs: ClassVar = {"eq": ("===", 9), "ne": ("!==", 9)}

    def text(self) -> str:
        """Return the definition, after the tables that it reads."""
        f = self.function
        tables = [
            f"const {self.names[f.key, name]} = [{', '.join(self.literal_text(x)[0] for x in values)}];"
            for name, values in f.tables.items()
        ]
        parameters = {p.name for p in f.parameters}
        local = [self.variable_text(name) for name in f.variables if name not in parameters and name not in self.once]
        body = self.lines(f.body)
        lines = [f"let {', '.join([*local, *self.views])};"] if local or self.views else []
        arguments = (
            a for p in f.parameters for a in (self.array_arguments(p.name) if p.array else [self.variable_text(p.name)])
        )
        head = f"function {self.names[f.key]}({', '.join([*self.first_arguments(f), *arguments])}) {{"
        return "\n".join([*tables, head, *lines, *body, "}"])

    def first_arguments(self, function: lang.Function) -> list[str]:
        """Return the arguments before the arguments of a function's source."""
        return []

    def literal_text(self, value: float | int | bool) -> tuple[str, int]:
        """Return a number and the precedence of its text."""
        if isinstance(value, bool):
            return ("true" if value else "false"), 20
        text = js_number(value)
        return text, 14 if text.startswith("-") else 20

    def declaration(self, s: lang.Assign) -> str:
        """Return the words before the name of a variable that is assigned once, at its assignment."""
        return "const "

    def loop_head(self, s: lang.For, counter: str) -> str:
        """Return the head of a loop whose counter has its own name."""
        first, last, sign = self.value(s.start), self.value(s.stop), "<" if s.step > 0 else ">"
        kept, end = ("", last) if isinstance(s.stop, lang.Constant) else (f", end = {last}", "end")
        further = f"{counter}++" if s.step == 1 else f"{counter} += {s.step}"
        return f"for (let {counter} = {first}{kept}; {counter} {sign} {end}; {further}) {{"

    def statement(self, s: lang.Statement) -> list[str]:
        """Return one statement; the tables of looped code are where their array ends, and the same for all."""
        if isinstance(s, lang.ArrayView) and s.type == "unsigned":
            self.arrays[s.name] = s.type, 1
            self.views[self.variable_text(s.name)] = None
            return [f"{self.variable_text(s.name)} = {INDEX_TABLES};"]
        if isinstance(s, lang.Assign) and s.name.endswith(".start") and getattr(s.value, "name", "") == "bits":
            return []  # where the tables begin
        return super().statement(s)

    def operation(self, e: lang.ScalarOperation) -> tuple[str, int]:
        """Return an operation; numbers of tables and places of functions are integers like others, far below 2^31."""
        first = e.arguments[0]
        if e.name in ("bits", "unsigned") or (e.name == "int" and first.type == "unsigned"):
            return self.expression(first)
        return (f"{self.value(first, 8)} | 0", 7) if e.name == "low" else super().operation(e)

    def function_name(self, e: lang.ScalarOperation) -> str:
        """Return the name of an operation's function."""
        if e.name == "rest" and e.type == "int":
            return "modulus"
        return _CALLED.get(e.name, f"Math.{e.name.removeprefix('math.')}")

    def conversion(self, kind: str, value: lang.Expression) -> tuple[str, int]:
        """Return a value in another type."""
        if kind == "bool":
            return f"{self.value(value, 10)} !== 0", 9
        if value.type == "bool":
            return f"({self.value(value)} ? 1 : 0)", 20
        return (f"Math.trunc({self.value(value)})", 20) if kind == "int" else self.expression(value)

    def block_text(self, number: int, lines: list[str]) -> list[str]:
        """Return the statements of a block that may be left before its end."""
        return [f"block{number}: {{", *lines, "}"]

    def leave_block(self, number: int) -> str:
        """Return the statement that leaves a block."""
        return f"break block{number};"

    def length_text(self, array: str, axis: int) -> str:
        """Return the length of an array along an axis: the elements of an array know the first one."""
        if axis > 0:
            return self.variable_text(f"{array}.n{axis}")
        _, *inner = self.array_arguments(array)
        return (
            f"({self.variable_text(array)}.length / ({'*'.join(inner)}))"
            if inner
            else f"{self.variable_text(array)}.length"
        )

    def array_arguments(self, array: str) -> list[str]:
        """Return the arguments of a call for an array: itself, and its lengths but the first."""
        _, rank = self.arrays[array]
        return [self.variable_text(array), *(self.length_text(array, axis) for axis in range(1, rank))]

    def name_array(self, name: str, array: str, first: lang.Expression | None, lengths: list[str]) -> list[str]:
        """Return the statements that give a name to an array, or to the elements from one on."""
        view, *inner = self.array_arguments(name)
        self.views |= dict.fromkeys([view, *inner])
        size = "*".join(f"({n})" if i == 0 and len(lengths) > 1 else n for i, n in enumerate(lengths))
        elements = (
            self.variable_text(array)
            if first is None
            else f"part({self.variable_text(array)}, {self.value(first)}, {size})"
        )
        return [f"{view} = {elements};", *map("{} = {};".format, inner, lengths[1:])]

    def call_by_address(self, e: lang.Invoke) -> str:
        """Return the call of a function by its address, here the function itself."""
        function = (
            self.variable_text(e.function) if isinstance(e.function, str) else f"{ADDRESSED}[{self.value(e.function)}]"
        )
        return f"{function}({', '.join(self.arguments(e.arguments))})"


class _BoundPrinter(_Printer):
    """Prints one function bound to a model.

    Parameters
    ----------
    function, names
        As for `FunctionPrinter`.
    bound : BoundFunctions
        The functions, with the memory that they use.
    """

    def __init__(self, function: lang.Function, names: Mapping[object, str], bound: BoundFunctions) -> None:
        super().__init__(function, names)
        self.bound = bound
        self.arrays |= bound.arrays

    def variable_text(self, name: str) -> str:
        """Return the name of a variable, or a member of the memory."""
        return f"model.{name.removeprefix(MEMORY)}" if name in self.bound.rooms else super().variable_text(name)

    def first_arguments(self, function: lang.Function) -> list[str]:
        """Return the memory, for functions that use it."""
        return ["model"] if function.key in self.bound.with_memory else []

    def passed_arguments(self, e: lang.FunctionCall) -> list[str]:
        """Return the arguments of a call of another function."""
        return [*self.first_arguments(e.function), *super().passed_arguments(e)]
