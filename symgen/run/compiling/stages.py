"""The interface of the pipeline: four stages, which each shape of code has, and the place of their source in the cache.

A stage returns what the next one takes. Stages import SymPy and Jinja2 inside, so that a process whose code is in the
cache imports neither.
"""

from __future__ import annotations

import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import wraps
from typing import Any, Generic, TypeVar

from symgen.compile.store.entries import Described, Entries, Modules
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.method_choice import MethodChoice
from symgen.run.layout.compiled import CompiledModel

Equations = TypeVar("Equations")
Programs = TypeVar("Programs")


@dataclass(frozen=True)
class Generated:
    """Emitted source with its metadata, by file stem: ``model``, one module a law, and the modules that laws share."""

    folder: str
    modules: Modules
    derive_seconds: float
    emit_seconds: float


class PipelineStages(ABC, Generic[Equations, Programs]):
    """The four stages from a mechanism to a compiled model, in one shape of code.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    choices : tuple of MethodChoice
        Methods whose laws are emitted; a compiled model has one.
    folder : str
        Name of the folder in the cache.
    whole : bool
        Whether each law is one readable module, and not modules that laws share, as in the cache.

    Attributes
    ----------
    store : Entries
        The cache.
    described : dict
        Descriptions of those modules that exist, by file stem; they are not emitted again.
    derive_seconds, emit_seconds : float
        Time that was spent so far [s].
    """

    def __init__(self, mechanism: Mechanism, choices: tuple[MethodChoice, ...], folder: str, whole: bool) -> None:
        self.mechanism, self.choices, self.folder, self.whole = mechanism, choices, folder, whole
        self.store, self.described = Entries(), Described()
        self.derive_seconds = self.emit_seconds = 0.0

    @property
    @abstractmethod
    def stems(self) -> tuple[str, ...]:
        """Modules that a compiled model needs, by file stem."""

    @abstractmethod
    def formulate(self) -> Equations:
        """Return the equations of motion."""

    @abstractmethod
    def lower(self, equations: Equations) -> Programs:
        """Return the operations of the equations and of each method, in order."""

    @abstractmethod
    def emit(self, programs: Programs) -> Modules:
        """Return the source of those modules that do not exist, with metadata, by file stem."""

    @abstractmethod
    def compile(self, sources: Modules) -> CompiledModel:
        """Put sources into the cache, and return the compiled model of the modules there."""

    @abstractmethod
    def collect(self, sources: Modules) -> Generated:
        """Return sources with what a reader of the folder needs besides them, and the time that they took."""

    def keep(self, sources: Modules) -> None:
        """Put sources into the cache."""
        for stem, (source, metadata) in sources.items():
            self.store.put(self.folder, stem, source, metadata)
            self.described[stem] = dict(metadata)

    @contextmanager
    def deriving(self) -> Iterator[None]:
        """Count the time of what all methods share, which is derived once."""
        began = time.perf_counter()
        yield
        self.derive_seconds += time.perf_counter() - began

    @contextmanager
    def emitting(self) -> Iterator[None]:
        """Count the time of what a method needs for itself, and of all source."""
        began = time.perf_counter()
        yield
        self.emit_seconds += time.perf_counter() - began


def unless_stored(
    pipeline: Callable[[PipelineStages[Any, Any]], CompiledModel],
) -> Callable[[PipelineStages[Any, Any]], CompiledModel]:
    """Have the cache answer where it has the source; otherwise other processes wait until this one has made it."""

    @wraps(pipeline)
    def through_cache(stages: PipelineStages[Any, Any]) -> CompiledModel:
        with stages.store.completing(stages.folder, stages.stems) as described:
            stages.described = described
            return stages.compile({}) if len(described) == len(stages.stems) else pipeline(stages)

    return through_cache
