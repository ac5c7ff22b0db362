"""Parameter studies: ``symgen.sweep``, the Python side of ``symgen sweep``."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import ExitStack
from functools import partial
from itertools import islice
from os import PathLike
from pathlib import Path
from queue import SimpleQueue
from typing import TYPE_CHECKING, Any, Unpack

from numpy.typing import ArrayLike

from symgen.base import arguments
from symgen.base.errors import InputError
from symgen.base.files import check_path
from symgen.base.keywords import RunKeywords, make_entry
from symgen.base.memory import processor_count, require_disk, require_memory
from symgen.base.settings import Settings, change_settings
from symgen.run.layout import abi
from symgen.run.layout.ensemble_abi import N_SUMMARY, RUNS_DONE
from symgen.study.ensemble.axes import RUN_SIZE
from symgen.study.ensemble.chunks import Chunk
from symgen.study.ensemble.ensemble import Ensemble
from symgen.study.ensemble.kernel import Integers, kernel_of_recipe, new_control
from symgen.study.ensemble.sweep_plan import make_ensemble
from symgen.study.ensemble.sweep_study import SAVED, Sweep
from symgen.study.ensemble.table import FolderTable, RowTable, check_folder

if TYPE_CHECKING:
    from distributed import Client

    from symgen.api import Model
    from symgen.describe.mechanism import Mechanism

#: The folder beside a file in which its runs are collected until it is written.
PARTS = ".parts"
#: Threads at most.
MOST_JOBS = 4096


@make_entry
def sweep(
    model: str | Path | Mechanism | Model,
    vary: Mapping[str, ArrayLike | str] | None = None,
    *,
    runs: Mapping[str, ArrayLike | str] | None = None,
    quantities: Sequence[str] | None = None,
    output: str | PathLike[str] | None = None,
    resume: bool = False,
    jobs: int | None = None,
    scheduler: str | Client | None = None,
    target: str = "cpu",
    settings: Settings | None = None,
    progress: Callable[[float, int], None] | None = None,
    **changes: Unpack[RunKeywords],
) -> Sweep:
    """Run a model for every combination of values, on all cores, on a CUDA device or on a Dask cluster.

    Parameters
    ----------
    model : str, Path, Mechanism or Model
        An argument of `symgen.load`, or its result.
    vary : mapping
        Name -> values: an array, or a text such as ``"lin(1, 3, 21)"``, ``"log(0.1, 10, 21)"``, ``"values(1, 2, 5)"``
        or ``"uniform(0, 1, 100, 7)"``. Names are parameters, and coordinates and velocities of bodies and joints at
        the start (``crank.theta``, ``crank.omega``, ``motor.angle``): a coordinate that varies is held while
        the others are closed; and parameters of the method (``method.alpha``). Each name is a dimension of the grid.
    runs : mapping, optional
        The same for names that vary together, all with as many values: one dimension, ``run``.
    quantities : sequence of str, optional
        Quantities to keep: ``crank.theta``, ``crank`` (all of a body), ``q``, ``v``, ``energy``, ...; ``event`` or
        ``event.NAME``, what happened; by default all coordinates and velocities. ``max(crank.omega)``, ``min``,
        ``range``, ``mean``, ``rms`` and ``peak``, the largest size, leave one number of a run's outputs. Memory grows
        with these and with the output times alone.
    output : path, optional
        ``.nc``: a NetCDF file; ``.csv``: a line for every run and time, with units in the heading; both with the
        folder ``<file>.parts`` beside them until all runs are done. Otherwise a folder.
        Finished runs survive an interruption and a kill.
    resume : bool
        Continue what an earlier call began at `output`.
    jobs : int, optional
        Threads; by default one for every core.
    scheduler : str or Client, optional
        Address of a Dask scheduler, or a client: its workers run the ensemble.
    target : {"cpu", "lanes", "cuda"}
        Target: all cores, one run after the other; all cores, several runs at once in vector instructions
        (constant steps); or a CUDA device (extra ``cuda``). Starts are closed on all cores.
    settings : Settings, optional
        Settings of each run.
    progress : callable, optional
        Called about ten times a second with the runs done and all.
    **changes
        Single settings by name, as listed above. Without ``times`` or ``output_step``, only the end of each run is
        kept. ``verify`` and ``repeat`` are for single runs.

    Returns
    -------
    Sweep
        Also after an interruption; failed runs are rows with status and reason.

    Raises
    ------
    InputError
        If a name, number, file or combination is wrong.
    SimulationError
        If results cannot be written, or the cluster gives up.
    """
    from symgen.api import load
    from symgen.study.ensemble.device_runs import check_target

    check_target(target, scheduler)
    jobs = None if jobs is None else arguments.whole_number("jobs", jobs, 1, MOST_JOBS)
    resume = arguments.truth_value("resume", resume)
    arguments.callable_or_none("progress", progress)
    if scheduler is not None and not isinstance(scheduler, str) and not hasattr(scheduler, "submit"):
        expected = "the address of a Dask scheduler, or a client"
        raise InputError("scheduler", expected, arguments.kind_of_value(scheduler))
    varied = {
        what: arguments.mapping(what, values, "values by the names of what varies")
        for what, values in (("vary", vary), ("runs", runs))
    }
    names = None if quantities is None else arguments.words("quantities", quantities)
    path = None if output is None else arguments.path_argument("output", output)
    folder = None if path is None else output_folder(path, resume)
    if resume and path is None:
        raise InputError("resume", "an output that was begun", "none")
    ensemble = make_ensemble(
        load(model), change_settings(settings, changes), varied["vary"], varied["runs"], names, target
    )
    _check_room(ensemble, path, folder)
    return _collect_results(ensemble, path, folder, resume, jobs, scheduler, progress)


def _collect_results(
    ensemble: Ensemble,
    path: Path | None,
    folder: Path | None,
    resume: bool,
    jobs: int | None,
    scheduler: str | Client | None,
    progress: Callable[[float, int], None] | None,
) -> Sweep:
    """Return the results of an ensemble, collected in a folder where there is one, and written to a file."""
    table = (
        RowTable(*ensemble.sizes)
        if folder is None
        else FolderTable(folder, ensemble.description, ensemble.sizes, resume)
    )
    with table:
        seconds, interrupted = _run_missing(ensemble, table, jobs, scheduler, progress)
        study = Sweep(ensemble, table.values, table.summary, table.runs_done_mask(), seconds, interrupted)
        if path is not None and path != folder and not interrupted:
            study.save(path)
            assert isinstance(table, FolderTable), "an output has a folder"
            table.remove()
    return study


def _check_room(ensemble: Ensemble, path: Path | None, folder: Path | None) -> None:
    """Refuse an ensemble whose rows do not fit where they are collected."""
    runs, quantities, times, _, further = ensemble.sizes
    what = f"{runs:g} runs, each with {quantities} quantities at {times} times"
    rows = 8.0 * runs * (quantities * times + N_SUMMARY + further)
    if folder is None:
        require_memory("sweep", what, rows + RUN_SIZE * runs)
    else:
        require_disk(f"folder '{folder}'", folder.parent, what, rows)
    if path is not None and path != folder:  # a file is made in memory, from the rows and their descriptions
        require_memory(f"output '{path}'", what, 2.0 * (rows + RUN_SIZE * runs))


def _run_missing(
    ensemble: Ensemble,
    table: RowTable,
    jobs: int | None,
    scheduler: str | Client | None,
    progress: Callable[[float, int], None] | None,
) -> tuple[float, bool]:
    """Run what is missing; return seconds, and whether it was interrupted."""
    show = None if progress is None else lambda done: progress(done, len(ensemble))
    with ExitStack() as clients:
        if scheduler is None:
            if table.missing_chunks():
                kernel_of_recipe(ensemble.recipe).compile_all()
            run = partial(run_here, ensemble, table, jobs)
        else:
            from symgen.study.ensemble.cluster import connect_scheduler, run_on_cluster

            client: Any = (
                clients.enter_context(connect_scheduler(scheduler)) if isinstance(scheduler, str) else scheduler
            )
            run = partial(run_on_cluster, ensemble, table, client)
        began = time.perf_counter()
        interrupted = run(show)
        return time.perf_counter() - began, interrupted


def output_folder(path: Path, resume: bool) -> Path:
    """Return the folder in which the runs of an output are collected, after making sure that it can be used.

    Raises
    ------
    InputError
        If it cannot.
    """
    if not path.suffix:
        check_folder(path, resume)
        return path
    check_path("output", path, SAVED, "data")
    parts = path.with_name(path.name + PARTS)
    if resume and path.exists() and not parts.exists():
        hint = "leave `resume` out to compute it again"
        raise InputError(f"output '{path}'", "one that is not finished", "a finished one", hint)
    check_folder(parts, resume)
    return parts


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
        The runs, and the receiver of each finished chunk.
    jobs : int or None
        Threads; None: one for every core.
    progress : callable, optional
        Called about ten times a second with the number of runs that are done.

    Returns
    -------
    bool
        Whether a KeyboardInterrupt ended it early; finished chunks are in the table then, and no others.
    """
    missing = table.missing_chunks()
    if not missing:
        return False
    kernel, jobs = kernel_of_recipe(ensemble.recipe), max(1, min(len(missing), jobs or processor_count()))
    controls, free = [new_control() for _ in range(jobs)], SimpleQueue[Integers]()
    for control in controls:
        free.put(control)
    stopping = interrupted = False

    def run_chunks(index: int) -> Chunk | None:
        control = free.get()
        control[:] = 0
        try:  # it may have been stopped before the line above
            return None if stopping else kernel.run(ensemble.rows(*table.bounds_of_chunk(index)), control)
        finally:
            free.put(control)

    def keep_chunk(index: int, chunk: Chunk | None) -> None:
        if chunk is not None and chunk.complete:
            table.keep_chunk(index, chunk)

    waiting, futures = iter(missing), dict[Future[Chunk | None], int]()
    with ThreadPoolExecutor(jobs, "symgen-sweep") as pool:
        try:
            while True:
                futures |= {
                    pool.submit(run_chunks, index): index for index in islice(waiting, _AHEAD * jobs - len(futures))
                }
                if not futures:
                    break
                done, _ = wait(futures, _BEAT, FIRST_COMPLETED)
                for future in done:
                    chunk = future.result()
                    keep_chunk(futures[future], chunk)
                    del futures[future]
                if progress is not None:
                    running = 0 if done else sum(int(control[RUNS_DONE]) for control in controls)
                    progress(table.runs_done + running)
        except KeyboardInterrupt:
            interrupted = True
        finally:
            stopping = True  # no other chunk begins, and the runs that are being worked on end
            for control in controls:
                control[abi.STOP] = 1
            for future in wait(futures).done:  # what was finished meanwhile
                if futures[future] not in table.finished and future.exception() is None:
                    keep_chunk(futures[future], future.result())
    return interrupted
