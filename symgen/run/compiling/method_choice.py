"""The choice of a method: its structural options, the shape of its code, and what the mechanism makes of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from symgen.base.errors import InputError
from symgen.base.vocabulary.measures import GROUND
from symgen.compile.store.identity import combined_digest
from symgen.derive.lower.law import refuse_bounded_rows
from symgen.derive.methods import METHODS
from symgen.derive.methods._base import EXPLICIT_FORMS, Method
from symgen.describe.bounds.by_reaction import SLIDING, pressed_rows
from symgen.describe.joints.rows import tied_bodies
from symgen.describe.mechanism import Mechanism

#: Characters of a file stem that say which velocities are free, at most.
LONGEST_FREE = 18


@dataclass(frozen=True)
class MethodChoice:
    """A method with its requested structural options, the shape of its code, and velocities that loops leave free.

    `directed`: with a right-hand side for derivatives.
    """

    method: Method
    options: Mapping[str, str]
    implicit: bool = False
    shape: str = "straight"
    free: tuple[int, ...] = ()
    directed: bool = False

    @property
    def stem(self) -> str:
        """File stem of its module."""
        return self.method.stem(self.options, self.implicit) + self.suffix

    @property
    def suffix(self) -> str:
        """End of the file stem, which says the free velocities, and whether it is for derivatives.

        Many free velocities are said by a digest: names of modules have an end.
        """
        free = "".join(f"_f{j}" for j in self.free)
        if len(free) > LONGEST_FREE:
            free = f"_f{combined_digest(free)[: LONGEST_FREE - 2]}"
        return free + "_slopes" * self.directed

    def with_options(self, **options: str) -> MethodChoice:
        """Return the choice with other values of some options."""
        return replace(self, options={**self.options, **options})


def choose_method(name: str, options: Mapping[str, str] | None = None, implicit: bool = False) -> MethodChoice:
    """Return the method called `name` with its options, defaults filled in, and the form that an integrator needs.

    Raises
    ------
    InputError
        If there is no such method or option.
    """
    method = METHODS.get(name, "method")
    implicit = implicit or not EXPLICIT_FORMS & set(method.forms)  # some methods have no other form
    return MethodChoice(method, method.complete_options(options or {}), implicit)


def takes_bounded_rows(choice: MethodChoice, mechanism: Mechanism) -> bool:
    """Return whether a method takes rows that may be off, whose bounds, if they have any, may depend on reactions."""
    if not mechanism.has_modes:
        return True
    pressed = next((row.family.one for row in pressed_rows(mechanism)), "")
    try:
        refuse_bounded_rows(choice.method, choice.options, choice.implicit, pressed)
    except InputError:
        return False
    return True


def choice_for_coordinates(mechanism: Mechanism, choice: MethodChoice) -> MethodChoice:
    """Return a choice for the mechanism's coordinates: the metric of bodies is the identity in their own."""
    if mechanism.topology is not None or choice.options.get("weight") != "body":
        return choice
    return choice.with_options(weight="identity")


def _bodies_of_pressed_rows(mechanism: Mechanism) -> set[str]:
    """Return the bodies that joints and rows with bounds tie to those whose bounds depend on forces."""
    ties = [set(joint.bodies) for joint in mechanism.joints] + [set(tied_bodies(x.held)) for x in mechanism.bounded]
    found, before = {body for row in pressed_rows(mechanism) for body in tied_bodies(row.held)}, 0
    while len(found) > before:
        before = len(found)
        found.update(*(tie for tie in ties if tie & found - {GROUND}))
    return found


def choice_for_masses(mechanism: Mechanism, choice: MethodChoice, free: bool = True) -> MethodChoice:
    """Return a choice for massless bodies: v' is not eliminated, where the solver is `free` to be chosen.

    Raises
    ------
    InputError
        If a body is massless, and the method inverts M.
    """
    if not mechanism.has_massless:
        return choice
    # M is not inverted then, and multipliers are refined; loads of bounds are those of one solution
    whole = choice.with_options(solver="augmented") if "solver" in choice.options else choice
    if pressed := pressed_rows(mechanism):
        sliders = {joint.bodies[-1] for joint in mechanism.joints if joint.kind == SLIDING}
        tied = _bodies_of_pressed_rows(mechanism) - sliders
        name = next((body.name for body in mechanism.bodies if body.massless and body.name in tied), "")
        if name:
            expected = (
                f"a mass and moments of inertia above 0, as {pressed[0].family.one} depends on the reaction of a joint"
            )
            raise InputError(f"bodies.{name}", expected, "one that is 0", pressed[0].family.apart)
        free = False  # rows of a point on a curve fix its velocities: elimination gives its mass to the slider
    if choice.method.needs_regular_mass((whole if pressed else choice).options):
        raise InputError(f"method '{choice.method.name}'", "one that does with massless bodies", "one that inverts M")
    return whole if free else choice
