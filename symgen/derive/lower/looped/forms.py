"""Contribution of an element to a method's descriptor form: kernels of its residual and of its Jacobian.

``F(t, y, k) = 0`` of a mechanism (`symgen.derive.lower.record_form.record_form`) is a sum over its elements. A body
gives ``q' - N v`` and ``M v' - f``; a force gives ``-f``; a joint gives ``D^T lambda`` to its bodies, ``N D^T eta``
where the form is stabilised, and its own rows at the level of the method. So kernels depend on the element's kind and
on the formula for that kind, and methods with the same formula share them.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import msgspec

from symgen.base.ir.derivative import jacobian
from symgen.base.ir.graph import Graph
from symgen.base.ir.program import Block, ElementProgram, OutputSlot
from symgen.derive.lower.drag import length_of_vector
from symgen.derive.lower.record_form import record_form
from symgen.derive.lower.recorded_law import BEHIND, EQUATIONS
from symgen.derive.lower.scalar import ScalarNodes
from symgen.derive.methods._tape import needed_operations

if TYPE_CHECKING:
    from symgen.derive.formulate.elements import Element
    from symgen.derive.formulate.equations import Equations
    from symgen.derive.lower.looped.instances import Instance
    from symgen.derive.methods._base import Method

#: Groups of unknowns: parts of k, then the state.
UNKNOWNS = ("k_q", "k_v", "k_first", "k_second", "q", "v")


class FormInfo(msgspec.Struct, frozen=True):
    """Facts about an element's part of a descriptor form for the tables.

    Parameters
    ----------
    entries : tuple of (str, int, str, int)
        Group and index, within the element, of the equation and of the unknown of each number that ``tangent`` writes.
    functions : dict
        Operations of each function that is not empty.
    """

    entries: tuple[tuple[str, int, str, int], ...]
    functions: dict[str, int]


#: The kernel of an element's part.
FormProgram = ElementProgram[FormInfo]


def form_key(method: Method, options: Mapping[str, str], kind: str = "joint", shifted: bool = False) -> str:
    """Return a short name of a method's formula for a kind of elements: equal formulas have equal names.

    `shifted`: rows for projections follow equations of states of the file.
    """
    record = record_form(method, options, _recorded_kind(kind))
    (part,) = record.parts
    operations = record.operations
    indices = needed_operations((i for _, i in part.outputs), lambda i: operations[i].operands)
    place = {index: k for k, index in enumerate(indices)}
    parameters = [p.name for p in method.parameters]
    level = record.form if _recorded_kind(kind) == "joint" or record.form == "explicit" else ""
    text: list[object] = [[(name, place[i]) for name, i in part.outputs], level]
    for o in (operations[i] for i in indices):
        payload = parameters.index(str(o.payload[0])) if o.kind == "parameter" else o.payload
        text.append((o.kind, [place[i] for i in o.operands], payload))
    text += ["shifted"] if shifted else []
    return hashlib.sha256(repr(text).encode()).hexdigest()[:8]


def form_stem(key: str, stem: str) -> str:
    """Return the name of the module of an element's part, from the formula's name and its kernel's."""
    return f"form_{key}_{stem[-45:]}"


def _recorded_kind(kind: str) -> str:
    """Return the kind of elements whose formula a kind has: a row with bounds is a joint with a force."""
    return {"bound": "joint", "drag": "force", "rotor": "body"}.get(kind, kind)


def _groups_of_bounded_row(g: Graph, e: Equations, groups: list[tuple[str, Any]]) -> list[tuple[str, Any]]:
    """Return the groups of a row with bounds: where it is off, its multipliers are 0, and its force acts."""
    held, changed = e.rows[0].held, list[tuple[str, Any]]()
    assert held is not None, "a row with bounds has a mode"
    for group, nodes in groups:
        if group in ("first", "second"):
            idle = g.mul(g.sub(g.one, held), g.input(f"k_{group}", 0))
            nodes = (g.add(g.mul(held, nodes[0]), idle),)
        elif group == "v":
            nodes = tuple(g.sub(n, f) for n, f in zip(nodes, e.forces, strict=True))
        elif group == "power":
            nodes = g.add(nodes[0] if isinstance(nodes, tuple) else nodes, e.power)
        changed.append((group, nodes))
    return changed


def _groups_of_drag(g: Graph, e: Equations) -> list[tuple[str, Any]]:
    """Return the groups of an effort that depends on a reaction: on the unknown multipliers of a joint."""
    (drag,) = e.drags
    parts = [g.sum_of(g.mul(n, g.input("k_first", row)) for row, n in line) for line in drag.pressed]
    size = parts[0] if drag.signed else length_of_vector(g, parts)
    force = g.mul(drag.sign, g.mul(drag.coefficient, size))
    entries = dict(e.rows[drag.row].entries)
    along = tuple(g.mul(force, entries[j]) if j in entries else g.zero for j in range(e.nv))
    return [("v", along), ("power", g.neg(g.mul(force, drag.rate)))]


def lower_form(
    element: Element, instance: Instance, method: Method, options: Mapping[str, str], stem: str
) -> FormProgram:
    """Lower an element's part of a descriptor form.

    Parameters
    ----------
    element, instance
        As for `symgen.derive.lower.looped.kernels.lower_kernel`.
    method, options : Method, mapping
        The method with its structural options, complete.
    stem : str
        Name of the module.
    """
    e, record = element.equations, record_form(method, options, _recorded_kind(instance.kind))
    names = [p.name for p in method.parameters]
    scalars = ScalarNodes(e, record.operations, names, {})
    (part,) = record.parts
    scalars.evaluate_remaining(needed_operations((i for _, i in part.outputs), lambda i: record.operations[i].operands))
    g = scalars.graph
    groups = [(group, scalars.values[index]) for group, index in part.outputs]
    if instance.kind == "bound":
        groups = _groups_of_bounded_row(g, e, groups)
    if instance.kind == "drag":
        groups = _groups_of_drag(g, e)
    if instance.kind == "rotor":
        groups = [(group, nodes) for group, nodes in groups if group == "v"]
    rows = [(group, i, n) for group, nodes in groups if group in EQUATIONS for i, n in enumerate(nodes) if n != g.zero]
    if instance.kind == "state":
        rows = [("z", 1, g.sub(g.input("k_z", 1), e.state_rates[0]))]
    explicit = record.form == "explicit"  # M and D are enough
    last = len(EQUATIONS) - BEHIND.get(record.form, 0)
    counted = [row for row in rows if (row[0] == "v" if explicit else row[0] in (*EQUATIONS[:last], "z"))]
    sizes = {"k_q": e.nq, "k_v": e.nv, "k_first": e.m, "k_second": e.m, "q": e.nq, "v": e.nv}
    unknowns = UNKNOWNS[: UNKNOWNS.index("k_second")] if explicit else UNKNOWNS
    keys = [(group, i) for group in unknowns for i in range(sizes[group])]
    keys += [] if explicit else [("z", i) for i in range(1, len(e.states) + 1)] + [("k_z", 1)]
    entries: list[tuple[str, int, str, int]] = []
    slopes: list[int] = []
    for (group, i, _), derivatives in zip(counted, jacobian(g, [n for _, _, n in counted], keys), strict=True):
        for space, index in sorted(derivatives):
            entries.append((group, i, space, index))
            slopes.append(derivatives[space, index])
    residual = [(OutputSlot(group, i), n) for group, i, n in rows]
    residual += [(OutputSlot("power", 0), n) for group, n in groups if group == "power" and n != g.zero]
    blocks = []
    for name, purpose, outputs in (
        ("residual", "its part of F(t, y, k) of the descriptor form, and of the power", residual),
        ("tangent", "its entries of dF/dk and dF/dy", [(OutputSlot("entry", i), n) for i, n in enumerate(slopes)]),
    ):
        if outputs:
            graph = Graph()
            nodes = element.copy_over_records([n for _, n in outputs], graph, g)
            copied = tuple((target, node) for (target, _), node in zip(outputs, nodes, strict=True))
            blocks.append(Block(name, purpose, graph, copied, ()))
    info = FormInfo(tuple(entries), {b.name: b.operations for b in blocks})
    return FormProgram(stem, instance.label, info, tuple(blocks), e.tables)
