"""Describing a mechanism stays light: neither SymPy nor NumPy, nor anything that draws or compiles."""

import subprocess
import sys

import pytest

HEAVY = {"sympy", "numpy", "numba", "scipy", "jinja2", "rich", "click", "matplotlib", "pandas"}
LOAD = "from symgen.describe import load"


@pytest.mark.parametrize(
    "statement",
    [
        f"{LOAD}; [load(name) for name in ('andrews', 'n-four-bar:3', 'driven-four-bar')]",
        "import symgen.describe.files.json_schema as s; s.file_schema()",
        "from symgen.describe import catalogue; catalogue.entries()",
        "from symgen.describe.edits.template import new_file_text; new_file_text()",
        f"{LOAD}; from symgen.describe.facts.digest import digest; digest(load('four-bar'))",
    ],
)
def test_nothing_heavy_is_imported(statement):
    code = f"{statement}\nimport sys\nprint(*sorted(set(sys.modules) & {HEAVY!r}))"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert result.stdout.split() == []


def test_kinds_are_imported_only_when_asked_for():
    code = (
        f"{LOAD}; load('four-bar')\nimport sys\n"
        "print(*sorted(m for m in sys.modules if m.startswith(('symgen.describe.joints.', 'symgen.describe.forces.'))))"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert result.stdout.split() == [
        "symgen.describe.joints._paired",
        "symgen.describe.joints._space",
        "symgen.describe.joints.revolute",
    ]
