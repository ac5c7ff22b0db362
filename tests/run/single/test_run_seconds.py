"""The seconds of a run: those of the loop, without what it compiles on its way."""

from types import SimpleNamespace

import numpy as np
import pytest

from symgen.compile.store import stats
from symgen.run.layout import abi
from symgen.run.single import run


def test_seconds_of_a_run_have_no_compilation_in_them(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [0.0]

    def enter(outputs: object) -> int:  # 3 s of loop, 8 s of a function that a change of modes asks for
        now[0] += 11.0
        stats.counters["compile_seconds"] += 7.5
        stats.counters["load_seconds"] += 0.5
        return abi.DONE

    monkeypatch.setattr(run, "time", SimpleNamespace(perf_counter=lambda: now[0]))
    monkeypatch.setattr(stats, "counters", stats.counters.copy())
    state = SimpleNamespace(clock=np.zeros(8), control=np.zeros(32, dtype=np.int64))
    code, seconds, _, interrupted = run._in_thread(SimpleNamespace(enter=enter, state=state), (), None)  # type: ignore[arg-type]  # a stub
    assert (code, seconds, interrupted) == (abi.DONE, 3.0, False)
