"""Events of a run as functions that loops take."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from symgen.compiling.side import compile_side
from symgen.describe.evaluate import evaluate
from symgen.describe.mechanism import Event, Mechanism, SpatialBody
from symgen.describe.printer import to_text
from symgen.runtime.abi import OBSERVE
from symgen.runtime.compiled import CompiledModel
from symgen.runtime.events import Watched
from symgen.runtime.probe import Ready
from symgen.runtime.resets import Masses, Reset, linear_in_v

Array = NDArray[np.float64]

_DIRECTIONS = {"rising": 1, "falling": -1, "any": 0}


def compile_events(
    mechanism: Mechanism, compiled: CompiledModel, events: Sequence[Event], values: Mapping[str, float]
) -> Watched | None:
    """Return events as loops take them, None where there are none; `values` are those of the parameters."""
    if not events:
        return None
    conditions = [(f"{event.name}: {event.text}", event.when) for event in events]
    side = compile_side(mechanism, compiled, "events", "Switching functions of events", conditions, 1)
    resets = {}
    for i, event in enumerate(events):
        if event.reset:
            named = [(to_text(quantity), quantity) for quantity, _ in event.reset]
            after = [(f"{label} afterwards", value) for (label, _), (_, value) in zip(named, event.reset, strict=True)]
            given = compile_side(mechanism, compiled, "reset", "Velocities at an event", [*named, *after])
            resets[i] = Reset(tuple(label for label, _ in named), given)
    return Watched(
        names=tuple(event.name for event in events),
        directions=tuple(_DIRECTIONS[event.direction] for event in events),
        actions=tuple(event.action for event in events),
        function=side.function,
        needs_rates="ydot" in side.reads,
        resets=resets,
        masses=masses_of(mechanism, values) if resets else None,
    )


def masses_of(mechanism: Mechanism, values: Mapping[str, float]) -> Masses:
    """Return what makes M, over the velocities of bodies where joints of a tree carry these."""
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
    """Return the entries of M beside its diagonal: row, column, value."""
    found, first = list[tuple[int, int, float]](), 0
    for body in mechanism.bodies:
        if isinstance(body, SpatialBody) and body.inertia is not None:
            for (i, j), entry in zip(((0, 1), (0, 2), (1, 2)), body.inertia[3:], strict=True):
                value = evaluate(entry, values, f"bodies.{body.name}.inertia")
                if value != 0.0:
                    found.append((first + 3 + i, first + 3 + j, value))
        first += len(body.speeds)
    return found
