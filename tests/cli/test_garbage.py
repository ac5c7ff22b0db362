"""A process of the command line leaves garbage collection alone while it imports and when it ends."""

from __future__ import annotations

import subprocess
import sys

import pytest

SPARING = """
import gc
usual = gc.get_threshold()
from symgen.cli import FIRST, sparing
sparing()
{body}
"""


def told(body: str) -> str:
    """Return what a process prints that begins as the command line does."""
    code = SPARING.format(body=body)
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout


def test_collection_is_as_usual_after_the_first_objects():
    said = told("kept = [[] for _ in range(2 * FIRST)]\nprint(gc.get_threshold() == usual, gc.get_freeze_count() > 0)")
    assert said == "True True\n"


def test_garbage_that_comes_later_is_collected():
    body = """
import weakref
class Ring: pass
kept = [[] for _ in range(2 * FIRST)]
ring = Ring(); ring.itself = ring; seen = weakref.ref(ring); del ring
gc.collect(); print(seen() is None)"""
    assert told(body) == "True\n"


def test_nothing_is_looked_through_when_the_process_ends():
    # atexit calls the last one registered first
    body = "print(gc.get_freeze_count())"
    code = "import atexit, gc\natexit.register(lambda: print(gc.get_freeze_count() > 0))\n" + SPARING.format(body=body)
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert said == "0\nTrue\n"


@pytest.mark.parametrize(("words", "changed"), [("", True), ("['--version']", False)])
def test_only_a_process_of_its_own_is_changed(words, changed):
    code = f"""
import gc, sys
usual = gc.get_threshold()
sys.argv = ["symgen", "--version"]
from symgen.cli import main
main({words})
print(gc.get_threshold() != usual)"""
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert said.splitlines()[-1] == str(changed)
