"""Data that all runs of an ensemble share: everything that shapes them apart from their rows.

A recipe travels: emitted modules go as source; the receiver puts them into its cache and compiles them once.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.ir.numerics import WARN
from symgen.base.plugins import plugin_digests
from symgen.base.version import __version__
from symgen.compile.store.identity import combined_digest
from symgen.compile.store.sources import package_digest
from symgen.describe.facts.digest import mechanism_digest
from symgen.describe.facts.sides import SidedJoint
from symgen.describe.mechanism import Event, Mechanism
from symgen.describe.parts.event_sections import events_in_words
from symgen.result.signals import Signal
from symgen.run.compiling.straight import load_compiled
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.compiled import CompiledModel
from symgen.run.layout.ensemble_abi import SIDE
from symgen.run.loops.run_spec import RunSpec
from symgen.run.starts.held import Held
from symgen.study.ensemble.judged_parts import WIDTH, JudgedParts
from symgen.study.ensemble.measured_quantities import Measures, store_modules
from symgen.study.ensemble.time_statistics import OverTime

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


@dataclass(frozen=True)
class Module:
    """An emitted law with its model, as source and metadata, under the stems that they have in the cache.

    Attributes
    ----------
    parts : mapping
        Source and metadata of the modules that hold the law's functions, beside its own.
    stored : mapping
        Metadata of the model as caches have it: without integrals that the law adds to the state.
    """

    folder: str
    stem: str
    model: tuple[str, Mapping[str, Any]]
    law: tuple[str, Mapping[str, Any]]
    parts: Mapping[str, tuple[str, Mapping[str, Any]]]
    stored: Mapping[str, Any]
    shared: str = "model"

    @property
    def described(self) -> list[Any]:
        """Description of the computation, as JSON can express it."""
        return [self.folder, self.stem, self.model[0], self.law[0], dict(self.parts)]

    @classmethod
    def of_compiled(cls, compiled: CompiledModel) -> Module:
        """Return the modules of a compiled model."""
        from symgen.compile.store.entries import Entries

        law, model = Path(str(compiled.law_module.__file__)), Path(str(compiled.model.__file__))
        entries, folder = Entries(), law.parent.name
        info = compiled.info.to_dict()
        return cls(
            folder=folder,
            stem=law.stem,
            model=(model.read_text(encoding="utf-8"), info),
            law=(law.read_text(encoding="utf-8"), compiled.law.to_dict()),
            parts={
                stem: (law.with_name(f"{stem}.py").read_text(encoding="utf-8"), entries.get(folder, stem) or {})
                for stem in compiled.law.modules
            },
            stored=(entries.get(folder, model.stem) or info) if compiled.info.integrals else info,
            shared=model.stem,
        )

    def load(self) -> CompiledModel:
        """Return the compiled model, its modules put into the cache of this machine where that has others or none."""
        folder = store_modules(
            self.folder, {**self.parts, self.shared: (self.model[0], self.stored), self.stem: self.law}
        )
        return load_compiled(folder, self.stem, self.model[1], self.law[1], shared=self.shared)


@dataclass(frozen=True)
class Code:
    """Emitted code of the runs, for one solver of their law.

    Attributes
    ----------
    module : Module
        Code that closes starts, and that runs where there is no other.
    other : Module or None
        The same law for the target of the recipe, where that is not ``cpu``.
    tree : Module or None
        Code of runs in joint coordinates.
    measures : Measures or None
        Code for quantities that no loop computes; None where none is selected.
    """

    module: Module
    other: Module | None = None
    tree: Module | None = None
    measures: Measures | None = None

    @property
    def described(self) -> list[Any]:
        """Description of the computation, as JSON can express it."""
        return [x if x is None else x.described for x in (self.module, self.other, self.tree, self.measures)]


@dataclass(frozen=True)
class EventPlan:
    """Events and switches of the rows.

    Attributes
    ----------
    mechanism : Mechanism
        The mechanism, with the values of inputs in their place.
    events : tuple of Event
        Events to look for.
    ends : bool
        Whether the only output is the end of a run, wherever an event puts it.
    """

    mechanism: Mechanism
    events: tuple[Event, ...] = ()
    ends: bool = False

    @property
    def width(self) -> int:
        """Numbers that each run leaves beside the numbers of every ensemble."""
        has_ends = bool(self.events) or bool(self.mechanism.bounded)
        return e.HEAD_OF_EVENTS + e.OF_EVENT * len(self.events) if has_ends else 0

    @property
    def described(self) -> list[Any]:
        """Description of the value, as JSON can express it."""
        return [mechanism_digest(self.mechanism), events_in_words(self.events), self.ends]


@dataclass(frozen=True)
class Recipe:
    """Everything that shapes runs apart from their rows.

    Attributes
    ----------
    first : Code
        Code of the runs.
    spare : Code or None
        The law with another solver, for runs whose bodies are too light for the first; None where the solver is set.
    integrator : str
        Name of the scheme.
    spec : RunSpec
        Steps, tolerances, limits and output times.
    method_parameters : mapping
        Values of the method's parameters that differ from the defaults.
    quantities : tuple of Signal
        Selected quantities, as loops leave them.
    tree : Mechanism or None
        The mechanism with its tree, where runs are in joint coordinates.
    watch : EventPlan or None
        Events and switches of the rows.
    sides : tuple of SidedJoint
        Joints that may hold bodies the wrong way round.
    seams : bool
        Whether runs have seams at times that rows bring along.
    held : Held
        Quantities that rows hold, each row at its own values.
    strict : bool
        Whether a start that has to be changed is refused.
    code : str
        From `run_code_identity`: what computes it.
    target : {"cpu", "lanes", "cuda"}
        Target of the code.
    plugins : tuple of str
        Files that workers load before.
    datum : tuple of float
        What coordinates are measured from, with parameters as described:
        `symgen.describe.facts.lengths.origin_of_sizes`.
    over : OverTime or None
        What is taken of the quantities over the time of each run; None where their histories are kept.
    weighed : Mechanism or None
        The mechanism where its M is not diagonal, which starts may need.
    judged : JudgedParts or None
        Parts that bend, whose columns are the last quantities; None where there are none, or nothing judges them.
    """

    first: Code
    spare: Code | None
    integrator: str
    spec: RunSpec
    method_parameters: Mapping[str, float]
    quantities: tuple[Signal, ...]
    held: Held
    strict: bool
    code: str
    target: str = "cpu"
    tree: Mechanism | None = None
    watch: EventPlan | None = None
    sides: tuple[SidedJoint, ...] = ()
    seams: bool = False
    plugins: tuple[str, ...] = ()
    datum: tuple[float, ...] = ()
    over: OverTime | None = None
    weighed: Mechanism | None = None
    judged: JudgedParts | None = None

    @property
    def shown(self) -> tuple[Signal, ...]:
        """The selected quantities."""
        return self.quantities[: len(self.quantities) - (0 if self.judged is None else len(self.judged.columns))]

    @property
    def kept(self) -> tuple[Signal, ...]:
        """What each run leaves: the quantities, or numbers of them over time."""
        return self.shown if self.over is None else self.over.quantities

    @property
    def kept_times(self) -> Array:
        """Times of what each run leaves: all output times, or the last one [s]."""
        return self.times if self.over is None else self.times[-1:]

    @property
    def times(self) -> Array:
        """Output times [s]."""
        return np.ascontiguousarray(self.spec.times)

    @property
    def limits(self) -> Array:
        """Limits by which runs are judged: see `symgen.run.layout.records.RowChunk`."""
        return np.array([self.spec.max_violation, self.spec.velocity_limit, self.spec.max_energy_error, WARN])

    @property
    def picks(self) -> Integers:
        """(source, column) of each of `columns`, flat."""
        return np.array([(q.source, q.column) for q in self.columns], dtype=np.int64).ravel()

    @property
    def measures(self) -> Measures | None:
        """Code for quantities that no loop computes, in first runs."""
        return self.first.measures

    @property
    def of_events(self) -> int:
        """Numbers that each run leaves of events."""
        return 0 if self.watch is None else self.watch.width

    @property
    def further(self) -> int:
        """Numbers that each run leaves beside the numbers of every ensemble: of events, then of parts that bend."""
        return self.of_events + (0 if self.judged is None else WIDTH)

    @property
    def columns(self) -> tuple[Signal, ...]:
        """Columns that loops write: quantities that loops have, and inputs of the others."""
        if self.measures is None:
            return self.quantities
        return (*(q for q in self.quantities if q.source < SIDE), *self.measures.reads)

    @property
    def behind(self) -> tuple[Signal, ...]:
        """The quantities that are evaluated after the loops."""
        return tuple(q for q in self.quantities if q.source >= SIDE)

    def in_order(self, columns: Array, behind: Array) -> Array:
        """Return the quantities in their order, from what loops left and what was evaluated after them."""
        if self.measures is None:
            return columns
        left, late = iter(range(columns.shape[1])), iter(range(behind.shape[1]))
        quantities = [behind[:, next(late)] if q.source >= SIDE else columns[:, next(left)] for q in self.quantities]
        return np.stack(quantities, axis=1)

    @property
    def sources(self) -> set[int]:
        """Sources of the columns."""
        return {q.source for q in self.columns}

    @cached_property
    def digest(self) -> str:
        """Digest of all this, the same in every process."""
        spec = {f.name: getattr(self.spec, f.name) for f in fields(self.spec) if f.name not in ("times", "in_place")}
        text = json.dumps(
            [
                *(self.integrator, {**spec, "integrator_parameters": dict(self.spec.integrator_parameters)}),
                *(dict(self.method_parameters), [q.name for q in self.kept], asdict(self.held)),
                *(self.strict, self.code, *([self.sides] if self.sides else [])),
                *(["seams"] if self.seams else []),
                *(x if x is None else x.described for x in (self.first, self.spare, self.watch)),
                None if self.tree is None else mechanism_digest(self.tree),
                *([] if self.weighed is None else [mechanism_digest(self.weighed)]),
                *([] if self.judged is None else [mechanism_digest(self.judged.mechanism)]),
            ],
            sort_keys=True,
        )
        return hashlib.sha256(text.encode() + self.spec.times.tobytes()).hexdigest()


def run_code_identity() -> str:
    """Return a digest of all that computes runs: the version, the whole package and plugins."""
    return combined_digest(__version__, package_digest(), *plugin_digests())
