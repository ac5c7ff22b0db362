"""Files of other systems' examples: each belongs to a line of the record and runs."""

import json

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen
from benchmarks import sayable
from benchmarks.said import SAID

#: Examples with the same smallest form are run once.
FIRST = {json.dumps(file, sort_keys=True): name for name, file in reversed(SAID.items())}


def test_each_file_is_of_an_example_that_can_be_said() -> None:
    verdicts = {f"{x.group}/{x.name}": x.after for x in sayable.examples()}
    assert all(verdicts[name] in "SH" for name in SAID)


@pytest.mark.by_turns(7)
@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(FIRST.values()))
def test_a_file_runs(name: str) -> None:
    """A moment of its motion is finite, and as good as its tolerances."""
    file = SAID[name]
    model = symgen.load(file) if isinstance(file, str) else symgen.Model(mechanism_of(file))
    run = model.simulate(until=0.2)
    assert run.ok, run.status
    assert np.all(np.isfinite(run.q.values)) and run.t[-1] == 0.2
