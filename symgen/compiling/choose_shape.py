"""Which shape the code of a run gets: straight lines for this mechanism alone, or loops that all mechanisms share.

Straight code is about two and a half times as fast and has to be compiled for every mechanism, which takes time that
grows with it; looped code is compiled once for all. A step of an implicit integrator costs about the same in both, as
most of it is the solution of its equations, and its Jacobian makes straight code longer. ``auto`` takes the shape whose
compilation and run together are expected to be shorter. The figures below come from ``benchmarks/shapes.py`` and
``benchmarks/newton.py``; they need not be exact, as the shapes differ by factors where the choice matters.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from symgen.compiling.choose_coordinates import Taken
from symgen.compiling.pipeline import folder_of, for_coordinates, generator_digest
from symgen.errors import InputError
from symgen.store.entries import Entries

if TYPE_CHECKING:
    from symgen.compiling.pipeline import MethodChoice
    from symgen.describe.mechanism import Mechanism


#: Seconds to derive, emit and compile a mechanism straight: at least, and for each coordinate (in the plane 0.009, in
#: space 0.024).
STRAIGHT_LEAST, STRAIGHT_EACH = 0.4, 0.013
#: The same for each coordinate with the Jacobian for implicit integrators (0.009 and 0.035).
STRAIGHT_EACH_IMPLICIT = 0.02
#: Seconds to compile what the looped shape shares: generic code, a law, a kernel, a kernel's part of a descriptor form.
LOOPED_GENERIC, LOOPED_LAW, LOOPED_KERNEL, LOOPED_FORM = 7.0, 1.7, 0.45, 0.6
#: Part of these seconds that counts: other mechanisms and later runs will not pay them again.
SHARED_PART = 0.4
#: Seconds of an evaluation for each coordinate; looped ones cost something whatever the size.
STRAIGHT_EVALUATION, LOOPED_EVALUATION, LOOPED_CALL = 1.0e-8, 2.1e-8, 1.0e-7
#: From this many coordinates on straight code is not considered: eight seconds here, most of a minute at three times as
#: many, for a mechanism in the plane.
LARGEST_STRAIGHT = 600


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
    coordinates, choice = sum(len(b.coordinates) for b in mechanism.bodies), for_coordinates(mechanism, choice)
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
    from symgen.compiling.looped import Needs, shared_folder

    looped = evaluations * (LOOPED_CALL + coordinates * LOOPED_EVALUATION)
    straight = looped if choice.implicit else evaluations * coordinates * STRAIGHT_EVALUATION
    straight += STRAIGHT_LEAST + (STRAIGHT_EACH_IMPLICIT if choice.implicit else STRAIGHT_EACH) * coordinates
    if looped < straight:  # what is missing is looked up only where it can matter
        shared, needs = shared_folder(generator_digest()), Needs.of(mechanism, choice)
        missing = 0.0 if _known(store, shared, "model") else LOOPED_GENERIC
        missing += 0.0 if _known(store, shared, needs.law) else LOOPED_LAW
        missing += LOOPED_KERNEL * sum(not _known(store, shared, stem) for stem in needs.elements)
        missing += LOOPED_FORM * sum(not _known(store, shared, stem) for stem in needs.forms.values())
        looped += SHARED_PART * missing
    if looped < straight:
        return Taken("looped", f"compilation would outweigh faster runs ({_size(coordinates, evaluations)})")
    return Taken("straight", f"faster runs outweigh compilation ({_size(coordinates, evaluations)})")


def _size(coordinates: int, evaluations: float) -> str:
    return f"{coordinates} coordinates, about {evaluations:.2g} evaluations"


def _is_compiled(mechanism: Mechanism, choice: MethodChoice, store: Entries) -> bool:
    """Whether straight code of a mechanism for a method is in the cache."""
    folder = folder_of(mechanism)
    return _known(store, folder, "model") and _known(store, folder, choice.stem)


def _known(store: Entries, folder: str, stem: str) -> bool:
    return store.path(folder, stem).with_suffix(".json").exists()
