"""Automatic choices: coordinates of a run, shape of its code, and the joints that carry bodies in a tree.

*Coordinates.* Joint coordinates have fewer unknowns and rows; both are counted without deriving anything. They exist as
straight code only, so where loops are better the coordinates are those of bodies.

*Shape.* Straight code is two to four times as fast and has to be compiled for every mechanism, which takes time that
grows with it; looped code is compiled once for all. A step of an implicit integrator costs about the same in both, as
most of it is the solution of its equations, and its Jacobian makes straight code longer. ``auto`` takes the shape whose
compilation and run together are expected to be shorter, as if nothing had been compiled yet: what the cache holds must
not change the digits of a run. The figures below come from ``benchmarks/shapes.py``; they need not be exact, as the
shapes differ by factors where the choice matters, and another machine changes all of them alike.

*Trees.* Where a loop is cut matters: `bricard` takes 899 to 1288 operations an evaluation. Trees are derived and
counted, one joint of a loop cut at a time, until enough operations have been counted: a limit of work, not of time, so
that the same mechanism has the same tree everywhere. The choice is kept with the emitted code.
"""

from __future__ import annotations

from typing import NamedTuple

import msgspec

from symgen.base.errors import InputError, plural
from symgen.describe.bounds.bounded_modes import one_sided_rows
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.topology import (
    count_empty_ends,
    joints_of_loops,
    possible_edges,
    spanning_tree,
    state_names,
    with_joint_coordinates,
)
from symgen.describe.remembered import compute_once
from symgen.describe.spanning_tree import Topology
from symgen.run.compiling.method_choice import MethodChoice, choice_for_coordinates
from symgen.run.compiling.pipeline import refuse_loops, straight_alone
from symgen.run.compiling.side import side_module

#: Lengths of bodies between which corrections in the metric of the identity keep at least four digits [m].
LENGTHS_OF_IDENTITY = 1e-6, 1e6


class TakenForm(NamedTuple):
    """The coordinates, or the shape of code, that are taken, and the reason in one sentence."""

    name: str
    reason: str


def weigh_corrections(choice: MethodChoice, massless: bool) -> MethodChoice:
    """Return a method with corrections in the metric of the masses, where it leaves the choice.

    The identity in the angles and displacements of joints depends on which joints carry, that of the masses does not.
    With massless bodies, whose M has no inverse, it is the identity in the velocities of bodies.
    """
    if "weight" not in choice.options:
        return choice
    return choice.with_options(weight="body" if massless else "mass")


def choice_for_lengths(choice: MethodChoice, longest: float) -> tuple[MethodChoice, tuple[str, ...]]:
    """Return a choice for bodies of such a length [m], and why; lengths of machines leave it as it is.

    In the metric of the identity 1 rad weighs as 1 m. D D^T then adds 1 and the square of the length: beyond these
    lengths rounding leaves nothing of one of them. The metric of the masses knows no unit of length.
    """
    low, high = LENGTHS_OF_IDENTITY
    if not longest > 0.0 or low <= longest <= high or choice.options.get("weight") != "identity":
        return choice, ()
    why = f"bodies of {longest:.3g} m: corrections are in the metric of the masses, as 1 rad does not weigh like 1 m"
    return choice.with_options(weight="mass"), (why,)


def choose_coordinates(mechanism: Mechanism, coordinates: str, shape: str) -> TakenForm:
    """Decide the coordinates of a run, ``absolute`` or ``joint``.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    coordinates : str
        One of `symgen.base.settings.COORDINATES`.
    shape : str
        The requested shape of code, or that of the bodies' own coordinates.

    Raises
    ------
    InputError
        If both joint coordinates and looped code are requested, or joint coordinates of modal bodies.
    """
    if coordinates == "absolute":
        return TakenForm("absolute", "it was set")
    if mechanism.has_modal_bodies:
        if coordinates == "joint":
            raise InputError("coordinates", "absolute ones for modal bodies, which no tree of joints carries", "joint")
        return TakenForm("absolute", "joint coordinates have no modal bodies")
    if coordinates == "joint":
        if shape == "looped":
            expected = "absolute ones for code that is not straight: loops, lanes and CUDA have no joint coordinates"
            raise InputError("coordinates", expected, "joint")
        return TakenForm("joint", "it was set")
    if shape == "looped":
        return TakenForm("absolute", "loops, lanes and CUDA have no joint coordinates")
    topology = spanning_tree(mechanism)
    own = sum(len(body.speeds) for body in mechanism.bodies)
    rows = sum(len(joint.rows) for joint in mechanism.joints)
    inside = {*(link.joint for link in topology.links), *(x.driver for x in topology.prescribed)}
    tree = len(state_names(mechanism, topology)[1])
    left = sum(len(joint.rows) for joint in mechanism.joints if joint.name not in inside)
    velocities = plural(tree, "velocity", "velocities")
    counts = f"{velocities} and {plural(left, 'row')} in joint coordinates, {own} and {rows} in absolute ones"
    if tree + left < own + rows:
        return TakenForm("joint", counts)
    return TakenForm("absolute", counts)


class ShapeCost(NamedTuple):
    """Cost of a mechanism for each of its coordinates; in space turns and their kernels make it higher.

    Attributes
    ----------
    compilation, implicit : float
        Derivation, emission and compilation as straight code; the same with the Jacobian for implicit integrators [s].
    straight, looped : float
        An evaluation in either shape [s].
    """

    compilation: float
    implicit: float
    straight: float
    looped: float


#: Seconds to derive, emit and compile any mechanism straight.
STRAIGHT_LEAST = 0.3
EACH = {"planar": ShapeCost(0.011, 0.013, 0.8e-8, 1.8e-8), "spatial": ShapeCost(0.03, 0.036, 2.5e-8, 1.0e-7)}
#: Seconds to derive and compile the shared looped code from an empty cache: one figure for 1 to 4, whatever is cached.
LOOPED_LEAST = 2.2
#: Seconds that contacts add to straight code, times the cube of their number: fitted; compilers take longer per line in
#: the long functions of many contacts.
STRAIGHT_CONTACTS = 1.1e-3
#: Seconds of a looped evaluation at any size.
LOOPED_CALL = 1.0e-7
#: From this many coordinates on straight code is not considered: eight seconds here, most of a minute at three times as
#: many, for a mechanism in the plane.
LARGEST_STRAIGHT = 600
#: More coordinates are refused where matrices stay dense.
LARGEST_DENSE = 400


def straight_seconds(mechanism: Mechanism, implicit: bool = False) -> float:
    """Return the approximate time to derive and compile the straight code of a method [s]."""
    each, contacts = EACH[mechanism.space], sum(row.in_contact for row in one_sided_rows(mechanism))
    written = (each.implicit if implicit else each.compilation) * mechanism.body_coordinates
    return STRAIGHT_LEAST + written + STRAIGHT_CONTACTS * contacts**3


def choose_shape(mechanism: Mechanism, choice: MethodChoice, shape: str, evaluations: float) -> TakenForm:
    """Decide the shape of a run, ``straight`` or ``looped``.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    choice : MethodChoice
        The method with its options.
    shape : str
        One of `symgen.base.settings.SHAPES`.
    evaluations : float
        Expected number of evaluations.

    Raises
    ------
    InputError
        If there is no such shape, or the method cannot have it at this size.
    """
    if what := straight_alone(mechanism):
        if shape == "looped":
            refuse_loops(mechanism)
        return TakenForm("straight", f"loops have no {what}")
    coordinates, choice = mechanism.body_coordinates, choice_for_coordinates(mechanism, choice)
    size = f"{plural(coordinates, 'coordinate')}, about {evaluations:.2g} evaluations"
    faster = TakenForm("straight", f"faster runs outweigh compilation ({size})")
    straight = coordinates <= LARGEST_STRAIGHT and not _looped_is_sooner(mechanism, choice, evaluations)
    if shape == "auto" and straight and coordinates <= LARGEST_DENSE:
        return faster
    # modules of looped code are not loaded where straight code is taken
    from symgen.derive.lower.looped.looped_law import is_loopable, refuse_dense

    dense = not is_loopable(choice.method, choice.options, choice.implicit)
    if shape == "looped":
        refuse_dense(choice.method, choice.options, choice.implicit)
    if dense and coordinates > LARGEST_DENSE:
        raise InputError(
            f"method '{choice.method.name}'",
            f"a mechanism of at most {LARGEST_DENSE} coordinates, as its matrices are dense",
            f"{coordinates} coordinates",
        )
    if shape != "auto":
        return TakenForm(shape, "it was set")
    if dense:
        return TakenForm("straight", f"{choice.method.name} needs what the looped shape does without")
    if coordinates > LARGEST_STRAIGHT:
        return TakenForm("looped", f"straight code for {coordinates} coordinates would take long to compile")
    return faster if straight else TakenForm("looped", f"compilation would outweigh faster runs ({size})")


def _looped_is_sooner(mechanism: Mechanism, choice: MethodChoice, evaluations: float) -> bool:
    """Whether the looped shape is expected to finish sooner, from an empty cache."""
    each = EACH[mechanism.space]
    looped = evaluations * (LOOPED_CALL + mechanism.body_coordinates * each.looped)
    straight = looped if choice.implicit else evaluations * mechanism.body_coordinates * each.straight
    return looped + LOOPED_LEAST < straight + straight_seconds(mechanism, choice.implicit)


#: Operations that are counted before the best tree so far is taken; the first tree is always counted.
ENOUGH = 12_000
#: A mechanism whose first tree takes more is not tried again: each count takes a second.
LARGE = 4_000
#: Another tree has to save this part to be taken.
GAIN = 0.01


@compute_once
def mechanism_on_tree(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism in the coordinates of its tree's joints; joints with ``cut = true`` carry nothing.

    Every run of the same description takes the same one, whose digest and numbers are then computed once.
    """
    first = spanning_tree(mechanism, mechanism.cuts)
    if not joints_of_loops(mechanism, first):
        return with_joint_coordinates(mechanism, first)
    text = f'"""Joints that carry nothing where `{mechanism.name}` is a tree."""\n'
    metadata, _ = side_module(
        mechanism, "tree", [sorted(mechanism.cuts)], lambda: (text, {"cut": list(_cheapest_choice(mechanism, first))})
    )
    return with_joint_coordinates(mechanism, spanning_tree(mechanism, tuple(metadata["cut"])))


def take_tree_of(mechanism: Mechanism, whole: Mechanism) -> Mechanism:
    """Return a mechanism that takes the tree of another one, which has the same joints and more rows or forces.

    Which tree is the cheapest depends on all that is derived. Where a part is left out, states keep their coordinates
    by this: all joints outside the other's tree are cut, which leaves nothing to choose.
    """
    tree = mechanism_on_tree(whole).topology
    assert tree is not None, "it is in joint coordinates"
    inside = {link.joint for link in tree.links}
    return msgspec.structs.replace(
        mechanism, cuts=tuple(name for name in possible_edges(mechanism) if name not in inside)
    )


def _cheapest_choice(mechanism: Mechanism, first: Topology) -> tuple[str, ...]:
    """Return the joints to cut, besides those that follow, for the fewest operations counted."""
    best, least = mechanism.cuts, count_rhs_operations(with_joint_coordinates(mechanism, first))
    counted, empty = least, count_empty_ends(mechanism, first)
    if least > LARGE:
        return best
    for loop in joints_of_loops(mechanism, first):
        cuts = best
        for joint in loop:
            if counted > ENOUGH:
                return best
            trial = (*cuts, joint)
            tree = spanning_tree(mechanism, trial)
            if _has_free_choice(tree) > _has_free_choice(first) or count_empty_ends(mechanism, tree) > empty:
                continue
            count = count_rhs_operations(with_joint_coordinates(mechanism, tree))
            counted += count
            if count < (1.0 - GAIN) * least:
                best, least = trial, count
    return best


def _has_free_choice(topology: Topology) -> int:
    """Return the number of bodies that no joint carries."""
    return sum(not link.joint for link in topology.links)


def count_rhs_operations(mechanism: Mechanism) -> int:
    """Return the operations of the right-hand side of `lagrange`, after sharing, without those on parameters alone."""
    from symgen.derive.formulate.formulate import formulate
    from symgen.derive.lower.plans import cheapest_plan, cost_of_plan

    equations = formulate(mechanism)
    return cost_of_plan(equations, cheapest_plan(equations, closing=False))[0]
