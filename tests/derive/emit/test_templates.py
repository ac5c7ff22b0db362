"""Templates are given what they ask for, in all of their branches, and nothing that they do not use."""

from itertools import product

import jinja2
import pytest
from jinja2 import meta

from symgen.base.files import templates_folder
from symgen.base.ir.interpolation import Interpolation
from symgen.base.ir.program import Correction
from symgen.derive.emit.emit import table_codes
from symgen.derive.emit.lane_modules import Inlined
from symgen.derive.emit.law_parts import Parts
from symgen.derive.emit.looped_modules import (
    PUSHED,
    emit_machine,
    emit_rotors,
    emit_shared_model,
    function_with_reactions,
)
from symgen.derive.emit.module import module_source
from symgen.derive.lower.looped.layout import PRESSED, TOUCHED

#: Those that are rendered by themselves; what else stands beside them are functions with loops, printed by `Parts`.
ALONE = {"parts/module.j2", "parts/table.j2", "curves/pieces.j2"}
ALONE |= {f"looped/{name}.j2" for name in ("machine.py", "model.py", "rotors.py", "pressed")}


def asked(template: str) -> set[str]:
    """Names that a template takes from outside, itself or in templates that it names."""
    tree = jinja2.Environment().parse((templates_folder() / template).read_text(encoding="utf-8"))
    named = [name for name in meta.find_referenced_templates(tree) if name is not None]
    return meta.find_undeclared_variables(tree).union(*map(asked, named))


def test_templates_that_are_rendered_alone(monkeypatch):
    given: dict[str, set[str]] = {}
    render = jinja2.Template.render

    def noted(self, values):
        given[self.name] = set(values)
        return render(self, values)

    monkeypatch.setattr(jinja2.Template, "render", noted)
    emit_machine("generator")
    emit_shared_model("generator")
    emit_rotors("generator")
    for drags, name in product((PRESSED, TOUCHED), PUSHED):
        function_with_reactions(name, drags)
    module_source("title", [], [], {}, {})
    x, y = (0.0, 1.0, 2.0), (1.0, 2.0, 4.0)
    table_codes([Interpolation("line", x, y), Interpolation("curve", x, y, ((1.0, 0.0, 0.0, 0.0),) * 2)])
    assert given.keys() == ALONE
    for template, values in given.items():
        assert asked(template) == values, template


@pytest.mark.parametrize(
    "template", sorted({f"parts/{path.name}" for path in (templates_folder() / "parts").glob("*.j2")} - ALONE)
)
def test_templates_of_functions_with_loops(template):
    known = Parts(Inlined(), Correction()).values.keys()
    assert asked(template) <= known


def test_every_value_of_functions_with_loops_is_asked_for():
    names = {f"parts/{path.name}" for path in (templates_folder() / "parts").glob("*.j2")} - ALONE
    assert set().union(*map(asked, names)) == set(Parts(Inlined(), Correction()).values)
