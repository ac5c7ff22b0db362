"""Coupling: a weighted sum of coordinates of joints follows a function of time, or a polynomial of another one."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.base.vocabulary.expressions import Expr, Reading, call, literal_of
from symgen.base.vocabulary.measures import FormulaMeasure, Holonomic, Measure, Sum
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Scalars, Text, TimeFunction, Weights
from symgen.describe.parts.scope import Scope

#: Maximum number of coefficients: as deep as a formula may be nested, 100 levels.
MOST_COEFFICIENTS = 50


class Coupling(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A sum of joint coordinates, each with a factor: as tendons, differentials and gear trains tie them together.

    Parameters
    ----------
    terms : table of scalars
        Coordinate -> its factor: ``JOINT``, or ``JOINT.COORDINATE`` in quotes where a joint has several.
    value : function of time
        What the sum is; 0 by default. An expression of t and parameters with two derivatives.
    of : str
        Another coordinate, written the same way, of which a polynomial is added to `value`.
    polynomial : list of scalars
        Its coefficients, the constant first; at most 50.

    Notes
    -----
    One row. Multiplier ``NAME.coupling``: what it exerts on the first joint's first body along its coordinate is the
    multiplier times the coordinate's factor. Its unit is that of the first coordinate, [N m] for an angle.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    terms: Weights
    value: TimeFunction = 0.0
    of: Text | None = None
    polynomial: Scalars | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to a sum of measures minus a polynomial of another measure."""
        if (self.of is None) != (self.polynomial is None):
            got = "polynomial alone" if self.of is None else "of alone"
            raise scope.error("", "the keys of and polynomial together", got)
        bodies, terms, units = list[str](), list[tuple[Expr, Measure]](), list[str]()
        for name, factor in self.terms.items():
            joint, label, measure = self._read_coordinate(scope, f"terms.{name}", name)
            if any(measure == other for _, other in terms):
                raise scope.error("terms", "different coordinates", f"'{joint.name}.{label}' twice")
            bodies += joint.bodies
            terms.append((scope.constant(f"terms.{name}", factor), measure))
            units.append(Joint.unit(label))
        if self.of is not None:
            if self.polynomial is not None and len(self.polynomial) > MOST_COEFFICIENTS:
                expected = f"at most {MOST_COEFFICIENTS} coefficients"
                raise scope.error("polynomial", expected, f"{len(self.polynomial)}")
            joint, label, measure = self._read_coordinate(scope, "of", self.of)
            bodies += joint.bodies
            coefficients = [scope.constant("polynomial", c) for c in self.polynomial or ()]
            powers = FormulaMeasure(_horner_polynomial(coefficients, Reading(f"{joint.name}.{label}", measure)))
            terms.append((literal_of(-1.0), powers))
        row = Holonomic("coupling", Sum(tuple(terms)), scope.of_time("value", self.value), units[0])
        return Joint(scope.name, scope.kind, tuple(dict.fromkeys(bodies)), (row,))

    def _read_coordinate(self, scope: Scope, key: str, name: str) -> tuple[Joint, str, Measure]:
        joint, _, label = name.partition(".")
        return scope.joint_coordinate(joint, label or None, (key, key))


def _horner_polynomial(coefficients: list[Expr], x: Expr) -> Expr:
    """Return a polynomial with its constant first."""
    value = coefficients[-1]
    for c in reversed(coefficients[:-1]):
        value = call("add", c, call("mul", x, value))
    return value


KIND = Coupling
