"""Nested dictionary to `Mechanism`: the one validator of files, catalogue and builder."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar

import msgspec

from symgen.base.errors import InputError, quote, suggest
from symgen.base.memory import without_garbage_collection
from symgen.base.units import unit_of
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.bounded_modes import with_bounded_outputs
from symgen.describe.bounds.checks import check_bounds, name_of_two
from symgen.describe.bounds.keys import SectionOfFiles, sections_of_files
from symgen.describe.bounds.losses import losses_by_name
from symgen.describe.bounds.smooth import rows_as_forces
from symgen.describe.contacts.outline_tables import read_outline
from symgen.describe.contacts.rays import value_of_output
from symgen.describe.files.joint_tables import JointTables
from symgen.describe.files.origins import errors_in, keep_origin
from symgen.describe.files.remarks import with_remarks
from symgen.describe.files.section_names import NAMED, SECTIONS
from symgen.describe.formulas.identifiers import check_identifier, check_mechanism_name, one_line
from symgen.describe.formulas.parser import FormulaNames
from symgen.describe.formulas.results_read import joints_with_multipliers
from symgen.describe.mechanism import (
    AnyBody,
    Hold,
    Joint,
    Mechanism,
    OperatingLimit,
    Output,
    Parameter,
    Shape,
    Vec,
)
from symgen.describe.parts.bodies import planar_body, read_shapes, spatial_body
from symgen.describe.parts.collected import Errors, Incomplete
from symgen.describe.parts.columns import check_columns
from symgen.describe.parts.context import Context
from symgen.describe.parts.event_sections import read_event
from symgen.describe.parts.fields import OutputFunction, read_table, read_value, value_in_words
from symgen.describe.parts.holding_joints import formulas_of_holding, with_holding
from symgen.describe.parts.holds import body_holds, read_holds
from symgen.describe.parts.kinds import read_force
from symgen.describe.parts.limits import read_limits_of_entry
from symgen.describe.parts.meant_words import hint_on_section
from symgen.describe.parts.numbers import read_run_defaults, read_table_function
from symgen.describe.parts.own_units import in_own_unit
from symgen.describe.parts.parameters import Parameters
from symgen.describe.parts.passing_ropes import with_rope_sheaves, with_sliders
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.sections import MechanismSection, OutputSection
from symgen.describe.parts.states import read_state
from symgen.describe.run_defaults import Defaults
from symgen.describe.table_functions import shapes_of_curves

if TYPE_CHECKING:
    from symgen.describe.beams.beams import Beams
    from symgen.describe.modal.modal_bodies import ModalBodies

Raw = Mapping[str, Any]
T = TypeVar("T")


@without_garbage_collection()
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
        mechanism = with_remarks(_Validator(raw, source, Errors()).read_mechanism(), raw)
    return keep_origin(mechanism, raw, source)


@without_garbage_collection()
def collect_errors(raw: Raw, source: str) -> tuple[InputError, ...]:
    """Return all that is wrong with a description, as of `validate`: of each table the first thing.

    Errors that follow from tables which are wrong, such as joints of their bodies, are left out.
    """
    errors = Errors(all_of_them=True)
    with suppress(Incomplete), errors.part_of_description():
        _Validator(raw, source, errors).read_mechanism()
    return tuple(errors.found.values())


class _Validator:
    """One description being read, section by section."""

    def __init__(self, raw: Raw, source: str, errors: Errors) -> None:
        self.raw, self.source = raw, source
        self.errors = errors
        self._entries: dict[str, list[tuple[str, Any]]] = {}
        self._parts: frozenset[str] = frozenset()  # names of nodes and elements of beams, and of interfaces
        self._numbers = FormulaNames("a number or an expression of parameters", {})
        self._limits: list[OperatingLimit] = []  # of parameters and outputs

    def place_in_file(self, path: str) -> str:
        return f"{self.source}: {path}"

    def scope_of_entry(self, section: str, name: str, kind: str = "") -> Scope:
        return Scope(self.context, f"{section}.{name}", name, kind)

    def read_joint(self, name: str, where: str) -> Joint:
        return self.joints.resolve_joint(name, where)

    def read_each_entry(self, section: str, read: Callable[[str, Any], T]) -> tuple[T, ...]:
        """Return what `read` makes of name and content of a section's entries, each apart from the others."""
        results = []
        for name, value in self.named_entries(section):
            beam = (name.partition(".")[0],) if name in self._parts else ()  # whose further parts are wrong alike
            with self.errors.part_of_description(name, *beam):
                self.errors.leave_if_wrong(*beam)
                own = partial(read, name)
                # joints tell theirs as they are resolved
                results.append(own(value) if section == "joints" else self.errors.read_whole(own, value))
        return tuple(results)

    def read_head(self) -> MechanismSection:
        """Return the table that says what the mechanism is called, and in which space it lies."""
        for key, content in self.raw.items():
            if key not in SECTIONS:
                with self.errors.part_of_description(*(content if isinstance(content, Mapping) else ())):
                    expected, got = f"the sections {', '.join(SECTIONS)}", f"the unknown section {quote(key)}"
                    raise InputError(self.source, expected, got, hint_on_section(key, content, SECTIONS), key)
        where = self.place_in_file("mechanism")
        with self.errors.part_of_description():
            if "mechanism" not in self.raw:
                raise InputError(where, "a section [mechanism] with a name", "no such section")
            head = read_table(MechanismSection, self.raw["mechanism"], where)
            with self.errors.part_of_description():
                check_mechanism_name(head.name, f"{where}.name")
            return head
        # What is right in the rest depends on the space.
        table = self.raw.get("mechanism")
        if not isinstance(table, Mapping) or table.get("space", "planar") not in ("planar", "spatial"):
            raise Incomplete
        if "space" not in table and suggest("space", table).startswith("did you mean"):
            raise Incomplete
        return MechanismSection(name="", space=table.get("space", "planar"))

    def read_mechanism(self) -> Mechanism:
        head = self.read_head()
        self.refuse_shared_names()
        parameters = self.read_parameters()
        tables = self.read_each_entry(
            "tables", lambda name, value: read_table_function(name, value, self.place_in_file(f"tables.{name}"))
        )
        self.context = Context(
            self.source,
            {p.name: p.value for p in parameters if not p.input},
            {t.name: t for t in tables},
            {},
            self.read_joint,
            head.space,
            frozenset(name for name, _ in self.named_entries("joints")),
            inputs=tuple(p.name for p in parameters if p.input),
            state_names=tuple(name for name, _ in self.named_entries("states")),
        )
        scope = Scope(self.context, "mechanism")
        read_body = spatial_body if head.space == "spatial" else planar_body
        modal = self.read_modal_files()
        beams = self.read_beams(read_body)
        self.expand_modal_bodies(modal)
        self.joints = JointTables(self.raw.get("joints", {}), self.errors, self.place_in_file, self.scope_of_entry)
        gravity: Vec = ()
        with self.errors.part_of_description():
            given = {"gravity": [0.0] * scope.dimension if head.gravity is None else list(head.gravity)}
            gravity = self.errors.read_whole(lambda table: scope.vector("gravity", tuple(table["gravity"])), given)
        bodies = self.read_bodies(read_body, beams, modal)
        self.context = msgspec.structs.replace(self.context, bodies={body.name: body for body in bodies})
        joints = self.read_each_entry("joints", lambda name, _: self.read_joint(name, self.place_in_file("joints")))
        forces = () if modal is None else modal.forces(bodies)
        forces += self.read_each_entry("forces", lambda name, raw: read_force(name, raw, self.scope_of_entry))
        forces += tuple(self.joints.forces[joint.name] for joint in joints if joint.name in self.joints.forces)
        self.context = msgspec.structs.replace(self.context, forces={force.name: force for force in forces})
        holds, shapes = self.read_holds_and_shapes(bodies)
        holds += [] if modal is None else modal.holds(bodies)
        holds += [hold for joint in joints for hold in self.joints.starts.get(joint.name, ())]
        outlines = self.read_each_entry(
            "outlines", lambda name, raw: read_outline(self.scope_of_entry("outlines", name), raw)
        )
        self.context = msgspec.structs.replace(self.context, outlines={x.name: x for x in outlines})
        bounded = self.read_bounded_rows(joints)
        self.context = msgspec.structs.replace(self.context, losses=losses_by_name(bounded))
        defaults = self.read_run_defaults(one_line(head.source))
        states = self.read_each_entry(
            "states", lambda name, raw: read_state(self.scope_of_entry("states", name), name, raw)
        )
        outputs = self.read_each_entry("outputs", self.read_output)
        events = self.read_each_entry(
            "events", lambda name, value: read_event(self.scope_of_entry("events", name), name, value)
        )
        holding = [self.joints.holding[joint.name] for joint in joints if joint.name in self.joints.holding]
        self.errors.leave_if_any()
        mechanism = Mechanism(
            name=head.name,
            title=one_line(head.title),
            space=head.space,
            gravity=gravity,
            parameters=parameters,
            tables=(*tables, *(shapes_of_curves(any(row.across for row in bounded)) if self.joints.sliders else ())),
            bodies=(*bodies, *(x.body for x in self.joints.sliders)),  # type: ignore[arg-type]  # all of one space
            joints=joints,
            forces=forces,
            defaults=defaults,
            rotors=tuple(self.joints.rotors[joint.name] for joint in joints if joint.name in self.joints.rotors),
            bounded=tuple(row for row in bounded if not row.smooth),
            states=states,
            outputs=outputs,
            seats=tuple(self.joints.seats.items()),
            cuts=joints_with_multipliers(
                joints,
                [*(x.rate for x in states), *(o.value for o in outputs), *formulas_of_holding(holding)],
                self.joints.cuts,
            ),
            holds=tuple(holds),
            shapes=tuple(shapes),
            beams=b"" if beams is None else msgspec.json.encode(beams.count_elements()),
            events=events,
            limits=tuple(self._limits),
            author=one_line(head.author),
            revision=one_line(head.revision),
            remarks=tuple(map(one_line, head.remarks)),
            restitution_law=head.restitution_law,
        )
        with self.errors.part_of_description():
            mechanism = with_rope_sheaves(with_holding(mechanism, holding), self.joints.sheaves)
            mechanism = with_sliders(mechanism, self.joints.sliders)
            mechanism = rows_as_forces(with_bounded_outputs(mechanism), [row for row in bounded if row.smooth])
            check_columns(mechanism, self.source)
            check_bounds(mechanism, self.source)
            read_holds(mechanism, self.source)  # says what is held twice
        return mechanism

    # Names ---------------------------------------------------------------------------------------------------------

    def named_entries(self, section: str) -> Sequence[tuple[str, Any]]:
        """Return name and content of a section's entries, names checked."""
        if section not in self._entries:
            self._entries[section] = list(self.entries_with_right_names(section))
        return self._entries[section]

    def entries_with_right_names(self, section: str) -> Iterator[tuple[str, Any]]:
        """Yield name and content of a section's entries whose names are right."""
        content = self.raw.get(section, {})
        if not isinstance(content, Mapping):
            with self.errors.part_of_description():
                raise InputError(
                    self.place_in_file(section), f"a table of {section}, one entry a name", value_in_words(content)
                )
            raise Incomplete  # which names the rest may use is unknown
        for name, value in content.items():
            right = name in self._parts
            if not right:
                with self.errors.part_of_description(name):
                    right = bool(check_identifier(name, self.place_in_file(section), NAMED[section]))
            if right:
                yield name, value

    def read_bounded_rows(self, joints: Sequence[Joint]) -> tuple[BoundedRow, ...]:
        """Return the rows with bounds, those whose force has two bounds first."""
        rows = self.joints.bounded_rows(joints)
        for section, kind in sections_of_files().items():
            rows += self._bounded_rows_of_section(section, kind)
        return tuple(sorted(rows, key=lambda row: row.one_sided))

    def _bounded_rows_of_section(self, section: str, kind: SectionOfFiles) -> tuple[BoundedRow, ...]:
        """Return the rows with bounds of a section of their own."""
        read = self.read_each_entry(section, lambda name, value: kind.read(self.scope_of_entry(section, name), value))
        if again := name_of_two(read):
            got = f"'{again}', which is of a set of contacts too"
            raise InputError(self.place_in_file(f"{section}.{again}"), "a name used once", got)
        return tuple(row for rows in read for row in rows)

    def refuse_shared_names(self) -> None:
        """Refuse one name for two things whose results would carry the same label, or that a formula may confuse."""
        for group in (
            ("bodies", "beams", "joints", "forces", *sections_of_files()),
            ("parameters", "inputs", "states", "tables"),
            ("states", "outputs"),
        ):
            sections: dict[str, str] = {}
            for section in group:
                for name, _ in self.named_entries(section):
                    if name in sections:
                        with self.errors.part_of_description():
                            got = f"'{name}', which is a {NAMED[sections[name]]} already"
                            raise InputError(self.place_in_file(f"{section}.{name}"), "a name used once", got)
                    sections[name] = section

    def read_beams(self, read_body: Callable[[Scope, object], AnyBody]) -> Beams | None:
        """Put the nodes and elements of beams into the description; return the beams, None where there are none."""
        if not self.named_entries("beams"):
            return None
        from symgen.describe.beams.beams import Beams

        with self.errors.part_of_description(*(name for name, _ in self.named_entries("beams"))):
            beams = Beams(self.raw, self.scope_of_entry, read_body, self.errors)
            self.raw, self._parts = beams.expand(), frozenset((*beams.bodies, *beams.forces))
            self._entries.clear()
            return beams
        return None

    def read_modal_files(self) -> ModalBodies | None:
        """Return the modal bodies, whose files are found; None where there are none."""
        tables = dict(self.named_entries("bodies"))
        if not any(isinstance(table, Mapping) and table.get("type") == "modal" for table in tables.values()):
            return None
        from symgen.describe.modal.modal_bodies import ModalBodies
        from symgen.describe.modal.modal_file import with_whole_paths

        modal = ModalBodies(tables, self.scope_of_entry, self.errors)
        self.raw = with_whole_paths(self.raw, self.source)  # of which finer beams are described anew
        self._entries.clear()
        return modal

    def expand_modal_bodies(self, modal: ModalBodies | None) -> None:
        """Put the interfaces of modal bodies into the description."""
        if modal is None:
            return
        for section in ("joints", "forces"):
            for name, table in self.named_entries(section):
                if name not in self._parts and isinstance(table, Mapping):
                    with self.errors.part_of_description(name):
                        modal.refuse_frames(self.scope_of_entry(section, name), table)
        self.raw, self._parts = modal.expand(self.raw), self._parts | frozenset(modal.interfaces)
        self._entries.clear()

    def read_bodies(
        self, read_body: Callable[[Scope, object], AnyBody], beams: Beams | None, modal: ModalBodies | None
    ) -> tuple[AnyBody, ...]:
        """Return the bodies, the nodes of beams, and the interfaces of modal bodies."""
        bent = () if modal is None else (*modal.names, *modal.interfaces)

        def read_any_body(name: str, value: object) -> AnyBody:
            scope = self.scope_of_entry("bodies", name)
            if modal is not None and name in bent:
                return modal.read_body(scope, value)
            if modal is not None and modal.is_wrong(name, value):
                raise Incomplete
            return read_body(scope, value)

        bodies = self.read_each_entry("bodies", read_any_body)
        if not self.raw.get("bodies") and not self.raw.get("beams"):
            self.errors.leave_if_any()
            raise InputError(self.place_in_file("bodies"), "at least one body, [bodies.NAME]", "none")
        with self.errors.part_of_description(*(body.name for body in bodies)):
            return bodies if beams is None else tuple(map(beams.add_end_masses, bodies))
        return ()

    def read_holds_and_shapes(self, bodies: tuple[AnyBody, ...]) -> tuple[list[Hold], list[tuple[str, Shape]]]:
        """Return what bodies keep of their start, and what they and the ground look like."""
        holds, shapes = list[Hold](), list[tuple[str, Shape]]()
        with self.errors.part_of_description():
            ground = Scope(self.context, "mechanism", GROUND)
            shapes += [(GROUND, shape) for shape in read_shapes(ground, self.raw["mechanism"])]
        for body in bodies:
            scope, raw = self.scope_of_entry("bodies", body.name), self.raw["bodies"][body.name]
            with self.errors.part_of_description():
                holds += body_holds(scope, raw, body)
            with self.errors.part_of_description():
                shapes += [(body.name, shape) for shape in read_shapes(scope, raw)]
        return holds, shapes

    # Sections ------------------------------------------------------------------------------------------------------

    def read_run_defaults(self, source: str) -> Defaults:
        with self.errors.part_of_description():
            return read_run_defaults(self.raw.get("run", {}), self.place_in_file("run"), source)
        return Defaults()

    def read_parameters(self) -> tuple[Parameter, ...]:
        """Return the parameters in the order of the file, then the inputs, formulas worked out with the defaults."""
        sections = {section: dict(self.named_entries(section)) for section in ("parameters", "inputs")}
        reader = Parameters(self.source, self.errors, sections, [name for name, _ in self.named_entries("tables")])
        parameters, self._numbers = reader.read_all(), reader.names
        self._limits += reader.limits
        return parameters

    def read_output(self, name: str, raw: object) -> Output:
        where = self.place_in_file(f"outputs.{name}")
        if isinstance(raw, Mapping):
            section, key = read_table(OutputSection, raw, where), "value"
        else:
            section, key = OutputSection(value=read_value(OutputFunction, raw, where)), ""
        scope = self.scope_of_entry("outputs", name)
        unit = unit_of(section.unit or "m" * (section.ray is not None), f"{where}.unit")
        value = in_own_unit(scope, value_of_output(scope, key, section), unit)
        self._limits += read_limits_of_entry(name, section, unit, self._numbers, where, si=False)
        return Output(name, value, unit.text)
