"""Mechanisms whose names mean something in C, in its library or in emitted code: all compile, and the name is said."""

import shutil
import subprocess
from pathlib import Path

import pytest

from symgen import load
from symgen.cli import main
from symgen.derive.emit.module import render_template
from symgen.describe import catalogue
from symgen.result.targets import Request
from symgen.result.targets._c_model import CModel, sources
from symgen.result.targets._c_names import prefix_of
from symgen.result.targets._fmu_modes import values_of_exchange

#: Of the emitted functions and their variables, of the templates, of keywords, of the library.
NAMES = """
model real rhs least greatest power square accept small large sin exp fabs memcpy memset order stage middle t p q v i k
main-c fmu fmu2 fmi2 fmi3 h set dual gram number value parameter x ydot w iw size-t ny rows nq eof e pi component
instance status prepare prepare-model formulas-of is free first bool true int8-t double long-t random index select
stdin expf strange velocities-at struct state defaults row main every words count export step m advance
""".split()
FILE = """
[mechanism]
name = "{}"
gravity = [0.0, -9.81]
[parameters]
load = 2.0
[bodies.rod]
mass = "load"
inertia = 0.5
points = {{ top = [-0.5, 0.0] }}
[joints.pin]
type = "revolute"
between = ["ground", "rod"]
at = [[-0.5, 0.0], "top"]
[outputs.height]
value = "rod.y"
[events.down]
when = "rod.y < -0.2"
reset = {{ "rod.omega" = "-rod.omega" }}
"""


def described(name: str, folder: Path) -> Path:
    path = folder / f"{name}.toml"
    path.write_text(FILE.format(name))
    return path


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    folder = tmp_path_factory.mktemp("names")
    mechanism = load(described("swing", folder)).mechanism
    return CModel.of(Request(mechanism, folder), "fmu")


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("fmi", [2, 3])
def test_code_of_every_name_compiles(fmi, model, tmp_path):
    """Derived once: only the names that the mechanism gives differ."""
    common = model.values | values_of_exchange(model)
    at = {"at_column": 1, "at_output": 2, "at_state": 3, "at_rate": 4, "at_event": 5, "at_time": 6}
    for name in NAMES:
        prefix = prefix_of(name, model.text)
        values = {**common, "name": name, "prefix": prefix, "upper": prefix.upper()}
        folder = tmp_path / name
        folder.mkdir()
        files = sources(values) | {"main.c": render_template("c/main.c.j2", values)}
        fmu = render_template(
            "c/fmu.c.j2", {**values, **at, "fmi": fmi, "derivatives": None, "guid": "", "version": ""}
        )
        assert not {"main.c", "fmu.c"} & {*sources(values)}
        for file, text in (files | {"fmu.c": fmu}).items():
            (folder / file).write_text(text)
    texts = [str(path) for path in tmp_path.glob("*/*.c") if path.name in ("fmu.c", "main.c")]  # fmu.c has the third
    options = ("-std=c99",) if fmi == 2 else ()  # strict, and with all that compilers declare by default
    command = ["cc", *options, "-Wall", "-Wextra", "-Werror", "-fsyntax-only", *texts]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert len(texts) == 2 * len(NAMES) and done.returncode == 0, done.stderr[:2000]


@pytest.mark.slow
def test_names_of_the_catalogue_stay(model):
    for entry in (*catalogue.entries(), *catalogue.entries(catalogue.MACHINES)):
        assert prefix_of(entry.name, model.text) == entry.name.replace("-", "_")


@pytest.mark.slow
def test_another_name_is_said_and_the_program_runs(tmp_path, capsys):
    path, folder = described("size-t", tmp_path), tmp_path / "c"
    assert main(["generate", str(path), "--target", "c", "-o", str(folder)]) == 0
    said = capsys.readouterr().err
    assert said == "symgen: in C, names of 'size-t' begin with size_t_model: size_t has another meaning there\n"
    assert {file.name for file in folder.iterdir()} == {"size_t_model.c", "size_t_model.h", "main.c", "README.md"}
    assert shutil.which("cc")
    program = folder / "sim"
    subprocess.run(["cc", *map(str, folder.glob("*.c")), "-lm", "-o", str(program)], check=True)
    assert subprocess.run([str(program), "0.01", "1e-3"], capture_output=True, check=True).stdout.count(b"\n") == 12
