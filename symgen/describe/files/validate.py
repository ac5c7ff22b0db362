"""Nested dictionary to `Mechanism`: the one validator behind files, catalogue and builder."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any, TypeVar

import msgspec

from symgen.base.errors import InputError, nearest, quoted
from symgen.base.memory import uncollected
from symgen.base.units import unit_of
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.checks import check_bounds
from symgen.describe.bounds.keys import SectionOfFiles, sections_of_files
from symgen.describe.bounds.losses import losses
from symgen.describe.bounds.modes import with_bounded_outputs
from symgen.describe.bounds.smooth import with_smooth
from symgen.describe.files.joint_tables import JointTables
from symgen.describe.files.origins import errors_in, keep_origin
from symgen.describe.files.section_names import NAMED, SECTIONS
from symgen.describe.formulas.names import check_identifier, check_mechanism_name, line
from symgen.describe.formulas.parser import FormulaNames
from symgen.describe.formulas.readings import rows_read
from symgen.describe.mechanism import (
    AnyBody,
    Defaults,
    Force,
    Hold,
    Joint,
    Mechanism,
    OperatingLimit,
    Output,
    Parameter,
    Shape,
    StateVariable,
    Vec,
)
from symgen.describe.parts.bodies import planar_body, shapes_of, spatial_body
from symgen.describe.parts.collected import Errors, Incomplete
from symgen.describe.parts.columns import check_columns
from symgen.describe.parts.context import Context
from symgen.describe.parts.events import read_event
from symgen.describe.parts.fields import (
    OutputFunction,
    read_table,
    read_value,
    words_of,
)
from symgen.describe.parts.holds import body_holds, holds_of
from symgen.describe.parts.kinds import FORCES, kind_and_keys
from symgen.describe.parts.limits import limits_of
from symgen.describe.parts.numbers import read_defaults, read_points
from symgen.describe.parts.own_units import check_own_unit
from symgen.describe.parts.parameters import Parameters
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.sections import (
    MechanismSection,
    OutputSection,
    StateSection,
)

if TYPE_CHECKING:
    from symgen.describe.beams.beams import Beams

Raw = Mapping[str, Any]
T = TypeVar("T")


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
    with errors_in(source):
        mechanism = _Validator(raw, source, Errors()).mechanism()
    return keep_origin(mechanism, raw, source)


@uncollected()
def errors_of(raw: Raw, source: str) -> tuple[InputError, ...]:
    """Return all that is wrong with a description, as of `validate`: of each table the first thing.

    Errors that follow from tables which are wrong, such as joints of their bodies, are left out.
    """
    errors = Errors(all_of_them=True)
    with suppress(Incomplete), errors.apart():
        _Validator(raw, source, errors).mechanism()
    return tuple(errors.found.values())


class _Validator:
    """One description being read, section by section."""

    def __init__(self, raw: Raw, source: str, errors: Errors) -> None:
        self.raw, self.source = raw, source
        self.errors = errors
        self._entries: dict[str, list[tuple[str, Any]]] = {}
        self._parts: frozenset[str] = frozenset()  # names of nodes and elements of beams
        self._numbers = FormulaNames("a number or an expression of parameters", {})
        self._limits: list[OperatingLimit] = []  # of parameters and outputs

    def where(self, path: str) -> str:
        return f"{self.source}: {path}"

    def scope(self, section: str, name: str, kind: str = "") -> Scope:
        return Scope(self.context, f"{section}.{name}", name, kind)

    def joint(self, name: str, where: str) -> Joint:
        return self.joints.joint(name, where)

    def each(self, section: str, read: Callable[[str, Any], T]) -> tuple[T, ...]:
        """Return what `read` makes of name and content of a section's entries, each apart from the others."""
        results = []
        for name, value in self.entries(section):
            beam = (name.partition(".")[0],) if name in self._parts else ()  # whose further parts are wrong alike
            with self.errors.apart(name, *beam):
                self.errors.need(*beam)
                results.append(read(name, value))
        return tuple(results)

    def head(self) -> MechanismSection:
        """Return the table that says what the mechanism is called, and in which space it lies."""
        for key, content in self.raw.items():
            if key not in SECTIONS:
                with self.errors.apart(*(content if isinstance(content, Mapping) else ())):
                    expected, got = f"the sections {', '.join(SECTIONS)}", f"the unknown section {quoted(key)}"
                    raise InputError(self.source, expected, got, nearest(key, SECTIONS), key)
        where = self.where("mechanism")
        with self.errors.apart():
            if "mechanism" not in self.raw:
                raise InputError(where, "a section [mechanism] with a name", "no such section")
            head = read_table(MechanismSection, self.raw["mechanism"], where)
            with self.errors.apart():
                check_mechanism_name(head.name, f"{where}.name")
            return head
        # What is right in the rest depends on the space.
        table = self.raw.get("mechanism")
        if not isinstance(table, Mapping) or table.get("space", "planar") not in ("planar", "spatial"):
            raise Incomplete
        if "space" not in table and nearest("space", table).startswith("did you mean"):
            raise Incomplete
        return MechanismSection(name="", space=table.get("space", "planar"))

    def mechanism(self) -> Mechanism:
        head = self.head()
        self.unique()
        parameters = self.parameters()
        tables = self.each("tables", lambda name, value: read_points(name, value, self.where(f"tables.{name}")))
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
        self.joints = JointTables(self.raw.get("joints", {}), self.errors, self.where, self.scope)
        gravity: Vec = ()
        with self.errors.apart():
            gravity = scope.vector("gravity", (0.0,) * scope.dimension if head.gravity is None else head.gravity)
        bodies = self.bodies(read_body, beams)
        self.context = msgspec.structs.replace(self.context, bodies={body.name: body for body in bodies})
        joints = self.each("joints", lambda name, _: self.joint(name, self.where("joints")))
        forces = self.each("forces", self.force)
        self.context = msgspec.structs.replace(self.context, forces={force.name: force for force in forces})
        holds, shapes = self.holds_and_shapes(bodies)
        holds += [hold for joint in joints for hold in self.joints.starts.get(joint.name, ())]
        bounded = self.bounded(joints)
        self.context = msgspec.structs.replace(self.context, losses=losses(bounded))
        defaults = self.defaults(line(head.source))
        states = self.each("states", self.state)
        outputs = self.each("outputs", self.output)
        events = self.each("events", lambda name, value: read_event(self.scope("events", name), name, value))
        self.errors.check()
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
            defaults=defaults,
            rotors=tuple(self.joints.rotors[joint.name] for joint in joints if joint.name in self.joints.rotors),
            bounded=tuple(row for row in bounded if not row.smooth),
            states=states,
            outputs=outputs,
            seats=tuple(self.joints.seats.items()),
            cuts=self._joints_with_multipliers(joints, outputs),
            holds=tuple(holds),
            shapes=tuple(shapes),
            beams=b"" if beams is None else msgspec.json.encode(beams.counted()),
            events=events,
            limits=tuple(self._limits),
            author=line(head.author),
            revision=line(head.revision),
        )
        with self.errors.apart():
            mechanism = with_smooth(with_bounded_outputs(mechanism), [row for row in bounded if row.smooth])
            check_columns(mechanism, self.source)
            check_bounds(mechanism, self.source)
            holds_of(mechanism, self.source)  # says what is held twice
        return mechanism

    def _joints_with_multipliers(self, joints: Sequence[Joint], outputs: Sequence[Output]) -> tuple[str, ...]:
        """Return joints that carry nothing in a tree, as their reactions are read: those that cut, and of outputs."""
        read = {row.rpartition(".")[0] for output in outputs for row in rows_read(output.value)}
        drivers = {joint.name for joint in joints if joint.kind == "driver"}
        cuts = self.joints.cuts
        return (*cuts, *(j.name for j in joints if j.name in read - drivers - set(cuts)))

    # Names ---------------------------------------------------------------------------------------------------------

    def entries(self, section: str) -> Sequence[tuple[str, Any]]:
        """Return name and content of a section's entries, names checked."""
        if section not in self._entries:
            self._entries[section] = list(self.checked(section))
        return self._entries[section]

    def checked(self, section: str) -> Iterator[tuple[str, Any]]:
        """Yield name and content of a section's entries whose names are right."""
        content = self.raw.get(section, {})
        if not isinstance(content, Mapping):
            with self.errors.apart():
                raise InputError(self.where(section), f"a table of {section}, one entry a name", words_of(content))
            raise Incomplete  # which names the rest may use is unknown
        for name, value in content.items():
            right = name in self._parts
            if not right:
                with self.errors.apart(name):
                    right = bool(check_identifier(name, self.where(section), NAMED[section]))
            if right:
                yield name, value

    def bounded(self, joints: Sequence[Joint]) -> tuple[BoundedRow, ...]:
        """Return the rows with bounds, those whose force has two bounds first."""
        rows = self.joints.bounded(joints)
        for section, kind in sections_of_files().items():
            rows += self._entries_of(section, kind)
        return tuple(sorted(rows, key=lambda row: row.one_sided))

    def _entries_of(self, section: str, kind: SectionOfFiles) -> tuple[BoundedRow, ...]:
        """Return the rows with bounds of a section of their own."""
        return self.each(section, lambda name, value: kind.read(self.scope(section, name), value))

    def unique(self) -> None:
        """Refuse one name for two things whose results would carry the same label, or that a formula may confuse."""
        for group in (
            ("bodies", "beams", "joints", "forces", *sections_of_files()),
            ("parameters", "inputs", "states", "tables"),
            ("states", "outputs"),
        ):
            sections: dict[str, str] = {}
            for section in group:
                for name, _ in self.entries(section):
                    if name in sections:
                        with self.errors.apart():
                            got = f"'{name}', which is a {NAMED[sections[name]]} already"
                            raise InputError(self.where(f"{section}.{name}"), "a name used once", got)
                    sections[name] = section

    def beams(self, read_body: Callable[[Scope, object], AnyBody]) -> Beams | None:
        """Put the nodes and elements of beams into the description; return the beams, None where there are none."""
        if not self.entries("beams"):
            return None
        from symgen.describe.beams.beams import Beams

        with self.errors.apart(*(name for name, _ in self.entries("beams"))):
            beams = Beams(self.raw, self.scope, read_body, self.errors)
            self.raw, self._parts = beams.expanded(), frozenset((*beams.bodies, *beams.forces))
            self._entries.clear()
            return beams
        return None

    def bodies(self, read_body: Callable[[Scope, object], AnyBody], beams: Beams | None) -> tuple[AnyBody, ...]:
        """Return the bodies, and the nodes of beams."""
        bodies = self.each("bodies", lambda name, value: read_body(self.scope("bodies", name), value))
        if not self.raw.get("bodies") and not self.raw.get("beams"):
            self.errors.check()
            raise InputError(self.where("bodies"), "at least one body, [bodies.NAME]", "none")
        with self.errors.apart(*(body.name for body in bodies)):
            return bodies if beams is None else tuple(map(beams.with_ends, bodies))
        return ()

    def holds_and_shapes(self, bodies: tuple[AnyBody, ...]) -> tuple[list[Hold], list[tuple[str, Shape]]]:
        """Return what bodies keep of their start, and what they and the ground look like."""
        holds, shapes = list[Hold](), list[tuple[str, Shape]]()
        with self.errors.apart():
            ground = Scope(self.context, "mechanism", GROUND)
            shapes += [(GROUND, shape) for shape in shapes_of(ground, self.raw["mechanism"])]
        for body in bodies:
            scope, raw = self.scope("bodies", body.name), self.raw["bodies"][body.name]
            with self.errors.apart():
                holds += body_holds(scope, raw, body)
            with self.errors.apart():
                shapes += [(body.name, shape) for shape in shapes_of(scope, raw)]
        return holds, shapes

    # Sections ------------------------------------------------------------------------------------------------------

    def defaults(self, source: str) -> Defaults:
        with self.errors.apart():
            return read_defaults(self.raw.get("run", {}), self.where("run"), source)
        return Defaults()

    def parameters(self) -> tuple[Parameter, ...]:
        """Return the parameters in the order of the file, then the inputs, formulas worked out with the defaults."""
        sections = {section: dict(self.entries(section)) for section in ("parameters", "inputs")}
        reader = Parameters(self.source, self.errors, sections, [name for name, _ in self.entries("tables")])
        parameters, self._numbers = reader.read(), reader.names
        self._limits += reader.limits
        return parameters

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
        check_own_unit(scope, value, unit)
        self._limits += limits_of(name, section, unit, self._numbers, where, si=False)
        return Output(name, value, unit.text)

    def force(self, name: str, raw: object) -> Force:
        where = self.where(f"forces.{name}")
        kind, table = kind_and_keys(where, raw, "force type")
        struct = FORCES.get(kind, f"{where}.type")
        scope = self.scope("forces", name, FORCES.canonical(kind))
        scope.check_space(struct.SPACES)
        return read_table(struct, table, where, ("type",)).build(scope)
