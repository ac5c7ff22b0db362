"""Tables of joints in a mechanism file: joints may refer to each other, so that each is resolved on demand."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import msgspec

from symgen.base.errors import InputError, quote, suggest
from symgen.base.vocabulary.expressions import ONE, call
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.keys import keys_of_any_joint, rows_of_joint
from symgen.describe.mechanism import Force, Hold, Joint, Rotor
from symgen.describe.parts.collected import Errors, Incomplete, further_errors
from symgen.describe.parts.fields import Flag, JointStart, Scalar, read_table, read_value, value_in_words
from symgen.describe.parts.held_places import at_present_place
from symgen.describe.parts.holding_keys import ReadHolding, read_holding
from symgen.describe.parts.holds import joint_holds
from symgen.describe.parts.kinds import JOINTS, check_points, kind_and_keys
from symgen.describe.parts.passing_ropes import CurveSlider, RopeSheave
from symgen.describe.parts.topology import articulation_of_joint

if TYPE_CHECKING:
    from symgen.base.vocabulary.measures import Marker
    from symgen.describe.parts.scope import Scope

#: Joints in a chain of references.
LONGEST_CHAIN = 20


class JointTables:
    """The tables of joints.

    Parameters
    ----------
    tables : mapping of str to object
        Joint -> its table.
    errors : Errors
        Errors of the description.
    where : callable
        Takes a path, such as ``joints.A.type``; returns what a message begins with.
    scope : callable
        Takes a section, a name and a kind; returns the scope in which an entry is resolved.

    Attributes
    ----------
    seats, starts, rotors : dict
        Joint -> its point ``at``, what its table says of the start, and its rotor, of those that have one.
    cuts : list of str
        Joints that carry nothing in a tree.
    forces : dict
        Joint -> the force in place of its rows, of those that give way.
    holding : dict
        Joint -> when its rows are in force, of those that hold for a while.
    sheaves, sliders : list
        Sheaves that ropes may leave, and what points add that slide along curves.
    """

    def __init__(
        self, tables: Mapping[str, Any], errors: Errors, where: Callable[[str], str], scope: Callable[..., Scope]
    ) -> None:
        self.tables, self.errors, self.where, self.scope = tables, errors, where, scope
        self.seats: dict[str, Marker] = {}
        self.starts: dict[str, tuple[Hold, ...]] = {}
        self.rotors: dict[str, Rotor] = {}
        self.cuts: list[str] = []
        self.forces: dict[str, Force] = {}
        self.holding: dict[str, ReadHolding] = {}
        self.sheaves: list[RopeSheave] = []
        self.sliders: list[CurveSlider] = []
        self._joints: dict[str, Joint | None] = {}
        self._implied: dict[str, Mapping[str, Any]] = {}  # keys that tables have without naming them
        self._open = 0  # joints being resolved, each because the one before refers to it
        self._scopes: dict[str, tuple[Scope, Joint]] = {}  # in the order in which joints are resolved
        self._keys = tuple(keys_of_any_joint())

    def resolve_joint(self, name: str, where: str) -> Joint:
        """Return the joint `name`, resolved now if another one asks for it first."""
        if name not in self.tables:
            got = f"the unknown joint {quote(name)}"
            raise InputError(where, "the name of a joint", got, suggest(name, self.tables))
        if name in self._joints:
            self.errors.leave_if_wrong(name)
            resolved = self._joints[name]
            if resolved is None:
                raise InputError(where, "a joint that stands by itself", f"'{name}', which leads back to this one")
            return resolved
        self._joints[name] = None
        self._open += 1
        with self.errors.part_of_description(name):
            if self._open > LONGEST_CHAIN:
                raise InputError(where, f"joints that refer to each other in at most {LONGEST_CHAIN} steps", "more")
            try:
                self._joints[name] = joint = self._read_joint(name, self.tables[name])
            except InputError as error:
                if self.errors.all_of_them:
                    error.further += further_errors(partial(self._read_whole_joint, name), self.tables[name], error)
                raise
            self._open -= 1
            return joint
        self._open -= 1
        raise Incomplete

    def _read_whole_joint(self, name: str, table: Mapping[str, Any]) -> None:
        """Read a table of a joint with its rows that have bounds, which other tables wait for."""
        joint = self._read_joint(name, table)
        self._rows_with_bounds(self._scopes.pop(name)[0], joint, table)

    def _rows_with_bounds(self, scope: Scope, joint: Joint, table: Mapping[str, Any]) -> tuple[BoundedRow, ...]:
        table = {**self._implied.get(joint.name, {}), **table}
        taken = _taken_keys(JOINTS.get(joint.kind), table)
        return tuple(rows_of_joint(scope, joint, {k: x for k, x in table.items() if k not in taken}))

    def _read_joint(self, name: str, whole: Mapping[str, Any]) -> Joint:
        """Return the joint `name`, and note what else its table says."""
        where = self.where(f"joints.{name}")
        kind, table = kind_and_keys(where, whole, "joint type")
        struct = JOINTS.get(kind, f"{where}.type")
        check_points(struct, kind, where)
        shared = tuple(key for key in self._keys if key not in _taken_keys(struct, whole))
        table = {key: value for key, value in table.items() if key not in shared}
        scope = self.scope("joints", name, JOINTS.resolve_alias(kind))
        scope.check_space(struct.SPACES)
        section = read_table(struct, table, where, ("type", *shared))
        joint = at_present_place(scope, section.build(scope), whole)
        if (give := getattr(section, "give", None)) is not None and (force := give(scope)) is not None:
            self.forces[name] = force
        if (sheaves := getattr(section, "sheaves", None)) is not None:
            self.sheaves += sheaves(scope)
        if (slider := getattr(section, "slider", None)) is not None:
            self.sliders.append(slider(scope))
            self._implied[name] = getattr(section, "implied", dict)()
        scope.coordinates = {label: joint.unit(label) for label, _ in joint.coordinates}
        at = getattr(section, "at", None)
        if at is not None:
            point = at[0] if hasattr(section, "between") else at
            self.seats[name] = scope.marker("at", joint.bodies[0], point)
        if "start" in whole:
            self.starts[name] = joint_holds(scope, read_value(JointStart, whole["start"], f"{where}.start"), joint)
        if read_value(Flag, whole.get("cut", False), f"{where}.cut"):
            if articulation_of_joint(joint) is None:
                got = f"a {joint.kind} joint, which has rows in any case"
                raise InputError(f"{where}.cut", "a joint that can carry a body", got)
            self.cuts.append(name)
        if (rotor := rotor_of(scope, joint, whole)) is not None:
            self.rotors[name] = rotor
        self._scopes[name] = scope, joint
        if "clearance" in whole:  # a contact is in place of its rows
            for key in ("friction", "cut"):
                if key in whole:
                    raise scope.error(key, "no such key beside clearance", value_in_words(whole[key]))
            joint = msgspec.structs.replace(joint, kind="place", rows=())
            self._joints[name] = joint
        return joint

    def bounded_rows(self, joints: Sequence[Joint]) -> list[BoundedRow]:
        """Return the rows with bounds of all joints, and note which joints have their reactions as multipliers."""
        rows, cuts = dict[str, tuple[BoundedRow, ...]](), list[str]()
        for name, (scope, joint) in self._scopes.items():  # after all joints, as formulas may read any
            with self.errors.part_of_description(name):
                read = partial(self._rows_with_bounds, scope, joint)
                rows[name] = self.errors.read_whole(read, self.tables[name])
                own = self.scope("joints", name, joint.kind)
                if (holding := read_holding(own, joint, self.tables[name])) is not None:
                    self.holding[name] = holding
            if name in self.cuts or any(row.pressed for row in rows.get(name, ())):
                cuts.append(name)  # its reaction is a multiplier
        self.cuts = cuts
        return [row for joint in joints for row in rows.get(joint.name, ())]


def _taken_keys(kind: object, table: Mapping[str, Any]) -> set[str]:
    """Return the keys of joints of any kind that a kind reads itself."""
    takes: Mapping[str, str] = getattr(kind, "TAKES", {})
    return {key for key, beside in takes.items() if beside in table}


def rotor_of(scope: Scope, joint: Joint, table: Mapping[str, Any]) -> Rotor | None:
    """Return the rotor of a joint, None where its table has none."""
    if "rotor_inertia" not in table:
        if "gear_ratio" in table:
            raise scope.error("gear_ratio", "the key rotor_inertia beside it", "no such key")
        return None
    angles = [measure for label, measure in joint.coordinates if Joint.unit(label) == "rad"]
    if not angles and len(joint.coordinates) == 1:  # a slide, which the rotor drives by a spindle or a belt
        angles = [measure for _, measure in joint.coordinates]
    if len(angles) != 1:
        got = f"a {joint.kind} joint with {len(angles) or 'none'}"
        raise scope.error("rotor_inertia", "a joint with one angle, or one displacement alone", got)
    inertia, ratio = (
        scope.constant(key, read_value(Scalar, table.get(key, 1.0), scope.where(key)), positive=positive)
        for key, positive in (("rotor_inertia", True), ("gear_ratio", False))
    )
    if ratio != ONE:
        inertia = call("mul", inertia, call("mul", ratio, ratio))
    way = articulation_of_joint(joint)
    axes = (way.of_a[2], way.of_b[2]) if way is not None and way.turn == "axis" and way.of_a else ()
    return Rotor(joint.name, angles[0], inertia, axes)
