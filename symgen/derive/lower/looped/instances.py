"""Bodies, joints, rows with bounds, rotors, forces and states as instances of kernels: structure apart from numbers.

Every element of a mechanism is rewritten as the only one of an abstract mechanism: bodies become ``f0``, ``f1``, ...,
numbers and formulas of parameters become the parameters ``k0``, ``k1``, ..., states of the file ``z0``, ``z1``, ....
Elements with equal abstract mechanisms share a kernel, within a mechanism and between mechanisms. Kept as they are:
zeros, unit directions, whole coefficients of sums, exponents, and everything that depends on time or state.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import msgspec

from symgen.base.vocabulary.expressions import (
    ONE,
    ZERO,
    Call,
    Expr,
    Name,
    Number,
    Reading,
    call,
    names_in_expression,
    readings_in,
    table_of,
)
from symgen.base.vocabulary.measures import GROUND, Direction, Effort, Marker, Measure, Row, Sum
from symgen.derive.lower.windings import counted_turns, measures_of_element
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.by_reaction import pressed_rows, refuse_shared_reactions
from symgen.describe.facts.repeats import without_repeats
from symgen.describe.formulas.formula_nodes import Formulas
from symgen.describe.mechanism import Body, Force, Joint, Mechanism, Parameter, Rotor, StateVariable

#: Fields of the vocabulary's structs that hold the name of a body.
_BODY_FIELDS = frozenset(("body", "a", "b"))
#: Fields with names for readers; of a unit it matters only whether it is that of an angle.
_LABELS = frozenset(("label",))
_UNITS = (0.0, 1.0, -1.0)
#: Parts of a mechanism outside its equations, which do not change the names of kernels.
_BESIDE = frozenset("defaults holds events outputs seats cuts topology shapes given states rotors beams".split())


@dataclass(frozen=True)
class Instance:
    """An element of a mechanism as an instance of a kernel.

    Parameters
    ----------
    kind : {"body", "joint", "bound", "drag", "rotor", "force", "state"}
        Kind of element.
    name, label : str
        The element's name, and the readable name of its kind.
    frames : tuple of str
        Bodies for ``f0``, ``f1``, ....
    constants : tuple of Expr
        Formulas of parameters for ``k0``, ``k1``, ....
    abstract : Mechanism
        The abstract mechanism with this element only.
    key : bytes
        Its canonical text: equal where the kernel is the same.
    angles : tuple of Measure
        Measures whose turns are counted, in the order of derivation; equal ones are one angle.
    states : tuple of str
        States of the file for ``z0``, ``z1``, ...; of a state it is the first.
    joint : str
        Of a drag, the joint on whose reaction it depends, or the row of a gap.
    """

    kind: str
    name: str
    label: str
    frames: tuple[str, ...]
    constants: tuple[Expr, ...]
    abstract: Mechanism
    key: bytes
    angles: tuple[Measure, ...] = ()
    states: tuple[str, ...] = ()
    joint: str = ""


def instances_of_mechanism(mechanism: Mechanism) -> tuple[Instance, ...]:
    """Return all parts of a mechanism as instances in the order of their kinds, rows that repeat others left out.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    """
    mechanism, repeats = without_repeats(mechanism)
    rewriting, pressed = _Rewriting(mechanism), pressed_rows(mechanism)
    for row in pressed:
        refuse_shared_reactions(row, repeats)
    return (
        *(rewriting.body_instance(body) for body in mechanism.bodies),
        *(rewriting.element_instance("joint", joint) for joint in mechanism.joints),
        *(rewriting.bounded_row_instance(row.without_reaction) for row in mechanism.bounded),
        *(rewriting.drag_instance(row) for row in pressed),
        *(rewriting.rotor_instance(rotor) for rotor in mechanism.rotors),
        *(rewriting.element_instance("force", force) for force in mechanism.forces),
        *(rewriting.state_instance(state) for state in mechanism.states),
    )


class _Rewriting:
    """Rewrites the elements of a mechanism, one after the other."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism, self.formulas = mechanism, Formulas(mechanism)
        self.bodies: Mapping[str, Any] = {b.name: b for b in mechanism.bodies}
        self.parameters = frozenset(p.name for p in mechanism.parameters)
        self.tables = {t.name: t for t in mechanism.tables}
        self.states = frozenset(x.name for x in mechanism.states)
        self.begin_element()

    def begin_element(self) -> None:
        """Begin another element."""
        self.frames: dict[str, str] = {}
        self.constants: list[Expr] = []
        self.aliases: dict[str, str] = {}  # of states
        self.used_tables: dict[str, Any] = {}
        self.memo: dict[object, object] = {}
        self.own: frozenset[str] = frozenset()  # words of the element itself, which are no parameters

    def body_instance(self, body: Any) -> Instance:
        """Return a body as an instance: its inertia, its weight and its frame."""
        self.begin_element()
        self.frames[body.name] = "f0"
        mass = self.rewrite_formula(body.mass)
        inertia = None if body.inertia is None else self.rewrite(body.inertia)
        gravity = tuple(self.rewrite_formula(e) for e in self.mechanism.gravity)
        abstract = type(body)(name="f0", mass=mass, inertia=inertia)
        return self.instance("body", body.name, "point" if body.is_point else "body", gravity, (abstract,))

    def element_instance(self, kind: str, element: Joint | Force) -> Instance:
        """Return a joint or force as an instance."""
        self.begin_element()
        content: Any
        if isinstance(element, Joint):
            rows = tuple(self.rewrite(row) for row in element.rows)
            coordinates = tuple(
                (f"{'angle' if label == 'angle' else 'c'}{i}", self.rewrite(m))
                for i, (label, m) in enumerate(element.coordinates)
            )
            content = Joint("e", "", (), rows, coordinates)
        else:
            content = Force(
                "e", "", (), *(tuple(self.rewrite(e) for e in part) for part in (element.efforts, element.flexures))
            )
        instance = self.massless_instance(kind, element.name, element.kind, content)
        angles = counted_turns(measures_of_element(element))
        return replace(instance, angles=angles) if angles else instance

    def bounded_row_instance(self, row: BoundedRow) -> Instance:
        """Return a row with bounds as an instance: its row, in force at times, and its effort where it is off."""
        self.begin_element()
        whole: Any = self.rewrite(row)
        named = {field: "e" for field in ("name", "joint", "owner") if field in whole.__struct_fields__}
        content = msgspec.structs.replace(whole, **named, **_alone(whole))
        instance = self.massless_instance("bound", row.row, row.family.one, content)
        angles = counted_turns([row.measure])
        return replace(instance, angles=angles) if angles else instance

    def drag_instance(self, row: BoundedRow) -> Instance:
        """Return a row whose bounds a reaction sets as an instance, with the rows that press."""
        self.begin_element()
        whole: Any = row  # all kinds are structs
        rows: tuple[Row, ...]
        if row.signed:  # its own gap, by its name
            gap = next(each for each in self.mechanism.bounded if each.row in row.pressed)
            owner, rows = gap.row, (gap.held,)
            held = (msgspec.structs.replace(self.rewrite(gap.held), label=gap.held.label),)
            content = msgspec.structs.replace(self.rewrite(whole), name="e", **_alone(whole))
        else:
            joint = self.mechanism.joint_named(row.owner)
            owner, rows = joint.name, joint.rows
            labels = {f"{owner}.{each.label}": f"r{i}" for i, each in enumerate(rows)}
            again = zip((self.rewrite(each) for each in rows), labels.values(), strict=True)
            held = tuple(msgspec.structs.replace(each, label=label) for each, label in again)
            pressed = msgspec.structs.replace(whole, pressed=tuple(f"e.{labels[name]}" for name in row.pressed))
            content = msgspec.structs.replace(self.rewrite(pressed), name="e", joint="e")
        instance = self.massless_instance("drag", row.row, row.family.one, content)
        abstract = msgspec.structs.replace(instance.abstract, joints=(Joint("e", "", (), held),), bounded=(content,))
        key = instance.key + msgspec.json.encode([*held, content])
        angles = counted_turns([*measures_of_element(Joint("e", "", (), rows)), row.measure])
        return replace(instance, abstract=abstract, key=key, angles=angles, joint=owner)

    def rotor_instance(self, rotor: Rotor) -> Instance:
        """Return a rotor on a joint as an instance: its inertia, and the rate of its angle."""
        self.begin_element()
        content = Rotor("e", self.rewrite(rotor.angle), self.rewrite_formula(rotor.inertia), self.rewrite(rotor.axes))
        instance = self.massless_instance("rotor", rotor.joint, "rotor")
        abstract = msgspec.structs.replace(instance.abstract, rotors=(content,))
        angles = counted_turns([rotor.angle])
        return replace(instance, abstract=abstract, key=instance.key + msgspec.json.encode(content), angles=angles)

    def state_instance(self, state: StateVariable) -> Instance:
        """Return a state of the file as an instance: its rate."""
        self.begin_element()
        self.aliases[state.name] = "z0"
        rate = self.rewrite_formula(state.rate)
        instance = self.massless_instance("state", state.name, "state")
        first, *others = instance.abstract.states
        abstract = msgspec.structs.replace(instance.abstract, states=(StateVariable(first.name, ZERO, rate), *others))
        angles = counted_turns(measure.source for measure in readings_in(state.rate))
        return replace(instance, abstract=abstract, key=instance.key + msgspec.json.encode(rate), angles=angles)

    def massless_instance(self, kind: str, name: str, label: str, content: object = None) -> Instance:
        """Return an instance without inertia of its own, on bodies as mere frames."""
        frames = tuple(self.body_as_frame(self.bodies[body], alias) for body, alias in self.frames.items())
        return self.instance(kind, name, label, (ZERO,) * len(self.mechanism.gravity), frames, content)

    def instance(
        self, kind: str, name: str, label: str, gravity: Any, frames: tuple[Any, ...], content: Any = None
    ) -> Instance:
        """Return the instance with its abstract mechanism."""
        abstract = Mechanism(
            name="element",
            title="",
            space=self.mechanism.space,
            gravity=gravity,
            parameters=tuple(Parameter(f"k{i}", 1.0) for i in range(len(self.constants))),
            tables=tuple(self.used_tables[n] for n in sorted(self.used_tables)),
            bodies=frames,
            joints=(content,) if isinstance(content, Joint) else (),
            forces=(content,) if isinstance(content, Force) else (),
            states=tuple(StateVariable(alias, ZERO, ZERO) for alias in self.aliases.values()),
            bounded=(content,) if kind == "bound" else (),
        )
        content = {name: getattr(abstract, name) for name in abstract.__struct_fields__ if name not in _BESIDE}
        key = kind.encode() + msgspec.json.encode(content)
        of = (tuple(self.frames), tuple(self.constants), abstract, key)
        return Instance(kind, name, label, *of, states=tuple(self.aliases))

    def body_as_frame(self, body: Any, alias: str) -> Any:
        """Return a body as a mere frame; its markers are relative to the centre of mass already."""
        inertia: Any = None
        if body.inertia is not None:
            unit = (ONE, ONE, ONE, ZERO, ZERO, ZERO)
            inertia = ONE if isinstance(body, Body) else unit
        return type(body)(name=alias, mass=ONE, inertia=inertia)

    # -- rewriting ---------------------------------------------------------------------------------------------------

    def rewrite(self, value: object, field: str = "") -> Any:
        """Return a value of the vocabulary with bodies and numbers replaced."""
        if isinstance(value, Number | Name | Call | Reading):
            return self.rewrite_formula(value)
        if isinstance(value, str):
            if field == "unit":
                return value if value == "rad" else ""
            return self.abstract_body(value) if field in _BODY_FIELDS else "" if field in _LABELS else value
        if isinstance(value, tuple):
            return tuple(self.rewrite(item) for item in value)
        if not isinstance(value, msgspec.Struct):
            return value
        if isinstance(value, Marker | Direction):
            if value not in self.memo:
                self.memo[value] = (
                    self.rewrite_marker(value) if isinstance(value, Marker) else self.rewrite_direction(value)
                )
            return self.memo[value]
        if isinstance(value, Sum):
            return Sum(tuple((self.rewrite_coefficient(k), self.rewrite(m)) for k, m in value.terms))
        before, self.own = self.own, frozenset(("s", "rate")) if isinstance(value, Effort) else self.own
        result = type(value)(**{f: self.rewrite(getattr(value, f), f) for f in value.__struct_fields__})
        self.own = before
        return result

    def abstract_body(self, body: str) -> str:
        """Return the name of a body in the abstract mechanism."""
        return body if body == GROUND else self.frames.setdefault(body, f"f{len(self.frames)}")

    def rewrite_marker(self, marker: Any) -> Marker:
        """Return a marker: at the centre of mass, on the x axis, or anywhere; on the ground anywhere."""
        alias = self.abstract_body(marker.body)
        if alias == GROUND:
            return Marker(alias, tuple(self.abstract_parameter(e) for e in marker.point))
        centre = self.bodies[marker.body].centre_of_mass
        point = [call("sub", x, c) for x, c in zip(marker.point, centre, strict=True)]
        last = max((i for i, e in enumerate(point) if self.literal_value(e) != 0.0), default=-1)
        return Marker(alias, tuple(self.abstract_parameter(e) if i <= last else ZERO for i, e in enumerate(point)))

    def rewrite_direction(self, direction: Any) -> Direction:
        """Return a direction: along an axis, or any."""
        alias, vector = self.abstract_body(direction.body), direction.vector
        literals = [self.literal_value(e) for e in vector]
        if all(x in _UNITS for x in literals):
            return Direction(alias, tuple(Number(x) for x in literals if x is not None))
        return Direction(alias, tuple(self.abstract_parameter(e) for e in vector))

    def rewrite_coefficient(self, e: Expr) -> Expr:
        """Return a coefficient of a sum; 0, 1 and -1 are unchanged."""
        literal = self.literal_value(e)
        return Number(literal) if literal in _UNITS and literal is not None else self.rewrite_formula(e)

    def literal_value(self, e: Expr) -> float | None:
        """Return the value of a formula of parameters after simplification; None where it depends on them."""
        return e.value if isinstance(e, Number) else self.formulas.graph.value(self.formulas.expression(e))

    def abstract_parameter(self, e: Expr) -> Expr:
        """Return the abstract parameter for a formula of parameters."""
        self.constants.append(e)
        return Name(f"k{len(self.constants) - 1}")

    def rewrite_formula(self, e: Expr) -> Expr:
        """Return a formula with its constant parts replaced; zeros stay."""
        if self.is_constant(e):
            return ZERO if self.literal_value(e) == 0.0 else self.abstract_parameter(e)
        if isinstance(e, Name):
            if e.name in self.states and e.name not in self.own:
                return Name(self.aliases.setdefault(e.name, f"z{len(self.aliases)}"))
            body, dot, coordinate = e.name.rpartition(".")
            return Name(f"{self.abstract_body(body)}.{coordinate}") if dot else e
        if isinstance(e, Reading):
            return Reading("", self.rewrite(e.source), e.order)
        assert isinstance(e, Call), "a literal is constant"
        name = table_of(e.function)
        if name is not None:
            self.used_tables[name] = self.tables[name]
        if e.function == "pow" and isinstance(e.arguments[1], Number):
            return Call("pow", (self.rewrite_formula(e.arguments[0]), e.arguments[1]))
        return Call(e.function, tuple(self.rewrite_formula(a) for a in e.arguments))

    def is_constant(self, e: Expr) -> bool:
        """Whether a formula depends on parameters alone."""
        if isinstance(e, Number):
            return True
        return all(name in self.parameters and name not in self.own for name in names_in_expression(e))


def _alone(row: msgspec.Struct) -> dict[str, int]:
    """Return what makes a row of a part of a contact one of a whole contact."""
    return {"part": 0} if "part" in row.__struct_fields__ else {}
