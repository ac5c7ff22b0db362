"""What libraries announce to change fails a test where the newest are tried, and nowhere else."""

import os
import subprocess
import sys
from pathlib import Path

import conftest
import pytest

ROOT = Path(__file__).resolve().parents[2]
TESTS = """
import warnings
import pytest

@pytest.mark.parametrize("kind", [DeprecationWarning, PendingDeprecationWarning, FutureWarning, RuntimeWarning])
def test_some(kind):
    warnings.warn("soon", kind)
"""


@pytest.mark.slow
@pytest.mark.parametrize(("heeded", "outcome"), [("", "1 failed, 3 passed"), ("1", "4 failed")])
def test_announcements_are_errors_where_they_are_asked_for(heeded: str, outcome: str, tmp_path: Path) -> None:
    """A warning of another kind, such as a division by zero, is always an error."""
    (tmp_path / "test_some.py").write_text(TESTS, encoding="utf-8")
    command = [sys.executable, "-m", "pytest", "-c", ROOT / "pyproject.toml", "-p", "conftest", tmp_path]
    environment = os.environ | {conftest.ANNOUNCEMENTS: heeded, "PYTHONPATH": str(ROOT / "tests")}
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False, env=environment)
    assert outcome in done.stdout.splitlines()[-1], done.stdout + done.stderr
