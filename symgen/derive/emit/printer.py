"""Prints blocks as straight-line Python that Numba compiles. The only place with the syntax of operations."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from symgen.base.escapes import comment_text
from symgen.base.ir.graph import CARRIED
from symgen.base.ir.program import STATUS, Block, JacobianEntry, ModelLayout, OutputSlot, table_of_payload
from symgen.base.vocabulary.elementary_functions import ELEMENTARY

if TYPE_CHECKING:
    from symgen.derive.formulate.equations import Equations

_BINARY = {"add": ("+", 1), "sub": ("-", 1), "mul": ("*", 2), "div": ("/", 2), "pow": ("**", 4)}
_COMPARE = {"lt": "<", "le": "<=", "gt": ">", "ge": ">="}
_LOGIC = {"and": "&", "or": "|"}
#: Operations with a truth value; others, and those computed once a run and kept, are numbers.
_TRUTH = frozenset((*_COMPARE, *_LOGIC, "not", "defined"))
#: Operations whose result is an integer where all operands are integers.
_WHOLE = frozenset("add sub mul neg abs min max where".split())
_MATH = frozenset((*ELEMENTARY, "atan2", "floor"))
#: Arrays that are arguments of functions; every other space is a section of ``w``.
_ARRAYS = frozenset(("p", "y", "ydot", "out", "k", "r", "j"))
#: Longest text of a term used once that is written at its use.
_INLINE = 90


@dataclass(frozen=True)
class BodyLines:
    """The three parts of a straight-line function's body, and the functions that it calls."""

    inputs: tuple[str, ...]
    terms: tuple[str, ...]
    outputs: tuple[str, ...]
    flag: str | None
    functions: frozenset[str]


class Access(ABC):
    """Text of elements in a target."""

    @abstractmethod
    def read(self, space: str, index: int) -> tuple[str, str]:
        """Return (local name, expression) of an input."""

    @abstractmethod
    def write(self, target: OutputSlot) -> str:
        """Return the left-hand side of an output."""

    def sign_of_output(self, target: OutputSlot) -> str:
        """Return the sign between an output and its value."""
        return "="

    def name_in_model(self, space: str, index: int) -> str:
        """Return the name of an element in the model, empty where it has none."""
        return ""

    def function(self, name: str) -> str:
        """Return the name of a mathematical function."""
        return f"math.{name}"


@dataclass(frozen=True)
class ElementAccess(Access):
    """Text of elements of arrays and scratch sections in a target: here, plain indexing."""

    layout: ModelLayout
    names: Mapping[tuple[str, int], str]

    def element(self, array: str, index: int) -> str:
        """Return an element of an array."""
        return f"{array}[{index}]"

    def read(self, space: str, index: int) -> tuple[str, str]:
        """Return (local name, expression) of an input."""
        if space == "t":
            return "t", "t"
        if space == "q":
            return f"q{index}", self.element("y", index)
        if space == "v":
            return f"v{index}", self.element("y", self.layout.nq + index)
        if space == "z":
            return f"z{index}", self.element("y", self.layout.nq + self.layout.nv + index)
        return f"{space}{index}" if space in ("p", "k") else f"{space}_{index}", self.write(OutputSlot(space, index))

    def write(self, target: OutputSlot) -> str:
        """Return the left-hand side of an output."""
        if target.space in _ARRAYS:
            return self.element(target.space, target.index)
        return self.element("w", self.layout.offset(target.space) + target.index)

    def name_in_model(self, space: str, index: int) -> str:
        """Return the name of an element in the model, empty where it has none."""
        return self.names.get((space, index), "")


@dataclass(frozen=True)
class LaneAccess(ElementAccess):
    """Elements of `lanes` runs side by side in one array ``z``: element i is at ``lanes*i + lane``.

    `bases` are the beginnings of the arrays of a single run.
    """

    bases: Mapping[str, int]
    lanes: int

    def element(self, array: str, index: int) -> str:
        """Return an element of an array of one run as the element of lane ``lane``."""
        return f"z[{(self.bases[array] + index) * self.lanes} + lane]"

    def function(self, name: str) -> str:
        """Return the name of a mathematical function: sines of lanes are inlined."""
        return {"sin": "sine", "cos": "cosine"}.get(name, f"math.{name}")


class Printer:
    """Prints one block as lines of Python; after `lines`, `text` holds text and precedence of every node.

    Terms are called by the `prefix` and their numbers.
    """

    def __init__(self, block: Block, access: Access, prefix: str = "s") -> None:
        self.block, self.access, self.graph, self.prefix = block, access, block.graph, prefix
        self.needed = block.needed
        self.uses = Counter(a for node in self.needed for a in self.graph.nodes[node].args) + Counter(block.nodes)
        self.text: dict[int, tuple[str, int]] = {}  # node -> (expression, precedence)
        self.functions: set[str] = set()  # called functions: of math, and emitted ones

    def lines(self) -> BodyLines:
        """Return the lines of the block."""
        inputs: list[str] = []
        terms: list[str] = []
        for node in self.needed:
            op, args, payload = self.graph.nodes[node]
            if op == "const":
                value = float(payload)  # type: ignore[arg-type]  # a constant's payload is a float
                self.text[node] = (repr(value), 5 if value >= 0.0 else 3)
            elif op == "input":
                assert isinstance(payload, tuple), "an input's payload is its key"
                space, index = payload
                name, expression = self.access.read(space, index)
                if name != expression:
                    note = comment_text(self.access.name_in_model(space, index))
                    inputs.append(f"{name} = {expression}" + (f"  # {note}" if note else ""))
                self.text[node] = (name, 5)
            else:
                text, level = self.operation(op, args, payload)
                if self.uses[node] > 1 or len(text) > _INLINE:
                    name = f"{self.prefix}{len(terms)}"
                    terms.append(f"{name} = {text}")
                    text, level = name, 5
                self.text[node] = (text, level)
        outputs = tuple(
            f"{self.access.write(target)} {self.access.sign_of_output(target)} {self.text[n][0]}"
            + self.comment_on_output(target)
            for target, n in self.block.outputs
        )
        flag = None if self.block.flag is None else self.text[self.block.flag][0]
        return BodyLines(tuple(inputs), tuple(terms), outputs, flag, frozenset(self.functions))

    def comment_on_output(self, target: OutputSlot) -> str:
        """Return the name of an output as a comment, empty where it has none."""
        note = comment_text(self.access.name_in_model(target.space, target.index))
        return f"  # {note}" if note else ""

    def operation(self, op: str, args: tuple[int, ...], payload: object) -> tuple[str, int]:
        """Return text and precedence of one operation."""
        if op in _BINARY:
            sign, level = _BINARY[op]
            if op == "pow":
                return f"{self.factor_text(args[0])}{sign}{self.factor_text(args[1])}", level
            left = self.bracket(args[0], level)
            right = self.bracket(args[1], level if op == "add" else level + 1)
            return f"{left} {sign} {right}" if level == 1 else f"{left}{sign}{right}", level
        if op == "neg":
            return f"-{self.bracket(args[0], 2)}", 1
        texts = [self.text[a][0] for a in args]
        if op in _COMPARE:
            return f"({self.bracket(args[0], 1)} {_COMPARE[op]} {self.bracket(args[1], 1)})", 5
        if op in _LOGIC:
            return f"({self.truth_text(args[0])} {_LOGIC[op]} {self.truth_text(args[1])})", 5
        if op in _MATH:
            name = self.access.function(op)
            self.functions.add(name)
            return f"{name}({', '.join(texts)})", 5
        if op in ("abs", "min", "max"):
            return f"{op}({', '.join(texts)})", 5
        if op in CARRIED:
            self.functions.add(op)
            return f"{op}({', '.join(texts)})", 5
        special = {
            "step": "1.0*({0} > {1})",
            "not": "(not {0})",
            "defined": "({0} == {0})",
            "where": "({1} if {0} else {2})",
            "sign": "1.0*(({0} > 0.0) - 1*({0} < 0.0))",
        }
        if op in special:
            return special[op].format(*texts), 2 if op in ("step", "sign") else 5
        if op == "table":
            name = table_name(*table_of_payload(payload))
            self.functions.add(name)
            return f"{name}({texts[0]})", 5
        raise AssertionError(f"no syntax for operation {op}")

    def factor_text(self, node: int) -> str:
        """Return a node's text as a part of a power: no integer, whose powers overflow or raise uncaught exceptions."""
        return f"float({self.text[node][0]})" if self.is_whole(node) else self.bracket(node, 5)

    def is_whole(self, node: int) -> bool:
        """Whether a node's text is an integer, as rounded numbers are, and their sums and products."""
        op, args, _ = self.graph.nodes[node]
        values = args[1:] if op == "where" else args
        return op == "floor" or (op in _WHOLE and all(map(self.is_whole, values)))

    def truth_text(self, node: int) -> str:
        """Return the text of a truth value."""
        text = self.bracket(node, 1)
        return text if self.graph.nodes[node].op in _TRUTH else f"({text} != 0.0)"

    def bracket(self, node: int, level: int) -> str:
        """Return a node's text, in parentheses where it binds more weakly than `level`."""
        text, own = self.text[node]
        return text if own >= level else f"({text})"


#: Prefixes of the name of a table in the emitted names: no other emitted name begins with them.
_OF_TABLE = {
    **{"value": "table_", "slope": "slope_", "second": "second_", "third": "third_"},
    **{"x": "points_", "y": "values_"},
}


def table_name(name: str, what: str = "value") -> str:
    """Return the emitted name of a table's function, of its derivatives, or of the array of its points or values.

    The table's name follows unchanged, so that names differ wherever those of tables do.

    Parameters
    ----------
    name : str
        A checked identifier.
    what : {"value", "slope", "second", "third", "x", "y"}
        Kind of the name.
    """
    return _OF_TABLE[what] + name


Names = dict[tuple[str, int], str]
#: Longest formula of parameters that serves as a name.
LONGEST_FORMULA = 48
#: Sections of ``w`` with an element for each row, and for each velocity.
_OF_ROWS = ("residual", "nu", "multipliers", "mask", "pivot", "row_weight")
_OF_VELOCITIES = ("change", "mass", "gauge")


def names_in_model(equations: Equations, jacobian: Sequence[JacobianEntry]) -> Names:
    """Return the names of sections of ``w`` that all methods share, and of the values returned at outputs.

    Parameters
    ----------
    equations : Equations
        The derived equations.
    jacobian : sequence of JacobianEntry
        Places of the entries of D.
    """
    rows, speeds = [r.name for r in equations.rows], [v.name for v in equations.velocities]
    names: Names = {(section, i): name for section in _OF_ROWS for i, name in enumerate(rows)}
    names |= {(section, i): name for section in _OF_VELOCITIES for i, name in enumerate(speeds)}
    names |= {("status", i): name for i, name in enumerate(STATUS)}
    names |= {("jacobian", e.slot): f"D {rows[e.row]}, {speeds[e.column]}" for e in jacobian if e.slot is not None}
    state = [q.name for q in (*equations.coordinates, *equations.velocities)]
    return names | {
        ("ydot", i): f"rate of {name}" for i, name in enumerate((*state, "work", *(x.name for x in equations.states)))
    }


def names_of_observed(equations: Equations) -> Names:
    """Return the names of the outputs of ``observe``."""
    labels = [row.name for row in equations.rows]
    labels += [name for c in equations.joint_coordinates for name in (c.name, f"rate of {c.name}")]
    return {("out", i): name for i, name in enumerate(labels)}


@dataclass(frozen=True)
class _ByName(ElementAccess):
    """Elements as their names, where they have names."""

    def read(self, space: str, index: int) -> tuple[str, str]:
        """Return the name of an input, twice."""
        name = self.names.get((space, index), "").partition(" [")[0] or f"{space}[{index}]"
        return name, name


def formulas_of_hoisted(blocks: Sequence[Block], access: ElementAccess) -> Names:
    """Return the short formulas of numbers that depend on parameters alone.

    Parameters
    ----------
    blocks : sequence of Block
        Of one module; ``prepare`` fills those numbers.
    access : ElementAccess
        With the names of parameters.
    """
    by_name, names = _ByName(access.layout, access.names), Names()
    for block in blocks:
        for target, node in block.outputs if block.name == "prepare" else ():
            printer = Printer(replace(block, outputs=((target, node),)), by_name)
            terms, (text, _) = printer.lines().terms, printer.text[node]
            if not terms and len(text) <= LONGEST_FORMULA:
                names[target.space, target.index] = text
    return names
