"""The start of a mechanism in another language: parameters that follow from others, and the described start."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from symgen.compile.native.formula_lines import Dialect, FormulaLines
from symgen.describe.formulas.evaluate import dependent_parameters, independent_values, parameter_values, scalar_values
from symgen.describe.formulas.start import described_start
from symgen.describe.parts.holds import ORIENTATION, read_holds
from symgen.run.compiling.mass_formulas import masses_of_starts
from symgen.run.layout.model_arrays import velocity_of_coordinate
from symgen.run.planning.held_numbers import held_quantities
from symgen.run.starts.assembler import Assembly
from symgen.run.starts.held import Held

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import CompiledModel


def room_for_lines(mechanism: Mechanism, dialect: Dialect) -> FormulaLines:
    """Return room for lines in which parameters are elements of the array ``p``."""
    return FormulaLines({p.name: f"p[{i}]" for i, p in enumerate(mechanism.parameters)}, dialect)


def derived_lines(mechanism: Mechanism, dialect: Dialect) -> list[tuple[int, list[str]]]:
    """Return the places of parameters that follow from others, in an order that serves, with lines that set them."""
    places, results = [p.name for p in mechanism.parameters], list[tuple[int, list[str]]]()
    for name, formula in dependent_parameters(mechanism.parameters):
        lines, place = room_for_lines(mechanism, dialect), places.index(name)
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
    held = {hold.name: hold.value for hold in read_holds(mechanism) if hold.value is not None}
    q, v = described_start(mechanism, lines)
    for kind, numbers in (("coordinates", q), ("speeds", v)):
        names = [f"{body.name}.{name}" for body in mechanism.bodies for name in getattr(body, kind)]
        for i, name in enumerate(names):
            if name in held:
                numbers[i] = lines.value(held[name], name)
    return q, v


def is_described(mechanism: Mechanism) -> bool:
    """Whether starts in coordinates of bodies are closed from the described one.

    Those that hold coordinates of joints are closed from an exported start instead.
    """
    names = {f"{b.name}.{name}" for b in mechanism.bodies for name in (*b.coordinates, *b.speeds, ORIENTATION)}
    return all(hold.name in names for hold in read_holds(mechanism))


def exported_start(
    mechanism: Mechanism, compiled: CompiledModel, datum: Sequence[float], turns: Sequence[float] | None
) -> Assembly:
    """Return the start of a mechanism in another language.

    Parameters
    ----------
    mechanism, compiled : Mechanism, CompiledModel
        The mechanism and its code.
    datum : sequence of float
        What coordinates are measured from.
    turns : sequence of float, optional
        Angles that count turns in the start that it is closed from, empty where their turns are chosen; None for the
        described start, of which some coordinates and velocities stay.
    """
    info, masses = compiled.info, masses_of_starts(mechanism, compiled, True)
    if turns is not None:
        return Assembly(compiled, branches=turns, datum=datum, masses=masses)
    held = held_quantities(info, read_holds(mechanism), scalar_values(parameter_values(mechanism)), [None] * info.nv)
    fixed = {*held.fixed, *(velocity_of_coordinate(i, info) for i in held.coordinates)}
    own = Held(velocities=held.velocities, fixed=tuple(sorted(fixed)))
    return Assembly(compiled, own, datum=datum, masses=masses)


def written_start(mechanism: Mechanism, dialect: Dialect, described: bool) -> list[str]:
    """Return lines that set the arrays q, v and own to the described start, v to nan where nothing describes it.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    dialect : Dialect
        The language.
    described : bool
        Whether q and v are the described ones; else the lines set states of the file alone.
    """
    lines, written = room_for_lines(mechanism, dialect), list[str]()
    if described:
        q, v = start_lines(mechanism, lines)
        written += [f"q[{i}] = {lines.result(x)};" for i, x in enumerate(q)]
        written += [f"v[{j}] = {dialect.undefined if x is None else lines.result(x)};" for j, x in enumerate(v)]
    for i, state in enumerate(mechanism.states):
        written.append(f"own[{i}] = {lines.result(lines.value(state.start, f'states.{state.name}.start'))};")
    return [*lines.lines_of(written), *written]
