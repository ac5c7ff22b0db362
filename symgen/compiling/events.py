"""Events of a run, and the comparisons of its formulas over the state, as functions for loops."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from symgen.compiling.side import Side, compile_side
from symgen.describe.evaluate import evaluate
from symgen.describe.formula_text import to_text
from symgen.describe.kinks import Discontinuity, changing_rows, discontinuities_of
from symgen.describe.mechanism import Event, Mechanism, SpatialBody
from symgen.ir.interpolation import Interpolation
from symgen.layout.abi import OBSERVE
from symgen.layout.compiled import CompiledModel
from symgen.layout.probe import Ready
from symgen.loops.run_spec import Masses, Reset, Switch, Watched
from symgen.runs.resets import linear_in_v
from symgen.runs.row_jumps import RowJumps

Array = NDArray[np.float64]

#: Order of the derivative of a table that jumps at its points.
_KINKS = {"linear": 1, "pchip": 2, "cubic": 3}
#: Sign of the change of a switching function at its event, 0 for both.
DIRECTIONS = {"rising": 1, "falling": -1, "any": 0}


def compile_events(
    mechanism: Mechanism,
    compiled: CompiledModel,
    events: Sequence[Event],
    values: Mapping[str, float],
    rtol: float | None = None,
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
    values : mapping of str to float
        Values of the parameters.
    rtol : float, optional
        Tolerance of adaptive steps, which end where formulas jump or have kinks over the state; constant steps do not.
        In either, rows that change are examined there.
    """
    passed = tuple(x for x in discontinuities_of(mechanism) if rtol is not None or x.holds)
    if not (events or passed):
        return None
    functions = [(f"{event.name}: {event.text}", event.when) for event in events]
    functions += [(to_text(x.argument), x.argument) for x in passed]
    side = compile_side(mechanism, compiled, "events", "Switching functions", functions, 1, bool(passed))
    resets = {}
    for i, event in enumerate(events):
        if event.reset:
            resets[i] = Reset(
                tuple(to_text(name) for name, _ in event.reset), velocities_at(mechanism, compiled, event)
            )
    return Watched(
        names=tuple(event.name for event in events),
        directions=tuple(DIRECTIONS[event.direction] for event in events),
        actions=tuple(event.action for event in events),
        function=side.function,
        needs_rates="ydot" in side.reads,
        resets=resets,
        masses=masses_of(mechanism, values) if resets else None,
        switches=tuple(switch_of(x, 1.0 if rtol is None else rtol) for x in passed),
        jumps=any(x.jumps for x in passed),
        rows=row_jumps(mechanism, compiled) if any(x.holds for x in passed) else None,
        adaptive=rtol is not None,
    )


def row_jumps(mechanism: Mechanism, compiled: CompiledModel) -> RowJumps:
    """Return the rows whose formulas may jump or have kinks over the state."""
    rows = tuple(row for row in changing_rows(mechanism) if row.switches)
    formulas = [(to_text(e), e) for row in rows for e in row.switches]
    formulas += [(row.name, row.formula) for row in rows]
    side = compile_side(mechanism, compiled, "rows", "Rows that may jump", formulas)
    return RowJumps(rows, side, mechanism.defaults.until)


def velocities_at(mechanism: Mechanism, compiled: CompiledModel, event: Event) -> Side:
    """Return the velocities that an event changes, then their values after it."""
    formulas = [(to_text(name), name) for name, _ in event.reset]
    formulas += [(f"{to_text(name)} afterwards", value) for name, value in event.reset]
    return compile_side(mechanism, compiled, "reset", "Velocities at an event", formulas)


def switch_of(passed: Discontinuity, rtol: float) -> Switch:
    """Return a discontinuity in the form for loops.

    A stage of a step of which a part x is behind a kink of the k-th derivative is off by the k-th power of x, which may
    be `rtol`. Points of a table that matter less than `rtol` are left out: many of these together are a smooth curve,
    which the error estimate sees.
    """
    table = passed.table
    if table is None:
        return Switch(rtol, holds=passed.holds)
    period = table.x[-1] - table.x[0] if table.periodic else 0.0
    own = table.x[:-1] if table.periodic else table.x
    points = tuple(x for x, size in zip(own, sizes_of_kinks(table.interpolated), strict=False) if size > rtol)
    return Switch(rtol ** (1.0 / _KINKS[table.interpolation]), points, period if points else 0.0)


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


def masses_of(mechanism: Mechanism, values: Mapping[str, float]) -> Masses:
    """Return the factors of M, over the velocities of bodies where joints of a tree carry these."""
    if mechanism.topology is not None:
        return partial(_carried_masses, mechanism)
    return partial(_own_masses, tuple(_products(mechanism, values)))


def _own_masses(
    products: Sequence[tuple[int, int, float]], compiled: CompiledModel, t: float, y: Array, p: Array, w: Array
) -> tuple[Array, Array, Array]:
    mass = np.diag(compiled.section(w, "mass"))
    for i, j, value in products:
        mass[i, j] = mass[j, i] = value
    return np.eye(len(mass)), np.zeros(len(mass)), mass


def _carried_masses(
    mechanism: Mechanism, compiled: CompiledModel, t: float, y: Array, p: Array, w: Array
) -> tuple[Array, Array, Array]:
    info = compiled.info
    values = dict(zip((q.name for q in info.parameters), p.tolist(), strict=False))
    diagonal = list[float]()
    for body in mechanism.bodies:
        where = f"bodies.{body.name}"
        diagonal += [evaluate(body.mass, values, f"{where}.mass")] * len(mechanism.gravity)
        if body.inertia is not None:
            turning = body.inertia[:3] if isinstance(body, SpatialBody) else (body.inertia,)
            diagonal += [evaluate(entry, values, f"{where}.inertia") for entry in turning]
    mass = np.diag(diagonal)
    for i, j, value in _products(mechanism, values):
        mass[i, j] = mass[j, i] = value
    first, count = mechanism.body_coordinates, len(diagonal)
    out, ydot, bodies = np.zeros(first + 2 * count), np.zeros(info.ny), Ready(compiled.model.bodies, OBSERVE)

    def velocities(state: Array) -> Array:
        bodies(t, state, p, w, ydot, out)
        return out[first : first + count]

    return *linear_in_v(info, y, velocities), mass


def _products(mechanism: Mechanism, values: Mapping[str, float]) -> list[tuple[int, int, float]]:
    """Return the off-diagonal entries of M: row, column, value."""
    entries, first = list[tuple[int, int, float]](), 0
    for body in mechanism.bodies:
        if isinstance(body, SpatialBody) and body.inertia is not None:
            for (i, j), entry in zip(((0, 1), (0, 2), (1, 2)), body.inertia[3:], strict=True):
                value = evaluate(entry, values, f"bodies.{body.name}.inertia")
                if value != 0.0:
                    entries.append((first + 3 + i, first + 3 + j, value))
        first += len(body.speeds)
    return entries
