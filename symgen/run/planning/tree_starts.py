"""Starts in joint coordinates: where a run of bodies begins, and where another run ended."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.run.compiling.carrying import carried_motion
from symgen.run.compiling.choices import mechanism_on_tree
from symgen.run.layout.start_records import Instant
from symgen.run.planning.continuation import choice_after, take_up_state
from symgen.run.planning.starts import compiled_for
from symgen.run.planning.tree import BODIES, TreeRun
from symgen.run.starts.assembler import ALONE, Assembly, as_one_row
from symgen.run.starts.assembly import Start
from symgen.run.starts.start_words import turned_over_error
from symgen.run.starts.tree_start import TURNED_OVER, Carried

if TYPE_CHECKING:
    from symgen.describe.mechanism import Event, Mechanism
    from symgen.run.compiling.method_choice import MethodChoice
    from symgen.run.effects.effects import Effects
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.planning.plan import Plan
    from symgen.run.single.last_state import LastState

Array = NDArray[np.float64]


def run_on_tree(plan: Plan, bodies: CompiledModel, start: Start) -> TreeRun:
    """Return the run in joint coordinates that begins where a run in coordinates of bodies begins.

    Parameters
    ----------
    plan : Plan
        The run.
    bodies, start : CompiledModel, Start
        In the bodies' own coordinates.

    Raises
    ------
    AssemblyError
        If a body of the tree would start turned over.
    """
    mechanism, compiled = tree_code(plan.mechanism, plan.choice, bodies)
    carried = map_to_tree(plan.mechanism, mechanism, bodies, compiled, start.t)
    return turn_bodies_upright(
        begin_on_tree(plan.mechanism, mechanism, carried, start, plan.method_parameters, plan.events)
    )


def turn_bodies_upright(run: TreeRun) -> TreeRun:
    """Return a run in which no body of the tree starts turned over.

    Raises
    ------
    AssemblyError
        If one would.
    """
    if run.over >= 0:
        raise turned_over_error(run.bodies.info, run.over)
    return run


def tree_code(mechanism: Mechanism, choice: MethodChoice, bodies: CompiledModel) -> tuple[Mechanism, CompiledModel]:
    """Return a mechanism with its tree, and its compiled model for the method that bodies are run with.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    choice : MethodChoice
        The method.
    bodies : CompiledModel
        In the bodies' own coordinates; its solver is the tree's.
    """
    carried = mechanism_on_tree(mechanism)
    weight = {name: value for name, value in choice.options.items() if name == "weight"}
    return carried, compiled_for(carried, replace(choice, options={**bodies.law.options, **weight}, shape="straight"))


def map_to_tree(
    whole: Mechanism, mechanism: Mechanism, bodies: CompiledModel, compiled: CompiledModel, t: float = 0.0
) -> Carried:
    """Return the map from starts of bodies at a time to starts of a tree.

    Parameters
    ----------
    whole, mechanism : Mechanism
        As described, and with its tree.
    bodies, compiled : CompiledModel
        In the bodies' own coordinates, and in joint coordinates.
    t : float
        Time [s].
    """
    return Carried(bodies, Assembly(compiled, t=t), carried_motion(whole, mechanism, bodies, compiled))


def begin_on_tree(
    whole: Mechanism,
    mechanism: Mechanism,
    carried: Carried,
    start: Start,
    method_parameters: Mapping[str, float],
    events: tuple[Event, ...] = (),
    effects: Callable[[], Effects | None] | None = None,
) -> TreeRun:
    """Return a run in joint coordinates from a start of bodies.

    Parameters
    ----------
    whole, mechanism : Mechanism
        As described, and with its tree.
    carried : Carried
        From `map_to_tree`.
    start : Start
        In the bodies' own coordinates.
    method_parameters : mapping
        Values of the method's parameters that differ from the defaults.
    events : tuple of Event
        That are looked for.
    effects : callable, optional
        As in `TreeRun`, where many runs share it.
    """
    bodies, compiled = carried.bodies, carried.assembly.compiled
    names = (x.name for x in bodies.info.parameters)
    p = compiled.parameter_array(dict(zip(names, start.p, strict=False)), method_parameters)
    y, w = np.zeros(compiled.info.ny), compiled.scratch()
    over = settle_on_tree(carried, Instant(start.y, start.p, start.w), Instant(y, p, w))
    notes = start.notes, start.changes, start.light, start.warnings
    own = Start(y, p, w, compiled.rank(w), compiled.redundant(w), *notes, t=start.t, work=start.work)
    return TreeRun(whole, mechanism, compiled, own, bodies, start, events, effects, over)


def settle_on_tree(carried: Carried, of_bodies: Instant, now: Instant) -> int:
    """Map a start of bodies to a tree, in place; return the body in space that would start turned over, -1 for none.

    Parameters
    ----------
    carried : Carried
        From `map_to_tree`.
    of_bodies, now : Instant
        The start of bodies, and the tree's, whose parameters are not yet prepared.
    """
    alike = carried.settle(as_one_row(*of_bodies), as_one_row(*now), *ALONE)[0]
    now.y[carried.assembly.compiled.info.work :] = of_bodies.y[carried.bodies.info.work :]
    return first_turned_over(alike)


def first_turned_over(alike: Array) -> int:
    """Return the first body in space that would start turned over, -1 for none, from products of Euler parameters."""
    if not len(alike):
        return -1
    over = np.flatnonzero(np.abs(alike) < TURNED_OVER)
    return int(over[0]) if len(over) else -1


def tree_taken_up(plan: Plan, last: LastState) -> TreeRun | None:
    """Return a run that takes up what another one in the same coordinates kept, None where there is none."""
    if last.arrays is None or not {*BODIES} <= {*last.arrays}:
        return None
    bodies = compiled_for(plan.mechanism, choice_after(plan, last))
    carried, compiled = tree_code(plan.mechanism, plan.choice, bodies)
    start = take_up_state(compiled, plan, last)
    if start is None or last.arrays["body_w"].shape != bodies.scratch().shape:
        return None
    y, p, w, rank = (last.arrays[name].copy() for name in BODIES)
    of_bodies = Start(y, p, w, last.rank, bodies.redundant(w), start.notes, t=last.t, work=last.work_before)
    start = replace(start, rank=int(rank[0]))
    return TreeRun(plan.mechanism, carried, compiled, start, bodies, of_bodies, plan.events)
