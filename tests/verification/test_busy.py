"""Ratios beside busy processes: what counts as a change, and which intervals hold the ratio alone."""

from types import SimpleNamespace

import pytest

from benchmarks.busy import Ratios, measure
from symgen.study.comparison.turns import Turns

OUTCOME = SimpleNamespace()


def turns(*ratios, wall=1.0):
    return Turns(OUTCOME, (1.0,) * len(ratios), (wall,) * len(ratios), ratios)


def test_a_change_is_that_of_a_median_and_an_interval_holds_the_middle_of_all_ratios_alone():
    alone = [turns(1.0, 1.1, 1.2), turns(1.1, 1.1, 1.3)]
    found = Ratios(alone, [turns(1.15, 1.21, 1.4, wall=3.0), turns(1.0, 1.1, 1.3, wall=2.0)])
    assert found.middle == pytest.approx(1.1)
    assert found.shifts == pytest.approx([0.1, 0.0])
    assert (found.held(found.alone), found.held(found.beside)) == (2, 1)
    assert found.load == pytest.approx(2.5)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_all_methods_but_the_yardstick_have_ratios_alone_and_beside():
    found = measure("pendulum", 1, 1)
    assert "lagrange" not in found and len(found) == 5
    for ratios in found.values():
        assert len(ratios.alone) == len(ratios.beside) == 1 and 0.5 < ratios.middle < 20.0
