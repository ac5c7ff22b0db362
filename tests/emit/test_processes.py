"""Emitted files across processes: the same bytes everywhere, standing alone, with and without compilation."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from support.emitted import Emitted

from symgen.api import load
from symgen.ir.program import SCALES, STATUS

EMIT_ALL = """
import hashlib, sys
from symgen.api import load
from symgen.catalogue import names
from symgen.lower.looped.law import is_loopable
from symgen.methods import METHODS
from symgen.compiling.pipeline import choose_method, generate

for name in names():
    for method in METHODS if name == "four-bar" else ("lagrange", "direct-correction"):
        options = [{}] + [{o.name: v} for o in METHODS.get(method).options for v in o.values]
        choices = tuple({c.stem: c for c in (choose_method(method, o) for o in options)}.values())
        made = [generate(load(name).mechanism, choices)]
        explicit = bool({"ode", "one-step"} & set(METHODS.get(method).forms))
        forms = [False] * explicit + [True] * bool(set(METHODS.get(method).forms) - {"ode", "one-step"})
        loops = [choose_method(method, o, implicit) for o in options for implicit in forms]
        loops = tuple(c for c in loops if is_loopable(c.method, c.options, c.implicit))
        made.append(generate(load(name).mechanism, loops, "looped"))
        if method in ("lagrange", "direct-correction"):
            made.append(generate(load(name).mechanism, choices[:1], target="lanes"))
            made.append(generate(load(name).mechanism, choices[:1], target="cuda"))
        for modules in made:
            for stem, (source, metadata) in modules.modules.items():
                text = source + repr(metadata)
                print(modules.folder, stem, hashlib.sha256(text.encode()).hexdigest())
"""


def start(script, arguments=(), cwd=None, **variables):
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONHASHSEED"} | variables
    return subprocess.Popen(
        [sys.executable, "-c", script, *map(str, arguments)],
        cwd=cwd,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def finished(process) -> str:
    out, errors = process.communicate(timeout=600)
    assert process.returncode == 0, errors
    return out


@pytest.mark.slow
def test_the_whole_catalogue_is_emitted_byte_for_byte_alike(tmp_path):
    """Straight, looped with tables, in lanes and for CUDA; all methods for the four-bar.

    Two processes that differ in hash seed, user, home, folder, zone and language.
    """
    here = start(EMIT_ALL, PYTHONHASHSEED="0")
    there = start(
        EMIT_ALL,
        cwd=tmp_path,
        PYTHONHASHSEED="4242",
        HOME=str(tmp_path),
        USER="somebody",
        LOGNAME="somebody",
        HOSTNAME="elsewhere",
        TZ="Asia/Tokyo",
        LC_ALL="C",
    )
    first, second = finished(here), finished(there)
    assert first == second
    stems = {tuple(line.split()[:2]) for line in first.splitlines()}
    for stem in ("model", "model_lanes", "model_cuda", "lagrange", "direct_correction_lanes", "machine", "mechanism"):
        assert sum(name == stem for _, name in stems) >= (1 if stem in ("machine", "mechanism") else 16), stem
    assert any(name.startswith("form_") for _, name in stems)


#: Evaluates every function of an emitted package at given states; imports nothing of symgen.
EVALUATE = """
import json, sys
import numpy as np
sys.path.insert(0, sys.argv[1])
from package import direct_correction_mass as law, model

case = json.load(open(sys.argv[2]))
result = []
for t, state in case["states"]:
    y, w, iw = np.array(state), np.zeros(case["nw"]), np.zeros(8, dtype=np.int64)
    p = np.zeros(case["np"])
    p[: len(case["parameters"])] = case["parameters"]
    p[case["offset"] : case["offset"] + len(case["own"])] = case["own"]
    rate, out = np.zeros(len(y)), np.zeros(64)
    for first, last in case["ones"]:  # scales, and pivots of rows that never change theirs
        w[first:last] = 1.0
    model.prepare(p)
    law.prepare(p)
    flags = [law.rhs(t, y, p, w, iw, rate), law.confirm(t, y, p, w, iw, rate), law.accept(t, y, p, w, iw)]
    model.observe(t, y, p, w, rate, out)
    result.append([flags, iw.tolist(), rate.tolist(), y.tolist(), w.tolist(), out.tolist()])
forbidden = sorted({m.partition(".")[0] for m in sys.modules} & {"symgen", "sympy", "jinja2", "msgspec"})
assert not forbidden, forbidden
print(json.dumps(result).replace("Infinity", "1e999"))
"""


def write_package(folder, emitted):
    package = folder / "package"
    package.mkdir()
    (package / "__init__.py").write_text("")
    for stem, (source, _) in emitted.generated.modules.items():
        (package / f"{stem}.py").write_text(source)


@pytest.mark.slow
def test_emitted_files_stand_alone_and_compute_the_same_without_compilation(tmp_path):
    model = load("driven-four-bar")
    emitted = Emitted(model.mechanism, "direct-correction", {"weight": "mass"})
    write_package(tmp_path, emitted)
    law, rng = emitted.law_info, np.random.default_rng(8)
    q, _ = model.initial_state(model.parameters())
    states = [[0.1 * k, [*(q + 1e-3 * rng.normal(size=9)), *rng.normal(size=9), 0.0]] for k in range(3)]
    case = {
        "states": states,
        "nw": law.nw,
        "np": law.parameter_offset + len(law.parameters) + law.hoisted,
        "parameters": list(model.parameters().values()),
        "offset": law.parameter_offset,
        "ones": [np.cumsum(emitted.info.sections[name]).tolist() for name in ("pivot", "gauge", "row_weight")]
        + [[STATUS.index(name), STATUS.index(name) + 1] for name in SCALES],
        "own": [default for _, default in law.parameters],
    }
    (tmp_path / "case.json").write_text(json.dumps(case))
    arguments = (tmp_path, tmp_path / "case.json")
    interpreted = start(EVALUATE, arguments, cwd=tmp_path, NUMBA_DISABLE_JIT="1")
    compiled = start(EVALUATE, arguments, cwd=tmp_path, NUMBA_DISABLE_JIT="0")
    plain, fast = json.loads(finished(interpreted)), json.loads(finished(compiled))
    for (t, state), a, b in zip(states, plain, fast, strict=True):
        assert a[:2] == b[:2]
        for x, y in zip(a[2:], b[2:], strict=True):
            np.testing.assert_allclose(x, y, rtol=1e-11, atol=1e-11)
        here = emitted.at(t, state[:9], state[9:18], emitted.parameters(model.parameters()))
        np.testing.assert_allclose(a[2][9:18], here.acceleration, rtol=1e-12, atol=1e-12)
