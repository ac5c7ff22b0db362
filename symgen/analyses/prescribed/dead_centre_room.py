"""How far a driver could still move, beyond its travel, until the mechanism is at a dead centre."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import NamedTuple

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.analyses.prescribed.driven_motion import driven_motion
from symgen.base.errors import SymgenError
from symgen.base.settings import Settings
from symgen.base.vocabulary.expressions import Expr, Name, Number, call
from symgen.base.vocabulary.measures import Holonomic
from symgen.describe.mechanism import Mechanism
from symgen.run.breaks.in_time import InTime
from symgen.run.planning.dead_centre import DRIVER

#: Positions on the way, which are at most this many apart from the dead centre that is found.
_POSITIONS = 200
#: What is left of a turn, as part of the travel, where the driver turns round and round.
_ROUNDING = 1e-9


class DeadCentreRoom(NamedTuple):
    """The way from an end of a driver's travel to a dead centre.

    Attributes
    ----------
    driver, unit : str
        The driver and the unit of its coordinate.
    way : float
        From the end of the travel to the dead centre; NaN where there is none as far as was looked.
    looked : float
        How far was looked beyond the end.
    backward : bool
        Whether it is beyond the lower end of the travel.
    """

    driver: str
    unit: str
    way: float
    looked: float
    backward: bool


def room_to_dead_centre(
    mechanism: Mechanism, times: NDArray[np.float64], parameters: Mapping[str, float]
) -> tuple[DeadCentreRoom, ...]:
    """Return the rooms beyond both ends of a driver's travel.

    There are none where a mechanism has no driver or several of them, where freedom is left, where the driver does
    not move or turns round and round. Beyond a length as much is looked at as the travel has, of an angle the rest of
    a turn.

    Parameters
    ----------
    mechanism : Mechanism
        In the coordinates of bodies.
    times : Array
        Of the travel, which begins at the first one [s].
    parameters : mapping
        Values of the parameters.
    """
    drivers = [joint for joint in mechanism.joints if joint.kind == DRIVER]
    if len(drivers) != 1 or not isinstance(row := drivers[0].rows[0], Holonomic):
        return ()
    in_time = InTime(mechanism, dict(parameters))
    travel = np.array([in_time.value_at(row.value, float(t)) for t in times])
    low, high = float(travel.min()), float(travel.max())
    looked = high - low if row.unit != "rad" else 2.0 * math.pi - (high - low)
    if high <= low or looked <= _ROUNDING * (high - low):
        return ()
    first = float(travel[0])
    try:
        return tuple(
            _rooms_at_ends(mechanism, drivers[0].name, row, (first - low, high - first), first, looked, parameters)
        )
    except SymgenError:  # freedom that is not driven, a state of the file's own
        return ()


def _rooms_at_ends(
    mechanism: Mechanism,
    name: str,
    row: Holonomic,
    ends: tuple[float, float],
    first: float,
    looked: float,
    parameters: Mapping[str, float],
) -> Iterator[DeadCentreRoom]:
    for backward, end in zip((True, False), ends, strict=True):
        value = call("sub" if backward else "add", Number(first), Name("t"))
        times = np.linspace(0.0, end + looked, _POSITIONS)
        motion = driven_motion(
            _put_driver_function(mechanism, name, value), Settings(parameters=dict(parameters)), times
        )
        way = motion.passages[-1].t - end if motion.ended and motion.passages else math.nan
        yield DeadCentreRoom(name, row.unit, way, looked, backward)


def _put_driver_function(mechanism: Mechanism, name: str, value: Expr) -> Mechanism:
    """Return a mechanism whose driver follows another function of time."""
    joints = tuple(
        msgspec.structs.replace(joint, rows=tuple(msgspec.structs.replace(row, value=value) for row in joint.rows))
        if joint.name == name
        else joint
        for joint in mechanism.joints
    )
    return msgspec.structs.replace(mechanism, joints=joints)
