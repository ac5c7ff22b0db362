"""One step from Python beside one step inside a run, and beside steps of other tools from Python.

    python -m benchmarks.stepping [--model NAME] [--peers-python FILE]

All figures of a table are measured in one session: least time of many batches of steps. "beyond" is what a call costs
that the step itself does not.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from rich.table import Table

import symgen
from benchmarks.peers.step import BATCHES, COUNT, least
from benchmarks.show import show
from symgen.describe.mechanism import Parameter

ROOT = Path(__file__).resolve().parents[1]
STEP = 1e-3
#: An input that nothing depends on: what it costs to give it other numbers is what every input costs.
INPUT = "benchmarked"
#: Method and integrator of each line, with constant steps.
PAIRS = (
    ("direct-correction", "rk4"),
    ("lagrange", "euler"),
    ("direct-correction", "abm4"),
    ("generalized-alpha", "generalized-alpha"),
    ("lagrange", "radau5"),
)


def measured(model: symgen.Model, method: str, integrator: str) -> dict[str, float]:
    """Return seconds of a step: inside a run, from Python, with an input or a parameter set, and called as ever.

    Parameters
    ----------
    model : Model
        What is run.
    method, integrator : str
        How.
    """
    options: dict[str, Any] = {"integrator.adaptive": "false"} if integrator == "radau5" else {}
    settings: dict[str, Any] = {"step": STEP, "until": 1000.0, "max_violation": 1.0, "max_energy_error": 1e9}
    sim = model.start(method=method, integrator=integrator, options=options, **settings)
    name, value = next((name, value) for name, value in sim.parameters.items() if name != INPUT)

    def inside() -> None:
        sim.run(sim.t + COUNT * STEP)

    def steps() -> None:
        for _ in range(COUNT):
            sim.step(STEP)

    def inputs() -> None:
        for k in range(COUNT):
            sim.step(STEP, {INPUT: float(k % 2)})

    def some(change: bool) -> None:
        for k in range(COUNT // 10):
            sim.step(STEP, {name: value * (1.0 + 1e-6 * (k % 2))} if change else None)

    seconds = {"inside": least(inside), "step": least(steps), "input": least(inputs)}
    sim._loop.direct = False  # the judge of the other
    seconds["as ever"] = least(lambda: some(False), COUNT // 10, BATCHES // 10)
    sim._loop.direct = True
    seconds["set"] = least(lambda: some(True), COUNT // 10, BATCHES // 10)
    assert np.all(np.isfinite(sim.state))
    return seconds


def peers(python: Path, name: str) -> list[dict[str, Any]]:
    """Return the rows of other tools, measured in an interpreter that has them; none where there is none."""
    if not python.exists():
        return []
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "rows.json"
        command = [str(python), "-m", "benchmarks.peers.step", "--model", name, "--step", str(STEP)]
        subprocess.run([*command, "--json", str(file)], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        rows: list[dict[str, Any]] = json.loads(file.read_text(encoding="utf-8"))
    return rows


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.stepping", description=__doc__)
    parser.add_argument("--model", default="four-bar", help="a catalogue name that the peers know as well")
    parser.add_argument("--peers-python", type=Path, default=ROOT / ".bench-venv" / "bin" / "python")
    options = parser.parse_args(arguments)
    table = Table(title=f"one step of {STEP:g} s of {options.model} [us]")
    columns = (
        "inside a run",
        "from Python",
        "beyond",
        "with an input",
        "with a value set",
        "called as ever",
        "times symgen's",
    )
    for column in ("tool", "setting", *columns):
        table.add_column(column, justify="left" if column in ("tool", "setting") else "right")
    mechanism, first = symgen.load(options.model).mechanism, 0.0
    parameters = (*mechanism.parameters, Parameter(INPUT, 0.0, input=True))
    model = symgen.Model(msgspec.structs.replace(mechanism, parameters=parameters))
    for method, integrator in PAIRS:
        microseconds = {key: 1e6 * seconds for key, seconds in measured(model, method, integrator).items()}
        first = first or microseconds["step"]
        beyond = microseconds["step"] - microseconds["inside"]
        cells = (
            microseconds["inside"],
            microseconds["step"],
            beyond,
            microseconds["input"],
            microseconds["set"],
            microseconds["as ever"],
            microseconds["step"] / first,
        )
        table.add_row("symgen", f"{method}, {integrator}", *(f"{x:.3g}" for x in cells))
    for row in peers(options.peers_python, options.model):
        step, inside = 1e6 * row["step"], None if row["inside"] is None else 1e6 * row["inside"]
        own = ("-", f"{step:.3g}", "-") if inside is None else (f"{inside:.3g}", f"{step:.3g}", f"{step - inside:.3g}")
        table.add_row(f"{row['peer']} {row['version']}", row["setting"], *own, "-", "-", "-", f"{step / first:.3g}")
    show(table)


if __name__ == "__main__":
    main()
