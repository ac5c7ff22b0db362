"""Random scenes of bodies that touch: runs beside an event-driven simulation that shares no code.

    python -m benchmarks.bounded.touch --count 4 --seed 1
    python -m benchmarks.bounded.touch --one chain/17
    python -m benchmarks.bounded.touch --write chain/17 > chain.toml

A verdict is right where all places are within 1e-8 (1e-6 with usual tolerances), times the growth of disturbances.
"""

from __future__ import annotations

import argparse
from collections import Counter

from benchmarks.bounded.touch.beside import BESIDE
from benchmarks.bounded.touch.kinds import drawn
from benchmarks.bounded.touch.modes import Unsolved
from benchmarks.bounded.touch.motion import Ended
from benchmarks.bounded.touch.outlines import OUTLINES
from benchmarks.bounded.touch.runs import RUNS, UNTIL, Reference, compared, reference
from benchmarks.bounded.touch.scenes import KINDS
from benchmarks.mechanisms.toml import text


def main() -> int:
    """Run what the command line asks for; return the number of wrong runs."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=4, help="scenes of each kind")
    parser.add_argument("--seed", type=int, default=1, help="number of the first scene of each kind")
    parser.add_argument("--kinds", default="")
    parser.add_argument("--runs", default=",".join(RUNS))
    parser.add_argument("--until", type=float, default=UNTIL)
    parser.add_argument("--beside", action="store_true", help="kinds in which impacts accumulate beside contacts")
    parser.add_argument("--outlines", action="store_true", help="kinds of discs and polygons on outlines")
    parser.add_argument("--one", metavar="KIND/SEED", help="a single scene")
    parser.add_argument("--write", metavar="KIND/SEED", help="print the file of a scene")
    options = parser.parse_args()
    if options.write:
        kind, seed = options.write.split("/")
        print(text(drawn(kind, int(seed)).raw), end="")
        return 0
    seeds = range(options.seed, options.seed + options.count)
    kinds = (
        options.kinds.split(",")
        if options.kinds
        else list(BESIDE if options.beside else OUTLINES if options.outlines else KINDS)
    )
    jobs = [(kind, seed) for kind in kinds for seed in seeds]
    if options.one:
        kind, seed = options.one.split("/")
        jobs = [(kind, int(seed))]
    total = Counter[str]()
    for kind, number in jobs:
        scene, against, why = drawn(kind, number), None, ""
        try:
            against = reference(scene, options.until)
        except (Unsolved, Ended) as reason:
            why = str(reason)
        print(f"{kind}/{number}: {_line(against, why)}", flush=True)
        for name in options.runs.split(","):
            verdict = compared(name, scene, against, options.until)
            total[verdict.outcome] += 1
            print(f"  {name:8} {verdict.outcome:10} {verdict.error:8.1e} {verdict.reason[:160]}", flush=True)
    print(dict(total))
    return total["WRONG"] + total["raised"]


def _line(against: Reference | None, why: str) -> str:
    if against is None:
        return f"no reference, {why}"
    words = Counter(word for _, word, _ in against.events)
    return f"up to {against.times[-1]:g} s, growth {against.growth:.2g}, {dict(words)}"


if __name__ == "__main__":
    raise SystemExit(main())
