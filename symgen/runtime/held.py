"""What a start keeps at values of its own, by index, and what is said where that cannot be."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.errors import AssemblyError
from symgen.runtime import ensemble_abi as e
from symgen.runtime.model_arrays import velocity_of

if TYPE_CHECKING:
    from symgen.runtime.compiled import ModelInfo

Array = NDArray[np.float64]

#: Halvings by which it is found how far a coordinate can be brought that cannot be held where it is asked for.
_HALVINGS = 24
#: Rows that stay open are told one by one up to so many.
_TOLD = 4


@dataclass(frozen=True)
class Held:
    """What a start keeps while everything else gives way.

    Attributes
    ----------
    coordinates : mapping of int to float
        Values by index in q, Euler parameters excepted. They are reached in small steps from the described start.
    velocities : mapping of int to float
        Values by index in v. They are not projected where they contradict other given ones.
    fixed : tuple of int
        Velocities whose coordinates stay as they are described; for an orientation in space all three of a body.
    joints, rates : mapping of int to float
        Values of joint coordinates and of their rates, by index. Values are reached in small steps as well.
    """

    coordinates: Mapping[int, float] = field(default_factory=dict)
    velocities: Mapping[int, float] = field(default_factory=dict)
    fixed: tuple[int, ...] = ()
    joints: Mapping[int, float] = field(default_factory=dict)
    rates: Mapping[int, float] = field(default_factory=dict)

    @property
    def positions(self) -> bool:
        """Whether anything about positions is held."""
        return bool(self.coordinates or self.fixed or self.joints)

    def told(self, info: ModelInfo) -> str:
        """Return the positions that are held at values of their own, in words."""
        items = [*((info.coordinates[i], x) for i, x in self.coordinates.items())]
        items += [(info.joint_coordinates[k], x) for k, x in self.joints.items()]
        return ", ".join(f"{q.name} = {x:.6g} {q.unit}" for q, x in items)


@dataclass(frozen=True)
class Attempt:
    """A start that was tried with some things held.

    Attributes
    ----------
    code : int
        See `symgen.runtime.ensemble_abi`.
    y : Array
        The state it came to.
    joints : Array, shape (2 n,)
        Joint coordinates and their rates there, in turns.
    """

    code: int
    y: Array
    joints: Array


@dataclass(frozen=True)
class _Item:
    """One thing that is held: what it is called, its value, the field of `Held` it stands in and by what index.

    An orientation has the first of its Euler parameters for an index, and its value is the angle of the turn from the
    described one: 0.
    """

    name: str
    unit: str
    value: float
    field: str
    index: int

    @property
    def turns(self) -> bool:
        """Whether it is an orientation."""
        return self.name.endswith(".orientation")

    @property
    def told(self) -> str:
        """What is held, in words."""
        return self.name if self.turns else f"{self.name} = {self.value:.6g} {self.unit}"

    def beside(self, held: Held, value: float, info: ModelInfo) -> Held:
        """Return what is held, and this at a value."""
        if self.turns:
            at = dict(info.spins)[self.index]
            return replace(held, fixed=(*held.fixed, at, at + 1, at + 2))
        changed: dict[str, Any] = {self.field: {**getattr(held, self.field), self.index: value}}
        return replace(held, **changed)

    def read(self, attempt: Attempt, q: Array, info: ModelInfo) -> float:
        """Return its value in a start that was tried; `q` are the described coordinates."""
        if self.turns:
            described, here = (x[self.index : self.index + 4] for x in (q, attempt.y))
            cosine = abs(float((described / np.linalg.norm(described)) @ (here / np.linalg.norm(here))))
            return 2.0 * math.acos(min(1.0, cosine))
        if self.field in ("joints", "rates"):
            return float(attempt.joints[2 * self.index + (self.field == "rates")])
        return float(attempt.y[self.index + (info.nq if self.field == "velocities" else 0)])


def _items(held: Held, info: ModelInfo, field: str, suffix: str = "", rate: str = "") -> list[_Item]:
    """Return what is held at values of its own in a field of `Held`."""
    names = {"coordinates": info.coordinates, "velocities": info.velocities}.get(field, info.joint_coordinates)
    values: Mapping[int, float] = getattr(held, field)
    return [_Item(names[i].name + suffix, names[i].unit + rate, x, field, i) for i, x in values.items()]


def _position_items(held: Held, info: ModelInfo, q: Array) -> list[_Item]:
    still = Held({i: float(q[i]) for i in range(info.nq) if _is_fixed(i, held, info)})
    turned = [first for first, at in info.spins if {at, at + 1, at + 2} & {*held.fixed}]
    names = ((first, info.coordinates[first].name.partition(".")[0]) for first in turned)
    return [
        *_items(still, info, "coordinates"),
        *(_Item(f"{name}.orientation", "rad", 0.0, "fixed", first) for first, name in names),
        *_items(held, info, "coordinates"),
        *_items(held, info, "joints"),
    ]


def _is_fixed(i: int, held: Held, info: ModelInfo) -> bool:
    euler = any(first <= i < first + 4 for first, _ in info.spins)
    return not euler and i not in held.coordinates and velocity_of(i, info) in held.fixed


def contradiction(
    info: ModelInfo,
    held: Held,
    q: Array,
    attempt: Callable[[Held], Attempt],
    open_rows: Callable[[Held], Sequence[tuple[str, str, float]]],
    code: int,
) -> AssemblyError | None:
    """Return which of the things that are held cannot be, beside which others, and by how much; None if all can.

    Parameters
    ----------
    info : ModelInfo
        The model.
    held : Held
        What no start was found with.
    q : Array, shape (nq,)
        Coordinates as described.
    attempt : callable
        Tries a start with less held.
    open_rows : callable
        Name and unit of rows that stay open where held coordinates are put to their values at once, and by how much.
    code : int
        How the start ended that had all held: `OPEN` or `CONTRADICTION`.
    """
    # things are added one by one; the first that does not fit is told
    positions = code == e.OPEN
    base = Held() if positions else replace(held, velocities={}, rates={})
    rates = [*_items(held, info, "velocities"), *_items(held, info, "rates", ".rate", "/s")]
    items = _position_items(held, info, q) if positions else rates
    before = attempt(base)
    if before.code != e.ASSEMBLED:
        return None  # without anything held it is no better
    for n, item in enumerate(items):
        with_it = item.beside(base, item.value, info)
        here = attempt(with_it)
        if here.code == e.ASSEMBLED:
            base, before = with_it, here
            continue
        reached = item.read(before, q, info)
        reached = _nearest(item, base, reached, attempt, info) if positions else reached
        beside = ", ".join(other.told for other in items[:n])
        short = abs(item.value - reached)
        if item.turns:
            found = f"it is turned by {short:.6g} rad there"
        else:
            verb = "it can be brought to" if positions else "it is"
            found = f"{verb} {reached:.6g} {item.unit}, {short:.3g} {item.unit} away"
        left = open_rows(with_it) if positions else ()
        rows = ", ".join(f"{name} by {size:.3g} {unit}" for name, unit, size in left[:_TOLD])
        open_by = f"; held all the same, it leaves open {rows}" if rows else ""
        return AssemblyError(
            f"{info.name}: {item.told} cannot be held{f' beside {beside}' if beside else ''}: {found}{open_by}"
        )
    return None


def _nearest(item: _Item, base: Held, first: float, attempt: Callable[[Held], Attempt], info: ModelInfo) -> float:
    """Return the value nearest to the one asked for that a position can be held at, on the way from a first one."""
    good, bad = 0.0, 1.0
    for _ in range(_HALVINGS if not item.turns else 0):
        middle = 0.5 * (good + bad)
        here = attempt(item.beside(base, first + middle * (item.value - first), info))
        good, bad = (middle, bad) if here.code == e.ASSEMBLED else (good, middle)
    return first + good * (item.value - first)
