"""What `symgen inspect` says of outlines: the numbers of the pieces beside which a contact's gap is."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import accumulate
from typing import TYPE_CHECKING, Any

from symgen.base.vocabulary.expressions import Reading
from symgen.base.vocabulary.measures import FormulaMeasure, OnChain
from symgen.describe.formulas.evaluate import evaluate_formula

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism

#: The one formula of all pieces.
FORMULA = "gap = z/(1 + sqrt(1 + k*z)), z = 2*b + k*(a**2 + b**2), way = before + atan2(k*a, 1 + k*b)/k, or before + a"
#: What its letters are.
_LETTERS = "k: curvature; a, b: the disc's centre from the start of its piece, along the angle there and on the left"


#: The numbers of a piece, and decimals beyond which they are rounding.
_NUMBERS, _DIGITS = ("x", "y", "angle", "curvature", "before"), 12


def outline_facts(mechanism: Mechanism, values: Mapping[str, float]) -> list[dict[str, Any]]:
    """Return the pieces of each chain of a contact, in the frame of its body.

    Returns
    -------
    list of dict
        ``row``, ``body``, and ``pieces`` of which each has ``x``, ``y`` [m] and ``angle`` [rad] at its start,
        ``curvature`` [1/m] and the way ``before`` it [m].
    """
    found = list[dict[str, Any]]()
    for row in mechanism.bounded:
        match row.measure:
            case FormulaMeasure(of=Reading(source=OnChain(chain=chain, quantity="gap"))):
                numbers = [
                    [evaluate_formula(e, values, row.where) for e in (*p.start, *p.along, p.curvature, p.length)]
                    for p in chain.pieces
                ]
                ways = accumulate((piece[5] for piece in numbers), initial=0.0)
                pieces = [
                    dict(zip(_NUMBERS, (x, y, math.atan2(ty, tx), k, before), strict=True))
                    for (x, y, tx, ty, k, _), before in zip(numbers, ways, strict=False)
                ]
                found.append({"row": row.row, "body": chain.origin.body, "pieces": pieces})
    return found


def outline_lines(facts: list[dict[str, Any]]) -> Iterator[str]:
    """Yield the lines of ``symgen inspect``."""
    yield from (FORMULA, _LETTERS)
    for each in facts:
        yield f"{each['row']}: beside {each['body']}; start [m], angle [rad], curvature [1/m], way before [m]"
        for number, p in enumerate(each["pieces"], 1):
            x, y, *others = (f"{round(p[name], _DIGITS) + 0.0:.6g}" for name in _NUMBERS)
            yield f"  {number}: [{x}, {y}], {', '.join(others)}"
