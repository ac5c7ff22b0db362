"""Folders of emitted modules are packages: they run with NumPy and Numba alone and give the numbers of a run."""

import json
import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

import symgen
from symgen import catalogue
from symgen.cli import main

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


def simulated(folder, alone, tmp_path, *arguments, compiled=False, fails=False):
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "NUMBA", "SYMGEN"))}
    environment |= {"NUMBA_CACHE_DIR": str(tmp_path / "numba")} | ({} if compiled else {"NUMBA_DISABLE_JIT": "1"})
    command = [sys.executable, "-I", "-S", "-c", RUN, str(alone), str(folder / "simulate.py"), *map(str, arguments)]
    done = subprocess.run(
        command, cwd=tmp_path, capture_output=True, text=True, timeout=600, check=False, env=environment
    )
    assert done.returncode == int(fails), done.stderr[-2000:]
    return done.stderr.strip().splitlines()[-1] if fails else json.loads(done.stdout)


def interpreted(*command):
    """What a script of a package says where Numba compiles nothing."""
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1"}
    return subprocess.run(
        [sys.executable, *command], capture_output=True, text=True, timeout=600, check=False, env=environment
    )


def agrees(name, alone, tmp_path, coordinates="absolute", steps=20, compiled=False):
    """A few steps of the package are those of a run."""
    folder = tmp_path / "emitted"
    arguments = ["--method", "direct-correction", "--coordinates", coordinates]
    assert main(["generate", name, "-o", str(folder), *arguments]) == 0
    start = json.loads((folder / "start.json").read_text())
    until = steps * start["step"]
    found = simulated(folder, alone, tmp_path, start["method"], until, compiled=compiled)
    settings = {"integrator": "rk4", "step": start["step"], "until": until, "coordinates": coordinates}
    result = symgen.load(name).simulate(method="direct-correction", shape="straight", **settings)
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


def test_a_package_gives_the_numbers_of_a_run(alone, tmp_path):
    found = agrees("four-bar", alone, tmp_path)
    assert next(iter(found)) == "t" and list(found)[-1] == "work"
    assert len((tmp_path / "emitted" / "simulate.py").read_text().splitlines()) <= 20


@pytest.mark.parametrize(
    ("method", "step", "says"),
    [
        ("lagrange", 0.2, "velocities violate the constraints by "),
        ("direct-correction", 0.4, "the energy is off by "),
    ],
)
def test_a_package_ends_where_a_run_would(method, step, says, alone, tmp_path):
    assert main(["generate", "pendulum", "--method", method, "-o", str(tmp_path / "emitted")]) == 0
    until = 200 * step
    found = simulated(tmp_path / "emitted", alone, tmp_path, method.replace("-", "_"), until, step, fails=True)
    run = symgen.load("pendulum").simulate(method=method, integrator="rk4", step=step, until=until, shape="straight")
    assert run.status == "failed"
    assert found.startswith(f"ArithmeticError: {says}")
    assert float(found.rpartition(" ")[2]) == pytest.approx(run.end, rel=1e-12)


def test_a_package_says_where_rows_that_stand_for_others_hardly_hold(alone, tmp_path):
    """Three parallel links under a bar, which fall until they lie flat: a run chooses other rows and goes on."""
    ends, angle = "points = { P = [-0.5, 0], Q = [0.5, 0] }\n", 0.3
    lines = ['[mechanism]\nname = "rack"\ngravity = [0, -9.81]\n[run]\nuntil = 0.4\nstep = 1e-3\n']
    tip = np.array([np.cos(angle), np.sin(angle)])
    lines.append(f"[bodies.bar]\nmass = 1.0\ninertia = 0.1\nposition = {tip.tolist()}\n")
    lines.append("points = { a = [-1, 0], b = [0, 0], c = [1, 0] }\n")
    for name, x in (("a", -1.0), ("b", 0.0), ("c", 1.0)):
        middle = (np.array([x, 0.0]) + tip / 2.0).tolist()
        lines.append(f"[bodies.l{name}]\nmass = 1.0\ninertia = 0.1\nposition = {middle}\nangle = {angle}\n{ends}")
        pin = '[joints.{}]\ntype = "revolute"\nbetween = ["{}", "l{}"]\nat = [{}, "{}"]\n'
        lines.append(pin.format(f"g{name}", "ground", name, [x, 0.0], "P"))
        lines.append(pin.format(f"h{name}", "bar", name, f'"{name}"', "Q"))
    path = tmp_path / "rack.toml"
    path.write_text("".join(lines))
    assert main(["generate", str(path), "--method", "direct-correction", "-o", str(tmp_path / "emitted")]) == 0
    stem = json.loads((tmp_path / "emitted" / "start.json").read_text())["method"]
    said = simulated(tmp_path / "emitted", alone, tmp_path, stem, fails=True)
    assert "the rows that stand for those left out hardly hold, and nothing here chooses others, at t = 0." in said


@pytest.mark.parametrize("method", ["lagrange", "direct-correction"])
def test_a_package_doubts_what_a_run_doubts(method, tmp_path):
    """Windows of two bars in line at 0.71 s: without correction nothing tells the branch."""
    assert main(["generate", "n-four-bar:2", "--method", method, "-o", str(tmp_path / "emitted")]) == 0
    script = str(tmp_path / "emitted" / "simulate.py")
    done = interpreted(script, method.replace("-", "_"), "0.72", "2e-3")
    assert done.returncode == 0, done.stderr[-2000:]
    asked = {"method": method, "integrator": "rk4", "step": 2e-3, "until": 0.72, "shape": "straight"}
    run = symgen.load("n-four-bar:2").simulate(**asked)
    passage = f"passed near a singular position at t = {run.rank_events[0].t_in:.6g} s"
    assert run.status == ("unverified" if method == "lagrange" else "ok") and passage in run.warnings[0]
    if method == "lagrange":
        assert f"UserWarning: unverified: {passage} and positions are not corrected: nothing tells" in done.stderr
    else:
        assert f"UserWarning: {passage}; the error there is not controlled by the step size" in done.stderr
    assert done.stderr.count("UserWarning") == 1


def test_a_package_says_what_it_is(tmp_path, capsys):
    folder = tmp_path / "emitted"
    assert main(["generate", "pendulum", "--method", "lagrange", "-o", str(folder), "--json"]) == 0
    listed = {Path(f["path"]).name for f in json.loads(capsys.readouterr().out)["files"]}
    assert {"__init__.py", "README.md", "simulate.py", "start.json", "model.py", "lagrange.py"} <= listed
    assert "python simulate.py" in (folder / "README.md").read_text()
    start = json.loads((folder / "start.json").read_text())
    assert start["parameters"] == symgen.load("pendulum").parameters()
    assert start["names"] == ["bob.x", "bob.y", "bob.vx", "bob.vy", "work"]
    first = {path.name: path.read_bytes() for path in folder.iterdir()}
    assert main(["generate", "pendulum", "--method", "lagrange", "-o", str(folder)]) == 0
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == first


def test_a_package_says_that_it_looks_for_no_events(tmp_path):
    path = tmp_path / "ball.toml"
    path.write_text(
        '[mechanism]\nname = "ball"\ngravity = [0, -9.81]\n[bodies.a]\ntype = "point"\nmass = 1.0\n'
        '[events.floor]\nwhen = "a.y < -1"\nreset = { "a.vy" = "-a.vy" }\n[events.seen]\nwhen = "a.y < -0.5"\n'
    )
    assert main(["generate", str(path), "--method", "lagrange", "-o", str(tmp_path / "emitted")]) == 0
    said = (tmp_path / "emitted" / "README.md").read_text()
    assert "Nothing here looks for events, as `symgen run` does: `floor` changes velocities.\n" in said
    done = interpreted("-W", "error", str(tmp_path / "emitted" / "simulate.py"), "lagrange", "1e-3")
    assert "UserWarning: nothing here looks for events, as a run does: `floor` changes velocities" in done.stderr


def test_the_energy_of_a_short_package_run_is_judged_at_its_end(alone, tmp_path):
    assert main(["generate", "pendulum", "--method", "direct-correction", "-o", str(tmp_path / "emitted")]) == 0
    found = simulated(tmp_path / "emitted", alone, tmp_path, "direct_correction", 40 * 0.4, 0.4, fails=True)
    run = symgen.load("pendulum").simulate(integrator="rk4", step=0.4, until=40 * 0.4, shape="straight")
    assert run.status == "failed" and run.steps == 40 and "energy" in run.reason
    assert found.startswith("ArithmeticError: the energy is off by ") and found.endswith(f"at t = {40 * 0.4}")


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_motions_that_jump_have_no_package_that_runs(coordinates, tmp_path):
    """On a tree what is prescribed is set, and corrections follow it: both went on behind the jump without a word."""
    path = tmp_path / "flip.toml"
    path.write_text(
        '[mechanism]\nname = "flip"\n[run]\nuntil = 1.0\n[bodies.a]\nmass = 1.0\ninertia = 0.1\n'
        '[joints.j]\ntype = "revolute"\nbetween = ["ground", "a"]\nat = [[0, 0], [0, 0]]\n'
        '[joints.motor]\ntype = "driver"\njoint = "j"\nvalue = "0.3 if t > 0.5 else 0"\n'
    )
    arguments = ["--method", "direct-correction", "--coordinates", coordinates]
    assert main(["generate", str(path), "-o", str(tmp_path / "emitted"), *arguments]) == 0
    assert not (tmp_path / "emitted" / "simulate.py").exists()
    said = (tmp_path / "emitted" / "README.md").read_text()
    assert "There is no `simulate.py`: " in said and "jumps by 0.3 rad at t = 0.5 s" in said


def test_a_package_warns_of_what_its_steps_may_miss(tmp_path):
    path = tmp_path / "pulse.toml"
    path.write_text(
        '[mechanism]\nname = "pulse"\n[run]\nuntil = 1.0\nstep = 1e-2\n[bodies.a]\ntype = "point"\nmass = 1.0\n'
        '[forces.f]\ntype = "force"\nbody = "a"\nforce = ["100 if 0.5021 < t < 0.5031 else 0", 0]\n'
    )
    assert main(["generate", str(path), "--method", "lagrange", "-o", str(tmp_path / "emitted")]) == 0
    done = interpreted(str(tmp_path / "emitted" / "simulate.py"), "lagrange", "1e-2")
    warned = symgen.load(path).simulate(method="lagrange", integrator="rk4").warnings
    assert len(warned) == 1 and f"UserWarning: {warned[0]}" in done.stderr


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


def test_what_does_not_close_is_generated_without_a_start(tmp_path):
    path = tmp_path / "open.toml"
    path.write_text(
        '[mechanism]\nname = "open"\ntitle = "a \\"\\"\\" title"\ngravity = [0, -9.81]\n'
        "[bodies.a]\nmass = 1.0\ninertia = 1.0\npoints = { P = [0.5, 0.0], Q = [-0.5, 0.0] }\n"
        '[joints.j]\ntype = "revolute"\nbetween = ["ground", "a"]\nat = [[0, 0], "P"]\n'
        '[joints.k]\ntype = "revolute"\nbetween = ["ground", "a"]\nat = [[9, 0], "Q"]\n'
    )
    folder = tmp_path / "emitted"
    assert main(["generate", str(path), "--method", "lagrange", "-o", str(folder)]) == 0
    assert not (folder / "simulate.py").exists()
    assert "There is no `simulate.py`" in (folder / "README.md").read_text()
    compile((folder / "__init__.py").read_text(), "x", "exec")


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


@pytest.mark.parametrize("link", ["mass = 0\ninertia = 0", "mass = 1e-12\ninertia = 1e-14"], ids=["none", "little"])
def test_packages_of_massless_and_light_bodies_give_the_numbers_of_runs(link, alone, tmp_path):
    """Eliminating v' divides by the mass, or leaves half of the digits: runs take another solver, packages too."""
    agrees(three_rods(tmp_path / "rods.toml", link), alone, tmp_path, steps=3)
    stem = json.loads((tmp_path / "emitted" / "start.json").read_text())["method"]
    assert stem == "direct_correction_augmented"


def test_a_solver_that_was_asked_for_is_emitted(tmp_path):
    model, folder = three_rods(tmp_path / "rods.toml", "mass = 1e-12\ninertia = 1e-14"), tmp_path / "emitted"
    wanted = ["--method", "lagrange", "--method", "baumgarte", "--option", "lagrange.solver=elimination"]
    assert main(["generate", model, "-o", str(folder), *wanted]) == 0
    assert (folder / "lagrange.py").exists() and (folder / "baumgarte_augmented.py").exists()


def test_methods_that_invert_m_are_not_emitted_for_massless_bodies(tmp_path, capsys):
    model, folder = three_rods(tmp_path / "rods.toml", "mass = 0\ninertia = 0"), tmp_path / "emitted"
    assert main(["generate", model, "-o", str(folder), "--shape", "looped"]) == 0
    assert (folder / "law_lagrange_augmented.py").exists()
    assert not list(folder.glob("*udwadia_kalaba*")) and not list(folder.glob("*augmented_hamiltonian*"))
    assert main(["generate", model, "-o", str(folder), "--method", "udwadia-kalaba"]) == 2
    assert "expected one that does with massless bodies" in capsys.readouterr().err
    assert main(["inspect", model, "--method", "lagrange", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["method"]["options"]["solver"] == "augmented"


def test_inspect_tells_the_solver_that_runs_take_for_light_bodies(tmp_path, capsys):
    model = three_rods(tmp_path / "rods.toml", "mass = 1e-12\ninertia = 1e-13")
    assert main(["inspect", model, "--method", "lagrange", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["method"]["options"]["solver"]
    run = symgen.load(model).simulate(method="lagrange", integrator="rk4", step=1e-3, until=1e-3)
    assert told == run.outcome.compiled.law.options["solver"] == "augmented"
    assert main(["inspect", model, "--method", "lagrange", "--option", "solver=elimination", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["method"]["options"]["solver"] == "elimination"


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


def test_methods_for_implicit_integrators_alone_have_nothing_to_simulate(tmp_path):
    folder = tmp_path / "emitted"
    assert main(["generate", "pendulum", "--method", "ggl", "-o", str(folder)]) == 0
    assert "no method here is for explicit integrators" in (folder / "README.md").read_text()


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(catalogue.known()))
def test_packages_of_the_catalogue_give_the_numbers_of_runs(name, alone, tmp_path):
    agrees(name, alone, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["bricard", "cam-follower", "flyball-governor", "scissor-lift", "spatial-slider-crank"]
)
def test_packages_in_joint_coordinates_give_the_numbers_of_runs(name, alone, tmp_path):
    agrees(name, alone, tmp_path, "joint")


@pytest.mark.slow
def test_a_package_is_compiled_by_numba_alone(alone, tmp_path):
    agrees("pendulum", alone, tmp_path, compiled=True)


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_the_method_that_a_package_starts_is_in_it(coordinates, tmp_path):
    """Bodies' own coordinates have their metric as the identity, and the module is called so."""
    folder = tmp_path / "emitted"
    arguments = ["--method", "direct-correction", "--option", "method.weight=body", "--coordinates", coordinates]
    assert main(["generate", "pendulum", "-o", str(folder), *arguments]) == 0
    stem = json.loads((folder / "start.json").read_text())["method"]
    assert (folder / f"{stem}.py").exists() and (folder / f"{stem}.json").exists()
