"""Modal bodies of a mechanism file, read before joints and forces are.

Each becomes a body with modes, a body without coordinates for each of its interfaces, and one force of its springs and
dampers.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Literal

import msgspec

from symgen.base.errors import InputError, plural, quote, suggest
from symgen.base.files import file_beside
from symgen.base.vocabulary.expressions import (
    ONE,
    ZERO,
    Expr,
    Name,
    call,
    literal_of,
    product,
)
from symgen.base.vocabulary.measures import Effort, FormulaMeasure
from symgen.describe.mechanism import AnyBody, Body, Force, Hold, SpatialBody
from symgen.describe.modal.modal_file import SUFFIX, ModalFile, read_modal_file
from symgen.describe.modal_body import COORDINATE, SPEED, CarriedInterface, Modal
from symgen.describe.parts.bodies import is_modal, optional_vector, read_orientation
from symgen.describe.parts.collected import Errors
from symgen.describe.parts.fields import Held, ModeStart, Scalar, Text, Vector, read_table
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.sections import OrientationSection, ShapeSection

Raw = Mapping[str, Any]
#: The force of the springs and dampers of a modal body, after its name; no interface has this name.
ELASTIC = "elastic"


class AnyModalSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A body that bends, by its modes.

    Parameters
    ----------
    type : str
        ``"modal"``.
    file : str
        What ``symgen.reduced(...).save(...)`` has written: a ``.npz`` file in or below the folder of the mechanism
        file. It has mass, modes and interfaces; the body's frame is that of the nodes.
    damping : scalar
        Time of a Kelvin-Voigt material [s]; 0 by default.
    position : vector
        As of a rigid body.
    velocity : vector
        As of a rigid body.
    start : table
        Coordinates of modes and their velocities at the start, such as ``{ m1 = 0.002, vm1 = 0.1 }``; 0 by default.
        Assembly keeps all of them.
    hold : bool, str or list of str
        As of a rigid body.
    shape : table, or list of tables
        As of a rigid body; the outline of the file by default.
    """

    type: Literal["modal"]
    file: Text
    damping: Scalar = 0.0
    position: Vector | None = None
    velocity: Vector | None = None
    start: ModeStart | None = None
    hold: Held = False
    shape: ShapeSection | tuple[ShapeSection, ...] | None = None


class ModalSection(AnyModalSection, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A planar body that bends, by its modes.

    Parameters
    ----------
    angle : scalar
        As of a rigid body.
    angular_velocity : scalar
        As of a rigid body.
    """

    angle: Scalar | None = None
    angular_velocity: Scalar | None = None


class SpatialModalSection(AnyModalSection, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A spatial body that bends, by its modes.

    Parameters
    ----------
    orientation : table
        As of a rigid body.
    angular_velocity : vector
        As of a rigid body.
    """

    orientation: OrientationSection | None = None
    angular_velocity: Vector | None = None


class ModalBodies:
    """The modal bodies of a description.

    Parameters
    ----------
    tables : mapping
        The bodies of the description.
    scope_of : callable
        Scope of a section and a name.
    errors : Errors
        Where errors go.

    Attributes
    ----------
    interfaces : dict of str to (str, str)
        Name of each interface -> its host, and its name in the file of the host.
    """

    def __init__(self, tables: Raw, scope_of: Callable[[str, str], Scope], errors: Errors) -> None:
        self._files: dict[str, ModalFile] = {}
        self._damping: dict[str, Expr] = {}
        self.interfaces: dict[str, tuple[str, str]] = {}
        for name, table in tables.items():
            if is_modal(table):
                with errors.part_of_description(name):
                    self._read_file(scope_of("bodies", name), name, table)

    def _read_file(self, scope: Scope, name: str, table: Raw) -> None:
        file, where = table.get("file"), scope.where("file")
        if not isinstance(file, str):
            raise InputError(where, "the name of a file that symgen.reduced has written", _found(file))
        what = f"the path of a {SUFFIX} file that symgen.reduced has written"
        path = file_beside(where, getattr(scope.context.source, "folder", ""), file, (SUFFIX,), what)
        content = read_modal_file(where, path)
        if content.dimension != scope.dimension:
            kinds = {2: "planar", 3: "spatial"}
            own, needed = kinds[content.dimension], kinds[scope.dimension]
            raise InputError(where, f"a {needed} body for a {needed} mechanism", f"{quote(file)}, which is {own}")
        for interface in content.interfaces:
            if interface == ELASTIC:
                hint = "reduce it with another name"
                raise InputError(where, f"interfaces that are not called '{ELASTIC}'", quote(file), hint)
            self.interfaces[f"{name}.{interface}"] = name, interface
        self._files[name] = content

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the bodies."""
        return tuple(self._files)

    def is_wrong(self, name: str, table: object) -> bool:
        """Whether a body is a modal one whose file could not be read, as was said."""
        return is_modal(table) and name not in self._files

    def expand(self, raw: Raw) -> dict[str, Any]:
        """Return the description with a table for each interface, after its body."""
        bodies = dict[str, Any]()
        for name, table in raw["bodies"].items():
            bodies[name] = table
            bodies |= {part: {} for part, (host, _) in self.interfaces.items() if host == name}
        return {**raw, "bodies": bodies}

    # -- bodies --------------------------------------------------------------------------------------------------------

    def read_body(self, scope: Scope, raw: object) -> AnyBody:
        """Return the body that a scope names: a modal one, or an interface of one."""
        if scope.name in self.interfaces:
            return self._interface(scope, *self.interfaces[scope.name])
        content = self._files[scope.name]
        given = raw if isinstance(raw, Mapping) else {}
        table = {key: value for key, value in given.items() if key != "shape"}
        section: Any = read_table(SpatialModalSection if scope.spatial else ModalSection, table, scope.where(""))
        damping = scope.constant("damping", section.damping)
        if scope.value(damping, "damping") < 0.0:
            raise scope.error("damping", "a time that is not negative", repr(scope.value(damping, "damping")))
        self._damping[scope.name] = damping
        modal = Modal(
            growth=content.growth,
            second=content.second,
            cross=content.cross,
            stiffness=content.stiffness,
            mass=content.mass,
            inner=content.inner,
            rows=content.rows,
            outline=content.outline,
            stretches=content.stretches,
            couples=content.couples,
            softening=content.softening,
            stiffened=content.stiffened,
        )
        modal = msgspec.structs.replace(modal, start=_read_start(scope, section.start or {}, modal))
        nothing = (0.0,) * scope.dimension
        common: dict[str, Any] = {
            "name": scope.name,
            "mass": literal_of(content.mass),
            "centre_of_mass": tuple(map(literal_of, content.centre)),
            "position": scope.vector("position", nothing if section.position is None else section.position),
            "velocity": optional_vector(scope, "velocity", section.velocity),
            "modal": modal,
        }
        if scope.spatial:
            (xx, xy, xz), (_, yy, yz), (_, _, zz) = content.inertia
            return SpatialBody(
                inertia=tuple(map(literal_of, (xx, yy, zz, xy, xz, yz))),  # type: ignore[arg-type]  # six
                orientation=read_orientation(scope, "orientation", section.orientation),
                angular_velocity=optional_vector(scope, "angular_velocity", section.angular_velocity),
                **common,
            )
        return Body(
            inertia=literal_of(content.inertia[0][0]),
            angle=ZERO if section.angle is None else scope.constant("angle", section.angle),
            angular_velocity=scope.optional("angular_velocity", section.angular_velocity),
            **common,
        )

    def _interface(self, scope: Scope, host: str, name: str) -> AnyBody:
        content = self._files[host]
        frame = content.interfaces[name]
        place = tuple(x - c for x, c in zip(frame.place, content.centre, strict=True))
        carried = CarriedInterface(host, place, frame.shape, frame.turn, frame.load, frame.curve, frame.twist)
        if scope.spatial:
            return SpatialBody(scope.name, ZERO, (ONE, ONE, ONE, ZERO, ZERO, ZERO), carried=carried)
        return Body(scope.name, ZERO, ONE, carried=carried)

    # -- what belongs to them ------------------------------------------------------------------------------------------

    def forces(self, bodies: tuple[AnyBody, ...]) -> tuple[Force, ...]:
        """Return strain energy and damping of each modal body, as efforts along the coordinates of its modes."""
        return tuple(self._elastic(body, body.modal) for body in bodies if body.modal is not None)

    def _elastic(self, body: AnyBody, modal: Modal) -> Force:
        efforts, time = list[Effort](), self._damping[body.name]
        for label, stiffness in zip(modal.names(COORDINATE), modal.stiffness, strict=True):
            drag = ZERO if time == ZERO else call("neg", product(time, literal_of(stiffness), Name("rate")))
            potential = product(literal_of(0.5 * stiffness), Name("s"), Name("s"))
            efforts.append(Effort(label, FormulaMeasure(Name(f"{body.name}.{label}")), drag, potential))
        return Force(f"{body.name}.{ELASTIC}", "modal", (body.name,), tuple(efforts))

    def holds(self, bodies: tuple[AnyBody, ...]) -> list[Hold]:
        """Return the modes, which a start keeps unless it names them: assembly moves bodies, and bends none."""
        return [
            Hold(f"{body.name}.{label}")
            for body in bodies
            if body.modal is not None
            for label in (*body.modal.names(COORDINATE), *body.modal.names(SPEED))
        ]

    def refuse_frames(self, scope: Scope, table: Raw) -> None:
        """Refuse a joint or force on the floating frame of a modal body, which is no part of its material."""
        named = [("between", name) for name in _as_names(table.get("between"))]
        named += [("bodies", name) for name in _as_names(table.get("bodies"))]
        named += [(key, table[key]) for key in ("body", "carrier") if isinstance(table.get(key), str)]
        for key, name in named:
            if name in self._files:
                faces = [part for part, (host, _) in self.interfaces.items() if host == name]
                expected = f"an interface of the modal body '{name}'" if faces else "a body with interfaces"
                hint = f"it has {', '.join(faces)}" if faces else "symgen.reduced(..., interfaces=...) makes them"
                raise scope.error(key, expected, f"'{name}', whose floating frame is no part of its material", hint)
            host, _, part = name.partition(".")
            if part and host in self._files and name not in self.interfaces:
                hint = suggest(name, [face for face, (own, _) in self.interfaces.items() if own == host])
                raise scope.error(
                    key, f"an interface of the modal body '{host}'", f"the unknown one {quote(part)}", hint
                )


def _as_names(value: object) -> list[str]:
    return [name for name in value if isinstance(name, str)] if isinstance(value, list | tuple) else []


def _found(value: object) -> str:
    return "no such key" if value is None else quote(value)


def _read_start(scope: Scope, start: Mapping[str, float | str], modal: Modal) -> tuple[tuple[str, Expr], ...]:
    """Return the coordinates and velocities of modes that the table of a body gives."""
    names = (*modal.names(COORDINATE), *modal.names(SPEED))
    for key in start:
        if key not in names:
            has = plural(len(modal.stiffness), "mode")
            expected = f"m1 to m{len(modal.stiffness)} or vm1 to vm{len(modal.stiffness)}, as the body has {has}"
            raise scope.error("start", expected, quote(key), suggest(key, names))
    return tuple((key, scope.constant(f"start.{key}", value)) for key, value in start.items())
