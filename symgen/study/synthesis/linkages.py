"""A four-bar linkage: its pins, its file, and its own run, which shows what it passes."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import AssemblyError, InputError
from symgen.describe.edits.snippet_tables import (
    EditedFile,
    Table,
    exact_number,
    insert_tables,
    table_at,
    uniform_body,
    vector_text,
)
from symgen.describe.edits.text_changes import apply_changes
from symgen.describe.facts.lifted import numbers_as_parameters
from symgen.describe.files.load import parse_toml
from symgen.describe.files.places import outline_of_document
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism

if TYPE_CHECKING:
    from symgen import Model

Array = NDArray[np.float64]
Point = tuple[float, float]

#: Times at which a linkage is looked at between the places of its task.
LOOKED_AT = 181
#: Gravity of a new file, and its last time [s].
_HEADER = '[mechanism]\nname = "linkage"\ngravity = [0.0, -9.81]\n\n[run]\nuntil = 1.0\n\n'
_SOURCE = "linkage"


class _Motor(NamedTuple):
    """A law of the crank: a parameter, its unit, and how far the crank has turned [rad]."""

    parameter: str
    unit: str
    law: str


#: A crank that turns round goes on; another one swings through the task and back, one second each way.
_STEADY, _SWINGING = _Motor("crank_speed", "rad/s", "{}*t"), _Motor("swing", "rad", "{}*(1 - cos(pi*t))/2")
_TURNS_ROUND = ("crank-rocker", "double-crank")


class Pins(NamedTuple):
    """Pins of a four-bar linkage at the start [m].

    Attributes
    ----------
    crank_pivot, rocker_pivot : tuple of float
        Pins on the ground.
    crank_pin, rocker_pin : tuple of float
        Pins of the coupler.
    tip : tuple of float
        The point of the coupler that passes the places of the task.
    """

    crank_pivot: Point
    rocker_pivot: Point
    crank_pin: Point
    rocker_pin: Point
    tip: Point

    @property
    def kind(self) -> str:
        """The kind by Grashof's rule, such as ``crank-rocker``: the driven bar first."""
        crank, coupler = math.dist(self.crank_pivot, self.crank_pin), math.dist(self.crank_pin, self.rocker_pin)
        rocker, ground = math.dist(self.rocker_pin, self.rocker_pivot), math.dist(self.crank_pivot, self.rocker_pivot)
        lengths = sorted((crank, coupler, rocker, ground))
        if lengths[0] + lengths[3] >= lengths[1] + lengths[2]:
            return "triple-rocker"
        kinds = {crank: "crank-rocker", rocker: "rocker-crank", ground: "double-crank", coupler: "double-rocker"}
        return kinds[lengths[0]]


@dataclass(frozen=True)
class Linkage:
    """A linkage that was found, as its own run showed it.

    Attributes
    ----------
    pins : Pins
        Its pins at the start.
    angle : float
        Angle of the coupler at the start [rad].
    turn : float
        How far its crank turns from the first place to the last one [rad].
    times : Array, shape (n,)
        When it passes the places of the task, in parts of the motion.
    transmission : float
        The smallest transmission angle between coupler and rocker [rad], 90 degrees being best.
    deviation : float
        The largest distance of the tip from a place [m].
    turned_off : float
        The largest angle from one that was asked for [rad]; 0 for a path.
    text : str
        Its file, which moves through the task in one second.
    """

    pins: Pins
    angle: float
    turn: float
    times: Array = field(repr=False)
    transmission: float
    deviation: float
    turned_off: float
    text: str = field(repr=False)

    @property
    def kind(self) -> str:
        """The kind by Grashof's rule, such as ``crank-rocker``."""
        return self.pins.kind

    @property
    def model(self) -> Model:
        """The machine of the file."""
        from symgen import Model

        return Model(validate(parse_toml(self.text, _SOURCE), _SOURCE))

    def add_to_text(self, text: str) -> str:
        """Return the text of a file with the linkage added; names that the file has get numbers.

        Raises
        ------
        InputError
            If the text is no TOML.
        """
        parts = outline_of_document(text)
        file = EditedFile(parse_toml(text, _SOURCE), parts, text, {})
        motor = _STEADY if self.kind in _TURNS_ROUND else _SWINGING
        tables = _tables(self.pins, self.angle, self.turn, motor, file.take_name)
        return apply_changes(text, insert_tables(tables, parts, text))

    def to_json(self) -> dict[str, Any]:
        """Return what is known of it, as ``symgen synthesize --json`` prints it."""
        own = ("kind", "turn", "transmission", "deviation", "turned_off", "text")
        pins = {name: list(point) for name, point in self.pins._asdict().items()}
        return {name: getattr(self, name) for name in own} | {"pins": pins}


def _tables(
    pins: Pins, angle: float, turn: float, motor: _Motor = _STEADY, named: Callable[[str], str] = str
) -> list[Table]:
    crank, coupler, rocker = map(named, ("crank", "coupler", "rocker"))
    pivot, crank_pin, rocker_pin, rocker_pivot = map(named, ("pivot", "crank_pin", "rocker_pin", "rocker_pivot"))
    parameter = named(motor.parameter)

    def pin(name: str, one: str, other: str, at: str) -> Table:
        return table_at(f"joints.{name}", 'type = "revolute"', f'between = ["{one}", "{other}"]', f"at = [{at}]")

    return [
        table_at(f"parameters.{parameter}", f"value = {exact_number(turn)}", f'unit = "{motor.unit}"'),
        uniform_body(crank, {"A": pins.crank_pivot, "B": pins.crank_pin}),
        uniform_body(coupler, {"P": pins.tip, "A": pins.crank_pin, "B": pins.rocker_pin}, angle),
        uniform_body(rocker, {"A": pins.rocker_pivot, "B": pins.rocker_pin}),
        pin(pivot, "ground", crank, f'{vector_text(pins.crank_pivot)}, "A"'),
        pin(crank_pin, crank, coupler, '"B", "A"'),
        pin(rocker_pin, coupler, rocker, '"B", "B"'),
        pin(rocker_pivot, "ground", rocker, f'{vector_text(pins.rocker_pivot)}, "A"'),
        table_at(
            *(f"joints.{named('motor')}", 'type = "driver"', f'joint = "{pivot}"'),
            f'value = "{motor.law.format(parameter)}"',
        ),
    ]


def verify_linkage(pins: Pins, turn: float, times: Array, places: Array, angles: Array | None) -> Linkage | None:
    """Return a linkage with what its own run passes; None where it does not move through the task.

    Parameters
    ----------
    pins, turn, times : Pins, float, Array
        As in `Linkage`.
    places, angles : Array, Array or None
        Of the task.
    """
    from symgen import Model

    angle = 0.0 if angles is None else float(angles[0])
    tables = _tables(pins, angle, turn)
    text = _HEADER + "\n\n".join(table for _, table in tables) + "\n"
    found = Linkage(pins, angle, turn, times, 0.0, 0.0, 0.0, text)
    looked_at = np.union1d(np.linspace(0.0, 1.0, LOOKED_AT), times)
    try:
        code = Model(numbers_as_parameters(found.model.mechanism).mechanism)  # the same one for all linkages
        motion = code.kinematics(looked_at, transmission=["rocker_pin"])
    except (InputError, AssemblyError):
        return None
    if len(motion.t) < len(looked_at):
        return None
    at, mu = np.searchsorted(looked_at, times), np.asarray(motion.transmission)
    tips = np.column_stack([motion["coupler.P.x"], motion["coupler.P.y"]])[at]
    off = 0.0 if angles is None else np.abs(np.exp(1j * (motion["coupler.theta"][at] - angles)) - 1.0).max()
    return Linkage(
        **{name: getattr(found, name) for name in ("pins", "angle", "turn", "times", "text")},
        transmission=float(np.minimum(mu, math.pi - mu).min()),
        deviation=float(np.linalg.norm(tips - places, axis=1).max()),
        turned_off=float(off),
    )


#: Names of the coordinates of `Pins` as parameters.
PLACES = ("px", "py", "qx", "qy", "ax", "ay", "bx", "by", "tx", "ty")


def variable_linkage(parameters: Mapping[str, float | str], motor: str) -> Mechanism:
    """Return a linkage whose pins are parameters.

    Parameters
    ----------
    parameters : mapping
        Numbers and formulas; `PLACES` among them.
    motor : str
        How far the crank has turned at a time from 0 to 1 [rad].
    """
    lengths = {
        "crank_length": "sqrt((ax - px)**2 + (ay - py)**2)",
        "rocker_length": "sqrt((bx - qx)**2 + (by - qy)**2)",
        "coupler_length": "sqrt((bx - ax)**2 + (by - ay)**2)",
    }

    def body(at: str, **points: str) -> dict[str, Any]:
        own = {name: [f"{p}x - {at}x", f"{p}y - {at}y"] for name, p in points.items()}
        return {"mass": 1.0, "inertia": 1.0, "position": [f"{at}x", f"{at}y"], "points": own}

    def pin(a: str, b: str, *at: object) -> dict[str, Any]:
        return {"type": "revolute", "between": [a, b], "at": [*at]}

    raw = {
        "mechanism": {"name": "linkage", "gravity": [0.0, 0.0]},
        "run": {"until": 1.0},
        "parameters": {**parameters, **lengths},
        "bodies": {"crank": body("p", B="a"), "coupler": body("t", A="a", B="b"), "rocker": body("q", B="b")},
        "joints": {
            "pivot": pin("ground", "crank", ["px", "py"], "origin"),
            "crank_pin": pin("crank", "coupler", "B", "A"),
            "rocker_pin": pin("coupler", "rocker", "B", "B"),
            "rocker_pivot": pin("ground", "rocker", ["qx", "qy"], "origin"),
            "motor": {"type": "driver", "joint": "pivot", "value": motor},
        },
    }
    return validate(raw, _SOURCE)


#: The cosine of the angle between coupler and rocker of `variable_linkage`: 0 where forces pass best.
COSINE = "cos(atan2(by - ay, bx - ax) + coupler.theta - atan2(by - qy, bx - qx) - rocker.theta)"


def pins_of_values(values: Mapping[str, float]) -> Pins:
    """Return the pins of values by the names of `PLACES`."""
    x = [values[name] for name in PLACES]
    return Pins(*((a, b) for a, b in zip(x[::2], x[1::2], strict=True)))
