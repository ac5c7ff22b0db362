"""The pipeline: four calls from a mechanism to a compiled model, the same ones for straight and for looped code.

    mechanism --formulate--> equations --lower--> programs --emit--> source --compile--> compiled model

`symgen.run.compiling.straight` and `symgen.run.compiling.looped` have the stages. Where the cache has the source, only
`compile` is called, so that neither SymPy nor Jinja2 is imported.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from symgen.base.errors import InputError
from symgen.describe.bounds.by_reaction import pressed_rows
from symgen.describe.formulas.results_read import reads_results
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.free_by_loops import choice_at_start
from symgen.run.compiling.kept_code import code_at_hand
from symgen.run.compiling.method_choice import MethodChoice, choice_for_coordinates, choose_method
from symgen.run.compiling.stages import Generated, PipelineStages, unless_stored
from symgen.run.compiling.straight import StraightStages
from symgen.run.layout.compiled import CompiledModel


@unless_stored
def compile_in_stages(stages: PipelineStages[Any, Any]) -> CompiledModel:
    """Return a compiled model: the whole pipeline."""
    equations = stages.formulate()
    programs = stages.lower(equations)
    sources = stages.emit(programs)
    return stages.compile(sources)


def generate_in_stages(stages: PipelineStages[Any, Any]) -> Generated:
    """Return the source for readers, from the same stages without the last one."""
    equations = stages.formulate()
    programs = stages.lower(equations)
    sources = stages.emit(programs)
    return stages.collect(sources)


def stages_of(
    mechanism: Mechanism,
    choices: tuple[MethodChoice, ...],
    shape: str,
    target: str = "cpu",
    whole: bool = False,
    lean: bool = False,
) -> PipelineStages[Any, Any]:
    """Return the stages of a shape of code; parameters and errors as of `generate`."""
    if target != "cpu":
        _refuse_target(mechanism, target, choices, shape)
    if shape == "looped":
        from symgen.run.compiling.looped import LoopedStages

        refuse_loops(mechanism)
        return LoopedStages(mechanism, choices, whole)
    return StraightStages(mechanism, choices, target, whole, lean)


# -- who calls it ------------------------------------------------------------------------------------------------------


def compile_model(mechanism: Mechanism, choice: MethodChoice, target: str = "cpu") -> CompiledModel:
    """Return the compiled model of `mechanism` for one method, generated only if the cache does not have it.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    choice : MethodChoice
        The method and its structural options.
    target : {"cpu", "lanes", "cuda"}
        Target of the code.

    Raises
    ------
    InputError
        As for `generate`.
    """
    choice = choice_for_coordinates(mechanism, choice)
    options = dict(choice.options)
    arguments = mechanism, choice.method.name, options, choice.implicit, choice.shape, target, choice.directed

    def compile_it() -> CompiledModel:
        return compile_in_stages(stages_of(mechanism, (choice_at_start(mechanism, choice),), choice.shape, target))

    return replace(code_at_hand(mechanism, choice, target, compile_it), origin=(compile_again, arguments))


def compile_again(
    mechanism: Mechanism,
    method: str,
    options: Mapping[str, str],
    implicit: bool,
    shape: str,
    target: str,
    directed: bool,
) -> CompiledModel:
    """Return a compiled model that was pickled elsewhere: from the cache, or generated."""
    choice = replace(choose_method(method, options, implicit), shape=shape, directed=directed)
    return compile_model(mechanism, choice, target=target)


def generate(
    mechanism: Mechanism,
    choices: tuple[MethodChoice, ...],
    shape: str = "straight",
    target: str = "cpu",
    whole: bool = False,
    lean: bool = False,
) -> Generated:
    """Derive, lower and emit `mechanism` with every method of `choices`.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    choices : tuple of MethodChoice
        One law module is emitted for each.
    shape : {"straight", "looped"}
        Code for this mechanism alone, or loops over tables.
    target : {"cpu", "lanes", "cuda"}
        Target of the code; stems of modules end in ``_lanes`` or ``_cuda`` then.
    whole : bool
        Whether each law is one readable module, and not modules that laws share, as in the cache.
    lean : bool
        Whether a readable model has only what these laws call, in straight code.

    Returns
    -------
    Generated
        The source of ``model`` and of every law, with metadata.

    Raises
    ------
    InputError
        If the code would be looped or for implicit integrators where it is not for ``cpu``; if tables are too long for
        ``cuda``, or a method iterates for ``lanes``; if numbers overflow.
    """
    choices = tuple(choice_for_coordinates(mechanism, choice) for choice in choices)
    return generate_in_stages(stages_of(mechanism, choices, shape, target, whole, lean))


# -- refusals ----------------------------------------------------------------------------------------------------------


def refuse_loops(mechanism: Mechanism) -> None:
    """Refuse looped code for files that need straight code.

    Raises
    ------
    InputError
        If rows of joints may be off, or bodies have modes.
    """
    if what := straight_alone(mechanism):
        raise InputError("shape", f"straight code where a file has {what}", "looped")


def straight_alone(mechanism: Mechanism) -> str:
    """Return what of a file exists as straight code alone; empty where loops take all of it."""
    if mechanism.has_modal_bodies:
        return "modal bodies"
    if any(reads_results(x.rate) for x in mechanism.states):
        return "states that read accelerations or forces"
    if mechanism.holding:
        return "joints that hold for a while"
    if mechanism.has_massless and pressed_rows(mechanism):
        return "sliders on curves beside bounds by reactions"
    if any(row.paired for row in mechanism.bounded):
        return "slip of contacts in space"
    if any(row.turns for row in mechanism.bounded):
        return "rolling resistance"
    return "rows that may be off" if mechanism.switchable else ""


def _refuse_target(mechanism: Mechanism, target: str, choices: tuple[MethodChoice, ...], shape: str) -> None:
    if mechanism.has_modal_bodies:
        raise InputError(f"target '{target}'", "bodies without modes", "modal bodies", "target 'cpu' takes them")
    if shape == "looped":
        raise InputError(f"target '{target}'", "the straight shape", "looped")
    for choice in choices:
        if choice.implicit:
            expected = f"a method that explicit integrators solve (target {target})"
            raise InputError(f"method '{choice.method.name}'", expected, "one for implicit ones")
