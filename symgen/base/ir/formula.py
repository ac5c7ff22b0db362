"""Functions of the formulas of a file: no limit, sign or comparison hides an undefined value.

The operations of a graph are those of a processor, for which ``max(1, nan)`` is 1 and ``nan < 1`` is false. A formula
that is undefined somewhere shall be no number there, nor anything computed from it; only the value that a choice drops
does not count, nor an operand of ``and`` or ``or`` where the other one decides. Operations are added only where an
argument may be undefined.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import reduce

from symgen.base.ir.graph import Graph
from symgen.base.vocabulary.elementary_functions import ELEMENTARY


class GraphFunctions:
    """Functions of formulas in a graph.

    Parameters
    ----------
    graph : Graph
        Graph of the operations.
    """

    def __init__(self, graph: Graph) -> None:
        self.graph = graph
        self._unsure: dict[int, tuple[int, int]] = {}  # condition -> where it is defined, and no number elsewhere
        self._signs: dict[int, tuple[int, bool]] = {}  # as in `_sign_of_operation`

    def call(self, function: str, *args: int) -> int:
        """Return the node of ``function(*args)`` for a name of `symgen.base.ir.graph.FUNCTIONS` or ``table:NAME``."""
        if function in ("both", "either"):
            return self._join_where_one_decides(function, *args)
        node = self.graph.call(function, *args)
        if function in ("where", "not"):
            return self._undefined_with_condition(function, args[0], node)
        if function in ("and", "or"):
            return self._join_conditions(function, args, node)
        if function in ("min", "max", "sign", "step", "lt", "le", "gt", "ge"):
            unsure = [a for a in dict.fromkeys(args) if not self._is_defined(a)]
            if unsure:
                defined = self._fold_conditions("and", (self.graph.call("defined", a) for a in unsure))
                self._unsure[node] = defined, self.graph.sum_of(unsure)
                if function in ("min", "max", "sign", "step"):
                    return self._undefined_with_condition("where", node, node)
        return node

    def _undefined_with_condition(self, function: str, condition: int, node: int) -> int:
        """Return a choice, or the negation of a condition, undefined where the condition is."""
        if condition not in self._unsure:
            return node
        if function == "where":
            defined, witness = self._unsure[condition]
            return self.graph.call("where", defined, node, witness)
        self._unsure[node] = self._unsure[condition]
        return node

    def _join_conditions(self, function: str, conditions: tuple[int, ...], node: int) -> int:
        """Return ``a and b`` or ``a or b``: defined where both operands are, or where one that is decides."""
        g, unsure = self.graph, {c: self._unsure[c] for c in conditions if c in self._unsure}
        if unsure:
            deciding = [(c, c if function == "or" else g.call("not", c)) for c in conditions]
            ways = [g.call("and", unsure[c][0], d) if c in unsure else d for c, d in deciding]
            both = self._fold_conditions("and", (defined for defined, _ in unsure.values()))
            self._unsure[node] = (
                self._fold_conditions("or", [both, *ways]),
                g.sum_of(witness for _, witness in unsure.values()),
            )
        return node

    def _join_where_one_decides(self, function: str, a: int, b: int) -> int:
        """Return a value above 0 where both, or either, of two are; the other may be undefined where one decides."""
        g, smaller = self.graph, function == "both"
        least = g.call("min" if smaller else "max", a, b)
        unsure = [x for x in (a, b) if not self._is_defined(x)]
        for x, other in ((a, b), (b, a)):
            least = g.call("where", g.call("defined", x), least, other) if x in unsure else least
        if not unsure:
            return least
        decides = g.call("le" if smaller else "gt", least, g.zero)
        sure = self._fold_conditions("and", (g.call("defined", x) for x in unsure))
        return g.call("where", g.call("or", sure, decides), least, g.sum_of(unsure))

    def _fold_conditions(self, function: str, conditions: Iterable[int]) -> int:
        return reduce(lambda a, b: self.graph.call(function, a, b), conditions)

    def _is_defined(self, node: int) -> bool:
        """Whether a node is a number wherever the inputs are."""
        for each in self.graph.required_nodes([node]) if node not in self._signs else ():
            if each not in self._signs:
                op, args, _ = self.graph.nodes[each]
                value = self.graph.value(each)
                signs = [self._signs[a] for a in args]
                self._signs[each] = (
                    (_sign_of_literal(value), True) if value is not None else _sign_of_operation(op, args, signs)
                )
        return self._signs[node][1]


def _sign_of_literal(value: float) -> int:
    return 2 if value > 0.0 else 1 if value == 0.0 else 0


def _sign_of_operation(op: str, args: tuple[int, ...], operands: list[tuple[int, bool]]) -> tuple[int, bool]:
    """Return the sign of an operation: 2 if it is above 0, 1 if not below, else 0; and whether it is a number.

    Squares, roots and sums of them are not below 0, so that distances are numbers.
    """
    signs, defined = [sign for sign, _ in operands], all(number for _, number in operands)
    match op:
        case "sqrt":
            return signs[0], defined and signs[0] > 0
        case "log":
            return 0, defined and signs[0] == 2
        case "pow":
            return signs[0], defined and signs[0] > 0
        case "div":
            return min(signs), defined and signs[1] == 2
        case "exp" | "cosh":
            return 2, defined
        case "abs":
            return max(1, signs[0]), defined
        case "mul":
            return max(min(signs), int(args[0] == args[1])), defined
        case "add":
            return max(signs) if min(signs) else 0, defined
        case "min" | "where":
            return min(signs[-2:]), defined
        case "max":
            return max(signs), defined
    return 0, defined and (op not in ELEMENTARY or ELEMENTARY[op].everywhere)
