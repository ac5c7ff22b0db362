"""Cells of a study computed on several processes, with a journal of what is done and an estimate of what is left.

Only for studies in which run times are not what is measured. Cells of one group share what is costly to make (a
compiled module, a reference) and go to the same process where that does not leave another one idle.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any

from symgen.errors import SimulationError
from symgen.study.journal import Journal, Outcome

#: What a numerical library may start threads by; a process of a study is one thread.
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
#: How often progress is shown while nothing ends [s].
_BEAT = 0.5
#: A cell whose process died is tried this many times before it counts as crashed.
_ATTEMPTS = 2
#: Outcome of a cell whose process died.
CRASHED: Mapping[str, Any] = {"crashed": True}


@dataclass(frozen=True)
class Cell:
    """One piece of work.

    Parameters
    ----------
    key : str
        From `symgen.study.journal.cell_key`.
    group : str
        Cells of one group share what is costly to make.
    task : object
        What `compute` gets; it travels between processes.
    cost : float
        Expected work relative to other cells, for the estimate of what is left.
    """

    key: str
    group: str
    task: Any
    cost: float = 1.0


@dataclass(frozen=True)
class Status:
    """How far a study is.

    Attributes
    ----------
    done, total : int
        Cells, those found in the journal included.
    share : float
        Work that is done, from 0 to 1.
    seconds_left : float or None
        Estimate from the work done since the study began; None before anything was computed.
    """

    done: int
    total: int
    share: float
    seconds_left: float | None


@dataclass
class _Progress:
    """Counts cells and work."""

    show: Callable[[Status], None]
    total: int
    work: float
    done: int = 0
    worked: float = 0.0
    found: float = 0.0
    began: float = field(default_factory=time.monotonic)

    def finished(self, cost: float, found: bool = False) -> None:
        self.done += 1
        self.worked += cost
        self.found += cost if found else 0.0

    def __call__(self) -> None:
        computed, elapsed = self.worked - self.found, time.monotonic() - self.began
        left = (self.work - self.worked) * elapsed / computed if computed > 0.0 else None
        self.show(Status(self.done, self.total, self.worked / self.work if self.work else 1.0, left))


def run_cells(
    cells: Sequence[Cell],
    compute: Callable[[Any], Outcome],
    journal: Journal,
    processes: int = 1,
    progress: Callable[[Status], None] | None = None,
) -> tuple[dict[str, Outcome], bool]:
    """Compute the cells that the journal does not hold yet.

    Parameters
    ----------
    cells : sequence of Cell
        Cells of the same key are computed once.
    compute : callable
        A function of a module: task -> outcome, what JSON can express. An error that it raises ends the study.
    journal : Journal
        Gets each outcome as soon as it is there.
    processes : int
        Processes to compute on; 1 computes in this one. A cell whose process dies is tried again, then is `CRASHED`.
    progress : callable, optional
        Called after each cell and about twice a second.

    Returns
    -------
    outcomes : dict
        Those of `cells` that are done, by key.
    interrupted : bool
        Whether a KeyboardInterrupt ended the study before all were.
    """
    unique = list({cell.key: cell for cell in cells}.values())
    state = _Progress(progress or (lambda status: None), len(unique), sum(cell.cost for cell in unique))
    missing = []
    for cell in unique:
        if cell.key in journal:
            state.finished(cell.cost, found=True)
        else:
            missing.append(cell)
    state()
    interrupted = False
    try:
        found = _here(missing, compute, state) if processes <= 1 else _spread(missing, compute, processes, state)
        with contextlib.closing(found):
            for cell, outcome in found:
                journal.add(cell.key, outcome)
                state.finished(cell.cost)
                state()
    except KeyboardInterrupt:
        interrupted = True
    outcomes = {cell.key: outcome for cell in unique if (outcome := journal.get(cell.key)) is not None}
    return outcomes, interrupted


Found = Iterator[tuple[Cell, Outcome]]


def _here(cells: Sequence[Cell], compute: Callable[[Any], Outcome], state: _Progress) -> Any:
    for cell in sorted(cells, key=lambda c: c.group):
        yield cell, compute(cell.task)


# -- several processes -------------------------------------------------------------------------------------------------


@dataclass
class _Worker:
    process: BaseProcess
    pipe: Connection
    group: str | None = None
    cell: Cell | None = None


def _spread(cells: Sequence[Cell], compute: Callable[[Any], Outcome], processes: int, state: _Progress) -> Any:
    """Yield cells as they get done; the processes end with this generator."""
    queue = _Queue(cells)
    attempts: dict[str, int] = {}
    workers: list[_Worker] = []
    try:
        for _ in range(min(processes, len(cells))):
            workers.append(_start(compute))
        for worker in workers:
            _give(worker, queue)
        while any(worker.cell is not None for worker in workers):
            ready = set(wait([worker.pipe for worker in workers if worker.cell is not None], _BEAT))
            state()
            for i, worker in enumerate(workers):
                if worker.pipe not in ready or worker.cell is None:
                    continue
                cell = worker.cell
                try:
                    outcome, error = worker.pipe.recv()
                except (EOFError, OSError):  # the process died over this cell
                    workers[i] = replacement = _start(compute)
                    _end(worker)
                    attempts[cell.key] = attempts.get(cell.key, 0) + 1
                    if attempts[cell.key] < _ATTEMPTS:
                        queue.put(cell)
                    else:
                        yield cell, dict(CRASHED)
                    _give(replacement, queue)
                    continue
                if error is not None:
                    raise error
                _give(worker, queue)  # before the outcome is dealt with: nobody waits meanwhile
                yield cell, outcome
    finally:
        for worker in workers:
            _end(worker)


class _Queue:
    """Cells by group: a worker stays with its group while there is one, else takes the one with the most work."""

    def __init__(self, cells: Sequence[Cell]) -> None:
        self.groups: dict[str, list[Cell]] = {}
        self.users: dict[str, int] = {}
        for cell in reversed(cells):
            self.put(cell)

    def put(self, cell: Cell) -> None:
        self.groups.setdefault(cell.group, []).append(cell)

    def take(self, group: str | None) -> Cell | None:
        if group is not None and self.groups.get(group):
            return self.groups[group].pop()
        if group is not None:
            self.users[group] = self.users.get(group, 1) - 1
        left = [(self.users.get(name, 0) > 0, -sum(c.cost for c in v), name) for name, v in self.groups.items() if v]
        if not left:
            return None
        chosen = min(left)[2]
        self.users[chosen] = self.users.get(chosen, 0) + 1
        return self.groups[chosen].pop()


def _give(worker: _Worker, queue: _Queue) -> None:
    worker.cell = queue.take(worker.group)
    if worker.cell is not None:
        worker.group = worker.cell.group
        # a process that has died meanwhile is met when its answer is read
        with contextlib.suppress(OSError):
            worker.pipe.send(worker.cell.task)


def _start(compute: Callable[[Any], Outcome]) -> _Worker:
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=_work, args=(theirs, compute), name="symgen-study", daemon=True)
    before = {name: os.environ.get(name) for name in _THREADS}
    os.environ.update(dict.fromkeys(_THREADS, "1"))
    try:
        process.start()
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
    theirs.close()  # so that the end of the process ends the pipe
    return _Worker(process, ours)


def _end(worker: _Worker) -> None:
    worker.pipe.close()
    worker.process.kill()
    worker.process.join()


def _work(pipe: Connection, compute: Callable[[Any], Outcome]) -> None:
    """Compute what comes through the pipe until it ends; Ctrl-C is the parent's business."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_follow_parent, daemon=True).start()
    while True:
        try:
            task = pipe.recv()
        except (EOFError, OSError):
            return
        try:
            answer: tuple[Outcome | None, BaseException | None] = compute(task), None
        except Exception as error:
            answer = None, _portable(error)
        try:
            pipe.send(answer)
        except OSError:
            return


def _portable(error: Exception) -> BaseException:
    """Return an error that survives the pipe: with its type where it can, else with its text."""
    import pickle

    try:
        pickle.loads(pickle.dumps(error))
    except Exception:
        return SimulationError(f"{type(error).__name__}: {error}")
    return error


def _follow_parent() -> None:
    """End this process when the parent is gone, in the middle of a cell too: a killed study leaves nobody behind."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
