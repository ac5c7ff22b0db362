"""Commands in fresh processes, files of the defects, and motions of the reference to compare with."""

import functools
import json
import os
import re
import subprocess
import sys
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from support import processes

from benchmarks.mechanisms.toml import text
from benchmarks.plain.motion import integrate
from benchmarks.plain.start import start
from benchmarks.plain.system import System, read
from symgen.api import Model, load
from symgen.compile.store.loaded_modules import plain_function

DEFECTS = Path(__file__).resolve().parents[1] / "data" / "defects"
_COMMAND = "import sys; from symgen.cli import main; sys.exit(main(sys.argv[1:]))"
#: Before a sentence stands the command, or of what is wrong in a file the line.
_BEGINNING = re.compile(r"symgen: |[^:]+\.toml:[0-9]+: ")


@dataclass(frozen=True)
class Said:
    """What a command left: exit code, both outputs, and the most memory of its process [bytes]."""

    code: int
    out: str
    err: str
    memory: int = 0

    @property
    def sentence(self) -> bool:
        """Whether it ended in one sentence on standard error, and nothing else there."""
        lines = self.err.strip().splitlines()
        return len(lines) == 1 and _BEGINNING.match(lines[0]) is not None and len(lines[0]) < 1000


def symgen(words: Sequence[str | Path], folder: Path, **variables: str) -> Said:
    """Run ``symgen`` in a process of its own, in a folder."""
    done = processes.symgen(words, cwd=folder, env={**os.environ, **variables})
    return Said(done.returncode, done.stdout, done.stderr)


def measured(words: Sequence[str | Path], folder: Path) -> Said:
    """Run ``symgen`` as above, and say how much memory it took."""
    script = f"""
import resource, subprocess, sys
done = subprocess.run([sys.executable, "-c", {_COMMAND!r}, *sys.argv[1:]], capture_output=True, text=True)
sys.stdout.write(done.stdout)
sys.stderr.write(done.stderr)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
sys.exit(done.returncode)
"""
    done = subprocess.run(
        [sys.executable, "-c", script, *map(str, words)], capture_output=True, text=True, cwd=folder, check=False
    )
    out, _, memory = done.stdout.rstrip().rpartition("\n")
    return Said(done.returncode, out, done.stderr, 1024 * int(memory))


def raw(name: str) -> dict:
    """Return the tables of a defect's file."""
    return tomllib.loads((DEFECTS / f"{name}.toml").read_text(encoding="utf-8"))


def reference(tables: Mapping, times: Sequence[float], rtol: float = 1e-11) -> tuple[System, np.ndarray, np.ndarray]:
    """Return the reference's system of a file, and its q and v at times; integrated once, however often it is asked."""
    q, v = _motion(json.dumps(tables), tuple(times), rtol)
    return read(tables), np.array(q), np.array(v)


@functools.cache
def _motion(tables: str, times: tuple[float, ...], rtol: float) -> tuple[Sequence[np.ndarray], Sequence[np.ndarray]]:
    system = read(json.loads(tables))
    begin = start(system)
    motion = integrate(system, begin.q, begin.v, np.asarray(times), rtol)
    assert not motion.ended, motion.ended
    assert motion.drift < 1e-6 * max(1.0, motion.energy_scale)
    return motion.q, motion.v


def off(result, system: System, q: np.ndarray) -> float:
    """Return the largest difference of a result's coordinates and the reference's, Euler parameters of either sign."""
    columns = [result.q.names.index(name) for name in system.names_q]
    theirs = np.asarray(result.q)[:, columns]
    assert len(theirs) == len(q), "the run did not come to its end"
    gap = np.abs(theirs - q)
    for body in system.bodies.values():
        if system.document.spatial and body.rigid:
            four = slice(body.first_q + 3, body.first_q + 7)
            gap[:, four] = np.minimum(gap[:, four], np.abs(theirs[:, four] + q[:, four]).max(axis=1, keepdims=True))
    return float(gap.max())


def rates(compiled, start) -> np.ndarray:
    """Return the rates of a state by emitted code as plain Python."""
    y, p, w = start.y.copy(), start.p.copy(), start.w.copy()
    law, ydot, counters = compiled.law_module, np.zeros(compiled.info.ny), np.zeros(64, dtype=np.int64)
    if plain_function(law.rhs)(0.0, y, p, w, counters, ydot) != 0:
        plain_function(law.confirm)(0.0, y, p, w, counters, ydot)
    return ydot


def of_bodies(run) -> np.ndarray:
    """Return coordinates, velocities and accelerations of bodies at the start of a run of joints."""
    info, start, first_state = run.bodies.info, run.start, run.body_start.y
    out = np.zeros(info.nq + 2 * info.nv)
    ydot = rates(run.compiled, start)
    plain_function(run.compiled.model.bodies)(0.0, start.y.copy(), start.p.copy(), start.w.copy(), ydot, out)
    for first, _ in info.spins:  # both signs mean the same orientation
        out[first : first + 4] *= np.sign(out[first : first + 4] @ first_state[first : first + 4])
    return out


def model_of(tables: Mapping, folder: Path) -> Model:
    """Return the model of a description that is written to a file."""
    path = folder / "described.toml"
    path.write_text(text(tables), encoding="utf-8")
    return load(path)
