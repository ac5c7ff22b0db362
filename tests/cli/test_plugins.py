"""Methods, joints and integrators of one's own: files that a command loads, as the guides show them."""

import json
import re
from pathlib import Path
from types import SimpleNamespace

import pytest
from support.processes import symgen

from symgen.base import plugins
from symgen.base.errors import InputError
from symgen.base.plugins import load_plugin
from symgen.derive.methods import METHODS
from symgen.derive.methods._base import MultiplierMethod
from symgen.study import journal
from symgen.study.ensemble import recipe
from symgen.study.journal import Journal
from symgen.study.runner import Cell, run_cells

GUIDES = Path(__file__).resolve().parents[2] / "docs" / "howto"
_FILE = re.compile(r"`([\w-]+\.py)`:\n\n```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_TEXT = re.compile(r"^```text\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def guide(name: str, folder: Path) -> str:
    """Write the files that a guide shows into a folder; return its text."""
    text = (GUIDES / f"{name}.md").read_text(encoding="utf-8")
    for file, content in _FILE.findall(text):
        (folder / file).write_text(content, encoding="utf-8")
    return text


def run(*words: object, cwd: Path) -> dict:
    """Run a command that must succeed; return its JSON."""
    done = symgen([*words, "--json"], cwd=cwd)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_a_method_runs_and_is_compared_with_three_gains(tmp_path: Path) -> None:
    guide("own-method", tmp_path)
    own = ("pendulum", "--plugin", "velocity_feedback.py")
    result = run(
        "run",
        *own,
        "--method",
        "velocity-feedback",
        "--integrator",
        "rk4",
        "--step",
        "5e-3",
        "--until",
        "1",
        cwd=tmp_path,
    )
    assert result["status"] == "ok" and result["method"] == "velocity-feedback"
    names = ["lagrange", *(f"velocity-feedback:k={k}" for k in (1, 5, 20))]
    words = ("--integrators", "rk4", "--steps", "5e-3", "--until", "1", "--repeat", "1", "--jobs", "2")
    rows = run("compare", *own, "--methods", ",".join(names), *words, "-o", "report.md", cwd=tmp_path)["rows"]
    assert "--plugin velocity_feedback.py" in (tmp_path / "report.md").read_text(encoding="utf-8")
    assert [row["variant"] for row in rows] == ["", "k=1", "k=5", "k=20"]
    assert len({row["velocity_violation_max"] for row in rows}) == 4
    for gain, row in zip((1, 5, 20), rows[1:], strict=True):
        words = ("--method", "velocity-feedback", "--option", f"method.k={gain}", "--step", "5e-3", "--until", "1")
        single = run("run", *own, "--integrator", "rk4", *words, cwd=tmp_path)
        assert single["velocity_violation_max"] == row["velocity_violation_max"]


def test_a_joint_of_a_file_falls_as_atwood_says(tmp_path: Path) -> None:
    text = guide("own-joint", tmp_path)
    (tmp_path / "atwood.toml").write_text(_TEXT.findall(text)[0], encoding="utf-8")
    final = run("run", "atwood.toml", "--plugin", "thread.py", cwd=tmp_path)["final"]
    acceleration = 9.81 * (2.0 - 1.0) / (2.0 + 1.0)
    assert abs(final["q"]["left.y"] + 1.0 + 0.5 * acceleration * final["t"] ** 2) < 1e-11
    without = symgen(["run", "atwood.toml"], cwd=tmp_path)
    assert without.returncode == 2 and "joints.rope.type: expected a joint type, got 'thread'" in without.stderr


def test_an_integrator_has_its_order(tmp_path: Path) -> None:
    guide("own-integrator", tmp_path)
    words = ("run", "four-bar", "--method", "direct-correction", "--until", "0.5", "--max-energy-error", "10")
    tight = ("--integrator", "dop853", "--rtol", "1e-11", "--atol", "1e-12")
    exact = run(*words, *tight, cwd=tmp_path)["final"]["q"]["crank.theta"]
    own = (*words, "--plugin", "ab2.py", "--integrator", "ab2", "--step")
    coarse, fine = (run(*own, h, cwd=tmp_path)["final"]["q"]["crank.theta"] - exact for h in ("2e-3", "1e-3"))
    assert 3.0 < coarse / fine < 5.0


def test_guides_use_public_names_alone() -> None:
    """What has no leading underscore, of the package itself and of its one module for plugins."""
    pages = [*GUIDES.glob("*.md"), GUIDES.parent / "extending.md"]
    for page in pages:
        for block in re.findall(r"^```python\n(.*?)^```$", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL):
            modules = set(re.findall(r"^(?:from|import) (symgen[\w.]*)", block, re.MULTILINE))
            if page.stem.startswith("own-"):
                assert modules <= {"symgen", "symgen.extension"}, page.name
            assert not any("._" in module for module in modules), page.name


# -- what cannot be loaded ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("import no_such_module_at_all", "ModuleNotFoundError: No module named 'no_such_module_at_all'"),
        ("1 / 0", "ZeroDivisionError"),
        ("def", "SyntaxError"),
        (
            "from symgen.extension import METHODS\nMETHODS.register('lagrange', METHODS.get('ggl'))",
            "method 'lagrange' is registered twice",
        ),
        (None, "expected a Python file, .py, got no such file"),
    ],
)
def test_a_plugin_that_cannot_be_loaded_is_one_sentence(cli, tmp_path: Path, text: str | None, sentence: str) -> None:
    file = tmp_path / "bad.py"
    if text is not None:
        file.write_text(text, encoding="utf-8")
    code, out, err = cli("run", "pendulum", "--plugin", file)
    assert code == 2 and not out and sentence in err and err.count("\n") == 1
    assert str(file) not in plugins.loaded_plugin_files()


def test_another_ending_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="another ending"):
        load_plugin(tmp_path / "plugin.toml")


# -- caches and processes ----------------------------------------------------------------------------------------------


@pytest.fixture
def loaded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A file that other processes are to load, which this one has not run."""
    file = tmp_path / "told_by_file.py"
    file.write_text("from symgen.base.errors import InputError\nInputError.of_plugin = 'loaded'\n", encoding="utf-8")
    monkeypatch.setitem(plugins._files, str(file), file.read_bytes())
    return file


def of_plugin(task: object) -> dict[str, object]:
    """Return what the file leaves in a process that has loaded it."""
    return {"here": getattr(InputError, "of_plugin", "")}


@pytest.mark.slow
def test_processes_of_a_study_load_what_this_one_has(loaded: Path) -> None:
    outcomes, _ = run_cells([Cell(str(i), "", i) for i in range(2)], of_plugin, Journal(), processes=2)
    assert [outcome["here"] for outcome in outcomes.values()] == ["loaded", "loaded"]
    assert of_plugin(None) == {"here": ""}


@pytest.mark.parametrize("identity", [journal.code_identity, recipe.run_code_identity], ids=["journal", "sweep"])
def test_journals_and_sweeps_depend_on_the_text(identity, loaded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = identity()
    monkeypatch.setitem(plugins._files, str(loaded), b"another text")
    changed = identity()
    monkeypatch.delitem(plugins._files, str(loaded))
    assert len({before, changed, identity()}) == 3


def test_packages_are_plugins_by_an_entry_point(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is imported when a name is not among symgen's own, and not before."""

    class Installed(MultiplierMethod):
        """A method of a package."""

        name = "of-a-package"
        summary = "of a package"

        def target(self, system):
            """Return what D v' shall be."""
            return system.gamma

    asked = []

    def entry_points(group: str) -> list[SimpleNamespace]:
        asked.append(group)
        load = lambda: METHODS.register("of-a-package", Installed())  # noqa: E731
        return [SimpleNamespace(name="mine", value="my_package.methods", dist=None, load=load)]

    monkeypatch.setattr("importlib.metadata.entry_points", entry_points)
    monkeypatch.setattr(plugins, "_installed", None)
    assert METHODS.get("lagrange").name == "lagrange" and not asked
    try:
        assert METHODS.get("of-a-package").summary == "of a package" and asked == ["symgen.plugins"]
        assert METHODS.listing()["of-a-package"] == "of a package"
    finally:
        METHODS._loaded.pop("of-a-package", None)
