"""A loop that a second process compiles is found by the first one, and its failure costs nothing but time."""

from __future__ import annotations

import pytest

from symgen import load
from symgen.running.prepare import prepare
from symgen.settings import Settings
from symgen.store import ahead

METHODS = {"generalized-alpha": "generalized-alpha"}

#: Starts a compilation, uses the function, and prints what came of it.
SCRIPT = """\
import json
from symgen.store import ahead
from symgen.store.jit import cache_stats
import loops

ahead.processors = lambda: 2
started = ahead.start(loops.never_called)
process = ahead._running.get("loops:never_called")
value = loops.never_called(2.0)
if process is not None:
    process.wait()
print(json.dumps({"value": value, "started": started, "again": ahead.start(loops.never_called), **cache_stats()}))
"""


def test_finds_in_the_cache_what_the_other_process_compiled(cache, generated, python):
    first = python(SCRIPT)
    assert first["started"] and first["value"] == 6.0
    assert (first["hits"], first["misses"]) == (1, 0) and not first["again"]
    later = python(SCRIPT)
    assert not later["started"] and (later["hits"], later["misses"]) == (1, 0)


def test_compiles_by_itself_where_the_other_process_fails(cache, generated, python, tmp_path):
    library = tmp_path / "library" / "loops.py"
    # only the second process, whose program is another one, cannot import the library
    library.write_text("import sys\nassert sys.argv[0] == '-c'\n" + library.read_text())
    found = python(SCRIPT)
    assert found["started"] and found["value"] == 6.0
    assert (found["hits"], found["misses"]) == (0, 1)


def test_starts_nothing_without_gain(cache, generated, python, tmp_path):
    alone = python(SCRIPT.replace("lambda: 2", "lambda: 1"))
    assert not alone["started"] and alone["value"] == 6.0 and alone["misses"] == 1
    embedded = SCRIPT.replace("started =", "ahead.sys.executable = '/usr/bin/modeller'\nstarted =", 1)
    inside = python(embedded, SYMGEN_CACHE_DIR=str(tmp_path / "other"))
    assert not inside["started"] and inside["value"] == 6.0 and inside["misses"] == 1
    plain = python(SCRIPT.replace("again", "ignored"), NUMBA_DISABLE_JIT="1")
    assert not plain["started"] and plain["value"] == 6.0
    assert not ahead.start(None) and not ahead.start(len)


@pytest.mark.parametrize("integrator", ["rk4", "dopri5", "abm", "rkmk4", "radau5", "generalized-alpha"])
def test_integrators_name_the_loop_that_they_enter(integrator):
    model = load("pendulum")
    run = prepare(model.mechanism, Settings(integrator=integrator, method=METHODS.get(integrator, "lagrange")))
    setup = run.plan.integrator.setup(run.compiled, run.spec, run.start.w)
    assert run.plan.integrator.loop(run.spec.adaptive) is setup.loop
