"""Impulses of friction by reactions, compiled: bounds over the impulses that joints have at an impact.

Where an impact leaves no rate of a coordinate, friction has the impulse that keeps it at rest; else its impulse is at
its bound, against the rate after the impact. Which of both is chosen with the modes of the impact
(`symgen.run.modes.contact_laws`). In these modes the impulses follow here from those that hold rates, and act on the
velocities from which the impact begins.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symgen.compile.loopcode.exact import exact
from symgen.compile.loopcode.loop_instances import Meanings, exact_instance
from symgen.compile.native.annotations import Array, Integers
from symgen.run.effects.applying import APPLIED
from symgen.run.effects.pushing import POISSON, REACTIONS, push_contacts
from symgen.run.laws.newton import follow_laws
from symgen.run.laws.problem import BALL, COMPONENTS, LOWER, OFF, ON, UPPER, acceleration_of, begin_row, load_of
from symgen.run.layout.start_records import Instant
from symgen.run.modes.probing import by_reaction, probe
from symgen.run.modes.row_records import Choice
from symgen.run.modes.strikes import Strikes

#: Where bounds depend on reactions beside one-sided rows.
BY_REACTIONS = Meanings("runs with one-sided rows beside bounds that depend on reactions", REACTIONS=True)
push_with_kicks = exact_instance(push_contacts, BY_REACTIONS)


@exact()
def kick_of(c: Choice, s: Strikes, i: int) -> float:
    """Return the impulse of a gap that follows from its compression, 0 for other rows."""
    return float(s.memory.kicked[i]) if c.rows.pushes[i] != 0 else 0.0


@exact()
def list_rows(c: Choice, s: Strikes) -> int:
    """List the rows of the impact in ``order``, each gap before its friction, with rates asked for and their modes.

    Friction by reactions comes last; returns the number of all.
    """
    _, _, _, _, changes = s.effects.model
    owners, ties, order, laws, n = changes.owners, s.ties, c.order, c.laws, 0
    for j in range(owners.shape[0]):
        for i in range(c.rows.dry, c.rows.count):
            if owners[j] == s.events[i] and s.active[i] != 0:
                gap = j == 0 or owners[j - 1] != owners[j]
                order[n] = i if gap else c.rows.partner[i]
                laws.kept[n], laws.state[n] = ties.values[j], ON if ties.held[j] > 0 else OFF
                if ties.held[j] < 0:
                    laws.kept[n], laws.state[n] = 0.0, UPPER if ties.ways[j] < 0.0 else LOWER
                elif POISSON and not gap and ties.held[j] == 0:  # it slides by the impulse of compression alone
                    laws.state[n] = c.mode[order[n]]
                n += 1
    for i in range(c.rows.dry):
        if by_reaction(c, i):
            order[n], laws.kept[n], laws.state[n] = i, 0.0, s.memory.pins[i]
            n += 1
    return n


@exact()
def fill_impact(c: Choice, s: Strikes, n: int, rests: bool) -> None:
    """Write the problem of the impulses of the rows listed.

    Where a series of impacts comes to rest, gaps have what is left of their impulses less what rest has in their place:
    they pull, and friction by reactions has the other sign.
    """
    k, order, laws = c.rows.count, c.order, c.laws
    for a in range(n):
        i = order[a]
        begin_row(n, a, laws)
        laws.offset[a], laws.forces[a] = c.read.speed[i] - laws.kept[a], 0.0
        for b in range(n):
            laws.matrix[a * n + b] = c.problem.matrix[i * k + order[b]]
            if POISSON:
                laws.offset[a] += c.problem.matrix[i * k + order[b]] * kick_of(c, s, order[b])
        if c.rows.pushes[i] == 0:
            laws.law[a], laws.kappa[a] = BALL, c.read.sliding[i]
            if by_reaction(c, i):
                laws.components[a], laws.beta[a] = 2, s.memory.kicked[i]
                laws.kappa[a] = -c.read.sliding[i] if rests else c.read.sliding[i]
                for part in range(2):
                    for b in range(n):
                        by_unit = c.problem.parts[(2 * i + part) * k + order[b]]
                        laws.parts[(COMPONENTS * a + part) * n + b] = by_unit
                        if POISSON:
                            laws.apart[COMPONENTS * a + part] += by_unit * kick_of(c, s, order[b])
            else:
                laws.presser[a] = a - 1
                laws.beta[a] = c.read.sliding[i] * s.memory.kicked[order[a - 1]] if POISSON else 0.0


@exact()
def solve_motion(c: Choice, s: Strikes, flies: bool) -> int:
    """Find the forces of motion of the rows of the impact, in its modes or where its gaps fly; return their number.

    0 where there are none.
    """
    laws, n = c.laws, list_rows(c, s)
    fill_impact(c, s, n, False)
    for a in range(n):
        i = c.order[a]
        laws.offset[a], laws.beta[a] = c.problem.offset[i], 0.0
        laws.state[a] = OFF if flies and not by_reaction(c, i) else laws.state[a]
        for part in range(laws.components[a]):
            laws.apart[COMPONENTS * a + part] = c.problem.apart[2 * i + part]
    return n if follow_laws(n, True, laws) else 0


@exact()
def find_shortfall(c: Choice, s: Strikes, left: float) -> None:
    """Set what rest lacks of the impulses of friction in the time that is left of a series of impacts of one gap.

    Flights and impacts have reactions N and R in turn, rest has their sum: friction is over ``|N| + |R|``, not over
    ``|N + R|``. A unit of the gap's impulse says how large R is for the force that rest has.
    """
    laws, gap, gaps, pushed = c.laws, -1, 0, 0.0
    for i in range(c.rows.count):
        s.memory.kicked[i] = c.sizes[i] = 0.0
    n = solve_motion(c, s, True)
    for a in range(n):
        if by_reaction(c, c.order[a]):
            c.sizes[c.order[a]] = load_of(n, a, laws)
    n = solve_motion(c, s, False)
    for a in range(n):
        if by_reaction(c, c.order[a]):
            c.sizes[c.order[a]] -= load_of(n, a, laws)
        elif c.rows.pushes[c.order[a]] != 0:
            gap, gaps, pushed = a, gaps + 1, -laws.forces[a]
    if gaps != 1 or not (pushed > 0.0 and left > 0.0):
        return
    n = list_rows(c, s)
    fill_impact(c, s, n, False)
    for a in range(n):
        laws.beta[a], laws.offset[a] = 0.0, -1.0 if a == gap else 0.0
    if follow_laws(n, True, laws) and laws.forces[gap] < 0.0:
        for a in range(n):
            i = c.order[a]
            if by_reaction(c, i) and s.memory.pins[i] >= UPPER:
                lacks = c.sizes[i] - pushed * load_of(n, a, laws) / laws.forces[gap]
                s.memory.kicked[i] = c.read.sliding[i] * left * lacks


@exact()
def find_kicks(c: Choice, s: Strikes, rests: bool, y: Array) -> bool:
    """Set the impulses of friction by reactions, and what they take; return whether there are any in these modes."""
    laws, n, kicked = c.laws, list_rows(c, s), s.memory.kicked
    fill_impact(c, s, n, rests)
    for row in range(s.ties.kicks.shape[0]):
        s.ties.kicks[row] = 0.0
    if not follow_laws(n, True, laws):
        return False
    for a in range(n):
        i, kick = c.order[a], 0.0
        if by_reaction(c, i):
            rate, kick = c.read.speed[i] + acceleration_of(n, a, laws), -laws.forces[a]
            s.memory.spent[0] += 0.5 * kick * rate
            s.memory.spent[1] += 0.5 * abs(kick) * abs(rate)
            if s.losses[i] >= 0:
                y[s.losses[i]] -= 0.5 * kick * rate
        elif POISSON and c.rows.pushes[i] != 0:
            kick = kicked[i]
        elif POISSON and laws.state[a] >= UPPER:
            kick = (-1.0 if laws.state[a] == UPPER else 1.0) * laws.beta[a]
            kicked[i] = kick
        for row in range(c.rows.layout.m):
            if c.rows.place_of[row] == i:
                s.ties.kicks[row] = kick
    return True


@exact()
def push(t: float, c: Choice, s: Strikes, now: Instant, rests: bool) -> bool:
    """Change velocities by the impulses of ``ties`` and of friction by reactions; return whether joints allow it.

    `rests`: a series of impacts comes to rest.
    """
    if REACTIONS and not find_kicks(c, s, rests, now.y):
        return False
    return bool(push_contacts(s.effects.model, t, now, s.chosen, s.effects.work, s.ties) == APPLIED)


@exact()
def probe_impact(t: float, c: Choice, s: Strikes, y: Array, p: Array, w: Array, iw: Integers) -> int:
    """Set G of all rows that an impact may have impulses along, at the present state with all rows off."""
    n = 0
    for i in range(c.rows.count):
        c.taken[i], c.signs[i] = 0, 0.0
        if c.rows.pushes[i] != 0 or c.rows.partner[i] >= 0 or by_reaction(c, i):
            c.rest[n] = i
            n += 1
    c.at_rest[0] = n
    return int(probe(t, c, y, p, w, iw, s.memory.control))


def kicks_along_rows(c: Choice, impulses: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the impulses of friction by reactions at an impact, along all rows of the model."""
    places = np.asarray(c.rows.place_of)
    pressed = (places >= 0) & (np.asarray(c.rows.pressed)[places] != 0)
    return np.where(pressed, impulses[: len(places)], 0.0)
