"""Random mechanisms, run by symgen and by a reference that shares no code with it: runs that are `ok` and wrong.

    python -m benchmarks.verify --mechanisms 500 --shapes straight,looped,auto --seed 1 --output out/verify.jsonl
    python -m benchmarks.verify --methods --mechanisms 40 --output out/methods.jsonl
    python -m benchmarks.verify --show out/verify.jsonl
    python -m benchmarks.verify --shrink 1/17 --shapes looped

Each mechanism is a line of the output; the same command goes on behind those that are there.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rich.table import Table

from benchmarks.show import show
from benchmarks.verification.one import Job, examine
from benchmarks.verification.reference import LEAST
from benchmarks.verification.shrink import shrunk
from benchmarks.verification.workers import answers

#: A mechanism that takes more of the processor than this is given up [s].
PATIENCE = 900.0


def main() -> int:
    """Run what the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mechanisms", type=int, default=20)
    parser.add_argument("--first", type=int, default=0, help="number of the first mechanism")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--space", choices=("planar", "spatial", "both"), default="both")
    parser.add_argument("--shapes", default="straight,looped,auto")
    parser.add_argument("--methods", action="store_true", help="every method instead of the basic runs")
    parser.add_argument("--least", type=float, default=LEAST, help="how near to singular positions motions may come")
    parser.add_argument("--interpreted", action="store_true", help="emitted code as Python, without compiling it")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--output", type=Path, default=Path("out/verify.jsonl"))
    parser.add_argument("--show", type=Path, help="only print the table of an earlier run")
    parser.add_argument("--shrink", metavar="SEED/INDEX", help="the smallest mechanism in which a run is dishonest")
    options = parser.parse_args()
    if options.show:
        return summary(_lines(options.show))
    shapes = tuple(options.shapes.split(","))
    if options.interpreted:
        os.environ["NUMBA_DISABLE_JIT"] = "1"  # for the processes: symgen is not imported here
    if options.shrink:
        seed, index = (int(x) for x in options.shrink.split("/"))
        print(shrunk(Job(seed, index, shapes, options.methods, None, options.least)))
        return 0
    return _run(options, shapes)


def _run(options: argparse.Namespace, shapes: tuple[str, ...]) -> int:
    options.output.parent.mkdir(parents=True, exist_ok=True)
    done = {(line["seed"], line["index"]) for line in _lines(options.output)}
    space = {"planar": False, "spatial": True, "both": None}[options.space]
    numbers = range(options.first, options.first + options.mechanisms)
    jobs = [
        Job(options.seed, i, shapes, options.methods, space, options.least)
        for i in numbers
        if (options.seed, i) not in done
    ]
    with options.output.open("a", encoding="utf-8") as file:
        for answer in answers(examine, jobs, options.jobs, PATIENCE):
            line = answer.value or {"seed": answer.job.seed, "index": answer.job.index, "died": answer.died}
            file.write(json.dumps(line, allow_nan=False) + "\n")
            file.flush()
            print(_short(line), file=sys.stderr, flush=True)
    return summary(_lines(options.output))


def _lines(path: Path) -> list[dict[str, Any]]:
    if not path.exists():
        return []
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines() if line.strip()]


def _short(line: dict[str, Any]) -> str:
    """Return a line about one mechanism for the terminal."""
    name = f"{line['seed']}/{line['index']}"
    if "died" in line or "unusable" in line:
        return f"{name}: {line.get('died') or line['unusable']}"
    runs = ", ".join(f"{r['run']} {r['status']}{'' if r['honest'] else ' DISHONEST'}" for r in line["runs"])
    return f"{name}: {runs}"


@dataclass
class _Count:
    right: int = 0
    wrong: int = 0
    untold: int = 0


def counted(lines: list[dict[str, Any]]) -> Iterator[tuple[str, str, _Count]]:
    """Yield run, status and how many of these were right, wrong, or not to be compared."""
    counts: dict[tuple[str, str], _Count] = {}
    for line in lines:
        for run in line.get("runs", ()):
            if "contradiction" in line:
                continue
            count = counts.setdefault((run["run"], run["status"]), _Count())
            if run["right"] is None:
                count.untold += 1
            elif run["right"]:
                count.right += 1
            else:
                count.wrong += 1
    for key in sorted(counts):
        yield *key, counts[key]


def summary(lines: list[dict[str, Any]]) -> int:
    """Print tables; return 1 where a run was dishonest or a process died, else 0."""
    table = Table("run", "status", "right", "wrong", "not compared", title="runs")
    for run, status, count in counted(lines):
        table.add_row(run, status, str(count.right), str(count.wrong), str(count.untold))
    show(table)
    usable = [line for line in lines if "runs" in line]
    print(f"{len(usable)} mechanisms of {len(lines)}; without a reference: ", end="")
    reasons = Counter(
        str(line["unusable"]).partition(" (")[0].partition(" grow")[0] for line in lines if "unusable" in line
    )
    print(", ".join(f"{reason} {count}" for reason, count in reasons.most_common()) or "none")
    still = [line for line in lines if "contradiction" in line]
    print(f"{len(still)} whose constraints contradict each other: ", end="")
    statuses = Counter(run["status"] for line in still for run in line["runs"])
    print(", ".join(f"{status} {count}" for status, count in statuses.most_common()) or "none")
    bad = 0
    for line in lines:
        if "died" in line:
            bad += 1
            print(f"{line['seed']}/{line['index']}: {line['died']}")
        for run in line.get("runs", ()):
            if not run["honest"]:
                bad += 1
                sizes = ", ".join(f"{n} {run['errors'][n]:.2g} of {run['bounds'][n]:.2g}" for n in run["errors"])
                print(f"{line['seed']}/{line['index']} {run['run']} {run['status']}: {run['reason'] or sizes}")
    print(f"{bad} dishonest")
    return 1 if bad else 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        os.environ.setdefault("SYMGEN_CACHE_DIR", folder)
        sys.exit(main())
