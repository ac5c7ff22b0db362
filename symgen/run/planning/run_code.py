"""The code of a run: the solver of its law, the shape of the code and the coordinates of the state."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from symgen.base.settings import Settings
from symgen.describe.facts.lengths import longest_body
from symgen.describe.formulas.evaluate import parameter_values
from symgen.run.compiling.choices import (
    TakenForm,
    choice_for_lengths,
    choose_coordinates,
    choose_shape,
    weigh_corrections,
)
from symgen.run.compiling.method_choice import MethodChoice, choice_for_masses

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism


class RunCode(NamedTuple):
    """The code of a run: its law, whether starts may choose the law's solver, shape, coordinates, and notes on them."""

    choice: MethodChoice
    solver_is_free: bool
    shape: TakenForm
    coordinates: TakenForm
    notes: tuple[str, ...]


def code_of_run(mechanism: Mechanism, s: Settings, choice: MethodChoice, shape: str, evaluations: float) -> RunCode:
    """Choose the solver of a law, the shape of its code, coordinates and the weight of corrections."""
    free, notes = "solver" in choice.options and not has_option(s, "solver"), tuple[str, ...]()
    massless = mechanism.has_massless
    choice, free = choice_for_masses(mechanism, choice, free), free and not massless
    if s.coordinates == "joint":
        choose_coordinates(mechanism, s.coordinates, shape)
        shape = "straight"
    code_shape = choose_shape(mechanism, choice, shape, evaluations)
    choice = replace(choice, shape=code_shape.name)
    coordinates = choose_coordinates(mechanism, s.coordinates, code_shape.name)
    if coordinates.name == "joint" and not has_option(s, "weight"):
        choice = weigh_corrections(choice, massless)
    elif not massless and not has_option(s, "weight"):
        choice, notes = choice_for_lengths(choice, longest_body(mechanism, parameter_values(mechanism, s.parameters)))
    return RunCode(choice, free, code_shape, coordinates, notes)


def has_option(s: Settings, option: str) -> bool:
    """Whether settings give an option of the method."""
    return any(key.partition(".")[2] == option for key in s.options)
