"""Values of straight functions at eight nodes of one run, as text for LLVM: operations on vectors of eight numbers."""

from __future__ import annotations

from collections.abc import Callable

from symgen.compile.native import language as lang
from symgen.compile.native import sines
from symgen.compile.native.llvm_values import COMPARED, FLOATS, INTS, TYPES, ValuePrinter, float_literal
from symgen.compile.native.read_values import Foreign
from symgen.compile.native.types import NODES

#: Arrays of a right-hand side with one value per node, shared ones, and those that are not read.
OWN, SHARED, WRITTEN = ("y",), ("p", "w"), ("ydot",)
#: Mathematical functions with a form in vectors, by LLVM's names.
_VECTORS = {
    **{"fabs": "fabs", "abs": "fabs", "math.fabs": "fabs", "math.sqrt": "sqrt", "math.copysign": "copysign"},
    **{"math.floor": "floor", "math.ceil": "ceil", "round": "rint"},
}
#: Conversions by the type after and before them.
_CONVERTED: dict[str, dict[str, str]] = {
    "float": {"int": "sitofp", "bool": "uitofp"},
    "int": {"float": "fptosi", "bool": "zext"},
    "bool": {},
}


def wide_type(kind: lang.Scalar) -> str:
    """Return the type of one value per node."""
    return f"<{NODES} x {TYPES[kind]}>"


class NodeValuePrinter(ValuePrinter):
    """Prints values that are the same at all nodes, or vectors of one value per node.

    Attributes
    ----------
    declared : set of str
        Declarations of the called functions on vectors.
    """

    def __init__(self, function: lang.Function, symbol: Callable[[lang.Function], str]) -> None:
        super().__init__(function, symbol)
        self.declared: set[str] = set()
        self.vectors: set[str] = {"t"}  # variables with one value per node
        self.equal: dict[tuple[str, str], str] = {}  # vectors of equal numbers
        self.far = ""
        self.stored: dict[tuple[str, int], tuple[str, bool]] = {}  # elements written so far: value, whether a vector
        self.calls: dict[object, lang.Function] = {}  # called functions

    def index_text(self, index: lang.Expression) -> int:
        """Return an index: a number, or a sum of numbers."""
        if isinstance(index, lang.ScalarOperation) and index.name == "add":
            return sum(self.index_text(part) for part in index.arguments)
        if not isinstance(index, lang.Constant):
            raise Foreign("an index that is computed")
        return int(index.value)

    def call(self, e: lang.FunctionCall) -> str:
        """Print a call of another function with numbers that are the same at all nodes."""
        self.calls[e.function.key] = e.function
        return super().call(e)

    def is_vector(self, e: lang.Expression | str) -> bool:
        """Whether an expression has one value per node.

        Raises
        ------
        Foreign
            If it takes an array with one value per node.
        """
        if isinstance(e, str):
            if e not in SHARED:
                raise Foreign(f"a function that is handed the array '{e}'")
            return False
        if isinstance(e, lang.Variable):
            return e.name in self.vectors
        if isinstance(e, lang.ArrayElement):
            if e.array in self.function.tables:
                return self.is_vector(e.index)
            if e.array in WRITTEN and (e.array, self.index_text(e.index)) not in self.stored:
                raise Foreign("a rate that is not written yet")
            if e.array not in (*OWN, *SHARED, *WRITTEN):
                raise Foreign(f"an element of '{e.array}' in straight code")
            return e.array in OWN or self.stored.get((e.array, self.index_text(e.index)), ("", False))[1]
        if isinstance(e, lang.ScalarOperation | lang.FunctionCall | lang.Invoke):
            return any([self.is_vector(a) for a in e.arguments])
        if isinstance(e, lang.Logic):
            return any([self.is_vector(e.first), self.is_vector(e.second)])
        if isinstance(e, lang.Choice):
            return any([self.is_vector(a) for a in (e.test, e.chosen, e.otherwise)])
        return False

    def value_or_vector(self, e: lang.Expression) -> str:
        """Print an expression and return its value, a vector where it has one value per node."""
        return self.values_at_nodes(e) if self.is_vector(e) else self.value(e)

    def value(self, e: lang.Expression) -> str:
        """Print an expression that is the same at all nodes."""
        if isinstance(e, lang.ArrayElement) and (e.array, self.index_text(e.index)) in self.stored:
            return self.stored[e.array, self.index_text(e.index)][0]
        return super().value(e)

    def values_at_nodes(self, e: lang.Expression) -> str:
        """Print an expression and return its values at the nodes."""
        if not self.is_vector(e):
            return self.spread_number(self.value(e), e.type)
        if isinstance(e, lang.Variable):
            return self.values[e.name]
        if isinstance(e, lang.ArrayElement):
            index = self.index_text(e.index)
            if (e.array, index) in self.stored:
                return self.stored[e.array, index][0]
            place = self.element_address(e.array, lang.Constant("int", NODES * index))
            return self.print_instruction(f"load {wide_type('float')}, ptr {place}, align 8")
        if isinstance(e, lang.ScalarOperation):
            return self.operate_at_nodes(e)
        if isinstance(e, lang.Logic):
            return self.print_instruction(
                f"{e.name} {wide_type('bool')} {self.values_at_nodes(e.first)}, {self.values_at_nodes(e.second)}"
            )
        if isinstance(e, lang.Choice):
            test, chosen, otherwise = (
                self.values_at_nodes(e.test),
                self.values_at_nodes(e.chosen),
                self.values_at_nodes(e.otherwise),
            )
            return self.choose_at_nodes(test, chosen, otherwise, e.type)
        if isinstance(e, lang.FunctionCall):
            return self.node_by_node(e.type, e.arguments, lambda values: self.call_with_values(e, values))
        raise Foreign(f"a {type(e).__name__} in straight code")

    def spread_number(self, value: str, kind: lang.Scalar) -> str:
        """Return a vector of equal numbers."""
        if (value, kind) not in self.equal:
            if value.startswith("%"):
                one = self.print_instruction(f"insertelement {wide_type(kind)} poison, {TYPES[kind]} {value}, i32 0")
                vector = self.print_instruction(
                    f"shufflevector {wide_type(kind)} {one}, {wide_type(kind)} poison, <{NODES} x i32> zeroinitializer"
                )
            else:
                number = value if kind != "bool" else str(value == "1").lower()
                vector = f"<{', '.join([f'{TYPES[kind]} {number}'] * NODES)}>"
            self.equal[value, kind] = vector
        return self.equal[value, kind]

    def operate_at_nodes(self, e: lang.ScalarOperation) -> str:
        """Print an operation on vectors."""
        name, first = e.name, e.arguments[0].type
        if name in sines.NAMES:
            return self.print_sine(name, e.arguments[0])
        if name == "pow" and isinstance(e.arguments[1], lang.Constant) and e.arguments[1].type == "int":
            return self.power(self.values_at_nodes(e.arguments[0]), int(e.arguments[1].value))
        if name in (*_VECTORS, "neg", "not", "min", "max", *FLOATS, *INTS, *COMPARED["float"], *_CONVERTED):
            values = [self.values_at_nodes(a) for a in e.arguments]
            return self.print_operation(e.type, name, first, values)
        return self.node_by_node(
            e.type, e.arguments, lambda values: self.function_of_math(name.removeprefix("math."), values)
        )

    def print_operation(self, kind: lang.Scalar, name: str, first: lang.Scalar, values: list[str]) -> str:
        """Print an operation on printed arguments of type `first`."""
        flag = self.flag if first == "float" else ""
        if name in COMPARED["float"]:
            compare = "fcmp" if first == "float" else "icmp"
            return self.print_instruction(
                f"{compare}{flag} {COMPARED[first][name]} {wide_type(first)} {', '.join(values)}"
            )
        if name in ("min", "max"):
            sign = COMPARED[kind]["lt" if name == "min" else "gt"]
            compare = f"fcmp{flag}" if kind == "float" else "icmp"
            test = self.print_instruction(f"{compare} {sign} {wide_type(kind)} {values[1]}, {values[0]}")
            return self.choose_at_nodes(test, values[1], values[0], kind)
        if kind == "float" and name in FLOATS:
            return self.print_instruction(f"{FLOATS[name]}{flag} {wide_type('float')} {values[0]}, {values[1]}")
        if name in INTS:
            return self.print_instruction(f"{INTS[name]} {wide_type(kind)} {values[0]}, {values[1]}")
        if name == "neg":
            zero = self.spread_number(float_literal(-0.0) if kind == "float" else "0", kind)
            return self.print_instruction(
                f"{'fsub' + flag if kind == 'float' else 'sub'} {wide_type(kind)} {zero}, {values[0]}"
            )
        if name == "not":
            return self.print_instruction(f"xor {wide_type('bool')} {values[0]}, {self.spread_number('1', 'bool')}")
        if name in _CONVERTED:
            if name == "bool":
                zero = self.spread_number(float_literal(0.0) if first == "float" else "0", first)
                return self.print_operation("bool", "ne", first, [values[0], zero])
            return self.print_instruction(
                f"{_CONVERTED[name][first]} {wide_type(first)} {values[0]} to {wide_type(kind)}"
            )
        if kind == "int" and name == "abs":
            below = self.print_operation("bool", "lt", "int", [values[0], self.spread_number("0", "int")])
            return self.choose_at_nodes(below, self.print_operation("int", "neg", "int", values), values[0], "int")
        value = self.call_intrinsic(_VECTORS[name], wide_type("float"), *((v, "float") for v in values))
        return (
            self.print_instruction(f"fptosi {wide_type('float')} {value} to {wide_type('int')}")
            if kind == "int"
            else value
        )

    def choose_at_nodes(self, test: str, one: str, other: str, kind: lang.Scalar) -> str:
        """Print a choice between two values at each node."""
        return self.print_instruction(
            f"select {wide_type('bool')} {test}, {wide_type(kind)} {one}, {wide_type(kind)} {other}"
        )

    def call_intrinsic(self, name: str, returned: str, *values: tuple[str, lang.Scalar]) -> str:
        """Print a call of an intrinsic function on vectors."""
        full = f"@llvm.{name}.v{NODES}{'i1' if values[0][1] == 'bool' else 'f64'}"
        self.declared.add(f"declare {returned} {full}({', '.join(wide_type(k) for _, k in values)})")
        return self.print_instruction(f"call {returned} {full}({', '.join(f'{wide_type(k)} {v}' for v, k in values)})")

    def power(self, base: str, exponent: int) -> str:
        """Print a power as products, by squaring, in the order of one node."""
        result = self.spread_number(float_literal(1.0), "float")
        while exponent:
            if exponent & 1:
                result = self.print_operation("float", "mul", "float", [result, base])
            exponent >>= 1
            base = self.print_operation("float", "mul", "float", [base, base])
        return result

    def print_sine(self, name: str, angle: lang.Expression) -> str:
        """Print the sine or cosine of an angle; both are kept."""
        if (name, angle) not in self.sines:
            value = self.values_at_nodes(angle)
            size = self.call_intrinsic("fabs", wide_type("float"), (value, "float"))
            limit = self.spread_number(float_literal(sines.FAR), "float")
            far = self.print_instruction(f"fcmp uge {wide_type('float')} {size}, {limit}")
            self.far = self.print_instruction(f"or {wide_type('bool')} {self.far}, {far}") if self.far else far
            for own, result in zip(sines.NAMES, self.sine_and_cosine(value), strict=True):
                self.sines[own, angle] = result
        return self.sines[name, angle]

    def sine_and_cosine(self, x: str) -> tuple[str, str]:
        """Print sine and cosine of angles that are not far: fdlibm's polynomials of the remainder of a quarter turn.

        Here operations may be contracted, and polynomials are summed in pairs, as later operations wait for them.
        """

        def number(value: float) -> str:
            return self.spread_number(float_literal(value), "float")

        def float_operation(name: str, a: str, b: str) -> str:
            return self.print_operation("float", name, "float", [a, b])

        def multiply_add(a: str, b: str, c: str) -> str:
            return float_operation("add", float_operation("mul", a, b), c)

        def polynomial(c: tuple[float, ...]) -> str:
            pairs = [multiply_add(number(c[k + 1]), z, number(c[k])) for k in (0, 2, 4)]
            return multiply_add(multiply_add(pairs[2], square, pairs[1]), square, pairs[0])

        whole, wide = wide_type("int"), wide_type("float")
        shifted = multiply_add(x, number(sines.TWO_OVER_PI), number(sines.ROUND))
        turns, r = self.print_instruction(f"fsub {wide} {shifted}, {number(sines.ROUND)}"), x
        for part in sines.HALF_PI:
            r = float_operation("sub", r, float_operation("mul", turns, number(part)))
        z = float_operation("mul", r, r)
        square = float_operation("mul", z, z)
        sine = multiply_add(float_operation("mul", r, z), polynomial(sines.SINE), r)
        cosine = multiply_add(square, polynomial(sines.COSINE), multiply_add(z, number(-0.5), number(1.0)))
        quarter = self.print_instruction(f"bitcast {wide} {shifted} to {whole}")
        odd = self.print_instruction(f"trunc {whole} {quarter} to {wide_type('bool')}")

        def turned(value: str, quarter: str) -> str:
            two, places = self.spread_number("2", "int"), self.spread_number("62", "int")
            sign = self.print_instruction(
                f"shl {whole} {self.print_instruction(f'and {whole} {quarter}, {two}')}, {places}"
            )
            bits = self.print_instruction(
                f"xor {whole} {self.print_instruction(f'bitcast {wide} {value} to {whole}')}, {sign}"
            )
            return self.print_instruction(f"bitcast {whole} {bits} to {wide}")

        following = self.print_operation("int", "add", "int", [quarter, self.spread_number("1", "int")])
        first, second = (
            self.choose_at_nodes(odd, cosine, sine, "float"),
            self.choose_at_nodes(odd, sine, cosine, "float"),
        )
        return turned(first, quarter), turned(second, following)

    def node_by_node(
        self, kind: lang.Scalar, arguments: tuple[lang.Expression | str, ...], call: Callable[[list[str]], str]
    ) -> str:
        """Print a function call for each node."""
        numbers = [a for a in arguments if not isinstance(a, str)]
        vectors, result = [(self.values_at_nodes(a), a.type) for a in numbers], "poison"
        for node in range(NODES):
            values = [self.print_instruction(f"extractelement {wide_type(k)} {v}, i32 {node}") for v, k in vectors]
            result = self.print_instruction(
                f"insertelement {wide_type(kind)} {result}, {TYPES[kind]} {call(values)}, i32 {node}"
            )
        return result

    def call_with_values(self, e: lang.FunctionCall, values: list[str]) -> str:
        """Print the call of another emitted function with printed numbers."""
        self.calls[e.function.key] = e.function
        left = iter(values)
        parts = [
            part
            for a in e.arguments
            for part in (self.call_argument(a) if isinstance(a, str) else [f"{TYPES[a.type]} {next(left)}"])
        ]
        return self.print_instruction(f'call {TYPES[e.type]} @"{self.symbol(e.function)}"({", ".join(parts)}) nounwind')
