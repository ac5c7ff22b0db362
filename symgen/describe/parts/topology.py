"""Spanning trees of mechanisms: which joints carry bodies, and which close loops.

With joint coordinates the state of a mechanism is the pose of bodies relative to the bodies that carry them. The joints
of the tree hold by construction and have no rows; those that are cut keep theirs.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import msgspec

from symgen.base.vocabulary.expressions import Number, readings_in
from symgen.base.vocabulary.measures import GROUND, Angle, Driven, Holonomic, Measure, Sum
from symgen.base.vocabulary.quantities import Quantity
from symgen.describe.coordinate_names import ACCELERATIONS
from symgen.describe.formulas.results_read import integrals_of_outputs
from symgen.describe.mechanism import Joint, Mechanism, SpatialBody
from symgen.describe.modal_body import MOST_MODES, UNITS_OF_MODES, names_of_modes
from symgen.describe.parts.kinds import JOINTS
from symgen.describe.spanning_tree import Articulation, Link, Prescribed, Topology

#: Units of the coordinates and velocities of bodies.
UNITS = {
    **{"x": "m", "y": "m", "theta": "rad", "vx": "m/s", "vy": "m/s", "omega": "rad/s"},
    **{name: unit for prefix, unit in UNITS_OF_MODES.items() for name in names_of_modes(prefix, MOST_MODES)},
    **{"z": "m", "e0": "1", "e1": "1", "e2": "1", "e3": "1", "vz": "m/s", "wx": "rad/s", "wy": "rad/s", "wz": "rad/s"},
}


def unit_of_column(label: str) -> str:
    """Return the SI unit of a coordinate, velocity or acceleration of a body; empty for another name."""
    speed = next((speed for speed, acceleration in ACCELERATIONS.items() if acceleration == label), "")
    return f"{UNITS[speed]}^2" if speed else UNITS.get(label, "")


def articulation_of_joint(joint: Joint) -> Articulation | None:
    """Return the relative motion of a joint's bodies, None for a kind with rows only."""
    articulate = getattr(JOINTS.get(joint.kind), "articulate", None)
    return None if articulate is None else articulate(joint)


def possible_edges(mechanism: Mechanism) -> dict[str, Articulation]:
    """Return the joints that can be part of a tree, with their relative motions."""
    edges = dict[str, Articulation]()
    for joint in mechanism.joints:
        articulation = articulation_of_joint(joint)
        if articulation is not None and articulation.a.body != articulation.b.body:
            edges[joint.name] = articulation
    return edges


def spanning_tree(mechanism: Mechanism, cut: Sequence[str] = ()) -> Topology:
    """Return a tree of shortest paths from the ground whose mass matrix is regular where there is one.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    cut : sequence of str
        Joints excluded from the tree.

    Notes
    -----
    Bodies that no joint of the tree reaches are free; of several choices the first in the file is taken. A body without
    mass at the end of a branch that moves has no inertia, so that M is singular. Where it is in a loop, it carries its
    neighbour, whose own joint is cut then.
    """
    tree = _shortest_tree(mechanism, cut)
    if not (empty := count_empty_ends(mechanism, tree)):
        return tree
    edges = {name: a for name, a in possible_edges(mechanism).items() if name not in cut}
    free = sum(not link.joint for link in tree.links)
    for joint in _joints_beside_empty_ends(mechanism, tree, edges):
        other = _shortest_tree(mechanism, (*cut, joint))
        left = count_empty_ends(mechanism, other)
        if left < empty and sum(not link.joint for link in other.links) <= free:
            return spanning_tree(mechanism, (*cut, joint))
    return tree


def count_empty_ends(mechanism: Mechanism, tree: Topology) -> int:
    """Return the number of links of a tree that move bodies without mass alone; with any, M is singular everywhere."""
    return len(_empty_ends(mechanism, tree))


def _empty_ends(mechanism: Mechanism, tree: Topology) -> list[Link]:
    """Return the links that move bodies without mass alone."""
    rotors = {rotor.joint for rotor in mechanism.rotors}
    given = {x.body for x in tree.prescribed}
    heavy = {body.name for body in mechanism.bodies if not body.weightless}
    for link in reversed(tree.links):
        if link.body in heavy:
            heavy.add(link.parent)
    moving = [
        x for x in tree.links if x.articulation is None or x.articulation.slides or x.articulation.turn != "fixed"
    ]
    return [x for x in moving if x.body not in heavy and x.body not in given and x.joint not in rotors]


def _joints_beside_empty_ends(mechanism: Mechanism, tree: Topology, edges: Mapping[str, Articulation]) -> Iterator[str]:
    """Yield joints whose cut lets a body without mass carry a neighbour, by an edge that the tree does not use."""
    carrying = {link.body: link.joint for link in tree.links}
    for end in _empty_ends(mechanism, tree):
        for name in tree.cut:
            if name in edges and end.body in (bodies := [edges[name].a.body, edges[name].b.body]):
                yield from (carrying[body] for body in bodies if body != end.body and carrying.get(body))


def _shortest_tree(mechanism: Mechanism, cut: Sequence[str]) -> Topology:
    """Return a tree of shortest paths from the ground."""
    edges = {name: a for name, a in possible_edges(mechanism).items() if name not in cut}
    points = {body.name for body in mechanism.bodies if body.is_point}
    links, reached = list[Link](), {GROUND}

    def grow_tree(waiting: list[str]) -> None:
        while waiting:
            at = waiting.pop(0)
            for name, articulation in edges.items():
                for link in _links_from(name, articulation, at):
                    if link.body not in reached and _can_hang_on(link, points, mechanism.space == "spatial"):
                        reached.add(link.body)
                        links.append(link)
                        waiting.append(link.body)

    grow_tree([GROUND])
    for body in mechanism.bodies:
        if body.name not in reached:
            reached.add(body.name)
            links.append(Link(body.name))
            grow_tree([body.name])
    tree = Topology(tuple(links))
    prescribed = _prescribed_coordinates(mechanism, tree)
    used = {*(link.joint for link in links), *(x.driver for x in prescribed)}
    rest = tuple(joint.name for joint in mechanism.joints if joint.rows and joint.name not in used)
    return Topology(tree.links, rest, prescribed)


def _prescribed_coordinates(mechanism: Mechanism, tree: Topology) -> tuple[Prescribed, ...]:
    """Return the values of drivers for the coordinates of a tree; at least one coordinate stays in the state.

    A driver whose effort is integrated keeps its row: its multiplier is wanted at every evaluation. So does a
    joint that holds for a while.
    """
    places = dict[Measure, tuple[str, str, float]]()
    for link in tree.links:
        lengths, angles = labels_of_link(mechanism, link)
        coordinates = dict(mechanism.joint_named(link.joint).coordinates) if link.joint else {}
        for label in (*lengths, *angles):
            if label in coordinates:
                places |= {m: (link.body, label, sign) for m, sign in _equal_measures(coordinates[label])}
        body = mechanism.body(link.body)
        if angles and not isinstance(body, SpatialBody):
            places.setdefault(Angle(GROUND, link.body), (link.body, "theta", 1.0))
    prescribed, keys = list[Prescribed](), set[str]()
    integrated = {
        r.source.row for x in integrals_of_outputs(mechanism) for r in readings_in(x.of) if isinstance(r.source, Driven)
    }
    for rotor in mechanism.rotors:  # a driver of such a coordinate exerts what the rotor takes: it keeps its row
        for measure, _ in _equal_measures(rotor.angle):
            places.pop(measure, None)
    for joint in mechanism.joints:
        alone = len(joint.rows) == 1 and not joint.coordinates and joint.name not in mechanism.switchable
        row = joint.rows[0] if alone else None
        if isinstance(row, Holonomic) and row.measure in places and f"{joint.name}.{row.label}" not in integrated:
            name, label, sign = places[row.measure]
            key = f"{name}.{'angle' if label == 'theta' else label}"
            if key not in keys:
                keys.add(key)
                prescribed.append(Prescribed(joint.name, name, label, row.value, sign))
    velocities = len(state_names(mechanism, tree)[1])
    return tuple(prescribed[: max(0, velocities - 1)])


def _equal_measures(measure: Measure) -> Iterator[tuple[Measure, float]]:
    """Yield a measure with sign 1 and, if it is the negative of another measure, that one with sign -1."""
    yield measure, 1.0
    if isinstance(measure, Sum) and len(measure.terms) == 1 and measure.terms[0][0] == Number(-1.0):
        yield measure.terms[0][1], -1.0


def _links_from(name: str, articulation: Articulation, at: str) -> Iterator[Link]:
    """Yield the links of a joint from a body."""
    if articulation.a.body == at:
        yield Link(articulation.b.body, name, at, True, articulation)
    if articulation.b.body == at:
        yield Link(articulation.a.body, name, at, False, articulation)


def _can_hang_on(link: Link, points: set[str], spatial: bool) -> bool:
    """Whether a body can hang on a joint: a point mass has no angle, so it carries nothing and only pins hold it."""
    articulation = link.articulation
    assert articulation is not None, "a link of a joint knows how it moves"
    if link.parent in points:
        return False
    if link.body in points:
        return articulation.turn == ("ball" if spatial else "axis")
    # displacements along directions of the first body are simple where that carries, or does not turn against the other
    return link.forward or not articulation.slides or articulation.turn == "fixed" or len(articulation.slides) == 1


def joints_of_loops(mechanism: Mechanism, topology: Topology) -> tuple[tuple[str, ...], ...]:
    """Return for each cut joint with an articulation the joints of the tree in its loop."""
    links = {link.body: link for link in topology.links}

    def path_to_ground(body: str) -> list[str]:
        way = list[str]()
        while body != GROUND and links[body].joint:
            way.append(links[body].joint)
            body = links[body].parent
        return way

    loops = list[tuple[str, ...]]()
    for name, articulation in possible_edges(mechanism).items():
        if name in topology.cut:
            a, b = path_to_ground(articulation.a.body), path_to_ground(articulation.b.body)
            loops.append(tuple([j for j in a if j not in b] + [j for j in b if j not in a]))
    return tuple(loops)


def with_joint_coordinates(mechanism: Mechanism, topology: Topology) -> Mechanism:
    """Return the mechanism in joint coordinates; joints of the tree have no rows."""
    inside = {*(link.joint for link in topology.links), *(x.driver for x in topology.prescribed)}
    joints = tuple(msgspec.structs.replace(j, rows=()) if j.name in inside else j for j in mechanism.joints)
    return msgspec.structs.replace(mechanism, joints=joints, topology=topology)


def labels_of_link(mechanism: Mechanism, link: Link) -> tuple[list[str], list[str]]:
    """Return the labels of a link's displacements and of its angles, as its joint reports them.

    In the plane the angle is the body's own, as a joint on which a point mass hangs may report none.
    """
    articulation, body = link.articulation, mechanism.body(link.body)
    if articulation is None:
        return [], []
    labels = [label for label, _ in mechanism.joint_named(link.joint).coordinates]
    lengths = [label for label in labels if label.startswith("displacement")][: len(articulation.slides)]
    if articulation.turn in ("fixed", "ball") or body.is_point:
        return lengths, []
    angles = [label for label in labels if label.startswith("angle")]
    return lengths, angles if isinstance(body, SpatialBody) else [*angles, "angle"][:1]


def state_names(mechanism: Mechanism, topology: Topology) -> tuple[list[tuple[str, str]], list[tuple[str, str]]]:
    """Return names and units of the coordinates and velocities of a tree, in the order of its links."""
    q, v = list[tuple[str, str]](), list[tuple[str, str]]()
    prescribed = {(x.body, "angle" if x.label == "theta" else x.label) for x in topology.prescribed}
    for link in topology.links:
        body = mechanism.body(link.body)
        articulation = link.articulation
        if articulation is None:
            q += [(f"{body.name}.{c}", UNITS[c]) for c in body.coordinates]
            v += [(f"{body.name}.{c}", UNITS[c]) for c in body.speeds]
            continue
        turns = articulation.turn != "fixed" and not body.is_point
        lengths, angles = (
            [x for x in part if (body.name, x) not in prescribed] for part in labels_of_link(mechanism, link)
        )
        q += [(f"{link.joint}.{label}", "m") for label in lengths]
        v += [(f"{link.joint}.{label}.rate", "m/s") for label in lengths]
        if not turns:
            continue
        if not isinstance(body, SpatialBody):
            if not angles:
                continue
            q.append((f"{body.name}.theta", "rad"))
            v.append((f"{body.name}.omega", "rad/s"))
        elif articulation.turn == "ball":
            q += [(f"{body.name}.{c}", "1") for c in ("e0", "e1", "e2", "e3")]
            v += [(f"{body.name}.{c}", "rad/s") for c in ("wx", "wy", "wz")]
        else:
            q += [(f"{link.joint}.{label}", "rad") for label in angles]
            v += [(f"{link.joint}.{label}.rate", "rad/s") for label in angles]
    return q, v


def state_quantities(mechanism: Mechanism) -> tuple[tuple[Quantity, ...], tuple[Quantity, ...]]:
    """Return names and units of q and v: of the tree where there is one, else of the bodies."""
    if mechanism.topology is not None:
        names = state_names(mechanism, mechanism.topology)
        q, v = (tuple(Quantity(name, unit) for name, unit in part) for part in names)
        return q, v
    q = tuple(Quantity(f"{b.name}.{c}", UNITS[c]) for b in mechanism.bodies for c in b.coordinates)
    v = tuple(Quantity(f"{b.name}.{c}", UNITS[c]) for b in mechanism.bodies for c in b.speeds)
    return q, v


def state_measures(mechanism: Mechanism, topology: Topology) -> dict[Measure, tuple[int, int, float]]:
    """Return measures that are coordinates of the state, with their indices in q and v and their sign."""
    names, speeds = state_names(mechanism, topology)
    q, v = ({name: i for i, (name, _) in enumerate(part)} for part in (names, speeds))
    places = dict[Measure, tuple[int, int, float]]()
    for link in topology.links:
        if not link.joint:
            continue
        for label, measure in mechanism.joint_named(link.joint).coordinates:
            name = f"{link.joint}.{label}"
            if name in q:
                places |= {m: (q[name], v[f"{name}.rate"], sign) for m, sign in _equal_measures(measure)}
    return places
