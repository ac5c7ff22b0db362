"""Formulas of a marker beside a chain: one for all pieces, of the numbers of the piece that it belongs to.

With u from the start of a piece to the marker, the direction t and the curvature k, ``a = t . u``, ``b = n . u`` on
the left, ``z = 2 b + k (a^2 + b^2)`` and ``w = sqrt(1 + k z)``, the gap is ``z / (1 + w)``, which is b of a segment,
and the way along the piece ``atan2(k a, 1 + k b) / k``.

Where another row has the contact, the gap grows by ``((s - p) (q - s))^2 / (q - p)^3`` of the way s on the chain
between the ends p and q of that stretch, smoothly from 0.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, Number, Reading, call, product
from symgen.base.vocabulary.measures import Chain, ChainPiece, Component, PieceNumber, axes

#: Curvature of a segment in the formula of the way, which divides by it [1/m].
_FLAT = Number(1e-12)
#: Numbers of a piece -> what they are, of its place among the pieces and of the piece.
NUMBERS: Mapping[str, Callable[[int, ChainPiece], Expr]] = {
    "x": lambda i, piece: piece.start[0],
    "y": lambda i, piece: piece.start[1],
    "tx": lambda i, piece: piece.along[0],
    "ty": lambda i, piece: piece.along[1],
    "curvature": lambda i, piece: piece.curvature,
    "turn": lambda i, piece: _FLAT if piece.curvature == ZERO else piece.curvature,
    "before": lambda i, piece: piece.before,
    "cosine": lambda i, piece: call("cos", product(piece.curvature, piece.length)),
    "reach": lambda i, piece: (
        piece.length
        if piece.curvature == ZERO
        else call("div", call("sin", product(piece.curvature, piece.length)), piece.curvature)
    ),
    "side": lambda i, piece: Number(1.0 - 2.0 * (i % 2)),
    "number": lambda i, piece: Number(float(i + 1)),
}
#: What the gap grows by is a product of the squares of the ways from these ends of a stretch, and of this factor.
_LEAVING = ("first", "last", "growth")


def numbers_at(chain: Chain, i: int) -> dict[str, Expr]:
    """Return the numbers of a piece of a chain, counted from 0."""
    found = {name: of(i, chain.pieces[i]) for name, of in NUMBERS.items()}
    if chain.leaving:
        first, last = chain.leaving[i]
        length = call("sub", last, first)
        growth = ZERO if first == last else call("div", ONE, call("pow", length, Number(3.0)))
        found |= dict(zip(_LEAVING, (first, last, growth), strict=True))
    return found


def number_of_piece(chain: Chain, name: str = "number") -> Reading:
    """Return a number of the piece that the marker of a chain belongs to; by default its place, counted from 1."""
    return Reading(f"piece.{name}", PieceNumber(chain, name))


def _place(chain: Chain) -> tuple[Expr, Expr]:
    """Return the place of the marker ahead of the start of its piece, and on its left."""
    dx, dy = (
        call("sub", Reading(f"centre.{name}", Component(chain.origin, chain.centre, e)), number_of_piece(chain, name))
        for name, e in zip("xy", axes(chain.origin.body, 2), strict=True)
    )
    tx, ty = (number_of_piece(chain, name) for name in ("tx", "ty"))
    return call("add", call("mul", tx, dx), call("mul", ty, dy)), call("sub", call("mul", tx, dy), call("mul", ty, dx))


def gap_of_chain(chain: Chain) -> Expr:
    """Return the distance of the marker from the chain [m]."""
    (ahead, left), k = _place(chain), number_of_piece(chain, "curvature")
    square = call("add", call("mul", ahead, ahead), call("mul", left, left))
    height = call("add", call("mul", Number(2.0), left), call("mul", k, square))
    gap = call("div", height, call("add", ONE, call("sqrt", call("add", ONE, call("mul", k, height)))))
    if not chain.leaving:
        return gap
    first, last, growth = (number_of_piece(chain, name) for name in _LEAVING)
    way = way_on_chain(chain)
    between = call("mul", call("sub", way, first), call("sub", last, way))
    return call("add", gap, call("mul", growth, call("mul", between, between)))


def way_in_piece(chain: Chain) -> Expr:
    """Return the way along the piece from its start to the marker [m]."""
    (ahead, left), k = _place(chain), number_of_piece(chain, "turn")
    return call("div", call("atan2", call("mul", k, ahead), call("add", ONE, call("mul", k, left))), k)


def way_on_chain(chain: Chain) -> Expr:
    """Return the way along the chain from its first piece to the marker [m]."""
    return call("add", number_of_piece(chain, "before"), way_in_piece(chain))


def zero_at_junctions(chain: Chain) -> Expr:
    """Return what changes its sign where the marker passes from a piece to the next one, and is smooth there.

    It is the distance from the nearer of the normals at the ends of the piece, of every second piece with the other
    sign. That at the end is ``(1 + k b) sin(k l) / k - a cos(k l)``, of the length l.
    """
    (ahead, left), k = _place(chain), number_of_piece(chain, "curvature")
    over = call("mul", number_of_piece(chain, "reach"), call("add", ONE, call("mul", k, left)))
    before_end = call("sub", over, call("mul", ahead, number_of_piece(chain, "cosine")))
    return call("mul", number_of_piece(chain, "side"), call("min", ahead, before_end))


#: Quantities of `OnChain` -> their formulas.
QUANTITIES: Mapping[str, Callable[[Chain], Expr]] = {
    "gap": gap_of_chain,
    "way": way_on_chain,
    "junction": zero_at_junctions,
}
