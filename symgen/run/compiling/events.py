"""Events of a run, and the comparisons of its formulas over the state, as functions for loops."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from symgen.base.ir.interpolation import Interpolation
from symgen.base.vocabulary.expressions import ZERO, Expr, moving_quantities
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.bounded_modes import measure_derivative, mode_events, one_sided_rows, two_sided_rows
from symgen.describe.bounds.by_reaction import reaction_components, rows_bounded_by_reactions
from symgen.describe.bounds.losses import places_of_losses
from symgen.describe.facts.gap_corners import corner_events, rows_that_turn
from symgen.describe.facts.kinks import KINKS, Discontinuity, changes_in_time, discontinuities_of, rows_with_kinks
from symgen.describe.formulas.formula_text import to_text
from symgen.describe.formulas.results_read import reads_results
from symgen.describe.mechanism import Event, Mechanism, ModeEvent
from symgen.describe.parts.holding_joints import CATCHES, DISSIPATED, RELEASES
from symgen.run.compiling.mass_formulas import entries_of_masses, formulas_of_masses
from symgen.run.compiling.side import compile_side
from symgen.run.effects.effects import Effect, Effects
from symgen.run.layout.compiled import CompiledModel
from symgen.run.loops.run_spec import BoundedNames, BoundedRows, Switch, Watched
from symgen.run.single.row_jumps import RowJumps

Array = NDArray[np.float64]

#: The method that corrects velocities after each step, up to its error.
CORRECTING = "direct-correction"
#: Sign of the change of a switching function at its event, 0 for both.
DIRECTIONS = {"rising": 1, "falling": -1, "any": 0}


def compile_events(
    mechanism: Mechanism,
    compiled: CompiledModel,
    events: Sequence[Event],
    rtol: float | None = None,
    directed: bool = False,
) -> Watched | None:
    """Return the switching functions of a run, or None.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    compiled : CompiledModel
        Model and method.
    events : sequence of Event
        Events of the run.
    rtol : float, optional
        Tolerance of adaptive steps, which end where formulas jump or have kinks over the state; constant steps do not.
        In either, rows that change are examined there.
    directed : bool
        Whether the run has derivatives.
    """
    passed = tuple(x for x in discontinuities_of(mechanism) if rtol is not None or x.holds)
    first = len(events) + len(mode_events(mechanism))
    events = (*events, *mode_events(mechanism), *corner_events(mechanism, directed))
    corners = tuple(range(first, len(events)))
    if not (events or passed):
        return None
    functions = [(f"{event.name}: {event.text}", event.when) for event in events]
    functions += [(to_text(x.argument), x.argument) for x in passed]
    side = compile_side(mechanism, compiled, "events", "Switching functions", functions, 1, bool(passed or corners))
    return Watched(
        names=tuple(event.name for event in events),
        directions=tuple(DIRECTIONS[event.direction] for event in events),
        actions=tuple(event.action for event in events),
        words=tuple(event.word if isinstance(event, ModeEvent) else "" for event in events),
        owners=tuple(event.row if isinstance(event, ModeEvent) else -1 for event in events),
        function=side.function,
        needs_rates=(
            "ydot" in side.reads
            or bool(mechanism.bounded)  # which leave multipliers in w
            or "multipliers" in side.reads
        ),
        of_forces=tuple(i for i in range(len(functions)) if i in side.of_forces),
        effects=effects_of_events(mechanism, compiled, events),
        switches=tuple(switch_of_event(x, 1.0 if rtol is None else rtol) for x in passed),
        jumps=any(x.jumps for x in passed),
        rows=row_jumps(mechanism, compiled) if any(x.holds for x in passed) else None,
        adaptive=rtol is not None,
        bounded=bounded_rows(mechanism, compiled),
        holding=bool(mechanism.holding),
        corners=corners,
        turns=rows_that_turn(mechanism, corrected=compiled.law.method == CORRECTING),
        missed=0.0 if rtol is None else rtol,
    )


def bounded_rows(mechanism: Mechanism, compiled: CompiledModel) -> BoundedRows | None:
    """Return the rows whose forces have bounds, or None."""
    every, held, pushing = mechanism.bounded, two_sided_rows(mechanism), one_sided_rows(mechanism)
    if not every:
        return None
    state = [row.place for row in every]
    state += [(f"rate of {row.label}", measure_derivative(row)) for row in every]
    state += [row.numbers[k] for k in range(2) for row in held]  # bounds at rest, then those in motion
    state += [row.numbers[0] for row in pushing]
    shifted = any(row.shift is not None for row in held)
    state += [(f"shift of the middle of {row.name} at rest", row.shift or ZERO) for row in held if shifted]
    state += [(f"middle of the bounds of {row.name}", row.middle_of_bounds()) for row in held if shifted]
    rates = [(f"second derivative of {row.label}", measure_derivative(row, 2)) for row in every]
    pressed, forces = rows_bounded_by_reactions(mechanism), list[tuple[str, Expr]]()
    for row in pressed:
        forces += zip((f"{row.name}, reaction {k}" for k in range(2)), (*reaction_components(row), ZERO), strict=False)
    reactions = (
        compile_side(mechanism, compiled, "reactions", "Reactions at rows with bounds", forces) if pressed else None
    )
    return BoundedRows(
        **vars(bounded_names(mechanism)),
        state=compile_side(mechanism, compiled, "bounded", "Rows with bounds", state),
        accelerations=compile_side(mechanism, compiled, "accelerations", "Accelerations along rows with bounds", rates),
        reactions=reactions,
        changes=changes_in_time(mechanism),
        losses=tuple(None if i is None else compiled.info.own_states.stop + i for i in places_of_losses(mechanism)),
        varying=tuple(i for i, row in enumerate(every) if row.changing),
        shifted=tuple(i for i, row in enumerate(every) if row.shift is not None),
    )


def bounded_names(mechanism: Mechanism) -> BoundedNames:
    """Return what the rows with bounds of a mechanism are called."""
    every = mechanism.bounded
    return BoundedNames(
        tuple(row.name for row in every),
        tuple(row.family.one for row in every),
        tuple(row.family.noun for row in every),
        len(two_sided_rows(mechanism)),
        tuple(i for i, row in enumerate(every) if row.pressed and not row.signed),
        tuple(joint.name for joint in mechanism.joints if joint.kind == "driver"),
        tuple(
            i
            for i in range(1, len(every))
            if every[i - 1].one_sided and every[i].one_sided and every[i].name == every[i - 1].name
        ),
        tuple(i for i, row in enumerate(every) if row.in_contact and row.one_sided),
        _partners_of(every),
        tuple(i for i, row in enumerate(every) if row.second),
        tuple(i for i, row in enumerate(every) if row.turns),
        mechanism.restitution_law == "poisson",
    )


def _partners_of(rows: Sequence[BoundedRow]) -> tuple[int, ...]:
    """Return for each row the gap that presses it, or the row that it presses; -1 for others."""
    partners, places = [-1] * len(rows), {row.row: i for i, row in enumerate(rows)}
    for i, row in enumerate(rows):
        if row.signed:
            gap = places[row.pressed[0]]
            partners[i], partners[gap] = gap, i if partners[gap] < 0 else partners[gap]
    return tuple(partners)


def row_jumps(mechanism: Mechanism, compiled: CompiledModel) -> RowJumps:
    """Return the rows whose formulas may jump or have kinks over the state."""
    rows = tuple(row for row in rows_with_kinks(mechanism) if row.switches)
    formulas = [(to_text(e), e) for row in rows for e in row.switches]
    formulas += [(row.name, row.formula) for row in rows]
    side = compile_side(mechanism, compiled, "rows", "Rows that may jump", formulas)
    return RowJumps(rows, side, mechanism.defaults.until)


def effects_of_events(mechanism: Mechanism, compiled: CompiledModel, events: Sequence[Event]) -> Effects | None:
    """Return the effects of events, or None where events change nothing."""
    states = {state.name for state in mechanism.states}
    parts = dict[int, tuple[list[tuple[Expr, Expr]], list[tuple[Expr, Expr]]]]()
    for i, event in enumerate(events):
        if event.reset:
            written = [to_text(name) in states for name, _ in event.reset]
            pairs = list(zip(event.reset, written, strict=True))
            parts[i] = [x for x, own in pairs if not own], [x for x, own in pairs if own]
    if not parts:
        return None
    struck = [pair for velocities, _ in parts.values() for pair in velocities]
    masses = entries_of_masses(mechanism) if struck else {}
    formulas = [(to_text(name), name) for name, _ in struck]
    formulas += [(f"{to_text(name)} afterwards", value) for name, value in struck]
    formulas += [(f"{to_text(name)} afterwards", value) for _, writes in parts.values() for name, value in writes]
    if struck:
        formulas += formulas_of_masses(mechanism, masses)
    carried = bool(struck) and mechanism.topology is not None
    return Effects(
        compiled=compiled,
        names=tuple(event.name for event in events),
        effects={
            i: Effect(*(tuple(to_text(name) for name, _ in pairs) for pairs in effect)) for i, effect in parts.items()
        },
        formulas=compile_side(mechanism, compiled, "effects", "Effects of events", formulas).function,
        entries=tuple(masses),
        bodies=sum(len(body.speeds) for body in mechanism.bodies) if carried else 0,
        first=mechanism.body_coordinates if carried else 0,
        rotors=len(mechanism.rotors) if struck else 0,
        catches=catches_of_joints(mechanism, events),
    )


def catches_of_joints(mechanism: Mechanism, events: Sequence[Event]) -> dict[int, tuple[str, int]]:
    """Return what joints that hold for a while do at events, see `symgen.run.effects.effects.Effects`."""
    numbers, found = {event.name: i for i, event in enumerate(events)}, dict[int, tuple[str, int]]()
    for x in mechanism.holding:
        release = numbers.get(f"{x.joint}.{RELEASES}", -1)
        if release >= 0:
            found[release] = "", -1
        if x.catches is not None:
            # a catch changes no condition of time alone
            by_state = x.releases is not None and not reads_results(x.releases) and moving_quantities(x.releases)
            found[numbers[f"{x.joint}.{CATCHES}"]] = f"{x.joint}.{DISSIPATED}", release if by_state else -1
    return found


def switch_of_event(passed: Discontinuity, rtol: float) -> Switch:
    """Return a discontinuity in the form for loops.

    If a fraction x of a step lies after a jump of the k-th derivative, its stages err by x^k, which may be `rtol`.
    Points of a table that matter less than `rtol` are left out: many of them together are a smooth curve, which the
    error estimate sees.
    """
    table = passed.table
    if table is None:
        return Switch(rtol, holds=passed.holds)
    period = table.x[-1] - table.x[0] if table.periodic else 0.0
    own = table.x[:-1] if table.periodic else table.x
    points = tuple(x for x, size in zip(own, sizes_of_kinks(table.interpolated), strict=False) if size > rtol)
    return Switch(rtol ** (1.0 / KINKS[table.interpolation]), points, period if points else 0.0)


def sizes_of_kinks(curve: Interpolation) -> tuple[float, ...]:
    """Return the distance of both sides of each point of a table within the shorter piece, over the range of values."""
    x, y, n = np.array(curve.x), np.array(curve.y), len(curve.x)
    gaps = np.diff(x)
    if curve.pieces:
        (_, *before), (_, *after) = (np.array(curve.pieces[k : n + k]).T for k in (0, 1))
        u = np.concatenate([[0.0], gaps])
        b1, b2, b3 = before
        parts = [after[0] - (b1 + u * (2.0 * b2 + u * (3.0 * b3))), after[1] - (b2 + 3.0 * u * b3), after[2] - b3]
    else:
        slopes = np.concatenate([[0.0], np.diff(y) / gaps, [0.0]])
        parts = [np.diff(slopes)]
    h = np.minimum(np.concatenate([gaps[:1], gaps]), np.concatenate([gaps, gaps[-1:]]))
    total = np.zeros(n)
    for k, part in enumerate(parts, 1):
        total += np.abs(part) * h**k
    span = float(np.ptp(y))
    return tuple((total / span).tolist()) if span > 0.0 else (0.0,) * n
