"""What a mechanism with rows with bounds may not have besides."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import ZERO, Number
from symgen.base.vocabulary.measures import Holonomic, Measure, Sum
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.bounded_modes import one_sided_rows, two_sided_rows
from symgen.describe.mechanism import Mechanism


def check_bounds(mechanism: Mechanism, source: str) -> None:
    """Refuse rows with two bounds along coordinates that drivers prescribe, and contacts of the same two shapes.

    Raises
    ------
    InputError
        With the first such row.
    """
    driven: dict[Measure, str] = {}
    for joint in mechanism.joints:
        for prescribed in joint.rows if joint.kind == "driver" else ():
            if isinstance(prescribed, Holonomic):
                driven[_positive_measure(prescribed.measure)] = joint.name
    for row in two_sided_rows(mechanism):
        driver = driven.get(_positive_measure(row.measure))
        if driver is not None:
            raise InputError(
                f"{source}: {row.where}", "a coordinate that no driver prescribes", f"one that '{driver}' prescribes"
            )
    paired = next((row for row in mechanism.bounded if row.paired), None)
    if paired is not None:
        rubs = next((row for row in two_sided_rows(mechanism) if row.pressed and not row.signed), None)
        if rubs is not None:
            expected = "no friction of contacts in space beside bounds by reactions"
            raise InputError(f"{source}: {rubs.where}", expected, f"that of '{paired.name}'")
        if mechanism.restitution_law == "poisson":
            expected = '"newton" beside friction of contacts in space'
            raise InputError(f"{source}: mechanism.restitution_law", expected, '"poisson"')
    gaps = dict[tuple[Measure, object], str]()
    for row in one_sided_rows(mechanism):
        if row.in_contact and (row.measure, row.held.value) in gaps:
            other = gaps[row.measure, row.held.value]
            raise InputError(f"{source}: {row.where}", "one contact of two shapes", f"the shapes of '{other}'")
        gaps[row.measure, row.held.value] = row.name


def name_of_two(entries: Sequence[Sequence[BoundedRow]]) -> str:
    """Return the first name that the rows of two entries of a file have; empty without any."""
    names = Counter(name for rows in entries for name in {row.name for row in rows})
    return next((name for name, count in names.items() if count > 1), "")


def refuse_driven_surfaces(where: str, mechanism: Mechanism) -> None:
    """Refuse surfaces that are driven, where runs alone have their motion.

    Raises
    ------
    InputError
        With their contacts.
    """
    if names := dict.fromkeys(row.name for row in mechanism.bounded if row.surface != ZERO):
        expected = "a mechanism without surfaces that move by themselves"
        raise InputError(where, expected, f"surface_speed of {', '.join(names)}", "runs and sweeps have it")


def _positive_measure(measure: Measure) -> Measure:
    """Return a measure, or the one that it is the negative of."""
    if isinstance(measure, Sum) and len(measure.terms) == 1 and measure.terms[0][0] == Number(-1.0):
        return measure.terms[0][1]
    return measure
