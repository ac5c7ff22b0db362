"""Places of pins as parameters: numbers of all points that a pin holds follow it, and bodies stay where they start."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, NamedTuple

from symgen.base.errors import InputError, quote, suggest
from symgen.base.units import read_amount
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.edits.handles import PINS, PointsOfFile, WrittenPoint
from symgen.describe.edits.new_numbers import put_at_path, value_at_path
from symgen.describe.facts.lifted import Path, free_parameter_name, names_of_scalars, path_in_words
from symgen.describe.files.origins import Origin, origin_of
from symgen.describe.files.validate import validate
from symgen.describe.formulas.evaluate import parameter_values, scalar_values
from symgen.describe.formulas.start import described_start
from symgen.describe.mechanism import Mechanism

AXES = ("x", "y")
#: Slopes of numbers below this are rounding of a cosine.
_NO_SLOPE = 1e-14


class MovedNumber(NamedTuple):
    """A number of a file that follows places of pins.

    Attributes
    ----------
    path : tuple
        Keys that lead to it.
    value : float
        Before anything moves, in SI units.
    slopes : mapping of str to float
        By how much it grows with each metre of a place.
    """

    path: Path
    value: float
    slopes: Mapping[str, float]

    def at(self, places: Mapping[str, float], before: Mapping[str, float]) -> float:
        """Return it with pins at other places than before."""
        if (name := self.place_itself(before)) is not None:
            return places[name]
        return math.fsum([self.value, *(slope * (places[name] - before[name]) for name, slope in self.slopes.items())])

    def place_itself(self, before: Mapping[str, float]) -> str | None:
        """Return the place that the number is, as numbers of the ground are; None where it only follows places."""
        name = next(iter(self.slopes))
        return name if dict(self.slopes) == {name: 1.0} and self.value == before[name] else None


@dataclass(frozen=True)
class PinPlaces:
    """Coordinates of pins at the start that are parameters.

    Attributes
    ----------
    mechanism : Mechanism
        The mechanism with these parameters.
    keys : mapping of str to str
        Names as typed, such as ``A.x``, each with its name in the mechanism.
    before : mapping of str to float
        Their values in the file [m].
    moved : tuple of MovedNumber
        Numbers that follow.
    spots : mapping of str to tuple of WrittenPoint
        The points that each name moves; one of the ground comes first.
    """

    mechanism: Mechanism
    keys: Mapping[str, str]
    before: Mapping[str, float]
    moved: tuple[MovedNumber, ...]
    spots: Mapping[str, tuple[WrittenPoint, ...]]

    def place(self, name: str, q: Sequence[float], values: Mapping[str, float]) -> float:
        """Return where bodies put a coordinate of a pin [m].

        Parameters
        ----------
        name : str
            One of `keys`.
        q : sequence of float
            Coordinates of all bodies.
        values : mapping of str to float
            Values of all parameters.
        """
        origin = origin_of(self.mechanism)
        assert origin is not None, "it was validated from a description"
        points, first = PointsOfFile(self.mechanism, origin.raw, {}, "", q, values), self.spots[name][0]
        numbers = {each.path: each for each in self.moved}
        places = {own: values[key] for own, key in self.keys.items()}
        local = [
            numbers[path].at(places, self.before) if (path := (*first.path, k)) in numbers else _si(first.raw[k])
            for k in range(2)
        ]
        return points.place_in_ground(first.body, local)[AXES.index(name[-1])]


def pin_of_place(raw: Mapping[str, Any], name: str) -> str:
    """Return the joint whose place at the start a name such as ``A.x`` means; empty for other names."""
    joint, _, axis = name.rpartition(".")
    return joint if axis in AXES and joint in raw.get("joints", {}) else ""


def pins_that_vary(mechanism: Mechanism) -> tuple[str, ...]:
    """Return the pins whose places a design may vary, each by its first joint; the start decides on some of them.

    Without the description of the mechanism, there are none.
    """
    origin = origin_of(mechanism)
    if origin is None or mechanism.space != "planar":
        return ()
    q = described_start(mechanism, scalar_values(parameter_values(mechanism)))[0]
    points, found = PointsOfFile(mechanism, origin.raw, {}, "", q), list[str]()
    for joint, _ in points.pins_with_points():
        with suppress(InputError):
            _spots_of_pin("design", points, joint)
            found.append(joint)
    return tuple(found)


def lift_pins(
    where: str, mechanism: Mechanism, names: Sequence[str], q: Sequence[float], parameters: Mapping[str, float]
) -> PinPlaces:
    """Return a mechanism in which places of pins at the start are parameters.

    The numbers of all points that a pin holds become formulas of its place, such that they stay in one place while
    bodies stay where they are. A centre of mass in the middle of points follows, as it does in the editor.

    Parameters
    ----------
    where : str
        Argument that has the names, for messages.
    mechanism : Mechanism
        The description, whose origin is at hand.
    names : sequence of str
        Places such as ``A.x``.
    q : sequence of float
        Coordinates of all bodies at the start.
    parameters : mapping of str to float
        Values that differ from the file's.

    Raises
    ------
    InputError
        If a joint is no pin of the plane, or a point of it is not written as numbers.
    """
    origin = origin_of(mechanism)
    assert origin is not None, "whoever asks has the description at hand"
    raw = origin.raw
    points = PointsOfFile(mechanism, raw, {}, "", q, parameter_values(mechanism, parameters))
    spots, before, owners = dict[str, tuple[WrittenPoint, ...]](), dict[str, float](), dict[tuple[str, Path], str]()
    for name in names:
        own, axis = _spots_of_pin(f"{where} '{name}'", points, pin_of_place(raw, name)), name[-1]
        spots[name] = tuple(sorted(own, key=lambda spot: spot.body != GROUND))
        if (first := owners.setdefault((axis, own[0].path), name)) != name:
            got = f"a second name of the place {quote(first)}: both joints are one pin"
            raise InputError(f"{where} '{name}'", "each place once", got)
        local = [_si(x) for x in spots[name][0].raw]
        at = points.place_in_ground(spots[name][0].body, local)[AXES.index(axis)]
        # of a frame that is not turned, the number as written, which lacks the rounding of the way there
        own_numbers = [_si(spot.raw[AXES.index(axis)]) for spot in own if points.poses[spot.body][2] == 0.0]
        before[name] = next((x for x in own_numbers if math.isclose(x, at, rel_tol=1e-12, abs_tol=1e-15)), at)
    slopes = dict[Path, dict[str, float]]()
    for name in names:
        for path, slope in _slopes(points, spots[name], AXES.index(name[-1])):
            if abs(slope) > _NO_SLOPE:
                mine = slopes.setdefault(path, {})
                mine[name] = mine.get(name, 0.0) + slope
    moved = tuple(MovedNumber(path, _si(value_at_path(raw, path)), own) for path, own in slopes.items())
    others, keys = names_of_scalars(raw), dict[str, str]()
    for name in names:
        keys[name] = free_parameter_name(name, others)
        others.add(keys[name])
    return PinPlaces(_with_formulas(origin, moved, keys, before), keys, before, moved, spots)


def _spots_of_pin(where: str, points: PointsOfFile, joint: str) -> list[WrittenPoint]:
    """Return the points that a pin and further joints at it hold.

    Raises
    ------
    InputError
        If it is no pin of the plane, or a point of it is not written as numbers.
    """
    if points.mechanism.space != "planar":
        raise InputError(where, "a pin of a planar mechanism", "a joint in space")
    entries = points.raw["joints"]
    kinds = {each.name: each.kind for each in points.mechanism.joints}
    if kinds.get(joint) not in PINS:
        pins = [name for name, kind in kinds.items() if kind in PINS]
        raise InputError(
            where,
            "a pin, which is a revolute or rigid joint",
            f"one of type {entries[joint]['type']}",
            suggest(joint, pins),
        )
    groups = [own for _, own in points.pins_with_points() if {s.path for s in own} & _paths(points, joint, entries)]
    spots = groups[0] if groups else []
    held = {spot.path for spot in spots}
    for name, entry in entries.items():
        own = _paths(points, name, entries)
        if name != joint and (kinds.get(name) not in PINS or not own & held):
            continue
        for k, (body, at) in enumerate(zip(entry["between"], entry.get("at", ()), strict=False)):
            if isinstance(at, str) and not any(s.point == at and s.body == body for s in spots):
                got = f"{quote(at)} of {quote(body)} at joint {quote(name)}"
                raise InputError(where, _NUMBERS, got, f"write its coordinates in the frame of {body}")
            if body != GROUND and body not in points.poses:
                raise InputError(where, "a pin of rigid bodies", f"{quote(body)} at joints.{name}.at[{k}]")
    if not spots:
        raise InputError(where, _NUMBERS, f"joint {quote(joint)} without points")
    for spot in spots:
        for k, x in enumerate(spot.raw):
            if not _is_number(x):
                got = f"{path_in_words((*spot.path, k))}, which is {quote(str(x))}"
                raise InputError(where, _NUMBERS, got, "take the parameters in it")
    return spots


_NUMBERS = "a pin whose points are numbers in the file"


def _paths(points: PointsOfFile, joint: str, entries: Mapping[str, Any]) -> set[Path]:
    return {spot.path for spot in points.ends_of_entry("joints", joint, entries[joint])}


def _slopes(points: PointsOfFile, spots: Sequence[WrittenPoint], axis: int) -> Iterator[tuple[Path, float]]:
    """Yield the numbers that follow a pin along an axis of the ground, by how much with each metre."""
    for spot in spots:
        angle = points.poses[spot.body][2]
        along = ((math.cos(angle), -math.sin(angle)), (math.sin(angle), math.cos(angle)))[axis]
        about = points.points_about_centre(spot)
        for k, slope in enumerate(along):
            yield (*spot.path, k), slope
            if about:
                yield (*spot.path[:2], "centre_of_mass", k), slope / about


def _with_formulas(
    origin: Origin, moved: Sequence[MovedNumber], keys: Mapping[str, str], before: Mapping[str, float]
) -> Mechanism:
    """Return the mechanism of a description in which numbers follow new parameters."""
    raw: Any = origin.raw
    for number in moved:
        if (place := number.place_itself(before)) is not None:
            text = keys[place]
        else:
            parts = (f"({slope!r})*({keys[name]} - ({before[name]!r}))" for name, slope in number.slopes.items())
            text = " + ".join([repr(number.value), *parts])
        raw = put_at_path(raw, number.path, text)
    own = {key: {"value": before[name], "unit": "m", "note": name} for name, key in keys.items()}
    return validate({**raw, "parameters": {**raw.get("parameters", {}), **own}}, origin.source)


def _is_number(value: object) -> bool:
    if isinstance(value, str):
        amount = read_amount(value)
        return amount is not None and bool(amount.unit)
    return isinstance(value, int | float) and not isinstance(value, bool)


def _si(value: object) -> float:
    """Return a number of a file in SI units."""
    if isinstance(value, str):
        amount = read_amount(value)
        assert amount is not None, "it was asked before"
        return amount.in_si("design", "m")
    assert isinstance(value, int | float)
    return float(value)
