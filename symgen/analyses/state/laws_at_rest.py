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
from symgen.run.laws.problem import BALL, COMPONENTS, PUSH, begin_row, new_laws
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
    """

    row: str
    bound: float = 0.0
    middle: float = 0.0
    pressed: tuple[str, ...] = ()
    across: tuple[tuple[float, ...], ...] = ()
    pushes: bool = False


def forces_at_rest(subject: Subject, holding: Sequence[Holding]) -> Array | None:
    """Return the forces of rows with bounds that hold a state at rest; None where the laws let something move.

    Parameters
    ----------
    subject : Subject
        The mechanism with all of them in force, at a start without velocities.
    holding : sequence of Holding
        The rows.

    Returns
    -------
    Array or None, shape (rows,)
        Multipliers; of forces that are many the least sum of squares over bounds.
    """
    e, names = subject.evaluate(subject.y), [row.name for row in subject.compiled.info.rows]
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
        laws.law[i] = PUSH if each.pushes else BALL
        laws.middle[i] = each.middle
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
    sizes = [plain_form(size_of_terms)(k, i, laws) for i in range(k)]
    left = laws.offset - laws.matrix.reshape(k, k) @ laws.forces
    return None if np.any(np.abs(left) > _STILL * np.array(sizes)) else np.array(laws.forces)
