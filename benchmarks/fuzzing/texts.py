"""Texts and values that programs stumble over."""

from __future__ import annotations

import random
from typing import Any

#: What a file tries to make if any of its text is executed.
CANARY = "EXECUTED_FROM_A_FILE"
_CODE = (
    f"open('{CANARY}', 'w')",
    f"__import__('os').system('touch {CANARY}')",
    f'"""\nimport os; os.system("touch {CANARY}")\n"""',
    f"'''\nopen('{CANARY}', 'w')\n'''",
    f"\nimport os; os.system('touch {CANARY}')\n#",
    f'"); open("{CANARY}", "w"); ("',
    f"]\nopen('{CANARY}', 'w')\n#",
    f"{{{{ ''.__class__.__mro__[1].__subclasses__() }}}}{CANARY}",
    f"{{% for x in range(9) %}}{CANARY}{{% endfor %}}",
    f"\\\nopen('{CANARY}', 'w')",
    f"$(touch {CANARY})",
    f"`touch {CANARY}`",
)
_ODD = (
    "",
    " ",
    "\n",
    "\t",
    "\x00",
    "\x07",
    "\x1b[31mred\x1b[0m",
    "\x7f",
    "\x85",
    "\u2028",
    "\u202eabc",
    "\ufeff",
    "\u0000",
    "é",
    "Ω",
    "ﬁ",
    "x" * 65,
    "x" * 5000,
    "𝒙",
    "１２",
    "a.b",
    "a-b",
    "a b",
    "_a",
    "__init__",
    "__class__",
    "lambda",
    "None",
    "True",
    "nan",
    "inf",
    "ground",
    "t",
    "s",
    "rate",
    "pi",
    "sin",
    "centre",
    "self",
    "../../etc/passwd",
    "/dev/zero",
    "file:///dev/stdin",
    "%s%s%s%n",
    "{0.__class__}",
    "\\N{DIGIT ONE}",
    "#",
    '"',
    "'",
    "\\",
    "🙂" * 40,
    "a\r\nb",
)
_FORMULAS = (
    "1/0",
    "0/0",
    "sqrt(-1)",
    "log(0)",
    "1e308*1e308",
    "9**9**9",
    "(-1)**0.5",
    "2**-64",
    "2**65",
    "1e400",
    "1_000",
    "0x10",
    "1j",
    "1if 1<2else 3",
    "a if b",
    "piecewise(1, 2)",
    "piecewise(1<2, 2)",
    "min(1)",
    "max()",
    "sin(1, 2)",
    "atan2(1)",
    "t.real",
    "x.__class__",
    "().__class__",
    "[1]",
    "{1: 2}",
    "lambda: 0",
    "yield",
    "await x",
    "x := 1",
    "f'{1}'",
    "'a'",
    "1 < 2 < 3",
    "not not not 1",
    "----1",
    "1 +",
    ")(",
    "+".join(["1"] * 600),
    "(" * 99 + "1" + ")" * 99,
    "(" * 101 + "1" + ")" * 101,
    "sin(" * 98 + "t" + ")" * 98,
    "-" * 500 + "1",
    "not " * 300 + "1",
    "1" + "*1" * 3000,
    "1" * 400,
    "0." + "1" * 4000,
    "t" * 9999,
    "((t))" * 100,
    "abs(min(t, max(t, 1)))",
    "1 if t > 0 else 1/0",
    "t**t",
    "(0*t)**-1",
    "exp(exp(exp(9)))",
    "acos(2)",
    "t and t",
    "1 == 1",
    "1 != 1",
    "1 // 2",
    "5 % 3",
    "1 | 2",
    "~1",
    "2 ^ 3",
    "not_a_name + 1",
    "sin",
    "sin + 1",
    "sin(sin)",
)
_NUMBERS: tuple[Any, ...] = (
    0,
    0.0,
    -0.0,
    -1,
    1,
    True,
    False,
    10**18,
    -(10**18),
    2**63 - 1,
    -(2**63),
    1e-308,
    5e-324,
    1e308,
    -1e308,
    float("nan"),
    float("inf"),
    float("-inf"),
    1e-9,
    1e9,
    1e30,
    2**62,
    3.141592653589793,
)


def text(rng: random.Random) -> str:
    """Return a text that is odd, code, or a formula that may be none."""
    choice = rng.random()
    if choice < 0.3:
        return rng.choice(_CODE)
    if choice < 0.6:
        return rng.choice(_FORMULAS)
    if choice < 0.9:
        return rng.choice(_ODD)
    return "".join(
        chr(rng.choice([rng.randrange(32, 127), rng.randrange(0x20, 0xD7FF)])) for _ in range(rng.randrange(30))
    )


def number(rng: random.Random) -> Any:
    """Return a number that is awkward somewhere."""
    if rng.random() < 0.3:
        return rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-320, 308)
    return rng.choice(_NUMBERS)


def value(rng: random.Random, depth: int = 0) -> Any:
    """Return any value a TOML file may hold."""
    choice = rng.random()
    if choice < 0.4:
        return text(rng)
    if choice < 0.75 or depth > 3:
        return number(rng)
    if choice < 0.9:
        return [value(rng, depth + 1) for _ in range(rng.choice([0, 1, 2, 3, 3, 4, 6, 7]))]
    return {key(rng): value(rng, depth + 1) for _ in range(rng.randrange(4))}


def key(rng: random.Random) -> str:
    """Return a key that may be no name."""
    return rng.choice(_ODD) if rng.random() < 0.5 else rng.choice(["type", "mass", "at", "x", "a1", "Ground", "BODY"])
