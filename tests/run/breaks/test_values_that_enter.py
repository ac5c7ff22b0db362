"""New values of parameters: only formulas that read them are searched again, and rows stay single runs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

import numpy as np
import pytest

import symgen
from symgen.base.vocabulary.expressions import Expr
from symgen.describe.formulas.formula_text import to_text
from symgen.run.breaks.in_time import InTime, Passing

#: A wheel that a motor drives through a freewheel, which a clutch with a program presses; a wave brakes it.
FREEWHEEL = """
[mechanism]
name = "freewheel"
[run]
until = 2.0
[parameters]
mu = 0.5
k = 10.0
at = 0.3
pace = 7.0
[bodies.a]
mass = 1.0
inertia = 1.0
angular_velocity = -0.5
[bodies.b]
mass = 1.0
inertia = 1.0
[joints.out]
type = "revolute"
between = ["ground", "b"]
at = [[0, 0], [0, 0]]
[joints.free]
type = "revolute"
between = ["b", "a"]
at = [[0, 0], [0, 0]]
friction = { sliding = { forwards = 1e4, backwards = "3*mu*(1 if at < t and t < 0.95 or t > 1.6 else 0)" } }
[forces.motor]
type = "torque"
body = "a"
torque = "k*sin(6*pi*t)"
[forces.brake]
type = "torque"
body = "b"
torque = "-0.1*max(sin(pace*t), 0.3)"
"""
VALUES = {
    "mu": np.linspace(0.1, 1.0, 12),
    "k": np.linspace(8.0, 12.0, 12),
    "at": np.linspace(0.1, 0.9, 12),
    "pace": np.linspace(5.0, 9.0, 12),
}


@pytest.fixture(scope="module")
def freewheel(tmp_path_factory: pytest.TempPathFactory) -> symgen.Model:
    file = tmp_path_factory.mktemp("freewheel") / "freewheel.toml"
    file.write_text(FREEWHEEL, encoding="utf-8")
    return symgen.load(file)


@pytest.fixture
def searched(monkeypatch: pytest.MonkeyPatch) -> Iterator[Counter[str]]:
    """Numbers of searches by the formula, and of its evaluations one by one."""
    count, found, at = Counter[str](), Passing._found, InTime.value_at

    def counted(self: Passing, formulas: InTime, until: float, first: float) -> tuple[tuple[float, ...], int]:
        count[to_text(self.jump.argument)] += 1
        return found(self, formulas, until, first)

    def looked(self: InTime, e: Expr, t: float) -> float:
        count["evaluations"] += 1
        return at(self, e, t)

    monkeypatch.setattr(Passing, "_found", counted)
    monkeypatch.setattr(InTime, "value_at", looked)
    yield count


@pytest.mark.by_turns(2)
@pytest.mark.slow_cases("mu-reads0", "k-reads1")
@pytest.mark.parametrize(
    ("name", "reads"), [("mu", ("3.0*mu",)), ("k", ()), ("at", ("3.0*mu", "at - t")), ("pace", ("sin(pace*t)",))]
)
def test_only_formulas_that_a_value_enters_are_searched_again(
    freewheel: symgen.Model, searched: Counter[str], name: str, reads: tuple[str, ...]
) -> None:
    """Of a sweep of twelve values; those that are constant between conditions take an evaluation for each part."""
    freewheel.sweep({name: VALUES[name][:1]}, verify=False)
    searched.clear()
    freewheel.sweep({name: VALUES[name]}, verify=False)
    evaluations, again = searched.pop("evaluations", 0), {text for text, n in searched.items() if n > 2}
    assert len(again) == len(reads) and all(any(text.startswith(r) for text in again) for r in reads), searched
    assert evaluations <= 14 * 7 * ("3.0*mu" in reads)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("name", VALUES)
def test_rows_are_single_runs(freewheel: symgen.Model, name: str) -> None:
    """To the last bit, also where a value moves a jump."""
    times = np.linspace(0.0, 2.0, 21)
    rows = freewheel.sweep({name: VALUES[name]}, quantities=("q", "v"), times=times, verify=False)
    ends = set[float]()
    for r, value in enumerate(VALUES[name].tolist()):
        alone = freewheel.simulate(parameters={name: value}, times=times, verify=False)
        assert rows.status[r] == alone.status == "ok"
        for own in (*alone.q.names, *alone.v.names):
            np.testing.assert_array_equal(rows[own][r], alone[own])
        ends.add(float(alone["b.omega"][-1]))
    assert len(ends) == 12
