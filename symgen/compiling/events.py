"""Events of a run as functions that loops take."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from symgen.compiling.side import compile_side
from symgen.describe.evaluate import evaluate
from symgen.describe.mechanism import Event, Mechanism, SpatialBody
from symgen.describe.printer import to_text
from symgen.runtime.compiled import CompiledModel
from symgen.runtime.events import Reset, Watched
from symgen.store.entries import Entries

_DIRECTIONS = {"rising": 1, "falling": -1, "any": 0}


def compile_events(
    mechanism: Mechanism,
    compiled: CompiledModel,
    events: Sequence[Event],
    values: Mapping[str, float],
    entries: Entries | None = None,
) -> Watched | None:
    """Return events as loops take them, None where there are none.

    Parameters
    ----------
    mechanism, compiled : Mechanism, CompiledModel
        The model.
    events : sequence of Event
        What is watched.
    values : mapping of str to float
        Of the parameters.
    entries : Entries, optional
        The cache; by default the user's.
    """
    if not events:
        return None
    conditions = [(f"{event.name}: {event.text}", event.when) for event in events]
    side = compile_side(mechanism, compiled, "events", "Switching functions of events", conditions, True, entries)
    resets = {}
    for i, event in enumerate(events):
        if event.reset:
            named = [(to_text(quantity), quantity) for quantity, _ in event.reset]
            after = [(f"{label} afterwards", value) for (label, _), (_, value) in zip(named, event.reset, strict=True)]
            given = compile_side(
                mechanism, compiled, "reset", "Velocities at an event", [*named, *after], entries=entries
            )
            resets[i] = Reset(tuple(label for label, _ in named), given)
    return Watched(
        names=tuple(event.name for event in events),
        directions=tuple(_DIRECTIONS[event.direction] for event in events),
        actions=tuple(event.action for event in events),
        function=side.function,
        needs_rates="ydot" in side.reads,
        resets=resets,
        products=tuple(mass_products(mechanism, values)),
    )


def mass_products(mechanism: Mechanism, values: Mapping[str, float]) -> list[tuple[int, int, float]]:
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
