"""Run time of methods at equal errors, as ratios to `lagrange`: five mechanisms, three integrators, two errors.

    python -m benchmarks.equal_error [--workers N] [--seconds S] [-o ROWS] [MECHANISM ...]

A mechanism with an integrator is a study of `symgen compare --at`: nine steps or eleven tolerances a method, all timed
in turn, nine rounds. Errors are shares of the mechanism's length. Cells are the median of the rounds' ratios, with
quartiles, of the CPU time of one process each, so that several processes want a core each; one that is empty has no two
settings with errors on both sides. A study is a line of JSON in the file of rows, and is not measured again where it is
there.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import math
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from benchmarks.page_tables import markdown
from benchmarks.statistics import Line, lines_in
from benchmarks.verification.workers import answers
from symgen.study.comparison.combinations import DEFAULT_METHODS
from symgen.study.comparison.compare import compare

#: Length [m], end of the run and largest step [s] of each mechanism.
MECHANISMS = {
    "four-bar": (4.0, 10.0, 1.6e-2),
    "slider-crank": (0.225, 5.0, 8e-3),
    "andrews": (0.04, 0.03, 1.6e-4),
    "bricard": (0.5, 10.0, 6.4e-2),
    "spatial-slider-crank": (0.15, 2.0, 8e-3),
}
INTEGRATORS = ("rk4", "dop853", "picard")
METHODS = (*DEFAULT_METHODS, "velocity-projection", "direct-correction:weight=mass")
#: Errors, as largest distances of points of bodies over the length of the mechanism [1].
ERRORS = (1e-6, 1e-8)
#: Number of constant steps of a method, each half of the one before it, and tolerances.
STEPS, RTOLS = 9, tuple(10.0**-k for k in range(2, 13))
#: Processor time of a study at most [s].
PATIENCE = 280.0

Job = tuple[str, str]


def examine(job: Job) -> dict[str, Any]:
    """Return the line of a mechanism with an integrator."""
    name, integrator = job
    length, until, step = MECHANISMS[name]
    steps, errors = [step / 2**k for k in range(STEPS)], [length * error for error in ERRORS]
    table = compare(name, METHODS, (integrator,), steps, RTOLS, until=until, repeat=1, error_at=errors).to_json()
    return {"mechanism": name, "integrator": integrator, "reference": table["reference"], "at": table["at"]}


def cells(line: Line, error: float) -> Iterator[str]:
    """Yield the cells of an error: milliseconds of `lagrange`, then the ratio of each method with its quartiles."""
    absolute = error * MECHANISMS[line["mechanism"]][0]
    times = {time["method"]: time for time in line["at"] if math.isclose(time["error"], absolute)}
    base = times["lagrange"]["seconds"]
    yield "" if base is None else f"{1e3 * base:.2g}"
    for method in METHODS[1:]:
        time_ = times.get(label(method), {"ratio": None})
        middle = time_["ratio"]
        yield "" if middle is None else f"{middle:.2f} ({time_['ratio_low']:.2f}-{time_['ratio_high']:.2f})"


def label(method: str) -> str:
    """Return the label of a line of a study, such as ``direct-correction, weight=mass``."""
    return method.replace(":", ", ")


def rows(lines: Sequence[Line]) -> Iterator[list[str]]:
    """Yield the rows of the table in the order of mechanisms, integrators and errors."""
    own = {(line["mechanism"], line["integrator"]): line for line in lines if "at" in line}
    for name in MECHANISMS:
        for integrator in INTEGRATORS:
            if (name, integrator) in own:
                for error in ERRORS:
                    yield [f"`{name}`", f"`{integrator}`", f"{error:g}", *cells(own[name, integrator], error)]


def main() -> None:
    """Measure, and print the table."""
    parser = argparse.ArgumentParser(description="Run time at equal errors.")
    parser.add_argument("mechanisms", nargs="*", default=list(MECHANISMS))
    parser.add_argument("--workers", type=int, default=1, help="processes, a core each")
    parser.add_argument("--seconds", type=float, default=math.inf, help="no study begins after so many seconds")
    parser.add_argument("-o", "--output", type=Path, help="file of rows; the studies that it has are not measured")
    chosen = parser.parse_args()
    lines, began = lines_in(chosen.output), time.monotonic()
    done = {(line["mechanism"], line["integrator"]) for line in lines}
    wanted = ((name, integrator) for integrator in INTEGRATORS for name in chosen.mechanisms)
    jobs = (job for job in wanted if job not in done and time.monotonic() - began < chosen.seconds)
    with contextlib.ExitStack() as stack:
        file = None if chosen.output is None else stack.enter_context(chosen.output.open("a", encoding="utf-8"))
        for answer in answers(examine, jobs, chosen.workers, PATIENCE):
            line = answer.value or dict(zip(("mechanism", "integrator"), answer.job, strict=True), died=answer.died)
            lines.append(line)
            if file is not None:
                file.write(json.dumps(line) + "\n")
                file.flush()
            print(*answer.job, f"{time.monotonic() - began:.0f} s", answer.died, file=sys.stderr, flush=True)
    headings = (
        "mechanism",
        "integrator",
        "error / length",
        "`lagrange` [ms]",
        *(f"`{method}`" for method in METHODS[1:]),
    )
    print("\n".join(markdown(headings, list(rows(lines)))))


if __name__ == "__main__":
    main()
