"""A mechanism whose bodies a hand can pull: springs from the ground, all slack until one of them is taken.

A page that works out motions has the springs in its code, so that a hand that takes a body compiles nothing. Forces are
efforts along coordinates of a point, as those of a file are: joints keep what they hold.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import msgspec

from symgen.base.vocabulary.expressions import ZERO, Name, call, sum_of_terms
from symgen.base.vocabulary.measures import GROUND, Component, Effort, Marker, axes
from symgen.describe.forces._parts import damper_force
from symgen.describe.mechanism import AnyBody, Force, Mechanism, Parameter


@dataclass(frozen=True)
class Pulled:
    """A mechanism with a spring and a damper on each body.

    The force on point P of the body that is pulled is ``k (to - r_P) - c v_P``. The damper works against the ground, so
    that a body which is held comes to rest.

    Attributes
    ----------
    mechanism : Mechanism
        The mechanism with the springs; its further parameters are the last ones.
    at, to : tuple of str
        Parameters for the coordinates of P in the frame of its body, and for those of the spring's other end [m].
    springs : mapping of str to pair of str
        Parameters k [N/m] and c [N s/m] by body; 0 but for the body that is pulled.
    """

    mechanism: Mechanism
    at: tuple[str, ...]
    to: tuple[str, ...]
    springs: dict[str, tuple[str, str]]

    @property
    def names(self) -> frozenset[str]:
        """All parameters of the springs."""
        return frozenset((*self.at, *self.to, *(name for pair in self.springs.values() for name in pair)))

    def without_springs(self, mechanism: Mechanism) -> Mechanism:
        """Return a mechanism that was made of this one, without the forces of the springs."""
        own = {force.name for force in self.mechanism.forces[-len(self.springs) :]}
        return msgspec.structs.replace(mechanism, forces=tuple(f for f in mechanism.forces if f.name not in own))


def pull_bodies(mechanism: Mechanism) -> Pulled | None:
    """Return a mechanism with a slack spring on each body; None where it has no bodies."""
    if not mechanism.bodies:
        return None
    letters, head = "xyz"[: 3 if mechanism.space == "spatial" else 2], _free_beginning(mechanism)
    at, to = (tuple(f"{head}_{word}_{letter}" for letter in letters) for word in ("at", "to"))
    bodies: tuple[AnyBody, ...] = mechanism.bodies
    springs = {body.name: (f"{head}_k{i}", f"{head}_c{i}") for i, body in enumerate(bodies)}
    units = {**dict.fromkeys((*at, *to), "m")}
    for k, c in springs.values():
        units |= {k: "N/m", c: "N s/m"}
    forces = tuple(
        Force(f"{head}.{body}", "force", (body,), _efforts_of_spring(body, letters, at, to, *spring))
        for body, spring in springs.items()
    )
    parameters = tuple(Parameter(name, 0.0, unit) for name, unit in units.items())
    whole = msgspec.structs.replace(
        mechanism, parameters=(*mechanism.parameters, *parameters), forces=(*mechanism.forces, *forces)
    )
    return Pulled(whole, at, to, springs)


def _efforts_of_spring(
    body: str, letters: str, at: tuple[str, ...], to: tuple[str, ...], stiffness: str, damping: str
) -> tuple[Effort, ...]:
    """Return the efforts along the coordinates of the point; the hand moves the end, so that they have no potential."""
    origin, point = Marker(GROUND, (ZERO,) * len(letters)), Marker(body, tuple(map(Name, at)))
    return tuple(
        Effort(
            letter,
            Component(origin, point, axis),
            sum_of_terms(call("mul", Name(stiffness), call("sub", Name(end), Name("s"))), damper_force(Name(damping))),
        )
        for letter, axis, end in zip(letters, axes(GROUND, len(letters)), to, strict=True)
    )


def _free_beginning(mechanism: Mechanism) -> str:
    """Return a word with which no name of the mechanism begins."""
    m = mechanism
    groups: tuple[tuple[Any, ...], ...] = (m.parameters, m.bodies, m.joints, m.forces, m.states)
    taken = [str(part.name) for group in groups for part in group]
    heads = (f"pull{k or ''}" for k in range(len(taken) + 1))
    return next(head for head in heads if not any(name.startswith(head) for name in taken))
