"""What names of loops mean where nothing is bound to them: each returns the code that stands for nothing."""

import math

import numpy as np
import pytest

from symgen.run.layout import abi
from symgen.run.loops import frame_parts, unbound
from symgen.run.modes.bounded_rows import SAME
from symgen.run.printed.exchanged_run import QUIET

NONE = np.zeros(0)


def test_codes_of_later_rooms_are_those_that_they_name() -> None:
    assert unbound.meet_impacts(0.0, None, None) == unbound.gather_impacts(0.0, None, None) == SAME
    assert unbound.rest_lost_gaps(0.0, None, None) == SAME
    assert unbound.pass_seams((), None, None) == QUIET


def test_a_scheme_without_an_attempt_diverges() -> None:
    assert unbound.attempt(None, None, None, None, 0.0, 1.0, 1.0, False) == frame_parts.DIVERGED


def test_a_run_without_events_finds_none_and_steps_as_proposed() -> None:
    assert unbound.locate_event(None, None, None, 1.0, 1.0, frame_parts.SEEK) == frame_parts.NOTHING
    assert unbound.prepare_search(None, None, frame_parts.LOOK) == frame_parts.NOTHING
    assert unbound.step_to_point(None, None, 0.25) == 0.25
    assert not unbound.is_astray(None, None, True)
    assert unbound.take_notes(abi.MET, 0, (), None, None) == abi.MET


def test_a_row_without_modes_and_seams_goes_on() -> None:
    assert unbound.begin_choice((), None, None) == unbound.resume_code(None) == abi.DONE
    assert unbound.take_change((), None, None) == abi.UNPREPARED
    assert not unbound.waits_for_caller(abi.MET, (), None, None)
    assert unbound.next_time((), None) == unbound.next_rest(0.0, None, NONE) == math.inf
    further = object()
    assert unbound.effects_alone(further) is further and unbound.system_of_steps(further) is further


def test_the_place_of_the_loop_is_never_called() -> None:
    with pytest.raises(NotImplementedError):
        unbound.integrate()
