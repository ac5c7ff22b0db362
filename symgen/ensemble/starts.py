"""Parameters and described starts of many runs at once, evaluated as arrays.

What is undefined for some values (a division by 0, the root of a negative number) is nan there, and only those runs
fail.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.describe.mechanism import Mechanism, SpatialBody
from symgen.describe.orientation import Orientation, matrix, multiply, rotate
from symgen.vocabulary.expressions import Expr, Name, Number

Array = NDArray[np.float64]

#: Function of an expression -> the same on arrays.
_FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    "add": np.add,
    "sub": np.subtract,
    "mul": np.multiply,
    "div": np.divide,
    "pow": np.power,
    "neg": np.negative,
    "sqrt": np.sqrt,
    "exp": np.exp,
    "log": np.log,
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "atan2": np.arctan2,
    "sinh": np.sinh,
    "cosh": np.cosh,
    "tanh": np.tanh,
    "abs": np.abs,
    "sign": np.sign,
    "min": np.minimum,
    "max": np.maximum,
    "lt": lambda a, b: np.asarray(a < b, dtype=np.float64),
    "le": lambda a, b: np.asarray(a <= b, dtype=np.float64),
    "gt": lambda a, b: np.asarray(a > b, dtype=np.float64),
    "ge": lambda a, b: np.asarray(a >= b, dtype=np.float64),
    "and": lambda a, b: np.asarray((a != 0.0) & (b != 0.0), dtype=np.float64),
    "or": lambda a, b: np.asarray((a != 0.0) | (b != 0.0), dtype=np.float64),
    "not": lambda a: np.asarray(a == 0.0, dtype=np.float64),
    "where": lambda condition, yes, no: np.where(condition != 0.0, yes, no),
}


def evaluate_all(expression: Expr, values: Mapping[str, Array]) -> Array:
    """Return an expression's values; nan where it is undefined.

    Parameters
    ----------
    expression : Expr
        A formula of parameters.
    values : mapping of str to Array
        For every name a number or an array of shape (k,).
    """
    if isinstance(expression, Number):
        return np.asarray(expression.value)
    if isinstance(expression, Name):
        return values[expression.name]
    arguments = [evaluate_all(a, values) for a in expression.arguments]
    with np.errstate(all="ignore"):
        found = np.asarray(_FUNCTIONS[expression.function](*arguments), dtype=np.float64)
    # what is undefined stays so, whatever is done with it, unless a choice leaves it aside
    undefined = ~np.isfinite(found)
    for argument in arguments[:1] if expression.function == "where" else arguments:
        undefined = undefined | np.isnan(argument)
    return np.where(undefined, np.nan, found)


@dataclass(frozen=True)
class Rows:
    """What distinguishes the runs of a chunk.

    Attributes
    ----------
    parameters : Array, shape (k, number of parameters)
        Values of the mechanism's parameters.
    q, v : Array, shapes (k, nq), (k, nv)
        Described coordinates, not closed; given velocities, nan where they are to be completed.
    targets : Array, shape (k, h)
        Values of the coordinates that the runs hold.
    """

    parameters: Array
    q: Array
    v: Array
    targets: Array

    def __len__(self) -> int:
        return len(self.parameters)


def make_rows(
    mechanism: Mechanism,
    base: Mapping[str, float],
    varied: Mapping[str, Array],
    held: Mapping[str, int],
    given: Mapping[str, int],
) -> Rows:
    """Return the rows of a chunk.

    Parameters
    ----------
    mechanism : Mechanism
        What is run.
    base : mapping
        Values of all parameters.
    varied : mapping of str to Array, shape (k,)
        Values of all names that vary.
    held, given : mapping of str to int
        Coordinates that vary, in the order of `Rows.targets`, and velocities that vary, each with its index.
    """
    k = len(next(iter(varied.values())))
    values: dict[str, Array] = {name: np.asarray(value, dtype=np.float64) for name, value in base.items()}
    values.update({name: x for name, x in varied.items() if name in base})
    parameters = np.empty((k, len(base)))
    for i, name in enumerate(base):
        parameters[:, i] = values[name]
    q, v, undefined = _described(mechanism, values, k)
    for name, column in given.items():
        v[:, column] = varied[name]
    q[undefined] = np.nan
    targets = np.column_stack([varied[name] for name in held]) if held else np.zeros((k, 0))
    return Rows(parameters, q, v, np.ascontiguousarray(targets))


def _described(mechanism: Mechanism, values: Mapping[str, Array], k: int) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Return q and v as described, as `symgen.api.Model.initial_state` does for one run, and undefined rows."""
    q: list[Any] = []
    v: list[Array | None] = []

    def value(e: Expr) -> Any:
        return evaluate_all(e, values)

    for body in mechanism.bodies:
        position = [value(e) for e in body.position]
        centre = [value(e) for e in body.centre_of_mass]
        v += [None if e is None else value(e) for e in body.velocity]
        with np.errstate(all="ignore"):
            if isinstance(body, SpatialBody):
                e = _orientation(body.orientation, value)
                q += [x + dx for x, dx in zip(position, rotate(matrix(e), tuple(centre)), strict=True)]
                if not body.is_point:
                    q += e
                    v += [None if x is None else value(x) for x in body.angular_velocity]
                continue
            angle = value(body.angle)
            c, s = np.cos(angle), np.sin(angle)
            q += [position[0] + c * centre[0] - s * centre[1], position[1] + s * centre[0] + c * centre[1]]
        if not body.is_point:
            q.append(angle)
            omega = body.angular_velocity
            v.append(None if omega is None else value(omega))
    coordinates = np.empty((k, len(q)))
    velocities = np.full((k, len(v)), np.nan)
    undefined = np.zeros(k, dtype=np.bool_)
    for i, x in enumerate(q):
        coordinates[:, i] = x
    for i, y in enumerate(v):
        if y is not None:
            velocities[:, i] = y
            undefined |= ~np.isfinite(velocities[:, i])
    return coordinates, velocities, undefined


def _orientation(orientation: Orientation, value: Callable[[Expr], Any]) -> Any:
    """Return Euler parameters as arrays, as `symgen.describe.orientation.euler_parameters` does for numbers."""
    x = [value(e) for e in orientation.values]
    if orientation.kind == "quaternion":
        length = np.sqrt(sum(e * e for e in x))
        return x[0] / length, x[1] / length, x[2] / length, x[3] / length
    if orientation.kind == "rotation-vector":
        angle = np.sqrt(sum(e * e for e in x))
        safe = np.where(angle > 0.0, angle, 1.0)
        factor = np.where(angle > 0.0, np.sin(angle / 2.0) / safe, 0.5)
        return np.cos(angle / 2.0), factor * x[0], factor * x[1], factor * x[2]
    if orientation.kind == "euler-angles":
        result: Any = (1.0, 0.0, 0.0, 0.0)
        for axis, angle in zip(orientation.convention, x, strict=True):
            turn: list[Any] = [np.cos(angle / 2.0), 0.0, 0.0, 0.0]
            turn["xyz".index(axis) + 1] = np.sin(angle / 2.0)
            result = multiply(result, (turn[0], turn[1], turn[2], turn[3]))
        return result
    if orientation.kind == "line":
        along, towards = [x[3] - x[0], x[4] - x[1], x[5] - x[2]], x[6:9]
    else:
        along, towards = x[0:3], x[3:6]
    length = np.sqrt(sum(e * e for e in along))
    a = [e / length for e in along]
    part = sum(e * f for e, f in zip(a, towards, strict=True))
    b = [f - part * e for e, f in zip(a, towards, strict=True)]
    rest = np.sqrt(sum(e * e for e in b))
    # parallel directions say nothing: nan
    rest = np.where(rest > 1e-9 * np.sqrt(sum(e * e for e in towards)), rest, np.nan)
    b = [e / rest for e in b]
    c = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    return _from_axes(a, b, c)


def _from_axes(a: list[Any], b: list[Any], c: list[Any]) -> tuple[Array, ...]:
    """Return the Euler parameters of the matrix with these columns, from its largest diagonal term."""
    ax, ay, az, bx, by, bz, cx, cy, cz = np.broadcast_arrays(*a, *b, *c)
    rows = np.array(
        [
            [1.0 + ax + by + cz, bz - cy, cx - az, ay - bx],
            [bz - cy, 1.0 + ax - by - cz, bx + ay, cx + az],
            [cx - az, bx + ay, 1.0 - ax + by - cz, bz + cy],
            [ay - bx, cx + az, bz + cy, 1.0 - ax - by + cz],
        ]
    )
    chosen = np.argmax(np.array([rows[i, i] for i in range(4)]), axis=0)
    row = np.take_along_axis(rows, np.broadcast_to(chosen, (1, 4, *chosen.shape)), axis=0)[0]
    row = row / np.sqrt(np.sum(row * row, axis=0)) * np.where(row[0] < 0.0, -1.0, 1.0)
    return row[0], row[1], row[2], row[3]
