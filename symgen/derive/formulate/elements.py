"""Equations of a single body, joint or force over the frames of its bodies, derived once for each kind.

The abstract mechanism of an element (`symgen.derive.lower.looped.instances`) is derived like a complete one. Nodes that
depend on the position of one body alone, such as the entries of its rotation matrix, are replaced by entries of the
body's *record*, which is filled once for all elements on that body.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from symgen.base.ir.graph import Graph
from symgen.derive.formulate.equations import ConstraintRow, Equations
from symgen.derive.formulate.formulate import formulate
from symgen.derive.formulate.measure_nodes import ModelNodes
from symgen.derive.formulate.rotors import rotor_rate, with_rotors
from symgen.describe.mechanism import Mechanism

#: Stride of the records in the numbering ("record", frame * RECORD + place).
RECORD = 64


@dataclass(frozen=True)
class FrameRecord:
    """A body's record: its coordinates, its velocities, then further numbers of its frame, as nodes of q and v.

    Parameters
    ----------
    q, v : tuple of int
        Indices of the body's coordinates and velocities in the element's equations.
    slots : tuple of int
        Nodes of the further numbers, such as entries of the rotation matrix.
    """

    q: tuple[int, ...]
    v: tuple[int, ...]
    slots: tuple[int, ...]

    @property
    def size(self) -> int:
        """Length of the record."""
        return len(self.q) + len(self.v) + len(self.slots)


@dataclass(frozen=True)
class Element:
    """The equations of one element.

    Parameters
    ----------
    equations : Equations
        Equations of the abstract mechanism; inputs ``t``, ``q``, ``v`` and ``p`` (the constants).
    frames : tuple of FrameRecord
        One for each body.
    """

    equations: Equations
    frames: tuple[FrameRecord, ...]

    def copy_over_records(self, nodes: Sequence[int], graph: Graph, source: Graph | None = None) -> list[int]:
        """Copy nodes into `graph` as functions of ``t``, ``p`` and ``("record", RECORD * frame + place)``.

        `source` is an extended copy of the equations' graph that contains `nodes`; by default that graph itself.
        """
        source = self.equations.graph if source is None else source
        places: dict[int, int] = {}
        for f, frame in enumerate(self.frames):
            inputs = [source.input("q", i) for i in frame.q] + [source.input("v", i) for i in frame.v]
            for place, node in enumerate((*inputs, *frame.slots)):
                places.setdefault(node, graph.input("record", RECORD * f + place))

        def node_in_graph(node: int) -> int:
            return places[node] if node in places else graph.input(*source.key(node))

        return graph.rebuild_from(source, nodes, node_in_graph, places.__contains__)


def derive_element(abstract: Mechanism) -> Element:
    """Derive the equations of an element.

    Parameters
    ----------
    abstract : Mechanism
        Its abstract mechanism.
    """
    equations = formulate(abstract)
    model = ModelNodes(abstract, equations.graph)  # the same graph: existing nodes are reused
    frames: list[FrameRecord] = []
    q = v = 0
    for body in abstract.bodies:
        slots = tuple(
            dict.fromkeys(
                node
                for node in model.frame_inputs(body.name)
                if equations.graph.nodes[node].op not in ("const", "input")
            )
        )
        nq, nv = len(body.coordinates), len(body.speeds)
        frames.append(FrameRecord(tuple(range(q, q + nq)), tuple(range(v, v + nv)), slots))
        q, v = q + nq, v + nv
    if abstract.rotors:
        equations = _equations_of_rotor(model, equations)
    return Element(equations, tuple(frames))


def _equations_of_rotor(model: ModelNodes, equations: Equations) -> Equations:
    """Return the equations of a rotor without the bodies that it joins.

    M is R^T R: with its inertia J and the rate r v of its angle the only row is R = sqrt(J) r, without Phi, nu, gamma.
    """
    g, forces = model.graph, [model.graph.zero] * len(model.velocities)
    mass, kinetic = with_rotors(model, (), forces)
    (rotor,) = model.mechanism.rotors
    inertia, _, row, _ = rotor_rate(model, rotor)
    root = g.call("sqrt", inertia)
    entries = tuple((i, g.mul(root, node)) for i, node in sorted(row.items()))
    rows = (ConstraintRow("R", "e", "rad", None, entries, g.zero, g.zero, None),)
    return replace(equations, mass=mass, rows=rows, forces=tuple(forces), kinetic=kinetic)
