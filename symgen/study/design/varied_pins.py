"""Places of pins that vary: where the machine starts decides which numbers follow them, and whether it stays closed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from symgen.base.errors import AssemblyError, InputError, quote
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.facts.lifted import path_in_words
from symgen.describe.facts.pins import PinPlaces, lift_pins
from symgen.describe.formulas.evaluate import parameter_values
from symgen.run.planning.closing_part import closing_part
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare

if TYPE_CHECKING:
    from symgen.analyses.search.ranges import Ranges
    from symgen.base.settings import Settings
    from symgen.describe.mechanism import Mechanism


#: Numbers move by this part of their ranges to see whether pins come where they should, to this part of the step.
STEP, NEAR = 1e-3, 1e-3
#: Rounding of places, in parts of their size.
ROUNDING = 1e-11


def start_of(mechanism: Mechanism, settings: Settings, parameters: Mapping[str, float]) -> list[float]:
    """Return the coordinates of all bodies where a machine starts.

    Raises
    ------
    InputError, AssemblyError
        If the machine does not close.
    """
    bare, own = closing_part(mechanism)
    states = {state.name for state in mechanism.states}
    start = {name: value for name, value in settings.start.items() if name not in states}
    found = prepare(bare, replace(own, parameters=parameters, inputs=settings.inputs, start=start), Purpose.STATE)
    return [float(x) for x in found.start.y[: found.compiled.info.nq]]


def read_pins(
    where: str, mechanism: Mechanism, names: Sequence[str], others: Sequence[str], settings: Settings
) -> PinPlaces:
    """Return the places of pins as parameters.

    Parameters
    ----------
    where : str
        Argument that has the names, for messages.
    mechanism : Mechanism
        The machine.
    names, others : sequence of str
        Places such as ``A.x``, and other numbers that vary.
    settings : Settings
        Of its runs.

    Raises
    ------
    InputError
        If a pin cannot be moved so, or another number that varies is one of its points.
    """
    try:
        q = start_of(mechanism, settings, settings.parameters)
    except AssemblyError as error:
        raise InputError(where, "a file whose machine closes at the start", str(error)) from None
    places = lift_pins(where, mechanism, names, q, settings.parameters)
    both = {path_in_words(number.path) for number in places.moved}.intersection(others)
    if both:
        name = min(both)
        raise InputError(
            f"{where} '{name}'", "a number that no pin moves", "one that follows a pin", "vary one of them"
        )
    return places


def check_pins(
    where: str,
    places: PinPlaces,
    mechanism: Mechanism,
    keys: Mapping[str, str],
    ranges: Ranges,
    settings: Settings,
) -> None:
    """Refuse pins that do not come to their places while numbers vary, as bodies do not stay where they start.

    Parameters
    ----------
    where : str
        Argument that has the names, for messages.
    places : PinPlaces
        The pins.
    mechanism : Mechanism
        The machine with all numbers that vary as parameters.
    keys : mapping of str to str
        Names of all of these as parameters.
    ranges : Ranges
        Their bounds.
    settings : Settings
        Of the runs.

    Raises
    ------
    InputError
        If one does not.
    """
    values = parameter_values(mechanism, settings.parameters)
    # a pin at the ground is where the ground has it
    loose = [name for name in places.keys if places.spots[name][0].body != GROUND]
    for name, low, high in zip(ranges.names, ranges.low, ranges.high, strict=True):
        if name not in places.keys and not loose:
            continue
        before = values[keys[name]]
        step = STEP * (high - low)
        now = float(before + step if before + step <= high else before - step)
        given = {**settings.parameters, keys[name]: now}
        try:
            q = start_of(mechanism, settings, given)
        except (AssemblyError, InputError) as error:
            if name not in places.keys:
                continue
            raise InputError(f"{where} '{name}'", "a pin that other joints let move", str(error)) from None
        own = parameter_values(mechanism, given)
        for pin in loose:
            beside = abs(places.place(pin, q, own) - own[keys[pin]])
            if beside <= NEAR * step + ROUNDING * max(1.0, *map(abs, q)):
                continue
            if name not in places.keys:
                got = f"{quote(name)}, which moves the bodies at it"
                raise InputError(
                    f"{where} '{pin}'", "a pin that other numbers leave in its place", got, "vary one of them"
                )
            got = f"a start that assembly closes {beside / step:.2g} of the way beside it"
            hint = "write positions and angles as assembled, and let no other joint hold its points"
            raise InputError(
                f"{where} '{name}'", "bodies that stay where the file has them while the pin moves", got, hint
            )
