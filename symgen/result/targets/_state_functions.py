"""The dynamics of a mechanism as one Python module for a library that differentiates."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from symgen.base.errors import InputError
from symgen.base.escapes import comment_text
from symgen.base.vocabulary.expressions import ZERO
from symgen.derive.emit.libraries import ARGUMENTS, Syntax, function_text
from symgen.derive.lower.function_programs import FunctionProgram, StateFunctions, Values, lower_function
from symgen.describe.formulas.formula_text import to_text
from symgen.run.planning.package import Package, write_folder
from symgen.run.planning.state_model import StateModel

if TYPE_CHECKING:
    from symgen.result.targets._target import Request

#: Functions of all mechanisms, and of those with rows: arguments and meaning.
OF_ALL = {
    "mass_matrix": ("q", "M"),
    "bias": ("qv", "h of M v' + h = effort - D^T lambda"),
    "forward_dynamics": ("qve", "v' with all rows in force"),
    "inverse_dynamics": ("qva", "M a + h; with rows the shortest efforts"),
    "rates": ("qv", "q'"),
    "kinetic_energy": ("qv", "T [J]"),
    "potential_energy": ("q", "V [J]"),
}
OF_ROWS = {
    "constraint_jacobian": ("q", "D of D v = nu"),
    "violation": ("q", "Phi"),
    "nu": ("q", "nu"),
    "gamma": ("qv", "gamma of D v' = gamma"),
}
OF_FRAMES = {"pose": "q", "velocity": "qv", "jacobian": "q"}


def write_functions(request: Request, library: str, syntax: Syntax, head: str, made: str) -> Package:
    """Write the module ``NAME_LIBRARY.py`` of a request.

    Parameters
    ----------
    request : Request
        The mechanism, its coordinates and the folder.
    library : str
        Name of the target.
    syntax : Syntax
        How it writes operations.
    head : str
        Lines at the head of the module.
    made : str
        Line after the elements ``_NAME`` that makes a function, with ``{name}``, ``{sizes}`` and ``{shape}``; empty
        where these are the function itself.

    Raises
    ------
    InputError
        If the shape is looped, a velocity has no inertia, or a formula reads a table.
    """
    where = f"--target {library}"
    began = time.perf_counter()
    model = state_model(where, request)
    functions, count = StateFunctions(model.mechanism), len(model.mechanism.parameters)
    programs = {
        x.name: lower_function(functions, x.base, x.purpose, x.vectors, x.values(functions)) for x in quantities(model)
    }
    derived = time.perf_counter()
    parts = list[str]()
    for name, program in programs.items():
        parts.append(function_text(where, program, count, f"_{name}" if made else name, syntax))
        if made:
            parts[-1] += "\n\n\n" + made.format(name=name, sizes=tuple(program.sizes.values()), shape=program.shape)
    text = "\n\n\n".join([_head(model, library, programs), head, *parts]) + "\n"
    name = f"{model.mechanism.name.replace('-', '_')}_{library}"
    files = write_folder(request.path, {f"{name}.py": text})
    return Package(request.path, files, derived - began, time.perf_counter() - derived)


class ModuleFunction(NamedTuple):
    """A function of a module.

    Attributes
    ----------
    name, base : str
        Its name there, and without the frame's.
    purpose : str
        What it is.
    vectors : str
        Spaces of its arguments before ``p``.
    values : callable
        Returns its nodes.
    identity : tuple
        What shapes these besides its name and the mechanism.
    """

    name: str
    base: str
    purpose: str
    vectors: str
    values: Callable[[StateFunctions], Values]
    identity: tuple[object, ...] = ()


def state_model(where: str, request: Request) -> StateModel:
    """Return the mechanism of a request for functions of its state.

    Raises
    ------
    InputError
        If the shape is looped, or a velocity has no inertia.
    """
    if request.shape != "straight":
        raise InputError(where, "the straight shape", request.shape)
    model = StateModel(where, request.mechanism, request.coordinates, {})
    if model.mechanism.has_massless and model.kind == "absolute":
        raise InputError(where, "bodies with mass and inertia, or joint coordinates", "one without")
    return model


def quantities(model: StateModel) -> Iterator[ModuleFunction]:
    """Yield the functions of a mechanism."""
    for name, (vectors, purpose) in (OF_ALL | (OF_ROWS if model.rows else {})).items():
        if model.rows and name in ("forward_dynamics", "inverse_dynamics"):
            values = partial(StateFunctions.solved_quantity, name=name, kept=model.kept)
            yield ModuleFunction(name, name, purpose, vectors, values, model.kept)
        else:
            yield ModuleFunction(name, name, purpose, vectors, partial(StateFunctions.values, name=name))
    taken = set[str]()
    for body in model.mechanism.bodies:
        origin = (ZERO,) * len(model.mechanism.gravity)
        places = [(f"{body.name}_{point}", at) for point, at in body.points] or [(body.name, origin)]
        for place, at in places:
            while place in taken:
                place += "_"
            taken.add(place)
            for what, vectors in OF_FRAMES.items():
                frame = partial(StateFunctions.frame, body=body.name, point=at, what=what, axes="world")
                purpose, identity = f"{what} of {place}", (body.name, *map(to_text, at))
                yield ModuleFunction(f"{what}_{place}", what, purpose, vectors, frame, identity)


def _head(model: StateModel, library: str, programs: dict[str, FunctionProgram]) -> str:
    """Return the docstring and the numbers of a module."""
    lines = [f'"""Dynamics of `{model.mechanism.name}` for {library}. Written by symgen.', ""]
    for name, program in programs.items():
        arguments = ", ".join(ARGUMENTS[x] for x in program.sizes)
        shape = " x ".join(map(str, program.shape)) or "a number"
        lines.append(f"{name}({arguments}): {comment_text(program.block.purpose)}, {shape}")
    for letter, part in (("q", model.coordinates), ("v", model.velocities)):
        lines += ["", *(f"{letter}[{i}] {comment_text(x.name)} [{comment_text(x.unit)}]" for i, x in enumerate(part))]
    lines += ["", *(f"p[{i}] {comment_text(name)}" for i, name in enumerate(model.parameters))]
    if model.rows:
        lines += ["", *(f"row {i} {comment_text(name)}" for i, name in enumerate(model.rows))]
    numbers = ", ".join(repr(float(x)) for x in model.values({}))
    return "\n".join(
        [*lines, '"""', "", "import numpy as np", "", f"P = np.array([{numbers}])", f"ROWS = {len(model.rows)}"]
    )
