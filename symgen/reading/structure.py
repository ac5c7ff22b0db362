"""Names for what expressions share: entries of rotation matrices, and the motion of bodies that joints carry."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping

from symgen.describe.mechanism import Mechanism
from symgen.describe.repeats import without_repeats
from symgen.formulate.equations import Equations
from symgen.formulate.frames import FRAME_SLOTS
from symgen.formulate.measures import Model
from symgen.formulate.spatial import SPATIAL_SLOTS
from symgen.ir.graph import Graph

#: A term that is used more than once gets a number for a name where it has at least so many operations.
SHARED = 2
_LEAVES = ("const", "input")


def structure(mechanism: Mechanism, equations: Equations) -> dict[int, str]:
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
        for those that are coordinates and velocities of the state: of free bodies.
    """
    model = Model(without_repeats(mechanism)[0])
    slots = SPATIAL_SLOTS if model.spatial else FRAME_SLOTS
    named = [(body.name, slot) for body in mechanism.bodies for slot in slots]
    nodes = [node for body in mechanism.bodies for node in model.frame_inputs(body.name)]
    inputs = {key: equations.graph.input(*key) for key in _inputs(model.graph, nodes)}
    copies = equations.graph.copy().inline(model.graph, nodes, inputs)
    names: dict[int, str] = {}
    state = {quantity.name for quantity in (*equations.coordinates, *equations.velocities)}
    for (body, slot), node in zip(named, copies, strict=True):
        computed = (
            f"{body}.{slot}" not in state
            and node < len(equations.graph.nodes)
            and equations.graph.nodes[node].op not in _LEAVES
        )
        if computed and not _turned(equations.graph, node):
            names.setdefault(node, f"{body}.{slot}")
    return names


def _turned(graph: Graph, node: int) -> bool:
    """Whether a node is another one with the other sign, whose name serves both."""
    return graph.nodes[node].op == "neg"


def _inputs(graph: Graph, nodes: Iterable[int]) -> list[tuple[str, int]]:
    operations = (graph.nodes[n] for n in graph.needed(nodes))
    return [o.payload for o in operations if o.op == "input" and isinstance(o.payload, tuple)]


def shared_terms(
    graph: Graph, nodes: Iterable[int], names: Mapping[int, str], taken: Container[str] = ()
) -> dict[int, str]:
    """Return names for all that `nodes` use more than once, beside those that some have already.

    Parameters
    ----------
    graph : Graph
        Holds the nodes.
    nodes : iterable of int
        What is written.
    names : mapping
        Nodes with names of their own.
    taken : container of str
        Names that mean something else.
    """
    ends = list(nodes)
    uses: dict[int, int] = {}
    cost: dict[int, int] = {}
    needed = graph.needed(ends)
    for node in needed:
        for argument in graph.nodes[node].args:
            uses[argument] = uses.get(argument, 0) + 1
    for node in ends:
        uses[node] = uses.get(node, 0) + 1
    terms: dict[int, str] = {}
    number = 0
    for node in needed:
        operation = graph.nodes[node]
        if operation.op in _LEAVES:
            cost[node] = 0
            continue
        cost[node] = 1 + sum(cost[a] for a in operation.args)
        if node in names:
            terms[node] = names[node]
        elif (
            uses[node] > 1 and cost[node] >= SHARED and operation.op not in ("neg", "lt", "le", "gt", "ge", "and", "or")
        ):
            number += 1
            while f"s{number}" in taken:
                number += 1
            terms[node] = f"s{number}"
        if node in terms:
            cost[node] = 0
    return terms
