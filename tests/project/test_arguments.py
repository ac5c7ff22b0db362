"""Functions of the runtime and of ensembles take records, not lists of arguments in an order that nothing checks."""

import ast
from pathlib import Path

import pytest

import symgen

#: Arguments that a function takes at most.
MOST = 12
PACKAGES = "compile", "run", "study/ensemble"


def arguments_of(source: str) -> dict[str, int]:
    """How many arguments each function of a module takes, those that name the object or the class left out."""
    functions = (n for n in ast.walk(ast.parse(source)) if isinstance(n, ast.FunctionDef | ast.AsyncFunctionDef))
    found = {}
    for function in functions:
        a = function.args
        names = [x.arg for x in (*a.posonlyargs, *a.args, *a.kwonlyargs)]
        found[f"{function.name}:{function.lineno}"] = len(names) - (names[:1] in (["self"], ["cls"]))
    return found


def test_all_kinds_of_arguments_are_counted():
    source = "class A:\n    def f(self, a, /, b, *c, d=1, **e): ...\n    async def g(x, self): ...\n"
    assert arguments_of(source) == {"f:2": 3, "g:3": 2}


@pytest.mark.slow_cases("run")
@pytest.mark.parametrize("package", PACKAGES)
def test_no_function_takes_a_long_list(package):
    files = sorted((Path(symgen.__file__).parent / package).rglob("*.py"))
    counts = {f"{file.name}:{name}": n for file in files for name, n in arguments_of(file.read_text("utf-8")).items()}
    assert len(counts) > 20
    assert {name: n for name, n in counts.items() if n > MOST} == {}
