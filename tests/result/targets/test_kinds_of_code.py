"""Targets times kinds of printed functions: no printed function has a name that the target's own text has."""

import re
import subprocess

import pytest

from symgen import Settings
from symgen.base.errors import InputError
from symgen.compile.native.c99_words import HELPERS as HELPERS_OF_C
from symgen.compile.native.c99_words import RESERVED
from symgen.compile.native.javascript_code import HELPERS, LOOP_HELPERS
from symgen.derive.emit.module import render_template
from symgen.result.player.live import live_part
from symgen.result.player.motion_page import model_script
from symgen.result.targets import Request
from symgen.result.targets._c_model import CModel, sources
from symgen.result.targets._c_names import defined_names
from symgen.result.targets.fmu import fmu_files
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare
from tests.result.targets.compilers import STRICT
from tests.result.targets.kinds_of_code import FILES, mechanism_of

#: The method that bodies without inertia need is the default; in joint coordinates code is another.
COORDINATES = ("absolute", "joint")
_FUNCTION = re.compile(r"^static \w+ (\w+)\(", re.MULTILINE)


def model_of(kind, coordinates, folder, target):
    return CModel.of(Request(mechanism_of(kind), folder, coordinates=coordinates), target)


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", COORDINATES)
@pytest.mark.parametrize("kind", FILES)
def test_c_and_fmus_compile_without_a_warning(kind, coordinates, tmp_path):
    model = model_of(kind, coordinates, tmp_path, "fmu")
    texts = {"c": sources(model.values) | {"main.c": render_template("c/main.c.j2", model.values)}}
    for fmi in (2, 3):
        files = {name.removeprefix("sources/"): text.decode() for name, text in fmu_files(model, fmi).items()}
        texts[f"fmu{fmi}"] = {name: text for name, text in files.items() if name.endswith((".c", ".h"))}
    compiled = []
    for folder, files in texts.items():
        (tmp_path / folder).mkdir()
        for name, text in files.items():
            (tmp_path / folder / name).write_text(text)
        compiled += [tmp_path / folder / name for name in files if name in ("main.c", "fmu.c")]
    done = subprocess.run(
        ["cc", *STRICT, "-fsyntax-only", tmp_path / "c" / "cart.c", *compiled], capture_output=True, text=True
    )
    assert len(compiled) == 3 and done.returncode == 0, done.stderr[:3000]


@pytest.mark.by_turns(8)
@pytest.mark.slow
@pytest.mark.parametrize("kind", FILES)
def test_printed_functions_have_names_of_their_own(kind, tmp_path):
    model = model_of(kind, "absolute", tmp_path, "fmu")
    given = {*model.functions, *model.bound.functions}
    printed = _FUNCTION.findall(model.text)
    assert given & {"rhs", "take_steps", "close_row"} == {"rhs", "take_steps", "close_row"}
    assert given <= {*printed} and len(printed) == len({*printed})
    assert not ({*printed} - given) & (defined_names() | RESERVED - HELPERS_OF_C.keys())


@pytest.mark.slow
def test_names_of_templates_are_those_that_compilers_see(tmp_path):
    """What the templates define beside printed functions, as a compiler lists it."""
    model = model_of("everything", "absolute", tmp_path, "fmu")
    printed = {*_FUNCTION.findall(model.text)}
    for fmi in (2, 3):
        files = {name.removeprefix("sources/"): text for name, text in fmu_files(model, fmi).items()}
        for name, text in files.items():
            (tmp_path / name).write_bytes(text)
        done = subprocess.run(
            ["cc", "-std=c99", "-O0", "-c", "fmu.c", "-o", "fmu.o"], cwd=tmp_path, capture_output=True, text=True
        )
        assert done.returncode == 0, done.stderr
        listed = subprocess.run(["nm", "fmu.o"], cwd=tmp_path, capture_output=True, text=True, check=True).stdout
        names = {line.split()[2] for line in listed.splitlines() if line.split()[-2] in "tT"}
        own = {name for name in names - printed if not name.startswith("cart_") and name not in RESERVED}
        assert {"begin", "advance", "ensure_state"} < own
        assert {
            name for name in own if not name.startswith(f"fmi{fmi}")
        } <= defined_names()  # macros make some of these


@pytest.mark.by_turns(4)
@pytest.mark.fast("state with a formula")
@pytest.mark.parametrize("kind", FILES)
def test_a_page_has_emitted_names_inside_a_function(kind):
    """A second function of a name would replace the first without a word, and a constant would be an error."""
    mechanism = mechanism_of(kind)
    run = prepare(mechanism, Settings(shape="straight"), Purpose.STATE)
    live, reason = live_part(run.mechanism, run.compiled, run.start, 1e-3)
    assert live is not None, reason
    defined = re.findall(r"^function (\w+)", live.code, re.MULTILINE)
    defined += re.findall(r"^const (\w+) = \(.*=>", HELPERS + LOOP_HELPERS, re.MULTILINE)
    assert len(defined) == len({*defined}) and {"rhs", "take_steps", "describe"} <= {*defined}
    script = model_script(live)
    begin, end = script.index("const emitted = (() => {"), script.index("\n})();\n")
    assert live.code in script[begin:end]


@pytest.mark.slow
def test_code_that_a_compiler_refuses_is_named(tmp_path, monkeypatch):
    """The sentence of the compiler, for a printed function that has a name of the template."""
    from symgen.result.targets import TARGETS, _c_model

    monkeypatch.setattr(_c_model, "defined_names", frozenset)
    request = Request(mechanism_of("light body"), tmp_path / "cart.fmu")
    with pytest.raises(InputError, match=r"expected code that cc compiles, got .*'?begin"):
        TARGETS.get("fmu").write(request)
