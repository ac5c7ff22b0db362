"""M of the bodies and rotors of a mechanism, as formulas of a run: for resets of velocities, and for starts."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from symgen.base.vocabulary.expressions import ZERO, Expr, Reading, call, sum_of_terms
from symgen.base.vocabulary.measures import GROUND, Spin
from symgen.describe.mechanism import AnyBody, Mechanism, Rotor, SpatialBody
from symgen.run.compiling.side import compile_side
from symgen.run.starts.masses import Masses

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel


def masses_of_starts(mechanism: Mechanism, compiled: CompiledModel, holds: bool) -> Masses | None:
    """Return what is off the diagonal of M in coordinates of bodies, or None where nothing is, or no start asks for it.

    Parameters
    ----------
    mechanism, compiled : Mechanism, CompiledModel
        The description, and its compiled form.
    holds : bool
        Whether a start holds velocities; without any, only those described may contradict each other.
    """
    if not (has_coupled_masses(mechanism) and (holds or describes_velocities(mechanism))):
        return None
    entries = entries_of_masses(mechanism)
    formulas = formulas_of_masses(mechanism, entries)
    function = compile_side(mechanism, compiled, "masses", "M at starts", formulas).function
    return Masses(function, tuple(entries), len(mechanism.rotors))


def has_coupled_masses(mechanism: Mechanism) -> bool:
    """Whether M has entries off its diagonal in coordinates of bodies, or rotors, which may have such entries."""
    return bool(mechanism.rotors) or any(i != j for i, j in entries_of_masses(mechanism))


def describes_velocities(mechanism: Mechanism) -> bool:
    """Whether a body of the mechanism has described velocities."""
    return any(x is not None for body in mechanism.bodies for x in (*body.velocity, *_spin(body)))


def _spin(body: AnyBody) -> tuple[Expr | None, ...]:
    return body.angular_velocity if isinstance(body, SpatialBody) else (body.angular_velocity,)


def formulas_of_masses(mechanism: Mechanism, entries: Mapping[tuple[int, int], Expr]) -> list[tuple[str, Expr]]:
    """Return entries of bodies, rates of rotors and their inertias, with a label of each."""
    formulas = [(f"mass {i}, {j}", value) for (i, j), value in entries.items()]
    formulas += [(f"rate of the rotor of {rotor.joint}", rate_of_rotor(mechanism, rotor)) for rotor in mechanism.rotors]
    return formulas + [(f"inertia of the rotor of {rotor.joint}", rotor.inertia) for rotor in mechanism.rotors]


def entries_of_masses(mechanism: Mechanism) -> dict[tuple[int, int], Expr]:
    """Return entries of bodies in M by row and column: off-diagonal ones, with joints or rotors diagonal ones too."""
    entries, first = dict[tuple[int, int], Expr](), 0
    for body in mechanism.bodies:
        inertia: tuple[Expr, ...] = ()
        if isinstance(body, SpatialBody):
            inertia = body.inertia or ()
        elif body.inertia is not None:
            inertia = (body.inertia,)
        if mechanism.topology is not None or mechanism.rotors:
            diagonal = [body.mass] * len(mechanism.gravity) + list(inertia[:3])
            entries |= {(first + i, first + i): value for i, value in enumerate(diagonal)}
        for (i, j), value in zip(((3, 4), (3, 5), (4, 5)), inertia[3:], strict=False):
            if value != ZERO:
                entries[first + i, first + j] = value
        first += len(body.speeds)
    return entries


def rate_of_rotor(mechanism: Mechanism, rotor: Rotor) -> Expr:
    """Return the rate of a rotor's angle, as M of the equations of motion has it.

    In space it is the difference of the angular velocities of both bodies about the axes that the joint keeps parallel.
    """
    if mechanism.topology is not None or not rotor.axes:
        return Reading(f"{rotor.joint}.rotor.rate", rotor.angle, 1)
    signed = [(sign, axis) for axis, sign in zip(rotor.axes, (-1.0, 1.0), strict=True) if axis.body != GROUND]
    rates = [(sign, Reading(f"{axis.body}.spin.rate", Spin(GROUND, axis.body, axis), 1)) for sign, axis in signed]
    return sum_of_terms(*(rate if sign > 0.0 else call("neg", rate) for sign, rate in rates))
