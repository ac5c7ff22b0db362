"""Numbers of cache hits and misses of compiled code, and times of compilation and loading."""

from __future__ import annotations

import os
import threading
import time
from typing import Self, TypedDict

#: Processor time of the calling thread [s], which the load of the machine changes little; elapsed time where a system
#: counts it coarsely or not at all.
CPU_CLOCK = getattr(time, "thread_time", time.perf_counter) if os.name == "posix" else time.perf_counter


class CacheStats(TypedDict):
    """Counters of this process since its start; the difference of two belongs to the run between them.

    `compile_seconds` holds translation and writing to the cache, `load_seconds` reading from it. Functions that are
    compiled or loaded while another one is being compiled are counted in `hits` and `misses`, and their seconds belong
    to the outer one, so no second is counted twice.
    """

    hits: int
    misses: int
    compile_seconds: float
    load_seconds: float


# One for the process: written only by the thread that compiles.
counters = CacheStats(hits=0, misses=0, compile_seconds=0.0, load_seconds=0.0)


#: Processor time of this thread in compilation or loading [s].
_here = threading.local()


def cache_stats() -> CacheStats:
    """Return a copy of the counters of this process."""
    return counters.copy()


def seconds_in_cache() -> float:
    """Return the seconds of this process in compilation or loading of compiled code."""
    return counters["compile_seconds"] + counters["load_seconds"]


def processor_seconds_in_cache() -> float:
    """Return the processor time of the calling thread in compilation or loading of compiled code [s]."""
    return float(getattr(_here, "processor", 0.0))


class CompilationClock:
    """Counts the compilation or loading of one function, and adds the time unless an outer clock is running.

    Attributes
    ----------
    loaded : bool
        Set inside if the function was cached.
    seconds : float
        Time spent inside, set at the end.
    """

    loaded = False
    seconds = 0.0

    def __enter__(self) -> Self:
        self._outermost = not getattr(_here, "running", False)
        _here.running = True
        self._started, self._processor = time.perf_counter(), CPU_CLOCK()
        return self

    def __exit__(self, kind: type[BaseException] | None, *error: object) -> None:
        self.seconds = time.perf_counter() - self._started
        if kind is None:
            counters["hits" if self.loaded else "misses"] += 1
        if self._outermost:
            _here.running = False
            _here.processor = processor_seconds_in_cache() + CPU_CLOCK() - self._processor
            counters["load_seconds" if self.loaded else "compile_seconds"] += self.seconds
