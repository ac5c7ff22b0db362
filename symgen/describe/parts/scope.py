"""Bodies, points, directions and formulas that a kind resolves in the mechanism read so far."""

from __future__ import annotations

import math
import re
from collections import ChainMap
from collections.abc import Mapping, Sequence

from symgen.base.errors import InputError, quote, suggest
from symgen.base.units import read_amount
from symgen.base.vocabulary.expressions import (
    ZERO,
    Expr,
    Number,
    call,
    moving_quantities,
    readings_in,
    scalar_product_of,
)
from symgen.base.vocabulary.measures import GROUND, Direction, Marker, Measure
from symgen.describe.coordinate_names import ACCELERATIONS
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.formulas.parser import FormulaNames, parse
from symgen.describe.formulas.readings import OUTPUT, Readings
from symgen.describe.mechanism import Joint, Vec
from symgen.describe.parts.context import Context
from symgen.describe.parts.fields import value_in_words
from symgen.describe.parts.key_units import unit_of_number
from symgen.describe.parts.meant_words import hint_on_body, hint_on_vector

#: The name by which a file means a body's centre of mass.
CENTRE = "centre"
#: The name of the origin of a body's frame, unless the body has a point of that name.
ORIGIN = "origin"
#: Entries of a symmetric matrix that differ by less than this part of the largest of theirs and their diagonal are one.
ROUNDING = 1e-12


class Scope:
    """One joint or force being resolved; every method raises `InputError` naming the file and the key.

    Parameters
    ----------
    context : Context
        The mechanism so far.
    path : str
        The table being read, e.g. ``"joints.A"``.
    name : str
        Name of the joint or force.
    kind : str
        Its type.
    """

    def __init__(self, context: Context, path: str, name: str = "", kind: str = "") -> None:
        self.context, self.path, self.name, self.kind = context, path, name, kind
        #: Coordinates of the joint with their units, once it is resolved.
        self.coordinates: Mapping[str, str] = {}

    @property
    def spatial(self) -> bool:
        """Whether the mechanism is spatial."""
        return self.context.space == "spatial"

    @property
    def dimension(self) -> int:
        """Number of components of a point."""
        return 3 if self.spatial else 2

    def check_space(self, spaces: tuple[str, ...]) -> None:
        """Refuse a kind that does not exist in this mechanism's space."""
        if self.context.space not in spaces:
            raise self.error(
                "type", f"a type for {self.context.space} mechanisms", f"'{self.kind}', which is {spaces[0]}"
            )

    def only(self, *keys: str, **values: object) -> None:
        """Refuse keys that mean nothing in this mechanism's space, and require `keys` that do."""
        space = "space" if self.spatial else "the plane"
        for key, value in values.items():
            if (value is None) == (key in keys):
                expected = (
                    f"a value, as '{self.kind}' needs it in {space}" if key in keys else f"no such key in {space}"
                )
                raise self.error(key, expected, "no such key" if value is None else value_in_words(value))

    def where(self, key: str) -> str:
        """Return file and key for a message."""
        return f"{self.context.source}: {self.path}.{key}" if key else f"{self.context.source}: {self.path}"

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
        if name not in self.context.bodies:
            names = [*self.context.bodies, GROUND] if ground else list(self.context.bodies)
            raise self.error(key, "the name of a body", f"the unknown body {quote(name)}", hint_on_body(name, names))
        if turns and self.context.bodies[name].is_point:
            raise self.error(key, f"a body with an angle for '{self.kind}'", f"the point mass '{name}'")
        return name

    def turns(self, name: str) -> bool:
        """Whether the body has an angle (the ground's is 0)."""
        return name == GROUND or not self.context.bodies[name].is_point

    def pair(self, key: str, names: tuple[str, str], *, turns: tuple[bool, bool] = (False, False)) -> tuple[str, str]:
        """Return two different bodies, so that at least one moves."""
        a, b = (self.body(key, name, turns=turn) for name, turn in zip(names, turns, strict=True))
        if a == b:
            raise self.error(key, "two different bodies", f"'{a}' twice")
        return a, b

    def marker(self, key: str, body: str, point: str | tuple[float | str, ...]) -> Marker:
        """Return a point of `body` from its name, ``"centre"``, ``"origin"`` or its coordinates."""
        if not isinstance(point, str):
            return self._free_marker(key, body, self.vector(key, point))
        if body == GROUND:
            listed = "[x, y, z]" if self.spatial else "[x, y]"
            raise self.error(key, f"coordinates {listed} of a point of the ground", quote(point))
        points = self.context.points[body]
        if point == CENTRE:
            return Marker(body, self.context.bodies[body].centre_of_mass)
        if point == ORIGIN and point not in points:
            return Marker(body, (ZERO,) * self.dimension)
        if point not in points:
            got = f"{quote(point)}, which is no point of '{body}'"
            raise self.error(key, "the name of a point", got, suggest(point, [*points, CENTRE, ORIGIN]))
        return Marker(body, points[point])

    def _free_marker(self, key: str, body: str, point: Vec) -> Marker:
        if not self.turns(body) and any(e != ZERO for e in point):
            origin = "[0, 0, 0]" if self.spatial else "[0, 0]"
            expected = f"'{CENTRE}' or {origin}, the one point of the point mass '{body}'"
            raise self.error(key, expected, "another point")
        return Marker(body, point)

    def axis(
        self, key: str, body: str, vector: tuple[float | str | tuple[float | str, ...], ...]
    ) -> tuple[Direction, Direction]:
        """Return the direction in the plane fixed in `body` and its left-hand normal, both of length 1."""
        plain = tuple(e for e in vector if not isinstance(e, tuple))
        if len(plain) < len(vector):
            raise self.error(key, "one direction [x, y]", value_in_words(vector))
        along = self.direction(key, body, plain)
        x, y = along.vector
        return along, Direction(body, (call("neg", y), x))

    def direction(self, key: str, body: str, vector: tuple[float | str, ...]) -> Direction:
        """Return a direction of length 1 fixed in `body`."""
        parts = self.vector(key, vector)
        numbers = [e.value for e in parts if isinstance(e, Number)]
        size = math.hypot(*numbers) if len(numbers) == len(parts) else 0.0
        length = Number(size) if size > 0.0 else call("sqrt", scalar_product_of(parts, parts))
        if not self.value(length, key) > 0:
            raise self.error(key, "a direction", "a vector of length 0")
        return Direction(body, tuple(call("div", e, length) for e in parts))

    def joint(self, key: str, name: str) -> Joint:
        """Return another joint of the mechanism."""
        return self.context.joint(name, self.where(key))

    def joint_coordinate(
        self, name: str, label: str | None, keys: tuple[str, str] = ("joint", "coordinate"), unit: str = ""
    ) -> tuple[Joint, str, Measure]:
        """Return a joint, and label and measure of one of its coordinates: by default the only one.

        With `unit` (``"rad"`` or ``"m"``) coordinates of the other unit are ignored.
        """
        joint = self.joint(keys[0], name)
        coordinates = {n: m for n, m in joint.coordinates if unit in ("", Joint.unit(n))}
        what = {"": "a coordinate", "rad": "an angle", "m": "a displacement"}[unit]
        if not coordinates:
            raise self.error(keys[0], f"a joint that has {what}", f"'{name}', a {joint.kind} joint without")
        if label is None:
            if len(coordinates) > 1:
                raise self.error(keys[1], f"one of {', '.join(coordinates)}", "no such key")
            label = next(iter(coordinates))
        if label not in coordinates:
            raise self.error(keys[1], f"{what} of joint '{name}'", quote(label), suggest(label, coordinates))
        return joint, label, coordinates[label]

    # Formulas ------------------------------------------------------------------------------------------------------

    def constant(self, key: str, value: float | str, *, positive: bool = False, or_zero: bool = False) -> Expr:
        """Return a number or an expression of parameters that is finite with their defaults.

        With `positive` it must be above 0; with `or_zero` as well, it may be the number 0, but not an expression.
        """
        expression = self._parse_expression(key, value, self.context.constants)
        size = self.value(expression, key)
        if positive and not size > 0 and not (or_zero and expression == ZERO):
            raise self.error(key, "a value above 0", repr(size))
        return expression

    def vector(self, key: str, components: tuple[float | str, ...]) -> Vec:
        """Return two numbers or expressions of parameters, in space three."""
        if len(components) != self.dimension:
            what = "three numbers or expressions of parameters [x, y, z]"
            raise self.error(
                key,
                what if self.spatial else "two numbers or expressions of parameters [x, y]",
                value_in_words(components),
                hint_on_vector(components, self.dimension),
            )
        return tuple(self.constant(key, e) for e in components)

    def several(
        self,
        key: str,
        value: float | str | tuple[float | str, ...],
        count: int,
        *,
        alike: bool = False,
        positive: bool = False,
    ) -> Vec:
        """Return `count` numbers or expressions of parameters; with `alike` a single one counts for each."""
        parts = value if isinstance(value, tuple) else (value,) * (count if alike else 1)
        if len(parts) != count:
            expected = f"{count} numbers or expressions of parameters" if count > 1 else "one number or expression"
            raise self.error(key, expected, value_in_words(value))
        return tuple(self.constant(key, part, positive=positive) for part in parts)

    def optional(self, key: str, value: float | str | None) -> Expr | None:
        """Return as `constant` does, None for None."""
        return None if value is None else self.constant(key, value)

    def of_time(self, key: str, value: float | str) -> Expr:
        """Return a number or an expression of t and parameters, with smooth tables: it must have two derivatives."""
        return self._parse_expression(key, value, self.context.times)

    def of_row(self, key: str, value: float | str, speeds: bool, inputs: bool = False, *, moves: bool = True) -> Expr:
        """Return an expression of t, parameters and positions, and with `speeds` velocities, with smooth tables.

        It is differentiated twice, so Euler parameters are excluded, and inputs unless `inputs` says otherwise. With
        `moves` something in it has to move.
        """
        own = {name: name for name in self.context.inputs} if inputs else {}
        times, what = self.context.times, "positions and velocities" if speeds else "positions"
        coordinates = {
            name: tuple(c for c in (*body.coordinates, *(body.speeds if speeds else ())) if c[0] != "e")
            for name, body in self.context.bodies.items()
        }
        names = FormulaNames(
            f"an expression of t, parameters and {what}",
            *({**times.plain, **own}, coordinates, times.tables, frozenset(times.elsewhere) - own.keys()),
            readings=Readings(self.context),
            hints=times.hints,
        )
        expression = self._parse_expression(key, value, names)
        for reading in readings_in(expression):
            if reading.order and not speeds:
                raise self.error(
                    key, names.what, f"'{reading.name}', a velocity", "a row of velocities is { velocity = ... }"
                )
        if moves and not moving_quantities(expression):
            raise self.error(key, names.what, "one in which nothing moves")
        return expression

    def of_state(
        self, key: str, value: float | str, words: Mapping[str, str] | None = None, *, conditions: bool = False
    ) -> Expr:
        """Return a number or an expression of t, parameters, the state and the element's own words.

        Of the state: coordinates of bodies, which are those of the centre of mass, as in results, points of bodies,
        coordinates of joints, and their rates (`symgen.describe.formulas.readings`). With `conditions` it may be true
        or false instead.
        """
        own = self._check_own_words(key, value, words)
        listed = "".join(f", {word}" for word in own)
        kind = "a condition" if conditions else "a number"
        what = f"{kind} or an expression of t{listed}, parameters and body coordinates"
        plain = ChainMap(own, self.context.states)
        names = FormulaNames(
            what,
            plain,
            self.context.coordinates,
            self.context.functions,
            readings=Readings(self.context),
            results=Readings(self.context, OUTPUT),
        )
        return self._parse_expression(key, value, names, conditions)

    def of_motion(self, key: str, value: float | str, *, integrals: bool = True, conditions: bool = False) -> Expr:
        """Return a number or an expression of t, parameters and all quantities available at outputs.

        With `conditions` it may be true or false instead.
        """
        kind = "a condition" if conditions else "a number"
        what = f"{kind} or an expression of t, parameters and what is known of the motion"
        own = {
            name: (*coordinates, *(ACCELERATIONS[speed] for speed in self.context.bodies[name].speeds))
            for name, coordinates in self.context.coordinates.items()
        }
        readings = Readings(self.context, OUTPUT)
        plain, tables = self.context.states, self.context.functions
        names = FormulaNames(what, plain, own, tables, readings=readings, integrals=integrals)
        return self._parse_expression(key, value, names, conditions)

    def potential(self, key: str, value: float | str, words: Mapping[str, str]) -> Expr:
        """Return an expression of parameters and the element's own coordinate."""
        own = self._check_own_words(key, value, words)
        what = f"an expression of parameters and {', '.join(own)}"
        plain = ChainMap(own, self.context.constants.plain)  # type: ignore[arg-type]  # the second one is only read
        return self._parse_expression(key, value, self.context.constants.with_other_names(what, plain))

    def of_curve(self, key: str, value: float | str, word: str) -> Expr:
        """Return an expression of a curve's own coordinate and smooth tables, from which its shape is read."""
        smooth = self.context.times
        others = smooth.elsewhere | self.context.values.keys() | {"t"}
        hints = dict.fromkeys(others, "arcs along the curve are chosen as the file is read")
        what = f"a number or an expression of {word} and smooth tables"
        names = FormulaNames(what, {word: word}, tables=smooth.tables, elsewhere=frozenset(others), hints=hints)
        return self._parse_expression(key, value, names)

    def symmetric(self, key: str, rows: Sequence[Sequence[float | str]]) -> tuple[tuple[Expr, ...], ...]:
        """Return the rows of a matrix; of two entries that differ by rounding the upper one counts.

        Raises
        ------
        InputError
            If the matrix is not symmetric.
        """
        matrix = [[self.constant(key, e) for e in row] for row in rows]
        values = [[self.value(e, key) for e in row] for row in matrix]
        for i, row in enumerate(values):
            for j in range(i):
                if abs(row[j] - values[j][i]) > ROUNDING * max(abs(row[j]), abs(row[i]), abs(values[j][j])):
                    got = f"different entries {i + 1}{j + 1} and {j + 1}{i + 1}"
                    raise self.error(key, "a symmetric matrix", got)
                matrix[i][j] = matrix[j][i]
        return tuple(map(tuple, matrix))

    def value(self, expression: Expr, key: str) -> float:
        """Return the number with the parameters' defaults."""
        return evaluate_formula(expression, self.context.values, self.where(key))

    def _check_own_words(self, key: str, value: float | str, words: Mapping[str, str] | None) -> dict[str, str]:
        """Return the element's own words, refusing a formula in which one of them could also mean a parameter."""
        own = dict(words or {})
        for word in own:
            if word in self.context.states and isinstance(value, str) and _mentions_word(value, word):
                kinds = {"input": self.context.inputs, "state": self.context.state_names}
                what = next((kind for kind, names in kinds.items() if word in names), "parameter")
                got = f"'{word}', which is {'an' if what == 'input' else 'a'} {what} too"
                raise self.error(key, f"'{word}' to mean the element's own", got, f"rename the {what}")
        return own

    def _parse_expression(self, key: str, value: float | str, names: FormulaNames, conditions: bool = False) -> Expr:
        if isinstance(value, str):
            amount = read_amount(value)
            if amount is not None and amount.unit and amount.unit not in names.plain:
                quantity = unit_of_number(self.path, key, self.kind, self.coordinates)
                return Number(amount.in_si(self.where(key), quantity))
            return parse(value, names, self.where(key), conditions)
        if not math.isfinite(value):
            raise self.error(key, "a finite number", str(value))
        return Number(float(value))


def _mentions_word(text: str, word: str) -> bool:
    return re.search(rf"(?<![A-Za-z0-9_.]){word}(?![A-Za-z0-9_])", text) is not None
