"""The stages of straight code, which is for one mechanism alone: its equations, the operations of a model and of laws.

Methods that are generated one after the other share one derivation of their mechanism.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, final

import msgspec
import numpy as np

from symgen.base.errors import refuse_overflow
from symgen.base.ir.program import SUFFIXES
from symgen.base.vocabulary.infos import LawInfo
from symgen.base.vocabulary.quantities import Quantity
from symgen.compile.store.entries import Modules
from symgen.compile.store.loaded_modules import load_module
from symgen.describe.facts.digest import digest as mechanism_digest
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.folders import folder_of
from symgen.run.compiling.method_choice import MethodChoice
from symgen.run.compiling.stages import Generated, PipelineStages
from symgen.run.layout.compiled import Array, CompiledModel, ModelInfo, RowInfo

if TYPE_CHECKING:
    from symgen.base.ir.program import EliminationPlan, LawProgram, ModelProgram
    from symgen.derive.formulate.equations import Equations

#: Functions of a model that whoever has it calls: what follows from parameters, and bodies of joint coordinates.
OF_READERS = frozenset(("prepare", "bodies"))
#: Forms of laws whose right-hand side explicit schemes evaluate: a method with none has a scheme of its own.
BY_RIGHT_SIDE = frozenset(("ode", "one-step"))
#: Functions of a model that schemes of methods call, beside those that laws do.
OF_OWN_SCHEMES = frozenset(("geometry", "measure", "spread", "turn"))

Stage = TypeVar("Stage", bound=Callable[..., Any])


@dataclass
class Derivation:
    """What the methods of a mechanism share for one target.

    Each lowering takes the graph of the equations, which grows, for itself: one method at a time has the derivation.

    Attributes
    ----------
    equations : Equations
        The derived equations.
    program : ModelProgram or None
        Their program, once they have been lowered.
    source, info : str, mapping
        Source of ``model`` and its metadata, once it has been emitted.
    closings : dict
        Plans with loops in closed form, by free velocities.
    """

    equations: Equations
    program: ModelProgram | None = None
    source: str = ""
    info: Mapping[str, Any] = field(default_factory=dict)
    closings: dict[tuple[int, ...], EliminationPlan] = field(default_factory=dict)


@dataclass(frozen=True)
class Programs:
    """The program of a model, and the laws of methods in their order."""

    derivation: Derivation
    model: ModelProgram
    laws: tuple[LawProgram, ...]


#: The last derivation, of one mechanism for one target, with the mechanism.
_latest: dict[tuple[int, str], tuple[weakref.ref[Mechanism], Derivation]] = {}


def _with_finite_numbers(stage: Stage) -> Stage:
    """Have a stage refuse numbers that overflow where equations are solved for the first time; others have names."""

    @wraps(stage)
    def checked(stages: StraightStages, *results: Any) -> Any:
        with refuse_overflow(f"mechanism '{stages.mechanism.name}'"):
            return stage(stages, *results)

    return checked  # type: ignore[return-value]  # a stage with the same parameters


@final
class StraightStages(PipelineStages[Derivation, Programs]):
    """The stages of straight code; parameters as of `symgen.run.compiling.pipeline.generate`."""

    def __init__(
        self,
        mechanism: Mechanism,
        choices: tuple[MethodChoice, ...],
        target: str = "cpu",
        whole: bool = False,
        lean: bool = False,
    ) -> None:
        super().__init__(mechanism, choices, folder_of(mechanism), whole)
        self.target, self.suffix, self.lean = target, SUFFIXES[target], lean

    @property
    def stems(self) -> tuple[str, ...]:
        """The model, and one law a method."""
        return f"model{self.suffix}", *(f"{choice.stem}{self.suffix}" for choice in self.choices)

    @_with_finite_numbers
    def formulate(self) -> Derivation:
        """Return the latest derivation, if it is of this mechanism, or a new one."""
        from symgen.derive.formulate.formulate import formulate

        reference, latest = _latest.pop((id(self.mechanism), self.target), (None, None))
        if latest is not None and reference is not None and reference() is self.mechanism:
            return latest
        _latest.clear()
        with self.deriving():
            return Derivation(formulate(self.mechanism))

    @_with_finite_numbers
    def lower(self, equations: Derivation) -> Programs:
        """Return the programs of the model and of all laws."""
        from symgen.derive.lower.law import lower_law
        from symgen.derive.lower.model import lower_model
        from symgen.derive.lower.plans import closing_plan

        shared = equations
        laws: list[LawProgram] = []
        if shared.program is None:
            with self.deriving():
                shared.program = lower_model(shared.equations, mechanism_digest(self.mechanism))
        with self.emitting():
            for choice in self.choices:
                closing = shared.closings.get(choice.free)
                if closing is None:
                    closing = closing_plan(shared.equations, shared.program.plan, choice.free)
                    shared.closings[choice.free] = closing
                arguments = choice.method, choice.options, choice.implicit, closing, choice.suffix, choice.directed
                laws.append(lower_law(shared.equations, shared.program, *arguments))
        return Programs(shared, shared.program, tuple(laws))

    @_with_finite_numbers
    def emit(self, programs: Programs) -> Modules:
        """Return the sources, and leave the derivation to the next method."""
        modules: dict[str, tuple[str, Mapping[str, Any]]] = {}
        with self.emitting():
            for choice, law in zip(self.choices, programs.laws, strict=True):
                sources = self._law(choice, law, programs)
                *shared, own = sources
                modules |= {stem: (sources[stem], {}) for stem in shared}
                law_info = msgspec.structs.replace(law.info, modules=tuple(shared))
                modules[own] = sources[own], law_info.to_dict()
            laws = "".join(source for source, _ in modules.values())
            modules = {self.stems[0]: self._model(programs, laws), **modules}
        key = id(self.mechanism), self.target
        _latest[key] = weakref.ref(self.mechanism, lambda _: _latest.pop(key, None)), programs.derivation
        return modules

    def _model(self, programs: Programs, laws: str) -> tuple[str, Mapping[str, Any]]:
        """Return source and metadata of the model: made once for all methods, unless the source is for readers."""
        from symgen.derive.emit.emit import emit_model
        from symgen.derive.emit.lane_modules import emit_lanes_model

        model, shared = programs.model, programs.derivation
        if not shared.source:
            lanes = self.target == "lanes"
            shared.source = emit_lanes_model(model) if lanes else emit_model(model, shared.equations, self.target)
            shared.info = model_info(model, shared.equations).to_dict()
        if self.whole and self.target != "lanes":  # lanes have their own places of elements
            called = self._called(laws) if self.lean else None
            return emit_model(model, shared.equations, self.target, True, called), shared.info
        return shared.source, shared.info

    def _called(self, laws: str) -> frozenset[str]:
        """Return the functions of the model that laws and the schemes of their methods call."""
        from symgen.derive.emit.whole import names_from_model

        own = any(not BY_RIGHT_SIDE & {*choice.method.forms} for choice in self.choices)
        return OF_READERS | names_from_model(laws) | (OF_OWN_SCHEMES if own else frozenset())

    def _law(self, choice: MethodChoice, law: LawProgram, programs: Programs) -> Mapping[str, str]:
        """Return the sources of a law, those that other laws share first."""
        from symgen.derive.emit.emit import emit_law
        from symgen.derive.emit.lane_modules import emit_lanes_law

        own = law, programs.model, programs.derivation.equations, choice.method.summary, choice.method.reference
        if self.target == "lanes":
            return {f"{choice.stem}{self.suffix}": emit_lanes_law(*own)}
        return emit_law(*own, self.target, self.whole)

    def compile(self, sources: Modules) -> StraightModel:
        """Return the compiled model with the one law of `choices`."""
        self.keep(sources)
        model, stem = self.stems
        return load_compiled(
            self.store.path(self.folder, stem).parent,
            stem,
            self.described[model],
            self.described[stem],
            self.derive_seconds,
            self.emit_seconds,
            model,
        )

    def collect(self, sources: Modules) -> Generated:
        """Return the sources as they are."""
        return Generated(self.folder, sources, self.derive_seconds, self.emit_seconds)


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
    from symgen.derive.lower.closed_loops import loop_pairs
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
        alone=_constant_pivots(program, len(equations.rows)),
        states=equations.states,
        switchable=tuple(i for i, row in enumerate(equations.rows) if row.held is not None),
        bounded=tuple(i for i, row in enumerate(equations.rows) if row.bounded),
        pairs=() if plan.loops else loop_pairs(loose, fixed),
        fixed=tuple((block.columns, block.rows) for block in fixed),
    )


def _constant_pivots(program: ModelProgram, rows: int) -> tuple[int, ...]:
    """Return the rows whose pivot is the same everywhere, which ``geometry`` need not report."""
    pivots = {
        target.index
        for block in program.blocks
        if block.name == "geometry"
        for target, _ in block.outputs
        if target.space == "pivot"
    }
    return tuple(i for i in range(rows) if i not in pivots)
