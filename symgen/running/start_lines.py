"""The start of a mechanism in another language: parameters that follow from others, and the described start."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from symgen.describe.evaluate import derived, independent_values, parameter_values, scalars
from symgen.describe.holds import holds_of
from symgen.describe.start import described_start
from symgen.layout.model_arrays import velocity_of
from symgen.native.formula_lines import Dialect, FormulaLines
from symgen.running.starts import held_of

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.layout.compiled import ModelInfo


def lines_for(mechanism: Mechanism, dialect: Dialect) -> FormulaLines:
    """Return room for lines in which parameters are elements of the array ``p``."""
    return FormulaLines({p.name: f"p[{i}]" for i, p in enumerate(mechanism.parameters)}, dialect)


def derived_lines(mechanism: Mechanism, dialect: Dialect) -> list[tuple[int, list[str]]]:
    """Return the places of parameters that follow from others, in an order that serves, with lines that set them."""
    places, results = [p.name for p in mechanism.parameters], list[tuple[int, list[str]]]()
    for name, formula in derived(mechanism.parameters):
        lines, place = lines_for(mechanism, dialect), places.index(name)
        value = lines.result(lines.value(formula, name))
        results.append((place, [*lines.lines, f"p[{place}] = {value};"]))
    return results


def independent_places(mechanism: Mechanism, values: Mapping[str, float]) -> list[int]:
    """Return the places of parameters whose values differ from their formulas."""
    own = independent_values(mechanism, values)
    return [i for i, p in enumerate(mechanism.parameters) if p.formula is not None and p.name in own]


def start_lines(mechanism: Mechanism, lines: FormulaLines) -> tuple[list[Any], list[Any]]:
    """Return q and v as described, or as bodies and joints to the ground hold them; None where nothing describes v.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    lines : FormulaLines
        Lines that receive the values.
    """
    held = {hold.name: hold.value for hold in holds_of(mechanism) if hold.value is not None}
    q, v = described_start(mechanism, lines)
    for kind, numbers in (("coordinates", q), ("speeds", v)):
        names = [f"{body.name}.{name}" for body in mechanism.bodies for name in getattr(body, kind)]
        for i, name in enumerate(names):
            if name in held:
                numbers[i] = lines.value(held[name], name)
    return q, v


def fixed_velocities(mechanism: Mechanism, info: ModelInfo) -> list[int]:
    """Return the velocities of bodies whose coordinates a start holds."""
    held = held_of(info, holds_of(mechanism), scalars(parameter_values(mechanism)), [None] * info.nv)
    return sorted({*held.fixed, *(velocity_of(i, info) for i in held.coordinates)})
