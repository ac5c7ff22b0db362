"""Which shape the code of a run gets: straight lines for this mechanism alone, or loops that all mechanisms share.

Straight code is two to four times as fast and has to be compiled for every mechanism, which takes time that grows with
it; looped code is compiled once for all. A step of an implicit integrator costs about the same in both, as most of it
is the solution of its equations, and its Jacobian makes straight code longer. ``auto`` takes the shape whose
compilation and run together are expected to be shorter. The figures below come from ``benchmarks/shapes.py``; they need
not be exact, as the shapes differ by factors where the choice matters, and another machine changes all of them alike.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from symgen.compiling.choose_coordinates import Taken
from symgen.compiling.pipeline import folder_of, for_coordinates, generator_digest
from symgen.errors import InputError
from symgen.store.entries import Entries

if TYPE_CHECKING:
    from symgen.compiling.pipeline import MethodChoice
    from symgen.describe.mechanism import Mechanism


class Seconds(NamedTuple):
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
EACH = {"planar": Seconds(0.011, 0.013, 0.8e-8, 1.8e-8), "spatial": Seconds(0.03, 0.036, 2.5e-8, 1.0e-7)}
#: Seconds to compile each piece of what the looped shape shares; a form is a kernel's part of a descriptor form.
LOOPED = {"generic code": 0.2, "law": 0.35, "kernel": 0.2, "form": 0.2}
#: Seconds of a looped evaluation whatever the size.
LOOPED_CALL = 1.0e-7
#: From this many coordinates on straight code is not considered: eight seconds here, most of a minute at three times as
#: many, for a mechanism in the plane.
LARGEST_STRAIGHT = 600


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
    store = Entries()
    compiled = asked == "auto" and _is_compiled(mechanism, choice, store)
    if compiled and coordinates <= LARGEST_STRAIGHT:
        return Taken("straight", f"it is compiled already ({_size(coordinates, evaluations)})")
    # what only looped code asks for is not loaded where straight code is there to be run
    from symgen.lower.looped.law import LARGEST_DENSE, is_loopable, refuse_dense

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
    return _shorter(mechanism, choice, coordinates, evaluations, store)


def _shorter(mechanism: Mechanism, choice: MethodChoice, coordinates: int, evaluations: float, store: Entries) -> Taken:
    """Return the shape that is expected to be done sooner."""
    each = EACH[mechanism.space]
    looped = evaluations * (LOOPED_CALL + coordinates * each.looped)
    straight = looped if choice.implicit else evaluations * coordinates * each.straight
    straight += straight_seconds(mechanism, choice.implicit)
    if looped < straight:  # what is missing is looked up only where it can matter
        looped += sum(LOOPED[piece] * count for piece, count in missing_pieces(mechanism, choice, store).items())
    if looped < straight:
        return Taken("looped", f"compilation would outweigh faster runs ({_size(coordinates, evaluations)})")
    return Taken("straight", f"faster runs outweigh compilation ({_size(coordinates, evaluations)})")


def missing_pieces(mechanism: Mechanism, choice: MethodChoice, store: Entries) -> dict[str, int]:
    """Return how many pieces of what looped code shares the cache does not have, by the names in `LOOPED`."""
    from symgen.compiling.looped import Needs, shared_folder

    needs = Needs.of(mechanism, choice)
    stems = {
        "generic code": ["model"],
        "law": [needs.law],
        "kernel": list(needs.elements),
        "form": list(needs.forms.values()),
    }
    shared = shared_folder(generator_digest())
    return {piece: sum(not _known(store, shared, stem) for stem in each) for piece, each in stems.items()}


def _size(coordinates: int, evaluations: float) -> str:
    return f"{coordinates} coordinates, about {evaluations:.2g} evaluations"


def _is_compiled(mechanism: Mechanism, choice: MethodChoice, store: Entries) -> bool:
    """Whether straight code of a mechanism for a method is in the cache."""
    folder = folder_of(mechanism)
    return _known(store, folder, "model") and _known(store, folder, choice.stem)


def _known(store: Entries, folder: str, stem: str) -> bool:
    return store.path(folder, stem).with_suffix(".json").exists()
