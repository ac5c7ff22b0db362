"""Errors inside plugins: one sentence with file and line, exit code 2."""

import pytest

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
