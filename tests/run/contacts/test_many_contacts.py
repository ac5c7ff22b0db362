"""Many contacts in one file: what their formulas take grows with their number, not with its square."""

import ast
from pathlib import Path

import pytest

from symgen.base.settings import Settings
from symgen.describe.bounds.bounded_modes import with_bounded_outputs
from symgen.run.compiling.events import compile_events
from symgen.run.compiling.side import Side, compile_side
from symgen.run.planning.prepare import prepare
from tests.run.contacts.scenes import body, head, loaded


def discs_on_a_floor(count: int, apart: float = 0.3) -> str:
    """Return discs beside each other on a floor: as many contacts as discs."""
    text = head("discs")
    for i in range(count):
        text += body(f"d{i}", 1.0, 0.005, (apart * i, 0.1))
        text += f'[contacts.c{i}]\nbetween = [{{ body = "d{i}", disc = 0.1 }}, {{ line = "ground" }}]\nfriction = 0.3\n'
    return text


def operations_in(side: Side, name: str) -> int:
    """Return the operations, calls and stored numbers that a function's text has."""
    tree = ast.parse(Path(side.path).read_text(encoding="utf-8"))
    (function,) = (x for x in tree.body if isinstance(x, ast.FunctionDef) and x.name == name)
    return sum(isinstance(x, ast.BinOp | ast.UnaryOp | ast.Call | ast.Assign) for x in ast.walk(function))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["events", "outputs"])
def test_operations_of_contacts_grow_with_their_number(name: str, tmp_path: Path) -> None:
    counts = list[int]()
    for count in (6, 12, 24):
        mechanism = loaded(discs_on_a_floor(count), tmp_path).mechanism
        compiled = prepare(mechanism, Settings(shape="looped", until=0.01)).compiled
        if name == "events":
            watched = compile_events(mechanism, compiled, mechanism.events)
            assert watched is not None
            side = Side(watched.function, Path(watched.function.py_func.__code__.co_filename), (), frozenset())
        else:
            formulas = [(x.name, x.value) for x in with_bounded_outputs(mechanism).outputs]
            side = compile_side(mechanism, compiled, "outputs", "Outputs", formulas)
        counts.append(operations_in(side, name))
    assert counts[1] < 2.2 * counts[0] and counts[2] < 2.1 * counts[1], counts
