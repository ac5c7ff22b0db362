"""Files of other systems' examples: each belongs to a line of the record and runs."""

import json
import shutil
import tomllib
from pathlib import Path

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen
from benchmarks import sayable
from benchmarks.said import SAID
from benchmarks.said_in_files import AT_REST, DOUBTED, IN_JOINTS
from benchmarks.said_parts import PARTS, write_parts

#: Examples with the same smallest form are run once; a flexible one has a file of parts of its own.
FIRST = {(json.dumps(SAID[name], sort_keys=True), name in IN_JOINTS): name for name in reversed(SAID)}


def test_each_file_is_of_an_example_that_can_be_said() -> None:
    verdicts = {f"{x.group}/{x.name}": x.after for x in sayable.examples()}
    assert all(verdicts[name] in "SH" for name in SAID)


@pytest.mark.by_turns(7)
@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(FIRST.values()))
def test_a_file_runs(name: str, tmp_path: Path) -> None:
    """Its motion, of a table a moment of it, is finite and as good as its tolerances; or it has an equilibrium.

    Where a source loads a flexible body beyond linear modes, as other programs do without a word, the run says so.
    """
    file = SAID[name]
    if name in PARTS and isinstance(file, str):
        file = shutil.copy(file, tmp_path)
        write_parts(name, tmp_path)
    model = symgen.load(file) if isinstance(file, str) else symgen.Model(mechanism_of(file))
    if name in AT_REST:
        assert all(np.isfinite(value) for value in model.equilibrium().q.values())
        return
    until = 0.2
    if isinstance(file, str) and file.endswith(".toml"):
        until = tomllib.loads(Path(file).read_text(encoding="utf-8"))["run"]["until"]
    run = model.simulate(until=until, coordinates="joint" if name in IN_JOINTS else "auto")
    if name in DOUBTED:
        assert run.status == "unverified" and "linear modes" in str(run.reason)
    else:
        assert run.ok, run.status
    assert np.all(np.isfinite(run.q.values)) and run.t[-1] == until
