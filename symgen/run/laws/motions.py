"""Forces that obey all laws: beginnings of Newton's method, and how many motions few rows have.

Rows with forces by reactions or contacts may have no motion, or several. Newton's method finds one; up to `COUNTED`
combinations of what rows may do are all solved for besides, and motions that differ are counted.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.exact import exact
from symgen.run.laws.newton import follow_laws
from symgen.run.laws.problem import (
    BALL,
    LOWER,
    NOTHING,
    OFF,
    ON,
    PUSH,
    SECOND,
    TINY,
    UPPER,
    Laws,
    acceleration_of,
    bound_of,
    load_of,
    middle_of,
    mobility_of,
    rows_of,
    weigh_laws,
)
from symgen.run.laws.sharing import spread_forces
from symgen.run.laws.verify import obeys, size_of_terms

#: How many motions there are; one, and others were not sought.
NO_MOTION, ONE_MOTION, SEVERAL_MOTIONS, NOT_SOUGHT = range(4)
#: Most combinations that are counted.
COUNTED = 256
#: Beginnings: the forces that are there, rest, none, and sweeps of row after row; what holds all, by many sweeps.
_GIVEN, _AT_REST, _NONE, _SWEPT = range(4)
_BEGINNINGS, _SOUGHT, _SWEEPS, _HELD, _RELAXED = 6, 5, 5, 6, 300
#: Balls of two rows take part in more sweeps than these: what is near without their forces is found before.
_LONG = 25
#: Forces above are no beginning; accelerations of two motions differ by more than this part.
_HUGE, _ONE = 1e100, 1e-7
#: Accelerations of chosen states below this part of what they are differences of are rounding.
_ROUNDING = 1e-10


@exact()
def sweep_laws(n: int, times: int, laws: Laws) -> None:
    """Let the forces of rows obey their laws one after the other."""
    for _ in range(times):
        for i in range(n):
            own = laws.matrix[i * n + i]
            wants = laws.forces[i] + (acceleration_of(n, i, laws) / own if own > 0.0 else 0.0)
            if laws.law[i] == PUSH:
                laws.forces[i] = min(wants, 0.0) if own > 0.0 else 0.0
            elif laws.law[i] == BALL and rows_of(n, i, laws) == 1:
                bound, middle = bound_of(n, i, laws), middle_of(i, load_of(n, i, laws), laws)
                if laws.way[i] != 0.0:
                    laws.forces[i] = laws.way[i] * bound
                elif own == 0.0:
                    laws.forces[i] = 0.0
                else:
                    laws.forces[i] = middle + min(max(wants - middle, -bound), bound)
            elif times > _LONG and laws.law[i] == BALL and laws.way[i] == laws.way[i + 1] == 0.0:
                own = max(mobility_of(n, i, laws), TINY)
                x = laws.forces[i] + acceleration_of(n, i, laws) / own
                y = laws.forces[i + 1] + acceleration_of(n, i + 1, laws) / own
                part = min(1.0, bound_of(n, i, laws) / max(math.sqrt(x * x + y * y), TINY))
                laws.forces[i], laws.forces[i + 1] = part * x, part * y


@exact()
def relax_laws(n: int, times: int, laws: Laws) -> None:
    """Let forces come near those that hold all rows, if any do: each contact takes the nearest force in its cone.

    They minimise a convex function, which has no other minimum than rest where rest is possible.
    """
    for _ in range(times):
        for i in range(n):
            if laws.law[i] == BALL and laws.presser[i] >= 0 and rows_of(n, i, laws) == 1:
                j, mu = laws.presser[i], laws.kappa[i]
                own = laws.matrix[i * n + i] + laws.matrix[j * n + j]
                if own > 0.0:
                    along = laws.forces[i] + acceleration_of(n, i, laws) / own
                    push = -laws.forces[j] - acceleration_of(n, j, laws) / own
                    if abs(along) > mu * push:  # outside: to the edge of the cone, or to its tip
                        push = max(push + mu * abs(along), 0.0) / (1.0 + mu * mu)
                        along = mu * push if along > 0.0 else -mu * push
                    laws.forces[i], laws.forces[j] = along, -push


@exact()
def begin(n: int, beginning: int, laws: Laws) -> None:
    """Set the forces, or the states, that Newton's method begins from."""
    for i in range(n):
        if beginning != _GIVEN or not abs(laws.forces[i]) < _HUGE:
            laws.forces[i] = 0.0
    if beginning == _AT_REST:
        for i in range(n):
            laws.state[i] = ON if laws.law[i] == PUSH or laws.way[i] == 0.0 else UPPER
        follow_laws(n, True, laws)
        spread_forces(n, laws)
    elif beginning == _HELD:
        relax_laws(n, _RELAXED, laws)
    elif beginning >= _SWEPT:
        times = beginning - _SWEPT + 1
        sweep_laws(n, _SWEEPS * times * times, laws)
    for i in range(n):
        if not abs(laws.forces[i]) < _HUGE:
            laws.forces[i] = 0.0


@exact()
def options_of(n: int, i: int, laws: Laws) -> int:
    """Return of how many things a row does one."""
    if laws.law[i] == PUSH:
        return 2
    return 3 if laws.law[i] == BALL and laws.way[i] == 0.0 and rows_of(n, i, laws) == 1 else 1


@exact()
def is_pressed(i: int, laws: Laws) -> bool:
    """Whether a row at rest has friction as long as a gap is closed, and none without."""
    return bool(laws.presser[i] >= 0 and laws.way[i] == 0.0 and laws.beta[i] == 0.0)


@exact()
def choose_states(n: int, laws: Laws) -> bool:
    """Set the states of the present combination; return whether it is one: an open gap has no friction."""
    for i in range(n):
        laws.forces[i] = 0.0
        if laws.law[i] == PUSH:
            laws.state[i] = ON if laws.option[i] == 0 else OFF
        elif laws.law[i] == NOTHING:
            laws.state[i] = OFF
        elif laws.way[i] == 0.0:
            laws.state[i] = ON if laws.option[i] == 0 else UPPER if laws.option[i] == 1 else LOWER
    for i in range(n):
        if is_pressed(i, laws) and laws.state[laws.presser[i]] == OFF and laws.state[i] != UPPER:
            return False
    return True


@exact()
def count_combinations(n: int, laws: Laws) -> float:
    """Return the number of combinations of what rows may do, inf with balls of two rows: those have directions."""
    total = 1.0
    for i in range(n):
        options = 2 if is_pressed(i, laws) else options_of(n, i, laws)  # an open gap has no friction
        total *= float(options) if not (laws.law[i] == BALL and rows_of(n, i, laws) == 2) else math.inf
    return total


@exact()
def next_combination(n: int, laws: Laws) -> bool:
    """Go on to the next combination; return whether there is one."""
    for i in range(n):
        laws.option[i] += 1
        if laws.option[i] < options_of(n, i, laws):
            return True
        laws.option[i] = 0
    return False


@exact()
def moves_alike(n: int, laws: Laws) -> bool:
    """Whether the first motion, which ``first`` has before its forces, has these accelerations.

    Differences count over what forces of all rows make, and those that are as large as what is there without forces.
    """
    most = weigh_laws(n, laws)
    for i in range(n):
        most += math.sqrt(abs(laws.matrix[i * n + i])) * (abs(laws.forces[i]) + abs(laws.first[n + i]))
    for i in range(n):
        size = abs(laws.offset[i]) + math.sqrt(abs(laws.matrix[i * n + i])) * most
        if abs(laws.left[i] - laws.first[i]) > _ONE * size:
            return False
    return True


@exact()
def moves_as_chosen(n: int, laws: Laws) -> bool:
    """Whether accelerations have the signs of the chosen states: what little they may miss is rounding."""
    for i in range(n):
        side = -1.0 if laws.state[i] == LOWER else 1.0
        opens = laws.law[i] == PUSH and laws.state[i] == OFF
        moves = laws.law[i] == BALL and laws.state[i] >= UPPER and laws.way[i] == 0.0 and bound_of(n, i, laws) > 0.0
        if (
            (opens or moves)
            and laws.matrix[i * n + i] > 0.0
            and side * laws.left[i] < -_ROUNDING * size_of_terms(n, i, laws)
        ):
            return False
    return True


@exact()
def is_first(n: int, laws: Laws) -> bool:
    """Whether the first motion has the chosen states."""
    for i in range(n):
        if laws.state[i] != laws.does[i]:
            return False
    return True


@exact()
def try_combinations(n: int, differs: bool, laws: Laws) -> bool:
    """Whether a combination has a motion, or one that `differs` from that kept."""
    found, more = False, True
    while more and not found:
        found = choose_states(n, laws) and not (differs and is_first(n, laws)) and follow_laws(n, True, laws)
        if found and not obeys(n, laws):  # where forces are many others may
            found = laws.column[n - 1] < 0 and spread_forces(n, laws) and obeys(n, laws)
        found = found and moves_as_chosen(n, laws) and not (differs and moves_alike(n, laws))
        more = next_combination(n, laws)
    return found


@exact(entry=True)
def find_forces(n: int, laws: Laws, first: int) -> bool:
    """Find forces that obey all laws; return whether any are found.

    `first` is 0 where those that are there may be near, else 1. Combinations follow where they are few.
    """
    for beginning in range(first, _BEGINNINGS):
        begin(n, beginning, laws)
        if follow_laws(n, False, laws) and obeys(n, laws):
            return True
    for i in range(n):
        laws.option[i] = 0
    return bool(count_combinations(n, laws) <= COUNTED and try_combinations(n, False, laws))


@exact()
def keep_first(n: int, laws: Laws) -> None:
    """Keep the motion found while others are sought."""
    for i in range(n):
        laws.option[i], laws.does[i] = 0, laws.state[i]
        laws.first[i], laws.first[n + i] = laws.left[i], laws.forces[i]


@exact()
def recall_first(n: int, laws: Laws) -> None:
    """Set the motion found anew; the states of the one sought last go to ``other``."""
    for i in range(n):
        laws.other[i] = laws.state[i]
        laws.state[i], laws.left[i], laws.forces[i] = laws.does[i], laws.first[i], laws.first[n + i]


@exact(entry=True)
def seek_another(n: int, laws: Laws) -> bool:
    """Whether another beginning leads to another motion than the present forces; its states go to ``other``."""
    another, rests = False, True
    keep_first(n, laws)
    for i in range(n):
        rests = rests and laws.does[i] == ON
    for number in range(_NONE, _SOUGHT if rests else _SOUGHT + 1):
        if not another:
            begin(n, number if number < _SOUGHT else _HELD, laws)
            another = follow_laws(n, False, laws) and obeys(n, laws) and not moves_alike(n, laws)
    recall_first(n, laws)
    return another


@exact(entry=True)
def find_another(n: int, laws: Laws) -> bool:
    """Whether any combination has another motion than the present forces; its states go to ``other``."""
    keep_first(n, laws)
    another = try_combinations(n, True, laws)
    recall_first(n, laws)
    return another


@exact()
def is_one_in_space(laws: Laws) -> bool:
    """Whether three rows are one contact in space whose acceleration its friction cannot turn about.

    Friction within a circle of radius kappa N changes by at most ``kappa sqrt(L/l) + |G_NT|/l`` over N, where l and L
    are the mobilities along it: the acceleration of the gap grows with N if its own mobility is more than that friction
    takes from it.
    """
    gap = 0 if laws.law[0] == PUSH else 2
    a, b = (1, 2) if gap == 0 else (0, 1)
    if laws.law[gap] != PUSH or laws.law[b] != SECOND or laws.presser[a] != gap:
        return False
    one, both, other = laws.matrix[4 * a], laws.matrix[3 * a + b], laws.matrix[4 * b]
    half = math.sqrt(0.25 * (one - other) * (one - other) + both * both)
    least, most = 0.5 * (one + other) - half, 0.5 * (one + other) + half
    if not least > _ONE * most:
        return False
    across = math.sqrt(laws.matrix[3 * gap + a] ** 2 + laws.matrix[3 * gap + b] ** 2)
    taken = across * (laws.kappa[a] * math.sqrt(most / least) + across / least)
    return bool(laws.matrix[4 * gap] > (1.0 + _ONE) * taken)


@exact()
def is_one_contact(n: int, laws: Laws) -> bool:
    """Whether the rows are one contact whose acceleration its friction cannot turn about: then its motion is one."""
    if n == 3:
        return is_one_in_space(laws)
    if n != 2:
        return False
    gap = 0 if laws.law[0] == PUSH else 1
    own, across, rub = laws.matrix[3 * gap], laws.matrix[1], 1 - gap
    regular = own * laws.matrix[3 * rub] > (1.0 + _ONE) * across * across
    return bool(laws.presser[rub] == gap and regular and own > (1.0 + _ONE) * laws.kappa[rub] * abs(across))


@exact()
def count_motions(n: int, laws: Laws) -> int:
    """Return how many motions there are beside the one found: `ONE_MOTION`, `SEVERAL_MOTIONS` or `NOT_SOUGHT`.

    Without loads forces minimise a convex function, and the motion is one. So it is of one contact whose mobility has
    the same sign in all that its friction may do.
    """
    depends = False
    for i in range(n):
        depends = depends or laws.presser[i] >= 0 or laws.components[i] > 0
    if not depends or is_one_contact(n, laws):
        return ONE_MOTION
    if count_combinations(n, laws) > COUNTED:
        return NOT_SOUGHT
    return SEVERAL_MOTIONS if find_another(n, laws) else ONE_MOTION
