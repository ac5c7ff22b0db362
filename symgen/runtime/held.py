"""What a start keeps at values of its own, by index, and what is said where that cannot be."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

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
    """One thing that is held: what it is called, how it is asked of a start, and its value in a state."""

    name: str
    unit: str
    value: float
    add: Callable[[Held, float], Held]
    read: Callable[[Attempt], float]


def _position_items(held: Held, info: ModelInfo, q: Array) -> list[_Item]:
    def coordinate(i: int, value: float) -> _Item:
        def add(h: Held, x: float) -> Held:
            return replace(h, coordinates={**h.coordinates, i: x})

        return _Item(info.coordinates[i].name, info.coordinates[i].unit, value, add, lambda a: float(a.y[i]))

    def joint(k: int, value: float) -> _Item:
        def add(h: Held, x: float) -> Held:
            return replace(h, joints={**h.joints, k: x})

        quantity = info.joint_coordinates[k]
        return _Item(quantity.name, quantity.unit, value, add, lambda a: float(a.joints[2 * k]))

    def orientation(first: int, columns: tuple[int, ...]) -> _Item:
        described = q[first : first + 4] / np.linalg.norm(q[first : first + 4])

        def angle(a: Attempt) -> float:  # of the turn from the described one
            here = a.y[first : first + 4] / np.linalg.norm(a.y[first : first + 4])
            return 2.0 * math.acos(min(1.0, abs(float(described @ here))))

        name = info.coordinates[first].name.partition(".")[0]
        return _Item(f"{name}.orientation", "rad", 0.0, lambda h, _: replace(h, fixed=(*h.fixed, *columns)), angle)

    turned = {j: first for first, at in info.spins for j in range(at, at + 3)}
    found = [coordinate(i, float(q[i])) for i in range(info.nq) if _is_fixed(i, held, info)]
    for first, at in info.spins:
        columns = tuple(j for j in held.fixed if turned.get(j) == first)
        if columns:
            found.append(orientation(first, tuple(range(at, at + 3))))
    found += [coordinate(i, x) for i, x in held.coordinates.items()]
    return found + [joint(k, x) for k, x in held.joints.items()]


def _is_fixed(i: int, held: Held, info: ModelInfo) -> bool:
    euler = any(first <= i < first + 4 for first, _ in info.spins)
    return not euler and i not in held.coordinates and velocity_of(i, info) in held.fixed


def _velocity_items(held: Held, info: ModelInfo) -> list[_Item]:
    def velocity(j: int, value: float) -> _Item:
        def add(h: Held, x: float) -> Held:
            return replace(h, velocities={**h.velocities, j: x})

        return _Item(info.velocities[j].name, info.velocities[j].unit, value, add, lambda a: float(a.y[info.nq + j]))

    def rate(k: int, value: float) -> _Item:
        def add(h: Held, x: float) -> Held:
            return replace(h, rates={**h.rates, k: x})

        quantity = info.joint_coordinates[k]
        return _Item(f"{quantity.name}.rate", f"{quantity.unit}/s", value, add, lambda a: float(a.joints[2 * k + 1]))

    return [velocity(j, x) for j, x in held.velocities.items()] + [rate(k, x) for k, x in held.rates.items()]


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
    items = _position_items(held, info, q) if positions else _velocity_items(held, info)
    before = attempt(base)
    if before.code != e.ASSEMBLED:
        return None  # without anything held it is no better
    for n, item in enumerate(items):
        here = attempt(item.add(base, item.value))
        if here.code == e.ASSEMBLED:
            base, before = item.add(base, item.value), here
            continue
        reached = _nearest(item, base, before, attempt) if positions else item.read(before)
        beside = ", ".join(_said(other) for other in items[:n])
        short = abs(item.value - reached)
        if item.name.endswith(".orientation"):
            found = f"it is turned by {short:.6g} rad there"
        else:
            verb = "it can be brought to" if positions else "it is"
            found = f"{verb} {reached:.6g} {item.unit}, {short:.3g} {item.unit} away"
        left = open_rows(item.add(base, item.value)) if positions else ()
        rows = ", ".join(f"{name} by {size:.3g} {unit}" for name, unit, size in left[:_TOLD])
        open_by = f"; held all the same, it leaves open {rows}" if rows else ""
        return AssemblyError(
            f"{info.name}: {_said(item)} cannot be held{f' beside {beside}' if beside else ''}: {found}{open_by}"
        )
    return None


def _said(item: _Item) -> str:
    return item.name if item.name.endswith(".orientation") else f"{item.name} = {item.value:.6g} {item.unit}"


def _nearest(item: _Item, base: Held, before: Attempt, attempt: Callable[[Held], Attempt]) -> float:
    """Return the value nearest to the one asked for that a position can be held at, on the way from where it is."""
    first = item.read(before)
    if item.name.endswith(".orientation"):
        return first
    good, bad = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (good + bad)
        here = attempt(item.add(base, first + middle * (item.value - first)))
        good, bad = (middle, bad) if here.code == e.ASSEMBLED else (good, middle)
    return first + good * (item.value - first)
