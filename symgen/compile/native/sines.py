"""Sines and cosines of several angles at once, in vectors: in the plane they are a third of a right-hand side.

Straight code with sines of three angles or more, all computed before the first sine is used, gets them from one
call. The algorithm is fdlibm's: angles are reduced by multiples of pi/2 in three parts (Cody and Waite), and two
polynomials follow. Results are within one unit of the last place (`tests/compile/native/test_sines.py`), like those of
the C library, but not always the same; nothing is contracted, so every processor gives the same bits. Angles of more
than 65,000 turns, infinities and nan are left to the C library, all of a call together.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator

from symgen.compile.native import language as lang

#: Fewer angles take as long one by one: their calls overlap with each other, and with the code around them.
FEWEST = 3
#: Most angles of a call.
MOST = 8
NAMES = ("math.sin", "math.cos")
#: Angles from here on [rad] are left to the C library; below, multiples of the parts of pi/2 are exact.
FAR = 4e5
#: Added and subtracted again, this leaves the nearest integer, which the last bits of the sum hold as well.
ROUND = 6755399441055744.0
TWO_OVER_PI = 6.36619772367581382433e-01
#: pi/2 in parts of 33 bits, and the remainder.
HALF_PI = (1.57079632673412561417, 6.07710050630396597660e-11, 2.02226624879595063154e-21)
SINE = (
    *(-1.66666666666666324348e-01, 8.33333333332248946124e-03, -1.98412698298579493134e-04),
    *(2.75573137070700676789e-06, -2.50507602534068634195e-08, 1.58969099521155010221e-10),
)
COSINE = (
    *(4.16666666666666019037e-02, -1.38888888888741095749e-03, 2.48015872894767294178e-05),
    *(-2.75573143513906633035e-07, 2.08757232129817482790e-09, -1.13596475577881948265e-11),
)


def groups_of_angles(function: lang.Function) -> dict[int, list[tuple[lang.Expression, ...]]]:
    """Return the groups of angles with a common call.

    Parameters
    ----------
    function : Function
        Any function; only its statements before the first choice or loop count.

    Returns
    -------
    dict of int to list of tuple of Expression
        Angles of each call, by the index of the statement before which they are computed and used.
    """
    straight = _straight_statements(function)
    since: dict[str, int] = {p.name: 0 for p in function.parameters if not p.array and p.name not in function.variables}
    uses: dict[lang.Expression, int] = {}  # first statement that uses it
    for i, statement in enumerate(straight):
        for angle in filter(is_simple, _angles_in_order(_expressions_of_statement(statement))):
            uses.setdefault(angle, i)
        if isinstance(statement, lang.Assign) and statement.name in function.fixed:
            since[statement.name] = i + 1
    ready = {angle: at for angle in uses if (at := _index_when_ready(angle, since)) is not None}
    calls: dict[int, list[tuple[lang.Expression, ...]]] = {}
    waiting = sorted(ready, key=uses.__getitem__)
    while waiting:
        here = uses[waiting[0]]
        together = [angle for angle in waiting if ready[angle] <= here]
        waiting = [angle for angle in waiting if ready[angle] > here]
        while len(together) >= FEWEST:
            calls.setdefault(here, []).append(tuple(together[:MOST]))
            together = together[MOST:]
    return calls


def _straight_statements(function: lang.Function) -> list[lang.Statement]:
    """Return the statements before the first that is not straight."""
    statements: list[lang.Statement] = []
    for statement in function.body:
        if not isinstance(statement, lang.Assign | lang.Store | lang.Evaluate):
            break
        statements.append(statement)
    return statements


def _expressions_of_statement(statement: lang.Statement) -> lang.Expression:
    """Return the expressions of a straight statement."""
    if isinstance(statement, lang.Assign | lang.Store):
        return statement.value
    assert isinstance(statement, lang.Evaluate), "a straight statement"
    return statement.call


def _angles_in_order(e: lang.Expression | str) -> Iterator[lang.Expression]:
    """Yield the arguments of sines and cosines that are always evaluated, innermost first."""
    if isinstance(e, lang.ScalarOperation | lang.FunctionCall):
        for argument in e.arguments:
            yield from _angles_in_order(argument)
        if isinstance(e, lang.ScalarOperation) and e.name in NAMES:
            yield e.arguments[0]


def is_simple(e: lang.Expression) -> bool:
    """Whether a value is a sum or product of variables and numbers: other angles are processed one by one."""
    if isinstance(e, lang.ScalarOperation):
        return e.name in ("add", "sub", "mul", "neg") and all(map(is_simple, e.arguments))
    return isinstance(e, lang.Constant | lang.Variable)


def _index_when_ready(e: lang.Expression, since: dict[str, int]) -> int | None:
    """Return the index of the statement before which a simple value is computed, None if a variable of it changes."""
    if isinstance(e, lang.Constant):
        return 0
    if isinstance(e, lang.Variable):
        return since.get(e.name)
    assert isinstance(e, lang.ScalarOperation), "a simple value"
    parts = [_index_when_ready(argument, since) for argument in e.arguments]
    return None if None in parts else max(part for part in parts if part is not None)


def function_width(count: int) -> int:
    """Return the number of angles that the function for `count` of them takes."""
    return 4 if count <= 4 else MOST


def result_type(n: int) -> str:
    """Return the result type of the function for `n` angles: sines and cosines."""
    return f"{{<{n} x double>, <{n} x double>}}"


def sine_name(n: int) -> str:
    """Return the name of the function for `n` angles."""
    return f"@symgen.sines{n}"


def function_definition(n: int) -> str:
    """Return the text of the function for `n` angles; its only jump is a ``switch``, see `machine.py`."""
    return _Writer(n).text()


class _Writer:
    """Writes the function for vectors of one length."""

    def __init__(self, n: int) -> None:
        self.n, self.count = n, 0
        self.float, self.whole, self.bit = (f"<{n} x {kind}>" for kind in ("double", "i64", "i1"))
        self.lines: list[str] = []

    def write_instruction(self, text: str) -> str:
        """Write an instruction and return its value."""
        self.count += 1
        self.lines.append(f"  %.{self.count} = {text}")
        return f"%.{self.count}"

    def number(self, value: float) -> str:
        """Return a vector of equal numbers."""
        bits = struct.pack(">d", value).hex()
        return f"<{', '.join([f'double 0x{bits}'] * self.n)}>"

    def integer(self, value: int) -> str:
        """Return a vector of equal integers."""
        return f"<{', '.join([f'i64 {value}'] * self.n)}>"

    def add(self, a: str, b: str) -> str:
        """Write a sum."""
        return self.write_instruction(f"fadd {self.float} {a}, {b}")

    def sub(self, a: str, b: str) -> str:
        """Write a difference."""
        return self.write_instruction(f"fsub {self.float} {a}, {b}")

    def mul(self, a: str, b: str) -> str:
        """Write a product."""
        return self.write_instruction(f"fmul {self.float} {a}, {b}")

    def polynomial(self, coefficients: tuple[float, ...], x: str) -> str:
        """Write a polynomial by Horner's rule."""
        value = self.number(coefficients[-1])
        for coefficient in reversed(coefficients[:-1]):
            value = self.add(self.mul(value, x), self.number(coefficient))
        return value

    def write_bits(self, value: str) -> str:
        """Write the bits of numbers as integers."""
        return self.write_instruction(f"bitcast {self.float} {value} to {self.whole}")

    def write_logic(self, operation: str, a: str, b: str) -> str:
        """Write an operation on integers."""
        return self.write_instruction(f"{operation} {self.whole} {a}, {b}")

    def change_sign_by_quarters(self, value: str, quarter: str) -> str:
        """Write numbers with the sign changed where a number of quarter turns is 2 or 3 modulo 4."""
        sign = self.write_logic("shl", self.write_logic("and", quarter, self.integer(2)), self.integer(62))
        changed = self.write_logic("xor", self.write_bits(value), sign)
        return self.write_instruction(f"bitcast {self.whole} {changed} to {self.float}")

    def write_end(self, sines: str, cosines: str) -> None:
        """Write the end."""
        pair = self.write_instruction(f"insertvalue {result_type(self.n)} undef, {self.float} {sines}, 0")
        pair = self.write_instruction(f"insertvalue {result_type(self.n)} {pair}, {self.float} {cosines}, 1")
        self.lines.append(f"  ret {result_type(self.n)} {pair}")

    def write_near_angles(self) -> None:
        """Write the code for angles that are not far."""
        shifted = self.add(self.mul("%x", self.number(TWO_OVER_PI)), self.number(ROUND))
        turns = self.sub(shifted, self.number(ROUND))
        first, second, last = (self.mul(turns, self.number(part)) for part in HALF_PI)
        before = self.sub("%x", first)
        after = self.sub(before, second)
        left = self.sub(last, self.sub(self.sub(before, after), second))
        z = self.sub(after, left)
        rest = self.sub(self.sub(after, z), left)  # z + rest is the angle
        zz = self.mul(z, z)
        cube = self.mul(zz, z)
        half = self.mul(rest, self.number(0.5))
        s = self.sub(half, self.mul(cube, self.polynomial(SINE[1:], zz)))
        s = self.sub(self.sub(self.mul(zz, s), rest), self.mul(cube, self.number(SINE[0])))
        sine = self.sub(z, s)
        c = self.mul(self.mul(zz, zz), self.polynomial(COSINE, zz))
        half = self.mul(zz, self.number(0.5))
        near = self.sub(self.number(1.0), half)
        c = self.add(self.sub(self.sub(self.number(1.0), near), half), self.sub(c, self.mul(z, rest)))
        cosine = self.add(near, c)
        quarter = self.write_bits(shifted)
        odd = self.write_instruction(f"trunc {self.whole} {quarter} to {self.bit}")
        pair = (f"{self.float} {value}" for value in (sine, cosine))
        sine, cosine = pair
        chosen = self.write_instruction(f"select {self.bit} {odd}, {cosine}, {sine}")
        other = self.write_instruction(f"select {self.bit} {odd}, {sine}, {cosine}")
        self.write_end(
            self.change_sign_by_quarters(chosen, quarter),
            self.change_sign_by_quarters(other, self.write_logic("add", quarter, self.integer(1))),
        )

    def write_far_angle(self) -> None:
        """Write the code for an angle that is far or no number."""
        vectors = {"sin": "undef", "cos": "undef"}
        for i in range(self.n):
            angle = self.write_instruction(f"extractelement {self.float} %x, i32 {i}")
            for each in vectors:
                value = self.write_instruction(f"call double @llvm.{each}.f64(double {angle})")
                vectors[each] = self.write_instruction(
                    f"insertelement {self.float} {vectors[each]}, double {value}, i32 {i}"
                )
        self.write_end(vectors["sin"], vectors["cos"])

    def text(self) -> str:
        """Return the function."""
        head = (
            f"define internal {result_type(self.n)} {sine_name(self.n)}({self.float} %x) noinline nounwind "
            f"memory(none) {{"
        )
        size = self.write_instruction(f"call {self.float} @llvm.fabs.v{self.n}f64({self.float} %x)")
        moderate = self.write_instruction(f"fcmp olt {self.float} {size}, {self.number(FAR)}")
        every = self.write_instruction(f"call i1 @llvm.vector.reduce.and.v{self.n}i1({self.bit} {moderate})")
        self.lines += [f"  switch i1 {every}, label %.far [i1 true, label %.near]", ".near:"]
        self.write_near_angles()
        self.lines.append(".far:")
        self.write_far_angle()
        declared = (
            f"declare {self.float} @llvm.fabs.v{self.n}f64({self.float})",
            f"declare i1 @llvm.vector.reduce.and.v{self.n}i1({self.bit})",
        )
        return "\n".join([head, ".entry:", *self.lines, "}", *declared])
