"""The type checker reads what the compiler reads: records are annotated classes, and no function has types besides."""

import ast
from collections.abc import Iterator
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[2] / "symgen"
TEXTS = {path.relative_to(PACKAGE).as_posix(): path.read_text("utf-8") for path in PACKAGE.rglob("*.py")}
#: Rooms of the loop language.
ROOMS = ("effects", "layout", "loops", "modes", "printed", "rows", "starts")
LOOPS = ("compile/loopcode/", *(f"run/{room}/" for room in ROOMS))
#: Most parameters of the package that may take anything at all; those of them in rooms of the loop language.
MOST, MOST_OF_LOOPS = 210, 40


def trees(*words: str) -> dict[str, ast.Module]:
    """Return the syntax trees of the files in which one of some words occurs."""
    return {path: ast.parse(text) for path, text in TEXTS.items() if any(word in text for word in words)}


def functions(node: ast.AST) -> Iterator[ast.FunctionDef]:
    """Yield the functions of a module, in classes and in functions as well."""
    for inner in ast.iter_child_nodes(node):
        if isinstance(inner, ast.FunctionDef):
            yield inner
        if isinstance(inner, ast.stmt):
            yield from functions(inner)


def untyped(tree: ast.AST) -> Iterator[str]:
    """Yield the parameters whose annotation is `Any`."""
    for function in functions(tree):
        a = function.args
        for x in (*a.posonlyargs, *a.args, *a.kwonlyargs, *filter(None, (a.vararg, a.kwarg))):
            if isinstance(x.annotation, ast.Name) and x.annotation.id == "Any":
                yield f"{function.name}({x.arg})"


def records(of: dict[str, ast.Module]) -> dict[str, ast.ClassDef]:
    """Return the classes of records, by their names: those with `Record` among their bases."""
    classes = [node for tree in of.values() for node in tree.body if isinstance(node, ast.ClassDef)]
    found = {"Record": ast.ClassDef("Record", [], [], [], [])}
    while more := [c for c in classes if c.name not in found and any(ast.unparse(b) in found for b in c.bases)]:
        found |= {c.name: c for c in more}
    del found["Record"]
    return found


def decorators(of: dict[str, ast.Module], *names: str) -> Iterator[tuple[str, ast.Call]]:
    """Yield decorators with such names, and where they are."""
    for path, tree in of.items():
        for function in functions(tree):
            for d in function.decorator_list:
                if isinstance(d, ast.Call) and isinstance(d.func, ast.Name) and d.func.id in names:
                    yield f"{path} {function.name}", d


def test_records_are_classes_with_annotated_fields() -> None:
    found = records(trees("Record)", "State)", "Run)", "ModelSystem)", "OfModes)"))
    assert len(found) >= 31
    for name, record in found.items():
        fields = [node for node in record.body if isinstance(node, ast.AnnAssign)]
        others = [node for node in record.body if not isinstance(node, ast.AnnAssign | ast.Expr)]
        assert fields and not others and "Any" not in {ast.unparse(field.annotation) for field in fields}, name
    assert [path for path, text in TEXTS.items() if "namedtuple(" in text] == ["compile/native/annotations.py"]


def test_entries_have_the_types_of_their_annotations() -> None:
    found = list(decorators(trees("@exact(", "@jit("), "exact", "jit"))
    entries = [where for where, call in found if any(k.arg == "entry" for k in call.keywords)]
    assert len(found) > 150 and len(entries) > 50
    assert [where for where, call in found if call.args] == []


def test_few_parameters_take_anything() -> None:
    counts = {path: list(untyped(tree)) for path, tree in trees(": Any,", ": Any)", ": Any = ").items()}
    of_loops = {path: names for path, names in counts.items() if path.startswith(LOOPS) and names}
    assert sum(map(len, of_loops.values())) <= MOST_OF_LOOPS, of_loops
    assert sum(map(len, counts.values())) <= MOST, {path: names for path, names in counts.items() if names}


def test_what_takes_anything_is_noticed() -> None:
    text = "def f(a: int, *b: Any, c: Any = 0): ...\nclass A(Record):\n    x: int\nclass B(A):\n    y: int\n"
    text += "@exact(N(F))\ndef g(x: F): ...\n"
    tree = {"a.py": ast.parse(text)}
    assert list(untyped(tree["a.py"])) == ["f(c)", "f(b)"] and list(records(tree)) == ["A", "B"]
    assert [(where, len(call.args)) for where, call in decorators(tree, "exact")] == [("a.py g", 1)]
