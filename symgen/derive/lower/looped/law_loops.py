"""Formulas laid out as loops over whole vectors and calls of generic code (`symgen.derive.lower.looped.statements`)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partialmethod
from typing import Any

from symgen.base.ir.graph import ARITHMETIC, Graph
from symgen.base.ir.program import STATUS
from symgen.derive.lower.looped.statements import (
    LOCAL,
    PARAMETER,
    RATES,
    STATE,
    SUM,
    VELOCITIES,
    WORK,
    Assignment,
    KernelCall,
    LoopedFunction,
    Statement,
)
from symgen.derive.lower.recorded_law import Part, RecordedLaw
from symgen.derive.lower.replay import Nodes, Replay
from symgen.derive.methods._tape import FormulaStep, needed_operations

#: Functions of a law in which the kernels of an evaluation are called first.
_EVALUATE = ("rhs", "begin", "balance")
#: Number of scratch vectors reserved for generic code.
_FIRST_VECTOR = 2


@dataclass(frozen=True)
class _Factor:
    """A factorisation L D L^T: its matrix, its section, and its penalties or its compliance."""

    matrix: str
    section: str
    weight: int = -1
    stored: bool = False

    @property
    def table(self) -> str:
        return "AUGMENTED_FACTOR" if self.matrix == "augmented" else "GRAM_FACTOR"


class Loops(Replay):
    """Lays out one function of a law."""

    def __init__(self, record: RecordedLaw, part: Part, parameters: tuple[str, ...]) -> None:
        super().__init__(Graph(), record.operations, parameters)
        self.part, self.vectors = part, _FIRST_VECTOR
        self.sections: dict[str, str] = {}
        self.statements: list[Statement] = []
        self.flagged, self.locals = False, 0
        self.stored: set[str] = set()
        self.mask = self._general_element("mask", "m")

    def function(self, positions: bool) -> LoopedFunction:
        """Return the function; `positions`: whether an evaluation needs Phi."""
        part, ends = self.part, self.ends
        if part.name in _EVALUATE:
            self._add_number((STATE, STATUS.index("power")), self.graph.zero)
            for stage in ("FRAMES", "FULL" if positions else "MOTION"):
                self._add_call("run", stage, "t", "y", "p", "w", "T", "w")
        indices = self.needed
        uses = Counter(i for index in indices for i in self._operands(index)) + Counter(end for _, end in ends)
        reads = {str(self.operations[i].payload[0]) for i in indices if self.operations[i].kind in _PLACES}
        # results of operations that can stay at their targets
        self.goal = {end: place for place, end in reversed(ends) if place not in reads and "." not in place}
        for index in indices:
            self.evaluate_remaining([index])
            self._share_in_vector(index, uses[index])
        self._write_outputs(ends)
        return LoopedFunction(part, self.graph, tuple(self.statements), self.sections, self.vectors, self.flagged)

    # -- places of results ---------------------------------------------------------------------------------------------

    @property
    def ends(self) -> list[tuple[str, int]]:
        """Outputs: of kept values the operand, unless it has its own place already."""
        ends = []
        for place, index in self.part.outputs:
            operation = self.operations[index]
            if not operation.kind.startswith("keep"):
                ends.append((place, index))
            elif self.operations[operation.operands[0]].kind not in _SIMPLE:
                ends.append((place, operation.operands[0]))
        return ends

    @property
    def needed(self) -> list[int]:
        """Operations that the function carries out."""
        return needed_operations((end for _, end in self.ends), self._operands)

    def _operands(self, index: int) -> tuple[int, ...]:
        """Return operands, none where the function reads a value kept by another one."""
        operation = self.operations[index]
        stored = operation.kind.startswith("keep") and self.operations[operation.operands[0]].kind not in _SIMPLE
        return () if stored else operation.operands

    def _share_in_vector(self, index: int, uses: int) -> None:
        """Put an elementwise result that is used several times into a vector, so that it is computed once."""
        value, size = self.values[index], self.operations[index].size
        if uses > 1 and size and isinstance(value, tuple) and not self._is_simple(value[0]):
            self.values[index] = self._general_element(self._section_of_vector(value[0], size, index), size)

    def _is_simple(self, node: int) -> bool:
        return self.graph.nodes[node].op in ("const", "input")

    def _general_element(self, section: str, size: str) -> Nodes:
        """Return a section's general element."""
        if section not in _NO_SECTIONS:
            self.sections[section] = size
        return (self.graph.input(section, 0),)

    def _section_of_result(self, index: int, size: str) -> str:
        """Return the section for an operation's result: its target, or a scratch vector."""
        goal = self.goal.pop(index, "")
        if not goal:
            goal = f"x{self.vectors}"
            self.vectors += 1
        self._general_element(goal, size)
        return goal

    def _section_of_vector(self, node: int, size: str, index: int = -1) -> str:
        """Return the section of a vector, computed first if it has none."""
        payload = self.graph.nodes[node].payload
        if isinstance(payload, tuple) and payload[0] not in _NO_SECTIONS:
            return payload[0]
        target = self._section_of_result(index, size)
        self._add_loop(size, target, node)
        return target

    def _add_loop(self, size: str, target: str, node: int) -> None:
        """Add a loop, or an assignment to the loop before it."""
        last = self.statements[-1] if self.statements else None
        before: tuple[tuple[str, int, int], ...] = ()
        if isinstance(last, Assignment) and last.size == size and last.outputs[0][0] != SUM:
            before = last.outputs
            self.statements.pop()
        self.statements.append(Assignment((*before, (target, 0, node)), size))

    def _add_number(self, place: tuple[str, int], node: int) -> None:
        self.statements.append(Assignment(((*place, node),)))

    def _add_call(self, function: str, *arguments: str, result: str = "") -> None:
        self.statements.append(KernelCall(function, arguments, result))

    def _local_number(self, node: int) -> int:
        """Return a number as a local one, computed before the loop that reads it."""
        op, _, payload = self.graph.nodes[node]
        if op == "const" or (isinstance(payload, tuple) and payload[0] == LOCAL):
            return node
        self._add_number((LOCAL, self.locals), node)
        self.locals += 1
        return self.graph.input(LOCAL, self.locals - 1)

    def apply_elementwise(self, function: Callable[..., int], *operands: Any) -> Any:
        """Return a function of numbers and of the general element of vectors."""
        if any(isinstance(x, tuple) for x in operands):
            operands = tuple(x if isinstance(x, tuple) else self._local_number(x) for x in operands)
        return super().apply_elementwise(function, *operands)

    def _write_outputs(self, ends: list[tuple[str, int]]) -> None:
        """Write the outputs; a vector that reads a section written before it is computed first."""
        vectors: list[tuple[str, str, int]] = []
        for place, index in ends:
            value, size = self.values[index], self.operations[index].size
            if isinstance(value, _Factor):
                self._factorise(replace(value, section=f"{place}lower") if place.endswith("_") else value)
            elif place == "rates.q":
                self._add_call("run", "RATES", "t", "y", "p", "w", "T", "ydot")
            elif place == WORK or place.startswith("status."):
                status = (STATE, STATUS.index(place.partition(".")[2])) if place != WORK else (WORK, 0)
                self._add_number(status, value)
            elif isinstance(value, tuple) and value != self._general_element(place, size):
                reads = {self.graph.nodes[n].payload for n in self.graph.required_nodes(value)}
                if reads & {(written, 0) for _, written, _ in vectors}:
                    value = self._general_element(self._section_of_vector(value[0], size), size)
                vectors.append((size, place, value[0]))
        for size, place, node in vectors:
            self._add_loop(size, place, node)

    # -- named values --------------------------------------------------------------------------------------------------

    def _on_quantity(self, operation: FormulaStep) -> Nodes:
        name = str(operation.payload[0])
        return self._general_element({"f": "force"}.get(name, name), operation.size)

    def _on_section(self, operation: FormulaStep) -> Nodes:
        return self._general_element(str(operation.payload[0]), operation.size)

    def _on_zeros(self, operation: FormulaStep) -> Nodes:
        return (self.graph.zero,)

    def _on_power(self, operation: FormulaStep) -> int:
        return self.graph.input(STATE, STATUS.index("power"))

    def _do_nothing(self, operation: FormulaStep, *operands: object) -> None:
        """Do nothing: D and its factorisation are in their places when a function begins."""

    _on_flag = _on_rank = _on_constraints = _on_stored_constraints = _on_keep_constraints = _do_nothing
    #: Of a root of M^-1 only products with its transposed are formed, next to another one.
    _on_times_transposed = _do_nothing

    def _on_dot(self, operation: FormulaStep, a: Nodes, b: Nodes) -> int:
        node = self.graph.mul(a[0], b[0])
        if node == self.graph.zero:
            return node
        driven = self.graph.input("nu", 0) in (a[0], b[0])  # nu is 0 where nothing is driven
        size = self.operations[operation.operands[0]].size
        self.statements.append(Assignment(((SUM, self.locals, node),), size, driven))
        self.locals += 1
        return self.graph.input(LOCAL, self.locals - 1)

    # -- products ------------------------------------------------------------------------------------------------------

    def _multiply_matrix(self, operation: FormulaStep, *operands: Any, helper: str) -> Nodes:
        x: Nodes = operands[-1]
        if x[0] == self.graph.zero:
            return x
        source = self._section_of_vector(x[0], self.operations[operation.operands[-1]].size)
        target = self._section_of_result(self.at, operation.size)
        self._add_call(helper, "T", "p", "w", source, target)
        return self._general_element(target, operation.size)

    def _on_inverse_mass_root(self, operation: FormulaStep) -> str:
        return "root"

    def _on_transposed(self, operation: FormulaStep, matrix: str | None, y: Nodes) -> Nodes:
        return self._multiply_matrix(operation, y, helper="columns_times" if matrix is None else "inverse_mass_times")

    _on_product = partialmethod(_multiply_matrix, helper="rows_times")
    _on_mass = partialmethod(_multiply_matrix, helper="mass_times")
    _on_minv = _on_free_acceleration = partialmethod(_multiply_matrix, helper="inverse_mass_times")

    def _on_gauged(self, operation: FormulaStep, x: Nodes) -> Nodes:
        return (self.graph.mul(self._general_element("gauge", "nv")[0], x[0]),)

    # -- factorisations ------------------------------------------------------------------------------------------------

    def _gram_factor(self, operation: FormulaStep, _: None = None, *, matrix: str, section: str) -> _Factor:
        return _Factor(matrix, section)

    _on_schur = _on_pseudoinverse = partialmethod(_gram_factor, matrix="schur", section="schur_lower")
    _on_weighted_mass = partialmethod(_gram_factor, matrix="weighted", section="law_lower")
    _on_weighted_identity = partialmethod(_gram_factor, matrix="identity", section="law_lower")

    def _on_compliant(self, operation: FormulaStep, compliance: Nodes) -> _Factor:
        return _Factor("compliant", "schur_lower", compliance[0])

    def _on_augmented(self, operation: FormulaStep, penalties: Nodes | None) -> _Factor:
        return _Factor("augmented", "augmented_lower", -1 if penalties is None else penalties[0])

    _on_augmented_metric = _on_augmented

    def _on_stored_factor(self, operation: FormulaStep, factor: _Factor) -> _Factor:
        return replace(factor, section=f"{operation.payload[0]}lower", stored=True)

    def _on_solve(self, operation: FormulaStep, factor: _Factor, right: Nodes) -> Nodes:
        if right[0] == self.graph.zero:
            return right
        target = self._section_of_result(self.at, operation.size)
        self._add_loop(operation.size, target, right[0])
        half = self._factorise(factor, target)  # use numbers of the factor while they are at hand
        self._add_call("solve_rest" if half else "solve", "T", "p", "w", factor.table, factor.section, target)
        return self._general_element(target, operation.size)

    def _factorise(self, factor: _Factor, target: str = "") -> bool:
        """Factorise a matrix unless that has been done; return whether half of the solution in `target` was, too."""
        self.sections[factor.section] = "augmented" if factor.matrix == "augmented" else "gram"
        if factor.stored or factor.section in self.stored:
            return False
        self.stored.add(factor.section)
        name, last = ("factorise_forward", (target,)) if target else ("factorise", ())
        if factor.matrix == "augmented":
            self._add_call("augment", "T", "p", "w", self._section_of_vector(factor.weight, "m"), factor.section)
            self._add_call(name, "T", "p", "w", factor.table, factor.section, "PLAIN_FACTOR", *last)
            return bool(target)
        if factor.matrix != "identity":
            self._add_call("weigh", "T", "p", "w")
        self._add_call("gram", "T", "p", "w", "0" if factor.matrix == "identity" else "1", factor.section)
        masked, compliant = factor.matrix == "schur", factor.matrix == "compliant"
        mode = "MASKED_FACTOR" if masked or compliant else "KEPT_FACTOR"
        if compliant:  # the mask is added to pivots: a term of a diagonal entry is a term of its pivot
            self._add_loop("m", "mask", self.graph.add(self.mask[0], factor.weight))
        result = "suspicious" if masked else ""
        self._add_call(name, "T", "p", "w", factor.table, factor.section, mode, *last, result=result)
        if compliant:
            self._add_loop("m", "mask", self.graph.sub(self.mask[0], factor.weight))
        self.flagged = self.flagged or masked
        return bool(target)

    # -- kept values ---------------------------------------------------------------------------------------------------

    def _on_keep(self, operation: FormulaStep, x: Nodes | None) -> Nodes:
        return self._general_element(str(operation.payload[0]), operation.size) if x is None else x

    def _on_keep_factor(self, operation: FormulaStep, factor: None) -> _Factor:
        matrix = self.operations[operation.operands[0]].kind
        return _Factor(matrix, f"{matrix}_lower", stored=True)


#: Kinds of operations with a place already, and those that need not be kept.
_PLACES = ("quantity", "section")
_SIMPLE = (*_PLACES, "zeros", "constraints")
_NO_SECTIONS = (VELOCITIES, RATES, WORK, LOCAL, PARAMETER, STATE, "q_rates")

#: Kinds of operations that have a meaning on whole vectors.
KINDS = frozenset(ARITHMETIC) | {
    name.removeprefix("_on_") for name in (*vars(Loops), *vars(Replay)) if name.startswith("_on_")
}
