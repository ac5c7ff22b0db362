"""The tape of a formula, operation by operation: the common part of straight and looped layout."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

from symgen.base.ir.graph import ARITHMETIC, Graph
from symgen.base.ir.program import STATUS
from symgen.derive.methods._tape import FormulaStep

Nodes = tuple[int, ...]


class Replay:
    """Evaluates operations of a tape in a graph.

    A vector is a tuple of nodes: one an element, or one for the general element of a loop. A scalar is a node. Kinds of
    operations are methods of subclasses, called ``_on_<kind>``; arithmetic is here.

    Parameters
    ----------
    graph : Graph
        Graph of the nodes.
    operations : tuple of FormulaStep
        The tape.
    parameters : sequence of str
        Names of the parameters of the method.

    Attributes
    ----------
    mask : tuple of int
        Numbers added to the pivots of S: 0, or infinite in rows that the runtime leaves out.
    at : int
        The current operation.
    """

    mask: Nodes

    def __init__(self, graph: Graph, operations: tuple[FormulaStep, ...], parameters: Sequence[str] = ()) -> None:
        self.graph, self.operations, self.parameters = graph, operations, tuple(parameters)
        self.values: dict[int, Any] = {}

    def evaluate_remaining(self, indices: Iterable[int]) -> None:
        """Evaluate the remaining operations, in order."""
        for index in indices:
            if index not in self.values:
                operation, self.at = self.operations[index], index
                operands = [self.values.get(i) for i in operation.operands]
                arithmetic = ARITHMETIC.get(operation.kind)
                if arithmetic is not None:
                    self.values[index] = self.apply_elementwise(getattr(self.graph, arithmetic), *operands)
                else:
                    self.values[index] = getattr(self, f"_on_{operation.kind}")(operation, *operands)

    def apply_elementwise(self, function: Callable[..., int], *operands: object) -> Any:
        """Return a function of scalars and of the elements of vectors."""
        lengths = [len(x) for x in operands if isinstance(x, tuple)]
        if not lengths:
            return function(*operands)
        return tuple(function(*(x[i] if isinstance(x, tuple) else x for x in operands)) for i in range(lengths[0]))

    def _on_constant(self, operation: FormulaStep) -> int:
        (value,) = operation.payload
        return self.graph.constant(float(value))

    def _on_parameter(self, operation: FormulaStep) -> int:
        return self.graph.input("parameter", self.parameters.index(str(operation.payload[0])))

    def _on_status(self, operation: FormulaStep) -> int:
        return self.graph.input("status", STATUS.index(str(operation.payload[0])))

    def _on_sqrt(self, operation: FormulaStep, x: int) -> int:
        return self.graph.call("sqrt", x)

    def _on_min(self, operation: FormulaStep, a: int, b: int) -> int:
        return self.graph.call("min", a, b)

    def _on_penalties(self, operation: FormulaStep, penalty: int) -> Nodes:
        g = self.graph
        penalties: Nodes = self.apply_elementwise(
            lambda mask, a: g.mul(a, g.call("step", g.one, mask)), self.mask, penalty
        )
        return penalties
