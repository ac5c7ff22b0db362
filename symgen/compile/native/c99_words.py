"""Words of C99: reserved ones, helpers outside its library, macros and numbers for 64 and 32 bits."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

#: Functions outside the C library that printed ones call, by name.
HELPERS = {
    "least": "static real least(real a, real b) { return b < a ? b : a; }",
    "greatest": "static real greatest(real a, real b) { return b > a ? b : a; }",
    "least_of_integers": "static int least_of_integers(int a, int b) { return b < a ? b : a; }",
    "greatest_of_integers": "static int greatest_of_integers(int a, int b) { return b > a ? b : a; }",
    "floored_quotient": "static int floored_quotient(int a, int b) { return a/b - (a % b && (a < 0) != (b < 0)); }",
    "square": "static real square(real x) { return x*x; }",
    "floored": "static real floored(real a, real b) { return M(floor)(a/b); }",
    "rest": "static real rest(real a, real b) { return a - b*M(floor)(a/b); }",
    "quotient_of_integers": "static int quotient_of_integers(int a, int b) "
    "{ return b == 0 ? 0 : a/b - (a % b && (a < 0) != (b < 0)); }",
    "rest_of_integers": "static int rest_of_integers(int a, int b) "
    "{ return b == 0 ? 0 : a % b + ((a % b && (a < 0) != (b < 0)) ? b : 0); }",
    "size_of_integer": "static int size_of_integer(int a) { return a < 0 ? -a : a; }",
    "power": "static real power(real x, int n) {\n"
    "real result = 1.0;\nfor (; n; n >>= 1) {\nif (n & 1) result *= x;\nx *= x;\n}\nreturn result;\n}",
}
#: Macros in printed text, with their values for 32 and for 64 bits; EPSILON serves templates.
_MACROS = (
    ("M(function)", "function##f", "function"),
    ("SMALL(x)", "1.2e-38f", "x"),
    ("LARGE(x)", "3.4e38f", "x"),
    ("FINE(x, single)", "single", "x"),
    ("EPSILON", "1.2e-7f", "2.2e-16"),
)
#: 20 roundings of a number of 32 bits, the least tolerance.
_LEAST = 2.4e-6
_KEYWORDS = (
    "auto break case char const continue default do double else enum extern float for goto if inline int long register "
    "restrict return short signed sizeof static struct switch typedef union unsigned void volatile while _Bool "
    "_Complex _Imaginary asm typeof linux unix near far small"
)
_LIBRARY = (
    "acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh erf erfc exp exp2 expm1 fabs fdim floor fma "
    "fmax fmin fmod frexp gamma hypot ilogb j0 j1 jn ldexp lgamma llrint llround log log10 log1p log2 logb lrint "
    "lround modf nan nearbyint nextafter nexttoward pow remainder remquo rint round scalbln scalbn scalb signgam sin "
    "sincos sinh sqrt tan tanh tgamma trunc y0 y1 yn significand drem finite isinf isnan isfinite abs abort exit main "
    "printf memcpy memset div labs atoi atof system time clock signal index double_t float_t"
)
_OWN = ("end", "real", "mechanism", "model", "I", "EOF", "NULL", "NAN", *(head.split("(")[0] for head, _, _ in _MACROS))
#: Reserved words: keywords, names of the library, and the files' own names.
RESERVED = frozenset((*_KEYWORDS.split(), *_LIBRARY.split(), *HELPERS, *_OWN))
#: Most characters of a line; C's compilers need not take lines of more than 4095.
_WIDTH = 120


def add_helpers(texts: Sequence[str], integer: str = "int") -> str:
    """Return functions after the helpers that they call."""
    text = "\n\n".join(texts)
    used = (helper for name, helper in HELPERS.items() if re.search(rf"\b{name}\(", text))
    helpers = [helper.replace("int ", f"{integer} ") for helper in used]
    return "\n\n".join([*helpers, text])


def break_line(line: str) -> str:
    """Return a line of C as lines of allowed length, broken at spaces."""
    lines = []
    while len(line) > _WIDTH and (at := line.rfind(" ", 0, _WIDTH)) > 0:
        lines.append(line[:at])
        line = line[at + 1 :]
    return "\n".join([*lines, line])


def c_number(value: float) -> str:
    """Return a number of 64 bits in C; a macro replaces it where 32 bits cannot hold it."""
    if math.isfinite(value):
        size = abs(value)
        text = repr(float(value))
        return f"SMALL({text})" if 0.0 < size < 1e-37 else f"LARGE({text})" if size > 1e38 else text
    return "NAN" if math.isnan(value) else "INFINITY" if value > 0 else "-INFINITY"


def c_limit(value: float) -> str:
    """Return a tolerance in C, with a larger one for 32 bits if needed."""
    return f"FINE({value!r}, {_LEAST})" if value < _LEAST else c_number(value)


def macro_definitions(single: str) -> str:
    """Return the macros of printed text; for 32 bits where the macro `single` is defined."""
    lines = [[f"#define {head} {values[k]}" for head, *values in _MACROS] for k in range(2)]
    return "\n".join([f"#ifdef {single}", *lines[0], "#else", *lines[1], "#endif"])
