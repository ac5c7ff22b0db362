"""What elements of arrays mean, for comments in emitted code: names of the file where there are some."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from symgen.emit.printer import ElementAccess, Printer
from symgen.ir.program import STATUS, Block, JacobianEntry

if TYPE_CHECKING:
    from symgen.formulate.equations import Equations

Names = dict[tuple[str, int], str]
#: Longest formula of parameters that stands as a name.
LONGEST = 48
#: Sections of ``w`` with an element for each row, and for each velocity.
_OF_ROWS = ("residual", "nu", "multipliers", "mask", "pivot", "row_weight")
_OF_VELOCITIES = ("change", "mass", "gauge")


def of_model(equations: Equations, jacobian: Sequence[JacobianEntry]) -> Names:
    """Return the names of sections of ``w`` that all methods share, and of what is returned at outputs.

    Parameters
    ----------
    equations : Equations
        The derived equations.
    jacobian : sequence of JacobianEntry
        Where entries of D stand.
    """
    rows, speeds = [r.name for r in equations.rows], [v.name for v in equations.velocities]
    names: Names = {(section, i): name for section in _OF_ROWS for i, name in enumerate(rows)}
    names |= {(section, i): name for section in _OF_VELOCITIES for i, name in enumerate(speeds)}
    names |= {("status", i): name for i, name in enumerate(STATUS)}
    names |= {("jacobian", e.slot): f"D {rows[e.row]}, {speeds[e.column]}" for e in jacobian if e.slot is not None}
    state = [q.name for q in (*equations.coordinates, *equations.velocities)]
    return names | {("ydot", i): f"rate of {name}" for i, name in enumerate((*state, "work"))}


def of_observed(equations: Equations) -> Names:
    """Return the names of what ``observe`` writes."""
    labels = [row.name for row in equations.rows]
    labels += [name for c in equations.joint_coordinates for name in (c.name, f"rate of {c.name}")]
    return {("out", i): name for i, name in enumerate(labels)}


@dataclass(frozen=True)
class _ByName(ElementAccess):
    """Elements written by their names, where they have some."""

    def read(self, space: str, index: int) -> tuple[str, str]:
        """Return the name of an input, twice."""
        name = self.names.get((space, index), "").partition(" [")[0] or f"{space}[{index}]"
        return name, name


def of_hoisted(blocks: Sequence[Block], access: ElementAccess) -> Names:
    """Return the formulas of numbers that depend on parameters alone, where they are short.

    Parameters
    ----------
    blocks : sequence of Block
        Of one module; ``prepare`` fills those numbers.
    access : ElementAccess
        With the names of parameters.
    """
    by_name, found = _ByName(access.layout, access.names), Names()
    for block in blocks:
        for target, node in block.outputs if block.name == "prepare" else ():
            printer = Printer(replace(block, outputs=((target, node),)), by_name)
            terms, (text, _) = printer.lines().terms, printer.text[node]
            if not terms and len(text) <= LONGEST:
                found[target.space, target.index] = text
    return found
