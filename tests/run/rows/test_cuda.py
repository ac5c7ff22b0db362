"""Sweeps on a CUDA device against the same on a processor, by Numba's simulator; what is refused; what is emitted."""

import ast
import os
import re
import subprocess
import sys
import textwrap
from pathlib import Path

import numpy as np
import pytest

import symgen
from run.rows.cuda_cases import CASES
from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.cli import main
from symgen.compile.loopcode.bare import part as elements
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import generate
from symgen.run.layout import ensemble_abi as e
from symgen.study.ensemble.sweep_plan import make_ensemble

SCRIPT = Path(__file__).with_name("cuda_cases.py")
#: Those that are also compared with compiled code: one in the plane, one in space, one adaptive.
COMPILED = ("planar", "spatial", "baumgarte")


def simulate(*words: str, interpreted: bool = False, **more: str) -> subprocess.CompletedProcess[str]:
    """Run Python under the simulator; processors' code compiled, or interpreted as well."""
    environment = {**os.environ, "NUMBA_ENABLE_CUDASIM": "1", "NUMBA_DISABLE_JIT": str(int(interpreted)), **more}
    return subprocess.run(
        [sys.executable, "-W", "ignore", *words],
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
        env=environment,
        cwd=SCRIPT.parents[3],
    )


@pytest.fixture(scope="module")
def interpreted(tmp_path_factory):
    """Folder with the results of all cases, all code interpreted."""
    out = tmp_path_factory.mktemp("interpreted")
    done = simulate(str(SCRIPT), str(out), *CASES, interpreted=True)
    assert done.returncode == 0, done.stderr
    return out


@pytest.fixture(scope="module")
def compiled(tmp_path_factory):
    """Folder with the results of some cases, the processor's code compiled."""
    out = tmp_path_factory.mktemp("compiled")
    done = simulate(str(SCRIPT), str(out), *COMPILED)
    assert done.returncode == 0, done.stderr
    return out


@pytest.mark.by_turns(8)
@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_the_same_operations_in_the_same_order(case, interpreted):
    """With everything interpreted there is no freedom of contraction: every bit has to be the same."""
    found = np.load(interpreted / f"{case}.npz")
    for name in ("values", "summary", "status", "reason"):
        np.testing.assert_array_equal(found[f"cuda_{name}"], found[f"cpu_{name}"], err_msg=name)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("case", COMPILED)
def test_compiled_runs_to_rounding(case, compiled):
    found = np.load(compiled / f"{case}.npz")
    for name in ("status", "reason"):
        assert list(found[f"cuda_{name}"]) == list(found[f"cpu_{name}"])
    values = found["cpu_values"]
    scale = np.maximum(1.0, np.nanmax(np.abs(np.nan_to_num(values)), axis=(0, 2), keepdims=True))
    np.testing.assert_allclose(found["cuda_values"] / scale, values / scale, rtol=0, atol=1e-12)
    for name in ("steps", "rejected", "evaluations", "outputs", "code", "start"):
        column = e.SUMMARY.index(name)
        np.testing.assert_array_equal(found["cuda_summary"][:, column], found["cpu_summary"][:, column], err_msg=name)


@pytest.mark.slow
def test_the_cases_are_what_they_are_called(interpreted):
    """So that none of them compares less than it seems to."""

    def column(case, name):
        return np.load(interpreted / f"{case}.npz")["cuda_summary"][:, e.SUMMARY.index(name)]

    assert column("light", "light")[0] == 1.0 and column("light", "light")[1] == 0.0
    assert np.all(column("passage", "rank_event_count") == 2.0)
    # the narrowest of two passages is the first one
    assert 0.6 < column("passage", "narrowest_time")[0] < 0.8
    assert column("redundant", "redundant_rows")[0] == 1.0
    assert set(np.load(interpreted / "violated.npz")["cuda_status"]) == {"failed"}
    assert list(np.load(interpreted / "planar.npz")["cuda_status"]) == ["ok", "ok", "failed"]
    for case in set(CASES) - {"violated", "planar"}:
        status = np.load(interpreted / f"{case}.npz")["cuda_status"]
        assert status[0] == "ok", case
    steps = column("baumgarte", "steps")
    assert steps[0] != steps[1]  # threads of one block with steps of their own


def test_sizes_of_memory_of_a_thread_are_names():
    """A device's compiler takes a constant there and no expression; the simulator takes both."""
    source = Path(symgen.__file__).with_name("run") / "rows" / "device.py"
    tree = ast.parse(source.read_text(encoding="utf-8"))
    calls = [x for x in ast.walk(tree) if isinstance(x, ast.Call) and ast.unparse(x.func) == "cuda.local.array"]
    assert len(calls) > 10 and all(isinstance(call.args[0], ast.Name) for call in calls)


@pytest.mark.slow
def test_folders_belong_to_a_target(tmp_path):
    """What one target began, another must not continue: last digits differ."""
    script = f"""
        import symgen
        settings = dict(until=0.01, step=5e-3, output={str(tmp_path / "runs")!r})
        symgen.sweep("pendulum", {{"bob_mass": [1.0, 2.0]}}, **settings)
        try:
            symgen.sweep("pendulum", {{"bob_mass": [1.0, 2.0]}}, target="cuda", resume=True, **settings)
        except symgen.InputError as error:
            print(error)
    """
    done = simulate("-c", textwrap.dedent(script), interpreted=True)
    assert done.returncode == 0, done.stderr
    assert "the sweep that was begun there" in done.stdout


# -- what is refused ---------------------------------------------------------------------------------------------------


BASE = ("sweep", "pendulum", "--vary", "bob_mass=values(1,2)", "--until", "0.01")


@pytest.mark.slow
def test_without_a_device_and_without_the_simulator():
    """Also where there is a device: it is hidden."""
    command = [sys.executable, "-c", "from symgen.cli import main; raise SystemExit(main())", *BASE, "--target", "cuda"]
    environment = {**os.environ, "CUDA_VISIBLE_DEVICES": "", "NUMBA_ENABLE_CUDASIM": "0"}
    done = subprocess.run(command, capture_output=True, text=True, timeout=600, check=False, env=environment)
    assert done.returncode == 2 and done.stdout == ""
    assert done.stderr.count("\n") == 1 and "expected a CUDA device that Numba can use" in done.stderr
    assert "symgen[cuda]" in done.stderr and "NUMBA_ENABLE_CUDASIM=1" in done.stderr


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((*BASE, "--target", "cuda", "--scheduler", "tcp://here:1"), "expected the device of this machine"),
        (("generate", "pendulum", "--target", "cuda", "--shape", "looped"), "expected the straight shape, got looped"),
        (("generate", "pendulum", "--target", "cuda", "--method", "ggl"), "a method that explicit integrators solve"),
    ],
)
def test_what_does_not_fit_is_refused_in_one_sentence(words, said, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(list(words)) == 2
    captured = capsys.readouterr()
    assert captured.out == "" and captured.err.count("\n") == 1 and said in captured.err


def test_a_target_that_does_not_exist():
    with pytest.raises(InputError, match="target: expected one of cpu, lanes, cuda, got 'cud'; did you mean 'cuda'"):
        symgen.sweep("pendulum", {"bob_mass": [1.0]}, target="cud")


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_a_run_too_large_for_a_thread():
    settings = Settings(method="lagrange", options={"method.solver": "dense"}, until=0.01)
    with pytest.raises(InputError, match="target 'cuda': expected runs that need at most 496 KiB each, got"):
        make_ensemble(symgen.load("n-four-bar:30"), settings, {"vertical0.omega": [-1.0]}, {}, None, "cuda")


def test_tables_too_long_for_constant_memory():
    raw = {
        "mechanism": {"name": "long", "space": "planar"},
        "bodies": {"block": {"mass": 1.0, "inertia": 1.0}},
        "tables": {"f": {"x": [float(i) for i in range(4001)], "y": [0.0] * 4001}},
        "forces": {"push": {"type": "force", "body": "block", "force": ["f(t)", 0.0]}},
    }
    from support.emitted import mechanism_of

    mechanism = mechanism_of(raw)
    assert generate(mechanism, (choose_method("lagrange"),)).modules
    with pytest.raises(InputError, match="tables: expected at most 4000 points in all"):
        generate(mechanism, (choose_method("lagrange"),), target="cuda")


# -- what is emitted and loaded ----------------------------------------------------------------------------------------


@pytest.mark.slow
def test_emitted_modules_hold_device_functions_only(tmp_path):
    assert main(["generate", "four-bar", "--target", "cuda", "--all", "-o", str(tmp_path)]) == 0
    modules = sorted(tmp_path.glob("*.py"))
    assert len(modules) > 10 and all(path.stem.endswith("_cuda") for path in modules)
    for path in modules:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        functions = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]
        assert functions
        for function in functions:
            assert [ast.unparse(d) for d in function.decorator_list] == ["cuda.jit(device=True)"], function.name
        names = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
        froms = {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
        assert names <= {"math", "numpy"} and froms <= {"numba", *(p.stem for p in modules)}, path
        # nothing that a device lacks: arrays made at run time, calls of NumPy in functions
        assert not re.search(r"^ .*\bnp\.", path.read_text(encoding="utf-8"), re.MULTILINE), path


@pytest.mark.slow
def test_an_emitted_module_runs_without_symgen(tmp_path):
    """A kernel of one's own around the device functions, in a process that has only them."""
    assert main(["generate", "pendulum", "--target", "cuda", "--method", "lagrange", "-o", str(tmp_path / "one")]) == 0
    script = """
        import sys
        import numpy as np
        from numba import cuda
        sys.path.insert(0, sys.argv[1])
        import lagrange_cuda, model_cuda

        @cuda.jit
        def rates(y, p, w, iw, ydot):
            i = cuda.grid(1)
            model_cuda.prepare(p[i])
            lagrange_cuda.prepare(p[i])
            lagrange_cuda.rhs(0.0, y[i], p[i], w[i], iw[i], ydot[i])

        y, ydot = np.zeros((2, 7)), np.zeros((2, 7))
        y[:, :3] = [1.0, 0.0, 0.0]
        p, w = np.ones((2, 50)), np.zeros((2, 300))
        rates[1, 2](y, p, w, np.zeros((2, 20), dtype=np.int64), ydot)
        assert "symgen" not in sys.modules
        print(np.all(np.isfinite(ydot)) and np.array_equal(ydot[0], ydot[1]) and np.abs(ydot).max() > 0.1)
    """
    done = simulate("-c", textwrap.dedent(script), str(tmp_path / "one"))
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == ["True"]


@pytest.mark.slow
def test_a_sweep_on_processors_loads_nothing_of_cuda():
    script = (
        "import sys, symgen\n"
        "assert symgen.sweep('pendulum', {'bob_mass': [1.0]}, until=0.01).counts['ok'] == 1\n"
        "print(sorted(m for m in sys.modules if m.startswith('numba.cuda') or m == 'symgen.run.rows.device'))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=600, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == "[]"


def test_a_helper_that_was_forgotten_is_noticed():
    """A device function that would call one made for processors; the simulator alone would let it pass."""
    from symgen.run.rows.device import on_device

    with pytest.raises(ValueError, match="first needs 'elements' as a device function"):
        on_device(caller)


def first(array):
    return elements(array, 0, 1)


def caller(array):
    return first(array)
