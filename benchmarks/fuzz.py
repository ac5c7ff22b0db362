"""Broken files under `symgen check`: exceptions, long waits, much memory, files left behind.

    python -m benchmarks.fuzz --files 100000 --output out/fuzz.jsonl

Files are mutations of the catalogue and the examples, random documents after the schema, and long or deep ones. A file
must be taken, or refused by one sentence without control characters and with exit code 2, within 2 s of processor time
and 300 MB; nothing in it may be executed. Findings are lines of the output, with the file's text.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import re
import subprocess
import sys
import tomllib
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from benchmarks.fuzzing.check import File, check
from benchmarks.fuzzing.mutate import changed, heavy
from benchmarks.fuzzing.schema import document
from benchmarks.verification.workers import answers

#: A file that takes more of the processor than this is given up [s].
PATIENCE = 20.0
#: Address space of a process [bytes].
ADDRESSES = 6_000_000_000
#: Models of longer files or of more bodies are left out as a base: where they stay valid they are slow to derive.
LARGEST_BASE, MOST_BODIES = 6_000, 4


def bases() -> list[dict[str, Any]]:
    """Return the files that mutations start from: the catalogue and the examples."""
    import symgen

    folders = [
        Path(str(symgen.__file__)).parent / "describe" / "catalogue",
        Path(__file__).resolve().parents[1] / "examples",
    ]
    texts = [path.read_text(encoding="utf-8") for folder in folders for path in sorted(folder.glob("*.toml"))]
    contents = [tomllib.loads(text) for text in texts if len(text) <= LARGEST_BASE]
    return [raw for raw in contents if len(raw["bodies"]) <= MOST_BODIES]


def files(seed: int, first: int, count: int, whole: float) -> Iterator[File]:
    """Yield files of a seed.

    Parameters
    ----------
    seed, first, count : int
        Which ones.
    whole : float
        Share of the valid ones that are assembled as well.
    """
    good = bases()
    command = "import symgen.cli; symgen.cli.main(['schema'])"
    printed = subprocess.run([sys.executable, "-c", command], capture_output=True, text=True, check=True)
    schema = json.loads(printed.stdout)
    for number in range(first, first + count):
        rng = random.Random(f"{seed}/{number}")
        kind = rng.random()
        if kind < 0.6:
            text = changed(rng, rng.choice(good), rng.choice(good))
        elif kind < 0.95:
            text = document(rng, schema)
        else:
            text = heavy(rng)
        yield File(number, text, rng.random() < whole)


def signature(wrong: str) -> str:
    """Return a finding without its particulars, by which findings are counted."""
    return re.sub(r"'[^']*'|\"[^\"]*\"|[0-9.]+", "_", wrong)[:100]


def worn(line: dict[str, Any]) -> bool:
    """Return whether a process has had so much memory that it cannot tell any more what a file takes."""
    return any(" MB" in wrong for wrong in line["wrong"])


def main() -> int:
    """Check the files that the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--files", type=int, default=1000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--whole", type=float, default=0.05, help="share of the valid files that are assembled")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--output", type=Path, default=Path("out/fuzz.jsonl"))
    options = parser.parse_args()
    options.output.parent.mkdir(parents=True, exist_ok=True)
    codes: Counter[str] = Counter()
    outcomes: Counter[str] = Counter()
    slowest = 0.0
    jobs = files(options.seed, options.first, options.files, options.whole)
    with options.output.open("w", encoding="utf-8") as file:
        for answer in answers(check, jobs, options.jobs, PATIENCE, ADDRESSES, worn):
            line = answer.value
            if line is None:
                line = {"number": answer.job.number, "code": None, "wrong": [answer.died], "text": answer.job.text}
            codes[str(line["code"])] += 1
            slowest = max(slowest, line.get("seconds", 0.0))
            for wrong in line["wrong"]:
                outcomes[signature(wrong)] += 1
            if line["wrong"]:
                file.write(json.dumps(line) + "\n")
                file.flush()
            if sum(codes.values()) % 1000 == 0:
                print(dict(codes), dict(outcomes), file=sys.stderr, flush=True)
    print("exit codes:", dict(codes), f"longest {slowest:.1f} s of the processor")
    for what, count in outcomes.most_common():
        print(f"{count:6d}  {what}")
    return 1 if outcomes else 0


if __name__ == "__main__":
    sys.exit(main())
