"""Quantities of derived equations, with the nodes of their entries."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.ir.derivative import jacobian
from symgen.base.ir.interpolation import Interpolation
from symgen.base.ir.program import DERIVATIVES, MODES, table_of_payload
from symgen.base.vocabulary.expressions import SMOOTH

if TYPE_CHECKING:
    from symgen.derive.formulate.equations import Equations


#: Quantities of the equations: attribute and words.
QUANTITIES = {
    "Phi": "constraints, 0 where a row has none",
    "D": "Jacobian, D v = nu",
    "nu": "right-hand side of the velocity constraints",
    "gamma": "right-hand side of the acceleration constraints, D v' = gamma",
    "N": "kinematic map, q' = N v",
    "M": "mass matrix",
    "f": "forces, M v' + D^T lambda = f",
    "T": "kinetic energy",
    "V": "potential energy",
    "power": "power of the forces without potential",
    "b": "power of the drivers that prescribe coordinates, b v' + c: by acceleration",
    "c": "the same: what is left where v' is 0",
}
#: Those that exist where drivers prescribe coordinates.
OF_DRIVERS = ("b", "c")


def input_names(e: Equations) -> dict[tuple[str, int], str]:
    """Return the names of time, coordinates, velocities, parameters and of angles as they were last."""
    spaces = {"q": e.coordinates, "v": e.velocities, "p": e.parameters}
    names = {(space, i): x.name for space, quantities in spaces.items() for i, x in enumerate(quantities)}
    names |= {("z", i): x.name for i, x in enumerate(e.states, 1)}
    names |= {("winding", i): f"turned_{i}" for i in range(len(e.windings))}
    read = {space for space, _ in e.graph.inputs_of(e.state_rates)}  # results, by rates of states alone
    if "ydot" in read:
        names |= {("ydot", e.nq + i): f"{x.name}.rate" for i, x in enumerate(e.velocities)}
    if "multipliers" in read:
        names |= {("multipliers", i): f"{row.name}.multiplier" for i, row in enumerate(e.rows)}
    switched = (row.name for row in e.rows if row.held is not None)
    modes = (f"{row}.{number}" for row in switched for number in MODES)
    return {("t", 0): "t", **names, **{("modes", i): name for i, name in enumerate(modes)}}


#: Shape of a matrix; row, column and node of its entries.
Entries = tuple[tuple[int, int], tuple[tuple[int, int, int], ...]]


def nodes_of_quantities(e: Equations) -> Mapping[str, Entries]:
    """Return for each quantity its shape, and row, column and node of its entries; N is added to the graph."""
    rates = jacobian(e.graph, e.q_rates, [("v", j) for j in range(e.nv)])
    zero = e.graph.zero

    def column_of_nodes(nodes: Iterable[int]) -> Entries:
        listed = list(nodes)
        return (len(listed), 1), tuple((i, 0, n) for i, n in enumerate(listed))

    mass = ((i, j, b.entries[r][c]) for b in e.mass for r, i in enumerate(b.columns) for c, j in enumerate(b.columns))
    return {
        "Phi": column_of_nodes(zero if row.phi is None else row.phi for row in e.rows),
        "D": ((e.m, e.nv), tuple((i, j, node) for i, row in enumerate(e.rows) for j, node in row.entries)),
        "nu": column_of_nodes(row.nu for row in e.rows),
        "gamma": column_of_nodes(row.gamma for row in e.rows),
        "N": ((e.nq, e.nv), tuple((i, j, n) for i, row in enumerate(rates) for (_, j), n in sorted(row.items()))),
        "M": ((e.nv, e.nv), tuple(mass)),
        "f": column_of_nodes(e.forces),
        **{k: column_of_nodes([n]) for k, n in (("T", e.kinetic), ("V", e.potential), ("power", e.power))},
        "b": ((1, e.nv), () if e.driving is None else tuple((0, j, n) for j, n in e.driving.entries)),
        "c": column_of_nodes([zero if e.driving is None else e.driving.rest]),
    }


def python_name(payload: object) -> str:
    """Return the name of a table, or of a derivative of it, in expressions."""
    name, what = table_of_payload(payload)
    return f"{what.replace('value', 'table')}_{name}"


def table_functions(tables: Iterable[Interpolation]) -> dict[str, Any]:
    """Return the interpolated functions and their derivatives by their names in expressions."""
    by_name: dict[str, Any] = {}
    for table in tables:
        for order in range(len(DERIVATIVES)):
            payload = f"{SMOOTH if table.pieces else ''}{table.name}" + "'" * order
            value = np.vectorize(lambda x, table=table, order=order: table.value(float(x), order), otypes=[float])
            by_name[python_name(payload)] = value
    return by_name
