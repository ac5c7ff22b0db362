"""What pages name exists: paths of the repository, modules and what stands in them, as text and for the site."""

import importlib
import re
from pathlib import Path

import pytest

from symgen.base.plugins import GROUP

ROOT = Path(__file__).resolve().parents[2]
PAGES = (*ROOT.glob("*.md"), ROOT / "benchmarks" / "README.md", *sorted((ROOT / "docs").rglob("*.md")))
#: In backticks; what a how-to guide tells to put into a file of its own is not there yet.
_PATH = re.compile(r"(?<!into )`((?:symgen|tests|templates|benchmarks|docs|examples|generated)/[\w./*-]+)`")
_NAME = re.compile(r"`(symgen(?:\.\w+)+)(?:\(.*?\))?`|^\.\. auto\w+:: ([\w.]+)$", re.MULTILINE)


def resolves(name: str) -> bool:
    """Whether a dotted name leads to a module, or to something in one."""
    parts = name.split(".")
    for k in range(len(parts), 0, -1):
        try:
            found: object = importlib.import_module(".".join(parts[:k]))
        except ModuleNotFoundError:
            continue
        for part in parts[k:]:
            found = getattr(found, part, None)
        return found is not None
    return False


def test_what_a_page_names_is_there() -> None:
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        missing = [path for path in _PATH.findall(text) if not any(ROOT.glob(path.rstrip("/")))]
        names = {name for pair in _NAME.findall(text) for name in pair} - {"", GROUP}
        missing += [name for name in names if not resolves(name)]
        assert not missing, page.relative_to(ROOT)


@pytest.mark.parametrize(
    ("name", "there"),
    [
        *((name, True) for name in ("symgen.run.loops.frame.loop", "symgen.compile.loopcode.padding.BLOCK")),
        *((name, False) for name in ("symgen.runtime.frame", "symgen.run.loops.frame.nothing", "nowhere.at.all")),
    ],
)
def test_names_that_moved_are_noticed(name: str, there: bool) -> None:
    assert resolves(name) is there
