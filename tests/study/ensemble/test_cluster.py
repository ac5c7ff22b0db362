"""Ensembles on a Dask cluster of several processes: the same bits, with a worker killed in the middle."""

import os
import signal
import threading
import time

import numpy as np
import pytest

import symgen
from symgen.base.errors import InputError
from symgen.compile.store.paths import cache_root
from symgen.study.ensemble.cluster import connect_scheduler

MANY = {"vary": {"crank_mass": "lin(1, 3, 60)", "coupler_mass": "values(6, 8)"}, "until": 4.0, "quantities": ("q",)}


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    """Three processes of one thread, with caches of their own: what they run has to reach them as source."""
    distributed = pytest.importorskip("distributed")
    cache = tmp_path_factory.mktemp("cache-of-workers")
    before = os.environ["SYMGEN_CACHE_DIR"]
    os.environ["SYMGEN_CACHE_DIR"] = str(cache)
    try:
        made = distributed.LocalCluster(
            n_workers=3, threads_per_worker=1, processes=True, dashboard_address=":0", silence_logs=50
        )
    finally:
        os.environ["SYMGEN_CACHE_DIR"] = before
    with made, distributed.Client(made) as client:
        yield client, cache


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_a_lost_worker_loses_nothing_and_the_bits_are_those_of_one_machine(cluster):
    client, cache = cluster
    assert cache_root() != cache
    here = symgen.sweep("four-bar", **MANY)
    chunks = -(-len(here) // here.ensemble.chunk)
    assert chunks > 8
    reached: list[float] = []
    killed: list[int] = []

    def kill_one():
        """Kill a worker that is computing, once some chunks are there."""
        while not killed:
            if len(reached) >= 3:
                victim = sorted(client.run(os.getpid).values())[0]
                os.kill(victim, signal.SIGKILL)
                killed.append(victim)
            time.sleep(0.01)

    thread = threading.Thread(target=kill_one)
    thread.start()
    there = symgen.sweep("four-bar", **MANY, scheduler=client, progress=lambda done, total: reached.append(done))
    thread.join()
    assert killed and len(reached) == chunks  # every chunk arrived, and none twice
    assert reached == sorted(set(reached)) and reached[-1] == len(here)
    np.testing.assert_array_equal(there.values, here.values)
    np.testing.assert_array_equal(there.summary, here.summary)
    assert there.counts == here.counts == {"ok": 120, "unverified": 0, "failed": 0, "not run": 0}
    assert list((cache / "models").glob("four-bar_*/direct_correction*.py"))


@pytest.mark.by_turns(4)
@pytest.mark.slow
def test_an_address_will_do_and_rows_that_fail_are_rows(cluster, tmp_path):
    client, _ = cluster
    masses = {"crank_mass": [2.0, -1.0, 3.0], "coupler_mass": [8.0, 1e-9]}
    settings = {"vary": masses, "until": 0.02, "method": "coordinate-partitioning"}
    there = symgen.sweep("four-bar", **settings, scheduler=client.scheduler.address, output=tmp_path / "there.nc")
    here = symgen.sweep("four-bar", **settings)
    np.testing.assert_array_equal(there.values, here.values)
    np.testing.assert_array_equal(there.status, here.status)
    assert list(there["light"].ravel()) == [0, 1, 0, 0, 0, 1]
    assert [path.name for path in tmp_path.iterdir()] == ["there.nc"]


def test_an_address_where_nothing_is_gets_one_sentence(monkeypatch):
    distributed = pytest.importorskip("distributed")

    def refuse(*arguments, **options):
        raise OSError("Timed out trying to connect to tcp://127.0.0.1:1 after 10 s")

    monkeypatch.setattr(distributed, "Client", refuse)
    with pytest.raises(InputError, match=r"scheduler: expected the address of a running Dask scheduler.*127.0.0.1:1"):
        connect_scheduler("tcp://127.0.0.1:1")
