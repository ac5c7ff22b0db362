"""The wheel holds what the package needs, and works in an environment that knows nothing of this checkout."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from benchmarks.paper import build_wheel

ROOT = Path(__file__).resolve().parents[2]


def run(*command: str | Path, cwd: Path) -> str:
    environment = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "VIRTUAL_ENV")}
    done = subprocess.run(command, capture_output=True, text=True, cwd=cwd, check=False, env=environment, timeout=600)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_wheel(tmp_path_factory.mktemp("wheel"))


@pytest.mark.slow
def test_the_wheel_holds_templates_and_catalogue(wheel: Path) -> None:
    names = set(zipfile.ZipFile(wheel).namelist())
    for path in sorted((ROOT / "templates").rglob("*.j2")):
        assert f"symgen/templates/{path.relative_to(ROOT / 'templates').as_posix()}" in names
    for path in sorted((ROOT / "symgen").rglob("*")):
        if path.suffix in (".py", ".toml") or path.name == "py.typed":
            assert path.relative_to(ROOT).as_posix() in names
    assert all(name.startswith(("symgen/", "symgen-")) for name in names)
    assert any(name.endswith("licenses/LICENSE") for name in names)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_the_wheel_works_on_its_own(wheel: Path, tmp_path: Path) -> None:
    """In a fresh environment that sees this one's libraries, but not this checkout."""
    run(sys.executable, "-m", "venv", tmp_path / "venv", cwd=tmp_path)
    python = tmp_path / "venv" / "bin" / "python"
    run(python, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", wheel, cwd=tmp_path)
    inside = run(python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))", cwd=tmp_path).strip()
    libraries = Path(inside) / "libraries"
    libraries.mkdir()
    here = next(Path(p) for p in sys.path if p.endswith("site-packages"))
    for entry in here.iterdir():
        if not entry.name.startswith(("symgen", "_editable_impl_symgen", "__editable__")) and entry.suffix != ".pth":
            (libraries / entry.name).symlink_to(entry)
    (Path(inside) / "libraries.pth").write_text("libraries\n", encoding="utf-8")
    symgen = tmp_path / "venv" / "bin" / "symgen"
    where = run(python, "-c", "import symgen; print(symgen.__file__)", cwd=tmp_path).strip()
    assert Path(where).is_relative_to(tmp_path)
    assert "four-bar" in run(symgen, "list", cwd=tmp_path)
    run(symgen, "generate", "four-bar", "--output", "emitted", cwd=tmp_path)
    expected = (ROOT / "generated" / "four_bar" / "direct_correction.py").read_text(encoding="utf-8")
    assert (tmp_path / "emitted" / "direct_correction.py").read_text(encoding="utf-8") == expected
