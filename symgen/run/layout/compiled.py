"""A compiled model: the emitted functions and their metadata for the runtime, readable without SymPy."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import ModuleType
from typing import TYPE_CHECKING, Any, ClassVar

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import sizes_in_words
from symgen.base.ir.numerics import SKIP
from symgen.base.ir.program import BY_PIVOTS, MODE_NUMBERS, SCALES, STATUS
from symgen.base.vocabulary.infos import Info, LawInfo
from symgen.base.vocabulary.quantities import Counted, Quantity

if TYPE_CHECKING:
    pass

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
    or None, slot or None) of D's structural entries; `windings` is the number of angles with counted turns; `spins`
    holds, for each body with Euler parameters, the index of these in q and of its angular velocity in v; `inputs` are
    parameters that may change during a run; `states` are states of the file's own, after the work, and `integrals` is
    the number of auxiliary states after these; `alone` are rows eliminated before all rows coupled to them: they are
    never left out, so nothing reads their mask; `switchable` are rows that may be off,
    and `bounded` those of them with forces within bounds, which are off at a start; `pairs` are the rows of joints that
    may close loops, with their velocities after those that are `fixed`, by columns and rows;
    `shadows` is the number of elements after the state without error control, directions
    (`symgen.run.directions.directed_model`).
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
    switchable: tuple[int, ...] = ()
    shadows: int = 0
    bounded: tuple[int, ...] = ()
    pairs: tuple[tuple[tuple[int, int], tuple[int, ...]], ...] = ()
    fixed: tuple[tuple[tuple[int, ...], tuple[int, ...]], ...] = ()

    def __repr__(self) -> str:
        return f"<ModelInfo of {self.name}: {sizes_in_words(self)}>"

    @property
    def work(self) -> int:
        """Index of the work in the state."""
        return self.nq + self.nv

    @property
    def own_states(self) -> slice:
        """Slice of the file's own states in the state."""
        return slice(self.work + 1, self.work + 1 + len(self.states))

    @property
    def ny(self) -> int:
        """Length of the state: q, v, the work, states of the file's own, integrals and directions."""
        return self.work + 1 + len(self.states) + self.integrals + self.shadows

    @property
    def kept(self) -> int:
        """Count of the numbers after the status that are kept with every output: turns of angles, modes of rows."""
        return self.windings + MODE_NUMBERS * len(self.switchable)

    @property
    def observed(self) -> int:
        """Length of the output of ``observe``: the rows of D v' - gamma, value and rate of each joint coordinate."""
        return self.m + 2 * len(self.joint_coordinates)

    def parts(self, y: Array) -> tuple[Array, Array]:
        """Return views of q and v of a state, or of states in rows."""
        return y[..., : self.nq], y[..., self.nq : self.work]


@dataclass(frozen=True, repr=False)
class CompiledModel(ABC):
    """Emitted functions of one model and one method, ready for the loops, in one of the shapes of code.

    Loading compiles nothing: each function is compiled, or read from the cache, at its first use by a loop.

    Class attributes
    ----------------
    shape : {"straight", "looped"}
        Shape of the code.
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
    #: Function and arguments that make the model again in another process: code itself is not pickled.
    origin: tuple[Callable[..., CompiledModel], tuple[Any, ...]] | None = field(default=None, repr=False, compare=False)

    def __reduce__(self) -> tuple[Callable[..., CompiledModel], tuple[Any, ...]]:
        if self.origin is None:
            raise TypeError("a compiled model that was loaded from files cannot be pickled; compile it from its model")
        return self.origin

    def __deepcopy__(self, memo: dict[int, Any]) -> CompiledModel:
        return self  # immutable

    def __repr__(self) -> str:
        info = self.info
        return f"<CompiledModel {info.name}, {self.law.key}, {self.shape}: {sizes_in_words(info)}>"

    @abstractmethod
    def scratch(self) -> Array:
        """Return a new scratch array ``w``; scales are 1 until a start sets them."""

    def printed_scratch(self) -> Array:
        """Return the same for a program in another language."""
        return self.scratch()

    @property
    def closes_all(self) -> bool:
        """Whether all rows fix velocities or close loops that leave some free."""
        pairs = self.info.pairs if BY_PIVOTS in self.law.operations else ()
        return bool(pairs) and self.info.m == sum(
            len(rows) for rows in (*(x for _, x in self.info.fixed), *(x for x, _ in pairs))
        )

    def parameter_array(self, parameters: Mapping[str, float], method_parameters: Mapping[str, float]) -> Array:
        """Return ``p``: model parameters, method parameters, and room for what ``prepare`` computes."""
        law = self.law
        p = np.zeros(max(1, law.parameter_offset + len(law.parameters) + law.hoisted))
        for i, q in enumerate(self.info.parameters):
            p[i] = parameters[q.name]
        for i, (name, default) in enumerate(law.parameters):
            p[law.parameter_offset + i] = method_parameters.get(name, default)
        return p

    def longer(self, shadows: int, hoisted: int, nw: int, model: ModuleType, law_module: ModuleType) -> CompiledModel:
        """Return a model with longer arrays and other functions.

        Parameters
        ----------
        shadows : int
            Elements after the state without error control.
        hoisted, nw : int
            Numbers that ``prepare`` computes, and length of the scratch array.
        model, law_module : module
            Functions of model and law.
        """
        info = msgspec.structs.replace(self.info, shadows=shadows)
        law = msgspec.structs.replace(self.law, hoisted=hoisted, nw=nw)
        return replace(self, info=info, law=law, model=model, law_module=law_module, origin=None)

    def prepare(self, p: Array) -> None:
        """Compute the numbers that follow the parameters in ``p``."""
        # these import Numba, which is not needed to emit code
        from symgen.run.layout import ensemble_abi as e
        from symgen.run.layout.probe import Ready

        for module in (self.model, self.law_module):
            Ready(module.prepare, e.PREPARE)(p)

    def with_scales(self, w: Array) -> Array:
        """Return the scratch array with its scales, and pivots of rows whose pivots never change, set to 1."""
        for name in ("pivot", "gauge", "row_weight"):
            self.section(w, name)[:] = 1.0
        w[[STATUS.index(name) for name in SCALES]] = 1.0
        if self.info.switchable:
            self.modes(w)[:, 0] = [float(row not in self.info.bounded) for row in self.info.switchable]
        return w

    def modes(self, w: Array) -> Array:
        """Return a view of the modes of rows that may be off, one line a row, see `symgen.base.ir.program.MODES`."""
        if not self.info.switchable:
            return w[:0].reshape(0, MODE_NUMBERS)
        return self.section(w, "modes").reshape(-1, MODE_NUMBERS)

    def off(self, w: Array) -> tuple[str, ...]:
        """Return the names of the rows that are off in `w`."""
        held = self.modes(w)[:, 0]
        return tuple(self.info.rows[i].name for i, on in zip(self.info.switchable, held, strict=True) if on == 0.0)

    def in_force(self, w: Array) -> int:
        """Return the number of rows in force in `w`."""
        return self.info.m - int(np.sum(self.modes(w)[:, 0] == 0.0))

    def section(self, w: Array, name: str) -> Array:
        """Return a view of one section of ``w``."""
        offset, size = self.info.sections[name]
        return w[offset : offset + size]

    def rank(self, w: Array) -> int:
        """Return the rank of D at the position of `w`: the number of pivots above rounding, of rows in force."""
        kept = self.section(w, "pivot") >= SKIP
        kept[list(self.info.switchable)] &= self.modes(w)[:, 0] != 0.0
        return int(np.sum(kept))

    def redundant(self, w: Array) -> tuple[str, ...]:
        """Return the names of the dependent rows that are left out in `w`."""
        return tuple(self.info.rows[i].name for i in np.flatnonzero(self.section(w, "mask")))

    def jacobian(self, w: Array) -> Array:
        """Return D as a dense matrix, shape (m, nv), from the values that ``geometry`` wrote to ``w``."""
        values = self.section(w, "jacobian")
        d = np.zeros((self.info.m, self.info.nv))
        for row, column, constant, slot in self.info.jacobian:
            d[row, column] = constant if slot is None else values[slot]
        return d
