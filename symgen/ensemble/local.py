"""Chunks run by threads of this process: the loops hold no lock, so each thread keeps a core busy."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from symgen.ensemble.kernel import Chunk, Integers, kernel_of, new_control
from symgen.memory import processors
from symgen.runtime import abi
from symgen.runtime.ensemble_abi import RUNS_DONE

if TYPE_CHECKING:
    from symgen.ensemble.plan import Ensemble
    from symgen.ensemble.table import Table

#: How often progress is shown while no chunk ends [s].
_BEAT = 0.1


class _Pool:
    """Threads that take chunks until there are none or they are stopped."""

    def __init__(self, ensemble: Ensemble, table: Table, jobs: int) -> None:
        self.ensemble, self.table = ensemble, table
        self.kernel = kernel_of(ensemble.recipe)
        self.waiting = iter(table.missing())
        self.lock = threading.Lock()
        self.stopping = False
        self.results: queue.Queue[tuple[int, Chunk | BaseException]] = queue.Queue()
        # no more results than that wait for being written
        self.places = threading.Semaphore(3 * jobs)
        self.controls = [new_control() for _ in range(jobs)]
        self.threads = [
            threading.Thread(target=self._work, args=(control,), name="symgen-sweep", daemon=True)
            for control in self.controls
        ]

    def _next(self) -> int | None:
        with self.lock:
            return None if self.stopping else next(self.waiting, None)

    def _work(self, control: Integers) -> None:
        while True:
            self.places.acquire()
            index = self._next()
            if index is None:
                return
            control[:] = 0
            if self.stopping:  # raised between the two lines above
                return
            try:
                chunk = self.kernel.run(self.ensemble.rows(*self.table.bounds(index)), control)
            except BaseException as error:  # carried over to the caller's thread
                self.results.put((index, error))
                return
            self.results.put((index, chunk))

    def stop(self) -> None:
        """Let no thread begin another chunk, and stop the runs that are being worked on."""
        self.stopping = True
        for control in self.controls:
            control[abi.STOP] = 1
        for _ in self.threads:
            self.places.release()

    def running(self) -> int:
        """Return how many runs of unfinished chunks are done."""
        return int(sum(control[RUNS_DONE] for control in self.controls))

    def finished(self, beat: Callable[[], None]) -> Iterator[tuple[int, Chunk]]:
        """Yield chunks as they are done; `beat` is called while there are none."""
        outstanding = len(self.table.missing())
        while outstanding:
            try:
                index, chunk = self.results.get(timeout=_BEAT)
            except queue.Empty:
                beat()
                continue
            self.places.release()
            if isinstance(chunk, BaseException):
                raise chunk
            outstanding -= 1
            if chunk.complete:
                yield index, chunk

    def rest(self) -> Iterator[tuple[int, Chunk]]:
        """Yield what was finished before the threads stopped."""
        for thread in self.threads:
            if thread.ident is not None:
                thread.join()
        while not self.results.empty():
            index, chunk = self.results.get()
            if isinstance(chunk, Chunk) and chunk.complete:
                yield index, chunk


def run_here(
    ensemble: Ensemble, table: Table, jobs: int | None, progress: Callable[[float], None] | None = None
) -> bool:
    """Run all chunks that the table does not hold yet.

    Parameters
    ----------
    ensemble, table : Ensemble, Table
        What to run, and what gets each chunk as soon as it is there.
    jobs : int or None
        Threads; None: one for every core.
    progress : callable, optional
        Called about ten times a second with the number of runs that are done.

    Returns
    -------
    bool
        Whether a KeyboardInterrupt ended it early; finished chunks are in the table then, and no others.
    """
    missing = len(table.missing())
    if not missing:
        return False
    pool = _Pool(ensemble, table, max(1, min(missing, jobs or processors())))
    interrupted = False
    try:
        pool.kernel.warm()
        for thread in pool.threads:
            thread.start()
        for index, chunk in pool.finished(lambda: progress(table.runs_done + pool.running()) if progress else None):
            table.put(index, chunk)
            if progress is not None:
                progress(table.runs_done)
    except KeyboardInterrupt:
        interrupted = True
    finally:
        pool.stop()
        for index, chunk in pool.rest():
            if index not in table.finished:
                table.put(index, chunk)
    return interrupted
