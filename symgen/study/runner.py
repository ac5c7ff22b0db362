"""Cells of a study computed one after another or on several processes, with a journal of the finished ones.

Several processes suit cells whose run times are not measured.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from typing import Any

from symgen.base.errors import SimulationError
from symgen.base.plugins import explain_plugin_errors, load_plugins, loaded_plugin_files
from symgen.study.journal import Journal, Outcome

#: Numerical libraries start threads by these variables; a process of a study is one thread.
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")

#: Cells that a process has at a time: it need not wait for the next one.
AHEAD = 2


@dataclass(frozen=True)
class Cell:
    """One piece of work.

    Parameters
    ----------
    key : str
        From `symgen.study.journal.cell_key`.
    group : str
        Cells of one group share code that is costly to compile, and are computed one after another.
    task : object
        Argument of `compute`; it is sent to processes.
    cost : float
        Expected work relative to other cells, for the estimate of the remaining time.
    check : callable
        Raises `ValueError` for an entry of a journal that is no outcome of such a cell; it is computed again.
    """

    key: str
    group: str
    task: Any
    cost: float = 1.0
    check: Callable[[Outcome], object] = dict


@dataclass(frozen=True)
class Status:
    """Progress of a study.

    Attributes
    ----------
    done, total : int
        Cells, those of the journal included.
    share : float
        Completed share of the work, from 0 to 1.
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
    done: int
    worked: float
    began: float = field(default_factory=time.monotonic)
    computed: float = 0.0

    def __call__(self, cost: float = 0.0) -> None:
        """Show the state after a cell, or, without a cost, before the first one."""
        self.done += cost > 0.0
        self.worked += cost
        self.computed += cost
        elapsed = time.monotonic() - self.began
        left = (self.work - self.worked) * elapsed / self.computed if self.computed else None
        self.show(Status(self.done, self.total, self.worked / self.work if self.work else 1.0, left))


def run_cells(
    cells: Sequence[Cell],
    compute: Callable[[Any], Outcome | None],
    journal: Journal,
    processes: int = 1,
    progress: Callable[[Status], None] | None = None,
    patience: float = 0.0,
) -> tuple[dict[str, Outcome], bool]:
    """Compute the cells that the journal lacks.

    Parameters
    ----------
    cells : sequence of Cell
        Cells of the same key are computed once.
    compute : callable
        A function of a module: task -> outcome as JSON values, or None for cells outside the journal. Its errors end
        the study.
    journal : Journal
        Receives each outcome as soon as it is computed.
    processes : int
        Processes to compute on; 1 computes in this one.
    progress : callable, optional
        Called before the first cell and after each.
    patience : float
        No process is started before a cell has taken longer than this [s].

    Returns
    -------
    outcomes : dict
        Outcomes of finished cells, by key.
    interrupted : bool
        Whether a KeyboardInterrupt ended the study early.

    Raises
    ------
    SimulationError
        If a process dies.
    """
    unique = list({cell.key: cell for cell in cells}.values())
    for cell in unique:
        if (entry := journal.get(cell.key)) is not None:
            try:
                cell.check(entry)
            except ValueError:
                journal.drop(cell.key)
    missing = sorted((cell for cell in unique if cell.key not in journal), key=lambda cell: cell.group)
    work = sum(cell.cost for cell in unique)
    behind = work - sum(cell.cost for cell in missing)
    advance = _Progress(progress or (lambda status: None), len(unique), work, len(unique) - len(missing), behind)
    advance()
    interrupted = False
    try:
        with contextlib.closing(_compute_cells(missing, compute, processes, patience)) as computed:
            for cell, outcome in computed:
                if outcome is not None:
                    journal.add(cell.key, outcome)
                advance(cell.cost)
    except KeyboardInterrupt:
        interrupted = True
    outcomes = {cell.key: outcome for cell in unique if (outcome := journal.get(cell.key)) is not None}
    return outcomes, interrupted


Computed = Iterator[tuple[Cell, Outcome | None]]


def _compute_cells(
    cells: Sequence[Cell], compute: Callable[[Any], Outcome | None], processes: int, patience: float
) -> Any:
    """Yield cells as they finish: in this process, and in others as soon as one takes longer than `patience`."""
    worthwhile = patience == 0.0
    for i, cell in enumerate(cells):
        if worthwhile and processes > 1 and len(cells) - i > 1:
            yield from _spread_over_processes(cells[i:], compute, processes)
            return
        began = time.monotonic()
        yield cell, compute(cell.task)
        worthwhile = worthwhile or time.monotonic() - began > patience


# -- several processes -------------------------------------------------------------------------------------------------


def _spread_over_processes(cells: Sequence[Cell], compute: Callable[[Any], Outcome | None], processes: int) -> Computed:
    """Yield cells as processes finish them; the processes end with this generator."""
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    shares, count = Shares(cells), min(processes, len(cells))
    # a pool of one process each: cells that share code go to the process that has it
    pools = [ProcessPoolExecutor(1, context, _begin_process, (theirs, loaded_plugin_files())) for _ in range(count)]
    running = dict[Future[Outcome | None], tuple[int, Cell]]()

    def send_cell(which: int) -> None:
        if (cell := shares.next_cell(which)) is not None:
            running[pools[which].submit(_compute_in_process, compute, cell.task)] = which, cell

    try:
        with one_thread_each():
            for which in list(range(count)) * AHEAD:
                send_cell(which)
        while running:
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                which, cell = running.pop(future)
                send_cell(which)
                yield cell, future.result()
    except BrokenProcessPool:
        raise SimulationError("a process of the study died; a journal holds what was done before") from None
    finally:
        ours.close()
        for pool in pools:
            pool.shutdown(cancel_futures=True)


class Shares:
    """Cells for processes: a process takes them group by group, and helps another group once none is left.

    Parameters
    ----------
    cells : sequence of Cell
        Cells, those of a group one after another.
    """

    def __init__(self, cells: Sequence[Cell]) -> None:
        groups = dict[str, deque[Cell]]()
        for cell in cells:
            groups.setdefault(cell.group, deque()).append(cell)
        self._untouched, self._own = deque(groups.values()), dict[int, deque[Cell]]()

    def next_cell(self, process: int) -> Cell | None:
        """Return the next cell of a process, None if no cell is left."""
        own = self._own.get(process)
        if not own and self._untouched:
            own = self._own[process] = self._untouched.popleft()
        if own:
            return own.popleft()
        longest = max(self._own.values(), key=len, default=None)
        return longest.pop() if longest else None


@explain_plugin_errors
def _compute_in_process(compute: Callable[[Any], Outcome | None], task: object) -> Outcome | None:
    """Compute a cell in another process: errors leave it without the lines that they passed."""
    return compute(task)


@contextlib.contextmanager
def one_thread_each() -> Iterator[None]:
    """Give one thread each to processes that start meanwhile, and to libraries that this one loads meanwhile.

    Matrices of a mechanism are small: on busy processors threads wait for each other longer than one of them computes.
    """
    before = {name: os.environ.get(name) for name in _THREADS}
    os.environ.update(dict.fromkeys(_THREADS, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            del os.environ[name]
            if value is not None:
                os.environ[name] = value


def _begin_process(study: Connection, plugins: tuple[str, ...]) -> None:
    """Prepare a process: Ctrl-C is for the study's own process, this one ends with the study and has its plugins."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_follow_process, args=(study,), daemon=True).start()
    load_plugins(plugins)


def _follow_process(study: Connection) -> None:
    """End this process as soon as the study has, in the middle of a cell too; nothing is ever sent."""
    with contextlib.suppress(EOFError, OSError):
        study.recv()
    os._exit(1)
