"""The pipeline, one line a stage.

    mechanism --formulate--> equations --lower--> program --emit--> source --load--> compiled model

`generate` returns the requested source; `compile_model` puts it into the cache, or finds it there, and
loads it. SymPy and Jinja2 are imported only when something has to be generated, and modules of looped
code only where that is requested.
"""

from __future__ import annotations

import time
import weakref
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, final

import msgspec
import numpy as np

from symgen.base.errors import InputError, finite_numbers
from symgen.base.ir.program import FORMAT, SUFFIXES
from symgen.base.vocabulary.infos import LawInfo
from symgen.base.vocabulary.quantities import Quantity
from symgen.compile.store.entries import Entries, Modules, folder_name
from symgen.compile.store.identity import combined_digest
from symgen.compile.store.modules import load_module
from symgen.compile.store.sources import CODE, reached_digest
from symgen.describe.facts.digest import digest as mechanism_digest
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.method_choice import MethodChoice, choose_method, for_coordinates
from symgen.run.layout.compiled import Array, CompiledModel, ModelInfo, RowInfo

if TYPE_CHECKING:
    from symgen.base.ir.program import ModelProgram
    from symgen.derive.formulate.equations import Equations


@dataclass(frozen=True)
class Generated:
    """Emitted source with its metadata, by file stem: ``model``, one module a law, and the modules that laws share."""

    folder: str
    modules: Modules
    derive_seconds: float
    emit_seconds: float


def folder_of(mechanism: Mechanism) -> str:
    """Return the name of the folder that holds everything emitted for `mechanism`; needs no SymPy."""
    text = f"{mechanism_digest(mechanism)} {generator_digest()}"
    return folder_name(mechanism.name, combined_digest(text), FORMAT)


@lru_cache(maxsize=1)
def generator_digest() -> str:
    """Return the digest of everything that shapes emitted code: sources, templates and SymPy's version."""
    return combined_digest(_sympy_version(), reached_digest(*CODE))


def _sympy_version() -> str:
    """Return SymPy's version without the import of SymPy, which costs more than a whole warm run."""
    spec = find_spec("sympy")
    if spec is None or spec.origin is None:
        return "absent"
    return (Path(spec.origin).parent / "release.py").read_text(encoding="utf-8").split('"')[1]


def refuse_loops(mechanism: Mechanism) -> None:
    """Refuse looped code for files that need straight code.

    Raises
    ------
    InputError
        If rows of joints may be off.
    """
    if what := straight_alone(mechanism):
        raise InputError("shape", f"straight code where a file has {what}", "looped")


def straight_alone(mechanism: Mechanism) -> str:
    """Return what of a file exists as straight code alone; empty where loops take all of it."""
    return "rows that may be off" if mechanism.switchable else ""


def generate(
    mechanism: Mechanism,
    choices: tuple[MethodChoice, ...],
    shape: str = "straight",
    target: str = "cpu",
    whole: bool = False,
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
    choices = tuple(for_coordinates(mechanism, choice) for choice in choices)
    if target != "cpu":
        _refuse_target(target, choices, shape)
    if shape == "looped":
        refuse_loops(mechanism)
        from symgen.run.compiling.looped import generate_looped, shared_folder

        began = time.perf_counter()
        modules = generate_looped(mechanism, choices, generator_digest(), whole)
        return Generated(shared_folder(generator_digest()), modules, 0.0, time.perf_counter() - began)
    # for numbers that meet only where equations are solved; others have names
    with finite_numbers(f"mechanism '{mechanism.name}'"):
        return _generate_straight(mechanism, choices, target, whole)


def _generate_straight(mechanism: Mechanism, choices: tuple[MethodChoice, ...], target: str, whole: bool) -> Generated:
    from symgen.derive.emit.emit import emit_law, emit_model
    from symgen.derive.emit.lanes import emit_lanes_law
    from symgen.derive.lower.law import lower_law
    from symgen.derive.lower.plans import closing_plan

    began = time.perf_counter()
    folder, key = folder_of(mechanism), (id(mechanism), target)
    # methods are often generated one after the other; each lowering takes the graph, which grows, for itself
    reference, before = _latest.pop(key, (None, None))
    if before is None or reference is None or reference() is not mechanism:
        _latest.clear()
        before = _without_method(mechanism, target)
    derived = time.perf_counter()
    equations, program, source, info, closings = before
    modules: dict[str, tuple[str, Mapping[str, Any]]] = {}
    suffix = SUFFIXES[target]
    named = whole and target != "lanes"  # lanes have their own places of elements
    modules[f"model{suffix}"] = emit_model(program, equations, target, whole) if named else source, info
    for choice in choices:
        closing = closings.get(choice.free)
        if closing is None:
            closing = closings[choice.free] = closing_plan(equations, program.plan, choice.free)
        arguments = choice.method, choice.options, choice.implicit, closing, choice.suffix, choice.directed
        law = lower_law(equations, program, *arguments)
        words = (choice.method.summary, choice.method.reference)
        if target == "lanes":
            sources = {f"{choice.stem}{suffix}": emit_lanes_law(law, program, equations, *words)}
        else:
            sources = emit_law(law, program, equations, *words, target, whole)
        *shared, own = sources
        modules |= {stem: (sources[stem], {}) for stem in shared}
        law_info = msgspec.structs.replace(law.info, modules=tuple(shared))
        modules[own] = sources[own], law_info.to_dict()
    _latest[key] = weakref.ref(mechanism, lambda _: _latest.pop(key, None)), before
    return Generated(folder, modules, derived - began, time.perf_counter() - derived)


#: Result of `_without_method`.
Shared = tuple[Any, Any, str, Mapping[str, Any], dict[tuple[int, ...], Any]]
#: The last derivation, of one mechanism for one target: the mechanism, and the result of `_without_method`.
_latest: dict[tuple[int, str], tuple[weakref.ref[Mechanism], Shared]] = {}


def _without_method(mechanism: Mechanism, target: str) -> Shared:
    """Return equations, program, source and metadata of the model, and plans by free velocities; methods share them."""
    from symgen.derive.emit.emit import emit_model
    from symgen.derive.emit.lanes import emit_lanes_model
    from symgen.derive.formulate.formulate import formulate
    from symgen.derive.lower.model import lower_model

    equations = formulate(mechanism)
    program = lower_model(equations, mechanism_digest(mechanism))
    source = emit_lanes_model(program) if target == "lanes" else emit_model(program, equations, target)
    return equations, program, source, model_info(program, equations).to_dict(), {}


def _refuse_target(target: str, choices: tuple[MethodChoice, ...], shape: str) -> None:
    if shape == "looped":
        raise InputError(f"target '{target}'", "the straight shape", "looped")
    for choice in choices:
        if choice.implicit:
            expected = f"a method that explicit integrators solve (target {target})"
            raise InputError(f"method '{choice.method.name}'", expected, "one for implicit ones")


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
    store, choice = Entries(), for_coordinates(mechanism, choice)
    options = dict(choice.options)
    arguments = mechanism, choice.method.name, options, choice.implicit, choice.shape, target, choice.directed
    if choice.shape == "looped" and target == "cpu":
        from symgen.run.compiling.looped import compile_looped

        return replace(compile_looped(mechanism, choice, generator_digest()), origin=(compile_again, arguments))
    from symgen.run.compiling.closing import at_start

    choice = at_start(mechanism, choice)
    folder, took = folder_of(mechanism), [0.0, 0.0]
    model, stem = f"model{SUFFIXES[target]}", f"{choice.stem}{SUFFIXES[target]}"

    def make(exists: Callable[[str], bool]) -> Modules:
        generated = generate(mechanism, (choice,), choice.shape, target)
        took[:] = generated.derive_seconds, generated.emit_seconds
        return generated.modules

    metadata = store.descriptions(folder, (model, stem), make)
    path = store.path(folder, stem).parent
    loaded = load_compiled(path, stem, metadata[model], metadata[stem], took[0], took[1], model)
    return replace(loaded, origin=(compile_again, arguments))


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


@final
@dataclass(frozen=True, repr=False)
class StraightModel(CompiledModel):
    """A compiled model in the straight shape: code for one mechanism alone."""

    shape, sparse = "straight", False

    def scratch(self) -> Array:
        """Return a new scratch array ``w``; scales are 1 until a start sets them."""
        return self.with_scales(np.zeros(max(1, self.law.nw)))


def load_compiled(
    folder: Path,
    stem: str,
    model: Mapping[str, Any],
    law: Mapping[str, Any],
    derive_seconds: float = 0.0,
    emit_seconds: float = 0.0,
    shared: str = "model",
) -> StraightModel:
    """Load the emitted modules of a folder.

    Parameters
    ----------
    folder : Path
        Holds ``<shared>.py`` and ``<stem>.py``.
    stem : str
        File stem of the law.
    model, law : mapping
        Their metadata.
    derive_seconds, emit_seconds : float
        Time of their generation, 0 if they were cached.
    shared : str
        File stem of the module that all laws share.
    """
    return StraightModel(
        info=msgspec.convert(model, ModelInfo),
        law=msgspec.convert(law, LawInfo),
        model=load_module(folder / f"{shared}.py"),
        law_module=load_module(folder / f"{stem}.py"),
        derive_seconds=derive_seconds,
        emit_seconds=emit_seconds,
    )


def model_info(program: ModelProgram, equations: Equations) -> ModelInfo:
    """Return the metadata of a program."""
    from symgen.derive.formulate.equations import without_bounded_rows
    from symgen.derive.lower.closing import loop_pairs
    from symgen.derive.lower.plans import cheapest_plan

    plan = program.plan
    slip = any(row.bounded for row in equations.rows)
    loose = without_bounded_rows(equations) if slip else equations
    fixed = cheapest_plan(loose, closing=False).fixed if slip else plan.fixed
    return ModelInfo(
        name=program.name,
        digest=program.digest,
        parameters=equations.parameters,
        coordinates=equations.coordinates,
        velocities=equations.velocities,
        rows=tuple(RowInfo(r.name, r.joint, r.unit, r.phi is not None) for r in equations.rows),
        joint_coordinates=tuple(Quantity(c.name, c.unit) for c in equations.joint_coordinates),
        sections=dict(program.layout.sections),
        jacobian=tuple((e.row, e.column, e.constant, e.slot) for e in program.jacobian),
        hoisted=program.hoisted,
        dropped_rows=equations.dropped_rows,
        massless=tuple(
            j for b in equations.mass for i, j in enumerate(b.columns) if equations.graph.value(b.entries[i][i]) == 0.0
        ),
        windings=len(equations.windings),
        spins=equations.spins,
        operations={b.name: b.operations for b in program.blocks},
        inputs=equations.inputs,
        alone=_alone(program, len(equations.rows)),
        states=equations.states,
        switchable=tuple(i for i, row in enumerate(equations.rows) if row.held is not None),
        bounded=tuple(i for i, row in enumerate(equations.rows) if row.bounded),
        pairs=() if plan.loops else loop_pairs(loose, fixed),
        fixed=tuple((block.columns, block.rows) for block in fixed),
    )


def _alone(program: ModelProgram, rows: int) -> tuple[int, ...]:
    """Return the rows whose pivot is the same everywhere, which ``geometry`` need not report."""
    pivots = {
        target.index
        for block in program.blocks
        if block.name == "geometry"
        for target, _ in block.outputs
        if target.space == "pivot"
    }
    return tuple(i for i in range(rows) if i not in pivots)
