"""A compiled model: the emitted functions with what the runtime has to know about them, readable without SymPy."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import ModuleType
from typing import TYPE_CHECKING, Any, ClassVar

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.ir.numerics import SKIP
from symgen.ir.program import SCALES, STATUS
from symgen.vocabulary.infos import Info, LawInfo
from symgen.vocabulary.quantities import Counted, Quantity

if TYPE_CHECKING:
    from symgen.runtime.start_records import Layout

Array = NDArray[np.float64]


class RowInfo(msgspec.Struct, frozen=True):
    """A constraint row."""

    name: str
    joint: str
    unit: str
    holonomic: bool


class ModelInfo(Counted, Info, frozen=True, omit_defaults=True):
    """Metadata of an emitted ``model`` module.

    `sections` maps each section of the scratch array ``w`` to (offset, size); `jacobian` lists (row, column, constant
    or None, slot or None) of D's structural entries; `windings` counts the angles whose turns are counted; `spins` says
    for each body with Euler parameters where these begin in q and its angular velocity in v; `inputs` are those
    parameters that may change during a run; `states` are those of the file's own, behind the work, and `integrals`
    counts auxiliary states behind these; `alone` are rows that are eliminated before all that have to do with them:
    they are never left out, so nothing reads their mask.
    """

    name: str
    digest: str
    parameters: tuple[Quantity, ...]
    coordinates: tuple[Quantity, ...]
    velocities: tuple[Quantity, ...]
    rows: tuple[RowInfo, ...]
    joint_coordinates: tuple[Quantity, ...]
    sections: dict[str, tuple[int, int]]
    jacobian: tuple[tuple[int, int, float | None, int | None], ...]
    hoisted: int
    dropped_rows: tuple[str, ...]
    massless: tuple[int, ...]
    windings: int
    spins: tuple[tuple[int, int], ...]
    operations: dict[str, int]
    inputs: tuple[str, ...] = ()
    integrals: int = 0
    alone: tuple[int, ...] = ()
    states: tuple[Quantity, ...] = ()

    def __repr__(self) -> str:
        return f"<ModelInfo of {self.name}: {self.nq} coordinates, {self.nv} velocities, {self.m} rows>"

    @property
    def work(self) -> int:
        """Index of the work in the state."""
        return self.nq + self.nv

    @property
    def own_states(self) -> slice:
        """Where the states of the file's own stand in the state."""
        return slice(self.work + 1, self.work + 1 + len(self.states))

    @property
    def ny(self) -> int:
        """Length of the state: q, v, the work, states of the file's own and integrals."""
        return self.work + 1 + len(self.states) + self.integrals

    @property
    def observed(self) -> int:
        """How many numbers ``observe`` writes: the rows of D v' - gamma, value and rate of each joint coordinate."""
        return self.m + 2 * len(self.joint_coordinates)

    def parts(self, y: Array) -> tuple[Array, Array]:
        """Return views of q and v of a state, or of one state a row."""
        return y[..., : self.nq], y[..., self.nq : self.work]


@dataclass(frozen=True, repr=False)
class CompiledModel(ABC):
    """Emitted functions of one model and one method, ready for the loops, in one of the shapes of code.

    Nothing is compiled by loading: each function is compiled, or read from the cache, when a loop first takes it.

    Class attributes
    ----------------
    shape : {"straight", "looped"}
        Of the code.
    sparse : bool
        Whether starts of large mechanisms may rely on ``spread`` instead of dense algebra.
    """

    shape: ClassVar[str]
    sparse: ClassVar[bool]

    info: ModelInfo
    law: LawInfo
    model: ModuleType
    law_module: ModuleType
    derive_seconds: float = 0.0
    emit_seconds: float = 0.0
    #: What it is made again from in another process: a function and its arguments. Code itself does not travel.
    origin: tuple[Callable[..., CompiledModel], tuple[Any, ...]] | None = field(default=None, repr=False, compare=False)

    def __reduce__(self) -> tuple[Callable[..., CompiledModel], tuple[Any, ...]]:
        if self.origin is None:
            raise TypeError("a compiled model that was loaded from files cannot be pickled; compile it from its model")
        return self.origin

    def __deepcopy__(self, memo: dict[int, Any]) -> CompiledModel:
        return self  # nothing of it ever changes

    def __repr__(self) -> str:
        info = self.info
        sizes = f"{info.nq} coordinates, {info.nv} velocities, {info.m} rows"
        return f"<CompiledModel {info.name}, {self.law.key}, {self.shape}: {sizes}>"

    @abstractmethod
    def scratch(self) -> Array:
        """Return a new scratch array ``w``; scales are 1 until a start finds them."""

    def parameter_array(self, parameters: Mapping[str, float], method_parameters: Mapping[str, float]) -> Array:
        """Return ``p``: model parameters, method parameters, and room for what ``prepare`` computes."""
        law = self.law
        p = np.zeros(max(1, law.parameter_offset + len(law.parameters) + law.hoisted))
        for i, q in enumerate(self.info.parameters):
            p[i] = parameters[q.name]
        for i, (name, default) in enumerate(law.parameters):
            p[law.parameter_offset + i] = method_parameters.get(name, default)
        return p

    def prepare(self, p: Array) -> None:
        """Fill the numbers behind the parameters in ``p``."""
        # Numba stands behind these, which emitting code does without
        from symgen.runtime import ensemble_abi as e
        from symgen.runtime.probe import Ready

        for module in (self.model, self.law_module):
            Ready(module.prepare, e.PREPARE)(p)

    def with_scales(self, w: Array) -> Array:
        """Return a scratch array whose scales, and pivots of rows that never change theirs, are set to 1."""
        for name in ("pivot", "gauge", "row_weight"):
            self.section(w, name)[:] = 1.0
        w[[STATUS.index(name) for name in SCALES]] = 1.0
        return w

    def section(self, w: Array, name: str) -> Array:
        """Return a view of one section of ``w``."""
        offset, size = self.info.sections[name]
        return w[offset : offset + size]

    def rank(self, w: Array) -> int:
        """Return the rank of D at the position of `w`: its pivots that are no rounding."""
        return int(np.sum(self.section(w, "pivot") >= SKIP))

    def redundant(self, w: Array) -> tuple[str, ...]:
        """Return the names of the rows that are left out in `w`, as they depend on others."""
        return tuple(self.info.rows[i].name for i in np.flatnonzero(self.section(w, "mask")))

    @cached_property
    def layout(self) -> Layout:
        """What a start has to know of the model, as `symgen.runtime.assembler.layout_of` returns it."""
        from symgen.runtime.assembler import layout_of

        return layout_of(self)

    def jacobian(self, w: Array) -> Array:
        """Return D as a dense matrix from what ``geometry`` left in ``w``; shape (m, nv)."""
        values = self.section(w, "jacobian")
        d = np.zeros((self.info.m, self.info.nv))
        for row, column, constant, slot in self.info.jacobian:
            d[row, column] = constant if slot is None else values[slot]
        return d
