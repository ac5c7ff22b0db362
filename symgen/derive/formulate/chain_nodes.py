"""Numbers of the piece of a chain that a marker belongs to, as choices in the graph of a model.

All pieces have one formula, of these numbers (`symgen.describe.contacts.on_chain`). Only the numbers are chosen.
"""

from __future__ import annotations

from symgen.base.vocabulary.measures import Chain, PieceNumber
from symgen.derive.formulate.derived_measure import DerivedMeasure
from symgen.describe.contacts.on_chain import numbers_at
from symgen.describe.formulas.formula_nodes import Formulas

#: Distance in place of that from no piece [m].
_FAR = 1e300


def numbers_of_piece(nodes: Formulas, chain: Chain, place: tuple[int, int]) -> dict[object, DerivedMeasure]:
    """Return the numbers of the piece of a chain that its marker belongs to.

    It belongs to a piece if it is between the normals at both of its ends, and not farther on its right than the
    piece's depth; of several such pieces to the nearest. Otherwise it belongs to the nearer end of an open chain.

    Parameters
    ----------
    nodes : Formulas
        Nodes of the model.
    chain : Chain
        The chain.
    place : tuple of int
        Nodes of the coordinates of the marker in the frame of the chain.
    """
    g, choice = nodes.graph, _Choice(nodes, chain, place)
    at = [numbers_at(chain, i) for i in range(len(chain.pieces))]
    numbers = [[nodes.expression(e) for e in each.values()] for each in at]
    inner, chosen, best = range(len(numbers)), numbers[0], g.constant(_FAR)
    if not chain.closed:
        inner = range(1, len(numbers) - 1)
        last = g.call("lt", choice.height(-1), choice.height(0))  # of circles with one radius
        chosen = choice.select(last, numbers[-1], chosen)
        best = g.call("where", last, choice.gap(-1), choice.gap(0)) if chain.hollow else best
    for i in inner:
        belongs = g.call("and", choice.is_between_ends(i), choice.is_in_front(i))
        if chain.hollow:
            gap = choice.gap(i)
            belongs = g.call("and", belongs, g.call("lt", gap, best))
            best = g.call("where", belongs, gap, best)
        chosen = choice.select(belongs, numbers[i], chosen)
    measures = (PieceNumber(chain, name) for name in at[0])
    return {m: DerivedMeasure(node, {}, g.zero) for m, node in zip(measures, chosen, strict=True)}


class _Choice:
    """The place of a chain's marker beside each of its pieces."""

    def __init__(self, nodes: Formulas, chain: Chain, place: tuple[int, int]) -> None:
        self.graph, (self.x, self.y) = nodes.graph, place
        self.depths = [nodes.expression(piece.depth) for piece in chain.pieces]
        self.starts = [tuple(map(nodes.expression, piece.start)) for piece in chain.pieces]
        self.along = [tuple(map(nodes.expression, piece.along)) for piece in chain.pieces]
        self.curvatures = [nodes.expression(piece.curvature) for piece in chain.pieces]

    def select(self, condition: int, yes: list[int], no: list[int]) -> list[int]:
        """Return one of two lists of numbers."""
        return [a if a == b else self.graph.call("where", condition, a, b) for a, b in zip(yes, no, strict=True)]

    def place(self, i: int) -> tuple[int, int]:
        """Return the place of the marker ahead of the start of a piece, and on its left."""
        g, (x, y), (tx, ty) = self.graph, self.starts[i], self.along[i]
        dx, dy = g.sub(self.x, x), g.sub(self.y, y)
        return g.add(g.mul(tx, dx), g.mul(ty, dy)), g.sub(g.mul(tx, dy), g.mul(ty, dx))

    def height(self, i: int) -> int:
        """Return 2 d + k d^2 of the distance d from a line or circle of curvature k."""
        g, k, (ahead, left) = self.graph, self.curvatures[i], self.place(i)
        square = g.add(g.mul(ahead, ahead), g.mul(left, left))
        return g.add(g.mul(g.constant(2.0), left), g.mul(k, square))

    def gap(self, i: int) -> int:
        """Return the distance from the line or circle of a piece."""
        g, height = self.graph, self.height(i)
        root = g.call("sqrt", g.call("max", g.zero, g.add(g.one, g.mul(self.curvatures[i], height))))
        return g.div(height, g.add(g.one, root))

    def is_between_ends(self, i: int) -> int:
        """Return the condition that the marker is between the normals at the ends of a piece."""
        g, following = self.graph, self.place((i + 1) % len(self.starts))[0]
        return g.call("and", g.call("ge", self.place(i)[0], g.zero), g.call("lt", following, g.zero))

    def is_in_front(self, i: int) -> int:
        """Return the condition that the marker is on the left of a piece, or less than the depth on its right."""
        g, depth = self.graph, self.depths[i]
        least = g.mul(depth, g.sub(g.constant(2.0), g.mul(depth, self.curvatures[i])))
        return g.call("gt", g.add(self.height(i), least), g.zero)
