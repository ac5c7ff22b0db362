"""How often compiled code was found in the cache, and what compiling and loading cost."""

from __future__ import annotations

from typing import TypedDict


class CacheStats(TypedDict):
    """Counters of this process since it started; take the difference of two for one run.

    `compile_seconds` holds translation by Numba, writing to the cache, and waiting for another process that does both,
    `load_seconds` reading from it. Functions that are compiled or loaded while another one is being compiled are
    counted in `hits` and `misses`, and their seconds belong to the outer one, so no second is counted twice. Of the
    functions of emitted modules, `translated` counts those whose machine code was made from their source, `foreign`
    those that were left to Numba (`symgen.store.emitted`).
    """

    hits: int
    misses: int
    translated: int
    foreign: int
    compile_seconds: float
    load_seconds: float


# One for the process: written only under Numba's compiler lock.
counters = CacheStats(hits=0, misses=0, translated=0, foreign=0, compile_seconds=0.0, load_seconds=0.0)


def cache_stats() -> CacheStats:
    """Return a copy of the counters of this process."""
    return counters.copy()


def seconds_in_cache() -> float:
    """Return the seconds that this process has spent compiling or loading compiled code."""
    return counters["compile_seconds"] + counters["load_seconds"]
