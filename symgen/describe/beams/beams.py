"""Beams of a mechanism file: each becomes bodies, the nodes, and beam elements between them before validation.

A node has the mass and the rotary inertia of the beam at its place, by the weights of a rule of integration that is
exact for cubics and positive (Gregory's, of fourth order), so that mass, centre of mass and moments of inertia of the
beam are exact, and frequencies converge as its elements do while M stays diagonal. A node at a vertex of a line has the
masses of the ends of two segments, and the elements before and after it have their own axes there.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import msgspec

from symgen.base.errors import quote, suggest
from symgen.base.vocabulary.expressions import (
    ONE,
    ZERO,
    Expr,
    call,
    difference,
    product,
    sum_of_terms,
)
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.beams.beam_lines import CrossSection, Segment, beam_segments, cross_sections
from symgen.describe.beams.beam_sections import BeamSection, Properties, section_properties
from symgen.describe.beams.node_tables import (
    BodyMass,
    RigidMotion,
    add_mass,
    body_axes,
    in_frame,
    node_velocities,
    pose_keys,
    rigid_motion,
    section_mass,
    write_vector,
)
from symgen.describe.formulas.formula_text import file_value, to_text
from symgen.describe.mechanism import AnyBody, Vec
from symgen.describe.parts.bodies import is_modal
from symgen.describe.parts.collected import Errors
from symgen.describe.parts.fields import read_table, value_in_words
from symgen.describe.parts.kinds import FORCES, JOINTS
from symgen.describe.parts.scope import CENTRE, Scope

Raw = Mapping[str, Any]
#: Names of the nodes at the ends, and of elements and loads, after a beam's name.
START, END, ELEMENT, LOAD = "start", "end", "e", "load"
_PLACE = re.compile(r"at\(\s*([0-9.eE+-]+)\s*\)")
#: Coordinates of the place in a load by length.
_OWN = re.compile(r"(?<![A-Za-z0-9_.])([xyz])(?![A-Za-z0-9_.])")
#: A place within this part of a beam's length from a node is at the node.
_NEAR = 1e-6
#: Axes of a body in its own frame.
_UNTURNED = {n: tuple(tuple(ONE if i == j else ZERO for j in range(n)) for i in range(n)) for n in (2, 3)}


@dataclass(frozen=True)
class _Seat:
    """A node of elements: a body, the place in its frame, and directions x and y there of each cross section."""

    body: str
    place: str | list[float | str]
    sides: list[tuple[Vec, ...]]

    def written_axis(self, section: int, i: int) -> list[float | str]:
        """Return direction x or y of a cross section as written in a file."""
        return write_vector(self.sides[section][i])


class Beams:
    """The beams of a description.

    Parameters
    ----------
    raw : mapping
        The description.
    scope_of : callable
        Scope of a section and a name.
    body_of : callable
        Reads the body that a scope names from its table.
    errors : Errors
        Where errors go.

    Attributes
    ----------
    bodies, forces : dict
        Nodes, and bodies with further points; elements and loads, as a description has them.
    """

    def __init__(
        self,
        raw: Raw,
        scope_of: Callable[[str, str], Scope],
        body_of: Callable[[Scope, object], AnyBody],
        errors: Errors,
    ) -> None:
        self.raw, self.scope_of, self.body_of, self.errors = raw, scope_of, body_of, errors
        self._nodes: dict[str, list[tuple[str, float]]] = {}  # of a beam, "" for a clamped end, and parts of its length
        self._counts: dict[str, list[int]] = {}  # elements of the segments of a beam
        self._curves: dict[str, tuple[list[_Seat], float | str | None]] = {}  # with the length of elements
        self._further: dict[str, list[BodyMass]] = {}  # of bodies, besides those of their tables
        self._centres: dict[str, Any] = {}  # of bodies that ends are clamped to, in their frames
        self.bodies: dict[str, Any] = {}
        self.forces: dict[str, Any] = {}

    def expand(self) -> dict[str, Any]:
        """Return the description without beams: with their nodes after its bodies and their elements before its forces.

        Raises
        ------
        InputError
            At the first error in a beam.
        """
        for name, table in self.raw["beams"].items():
            scope = self.scope_of("beams", name)
            with self.errors.part_of_description(name):
                self._add_beam(scope, name, read_table(BeamSection, table, scope.where("")))
        self.errors.leave_if_wrong(*self.raw["beams"])
        raw = {key: dict(value) if key in ("joints", "forces") else value for key, value in self.raw.items()}
        for section in ("joints", "forces"):
            for name, table in self.raw.get(section, {}).items():
                if isinstance(table, Mapping):
                    del raw[section][name]
                    with self.errors.part_of_description(name):
                        raw[section][name] = self._replace_beams_by_nodes(
                            self.scope_of(section, name), dict(table), section
                        )
        del raw["beams"]
        return raw | {
            "bodies": {**self.raw.get("bodies", {}), **self.bodies},
            "forces": {**self.forces, **raw.get("forces", {})},
        }

    def count_elements(self) -> dict[str, Any]:
        """Return the description with the number of elements of each segment of its beams."""
        beams = {name: {**table, "elements": self._counts[name]} for name, table in self.raw["beams"].items()}
        return {**self.raw, "beams": beams}

    def add_end_masses(self, body: AnyBody) -> AnyBody:
        """Return a body with the masses of the ends of beams that are part of it."""
        for further in self._further.get(body.name, ()):
            body = add_mass(body, further)
        return body

    # -- nodes and elements ------------------------------------------------------------------------------------------

    def _add_beam(self, scope: Scope, name: str, beam: BeamSection) -> None:
        if beam.load is not None and any(x in scope.context.states for x in "xyz"):
            raise scope.error("load", "x, y and z to mean the place", "a parameter or an input of that name")
        line, properties = beam_segments(scope, beam), section_properties(scope, beam)
        longer = _longer_than_line(scope, beam, line)
        properties = replace(properties, mass=product(properties.mass, longer))
        clamps = (beam.clamp, "") if isinstance(beam.clamp, str) else beam.clamp
        if len(clamps) != 2:
            raise scope.error(
                "clamp", "one body, or two: that of the start and that of the end", value_in_words(beam.clamp)
            )
        nodes, motion, seats = cross_sections(scope, line), rigid_motion(scope, beam, line[0].start), list[_Seat]()
        last = len(nodes) - 1
        self._counts[name], self._nodes[name] = [segment.elements for segment in line], []
        for k, sections in enumerate(nodes):
            node = f"{name}.{ {0: START, last: END}.get(k, k) }"
            host = {0: clamps[0], last: clamps[1]}.get(k, "")
            self._nodes[name].append(("" if host else node, sections[0].part))
            if host:
                seats.append(self._clamped_seat(scope, host, sections[0], properties, beam.cable))
            else:
                seats.append(self._node_seat(node, beam, sections, properties, motion))
            if beam.load is not None and host != GROUND:
                at = self._name_clamped_point(host, node.replace(".", "_"), seats[-1].place) if host else CENTRE
                size, place = sum_of_terms(*(section.share for section in sections)), f"{host}.{at}" if host else node
                load = [_load_on_node(size, part, place) for part in beam.load]
                self.forces[f"{name}.{LOAD}{k}"] = {"type": "force", "body": host or node, "at": at, "force": load}
        self._curves[name] = seats, file_value(product(line[0].step, longer)) if len(line) == 1 else None
        k = 0
        for segment in line:
            element = _element_of_segment(beam, properties, segment, product(segment.step, longer), scope.spatial)
            for _ in range(segment.elements):
                a, b, k = seats[k], seats[k + 1], k + 1
                keys: dict[str, Any] = {"between": [a.body, b.body], "at": [a.place, b.place]}
                if not beam.cable:
                    keys["axis"] = [a.written_axis(-1, 0), b.written_axis(0, 0)]
                    if scope.spatial:
                        keys["reference"] = [a.written_axis(-1, 1), b.written_axis(0, 1)]
                self.forces[f"{name}.{ELEMENT}{k}"] = element | keys

    def _node_seat(
        self,
        name: str,
        beam: BeamSection,
        sections: list[CrossSection],
        properties: Properties,
        motion: RigidMotion | None,
    ) -> _Seat:
        """Return the seat of a node, which becomes a body."""
        vertex, own = len(sections) > 1, sections[0]
        dimension = len(own.place)
        unturned = _UNTURNED[dimension]
        (mass, inertia), *others = (section_mass(properties, s, s.axes if vertex else None) for s in sections)
        if beam.cable:
            whole = sum_of_terms(mass, *(further for further, _ in others))
            moving = {} if motion is None else {"velocity": node_velocities(own, motion)["velocity"]}
            keys = {"type": "point", "mass": file_value(whole), "hold": beam.hold}
            self.bodies[name] = keys | {"position": write_vector(own.place)} | moving
            return _Seat(name, CENTRE, [unturned] * len(sections))
        if vertex:  # it has no direction of its own
            own = replace(own, axes=unturned, angle=ZERO)
            self._further[name] = [BodyMass((ZERO,) * dimension, *other) for other in others]
        self.bodies[name] = {
            "mass": file_value(mass),
            "inertia": write_vector(inertia) if dimension == 3 else file_value(*inertia),
            "hold": beam.hold,
            **pose_keys(own),
            **({} if motion is None else node_velocities(own, motion)),
        }
        return _Seat(name, CENTRE, [section.sides if vertex else unturned for section in sections])

    def _name_clamped_point(self, body: str, name: str, place: str | list[float | str]) -> str:
        """Return the name of a further point of a body with a clamped end."""
        table = self.bodies.get(body, self.raw["bodies"][body])
        points = table.get("points", {})
        while name in points:
            name += "_"
        self.bodies[body] = {**table, "points": {**points, name: place}}
        return name

    def _clamped_seat(self, scope: Scope, name: str, end: CrossSection, properties: Properties, hinged: bool) -> _Seat:
        """Return the seat of a clamped end on its body, which takes its mass; of a cable a point mass may be."""
        if name == GROUND:
            return _Seat(name, write_vector(end.place), [end.sides])
        bodies = self.raw.get("bodies", {})
        if name not in bodies:
            got = f"the unknown body {quote(name)}"
            raise scope.error("clamp", "the name of a body or 'ground'", got, suggest(name, [*bodies, GROUND]))
        if is_modal(bodies[name]):
            hint = "a rigid joint holds the end of a beam on an interface"
            raise scope.error("clamp", "a rigid body or 'ground'", f"the modal body '{name}'", hint)
        body = self.body_of(self.scope_of("bodies", name), bodies[name])
        if body.is_point and not hinged:
            raise scope.error("clamp", "a body with an angle", f"the point mass '{name}'")
        frame = body_axes(scope, body)
        (place,) = in_frame(frame, [tuple(map(difference, end.place, body.position))])
        mass = BodyMass(place, *section_mass(properties, end, in_frame(frame, end.axes)))
        self._further.setdefault(name, []).append(mass)
        self._centres[name] = write_vector(body.centre_of_mass)
        return _Seat(name, write_vector(place), [in_frame(frame, end.sides)])

    # -- names of nodes ----------------------------------------------------------------------------------------------

    def _replace_beams_by_nodes(self, scope: Scope, table: dict[str, Any], section: str) -> dict[str, Any]:
        """Return the table of a joint or force with beams and places on them replaced by nodes.

        Clamped beams do not move a body's centre of mass.
        """
        if isinstance(table.get("beam"), str):
            return self._curve_of_beam(scope, table)
        pair, at = isinstance(table.get("between"), list | tuple), table.get("at")
        bodies = list(table["between"]) if pair else [table.get("body")]
        places = [at] if not pair else list(at) if isinstance(at, list | tuple) else []
        places += [None] * (len(bodies) - len(places))
        before = [*bodies, *places]
        for i, body in enumerate(bodies):
            if not isinstance(body, str):
                continue
            if body in self._nodes:
                bodies[i], places[i] = self._node_at(scope, body, places[i]), CENTRE
            elif body in self._centres and (places[i] == CENTRE or (places[i] is None and not pair)):
                places[i] = self._centres[body]
        if [*bodies, *places] == before:
            return table
        kinds: Any = JOINTS if section == "joints" else FORCES
        kind = table.get("type")
        table |= {"between": bodies, "at": places} if pair else {"body": bodies[0], "at": places[0]}
        if isinstance(kind, str) and kind in kinds and "at" not in kinds.get(kind).__struct_fields__:
            del table["at"]
        return table

    def _curve_of_beam(self, scope: Scope, table: dict[str, Any]) -> dict[str, Any]:
        """Return the table of a joint on a beam with the stations of the beam's curve in its place."""
        beam = table.pop("beam")
        if beam not in self._curves:
            got = f"the unknown beam {quote(beam)}"
            raise scope.error("beam", "the name of a beam", got, suggest(beam, self._curves))
        seats, step = self._curves[beam]
        if step is None:
            got = f"'{beam}', a line of {len(self._counts[beam])} segments"
            raise scope.error("beam", "a beam without corners, at which the velocity would jump", got)
        along = [{"body": seat.body, "at": seat.place} for seat in seats]
        if not self.raw["beams"][beam].get("cable", False):
            along = [{**x, "axis": seat.written_axis(0, 0)} for x, seat in zip(along, seats, strict=True)]
        return table | {"along": along, "step": step}

    def _node_at(self, scope: Scope, beam: str, at: object) -> str:
        """Return the node of a beam at one of its ends, by its number, or at a place."""
        nodes = self._nodes[beam]
        last = len(nodes) - 1
        expected = f"a node of the beam '{beam}': '{START}', '{END}', a number up to {last}, or 'at(0.5)' of its length"
        numbers = {START: 0, END: last} | {str(k): k for k in range(last + 1)}
        place = _PLACE.fullmatch(at) if isinstance(at, str) else None
        if place is not None:
            try:
                part = float(place.group(1))
            except ValueError:
                raise scope.error("at", expected, value_in_words(at)) from None
            k = min(range(last + 1), key=lambda i: abs(nodes[i][1] - part))
            if abs(nodes[k][1] - part) > _NEAR:
                hint = f"the nearest node is number {k}, at({nodes[k][1]:g})"
                raise scope.error("at", expected, f"{value_in_words(at)}, where no node is", hint)
        elif isinstance(at, bool) or not isinstance(at, int | str) or str(at) not in numbers:
            raise scope.error("at", expected, "no such key" if at is None else value_in_words(at))
        else:
            k = numbers[str(at)]
        if not nodes[k][0]:
            got = f"the end of '{beam}' that is clamped to a body"
            raise scope.error("at", "a node that moves by itself", got, "name that body and a point of it")
        return nodes[k][0]


def _longer_than_line(scope: Scope, beam: BeamSection, line: list[Segment]) -> Expr:
    """Return the unloaded length of a cable over the length of its line; 1 without such a key."""
    if beam.length is None:
        return ONE
    length = scope.constant("length", beam.length, positive=True)
    return call("div", length, sum_of_terms(*(segment.length for segment in line)))


def _element_of_segment(
    beam: BeamSection, properties: Properties, segment: Segment, step: Expr, spatial: bool
) -> dict[str, Any]:
    """Return the table of the elements of a segment, of a length, but for their ends."""
    element: dict[str, Any] = {}
    if beam.cable:
        stiffness, length = f"({properties.stiffness['axial']})/({to_text(step)})", to_text(step)
        pull = f"{stiffness}*max(length - ({length}), 0.0)"
        element |= {"type": "spring-damper", "free_length": file_value(step)}
        element["potential"] = f"0.5*{pull}*max(length - ({length}), 0.0)"
        if beam.damping != 0.0:  # at most what the stiffness gives, so that no element pushes
            damper = f"-({beam.damping})*{stiffness}*rate"
            element["actuator"] = f"max(min({damper}, {pull}), -({pull}))"
        return element
    element |= {"type": "beam", "length": file_value(step), "damping": msgspec.to_builtins(beam.damping)}
    element |= properties.stiffness
    if segment.bend != ZERO:
        bend = file_value(segment.curvature)
        element["curvature"] = [0.0, 0.0, bend] if spatial else bend
    return element


def _load_on_node(size: Expr, part: float | str, node: str) -> str:
    """Return a load by length, times the length of beam that a node has, at that node."""
    own = _OWN.sub(lambda match: f"{node}.{match.group()}", str(part))
    return f"({to_text(size)})*({own})"
