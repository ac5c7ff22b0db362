"""An environment of many runs, which one compiled call takes on."""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from symgen.base import arguments
from symgen.base.errors import InputError, StepError
from symgen.base.memory import processor_count
from symgen.base.settings import differs_from_default
from symgen.compile.loopcode.entry import ArgumentBlock
from symgen.describe.bounds.keys import all_families
from symgen.result.stepping.meter import compile_formulas
from symgen.run.layout import abi
from symgen.run.layout.probe import rate_functions
from symgen.run.loops.seams import preparing_functions
from symgen.run.planning.prepare import prepare
from symgen.run.planning.restarts import Restarts
from symgen.run.rows.stepped_rows import Stepped, over_stepped
from symgen.run.single.changes import begin_stepping
from symgen.run.single.run import reason_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from symgen.run.planning.prepare import Prepared
    from symgen.run.single.simulation import Simulation
    from symgen.study.gym.task import Array, Task

#: Least rows of a thread: fewer are done sooner than another thread begins.
_LEAST = 64


class Environments(VectorEnv):  # type: ignore[misc]  # a class without types
    """Runs of one model side by side; `symgen.gym.make_vec` makes them.

    An episode that has ended begins anew at the next step, whose action it does not take. A row that fails stays where
    it was, and its episode is truncated, with the reason in ``infos["failure"]``. `reset` returns remarks on
    the model in ``infos["remarks"]``.

    Parameters
    ----------
    task : Task
        What each does.
    count : int
        Number of runs.
    jobs : int or None
        Threads.
    """

    metadata: ClassVar[dict[str, Any]] = {"render_modes": [], "autoreset_mode": AutoresetMode.NEXT_STEP}

    def __init__(self, task: Task, count: int, jobs: int | None) -> None:
        self.task, self.num_envs, self.render_mode = task, count, None
        self.single_observation_space, self.single_action_space = task.spaces
        self.observation_space = batch_space(self.single_observation_space, count)
        self.action_space = batch_space(self.single_action_space, count)
        self._rows = _Rows(task, count, jobs)
        self._over = np.zeros(count, dtype=bool)

    def reset(
        self, *, seed: int | list[int] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Array, dict[str, Any]]:
        """Begin episodes: all, or those that ``options["reset_mask"]`` selects."""
        if seed is not None:
            self._np_random, self._np_random_seed = np.random.default_rng(seed), seed
        mask = np.ones(self.num_envs, dtype=bool)
        if options and "reset_mask" in options:
            mask = np.asarray(options["reset_mask"], dtype=bool)
            if mask.shape != (self.num_envs,):
                raise InputError("reset_mask", f"{self.num_envs} truth values", arguments.kind_of_value(mask))
        self._begin(mask)
        return self._rows.values[:, : len(self.task.observe)].copy(), self.task.remarks

    def _begin(self, mask: NDArray[np.bool_]) -> None:
        for r in np.flatnonzero(mask).tolist():
            self._rows.begin(r, self.task.draw_start(self.np_random))
        self._over &= ~mask
        self._rows.step(0.0, np.zeros(self.num_envs, dtype=np.int64))

    def step(self, actions: object) -> tuple[Array, Array, NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        """Hold actions for a time `dt`."""
        task, rows, anew = self.task, self._rows, self._over.copy()
        drives = np.asarray(actions, dtype=np.float64)
        if drives.shape != rows.given.shape:
            raise InputError("actions", f"an array of shape {rows.given.shape}", f"one of shape {drives.shape}")
        for r in np.flatnonzero(anew).tolist():
            rows.begin(r, task.draw_start(self.np_random))
        rows.given[~anew] = drives[~anew]
        rows.step(task.dt, (~anew).astype(np.int64))
        observations, reward, ended = task.judge_step(rows.values, drives)
        failed = np.array([reason != "" for reason in rows.reasons]) if rows.reasons else np.zeros_like(anew)
        truncated = (task.is_time_over(rows.times) | failed) & ~anew
        ended = ended & ~anew
        self._over = ended | truncated
        infos = {"failure": np.array(rows.reasons), "_failure": failed} if failed.any() else {}
        return observations, np.where(anew, 0.0, reward), ended, truncated, infos

    def close_extras(self, **options: object) -> None:
        """End the threads; `options` are Gymnasium's."""
        self._rows.close()


class _Rows:
    """Memory of the runs, and the compiled call for each thread.

    Attributes
    ----------
    given : Array, shape (rows, inputs)
        Inputs of the next step.
    values : Array, shape (rows, formulas)
        Formulas at the present states.
    times : Array
        Present times [s].
    reasons : list of str
        Why rows failed in the last step; empty where none has.
    """

    def __init__(self, task: Task, count: int, jobs: int | None) -> None:
        settings = replace(task.settings, times=())
        if not differs_from_default(settings, "shape"):
            settings = replace(settings, shape="straight")
        self._prepared = prepared = prepare(task.model.mechanism, settings)
        self._restarts, own = Restarts(prepared), prepared.simulation()
        _refuse_unsupported(prepared, own)
        self._own, self._first = own, own.snapshot.front.copy()
        self._fronts = np.zeros((count, len(self._first)))
        self.given = np.zeros((count, len(task.act)))
        self.values = np.zeros((count, len(task.formulas)))
        self.times, self.reasons = np.zeros(count), list[str]()
        self._last: tuple[Mapping[str, float] | None, Array] | None = None
        self._codes, self._until = np.zeros(count, dtype=np.int64), np.zeros(count)
        self._moving = np.zeros(count, dtype=np.int64)
        side, rated = compile_formulas(prepared, task.formulas, "formulas of the environment")
        places = {q.name: i for i, q in enumerate(prepared.compiled.info.parameters)}
        self._places = np.array([places[name] for name in task.act], dtype=np.int64)
        self._defaults = own.state.p[self._places]
        threads = processor_count() if jobs is None else arguments.whole_number("jobs", jobs, 1, count)
        threads = max(1, min(threads, count // _LEAST)) if jobs is None else threads
        bounds = np.linspace(0, count, threads + 1).astype(int).tolist()
        self._parts = [self._call_over_rows(side.function, rated, first, last) for first, last in pairwise(bounds)]
        self._pool = ThreadPoolExecutor(threads - 1, "symgen-gym") if threads > 1 else None
        at = own.state.clock.ctypes.data - own.snapshot.front.ctypes.data
        self._clock = at // self._first.itemsize + abi.TIME

    def _call_over_rows(self, function: object, rated: bool, first: int, last: int) -> _Part:
        """Return the call over some rows, with memory of its own."""
        simulation = self._prepared.simulation()
        state, compiled, setup = simulation.state, simulation.compiled, simulation.setup
        table = Stepped(
            fronts=self._fronts.ravel(),
            front=simulation.snapshot.front,
            given=self.given.ravel(),
            places=self._places,
            moving=self._moving,
            codes=self._codes,
            values=self.values.ravel(),
            until=self._until,
            w=state.w.copy(),
            rates=np.zeros(compiled.info.ny),
            counters=np.zeros_like(state.iw),
            dt=np.zeros(1),
            bounds=np.array([first, last]),
            rated=int(rated),
            adaptive=int(self._prepared.spec.adaptive),
        )
        system = simulation.sizes, *setup.functions
        formulas = *rate_functions(compiled.law_module), function, self.values.shape[1]
        model = system, setup.loop, *preparing_functions(compiled), formulas
        span = simulation.span._replace(end=math.inf, most=math.inf)
        nothing = simulation.outputs(np.zeros(0))
        return _Part(over_stepped(setup.loop), model, simulation.scheme, span, table, state, nothing)

    def begin(self, r: int, start: Mapping[str, float] | None) -> None:
        """Put a row at a start; its formulas are evaluated by the next step."""
        if self._last is None or self._last[0] != start:
            self._last = start, self._memory_at_start(start)
        self._fronts[r], self.given[r] = self._last[1], self._defaults

    def _memory_at_start(self, start: Mapping[str, float] | None) -> Array:
        """Return the memory of a run at a start."""
        own, state = self._own, self._own.state
        own.snapshot.front[:] = self._first
        if start is not None:
            now = self._restarts.state(start)
            if now is None:
                raise InputError("reset", "a start that the code of the environment serves", "one with lighter bodies")
            state.y[: len(now.y)], state.w[:] = now.y, now.w
        if (code := begin_stepping(own)) != abi.DONE:
            raise StepError(reason_of(own, code, own.start.t), own.start.t)
        return own.snapshot.front.copy()

    def step(self, dt: float, moving: NDArray[np.int64]) -> None:
        """Take rows on by a time, and evaluate the formulas of all."""
        self._moving[:] = moving
        if self._pool is None:
            self._parts[0](dt)
        else:
            waiting = [self._pool.submit(part, dt) for part in self._parts[1:]]
            self._parts[0](dt)
            for future in waiting:
                future.result()
        self.reasons = []
        for r in np.flatnonzero(self._codes).tolist():
            self._serve_request(r)
        self.times[:] = self._fronts[:, self._clock]

    def _serve_request(self, r: int) -> None:
        """Serve the request of a row's loop, or keep the reason of its failure."""
        own, code = self._own, int(self._codes[r])
        if code < abi.DONE:
            own.snapshot.front[:] = self._fronts[r]
            code = own.enter(own.outputs(np.zeros(0)), float(self._until[r]), most=math.inf)
            if code == abi.DONE:
                self._fronts[r] = own.snapshot.front
        if code != abi.DONE:
            self.reasons = self.reasons or [""] * len(self._fronts)
            self.reasons[r] = abi.REASONS[code] or "the run cannot go on"
        self._moving[r], part = 0, next(part for part in self._parts if part.first <= r < part.last)
        part(0.0, r, r + 1)

    def close(self) -> None:
        """End the threads."""
        if self._pool is not None:
            self._pool.shutdown()


class _Part:
    """The compiled call over some rows."""

    def __init__(self, function: Any, *arguments: Any) -> None:
        table = arguments[3]
        self._dt, self._bounds = table.dt, table.bounds
        self.first, self.last = table.bounds.tolist()
        block = ArgumentBlock.of(function, getattr(function, "signature", None), arguments)
        self._enter = partial(function, *arguments) if block is None else block.enter

    def __call__(self, dt: float, first: int | None = None, last: int | None = None) -> None:
        """Take the rows on by a time; some of them where bounds are named."""
        self._dt[0] = dt
        self._bounds[:] = (self.first, self.last) if first is None or last is None else (first, last)
        self._enter()


def _refuse_unsupported(prepared: Prepared, simulation: Simulation) -> None:
    """Refuse runs that single runs alone serve."""
    hint = "gymnasium.vector.SyncVectorEnv takes many environments of symgen.gym.make"
    where, compiled = "make_vec", prepared.compiled
    if compiled.shape != "straight":
        raise InputError(where, "code of the shape 'straight'", f"'{compiled.shape}'", hint)
    if prepared.spec.events is not None or compiled.info.bounded:
        kinds = " and ".join(family.noun for family in reversed(all_families()))
        raise InputError(where, f"a model without events, {kinds}", "one with such", hint)
    if prepared.spec.seams:
        raise InputError(where, "inputs and formulas that do not jump at known times", "one that does", hint)
    if not simulation._copied:
        raise InputError(where, "an explicit integrator", f"'{prepared.plan.settings.integrator}'", hint)
