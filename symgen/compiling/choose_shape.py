"""Which shape the code of a run gets: straight lines for this mechanism alone, or loops that all mechanisms share.

Straight code is two to four times as fast and has to be compiled for every mechanism, which takes time that grows with
it; looped code is compiled once for all. A step of an implicit integrator costs about the same in both, as most of it
is the solution of its equations, and its Jacobian makes straight code longer. ``auto`` takes the shape whose
compilation and run together are expected to be shorter, as if nothing had been compiled yet: what the cache holds must
not change the digits of a run. The figures below come from ``benchmarks/shapes.py``; they need not be exact, as the
shapes differ by factors where the choice matters, and another machine changes all of them alike.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from symgen.compiling.choose_coordinates import Taken
from symgen.compiling.pipeline import for_coordinates
from symgen.errors import InputError

if TYPE_CHECKING:
    from symgen.compiling.pipeline import MethodChoice
    from symgen.describe.mechanism import Mechanism


class ShapeCost(NamedTuple):
    """What a mechanism costs for each of its coordinates; turns and their kernels make more of one in space.

    Attributes
    ----------
    compilation, implicit : float
        To derive, emit and compile it straight; the same with the Jacobian for implicit integrators [s].
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
#: Seconds to derive and compile what looped code shares, where none of it is there: one figure for 1 to 4, whatever is.
LOOPED_LEAST = 2.2
#: Seconds of a looped evaluation whatever the size.
LOOPED_CALL = 1.0e-7
#: From this many coordinates on straight code is not considered: eight seconds here, most of a minute at three times as
#: many, for a mechanism in the plane.
LARGEST_STRAIGHT = 600
#: More coordinates are refused where matrices stay dense.
LARGEST_DENSE = 400


def straight_seconds(mechanism: Mechanism, implicit: bool = False) -> float:
    """Return about how long the straight code of a method takes to derive and compile [s]."""
    each = EACH[mechanism.space]
    return STRAIGHT_LEAST + (each.implicit if implicit else each.compilation) * mechanism.body_coordinates


def choose_shape(mechanism: Mechanism, choice: MethodChoice, asked: str, evaluations: float) -> Taken:
    """Decide the shape of a run, ``straight`` or ``looped``.

    Parameters
    ----------
    mechanism : Mechanism
        What is run.
    choice : MethodChoice
        The method with its options.
    asked : str
        One of `symgen.settings.SHAPES`.
    evaluations : float
        Evaluations that are expected.

    Raises
    ------
    InputError
        If there is no such shape, or the method cannot have it at this size.
    """
    coordinates, choice = mechanism.body_coordinates, for_coordinates(mechanism, choice)
    size = f"{coordinates} coordinates, about {evaluations:.2g} evaluations"
    faster = Taken("straight", f"faster runs outweigh compilation ({size})")
    straight = coordinates <= LARGEST_STRAIGHT and not _looped_is_sooner(mechanism, choice, evaluations)
    if asked == "auto" and straight and coordinates <= LARGEST_DENSE:
        return faster
    # what only looped code asks for is not loaded where straight code is taken
    from symgen.lower.looped.law import is_loopable, refuse_dense

    dense = not is_loopable(choice.method, choice.options, choice.implicit)
    if asked == "looped":
        refuse_dense(choice.method, choice.options, choice.implicit)
    if dense and coordinates > LARGEST_DENSE:
        raise InputError(
            f"method '{choice.method.name}'",
            f"a mechanism of at most {LARGEST_DENSE} coordinates, as its matrices are dense",
            f"{coordinates} coordinates",
        )
    if asked != "auto":
        return Taken(asked, "it was asked for")
    if dense:
        return Taken("straight", f"{choice.method.name} needs what the looped shape does without")
    if coordinates > LARGEST_STRAIGHT:
        return Taken("looped", f"straight code for {coordinates} coordinates would take long to compile")
    return faster if straight else Taken("looped", f"compilation would outweigh faster runs ({size})")


def _looped_is_sooner(mechanism: Mechanism, choice: MethodChoice, evaluations: float) -> bool:
    """Whether the looped shape is expected to be done sooner, from an empty cache."""
    each = EACH[mechanism.space]
    looped = evaluations * (LOOPED_CALL + mechanism.body_coordinates * each.looped)
    straight = looped if choice.implicit else evaluations * mechanism.body_coordinates * each.straight
    return looped + LOOPED_LEAST < straight + straight_seconds(mechanism, choice.implicit)
