"""Events of runs, of C and of FMUs: effects have one source, and happen at the same times."""

import subprocess

import numpy as np
import pytest
from fmpy import simulate_fmu
from support.struck import STRUCK

from result.targets.compilers import compiled, written
from symgen import load
from symgen.result.targets import TARGETS, Request

#: Prints the time of the last event, then coordinates and velocities of bodies, at the end of steps of 1 ms.
MAIN = """
#include "{prefix}.h"
#include <stdio.h>
int main(void) {{
    static {prefix} model;
    {prefix}_real columns[{upper}_COLUMNS], outputs[{upper}_OUTPUTS];
    int event;
    {prefix}_init(&model);
    if ({prefix}_start(&model)) return 1;
    for (int k = 1; k <= {until} * 100; k++) {{
        if ({prefix}_advance(&model, k * 0.01, 1e-3, &event)) return 1;
        {prefix}_outputs(&model, model.t, model.y, outputs);
        {prefix}_bodies(&model, model.t, model.y, columns);
        for (int i = 0; i < {upper}_OUTPUTS; i++) printf("%.17g ", outputs[i]);
        for (int i = 0; i < {upper}_COLUMNS; i++) printf("%.17g ", columns[i]);
        printf("\\n");
    }}
    return 0;
}}
"""


def in_c(mechanism, folder, until, **keys):
    """Outputs and columns of a run in C, every 10 ms."""
    written(mechanism, folder, **keys)
    prefix = next(folder.glob("*.h")).stem
    (folder / "main.c").write_text(MAIN.format(prefix=prefix, upper=prefix.upper(), until=until))
    ran = subprocess.run([str(compiled(folder))], capture_output=True, text=True, check=True)
    return np.array([line.split() for line in ran.stdout.splitlines()], dtype=float)


def run_of(model, until, **keys):
    """The same of a run."""
    result = model.simulate(
        method="direct-correction", integrator="rk4", step=1e-3, until=until, output_step=0.01, shape="straight", **keys
    )  # fmt: skip
    assert result.ok, result.status
    return result, np.column_stack([result["hit"], result.q.values, result.v.values])[1:]


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("name", STRUCK)
def test_c_is_a_run(name, coordinates, tmp_path):
    (tmp_path / "struck.toml").write_text(STRUCK[name])
    model = load(tmp_path / "struck.toml")
    result, expected = run_of(model, 3 if name == "four-bar" else 1.5, coordinates=coordinates)
    found = in_c(model.mechanism, tmp_path / "c", 3 if name == "four-bar" else 1.5, coordinates=coordinates)
    times = [event.t for event in result.events]
    assert len(times) >= 2
    assert sorted(set(found[:, 0]) - {0.0}) == pytest.approx(times, rel=0, abs=1e-9)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-8)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("name", STRUCK)
def test_a_co_simulation_is_a_run(name, tmp_path):
    (tmp_path / "struck.toml").write_text(STRUCK[name])
    model = load(tmp_path / "struck.toml")
    until = 3.0 if name == "four-bar" else 1.5
    result, _ = run_of(model, until)
    TARGETS.get("fmu").write(Request(model.mechanism, tmp_path / "struck.fmu"))
    rows = simulate_fmu(
        str(tmp_path / "struck.fmu"), stop_time=until, output_interval=0.01, fmi_type="CoSimulation", output=["hit"]
    )  # fmt: skip
    times = [event.t for event in result.events]
    assert sorted(set(rows["hit"]) - {0.0}) == pytest.approx(times, rel=0, abs=1e-9)
