"""A process of the command line leaves garbage collection alone while it imports and when it ends, and warns nobody."""

import subprocess
import sys

import pytest

# Python 3.12 begins with objects of its own that it does not look through
SPARING = """
import gc
usual, excluded = gc.get_threshold(), gc.get_freeze_count()
from symgen.cli import FIRST, spare_collections
spare_collections()
{body}
"""


def printed(code: str) -> str:
    """Return what a process prints."""
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize(
    "body",
    [
        "kept = [[] for _ in range(2 * FIRST)]\n"
        "print(gc.get_threshold() == usual and gc.get_freeze_count() > excluded)",
        "import weakref\nclass Ring: pass\nkept = [[] for _ in range(2 * FIRST)]\n"
        "ring = Ring(); ring.itself = ring; dead = weakref.ref(ring); del ring\ngc.collect(); print(dead() is None)",
    ],
    ids=["as usual after the first objects", "later garbage is collected"],
)
def test_collection_comes_late(body: str) -> None:
    assert printed(SPARING.format(body=body)) == "True\n"


def test_nothing_is_looked_through_when_the_process_ends() -> None:
    # atexit calls the last one registered first
    body = SPARING.format(body="print(gc.get_freeze_count() == excluded)")
    code = f"import atexit, gc\natexit.register(lambda: print(gc.get_freeze_count() > excluded))\n{body}"
    assert printed(code) == "True\nTrue\n"


def test_no_command_fails_by_what_a_library_announces() -> None:
    code = "import sys, warnings\nfrom symgen.cli import main\nsys.argv = ['symgen', '--version']\nmain()\n"
    code += "for kind in (DeprecationWarning, FutureWarning):\n    warnings.warn('soon', kind)\nprint('went on')"
    command = [sys.executable, "-W", "error", "-c", code]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout.endswith("went on\n")


@pytest.mark.parametrize(("words", "changed"), [("", True), ("['--version']", False)])
def test_only_a_process_of_its_own_is_changed(words: str, changed: bool) -> None:
    code = "import gc, sys\nusual = gc.get_threshold()\nsys.argv = ['symgen', '--version']\n"
    code += f"from symgen.cli import main\nmain({words})\nprint(gc.get_threshold() != usual)"
    assert printed(code).splitlines()[-1] == str(changed)
