"""A study of cells that leave a trace each time they are computed, run as a process that a test kills."""

import os
import sys
import time
from pathlib import Path

from symgen.study.journal import Journal, cell_key
from symgen.study.runner import Cell, run_cells

COUNT = 24


def compute(task):
    folder, number = task
    with open(Path(folder) / "trace.txt", "a") as trace:
        trace.write(f"{number}\n")
    time.sleep(0.05)
    if number == "dies":
        os._exit(3)
    return {"square": number * number}


def cells(folder, count=COUNT):
    return [Cell(cell_key(number=i), f"group {i % 3}", (str(folder), i)) for i in range(count)]


def main(folder, processes):
    with Journal(Path(folder) / "journal.jsonl") as journal:
        outcomes, interrupted = run_cells(cells(folder), compute, journal, processes)
    print(len(outcomes), interrupted)
    return 130 if interrupted else 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1], int(sys.argv[2])))
