"""A design as it is asked for: numbers that vary within bounds, an aim, and limits of the file and of the caller."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.search.ranges import Ranges, make_ranges, read_bounds
from symgen.analyses.search.sampled_motions import Aim, Limit, Taken
from symgen.base import arguments
from symgen.base.errors import InputError, enumeration, quote, suggest
from symgen.base.units import known_unit, read_unit
from symgen.base.vocabulary.expressions import Name, names_in_expression
from symgen.describe.edits.handles import PINS
from symgen.describe.facts.lifted import is_path, lift_numbers
from symgen.describe.facts.motion_quantities import MotionQuantity, QuantityNames
from symgen.describe.facts.pins import AXES, PinPlaces, pin_of_place
from symgen.describe.files.origins import origin_of
from symgen.describe.formulas.evaluate import evaluate_formula, parameter_values
from symgen.study.design.varied_pins import check_pins, read_pins
from symgen.study.design.wording import WrittenLimit, read_taken, read_written_limits, unknown_word

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.base.vocabulary.expressions import Expr
    from symgen.describe.mechanism import Mechanism, Parameter

Array = NDArray[np.float64]

#: Most numbers that vary.
MOST_VARIED = 200


@dataclass(frozen=True)
class Varied(Ranges):
    """The numbers that vary.

    Attributes
    ----------
    mechanism : Mechanism
        The machine, with all of them as parameters.
    keys : tuple of str
        Their names as parameters of `mechanism`.
    pins : PinPlaces or None
        Places of pins among them.
    """

    mechanism: Mechanism
    keys: tuple[str, ...]
    pins: PinPlaces | None = None

    @property
    def units(self) -> list[str]:
        """Their units."""
        own = {p.name: p.unit for p in self.mechanism.parameters}
        return [own[key] for key in self.keys]


def read_varied(mechanism: Mechanism, vary: object, settings: Settings) -> Varied:
    """Return the numbers that vary.

    Parameters
    ----------
    mechanism : Mechanism
        The machine.
    vary : object
        As for `symgen.study.design.designing.design`.
    settings : Settings
        Of its runs.

    Raises
    ------
    InputError
        If one is no number of the file, follows others by a formula, or its bounds do not hold its value.
    """
    parameters = settings.parameters
    given = read_bounds("design: vary", vary, closed=True)
    if not 0 < len(given) <= MOST_VARIED:
        raise InputError("design: vary", f"1 to {MOST_VARIED} numbers with bounds", f"{len(given)}")
    own, origin = {p.name: p for p in mechanism.parameters}, origin_of(mechanism)
    moved = [name for name in given if not is_path(name) and origin is not None and pin_of_place(origin.raw, name)]
    for name in given:
        if name not in moved:
            _refuse_name(name, own, mechanism, parameters)
    others, pins = [name for name in given if name not in moved], None
    if moved:
        pins = read_pins("design: vary", mechanism, moved, others, settings)
        mechanism = pins.mechanism
    lifted = lift_numbers("design: vary", mechanism, others)
    values = parameter_values(lifted.mechanism, parameters)
    all_keys = {**lifted.keys, **(pins.keys if pins else {})}
    keys = tuple(all_keys[name] for name in given)
    ranges = make_ranges("design: vary", given, [values[key] for key in keys], "the value of the file")
    if pins:
        check_pins("design: vary", pins, lifted.mechanism, all_keys, ranges, settings)
    return Varied(**vars(ranges), mechanism=lifted.mechanism, keys=keys, pins=pins)


def _refuse_name(
    name: str, own: Mapping[str, Parameter], mechanism: Mechanism, parameters: Mapping[str, float]
) -> None:
    """Refuse a name of no number, and one of a number that does not stand for itself."""
    if not is_path(name) and name not in own:
        expected = "a parameter, the place of a pin such as A.x, or the path of a number such as bodies.crank.mass"
        pins = (f"{joint.name}.{axis}" for joint in mechanism.joints if joint.kind in PINS for axis in AXES)
        raise InputError(f"design: vary '{name}'", expected, "none of that name", suggest(name, [*own, *pins]))
    if name in own and own[name].input:
        raise InputError(f"design: vary '{name}'", "a number of the machine", "an input, which comes from outside")
    if name in own and (formula := own[name].formula) is not None and name not in parameters:
        by = enumeration(_roots(formula, own))
        got = f"one that follows {by}" if by else "a formula"
        hint = f"vary {by}" if by else "write it as a number"
        raise InputError(f"design: vary '{name}'", "a number of its own", got, hint)


def _roots(formula: Expr, own: Mapping[str, Parameter]) -> list[str]:
    """Return the parameters without formulas that a formula follows."""
    found, waiting = dict[str, None](), [formula]
    while waiting:
        for name in names_in_expression(waiting.pop()):
            if name not in own or name in found:
                continue
            inner = own[name].formula
            if inner is None:
                found[name] = None
            else:
                waiting.append(inner)
    return sorted(found)


class QuantityReader:
    """Reads quantities of aims and limits, each once.

    Parameters
    ----------
    mechanism : Mechanism
        The machine.

    Attributes
    ----------
    quantities : list of MotionQuantity
        Those that were read.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism, self.quantities = mechanism, list[MotionQuantity]()
        self._names, self._units = QuantityNames(mechanism), {p.name: p.unit for p in mechanism.parameters}

    def place(self, where: str, text: str) -> int:
        """Return the place of a quantity among `quantities`.

        Raises
        ------
        InputError
            If it is no formula of what is known of a motion.
        """
        for i, quantity in enumerate(self.quantities):
            if quantity.text == text:
                return i
        try:
            return self._add(self._names.read(where, text))
        except InputError as error:
            raise InputError(where, error.expected, error.got, unknown_word(text) or error.hint) from None

    def parameter(self, name: str) -> int:
        """Return the place of a parameter."""
        return self.formula(name, Name(name), self._units[name])

    def formula(self, text: str, formula: Expr, unit: str) -> int:
        """Return the place of a formula of the machine, under a name for messages."""
        return self._add(self._names.of_formula(text, formula, unit))

    def _add(self, quantity: MotionQuantity) -> int:
        self.quantities.append(quantity)
        return len(self.quantities) - 1


def read_aim(reader: QuantityReader, aim: str) -> Aim:
    """Return an aim from its text."""
    taken = read_taken("design: aim", aim)
    place = reader.place("design: aim", taken.quantity)
    side = "smallest" if taken.word == "min" else "largest"
    return Aim(taken, place, reader.quantities[place].unit, side)


def read_keep(reader: QuantityReader, keep: object) -> Iterator[Limit]:
    """Yield the limits that a caller gives."""
    for text in arguments.words("design: keep", keep):
        for written in read_written_limits("design: keep", text):
            place = reader.place("design: keep", written.taken.quantity)
            bound = _bound_in_own_unit(written, reader.quantities[place].unit)
            unit = reader.quantities[place].unit or written.bound.unit
            yield Limit(written.taken, place, unit, written.side, bound, abs(bound) or 1.0, written.text)


def _bound_in_own_unit(written: WrittenLimit, own: str) -> float:
    """Return the number of a limit in the unit of its quantity: one with a unit may have another one."""
    text = written.bound.unit
    if not text or text == own:
        return written.bound.number
    unit, of_quantity = read_unit(text), known_unit(own)
    if isinstance(unit, str) or unit is None:
        raise InputError("design: keep", "a number with a unit", quote(f"{written.bound.number:g} {text}"))
    if own and not unit.fits(of_quantity):
        raise InputError("design: keep", f"{own}, the unit of {written.taken.quantity}", quote(text))
    si = unit.to_si(written.bound.number)
    return of_quantity.from_si(si) if own else si


def limits_of_file(reader: QuantityReader, varied: Varied, parameters: Mapping[str, float]) -> Iterator[Limit]:
    """Yield the limits of a file: of outputs at every time, and of parameters.

    Raises
    ------
    InputError
        If a limit follows a number that varies.
    """
    mechanism = varied.mechanism
    values = parameter_values(mechanism, parameters)
    outputs = {output.name for output in mechanism.outputs}
    for limit in mechanism.limits:
        for side, end in (("smallest", limit.smallest), ("largest", limit.largest)):
            if end is None:
                continue
            if moving := [name for name in names_in_expression(end) if name in varied.keys]:
                got = f"one that follows {enumeration(moving)}"
                raise InputError(f"design: {limit.name}.{side}", "a limit that stays", got)
            place = reader.place(limit.name, limit.name) if limit.name in outputs else reader.parameter(limit.name)
            bound, unit = evaluate_formula(end, values, f"{limit.name}.{side}"), reader.quantities[place].unit
            sign = "<=" if side == "largest" else ">="
            text = f"{limit.name} {sign} {bound:g} {unit}".rstrip()
            yield Limit(Taken("", limit.name), place, unit, side, bound, abs(bound) or 1.0, text, of_file=True)


def sized(limits: Sequence[Limit], values: Array) -> list[Limit]:
    """Return limits of 0 with the size of their quantity in a motion; others have their own.

    Parameters
    ----------
    limits : sequence of Limit
        The limits.
    values : Array, shape (k, quantities)
        Quantities of the motion.
    """
    return [
        limit if limit.bound else replace(limit, size=float(np.abs(values[:, limit.quantity]).max()) or 1.0)
        for limit in limits
    ]
