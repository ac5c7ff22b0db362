"""Cases that take turns: in so many days each has its own, and all of them where all are asked for."""

from types import SimpleNamespace

import conftest
import pytest
from support.rotation import DAY, of_today


@pytest.mark.parametrize("days", [1, 2, 3, 7])
def test_each_case_has_one_day(days, monkeypatch):
    cases = list("abcdefghij")
    found = []
    for day in range(739_000, 739_000 + days):
        monkeypatch.setenv(DAY, str(day))
        found += of_today(cases, days)
    assert sorted(found) == cases
    monkeypatch.setenv(DAY, "all")
    assert of_today(iter(cases), days) == cases


class Item:
    """A collected test, as far as it is asked."""

    def __init__(self, name, **markers):
        self.nodeid, self.markers = name, markers

    def get_closest_marker(self, name):
        return self.markers.get(name)


@pytest.mark.parametrize(("day", "left"), [("0", ["a", "c", "f", "s"]), ("1", ["b", "f", "s"]), ("all", list("abcfs"))])
def test_fast_cases_and_tests_without_the_mark_are_there_every_day(day, left, monkeypatch):
    monkeypatch.setenv(DAY, day)
    mark, slow = SimpleNamespace(args=(2,)), SimpleNamespace(args=())
    items = [Item(f"test.py::test[{name}]", by_turns=mark, slow=slow) for name in "abc"]
    items += [Item("test.py::test[f]", by_turns=mark), Item("test.py::other[s]", slow=slow)]
    told = []
    hook = SimpleNamespace(pytest_deselected=lambda items: told.extend(items))
    everything = list(items)
    conftest._take_turns(SimpleNamespace(hook=hook), items)
    assert [item.nodeid[-2] for item in items] == left
    assert told == [item for item in everything if item not in items]
