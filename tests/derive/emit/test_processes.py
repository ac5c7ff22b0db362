"""Emitted files across processes: the same bytes everywhere."""

import os
import subprocess
import sys

import pytest
from support.rotation import of_turn

from symgen.describe.catalogue import names

EMIT_ALL = """
import hashlib, sys
from symgen.api import load
from symgen.derive.lower.looped.looped_law import is_loopable
from symgen.derive.methods import METHODS
from symgen.derive.methods._base import EXPLICIT_FORMS
from symgen.run.compiling.pipeline import choose_method, generate

for name in sys.argv[1:]:
    for method in METHODS if name == "four-bar" else ("lagrange", "direct-correction"):
        options = [{}] + [{o.name: v} for o in METHODS.get(method).options for v in o.values]
        choices = tuple({c.stem: c for c in (choose_method(method, o) for o in options)}.values())
        made = [generate(load(name).mechanism, choices)]
        explicit = bool(EXPLICIT_FORMS & set(METHODS.get(method).forms))
        forms = [False] * explicit + [True] * bool(set(METHODS.get(method).forms) - EXPLICIT_FORMS)
        loops = [choose_method(method, o, implicit) for o in options for implicit in forms]
        loops = tuple(c for c in loops if is_loopable(c.method, c.options, c.implicit))
        made.append(generate(load(name).mechanism, loops, "looped"))
        if method in ("lagrange", "direct-correction"):
            made.append(generate(load(name).mechanism, choices[:1], target="lanes"))
            made.append(generate(load(name).mechanism, choices[:1], target="cuda"))
        for modules in made:
            for stem, (source, metadata) in modules.modules.items():
                text = source + repr(metadata)
                print(modules.folder, stem, hashlib.sha256(text.encode()).hexdigest())
"""


#: All methods for the first; an eighth of the others in a turn.
FIRST = "four-bar"
CHOSEN = (FIRST, *of_turn((name for name in names() if name != FIRST), 8))


def start(cwd=None, **variables):
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONHASHSEED"} | variables
    command = [sys.executable, "-c", EMIT_ALL, *CHOSEN]
    return subprocess.Popen(command, cwd=cwd, env=environment, stdout=-1, stderr=-1, text=True)


def finished(process) -> str:
    out, errors = process.communicate(timeout=600)
    assert process.returncode == 0, errors
    return out


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_the_catalogue_is_emitted_byte_for_byte_alike(tmp_path):
    """Straight, looped with tables, in lanes and for CUDA; all methods for the four-bar.

    Two processes that differ in hash seed, user, home, folder, zone and language.
    """
    elsewhere = {"HOME": str(tmp_path), "USER": "somebody", "LOGNAME": "somebody", "HOSTNAME": "elsewhere"}
    here = start(PYTHONHASHSEED="0")
    there = start(tmp_path, PYTHONHASHSEED="4242", TZ="Asia/Tokyo", LC_ALL="C", **elsewhere)
    first, second = finished(here), finished(there)
    assert first == second
    stems = {tuple(line.split()[:2]) for line in first.splitlines()}
    for stem in ("model", "model_lanes", "model_cuda", "lagrange", "direct_correction_lanes", "machine", "mechanism"):
        assert sum(name == stem for _, name in stems) >= (1 if stem in ("machine", "mechanism") else len(CHOSEN)), stem
    assert any(name.startswith("form_") for _, name in stems)
