"""Straight functions as text for LLVM that evaluates them at eight nodes of one run at once.

Time and state have one value per node, parameters and scratch are shared: element i of the state is at ``8 i + node``
of its array. The same operations as for one node are done on vectors of eight numbers, which processors with shorter
vectors process in several parts: the number of nodes is the same for all. Nothing is written to the scratch array.

Functions without a form in vectors, tables of data and those of the C library, are called node by node. Sines and
cosines use the coefficients of `symgen.compile.native.sines`, for angles that are not large: the function returns 2 for
others.
"""

from __future__ import annotations

from collections.abc import Callable

from msgspec.structs import replace

from symgen.compile.native import language as lang
from symgen.compile.native.llvm import LlvmPrinter, declarations, function_head, functions_of_module, is_copied
from symgen.compile.native.llvm_values import TYPES, float_literal
from symgen.compile.native.node_values import OWN, SHARED, WRITTEN, NodeValuePrinter, wide_type
from symgen.compile.native.read_values import Foreign
from symgen.compile.native.types import NODES

#: Summands of the function's result: a pivot is suspicious at a node; an angle is too large for the sines here.
SUSPICIOUS, FAR = 1, 2


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
        As for `symgen.compile.native.llvm.llvm_module`.

    Raises
    ------
    Foreign
        If the function is not straight code.
    """
    printer = NodesPrinter(move_choice_outside(function), symbol, name)
    texts = [printer.text()]
    copied, declared = dict[object, lang.Function](), dict[object, lang.Function]()
    for each in printer.calls.values():
        if is_copied(each) or inlined(each):
            defined, others = functions_of_module(each, inlined)
            copied |= {f.key: f for f in defined}
            declared |= {f.key: f for f in others}
        else:
            declared[each.key] = each
    texts += [LlvmPrinter(f, symbol, "available_externally ", False).text() for f in copied.values()]
    texts += [f"declare {function_head(f, symbol(f), named=False)}" for key, f in declared.items() if key not in copied]
    return "\n".join([*texts, *sorted(printer.declared), *declarations(texts), ""])


def move_choice_outside(function: lang.Function) -> lang.Function:
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


class NodesPrinter(NodeValuePrinter):
    """Prints the statements of a straight function for eight nodes."""

    def __init__(self, function: lang.Function, symbol: Callable[[lang.Function], str], name: str) -> None:
        super().__init__(function, symbol)
        self.name = name
        self.functions: list[lang.Function] = [function]  # functions whose statements are here

    def text(self) -> str:
        """Return the definition.

        Raises
        ------
        Foreign
            If the function is not straight code.
        """
        arrays = (*("t", *OWN), *SHARED, *WRITTEN)
        own = ", ".join(f'ptr noalias %"{a}", i64 %"{a}.n"' for a in arrays)
        self.views = {a: (f'%"{a}"', (f'%"{a}.n"',)) for a in arrays}
        self.values["t"] = self.print_instruction(f'load {wide_type("float")}, ptr %"t", align 8')
        self.end(self.statements(self.function.body))
        tables = [
            f'@"{self.symbol(f)}.{name}" = private unnamed_addr constant [{len(x)} x double] '
            f"[{', '.join('double ' + float_literal(v) for v in x)}]"
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
                self.inline_call(statement.call)
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
        yes, no = self.new_labels("then", "else")
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
            self.begin_block(label)
            if label == yes:
                self.end(self.statements(statement.then))

    def assign(self, name: str, value: lang.Expression) -> None:
        """Print an assignment to a variable."""
        if isinstance(value, lang.FunctionCall) and "y" in value.arguments:
            text, vector = self.inline_call(value)
        else:
            text, vector = self.value_or_vector(value), self.is_vector(value)
        self.values[name] = text
        (self.vectors.add if vector else self.vectors.discard)(name)

    def inline_call(self, call: lang.FunctionCall) -> tuple[str, bool]:
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
        text, vector = self.value_or_vector(result), self.is_vector(result)
        self.function, self.values, self.vectors = outer, values, vectors
        self.sines.clear()
        return text, vector

    def store(self, statement: lang.Store) -> None:
        """Print the rate of an element of the state; values for the scratch array belong to no node."""
        if statement.array not in (*WRITTEN, *SHARED):
            raise Foreign(f"an element of '{statement.array}' in straight code")
        index, vector = self.index_text(statement.index), self.is_vector(statement.value)
        value = (
            self.values_at_nodes(statement.value)
            if statement.array in WRITTEN
            else self.value_or_vector(statement.value)
        )
        self.stored[statement.array, index] = value, vector or statement.array in WRITTEN
        if statement.array in WRITTEN:
            place = self.element_address(statement.array, lang.Constant("int", NODES * index))
            self.lines.append(f"  store {wide_type('float')} {value}, ptr {place}, align 8")

    def end(self, value: lang.Expression) -> None:
        """Print the end: whether a pivot is suspicious at any node, and whether an angle is large."""
        if isinstance(value, lang.FunctionCall) and "y" in value.arguments:
            test, vector = self.inline_call(value)
        else:
            test, vector = self.value_or_vector(value), self.is_vector(value)
        if vector:
            if value.type != "bool":
                test = self.print_operation("bool", "ne", value.type, [test, self.spread_number("0", value.type)])
            test = self.call_intrinsic("vector.reduce.or", "i1", (test, "bool"))
        else:
            test = self.print_instruction(f"icmp ne {TYPES[value.type]} {test}, 0")
        result = self.print_instruction(f"select i1 {test}, i64 {SUSPICIOUS}, i64 0")
        if self.far:
            far = self.call_intrinsic("vector.reduce.or", "i1", (self.far, "bool"))
            result = self.print_instruction(
                f"or i64 {result}, {self.print_instruction(f'select i1 {far}, i64 {FAR}, i64 0')}"
            )
        self.lines.append(f"  ret i64 {result}")
