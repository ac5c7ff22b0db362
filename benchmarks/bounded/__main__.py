"""Random mechanisms with dry friction, stops and ropes: runs beside an event-driven simulation that shares no code.

    python -m benchmarks.bounded --count 30 --seed 1 --output out/bounded.jsonl
    python -m benchmarks.bounded --one chain/17 --runs default,dop853
    python -m benchmarks.bounded --one hard/chain-two-stops
    python -m benchmarks.bounded --with rotors --kinds chain,loop --seed 200
    python -m benchmarks.bounded --write chain/17 > chain.toml
    python -m benchmarks.bounded --show out/bounded.jsonl

Each mechanism is a line of the output; the same command goes on behind those that are there.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import sys
import tempfile
from collections import Counter
from dataclasses import asdict
from pathlib import Path
from typing import Any

from rich.table import Table

from benchmarks.bounded.chains import HARD, hard
from benchmarks.bounded.compare import ROWS, RUNS, UNTIL, examined
from benchmarks.bounded.corners import cornered
from benchmarks.bounded.draw import KINDS, Drawn, drawn
from benchmarks.bounded.rotors import geared
from benchmarks.bounded.sleds import sledded
from benchmarks.mechanisms.toml import text
from benchmarks.show import show

#: What mechanisms have besides, by name: nothing, floors with corners (in the plane alone), rotors, sleds.
DRAWERS = {"": drawn, "corners": cornered, "rotors": geared, "sleds": sledded}
OUTCOMES = ("right", "coarse", "sentence", "failed", "unverified", "WRONG", "raised")


def main() -> int:
    """Run what the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=5, help="mechanisms of each kind")
    parser.add_argument("--seed", type=int, default=1, help="number of the first mechanism of each kind")
    parser.add_argument(
        "--kinds", default=",".join(["hard", *KINDS]), help="of random mechanisms, or hard for five chains"
    )
    parser.add_argument("--with", dest="beside", choices=sorted(DRAWERS), default="", help="what they have besides")
    parser.add_argument("--runs", default=",".join([*RUNS, ROWS]))
    parser.add_argument("--until", type=float, default=UNTIL)
    parser.add_argument("--one", metavar="KIND/SEED", help="a single mechanism")
    parser.add_argument("--write", metavar="KIND/SEED", help="print the file of a mechanism")
    parser.add_argument("--output", type=Path, help="file of lines, one for each mechanism")
    parser.add_argument("--show", type=Path, help="only print the table of an earlier run")
    options = parser.parse_args()
    if options.write:
        kind, seed = options.write.split("/")
        print(text(DRAWERS[options.beside](kind, int(seed)).raw), end="")
        return 0
    if options.show:
        return summary(_lines(options.show))
    numbers = [str(seed) for seed in range(options.seed, options.seed + options.count)]
    jobs = [(kind, seed) for kind in options.kinds.split(",") for seed in (HARD if kind == "hard" else numbers)]
    if options.one:
        jobs = [options.one.split("/")]
    lines = _lines(options.output) if options.output else []
    done = {(line["kind"], line["seed"]) for line in lines}
    for kind, seed in jobs:
        if (kind, seed) not in done:
            mechanism = hard(seed) if kind == "hard" else DRAWERS[options.beside](kind, int(seed))
            until = HARD[seed] if kind == "hard" else options.until
            line = _line(mechanism, kind, seed, tuple(options.runs.split(",")), until)
            print(_short(line), file=sys.stderr, flush=True)
            lines.append(line)
            if options.output:
                options.output.parent.mkdir(parents=True, exist_ok=True)
                with options.output.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(line) + "\n")
    return summary(lines)


def _lines(path: Path) -> list[dict[str, Any]]:
    if not path.exists():
        return []
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines() if line.strip()]


def _line(mechanism: Drawn, kind: str, seed: str, runs: tuple[str, ...], until: float) -> dict[str, Any]:
    """Return what is kept of a mechanism."""
    against, verdicts = examined(mechanism, runs, until)
    line: dict[str, Any] = {"kind": kind, "seed": seed, "features": sorted(mechanism.features)}
    if isinstance(against, str):
        return {**line, "unusable": against}
    events = [f"{e.t:.9f} {e.name}.{e.kind}" for e in against.events[:60]]
    return {
        **line,
        "until": float(against.times[-1]),
        "growth": against.growth,
        "events": events,
        "runs": [asdict(verdict) for verdict in verdicts],
    }


def _short(line: dict[str, Any]) -> str:
    """Return a line about one mechanism for the terminal."""
    name = f"{line['kind']}/{line['seed']} ({', '.join(line['features'])})"
    if "unusable" in line:
        return f"{name}: {line['unusable']}"
    runs = "".join(
        f"\n    {r['run']}: {r['outcome']}{'' if math.isnan(r['error']) else format(r['error'], ' .1e')}"
        f" {r['reason'][:200] if r['outcome'] != 'right' else ''} [{r['seconds']:.1f} s]"
        for r in line["runs"]
    )
    return f"{name}: {len(line['events'])} events until {line['until']:g} s, growth {line['growth']:.1f}{runs}"


def summary(lines: list[dict[str, Any]]) -> int:
    """Print tables; return 1 where a run was `ok` and wrong or raised something else than a sentence, else 0."""
    counts: Counter[tuple[str, str]] = Counter()
    worst: dict[str, float] = {}
    for line in lines:
        for run in line.get("runs", ()):
            counts[run["run"], run["outcome"]] += 1
            if run["outcome"] == "right":
                worst[run["run"]] = max(worst.get(run["run"], 0.0), run["error"] / line["growth"])
    table = Table("run", *OUTCOMES, "largest error of right ones over growth")
    for name in dict.fromkeys(run for run, _ in counts):
        table.add_row(name, *(str(counts[name, o]) for o in OUTCOMES), f"{worst.get(name, math.nan):.1e}")
    show(table)
    usable = [line for line in lines if "runs" in line]
    features = Counter(feature for line in usable for feature in line["features"])
    print(f"{len(usable)} mechanisms of {len(lines)}: {', '.join(f'{n} {c}' for n, c in features.most_common())}")
    for line in lines:
        if "unusable" in line:
            print(f"{line['kind']}/{line['seed']} without a reference: {line['unusable']}")
    for outcome in ("WRONG", "raised", "failed", "unverified", "coarse"):
        for line in usable:
            for run in line["runs"]:
                if run["outcome"] == outcome:
                    name = f"{line['kind']}/{line['seed']} {run['run']}"
                    print(f"{name} {outcome} {run['error']:.1e}: {run['reason'][:160]}")
    return 1 if any(counts[name, bad] for name in [*RUNS, ROWS] for bad in ("WRONG", "raised")) else 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        os.environ.setdefault("SYMGEN_CACHE_DIR", folder)
        sys.exit(main())
