"""Cases that take turns: each belongs to one, and all of them run where all are asked for."""

import ast
import math
from pathlib import Path
from types import SimpleNamespace

import conftest
import pytest
from support.rotation import TURN, has_turn, of_turn


@pytest.mark.parametrize("turns", [1, 2, 3, 7])
def test_each_case_has_one_turn(turns, monkeypatch):
    cases = list("abcdefghij")
    found = []
    for turn in range(turns):
        monkeypatch.setenv(TURN, str(turn))
        found += of_turn(cases, turns)
    assert sorted(found) == cases
    monkeypatch.setenv(TURN, "all")
    assert of_turn(iter(cases), turns) == cases


def test_families_of_cases_begin_at_different_turns(monkeypatch):
    """Of two cases in four turns each turn has about half of the families, and each case of a family has its turn."""
    names, had = [f"tests/test_some.py::test_{i}" for i in range(50)], {}
    for turn in range(4):
        monkeypatch.setenv(TURN, str(turn))
        found = {name: of_turn("ab", 4, name) for name in names}
        assert 15 <= sum(map(len, found.values())) <= 35
        for name, cases in found.items():
            had.setdefault(name, []).extend(cases)
    assert all(sorted(cases) == ["a", "b"] for cases in had.values())


@pytest.mark.parametrize("turns", [2, 3, 5])
def test_a_test_without_cases_has_one_turn_and_names_differ_in_theirs(turns, monkeypatch):
    names, when = [f"tests/test_some.py::test_{i}" for i in range(50)], {}
    for turn in range(turns):
        monkeypatch.setenv(TURN, str(turn))
        for name in names:
            if has_turn(name, turns):
                when.setdefault(name, []).append(turn)
    assert [*map(len, when.values())] == [1] * len(names)
    assert {turn for (turn,) in when.values()} == set(range(turns))
    monkeypatch.setenv(TURN, "all")
    assert all(has_turn(name, turns) for name in names)


class Item:
    """A collected test, as far as it is asked."""

    def __init__(self, name, **markers):
        self.nodeid, self.markers = name, markers

    def get_closest_marker(self, name):
        return self.markers.get(name)


@pytest.mark.parametrize(
    ("turn", "left"), [("0", ["b", "f", "s"]), ("1", ["a", "c", "f", "s"]), ("all", list("abcfs"))]
)
def test_fast_cases_and_tests_without_the_mark_are_there_in_every_turn(turn, left, monkeypatch):
    monkeypatch.setenv(TURN, turn)
    mark, slow = SimpleNamespace(args=(2,)), SimpleNamespace(args=())
    items = [Item(f"test.py::test[{name}]", by_turns=mark, slow=slow) for name in "abc"]
    items += [Item("test.py::test[f]", by_turns=mark), Item("test.py::other[s]", slow=slow)]
    told = []
    hook = SimpleNamespace(pytest_deselected=lambda items: told.extend(items))
    everything = list(items)
    conftest._take_turns(SimpleNamespace(hook=hook), items)
    assert [item.nodeid[-2] for item in items] == left
    assert told == [item for item in everything if item not in items]


def shares_of(node, named):
    """Return the numbers of turns of calls of `of_turn` in a part of a module, and of the names that it reads."""
    found = set()
    for part in ast.walk(node):
        if isinstance(part, ast.Call) and getattr(part.func, "id", "") == "of_turn":
            found.add(ast.literal_eval(part.args[1]))
        elif isinstance(part, ast.Name):
            found |= named.get(part.id, set())
    return found


def never_together(text):
    """Return tests with turns of their own whose cases take turns as well, at numbers with a common divisor."""
    named, wrong = {}, []
    for node in ast.parse(text).body:
        if isinstance(node, ast.Assign | ast.AnnAssign):
            for target in node.targets if isinstance(node, ast.Assign) else [node.target]:
                named[getattr(target, "id", "")] = shares_of(node.value, named) if node.value else set()
        elif isinstance(node, ast.FunctionDef):
            own = [
                ast.literal_eval(mark.args[0])
                for mark in node.decorator_list
                if isinstance(mark, ast.Call) and getattr(mark.func, "attr", "") == "by_turns"
            ]
            inner = named[node.name] = shares_of(node, named)
            wrong += [node.name for turns in own for share in inner if math.gcd(turns, share) > 1]
    return wrong


def test_each_case_of_a_test_with_turns_of_its_own_has_one():
    """A test of every second turn would never reach the odd ones of six shares."""
    folder = Path(__file__).parents[1]
    texts = {path: path.read_text(encoding="utf-8") for path in folder.rglob("test_*.py") if path != Path(__file__)}
    both = {path: text for path, text in texts.items() if "mark.by_turns(" in text and "of_turn(" in text}
    assert len(both) > 10
    assert {path.name: wrong for path, text in both.items() if (wrong := never_together(text))} == {}


def test_a_common_divisor_is_found():
    text = "CASES = of_turn(range(9), 6)\n@pytest.mark.by_turns({})\ndef test_some():\n    assert CASES\n"
    assert never_together(text.format(4)) == ["test_some"]
    assert never_together(text.format(5)) == []
