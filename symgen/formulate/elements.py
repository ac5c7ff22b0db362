"""One body, joint or force on its own: its equations over the frames of its bodies, derived once for each kind.

The abstract mechanism of an element (`symgen.lower.looped.instances`) goes through the same derivation as a whole
one. What depends on the position of one body alone, such as the entries of its rotation matrix, is cut out and read
from the body's *record*, which is filled once for all elements on that body.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from symgen.describe.mechanism import Mechanism
from symgen.formulate.equations import Equations
from symgen.formulate.formulate import formulate
from symgen.formulate.measures import ModelNodes
from symgen.ir.graph import Graph

#: Room for one frame's record in the numbering of ("record", frame * RECORD + place).
RECORD = 64


@dataclass(frozen=True)
class FrameRecord:
    """A body's record: its coordinates, its velocities, then what else its frame needs, as nodes of q and v.

    Parameters
    ----------
    q, v : tuple of int
        Indices of the body's coordinates and velocities in the element's equations.
    slots : tuple of int
        Nodes of the further numbers, entries of the rotation matrix for instance.
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
        Of the abstract mechanism; inputs ``t``, ``q``, ``v`` and ``p`` (the constants).
    frames : tuple of FrameRecord
        One for each body.
    """

    equations: Equations
    frames: tuple[FrameRecord, ...]

    def over_records(self, nodes: Sequence[int], graph: Graph, source: Graph | None = None) -> list[int]:
        """Copy nodes into `graph` as functions of ``t``, ``p`` and ``("record", RECORD * frame + place)``.

        `source` is a copy of the equations' graph with more nodes, where these are meant.
        """
        source = self.equations.graph if source is None else source
        places: dict[int, int] = {}
        for f, frame in enumerate(self.frames):
            inputs = [source.input("q", i) for i in frame.q] + [source.input("v", i) for i in frame.v]
            for place, node in enumerate((*inputs, *frame.slots)):
                places.setdefault(node, graph.input("record", RECORD * f + place))

        def image(node: int) -> int:
            return places[node] if node in places else graph.input(*source.key(node))

        return graph.rebuilt(source, nodes, image, places.__contains__)


def derive_element(abstract: Mechanism) -> Element:
    """Derive the equations of an element.

    Parameters
    ----------
    abstract : Mechanism
        Its abstract mechanism.
    """
    equations = formulate(abstract)
    model = ModelNodes(abstract, equations.graph)  # the same graph: nodes that are there already are found again
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
    return Element(equations, tuple(frames))
