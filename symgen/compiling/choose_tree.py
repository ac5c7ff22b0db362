"""Which joints of a mechanism carry its bodies where the state is that of a tree of joints.

Where a loop is cut matters: `bricard` takes 899 to 1288 operations an evaluation. Trees are derived and counted, one
joint of a loop cut at a time, until enough operations have been counted: a limit of work, not of time, so that the same
mechanism has the same tree everywhere. What was chosen is kept beside the emitted code.
"""

from __future__ import annotations

from symgen.compiling.side import made_beside
from symgen.describe.mechanism import Mechanism, Topology
from symgen.describe.topology import loops_of, spanning_tree, with_joint_coordinates

#: Operations that are counted before the best tree so far is taken; the first tree is always counted.
ENOUGH = 12_000
#: A mechanism whose first tree takes more is not tried again: each count takes a second.
LARGE = 4_000
#: Another tree has to save this part to be taken.
GAIN = 0.01


def on_tree(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism whose state is that of the joints of its tree; those with ``cut = true`` carry nothing."""
    first = spanning_tree(mechanism, mechanism.cuts)
    if not loops_of(mechanism, first):
        return with_joint_coordinates(mechanism, first)
    text = f'"""Joints that carry nothing where `{mechanism.name}` is a tree."""\n'
    known, _ = made_beside(
        mechanism, "tree", [sorted(mechanism.cuts)], lambda: (text, {"cut": list(_cheapest(mechanism, first))})
    )
    return with_joint_coordinates(mechanism, spanning_tree(mechanism, tuple(known["cut"])))


def _cheapest(mechanism: Mechanism, first: Topology) -> tuple[str, ...]:
    """Return the joints that are cut, beside those that follow, for the fewest operations that were found."""
    best, least = mechanism.cuts, operations(with_joint_coordinates(mechanism, first))
    counted = least
    if least > LARGE:
        return best
    for loop in loops_of(mechanism, first):
        found = best
        for joint in loop:
            if counted > ENOUGH:
                return best
            tried = (*found, joint)
            tree = spanning_tree(mechanism, tried)
            if _free(tree) > _free(first):
                continue
            count = operations(with_joint_coordinates(mechanism, tree))
            counted += count
            if count < (1.0 - GAIN) * least:
                best, least = tried, count
    return best


def _free(topology: Topology) -> int:
    """Return how many bodies no joint carries."""
    return sum(not link.joint for link in topology.links)


def operations(mechanism: Mechanism) -> int:
    """Return the operations of the right-hand side of `lagrange`, after sharing."""
    from symgen.formulate.formulate import formulate
    from symgen.lower.law import part_outputs
    from symgen.lower.record import record_law
    from symgen.lower.scalar import ScalarNodes
    from symgen.methods import METHODS

    method = METHODS.get("lagrange", "")
    equations = formulate(mechanism)
    record = record_law(method, method.complete_options({}), equations.driving is not None)
    scalars = ScalarNodes(equations, record.operations, [p.name for p in method.parameters])
    scalars.run(range(len(record.operations)))
    nodes = [node for part in record.parts if part.role == "acceleration" for _, node in part_outputs(scalars, part)]
    return scalars.graph.operations(nodes)
