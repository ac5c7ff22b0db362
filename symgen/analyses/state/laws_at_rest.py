"""Forces of rows with bounds that hold a state at rest, by the solver of the laws that runs obey.

All rows are in force in the mechanism that is looked at: those of joints hold by any force, those with bounds within
theirs. Loads of bounds are forces of gaps and reactions of joints, which depend on all of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.compile.loopcode.exact import plain_form
from symgen.run.laws.motions import find_forces
from symgen.run.laws.problem import BALL, COMPONENTS, PUSH, SECOND, begin_row, new_laws
from symgen.run.laws.sharing import share_forces
from symgen.run.laws.verify import size_of_terms

if TYPE_CHECKING:
    from symgen.analyses.state.subject import Subject

Array = NDArray[np.float64]

#: An acceleration below this part of what it is a difference of is none.
_STILL = 1e-8


class Holding(msgspec.Struct, frozen=True):
    """A row with bounds among the rows of a mechanism.

    Parameters
    ----------
    row : str
        Its name there.
    bound, middle : float
        Largest force to both sides of the middle [N or N m], or these over the load; not of a row that pushes.
    pressed : tuple of str
        Rows whose forces are the load; none where the bound is constant.
    across : tuple of tuple of float
        Cosines of the axes of `pressed` with directions across the joint; none where its forces are the components.
    pushes : bool
        Whether its force only pushes.
    second : bool
        Whether it is the second one of two rows along a contact.
    """

    row: str
    bound: float = 0.0
    middle: float = 0.0
    pressed: tuple[str, ...] = ()
    across: tuple[tuple[float, ...], ...] = ()
    pushes: bool = False
    second: bool = False


class Begun(msgspec.Struct, frozen=True):
    """What the laws have rows with bounds do at a state without velocities.

    Parameters
    ----------
    forces : Array, shape (rows,)
        Multipliers; of forces that are many the least sum of squares over bounds.
    moving : tuple of str
        Rows that begin to move; none at rest.
    """

    forces: Array
    moving: tuple[str, ...]


def contacts_holding(subject: Subject) -> tuple[Holding, ...]:
    """Return the one-sided rows in force and the rows along them."""
    pushing = (Holding(row.row, pushes=True) for row in subject.shut)
    along = (
        Holding(each.row.row, each.coefficient, pressed=each.row.pressed, second=each.row.second)
        for each in subject.stuck
    )
    return (*pushing, *along)


def multipliers_with(subject: Subject, y: Array, holding: Sequence[Holding], forces: Array) -> Array:
    """Return the multipliers of all rows where some rows have known forces: the smallest of the others.

    Parameters
    ----------
    subject, y, holding
        As for `forces_at_rest`.
    forces : Array, shape (rows,)
        Multipliers of the rows in `holding`.
    """
    e, names = subject.evaluate(y), [row.name for row in subject.compiled.info.rows]
    own = [names.index(each.row) for each in holding]
    joints = [i for i in range(len(names)) if i not in own]
    d, lam = subject.rows(e), np.zeros(len(names))
    lam[own] = forces
    inverse = subject.split_freedom(d[joints], np.asarray(subject.loads)[joints])[1]
    lam[joints] = -inverse.T @ (e.value("balance") + d[own].T @ forces)
    return lam


def forces_at_rest(subject: Subject, y: Array, holding: Sequence[Holding]) -> Begun | None:
    """Return the forces of rows with bounds at a state without velocities; None where the solver finds none.

    Parameters
    ----------
    subject : Subject
        The mechanism with all of them in force.
    y : Array
        The state, without velocities.
    holding : sequence of Holding
        The rows.

    Returns
    -------
    Begun or None
        The forces, and the rows that begin to move.
    """
    e, names = subject.evaluate(y), [row.name for row in subject.compiled.info.rows]
    own = [names.index(each.row) for each in holding]
    joints = [i for i in range(len(names)) if i not in own]
    d, gained, mass, balance = subject.rows(e), e.value("accelerations"), e.by("balance", "a"), e.value("balance")
    basis, inverse = subject.split_freedom(d[joints], np.asarray(subject.loads)[joints])
    heavy = basis.T @ mass @ basis
    if np.linalg.matrix_rank(heavy) < len(heavy):
        return None  # what has no mass follows the rest, by no law of these
    mobile = basis @ np.linalg.solve(heavy, basis.T)
    free = -inverse @ gained[joints]
    free = free - mobile @ (balance + mass @ free)
    rows, k, laws = d[own], len(own), new_laws(len(own))
    reactions = -inverse.T @ (balance + mass @ free)
    by_forces = inverse.T @ (rows.T - mass @ mobile @ rows.T)
    laws.matrix[:], laws.offset[:] = (rows @ mobile @ rows.T).ravel(), rows @ free + gained[own]
    for i, each in enumerate(holding):
        plain_form(begin_row)(k, i, laws)
        laws.law[i] = PUSH if each.pushes else SECOND if each.second else BALL
        laws.middle[i] = each.middle
        if each.second:
            continue
        pressing = [names.index(name) for name in each.pressed]
        if not pressing:
            laws.beta[i] = each.bound
        elif pressing[0] in own:
            laws.kappa[i], laws.presser[i] = each.bound, own.index(pressing[0])
        else:
            at = [joints.index(place) for place in pressing]
            turned = np.array(each.across) if each.across else np.eye(len(at))
            laws.kappa[i], laws.components[i] = each.bound, len(turned)
            for part, line in enumerate(turned):
                place = COMPONENTS * i + part
                laws.apart[place] = line @ reactions[at]
                laws.parts[place * k : (place + 1) * k] = line @ by_forces[at]
    if not plain_form(find_forces)(k, laws, 1):
        return None
    plain_form(share_forces)(k, laws)
    sizes = np.array([plain_form(size_of_terms)(k, i, laws) for i in range(k)])
    moving = np.abs(laws.offset - laws.matrix.reshape(k, k) @ laws.forces) > _STILL * sizes
    return Begun(np.array(laws.forces), tuple(each.row for each, m in zip(holding, moving, strict=True) if m))
