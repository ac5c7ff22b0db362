"""Each test has a cache of its own; what must happen in another process goes through `python`.

That process is a fork of one in which everything is imported and nothing is compiled; where a variable is given that
Python or Numba reads when it starts, an interpreter is started.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from support import processes

NJIT = '@njit(error_model="numpy", fastmath={"contract"})\n'
MODEL = f'''
import math
import numpy as np
from numba import njit

TABLE_X = np.array([0.0, 1.0, 2.0])

{NJIT}def table(x):
    """A table."""
    return 1.0 if x <= TABLE_X[1] else TABLE_X[2]


{NJIT}def geometry(t, y, w):
    """A sine."""
    w[0] = math.sin(y[0])*table(y[0])
    return 0
'''

LAW = f"""
from numba import njit
from .model import geometry

{NJIT}def rhs(t, y, p, w, iw, ydot):
    geometry(t, y, w)
    ydot[0] = y[1]
    ydot[1] = -p[0] * w[0]
    iw[0] += 1
    return 0
"""

LOOPS = """\
from symgen.compile.native.types import FunctionType, float64, int64
from symgen.compile.store.jit import jit

ARRAY = float64[::1]
RHS = FunctionType(int64(float64, ARRAY, ARRAY, ARRAY, int64[::1], ARRAY))

@jit()
def advance(y, ydot, h):
    for i in range(y.shape[0]):
        y[i] += h * ydot[i]

@jit(int64(RHS, int64, float64, ARRAY, ARRAY, ARRAY, int64[::1], ARRAY))
def euler(rhs, steps, h, y, p, w, iw, ydot):
    for k in range(steps):
        status = rhs(k * h, y, p, w, iw, ydot)
        if status != 0:
            return status
        advance(y, ydot, h)
    return 0

@jit(float64(float64))
def never_called(x):
    return 3.0 * x
"""

# Runs the loop with the emitted function and prints the state reached and the counters.
RUN = """\
import json, sys
import numpy as np
from symgen.compile.store.loaded_modules import load_module
from symgen.compile.store.stats import cache_stats
import loops

law = load_module(sys.argv[1])
y, ydot = np.array([1.0, 0.0]), np.zeros(2)
status = loops.euler(law.rhs, 10, 0.01, y, np.array([9.81]), np.zeros(4), np.zeros(2, np.int64), ydot)
print(json.dumps({"y": y.tolist(), "status": status, **cache_stats()}))
"""

FOLDER = "four-bar_0123456789abcdef_1"


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The cache folder of this test, not yet made."""
    root = tmp_path / "cache"
    monkeypatch.setenv("SYMGEN_CACHE_DIR", str(root))
    return root


@pytest.fixture
def generated(tmp_path: Path) -> Iterator[Path]:
    """A folder with an emitted model and one law, and a library `loops` on the path of `python`."""
    folder = tmp_path / "generated" / FOLDER
    folder.mkdir(parents=True)
    (folder / "model.py").write_text(MODEL)
    (folder / "lagrange.py").write_text(LAW)
    (tmp_path / "library").mkdir()
    (tmp_path / "library" / "loops.py").write_text(LOOPS)
    yield folder
    for name in [name for name in sys.modules if name.startswith("symgen_generated")]:
        del sys.modules[name]


@pytest.fixture
def law(generated: Path, cache: Path) -> Path:
    """The emitted law, and a cache of its own."""
    return generated / "lagrange.py"


@pytest.fixture
def python(tmp_path: Path) -> Callable[..., Any]:
    """Run a script in another process and return the JSON of its last line."""

    def run(script: str, *arguments: object, **environment: str) -> Any:
        folders = [str(tmp_path / "library"), str(Path(__file__).parents[3])]
        variables = {**os.environ, **environment}
        result = processes.python(script, *arguments, env=variables, path=folders, strict=True)
        assert result.returncode == 0, result.stderr
        return json.loads(result.stdout.splitlines()[-1])

    return run
