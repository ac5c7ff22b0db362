"""Runs by Numba beside those by the own compiler: what counts as rounding, and what the page says."""

import json
import math
import signal

import pytest

from benchmarks import by_numba
from benchmarks.by_numba import Compiler, Computed, apart, claims, difference, end_of, page_table


def test_a_difference_is_over_the_largest_position_or_velocity():
    one, other = [[[1.0, 4.0]], [[1e-3]]], [[[1.0, 4.0 + 4e-6]], [[1e-3 + 1e-8]]]
    assert difference(one, other) == pytest.approx(1e-5)
    assert difference(one, one) == difference([[[0.0]]], [[[0.0]]]) == 0.0
    assert difference([[[1.0, math.nan]]], [[[1.0, math.nan]]]) == difference([[[1.0]]], [[[1.0], [2.0]]]) == math.inf


class Answer:
    """A compiler that has one answer."""

    def __init__(self, seconds, states, status="ok"):
        self.answer = Computed(seconds, states, status)

    def computed(self, name, kind):
        return self.answer


@pytest.mark.parametrize(
    ("other", "end"),
    [
        (Answer(9.0, [[[1.0 + 1e-12]]]), "ok"),
        (Answer(9.0, [[[2.0]]]), "states differ"),
        (Answer(9.0, [[[1.0]]], "failed"), "ok; Numba: failed"),
        (Answer(9.0, None, "no form"), "ok; Numba: no form"),
    ],
)
def test_a_scene_ends_alike_by_both_or_what_one_of_them_says_is_told(other, end):
    found = apart("four-bar", "run", Answer(1.0, [[[1.0]]]), other)
    assert end_of(found) == end and (found["own"], found["numba"]) == (1.0, 9.0)


def test_rounding_is_what_other_last_digits_of_parameters_make():
    own, far, moved = [[[1.0]]], [[[1.0 + 6e-9]]], [[[1.0 + 4e-9]]]

    class Sensitive(Answer):
        def computed(self, name, kind):
            return Computed(1.0, moved if kind == "moved" else own, "ok")

    found = apart("curved-lever", "run", Sensitive(1.0, own), Answer(9.0, far))
    assert found["difference"] == pytest.approx(6e-9) and found["moved"] == pytest.approx(4e-9)
    assert end_of(found) == "ok" and end_of(found | {"moved": 1e-9}) == "states differ"
    assert "moved" not in apart("curved-lever", "run", Sensitive(1.0, own), Answer(9.0, [[[1.0 + 1e-10]]]))


def test_the_page_names_differences_times_and_what_is_missing(tmp_path, monkeypatch):
    monkeypatch.setattr("benchmarks.records.FOLDER", tmp_path)
    monkeypatch.setattr(by_numba, "all_names", lambda: ("four-bar", "pendulum", "wiper"))
    monkeypatch.setattr(by_numba, "names", lambda: ("pendulum",))
    alone = {"alone": [2.0, 1.5, 40.0]}
    lines = [
        {"model": "pendulum", "own": 1.0, "numba": 20.0, "status": "ok", "difference": 2e-13} | alone,
        {"model": "wiper", "own": 3.0, "numba": 30.0, "says": "ok; Numba: no form"},
    ]
    (tmp_path / "by_numba.jsonl").write_text("\n".join(map(json.dumps, lines)), encoding="utf-8")
    assert page_table().measured() == [
        ["`pendulum`", "2e-13", "1", "20", "2", "1.5", "40"],
        ["`wiper`", "ok; Numba: no form", "3", "30", "", "", ""],
    ]
    assert list(claims()) == [
        "1 of 2 scenes agree to rounding, the largest difference being 2e-13.",
        "Medians, one scene after another: 1 s by the own compiler, 20 s by Numba.",
        "Scenes not measured: 1.",
    ]


@pytest.mark.slow
def test_a_process_has_the_compiler_that_is_asked_for_and_says_why_it_has_no_states(tmp_path):
    with Compiler("") as own:
        first, second = own.computed("pendulum", "run"), own.computed("pendulom", "run")
        assert first.status == "ok" and len(first.states) == 2 and first.seconds > 0.0
        assert second.states is None and "'pendulom'" in second.status
        own.process.send_signal(signal.SIGXCPU)  # as the system does after so much time
        own.process.wait()
        assert own.computed("pendulum", "run") == Computed(600.0, None, "too slow")
    with Compiler("") as own:
        own.process.kill()
        assert own.computed("pendulum", "run").status == "signal 9"
    assert own.process.returncode == -9
