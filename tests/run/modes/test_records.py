"""Records of rows with bounds: which file writes each field, read from the sources."""

import ast
from collections import defaultdict
from pathlib import Path

import symgen
from symgen.run.modes import row_records
from symgen.run.modes.row_records import Choice, Found, Placing, Problem, Reading, Rows

RUN = Path(symgen.__file__).parent / "run"
#: Records by the fields of `Choice` that hold them, and the file that writes all of their fields; none for constants.
WRITERS = {
    "rows": (Rows, None),
    "read": (Reading, "reading.py"),
    "found": (Found, "found_rows.py"),
    "problem": (Problem, "probing.py"),
    "placing": (Placing, "placing.py"),
}


def field_of(node: ast.expr) -> tuple[str, str] | None:
    """Return the record and the field that an expression such as ``c.read.value`` is, else None."""
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Attribute) and node.value.attr in WRITERS:
        record, _ = WRITERS[node.value.attr]
        return (node.value.attr, node.attr) if node.attr in record._fields else None
    return None


def pairs_of(target: ast.expr, value: ast.expr) -> list[tuple[ast.expr, ast.expr]]:
    """Return targets and values of an assignment one by one."""
    if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
        return [pair for own, of in zip(target.elts, value.elts, strict=True) for pair in pairs_of(own, of)]
    return [(each, value) for each in target.elts] if isinstance(target, ast.Tuple) else [(target, value)]


def written(source: str) -> set[tuple[str, str]]:
    """Return the fields whose elements a source assigns, by their names or by local ones."""
    found = set()
    for function in ast.walk(ast.parse(source)):
        if not isinstance(function, ast.FunctionDef):
            continue
        local: dict[str, tuple[str, str] | None] = {}
        nodes = [node for node in ast.walk(function) if isinstance(node, ast.Assign | ast.AugAssign)]
        targets = [
            pair
            for node in nodes
            for target in (node.targets if isinstance(node, ast.Assign) else [node.target])
            for pair in pairs_of(target, node.value)
        ]
        local = {target.id: field_of(value) for target, value in targets if isinstance(target, ast.Name)}
        for target, _ in targets:
            base = target.value if isinstance(target, ast.Subscript) else None
            place = local.get(base.id) if isinstance(base, ast.Name) else field_of(base) if base is not None else None
            if place is not None:
                found.add(place)
    return found


def test_each_field_is_written_by_one_file() -> None:
    writers: dict[tuple[str, str], set[str]] = defaultdict(set)
    for path in RUN.rglob("*.py"):
        for place in written(path.read_text(encoding="utf-8")):
            writers[place].add(path.name)
    for (record, field), files in writers.items():
        assert files == {WRITERS[record][1]}, f"{record}.{field}"
    assert len(writers) > 20


def test_what_is_written_by_a_local_name_is_found() -> None:
    assert written("def f(c):\n    a, b = c.read.value, 1.0\n    a[0] = b\n") == {("read", "value")}
    assert written("def f(c):\n    c.problem.matrix[0], x = 1.0, 2.0\n") == {("problem", "matrix")}
    assert written("def f(c):\n    x = c.problem.matrix[0]\n    c.forces[0] = x\n") == set()


def test_records_share_no_field() -> None:
    fields = [field for record in (Choice, *(own for own, _ in WRITERS.values())) for field in record._fields]
    shared = {field for field in fields if fields.count(field) > 1} - {"matrix", "order", "space"}
    assert shared == set(), row_records.__name__
