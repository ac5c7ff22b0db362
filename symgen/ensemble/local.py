"""Chunks run by threads of this process: the loops hold no lock, so each thread keeps a core busy."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from itertools import islice
from queue import SimpleQueue
from typing import TYPE_CHECKING

from symgen.ensemble.chunks import Chunk
from symgen.ensemble.kernel import Integers, kernel_of, new_control
from symgen.memory import processors
from symgen.runtime import abi
from symgen.runtime.ensemble_abi import RUNS_DONE

if TYPE_CHECKING:
    from symgen.ensemble.sweep_plan import Ensemble
    from symgen.ensemble.table import RowTable

#: How often progress is shown while no chunk ends [s].
_BEAT = 0.1
#: Chunks that are handed out for every thread: no more results than these wait for being written.
_AHEAD = 3


def run_here(
    ensemble: Ensemble, table: RowTable, jobs: int | None, progress: Callable[[float], None] | None = None
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
    missing = table.missing()
    if not missing:
        return False
    kernel, jobs = kernel_of(ensemble.recipe), max(1, min(len(missing), jobs or processors()))
    controls, free = [new_control() for _ in range(jobs)], SimpleQueue[Integers]()
    for control in controls:
        free.put(control)
    stopping = interrupted = False

    def work(index: int) -> Chunk | None:
        control = free.get()
        control[:] = 0
        try:  # it may have been stopped before the line above
            return None if stopping else kernel.run(ensemble.rows(*table.bounds(index)), control)
        finally:
            free.put(control)

    def put(index: int, chunk: Chunk | None) -> None:
        if chunk is not None and chunk.complete:
            table.put(index, chunk)

    waiting, handed = iter(missing), dict[Future[Chunk | None], int]()
    with ThreadPoolExecutor(jobs, "symgen-sweep") as pool:
        try:
            kernel.warm()
            while True:
                handed |= {pool.submit(work, index): index for index in islice(waiting, _AHEAD * jobs - len(handed))}
                if not handed:
                    break
                done, _ = wait(handed, _BEAT, FIRST_COMPLETED)
                for future in done:
                    chunk = future.result()
                    put(handed[future], chunk)
                    del handed[future]
                if progress is not None:
                    running = 0 if done else sum(int(control[RUNS_DONE]) for control in controls)
                    progress(table.runs_done + running)
        except KeyboardInterrupt:
            interrupted = True
        finally:
            stopping = True  # no other chunk begins, and the runs that are being worked on end
            for control in controls:
                control[abi.STOP] = 1
            for future in wait(handed).done:  # what was finished meanwhile
                if handed[future] not in table.finished and future.exception() is None:
                    put(handed[future], future.result())
    return interrupted
