"""Names of varied and held quantities: parameters, coordinates and velocities of bodies and joints at the start."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from symgen.base.errors import InputError, suggest
from symgen.describe.parts.holds import ORIENTATION, joint_quantity_names
from symgen.run.layout.model_arrays import velocity_of_coordinate
from symgen.run.starts.held import Held

if TYPE_CHECKING:
    from symgen.base.vocabulary.expressions import Expr
    from symgen.describe.mechanism import Hold, Mechanism
    from symgen.run.layout.compiled import ModelInfo

#: What names of the method's parameters begin with.
METHOD = "method."
_EULER = ("e0", "e1", "e2", "e3")


@dataclass(frozen=True)
class Names:
    """Quantities in which runs of a mechanism may differ.

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
    states : tuple of str
        Of the file's own.
    options : tuple of str
        Parameters of the method: ``method.alpha``.
    """

    model: str
    parameters: tuple[str, ...]
    coordinates: tuple[str, ...]
    velocities: tuple[str, ...]
    joints: Mapping[str, str]
    states: tuple[str, ...] = ()
    options: tuple[str, ...] = ()

    @classmethod
    def of_mechanism(cls, mechanism: Mechanism) -> Names:
        """Return the names of a mechanism."""
        bodies = mechanism.bodies
        coordinates = tuple(f"{body.name}.{name}" for body in bodies for name in body.coordinates)
        velocities = tuple(f"{body.name}.{name}" for body in bodies for name in body.speeds)
        parameters = tuple(p.name for p in mechanism.parameters)
        states = tuple(x.name for x in mechanism.states)
        return cls(mechanism.name, parameters, coordinates, velocities, joint_quantity_names(mechanism), states)

    @property
    def starts(self) -> tuple[str, ...]:
        """All names of the start."""
        return (*self.coordinates, *self.velocities, *self.joints, *self.states)

    def canonical_name(self, name: str) -> str:
        """Return the one name of what a name of the start means."""
        plain = name in self.parameters or name in self.coordinates or name in self.velocities
        return name if plain else self.joints.get(name, name)

    def check(self, varied: Iterable[str], taken_names: Iterable[str]) -> None:
        """Refuse what cannot vary.

        Parameters
        ----------
        varied : iterable of str
            Names as they were written.
        taken_names : iterable of str
            Names that are given values otherwise.

        Raises
        ------
        InputError
            If a name is none, means what another one does, or is given otherwise.
        """
        names = (*self.parameters, *self.starts, *self.options)
        written, others = dict[str, str](), set(map(self.canonical_name, taken_names))
        for name in varied:
            where = f"vary '{name}'"
            if name not in names:
                expected = f"a parameter, or an initial coordinate or velocity of {self.model}"
                if name.startswith(METHOD):
                    names, expected = self.options, "a parameter of the method, which is a number"
                key = name.rpartition(".")[2]
                makes = f"'{key} = VALUE' in [parameters] makes one, which the body reads by its name"
                hint = makes if key in ("mass", "inertia") else suggest(name, names) or "it has none"
                raise InputError(where, expected, "none of that name", hint)
            if name in self.coordinates and name.rpartition(".")[2] in _EULER:
                raise InputError(
                    where,
                    "a coordinate that can change by itself",
                    "an Euler parameter",
                    "write the orientation with a parameter, and vary that",
                )
            one = self.canonical_name(name)
            if one in others:
                raise InputError(where, "one way of giving it a value", "two")
            if one in written:
                raise InputError(where, "each thing once", f"{written[one]} and {name}, which are the same")
            written[one] = name


@dataclass(frozen=True)
class Targets:
    """Quantities that the starts of all runs hold.

    Attributes
    ----------
    held : Held
        By index, with values of 0: those of rows are in `Rows.targets`.
    names : tuple of str
        Names of those values, in the order of `Rows.targets`: coordinates, then joint coordinates, then their rates.
    velocities : mapping of str to int
        Velocities that vary or have values of their own, with their index.
    constant : mapping of str to Expr
        Values of those that do not vary.
    """

    held: Held
    names: tuple[str, ...]
    velocities: Mapping[str, int]
    constant: Mapping[str, Expr]


def start_targets(names: Names, varied: Sequence[str], holds: Sequence[Hold], info: ModelInfo) -> Targets:
    """Return the quantities that starts hold.

    Parameters
    ----------
    names : Names
        Of the mechanism.
    varied : sequence of str
        Varied quantities, which are held at their values.
    holds : sequence of Hold
        Quantities that the description or the settings hold; varied ones are held at their values alone.
    info : ModelInfo
        The model.
    """
    varies = {names.canonical_name(name) for name in varied}
    others = [hold for hold in holds if hold.name not in varies]
    constant = {hold.name: hold.value for hold in others if hold.value is not None}
    places = [hold.name for hold in others if hold.value is None and hold.name not in names.velocities]
    plain_names = {name: names.canonical_name(name) for name in (*varied, *constant)}

    def indices_among(names_of_kind: Sequence[str]) -> dict[str, int]:
        return {name: names_of_kind.index(one) for name, one in plain_names.items() if one in names_of_kind}

    joints = [quantity.name for quantity in info.joint_coordinates]
    coordinates, turned, rates = map(indices_among, (names.coordinates, joints, [f"{name}.rate" for name in joints]))
    columns = [names.velocities.index(hold.name) for hold in others if hold.name in names.velocities]
    held = Held(
        coordinates=dict.fromkeys(coordinates.values(), 0.0),
        velocities=dict.fromkeys(columns, 0.0),
        fixed=tuple(sorted({j for name in places for j in _velocity_columns(name, info)})),
        joints=dict.fromkeys(turned.values(), 0.0),
        rates=dict.fromkeys(rates.values(), 0.0),
    )
    return Targets(held, (*coordinates, *turned, *rates), indices_among(names.velocities), constant)


def _velocity_columns(name: str, info: ModelInfo) -> tuple[int, ...]:
    """Return the velocities that change a coordinate, or the orientation of a body in space."""
    body, _, what = name.rpartition(".")
    if what == ORIENTATION:
        at = next(at for first, at in info.spins if info.coordinates[first].name == f"{body}.e0")
        return at, at + 1, at + 2
    return (velocity_of_coordinate([q.name for q in info.coordinates].index(name), info),)
