"""Modules for people: the functions that run, each once, with names for places in arrays."""

import ast

import pytest
from support.golden import LOOPED, MODELS, emitted, emitted_looped

from symgen.run.compiling.looped import number_kernels


class Plain(ast.NodeTransformer):
    """Puts numbers for constants, and takes away what tells functions of the model and of accelerations apart."""

    def __init__(self, constants):
        self.constants = constants

    def visit_Name(self, node):
        if node.id in self.constants:
            return ast.Constant(self.constants[node.id])
        return ast.Name(plain(node.id), node.ctx)

    def visit_BinOp(self, node):
        self.generic_visit(node)
        both = node.left, node.right
        if isinstance(node.op, ast.Add) and all(isinstance(x, ast.Constant) and type(x.value) is int for x in both):
            return ast.Constant(node.left.value + node.right.value)
        return node


def plain(name):
    return {"accelerate": "rhs"}.get(name, name.removesuffix("_of_model"))


def functions(source):
    """The functions of a module by name and syntax."""
    tree = ast.parse(source)
    constants = {
        n.targets[0].id: n.value.value
        for n in tree.body
        if isinstance(n, ast.Assign) and isinstance(n.value, ast.Constant) and n.targets[0].id.isupper()
    }
    found = []
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            node.name = plain(node.name)
            found.append((node.name, ast.dump(Plain(constants).visit(node))))
    return sorted(found)


def modules_of(stem, modules):
    """The modules of a law in the cache: its own, and those that these import, without those that all laws share."""
    found, wanted = [], [stem]
    for each in wanted:
        found.append(modules[each])
        for node in ast.parse(modules[each]).body:
            shared = isinstance(node, ast.ImportFrom) and node.module.partition("_")[0] in ("model", "machine")
            if isinstance(node, ast.ImportFrom) and node.level == 1 and not shared and node.module not in wanted:
                wanted.append(node.module)
    return found


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize("model", MODELS)
def test_functions_of_straight_code_are_those_that_run(model):
    for stem, source in emitted(model).items():
        parts = modules_of(stem, emitted(model, False))
        assert functions(source) == sorted(f for part in parts for f in functions(part)), stem


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("model", LOOPED)
def test_functions_of_looped_code_are_those_that_run(model):
    divided = emitted_looped(model, False)
    names = number_kernels(divided)
    found = {names.get(stem, stem): stem for stem in divided}
    for stem, source in emitted_looped(model).items():
        parts = modules_of(found[stem], divided)
        assert functions(source) == sorted(f for part in parts for f in functions(part)), stem


@pytest.mark.slow
def test_a_law_that_closes_coordinates_has_both_right_hand_sides():
    source = emitted("four-bar")["coordinate_partitioning"]
    assert "def accelerate(" in source and "def rhs(" in source and "return accelerate(" in source


@pytest.mark.slow
def test_a_law_with_a_metric_of_its_own_calls_the_models_functions_by_another_name():
    assert "from model import geometry, measure\n" in emitted("four-bar")["direct_correction"], "it has no factor"
    source = emitted("four-bar")["mass_orthogonal_projection"]
    assert "from model import geometry as geometry_of_model, measure\n" in source
    assert "w[POSITION_MEASURE]" in source and "iw[ITERATIONS] += 1" in source and "p[TOLERANCE]" in source


def test_kernels_are_counted():
    one, two, form = ("joint_revolute_" + 16 * c for c in "012")
    found = number_kernels(["model", one, f"form_01234567_{form}", two])
    assert list(found.values()) == ["joint_revolute", "form_joint_revolute", "joint_revolute_2"]
