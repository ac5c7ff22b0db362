"""A Dask cluster as `docs/sweeps.md` has it: a scheduler by its address, workers, and what is left when they die."""

import re
import socket
from contextlib import ExitStack

import numpy as np
import pytest

import symgen
from tests.processes.programs import Program, chunks, command_of

ROWS = 20_000
PAGE = "sweeps.md"


def words_of(beginning, port):
    """Return a command of the page, for the loopback interface."""
    found = command_of(PAGE, beginning, "" if beginning == "dask scheduler" else "tcp://host:8786").replace(
        "tcp://host:8786", f"tcp://127.0.0.1:{port}"
    )
    return found.replace('"', "").split()


def free_port():
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]


class Cluster:
    """A scheduler and two workers, as three processes."""

    def __init__(self, folder, number, programs):
        port = free_port()
        here = ("--host", "127.0.0.1", "--no-dashboard")
        more = {"SYMGEN_CACHE_DIR": str(folder / "cache-of-workers")}
        words = [*words_of("dask scheduler", port), *here, "--port", port]
        self.scheduler = programs.enter_context(Program(words, folder / f"scheduler-{number}.txt"))
        self.scheduler.wait_for(lambda: "Scheduler at:" in self.scheduler.said())
        assert re.search(rf"Scheduler at: +tcp://127.0.0.1:{port}\b", self.scheduler.said()), "it prints its address"
        words = [*words_of("dask worker", port), *here]
        self.workers = [
            programs.enter_context(Program(words, folder / f"worker-{number}-{k}.txt", **more)) for k in range(2)
        ]
        for worker in self.workers:
            worker.wait_for(lambda worker=worker: "Registered to:" in worker.said())
        sweep = words_of("symgen sweep", port)
        assert sweep[-2:] == ["-o", "large.nc"]
        self.sweep = [*(word.replace("100000", str(ROWS)) for word in sweep[:-1]), "folder"]


@pytest.mark.by_turns(4)
@pytest.mark.slow
def test_no_row_is_lost_or_computed_twice_by_a_lost_worker_and_a_lost_scheduler(tmp_path):
    folder = tmp_path / "folder"
    with ExitStack() as programs:
        first = Cluster(tmp_path, 1, programs)
        sweep = programs.enter_context(Program(first.sweep, tmp_path / "sweep-1.txt"))
        sweep.wait_for(lambda: len(chunks(folder)) >= 5)
        first.workers[0].kill()
        reached = len(chunks(folder))
        sweep.wait_for(lambda: len(chunks(folder)) >= reached + 5)
        first.scheduler.kill()
        assert sweep.end() == 1
        before = chunks(folder)
        (said,) = sweep.said().splitlines()
        assert re.fullmatch(r"symgen: the cluster could not compute chunk \d+: the connection .* was lost", said)

        second = Cluster(tmp_path, 2, programs)
        again = programs.enter_context(Program([*second.sweep, "--resume"], tmp_path / "sweep-2.txt"))
        assert again.end() == 0, again.said()
        assert f"ok: {ROWS}" in again.said()
    after = chunks(folder)
    assert after[: len(before)] == before and len(before) < len(after)
    assert sorted(after) == [*range(len(after))]
    there = {name: np.load(folder / f"{name}.npy") for name in ("values", "summary")}
    here = symgen.sweep("four-bar", {"crank_mass": f"lin(1,3,{ROWS})"})
    np.testing.assert_array_equal(there["values"], here.values)
    np.testing.assert_array_equal(there["summary"], here.summary)


@pytest.mark.slow
def test_a_small_sweep_on_a_scheduler_by_its_address(tmp_path):
    """Of fewer chunks than are handed out at once; from Python the address is a text as well."""
    with ExitStack() as programs:
        cluster = Cluster(tmp_path, 1, programs)
        address = cluster.sweep[cluster.sweep.index("--scheduler") + 1]
        there = symgen.sweep("four-bar", {"crank_mass": [1.0, 2.0]}, until=0.1, scheduler=address)
    here = symgen.sweep("four-bar", {"crank_mass": [1.0, 2.0]}, until=0.1)
    np.testing.assert_array_equal(there.values, here.values)
