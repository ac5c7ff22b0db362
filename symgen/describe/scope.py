"""What a joint or force kind may ask while it is resolved: bodies, points, directions, formulas."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping

import msgspec

from symgen.describe.evaluate import evaluate
from symgen.describe.mechanism import Body, Joint
from symgen.describe.names import quoted
from symgen.describe.parser import Names, parse
from symgen.errors import InputError, nearest
from symgen.vocabulary.expressions import ZERO, Expr, Number, call
from symgen.vocabulary.measures import GROUND, Direction, Marker

#: The name by which a file means a body's centre of mass.
CENTRE = "centre"


class Model(msgspec.Struct, frozen=True):
    """What is known of the mechanism when joints and forces are resolved."""

    source: str
    values: Mapping[str, float]  # parameters with their defaults
    tables: tuple[str, ...]
    bodies: Mapping[str, Body]
    joint: Callable[[str, str], Joint]  # (name, where) -> the joint, resolved if it was not yet

    @property
    def coordinates(self) -> dict[str, tuple[str, ...]]:
        """Body -> coordinates and velocities that formulas may use."""
        return {name: body.coordinates + body.speeds for name, body in self.bodies.items()}


class Scope:
    """One joint or force being resolved; every method raises `InputError` naming the file and the key.

    Parameters
    ----------
    model : Model
        The mechanism so far.
    path : str
        The table being read, e.g. ``"joints.A"``.
    name : str
        Name of the joint or force.
    kind : str
        Its type.
    """

    def __init__(self, model: Model, path: str, name: str = "", kind: str = "") -> None:
        self.model, self.path, self.name, self.kind = model, path, name, kind

    def where(self, key: str) -> str:
        """Return file and key for a message."""
        return f"{self.model.source}: {self.path}.{key}" if key else f"{self.model.source}: {self.path}"

    def error(self, key: str, expected: str, got: str, hint: str = "") -> InputError:
        """Return the error to raise about `key`."""
        return InputError(self.where(key), expected, got, hint)

    # Bodies, points, directions ------------------------------------------------------------------------------------

    def body(self, key: str, name: str, *, turns: bool = False, ground: bool = True) -> str:
        """Return `name` if there is such a body; `turns`: it must have an angle, `ground`: it may be the ground."""
        if name == GROUND:
            if not ground:
                raise self.error(key, "a body that moves", f"'{GROUND}'")
            return name
        if name not in self.model.bodies:
            known = [*self.model.bodies, GROUND] if ground else list(self.model.bodies)
            raise self.error(key, "the name of a body", f"the unknown body {quoted(name)}", nearest(name, known))
        if turns and self.model.bodies[name].is_point:
            raise self.error(key, f"a body with an angle for '{self.kind}'", f"the point mass '{name}'")
        return name

    def turns(self, name: str) -> bool:
        """Whether the body has an angle (the ground's is 0)."""
        return name == GROUND or not self.model.bodies[name].is_point

    def pair(self, key: str, names: tuple[str, str], *, turns: tuple[bool, bool] = (False, False)) -> tuple[str, str]:
        """Return two different bodies, so that at least one of them moves."""
        a, b = (self.body(key, name, turns=turn) for name, turn in zip(names, turns, strict=True))
        if a == b:
            raise self.error(key, "two different bodies", f"'{a}' twice")
        return a, b

    def marker(self, key: str, body: str, point: str | tuple[float | str, float | str]) -> Marker:
        """Return the point of `body` that is given by name, as ``"centre"`` or by coordinates."""
        if not isinstance(point, str):
            return self._free_marker(key, body, self.vector(key, point))
        if body == GROUND:
            raise self.error(key, "coordinates [x, y] of a point of the ground", quoted(point))
        known = dict(self.model.bodies[body].points)
        if point == CENTRE:
            return Marker(body, self.model.bodies[body].centre_of_mass)
        if point not in known:
            got = f"{quoted(point)}, which is no point of '{body}'"
            raise self.error(key, "the name of a point", got, nearest(point, [*known, CENTRE]))
        return Marker(body, known[point])

    def _free_marker(self, key: str, body: str, point: tuple[Expr, Expr]) -> Marker:
        if not self.turns(body) and point != (ZERO, ZERO):
            raise self.error(key, f"'{CENTRE}' or [0, 0], the one point of the point mass '{body}'", "another point")
        return Marker(body, point)

    def axis(self, key: str, body: str, vector: tuple[float | str, float | str]) -> tuple[Direction, Direction]:
        """Return the direction fixed in `body` and its left-hand normal, both of length 1."""
        x, y = self.vector(key, vector)
        length = call("sqrt", call("add", call("mul", x, x), call("mul", y, y)))
        if not self.value(length, key) > 0:
            raise self.error(key, "a direction", "a vector of length 0")
        if isinstance(x, Number) and isinstance(y, Number):
            size = math.hypot(x.value, y.value)
            x, y = Number(x.value / size), Number(y.value / size)
        else:
            x, y = call("div", x, length), call("div", y, length)
        return Direction(body, (x, y)), Direction(body, (call("neg", y), x))

    def joint(self, key: str, name: str) -> Joint:
        """Return another joint of the mechanism."""
        return self.model.joint(name, self.where(key))

    # Formulas ------------------------------------------------------------------------------------------------------

    def constant(self, key: str, value: float | str, *, positive: bool = False, or_zero: bool = False) -> Expr:
        """Return a number or an expression of parameters that is finite with their defaults.

        With `positive` it must be above 0; with `or_zero` besides it may be the number 0 itself, no expression.
        """
        names = Names(
            "a number or an expression of parameters",
            _same(self.model.values),
            elsewhere=frozenset({"t", *self.model.tables}),
        )
        expression = self._expression(key, value, names)
        size = self.value(expression, key)
        if positive and not size > 0 and not (or_zero and expression == ZERO):
            raise self.error(key, "a value above 0", repr(size))
        return expression

    def vector(self, key: str, pair: tuple[float | str, float | str]) -> tuple[Expr, Expr]:
        """Return two numbers or expressions of parameters."""
        return self.constant(key, pair[0]), self.constant(key, pair[1])

    def optional(self, key: str, value: float | str | None) -> Expr | None:
        """Return as `constant` does, None for None."""
        return None if value is None else self.constant(key, value)

    def of_time(self, key: str, value: float | str) -> Expr:
        """Return a number or an expression of t and parameters, without tables: it must have two derivatives."""
        what = "a number or an expression of t and parameters"
        names = Names(what, _same(self.model.values, "t"), elsewhere=frozenset(self.model.tables))
        return self._expression(key, value, names)

    def of_state(self, key: str, value: float | str, words: Mapping[str, str] | None = None) -> Expr:
        """Return a number or an expression of t, parameters, body coordinates and the element's own words.

        Coordinates are those of the centre of mass, as in results.
        """
        own = self._own(key, value, words)
        listed = "".join(f", {word}" for word in own)
        what = f"a number or an expression of t{listed}, parameters and body coordinates"
        plain = _same(self.model.values, "t") | own
        return self._expression(key, value, Names(what, plain, self.model.coordinates, self.model.tables))

    def potential(self, key: str, value: float | str, words: Mapping[str, str]) -> Expr:
        """Return an expression of parameters and the element's own coordinate."""
        own = self._own(key, value, words)
        what = f"an expression of parameters and {', '.join(own)}"
        plain = _same(self.model.values) | own
        return self._expression(key, value, Names(what, plain, elsewhere=frozenset({"t", *self.model.tables})))

    def value(self, expression: Expr, key: str) -> float:
        """Return the number with the parameters' defaults."""
        return evaluate(expression, self.model.values, self.where(key))

    def _own(self, key: str, value: float | str, words: Mapping[str, str] | None) -> dict[str, str]:
        """Return the element's own words, refusing a formula in which one of them could also mean a parameter."""
        own = dict(words or {})
        for word in own:
            if word in self.model.values and isinstance(value, str) and _mentions(value, word):
                got = f"'{word}', which is a parameter too"
                raise self.error(key, f"'{word}' to mean the element's own", got, "rename the parameter")
        return own

    def _expression(self, key: str, value: float | str, names: Names) -> Expr:
        if isinstance(value, str):
            return parse(value, names, self.where(key))
        if not math.isfinite(value):
            raise self.error(key, "a finite number", str(value))
        return Number(float(value))


def _same(values: Mapping[str, float], *more: str) -> dict[str, str]:
    return {name: name for name in (*values, *more)}


def _mentions(text: str, word: str) -> bool:
    return re.search(rf"(?<![A-Za-z0-9_.]){word}(?![A-Za-z0-9_])", text) is not None
