"""What emitted source may contain: imports, names, literals, and how many operations."""

import ast
import re
from functools import cache

import pytest
from support import kinds
from support.emitted import mechanism_of
from support.models import EVERYTHING, ROUGH

from symgen.api import load
from symgen.derive.formulate.formulate import formulate
from symgen.derive.lower.law import lower_law
from symgen.derive.lower.model import lower_model
from symgen.derive.methods import METHODS
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import generate

MODELS = ("pendulum", "four-bar", "slider-crank", "driven-four-bar", "n-four-bar:2", "everything", "rough")
OWN = {"everything": EVERYTHING, "rough": ROUGH}


def mechanism(model: str):
    return mechanism_of(OWN[model]) if model in OWN else load(model).mechanism


@cache
def sources(model: str) -> dict[str, str]:
    """Stem -> source of the model and of methods with every option: of all methods for the four-bar."""
    choices = []
    for name in METHODS if model == "four-bar" else kinds.METHODS:
        method = METHODS.get(name)
        combinations = [{}] + [{o.name: value} for o in method.options for value in o.values]
        choices += {choice.stem: choice for choice in (choose_method(name, c) for c in combinations)}.values()
    return {stem: source for stem, (source, _) in generate(mechanism(model), tuple(choices)).modules.items()}


def trees(model: str):
    return [(stem, ast.parse(source)) for stem, source in sources(model).items()]


def straight_line(tree: ast.Module) -> list[ast.FunctionDef]:
    """The functions that were printed from blocks; they count their operations, those with loops do not."""
    functions = [n for n in tree.body if isinstance(n, ast.FunctionDef)]
    return [f for f in functions if re.search(r": \d+ operations", ast.get_docstring(f) or "")]


def is_condition(node: ast.expr) -> bool:
    """Whether a number is made of a comparison, which is what a literal factor 1.0 is for."""
    return any(isinstance(n, ast.Compare) for n in ast.walk(node))


@pytest.mark.by_turns(6)
@pytest.mark.fast("pendulum", "rough")
@pytest.mark.parametrize("model", MODELS)
def test_no_operation_with_a_literal_that_changes_nothing(model):
    for stem, tree in trees(model):
        for node in (n for f in straight_line(tree) for n in ast.walk(f)):
            if not isinstance(node, ast.BinOp):
                continue
            literals = {n.value for n in (node.left, node.right) if isinstance(n, ast.Constant)}
            where = f"{stem}, line {node.lineno}: {ast.unparse(node)[:80]}"
            if isinstance(node.op, ast.Mult) and not is_condition(node):
                assert not literals & {0.0, 1.0}, where
            if isinstance(node.op, ast.Add | ast.Sub):
                assert 0.0 not in literals, where
            if isinstance(node.op, ast.Div):
                divisor = node.right.value if isinstance(node.right, ast.Constant) else None
                assert divisor is None, f"{where}: a literal divisor is a literal factor"
            if not isinstance(node.op, ast.Add):  # 1.0 + (1.0 + x) is printed without parentheses
                assert not (isinstance(node.left, ast.Constant) and isinstance(node.right, ast.Constant)), where


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases("everything", "four-bar", "n-four-bar:2", "driven-four-bar")
@pytest.mark.parametrize("model", MODELS)
def test_every_name_is_used_and_every_line_is_needed(model):
    for stem, tree in trees(model):
        for function in straight_line(tree):
            stored = [n.id for n in ast.walk(function) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)]
            loaded = [n.id for n in ast.walk(function) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)]
            where = f"{stem}.{function.name}"
            assert set(stored) - set(loaded) <= {"_"}, where
            terms = [n for n in stored if re.fullmatch(r"s\d+", n)]
            assert len(set(terms)) == len(terms), f"{where}: straight-line terms are assigned once"


@pytest.mark.slow
def test_planar_code_knows_no_third_axis_and_no_ground():
    """Three columns a body, and none for the ground; nothing of z or of Euler parameters."""
    equations = formulate(mechanism("four-bar"))
    assert (equations.nq, equations.nv, equations.m) == (9, 9, 8)
    touched = {j for row in equations.rows for j, _ in row.entries}
    assert touched == set(range(9))
    ground_rows = [row for row in equations.rows if row.joint in ("A", "D")]
    assert all(len(row.entries) == 2 for row in ground_rows), "a pin on the ground: one translation and the angle"
    for stem, source in sources("four-bar").items():
        table = [line.split() for line in source.splitlines() if re.match(r"y\[\d+\] ", line)]
        assert all(not re.search(r"\.(z|e[0-3]|vz|w[xyz])$", line[1]) for line in table), stem
        assert "ground" not in re.sub(r"Left out:.*?\"\"\"", "", source, flags=re.DOTALL), stem


#: Operations of the four-bar's blocks as of writing; an upper bound, as fewer are welcome.
OPERATIONS = {
    "model": {"geometry": 129, "spread": 150, "measure": 75, "observe": 59, "masses": 0},
    "lagrange": {"rhs": 178},
    "baumgarte": {"rhs": 254},
    "direct-correction": {"rhs": 178, "spread": 147},
}


def test_operation_counts_of_the_four_bar_do_not_grow():
    equations = formulate(mechanism("four-bar"))
    program = lower_model(equations, "")
    found = {"model": {b.name: b.operations for b in program.blocks}}
    for name in ("lagrange", "baumgarte", "direct-correction"):
        law = lower_law(equations, program, METHODS.get(name), METHODS.get(name).complete_options({}))
        found[name] = {b.name: b.operations for b in law.blocks}
    for part, blocks in OPERATIONS.items():
        for block, bound in blocks.items():
            assert found[part][block] <= bound, f"{part}.{block}: {found[part][block]} operations"


def test_printed_operations_are_those_counted():
    """The count in a function's docstring is the number of operators and calls in its body, signs of literals aside."""
    for stem, tree in trees("slider-crank"):
        for function in (n for n in tree.body if isinstance(n, ast.FunctionDef)):
            said = re.search(r": (\d+) operations", ast.get_docstring(function) or "")
            if said is None:
                continue
            body = ast.Module(function.body[1:], [])
            operators = sum(
                isinstance(n, ast.BinOp | ast.Compare)
                or (isinstance(n, ast.UnaryOp) and not isinstance(n.operand, ast.Constant))
                or (isinstance(n, ast.Call) and ast.unparse(n.func) != "int")
                for n in ast.walk(body)
            )
            literal_factors = sum(  # step(a, b) is one operation, printed as 1.0*(a > b)
                isinstance(n, ast.BinOp) and isinstance(n.op, ast.Mult) and isinstance(n.right, ast.Compare)
                for n in ast.walk(body)
            )
            signs = sum(isinstance(n, ast.UnaryOp) and isinstance(n.operand, ast.Constant) for n in ast.walk(body))
            counted, printed = int(said.group(1)), operators - literal_factors
            assert printed <= counted and 0.98 * counted <= printed + signs, f"{stem}.{function.name}"


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases("everything", "four-bar", "n-four-bar:2")
@pytest.mark.parametrize("model", MODELS)
def test_the_header_says_what_it_must(model):
    for stem, source in sources(model).items():
        header = ast.get_docstring(ast.parse(source))
        assert re.search(r"digest [0-9a-f]{64}, format \d+, templates [0-9a-f]{16}", header), stem
        assert "do not edit" in header
        if stem == "model":
            equations = formulate(mechanism(model))
            for i, q in enumerate(equations.coordinates):
                assert re.search(rf"^y\[{i}\] +{re.escape(q.name)} \[{q.unit}\]$", header, re.MULTILINE)
            assert "Left out:" in header and f"{equations.m} constraint rows" in header
