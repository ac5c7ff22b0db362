"""The expression graph: computations, apart from their layout.

A `Graph` holds operations on scalars, each stored once (hash-consing), so common subexpressions over everything that
is built in one graph are shared without a separate pass. Structural zeros and ones vanish while building. Nodes are
integers; a node's arguments always have smaller numbers, so increasing order is an evaluation order. It depends
only on the order of construction: the same mechanism gives the same numbers in every process.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple

from symgen.base.vocabulary.elementary_functions import ELEMENTARY

#: Bits of the dependencies of a node.
TIME, POSITION, VELOCITY, PARAMETER, SCRATCH = 1, 2, 4, 8, 16

#: Input spaces that are not scratch: every other name is a section of ``w`` or an array of the block's own.
_BITS = {"t": TIME, "q": POSITION, "v": VELOCITY, "p": PARAMETER, "parameter": PARAMETER}

#: Numbers with other derivatives: ``held(a)`` is a without derivatives, ``carried(a, b)`` is a with those of b.
CARRIED = {"held": ("a",), "carried": ("a", "b")}
#: Operations that are not arithmetic; ``step(a, b)`` is 1.0 where a > b and 0.0 elsewhere, without a branch, and
#: ``defined(a)`` is true where a is a number.
FUNCTIONS = frozenset((*ELEMENTARY, *"atan2 abs floor min max sign lt le gt ge and or not where step defined".split()))

_FOLD: dict[str, Callable[[float], float]] = {name: function.evaluate for name, function in ELEMENTARY.items()}
_FOLD |= {"abs": abs, "floor": math.floor}


class Operation(NamedTuple):
    """One node: its operator, its arguments, and its payload (value of a constant, key of an input)."""

    op: str
    args: tuple[int, ...]
    payload: float | str | tuple[str, int] | None = None


class Graph:
    """Operations on scalars, shared and simplified during construction."""

    #: Node of the number 0 in every graph.
    ZERO = 0

    def __init__(self) -> None:
        self.nodes: list[Operation] = []
        self.depends: list[int] = []
        self._index: dict[Operation, int] = {}
        self.zero = self.constant(0.0)
        self.one = self.constant(1.0)

    def copy(self) -> Graph:
        """Return an independent graph with the same nodes."""
        other = Graph()
        other.nodes, other.depends, other._index = list(self.nodes), list(self.depends), dict(self._index)
        return other

    # -- leaves ------------------------------------------------------------------------------------------------------

    def constant(self, value: float) -> int:
        """Return the node of a literal; -0.0 is 0.0.

        Raises
        ------
        OverflowError
            If it is not finite, as products of finite literals may be: such a number has no literal in emitted code.
        """
        number = float(value) + 0.0
        if not math.isfinite(number):
            raise OverflowError("a constant that is not finite")
        return self._store_node(Operation("const", (), number), 0)

    def input(self, space: str, index: int) -> int:
        """Return the node of element `index` of ``t``, ``q``, ``v``, ``p``, ``parameter`` or of a scratch section."""
        return self._store_node(Operation("input", (), (space, index)), _BITS.get(space, SCRATCH))

    def key(self, node: int) -> tuple[str, int]:
        """Return space and index of `node`, an input."""
        return self.nodes[node].payload  # type: ignore[return-value]  # an input's payload is its key

    def value(self, node: int) -> float | None:
        """Return the literal value of `node`, None where it is not a literal."""
        operation = self.nodes[node]
        return operation.payload if operation.op == "const" and isinstance(operation.payload, float) else None

    def _store_node(self, operation: Operation, depends: int) -> int:
        index = self._index.get(operation)
        if index is None:
            index = self._index[operation] = len(self.nodes)
            self.nodes.append(operation)
            self.depends.append(depends)
        return index

    def _store_operation(self, op: str, *args: int, payload: str | None = None) -> int:
        depends = 0
        for a in args:
            depends |= self.depends[a]
        return self._store_node(Operation(op, args, payload), depends)

    # -- arithmetic --------------------------------------------------------------------------------------------------

    def neg(self, a: int) -> int:
        """Return -a."""
        operation = self.nodes[a]
        if operation.op == "const":
            return self.constant(-float(operation.payload))  # type: ignore[arg-type]  # a constant's payload is a float
        if operation.op == "neg":
            return operation.args[0]
        if operation.op == "sub":
            return self.sub(operation.args[1], operation.args[0])
        return self._store_operation("neg", a)

    def add(self, a: int, b: int) -> int:
        """Return a + b."""
        if a == self.zero:
            return b
        if b == self.zero:
            return a
        va, vb = self.value(a), self.value(b)
        if va is not None and vb is not None:
            return self.constant(va + vb)
        if self.nodes[b].op == "neg":
            return self.sub(a, self.nodes[b].args[0])
        if self.nodes[a].op == "neg":
            return self.sub(b, self.nodes[a].args[0])
        return self._store_operation("add", *((a, b) if a <= b else (b, a)))

    def sub(self, a: int, b: int) -> int:
        """Return a - b."""
        if b == self.zero:
            return a
        if a == b:
            return self.zero
        va, vb = self.value(a), self.value(b)
        if va is not None and vb is not None:
            return self.constant(va - vb)
        if a == self.zero:
            return self.neg(b)
        if self.nodes[b].op == "neg":
            return self.add(a, self.nodes[b].args[0])
        if self.nodes[a].op == "neg" and va is None:
            return self.neg(self.add(self.nodes[a].args[0], b))
        return self._store_operation("sub", a, b)

    def mul(self, a: int, b: int) -> int:
        """Return a * b."""
        if a > b:
            a, b = b, a
        va, vb = self.value(a), self.value(b)
        if va is None and vb is not None:
            a, b, va, vb = b, a, vb, va
        if va is not None:
            if vb is not None:
                return self.constant(va * vb)
            if va == 0.0:
                return self.zero
            if va == 1.0:
                return b
            if va == -1.0:
                return self.neg(b)
            if va < 0.0:
                return self.neg(self.mul(self.constant(-va), b))
            inner = self.nodes[b]
            if inner.op == "mul" and (v := self.value(inner.args[0])) is not None:
                return self.mul(self.constant(va * v), inner.args[1])
        # signs move outwards so that products differing in sign only are shared
        if self.nodes[a].op == "neg":
            return self.neg(self.mul(self.nodes[a].args[0], b))
        if self.nodes[b].op == "neg":
            return self.neg(self.mul(a, self.nodes[b].args[0]))
        return self._store_operation("mul", a, b)

    def div(self, a: int, b: int) -> int:
        """Return a / b; division by a literal becomes multiplication by its reciprocal."""
        va, vb = self.value(a), self.value(b)
        if a == self.zero and vb != 0.0:
            return self.zero
        if va is not None and vb:
            return self.constant(va / vb)
        if vb is not None and vb != 0.0 and math.isfinite(1.0 / vb):
            return self.mul(a, self.constant(1.0 / vb))
        if self.nodes[a].op == "neg":
            return self.neg(self.div(self.nodes[a].args[0], b))
        if self.nodes[b].op == "neg":
            return self.neg(self.div(a, self.nodes[b].args[0]))
        if a == b:
            return self.one
        return self._store_operation("div", a, b)

    def power(self, a: int, b: int) -> int:
        """Return a ** b; small whole and half exponents become products and square roots."""
        vb = self.value(b)
        if vb is not None:
            if vb == 0.0:
                return self.one
            if vb < 0.0:
                return self.div(self.one, self.power(a, self.constant(-vb)))
            if vb == 0.5:
                return self.call("sqrt", a)
            whole = int(vb) if vb <= 64.0 else 0
            if whole and (vb == whole or vb == whole + 0.5):
                result = self._whole_power(a, whole)
                return result if vb == whole else self.mul(result, self.call("sqrt", a))
        va = self.value(a)
        if va is not None and vb is not None and va > 0.0:
            return self.constant(va**vb)
        return self._store_operation("pow", a, b)

    def _whole_power(self, a: int, n: int) -> int:
        result, base = self.one, a
        while n:
            if n & 1:
                result = self.mul(result, base)
            n >>= 1
            if n:
                base = self.mul(base, base)
        return result

    def call(self, function: str, *args: int) -> int:
        """Return ``function(*args)`` for a name of `FUNCTIONS` or ``table:NAME``, with ' for each derivative."""
        if function in _FOLD and (v := self.value(args[0])) is not None:
            try:
                return self.constant(_FOLD[function](v))
            except ValueError:
                pass
        if function == "abs" and self.nodes[args[0]].op == "neg":
            return self.call("abs", self.nodes[args[0]].args[0])
        if function == "where" and (condition := self.value(args[0])) is not None:
            return args[1] if condition else args[2]
        if function == "held":  # never hoisted: derivatives of numbers that depend on parameters would go with it
            own = self.value(args[0]) is not None
            return args[0] if own else self._store_node(Operation(function, args), self.depends[args[0]] | SCRATCH)
        if function in FUNCTIONS or function in CARRIED:
            return self._store_operation(function, *args)
        return self._store_operation("table", *args, payload=function.removeprefix("table:"))

    # -- many at once ------------------------------------------------------------------------------------------------

    def sum_of(self, terms: Iterable[int]) -> int:
        """Return the sum of `terms`, added from the left."""
        result = self.zero
        for term in terms:
            result = self.add(result, term)
        return result

    def dot(self, a: Sequence[int], b: Sequence[int]) -> int:
        """Return the sum of products of two equally long sequences."""
        return self.sum_of(self.mul(x, y) for x, y in zip(a, b, strict=True))

    def copy_from(self, other: Graph, outputs: Sequence[int], inputs: Mapping[tuple[str, int], int]) -> list[int]:
        """Copy `outputs` of `other` with their operands into this graph, inputs replaced; return their new nodes."""
        return self.rebuild_from(other, outputs, lambda node: inputs[other.key(node)])

    def replace_inputs(self, outputs: Sequence[int], inputs: Mapping[tuple[str, int], int]) -> list[int]:
        """Return `outputs` with some inputs replaced by nodes of this graph."""
        return self.rebuild_from(self, outputs, lambda node: inputs.get(self.key(node), node))

    def rebuild_from(
        self,
        source: Graph,
        outputs: Sequence[int],
        image: Callable[[int], int],
        stops: Callable[[int], bool] | None = None,
    ) -> list[int]:
        """Build the nodes that `outputs` of `source` need anew in this graph; return the outputs' nodes here.

        Parameters
        ----------
        source : Graph
            Graph of the outputs.
        outputs : sequence of int
            Nodes of `source`.
        image : callable
            Returns the node here for an input of `source`, or for a node that `stops` selects; called once for
            each, in evaluation order.
        stops : callable, optional
            Whether a node is not built from its operands, so that these are not needed for it; by default only inputs.
        """
        images: dict[int, int] = {}
        for node in source.required_nodes(outputs, stops):
            op, args, payload = source.nodes[node]
            if op == "input" or (stops is not None and stops(node)):
                images[node] = image(node)
            elif op == "const":
                images[node] = self.constant(payload)  # type: ignore[arg-type]  # a constant's payload is a float
            else:
                images[node] = self.apply(op, tuple(images[a] for a in args), payload)
        return [images[o] for o in outputs]

    def apply(self, op: str, args: tuple[int, ...], payload: object = None) -> int:
        """Return the operation `op` on `args`, simplified as by its own method."""
        builder = ARITHMETIC.get(op)
        if builder is not None:
            return int(getattr(self, builder)(*args))
        return self.call(f"table:{payload}" if op == "table" else op, *args)

    def required_nodes(self, outputs: Iterable[int], stops: Callable[[int], bool] | None = None) -> list[int]:
        """Return all nodes that `outputs` depend on, in evaluation order; it stops at those that `stops` selects."""
        nodes: set[int] = set()
        stack = list(outputs)
        while stack:
            node = stack.pop()
            if node not in nodes:
                nodes.add(node)
                if stops is None or not stops(node):
                    stack.extend(self.nodes[node].args)
        return sorted(nodes)

    def inputs_of(self, outputs: Iterable[int]) -> list[tuple[str, int]]:
        """Return space and index of all inputs that `outputs` depend on, in evaluation order."""
        payloads = (self.nodes[n].payload for n in self.required_nodes(outputs))
        return [payload for payload in payloads if isinstance(payload, tuple)]

    def count_operations(self, outputs: Iterable[int]) -> int:
        """Return the number of arithmetic operations for `outputs`, shared ones counted once."""
        return sum(1 for n in self.required_nodes(outputs) if self.nodes[n].op not in ("const", "input"))

    def count_tree_operations(self, outputs: Iterable[int]) -> int:
        """Return the number of operations of `outputs` without sharing."""
        outputs = list(outputs)
        cost: dict[int, int] = {}
        for node in self.required_nodes(outputs):
            op, args, _ = self.nodes[node]
            cost[node] = 0 if op in ("const", "input") else 1 + sum(cost[a] for a in args)
        return sum(cost[o] for o in outputs)


ARITHMETIC = {"add": "add", "sub": "sub", "mul": "mul", "div": "div", "neg": "neg", "pow": "power"}
