"""Cases that take turns: each belongs to one, and all of them run where all are asked for."""

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
    ("turn", "left"), [("0", ["a", "c", "f", "s"]), ("1", ["b", "f", "s"]), ("all", list("abcfs"))]
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
