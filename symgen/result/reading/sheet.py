"""Content of documents and pages: equations as lines and matrices of boxes, in the order of a textbook."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from symgen.base.vocabulary.expressions import call
from symgen.describe.formulas.formula_text import to_text
from symgen.result.reading.boxes import TextBox, bracket_box, matrix_box, name_box, rate_box, row_box, sign_box
from symgen.result.reading.structure import nodes_with_names
from symgen.result.reading.typeset import Sum, Typesetter, as_term

if TYPE_CHECKING:
    from symgen.base.vocabulary.quantities import Quantity
    from symgen.derive.formulate.equations import ConstraintRow, Equations
    from symgen.describe.mechanism import Mechanism

#: Width of a line, in units of the type's size.
LINE = 43.0


@dataclass(frozen=True)
class Equation:
    """An equation: its left side, and a sum."""

    left: TextBox
    right: Sum
    key: str = ""


class Sheet:
    """Equations of a mechanism, written.

    Parameters
    ----------
    mechanism : Mechanism
        The description, with its tree where coordinates are those of joints.
    equations : Equations
        What was derived.
    joints : container of str, optional
        Joints that are written; all by default.
    """

    def __init__(self, mechanism: Mechanism, equations: Equations, joints: Sequence[str] = ()) -> None:
        self.mechanism, self.equations = mechanism, equations
        self.rows = tuple(row for row in equations.rows if not joints or row.joint in joints)
        g = equations.graph
        ends = [n for r in self.rows for n in (r.phi, r.nu, r.gamma, *(x for _, x in r.entries)) if n is not None]
        ends += [n for block in equations.mass for line in block.entries for n in line]
        ends += [*equations.forces, *self._energies]
        ends += [*(n for n in equations.q_rates if g.nodes[n].op != "input"), g.zero]
        parameters = {quantity.name for quantity in equations.parameters}
        self.writer = Typesetter(equations, ends, self._structure_names(), parameters)

    def _structure_names(self) -> dict[int, str]:
        """Return the names of the structure; cosine and sine of one coordinate read best as they are."""
        g, names = self.equations.graph, nodes_with_names(self.mechanism, self.equations)
        simple = {n for n in names if g.nodes[n].op in ("sin", "cos") and g.nodes[g.nodes[n].args[0]].op == "input"}
        return {n: title for n, title in names.items() if n not in simple}

    # -- constraints -----------------------------------------------------------------------------------------------

    @property
    def joints(self) -> tuple[str, ...]:
        """Joints with rows, in the order of the file."""
        return tuple(dict.fromkeys(r.joint for r in self.rows))

    def rows_of_joint(self, joint: str) -> tuple[ConstraintRow, ...]:
        """Return the rows of a joint."""
        return tuple(r for r in self.rows if r.joint == joint)

    def phi(self, rows: Iterable[ConstraintRow]) -> list[Equation]:
        """Return ``Phi_ROW = ...`` of holonomic rows."""
        return [
            Equation(indexed_letter("Phi", r.name), self.writer.sum_of_node(r.phi), r.name)
            for r in rows
            if r.phi is not None
        ]

    def nu(self, rows: Iterable[ConstraintRow]) -> list[Equation]:
        """Return ``nu_ROW = ...`` where it is not 0."""
        zero = self.equations.graph.zero
        return [
            Equation(indexed_letter("nu", r.name), self.writer.sum_of_node(r.nu), r.name) for r in rows if r.nu != zero
        ]

    def gamma(self, rows: Iterable[ConstraintRow]) -> list[Equation]:
        """Return ``gamma_ROW = ...``."""
        return [Equation(indexed_letter("gamma", r.name), self.writer.sum_of_node(r.gamma), r.name) for r in rows]

    @cached_property
    def groups(self) -> dict[str, list[int]]:
        """Velocities by their bodies, or joints of the tree."""
        by_owner: dict[str, list[int]] = {}
        for i, v in enumerate(self.equations.velocities):
            by_owner.setdefault(v.name.rpartition(".")[0], []).append(i)
        return by_owner

    def jacobian(self, joint: str) -> list[Equation]:
        """Return the blocks of D of a joint's rows, by what the velocities belong to; those that are 0 are left out."""
        rows, blocks = self.rows_of_joint(joint), list[Equation]()
        for group, indices in self.groups.items():
            entries = [[dict(r.entries).get(i, self.equations.graph.zero) for i in indices] for r in rows]
            if any(n != self.equations.graph.zero for line in entries for n in line):
                left = TextBox("name", text="D", index=f"{joint},{group}", width=1.0 + 0.42 * len(joint + group))
                blocks.append(self._narrow_matrix(left, entries, joint))
        return blocks

    def _narrow_matrix(self, left: TextBox, nodes: list[list[int]], key: str = "") -> Equation:
        """Return a matrix that is no wider than a line: its widest entries get names."""
        waiting = {n for line in nodes for n in line}
        entries = self._matrix_of_nodes(nodes)
        while waiting and entries.width + left.width > LINE - 3.0:
            widest = max(waiting, key=lambda n: (self.writer.box_of_node(n).width, n))
            waiting.remove(widest)
            self.writer.name_entry(widest)
            entries = self._matrix_of_nodes(nodes)
        return Equation(left, as_term(entries), key)

    def _matrix_of_nodes(self, nodes: Iterable[Iterable[int]]) -> TextBox:
        return matrix_box([[self.writer.box_of_node(n) for n in line] for line in nodes])

    def whole_matrices(self) -> list[Equation]:
        """Return M, and D where it has rows, as matrices; for small mechanisms."""
        e, zero = self.equations, self.equations.graph.zero
        masses = {
            (i, j): b.entries[r][c] for b in e.mass for r, i in enumerate(b.columns) for c, j in enumerate(b.columns)
        }
        everything = {"M": [[masses.get((i, j), zero) for j in range(e.nv)] for i in range(e.nv)]}
        everything["D"] = [[dict(r.entries).get(j, zero) for j in range(e.nv)] for r in self.rows]
        return [
            Equation(name_box(k), as_term(self._matrix_of_nodes(nodes))) for k, nodes in everything.items() if nodes
        ]

    # -- motion ----------------------------------------------------------------------------------------------------

    def mass(self) -> list[Equation]:
        """Return the diagonal entries of M as equations, and its blocks as matrices."""
        lines = list[Equation]()
        for block in self.equations.mass:
            names = [self.equations.velocities[i].name for i in block.columns]
            if len(names) == 1:
                lines.append(
                    Equation(
                        row_box(name_box("M"), _velocity_arguments(names[0])),
                        self.writer.sum_of_node(block.entries[0][0]),
                        names[0],
                    )
                )
            elif len(names) <= 6:
                lines.append(
                    self._narrow_matrix(
                        row_box(name_box("M"), _velocity_arguments(names[0])), [list(line) for line in block.entries]
                    )
                )
            else:
                lines += [
                    Equation(
                        row_box(name_box("M"), _velocity_arguments(names[i], names[j])),
                        self.writer.sum_of_node(block.entries[i][j]),
                    )
                    for i in range(len(names))
                    for j in range(i, len(names))
                    if block.entries[i][j] != self.equations.graph.zero
                ]
        return lines

    def forces(self) -> list[Equation]:
        """Return the entries of f that are not 0."""
        g, e = self.equations.graph, self.equations
        pairs = zip(e.velocities, e.forces, strict=True)
        return [
            Equation(row_box(name_box("f"), _velocity_arguments(v.name)), self.writer.sum_of_node(n), v.name)
            for v, n in pairs
            if n != g.zero
        ]

    def rates(self) -> list[Equation]:
        """Return ``q' = N v`` where it is not ``q' = v``, and the rates of the states of the file."""
        g, e = self.equations.graph, self.equations
        pairs = zip(e.coordinates, e.q_rates, strict=True)
        moving = [(q, n) for q, n in pairs if g.nodes[n].op != "input"]
        whole = (*moving, *zip(e.states, e.state_rates, strict=True))
        return [Equation(rate_box(name_box(x.name)), self.writer.sum_of_node(n), x.name) for x, n in whole]

    def energies(self) -> list[Equation]:
        """Return T, V, the power of forces without potential, and the power of drivers without rows, b v' + c."""
        e = self.equations
        lefts = [name_box("T"), name_box("V"), name_box("P")]
        if e.driving is not None:
            lefts += [
                *(row_box(name_box("b"), _velocity_arguments(e.velocities[j].name)) for j, _ in e.driving.entries),
                name_box("c"),
            ]
        return [Equation(left, self.writer.sum_of_node(n)) for left, n in zip(lefts, self._energies, strict=True)]

    @property
    def _energies(self) -> list[int]:
        e = self.equations
        driving = [] if e.driving is None else [*(n for _, n in e.driving.entries), e.driving.rest]
        return [e.kinetic, e.potential, e.power, *driving]

    def sentences_on_drivers(self) -> dict[str, str]:
        """Return a sentence by name for each driver without a row: the motion that it prescribes."""
        topology = self.mechanism.topology
        joints = {} if topology is None else {link.body: link.joint for link in topology.links}
        sentences = {}
        for p in () if topology is None else topology.prescribed:
            value = to_text(p.value if p.sign > 0 else call("neg", p.value))
            sentences[p.driver] = f"{joints[p.body] or p.body}.{p.label} = {value}"
        return sentences

    def shared_equations(self, nodes: Iterable[int]) -> list[Equation]:
        """Return the equations of the shared terms of `nodes`."""
        return [
            Equation(self.writer.definitions[n][0], self.writer.definitions[n][1])
            for n in self.writer.names_used(nodes)
        ]

    def nodes(self, what: Iterable[str]) -> list[int]:
        """Return the nodes that some quantities are made of, by `QUANTITIES`' names."""
        e = self.equations
        nodes = e.nodes(self.rows) | {"N": [*e.q_rates, *e.state_rates], "energies": self._energies}
        keys = {"Phi": "phi", "D": "jacobian", "M": "mass", "f": "forces"}
        return [n for part in what for n in nodes.get(keys.get(part, part), ())]

    def quantities(self) -> list[tuple[str, tuple[Quantity, ...]]]:
        """Return coordinates, velocities, parameters and inputs under their headings."""
        e = self.equations
        own, inputs = (tuple(p for p in e.parameters if (p.name in e.inputs) == is_input) for is_input in (False, True))
        states = [("States", e.states)] if e.states else []
        moving = [("Coordinates", e.coordinates), ("Velocities", e.velocities)]
        return [*moving, *states, ("Parameters", own), ("Inputs", inputs)]


def indexed_letter(letter: str, index: str) -> TextBox:
    """Return a letter of the notation with the name of a row."""
    return TextBox("name", text=letter, index=index, width=0.8 + 0.42 * len(index))


def _velocity_arguments(*names: str) -> TextBox:
    """Return the names of velocities as arguments."""
    parts = [name_box(names[0])]
    for other in names[1:]:
        parts += [sign_box(","), name_box(other)]
    return bracket_box(row_box(*parts))
