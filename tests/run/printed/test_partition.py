"""States of model exchange as the loop language has them: chosen, completed, and events without modes."""

import numpy as np
import pytest
from support.emitted import mechanism_of

from symgen import Settings, load
from symgen.compile.loopcode.exact import compiled_form
from symgen.run.compiling.printed import PrintedEvents
from symgen.run.effects.stepping import passes_event
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare
from symgen.run.printed import exchanged_steps as steps
from symgen.run.printed import partition
from symgen.run.printed.exchanged_run import ASK, COMPLETE, HANDLE, HAPPENED, OVER, QUIET
from symgen.run.printed.partition_tables import count_states, new_partition, tables_of
from symgen.run.starts.assembler import layout_of_starts


def partitioned(mechanism):
    """Return a prepared mechanism, its partition, and the arguments of its functions before and behind a state."""
    run = prepare(mechanism, Settings(shape="straight"), Purpose.STATE)
    compiled, start = run.compiled, run.start
    layout, tables = layout_of_starts(compiled), tables_of(compiled, start.w, False)
    part = new_partition(layout, tables)
    return run, tables, (layout, compiled_form(compiled.model.geometry), tables), (start.p, start.w.copy(), part)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["four-bar", "bricard"])
def test_dependent_coordinates_follow_from_the_independent_ones(name):
    run, tables, model, behind = partitioned(load(name).mechanism)
    info, start, part = run.compiled.info, run.start, behind[-1]
    y = start.y.copy()
    compiled_form(partition.choose_states)(model, 0.0, y, *behind)
    assert compiled_form(partition.quality_of_choice)(model, 0.0, y, *behind) == 1.0
    count = count_states(model[0], tables)
    states, other = np.zeros(count), np.zeros(count)
    compiled_form(partition.read_states)(model, y, part, states)
    moved = y + 1e-3 * np.cos(np.arange(len(y)))
    compiled_form(partition.write_states)(model, states, part, moved)
    assert compiled_form(partition.complete_state)(model, 0.0, moved, *behind)
    compiled_form(partition.read_states)(model, moved, part, other)
    assert (other == states).all() and count < info.nq + info.nv
    np.testing.assert_allclose(moved[: info.work], y[: info.work], rtol=0, atol=1e-9)
    assert np.abs(run.compiled.section(behind[1], "residual")).max() < 1e-12


def test_a_choice_gets_worse_towards_where_it_is_singular():
    """A point on a circle: x follows from y at (1, 0), by a row whose entries are x and y."""
    circle = {
        "mechanism": {"name": "circle"},
        "bodies": {"a": {"type": "point", "mass": 1.0, "position": [1.0, 0.0]}},
        "joints": {"c": {"type": "rows", "rows": [{"position": "a.x**2 + a.y**2 - 1"}]}},
    }
    run, _, model, behind = partitioned(mechanism_of(circle))
    y = run.start.y.copy()
    compiled_form(partition.choose_states)(model, 0.0, y, *behind)
    for angle in (0.3, 0.7, 1.0, 1.4):
        y[:2] = np.cos(angle), np.sin(angle)
        quality = compiled_form(partition.quality_of_choice)(model, 0.0, y, *behind)
        assert quality == pytest.approx(min(1.0, 1.0 / np.tan(angle)), rel=1e-12)


BALL = {
    "mechanism": {"name": "ball"},
    "bodies": {"a": {"type": "point", "mass": 1.0, "velocity": [1.0, 0.0]}},
    "events": {
        "blow": {"when": "a.x > 0.5", "reset": {"a.vx": "-2*a.vx"}},
        "end": {"when": "a.x < -1", "action": "stop"},
        "seen": {"when": "a.x < 0", "action": "record"},
    },
}


@pytest.mark.slow
def test_events_of_an_importer_are_noted_handled_and_end_the_motion():
    mechanism = mechanism_of(BALL)
    run, _, model, (p, w, part) = partitioned(mechanism)
    events, y = PrintedEvents.of(mechanism, run.compiled), run.start.y.copy()
    (of_steps, effects, ends), (now, iw, work, impact) = events.steps(run.compiled)
    now = now._replace(y=y, p=p, w=w)
    compiled_form(partition.choose_states)(model, 0.0, y, p, w, part)
    happened, whole = np.zeros(3, dtype=np.int64), (model, of_steps, effects, ends)

    def asked(doing, t):
        return compiled_form(steps.exchange_steps)(whole, doing, t, now, iw, happened, work, impact, part)

    assert asked(ASK, 0.0) == asked(COMPLETE, 0.0) == QUIET
    y[0] = 0.5000001
    assert asked(COMPLETE, 0.5) == HAPPENED and list(happened) == [1, 0, 0] and y[2] == 1.0
    assert asked(HANDLE, 0.5) == HAPPENED and not happened.any() and y[2] == -2.0
    y[0] = -1.1
    assert asked(HANDLE, 1.3) == OVER and y[2] == -2.0


@pytest.mark.parametrize(
    ("direction", "rising", "falling"), [(0, True, True), (1, True, False), (-1, False, True), (2, False, False)]
)
def test_an_event_happens_in_its_direction(direction, rising, falling):
    happens = passes_event.plain
    assert (happens(direction, -1.0, 0.0), happens(direction, 1.0, 0.0)) == (rising, falling)
    assert not happens(direction, 0.0, 1.0) and not happens(direction, 1.0, float("nan"))
