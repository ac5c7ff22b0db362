"""Forces that are many: of those that leave the same accelerations, the least sum of c^2/B over the rows at rest.

Rows at rest that others determine may have any part of a force that several share. The least sum gives rows that hold
one coordinate equal parts of their bounds, whatever their order: all hold as long as any forces do. Rows that push have
no bound, and follow.
"""

from __future__ import annotations

from symgen.compile.loopcode.exact import exact
from symgen.run.laws.newton import follow_laws
from symgen.run.laws.problem import BALL, ON, UPPER, Laws, bound_of, load_of, middle_of, rows_of
from symgen.run.laws.verify import obeys, size_of_terms
from symgen.run.layout.scales import larger_number

#: Pivots below this part of a row's own mobility are rounding; forces are shared that move by less than this part of B.
_DEPENDENT, _SHARED = 1e-9, 1e-15
#: Accelerations below this part of what they are differences of are none.
STILL = 1e-12
#: Turns in which what moves follows the shares, and rounds over determined rows in one.
_TURNS, _ROUNDS = 3, 200


@exact()
def rests(i: int, laws: Laws) -> bool:
    """Whether a row is at rest within its bounds, or pushes."""
    return bool(laws.state[i] == ON)


@exact()
def turn_of(n: int, i: int, laws: Laws) -> int:
    """Return when a row is eliminated: 0 where it pushes, 1 where it would, 2 for others, 3 where its bound is 0.

    A bound of 0, as of a brake that is not applied, takes no part of what changes: others hold as long as they can.
    """
    if laws.law[i] == BALL:
        return 2 if bound_of(n, i, laws) > 0.0 else 3
    return 0 if laws.forces[i] < 0.0 else 1


@exact()
def find_dependent(n: int, laws: Laws) -> int:
    """Eliminate the rows at rest, those that push first; return the number of those that others determine.

    Of rows that push, those with a force are before those without: where a few carry all, the others have none.
    ``depends`` is 1 for independent rows, 2 for those determined, else 0. In ``slopes`` the line of an independent row
    has what one unit of a determined force takes from it.
    """
    count = 0
    for i in range(n):
        laws.depends[i] = 2 if rests(i, laws) and laws.matrix[i * n + i] > 0.0 else 0
        for j in range(n):
            laws.slopes[i * n + j] = laws.matrix[i * n + j]
    for turn in range(4):
        while True:
            best, most = -1, _DEPENDENT
            for i in range(n):
                part = laws.slopes[i * n + i] / laws.matrix[i * n + i] if laws.depends[i] == 2 else 0.0
                if part > most * (1.0 + _DEPENDENT) and turn_of(n, i, laws) == turn:
                    best, most = i, part
            if best < 0:
                break
            laws.depends[best], pivot = 1, laws.slopes[best * n + best]
            for j in range(n):
                laws.slopes[best * n + j] /= pivot
            for i in range(n):
                part = laws.slopes[i * n + best]
                if i != best and part != 0.0 and laws.depends[i] != 0:
                    for j in range(n):
                        laws.slopes[i * n + j] -= part * laws.slopes[best * n + j]
    for i in range(n):
        count += 1 if laws.depends[i] == 2 else 0
    return count


@exact()
def weight_of(n: int, i: int, laws: Laws) -> float:
    """Return 1/B of a row at rest, 0 for rows that push or have no bound."""
    bound = bound_of(n, i, laws) if laws.law[i] == BALL else 0.0
    return 1.0 / bound if bound > 0.0 else 0.0


@exact()
def share_once(n: int, laws: Laws) -> float:
    """Move forces to the least sum for the present bounds, one determined row after the other; return the largest move.

    Moves count over bounds. Rows that have come to a bound stay there.
    """
    largest = 0.0
    for j in range(n):
        if laws.depends[j] == 2:
            own = weight_of(n, j, laws)
            along = own * (laws.forces[j] - middle_of(j, load_of(n, j, laws), laws))
            across = own
            for i in range(n):
                if laws.depends[i] == 1:
                    z, weight = laws.slopes[i * n + j], weight_of(n, i, laws)
                    along -= z * weight * (laws.forces[i] - middle_of(i, load_of(n, i, laws), laws))
                    across += z * z * weight
            if own > 0.0 and across > 0.0:
                change = -along / across
                laws.forces[j] += change
                for i in range(n):
                    if laws.depends[i] == 1:
                        laws.forces[i] -= laws.slopes[i * n + j] * change
                largest = larger_number(largest, abs(change) * own)
    return largest


@exact(entry=True)
def spread_forces(n: int, laws: Laws) -> bool:
    """Move the forces at rest that are many to the least sum; return whether there are any."""
    if find_dependent(n, laws) == 0:
        return False
    for _ in range(_ROUNDS):
        if share_once(n, laws) <= _SHARED:
            break
    return True


@exact(entry=True)
def share_forces(n: int, laws: Laws) -> bool:
    """Share out the forces at rest that are many; return whether there are any. What they leave stays what it is.

    Where the least sum is beyond a bound, or loads that depend on it change what moves, the forces stay as they are.
    """
    for i in range(n):
        laws.first[i], laws.first[n + i], laws.does[i] = laws.left[i], laws.forces[i], laws.state[i]
    for i in range(n):  # a force at its bound that accelerates nothing may be less
        at_bound = laws.state[i] >= UPPER and laws.way[i] == 0.0 and rows_of(n, i, laws) == 1
        if laws.law[i] == BALL and at_bound and abs(laws.left[i]) <= STILL * size_of_terms(n, i, laws):
            laws.state[i] = ON
    found, many = True, False
    for _ in range(_TURNS):
        if not spread_forces(n, laws):
            break
        many, found = True, follow_laws(n, False, laws)
        if not found:
            break
    if not (found and obeys(n, laws)):
        for i in range(n):
            laws.left[i], laws.forces[i], laws.state[i] = laws.first[i], laws.first[n + i], laws.does[i]
    return many
