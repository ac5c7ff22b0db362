"""Chunks run by the workers of a Dask cluster: modules travel as source, results stream back, a lost worker loses none.

The scheduler hands a chunk whose worker was lost to another one. Rows are written here alone, once for every chunk.
"""

from __future__ import annotations

import logging
from asyncio import CancelledError
from collections.abc import Callable
from contextlib import suppress
from secrets import token_hex
from typing import TYPE_CHECKING, Any

from symgen.base.errors import InputError, SimulationError
from symgen.base.plugins import explain_plugin_errors, load_plugins
from symgen.study.ensemble.chunks import Chunk, Rows
from symgen.study.ensemble.kernel import kernel_of_recipe, new_control
from symgen.study.ensemble.recipe import Recipe, run_code_identity

if TYPE_CHECKING:
    from distributed import Client

    from symgen.study.ensemble.ensemble import Ensemble
    from symgen.study.ensemble.table import RowTable

#: Chunks handed out for every thread of the cluster: enough to keep it busy, few enough for its memory.
_AHEAD = 4
#: A chunk is handed out again this often after workers died over it.
_ATTEMPTS = 5


def connect_scheduler(address: str) -> Client:
    """Return a client of a scheduler.

    Raises
    ------
    InputError
        If there is none, or the library is missing.
    """
    from symgen.base.files import need_library

    need_library("scheduler", "distributed", extra="dask")
    from distributed import Client

    # a scheduler that goes while it computes is one sentence of ours, not a traceback of the library
    for name in ("distributed.batched", "distributed.client"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    try:
        return Client(address, timeout=10, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        why = str(error).splitlines()[0] if str(error) else "nothing there"
        raise InputError(
            "scheduler", "the address of a running Dask scheduler, such as tcp://host:8786", f"'{address}' ({why})"
        ) from None


def receive_recipe(recipe: Recipe) -> Recipe:
    """Return a recipe on a worker; were that one lost, the scheduler would do this again elsewhere."""
    return recipe


@explain_plugin_errors
def run_chunk(recipe: Recipe, rows: Rows) -> Chunk:
    """Run a chunk on a worker, which compiles once for a recipe.

    Raises
    ------
    SimulationError
        If the worker has another version of symgen.
    """
    load_plugins(recipe.plugins)
    if recipe.code != run_code_identity():
        raise SimulationError("a worker of the cluster has another version of symgen")
    kernel = kernel_of_recipe(recipe)
    kernel.compile_all()
    return kernel.run(rows, new_control())


def run_on_cluster(
    ensemble: Ensemble, table: RowTable, client: Client, progress: Callable[[float], None] | None = None
) -> bool:
    """Run all chunks that the table does not hold yet on a cluster.

    Parameters
    ----------
    ensemble, table : Ensemble, Table
        As for `symgen.study.ensemble.parameter_sweep.run_here`.
    client : Client
        Of the cluster; stays open.
    progress : callable, optional
        Called after each chunk with the number of runs that are done.

    Raises
    ------
    SimulationError
        If the cluster has no workers, or lost one after the other over the same chunk.
    """
    from distributed import as_completed

    waiting = iter(table.missing_chunks())
    recipe = client.submit(receive_recipe, ensemble.recipe, pure=False)
    attempts: dict[Any, tuple[int, int]] = {}

    def hand_out(index: int, attempt: int) -> Any:
        rows = ensemble.rows(*table.bounds_of_chunk(index))
        try:
            future = client.submit(run_chunk, recipe, rows, pure=False, key=f"symgen-chunk-{index}-{token_hex(8)}")
        except (Exception, CancelledError) as error:  # of a scheduler that has gone
            raise _sentence_of_failure(client, index, error) from None
        attempts[future.key] = (index, attempt)
        return future

    threads = sum(client.nthreads().values())
    if not threads:
        raise SimulationError("the cluster has no workers")
    first = [hand_out(index, 1) for _, index in zip(range(_AHEAD * threads), waiting, strict=False)]
    completed = as_completed(first, loop=client.loop)  # else of the default client, which this one need not be
    try:
        for future in completed:
            index, attempt = attempts.pop(future.key)
            result = _chunk_or_reason(future)
            if isinstance(result, Chunk):
                table.keep_chunk(index, result)
                if progress is not None:
                    progress(table.runs_done)
                following, attempt = next(waiting, None), 0
                if following is None:
                    continue
                index = following
            elif isinstance(result, SimulationError | InputError):
                raise result
            elif attempt >= _ATTEMPTS or client.status != "running":
                raise _sentence_of_failure(client, index, result)
            completed.add(hand_out(index, attempt + 1))
    except KeyboardInterrupt:
        return True
    finally:
        with suppress(Exception):  # of a scheduler that has gone
            client.cancel([*completed.futures, recipe])
    return False


def _sentence_of_failure(client: Client, index: int, error: BaseException) -> SimulationError:
    """Return the sentence for a chunk that is not computed."""
    why = (str(error) or type(error).__name__).splitlines()[0]
    if client.status != "running":
        why = "the connection to the scheduler was lost"
    return SimulationError(f"the cluster could not compute chunk {index}: {why}")


def _chunk_or_reason(future: Any) -> Chunk | BaseException:
    """Return a chunk, or why there is none: its task failed, or what it gave was lost on the way here."""
    try:
        chunk: Chunk = future.result(timeout=60)
    except (Exception, CancelledError) as error:
        return error
    return chunk
