"""What varies and what is held, by name: parameters, coordinates and velocities of bodies and joints at the start."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from symgen.describe.holds import ORIENTATION, joint_names
from symgen.errors import InputError, nearest
from symgen.runtime.model_arrays import velocity_of

if TYPE_CHECKING:
    from symgen.describe.mechanism import Hold, Mechanism
    from symgen.runtime.compiled import ModelInfo
    from symgen.vocabulary.expressions import Expr

_EULER = ("e0", "e1", "e2", "e3")


@dataclass(frozen=True)
class Names:
    """What runs of a mechanism may differ in.

    Attributes
    ----------
    model : str
        Name of the mechanism.
    parameters : tuple of str
        Names of its parameters.
    coordinates, velocities : tuple of str
        Of bodies, in the order of q and v.
    joints : mapping of str to str
        Names of joint coordinates and rates, each with the one name of what it is.
    """

    model: str
    parameters: tuple[str, ...]
    coordinates: tuple[str, ...]
    velocities: tuple[str, ...]
    joints: Mapping[str, str]

    @classmethod
    def of(cls, mechanism: Mechanism) -> Names:
        """Return the names of a mechanism."""
        bodies = mechanism.bodies
        coordinates = tuple(f"{body.name}.{name}" for body in bodies for name in body.coordinates)
        velocities = tuple(f"{body.name}.{name}" for body in bodies for name in body.speeds)
        parameters = tuple(p.name for p in mechanism.parameters)
        return cls(mechanism.name, parameters, coordinates, velocities, joint_names(mechanism))

    @property
    def starts(self) -> tuple[str, ...]:
        """All names of the start."""
        return (*self.coordinates, *self.velocities, *self.joints)

    def one(self, name: str) -> str:
        """Return the one name of what a name of the start means."""
        known = name in self.parameters or name in self.coordinates or name in self.velocities
        return name if known else self.joints.get(name, name)

    def check(self, varied: Iterable[str], given: Iterable[str]) -> None:
        """Refuse what cannot vary.

        Parameters
        ----------
        varied : iterable of str
            Names as they were written.
        given : iterable of str
            Names that are given values otherwise.

        Raises
        ------
        InputError
            If a name is none, means what another one does, or is given otherwise.
        """
        known, seen, taken = (*self.parameters, *self.starts), dict[str, str](), {self.one(name) for name in given}
        for name in varied:
            where = f"vary '{name}'"
            if name not in known:
                expected = f"a parameter, or an initial coordinate or velocity of {self.model}"
                raise InputError(where, expected, "none of that name", nearest(name, known))
            if name in self.coordinates and name.rpartition(".")[2] in _EULER:
                raise InputError(
                    where,
                    "a coordinate that can change by itself",
                    "an Euler parameter",
                    "write the orientation with a parameter, and vary that",
                )
            one = self.one(name)
            if one in taken:
                raise InputError(where, "one way of giving it a value", "two")
            if one in seen:
                raise InputError(where, "each thing once", f"{seen[one]} and {name}, which are the same")
            seen[one] = name


@dataclass(frozen=True)
class Held:
    """What the starts of all runs hold, by index.

    Attributes
    ----------
    coordinates, velocities : mapping of str to int
        Those that vary or have values of their own, with their index in q and v.
    joints : mapping of str to (int, int)
        Joint coordinates that do, with their index and 0, then rates with the index and 1.
    kept, fixed : tuple of int
        Velocities that are not projected, and velocities whose coordinates stay as they are described.
    constant : mapping of str to Expr
        Values of those that do not vary.
    """

    coordinates: Mapping[str, int]
    velocities: Mapping[str, int]
    joints: Mapping[str, tuple[int, int]]
    kept: tuple[int, ...]
    fixed: tuple[int, ...]
    constant: Mapping[str, Expr]


def held_of(names: Names, varied: Sequence[str], holds: Sequence[Hold], info: ModelInfo) -> Held:
    """Return what starts hold.

    Parameters
    ----------
    names : Names
        Of the mechanism.
    varied : sequence of str
        What varies, which is held at its values.
    holds : sequence of Hold
        What the description or the settings hold; what varies is not held otherwise.
    info : ModelInfo
        The model.
    """
    varies = {names.one(name) for name in varied}
    others = [hold for hold in holds if hold.name not in varies]
    constant = {hold.name: hold.value for hold in others if hold.value is not None}
    places = [hold.name for hold in others if hold.value is None and hold.name not in names.velocities]
    asked = {name: names.one(name) for name in (*varied, *constant)}
    joints = {quantity.name: k for k, quantity in enumerate(info.joint_coordinates)}
    rates = {f"{name}.rate": k for name, k in joints.items()}
    at = {name: (joints[one], 0) for name, one in asked.items() if one in joints}
    at |= {name: (rates[one], 1) for name, one in asked.items() if one in rates}
    return Held(
        coordinates={name: names.coordinates.index(one) for name, one in asked.items() if one in names.coordinates},
        velocities={name: names.velocities.index(one) for name, one in asked.items() if one in names.velocities},
        joints=at,
        kept=tuple(names.velocities.index(hold.name) for hold in others if hold.name in names.velocities),
        fixed=tuple(sorted({j for name in places for j in _columns(name, info)})),
        constant=constant,
    )


def _columns(name: str, info: ModelInfo) -> tuple[int, ...]:
    """Return the velocities that change a coordinate, or the orientation of a body in space."""
    body, _, what = name.partition(".")
    if what == ORIENTATION:
        at = next(at for first, at in info.spins if info.coordinates[first].name == f"{body}.e0")
        return at, at + 1, at + 2
    return (velocity_of([q.name for q in info.coordinates].index(name), info),)
