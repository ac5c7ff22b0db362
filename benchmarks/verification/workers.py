"""Processes for work that may crash, hang or eat memory: each job is answered, whatever happens to its process."""

from __future__ import annotations

import multiprocessing
import os
import resource
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnProcess
from pathlib import Path
from typing import Any

#: What every process gets: one thread for linear algebra, as there is a process for every core.
THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")


@dataclass(frozen=True)
class Answer:
    """What became of a job.

    Attributes
    ----------
    job : Any
        The job.
    value : Any
        What the function returned; None where it did not return.
    died : str
        ``""``, or how the process ended: a time limit, a signal, an exit code.
    """

    job: Any
    value: Any
    died: str = ""


class _Worker:
    """One process and the pipe to it."""

    def __init__(self, function: Callable[[Any], Any], memory: int) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self.process: SpawnProcess = context.Process(target=_serve, args=(function, theirs, memory), daemon=True)
        self.process.start()
        theirs.close()
        self.job: Any = None
        self.since = self.used = 0.0
        self.busy = False

    def send(self, job: Any) -> None:
        self.job, self.since, self.used, self.busy = job, time.monotonic(), self.processor(), True
        self.pipe.send(job)

    def processor(self) -> float:
        """Return the processor time of the process so far [s]: what a busy machine does not make longer."""
        try:
            fields = Path(f"/proc/{self.process.pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
        except OSError:  # a system without it, or a process that has ended
            return time.monotonic()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def stop(self) -> None:
        self.process.kill()
        self.process.join()
        self.pipe.close()


def _serve(function: Callable[[Any], Any], pipe: Connection, memory: int) -> None:
    if memory:
        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    while True:
        try:
            job = pipe.recv()
        except EOFError:
            return
        pipe.send(function(job))


def answers(
    function: Callable[[Any], Any],
    jobs: Iterable[Any],
    workers: int,
    seconds: float,
    memory: int = 0,
    worn: Callable[[Any], bool] = lambda value: False,
) -> Iterator[Answer]:
    """Yield an answer for every job as they come.

    Parameters
    ----------
    function : callable
        Of a module, called with a job in one of the processes.
    jobs : iterable
        What to call it with; anything that can be pickled.
    workers : int
        Number of processes.
    seconds : float
        A job that takes more of the processor, or twenty times that of the clock, is given up and its process ended.
    memory : int
        Address space that a process may have [bytes]; 0 for no limit.
    worn : callable
        Says of a value whether the process that gave it shall be replaced.
    """
    for name in THREADS:
        os.environ.setdefault(name, "1")
    waiting = iter(jobs)
    pool = [_Worker(function, memory) for _ in range(workers)]
    try:
        for worker in pool:
            _next(worker, waiting)
        while any(worker.busy for worker in pool):
            wait([w.pipe for w in pool if w.busy], timeout=0.2)
            for k, worker in enumerate(pool):
                if not worker.busy:
                    continue
                answer = _answer(worker, seconds)
                if answer is None:
                    continue
                if answer.died or worn(answer.value):
                    worker.stop()
                    worker = pool[k] = _Worker(function, memory)
                worker.busy = False
                _next(worker, waiting)
                yield answer
    finally:
        for worker in pool:
            worker.stop()


def _next(worker: _Worker, waiting: Iterator[Any]) -> None:
    job = next(waiting, None)
    if job is not None:
        worker.send(job)


def _answer(worker: _Worker, seconds: float) -> Answer | None:
    """Return what a busy worker has to say, None while it works."""
    try:
        if worker.pipe.poll():
            return Answer(worker.job, worker.pipe.recv())
    except (EOFError, ConnectionError, OSError):
        worker.process.join(5.0)
        code = worker.process.exitcode
        return Answer(worker.job, None, f"signal {-code}" if code is not None and code < 0 else f"exit code {code}")
    if worker.processor() - worker.used > seconds or time.monotonic() - worker.since > 20.0 * seconds:
        return Answer(worker.job, None, f"no end within {seconds:g} s")
    return None
