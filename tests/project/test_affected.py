"""`make affected` runs the tests that a change enters, and no others."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from support import affected

FILES = {
    "pyproject.toml": "[tool.pytest.ini_options]\naddopts = '-q -p no:cacheprovider'\n",
    "tests/conftest.py": "",
    "tests/__init__.py": "",
    "tests/support/__init__.py": "",
    "symgen/__init__.py": "",
    "symgen/size.py": "LENGTH = 2.0\n",
    "symgen/area.py": "from symgen.size import LENGTH\n\ndef area():\n    return LENGTH**2\n",
    "symgen/shared.py": "def made():\n    return 3.0\n",
    "symgen/other.py": "def other():\n    return 1.0\n",
    "templates/page.j2": "a page",
    "tests/test_some.py": "import pathlib\nimport pytest\nfrom symgen import area, other, shared\n\n"
    "@pytest.fixture(scope='module')\ndef thing():\n    return shared.made()\n\n"
    "def test_area():\n    assert area.area() == 4.0\n\n"
    "def test_first(thing):\n    assert thing == 3.0\n\n"
    "def test_second(thing):\n    assert thing == 3.0\n\n"
    "def test_other():\n    assert other.other() == 1.0\n\n"
    "def test_page():\n    assert pathlib.Path('templates/page.j2').read_text() == 'a page'\n",
}


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A project of three modules and five tests, with the plugin."""
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    shutil.copy(affected.__file__, tmp_path / "tests" / "support" / "affected.py")
    return tmp_path


def run(project: Path, *words: str) -> tuple[set[str], str]:
    """Return the tests that ran, and what was printed."""
    command = [sys.executable, "-m", "pytest", "-p", "tests.support.affected", "-rA", *words, "tests"]
    # Compiled files are told apart by second and size: an edit in the second of the one before would not be seen.
    environment = os.environ | {"PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run(command, capture_output=True, text=True, cwd=project, check=False, env=environment)
    lines = [line.split() for line in done.stdout.splitlines()]
    return {
        line[1].partition("::")[2] for line in lines if line[:1] in (["PASSED"], ["FAILED"])
    }, done.stdout + done.stderr


def edit(project: Path, name: str, text: str) -> None:
    (project / name).write_text(text, encoding="utf-8")


@pytest.mark.slow
@pytest.mark.parametrize("words", [(), ("-n", "2")], ids=["one process", "workers"])
def test_what_a_change_enters_runs_and_what_failed_runs_again(words: tuple[str, ...], project: Path) -> None:
    every, printed = run(project, *words)
    if sys.version_info < (3, 12):
        assert "Python 3.12 and newer" in printed
        return
    assert every == {"test_area", "test_first", "test_second", "test_other", "test_page"}, printed
    assert run(project, *words)[0] == set()
    for name, text, expected in (
        ("symgen/other.py", "def other():\n    return 2.0 / 2.0\n", {"test_other"}),
        ("symgen/shared.py", "def made():\n    return 4.0 - 1.0\n", {"test_first", "test_second"}),
        ("templates/page.j2", "another page", {"test_page"}),
        ("symgen/size.py", "LENGTH = 1.0\n", {"test_area", "test_page"}),
        ("symgen/size.py", "LENGTH = 2.0\n", {"test_area", "test_page"}),
        ("templates/page.j2", "a page", {"test_page"}),
        ("tests/conftest.py", "# anew\n", every),
    ):
        edit(project, name, text)
        assert run(project, *words)[0] == expected, name
    assert run(project, *words)[0] == set()


def test_a_change_of_what_writes_code_enters_tests_that_ask_the_cache_for_code() -> None:
    tests = {"a": ["symgen/run/compiling/folders.py"], "b": ["symgen/derive/names.py"], "c": ["symgen/base/units.py"]}
    assert affected.affected_tests(tests, {"templates/c/model.c.j2"}) == {"a"}
    assert affected.affected_tests(tests, {"symgen/derive/names.py"}) == {"a", "b"}
    assert affected.affected_tests(tests, {"pyproject.toml"}) == {"a", "b", "c"}


def test_a_test_that_starts_processes_is_affected_by_all_that_they_may_enter() -> None:
    tests = {"a": [affected.PROCESS], "b": ["symgen/base/units.py"]}
    assert affected.affected_tests(tests, {"symgen/cli/sweep.py"}) == {"a"}
    assert affected.affected_tests(tests, {"docs/README.md"}) == set()
