"""Folders of emitted modules are packages: they run with NumPy and Numba alone and give the numbers of a run."""

import json
import os
import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from support.golden import SHOWN
from support.rotation import of_turn

import symgen
from symgen.cli import main
from symgen.compile.store.loaded_modules import load_module, plain_function
from symgen.derive.methods import METHODS
from symgen.describe import catalogue
from symgen.run.layout import abi
from symgen.run.layout.probe import Ready
from symgen.run.planning.prepare import prepare

#: What numpy and numba consist of.
ALONE = ("numpy", "numpy.libs", "numba", "llvmlite", "numba.libs", "llvmlite.libs")
RUN = """
import sys, runpy
sys.path.insert(0, sys.argv.pop(1))
found = {}
for name in ("symgen", "sympy", "scipy", "msgspec", "jinja2"):
    try:
        __import__(name)
    except ImportError:
        continue
    raise SystemExit(name + " is there")
sys.argv = sys.argv[1:]
runpy.run_path(sys.argv[0], run_name="__main__")
"""


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """A folder that holds numpy and numba and nothing else."""
    folder = tmp_path_factory.mktemp("alone")
    site = Path(find_spec("numpy").origin).parents[1]
    for name in ALONE:
        if (site / name).exists():
            (folder / name).symlink_to(site / name)
    return folder


def simulated(folder, alone, tmp_path, *arguments, compiled=False):
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "NUMBA", "SYMGEN"))}
    environment |= {"NUMBA_CACHE_DIR": str(tmp_path / "numba")} | ({} if compiled else {"NUMBA_DISABLE_JIT": "1"})
    command = [sys.executable, "-I", "-S", "-c", RUN, str(alone), str(folder / "simulate.py"), *map(str, arguments)]
    done = subprocess.run(
        command, cwd=tmp_path, capture_output=True, text=True, timeout=600, check=False, env=environment
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout)


def agrees(name, alone, tmp_path, coordinates="absolute", steps=20, compiled=False, method="direct-correction"):
    """A few steps of the package are those of a run."""
    folder = tmp_path / "emitted"
    arguments = ["--method", method, "--coordinates", coordinates]
    assert main(["generate", name, "-o", str(folder), *arguments]) == 0
    return agrees_in(folder, name, alone, tmp_path, coordinates, steps, compiled, method)


def agrees_in(
    folder, name, alone, tmp_path, coordinates="absolute", steps=20, compiled=False, method="direct-correction"
):
    """A few steps of a folder are those of a run."""
    start = json.loads((folder / "model.json").read_text())["run"]
    until = steps * start["step"]
    found = simulated(folder, alone, tmp_path, method, until, compiled=compiled)
    integrator = "rattle" if method == "rattle" else "rk4"
    settings = {"integrator": integrator, "step": start["step"], "until": until, "coordinates": coordinates}
    result = symgen.load(name).simulate(method=method, shape="straight", **settings)
    assert result.status == "ok", result.reason
    final = result.to_json()["final"]
    joints = dict(zip(result.joint_coordinates.names, np.asarray(result.joint_coordinates)[-1].tolist(), strict=True))
    expected = {**final["q"], **final["v"], **joints}
    known = [key for key in found if key in expected]
    assert known
    numbers, others = np.array([found[k] for k in known]), np.array([expected[k] for k in known])
    # the same operations in another order, twenty times: a few units in the last place of the largest numbers
    assert np.abs(numbers - others).max() <= 1e-11 * max(1.0, np.abs(others).max())
    return found


@pytest.mark.slow
def test_a_package_gives_the_numbers_of_a_run(alone, tmp_path):
    found = agrees("four-bar", alone, tmp_path)
    assert next(iter(found)) == "t" and list(found)[-1] == "work"


def test_a_package_has_a_module_a_method_and_says_what_it_is(tmp_path, capsys):
    folder = tmp_path / "emitted"
    wanted = ["generate", "slider-crank", "--method", "lagrange", "--method", "direct-correction", "-o", str(folder)]
    assert main([*wanted, "--json"]) == 0
    listed = {Path(f["path"]).name for f in json.loads(capsys.readouterr().out)["files"]}
    modules = {"model.py", "lagrange.py", "direct_correction.py"}
    assert listed == {p.name for p in folder.iterdir()} == {*modules, "README.md", "simulate.py", "model.json"}
    page = (folder / "README.md").read_text()
    assert "python simulate.py" in page and all(f"| `{name}` |" in page for name in listed - {"README.md"})
    about = json.loads((folder / "model.json").read_text())
    assert about["run"]["parameters"] == symgen.load("slider-crank").parameters()
    assert about["run"]["names"][:2] == ["crank.x", "crank.y"] and about["run"]["names"][-1] == "work"
    assert about["run"]["method"] == "direct_correction" and {*about["methods"]} == {"lagrange", "direct_correction"}
    first = {path.name: path.read_bytes() for path in folder.iterdir()}
    assert main(wanted) == 0
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == first


@pytest.mark.slow
def test_a_method_that_is_not_in_the_folder_is_named_with_those_that_are(tmp_path):
    symgen.load("pendulum").generate(tmp_path / "emitted")
    command = [sys.executable, str(tmp_path / "emitted" / "simulate.py"), "direct-corection"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert done.stderr == (
        "simulate.py: expected a method of this folder, one of direct-correction, got 'direct-corection'\n"
    )


def test_a_module_imports_the_model_alone(tmp_path):
    symgen.load("pendulum").generate(tmp_path / "emitted")
    source = (tmp_path / "emitted" / "direct_correction.py").read_text()
    assert set(re.findall(r"^(?:from|import) (\w+)", source, re.MULTILINE)) == {"math", "numba", "model"}


def test_all_methods_that_suit_a_mechanism(tmp_path):
    package = symgen.load("pendulum").generate(tmp_path / "emitted", None)
    assert {f"{name.replace('-', '_')}.py" for name in METHODS.names} < {path.name for path in package.files}
    about = json.loads((tmp_path / "emitted" / "model.json").read_text())
    assert about["run"]["method"] == "direct_correction" and len(about["methods"]) == len(METHODS.names)
    assert main(["generate", "pendulum", "--all", "--method", "ggl", "-o", str(tmp_path / "other")]) == 2


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("method", ["coordinate-partitioning", "null-space", "augmented-lagrangian"])
def test_a_package_gives_the_numbers_of_runs_by_other_methods(method, alone, tmp_path):
    agrees("four-bar", alone, tmp_path, method=method)


@pytest.mark.fast("four-bar-rattle")
@pytest.mark.by_turns(3)
@pytest.mark.slow_cases("front-suspension-direct-correction", "bricard-direct-correction")
@pytest.mark.parametrize(("name", "method"), [(name, method) for name in SHOWN for method in SHOWN[name]])
def test_packages_in_the_repository_give_the_numbers_of_runs(name, method, alone, tmp_path):
    folder = Path(__file__).resolve().parents[2] / "generated" / name.replace("-", "_")
    agrees_in(folder, name, alone, tmp_path, method=method, steps=10)
    command = re.search(r"^    symgen generate .*$", (folder / "README.md").read_text(), re.MULTILINE)[0].split()
    assert method in command and main([*command[1:-1], str(tmp_path / "anew")]) == 0
    assert {path.name for path in folder.iterdir()} - {"__pycache__"} == {p.name for p in (tmp_path / "anew").iterdir()}


#: What operations in another order leave of digits beyond 1e-12: a matrix of penalties over masses rounds 1e9 times as
#: much, momenta and Newton's iterations some times.
ROUNDING = {"penalty": 2e-8}
ROUNDING |= dict.fromkeys(("augmented-hamiltonian", "hamiltonian-baumgarte", "discrete-gradient"), 1e-11)
#: All methods of a folder in one process, whose import of Numba takes longer than a run.
RUN_ALL = """
import contextlib, io, json, runpy, sys
sys.path.insert(0, sys.argv.pop(1))
script, until, step, *methods = sys.argv[1:]
found = {}
for method in methods:
    sys.argv[:], printed = [script, method, until, step], io.StringIO()
    with contextlib.redirect_stdout(printed):
        runpy.run_path(script, run_name="__main__")
    found[method] = json.loads(printed.getvalue())
assert not {"symgen", "sympy", "scipy", "msgspec", "jinja2"} & {*sys.modules}
print(json.dumps(found))
"""


@pytest.mark.fast("four-bar-rattle")
@pytest.mark.parametrize(
    ("name", "methods"),
    [
        ("four-bar", ("rattle",)),
        *((name, METHODS.names) for name in ("four-bar", "slider-crank", "pendulum", "spatial-slider-crank")),
    ],
    ids=lambda value: value if isinstance(value, str) else "all" if len(value) > 1 else value[0],
)
def test_a_package_runs_the_scheme_of_its_method(name, methods, alone, tmp_path):
    """Every method, by NumPy and Numba alone; rk4 in place of a method's own scheme differs in the fourth digit."""
    model, folder, steps = symgen.load(name), tmp_path / "emitted", 8
    model.generate(folder, methods)
    step = 5.0 * json.loads((folder / "model.json").read_text())["run"]["step"]
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "NUMBA", "SYMGEN"))}
    command = [sys.executable, "-I", "-S", "-c", RUN_ALL, str(alone), str(folder / "simulate.py"), repr(steps * step)]
    done = subprocess.run(
        [*command, repr(step), *methods],
        capture_output=True,
        text=True,
        check=False,
        env=environment | {"NUMBA_DISABLE_JIT": "1"},
    )
    assert done.returncode == 0, done.stderr[-2000:]
    found = json.loads(done.stdout)
    limits = {"max_violation": 1.0, "max_energy_error": 10.0}
    settings = {"step": step, "until": steps * step, "shape": "straight", "coordinates": "absolute"}
    for method in methods:
        own = METHODS.get(method).default_integrator not in ("picard", "dop853")
        options = {"integrator.adaptive": "false"} if method == "ggl" else {}
        how = {} if own else {"integrator": "rk4"}
        final = model.simulate(method=method, options=options, **how, **settings, **limits).to_json()["final"]
        expected = {**final["q"], **final["v"]}
        off = max(abs(found[method][key] - expected[key]) for key in expected)
        assert off < ROUNDING.get(method, 1e-12) * max(1.0, *map(abs, expected.values())), (method, off)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_numba_compiles_the_step_of_a_scheme(alone, tmp_path):
    symgen.load("pendulum").generate(tmp_path / "emitted", "rattle")
    run = tmp_path / "emitted", alone, tmp_path, "rattle", 0.05, 0.01
    plainly, compiled = (simulated(*run, compiled=c) for c in (False, True))
    assert plainly.keys() == compiled.keys()
    assert max(abs(plainly[key] - compiled[key]) for key in plainly) < 1e-10


@pytest.mark.parametrize("target", ["cuda", "lanes"])
def test_code_for_other_targets_is_a_model_and_a_method(target, tmp_path):
    found = symgen.load("pendulum").generate(tmp_path / "emitted", "lagrange", target=target)
    names = {f"model_{target}.py", f"lagrange_{target}.py", "model.json", "README.md"}
    assert {path.name for path in found.files} == names
    assert "There is no `simulate.py`" in (tmp_path / "emitted" / "README.md").read_text()


def test_a_package_says_what_runs_do_besides(tmp_path):
    path = tmp_path / "ball.toml"
    path.write_text(
        '[mechanism]\nname = "ball"\ngravity = [0, -9.81]\n[bodies.a]\ntype = "point"\nmass = 1.0\n'
        '[events.floor]\nwhen = "a.y < -1"\nreset = { "a.vy" = "-a.vy" }\n[events.seen]\nwhen = "a.y < -0.5"\n'
    )
    assert main(["generate", str(path), "-o", str(tmp_path / "emitted")]) == 0
    page = (tmp_path / "emitted" / "README.md").read_text()
    assert "`symgen run` also" in page and page.endswith("Events of the mechanism: `floor` changes the state.\n")


PIN = 'type = "revolute"\nbetween = ["ground", "a"]\nat = [{}, {}]\n'
FLIP = (
    '[mechanism]\nname = "flip"\n[run]\nuntil = 1.0\n[bodies.a]\nmass = 1.0\ninertia = 0.1\n'
    f"[joints.j]\n{PIN.format('[0, 0]', '[0, 0]')}"
    '[joints.motor]\ntype = "driver"\njoint = "j"\nvalue = "0.3 if t > 0.5 else 0"\n'
)
OPEN = (
    '[mechanism]\nname = "open"\ntitle = "a \\"\\"\\" title"\ngravity = [0, -9.81]\n'
    "[bodies.a]\nmass = 1.0\ninertia = 1.0\npoints = { P = [0.5, 0.0], Q = [-0.5, 0.0] }\n"
    f"""[joints.j]\n{PIN.format("[0, 0]", '"P"')}[joints.k]\n{PIN.format("[9, 0]", '"Q"')}"""
)


@pytest.mark.parametrize(
    ("text", "arguments", "why"),
    [
        # on a tree what is prescribed is set, and corrections follow it: both would go on behind the jump
        (FLIP, ["--coordinates", "absolute"], "jumps by 0.3 rad at t = 0.5 s"),
        (FLIP, ["--coordinates", "joint"], "jumps by 0.3 rad at t = 0.5 s"),
        (OPEN, ["--method", "lagrange"], "cannot be assembled"),
    ],
)
def test_what_cannot_be_run_has_code_and_a_reason(text, arguments, why, tmp_path):
    (tmp_path / "model.toml").write_text(text)
    folder, model = tmp_path / "emitted", str(tmp_path / "model.toml")
    assert main(["generate", model, "-o", str(folder), *arguments]) == 0
    assert not (folder / "simulate.py").exists()
    assert re.search(rf"There is no `simulate\.py`: [^\n]*{re.escape(why)}", (folder / "README.md").read_text())
    assert "run" not in json.loads((folder / "model.json").read_text())


@pytest.mark.slow
def test_a_package_on_a_tree_has_the_state_of_its_start(alone, tmp_path):
    """A motor whose effort is integrated as an output keeps its row in runs; packages have no outputs."""
    path = tmp_path / "motor.toml"
    body = "mass = 1.0\ninertia = 0.1\npoints = { P = [-0.5, 0], Q = [0.5, 0] }\n"
    path.write_text(
        '[mechanism]\nname = "motor"\ngravity = [0, -9.81]\n[run]\nstep = 1e-3\n'
        f"[bodies.a]\n{body}position = [0.5, 0]\n[bodies.b]\n{body}position = [1.5, 0]\n"
        '[joints.j]\ntype = "revolute"\nbetween = ["ground", "a"]\nat = [[0, 0], "P"]\n'
        '[joints.k]\ntype = "revolute"\nbetween = ["a", "b"]\nat = ["Q", "P"]\n'
        '[joints.motor]\ntype = "driver"\njoint = "j"\nvalue = "sin(3*t)"\n'
        '[outputs]\ngiven = "integral(motor.power)"\n'
    )
    assert list(agrees(str(path), alone, tmp_path, "joint")) == ["t", "b.theta", "b.omega", "work"]


def three_rods(path, link):
    """Three rods on pins, the middle one with the masses `link`."""
    pin = '[joints.{}]\ntype = "revolute"\nbetween = ["{}", "{}"]\nat = [{}, {}]\n'
    ends = "points = { P = [-0.5, 0], Q = [0.5, 0] }\n"
    path.write_text(
        '[mechanism]\nname = "rods"\ngravity = [0, -9.81]\n[run]\nuntil = 0.01\nstep = 1e-3\n'
        f"[bodies.a]\nmass = 2.0\ninertia = 0.1\nangle = 0.4\n{ends}"
        f"[bodies.link]\n{link}\nangle = -1.1\nposition = [1.15, -0.1]\n{ends}"
        f"[bodies.b]\nmass = 1.0\ninertia = 0.1\nangle = 0.5\nposition = [1.8, -0.3]\n{ends}"
        + pin.format("j", "ground", "a", "[0, 0]", '"P"')
        + pin.format("k", "a", "link", '"Q"', '"P"')
        + pin.format("l", "link", "b", '"Q"', '"P"')
        + pin.format("m", "b", "ground", '"Q"', "[2.2, 0]")
    )
    return str(path)


def options_of(folder, method):
    """The options that a method has in a package."""
    return json.loads((folder / "model.json").read_text())["methods"][method]["options"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("link", "solver"),
    [("mass = 0\ninertia = 0", "augmented"), ("mass = 1e-12\ninertia = 1e-14", "elimination")],
    ids=["none", "little"],
)
def test_packages_of_massless_and_light_bodies_give_the_numbers_of_runs(link, solver, alone, tmp_path):
    """Eliminating v' divides by the mass: runs take another solver, packages too; determinants of loops do not."""
    agrees(three_rods(tmp_path / "rods.toml", link), alone, tmp_path, steps=3)
    assert options_of(tmp_path / "emitted", "direct_correction")["solver"] == solver


@pytest.mark.slow
def test_a_solver_that_was_asked_for_is_emitted(tmp_path):
    model, folder = three_rods(tmp_path / "rods.toml", "mass = 1e-12\ninertia = 1e-14"), tmp_path / "emitted"
    wanted = ["--method", "lagrange", "--method", "baumgarte", "--option", "lagrange.solver=augmented"]
    assert main(["generate", model, "-o", str(folder), *wanted]) == 0
    assert options_of(folder, "lagrange")["solver"] == "augmented"
    assert options_of(folder, "baumgarte")["solver"] == "elimination"


@pytest.mark.slow
def test_methods_that_invert_m_are_not_emitted_for_massless_bodies(tmp_path, capsys):
    model, folder = three_rods(tmp_path / "rods.toml", "mass = 0\ninertia = 0"), tmp_path / "emitted"
    assert main(["generate", model, "-o", str(folder), "--shape", "looped", "--all"]) == 0
    assert options_of(folder, "lagrange")["solver"] == "augmented"
    assert not list(folder.glob("*udwadia_kalaba*")) and not list(folder.glob("*augmented_hamiltonian*"))
    assert main(["generate", model, "-o", str(folder), "--method", "udwadia-kalaba"]) == 2
    assert "expected one that does with massless bodies" in capsys.readouterr().err
    assert main(["inspect", model, "--method", "lagrange", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["method"]["options"]["solver"] == "augmented"


@pytest.mark.slow
def test_inspect_tells_the_solver_that_runs_take_for_light_bodies(tmp_path, capsys):
    method = "coordinate-partitioning"
    model = three_rods(tmp_path / "rods.toml", "mass = 1e-12\ninertia = 1e-13")
    assert main(["inspect", model, "--method", method, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["method"]["options"]["solver"]
    run = symgen.load(model).simulate(method=method, integrator="rk4", step=1e-3, until=1e-3)
    assert told == run.outcome.compiled.law.options["solver"] == "augmented"
    assert main(["inspect", model, "--method", method, "--option", "solver=elimination", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["method"]["options"]["solver"] == "elimination"


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["json", "numpy", "version-1.0"])
def test_a_package_runs_whatever_its_folder_is_called(name, alone, tmp_path):
    assert main(["generate", "pendulum", "--method", "lagrange", "-o", str(tmp_path / name)]) == 0
    assert simulated(tmp_path / name, alone, tmp_path, "lagrange", 2e-3)["t"] == 2e-3


def test_files_of_other_people_stay_as_they_are(tmp_path):
    folder = tmp_path / "emitted"
    folder.mkdir()
    (folder / "README.md").write_text("mine")
    assert main(["generate", "pendulum", "--method", "lagrange", "-o", str(folder)]) == 0
    assert (folder / "README.md").read_text() == "mine"
    assert (folder / "simulate.py").exists()
    assert main(["generate", "pendulum", "--target", "cuda", "-o", str(folder)]) == 0
    assert not (folder / "simulate.py").exists(), "it reads what is no longer in model.json"


def changes_modes(name):
    raw = catalogue.raw(name)
    return "contacts" in raw or any({"friction", "clearance"} & {*joint} for joint in raw.get("joints", {}).values())


@pytest.mark.slow
@pytest.mark.parametrize("name", of_turn((name for name in catalogue.all_names() if not changes_modes(name)), 9))
def test_packages_of_the_catalogue_give_the_numbers_of_runs(name, alone, tmp_path):
    agrees(name, alone, tmp_path)


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["bricard", "cam-follower", "flyball-governor", "scissor-lift", "spatial-slider-crank"]
)
def test_packages_in_joint_coordinates_give_the_numbers_of_runs(name, alone, tmp_path):
    agrees(name, alone, tmp_path, "joint")


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_package_is_compiled_by_numba_alone(alone, tmp_path):
    agrees("pendulum", alone, tmp_path, compiled=True)


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_the_method_that_a_package_starts_is_in_it(coordinates, tmp_path):
    """Whatever its options are, of which some are others in the coordinates of bodies."""
    folder = tmp_path / "emitted"
    arguments = ["--method", "direct-correction", "--option", "method.weight=body", "--coordinates", coordinates]
    assert main(["generate", "pendulum", "-o", str(folder), *arguments]) == 0
    about = json.loads((folder / "model.json").read_text())
    assert about["run"]["method"] in about["methods"] and (folder / "direct_correction.py").exists()


@pytest.mark.by_turns(3)
@pytest.mark.fast("options0-model.py", "options1-direct_correction.py", "options2-model.json", "options3-machine.py")
@pytest.mark.parametrize(
    ("options", "name"),
    [
        ((), "model.py"),
        ((), "direct_correction.py"),
        ((), "model.json"),
        (("--shape", "looped"), "machine.py"),
        (("--target", "c"), "main.c"),
        (("--target", "c"), "pendulum.c"),
        (("--target", "c"), "pendulum.h"),
        (("--target", "javascript"), "pendulum.mjs"),
    ],
)
def test_a_file_of_somebody_else_is_left_alone(options, name, tmp_path, capsys):
    """Every file of a folder that symgen writes is replaced by the next one, and none that somebody else wrote."""
    folder = tmp_path / "emitted"
    command = ["generate", "pendulum", *options, "-o", str(folder)]
    assert main(command) == main(command) == 0
    files = {path.name: path.read_bytes() for path in folder.iterdir()}
    for path in folder.iterdir():
        path.unlink()
    (folder / name).write_text('{"parameters": 1}' if name.endswith("json") else "precious\n")
    capsys.readouterr()
    assert main(command) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and f"another '{folder / name}'; nothing was written" in said
    assert [path.name for path in folder.iterdir()] == [name]
    (folder / name).unlink()
    (folder / name).symlink_to(tmp_path / "nowhere")
    assert main(command) == 2
    assert not (tmp_path / "nowhere").exists()
    (folder / name).unlink()
    (folder / "README.md").write_text("mine")
    assert main(command) == 0
    assert {p.name: p.read_bytes() for p in folder.iterdir()} == files | {"README.md": b"mine"}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["dry-four-bar", "toggle-press"])
def test_code_of_dry_friction_and_stops_is_that_of_runs(name, tmp_path, monkeypatch):
    """Callers choose modes: with rows in force, with signs and with none, accelerations are those of runs."""
    assert main(["generate", name, "-o", str(tmp_path)]) == 0
    assert not (tmp_path / "simulate.py").exists()
    assert "modes of contacts, dry friction and stops are chosen" in (tmp_path / "README.md").read_text()
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "model", raising=False)
    law = load_module(tmp_path / "direct_correction.py")
    monkeypatch.delitem(sys.modules, "model")
    settings = symgen.Settings(method="direct-correction", integrator="rk4", coordinates="absolute")
    run = prepare(symgen.load(name).mechanism, settings)
    compiled, start = run.compiled, run.start
    signs = np.random.default_rng(1).choice([-1.0, 1.0], len(compiled.info.switchable))
    for held in (0.0, 1.0):
        found = []
        for rhs in (plain_function(law.rhs), Ready(compiled.law_module.rhs, abi.RHS)):
            w, rate = start.w.copy(), np.zeros_like(start.y)
            modes = compiled.modes(w)
            modes[:, 0], modes[:, 2] = 0.0, signs * (1.0 - held)
            modes[0, 0] = held
            flag = rhs(0.0, start.y.copy(), start.p, w, np.zeros(abi.N_COUNTERS, dtype=np.int64), rate)
            found.append([np.array([flag]), rate, compiled.section(w, "multipliers")])
        for mine, other in zip(*found, strict=True):
            np.testing.assert_allclose(mine, other, rtol=1e-11, atol=1e-11 * np.abs(other).max())
