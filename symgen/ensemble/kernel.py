"""The compiled side of an ensemble: closes and runs the rows of a chunk, here or on another machine."""

from __future__ import annotations

import threading
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.ensemble.recipe import Module, Recipe
from symgen.errors import InputError
from symgen.integrators import INTEGRATORS
from symgen.model import CompiledModel
from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e
from symgen.runtime.run import RunSpec

if TYPE_CHECKING:
    from symgen.ensemble.device import DeviceRuns
    from symgen.ensemble.lanes import LaneRuns
    from symgen.ensemble.starts import Rows
    from symgen.integrators._base import BatchCall

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

_LIGHT, _START = e.SUMMARY.index("light"), e.SUMMARY.index("start")
_REDUNDANT = e.SUMMARY.index("redundant_rows")


@dataclass(frozen=True)
class Chunk:
    """What the rows of a chunk gave.

    Attributes
    ----------
    values : Array, shape (k, quantities, times)
        Quantities at the output times; nan where a run did not get there.
    summary : Array, shape (k, N_SUMMARY)
        See `symgen.runtime.ensemble_abi`.
    complete : bool
        Whether all rows were run.
    """

    values: Array
    summary: Array
    complete: bool = True


@dataclass
class _Prepared:
    """A compiled model with the arrays that describe it to the loops."""

    compiled: CompiledModel
    sizes: Integers
    table: Integers
    constants: Array
    joints: Integers
    massless: Integers
    p: Array
    device: DeviceRuns | None = None
    lanes: LaneRuns | None = None


@dataclass
class Kernel:
    """Runs the chunks of one recipe; threads may share it."""

    recipe: Recipe
    _lock: threading.Lock = field(default_factory=threading.Lock)
    _spare: _Prepared | None = None
    _warm: bool = False

    @cached_property
    def call(self) -> BatchCall:
        """The loop over many runs.

        Raises
        ------
        InputError
            If the integrator has none.
        """
        return batch_call(self.recipe.integrator, self.first.compiled.info.ny, self.recipe.spec)

    @cached_property
    def first(self) -> _Prepared:
        """The model as it is run first."""
        return self._prepare(self.recipe.module.load(), self.recipe.other)

    def spare(self) -> _Prepared | None:
        """Return the model with the solver for light bodies, loaded when the first such run is met."""
        with self._lock:
            if self._spare is None and self.recipe.spare is not None:
                self._spare = self._prepare(self.recipe.spare.load(), self.recipe.spare_other)
            return self._spare

    def warm(self) -> None:
        """Compile or load all that runs need, by no runs at all."""
        from symgen.ensemble.starts import Rows

        with self._lock:
            if self._warm:
                return
            info = self.first.compiled.info
            sizes = (len(info.parameters), info.nq, info.nv, len(self.recipe.held))
            self.run(Rows(*(np.zeros((0, size)) for size in sizes)), new_control())
            if self.first.device is not None:
                self.first.device.compile()
            self._warm = True

    def run(self, rows: Rows, control: Integers) -> Chunk:
        """Close and run the rows of a chunk.

        Parameters
        ----------
        rows : Rows
            What distinguishes the runs.
        control : Array of int
            From `new_control`: raising its flag `symgen.runtime.abi.STOP` from another thread stops the run that is
            being worked on; `symgen.runtime.ensemble_abi.RUNS_DONE` counts finished ones.
        """
        recipe, k = self.recipe, len(rows)
        values = np.full((k, len(recipe.quantities), len(recipe.spec.times)), np.nan)
        summary = np.zeros((k, e.N_SUMMARY))
        everything = np.arange(k, dtype=np.int64)
        complete = self._run_with(self.first, rows, everything, values, summary, control)
        light = np.flatnonzero((summary[:, _LIGHT] == 1.0) & (summary[:, _START] == e.ASSEMBLED))
        if complete and len(light) and (spare := self.spare()) is not None:
            summary[light] = 0.0
            complete = self._run_with(spare, rows, light.astype(np.int64), values, summary, control)
            summary[light, _LIGHT] = 1.0
        multipliers = [i for i, q in enumerate(recipe.quantities) if q.source == e.MULTIPLIER]
        redundant = np.flatnonzero(summary[:, _REDUNDANT] > 0.0)
        for i in multipliers:  # they are not unique then
            values[redundant, i] = np.nan
        return Chunk(values, summary, complete)

    def _run_with(
        self, model: _Prepared, rows: Rows, selected: Integers, values: Array, summary: Array, control: Integers
    ) -> bool:
        """Close and run selected rows with one compiled model; those with light bodies only where there is no other."""
        from symgen.runtime.batch import observe_nothing
        from symgen.runtime.closing import correct
        from symgen.runtime.manifold import stay
        from symgen.runtime.starting import close_runs, follow_nothing

        info, law, recipe, call = model.compiled.info, model.compiled.law_module, self.recipe, self.call
        k, ny, nw = len(rows), info.ny, max(1, model.compiled.law.nw)
        ps = np.tile(model.p, (max(k, 1), 1))
        ps[:k, : len(info.parameters)] = rows.parameters
        ys, ws = np.zeros(max(k, 1) * ny), np.zeros(max(k, 1) * nw)
        iw, order = np.zeros(abi.N_COUNTERS, dtype=np.int64), np.zeros(max(1, info.m), dtype=np.int64)
        m, n = info.m, info.nv
        room = np.zeros(3 * n + 2 * m + info.nq + 2 * ny + nw + m * n + m * min(m, n) + m + n)
        done = close_runs(
            *(model.compiled.model.prepare, law.prepare, model.compiled.model.masses, model.compiled.model.geometry),
            *(
                model.compiled.model.measure if info.windings else follow_nothing,
                getattr(model.compiled.model, "move", stay),
            ),
            *(correct, law.rhs),
            *(model.sizes, model.table, model.constants, model.joints, model.massless),
            *(np.array(recipe.held, dtype=np.int64).ravel(), selected),
            *(_flat(rows.targets), _flat(rows.q), _flat(rows.v), ps.ravel(), ys, ws, summary.reshape(-1)),
            *(iw, order, control, room),
        )
        if done < len(selected):
            return False
        ready = summary[selected, _START] == e.ASSEMBLED
        if model is self.first and recipe.spare is not None:
            ready &= summary[selected, _LIGHT] == 0.0
        selected = selected[ready]
        if model.device is not None:
            starts = (ys.reshape(-1, ny), ps, ws.reshape(-1, nw))
            return model.device.run(*starts, selected, values, summary, control) == len(selected)
        times = recipe.times
        k_times, windings = len(times), info.windings
        observes = e.JOINT in recipe.sources
        rates = getattr(law, "rates", law.rhs)  # a law that integrates something else than v has rates of v beside
        ends = (law.accept, model.compiled.model.observe if observes else observe_nothing)
        confirms = getattr(law, "confirm", law.rhs), getattr(law, "confirm", rates)
        outputs = (
            *(np.empty((k_times, ny)), np.empty((k_times, abi.RANK + 1 + windings))),
            *(np.zeros((k_times, info.nv)), np.zeros((k_times, info.m))),
            *(np.zeros((k_times, info.m + 2 * len(info.joint_coordinates))), np.zeros((k_times, windings))),
            recipe.picks,
            *(values.reshape(-1), summary.reshape(-1), recipe.limits, np.zeros(abi.N_GAUGES), control),
            *(np.zeros(abi.MAX_EVENTS * abi.N_EVENT), iw),
        )
        flat = ps.ravel()
        if model.lanes is not None:
            left = np.zeros(max(k, 1), dtype=np.int64)
            functions = (rates, confirms[1], *ends)
            done = model.lanes.run(functions, call, (model.sizes, selected, ys, flat, ws, times, *outputs), left)
            if done < len(selected):
                return False
            selected = np.flatnonzero(left).astype(np.int64)
        done = call.loop(
            *(law.rhs, confirms[0], law.accept, rates, confirms[1], ends[1], *call.arguments),
            *(model.sizes, selected, ys, flat, ws, times, *outputs, np.zeros(nw + call.room)),
        )
        return bool(done == len(selected))

    def _prepare(self, compiled: CompiledModel, other: Module | None) -> _Prepared:
        info, recipe = compiled.info, self.recipe
        defaults = {q.name: 0.0 for q in info.parameters}
        p = compiled.parameter_array(defaults, recipe.method_parameters)
        sizes = np.zeros(e.N_SIZES, dtype=np.int64)
        for index, value in (
            (e.NQ, info.nq),
            (e.NV, info.nv),
            (e.M, info.m),
            (e.NP, len(p)),
            (e.NW, max(1, compiled.law.nw)),
            (e.N_PARAMETERS, len(info.parameters)),
            (e.SPATIAL, int(bool(info.spins))),
            (e.LIGHT_CHECK, int(recipe.spare is not None and hasattr(compiled.law_module, "confirm"))),
            (e.STRICT, int(recipe.strict)),
            (e.WINDINGS, info.windings),
        ):
            sizes[index] = value
        for index, name in (
            (e.MASS, "mass"),
            (e.RESIDUAL, "residual"),
            (e.NU, "nu"),
            (e.JACOBIAN, "jacobian"),
            (e.PIVOTS, "pivot"),
            (e.MASK, "mask"),
            (e.CHANGE, "change"),
            (e.MULTIPLIERS, "multipliers"),
        ):
            sizes[index] = info.sections.get(name, (0, 0))[0]
        sizes[e.WANTS_JOINTS] = int(e.JOINT in recipe.sources)
        sizes[e.WANTS_RATES] = int(bool(recipe.sources & {e.ACCELERATION, e.MULTIPLIER, e.JOINT}))
        names = list(dict.fromkeys(row.joint for row in info.rows))
        massless = np.zeros(info.nv, dtype=np.int64)
        massless[list(info.massless)] = 1
        return _Prepared(
            compiled=compiled,
            sizes=sizes,
            table=np.array(
                [(r, c, -1 if slot is None else slot) for r, c, _, slot in info.jacobian], dtype=np.int64
            ).ravel(),
            constants=np.array([constant or 0.0 for _, _, constant, _ in info.jacobian], dtype=np.float64),
            joints=np.array([names.index(row.joint) for row in info.rows], dtype=np.int64),
            massless=massless,
            p=p,
            device=self._device_runs(other.load(), len(p), sizes)
            if other is not None and recipe.target == "cuda"
            else None,
            lanes=self._lane_runs(other.load(), len(p)) if other is not None and recipe.target == "lanes" else None,
        )

    def _lane_runs(self, compiled: CompiledModel, n_p: int) -> LaneRuns:
        from symgen.ensemble.lanes import LaneRuns

        return LaneRuns(compiled, n_p, len(self.recipe.spec.times))

    def _device_runs(self, compiled: CompiledModel, n_p: int, sizes: Integers) -> DeviceRuns:
        from symgen.ensemble.device import DeviceRuns, need_of

        recipe = self.recipe
        call = batch_call(recipe.integrator, compiled.info.ny, recipe.spec)
        need = need_of(compiled, n_p, call, recipe.spec.adaptive, recipe.sources)
        return DeviceRuns(compiled, need, call, sizes, recipe.limits, recipe.times, recipe.picks)


def batch_call(integrator: str, ny: int, spec: RunSpec) -> BatchCall:
    """Return an integrator's loop over many runs.

    Raises
    ------
    InputError
        If it has none; says which have one.
    """
    chosen = INTEGRATORS.get(integrator, "--integrator")
    batch = getattr(chosen, "batch", None)
    call: BatchCall | None = None if batch is None else batch(ny, spec)
    if call is None:
        with_loop = [
            name
            for name, kind in INTEGRATORS.items()
            if (found := getattr(kind, "batch", None)) and found(ny, replace(spec, adaptive=False, step=1.0))
        ]
        raise InputError(
            f"integrator '{integrator}'",
            "one with a loop over many runs",
            "one without",
            f"{', '.join(with_loop)} have one",
        )
    return call


def new_control() -> Integers:
    """Return the integers that a chunk shares with whoever watches it."""
    return np.zeros(e.N_CONTROL, dtype=np.int64)


def _flat(values: Array) -> Array:
    return np.ascontiguousarray(values, dtype=np.float64).reshape(-1)


_kernels: dict[str, Kernel] = {}
_kernels_lock = threading.Lock()


def kernel_of(recipe: Recipe) -> Kernel:
    """Return the kernel of a recipe, the same one as long as it is among the last few."""
    with _kernels_lock:
        found = _kernels.get(recipe.digest)
        if found is None:
            while len(_kernels) >= 4:
                del _kernels[next(iter(_kernels))]
            found = _kernels[recipe.digest] = Kernel(recipe)
    return found
