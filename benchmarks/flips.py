"""Flipped bits in the cache: whether a run answers the same, or says what is wrong.

    python -m benchmarks.flips --flips 400 --output out/flips.jsonl

A cache is filled by one run of each model below. For every flip it is copied, one bit of one of its files is turned
over, and the same run is made twice in fresh processes. Each must give the same answer to the last bit, or an error of
one sentence; a traceback, a crash, or another answer is a finding. Files of source, of JSON and of machine code are
taken equally often.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

#: What is run: words after ``symgen run``.
RUNS = (
    ("four-bar", "--until", "0.05", "--step", "1e-3", "--shape", "straight", "--json"),
    ("slider-crank", "--until", "0.05", "--step", "1e-3", "--shape", "looped", "--json"),
)
#: Keys of the answer that depend on the machine's mood.
MOODY = ("seconds",)
SENTENCES = 3


@dataclass(frozen=True)
class Flip:
    """A bit to turn over: which run's cache, which file in it, which byte, which bit."""

    number: int
    run: int
    file: str
    byte: int
    bit: int


@dataclass(frozen=True)
class Outcome:
    """What two runs after a flip said.

    Attributes
    ----------
    verdicts : tuple of str
        For each of them ``"same"``, ``"error"``, ``"another answer"``, ``"traceback"`` or ``"signal n"``.
    words : str
        Standard error, shortened.
    """

    flip: Flip
    verdicts: tuple[str, ...]
    words: str

    @property
    def bad(self) -> bool:
        """Whether a run was silent about another answer, or did not end in words."""
        return any(word not in ("same", "error") for word in self.verdicts)


def answer(words: tuple[str, ...], cache: Path) -> tuple[int, str, str]:
    """Return exit code, answer without what varies, and standard error of a run with a cache."""
    command = "import sys; from symgen.cli import main; sys.exit(main(sys.argv[1:]))"
    done = subprocess.run(
        [sys.executable, "-c", command, "run", *words],
        capture_output=True,
        text=True,
        env={**os.environ, "SYMGEN_CACHE_DIR": str(cache)},
        check=False,
    )
    try:
        fields: dict[str, Any] = json.loads(done.stdout)
        output = json.dumps({key: value for key, value in fields.items() if key not in MOODY})
    except ValueError:
        output = done.stdout
    return done.returncode, output, done.stderr


def flips(caches: list[Path], count: int, seed: int) -> list[Flip]:
    """Return random flips in the files of caches, as many of each kind of file."""
    rng = random.Random(seed)
    drawn = []
    for number in range(count):
        run = number % len(caches)
        files = sorted(p for p in caches[run].rglob("*") if p.is_file() and p.stat().st_size > 0)
        kinds = {kind: [p for p in files if _kind(p) == kind] for kind in ("json", "source", "machine code")}
        kind = rng.choice([kind for kind, candidates in kinds.items() if candidates])
        file = rng.choice(kinds[kind])
        byte, bit = rng.randrange(file.stat().st_size), rng.randrange(8)
        drawn.append(Flip(number, run, str(file.relative_to(caches[run])), byte, bit))
    return drawn


def _kind(path: Path) -> str:
    return {".json": "json", ".py": "source", ".bin": "machine code"}.get(path.suffix, "source")


def tried(flip: Flip, caches: list[Path], expected: list[str]) -> Outcome:
    """Return what two runs say after a flip."""
    with tempfile.TemporaryDirectory() as folder:
        cache = Path(folder) / "cache"
        shutil.copytree(caches[flip.run], cache)
        path = cache / flip.file
        content = bytearray(path.read_bytes())
        content[flip.byte] ^= 1 << flip.bit
        path.write_bytes(content)
        verdicts, words = [], ""
        for _ in range(2):
            code, output, err = answer(RUNS[flip.run], cache)
            verdicts.append(_verdict(code, output, err, expected[flip.run]))
            words = words or (err[-400:] if verdicts[-1] != "same" else "")
    return Outcome(flip, tuple(verdicts), words)


def _verdict(code: int, output: str, err: str, expected: str) -> str:
    if code < 0:
        return f"signal {-code}"
    if "Traceback (most recent call last)" in err:
        return "traceback"
    if output == expected:
        return "same"
    return "error" if code != 0 and not output and 0 < err.count("\n") <= SENTENCES else "another answer"


def main() -> int:
    """Turn over the bits that the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--flips", type=int, default=400)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--output", type=Path, default=Path("out/flips.jsonl"))
    options = parser.parse_args()
    options.output.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        caches = [Path(folder) / str(k) for k in range(len(RUNS))]
        expected = [filled(words, cache) for words, cache in zip(RUNS, caches, strict=True)]
        counts: Counter[str] = Counter()
        bad = 0
        with options.output.open("w", encoding="utf-8") as file, ThreadPoolExecutor(options.jobs) as pool:
            todo = flips(caches, options.flips, options.seed)
            for outcome in pool.map(lambda flip: tried(flip, caches, expected), todo):
                kind = _kind(Path(outcome.flip.file))
                counts[f"{kind}: {' then '.join(outcome.verdicts)}"] += 1
                bad += outcome.bad
                file.write(json.dumps(asdict(outcome)) + "\n")
                file.flush()
    for what, count in sorted(counts.items()):
        print(f"{count:6d}  {what}")
    print(f"{bad} of {options.flips} are findings")
    return 1 if bad else 0


def filled(words: tuple[str, ...], cache: Path) -> str:
    """Return the answer of a run that fills a cache, once a second one has given the same from it."""
    first, again = (answer(words, cache) for _ in range(2))
    if first[0] != 0 or first != again:
        raise SystemExit(f"the run itself does not repeat: {first} {again}")
    return first[1]


if __name__ == "__main__":
    sys.exit(main())
