"""Inputs of a mechanism: formulas, data and numbers put into their places."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from symgen.base.errors import InputError
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.mechanism import Mechanism, with_largest_step
from symgen.describe.parts.driven_mechanism import DrivenMechanism, apply_inputs
from symgen.run.breaks.foreseen_seams import seams_of_motion
from symgen.run.loops.run_spec import Seam

if TYPE_CHECKING:
    from symgen.base.settings import Settings


@dataclass(frozen=True)
class Inputs:
    """A mechanism and settings with the inputs of a run in their places.

    Attributes
    ----------
    mechanism : Mechanism
        With formulas and data in the places of inputs, and the largest step of the run.
    settings : Settings
        Without inputs; their values at the start are among the parameters.
    seams : tuple of Seam
        Parts of the run between jumps of inputs; empty where none jumps.
    words : mapping of str to str or float
        Each input as a text, or as its number.
    driven : DrivenMechanism or None
        The formulas and data of inputs; None where all inputs are numbers.
    """

    mechanism: Mechanism
    settings: Settings
    seams: tuple[Seam, ...]
    words: Mapping[str, str | float]
    driven: DrivenMechanism | None = None


def put_inputs(mechanism: Mechanism, settings: Settings, beyond: float = 0.0) -> Inputs:
    """Put the inputs of a run into their places.

    Parameters
    ----------
    mechanism, settings : Mechanism, Settings
        The description and the settings of a run.
    beyond : float
        Jumps are searched for this fraction of the run beyond its end, see `seams_of`.

    Raises
    ------
    InputError
        If an input is wrong, see `symgen.describe.parts.driven_mechanism.apply_inputs`, or set twice.
    """
    for name in settings.inputs:
        if name in settings.parameters:
            raise InputError(f"input '{name}'", "one way of giving it a value", "two: a parameter is set by that name")
    mechanism = with_largest_step(mechanism, settings.max_step)
    numbers = {name: settings.parameters[name] for name in mechanism.inputs if name in settings.parameters}
    if not settings.inputs:
        values = parameter_values(mechanism, settings.parameters) if mechanism.inputs else {}
        return Inputs(mechanism, settings, (), {name: values[name] for name in mechanism.inputs})
    sources = apply_inputs(mechanism, {**numbers, **settings.inputs})
    parameters = {**settings.parameters, **sources.numbers}
    until = mechanism.defaults.until if settings.until is None else settings.until
    values = parameter_values(sources.mechanism, parameters)
    seams = seams_of_motion(sources, values, until, beyond=beyond)
    parameters |= seams[0].values if seams else {}
    # defaults of inputs may follow other parameters, so numbers are read from the values
    words = {name: x if isinstance(x, str) else values[name] for name, x in sources.descriptions.items()}
    return Inputs(sources.mechanism, replace(settings, parameters=parameters, inputs={}), seams, words, sources)
