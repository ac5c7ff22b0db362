"""The numbers that a machine's owner asks for first: loads of drives and pins, power, work, travel, transmission."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.prescribed.dead_centre_room import room_to_dead_centre
from symgen.analyses.prescribed.transmission import PIN, transmission_angles
from symgen.base.errors import InputError
from symgen.base.vocabulary.measures import GROUND
from symgen.study.report.dead_points import outside_passages
from symgen.study.report.words import engineering_number

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.result.result import Result

Array = NDArray[np.float64]

#: Numbers on the first screen at most, and pins among them.
MOST_NUMBERS, MOST_PINS = 7, 2
#: Share of a range that is rounding at one of its ends, and of work back and forth that its sum over outputs misses.
FINEST, MISSED = 1e-6, 1e-4
#: What the way to a dead centre is called.
ROOM = "room to the dead centre"
#: Last words of the columns of a drive or force element: what it exerts, and its power.
_EFFORTS, _POWER = (".effort", ".force", ".torque", ".Fx", ".Fy", ".Fz"), ".power"


class KeyNumber(NamedTuple):
    """A number with its words.

    Attributes
    ----------
    what, value, where : str
        Of what it is; the number with its unit; when and where.
    """

    what: str
    value: str
    where: str


def key_numbers(mechanism: Mechanism, result: Result, every: bool = False) -> tuple[KeyNumber, ...]:
    """Return at most seven numbers of a run that has outputs, or all pins and travels as well.

    The largest effort of each drive, its largest power and its work; the largest forces of pins; the largest travel
    of a joint, or the ranges of outputs; the least transmission angle of a mechanism in the plane; the room between
    the travel of its driver and a dead centre.
    """
    rest = [
        *_ranges_of_outputs(mechanism, result)[: None if every else 1],
        *_least_transmission_angle(mechanism, result),
        *_room_to_dead_centre(mechanism, result),
    ]
    first = [*_loads_of_drivers(mechanism, result)]
    if every:
        return (*first, *_largest_pin_forces(mechanism, result), *rest)
    first = first[: MOST_NUMBERS - MOST_PINS - len(rest)]
    return (*first, *_largest_pin_forces(mechanism, result)[: MOST_NUMBERS - len(first) - len(rest)], *rest)


def _time_in_words(result: Result, k: int) -> str:
    if k in (0, len(result.t) - 1):
        return "at the start" if k == 0 else "at the end"
    return f"at {result.t[k]:.3g} s"


def _index_of_peak(values: Array) -> int | None:
    """Return where the largest value is; None where all are 0 or none is finite."""
    size = np.nan_to_num(np.abs(values))
    return int(np.argmax(size)) if size.any() else None


def _loads_of_drivers(mechanism: Mechanism, result: Result) -> Iterator[KeyNumber]:
    """Yield the loads of drivers; where there is none, of force elements."""
    table = result.whole(("elements",))
    columns = dict(zip(table.names, table.values.T, strict=True))
    units = dict(zip(table.names, table.units, strict=True))
    columns = {name: np.where(outside_passages(result), column, np.nan) for name, column in columns.items()}
    drivers = [name for name in columns if name.endswith(_EFFORTS[0])]
    told = set[str]()
    for name in drivers or [name for name in columns if name.endswith(_EFFORTS)]:
        owner, _, part = name.rpartition(".")
        if (k := _index_of_peak(columns[name])) is None:
            continue
        kind = "torque" if units[name] == "N m" else "force"
        kind += f" along {part[1:]}" if part in ("Fx", "Fy", "Fz") else ""
        yield KeyNumber(
            f"{owner}, {kind}", engineering_number(columns[name][k], units[name]), _time_in_words(result, k)
        )
        power = None if owner in told else columns.get(f"{owner}{_POWER}")
        told.add(owner)
        if power is not None and (k := _index_of_peak(power)) is not None:
            work = float(np.trapezoid(np.nan_to_num(power), result.t))
            moved = float(np.trapezoid(np.abs(np.nan_to_num(power)), result.t))
            work = work if abs(work) > MISSED * moved else 0.0
            where = f"{_time_in_words(result, k)}; work of the run {engineering_number(work, 'J')}"
            yield KeyNumber(f"{owner}, power", engineering_number(power[k], "W"), where)


def _largest_pin_forces(mechanism: Mechanism, result: Result) -> list[KeyNumber]:
    """Return the largest forces of joints that are no drivers, the largest one first."""
    drivers = {joint.name for joint in mechanism.joints if joint.kind == "driver"}
    table, peaks = result.whole(("magnitudes",)), list[tuple[float, KeyNumber]]()
    for i, name in enumerate(table.names):
        joint = name.rpartition(".")[0]
        k = _index_of_peak(np.where(outside_passages(result), table.values[:, i], np.nan))
        if k is None or joint in drivers or table.units[i] != "N":
            continue
        size = float(abs(table.values[k, i]))
        peaks.append((size, KeyNumber(f"{joint}, force", engineering_number(size, "N"), _time_in_words(result, k))))
    return [number for _, number in sorted(peaks, key=lambda pair: -pair[0])]


def _ranges_of_outputs(mechanism: Mechanism, result: Result) -> list[KeyNumber]:
    """Return the ranges of outputs that are lengths or angles, else of joints at the ground, the largest first."""
    table = result.whole(("outputs",))
    ranges = [
        (name, column, unit)
        for name, column, unit in zip(table.names, table.values.T, table.units, strict=True)
        if unit in ("m", "rad")
    ]
    if not ranges:
        grounded = {j.name for j in mechanism.joints if GROUND in j.bodies and j.kind != "driver"}
        joints = result.whole(("joint_coordinates",))
        for name, column, unit in zip(joints.names, joints.values.T, joints.units, strict=True):
            if name.split(".")[0] in grounded and not name.endswith(".rate") and unit in ("m", "rad"):
                ranges.append((name, column, unit))
        # the link that swings farthest; an angle that turns round and round says nothing
        ranges = [each for each in ranges if each[2] == "m" or np.ptp(each[1]) < 2.0 * np.pi]
        ranges.sort(key=lambda each: (each[2] != "rad", -np.ptp(each[1])))
    found = list[KeyNumber]()
    for name, values, unit in ranges:
        span = float(np.nanmax(values) - np.nanmin(values))
        ends = (float(np.nanmin(values)), float(np.nanmax(values)))
        low, high = (engineering_number(x if abs(x) > FINEST * span else 0.0, unit) for x in ends)
        found.append(KeyNumber(f"travel of {name}", engineering_number(span, unit), f"from {low} to {high}"))
    return found


def _least_transmission_angle(mechanism: Mechanism, result: Result) -> Iterator[KeyNumber]:
    """Yield the least transmission angle of pins that have one; a link that a driver moves needs no transmission."""
    driven = {name for joint in mechanism.joints if joint.kind == "driver" for name in joint.bodies}
    if mechanism.space != "planar" or not driven:
        return
    found = list[tuple[float, int, str]]()
    for pin in mechanism.joints:
        if pin.kind != PIN or GROUND in pin.bodies or not driven.isdisjoint(pin.bodies):
            continue
        try:
            angle = transmission_angles(mechanism, result.q, result.parameters, (pin.name,)).values[:, 0]
        except InputError:  # its bodies have several further joints
            continue
        least = np.minimum(angle, np.pi - angle)
        k = int(np.argmin(least))
        found.append((float(least[k]), k, pin.name))
    if found:
        size, k, name = min(found)
        yield KeyNumber(
            "transmission angle", engineering_number(size, "rad"), f"least, at {name}, {_time_in_words(result, k)}"
        )


def _room_to_dead_centre(mechanism: Mechanism, result: Result) -> Iterator[KeyNumber]:
    """Yield the way from the travel of the driver to the nearer dead centre, where there is one."""
    rooms = [room for room in room_to_dead_centre(mechanism, result.t, result.parameters) if not math.isnan(room.way)]
    for room in sorted(rooms, key=lambda room: room.way)[:1]:
        where = f"{'below' if room.backward else 'above'} the travel of {room.driver}"
        yield KeyNumber(ROOM, engineering_number(room.way, room.unit), where)
