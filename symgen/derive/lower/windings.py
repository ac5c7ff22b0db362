"""Angles of the elements of the section ``winding``, in each shape of code; other inputs of formulas."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from symgen.base.vocabulary.expressions import Reading, moving_quantities, readings_in
from symgen.base.vocabulary.measures import (
    FormulaMeasure,
    FormulaSpeed,
    Holonomic,
    Measure,
    Periodic,
    Sum,
    Turning,
    Wrapped,
)
from symgen.describe.facts.repeats import without_repeats
from symgen.describe.mechanism import Force, Joint, Mechanism
from symgen.describe.parts.topology import state_measures


@dataclass(frozen=True)
class Beside:
    """Parts of a compiled model that formulas of a run may read.

    Attributes
    ----------
    turning : tuple of Measure
        Angles whose turns it counts, from `winding_order`.
    sections : mapping of str to (int, int)
        Sections of its ``w``: beginnings and sizes.
    rows : mapping of str to int
        Place of the multiplier of each row.
    """

    turning: tuple[Measure, ...]
    sections: Mapping[str, tuple[int, int]]
    rows: Mapping[str, int]


def counted_turns(measures: Iterable[Any]) -> tuple[Measure, ...]:
    """Return those measures, and parts of sums among them, whose turns are counted, each once, in this order."""
    waiting, angles = list(measures), dict[Measure, None]()
    while waiting:
        measure = waiting.pop(0)
        if isinstance(measure, Sum):
            waiting = [part for _, part in measure.terms] + waiting
        elif isinstance(measure, FormulaMeasure | FormulaSpeed):
            waiting = [r.source for r in moving_quantities(measure.of) if isinstance(r, Reading)] + waiting
        elif isinstance(measure, Periodic):
            if isinstance(measure, Wrapped):  # derived after what it wraps
                angles |= dict.fromkeys(counted_turns([measure.of]))
            angles[measure] = None
    return tuple(angles)


def measures_of_element(element: Joint | Force) -> list[Any]:
    """Return the measures of an element in the order of derivation."""
    if isinstance(element, Joint):
        return [*_held_measures(element), *(m for _, m in element.coordinates)]
    return [m for e in element.efforts for m in (e.measure, *(r.source for r in readings_in(e.magnitude)))]


def counts_turns(mechanism: Mechanism) -> bool:
    """Return whether a mechanism may have angles whose turns are counted.

    In the plane only joints have these, and rows with bounds are along them.
    """
    if mechanism.space != "planar" or counted_turns(row.measure for row in mechanism.bounded):
        return True
    return any(counted_turns(measures_of_element(joint)) for joint in mechanism.joints)


def follows_places(mechanism: Mechanism) -> bool:
    """Return whether joints without rows report angles whose turns are counted: nothing else bounds their changes."""
    places = (joint for joint in mechanism.joints if not joint.rows)
    return any(isinstance(m, Turning) for joint in places for _, m in joint.coordinates)


def winding_order(mechanism: Mechanism, shape: str) -> tuple[Measure, ...]:
    """Return the angles of the section ``winding`` in its order.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    shape : {"straight", "looped"}
        Straight code derives the rows of all joints first and reported quantities last, looped code derives element by
        element.
    """
    if not counts_turns(mechanism):
        return ()
    coordinates = {} if mechanism.topology is None else state_measures(mechanism, mechanism.topology)
    distinct, _ = without_repeats(mechanism)
    bounds = [bounded.measure for bounded in distinct.bounded]
    efforts = [m for force in distinct.forces for m in measures_of_element(force)]
    efforts += [rotor.angle for rotor in distinct.rotors]
    if shape == "looped":
        of_joints = [m for joint in distinct.joints for m in counted_turns(measures_of_element(joint))]
        return counted_turns(of_joints + bounds + efforts)
    rows = [m for joint in distinct.joints for m in _held_measures(joint)] + bounds
    angles = counted_turns(
        m
        for m in (*rows, *efforts, *(m for joint in distinct.joints for _, m in joint.coordinates))
        if m not in coordinates
    )
    return tuple(m for m in angles if m not in coordinates)


def _held_measures(joint: Joint) -> list[Any]:
    return [row.measure if isinstance(row, Holonomic) else row.speed for row in joint.rows]
