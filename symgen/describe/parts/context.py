"""The mechanism read so far: what the formulas of joints, forces and outputs may name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property

import msgspec

from symgen.base.vocabulary.expressions import Expr
from symgen.describe.contacts.chains import BodyOutline
from symgen.describe.formulas.parser import FormulaNames
from symgen.describe.mechanism import AnyBody, Force, Joint, Mechanism, Vec
from symgen.describe.table_functions import Table


class Context(msgspec.Struct, frozen=True, dict=True):
    """Facts about the mechanism when joints and forces are resolved.

    Values that all formulas need are computed once: a file may have thousands of parameters, bodies and formulas.
    """

    source: str
    values: Mapping[str, float]  # parameters with their defaults
    tables: Mapping[str, Table]
    bodies: Mapping[str, AnyBody]
    joint: Callable[[str, str], Joint]  # (name, where) -> the joint, resolved if it was not yet
    space: str = "planar"
    joint_names: frozenset[str] = frozenset()
    forces: Mapping[str, Force] = {}  # empty while forces are resolved
    inputs: tuple[str, ...] = ()
    state_names: tuple[str, ...] = ()
    losses: Mapping[str, Expr] = {}  # energy lost at rows with bounds, which outputs may read
    outlines: Mapping[str, BodyOutline] = {}  # of bodies and the ground, which contacts name

    @classmethod
    def of_mechanism(cls, mechanism: Mechanism, source: str = "") -> Context:
        """Return the context of a complete mechanism, for later formulas."""
        from symgen.describe.bounds.losses import losses_by_name  # which needs scopes

        joints = {joint.name: joint for joint in mechanism.joints}
        return cls(
            source or mechanism.name,
            {p.name: p.value for p in mechanism.parameters if not p.input},
            {table.name: table for table in mechanism.tables},
            {body.name: body for body in mechanism.bodies},
            lambda name, where: joints[name],
            mechanism.space,
            frozenset(joints),
            {force.name: force for force in mechanism.forces},
            mechanism.inputs,
            tuple(state.name for state in mechanism.states),
            losses_by_name(mechanism.bounded),
        )

    @cached_property
    def coordinates(self) -> dict[str, tuple[str, ...]]:
        """Body -> coordinates and velocities that formulas may use."""
        return {name: body.coordinates + body.speeds for name, body in self.bodies.items()}

    @cached_property
    def points(self) -> dict[str, dict[str, Vec]]:
        """Body -> its points by name."""
        return {name: dict(body.points) for name, body in self.bodies.items()}

    @cached_property
    def constants(self) -> FormulaNames:
        """Names of a formula of parameters."""
        plain = {name: name for name in self.values}
        elsewhere = frozenset({"t", *self.tables, *self._changing})
        return FormulaNames("a number or an expression of parameters", plain, elsewhere=elsewhere, hints=self._changing)

    @cached_property
    def times(self) -> FormulaNames:
        """Names of a formula of t and parameters."""
        plain = {name: name for name in (*self.values, "t")}
        smooth = {name: t.function for name, t in self.tables.items() if t.interpolation == "cubic"}
        others = frozenset(self.tables) - frozenset(smooth)
        hints = dict.fromkeys(others, "a motion needs two continuous derivatives, which interpolation = 'cubic' has")
        what = "a number or an expression of t and parameters"
        elsewhere = others | frozenset(self._changing)
        return FormulaNames(what, plain, tables=smooth, elsewhere=elsewhere, hints=hints | self._changing)

    @cached_property
    def states(self) -> dict[str, str]:
        """Names of a formula of t, parameters, inputs and state, coordinates apart."""
        return {name: name for name in (*self.values, *self.inputs, *self.state_names, "t")}

    @property
    def _changing(self) -> dict[str, str]:
        """Hints on inputs and states where a formula may not have them."""
        hints = dict.fromkeys(self.state_names, "only forces, torques, rates of states and outputs may use a state")
        return hints | dict.fromkeys(self.inputs, "only forces, torques and actuators may use an input")

    @cached_property
    def functions(self) -> dict[str, str]:
        """Tables -> functions of a tree."""
        return {name: table.function for name, table in self.tables.items()}
