"""Bodies that carry others: interfaces of modal bodies have no coordinates, and act on the body that carries them."""

from __future__ import annotations

from symgen.base.vocabulary.expressions import (
    ONE,
    ZERO,
    Expr,
    Name,
    call,
    difference,
    literal_of,
    product,
    sum_of_terms,
    vector_product,
)
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.mechanism import Mechanism, Vec
from symgen.describe.modal_body import COORDINATE, CarriedInterface, Numbers, names_of_modes


def bodies_of_reactions(mechanism: Mechanism) -> dict[str, str]:
    """Return for each joint the body that its reaction is reported on: the first one, or what carries it.

    A joint between two interfaces of one body is left out: its reactions balance each other on that body.
    """
    carried = {body.name: body.carried.host for body in mechanism.bodies if body.carried is not None}
    found = dict[str, str]()
    for joint in mechanism.joints:
        first, *others = (carried.get(body, body) for body in joint.bodies)
        if first not in others or joint.bodies[0] in joint.bodies[1:]:
            found[joint.name] = first
    return found


def seats_on_carriers(mechanism: Mechanism) -> dict[str, tuple[Vec, Vec]]:
    """Return the point ``at`` of joints in the frame of `bodies_of_reactions`, and the centre of mass there.

    They are formulas of parameters and, on an interface, of coordinates of modes. Joints without such a point have
    none.
    """
    bodies, found = {body.name: body for body in mechanism.bodies}, dict[str, tuple[Vec, Vec]]()
    for joint, marker in mechanism.seats:
        nothing = (ZERO,) * len(marker.point)
        if marker.body == GROUND:
            found[joint] = marker.point, nothing
        elif (carried := bodies[marker.body].carried) is None:
            found[joint] = marker.point, bodies[marker.body].centre_of_mass
        else:
            found[joint] = point_of_interface(carried, marker.point), nothing
    return found


def point_of_interface(carried: CarriedInterface, point: Vec) -> Vec:
    """Return a point of an interface from the centre of mass of its body, in the axes of that body."""
    modes = [Name(f"{carried.host}.{m}") for m in names_of_modes(COORDINATE, len(carried.shape))]

    def combined(
        start: Numbers, parts: tuple[Numbers, ...], curve: tuple[tuple[Numbers, ...], ...], factor: float = 1.0
    ) -> Vec:
        terms: list[tuple[Numbers, Expr]] = list(zip(parts, modes, strict=True))
        for own, m in zip(curve, modes, strict=bool(curve)):
            terms += [(part, product(m, other)) for part, other in zip(own, modes, strict=True)]
        return tuple(
            sum_of_terms(literal_of(x), *(product(literal_of(factor * part[a]), m) for part, m in terms))
            for a, x in enumerate(start)
        )

    origin = combined(carried.place, carried.shape, carried.curve)
    if all(x == ZERO for x in point):
        return origin
    if len(point) == 2:
        (angle,) = combined((0.0,), carried.turn, carried.twist)
        c, s, (x, y) = call("cos", angle), call("sin", angle), point
        turned: Vec = (difference(product(c, x), product(s, y)), sum_of_terms(product(s, x), product(c, y)))
    else:
        p = combined((0.0,) * 3, carried.turn, carried.twist, 0.5)
        factor = call("div", literal_of(2.0), sum_of_terms(ONE, *(product(e, e) for e in p)))
        once = vector_product(p, point)
        twice = vector_product(p, once)
        turned = tuple(
            sum_of_terms(x, product(factor, sum_of_terms(a, b))) for x, a, b in zip(point, once, twice, strict=True)
        )
    return tuple(sum_of_terms(a, b) for a, b in zip(origin, turned, strict=True))
