"""Functions of `symgen.native.language` as JavaScript: the emitted code of a mechanism for a page.

Numbers of both languages are the same 64 bits; operations stand in the order of the source. Integers of emitted code
are indices and counters, far below 2^53. Arrays are ``Float64Array``, of integers too.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from symgen.native import language as lang

#: What printed functions call beside ``Math``. Sines and cosines of browsers are rounded wrongly once in thirty times,
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
let low = 0;
function times(a, b) {
  const p = a * b, u = 134217729 * a, v = 134217729 * b, c = u - (u - a), d = v - (v - b);
  low = (c * d - p + c * (b - d) + (a - c) * d) + (a - c) * (b - d);
  return p;
}
function sineOf(x, y) {
  const z = times(x, x), zl = low, p = z * z * x;
  const c = times(z, x), cl = low + zl * x;
  const d = times(c, 0.16666666666666666), dl = low + c * 9.25185853854297e-18 + cl * 0.16666666666666666;
  const s = x - d, e = x - s - d;
  let more = 1 / 1307674368000 - z / 355687428096000;
  for (const n of [6227020800, 39916800, 362880, 5040, 120]) more = 1 / n - z * more;
  return s + (e - dl + p * more + y * (1 - z * (0.5 - z / 24)));
}
function cosineOf(x, y) {
  const z = times(x, x), zl = low + 2 * x * y;
  const q = times(z, z), ql = low + 2 * z * zl;
  const r = times(q, 0.041666666666666664), rl = low + q * 2.3129646346357427e-18 + ql * 0.041666666666666664;
  const s = 1 - 0.5 * z, e = 1 - s - 0.5 * z, t = s + r, f = s - t + r;
  let more = 1 / 20922789888000 - z / 6402373705728000;
  for (const n of [87178291200, 479001600, 3628800, 40320, 720]) more = 1 / n - z * more;
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
#: Words that may not be names; emitted code has none of them today.
RESERVED = frozenset(
    "arguments await break case catch class const debugger default delete enum eval export extends function implements "
    "in instanceof interface let new package private protected public static super switch this throw typeof undefined "
    "var void with yield Math copysign floored rest least greatest square power "
    "low times sineOf cosineOf quarter sine cosine".split()
)

_SIGNS = {"add": ("+", 12), "sub": ("-", 12), "mul": ("*", 13), "div": ("/", 13), "and": ("&&", 5), "or": ("||", 4)}
_SIGNS |= {"lt": ("<", 10), "le": ("<=", 10), "gt": (">", 10), "ge": (">=", 10), "eq": ("===", 9), "ne": ("!==", 9)}
_CALLED = {"floordiv": "floored", "mod": "rest", "min": "least", "max": "greatest", "abs": "Math.abs"}
_CALLED |= {"math.sin": "sine", "math.cos": "cosine"}
_CALLED |= {"math.fabs": "Math.abs", "math.copysign": "copysign", "math.pow": "Math.pow"}


def javascript(functions: Mapping[str, lang.Function]) -> str:
    """Return the text of functions and of all that they call, each once, callees first.

    Parameters
    ----------
    functions : mapping of str to Function
        What the text shall define, by the names that it shall have there.
    """
    names: dict[object, str] = {function.key: name for name, function in functions.items()}
    texts: list[str] = []

    def define(function: lang.Function) -> None:
        for called in function.called:
            if called.key not in names:
                names[called.key] = _free(_word(called.name), names.values())
                define(called)
        for array in function.tables:
            names[function.key, array] = _free(f"{names[function.key]}_{_word(array)}", names.values())
        texts.append(_Printer(function, names).text())

    for function in functions.values():
        define(function)
    return "\n".join(texts)


def _free(name: str, taken: Iterable[str]) -> str:
    names, free, k = set(taken), name, 2
    while free in names:
        free, k = f"{name}_{k}", k + 1
    return free


def _word(name: str) -> str:
    """Return a variable's name; those that the reader made have dots."""
    name = name.replace(".", "_") if not name[0].isdigit() else f"held{name.replace('.', '_')}"
    return f"{name}_" if name in RESERVED else name


def _literal(value: float | int | bool) -> tuple[str, int]:
    if isinstance(value, bool):
        return ("true" if value else "false"), 20
    if isinstance(value, float) and not math.isfinite(value):
        return ("NaN" if math.isnan(value) else "Infinity" if value > 0 else "-Infinity"), 20 if value > 0 else 14
    text = repr(value).removesuffix(".0")
    return text, 14 if text.startswith("-") else 20


class _Printer:
    """Prints one function."""

    def __init__(self, function: lang.Function, names: dict[object, str]) -> None:
        self.function, self.names = function, names
        self.counters = 0

    def text(self) -> str:
        """Return the definition, with the tables that it reads before it."""
        f = self.function
        tables = [
            f"const {self.names[f.key, name]} = [{', '.join(_literal(x)[0] for x in values)}];"
            for name, values in f.tables.items()
        ]
        parameters = {p.name for p in f.parameters}
        local = [_word(name) for name in f.variables if name not in parameters and name not in f.fixed]
        lines = [f"let {', '.join(local)};"] if local else []
        lines += self.lines(f.body)
        head = f"function {self.names[f.key]}({', '.join(_word(p.name) for p in f.parameters)}) {{"
        return "\n".join([*tables, head, *lines, "}"])

    def lines(self, statements: tuple[lang.Statement, ...]) -> list[str]:
        """Return statements as lines."""
        return [line for statement in statements for line in self.statement(statement)]

    def statement(self, s: lang.Statement) -> list[str]:
        """Return one statement."""
        if isinstance(s, lang.Assign):
            once = "const " if s.name in self.function.fixed else ""
            return [f"{once}{_word(s.name)} = {self.value(s.value)};"]
        if isinstance(s, lang.Store):
            return [f"{_word(s.array)}[{self.value(s.index)}] = {self.value(s.value)};"]
        if isinstance(s, lang.Evaluate):
            return [f"{self.value(s.call)};"]
        if isinstance(s, lang.Return):
            return [f"return {self.value(s.value)};"]
        if isinstance(s, lang.Leave):
            return [f"{s.how};"]
        if isinstance(s, lang.If):
            lines = [f"if ({self.value(s.test)}) {{", *self.lines(s.then)]
            return [*lines, *(["} else {", *self.lines(s.otherwise)] if s.otherwise else []), "}"]
        if isinstance(s, lang.While):
            return [f"while ({self.value(s.test)}) {{", *self.lines(s.body), "}"]
        assert isinstance(s, lang.For), "all kinds of statements are known"
        self.counters += 1
        i, sign = f"counter{self.counters}", "<" if s.step > 0 else ">"
        head = f"for (let {i} = {self.value(s.start)}, end = {self.value(s.stop)}; {i} {sign} end; {i} += {s.step}) {{"
        return [head, f"{_word(s.name)} = {i};", *self.lines(s.body), "}"]

    def value(self, e: lang.Expression, level: int = 0) -> str:
        """Return an expression, in parentheses where it binds weaker than `level`."""
        text, own = self.expression(e)
        return text if own >= level else f"({text})"

    def expression(self, e: lang.Expression) -> tuple[str, int]:
        """Return an expression and how strongly it binds."""
        if isinstance(e, lang.Constant):
            return _literal(e.value)
        if isinstance(e, lang.Variable):
            return _word(e.name), 20
        if isinstance(e, lang.ArrayElement):
            constant = e.array in self.function.tables
            array = self.names[self.function.key, e.array] if constant else _word(e.array)
            return f"{array}[{self.value(e.index)}]", 20
        if isinstance(e, lang.FunctionCall):
            arguments = (_word(a) if isinstance(a, str) else self.value(a) for a in e.arguments)
            return f"{self.names[e.function.key]}({', '.join(arguments)})", 20
        if isinstance(e, lang.Logic):
            sign, own = _SIGNS[e.name]
            return f"{self.value(e.first, own)} {sign} {self.value(e.second, own + 1)}", own
        if isinstance(e, lang.Choice):
            return f"{self.value(e.test, 4)} ? {self.value(e.chosen, 3)} : {self.value(e.otherwise, 3)}", 2
        assert isinstance(e, lang.ScalarOperation), "emitted functions have no other expressions"
        return self.operation(e)

    def operation(self, e: lang.ScalarOperation) -> tuple[str, int]:
        """Return an operation."""
        name, first = e.name, e.arguments[0]
        if name in ("and", "or") and e.type != "bool":
            return f"{self.value(first, 8)} {'&' if name == 'and' else '|'} {self.value(e.arguments[1], 8)}", 7
        if name in _SIGNS:
            sign, own = _SIGNS[name]
            room = "" if sign in "*/" else " "  # a sign may stand behind + and -
            return f"{self.value(first, own)}{room}{sign}{room}{self.value(e.arguments[1], own + 1)}", own
        if name == "neg":
            return f"-{self.value(first, 15)}", 14
        if name == "not":
            return f"!{self.value(first, 15)}", 14
        if name in ("float", "int", "bool"):
            return self.converted(name, first)
        if name == "pow" and e.arguments[1].type == "int":
            exponent = e.arguments[1]
            assert isinstance(exponent, lang.Constant), "a power with a literal exponent"
            if exponent.value == 2:
                return f"square({self.value(first)})", 20
            return f"power({self.value(first)}, {int(exponent.value)})", 20
        called = _CALLED.get(name, "Math.pow" if name == "pow" else f"Math.{name.removeprefix('math.')}")
        return f"{called}({', '.join(self.value(a) for a in e.arguments)})", 20

    def converted(self, kind: str, value: lang.Expression) -> tuple[str, int]:
        """Return a value in another type."""
        if kind == "bool":
            return f"{self.value(value, 10)} !== 0", 9
        if value.type == "bool":
            return f"({self.value(value)} ? 1 : 0)", 20
        return (f"Math.trunc({self.value(value)})", 20) if kind == "int" else self.expression(value)
