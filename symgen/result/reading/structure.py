"""Names of shared terms of expressions: entries of rotation matrices, and the motion of bodies that joints carry."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from itertools import count

from symgen.base.ir.graph import Graph
from symgen.base.vocabulary.expressions import Reading
from symgen.base.vocabulary.measures import Carrying, Driven, Exerted, Flexed
from symgen.derive.formulate.equations import Equations
from symgen.derive.formulate.flexure import exertions_of_force
from symgen.derive.formulate.frames import FRAME_SLOTS, SPATIAL_SLOTS
from symgen.derive.formulate.measure_nodes import ModelNodes
from symgen.describe.facts.repeats import without_repeats
from symgen.describe.formulas.reported_columns import columns_of_force_elements
from symgen.describe.mechanism import Mechanism

#: A term that is used more than once gets a number for a name where it has at least so many operations.
SHARED = 2
_LEAVES = ("const", "input")
_UNNAMED = ("neg", "lt", "le", "gt", "ge", "and", "or")


def nodes_with_names(mechanism: Mechanism, equations: Equations) -> dict[int, str]:
    """Return the nodes that have a meaning of their own, with their names.

    Parameters
    ----------
    mechanism : Mechanism
        What the equations were derived from.
    equations : Equations
        The derived equations.

    Returns
    -------
    dict
        In the plane ``BODY.c`` and ``BODY.s``, cosine and sine of its angle; in space ``BODY.a00`` to ``BODY.a22``,
        its rotation matrix; where joints carry the bodies also their places and velocities, such as ``BODY.x``, but
        for those that are coordinates and velocities of the state: of free bodies. Of force elements
        ``FORCE.length``, ``FORCE.rate``, ``FORCE.force``.
    """
    model = ModelNodes(without_repeats(mechanism)[0])
    slots = SPATIAL_SLOTS if model.spatial else FRAME_SLOTS
    named = [(body.name, slot) for body in mechanism.bodies for slot in slots]
    nodes = [node for body in mechanism.bodies for node in model.frame_inputs(body.name)]
    inputs = {key: equations.graph.input(*key) for key in model.graph.inputs_of(nodes)}
    copies = equations.graph.copy().copy_from(model.graph, nodes, inputs)
    names: dict[int, str] = {}
    state = {quantity.name for quantity in (*equations.coordinates, *equations.velocities)}
    computed = equations.graph.nodes
    for (body, slot), node in zip(named, copies, strict=True):
        # what has the other sign needs no name: that of its operand serves both
        if f"{body}.{slot}" not in state and node < len(computed) and computed[node].op not in (*_LEAVES, "neg"):
            names.setdefault(node, f"{body}.{slot}")
    return names | {n: x for n, x in element_terms(mechanism, equations).items() if n not in names}


def element_terms(mechanism: Mechanism, equations: Equations) -> dict[int, str]:
    """Return the nodes of the equations that are measures and efforts of force elements, with their names."""
    model = ModelNodes(without_repeats(mechanism)[0])
    columns = [(c.name, c.formula) for c in columns_of_force_elements(mechanism) if isinstance(c.formula, Reading)]
    written = [(name, node) for name, r in columns if (node := _node_of_reading(model, r)) is not None]
    nodes = [node for _, node in written]
    inputs = {key: equations.graph.input(*key) for key in model.graph.inputs_of(nodes)}
    copies = equations.graph.copy().copy_from(model.graph, nodes, inputs)
    names, computed = dict[int, str](), equations.graph.nodes
    for (name, _), node in zip(written, copies, strict=True):
        if node < len(computed) and computed[node].op not in (*_LEAVES, "neg"):
            names.setdefault(node, name)
    return names


def _node_of_reading(model: ModelNodes, reading: Reading) -> int | None:
    """Return the node of a measure or an effort; None of what multipliers, powers or beams are."""
    source = reading.source
    if isinstance(source, Carrying | Driven | Flexed) or (
        isinstance(source, Exerted) and (source.power or source.flexures)
    ):
        return None
    if isinstance(source, Exerted):
        return model.graph.sum_of(e.total for e in exertions_of_force(model, source))
    return model.reading(reading)


def shared_terms(
    graph: Graph, nodes: Iterable[int], names: Mapping[int, str], others: Container[str] = ()
) -> dict[int, str]:
    """Return names for all terms that `nodes` use more than once and that have none yet.

    Parameters
    ----------
    graph : Graph
        Holds the nodes.
    nodes : iterable of int
        What is written.
    names : mapping
        Nodes with names of their own.
    others : container of str
        Names that mean something else.
    """
    ends = list(nodes)
    used, numbered, terms = count_uses(graph, ends), free_names(others), dict[int, str]()
    cost: dict[int, int] = {}
    for node in graph.required_nodes(ends):
        op, args, _ = graph.nodes[node]
        cost[node] = 0 if op in _LEAVES else 1 + sum(cost[a] for a in args)
        if node in names:
            terms[node] = names[node]
        elif used[node] > 1 and cost[node] >= SHARED and op not in _UNNAMED:
            terms[node] = next(numbered)
        if node in terms:
            cost[node] = 0
    return terms


def count_uses(graph: Graph, ends: Sequence[int]) -> Counter[int]:
    """Count how often nodes are operands of what `ends` need, or ends themselves."""
    return Counter([*ends, *(a for n in graph.required_nodes(ends) for a in graph.nodes[n].args)])


def free_names(others: Container[str]) -> Iterator[str]:
    """Yield names of shared terms: s1, s2, ..., without those that are taken, or typeset like one that is."""
    return (f"s{i}" for i in count(1) if f"s{i}" not in others and f"s_{i}" not in others)
