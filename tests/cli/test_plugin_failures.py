"""Errors inside plugins: one sentence with file and line, exit code 2."""

import pytest

import symgen
from symgen.base.errors import InputError
from symgen.derive.methods import METHODS
from symgen.describe.parts.kinds import FORCES, JOINTS
from symgen.study.journal import Journal
from symgen.study.runner import Cell, run_cells


@pytest.fixture(autouse=True)
def registered_here_alone(monkeypatch):
    """What a test registers is gone after it: others go through all kinds."""
    for registry in (METHODS, JOINTS, FORCES):
        monkeypatch.setattr(registry, "_loaded", dict(registry._loaded))


METHOD = """
import sys

from symgen.extension import METHODS, MultiplierMethod


class Third(MultiplierMethod):
    name = "{name}"
    summary = "a test"
    reference = "a test"
    parameters = ()

    def target(self, system):
        {line}


METHODS.register("{name}", Third())
"""


@pytest.mark.parametrize(
    ("line", "error"),
    [("return system.nothing", "AttributeError"), ("sys.exit()", "SystemExit"), ("1/0", "ZeroDivisionError")],
)
def test_an_error_in_a_method_names_its_line(cli, tmp_path, line, error):
    name = f"broken-{error.lower()}"
    file = tmp_path / f"{name}.py"
    file.write_text(METHOD.format(name=name, line=line))
    code, _, err = cli("run", "pendulum", "--plugin", file, "--method", name, "--integrator", "rk4")
    assert code == 2 and f"{name}.py', line 14: expected code that runs, got {error}" in err
    assert len(err.strip().splitlines()) == 1


def test_a_plugin_that_exits_is_refused(cli, tmp_path):
    file = tmp_path / "leaving.py"
    file.write_text("import sys\nsys.exit()\n")
    code, _, err = cli("run", "pendulum", "--plugin", file)
    assert code == 2 and "expected a file that runs, got SystemExit" in err


def test_phi_of_a_method_has_the_name_of_the_notation(cli, tmp_path):
    file = tmp_path / "feedback.py"
    file.write_text(METHOD.format(name="feedback", line="return system.gamma - system.scale('mean_mass')*system.Phi"))
    assert (
        cli("run", "pendulum", "--until", "0.1", "--plugin", file, "--method", "feedback", "--integrator", "rk4")[0]
        == 0
    )


JOINT = """
import msgspec

from symgen.extension import FORCES, JOINTS


class Broken(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    \"\"\"A part that cannot be built.\"\"\"

    SPACES = ("planar", "spatial")

    def build(self, scope):
        return scope.nothing


JOINTS.register("broken-joint", Broken)
FORCES.register("broken-force", Broken)
"""
FILE = """
[mechanism]
name = "broken"

[bodies.a]
type = "point"
mass = 1.0

[{part}.b]
type = "{kind}"
"""


def ends_in_the_plugin(caught, file, cause):
    assert isinstance(caught.value.__cause__, cause)
    return f"plugin '{file}', line " in str(caught.value) and cause.__name__ in str(caught.value)


def test_python_gets_the_sentence_of_a_method_with_the_error_as_its_cause(tmp_path):
    file = tmp_path / "broken-python.py"
    file.write_text(METHOD.format(name="broken-python", line="1/0"))
    symgen.load_plugin(file)
    model, settings = symgen.load("pendulum"), {"method": "broken-python", "integrator": "rk4", "until": 0.1}
    for call in (
        lambda: model.simulate(**settings),
        lambda: symgen.simulate("pendulum", **settings),
        lambda: model.start(**settings),
        lambda: model.sweep({"bob.vx": [0.0, 1.0]}, **settings),
        lambda: model.compile("broken-python"),
        lambda: model.compare(["broken-python"], ["rk4"], until=0.1),
    ):
        with pytest.raises(InputError, match="line 14: expected code that runs, got ZeroDivisionError") as caught:
            call()
        assert ends_in_the_plugin(caught, file, ZeroDivisionError)


def test_python_gets_the_sentence_of_joints_and_forces(tmp_path):
    file = tmp_path / "broken-parts.py"
    file.write_text(JOINT)
    symgen.load_plugin(file)
    for part in ("joint", "force"):
        described = tmp_path / f"{part}.toml"
        described.write_text(FILE.format(part=f"{part}s", kind=f"broken-{part}"))
        with pytest.raises(InputError, match="line 13: expected code that runs, got AttributeError") as caught:
            symgen.load(described)
        assert ends_in_the_plugin(caught, file, AttributeError)


@pytest.mark.slow
def test_an_error_in_another_process_is_the_same_sentence(tmp_path):
    file = tmp_path / "broken-there.py"
    file.write_text("def compute(task):\n    return 1 / task\n")
    compute = symgen.load_plugin(file).compute
    cells = [Cell(str(i), "one", 0) for i in range(2)]
    with pytest.raises(InputError, match="line 2: expected code that runs, got ZeroDivisionError"):
        run_cells(cells, compute, Journal(), processes=2)


def test_an_error_of_a_caller_stays_what_it_is():
    def progress(reached):
        raise ValueError("of the caller")

    with pytest.raises(ValueError, match="of the caller"):
        symgen.simulate("pendulum", until=20.0, integrator="rk4", step=1e-5, progress=progress)
