"""A notebook of ten cells: arguments complete by signatures, and every object shows itself.

Completion in notebooks asks `inspect.signature`, that in editors the types; both are looked at. What notebooks show
are ``_repr_html_``, ``_repr_svg_`` or ``_repr_latex_``, and the text of an object where there is none of these.
"""

import ast
import inspect
import subprocess
import sys
from pathlib import Path
from typing import Any, get_type_hints

import msgspec
import pytest
import sympy

import symgen
from symgen.base import keywords, settings
from symgen.describe.files import builder_keys
from symgen.describe.files.builder import MechanismBuilder
from symgen.describe.modal.modal_bodies import ModalSection, SpatialModalSection
from symgen.describe.parts import sections
from symgen.describe.parts.event_sections import EventSection

#: Cells, each with what its last line shows: the name of the method, and something that is in it.
CELLS = (
    ("import symgen\nmodel = symgen.load('four-bar')\nmodel", "_repr_svg_", "<svg"),
    ("symgen.list_methods()", "_repr_html_", "direct-correction"),
    ("model.inspect(method='lagrange', coordinates='absolute')", "_repr_html_", "Jacobian D"),
    ("model.equations", "_repr_html_", "9 velocities"),
    ("result = model.simulate(until=0.2, step=1e-3)\nresult", "_repr_html_", "direct-correction"),
    ("model.view(until=0.2, output_step=0.05)", "_repr_html_", "<iframe"),
    ("model.equilibrium(start={'crank.theta': 4.0})", "_repr_html_", "omega^2"),
    ("symgen.load('pendulum').linearise(at={'bob.x': 0.0})", "_repr_html_", "about the stable equilibrium"),
    (
        "symgen.load('pendulum').compare(['baumgarte:alpha=5:beta=5'], ['rk4'], [0.01], until=0.1, repeat=1)",
        "_repr_html_",
        "baumgarte, alpha=5, beta=5",
    ),
    (
        "symgen.load('pendulum').sweep({'method.alpha': [1, 5, 20]}, method='baumgarte', until=0.1)",
        "_repr_html_",
        "3 values from 1 to 20",
    ),
)
#: The longest line of text that stands for an object.
LONGEST = 200


def test_every_object_shows_itself() -> None:
    names: dict[str, Any] = {}
    for text, method, contained in CELLS:
        *before, last = ast.parse(text).body
        assert isinstance(last, ast.Expr)
        exec(compile(ast.Module(before, []), "<cell>", "exec"), names)
        shown = eval(compile(ast.Expression(last.value), "<cell>", "eval"), names)
        assert contained in getattr(shown, method)(), text
        assert 10 < len(repr(shown).splitlines()[0]) and (isinstance(shown, dict) or len(repr(shown)) <= LONGEST), text


def test_every_argument_of_a_cell_completes() -> None:
    """Each keyword that a cell gives is one of the signature, as is every setting that the call takes."""
    names: dict[str, Any] = {"symgen": symgen, "model": symgen.load("four-bar")}
    calls = 0
    for text, *_ in CELLS:
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
                signature = inspect.signature(eval(compile(ast.Expression(node.func), "<cell>", "eval"), names))
                kinds = {p.kind for p in signature.parameters.values()}
                assert inspect.Parameter.VAR_KEYWORD not in kinds, ast.unparse(node.func)
                assert {keyword.arg for keyword in node.keywords} <= set(signature.parameters)
                calls += 1
    assert calls == 12


def every_call() -> list[Any]:
    """Return the public functions that take settings, and the methods of models that do."""
    methods = [x for name, x in inspect.getmembers(symgen.Model, callable) if not name.startswith("_")]
    return [symgen.simulate, symgen.sweep, symgen.compare, *methods]


@pytest.mark.parametrize("call", every_call(), ids=lambda call: call.__qualname__)
def test_no_call_hides_its_arguments(call: Any) -> None:
    parameters = inspect.signature(call).parameters.values()
    assert not [p.name for p in parameters if p.kind is p.VAR_KEYWORD]
    text, table = inspect.getdoc(call) or "", settings.setting_names()
    for p in parameters:
        if p.kind is p.KEYWORD_ONLY and p.name in table and "**changes" in text:
            assert p.default == settings.default_of_setting(p.name)
            assert f"\n{p.name} : " in text and settings.setting_description(p.name).help in text


def test_keywords_are_the_settings_of_the_table() -> None:
    """Names and types; a start may be a result as well, times an array, and a condition one text."""
    assert keywords.keyword_names(keywords.RunKeywords) == settings.setting_names()
    wider = {"start": " | EndedRun", "times": "", "stop_when": "str | ", "record_when": "str | "}
    own = inspect.get_annotations(symgen.Settings)
    for kind in (keywords.DrivenKeywords, keywords.StateKeywords, keywords.PlaceKeywords, keywords.RunKeywords):
        for name, forward in kind.__annotations__.items():
            written = forward.__forward_arg__
            if name in wider:
                written = written.replace(wider[name], "").replace("Iterable", "Sequence")
            assert written == own[name], name


@pytest.mark.parametrize(
    ("keys", "structs", "left"),
    [
        (builder_keys.MechanismKeys, [sections.MechanismSection], {"name"}),
        (builder_keys.RunKeys, [sections.RunSection], set()),
        (builder_keys.TableKeys, [sections.TableSection], {"x", "y"}),
        (
            builder_keys.BodyKeys,
            [sections.BodySection, sections.SpatialBodySection, ModalSection, SpatialModalSection],
            set(),
        ),
        (builder_keys.EventKeys, [EventSection], set()),
    ],
    ids=lambda x: getattr(x, "__name__", ""),
)
def test_keys_of_the_builder_are_those_of_files(keys: type, structs: list[type], left: set[str]) -> None:
    fields = {field.name for struct in structs for field in msgspec.structs.fields(struct)}
    assert set(get_type_hints(keys)) == fields - left


@pytest.mark.parametrize("method", ["body", "event", "run", "table"])
def test_the_builder_completes(method: str) -> None:
    parameters = inspect.signature(getattr(MechanismBuilder("x"), method)).parameters.values()
    assert not [p for p in parameters if p.kind is p.VAR_KEYWORD] and len(list(parameters)) > 3


def test_symbols_have_the_names_of_documents() -> None:
    equations = symgen.load("four-bar").equations
    shown = sympy.latex(equations.D[0, 2])
    assert shown == r"\sin{\left(\theta_{\mathrm{crank}} \right)}"
    assert str(equations.q["crank.theta"]) == "crank.theta"


BAD = """
import symgen
model = symgen.load("pendulum")
model.simulate(metod="lagrange")
model.linearise(at="start", until=3)
model.sweep({}, untill=3)
symgen.MechanismBuilder("x").body("a", mas=1)
symgen.MechanismBuilder("x").joint("a", "revolute", between=("ground", "a"), pulleys=3)
"""
GOOD = """
import numpy as np
import symgen
from symgen.extension import METHODS, MultiplierMethod
model = symgen.load("pendulum")
first = model.simulate(method="lagrange", until=1.0, times=np.linspace(0.0, 1.0, 3), stop_when="t > 3")
model.simulate(start=first, until=2.0).view().save("x.html")
model.start(step=1e-3).reset(first)
print(model.compare(["lagrange"]).rows[0].error, model.sweep({"bob_mass": [1.0]}).counts["ok"])
"""


@pytest.mark.slow
def test_type_checkers_know_the_arguments(tmp_path: Path) -> None:
    """As `mypy --strict` of the user's own code; wrong names are found, right ones accepted."""
    for name, text, wrong in (("good", GOOD, 0), ("bad", BAD, 4)):
        file = tmp_path / f"{name}.py"
        file.write_text(text, encoding="utf-8")
        words = (sys.executable, "-m", "mypy", "--strict", "--no-error-summary", str(file))
        done = subprocess.run(words, capture_output=True, text=True, cwd=Path(symgen.__file__).parents[1])
        errors = [line for line in done.stdout.splitlines() if f"{name}.py" in line and ": error:" in line]
        assert len(errors) == wrong, done.stdout
