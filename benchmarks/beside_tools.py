"""Error against run time beside other tools: the tables of README and of benchmarks/README.md.

    python -m benchmarks.beside_tools                      both tables, from the record
    python -m benchmarks.records beside_tools --anew       measures it, on a quiet machine (`make peers`)

Each tool runs a mechanism with all of its settings (`benchmarks.against_peers`, `benchmarks.peers`). The record has the
runs of each tool that no other run of the same tool beats in both error and time, and the numbers in a vector of the
processor that symgen compiles for: its own, or one with AVX2. The interpreter of the other tools is
``.bench-venv/bin/python``, or what BENCH_PYTHON names.
"""

from __future__ import annotations

import json
import os
import random
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from benchmarks.against_peers import ROOT, TARGET, peers, rows
from benchmarks.page_tables import DECADE, KEPT, PageTable, list_of, print_tables, two_digits
from benchmarks.peers import models
from benchmarks.peers.measure import Row
from benchmarks.records import Line, Pair, Record
from symgen.compile.native.machine import vector_width

MECHANISMS = ("four-bar-peers", "four-bar", "andrews", "n-four-bar:10")
OWN, NARROW, HEYOKA = "symgen", "symgen-avx2", "heyoka"
#: A processor with vectors of four numbers.
AVX2 = "haswell"
TOOLS = {
    OWN: "symgen",
    NARROW: "symgen, AVX2",
    "casadi": "CasADi with gcc",
    HEYOKA: "heyoka",
    "exudyn": "Exudyn",
    "mujoco": "MuJoCo",
}
#: Tools of README's table, whose readers ask for a simulator or an interpreter's code.
SHORT = {name: label for name, label in TOOLS.items() if name not in (NARROW, HEYOKA)}
#: The method that closes joints to rounding.
CLOSED = "direct-correction"
#: Mechanism and error [rad] of README's sentence.
FINE = ("four-bar-peers", 1e-9)
#: Errors [rad] below are those of references, or rounding.
RESOLVED = 1e-10
#: Processor time of a tool on a mechanism at most [s].
PATIENCE = 1800.0


class Job(NamedTuple):
    """A mechanism in a tool."""

    mechanism: str
    tool: str


class Run(NamedTuple):
    """A run of the record: loop time [s] and largest error of a body angle [rad]."""

    setting: str
    seconds: float
    error: float


def interpreter() -> Path:
    """Return the interpreter of the other tools."""
    return Path(os.environ.get("BENCH_PYTHON", ROOT / ".bench-venv" / "bin" / "python"))


def front(runs: Iterable[Row]) -> list[Run]:
    """Return the runs that no other one beats in error and time, the fastest first."""
    best = list[Run]()
    done = (Run(r["setting"], r["seconds"], r["error"]) for r in runs if r["seconds"] is not None and r["error"])
    for run in sorted(done, key=lambda run: (run.seconds, run.error)):
        if not best or run.error < best[-1].error:
            best.append(run)
    return best


def narrow(mechanism: str, folder: Path) -> list[Row]:
    """Return symgen's runs on a processor with vectors of four numbers."""
    none, target = folder / "none.json", folder / "rows.json"
    none.write_text("[]", encoding="utf-8")
    command = ["-m", "benchmarks.against_peers", "--model", mechanism, "--peers-json", str(none), "--json", str(target)]
    processor = os.environ | {"NUMBA_CPU_NAME": AVX2, "NUMBA_CPU_FEATURES": ""}
    subprocess.run([sys.executable, *command], cwd=ROOT, env=processor, check=True, stdout=subprocess.DEVNULL)
    measured: list[Row] = json.loads(target.read_text(encoding="utf-8"))
    return measured


def examine(job: Job) -> dict[str, Any]:
    """Return the version of a tool and its front; for symgen, numbers in a vector and the front with closed joints."""
    own = dict[str, Any]()
    with tempfile.TemporaryDirectory() as folder:
        if job.tool == OWN:
            runs = list(rows(models.load(job.mechanism)))
            own = {"width": vector_width(), "closed": front(run for run in runs if CLOSED in run["setting"])}
        elif job.tool == NARROW:
            runs = narrow(job.mechanism, Path(folder))
        else:
            runs = peers([job.mechanism], interpreter(), Path(folder) / "rows.json", job.tool)
    return {"version": runs[0]["version"] if runs else "", **own, "runs": front(runs)}


def again(stored: Line, dice: random.Random) -> Iterator[Pair]:
    """Yield the errors of two of symgen's runs beside those measured again."""
    resolved = [Run(*run) for run in stored.get("runs", ()) if run[2] > RESOLVED]
    for run in dice.sample(resolved, min(2, len(resolved))) if stored["tool"] == OWN else ():
        # settings begin alike: 1e-08 and 1e-085 do not occur
        repeats = [row for row in rows(models.load(stored["mechanism"]), run.setting) if row["setting"] == run.setting]
        within = DECADE if "picard" in run.setting else 1.1
        yield Pair(f"{stored['mechanism']}, {run.setting}", run.error, repeats[0]["error"], within)


def runs_of(mechanism: str, tool: str, key: str = "runs") -> list[Run] | None:
    """Return the front of a tool, None if it was not measured."""
    lines = (line for line in RECORD.lines() if (line["mechanism"], line["tool"]) == (mechanism, tool))
    line = next(lines, {})
    return [Run(*run) for run in line[key]] if key in line else None


def fastest(mechanism: str, tool: str, error: float = TARGET, text: str = "", key: str = "runs") -> Run | None:
    """Return the fastest run of a front within an error whose setting contains a text."""
    good = (run for run in runs_of(mechanism, tool, key) or () if run.error <= error and text in run.setting)
    return next(good, None)


def cells(tools: Iterable[str], settings: bool, mechanism: str) -> Iterator[str]:
    """Yield milliseconds of each tool within the error, with the multiple of symgen's and the setting."""
    own = fastest(mechanism, OWN)
    for tool in tools:
        run = fastest(mechanism, tool)
        if runs_of(mechanism, tool) is None or own is None:
            yield KEPT
        elif run is None:
            yield "not reached"
        else:
            multiple = "" if tool == OWN else two_digits(run.seconds / own.seconds)
            notes = [x for x in (multiple, f"`{run.setting}`" if settings else "") if x]
            yield f"{1e3 * run.seconds:.3g} ms" + (f" ({'; '.join(notes)})" if notes else "")


def claims() -> Iterator[str]:
    """Yield README's sentence on small errors."""
    name, error = FINE
    best = [fastest(name, tool, error) for tool in (OWN, HEYOKA)]
    own, taylor = (None if run is None else f"{1e3 * run.seconds:.3f} ms" for run in best)
    if own and taylor:
        yield f"needs {own} for a four-bar, heyoka {taylor}."


def closed_claims() -> Iterator[str]:
    """Yield the sentences of benchmarks/README.md: widths of vectors, and symgen's times with closed joints."""
    widths = {line["width"] for line in RECORD.lines() if line["tool"] == OWN and "width" in line}
    closed = [fastest(name, OWN, key="closed") for name in MECHANISMS]
    if len(widths) == 1 and all(closed):
        yield f"symgen's vectors have {widths.pop()} numbers, with AVX2 4"
        times = [f"{1e3 * run.seconds:.3g}" for run in closed if run is not None]
        yield f"With `{CLOSED}`, joints closed to rounding, symgen takes {', '.join(times[:-1])} and {times[-1]} ms"


def tables() -> tuple[PageTable, ...]:
    """Return the tables of both pages."""
    page_tables = list[PageTable]()
    for page, tools, settings, names in (
        ("README.md", SHORT, False, MECHANISMS[1:]),
        ("benchmarks/README.md", TOOLS, True, MECHANISMS),
    ):
        lines = tuple(((f"`{name}`",), partial(list_of, cells, tools, settings, name)) for name in names)
        headings = ("mechanism", *tools.values())
        sentences = claims if page == "README.md" else closed_claims
        page_tables.append(PageTable("beside_tools", page, headings, lines, stored=True, claims=sentences))
    return tuple(page_tables)


def jobs() -> Iterator[Job]:
    """Yield the mechanisms in each tool."""
    if not interpreter().exists():
        sys.exit(f"{interpreter()} does not exist: make peers makes it, benchmarks/peers/README.md says how")
    return (Job(name, tool) for name in MECHANISMS for tool in TOOLS)


RECORD = Record("beside_tools", jobs, examine, again, PATIENCE, share=0.5)


if __name__ == "__main__":
    sys.exit(print_tables({table.page: table for table in tables()}, ()))
