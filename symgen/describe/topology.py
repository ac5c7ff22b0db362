"""Spanning trees of mechanisms: which joints carry bodies, and which close loops.

With joint coordinates the state of a mechanism is how bodies stand on the bodies that carry them. The joints of the
tree hold by construction and have no rows; those that are cut keep theirs.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from symgen.describe.mechanism import Articulation, Joint, Link, Mechanism, SpatialBody, Topology
from symgen.vocabulary.expressions import Number
from symgen.vocabulary.measures import GROUND, Measure, Sum


def articulation_of(joint: Joint) -> Articulation | None:
    """Return how the bodies of a joint move against each other, None for a kind that is rows only."""
    from symgen.joints import JOINTS

    articulate = getattr(JOINTS.get(joint.kind), "articulate", None)
    return None if articulate is None else articulate(joint)


def edges_of(mechanism: Mechanism) -> dict[str, Articulation]:
    """Return the joints that can stand in a tree, with how their bodies move."""
    found = dict[str, Articulation]()
    for joint in mechanism.joints:
        articulation = articulation_of(joint)
        if articulation is not None and articulation.a.body != articulation.b.body:
            found[joint.name] = articulation
    return found


def spanning_tree(mechanism: Mechanism, cut: Sequence[str] = ()) -> Topology:
    """Return a tree of shortest paths from the ground.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    cut : sequence of str
        Joints that shall not stand in the tree.

    Notes
    -----
    Bodies that no joint of the tree leads to are free; the first one of the file is taken where there is a choice.
    """
    edges = {name: a for name, a in edges_of(mechanism).items() if name not in cut}
    points = {body.name for body in mechanism.bodies if body.is_point}
    links, reached = list[Link](), {GROUND}

    def grow(waiting: list[str]) -> None:
        while waiting:
            at = waiting.pop(0)
            for name, articulation in edges.items():
                for link in _ways(name, articulation, at):
                    if link.body not in reached and _suits(link, points, mechanism.space == "spatial"):
                        reached.add(link.body)
                        links.append(link)
                        waiting.append(link.body)

    grow([GROUND])
    for body in mechanism.bodies:
        if body.name not in reached:
            reached.add(body.name)
            links.append(Link(body.name))
            grow([body.name])
    used = {link.joint for link in links}
    return Topology(
        tuple(links), tuple(joint.name for joint in mechanism.joints if joint.rows and joint.name not in used)
    )


def _ways(name: str, articulation: Articulation, at: str) -> Iterator[Link]:
    """Yield how a joint leads on from a body."""
    if articulation.a.body == at:
        yield Link(articulation.b.body, name, at, True, articulation)
    if articulation.b.body == at:
        yield Link(articulation.a.body, name, at, False, articulation)


def _suits(link: Link, points: set[str], spatial: bool) -> bool:
    """Whether a body can hang on a joint: a point mass has no angle, so it carries nothing and only pins hold it."""
    found = link.articulation
    assert found is not None, "a link of a joint knows how it moves"
    if link.parent in points:
        return False
    if link.body in points:
        return found.turn == ("ball" if spatial else "axis")
    # displacements along directions of the first body are simple where that carries, or does not turn against the other
    return link.forward or not found.slides or found.turn == "fixed" or len(found.slides) == 1


def loops_of(mechanism: Mechanism, topology: Topology) -> tuple[tuple[str, ...], ...]:
    """Return for each joint that closes a loop and could stand in a tree the joints of the tree in that loop."""
    links = {link.body: link for link in topology.links}

    def path(body: str) -> list[str]:
        found = list[str]()
        while body != GROUND and links[body].joint:
            found.append(links[body].joint)
            body = links[body].parent
        return found

    loops = list[tuple[str, ...]]()
    for name, articulation in edges_of(mechanism).items():
        if name in topology.cut:
            a, b = path(articulation.a.body), path(articulation.b.body)
            loops.append(tuple([j for j in a if j not in b] + [j for j in b if j not in a]))
    return tuple(loops)


def with_joint_coordinates(mechanism: Mechanism, topology: Topology) -> Mechanism:
    """Return a mechanism whose state is that of the joints of a tree: these have no rows any more."""
    inside = {link.joint for link in topology.links}
    joints = tuple(msgspec.structs.replace(j, rows=()) if j.name in inside else j for j in mechanism.joints)
    return msgspec.structs.replace(mechanism, joints=joints, topology=topology)


def state_names(mechanism: Mechanism, topology: Topology) -> tuple[list[tuple[str, str]], list[tuple[str, str]]]:
    """Return names and units of the coordinates and velocities of a tree, in the order of its links."""
    q, v = list[tuple[str, str]](), list[tuple[str, str]]()
    for link in topology.links:
        body = mechanism.body(link.body)
        found = link.articulation
        if found is None:
            q += [(f"{body.name}.{c}", _UNITS[c]) for c in body.coordinates]
            v += [(f"{body.name}.{c}", _UNITS[c]) for c in body.speeds]
            continue
        turns = found.turn != "fixed" and not body.is_point
        labels = [label for label, _ in mechanism.joint_named(link.joint).coordinates]
        lengths = [label for label in labels if label.startswith("displacement")][: len(found.slides)]
        angles = [label for label in labels if label.startswith("angle")]
        q += [(f"{link.joint}.{label}", "m") for label in lengths]
        v += [(f"{link.joint}.{label}.rate", "m/s") for label in lengths]
        if not turns:
            continue
        if not isinstance(body, SpatialBody):
            q.append((f"{body.name}.theta", "rad"))
            v.append((f"{body.name}.omega", "rad/s"))
        elif found.turn == "ball":
            q += [(f"{body.name}.{c}", "1") for c in ("e0", "e1", "e2", "e3")]
            v += [(f"{body.name}.{c}", "rad/s") for c in ("wx", "wy", "wz")]
        else:
            q += [(f"{link.joint}.{label}", "rad") for label in angles]
            v += [(f"{link.joint}.{label}.rate", "rad/s") for label in angles]
    return q, v


def known_coordinates(mechanism: Mechanism, topology: Topology) -> dict[Measure, tuple[int, int, float]]:
    """Return measures that are coordinates of the state: where they stand in q and v, and with which sign."""
    names, speeds = state_names(mechanism, topology)
    q, v = ({name: i for i, (name, _) in enumerate(part)} for part in (names, speeds))
    found = dict[Measure, tuple[int, int, float]]()
    for link in topology.links:
        if not link.joint:
            continue
        for label, measure in mechanism.joint_named(link.joint).coordinates:
            name = f"{link.joint}.{label}"
            if name in q:
                found[measure] = q[name], v[f"{name}.rate"], 1.0
                if isinstance(measure, Sum) and len(measure.terms) == 1 and measure.terms[0][0] == Number(-1.0):
                    found[measure.terms[0][1]] = q[name], v[f"{name}.rate"], -1.0
    return found


_UNITS = {
    **{"x": "m", "y": "m", "theta": "rad", "vx": "m/s", "vy": "m/s", "omega": "rad/s"},
    **{"z": "m", "e0": "1", "e1": "1", "e2": "1", "e3": "1", "vz": "m/s", "wx": "rad/s", "wy": "rad/s", "wz": "rad/s"},
}
