"""Straight functions as text for LLVM that evaluates them at eight nodes of one run at once.

Time and state have one value per node, parameters and scratch are shared: element i of the state is at ``8 i + node``
of its array. The same operations as for one node are done on vectors of eight numbers, which processors with shorter
vectors process in several parts: the number of nodes is the same for all. Nothing is written to the scratch array.

Functions without a form in vectors, tables of data and those of the C library, are called node by node. Sines and
cosines use the coefficients of `symgen.native.sines`, for angles that are not large: the function returns 2 for others.
"""

from __future__ import annotations

from collections.abc import Callable

from msgspec.structs import replace

from symgen.native import language as lang
from symgen.native import sines
from symgen.native.llvm import FunctionPrinter, declarations, head, is_copied, reached
from symgen.native.llvm_values import COMPARED, FLOATS, INTS, TYPES, ValuePrinter, literal
from symgen.native.read_values import Foreign
from symgen.native.types import NODES

#: Summands of the function's result: a pivot is suspicious at a node; an angle is too large for the sines here.
SUSPICIOUS, FAR = 1, 2
#: Arrays of a right-hand side with one value per node, shared ones, and those that are not read.
_OWN, _SHARED, _WRITTEN = ("y",), ("p", "w"), ("ydot",)
#: Mathematical functions with a form in vectors, by LLVM's names.
_VECTORS = {
    **{"fabs": "fabs", "abs": "fabs", "math.fabs": "fabs", "math.sqrt": "sqrt", "math.copysign": "copysign"},
    **{"math.floor": "floor", "math.ceil": "ceil", "round": "rint"},
}


def node_module(
    function: lang.Function,
    name: str,
    symbol: Callable[[lang.Function], str],
    inlined: Callable[[lang.Function], bool],
) -> str:
    """Return the text of a module that defines a right-hand side at eight nodes.

    Parameters
    ----------
    function : Function
        The right-hand side at one node, ``rhs(t, y, p, w, iw, ydot)``.
    name : str
        Its name in machine code: ``name(t, y, p, w, ydot)``, where all are arrays.
    symbol, inlined : Callable
        As for `symgen.native.llvm.llvm_module`.

    Raises
    ------
    Foreign
        If the function is not straight code.
    """
    printer = NodesPrinter(with_choice_outside(function), symbol, name)
    texts = [printer.text()]
    copied, declared = dict[object, lang.Function](), dict[object, lang.Function]()
    for each in printer.calls.values():
        if is_copied(each) or inlined(each):
            defined, others = reached(each, inlined)
            copied |= {f.key: f for f in defined}
            declared |= {f.key: f for f in others}
        else:
            declared[each.key] = each
    texts += [FunctionPrinter(f, symbol, "available_externally ", False).text() for f in copied.values()]
    texts += [f"declare {head(f, symbol(f), named=False)}" for key, f in declared.items() if key not in copied]
    return "\n".join([*texts, *sorted(printer.declared), *declarations(texts), ""])


def with_choice_outside(function: lang.Function) -> lang.Function:
    """Return a function whose first call chooses among results with that choice around all of its statements.

    A function around a right-hand side, as of integrals, calls first what has a choice.
    """
    first = function.body[0]
    if not (isinstance(first, lang.Assign) and isinstance(first.value, lang.FunctionCall)):
        return function
    match first.value.function.body:
        case (lang.If(test=test, then=(lang.Return(value=yes),), otherwise=()), lang.Return(value=no)):
            rest = function.body[1:]
            then = lang.Assign(first.name, yes), *rest
            return replace(function, body=(lang.If(test, then, ()), lang.Assign(first.name, no), *rest))
    return function


class NodesPrinter(ValuePrinter):
    """Prints a straight function for eight nodes.

    Attributes
    ----------
    declared : set of str
        Declarations of the called functions on vectors.
    """

    def __init__(self, function: lang.Function, symbol: Callable[[lang.Function], str], name: str) -> None:
        super().__init__(function, symbol)
        self.name = name
        self.declared: set[str] = set()
        self.vectors: set[str] = {"t"}  # variables with one value per node
        self.equal: dict[tuple[str, str], str] = {}  # vectors of equal numbers
        self.far = ""
        self.stored: dict[tuple[str, int], tuple[str, bool]] = {}  # elements written so far: value, whether a vector
        self.functions: list[lang.Function] = [function]  # functions whose statements are here
        self.calls: dict[object, lang.Function] = {}  # called functions

    def text(self) -> str:
        """Return the definition.

        Raises
        ------
        Foreign
            If the function is not straight code.
        """
        arrays = (*("t", *_OWN), *_SHARED, *_WRITTEN)
        own = ", ".join(f'ptr noalias %"{a}", i64 %"{a}.n"' for a in arrays)
        self.views = {a: (f'%"{a}"', (f'%"{a}.n"',)) for a in arrays}
        self.values["t"] = self.put(f'load {_kind("float")}, ptr %"t", align 8')
        self.end(self.statements(self.function.body))
        tables = [
            f'@"{self.symbol(f)}.{name}" = private unnamed_addr constant [{len(x)} x double] '
            f"[{', '.join('double ' + literal(v) for v in x)}]"
            for f in self.functions
            for name, x in f.tables.items()
        ]
        return "\n".join([*tables, f'define i64 @"{self.name}"({own}) nounwind {{', ".entry:", *self.lines, "}"])

    def statements(self, body: tuple[lang.Statement, ...]) -> lang.Expression:
        """Print the statements of a function up to its result and return that."""
        for statement in body:
            if isinstance(statement, lang.Assign):
                self.assign(statement.name, statement.value)
            elif isinstance(statement, lang.Store):
                self.store(statement)
            elif isinstance(statement, lang.Evaluate) and isinstance(statement.call, lang.FunctionCall):
                self.inline(statement.call)
            elif isinstance(statement, lang.If) and not self.is_vector(statement.test):
                self.choose(statement)
            elif isinstance(statement, lang.Return):
                return statement.value
            else:
                raise Foreign(f"a {type(statement).__name__} in straight code")
        raise Foreign("code without a result")

    def choose(self, statement: lang.If) -> None:
        """Print a choice, the same at all nodes, of statements that end the function."""
        if statement.otherwise or self.function is not self.functions[0]:
            raise Foreign("a choice inside straight code")
        yes, no = self.labels("then", "else")
        self.branch(self.value(statement.test), yes, no)
        values, vectors, equal, stored, far = self.values, self.vectors, self.equal, self.stored, self.far
        for label in (yes, no):
            self.values, self.vectors, self.equal, self.stored = (
                values.copy(),
                vectors.copy(),
                equal.copy(),
                stored.copy(),
            )
            self.far = far
            self.sines.clear()
            self.begin(label)
            if label == yes:
                self.end(self.statements(statement.then))

    def assign(self, name: str, value: lang.Expression) -> None:
        """Print an assignment to a variable."""
        if isinstance(value, lang.FunctionCall) and "y" in value.arguments:
            text, vector = self.inline(value)
        else:
            text, vector = self.plain(value), self.is_vector(value)
        self.values[name] = text
        (self.vectors.add if vector else self.vectors.discard)(name)

    def inline(self, call: lang.FunctionCall) -> tuple[str, bool]:
        """Print the statements of a function on the same state; return its result, and whether it is a vector."""
        function, names = call.function, [p.name for p in call.function.parameters]
        arguments = [a.name if isinstance(a, lang.Variable) else a for a in call.arguments]
        if arguments != names:
            raise Foreign("a function of another state")
        outer, values, vectors = self.function, self.values, self.vectors
        self.function, self.values, self.vectors = function, {"t": values["t"]}, {"t"}
        self.sines.clear()
        self.functions.append(function)
        result = self.statements(function.body)
        text, vector = self.plain(result), self.is_vector(result)
        self.function, self.values, self.vectors = outer, values, vectors
        self.sines.clear()
        return text, vector

    def store(self, statement: lang.Store) -> None:
        """Print the rate of an element of the state; values for the scratch array belong to no node."""
        if statement.array not in (*_WRITTEN, *_SHARED):
            raise Foreign(f"an element of '{statement.array}' in straight code")
        index, vector = self.at(statement.index), self.is_vector(statement.value)
        value = self.wide(statement.value) if statement.array in _WRITTEN else self.plain(statement.value)
        self.stored[statement.array, index] = value, vector or statement.array in _WRITTEN
        if statement.array in _WRITTEN:
            place = self.place(statement.array, lang.Constant("int", NODES * index))
            self.lines.append(f"  store {_kind('float')} {value}, ptr {place}, align 8")

    def end(self, value: lang.Expression) -> None:
        """Print the end: whether a pivot is suspicious at any node, and whether an angle is large."""
        if isinstance(value, lang.FunctionCall) and "y" in value.arguments:
            test, vector = self.inline(value)
        else:
            test, vector = self.plain(value), self.is_vector(value)
        if vector:
            if value.type != "bool":
                test = self.operated("bool", "ne", value.type, [test, self.spread("0", value.type)])
            test = self.of_vectors("vector.reduce.or", "i1", (test, "bool"))
        else:
            test = self.put(f"icmp ne {TYPES[value.type]} {test}, 0")
        result = self.put(f"select i1 {test}, i64 {SUSPICIOUS}, i64 0")
        if self.far:
            far = self.of_vectors("vector.reduce.or", "i1", (self.far, "bool"))
            result = self.put(f"or i64 {result}, {self.put(f'select i1 {far}, i64 {FAR}, i64 0')}")
        self.lines.append(f"  ret i64 {result}")

    def at(self, index: lang.Expression) -> int:
        """Return an index: a number, or a sum of numbers."""
        if isinstance(index, lang.ScalarOperation) and index.name == "add":
            return sum(self.at(part) for part in index.arguments)
        if not isinstance(index, lang.Constant):
            raise Foreign("an index that is computed")
        return int(index.value)

    # -- values

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
            if e not in _SHARED:
                raise Foreign(f"a function that is handed the array '{e}'")
            return False
        if isinstance(e, lang.Variable):
            return e.name in self.vectors
        if isinstance(e, lang.ArrayElement):
            if e.array in self.function.tables:
                return self.is_vector(e.index)
            if e.array in _WRITTEN and (e.array, self.at(e.index)) not in self.stored:
                raise Foreign("a rate that is not written yet")
            if e.array not in (*_OWN, *_SHARED, *_WRITTEN):
                raise Foreign(f"an element of '{e.array}' in straight code")
            return e.array in _OWN or self.stored.get((e.array, self.at(e.index)), ("", False))[1]
        if isinstance(e, lang.ScalarOperation | lang.FunctionCall | lang.Invoke):
            return any([self.is_vector(a) for a in e.arguments])
        if isinstance(e, lang.Logic):
            return any([self.is_vector(e.first), self.is_vector(e.second)])
        if isinstance(e, lang.Choice):
            return any([self.is_vector(a) for a in (e.test, e.chosen, e.otherwise)])
        return False

    def plain(self, e: lang.Expression) -> str:
        """Print an expression and return its value, a vector where it has one value per node."""
        return self.wide(e) if self.is_vector(e) else self.value(e)

    def value(self, e: lang.Expression) -> str:
        """Print an expression that is the same at all nodes."""
        if isinstance(e, lang.ArrayElement) and (e.array, self.at(e.index)) in self.stored:
            return self.stored[e.array, self.at(e.index)][0]
        return super().value(e)

    def wide(self, e: lang.Expression) -> str:
        """Print an expression and return its values at the nodes."""
        if not self.is_vector(e):
            return self.spread(self.value(e), e.type)
        if isinstance(e, lang.Variable):
            return self.values[e.name]
        if isinstance(e, lang.ArrayElement):
            index = self.at(e.index)
            if (e.array, index) in self.stored:
                return self.stored[e.array, index][0]
            place = self.place(e.array, lang.Constant("int", NODES * index))
            return self.put(f"load {_kind('float')}, ptr {place}, align 8")
        if isinstance(e, lang.ScalarOperation):
            return self.at_nodes(e)
        if isinstance(e, lang.Logic):
            return self.put(f"{e.name} {_kind('bool')} {self.wide(e.first)}, {self.wide(e.second)}")
        if isinstance(e, lang.Choice):
            test, chosen, otherwise = self.wide(e.test), self.wide(e.chosen), self.wide(e.otherwise)
            return self.chosen(test, chosen, otherwise, e.type)
        if isinstance(e, lang.FunctionCall):
            return self.node_by_node(e.type, e.arguments, lambda values: self.called_at(e, values))
        raise Foreign(f"a {type(e).__name__} in straight code")

    def spread(self, value: str, kind: lang.Scalar) -> str:
        """Return a vector of equal numbers."""
        if (value, kind) not in self.equal:
            if value.startswith("%"):
                one = self.put(f"insertelement {_kind(kind)} poison, {TYPES[kind]} {value}, i32 0")
                vector = self.put(
                    f"shufflevector {_kind(kind)} {one}, {_kind(kind)} poison, <{NODES} x i32> zeroinitializer"
                )
            else:
                number = value if kind != "bool" else str(value == "1").lower()
                vector = f"<{', '.join([f'{TYPES[kind]} {number}'] * NODES)}>"
            self.equal[value, kind] = vector
        return self.equal[value, kind]

    def at_nodes(self, e: lang.ScalarOperation) -> str:
        """Print an operation on vectors."""
        name, first = e.name, e.arguments[0].type
        if name in sines.NAMES:
            return self.sine(name, e.arguments[0])
        if name == "pow" and isinstance(e.arguments[1], lang.Constant) and e.arguments[1].type == "int":
            return self.power(self.wide(e.arguments[0]), int(e.arguments[1].value))
        if name in (*_VECTORS, "neg", "not", "min", "max", *FLOATS, *INTS, *COMPARED["float"], *_CONVERTED):
            values = [self.wide(a) for a in e.arguments]
            return self.operated(e.type, name, first, values)
        return self.node_by_node(
            e.type, e.arguments, lambda values: self.function_of_math(name.removeprefix("math."), values)
        )

    def operated(self, kind: lang.Scalar, name: str, first: lang.Scalar, values: list[str]) -> str:
        """Print an operation on printed arguments of type `first`."""
        flag = self.flag if first == "float" else ""
        if name in COMPARED["float"]:
            compare = "fcmp" if first == "float" else "icmp"
            return self.put(f"{compare}{flag} {COMPARED[first][name]} {_kind(first)} {', '.join(values)}")
        if name in ("min", "max"):
            sign = COMPARED[kind]["lt" if name == "min" else "gt"]
            compare = f"fcmp{flag}" if kind == "float" else "icmp"
            test = self.put(f"{compare} {sign} {_kind(kind)} {values[1]}, {values[0]}")
            return self.chosen(test, values[1], values[0], kind)
        if kind == "float" and name in FLOATS:
            return self.put(f"{FLOATS[name]}{flag} {_kind('float')} {values[0]}, {values[1]}")
        if name in INTS:
            return self.put(f"{INTS[name]} {_kind(kind)} {values[0]}, {values[1]}")
        if name == "neg":
            zero = self.spread(literal(-0.0) if kind == "float" else "0", kind)
            return self.put(f"{'fsub' + flag if kind == 'float' else 'sub'} {_kind(kind)} {zero}, {values[0]}")
        if name == "not":
            return self.put(f"xor {_kind('bool')} {values[0]}, {self.spread('1', 'bool')}")
        if name in _CONVERTED:
            if name == "bool":
                zero = self.spread(literal(0.0) if first == "float" else "0", first)
                return self.operated("bool", "ne", first, [values[0], zero])
            return self.put(f"{_CONVERTED[name][first]} {_kind(first)} {values[0]} to {_kind(kind)}")
        if kind == "int" and name == "abs":
            below = self.operated("bool", "lt", "int", [values[0], self.spread("0", "int")])
            return self.chosen(below, self.operated("int", "neg", "int", values), values[0], "int")
        value = self.of_vectors(_VECTORS[name], _kind("float"), *((v, "float") for v in values))
        return self.put(f"fptosi {_kind('float')} {value} to {_kind('int')}") if kind == "int" else value

    def chosen(self, test: str, one: str, other: str, kind: lang.Scalar) -> str:
        """Print a choice between two values at each node."""
        return self.put(f"select {_kind('bool')} {test}, {_kind(kind)} {one}, {_kind(kind)} {other}")

    def of_vectors(self, name: str, returned: str, *values: tuple[str, lang.Scalar]) -> str:
        """Print a call of an intrinsic function on vectors."""
        full = f"@llvm.{name}.v{NODES}{'i1' if values[0][1] == 'bool' else 'f64'}"
        self.declared.add(f"declare {returned} {full}({', '.join(_kind(k) for _, k in values)})")
        return self.put(f"call {returned} {full}({', '.join(f'{_kind(k)} {v}' for v, k in values)})")

    def power(self, base: str, exponent: int) -> str:
        """Print a power as products, by squaring, in the order of one node."""
        result = self.spread(literal(1.0), "float")
        while exponent:
            if exponent & 1:
                result = self.operated("float", "mul", "float", [result, base])
            exponent >>= 1
            base = self.operated("float", "mul", "float", [base, base])
        return result

    def sine(self, name: str, angle: lang.Expression) -> str:
        """Print the sine or cosine of an angle; both are kept."""
        if (name, angle) not in self.sines:
            value = self.wide(angle)
            size = self.of_vectors("fabs", _kind("float"), (value, "float"))
            limit = self.spread(literal(sines.FAR), "float")
            far = self.put(f"fcmp uge {_kind('float')} {size}, {limit}")
            self.far = self.put(f"or {_kind('bool')} {self.far}, {far}") if self.far else far
            for own, result in zip(sines.NAMES, self.sine_and_cosine(value), strict=True):
                self.sines[own, angle] = result
        return self.sines[name, angle]

    def sine_and_cosine(self, x: str) -> tuple[str, str]:
        """Print sine and cosine of angles that are not far: fdlibm's polynomials of the remainder of a quarter turn.

        Here operations may be contracted, and polynomials are summed in pairs, as later operations wait for them.
        """

        def number(value: float) -> str:
            return self.spread(literal(value), "float")

        def op(name: str, a: str, b: str) -> str:
            return self.operated("float", name, "float", [a, b])

        def added(a: str, b: str, c: str) -> str:
            return op("add", op("mul", a, b), c)

        def polynomial(c: tuple[float, ...]) -> str:
            pairs = [added(number(c[k + 1]), z, number(c[k])) for k in (0, 2, 4)]
            return added(added(pairs[2], square, pairs[1]), square, pairs[0])

        whole, wide = _kind("int"), _kind("float")
        shifted = added(x, number(sines.TWO_OVER_PI), number(sines.ROUND))
        turns, r = self.put(f"fsub {wide} {shifted}, {number(sines.ROUND)}"), x
        for part in sines.HALF_PI:
            r = op("sub", r, op("mul", turns, number(part)))
        z = op("mul", r, r)
        square = op("mul", z, z)
        sine = added(op("mul", r, z), polynomial(sines.SINE), r)
        cosine = added(square, polynomial(sines.COSINE), added(z, number(-0.5), number(1.0)))
        quarter = self.put(f"bitcast {wide} {shifted} to {whole}")
        odd = self.put(f"trunc {whole} {quarter} to {_kind('bool')}")

        def turned(value: str, quarter: str) -> str:
            two, places = self.spread("2", "int"), self.spread("62", "int")
            sign = self.put(f"shl {whole} {self.put(f'and {whole} {quarter}, {two}')}, {places}")
            bits = self.put(f"xor {whole} {self.put(f'bitcast {wide} {value} to {whole}')}, {sign}")
            return self.put(f"bitcast {whole} {bits} to {wide}")

        following = self.operated("int", "add", "int", [quarter, self.spread("1", "int")])
        first, second = self.chosen(odd, cosine, sine, "float"), self.chosen(odd, sine, cosine, "float")
        return turned(first, quarter), turned(second, following)

    def node_by_node(
        self, kind: lang.Scalar, arguments: tuple[lang.Expression | str, ...], call: Callable[[list[str]], str]
    ) -> str:
        """Print a function call for each node."""
        numbers = [a for a in arguments if not isinstance(a, str)]
        vectors, result = [(self.wide(a), a.type) for a in numbers], "poison"
        for node in range(NODES):
            values = [self.put(f"extractelement {_kind(k)} {v}, i32 {node}") for v, k in vectors]
            result = self.put(f"insertelement {_kind(kind)} {result}, {TYPES[kind]} {call(values)}, i32 {node}")
        return result

    def called_at(self, e: lang.FunctionCall, values: list[str]) -> str:
        """Print the call of another emitted function with printed numbers."""
        self.calls[e.function.key] = e.function
        left = iter(values)
        parts = [
            part
            for a in e.arguments
            for part in (self.handed(a) if isinstance(a, str) else [f"{TYPES[a.type]} {next(left)}"])
        ]
        return self.put(f'call {TYPES[e.type]} @"{self.symbol(e.function)}"({", ".join(parts)}) nounwind')


#: Conversions by the type after and before them.
_CONVERTED: dict[str, dict[str, str]] = {
    "float": {"int": "sitofp", "bool": "uitofp"},
    "int": {"float": "fptosi", "bool": "zext"},
    "bool": {},
}


def _kind(kind: lang.Scalar) -> str:
    """Return the type of one value per node."""
    return f"<{NODES} x {TYPES[kind]}>"
