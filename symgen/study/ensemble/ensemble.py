"""Ensembles: many runs of one model, fully resolved, in chunks."""

from __future__ import annotations

import hashlib
import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from symgen.base.errors import plural
from symgen.base.ir.program import LANES
from symgen.describe.facts.digest import mechanism_digest
from symgen.describe.formulas.evaluate import dependent_parameters
from symgen.run.planning.plan import Plan
from symgen.study.ensemble.axes import Grid
from symgen.study.ensemble.chunks import Rows, make_rows
from symgen.study.ensemble.driving import Driving
from symgen.study.ensemble.recipe import Recipe
from symgen.study.ensemble.varied_names import METHOD, Targets

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.run.layout.compiled import CompiledModel

#: A chunk should take about so many seconds, and its arrays no more than so many bytes.
CHUNK_SECONDS, CHUNK_BYTES = 0.2, 32e6
#: The same bound where a CUDA device runs them.
CHUNK_BYTES_CUDA = 128e6
#: Seconds an operation of a right-hand side takes, and evaluations in a simulated second of an adaptive run: guesses
#: that shape nothing but the size of chunks.
_OPERATION, _EVALUATIONS = 4e-10, 1e4


@dataclass(frozen=True, repr=False)
class Ensemble:
    """Many runs of one model, fully resolved.

    Attributes
    ----------
    model : Model
        The model.
    plan : Plan
        How, resolved.
    compiled : CompiledModel
        Its law; compiled when it is first run.
    grid : Grid
        Axes of the varied quantities.
    targets : Targets
        Quantities that the starts of all runs hold.
    recipe : Recipe
        Specification of a run apart from its row.
    driving : Driving
        Inputs of the runs.
    warnings : tuple of str
        Warnings that concern all runs.
    notes : tuple of str
        Automatic choices with their reasons.
    """

    model: Model
    plan: Plan
    compiled: CompiledModel
    grid: Grid
    targets: Targets
    recipe: Recipe
    driving: Driving
    warnings: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return f"<Ensemble of {self.model.name}: {plural(len(self), 'run')} with {self.plan.choice.method.name}>"

    def __len__(self) -> int:
        return len(self.grid)

    @property
    def target(self) -> str:
        """Name of the target: ``cpu``, ``lanes`` or ``cuda``."""
        return self.recipe.target

    @property
    def events(self) -> tuple[str, ...]:
        """Names of the events that are looked for."""
        return () if self.recipe.watch is None else tuple(x.name for x in self.recipe.watch.events)

    @property
    def sizes(self) -> tuple[int, int, int, int, int]:
        """Runs, quantities, output times, runs in a chunk, and numbers that each run leaves of events."""
        recipe = self.recipe
        return len(self), len(recipe.kept), len(recipe.kept_times), self.chunk, recipe.further

    @cached_property
    def parameters(self) -> dict[str, float]:
        """Values of all parameters, before any varies."""
        return self.model.parameters(self.plan.settings.parameters)

    @cached_property
    def chunk(self) -> int:
        """Runs in a chunk; it depends on nothing but the ensemble, so that another process can continue it."""
        spec, info, law = self.recipe.spec, self.compiled.info, self.compiled.law
        stages = self.plan.integrator.stages
        evaluations = spec.until * _EVALUATIONS
        if not spec.adaptive and spec.step is not None:
            evaluations = stages * spec.until / spec.step
        seconds = 2e-5 + _OPERATION * evaluations * sum(law.operations.get(name, 0) for name in ("rhs", "accept"))
        numbers = law.nw + 4 * info.ny + 100 + len(self.recipe.columns) * len(spec.times)
        if self.target == "cuda":  # a device wants tens of thousands of runs at once, whatever they take
            return int(max(1.0, min(131072.0, CHUNK_BYTES_CUDA / (8 * numbers))))
        most = min(CHUNK_SECONDS / seconds, CHUNK_BYTES / (8 * numbers), len(self) / 16)
        size = int(max(1.0, min(65536.0, math.ceil(most))))
        return size if self.target == "cpu" else LANES * math.ceil(size / LANES)

    def rows(self, first: int, last: int) -> Rows:
        """Return the values that distinguish the runs from `first` to `last` (exclusive)."""
        return self.driving.put_seams(self.rows_without_seams(first, last), tuple(self.parameters))

    def rows_without_seams(self, first: int, last: int) -> Rows:
        """Return the same without the seams of runs."""
        varied, targets, settled = self.grid.values(first, last), self.targets, self.plan.settings.parameters
        held = targets.names, targets.velocities, settled, targets.constant
        rows = make_rows(self.model.mechanism, self.parameters, varied, *held)
        options = {name.removeprefix(METHOD): x for name, x in varied.items() if name.startswith(METHOD)}
        return replace(rows, method=options) if options else rows

    @cached_property
    def description(self) -> dict[str, Any]:
        """Description of the computation: two ensembles with the same description give the same rows."""
        varied = hashlib.sha256()
        for axis in self.grid.axes:
            for name, values in axis.values.items():
                varied.update(f"{axis.dimension}\0{name}\0".encode() + values.tobytes())
        formulas = {name for name, _ in dependent_parameters(self.model.mechanism.parameters)}
        settled = sorted(formulas & set(self.plan.settings.parameters))  # these have numbers in place of their formulas
        return {
            **({"settled": settled} if settled else {}),
            "mechanism": mechanism_digest(self.model.mechanism),
            "varied": varied.hexdigest(),
            "parameters": self.parameters,
            "start": {name: repr(value) for name, value in self.targets.constant.items()},
            **({"inputs": driven} if (driven := self.driving.described) else {}),
            "recipe": self.recipe.digest,
            "code": self.recipe.code,
            "runs": len(self),
            "chunk": self.chunk,
        }
