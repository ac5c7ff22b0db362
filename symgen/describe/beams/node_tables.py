"""Tables of the nodes of beams, and the masses that beams put on nodes and bodies."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import msgspec

from symgen.base.vocabulary.expressions import (
    ZERO,
    Expr,
    call,
    difference,
    literal_of,
    product,
    scalar_product_of,
    sum_of_terms,
    vector_product,
)
from symgen.base.vocabulary.rotations import rotation_matrix_of
from symgen.describe.beams.beam_lines import CrossSection
from symgen.describe.beams.beam_sections import BeamSection, Properties
from symgen.describe.formulas.evaluate import scalar_values
from symgen.describe.formulas.formula_text import file_value
from symgen.describe.formulas.start import euler_parameters
from symgen.describe.mechanism import AnyBody, Body, Vec
from symgen.describe.parts.bodies import shift_tensor
from symgen.describe.parts.scope import Scope


@dataclass(frozen=True)
class BodyMass:
    """The end of a line on a body: its place in the frame of that body, its mass, and its inertia in that frame.

    In space the inertia is a tensor of six entries.
    """

    place: Vec
    mass: Expr
    inertia: tuple[Expr, ...]


#: A point of a rigid beam, its velocity, and three components of the angular velocity.
RigidMotion = tuple[Vec, Vec, Vec]


def rigid_motion(scope: Scope, beam: BeamSection, start: Vec) -> RigidMotion | None:
    """Return the rigid-body motion of a beam at the start, None where its table has no velocities."""
    if beam.velocity is None and beam.angular_velocity is None:
        return None
    velocity = scope.vector("velocity", (0.0,) * scope.dimension if beam.velocity is None else beam.velocity)
    count, turning = (3 if scope.spatial else 1), beam.angular_velocity
    omega = scope.several("angular_velocity", 0.0 if turning is None else turning, count, alike=turning is None)
    return start, velocity, (*(ZERO,) * (3 - count), *omega)


def node_velocities(section: CrossSection, motion: RigidMotion) -> dict[str, Any]:
    """Return the velocities of a node."""
    start, velocity, omega = motion
    swept = vector_product(omega, (*map(difference, section.place, start), ZERO))
    own = (
        write_vector(scalar_product_of(omega, axis) for axis in section.axes)
        if len(start) == 3
        else file_value(omega[2])
    )
    return {"velocity": write_vector(map(sum_of_terms, velocity, swept)), "angular_velocity": own}


def pose_keys(section: CrossSection) -> dict[str, Any]:
    """Return the position and orientation of a node."""
    if len(section.axes) == 2:
        return {"position": write_vector(section.place), "angle": file_value(section.angle)}
    turned = {"x_axis": write_vector(section.axes[0]), "y_axis": write_vector(section.axes[1])}
    return {"position": write_vector(section.place), "orientation": turned}


def section_mass(
    properties: Properties, section: CrossSection, axes: tuple[Vec, ...] | None
) -> tuple[Expr, tuple[Expr, ...]]:
    """Return the mass of a cross section and its rotary inertia, in space with axes in a frame its tensor there."""
    mass, *rotary = (product(section.share, e) for e in (properties.mass, *properties.rotary))
    if axes is None or len(axes) == 2:
        return mass, tuple(rotary)
    x, y, _ = axes
    pairs = (0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)
    # the third of three perpendicular axes follows from the others: its formulas are the longest
    about_x, about_y = (difference(e, rotary[2]) for e in rotary[:2])
    return mass, tuple(
        sum_of_terms(rotary[2] if i == j else ZERO, product(about_x, x[i], x[j]), product(about_y, y[i], y[j]))
        for i, j in pairs
    )


def body_axes(scope: Scope, body: AnyBody) -> tuple[Vec, ...]:
    """Return the axes of a body's frame in the ground frame, as it is described."""
    if isinstance(body, Body):
        cosine, sine = call("cos", body.angle), call("sin", body.angle)
        return (cosine, sine), (call("neg", sine), cosine)
    if not body.orientation.is_numeric:
        raise scope.error("clamp", "a body whose orientation at the start is given in numbers", f"'{body.name}'")
    rows = rotation_matrix_of(
        euler_parameters(body.orientation, scalar_values(scope.context.values), scope.where("clamp"))
    )
    return tuple(tuple(literal_of(x) for x in column) for column in zip(*rows, strict=True))


def add_mass(body: AnyBody, further: BodyMass) -> AnyBody:
    """Return a body with a further mass and tensor of inertia at a place of its frame (Huygens, Steiner)."""
    mass = sum_of_terms(body.mass, further.mass)
    if body.inertia is None:
        return msgspec.structs.replace(body, mass=mass)
    share = call("div", further.mass, mass)
    apart = tuple(map(difference, further.place, body.centre_of_mass))
    centre = tuple(sum_of_terms(c, product(share, d)) for c, d in zip(body.centre_of_mass, apart, strict=True))
    reduced, inertia = product(share, body.mass), body.inertia
    if isinstance(inertia, tuple):
        a, b, c, d, e, f = map(sum_of_terms, inertia, further.inertia)
        inertia = shift_tensor((a, b, c, d, e, f), call("neg", reduced), apart)
    else:
        inertia = sum_of_terms(inertia, *further.inertia, product(reduced, scalar_product_of(apart, apart)))
    return msgspec.structs.replace(body, mass=mass, centre_of_mass=centre, inertia=inertia)


def in_frame(frame: Sequence[Vec], vectors: Sequence[Vec]) -> tuple[Vec, ...]:
    """Return vectors in the axes of a frame."""
    return tuple(tuple(scalar_product_of(vector, axis) for axis in frame) for vector in vectors)


def write_vector(vector: Iterable[Expr]) -> list[float | str]:
    """Return a vector as written in a file."""
    return [file_value(e) for e in vector]
