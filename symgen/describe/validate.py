"""Nested dictionary to `Mechanism`: the one validator behind files, catalogue and builder."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import msgspec

from symgen.base.errors import InputError, nearest, quoted
from symgen.base.memory import uncollected
from symgen.base.units import unit_of
from symgen.describe.bodies import planar_body, shapes_of, spatial_body
from symgen.describe.columns import check_columns
from symgen.describe.evaluate import evaluate, evaluation_order
from symgen.describe.events import read_event
from symgen.describe.fields import (
    OF_ANY_JOINT,
    Flag,
    JointStart,
    OutputFunction,
    Scalar,
    read_table,
    read_value,
    words_of,
)
from symgen.describe.friction import check_frictions, read_friction, with_friction_outputs
from symgen.describe.holds import body_holds, holds_of, joint_holds
from symgen.describe.kinds import FORCES, JOINTS
from symgen.describe.losses import losses
from symgen.describe.mechanism import (
    AnyBody,
    Defaults,
    EndStop,
    Force,
    Friction,
    Hold,
    Joint,
    Mechanism,
    Output,
    Parameter,
    Rotor,
    StateVariable,
)
from symgen.describe.names import check_identifier, check_mechanism_name, line
from symgen.describe.origins import keep_origin
from symgen.describe.own_units import check_single, parameter_value
from symgen.describe.parser import FormulaNames
from symgen.describe.scope import Context, Scope
from symgen.describe.sections import (
    NAMED,
    SECTIONS,
    InputSection,
    MechanismSection,
    OutputSection,
    ParameterSection,
    RunSection,
    StateSection,
    TableSection,
)
from symgen.describe.smooth_friction import with_smooth_friction
from symgen.describe.stops import check_stops, read_gap, read_limits, with_stop_outputs
from symgen.describe.tables import Table
from symgen.describe.topology import articulation_of
from symgen.vocabulary.expressions import ONE, call
from symgen.vocabulary.measures import GROUND, Marker

if TYPE_CHECKING:
    from symgen.describe.beams import Beams

Raw = Mapping[str, Any]
#: Levels of tables in a file, and joints in a chain of references.
DEEPEST = 20


@uncollected()
def validate(raw: Raw, source: str) -> Mechanism:
    """Return the mechanism that the nested dictionary `raw` describes.

    Parameters
    ----------
    raw, source : mapping, str
        Sections as in a mechanism file; its name or other origin, with which every message begins.

    Raises
    ------
    InputError
        At the first thing that is wrong.
    """
    return keep_origin(_Validator(raw, source).mechanism(), raw, source)


class _Validator:
    """One description being read, section by section; joints may refer to each other and are resolved on demand."""

    def __init__(self, raw: Raw, source: str) -> None:
        self.raw, self.source = raw, source
        self._joints: dict[str, Joint | None] = {}
        self._seats: dict[str, Marker] = {}
        self._open = 0  # joints being resolved, each because the one before refers to it
        self._cuts: list[str] = []
        self._rotors: dict[str, Rotor] = {}
        self._frictions: dict[str, tuple[Friction, ...]] = {}
        self._limits: dict[str, tuple[EndStop, ...]] = {}
        self._starts: dict[str, tuple[Hold, ...]] = {}  # what joints say of the start
        self._parts: frozenset[str] = frozenset()  # names of nodes and elements of beams

    def where(self, path: str) -> str:
        return f"{self.source}: {path}"

    def scope(self, section: str, name: str) -> Scope:
        return Scope(self.context, f"{section}.{name}", name)

    def mechanism(self) -> Mechanism:
        for key in self.raw:
            if key not in SECTIONS:
                expected = f"the sections {', '.join(SECTIONS)}"
                raise InputError(self.source, expected, f"the unknown section {quoted(key)}", nearest(key, SECTIONS))
        if "mechanism" not in self.raw:
            raise InputError(self.where("mechanism"), "a section [mechanism] with a name", "no such section")
        head = read_table(MechanismSection, self.raw["mechanism"], self.where("mechanism"))
        check_mechanism_name(head.name, self.where("mechanism.name"))
        self.unique()
        parameters = self.parameters()
        tables = tuple(self.table(name, value) for name, value in self.entries("tables"))
        self.context = Context(
            self.source,
            {p.name: p.value for p in parameters if not p.input},
            {t.name: t for t in tables},
            {},
            self.joint,
            head.space,
            frozenset(name for name, _ in self.entries("joints")),
            inputs=tuple(p.name for p in parameters if p.input),
            state_names=tuple(name for name, _ in self.entries("states")),
        )
        scope = Scope(self.context, "mechanism")
        read_body = spatial_body if head.space == "spatial" else planar_body
        beams = self.beams(read_body)
        gravity = scope.vector("gravity", (0.0,) * scope.dimension if head.gravity is None else head.gravity)
        bodies = tuple(read_body(self.scope("bodies", name), value) for name, value in self.entries("bodies"))
        if not bodies:
            raise InputError(self.where("bodies"), "at least one body, [bodies.NAME]", "none")
        bodies = bodies if beams is None else tuple(map(beams.with_ends, bodies))
        self.context = msgspec.structs.replace(self.context, bodies={body.name: body for body in bodies})
        joints = tuple(self.joint(name, self.where("joints")) for name, _ in self.entries("joints"))
        forces = tuple(self.force(name, value) for name, value in self.entries("forces"))
        self.context = msgspec.structs.replace(self.context, forces={force.name: force for force in forces})
        described = [(self.scope("bodies", body.name), self.raw["bodies"][body.name], body) for body in bodies]
        ground = Scope(self.context, "mechanism", GROUND)
        looks = [(ground, self.raw["mechanism"]), *((scope, raw) for scope, raw, _ in described)]
        holds = [hold for scope, raw, body in described for hold in body_holds(scope, raw, body)]
        holds += [hold for joint in joints for hold in self._starts.get(joint.name, ())]
        frictions = [friction for joint in joints for friction in self._frictions.get(joint.name, ())]
        stops = (
            *(stop for joint in joints for stop in self._limits.get(joint.name, ())),
            *(read_gap(self.scope("stops", name), value) for name, value in self.entries("stops")),
        )
        self.context = msgspec.structs.replace(self.context, losses=losses((*frictions, *stops)))
        mechanism = Mechanism(
            name=head.name,
            title=line(head.title),
            space=head.space,
            gravity=gravity,
            parameters=parameters,
            tables=tables,
            bodies=bodies,  # type: ignore[arg-type]  # all of one space
            joints=joints,
            forces=forces,
            defaults=self.defaults(line(head.source)),
            rotors=tuple(self._rotors[joint.name] for joint in joints if joint.name in self._rotors),
            frictions=tuple(friction for friction in frictions if friction.speed is None),
            stops=stops,
            states=tuple(self.state(name, value) for name, value in self.entries("states")),
            outputs=tuple(self.output(name, value) for name, value in self.entries("outputs")),
            seats=tuple(self._seats.items()),
            cuts=tuple(self._cuts),
            holds=tuple(holds),
            shapes=tuple((scope.name, shape) for scope, raw in looks for shape in shapes_of(scope, raw)),
            beams=b"" if beams is None else msgspec.json.encode(beams.counted()),
            events=tuple(read_event(self.scope("events", n), n, event) for n, event in self.entries("events")),
        )
        smooth = [friction for friction in frictions if friction.speed is not None]
        mechanism = with_smooth_friction(with_stop_outputs(with_friction_outputs(mechanism)), smooth)
        check_columns(mechanism, self.source)
        check_frictions(mechanism, self.source)
        check_stops(mechanism, self.source)
        holds_of(mechanism, self.source)  # says what is held twice
        return mechanism

    # Names ---------------------------------------------------------------------------------------------------------

    def entries(self, section: str) -> Iterator[tuple[str, Any]]:
        """Yield name and content of a section's entries, names checked."""
        content = self.raw.get(section, {})
        if not isinstance(content, Mapping):
            raise InputError(self.where(section), f"a table of {section}, one entry a name", words_of(content))
        for name, value in content.items():
            if name not in self._parts:
                check_identifier(name, self.where(section), NAMED[section])
            yield name, value

    def unique(self) -> None:
        """Refuse one name for two things whose results would carry the same label, or that a formula may confuse."""
        for group in (
            ("bodies", "beams", "joints", "forces", "stops"),
            ("parameters", "inputs", "states", "tables"),
            ("states", "outputs"),
        ):
            sections: dict[str, str] = {}
            for section in group:
                for name, _ in self.entries(section):
                    if name in sections:
                        got = f"'{name}', which is a {NAMED[sections[name]]} already"
                        raise InputError(self.where(f"{section}.{name}"), "a name used once", got)
                    sections[name] = section

    def beams(self, read_body: Callable[[Scope, object], AnyBody]) -> Beams | None:
        """Put the nodes and elements of beams into the description; return the beams, None where there are none."""
        if not any(self.entries("beams")):
            return None
        from symgen.describe.beams import Beams

        for section in ("bodies", "joints", "forces"):
            any(self.entries(section))
        beams = Beams(self.raw, self.scope, read_body)
        self.raw, self._parts = beams.expanded(), frozenset((*beams.bodies, *beams.forces))
        return beams

    # Sections ------------------------------------------------------------------------------------------------------

    def defaults(self, source: str) -> Defaults:
        where = self.where("run")
        run = read_table(RunSection, self.raw.get("run", {}), where)
        for key in ("until", "step", "output_step", "max_step", "predictable_until"):
            value = getattr(run, key)
            if value is not None and not math.isfinite(value):
                raise InputError(f"{where}.{key}", "a finite number", str(value))
        usual = Defaults().step
        step = run.step or (usual if run.until >= usual else 0.01 * run.until)
        if step > run.until:
            raise InputError(f"{where}.step", f"at most until = {run.until!r}", repr(step))
        further = source, run.step, run.integrator, run.verify
        return Defaults(run.until, step, run.output_step, run.predictable_until, run.max_step, *further)

    def parameters(self) -> tuple[Parameter, ...]:
        """Return the parameters in the order of the file, then the inputs, formulas worked out with the defaults."""
        entries, inputs = dict(self.entries("parameters")), dict(self.entries("inputs"))
        elsewhere = frozenset(("t", *inputs, *(name for name, _ in self.entries("tables"))))
        allowed = FormulaNames(
            "a number or an expression of parameters", {name: name for name in entries}, elsewhere=elsewhere
        )
        parameters = {name: self.parameter("parameters", name, value, allowed) for name, value in entries.items()}
        parameters |= {name: self.parameter("inputs", name, value, allowed) for name, value in inputs.items()}
        values = dict[str, float]()
        for name in evaluation_order({name: p.formula for name, p in parameters.items()}, self.where("parameters")):
            formula = parameters[name].formula
            if formula is not None:
                value = evaluate(formula, values, self.where(f"{'inputs' if name in inputs else 'parameters'}.{name}"))
                parameters[name] = msgspec.structs.replace(parameters[name], value=value)
            values[name] = parameters[name].value
        return tuple(parameters.values())

    def parameter(self, section: str, name: str, raw: object, allowed: FormulaNames) -> Parameter:
        """Return a parameter or an input; one with a formula of others has no value yet."""
        where, text, note = self.where(f"{section}.{name}"), "", ""
        value: float | str
        if not isinstance(raw, Mapping):
            value = read_value(Scalar, raw, where)
        elif section == "inputs":
            content = read_table(InputSection, raw, where)
            value, text, note = content.default, content.unit, content.note
        else:
            table = read_table(ParameterSection, raw, where)
            value, text, note = table.value, table.unit, table.note
        number, formula, unit = parameter_value(value, text, allowed, where)
        shown = "" if unit.is_si else unit.text
        return Parameter(name, number, unit.si, line(note), formula, section == "inputs", shown)

    def table(self, name: str, raw: object) -> Table:
        where = self.where(f"tables.{name}")
        section = read_table(TableSection, raw, where)
        if len(section.x) < 2:
            raise InputError(f"{where}.x", "two numbers or more", str(len(section.x)))
        if len(section.y) != len(section.x):
            raise InputError(f"{where}.y", f"as many numbers as x has, {len(section.x)}", str(len(section.y)))
        for key in ("x", "y"):
            for value in getattr(section, key):
                if not math.isfinite(value):
                    raise InputError(f"{where}.{key}", "finite numbers", str(value))
        for left, right in zip(section.x, section.x[1:], strict=False):
            if not left < right:
                raise InputError(f"{where}.x", "increasing numbers", f"{right!r} after {left!r}")
        how, fewest = section.interpolation, 4 if section.interpolation == "cubic" or section.periodic else 2
        if len(section.x) < fewest:
            expected = f"{fewest} numbers or more for interpolation = '{how}'{', periodic' if section.periodic else ''}"
            raise InputError(f"{where}.x", expected, str(len(section.x)))
        if section.periodic and how == "linear":
            raise InputError(f"{where}.periodic", "true where interpolation is 'cubic' or 'pchip'", "true for 'linear'")
        if section.periodic and section.y[0] != section.y[-1]:
            got = f"{section.y[0]!r} and {section.y[-1]!r}"
            raise InputError(f"{where}.y", "the same value at both ends of a period", got)
        table = Table(name, section.x, section.y, how, section.periodic)
        try:
            finite = all(math.isfinite(c) for piece in table.interpolated.pieces for c in piece)
        except (ArithmeticError, ValueError):
            finite = False
        if not finite:
            raise InputError(where, "points between which curves have finite coefficients", "points too close or far")
        return table

    def state(self, name: str, raw: object) -> StateVariable:
        where, scope = self.where(f"states.{name}"), self.scope("states", name)
        section = read_table(StateSection, raw, where)
        unit = unit_of(section.unit, f"{where}.unit")
        if not unit.is_si:
            hint = f'a start may have one of its own: "5 {unit.text}"'
            raise InputError(f"{where}.unit", f"an SI unit such as {unit.si}, as formulas are", quoted(unit.text), hint)
        scope.coordinates = {name: unit.si}
        start, rate = scope.constant("start", section.start), scope.of_state("rate", section.rate)
        return StateVariable(name, start, rate, unit.text)

    def output(self, name: str, raw: object) -> Output:
        where = self.where(f"outputs.{name}")
        if isinstance(raw, Mapping):
            section, key = read_table(OutputSection, raw, where), "value"
        else:
            section, key = OutputSection(value=read_value(OutputFunction, raw, where)), ""
        scope = self.scope("outputs", name)
        value = scope.of_motion(key, section.value)
        unit = unit_of(section.unit, f"{where}.unit")
        check_single(scope, value, unit)
        return Output(name, value, unit.text)

    # Joints and forces ---------------------------------------------------------------------------------------------

    def split(self, path: str, raw: object, what: str, *common: str) -> tuple[str, dict[str, Any]]:
        """Return the type of a joint or force and the keys of its kind: those but the type and `common` ones."""
        where = self.where(path)
        if not isinstance(raw, Mapping):
            raise InputError(where, "a table", words_of(raw))
        kind = raw.get("type")
        if not isinstance(kind, str):
            got = "no such key" if kind is None else words_of(kind)
            raise InputError(f"{where}.type", f"a {what}", got)
        return kind, {key: value for key, value in raw.items() if key not in ("type", *common)}

    def joint(self, name: str, where: str) -> Joint:
        """Return the joint `name`, resolved now if another one asks for it first."""
        if name not in self.raw.get("joints", {}):
            got = f"the unknown joint {quoted(name)}"
            raise InputError(where, "the name of a joint", got, nearest(name, self.raw.get("joints", {})))
        if name in self._joints:
            resolved = self._joints[name]
            if resolved is None:
                raise InputError(where, "a joint that stands by itself", f"'{name}', which leads back to this one")
            return resolved
        self._joints[name] = None
        self._open += 1
        if self._open > DEEPEST:
            raise InputError(where, f"joints that refer to each other in at most {DEEPEST} steps", "more")
        path = f"joints.{name}"
        kind, table = self.split(path, self.raw["joints"][name], "joint type", *OF_ANY_JOINT)
        struct = JOINTS.get(kind, self.where(f"{path}.type"))
        scope = Scope(self.context, path, name, JOINTS.canonical(kind))
        scope.check_space(struct.SPACES)
        section = read_table(struct, table, self.where(path), ("type", *OF_ANY_JOINT))
        joint = section.build(scope)
        scope.coordinates = {label: joint.unit(label) for label, _ in joint.coordinates}
        at = getattr(section, "at", None)
        if at is not None:
            point = at[0] if hasattr(section, "between") else at
            self._seats[name] = scope.marker("at", joint.bodies[0], point)
        if "start" in self.raw["joints"][name]:
            coordinates = read_value(JointStart, self.raw["joints"][name]["start"], self.where(f"{path}.start"))
            self._starts[name] = joint_holds(scope, coordinates, joint)
        if read_value(Flag, self.raw["joints"][name].get("cut", False), self.where(f"{path}.cut")):
            if articulation_of(joint) is None:
                got = f"a {joint.kind} joint, which has rows in any case"
                raise InputError(self.where(f"{path}.cut"), "a joint that can carry a body", got)
            self._cuts.append(name)
        self.rotor(scope, joint, self.raw["joints"][name])
        if "friction" in self.raw["joints"][name]:
            self._frictions[name] = read_friction(scope, joint, self.raw["joints"][name]["friction"])
            if any(friction.pressed for friction in self._frictions[name]) and name not in self._cuts:
                self._cuts.append(name)  # its reaction is a multiplier
        if "stop" in self.raw["joints"][name]:
            self._limits[name] = read_limits(scope, joint, self.raw["joints"][name]["stop"])
        self._joints[name] = joint
        self._open -= 1
        return joint

    def rotor(self, scope: Scope, joint: Joint, raw: Raw) -> None:
        """Note the rotor of a joint, where it has one."""
        if "rotor_inertia" not in raw:
            if "gear_ratio" in raw:
                raise scope.error("gear_ratio", "the key rotor_inertia beside it", "no such key")
            return
        angles = [measure for label, measure in joint.coordinates if Joint.unit(label) == "rad"]
        if not angles and len(joint.coordinates) == 1:  # a slide, which the rotor drives by a spindle or a belt
            angles = [measure for _, measure in joint.coordinates]
        if len(angles) != 1:
            got = f"a {joint.kind} joint with {len(angles) or 'none'}"
            raise scope.error("rotor_inertia", "a joint with one angle, or one displacement alone", got)
        inertia, ratio = (
            scope.constant(key, read_value(Scalar, raw.get(key, 1.0), scope.where(key)), positive=positive)
            for key, positive in (("rotor_inertia", True), ("gear_ratio", False))
        )
        if ratio != ONE:
            inertia = call("mul", inertia, call("mul", ratio, ratio))
        way = articulation_of(joint)
        axes = (way.of_a[2], way.of_b[2]) if way is not None and way.turn == "axis" and way.of_a else ()
        self._rotors[joint.name] = Rotor(joint.name, angles[0], inertia, axes)

    def force(self, name: str, raw: object) -> Force:
        path = f"forces.{name}"
        kind, table = self.split(path, raw, "force type")
        struct = FORCES.get(kind, self.where(f"{path}.type"))
        scope = Scope(self.context, path, name, FORCES.canonical(kind))
        scope.check_space(struct.SPACES)
        return read_table(struct, table, self.where(path), ("type",)).build(scope)
