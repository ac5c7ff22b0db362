"""Keys of a file's tables as keyword arguments of the builder; a test compares them with `sections`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Literal, TypedDict

#: A number or a formula; several of them, as a list, a tuple or an array; a point: its name or its coordinates.
Scalar = float | str
Vector = Iterable[Any]
Point = str | Iterable[Any]


class MechanismKeys(TypedDict, total=False):
    """Keys of ``[mechanism]`` besides its name."""

    title: str
    source: str
    author: str
    revision: str
    remarks: Iterable[str]
    space: Literal["planar", "spatial"]
    gravity: Vector
    restitution_law: Literal["newton", "poisson"]
    shape: Mapping[str, Any] | Iterable[Mapping[str, Any]]


class RunKeys(TypedDict, total=False):
    """Keys of ``[run]``, times in seconds."""

    integrator: str
    until: float
    step: float
    output_step: float
    max_step: float
    predictable_until: float
    verify: bool


class LimitKeys(TypedDict, total=False):
    """Limits of ``[parameters.NAME]`` and ``[outputs.NAME]``."""

    smallest: Scalar
    largest: Scalar


class TableKeys(TypedDict, total=False):
    """Keys of ``[tables.NAME]`` besides its points."""

    interpolation: Literal["linear", "cubic", "pchip"]
    periodic: bool


class BodyKeys(TypedDict, total=False):
    """Keys of ``[bodies.NAME]``, in the plane and in space."""

    type: Literal["rigid", "point", "modal"]
    mass: Scalar
    inertia: Scalar | Vector
    inertia_at: Point
    inertia_axes: Mapping[str, Any]
    centre_of_mass: Vector
    points: Mapping[str, Vector]
    position: Vector
    angle: Scalar
    orientation: Mapping[str, Any]
    velocity: Vector
    angular_velocity: Scalar | Vector
    file: str
    damping: Scalar
    start: Mapping[str, Scalar]
    hold: bool | str | Iterable[str]
    shape: Mapping[str, Any] | Iterable[Mapping[str, Any]]


class EventKeys(TypedDict, total=False):
    """Keys of ``[events.NAME]``."""

    when: str
    direction: Literal["rising", "falling", "any"]
    action: Literal["record", "stop", "reset"]
    reset: Mapping[str, Scalar]


class JointKeys(TypedDict, total=False):
    """Keys that most kinds of joints have; each kind adds its own."""

    between: Iterable[str]
    at: Point
    axis: Vector
    start: Mapping[str, Scalar]
    cut: bool


class ForceKeys(TypedDict, total=False):
    """Keys that most kinds of forces have; each kind adds its own."""

    between: Iterable[str]
    body: str
    at: Point
